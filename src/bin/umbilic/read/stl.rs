//! Reads STL files, text or binary, with `stl_io` and welds the triangles.
//!
//! STL stores loose triangles. Corners with identical coordinates become one vertex, numbered by first use; corners
//! that are merely close stay apart. Coordinates have single precision.
//!
//! `stl_io` tells text from binary by the first word alone, reads one solid and is strict about letter case, while
//! programs write binary files that start with `solid`, several solids per file and capitals. So the kind is found
//! out here and text is put into the strict form before it is parsed; its lines stay where they are, so that errors
//! name the right one.

use super::Fault;
use super::builder::MeshBuilder;
use super::scanner::shorten;
use crate::mesh::PolygonMesh;
use std::collections::HashMap;
use std::io::{self, BufRead, Cursor, Read, Seek, SeekFrom};

/// How far to look for the zero bytes that give away a binary file: its header has 80 bytes, and its count and first
/// triangle hardly do without zeros.
const SNIFFED_BYTES: usize = 200;

/// Reads an STL file.
pub(super) fn read(mut reader: impl BufRead) -> Result<PolygonMesh, Fault> {
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes)?;
    if is_text(&bytes) {
        let mut lines = LineByLine(Cursor::new(normalize(&bytes)));
        weld(&mut lines).map_err(|error| Fault::on_line(lines.line_number(), shorten(&error.to_string())))
    } else {
        // The header is free text, which `stl_io` must not mistake for a solid.
        bytes.iter_mut().take(5).for_each(|byte| *byte = b' ');
        let length = bytes.len();
        weld(&mut Cursor::new(bytes)).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => {
                Fault::in_file(format!("the file ends before its last triangle, after {length} bytes"))
            }
            _ => error.into(),
        })
    }
}

/// Whether a file is a text rather than a binary one.
fn is_text(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(SNIFFED_BYTES)];
    let first_word = head.trim_ascii_start().get(..5).unwrap_or_default();
    first_word.eq_ignore_ascii_case(b"solid") && !head.contains(&0)
}

/// Puts a text file into the form that `stl_io` reads: small letters, a single solid with a name, and no normals,
/// which may be anything and are not needed.
fn normalize(bytes: &[u8]) -> Vec<u8> {
    // The first line is blank or starts the first solid.
    let mut text = b"solid one".to_vec();
    let mut ended = false;
    for line in bytes.split(|&byte| byte == b'\n') {
        let line = line.trim_ascii().to_ascii_lowercase();
        let word = line.split(u8::is_ascii_whitespace).next();
        match word.unwrap_or_default() {
            b"solid" | b"" => {}
            b"endsolid" => ended = true,
            b"facet" => {
                ended = false;
                text.extend_from_slice(b"facet normal 0 0 0");
            }
            _ => text.extend_from_slice(&line),
        }
        text.push(b'\n');
    }
    // Without this end, `stl_io` will report the truncation.
    if ended {
        text.extend_from_slice(b"endsolid\n");
    }
    text
}

/// Reads triangles and makes one vertex of corners with equal coordinates.
fn weld(reader: &mut (impl Read + Seek)) -> io::Result<PolygonMesh> {
    let mut vertices = HashMap::new();
    let mut builder = MeshBuilder::new(0);
    for triangle in stl_io::create_stl_reader(reader)? {
        for corner in triangle?.vertices {
            // Adding zero turns a negative zero into a positive one, whose bits are those of the equal coordinate.
            let position = corner.0.map(|coordinate| coordinate + 0.0);
            let next = builder.vertex_count();
            let vertex = *vertices.entry(position.map(f32::to_bits)).or_insert(next);
            if vertex == next {
                builder.add_vertex(position.map(f64::from));
            }
            builder.add_corner(vertex as i64, None).map_err(|fault| io::Error::other(fault.message))?;
        }
        builder.end_face().map_err(|fault| io::Error::other(fault.message))?;
    }
    builder.finish().map_err(|fault| io::Error::other(fault.message))
}

/// A text that is read one line at a time, even through a buffer, so that the position tells which line is being
/// parsed.
struct LineByLine(Cursor<Vec<u8>>);

impl LineByLine {
    /// The number of lines read so far.
    fn line_number(&self) -> usize {
        let end = self.0.get_ref().len().min(self.0.position() as usize);
        let read = &self.0.get_ref()[..end];
        read.iter().filter(|&&byte| byte == b'\n').count()
    }
}

impl Read for LineByLine {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let rest = self.0.fill_buf()?;
        let line = rest.split_inclusive(|&byte| byte == b'\n').next();
        let count = line.map_or(0, |line| line.len().min(buffer.len()));
        self.0.read(&mut buffer[..count])
    }
}

impl Seek for LineByLine {
    fn seek(&mut self, target: SeekFrom) -> io::Result<u64> {
        self.0.seek(target)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles that share an edge, one corner of which has a negative zero in the second one.
    const TRIANGLES: [[[f32; 3]; 3]; 2] =
        [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]], [[1.0, 0.0, -0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5]]];

    fn binary(header: &[u8]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(2_u32.to_le_bytes());
        for corners in TRIANGLES {
            bytes.extend([0; 12]);
            bytes.extend(corners.as_flattened().iter().flat_map(|c| c.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    fn facet(corners: [[f32; 3]; 3]) -> String {
        let mut text = "  facet normal nan nan nan\n    outer loop\n".to_owned();
        for [x, y, z] in corners {
            text += &format!("      vertex {x} {y} {z}\n");
        }
        text + "    endloop\n  endfacet\n"
    }

    fn check(mesh: &PolygonMesh) {
        assert_eq!(mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5], [1.0, 1.0, 0.0]]);
        assert_eq!(mesh.offsets, [0, 3, 6]);
        assert_eq!(mesh.indices, [0, 1, 2, 1, 3, 2]);
    }

    #[test]
    fn binary_files_are_welded_whatever_their_header_says() {
        for header in [&b"exported"[..], b"solid exported", b""] {
            check(&read(&binary(header)[..]).unwrap());
        }
    }

    #[test]
    fn text_files_may_have_capitals_and_several_solids() {
        let [first, second] = TRIANGLES.map(facet);
        let plain = format!("solid\n{first}{second}endsolid");
        let split = format!("\r\nSolid a\r\n{first}endsolid a\r\n\r\nsolid b\r\n{second}endsolid b\r\n\r\n");
        for text in [plain.clone(), plain.to_uppercase(), split] {
            check(&read(text.as_bytes()).unwrap());
        }
    }

    #[test]
    fn truncated_files_are_faults() {
        let bytes = binary(b"");
        for length in 0..bytes.len() {
            assert!(read(&bytes[..length]).is_err());
        }
        let text = format!("solid a\n{}", TRIANGLES.map(facet).concat());
        for length in 0..=text.len() {
            assert!(read(&text.as_bytes()[..length]).is_err());
        }
    }

    #[test]
    fn text_faults_name_the_line() {
        let text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 q 0\n";
        let fault = read(text.as_bytes()).unwrap_err();
        assert_eq!(fault.line, Some(5));
        let fault = read(format!("\n\n{text}").as_bytes()).unwrap_err();
        assert_eq!(fault.line, Some(7));
    }

    #[test]
    fn a_huge_count_costs_nothing() {
        let mut bytes = binary(b"");
        bytes[80..84].fill(0xff);
        let fault = read(&bytes[..]).unwrap_err();
        assert!(fault.message.contains("last triangle"), "{}", fault.message);
    }
}

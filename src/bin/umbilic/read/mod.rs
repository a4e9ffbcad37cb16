//! Reads a polygon mesh from an OBJ, PLY, STL or OFF file, and a polyline from a text file.
//!
//! The format follows from the file name's extension and, when that says nothing, from the first bytes. Every reader
//! keeps polygons as they are, keeps the order of the vertices (STL has none, so there equal corners become one
//! vertex) and ignores everything but positions and faces.
//!
//! A damaged file gives an error that names the line, where there are lines, or the face. Counts claimed by a header
//! are never trusted with memory: storage grows with the data that is really there.

mod builder;
mod obj;
mod off;
mod ply;
mod points;
mod scanner;
mod stl;

pub use points::PolylineFile;

use crate::mesh::PolygonMesh;
use crate::progress;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::{error, fmt};

/// Why a file could not be read; displays as `FILE:LINE: what`, or as `FILE: what` when no line is to blame.
#[derive(Debug)]
pub struct ReadError {
    /// The file as it was named.
    path: PathBuf,
    /// What is wrong in it, and where.
    fault: Fault,
}

impl fmt::Display for ReadError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.path.display())?;
        if let Some(line) = self.fault.line {
            write!(formatter, ":{line}")?;
        }
        write!(formatter, ": {}", self.fault.message)
    }
}

impl error::Error for ReadError {}

/// What is wrong in a file whose name the format's reader need not know.
#[derive(Debug)]
struct Fault {
    /// The line to blame, counted from one.
    line: Option<usize>,
    /// What is wrong there.
    message: String,
}

impl Fault {
    /// A fault on a known line, counted from one.
    fn on_line(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), message: message.into() }
    }

    /// A fault of the file as a whole or of a binary part of it.
    fn in_file(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into() }
    }
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::in_file(error.to_string())
    }
}

/// The file formats that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Polygon file format, also known as Stanford triangle format.
    Ply,
    /// Stereolithography.
    Stl,
    /// Geomview's object file format.
    Off,
}

impl Format {
    /// The format that an extension stands for, in any letter case.
    fn from_extension(extension: &OsStr) -> Option<Self> {
        match extension.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            "off" | "coff" | "noff" | "cnoff" => Some(Self::Off),
            _ => None,
        }
    }

    /// The format whose files start like this. Binary STL has no mark of its own and can only be told by its
    /// extension.
    fn from_first_bytes(bytes: &[u8]) -> Option<Self> {
        let text = String::from_utf8_lossy(bytes);
        let mut words = text
            .lines()
            .map(str::trim_start)
            .filter(|line| !line.is_empty() && !line.starts_with('#'))
            .filter_map(|line| line.split_whitespace().next());
        match words.next()? {
            "ply" => Some(Self::Ply),
            "v" | "vn" | "vt" | "o" | "g" | "mtllib" => Some(Self::Obj),
            word if word.eq_ignore_ascii_case("solid") => Some(Self::Stl),
            word if off::split_keyword(word).is_some() => Some(Self::Off),
            _ => None,
        }
    }
}

/// Reads the mesh in a file, with a progress bar if it is large.
pub fn read_mesh(path: &Path) -> Result<PolygonMesh, ReadError> {
    read_file(path).map_err(|fault| ReadError { path: path.to_owned(), fault })
}

/// Reads the polyline in a text file, with a progress bar if it is large.
pub fn read_polyline(path: &Path) -> Result<PolylineFile, ReadError> {
    let read = || {
        let file = File::open(path)?;
        let bar = progress::reading(file.metadata()?.len());
        let polyline = points::read(BufReader::new(bar.wrap_read(file)));
        bar.finish_and_clear();
        polyline
    };
    read().map_err(|fault| ReadError { path: path.to_owned(), fault })
}

/// Opens a file, finds out its format and reads it.
fn read_file(path: &Path) -> Result<PolygonMesh, Fault> {
    let file = File::open(path)?;
    let bar = progress::reading(file.metadata()?.len());
    let mut reader = BufReader::new(bar.wrap_read(file));
    let format = match path.extension().and_then(Format::from_extension) {
        Some(format) => format,
        None => Format::from_first_bytes(reader.fill_buf()?)
            .ok_or_else(|| Fault::in_file("not recognised as one of the formats OBJ, PLY, STL and OFF"))?,
    };
    let mesh = read_format(format, reader);
    bar.finish_and_clear();
    mesh
}

/// Reads a mesh in a known format.
fn read_format(format: Format, reader: impl BufRead) -> Result<PolygonMesh, Fault> {
    let mesh = match format {
        Format::Obj => obj::read(reader),
        Format::Ply => ply::read(reader),
        Format::Stl => stl::read(reader),
        Format::Off => off::read(reader),
    }?;
    // Also catches an unrelated file under the name of a lenient text format.
    if mesh.positions.is_empty() {
        return Err(Fault::in_file("there is no vertex in it"));
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Reads bytes as a format, for the tests of all formats.
    pub(super) fn read_bytes(format: Format, bytes: &[u8]) -> Result<PolygonMesh, Fault> {
        read_format(format, bytes)
    }

    /// One triangle in each text format.
    const SAMPLES: [(Format, &str); 4] = [
        (Format::Obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        (
            Format::Ply,
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
             end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        ),
        (
            Format::Stl,
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
             vertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
        ),
        (Format::Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
    ];

    /// A deterministic stream of bytes that look like noise.
    fn noise(seed: u64) -> impl Iterator<Item = u8> {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        std::iter::repeat_with(move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 32) as u8
        })
    }

    #[test]
    fn the_samples_are_recognised_by_their_first_bytes() {
        for (format, text) in SAMPLES {
            assert_eq!(Format::from_first_bytes(text.as_bytes()), Some(format));
        }
        assert_eq!(Format::from_first_bytes(b"hello\n"), None);
        assert_eq!(Format::from_first_bytes(b""), None);
    }

    #[test]
    fn all_formats_agree_on_the_sample() {
        for (format, text) in SAMPLES {
            let mesh = read_bytes(format, text.as_bytes()).unwrap();
            assert_eq!(mesh.positions.len(), 3, "{format:?}");
            assert_eq!(mesh.positions[2], [0.0, 1.0, 0.0], "{format:?}");
            assert_eq!(mesh.indices, [0, 1, 2], "{format:?}");
            assert_eq!(mesh.offsets, [0, 3], "{format:?}");
        }
    }

    #[test]
    fn truncated_files_are_errors_or_valid_meshes() {
        for (format, text) in SAMPLES {
            for length in 0..text.len() {
                if let Ok(mesh) = read_bytes(format, &text.as_bytes()[..length]) {
                    assert!(mesh.indices.iter().all(|&index| index < 3));
                }
            }
        }
    }

    #[test]
    fn noise_never_panics() {
        for (format, text) in SAMPLES {
            for seed in 0..300 {
                let pure: Vec<u8> = noise(seed).take(600).collect();
                let _ = read_bytes(format, &pure);
                let mut damaged = text.as_bytes().to_vec();
                for pair in noise(seed).take(8).collect::<Vec<u8>>().chunks_exact(2) {
                    let place = usize::from(pair[0]) % damaged.len();
                    damaged[place] = pair[1];
                }
                let _ = read_bytes(format, &damaged);
            }
        }
    }

    #[test]
    fn an_error_names_the_file_and_the_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("BROKEN.OBJ");
        fs::write(&path, "v 0 0 0\nv 1 zero 0\n").unwrap();
        let error = read_mesh(&path).unwrap_err().to_string();
        assert!(error.contains("BROKEN.OBJ:2: "), "{error}");
        assert!(error.contains("zero"), "{error}");
    }

    #[test]
    fn a_missing_file_and_an_unknown_format_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        let missing = read_mesh(&folder.path().join("none.ply")).unwrap_err();
        assert!(missing.to_string().contains("none.ply: "), "{missing}");
        let path = folder.path().join("notes.txt");
        fs::write(&path, "just some words\n").unwrap();
        let unknown = read_mesh(&path).unwrap_err();
        assert!(unknown.to_string().contains("not recognised"), "{unknown}");
    }
}

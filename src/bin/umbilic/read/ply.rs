//! Reads PLY files, text or binary of either byte order, with `ply-rs-bw`.
//!
//! The mesh is made of the `vertex` element's `x`, `y` and `z` and of the `face` element's list `vertex_indices` (or
//! `vertex_index`), of whatever number types; all other properties and elements are skipped. Triangle strips are not
//! supported, and numbers in text files need digits on both sides of their decimal point.

use super::Fault;
use super::builder::MeshBuilder;
use super::scanner::shorten;
use crate::mesh::PolygonMesh;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType};
use std::io::{BufRead, ErrorKind};

/// The names of the coordinates in the order of the axes.
const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// The names under which programs store the corners of faces.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads a PLY file.
pub(super) fn read(reader: impl BufRead) -> Result<PolygonMesh, Fault> {
    let mut reader = Reader::new(reader);
    let header = Parser::<Skipped>::new().read_header(&mut reader).map_err(|error| fault(&error, true))?;
    check_header(&header)?;
    let mut builder = MeshBuilder::new(0);
    for definition in header.elements.values() {
        match definition.name.as_str() {
            "vertex" => {
                read_elements(&mut reader, definition, &header, |vertex: Vertex, _| {
                    builder.add_vertex(vertex.position);
                    Ok(())
                })?;
            }
            "face" => {
                read_elements(&mut reader, definition, &header, |face: Face, line| {
                    for corner in face.corners {
                        builder.add_corner(corner, line)?;
                    }
                    builder.end_face()
                })?;
            }
            _ => read_elements(&mut reader, definition, &header, |Skipped, _| Ok(()))?,
        }
    }
    builder.finish()
}

/// Checks that the header declares what a mesh needs.
fn check_header(header: &Header) -> Result<(), Fault> {
    // Elements without properties take no space in a binary file, so that the end of the file would not stop the
    // reading of any number of them.
    if let Some(empty) = header.elements.values().find(|e| e.properties.is_empty()) {
        let name = &empty.name;
        return Err(Fault::in_file(format!("element `{name}` has no properties")));
    }
    let Some(vertex) = header.elements.get("vertex") else {
        return Err(Fault::in_file("there is no element `vertex`"));
    };
    for name in COORDINATES {
        match vertex.properties.get(name).map(|p| &p.data_type) {
            Some(PropertyType::Scalar(_)) => {}
            _ => return Err(Fault::in_file(format!("the vertices have no `{name}`"))),
        }
    }
    match header.elements.get("face") {
        Some(face) if !CORNERS.iter().any(|name| has_list(face, name)) => {
            Err(Fault::in_file("the faces have no list `vertex_indices`"))
        }
        None if header.elements.contains_key("tristrips") => Err(Fault::in_file("triangle strips are not supported")),
        _ => Ok(()),
    }
}

/// Whether an element has a list property of this name.
fn has_list(definition: &ElementDef, name: &str) -> bool {
    definition.properties.get(name).is_some_and(|property| matches!(property.data_type, PropertyType::List(..)))
}

/// Reads all instances of an element, one after the other, and hands each on with its line if it has one.
fn read_elements<E: PropertyAccess>(
    reader: &mut Reader<impl BufRead>,
    definition: &ElementDef,
    header: &Header,
    mut take: impl FnMut(E, Option<usize>) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let in_text = header.encoding == Encoding::Ascii;
    let parser = Parser::new();
    let mut single = definition.clone();
    single.count = 1;
    for index in 0..definition.count {
        let elements = parser.read_payload_for_element(reader, &single, header).map_err(|error| {
            if error.kind() == ErrorKind::UnexpectedEof {
                let ElementDef { name, count, .. } = definition;
                return Fault::in_file(format!("the file ends after {index} of {count} elements `{name}`"));
            }
            fault(&error, in_text)
        })?;
        // The parser has gone on to the line behind the element.
        let line = in_text.then(|| reader.line() - 1);
        for element in elements {
            take(element, line)?;
        }
    }
    Ok(())
}

/// Turns a parser's error, which spans lines and quotes all input, into a short one. In binary data the parser counts
/// elements as lines, which would send the reader of the message to the wrong place.
fn fault(error: &ParseError, in_text: bool) -> Fault {
    let message = error.to_string();
    let message = match error.line() {
        Some(line) => message.strip_prefix(&format!("Line {line}: ")).unwrap_or(&message),
        None => &message,
    };
    let words: Vec<&str> = message.split_whitespace().collect();
    Fault { line: error.line().filter(|_| in_text), message: shorten(&words.join(" ")) }
}

/// The part of a vertex that is kept.
struct Vertex {
    /// The coordinates.
    position: [f64; 3],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { position: [0.0; 3] }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(axis) = COORDINATES.iter().position(|&axis| axis == name) else {
            return PropertyAccessResult::Ignored;
        };
        self.position[axis] = match property {
            Property::Char(value) => value.into(),
            Property::UChar(value) => value.into(),
            Property::Short(value) => value.into(),
            Property::UShort(value) => value.into(),
            Property::Int(value) => value.into(),
            Property::UInt(value) => value.into(),
            Property::Float(value) => value.into(),
            Property::Double(value) => value,
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

/// The part of a face that is kept.
struct Face {
    /// The vertices around the face, which may be negative in a bad file.
    corners: Vec<i64>,
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self { corners: Vec::new() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !CORNERS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.corners = match property {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

/// An element of which nothing is kept.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "comment made by hand\nelement vertex 4\nproperty double x\n\
                          property float y\nproperty short z\nproperty uchar red\n\
                          element edge 1\nproperty list uchar float weights\n\
                          element face 2\nproperty uchar flags\n\
                          property list uchar uint vertex_index\nend_header\n";

    fn fault_of(bytes: &[u8]) -> (Option<usize>, String) {
        let fault = read(bytes).unwrap_err();
        (fault.line, fault.message)
    }

    /// The same mesh as in the text test, in binary.
    fn binary(little_endian: bool) -> Vec<u8> {
        let order = if little_endian { "little" } else { "big" };
        let mut bytes = format!("ply\nformat binary_{order}_endian 1.0\n{HEADER}").into_bytes();
        let mut push = |native: &[u8]| {
            let reversed = native.iter().rev().copied();
            if little_endian == cfg!(target_endian = "little") {
                bytes.extend_from_slice(native);
            } else {
                bytes.extend(reversed);
            }
        };
        for (x, y, z) in [(0.1, 0.0, 0_i16), (1.0, 0.0, -2), (1.0, 1.0, 0), (0.0, 1.0, 0)] {
            push(&f64::to_ne_bytes(x));
            push(&f32::to_ne_bytes(y));
            push(&z.to_ne_bytes());
            push(&[200]);
        }
        push(&[1]);
        push(&1.5_f32.to_ne_bytes());
        for corners in [&[0_u32, 1, 2, 3][..], &[0, 1, 2]] {
            push(&[7]);
            push(&[corners.len() as u8]);
            for corner in corners {
                push(&corner.to_ne_bytes());
            }
        }
        bytes
    }

    #[test]
    fn text_and_both_byte_orders_give_the_same_mesh() {
        let text = format!(
            "ply\r\nformat ascii 1.0\n{HEADER}0.1 0 0 200\n1 0 -2 200\n1 1 0 200\n0 1 0 200\n\
             1 1.5\n7 4 0 1 2 3\n7 3 0 1 2\n"
        );
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.positions[0], [0.1, 0.0, 0.0]);
        assert_eq!(mesh.positions[1], [1.0, 0.0, -2.0]);
        assert_eq!(mesh.offsets, [0, 4, 7]);
        assert_eq!(mesh.indices, [0, 1, 2, 3, 0, 1, 2]);
        assert_eq!(read(&binary(true)[..]).unwrap(), mesh);
        assert_eq!(read(&binary(false)[..]).unwrap(), mesh);
    }

    #[test]
    fn truncated_binary_files_are_faults_without_a_line() {
        let bytes = binary(true);
        for length in 0..bytes.len() {
            let fault = read(&bytes[..length]).unwrap_err();
            let in_header = length < bytes.len() - 60;
            assert!(in_header || fault.line.is_none());
        }
    }

    #[test]
    fn text_faults_name_the_line() {
        let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n\
                    property float y\nproperty float z\nend_header\n0 zero 0\n";
        let (line, message) = fault_of(text.as_bytes());
        assert_eq!(line, Some(8));
        assert!(message.contains("zero"), "{message}");
        assert!(!message.contains('\n'), "{message}");
        let (line, _) = fault_of(b"ply\nformat ascii 1.0\nproperly\n");
        assert_eq!(line, Some(3));
    }

    #[test]
    fn bad_indices_name_the_line_and_the_face() {
        for index in [-1, 3] {
            let text = format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property float z\nelement face 2\nproperty list uchar int vertex_indices\n\
                 end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 {index}\n"
            );
            let (line, message) = fault_of(text.as_bytes());
            assert_eq!(line, Some(14));
            assert!(message.contains("face 1"), "{message}");
            assert!(message.contains(&format!("vertex {index},")), "{message}");
        }
    }

    #[test]
    fn huge_claims_cost_nothing() {
        let header = "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n\
                      property float x\nproperty float y\nproperty float z\nend_header\n";
        assert!(fault_of(header.as_bytes()).1.contains("ends after 0 of"));
        let empty = "ply\nformat binary_little_endian 1.0\nelement nothing 18446744073709551615\n\
                     element vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
                     end_header\n";
        assert!(fault_of(empty.as_bytes()).1.contains("no properties"));
        let mut list = b"ply\nformat binary_little_endian 1.0\nelement face 1\n\
                         property list uint int vertex_indices\nelement vertex 1\n\
                         property float x\nproperty float y\nproperty float z\nend_header\n"
            .to_vec();
        list.extend(u32::MAX.to_le_bytes());
        list.extend([0; 40]);
        fault_of(&list);
    }

    #[test]
    fn headers_without_a_mesh_are_faults() {
        let vertex = "element vertex 0\nproperty float x\nproperty float y\nproperty list uchar float z\n";
        for (elements, expected) in [
            ("", "no element `vertex`"),
            (vertex, "no `z`"),
            (
                "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n\
                 element face 0\nproperty int a\n",
                "no list",
            ),
        ] {
            let text = format!("ply\nformat ascii 1.0\n{elements}end_header\n");
            let (_, message) = fault_of(text.as_bytes());
            assert!(message.contains(expected), "{message}");
        }
    }
}

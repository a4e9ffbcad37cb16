//! Writes a mesh with properties of vertices and faces as a PLY file, with `ply-rs-bw`.
//!
//! Positions are floats if none of them loses anything by it, and doubles otherwise; normals and scalar columns are
//! floats, colors and flags bytes, labels signed integers, under the names that MeshLab, Blender and ParaView know. Faces
//! are lists of signed 32-bit indices, the only kind that all of them read, so a mesh may have at most 2147483648 vertices.

use crate::mesh::PolygonMesh;
use crate::output::{WriteError, write_file};
use ply_rs_bw::ply::{
    Addable, DefaultElement, ElementDef, Encoding, Header, Property, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;
use std::io;
use std::path::Path;

/// The list of the corners of a face.
const CORNERS: &str = "vertex_indices";

/// The encodings of PLY that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlyFormat {
    /// Text that a person can read.
    Ascii,
    /// Bytes, small and exact.
    BinaryLittleEndian,
}

/// What to write for each vertex besides its position, or for each face besides its corners. Every slice needs one entry
/// for each of them.
#[derive(Debug, Clone, Default)]
pub struct Properties<'a> {
    /// Normals, written as `nx`, `ny` and `nz`.
    pub normals: Option<&'a [[f32; 3]]>,
    /// Named scalars.
    pub columns: Vec<Column<'a>>,
    /// Colors, written as `red`, `green` and `blue`.
    pub colors: Option<&'a [[u8; 3]]>,
}

/// A named scalar.
#[derive(Debug, Clone, Copy)]
pub struct Column<'a> {
    /// The name of the property: a letter or `_`, then letters, digits, `_` or `-`.
    pub name: &'a str,
    /// The values.
    pub values: ColumnValues<'a>,
}

/// The values of a scalar.
#[derive(Debug, Clone, Copy)]
pub enum ColumnValues<'a> {
    /// Written as `float`; what is beyond its range as its largest number.
    Float(&'a [f64]),
    /// One axis of vectors, written as `float`.
    Axis(&'a [[f32; 3]], usize),
    /// Written as `uchar`.
    Byte(&'a [u8]),
    /// Written as `int`; what is beyond its range as -1.
    Label(&'a [u32]),
}

impl<'a> ColumnValues<'a> {
    /// The number of values.
    fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Axis(values, _) => values.len(),
            Self::Byte(values) => values.len(),
            Self::Label(values) => values.len(),
        }
    }
}

/// One property of all vertices, or of all faces.
struct NamedProperty<'a> {
    /// The name in the file.
    name: &'a str,
    /// The type in the file.
    scalar: ScalarType,
    /// The value at one of them.
    value: Box<dyn Fn(usize) -> Property + 'a>,
}

/// Writes a mesh to a PLY file, which is replaced if it exists.
pub fn write_ply(
    path: &Path,
    mesh: &PolygonMesh,
    of_vertices: &Properties<'_>,
    of_faces: &Properties<'_>,
    format: PlyFormat,
) -> Result<(), WriteError> {
    check(mesh, of_vertices, of_faces).map_err(|message| WriteError::new(path, message))?;
    let mut vertex_properties = list_positions(mesh);
    vertex_properties.extend(list_properties(of_vertices));
    let face_properties = list_properties(of_faces);
    let header = describe(mesh, &vertex_properties, &face_properties, format);
    write_file(path, |out| {
        let writer = Writer::<DefaultElement>::new();
        writer.write_header(out, &header)?;
        let mut row = DefaultElement::new();
        for vertex in 0..mesh.vertex_count() {
            for property in &vertex_properties {
                set(&mut row, property.name, (property.value)(vertex));
            }
            write_row(&writer, out, &row, &header, "vertex")?;
        }
        row.clear();
        for (index, face) in mesh.faces().enumerate() {
            // The check above has made sure that no index wraps around.
            let corners = face.iter().map(|&vertex| vertex as i32).collect();
            set(&mut row, CORNERS, Property::ListInt(corners));
            for property in &face_properties {
                set(&mut row, property.name, (property.value)(index));
            }
            write_row(&writer, out, &row, &header, "face")?;
        }
        Ok(())
    })
}

/// Checks what would make the file unreadable.
fn check(mesh: &PolygonMesh, of_vertices: &Properties<'_>, of_faces: &Properties<'_>) -> Result<(), String> {
    let vertex_count = mesh.vertex_count();
    if i32::try_from(vertex_count.saturating_sub(1)).is_err() {
        return Err(format!("{vertex_count} vertices are too many for PLY"));
    }
    check_properties(of_vertices, &["x", "y", "z"], vertex_count, "vertices")?;
    check_properties(of_faces, &[CORNERS], mesh.face_count(), "faces")
}

/// Checks the names of properties besides those that all elements have, and their numbers.
fn check_properties(properties: &Properties<'_>, own: &[&str], count: usize, elements: &str) -> Result<(), String> {
    let mut names: Vec<&str> = own.to_vec();
    let mut lengths = Vec::new();
    if let Some(normals) = properties.normals {
        names.extend(["nx", "ny", "nz"]);
        lengths.push(("the normals", normals.len()));
    }
    if let Some(colors) = properties.colors {
        names.extend(["red", "green", "blue"]);
        lengths.push(("the colors", colors.len()));
    }
    for column in &properties.columns {
        if !is_name(column.name) {
            return Err(format!("`{}` cannot name a PLY property", column.name));
        }
        if names.contains(&column.name) {
            return Err(format!("there are two properties `{}`", column.name));
        }
        names.push(column.name);
        lengths.push((column.name, column.values.len()));
    }
    match lengths.iter().find(|(_, length)| *length != count) {
        Some((what, length)) => Err(format!("{what}: {length} values for {count} {elements}")),
        None => Ok(()),
    }
}

/// Whether a text can name a property.
fn is_name(name: &str) -> bool {
    let start = |byte: u8| byte.is_ascii_alphabetic() || byte == b'_';
    name.bytes().next().is_some_and(start)
        && name.bytes().all(|byte| start(byte) || byte.is_ascii_digit() || byte == b'-')
}

/// The positions of the vertices.
fn list_positions(mesh: &PolygonMesh) -> Vec<NamedProperty<'_>> {
    let exact = mesh.positions.as_flattened().iter().all(|&x| f64::from(x as f32) == x);
    let property = |(axis, name)| {
        if exact {
            let value = Box::new(move |vertex: usize| Property::Float(mesh.positions[vertex][axis] as f32));
            NamedProperty { name, scalar: ScalarType::Float, value }
        } else {
            let value = Box::new(move |vertex: usize| Property::Double(mesh.positions[vertex][axis]));
            NamedProperty { name, scalar: ScalarType::Double, value }
        }
    };
    ["x", "y", "z"].into_iter().enumerate().map(property).collect()
}

/// All other properties in the order of the file.
fn list_properties<'a>(properties: &Properties<'a>) -> Vec<NamedProperty<'a>> {
    let mut list = Vec::new();
    if let Some(normals) = properties.normals {
        for (axis, name) in ["nx", "ny", "nz"].into_iter().enumerate() {
            list.push(NamedProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |index| Property::Float(normals[index][axis])),
            });
        }
    }
    if let Some(colors) = properties.colors {
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            list.push(NamedProperty {
                name,
                scalar: ScalarType::UChar,
                value: Box::new(move |index| Property::UChar(colors[index][channel])),
            });
        }
    }
    for &Column { name, values } in &properties.columns {
        list.push(match values {
            ColumnValues::Float(values) => NamedProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |index| {
                    Property::Float(values[index].clamp(f32::MIN.into(), f32::MAX.into()) as f32)
                }),
            },
            ColumnValues::Axis(values, axis) => NamedProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |index| Property::Float(values[index][axis])),
            },
            ColumnValues::Byte(values) => NamedProperty {
                name,
                scalar: ScalarType::UChar,
                value: Box::new(move |index| Property::UChar(values[index])),
            },
            ColumnValues::Label(values) => NamedProperty {
                name,
                scalar: ScalarType::Int,
                value: Box::new(move |index| Property::Int(i32::try_from(values[index]).unwrap_or(-1))),
            },
        });
    }
    list
}

/// Describes the elements and properties of the file.
fn describe(
    mesh: &PolygonMesh,
    of_vertices: &[NamedProperty<'_>],
    of_faces: &[NamedProperty<'_>],
    format: PlyFormat,
) -> Header {
    let mut vertex = ElementDef::new("vertex".to_owned());
    vertex.count = mesh.vertex_count();
    add_properties(&mut vertex, of_vertices);
    let mut face = ElementDef::new("face".to_owned());
    face.count = mesh.face_count();
    // The usual byte does not count the corners of very large polygons.
    let largest = mesh.faces().map(<[u32]>::len).max().unwrap_or(0);
    let count = match u8::try_from(largest) {
        Ok(_) => ScalarType::UChar,
        Err(_) => ScalarType::UInt,
    };
    face.properties.add(PropertyDef::new(CORNERS.to_owned(), PropertyType::List(count, ScalarType::Int)));
    add_properties(&mut face, of_faces);
    let mut header = Header::new();
    header.encoding = match format {
        PlyFormat::Ascii => Encoding::Ascii,
        PlyFormat::BinaryLittleEndian => Encoding::BinaryLittleEndian,
    };
    header.elements.add(vertex);
    header.elements.add(face);
    header
}

/// Describes properties of an element.
fn add_properties(element: &mut ElementDef, properties: &[NamedProperty<'_>]) {
    for property in properties {
        let kind = PropertyType::Scalar(property.scalar.clone());
        element.properties.add(PropertyDef::new(property.name.to_owned(), kind));
    }
}

/// Sets a property, allocating its name only the first time.
fn set(row: &mut DefaultElement, name: &str, property: Property) {
    match row.get_mut(name) {
        Some(place) => *place = property,
        None => {
            row.insert(name.to_owned(), property);
        }
    }
}

/// Writes one vertex or face.
fn write_row(
    writer: &Writer<DefaultElement>,
    out: &mut impl io::Write,
    row: &DefaultElement,
    header: &Header,
    element: &str,
) -> io::Result<()> {
    let definition = &header.elements[element];
    match header.encoding {
        Encoding::Ascii => writer.write_ascii_element(out, row, definition)?,
        _ => writer.write_little_endian_element(out, row, definition)?,
    };
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::read_mesh;
    use std::fs;

    fn sample() -> PolygonMesh {
        PolygonMesh {
            positions: vec![[0.1, 0.0, 0.0], [1.0, 1e-20, 0.0], [1.0, 1.0, -3e10], [0.0, 1.0, 0.0]],
            offsets: vec![0, 4, 7],
            indices: vec![0, 1, 2, 3, 2, 1, 0],
        }
    }

    /// Writes a mesh and returns the file's text, as far as it is text, and the mesh that is read back from it.
    fn round_trip(mesh: &PolygonMesh, properties: &Properties<'_>, format: PlyFormat) -> (String, PolygonMesh) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ply");
        write_ply(&path, mesh, properties, &Properties::default(), format).unwrap();
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        (text, read_mesh(&path).unwrap())
    }

    fn failure(mesh: &PolygonMesh, properties: &Properties<'_>) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ply");
        let error = write_ply(&path, mesh, properties, &Properties::default(), PlyFormat::Ascii).unwrap_err();
        assert!(!path.exists());
        error.to_string()
    }

    #[test]
    fn all_properties_survive_the_round_trip() {
        let mesh = sample();
        let properties = Properties {
            normals: Some(&[[0.0, 0.6, 0.8]; 4]),
            columns: vec![
                Column { name: "quality", values: ColumnValues::Float(&[0.5, 1e300, 2.5, 3.5]) },
                Column { name: "to_x", values: ColumnValues::Axis(&[[0.25, 0.5, 0.75]; 4], 1) },
                Column { name: "flag", values: ColumnValues::Byte(&[1, 2, 3, 4]) },
            ],
            colors: Some(&[[255, 128, 0]; 4]),
        };
        for format in [PlyFormat::Ascii, PlyFormat::BinaryLittleEndian] {
            let (text, read_back) = round_trip(&mesh, &properties, format);
            assert_eq!(read_back, mesh);
            for line in [
                "element vertex 4",
                "property double x",
                "property float nx",
                "property uchar red",
                "property float quality",
                "property float to_x",
                "property uchar flag",
                "element face 2",
                "property list uchar int vertex_indices",
            ] {
                assert!(text.lines().any(|found| found == line), "{line}");
            }
        }
        let (text, _) = round_trip(&mesh, &properties, PlyFormat::Ascii);
        assert!(text.contains("\n0.1 0 0 0 0.6 0.8 255 128 0 0.5 0.5 1\n"), "{text}");
        assert!(text.ends_with("\n4 0 1 2 3\n3 2 1 0\n"), "{text}");
    }

    #[test]
    fn faces_have_properties_of_their_own() {
        let mesh = sample();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ply");
        let of_faces = Properties {
            columns: vec![Column { name: "label", values: ColumnValues::Label(&[7, u32::MAX]) }],
            colors: Some(&[[255, 128, 0], [1, 2, 3]]),
            ..Properties::default()
        };
        for format in [PlyFormat::BinaryLittleEndian, PlyFormat::Ascii] {
            write_ply(&path, &mesh, &Properties::default(), &of_faces, format).unwrap();
            assert_eq!(read_mesh(&path).unwrap(), mesh);
        }
        let text = fs::read_to_string(&path).unwrap();
        let header = "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n\
                      property uchar blue\nproperty int label\nend_header\n";
        assert!(text.contains(header), "{text}");
        assert!(text.ends_with("\n4 0 1 2 3 255 128 0 7\n3 2 1 0 1 2 3 -1\n"), "{text}");
        let few = Properties { colors: Some(&[[0; 3]; 4]), ..Properties::default() };
        let error = write_ply(&path, &mesh, &Properties::default(), &few, PlyFormat::Ascii).unwrap_err();
        assert!(error.to_string().ends_with("the colors: 4 values for 2 faces"), "{error}");
    }

    #[test]
    fn large_polygons_get_a_larger_count() {
        let corners = 300;
        let mesh = PolygonMesh {
            positions: vec![[0.5; 3]; corners as usize],
            offsets: vec![0, corners],
            indices: (0..corners).collect(),
        };
        for format in [PlyFormat::Ascii, PlyFormat::BinaryLittleEndian] {
            let (text, read_back) = round_trip(&mesh, &Properties::default(), format);
            assert!(text.contains("property list uint int vertex_indices\n"));
            assert_eq!(read_back, mesh);
        }
    }

    #[test]
    fn unfit_properties_are_refused() {
        let mesh = sample();
        let normals = Properties { normals: Some(&[[0.0; 3]; 3]), ..Properties::default() };
        assert!(failure(&mesh, &normals).contains("3 values for 4 vertices"));
        for name in ["", "two words", "1st", "x", "z\nelement"] {
            let column = Properties {
                columns: vec![Column { name, values: ColumnValues::Byte(&[0; 4]) }],
                ..Properties::default()
            };
            assert!(failure(&mesh, &column).contains("propert"));
        }
    }
}

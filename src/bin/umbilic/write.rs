//! Writes a mesh with vertex properties as a PLY file, with `ply-rs-bw`.
//!
//! Positions are floats if none of them loses anything by it, and doubles otherwise; normals and scalar columns are
//! floats, colors and flags bytes, under the names that MeshLab, Blender and ParaView know. Faces are lists of signed
//! 32-bit indices, the only kind that all of them read, so a mesh may have at most 2147483648 vertices.

use crate::mesh::PolygonMesh;
use crate::output::{WriteError, write_file};
use ply_rs_bw::ply::{
    Addable, DefaultElement, ElementDef, Encoding, Header, Property, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;
use std::io;
use std::path::Path;

/// The encodings of PLY that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlyFormat {
    /// Text that a person can read.
    Ascii,
    /// Bytes, small and exact.
    BinaryLittleEndian,
}

/// What to write for each vertex besides its position. Every slice needs one entry per vertex.
#[derive(Debug, Clone, Default)]
pub struct VertexProperties<'a> {
    /// Normals, written as `nx`, `ny` and `nz`.
    pub normals: Option<&'a [[f32; 3]]>,
    /// Named scalars.
    pub columns: Vec<Column<'a>>,
    /// Colors, written as `red`, `green` and `blue`.
    pub colors: Option<&'a [[u8; 3]]>,
}

/// A named scalar per vertex.
#[derive(Debug, Clone, Copy)]
pub struct Column<'a> {
    /// The name of the property: a letter or `_`, then letters, digits, `_` or `-`.
    pub name: &'a str,
    /// The values.
    pub values: ColumnValues<'a>,
}

/// The values of a scalar per vertex.
#[derive(Debug, Clone, Copy)]
pub enum ColumnValues<'a> {
    /// Written as `float`; what is beyond its range as its largest number.
    Float(&'a [f64]),
    /// One axis of vectors, written as `float`.
    Axis(&'a [[f32; 3]], usize),
    /// Written as `uchar`.
    Byte(&'a [u8]),
}

impl<'a> ColumnValues<'a> {
    /// The number of values.
    fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Axis(values, _) => values.len(),
            Self::Byte(values) => values.len(),
        }
    }
}

/// One property of all vertices.
struct VertexProperty<'a> {
    /// The name in the file.
    name: &'a str,
    /// The type in the file.
    scalar: ScalarType,
    /// The value at a vertex.
    value: Box<dyn Fn(usize) -> Property + 'a>,
}

/// Writes a mesh to a PLY file, which is replaced if it exists.
pub fn write_ply(
    path: &Path,
    mesh: &PolygonMesh,
    properties: &VertexProperties<'_>,
    format: PlyFormat,
) -> Result<(), WriteError> {
    check(mesh, properties).map_err(|message| WriteError::new(path, message))?;
    let vertex_properties = list_properties(mesh, properties);
    let header = describe(mesh, &vertex_properties, format);
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
        for face in mesh.faces() {
            // The check above has made sure that no index wraps around.
            let corners = face.iter().map(|&vertex| vertex as i32).collect();
            set(&mut row, "vertex_indices", Property::ListInt(corners));
            write_row(&writer, out, &row, &header, "face")?;
        }
        Ok(())
    })
}

/// Checks what would make the file unreadable.
fn check(mesh: &PolygonMesh, properties: &VertexProperties<'_>) -> Result<(), String> {
    let vertex_count = mesh.vertex_count();
    if i32::try_from(vertex_count.saturating_sub(1)).is_err() {
        return Err(format!("{vertex_count} vertices are too many for PLY"));
    }
    let mut names = vec!["x", "y", "z"];
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
    match lengths.iter().find(|(_, length)| *length != vertex_count) {
        Some((what, length)) => Err(format!("{what}: {length} values for {vertex_count} vertices")),
        None => Ok(()),
    }
}

/// Whether a text can name a property.
fn is_name(name: &str) -> bool {
    let start = |byte: u8| byte.is_ascii_alphabetic() || byte == b'_';
    name.bytes().next().is_some_and(start)
        && name.bytes().all(|byte| start(byte) || byte.is_ascii_digit() || byte == b'-')
}

/// All properties of the vertices in the order of the file.
fn list_properties<'a>(mesh: &'a PolygonMesh, properties: &VertexProperties<'a>) -> Vec<VertexProperty<'a>> {
    let mut list = Vec::new();
    let exact = mesh.positions.as_flattened().iter().all(|&x| f64::from(x as f32) == x);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        list.push(if exact {
            VertexProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |vertex| Property::Float(mesh.positions[vertex][axis] as f32)),
            }
        } else {
            VertexProperty {
                name,
                scalar: ScalarType::Double,
                value: Box::new(move |vertex| Property::Double(mesh.positions[vertex][axis])),
            }
        });
    }
    if let Some(normals) = properties.normals {
        for (axis, name) in ["nx", "ny", "nz"].into_iter().enumerate() {
            list.push(VertexProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |vertex| Property::Float(normals[vertex][axis])),
            });
        }
    }
    if let Some(colors) = properties.colors {
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            list.push(VertexProperty {
                name,
                scalar: ScalarType::UChar,
                value: Box::new(move |vertex| Property::UChar(colors[vertex][channel])),
            });
        }
    }
    for &Column { name, values } in &properties.columns {
        list.push(match values {
            ColumnValues::Float(values) => VertexProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |vertex| {
                    Property::Float(values[vertex].clamp(f32::MIN.into(), f32::MAX.into()) as f32)
                }),
            },
            ColumnValues::Axis(values, axis) => VertexProperty {
                name,
                scalar: ScalarType::Float,
                value: Box::new(move |vertex| Property::Float(values[vertex][axis])),
            },
            ColumnValues::Byte(values) => VertexProperty {
                name,
                scalar: ScalarType::UChar,
                value: Box::new(move |vertex| Property::UChar(values[vertex])),
            },
        });
    }
    list
}

/// Describes the elements and properties of the file.
fn describe(mesh: &PolygonMesh, properties: &[VertexProperty<'_>], format: PlyFormat) -> Header {
    let mut vertex = ElementDef::new("vertex".to_owned());
    vertex.count = mesh.vertex_count();
    for property in properties {
        vertex
            .properties
            .add(PropertyDef::new(property.name.to_owned(), PropertyType::Scalar(property.scalar.clone())));
    }
    let mut face = ElementDef::new("face".to_owned());
    face.count = mesh.face_count();
    // The usual byte does not count the corners of very large polygons.
    let largest = mesh.faces().map(<[u32]>::len).max().unwrap_or(0);
    let count = match u8::try_from(largest) {
        Ok(_) => ScalarType::UChar,
        Err(_) => ScalarType::UInt,
    };
    face.properties.add(PropertyDef::new("vertex_indices".to_owned(), PropertyType::List(count, ScalarType::Int)));
    let mut header = Header::new();
    header.encoding = match format {
        PlyFormat::Ascii => Encoding::Ascii,
        PlyFormat::BinaryLittleEndian => Encoding::BinaryLittleEndian,
    };
    header.elements.add(vertex);
    header.elements.add(face);
    header
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
    fn round_trip(mesh: &PolygonMesh, properties: &VertexProperties<'_>, format: PlyFormat) -> (String, PolygonMesh) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ply");
        write_ply(&path, mesh, properties, format).unwrap();
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        (text, read_mesh(&path).unwrap())
    }

    fn failure(mesh: &PolygonMesh, properties: &VertexProperties<'_>) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ply");
        let error = write_ply(&path, mesh, properties, PlyFormat::Ascii).unwrap_err();
        assert!(!path.exists());
        error.to_string()
    }

    #[test]
    fn all_properties_survive_the_round_trip() {
        let mesh = sample();
        let properties = VertexProperties {
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
    fn large_polygons_get_a_larger_count() {
        let corners = 300;
        let mesh = PolygonMesh {
            positions: vec![[0.5; 3]; corners as usize],
            offsets: vec![0, corners],
            indices: (0..corners).collect(),
        };
        for format in [PlyFormat::Ascii, PlyFormat::BinaryLittleEndian] {
            let (text, read_back) = round_trip(&mesh, &VertexProperties::default(), format);
            assert!(text.contains("property list uint int vertex_indices\n"));
            assert_eq!(read_back, mesh);
        }
    }

    #[test]
    fn unfit_properties_are_refused() {
        let mesh = sample();
        let normals = VertexProperties { normals: Some(&[[0.0; 3]; 3]), ..VertexProperties::default() };
        assert!(failure(&mesh, &normals).contains("3 values for 4 vertices"));
        for name in ["", "two words", "1st", "x", "z\nelement"] {
            let column = VertexProperties {
                columns: vec![Column { name, values: ColumnValues::Byte(&[0; 4]) }],
                ..VertexProperties::default()
            };
            assert!(failure(&mesh, &column).contains("propert"));
        }
    }
}

//! Reads Wavefront OBJ files: `v` and `f` statements, nothing else.
//!
//! All objects, groups and materials become one mesh, and vertex `i` of the file is vertex `i` of the mesh. That is
//! why no general OBJ loader is used here: those hand out one mesh per group with the vertices renumbered and the
//! unused ones gone, which cuts the surface along every group, and they cannot tell which face has a bad index.
//!
//! Relative (negative) indices, `v/vt/vn` corners, continued lines and comments behind statements are understood.
//! Texture coordinates, normals, colors, the weight of a vertex, lines, points and free-form surfaces are ignored.

use super::Fault;
use super::builder::MeshBuilder;
use super::scanner::{Scanner, parse};
use crate::mesh::PolygonMesh;
use std::io::BufRead;

/// Reads an OBJ file.
pub(super) fn read(reader: impl BufRead) -> Result<PolygonMesh, Fault> {
    let mut scanner = Scanner::new(reader);
    let mut builder = MeshBuilder::new(1);
    while scanner.next_line()? {
        let line = scanner.line_number();
        let mut words = scanner.words();
        match words.next() {
            Some("v") => {
                let position = parse_position(words).map_err(|error| scanner.fault(error))?;
                builder.add_vertex(position);
            }
            Some("f") => {
                for word in words {
                    let vertex = parse_corner(word, &builder).map_err(|error| scanner.fault(error))?;
                    builder.add_corner(vertex, Some(line))?;
                }
                builder.end_face()?;
            }
            _ => {}
        }
    }
    builder.finish()
}

/// Reads the three coordinates that start a vertex statement.
fn parse_position<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<[f64; 3], String> {
    let mut position = [0.0; 3];
    for coordinate in &mut position {
        let word = words.next().ok_or("the vertex has fewer than three coordinates")?;
        *coordinate = parse(word, "a coordinate")?;
    }
    Ok(position)
}

/// Reads the vertex number of a `v/vt/vn` corner and makes it absolute.
fn parse_corner(word: &str, builder: &MeshBuilder) -> Result<i64, String> {
    let vertex = word.split('/').next().unwrap_or_default();
    let number: i64 = parse(vertex, "a vertex number")?;
    if number >= 0 {
        return Ok(number);
    }
    // A vector's length always fits an `i64`.
    let absolute = builder.vertex_count() as i64 + 1 + number;
    if absolute < 1 {
        return Err(format!(
            "face {} (counted from 0) refers back to vertex {number}, but only {} vertices \
             precede it",
            builder.face_count(),
            builder.vertex_count(),
        ));
    }
    Ok(absolute)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> (Option<usize>, String) {
        let fault = read(text.as_bytes()).unwrap_err();
        (fault.line, fault.message)
    }

    #[test]
    fn groups_share_vertices_and_polygons_stay() {
        let text = "mtllib a.mtl\r\nv 0 0 0\r\nv 1 0 0 0.5\r\nv 1 1 0 1 0 0 # red\r\nv 0 1 0\r\n\
                    v 9 9 9\r\nv 2 0 0\r\ng left\r\nusemtl a\r\nf 1/1/1 2//2 3/3 4\r\n\
                    g right\r\nl 1 2\r\nf 2 6 \\\r\n 3\r\n";
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.positions.len(), 6);
        assert_eq!(mesh.positions[1], [1.0, 0.0, 0.0]);
        assert_eq!(mesh.offsets, [0, 4, 7]);
        assert_eq!(mesh.indices, [0, 1, 2, 3, 1, 5, 2]);
    }

    #[test]
    fn coordinates_keep_double_precision() {
        let mesh = read(&b"v 0.1234567890123456 1e-300 -7\n"[..]).unwrap();
        assert_eq!(mesh.positions, [[0.123_456_789_012_345_6, 1e-300, -7.0]]);
    }

    #[test]
    fn negative_numbers_count_back_from_the_face() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 1\n";
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.indices, [0, 1, 2, 3, 2, 0]);
    }

    #[test]
    fn a_face_may_precede_its_vertices() {
        let mesh = read(&b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"[..]).unwrap();
        assert_eq!(mesh.indices, [0, 1, 2]);
    }

    #[test]
    fn faults_name_the_line_and_the_face() {
        let (line, message) = fault("v 0 0 0\n\nv 1 2\n");
        assert_eq!(line, Some(3));
        assert!(message.contains("three coordinates"), "{message}");

        let (line, message) = fault("v 0 0 0\nf 1 1 x\n");
        assert_eq!(line, Some(2));
        assert!(message.contains("`x`"), "{message}");

        let (line, message) = fault("v 0 0 0\nf 1 1 1\nf 1 1 7\nf 1 1 1\n");
        assert_eq!(line, Some(3));
        assert!(message.contains("face 1") && message.contains("vertex 7"), "{message}");

        let (line, message) = fault("v 0 0 0\nf 1 0 1\n");
        assert_eq!(line, Some(2));
        assert!(message.contains("vertex 0"), "{message}");

        let (line, message) = fault("v 0 0 0\nf 1 1 -2\n");
        assert_eq!(line, Some(2));
        assert!(message.contains("vertex -2"), "{message}");

        let (line, _) = fault("f 1 2 99999999999999999999\n");
        assert_eq!(line, Some(1));
        let (line, _) = fault("f 1 2 -9223372036854775808\n");
        assert_eq!(line, Some(1));
    }
}

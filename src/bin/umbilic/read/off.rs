//! Reads text OFF files (Geomview's object file format).
//!
//! The OFF crates on hand read only the plain variant, need the keyword alone on its line, read single precision and
//! insist on one kind of color; files in the wild differ in all of that. This reader accepts `OFF`, `COFF`, `NOFF`
//! and the other three-dimensional variants, counts behind the keyword (even glued to it, as in a well-known data
//! set) or no keyword at all, a missing edge count, comments and any line ending. A vertex is the first three numbers
//! on a line and a face its count and indices, so that normals and colors behind them, in whatever form, are skipped.
//! Not read are binary OFF and the variants of other dimensions.

use super::Fault;
use super::builder::MeshBuilder;
use super::scanner::{Scanner, parse, shorten};
use crate::mesh::PolygonMesh;
use std::io::BufRead;

/// Reads an OFF file.
pub(super) fn read(reader: impl BufRead) -> Result<PolygonMesh, Fault> {
    let mut scanner = Scanner::new(reader);
    let (vertex_count, face_count) = read_header(&mut scanner)?;
    let mut builder = MeshBuilder::new(0);
    for vertex in 0..vertex_count {
        let missing = || format!("the file ends after {vertex} of {vertex_count} vertices");
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            *coordinate = read_number(&mut scanner, "a coordinate", missing)?;
        }
        scanner.skip_rest_of_line();
        builder.add_vertex(position);
    }
    for face in 0..face_count {
        let missing = || format!("the file ends after {face} of {face_count} faces");
        let corner_count: u64 = read_number(&mut scanner, "the size of a face", missing)?;
        for _ in 0..corner_count {
            let vertex = read_number(&mut scanner, "a vertex number", missing)?;
            builder.add_corner(vertex, Some(scanner.line_number()))?;
        }
        scanner.skip_rest_of_line();
        builder.end_face()?;
    }
    builder.finish()
}

/// Splits the keyword of an OFF file into the letters for its variant and the number that may be glued to it.
pub(super) fn split_keyword(word: &str) -> Option<(&str, &str)> {
    let (variant, number) = word.split_once("OFF")?;
    let plausible = variant.len() <= 5
        && variant.bytes().all(|byte| b"STCN4n".contains(&byte))
        && number.bytes().all(|byte| byte.is_ascii_digit());
    plausible.then_some((variant, number))
}

/// Reads the keyword and the numbers of vertices and faces.
fn read_header<R: BufRead>(scanner: &mut Scanner<R>) -> Result<(u64, u64), Fault> {
    let missing = || "the file ends before the numbers of vertices and faces".to_owned();
    let first = scanner.next_word()?.ok_or_else(|| Fault::in_file("the file is empty"))?.to_owned();
    let glued = match split_keyword(&first) {
        Some((variant, _)) if variant.contains(['4', 'n']) => {
            return Err(scanner.fault(format!("`{first}` is not three-dimensional")));
        }
        Some((_, number)) => number,
        // The keyword may be left out, and then this is the vertex count.
        None if first.bytes().all(|byte| byte.is_ascii_digit()) => &first,
        None => {
            let found = shorten(&first);
            return Err(scanner.fault(format!("expected the keyword `OFF`, found `{found}`")));
        }
    };
    let what = "the number of vertices";
    let vertex_count = if glued.is_empty() {
        read_number(scanner, what, missing)?
    } else {
        parse(glued, what).map_err(|message| scanner.fault(message))?
    };
    let face_count = read_number(scanner, "the number of faces", missing)?;
    scanner.skip_rest_of_line();
    Ok((vertex_count, face_count))
}

/// Reads the next word as a number.
fn read_number<R: BufRead, T: std::str::FromStr>(
    scanner: &mut Scanner<R>,
    what: &str,
    missing: impl Fn() -> String,
) -> Result<T, Fault> {
    let parsed = match scanner.next_word()? {
        Some("BINARY") => Err("binary OFF is not supported".to_owned()),
        Some(word) => parse(word, what),
        None => Err(missing()),
    };
    parsed.map_err(|message| scanner.fault(message))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2\n";

    fn fault(text: &str) -> (Option<usize>, String) {
        let fault = read(text.as_bytes()).unwrap_err();
        (fault.line, fault.message)
    }

    #[test]
    fn headers_in_the_wild_are_understood() {
        for header in [
            "OFF\n4 2 0\n",
            "OFF 4 2 5\n",
            "OFF4 2 0\n",
            "4 2 0\n",
            "# made by hand\r\n\r\nOFF # plain\r\n# counts\r\n4 2\r\n\r\n",
            "NOFF\n4 2 0\n",
            "STCNOFF 4 2 0\n",
        ] {
            let mesh = read(format!("{header}{BODY}").as_bytes()).unwrap();
            assert_eq!(mesh.positions.len(), 4, "{header}");
            assert_eq!(mesh.positions[2], [1.0, 1.0, 0.0], "{header}");
            assert_eq!(mesh.offsets, [0, 4, 7], "{header}");
            assert_eq!(mesh.indices, [0, 1, 2, 3, 0, 1, 2], "{header}");
        }
    }

    #[test]
    fn colors_and_normals_are_skipped() {
        let text = "CNOFF\n3 1 0\n0 0 0.25 0 0 1 255 0 0 255\n1 0 0 0 0 1 0.5 0.5 0.5\n\
                    0 1 0 0 0 1 1 1 1 1\n3 0 1 2 0.1 0.2 0.3\n";
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.positions[0], [0.0, 0.0, 0.25]);
        assert_eq!(mesh.indices, [0, 1, 2]);
    }

    #[test]
    fn a_long_face_may_be_broken_into_lines() {
        let text = "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1\n 2 3\n";
        assert_eq!(read(text.as_bytes()).unwrap().indices, [0, 1, 2, 3]);
    }

    #[test]
    fn faults_name_the_line() {
        let (line, message) = fault("OFF\n2 0 0\n0 0 0\n0 y 0\n");
        assert_eq!(line, Some(4));
        assert!(message.contains("`y`"), "{message}");

        let (line, message) = fault("OFF\n1 2 0\n0 0 0\n3 0 0 0\n3 0 0 5 1 1 1\n");
        assert_eq!(line, Some(5));
        assert!(message.contains("face 1") && message.contains("vertex 5"), "{message}");

        let (line, message) = fault("OFF\n1 1 0\n0 0 0\n3 0 -1 0\n");
        assert_eq!(line, Some(4));
        assert!(message.contains("vertex -1"), "{message}");

        let (line, message) = fault("OFF\n18446744073709551615 1 0\n0 0 0\n");
        assert_eq!(line, Some(3));
        assert!(message.contains("after 1 of 18446744073709551615 vertices"));

        let (_, message) = fault("OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n");
        assert!(message.contains("after 0 of 1 faces"), "{message}");
    }

    #[test]
    fn other_variants_are_refused() {
        assert!(fault("4OFF\n1 0 0\n").1.contains("three-dimensional"));
        assert!(fault("OFF BINARY\n").1.contains("binary"));
        assert!(fault("JUNK\n").1.contains("`JUNK`"));
        assert!(fault("").1.contains("empty"));
    }
}

//! Reads the points of a polyline from text: one point a line, two or three numbers, separated by blanks or by commas.
//!
//! Blank lines and comments that start with `#` are skipped. The first point tells the dimension.

use super::Fault;
use super::scanner::{Scanner, parse};
use std::io::BufRead;

/// The points of a polyline.
#[derive(Debug, PartialEq)]
pub enum PolylineFile {
    /// In the plane.
    Plane(Vec<[f64; 2]>),
    /// In space.
    Space(Vec<[f64; 3]>),
}

/// Reads all points.
pub(super) fn read(reader: impl BufRead) -> Result<PolylineFile, Fault> {
    let mut scanner = Scanner::new(reader);
    let mut points = None;
    while scanner.next_line()? {
        let (point, dimension) = read_point(scanner.text()).map_err(|message| scanner.fault(message))?;
        let [x, y, z] = point;
        match points.get_or_insert_with(|| match dimension {
            2 => PolylineFile::Plane(Vec::new()),
            _ => PolylineFile::Space(Vec::new()),
        }) {
            PolylineFile::Plane(points) if dimension == 2 => points.push([x, y]),
            PolylineFile::Space(points) if dimension == 3 => points.push([x, y, z]),
            _ => {
                let other = 5 - dimension;
                return Err(scanner.fault(format!("{dimension} coordinates, but the points above have {other}")));
            }
        }
    }
    points.ok_or_else(|| Fault::in_file("there is no point in it"))
}

/// The coordinates on a line, and how many there are.
fn read_point(line: &str) -> Result<([f64; 3], usize), String> {
    let (mut point, mut dimension) = ([0.0; 3], 0);
    // Between commas stands one number each, so a missing one does not go unseen.
    let words: Box<dyn Iterator<Item = &str>> = match line.contains(',') {
        true => Box::new(line.split(',').map(str::trim)),
        false => Box::new(line.split_whitespace()),
    };
    for word in words {
        let number: f64 = parse(word, "a coordinate")?;
        if !number.is_finite() {
            return Err(format!("the coordinate `{word}` is not a finite number"));
        }
        *point.get_mut(dimension).ok_or("expected two or three coordinates, found more")? = number;
        dimension += 1;
    }
    if dimension < 2 {
        Err("expected two or three coordinates, found one".to_owned())
    } else {
        Ok((point, dimension))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blanks_commas_and_comments() {
        let text = "# a triangle\n0 0\n\n1,0 # right\r\n\t.5 , 1e0\n";
        assert_eq!(read(text.as_bytes()).unwrap(), PolylineFile::Plane(vec![[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]));
        assert_eq!(read(&b"1 2 3"[..]).unwrap(), PolylineFile::Space(vec![[1.0, 2.0, 3.0]]));
    }

    #[test]
    fn faults_name_the_line() {
        for (text, line, what) in [
            ("", None, "no point"),
            ("# nothing\n", None, "no point"),
            ("0 0\n1\n", Some(2), "found one"),
            ("0 0 0 0\n", Some(1), "found more"),
            ("0 0\n\n0 0 0\n", Some(3), "3 coordinates, but the points above have 2"),
            ("0 0 0\n0 0\n", Some(2), "2 coordinates, but the points above have 3"),
            ("0 0\n1 x\n", Some(2), "`x`"),
            ("1,,2\n", Some(1), "``"),
            ("1,2 3\n", Some(1), "`2 3`"),
            ("0 nan\n", Some(1), "finite"),
            ("0 1e999\n", Some(1), "finite"),
        ] {
            let fault = read(text.as_bytes()).unwrap_err();
            assert_eq!(fault.line, line, "{text:?}");
            assert!(fault.message.contains(what), "{text:?}: {}", fault.message);
        }
    }
}

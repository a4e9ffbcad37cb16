//! Values on the command line: weights, sizes, angles, names of output files.

mod curvature;
mod scale;
mod segmenter;
mod view;

pub use curvature::{CurvatureEstimator, model_rows};
pub use scale::ColorScale;
pub use segmenter::Segmenter;
use segmenter::tolerance;
pub use view::View;

use crate::render::{LARGEST_SIDE, UpAxis};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use umbilic::{AdaptiveOptions, JetOptions, Weight};

/// How vertex normals are computed.
#[derive(Args)]
pub struct Estimator {
    /// How the faces around a vertex are weighed.
    #[arg(long, default_value = Weight::default().name(), value_parser = weight())]
    weight: Weight,
    /// With --weight jet, the degree of the polynomial, 1 to 4 [default: 3].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=4))]
    degree: Option<u8>,
    /// With --weight jet and adaptive-jet, the rings of neighbours that it is fitted to, 1 to 8 [default: 1 at degree 1, 2
    /// at degrees 2 and 3, 3 at degree 4; 3 to 6 with adaptive-jet, by the noise].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=8))]
    rings: Option<u8>,
}

impl Estimator {
    /// The weight with its options; refused where it has none.
    pub fn weight(&self) -> Result<Weight, String> {
        weight_with(self.weight, self.degree, self.rings)
    }
}

/// A weight with the options of a jet; refused where it has none.
fn weight_with(weight: Weight, degree: Option<u8>, rings: Option<u8>) -> Result<Weight, String> {
    match weight {
        Weight::Jet(_) => Ok(Weight::Jet(JetOptions { degree: degree.unwrap_or(0), rings: rings.unwrap_or(0) })),
        Weight::AdaptiveJet(options) if degree.is_none() => {
            Ok(Weight::AdaptiveJet(AdaptiveOptions { rings: rings.unwrap_or(0), ..options }))
        }
        weight if degree.is_none() && rings.is_none() => Ok(weight),
        weight => Err(format!("--degree and --rings are for --weight jet, not {}", weight.name())),
    }
}

/// A weight by its name.
fn weight() -> impl TypedValueParser<Value = Weight> {
    let names = Weight::ALL.map(|weight| PossibleValue::new(weight.name()).help(describe(weight)));
    PossibleValuesParser::new(names).try_map(|name| Weight::from_name(&name).ok_or("no such weight"))
}

fn describe(weight: Weight) -> &'static str {
    match weight {
        Weight::Conformal => "A conformal map of the ring; best on irregular smooth meshes",
        Weight::Uniform => "All faces alike",
        Weight::Angle => "The face's angle at the vertex; indifferent to how flat parts are cut up",
        Weight::Area => "The face's area",
        Weight::Max => "Max 1999; exact on spheres",
        Weight::CentroidArea => "The area over the distance to the face's centroid",
        Weight::Centroid => "One over the squared distance to the face's centroid",
        Weight::InverseRootEdges => "One over the root of the product of the two edges at the vertex",
        Weight::Sine => "The sine of the angle",
        Weight::AngleEdges => "The angle times the two edges",
        Weight::AdaptiveJet(_) => {
            "A polynomial that adapts to noise and creases of the mesh; the most accurate, dear"
        }
        Weight::TiltedSections => {
            "Max's, tilted so that sections along edges agree; the best of one ring on smooth meshes"
        }
        Weight::Jet(_) => "A polynomial fitted to several rings; best on fine smooth meshes, dear, rounds creases",
        _ => "",
    }
}

/// A finite number above zero.
fn positive(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    number.filter(|&number| number > 0.0 && number.is_finite()).ok_or_else(|| "expected a number above 0".to_owned())
}

/// The name of a PLY file to write.
pub fn ply_file(name: &str) -> Result<PathBuf, String> {
    file_of("ply", name)
}

/// The name of a PNG file to write.
pub fn png_file(name: &str) -> Result<PathBuf, String> {
    file_of("png", name)
}

/// The name of a CSV file to write.
pub fn csv_file(name: &str) -> Result<PathBuf, String> {
    file_of("csv", name)
}

/// Devices and pipes need no extension; a wrong one would promise another format.
fn file_of(extension: &str, name: &str) -> Result<PathBuf, String> {
    match Path::new(name).extension() {
        Some(found) if !found.eq_ignore_ascii_case(extension) => Err(format!(
            "the output is in the format {}, so its name must end in .{extension}",
            extension.to_uppercase()
        )),
        _ => Ok(PathBuf::from(name)),
    }
}

/// A width and a height in pixels.
fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    match sides {
        Some(sides) if sides.iter().all(|side| (1..=LARGEST_SIDE).contains(side)) => Ok(sides),
        Some(_) => Err(format!("each side must be between 1 and {LARGEST_SIDE} pixels")),
        None => Err("expected a width and a height, such as 1200x900".to_owned()),
    }
}

/// An angle in degrees.
fn angle(text: &str) -> Result<f64, String> {
    let degrees: Option<f64> = text.parse().ok();
    degrees.filter(|degrees| degrees.is_finite()).ok_or_else(|| "expected a number of degrees".to_owned())
}

/// The angle of a crease, in degrees.
pub fn crease_angle(text: &str) -> Result<f64, String> {
    let degrees = angle(text)?;
    if degrees >= 0.0 { Ok(degrees) } else { Err("expected an angle of 0 or more".to_owned()) }
}

impl ValueEnum for UpAxis {
    fn value_variants<'a>() -> &'a [Self] {
        &[UpAxis::Y, UpAxis::Z]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self {
            UpAxis::Y => PossibleValue::new("y").help("Usual for models from animation"),
            UpAxis::Z => PossibleValue::new("z").help("Usual for models from engineering and scanning"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_angles_are_checked() {
        assert_eq!(size("80x60"), Ok([80, 60]));
        for bad in ["", "80", "x", "80x", "0x60", "80x99999", "-1x5", "8x6x4"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        assert_eq!(angle("-30.5"), Ok(-30.5));
        assert!(angle("nan").is_err() && angle("inf").is_err() && angle("up").is_err());
    }

    #[test]
    fn extensions_must_tell_the_format() {
        assert!(ply_file("a.PLY").is_ok() && ply_file("/dev/null").is_ok());
        assert!(ply_file("a.obj").is_err() && png_file("a.ply").is_err() && csv_file("a.txt").is_err());
    }
}

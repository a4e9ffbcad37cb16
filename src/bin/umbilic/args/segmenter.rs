//! How meshes are cut into segments, as options on the command line.

use super::{CurvatureEstimator, crease_angle};
use crate::segments::Way;
use crate::table::number;
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use serde_json::Value;
use umbilic::{Creases, CurvatureKind, DEFAULT_CREASE_ANGLE, RegionOptions};

/// [`DEFAULT_CREASE_ANGLE`] in degrees.
const CREASE_ANGLE: f64 = 30.0;

/// How a mesh is cut. Nothing that is given goes unused: what a way of cutting does not have is refused.
#[derive(Args)]
pub struct Segmenter {
    /// What tells segments apart.
    #[arg(long, value_enum, default_value = "features")]
    by: By,
    /// By features and regions: faces whose normals differ by more than this, in degrees, are not joined [default: 30].
    #[arg(long, visible_alias = "angle", value_name = "DEGREES", value_parser = crease_angle)]
    crease_angle: Option<f64>,
    /// By watershed: basins of curvedness that are less deep than this, in 1/length, are merged [default: 4 by the diagonal
    /// of the bounding box].
    #[arg(long, value_name = "X", value_parser = depth)]
    depth: Option<f64>,
    /// By regions: curvatures of up to this, in 1/length, count as none [default: 2 by the diagonal of the bounding box].
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
    /// By regions: those of less than this share of the whole area, 0 to 1, become part of a neighbour [default: 0.0005].
    #[arg(long, value_name = "X", value_parser = share)]
    smallest_share: Option<f64>,
    /// By regions: those of fewer faces become part of a neighbour [default: 0].
    #[arg(long, value_name = "N")]
    smallest_faces: Option<usize>,
}

/// What tells segments apart.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Features,
    Watershed,
    Regions,
}

impl By {
    fn name(self) -> &'static str {
        match self {
            By::Features => "features",
            By::Watershed => "watershed",
            By::Regions => "regions",
        }
    }
}

impl ValueEnum for By {
    fn value_variants<'a>() -> &'a [Self] {
        &[By::Features, By::Watershed, By::Regions]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()).help(match self {
            By::Features => "Sharp edges; for what machines make",
            By::Watershed => {
                "Valleys of curvedness, up to where it is highest between them; for what has rounded edges"
            }
            By::Regions => "Classes of shape, flat, convex, concave or saddle, and sharp edges; for what has fillets",
        }))
    }
}

impl Segmenter {
    /// The way of cutting, with curvatures by these options where it goes by them.
    pub fn way(&self, estimator: &CurvatureEstimator) -> Result<Way<'static>, String> {
        for (name, given, ways) in [
            ("--crease-angle", self.crease_angle.is_some(), &[By::Features, By::Regions][..]),
            ("--depth", self.depth.is_some(), &[By::Watershed]),
            ("--tolerance", self.tolerance.is_some(), &[By::Regions]),
            ("--smallest-share", self.smallest_share.is_some(), &[By::Regions]),
            ("--smallest-faces", self.smallest_faces.is_some(), &[By::Regions]),
        ] {
            if given && !ways.contains(&self.by) {
                return Err(format!("{name} is nothing that --by {} has", self.by.name()));
            }
        }
        if self.by == By::Features {
            estimator.refuse("segments by features")?;
            return Ok(Way::Features { angle: self.angle() });
        }
        estimator.check_kind(CurvatureKind::Principal, &format!("--by {}", self.by.name()))?;
        let curvature = estimator.options()?;
        Ok(if self.by == By::Watershed {
            Way::Watershed { depth: self.depth, curvature }
        } else {
            Way::Regions { tolerance: self.tolerance, options: self.region_options(), curvature }
        })
    }

    /// The crease angle in radians.
    pub fn angle(&self) -> f64 {
        self.crease_angle.map_or(DEFAULT_CREASE_ANGLE, f64::to_radians)
    }

    /// What the options are: a key, words, the value in words and as such. `limit` is the depth or the tolerance that was taken.
    pub fn rows(&self, limit: Option<f64>) -> Vec<(&'static str, &'static str, String, Value)> {
        let mut rows = vec![("by", "by", self.by.name().to_owned(), self.by.name().into())];
        if self.by != By::Watershed {
            let degrees = self.crease_angle.unwrap_or(CREASE_ANGLE);
            rows.push(("crease_angle", "crease angle", format!("{degrees}°"), degrees.into()));
        }
        if let Some(limit) = limit {
            let name = if self.by == By::Watershed { "depth" } else { "tolerance" };
            rows.push((name, name, number(limit), limit.into()));
        }
        if self.by == By::Regions {
            let RegionOptions { smallest_share, smallest_faces, .. } = self.region_options();
            rows.push(("smallest_share", "smallest share", number(smallest_share), smallest_share.into()));
            rows.push(("smallest_faces", "smallest faces", smallest_faces.to_string(), smallest_faces.into()));
        }
        rows
    }

    fn region_options(&self) -> RegionOptions<'static> {
        let default = RegionOptions::default();
        RegionOptions {
            creases: Creases { angle: self.angle(), ..Creases::default() },
            smallest_faces: self.smallest_faces.unwrap_or(default.smallest_faces),
            smallest_share: self.smallest_share.unwrap_or(default.smallest_share),
        }
    }
}

/// A number of 0 or more, or infinity.
fn depth(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    number.filter(|&number| number >= 0.0).ok_or_else(|| "expected a number of 0 or more, or inf".to_owned())
}

/// A finite number of 0 or more.
pub fn tolerance(text: &str) -> Result<f64, String> {
    depth(text).ok().filter(|number| number.is_finite()).ok_or_else(|| "expected a number of 0 or more".to_owned())
}

/// A part of a whole.
fn share(text: &str) -> Result<f64, String> {
    depth(text).ok().filter(|&number| number <= 1.0).ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_angle_is_that_of_the_library() {
        assert!((CREASE_ANGLE.to_radians() - DEFAULT_CREASE_ANGLE).abs() < 1e-15);
    }

    #[test]
    fn numbers_are_within_their_bounds() {
        assert_eq!((depth("inf"), tolerance("0"), share("1")), (Ok(f64::INFINITY), Ok(0.0), Ok(1.0)));
        assert!(["", "-1", "nan", "deep"].into_iter().all(|bad| depth(bad).is_err() && share(bad).is_err()));
        assert!(tolerance("inf").is_err() && share("1.01").is_err());
    }
}

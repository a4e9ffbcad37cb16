//! Which numbers get which colors, as options on the command line.

use super::{png_file, positive, tolerance};
use crate::coloring::{Coloring, Subject};
use crate::compute::{self, VertexCurvatures};
use crate::mesh::PolygonMesh;
use crate::quantity::Quantity;
use crate::scale::{PERCENTILE, Scale};
use clap::Args;
use std::path::PathBuf;
use umbilic::{Error, Points, shape_tolerance};

/// Which numbers get which colors.
#[derive(Args)]
#[command(next_help_heading = "Options of colors")]
pub struct ColorScale {
    /// The numbers that get the colors of the two ends; 0 is nearly white wherever it is between them [default: from
    /// -P to P, from 0 to P for curvedness, from -1 to 1 for the shape index].
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true, value_parser = range)]
    range: Option<[f64; 2]>,
    /// The part of the vertices, in percent, whose absolute value is at most P, where no range is given
    /// [default: 95].
    #[arg(long, value_name = "PERCENT", conflicts_with = "range", value_parser = percentile)]
    percentile: Option<f64>,
    /// Draw the colors with their numbers into this PNG file.
    #[arg(long, value_name = "BAR.png", value_parser = png_file)]
    pub colorbar: Option<PathBuf>,
    /// With --color shape, curvatures of up to this, in 1/length, count as none [default: 1 by the diagonal of the bounding
    /// box].
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
}

impl ColorScale {
    /// Refuses all of this where nothing gets colors.
    pub fn refuse(&self) -> Result<(), String> {
        self.refuse_range()?;
        self.refuse_tolerance()
    }

    /// Refuses what the colors of a subject do not have.
    pub fn check(&self, subject: Subject) -> Result<(), String> {
        match subject {
            Subject::Quantity(_) => self.refuse_tolerance(),
            Subject::Shape => self.refuse_range(),
        }
    }

    fn refuse_range(&self) -> Result<(), String> {
        match self.range.is_some() || self.percentile.is_some() || self.colorbar.is_some() {
            true => Err("--range, --percentile and --colorbar are for colors of curvatures".to_owned()),
            false => Ok(()),
        }
    }

    fn refuse_tolerance(&self) -> Result<(), String> {
        if self.tolerance.is_some() { Err("--tolerance is for --color shape".to_owned()) } else { Ok(()) }
    }

    /// The colors of a subject that the method has.
    pub fn coloring(
        &self,
        subject: Subject,
        mesh: &PolygonMesh,
        found: &VertexCurvatures,
    ) -> Result<Coloring, Error> {
        match subject {
            Subject::Quantity(quantity) => Ok(Coloring::Scale(quantity, self.scale(quantity, mesh, found))),
            Subject::Shape => {
                let tolerance = match self.tolerance {
                    Some(tolerance) => tolerance,
                    None => shape_tolerance(&Points::from(&mesh.positions))?,
                };
                Ok(Coloring::Shape { classes: compute::shape_classes(mesh, found, tolerance)?, tolerance })
            }
        }
    }

    /// The scale for a quantity that the method has.
    fn scale(&self, quantity: Quantity, mesh: &PolygonMesh, found: &VertexCurvatures) -> Scale {
        /// Curvatures smaller than this by the size of the mesh are rounding errors.
        const ROUNDING: f64 = 1e-9;
        if let Some([low, high]) = self.range {
            return Scale { low, high };
        }
        let size = mesh
            .bounding_box()
            .map_or(0.0, |(low, high)| (0..3).map(|axis| (high[axis] - low[axis]).abs()).fold(0.0, f64::max));
        let rounding = if size > 0.0 { ROUNDING * size.powi(quantity.power()) } else { 0.0 };
        let values = found.results(quantity).into_iter().flatten();
        Scale::of(quantity, values, self.percentile.unwrap_or(PERCENTILE), rounding)
    }
}

/// Two ascending numbers.
fn range(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    match text.split_once(',').and_then(|(low, high)| Some([number(low)?, number(high)?])) {
        Some([low, high]) if low < high => Ok([low, high]),
        Some(_) => Err("the first number must be below the second".to_owned()),
        None => Err("expected two numbers, such as -1.5,1.5".to_owned()),
    }
}

/// A number of percent.
fn percentile(text: &str) -> Result<f64, String> {
    positive(text).ok().filter(|&percent| percent <= 100.0).ok_or_else(|| "expected above 0 and up to 100".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_ascend_and_percentiles_are_parts() {
        assert_eq!(range("-1.5, 2e3"), Ok([-1.5, 2000.0]));
        assert!(["", "1", "1,", "2,1", "1,1", "nan,1", "0,inf"].into_iter().all(|bad| range(bad).is_err()));
        assert_eq!(percentile("100"), Ok(100.0));
        assert!(["0", "-1", "101", "many", "nan"].into_iter().all(|bad| percentile(bad).is_err()));
    }
}

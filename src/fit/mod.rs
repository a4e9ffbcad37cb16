//! Surfaces fitted to neighbourhoods: osculating jets, and the least squares under them.

mod adaptive_jet;
mod adaptive_model;
mod axes;
mod cholesky;
mod heights;
mod jet;
mod learning;
mod least_squares;
mod moments;
mod normal_equations;
mod ridge;
mod sample;
mod surface;
mod surroundings;
mod tilted_sections;

pub(crate) use adaptive_jet::{AdaptiveFit, AdaptiveJet};
pub use adaptive_model::{AdaptiveModel, Coordinates};
pub(crate) use axes::Axes;
pub(crate) use jet::Jet;
pub(crate) use learning::learn;
pub(crate) use least_squares::{condition, solve};
pub(crate) use surroundings::Surroundings;
pub(crate) use tilted_sections::TiltedSums;

use crate::error::Error;
use crate::sweep::MOST_RINGS;
use jet::coefficients;
use moments::ROWS;

/// How a jet is fitted. Zeros, the default, stand for the values that are said here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct JetOptions {
    /// The degree of the polynomial, 1 to 4; 0 for 3.
    pub degree: u8,
    /// The rings of neighbours that it is fitted to, at most 8; 0 for 1 at degree 1, 2 at degrees 2 and 3, 3 at degree 4.
    pub rings: u8,
}

/// The largest degree of a jet.
pub(crate) const MOST_DEGREE: u8 = 4;

/// What a jet estimator works with, and what becomes of vertices where it fails: one place for all that use jets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JetFit {
    degree: usize,
    rings: usize,
}

impl JetFit {
    /// # Errors
    /// [`Error::OptionOutOfRange`] for a degree or a number of rings beyond what [`JetOptions`] says.
    pub(crate) fn new(options: JetOptions) -> Result<Self, Error> {
        for (what, value, most) in
            [("options.degree", options.degree, MOST_DEGREE), ("options.rings", options.rings, MOST_RINGS as u8)]
        {
            if value > most {
                return Err(Error::OptionOutOfRange { what });
            }
        }
        let degree = if options.degree == 0 { 3 } else { options.degree as usize };
        let rings = match (options.rings, degree) {
            (0, 1) => 1,
            (0, 2 | 3) => 2,
            (0, _) => 3,
            (rings, _) => rings as usize,
        };
        Ok(JetFit { degree, rings })
    }

    /// The rings that were asked for.
    pub(crate) fn rings(&self) -> usize {
        self.rings
    }

    /// The fewest neighbours: with the vertex itself one point more than coefficients.
    pub(crate) fn least(&self) -> usize {
        coefficients(self.degree)
    }

    /// Rows of scratch for a patch of so many points.
    pub(crate) fn scratch(&self, points: usize) -> usize {
        let coefficients = coefficients(self.degree);
        3 * points.next_multiple_of(ROWS) + (coefficients + 1) * (points + 1).max(coefficients)
    }
}

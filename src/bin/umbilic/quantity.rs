//! The curvatures that can be shown as colors.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use umbilic::CurvatureKind;

/// A scalar at each vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The larger principal curvature.
    K1,
    /// The smaller principal curvature.
    K2,
    /// Mean curvature.
    Mean,
    /// Gaussian curvature.
    Gaussian,
    /// Koenderink's shape index.
    ShapeIndex,
    /// Koenderink's curvedness.
    Curvedness,
}

impl Quantity {
    /// Every quantity.
    pub const ALL: [Quantity; 6] =
        [Quantity::K1, Quantity::K2, Quantity::Mean, Quantity::Gaussian, Quantity::ShapeIndex, Quantity::Curvedness];

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::K1 => "k1",
            Quantity::K2 => "k2",
            Quantity::Mean => "mean",
            Quantity::Gaussian => "gaussian",
            Quantity::ShapeIndex => "shape_index",
            Quantity::Curvedness => "curvedness",
        }
    }

    /// The kind of output that has it.
    pub fn kind(self) -> CurvatureKind {
        match self {
            Quantity::Mean => CurvatureKind::Mean,
            Quantity::Gaussian => CurvatureKind::Gaussian,
            Quantity::K1 | Quantity::K2 | Quantity::ShapeIndex | Quantity::Curvedness => CurvatureKind::Principal,
        }
    }

    /// The power of length in its unit.
    pub fn power(self) -> i32 {
        match self {
            Quantity::ShapeIndex => 0,
            Quantity::Gaussian => -2,
            Quantity::K1 | Quantity::K2 | Quantity::Mean | Quantity::Curvedness => -1,
        }
    }
}

impl ValueEnum for Quantity {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self {
            Quantity::K1 => PossibleValue::new("k1").help("The larger principal curvature, 1/length"),
            Quantity::K2 => PossibleValue::new("k2").help("The smaller principal curvature, 1/length"),
            Quantity::Mean => PossibleValue::new("mean").help("Mean curvature, (k1 + k2) / 2, 1/length"),
            Quantity::Gaussian => PossibleValue::new("gaussian").help("Gaussian curvature, k1 k2, 1/length²"),
            Quantity::ShapeIndex => PossibleValue::new("shape-index")
                .help("1 cap, 0.5 ridge, 0 saddle or plane, -0.5 rut, -1 cup; no unit"),
            Quantity::Curvedness => {
                PossibleValue::new("curvedness").help("How strongly it bends, √((k1² + k2²) / 2), 1/length")
            }
        })
    }
}

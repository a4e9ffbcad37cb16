//! Vertex and face normals.

mod adaptive_jet;
mod conformal;
mod face;
mod jet;
mod sum;
mod surroundings;
mod tilted_sections;
mod vertex;
mod weights;

pub use adaptive_jet::{AdaptiveOptions, learn_model};
pub(crate) use adaptive_jet::{Sink, adaptive_jets};
pub use face::{FaceOutputs, face_normals};
pub use vertex::{NormalOutputs, vertex_normals, vertex_normals_from_faces};
pub(crate) use vertex::{is_one_ring, reference_normals, with_vertex_normals};

use crate::fit::JetOptions;

/// How a vertex normal comes about: how it weighs the faces, or the edges, around the vertex, or what it fits.
///
/// `Nᵢ` is the unit normal of face `i` at the vertex, `θᵢ` its interior angle there, `a` and `b` the lengths of its two
/// edges there, `|fᵢ|` its area, `g` the distance to its centroid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Weight {
    /// N_CM, the conformal map with mean value coordinates: a combination of edge normals `unit(Nᵢ₋₁ + Nᵢ)`, weighted
    /// `(tan(αᵢ₋₁/2) + tan(αᵢ/2)) / a` with angles `α` that fill the full circle. The best of the one-ring averages on
    /// irregular smooth meshes.
    #[default]
    Conformal,
    /// N_G (Gouraud 1971): 1.
    Uniform,
    /// N_T (Thürmer & Wüthrich 1998): `θᵢ`. Does not depend on how a flat face is cut up.
    Angle,
    /// N_M: `|fᵢ|`.
    Area,
    /// Max 1999: `sin θᵢ / (a b)`. Exact where the vertex and its neighbours lie on a sphere.
    Max,
    /// N_C as the paper prints it: `|fᵢ| / g`.
    CentroidArea,
    /// N_C (Chen & Wu 2004), as the paper's tables use it: `1 / g²`.
    Centroid,
    /// Jin, Lewis & West 2005: `1 / √(a b)`.
    InverseRootEdges,
    /// `sin θᵢ`
    Sine,
    /// `θᵢ a b`
    AngleEdges,
    /// No average: the normal of an osculating jet (Cazals & Pouget 2005), a polynomial height field fitted to several rings.
    /// On smooth surfaces of a higher order than any average, and twenty to forty times as expensive. The area-weighted
    /// normal says to which side it points.
    Jet(JetOptions),
    /// No average: the normal of an adaptive jet, a polynomial height field of degree 4 over three to six rings, whose weights and
    /// prior follow from the noise and the smoothness that the mesh itself shows. The most accurate normals of this library, on
    /// clean, noisy and creased meshes alike, at three to five times the cost of the default [`Weight::Jet`]. On creases the mean direction of their sides.
    AdaptiveJet(AdaptiveOptions),
    /// Max's normal, tilted so that the sections along the edges of the ring agree best with one shape operator. Exact where the
    /// vertex and its neighbours lie on a sphere; the most accurate normal of one ring on smooth surfaces with little noise.
    TiltedSections,
}

impl Weight {
    /// Every weight; jets with their default options.
    pub const ALL: [Weight; 13] = [
        Weight::Conformal,
        Weight::Uniform,
        Weight::Angle,
        Weight::Area,
        Weight::Max,
        Weight::CentroidArea,
        Weight::Centroid,
        Weight::InverseRootEdges,
        Weight::Sine,
        Weight::AngleEdges,
        Weight::Jet(JetOptions { degree: 0, rings: 0 }),
        Weight::AdaptiveJet(AdaptiveOptions { rings: 0, model: None }),
        Weight::TiltedSections,
    ];

    /// A name in lower case with dashes, for command lines and files; it says nothing of options.
    pub fn name(self) -> &'static str {
        match self {
            Weight::Conformal => "conformal",
            Weight::Uniform => "uniform",
            Weight::Angle => "angle",
            Weight::Area => "area",
            Weight::Max => "max",
            Weight::CentroidArea => "centroid-area",
            Weight::Centroid => "centroid",
            Weight::InverseRootEdges => "inverse-root-edges",
            Weight::Sine => "sine",
            Weight::AngleEdges => "angle-edges",
            Weight::Jet(_) => "jet",
            Weight::AdaptiveJet(_) => "adaptive-jet",
            Weight::TiltedSections => "tilted-sections",
        }
    }

    /// The weight of that [`Weight::name`], with default options.
    pub fn from_name(name: &str) -> Option<Weight> {
        Self::ALL.into_iter().find(|weight| weight.name() == name)
    }
}

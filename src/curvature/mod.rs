//! Curvatures of polylines and of polygon meshes.

mod adaptive_jet;
mod angle_defect;
mod corrected_measure;
mod direction_section;
mod edge_section;
mod goldfeather;
mod jet;
mod measure;
mod meyer;
mod normal_cycle;
mod one_ring;
mod outputs;
mod patch;
mod polyline;
mod principal;
mod quadric;
mod ring;
mod rusinkiewicz;
mod section;
mod shape_operator;
mod taubin;
mod tilted_sections;
mod vertex;
mod watanabe;

pub use direction_section::{Directions, direction_sections};
pub use edge_section::{SectionOutputs, edge_sections};
pub use outputs::{CurvatureKind, CurvatureOutputs};
pub use polyline::{PolylineOutputs, polyline_curvatures, polyline_status};
pub use vertex::{CurvatureOptions, VertexNormals, curvatures};

use outputs::Kinds;

/// Bits of a section's status byte. 0 is a section with a surface on both sides of the vertex, or along an edge.
pub mod section_status {
    /// The normal plane meets the ring on one side of the vertex only; its mirror image stands in for the other.
    pub const ONE_SIDED: u8 = 1;
    /// There is no section; its curvature is 0.
    pub const NONE: u8 = 2;
}

/// How curvatures are estimated.
///
/// | method | values, directions | `H`, `K` | areas, integrals | residual, condition |
/// |---|---|---|---|---|
/// | [`AdaptiveJet`](Method::AdaptiveJet) | both | both | | residual, degrees of freedom |
/// | [`Jet`](Method::Jet), [`Quadric`](Method::Quadric), [`Goldfeather`](Method::Goldfeather) | both | both | | both |
/// | [`LeastSquares`](Method::LeastSquares), [`Taubin`](Method::Taubin) | both | both | | residual (least squares) |
/// | [`Watanabe`](Method::Watanabe) | values | both | | |
/// | [`Meyer`](Method::Meyer) | values | both | all | |
/// | [`AngleDefect`](Method::AngleDefect) | | `K` | area, integral of `K` | |
/// | [`TiltedSections`](Method::TiltedSections), [`Rusinkiewicz`](Method::Rusinkiewicz) | both | both | | |
/// | [`NormalCycle`](Method::NormalCycle) | both | both | area, integral of `H` | |
/// | [`CorrectedMeasure`](Method::CorrectedMeasure) | both | both | all | |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// Adaptive jets: a polynomial height field of degree 4 over three to six rings, whose weights and prior follow from the noise and
    /// the smoothness that the mesh itself shows (see [`AdaptiveModel`](crate::AdaptiveModel)). Its own normal is an output as
    /// well. The most accurate curvatures of this library, on clean, noisy and creased meshes alike.
    #[default]
    AdaptiveJet,
    /// Osculating jets (Cazals & Pouget 2005): a polynomial height field of degree 2 to 4 over several rings, whose own
    /// normal is an output as well. Converges on meshes of any kind, at order `degree − 1`.
    Jet,
    /// A quadratic height field in the frame of a vertex normal, over one ring or more.
    Quadric,
    /// Goldfeather & Interrante 2004: a cubic height field fitted to positions and normals of neighbours.
    Goldfeather,
    /// The sections along all edges, with a tilt of Max's normal: its own normal is an output as well. Exact on spheres; the most
    /// accurate curvature of one ring on smooth surfaces with little noise.
    TiltedSections,
    /// The shape operator that fits the curvatures of the sections along all edges best (least squares). Exact on spheres
    /// with [`Section::Circle`] and exact normals.
    LeastSquares,
    /// Taubin 1995: the eigenvalues of an integral of sectional curvatures, weighted by area.
    Taubin,
    /// Watanabe & Belyaev 2001: `H` and `K` from the means of sectional curvature and of its square.
    Watanabe,
    /// Meyer et al. 2003: the mean curvature normal by cotangents, `K` by the angle defect, over mixed Voronoi areas.
    Meyer,
    /// The angle defect `2π − Σθ` of Gauss and Bonnet (`π − Σθ` at a boundary), and that by the mixed area.
    AngleDefect,
    /// Rusinkiewicz 2004: shape operators of faces from differences of vertex normals, averaged.
    Rusinkiewicz,
    /// The normal cycle (Cohen-Steiner & Morvan 2003): dihedral angles along edges, by area.
    NormalCycle,
    /// Interpolated corrected curvature measures (Lachaud, Romon & Thibert 2020).
    CorrectedMeasure,
}

impl Method {
    /// Every method.
    pub const ALL: [Method; 13] = [
        Method::AdaptiveJet,
        Method::Jet,
        Method::Quadric,
        Method::Goldfeather,
        Method::TiltedSections,
        Method::LeastSquares,
        Method::Taubin,
        Method::Watanabe,
        Method::Meyer,
        Method::AngleDefect,
        Method::Rusinkiewicz,
        Method::NormalCycle,
        Method::CorrectedMeasure,
    ];

    /// A name in lower case with dashes, for command lines and files.
    pub fn name(self) -> &'static str {
        match self {
            Method::AdaptiveJet => "adaptive-jet",
            Method::Jet => "jet",
            Method::Quadric => "quadric",
            Method::Goldfeather => "goldfeather",
            Method::TiltedSections => "tilted-sections",
            Method::LeastSquares => "least-squares",
            Method::Taubin => "taubin",
            Method::Watanabe => "watanabe",
            Method::Meyer => "meyer",
            Method::AngleDefect => "angle-defect",
            Method::Rusinkiewicz => "rusinkiewicz",
            Method::NormalCycle => "normal-cycle",
            Method::CorrectedMeasure => "corrected-measure",
        }
    }

    /// The method of that [`Method::name`].
    pub fn from_name(name: &str) -> Option<Method> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// Whether the method has outputs of a kind; the others it refuses.
    pub fn has(self, kind: CurvatureKind) -> bool {
        self.provides().has(kind.into())
    }

    /// Whether the method works with sections along edges, so that [`CurvatureOptions::section`] counts.
    pub fn has_sections(self) -> bool {
        matches!(self, Method::LeastSquares | Method::Taubin | Method::Watanabe)
    }

    /// What the method has to give.
    pub(crate) fn provides(self) -> Kinds {
        let values = Kinds::PRINCIPAL.and(Kinds::MEAN).and(Kinds::GAUSSIAN);
        let all = values.and(Kinds::DIRECTIONS);
        match self {
            Method::Jet | Method::Quadric | Method::Goldfeather => all.and(Kinds::RESIDUAL).and(Kinds::CONDITION),
            Method::AdaptiveJet => all.and(Kinds::RESIDUAL).and(Kinds::FREEDOM),
            Method::LeastSquares => all.and(Kinds::RESIDUAL),
            Method::TiltedSections | Method::Taubin | Method::Rusinkiewicz => all,
            Method::Watanabe => values,
            Method::Meyer => values.and(Kinds::AREA).and(Kinds::INTEGRATED_MEAN).and(Kinds::INTEGRATED_GAUSSIAN),
            Method::AngleDefect => Kinds::GAUSSIAN.and(Kinds::AREA).and(Kinds::INTEGRATED_GAUSSIAN),
            Method::NormalCycle => all.and(Kinds::AREA).and(Kinds::INTEGRATED_MEAN),
            Method::CorrectedMeasure => {
                all.and(Kinds::AREA).and(Kinds::INTEGRATED_MEAN).and(Kinds::INTEGRATED_GAUSSIAN)
            }
        }
    }
}

/// How the curvature of a curve is taken from three of its points, or of a section from an edge and a normal.
///
/// `a` and `c` are the edges from the point to its two neighbours, `φ` is the angle between them, `d = |c − a|` the
/// distance of the neighbours from each other. On evenly spaced points the three parabolas agree. As the points of a
/// smooth curve get closer, all tend to its curvature, but [`Section::Parabola`] only if they are evenly spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Section {
    /// κ_C, of the circle through the three points: `2 sin φ / d`. At most `2 / max(|a|, |c|)`, however sharp the corner.
    Circle,
    /// κ_P, of the parabola that passes the three points at the parameters 0, ½ and 1: `8 |a| |c| sin φ / d³`.
    Parabola,
    /// κ_P with the parameter in proportion to the lengths `|a|`, `|c|`: `2 (|a| + |c|)² sin φ / d³`.
    LengthParabola,
    /// κ_SP, of a parabola symmetric about the bisector: `4 cos(φ/2) / ((|a| + |c|) sin²(φ/2))`. It grows without bound
    /// as the corner sharpens.
    #[default]
    SymmetricParabola,
}

impl Section {
    /// Every section.
    pub const ALL: [Section; 4] =
        [Section::Circle, Section::Parabola, Section::LengthParabola, Section::SymmetricParabola];

    /// A name in lower case with dashes, for command lines and files.
    pub fn name(self) -> &'static str {
        match self {
            Section::Circle => "circle",
            Section::Parabola => "parabola",
            Section::LengthParabola => "length-parabola",
            Section::SymmetricParabola => "symmetric-parabola",
        }
    }

    /// The section of that [`Section::name`], or of the paper's letters for it: `c`, `p`, `pl`, `sp`.
    pub fn from_name(name: &str) -> Option<Section> {
        match name {
            "c" => Some(Section::Circle),
            "p" => Some(Section::Parabola),
            "pl" => Some(Section::LengthParabola),
            "sp" => Some(Section::SymmetricParabola),
            name => Self::ALL.into_iter().find(|section| section.name() == name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_say_what_they_have() {
        assert!(CurvatureKind::ALL.into_iter().filter(|&kind| Method::Jet.has(kind)).eq([
            CurvatureKind::Principal,
            CurvatureKind::Directions,
            CurvatureKind::Mean,
            CurvatureKind::Gaussian,
            CurvatureKind::Residual,
            CurvatureKind::Condition,
        ]));
        assert!(CurvatureKind::ALL.into_iter().filter(|&kind| Method::AngleDefect.has(kind)).eq([
            CurvatureKind::Gaussian,
            CurvatureKind::Area,
            CurvatureKind::IntegratedGaussian,
        ]));
    }

    #[test]
    fn names_lead_back() {
        for (section, letters) in Section::ALL.into_iter().zip(["c", "p", "pl", "sp"]) {
            assert_eq!(Section::from_name(section.name()), Some(section));
            assert_eq!(Section::from_name(letters), Some(section));
        }
        assert_eq!(Section::from_name("Circle"), None);
        assert_eq!(Section::default(), Section::SymmetricParabola);
    }
}

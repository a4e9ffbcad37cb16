//! Curvatures of polylines and of polygon meshes.

mod angle_defect;
mod corrected_measure;
mod measure;
mod meyer;
mod normal_cycle;
mod outputs;
mod principal;
mod ring;
mod rusinkiewicz;
mod section;
mod shape_operator;
mod taubin;
mod vertex;
mod watanabe;

pub use outputs::CurvatureOutputs;
pub use section::Section;
pub use vertex::{CurvatureOptions, VertexNormals, curvatures};

use outputs::Kinds;

/// How curvatures are estimated.
///
/// | method | values, directions | `H`, `K` | areas, integrals | residual, condition |
/// |---|---|---|---|---|
/// | [`LeastSquares`](Method::LeastSquares), [`Taubin`](Method::Taubin) | both | both | | residual (least squares) |
/// | [`Watanabe`](Method::Watanabe) | values | both | | |
/// | [`Meyer`](Method::Meyer) | values | both | all | |
/// | [`AngleDefect`](Method::AngleDefect) | | `K` | area, integral of `K` | |
/// | [`Rusinkiewicz`](Method::Rusinkiewicz) | both | both | | |
/// | [`NormalCycle`](Method::NormalCycle) | both | both | area, integral of `H` | |
/// | [`CorrectedMeasure`](Method::CorrectedMeasure) | both | both | all | |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// The shape operator that fits the curvatures of the sections along all edges best (least squares). Exact on spheres
    /// with [`Section::Circle`] and exact normals.
    #[default]
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
    pub const ALL: [Method; 8] = [
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

    /// What the method has to give.
    pub(crate) fn provides(self) -> Kinds {
        let values = Kinds::PRINCIPAL.and(Kinds::MEAN).and(Kinds::GAUSSIAN);
        let all = values.and(Kinds::DIRECTIONS);
        match self {
            Method::LeastSquares => all.and(Kinds::RESIDUAL),
            Method::Taubin | Method::Rusinkiewicz => all,
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

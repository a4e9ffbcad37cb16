//! The vertices whose results change as others move: what a caller computes anew, as [`Run::vertices`](crate::Run::vertices), to keep normals or
//! curvatures up to date.
//!
//! A result depends on the positions within so many rings of its vertex (vertices that share a face are neighbours), and on no others. How
//! many follows from weight, method and options: one for averages over one ring, those of the fit for jets, one more for what takes the
//! normals of neighbours. So the vertices within as many rings of those that moved are all that can have changed, and a call for their list
//! gives what a call for all would, to the bit.
//!
//! Fits widen their neighbourhood by up to four rings where points are too few or in special position. Around a vertex that none of
//! the moved ones is near, that is as it was: its last status says whether its neighbourhood was widened. Without statuses every
//! vertex is taken for one whose was.
//!
//! Adaptive jets depend on all positions through what they learn, unless they are given a model. Regions by radius depend on which
//! vertices are near, before and after: for them there is no list.
//!
//! Cost: the rings of what is found; a byte a vertex of the mesh, of which only pages are touched where something is found.

use crate::curvature::{CurvatureOptions, Method, VertexNormals};
use crate::error::Error;
use crate::fit::{JetFit, JetOptions};
use crate::normals::{AdaptiveOptions, Weight};
use crate::sweep::{MOST_EXTRA_RINGS, MOST_RINGS};
use crate::topology::{Topology, closure_by_rings, status};
use crate::view::{Bytes, Indices};

/// How far the result of a vertex reaches.
#[derive(Clone, Copy)]
struct Reach {
    /// The rings that it always depends on.
    rings: usize,
    /// How many more it depends on if its neighbourhood was widened.
    widened: usize,
}

/// The vertices whose normals by this weight may change as those in `moved` move, these among them: each once, breadth first.
///
/// `statuses` are those of the normals as they were, `#V`, if there are any: they make the list of [`Weight::Jet`] shorter.
///
/// # Errors
/// [`Error::IndexOutOfRange`] for a vertex that is none; [`Error::Size`] for another number of statuses than vertices;
/// [`Error::NotApplicable`] for adaptive jets without a model; [`Error::OptionOutOfRange`]; [`Error::OutOfMemory`].
pub fn affected_normals(
    topology: &Topology,
    moved: &[u32],
    weight: Weight,
    statuses: Option<&Bytes<'_>>,
) -> Result<Vec<u32>, Error> {
    within(topology, moved, statuses, of_weight(weight)?)
}

/// The vertices whose curvatures by these options may change as those in `moved` move, or the normals given for them; else as
/// [`affected_normals`].
///
/// # Errors
/// As [`affected_normals`]; [`Error::NotApplicable`] also for regions by radius.
pub fn affected_curvatures(
    topology: &Topology,
    moved: &[u32],
    options: &CurvatureOptions<'_>,
    statuses: Option<&Bytes<'_>>,
) -> Result<Vec<u32>, Error> {
    within(topology, moved, statuses, of_method(options)?)
}

fn within(
    topology: &Topology,
    moved: &[u32],
    statuses: Option<&Bytes<'_>>,
    Reach { rings, widened }: Reach,
) -> Result<Vec<u32>, Error> {
    Indices::from(moved).check_range("moved", topology.vertex_count())?;
    if let Some(found) = statuses.map(Bytes::len).filter(|&found| found != topology.vertex_count()) {
        let expected = topology.vertex_count() as u64;
        return Err(Error::Size { what: "statuses", found: found as u64, expected });
    }
    let (mut found, always) = closure_by_rings(topology, moved, rings, widened)?;
    if let Some(statuses) = statuses {
        let mut count = always;
        for place in always..found.len() {
            if statuses.get(found[place] as usize) & status::WIDENED != 0 {
                found[count] = found[place];
                count += 1;
            }
        }
        found.truncate(count);
    }
    Ok(found)
}

/// Within how many rings of a vertex its normal looks at positions, widened or not; none if it looks at all of them.
pub(super) fn reach(weight: Weight) -> Option<usize> {
    of_weight(weight).ok().map(|reach| reach.rings + reach.widened)
}

fn of_weight(weight: Weight) -> Result<Reach, Error> {
    match weight {
        Weight::Jet(options) => Ok(Reach { rings: JetFit::new(options)?.rings(), widened: MOST_EXTRA_RINGS }),
        Weight::AdaptiveJet(options) => of_adaptive_jet(options),
        Weight::Conformal
        | Weight::Uniform
        | Weight::Angle
        | Weight::Area
        | Weight::Max
        | Weight::CentroidArea
        | Weight::Centroid
        | Weight::InverseRootEdges
        | Weight::Sine
        | Weight::AngleEdges
        | Weight::TiltedSections => Ok(Reach { rings: 1, widened: 0 }),
    }
}

/// One ring more than the fit's, since the normals of its points say which of them count, and their edges how noisy they are.
fn of_adaptive_jet(options: AdaptiveOptions) -> Result<Reach, Error> {
    let Some(model) = options.model else {
        return Err(Error::NotApplicable { what: "an update without options.model" });
    };
    model.check()?;
    if options.rings as usize > MOST_RINGS {
        return Err(Error::OptionOutOfRange { what: "options.rings" });
    }
    let rings = if options.rings == 0 { model.rings() } else { options.rings as usize };
    Ok(Reach { rings: rings + 1, widened: 0 })
}

fn of_method(options: &CurvatureOptions<'_>) -> Result<Reach, Error> {
    if options.radius != 0.0 {
        return Err(Error::NotApplicable { what: "options.radius" });
    }
    if options.rings > MOST_RINGS {
        return Err(Error::OptionOutOfRange { what: "options.rings" });
    }
    let rings = options.rings.max(1);
    // What the normal of a vertex reaches. Whether it was widened, no status says.
    let normals = || match options.normals {
        VertexNormals::Given(_) => Ok(0),
        VertexNormals::Computed(weight) => of_weight(weight).map(|reach| reach.rings + reach.widened),
    };
    let (rings, widened) = match options.method {
        Method::AdaptiveJet => {
            return of_adaptive_jet(AdaptiveOptions { rings: options.rings as u8, model: options.model });
        }
        Method::Jet => {
            let fit = JetFit::new(JetOptions { degree: options.degree, rings: options.rings as u8 })?;
            (fit.rings(), MOST_EXTRA_RINGS)
        }
        Method::Quadric => (rings.max(normals()?), MOST_EXTRA_RINGS),
        // Those of every point.
        Method::Goldfeather => (rings + normals()?, MOST_EXTRA_RINGS),
        Method::Rusinkiewicz | Method::CorrectedMeasure => (rings + normals()?, 0),
        Method::NormalCycle => (rings.max(rings - 1 + normals()?), 0),
        Method::TiltedSections
        | Method::LeastSquares
        | Method::Taubin
        | Method::Watanabe
        | Method::Meyer
        | Method::AngleDefect => (normals()?.max(1), 0),
    };
    Ok(Reach { rings, widened })
}

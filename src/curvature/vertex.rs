//! Curvatures at the vertices of a mesh: checks, vertex normals, and the method asked for.

use super::adaptive_jet::adaptive_curvatures;
use super::corrected_measure::CorrectedMeasure;
use super::goldfeather::Goldfeather;
use super::measure::{Region, cells_needed, over_region};
use super::normal_cycle::NormalCycle;
use super::one_ring::{Way, is_single, looks_at_one_ring, over_one_ring, weight_on_the_way};
use super::patch::PatchCurvatures;
use super::quadric::Quadric;
use super::ring::OwnNormals;
use super::{CurvatureOutputs, Method, Section};
use crate::error::Error;
use crate::fit::{AdaptiveModel, JetFit, JetOptions, MOST_DEGREE};
use crate::normals::{NormalOutputs, Weight, reference_normals, vertex_normals};
use crate::parallel::{Run, fill};
use crate::simd::Real;
use crate::sweep::{MOST_EXTRA_RINGS, MOST_RINGS, NormalRows, check_counts, sweep_patches};
use crate::topology::{Topology, closure};
use crate::view::{Output, Points, Zero, zeroed};
use glam::DVec3;

/// The vertex normals that a method takes.
#[derive(Clone, Copy, Debug)]
pub enum VertexNormals<'a> {
    /// Computed with this weight.
    Computed(Weight),
    /// Given, `#V × 3`, of any length but zero; a vertex with a zero normal has none.
    Given(Points<'a>),
}

impl Default for VertexNormals<'_> {
    fn default() -> Self {
        VertexNormals::Computed(Weight::default())
    }
}

/// How [`curvatures`] are computed.
#[derive(Clone, Copy, Debug, Default)]
pub struct CurvatureOptions<'a> {
    /// The method.
    pub method: Method,
    /// The formula of sections: [`Section::Circle`] or [`Section::SymmetricParabola`].
    pub section: Section,
    /// The vertex normals.
    pub normals: VertexNormals<'a>,
    /// What adaptive jets know of the mesh; learned from it if there is none. Other methods do not look at it.
    pub model: Option<AdaptiveModel>,
    /// For jets, the degree, 2 to 4; 0 for 3.
    pub degree: u8,
    /// How many rings around a vertex count; 0 for what the method does by itself. Methods of one ring take 0 or 1.
    pub rings: usize,
    /// For the measures, the radius of a ball instead of rings; 0 for none.
    pub radius: f64,
}

/// Computes the curvatures of all vertices, or of those in [`Run::vertices`].
///
/// Methods of one ring are computed in single precision where positions, given normals and outputs all are `f32` and faces are
/// triangles, and then in double precision wherever that could be off by more than about 2e-6 by the length of the shortest edge
/// at the vertex (to the power of the result's own unit), which is what the rounding of the positions to single precision costs as
/// well; all else in double precision.
/// Results are pointwise unless their name says integrated.
///
/// # Errors
/// [`Error::Size`] where counts do not fit; [`Error::NotApplicable`] for an output or an option that the method does not
/// have; [`Error::OptionOutOfRange`]; [`Error::NonFinitePosition`]; [`Error::NonFiniteNormal`];
/// [`Error::IndexOutOfRange`] for a vertex to compute that is none; [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub fn curvatures(
    topology: &Topology,
    points: &Points<'_>,
    options: &CurvatureOptions<'_>,
    mut run: Run<'_>,
    outputs: &CurvatureOutputs<'_>,
) -> Result<(), Error> {
    outputs.check(topology.vertex_count(), options.method.provides())?;
    let region = region(options)?;
    if options.method == Method::Jet {
        jet_options(options)?;
    }
    check_counts(topology, points, run.vertices)?;
    if options.method == Method::AdaptiveJet {
        return adaptive_curvatures(topology, points, options, run, outputs);
    }
    if looks_at_one_ring(options.method, region) {
        return with_own_normals(topology, points, options, run, outputs);
    }
    // The vertices whose cells are added up; None for all, or where there are no cells.
    let cells = match (run.vertices, options.method) {
        (Some(vertices), Method::NormalCycle | Method::CorrectedMeasure) => {
            Some(cells_needed(topology, points, vertices, region)?)
        }
        _ => None,
    };
    let list = match cells.as_deref().or(run.vertices) {
        Some(list) => Some(closure(topology, list, normal_rings(options))?),
        None => None,
    };
    let normals = run.part_for(list.as_deref(), 0.0, NORMAL_SHARE, |run| {
        match (options.method, options.normals) {
            // A jet only asks which side is which.
            (Method::Jet, VertexNormals::Computed(_)) => reference_normals(topology, points, run),
            (_, asked) => normals_of(topology, points, asked, run),
        }
    })?;
    run.part(NORMAL_SHARE, 1.0, |run| over_rings(topology, points, options, run, &normals, outputs, cells.as_deref()))
}

/// Computes a method of one ring, with its normals.
fn with_own_normals(
    topology: &Topology,
    points: &Points<'_>,
    options: &CurvatureOptions<'_>,
    mut run: Run<'_>,
    outputs: &CurvatureOutputs<'_>,
) -> Result<(), Error> {
    let double = !is_single(points, options, outputs);
    if options.method == Method::AngleDefect && outputs.normal.is_none() {
        let normals = Ok(OwnNormals::None);
        return over_one_ring(options, outputs, Way { topology, points, run: &mut run, double, normals });
    }
    if let Some(weight) = weight_on_the_way(options) {
        let normals = Err(weight);
        return over_one_ring(options, outputs, Way { topology, points, run: &mut run, double, normals });
    }
    let list = match run.vertices {
        Some(list) => Some(closure(topology, list, normal_rings(options))?),
        None => None,
    };
    let (single_rows, double_rows): (Vec<[f32; 3]>, Vec<[f64; 3]>);
    let rows = if double {
        double_rows = run
            .part_for(list.as_deref(), 0.0, NORMAL_SHARE, |run| normals_of(topology, points, options.normals, run))?;
        NormalRows::Double(&double_rows)
    } else {
        single_rows = run
            .part_for(list.as_deref(), 0.0, NORMAL_SHARE, |run| normals_of(topology, points, options.normals, run))?;
        NormalRows::Single(&single_rows)
    };
    run.part(NORMAL_SHARE, 1.0, |mut run| {
        let normals = Ok(OwnNormals::Rows(rows));
        over_one_ring(options, outputs, Way { topology, points, run: &mut run, double, normals })
    })
}

/// The part of the work that goes into the vertex normals, for progress.
pub(super) const NORMAL_SHARE: f64 = 0.2;

/// How many rings around a vertex a method needs normals of.
fn normal_rings(options: &CurvatureOptions<'_>) -> usize {
    match options.method {
        Method::Rusinkiewicz | Method::CorrectedMeasure => 1,
        Method::Goldfeather => options.rings.max(1) + MOST_EXTRA_RINGS,
        _ => 0,
    }
}

/// Computes a method of more than one ring.
fn over_rings(
    topology: &Topology,
    points: &Points<'_>,
    options: &CurvatureOptions<'_>,
    mut run: Run<'_>,
    normals: &[[f64; 3]],
    outputs: &CurvatureOutputs<'_>,
    cells: Option<&[u32]>,
) -> Result<(), Error> {
    let flags = topology.flags();
    macro_rules! patch {
        ($estimator:expr) => {{
            let quantity = PatchCurvatures { outputs, flags, normals, estimator: $estimator };
            sweep_patches(topology, points, &mut run, &quantity)
        }};
    }
    let region = region(options)?;
    let condition = outputs.condition.is_some();
    let rings = options.rings.max(1);
    match options.method {
        Method::Jet => patch!(JetFit::new(jet_options(options)?)?),
        Method::Quadric => patch!(Quadric { rings, condition }),
        Method::Goldfeather => patch!(Goldfeather { rings, condition }),
        Method::NormalCycle => over_region::<NormalCycle>(topology, points, run, normals, outputs, region, cells),
        Method::CorrectedMeasure => {
            over_region::<CorrectedMeasure>(topology, points, run, normals, outputs, region, cells)
        }
        Method::AdaptiveJet
        | Method::TiltedSections
        | Method::LeastSquares
        | Method::Taubin
        | Method::Watanabe
        | Method::Meyer
        | Method::AngleDefect
        | Method::Rusinkiewicz => unreachable!("these have gone another way"),
    }
}

/// The options of a jet that has curvatures.
fn jet_options(options: &CurvatureOptions<'_>) -> Result<JetOptions, Error> {
    if options.degree == 1 {
        return Err(Error::OptionOutOfRange { what: "options.degree" });
    }
    Ok(JetOptions { degree: options.degree, rings: options.rings as u8 })
}

/// The region that the options ask for, or why they cannot.
fn region(options: &CurvatureOptions<'_>) -> Result<Region, Error> {
    let fit = matches!(options.method, Method::AdaptiveJet | Method::Jet | Method::Quadric | Method::Goldfeather);
    if options.degree != 0 && options.method != Method::Jet {
        return Err(Error::NotApplicable { what: "options.degree" });
    }
    if options.degree > MOST_DEGREE {
        return Err(Error::OptionOutOfRange { what: "options.degree" });
    }
    let measure = matches!(options.method, Method::NormalCycle | Method::CorrectedMeasure);
    if !(options.radius >= 0.0 && options.radius < f64::INFINITY) {
        return Err(Error::OptionOutOfRange { what: "options.radius" });
    }
    if options.rings > MOST_RINGS {
        return Err(Error::OptionOutOfRange { what: "options.rings" });
    }
    if options.radius > 0.0 {
        return match measure {
            true if options.rings == 0 => Ok(Region::Ball(options.radius)),
            true => Err(Error::NotApplicable { what: "options.rings beside options.radius" }),
            false => Err(Error::NotApplicable { what: "options.radius" }),
        };
    }
    if options.rings > 1 && !measure && !fit {
        return Err(Error::NotApplicable { what: "options.rings" });
    }
    Ok(Region::Rings(options.rings.max(1)))
}

/// Checks counts and the list of vertices, then unit normals of these, as a part of a run.
pub(super) fn unit_normals(
    topology: &Topology,
    points: &Points<'_>,
    asked: VertexNormals<'_>,
    run: &mut Run<'_>,
) -> Result<Vec<[f64; 3]>, Error> {
    check_counts(topology, points, run.vertices)?;
    run.part(0.0, NORMAL_SHARE, |run| normals_of(topology, points, asked, run))
}

/// Unit normals of the vertices that `run` asks for; zero where there is none.
fn normals_of<S: Real + Zero>(
    topology: &Topology,
    points: &Points<'_>,
    asked: VertexNormals<'_>,
    run: Run<'_>,
) -> Result<Vec<[S; 3]>, Error>
where
    for<'a> Output<'a>: From<&'a mut [[S; 3]]>,
{
    let mut normals: Vec<[S; 3]> = zeroed(topology.vertex_count())?;
    match asked {
        VertexNormals::Computed(weight) => {
            let outputs = NormalOutputs { normal: Some(normals.as_mut_slice().into()), ..NormalOutputs::default() };
            vertex_normals(topology, points, weight, run, &outputs)?;
        }
        VertexNormals::Given(given) => {
            if given.len() != topology.vertex_count() {
                let (found, expected) = (given.len() as u64, topology.vertex_count() as u64);
                return Err(Error::Size { what: "normals.count", found, expected });
            }
            let normal = |vertex: usize| unit(given.get(vertex)).to_array().map(S::from_f64);
            match run.vertices {
                Some(list) => {
                    for &vertex in list {
                        if !given.get(vertex as usize).is_finite() {
                            return Err(Error::NonFiniteNormal { vertex: vertex as u64 });
                        }
                        normals[vertex as usize] = normal(vertex as usize);
                    }
                }
                None => {
                    given.check_finite().map_err(|error| match error {
                        Error::NonFinitePosition { vertex } => Error::NonFiniteNormal { vertex },
                        other => other,
                    })?;
                    fill(run.threads, &mut normals, normal);
                }
            }
        }
    }
    Ok(normals)
}

/// A vector of any length at length 1; zero if it is zero.
#[inline(always)]
fn unit(vector: DVec3) -> DVec3 {
    let squared = vector.length_squared();
    if (1e-200..1e200).contains(&squared) {
        return vector / squared.sqrt();
    }
    // Twice, since the largest factor does not lift the smallest numbers all the way.
    let vector = vector * vector.abs().max_element().inverse_power_of_two();
    let vector = vector * vector.abs().max_element().inverse_power_of_two();
    let length = vector.length();
    if length > 0.0 { vector / length } else { DVec3::ZERO }
}

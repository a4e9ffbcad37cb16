//! Adaptive jets over a mesh: rings, model, fits, creases.
//!
//! See [`fit`](crate::fit) for the fit and for what is learned. This file runs them: first what all one-rings are like, then, if
//! no model is given, what the mesh teaches, then the fits, and at last the vertices on creases.
//!
//! **Creases.** The status of a vertex with a face more than 37° from its normal says crease. If besides a smooth surface through
//! its ring contradicts what was learned of noise and smoothness ([`AdaptiveJet::kinked`]), nothing is fitted there: its normal is the
//! mean direction of the sides (`surroundings.rs`), curvatures are those of sections, and the status says fallback too. Everywhere
//! else neighbours beyond a crease do not count, since their normals are more than 60° away.
//!
//! Degenerate rule: a vertex without normal has no result (status degenerate); one where the fit has no solution in range keeps
//! Max's normal, without curvature (status fallback).
//!
//! Cost: three rings take about three times as long as a jet of degree 3 over two, four rings five times; learning takes as long as the
//! fits of a few thousand vertices.

use super::surroundings::{crease_normals, surroundings};
use super::vertex::NormalOutputs;
use crate::error::{Error, reserved};
use crate::fit::{AdaptiveFit, AdaptiveJet, AdaptiveModel, Surroundings, learn};
use crate::parallel::{Run, fill};
use crate::simd::{Mask, Vector};
use crate::sweep::{Counts, MOST_RINGS, Patch, PatchQuantity, Room, check_counts, sweep_patches};
use crate::topology::{Neighbourhood, Topology, closure, status};
use crate::view::{Points, StatusOutput, zeroed};

/// How an adaptive jet is fitted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AdaptiveOptions {
    /// The rings of neighbours that it is fitted to, at most 8; 0 for as many as the noise asks for, 3 to 6. What is further away
    /// than the fit reaches has next to no weight, so more rings cost time but no accuracy.
    pub rings: u8,
    /// What is known of the mesh; learned from it if there is none.
    pub model: Option<AdaptiveModel>,
}

/// Where the results of adaptive jets go.
pub(crate) trait Sink: Sync {
    /// Whether [`AdaptiveJet::freedom`] is asked for.
    fn freedom(&self) -> bool {
        false
    }
    /// Whether [`AdaptiveJet::residual`] is asked for.
    fn residual(&self) -> bool {
        false
    }
    /// Writes the lanes of a block whose bits are set and that have numbers in range, with status bits; answers with theirs.
    fn write<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        lanes: u32,
        jet: &AdaptiveJet<V>,
        scale: V,
        more: u8,
    ) -> u32;
    /// Writes a vertex that has no jet, with its normal (zero where it has none) and status bits.
    fn write_none(&self, vertex: usize, normal: [f64; 3], more: u8);
    /// Writes the vertices on creases, which are those of `run`; `normals` has theirs.
    ///
    /// # Errors
    /// As [`sweep_in`](crate::sweep::sweep_in).
    fn write_creases(&self, room: &Room, run: Run<'_>, normals: &[[f64; 3]]) -> Result<(), Error>;
}

/// Learns what adaptive jets use of a mesh, from a sample of all its vertices; `run.vertices` is not looked at.
///
/// Handed to calls in [`AdaptiveOptions::model`], it gives the same bits as calls that learn it themselves.
///
/// # Errors
/// [`Error::Size`] where counts do not fit; [`Error::NonFinitePosition`];
/// [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub fn learn_model(topology: &Topology, points: &Points<'_>, mut run: Run<'_>) -> Result<AdaptiveModel, Error> {
    let around = run.part_for(None, 0.0, 0.5, |mut run| surroundings(topology, points, &mut run))?;
    let model = run.part_for(None, 0.5, 1.0, |mut run| learn(topology, points, &around, &mut run))?;
    if let Some(progress) = &mut run.progress {
        // Learning ends without a sweep, or with none at all; a wish to cancel comes too late to matter.
        progress(1.0);
    }
    Ok(model)
}

/// Fits adaptive jets to the vertices of `run`.
///
/// # Errors
/// As [`learn_model`], and [`Error::IndexOutOfRange`].
pub(crate) fn adaptive_jets<S: Sink>(
    topology: &Topology,
    points: &Points<'_>,
    options: AdaptiveOptions,
    mut run: Run<'_>,
    sink: &S,
) -> Result<(), Error> {
    check_counts(topology, points, run.vertices)?;
    if options.rings as usize > MOST_RINGS {
        return Err(Error::OptionOutOfRange { what: "options.rings" });
    }
    let rings_of = |model: &AdaptiveModel| if options.rings == 0 { model.rings() } else { options.rings as usize };
    if let Some(model) = &options.model {
        model.check()?;
    }
    // Without a model every ring is looked at.
    let list = match (run.vertices, &options.model) {
        (Some(vertices), Some(model)) => Some(closure(topology, vertices, rings_of(model))?),
        _ => None,
    };
    let mut around = run.part_for(list.as_deref(), 0.0, 0.05, |mut run| surroundings(topology, points, &mut run))?;
    let model = match options.model {
        Some(model) => model,
        None => run.part_for(None, 0.05, 0.1, |mut run| learn(topology, points, &around, &mut run))?,
    };
    let mut noise = Vec::new();
    if model.noise_exponent > 0 {
        noise = zeroed(topology.vertex_count())?;
        match &list {
            Some(list) => list.iter().for_each(|&vertex| {
                noise[vertex as usize] = model.noise_at(around.edge_lengths[vertex as usize]);
            }),
            None => fill(run.threads, &mut noise, |vertex| model.noise_at(around.edge_lengths[vertex])),
        }
    }
    let mut creased: Vec<u8> = zeroed(topology.vertex_count())?;
    // All memory is there before the first result is written.
    let sharp = |vertex: &usize| around.may_be_creased(*vertex);
    let room = match run.vertices {
        Some(vertices) => Room::new(topology, vertices.iter().map(|&vertex| vertex as usize).filter(sharp))?,
        None => Room::new(topology, (0..topology.vertex_count()).filter(sharp))?,
    };
    let mut creases: Vec<u32> = reserved(run.vertices.map_or(topology.vertex_count(), <[u32]>::len))?;
    let quantity = Jets {
        fit: AdaptiveFit {
            model,
            rings: rings_of(&model),
            edge_lengths: &around.edge_lengths,
            noise: (model.noise_exponent > 0).then_some(&noise),
            freedom: sink.freedom(),
            residual: sink.residual(),
        },
        around: &around,
        creased: creased.as_mut_slice().into(),
        sink,
    };
    run.part(0.1, 0.95, |mut run| sweep_patches(topology, points, &mut run, &quantity))?;
    let is_creased = |vertex: &u32| creased[*vertex as usize] != 0;
    match run.vertices {
        Some(vertices) => creases.extend(vertices.iter().copied().filter(is_creased)),
        None => creases.extend((0..topology.vertex_count() as u32).filter(is_creased)),
    }
    run.part_for(Some(&creases), 0.95, 0.97, |mut run| {
        crease_normals(&room, topology, points, &mut run, &mut around.normals)
    })?;
    run.part_for(Some(&creases), 0.97, 1.0, |run| sink.write_creases(&room, run, &around.normals))?;
    if let Some(progress) = &mut run.progress {
        // All is written, so a wish to cancel comes too late to matter.
        progress(1.0);
    }
    Ok(())
}

/// Fits, and marks vertices on creases.
struct Jets<'a, S> {
    fit: AdaptiveFit<'a>,
    around: &'a Surroundings,
    creased: StatusOutput<'a>,
    sink: &'a S,
}

impl<S: Sink> PatchQuantity for Jets<'_, S> {
    const ATTEMPTS: usize = 2;

    fn rings(&self) -> usize {
        self.fit.rings
    }
    fn least(&self) -> usize {
        0
    }
    fn scratch(&self, points: usize) -> usize {
        self.fit.scratch(points)
    }
    fn normals(&self) -> &[[f64; 3]] {
        &self.around.normals
    }
    fn values(&self) -> Option<&[f64]> {
        self.fit.noise
    }
    #[inline(always)]
    fn choose<V: Vector<Scalar = f64>, Z: Vector<Scalar = f32>>(
        &self,
        vertex: u32,
        found: &Neighbourhood,
        chosen: &mut [u32],
    ) -> Counts {
        self.around.choose::<V, Z>(vertex, found, chosen)
    }

    #[inline(always)]
    fn block<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        scale: V,
        _widened: u32,
        attempt: usize,
        scratch: &mut [V],
    ) -> u32 {
        let jet = self.fit.lanes(vertices, patch, scale, attempt > 0, scratch);
        let all = (1u32 << vertices.len()) - 1;
        let known = jet.trusted.and(V::zero().lt(patch.normal.squared())).bits() & all;
        let (kinked, mut creases, mut sharp) = (jet.kinked.bits(), 0, 0);
        for (lane, &vertex) in vertices.iter().enumerate() {
            let bit = 1 << lane;
            if self.around.marks[vertex as usize] & Surroundings::SHARP != 0 {
                sharp |= bit;
                if known & kinked & bit != 0 && self.around.may_be_creased(vertex as usize) {
                    creases |= bit;
                    self.creased.write(vertex as usize, 1);
                }
            }
        }
        let again = if attempt == 0 { jet.off.bits() } else { 0 };
        let fitted = known & !creases & !again;
        let mut done = creases | self.sink.write(vertices, fitted & !sharp, &jet, scale, 0);
        if fitted & sharp != 0 {
            done |= self.sink.write(vertices, fitted & sharp, &jet, scale, status::CREASE);
        }
        all & !done
    }

    fn alone(
        &self,
        vertex: usize,
        _patch: &Patch<'_, f64>,
        _scale: f64,
        _widened: bool,
        _last: bool,
        _scratch: &mut [f64],
    ) -> bool {
        let normal = self.around.normals[vertex];
        self.sink.write_none(vertex, normal, if normal == [0.0; 3] { status::DEGENERATE } else { status::FALLBACK });
        true
    }

    fn isolated(&self, vertex: usize) {
        self.sink.write_none(vertex, [0.0; 3], status::ISOLATED);
    }
}

/// [`vertex_normals`](super::vertex_normals) by adaptive jets. The counts of `outputs` have been checked.
pub(super) fn adaptive_normals(
    topology: &Topology,
    points: &Points<'_>,
    options: AdaptiveOptions,
    run: Run<'_>,
    outputs: &NormalOutputs<'_>,
) -> Result<(), Error> {
    adaptive_jets(topology, points, options, run, &Normals { outputs, flags: topology.flags() })
}

struct Normals<'a> {
    outputs: &'a NormalOutputs<'a>,
    flags: &'a [u8],
}

impl Sink for Normals<'_> {
    #[inline(always)]
    fn write<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        lanes: u32,
        jet: &AdaptiveJet<V>,
        _scale: V,
        more: u8,
    ) -> u32 {
        let normal = jet.surface.normal;
        let lanes = lanes & normal.squared().lt(V::constant(2.0)).bits();
        let axes = [normal.x.to_lanes(), normal.y.to_lanes(), normal.z.to_lanes()];
        for (lane, &vertex) in vertices.iter().enumerate() {
            if lanes & 1 << lane != 0 {
                self.write_none(vertex as usize, [axes[0][lane], axes[1][lane], axes[2][lane]], more);
            }
        }
        lanes
    }

    fn write_none(&self, vertex: usize, normal: [f64; 3], more: u8) {
        self.outputs.write(vertex, normal, normal, self.flags[vertex] | more);
    }

    fn write_creases(&self, _room: &Room, run: Run<'_>, normals: &[[f64; 3]]) -> Result<(), Error> {
        for &vertex in run.vertices.unwrap_or(&[]) {
            self.write_none(vertex as usize, normals[vertex as usize], status::CREASE | status::FALLBACK);
        }
        Ok(())
    }
}

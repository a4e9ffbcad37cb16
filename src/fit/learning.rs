//! Learning from a mesh how noisy its positions are and how smooth its surface is: empirical Bayes for adaptive jets.
//!
//! **Sample.** Up to [`MOST_SAMPLED`] vertices, evenly spaced over the mesh, are looked at; of those away from creases (no
//! neighbour within two rings left out, no face far from the normal) as many are learned from. Where there are few of these, all are.
//!
//! **Noise.** Plain jets of degrees 4 and 3 over two rings, and 4 over three, leave a mean square of each neighbourhood. Its lower
//! quartile over the sample, divided by what that is for normal noise of variance 1, is where the surface is quiet: relief that a
//! mesh is too coarse for looks like noise, but is hardly ever everywhere. `σ²` is half of the least of the three. A second model
//! has the 0.8 quantile instead, for meshes of which a part is much noisier, and is taken only if the evidence for it is overwhelming.
//!
//! **Sizes.** `τ_d²` is the fixed point of MacKay 1992 ("Bayesian interpolation", eq. 4.21): the mean of the squared coefficients
//! over as many of them as the data decide. `τ₅`, for what lies beyond, continues the series: `τ₄²/τ₃`, at most `τ₄`.
//!
//! **Choices.** Coordinates, and if edges are of very different lengths also how noise and sizes go with them, are those with the
//! most evidence. Without enough vertices to learn from, circles are taken, since small meshes are mostly closed.
//!
//! Numerical notes: sums over the sample go vertex by vertex in one order, and logarithms are those of `libm`, so bits depend
//! neither on lanes and threads nor on the system. Cost: about 30 fits a sample vertex.

use super::adaptive_model::{AdaptiveModel, Coordinates, LEAST_NOISE};
use super::heights::{Heights, scratch, weigh};
use super::ridge::{Setting, solve};
use super::sample::{COLUMNS, Collector, Sample, Samples};
use super::surroundings::Surroundings;
use crate::error::{Error, filled, reserved};
use crate::parallel::Run;
use crate::simd::{MAX_LANES, Mask, Task, Vector, Width, dispatch, each};
use crate::sweep::sweep_patches;
use crate::topology::{Neighbourhood, Topology};
use crate::view::{Points, zeroed};
use std::sync::{Mutex, PoisonError};

/// The most vertices that are learned from.
const MOST_SAMPLED: usize = 256;

/// The most that are looked at for that.
const MOST_LOOKED_AT: usize = 4 * MOST_SAMPLED;

/// With fewer than this, no choices are made.
const FEW_SAMPLED: usize = 32;

/// What plain jets leave is their own error besides the noise: this part of its mean square is taken for noise.
const NOISE_PART: f64 = 0.5;

/// Repetitions of the fixed point: from nothing, and from the sizes of other choices.
const REPETITIONS: usize = 8;

const FURTHER_REPETITIONS: usize = 4;

/// Edges are of very different lengths if the 95 % quantile is more than this many times the 5 % quantile.
const GRADED: f64 = 2.0;

/// The quantile at which the noise is looked for: what is not noise but relief is hardly ever everywhere.
const QUIET: f64 = 0.25;

/// The quantile for a loud part, and by how much the logarithm of the evidence of a vertex must then be larger.
const LOUD: f64 = 0.8;

const LOUD_MARGIN: f64 = 20.0;

/// Learns from all vertices, whatever `run` is to compute.
///
/// # Errors
/// As [`sweep_patches`].
pub(crate) fn learn(
    topology: &Topology,
    points: &Points<'_>,
    around: &Surroundings,
    run: &mut Run<'_>,
) -> Result<AdaptiveModel, Error> {
    let known = |vertex: usize| {
        let length = around.edge_lengths[vertex];
        around.normals[vertex] != [0.0; 3] && length > 0.0 && length < f64::INFINITY
    };
    let mut lengths: Vec<f64> = zeroed(topology.vertex_count())?;
    let mut count = 0;
    for vertex in (0..topology.vertex_count()).filter(|&vertex| known(vertex)) {
        lengths[count] = around.edge_lengths[vertex];
        count += 1;
    }
    let Some(edge_length) = quantile(&mut lengths[..count], 0.5) else { return Ok(AdaptiveModel::UNKNOWN) };
    drop(lengths);
    // Above zero, however small the mesh.
    let noise_of = |part: f64| (part * edge_length).clamp(f64::from_bits(1), f64::MAX);
    let unknown = AdaptiveModel { edge_length, noise: noise_of(LEAST_NOISE), ..AdaptiveModel::UNKNOWN };

    let mut neighbourhood = Neighbourhood::new(topology)?;
    let mut candidates: Vec<u32> = reserved(MOST_LOOKED_AT)?;
    let looked_at = spaced(topology.vertex_count(), MOST_LOOKED_AT).filter(|&vertex| known(vertex));
    candidates.extend(looked_at.map(|vertex| vertex as u32));
    let mut clean: Vec<u32> = reserved(candidates.len())?;
    clean.extend(candidates.iter().filter(|&&vertex| around.is_clean(vertex, topology, &mut neighbourhood)));
    let candidates = if clean.len() < FEW_SAMPLED { candidates } else { clean };
    let mut list: Vec<u32> = reserved(MOST_SAMPLED)?;
    list.extend(spaced(candidates.len(), MOST_SAMPLED).map(|index| candidates[index]));

    let samples = Mutex::new(Samples::with_room(list.len(), topology.vertex_count())?);
    let collector = Collector { around, edge_length, samples };
    run.part_for(Some(&list), 0.0, 0.5, |mut run| sweep_patches(topology, points, &mut run, &collector))?;
    let mut samples = collector.samples.into_inner().unwrap_or_else(PoisonError::into_inner);
    // Neighbourhoods of one size share a row of lanes.
    samples.vertices.sort_unstable_by_key(|sample| (sample.count, sample.vertex));
    if samples.vertices.is_empty() {
        return Ok(unknown);
    }
    let mut best = None;
    dispatch(run.level, Choose { samples: &samples, best: &mut best });
    let Some(best) = best.transpose()? else { return Ok(unknown) };
    let Trial { noise_squared, sizes, coordinates, noise_exponent, size_exponent } = best.trial;
    let model = AdaptiveModel {
        edge_length,
        noise: noise_of(noise_squared.sqrt()),
        sizes,
        noise_exponent,
        size_exponent,
        coordinates,
        evidence: best.evidence,
        sample: samples.vertices.len() as u32,
    };
    // What came out must be what can be handed in.
    Ok(if model.check().is_ok() { model } else { unknown })
}

/// `0..count`, or `most` evenly spaced of them.
fn spaced(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let taken = count.min(most);
    (0..taken).map(move |index| (index as u64 * count as u64 / taken as u64) as usize)
}

/// The element of that rank, from 0 to 1; rearranges `numbers`.
fn quantile(numbers: &mut [f64], rank: f64) -> Option<f64> {
    let index = (numbers.len().checked_sub(1)? as f64 * rank) as usize;
    Some(*numbers.select_nth_unstable_by(index, f64::total_cmp).1)
}

/// The numbers, at the start of `place`.
fn listed(place: &mut [f64; MOST_SAMPLED], numbers: impl Iterator<Item = f64>) -> &mut [f64] {
    let mut count = 0;
    for number in numbers {
        place[count] = number;
        count += 1;
    }
    &mut place[..count]
}

/// What the mean of `freedom` squares of standard normal numbers is at the quantiles [`QUIET`] and [`LOUD`], by Wilson and Hilferty.
fn typical(rank: f64, freedom: f64) -> f64 {
    let normal = if rank == LOUD { 0.8416 } else { -0.6745 };
    let step = 2.0 / (9.0 * freedom);
    let root = 1.0 - step + normal * step.sqrt();
    root * root * root
}

/// The numbers of a model, in units of the mesh's edge length.
#[derive(Clone, Copy)]
struct Trial {
    noise_squared: f64,
    sizes: [f64; 4],
    coordinates: Coordinates,
    noise_exponent: u8,
    size_exponent: u8,
}

/// A model with its evidence.
#[derive(Clone, Copy)]
struct Learned {
    trial: Trial,
    /// Its own logarithm a vertex.
    own: f64,
    /// The best of both coordinates.
    evidence: [f64; 2],
}

/// Chooses the best model for samples.
struct Choose<'a> {
    samples: &'a Samples,
    best: &'a mut Option<Result<Learned, Error>>,
}

impl Task for Choose<'_> {
    #[inline(always)]
    fn run<W: Width>(self) {
        // Without closures, which would be functions of their own, of no width.
        *self.best = Some(match Sampled::<W>::new(self.samples) {
            Ok(mut sampled) => Ok(choose_model(&mut sampled)),
            Err(error) => Err(error),
        });
    }
}

/// A row of samples, in lanes; those that have fewer points than others have zeros.
struct Block<V> {
    /// How many samples there are.
    samples: usize,
    /// How many points the largest has.
    rows: usize,
    /// Where they start in [`Sampled::numbers`].
    start: usize,
    /// The mean edge lengths of the samples' own vertices.
    own_grade: V,
    slopes: [V; 2],
    count: V,
}

/// All samples, for vectors of a width.
struct Sampled<'a, W: Width> {
    samples: &'a [Sample],
    blocks: Vec<Block<W::Double>>,
    /// The points of all blocks, column after column.
    numbers: Vec<W::Double>,
    /// For the fit of a block.
    scratch: Vec<W::Double>,
}

impl<'a, W: Width> Sampled<'a, W> {
    fn new(all: &'a Samples) -> Result<Self, Error> {
        let samples = &all.vertices[..];
        let rows = samples.chunks(W::Double::LANES).map(most_points).sum::<usize>();
        let mut sampled = Sampled {
            samples,
            blocks: reserved(samples.len().div_ceil(W::Double::LANES))?,
            numbers: reserved(COLUMNS * rows)?,
            scratch: filled(scratch(most_points(samples)), W::Double::zero())?,
        };
        for block in samples.chunks(W::Double::LANES) {
            let load = |number: &dyn Fn(&Sample) -> f64| {
                W::Double::from_lanes(&each(0.0, |lane| number(block.get(lane).unwrap_or(&block[0]))))
            };
            let (rows, start) = (most_points(block), sampled.numbers.len());
            for column in 0..COLUMNS {
                // Lengths stand in denominators.
                let beyond = if column == COLUMNS - 1 { 1.0 } else { 0.0 };
                let row = |row| load(&|sample| all.get(sample, column, row).unwrap_or(beyond));
                sampled.numbers.extend((0..rows).map(row));
            }
            sampled.blocks.push(Block {
                samples: block.len(),
                rows,
                start,
                own_grade: load(&|sample| sample.grade),
                slopes: [load(&|sample| sample.slopes[0]), load(&|sample| sample.slopes[1])],
                count: load(&|sample| sample.count as f64),
            });
        }
        Ok(sampled)
    }
}

fn most_points(samples: &[Sample]) -> usize {
    samples.iter().map(|sample| sample.count).max().unwrap_or(0)
}

fn choose_model<W: Width>(sampled: &mut Sampled<'_, W>) -> Learned {
    let tiny = sampled.samples.len() < FEW_SAMPLED;
    let mut best = sampled.learn(Coordinates::Circle, 0, 0, QUIET, None);
    if tiny {
        return best;
    }
    best.take(sampled.learn(Coordinates::Height, 0, 0, QUIET, Some(&best)), 0.0);
    let mut grades = [0.0; MOST_SAMPLED];
    let grades = listed(&mut grades, sampled.samples.iter().map(|sample| sample.grade));
    let low = quantile(grades, 0.05).unwrap_or(1.0);
    let high = quantile(grades, 0.95).unwrap_or(1.0);
    if high > GRADED * low {
        for (noise_exponent, size_exponent) in [(1, 0), (2, 0), (1, 1)] {
            let coordinates = best.trial.coordinates;
            best.take(sampled.learn(coordinates, noise_exponent, size_exponent, QUIET, Some(&best)), 0.0);
        }
        let Trial { coordinates, noise_exponent, size_exponent, .. } = best.trial;
        best.take(sampled.learn(other(coordinates), noise_exponent, size_exponent, QUIET, Some(&best)), 0.0);
    }
    let Trial { coordinates, noise_exponent, size_exponent, .. } = best.trial;
    let loud = sampled.learn(coordinates, noise_exponent, size_exponent, LOUD, Some(&best));
    if best.take(loud, LOUD_MARGIN) {
        // What spoke for these coordinates may have been noise that the model did not know of.
        best.take(sampled.learn(other(coordinates), noise_exponent, size_exponent, LOUD, Some(&best)), 0.0);
    }
    best
}

fn other(coordinates: Coordinates) -> Coordinates {
    match coordinates {
        Coordinates::Height => Coordinates::Circle,
        Coordinates::Circle => Coordinates::Height,
    }
}

impl Learned {
    /// Becomes `other` if there is more evidence for that, by more than `margin`; answers whether there is.
    fn take(&mut self, other: Learned, margin: f64) -> bool {
        let mut evidence = self.evidence;
        for (best, other) in evidence.iter_mut().zip(other.evidence) {
            if other != 0.0 && (*best == 0.0 || other > *best + margin) {
                *best = other;
            }
        }
        let more = other.own > self.own + margin;
        if more {
            *self = other;
        }
        self.evidence = evidence;
        more
    }
}

/// Sums over the sample: for degrees 2 to 4, of squares of coefficients and of what the prior decides of them; and of evidence.
#[derive(Default)]
struct Totals {
    squares: [f64; 3],
    decided: [f64; 3],
    evidence: f64,
    /// How many samples these are.
    used: usize,
}

impl<W: Width> Sampled<'_, W> {
    /// The best numbers for these choices, starting at those of others if there are any.
    fn learn(
        &mut self,
        coordinates: Coordinates,
        noise_exponent: u8,
        size_exponent: u8,
        rank: f64,
        start: Option<&Learned>,
    ) -> Learned {
        let mut trial = Trial {
            noise_squared: self.noise(noise_exponent, rank),
            sizes: start.map_or(AdaptiveModel::UNKNOWN.sizes, |start| start.trial.sizes),
            coordinates,
            noise_exponent,
            size_exponent,
        };
        for _ in 0..if start.is_some() { FURTHER_REPETITIONS } else { REPETITIONS } {
            let totals = self.totals(&trial, false);
            for degree in 2..=4 {
                let count = ((degree + 1) * totals.used) as f64;
                let (squares, decided) = (totals.squares[degree - 2], totals.decided[degree - 2]);
                let size = &mut trial.sizes[degree - 2];
                let free = (count - decided / (*size * *size)).max(1e-3 * count).max(1e-3);
                *size = (squares / free).max(LEAST_NOISE * LEAST_NOISE).sqrt();
            }
            let [_, third, fourth, beyond] = &mut trial.sizes;
            *beyond = (*fourth * *fourth / third.max(1e-9)).clamp(0.02 * *fourth, *fourth);
        }
        let totals = self.totals(&trial, true);
        let own = totals.evidence / totals.used.max(1) as f64;
        let mut evidence = [0.0; 2];
        evidence[(coordinates == Coordinates::Circle) as usize] = own;
        Learned { trial, own, evidence }
    }

    /// The variance of the noise that plain jets leave, in units of the mesh's edge length.
    fn noise(&self, exponent: u8, rank: f64) -> f64 {
        let mut least = f64::INFINITY;
        for jet in 0..3 {
            let enough = self.samples.iter().filter(|sample| sample.plain[jet].1 > 0.5);
            let variance = |sample: &Sample| {
                let (squares, freedom) = sample.plain[jet];
                let factor = [sample.grade, 1.0, 1.0 / sample.grade][exponent as usize];
                squares / freedom * factor * factor
            };
            let (mut freedoms, mut variances) = ([0.0; MOST_SAMPLED], [0.0; MOST_SAMPLED]);
            let freedoms = listed(&mut freedoms, enough.clone().map(|sample| sample.plain[jet].1));
            let variances = listed(&mut variances, enough.map(variance));
            if variances.len() >= 8
                && let (Some(variance), Some(freedom)) = (quantile(variances, rank), quantile(freedoms, 0.5))
            {
                least = least.min(variance / typical(rank, freedom));
            }
        }
        // None of them has enough points: nothing can be told from the surface.
        if least == f64::INFINITY {
            least = 0.0;
        }
        (NOISE_PART * least).max(LEAST_NOISE * LEAST_NOISE)
    }

    fn totals(&mut self, trial: &Trial, evidence: bool) -> Totals {
        let mut totals = Totals::default();
        let (blocks, numbers, scratch) = (&self.blocks[..], &self.numbers[..], &mut self.scratch[..]);
        W::call(Evaluate { blocks, numbers, scratch, trial, evidence, totals: &mut totals });
        totals
    }
}

/// Fits all samples with a trial's numbers.
struct Evaluate<'a, V> {
    blocks: &'a [Block<V>],
    numbers: &'a [V],
    scratch: &'a mut [V],
    trial: &'a Trial,
    evidence: bool,
    totals: &'a mut Totals,
}

impl<V: Vector<Scalar = f64>> Task for Evaluate<'_, V> {
    /// The width is that of the blocks.
    #[inline(always)]
    fn run<W: Width>(self) {
        for block in self.blocks {
            evaluate(block, self.numbers, self.trial, self.evidence, self.scratch, self.totals);
        }
    }
}

#[inline(always)]
fn evaluate<V: Vector<Scalar = f64>>(
    block: &Block<V>,
    numbers: &[V],
    trial: &Trial,
    evidence: bool,
    scratch: &mut [V],
    totals: &mut Totals,
) {
    let heights = &mut Heights::new(scratch, block.rows - 1).0;
    let one = V::one();
    for (row, variance) in heights.variance.iter_mut().enumerate() {
        let at = |column: usize, beyond: V| {
            if row < block.rows { numbers[block.start + column * block.rows + row] } else { beyond }
        };
        heights.u[row] = at(0, V::zero());
        heights.v[row] = at(1, V::zero());
        heights.w[row] = at(2, V::zero());
        let grade = at(3, one);
        let factor = match trial.noise_exponent {
            0 => one,
            1 => grade,
            _ => grade * grade,
        } / block.own_grade;
        *variance = bounded(V::constant(trial.noise_squared) * factor * factor);
    }
    let grade = if trial.size_exponent == 0 { block.own_grade } else { one };
    let mut factor = one;
    let sizes_squared = each(V::zero(), |index| {
        factor = factor * grade;
        let size = V::constant(trial.sizes[index]) * factor;
        bounded(size * size)
    });
    let setting = Setting { sizes_squared, count: block.count, slopes: block.slopes, coordinates: trial.coordinates };
    weigh(heights, &setting);
    let found = solve(heights, &setting, !evidence);
    if evidence {
        let logarithms = found.log_evidence(heights, &setting);
        for logarithm in logarithms[..block.samples].iter().filter(|logarithm| logarithm.is_finite()) {
            totals.evidence += logarithm;
            totals.used += 1;
        }
        return;
    }
    let definite = found.definite.bits();
    let mut factor = one;
    let found_shares = found.shares();
    let shares: [_; 3] = each(([0.0; MAX_LANES], [0.0; MAX_LANES]), |index| {
        let (squares, decided) = found_shares[index];
        factor = factor * grade;
        let inverse = one / (factor * factor);
        ((squares * inverse).to_lanes(), (decided * inverse).to_lanes())
    });
    // A sample out of all range teaches nothing, and must not spoil what the others do.
    let usable = |lane: &usize| {
        let finite =
            |(squares, decided): &([f64; MAX_LANES], [f64; MAX_LANES])| (squares[*lane] + decided[*lane]).is_finite();
        definite & 1 << lane != 0 && shares.iter().all(finite)
    };
    for lane in (0..block.samples).filter(usable) {
        for (index, (squares, decided)) in shares.iter().enumerate() {
            totals.squares[index] += squares[lane];
            totals.decided[index] += decided[lane];
        }
        totals.used += 1;
    }
}

/// Kept where squares and reciprocals stay in range.
#[inline(always)]
fn bounded<V: Vector<Scalar = f64>>(x: V) -> V {
    x.max(V::constant(1e-200)).min(V::constant(1e200))
}

//! The oracle of what adaptive jets learn: the sample, the noise, MacKay's fixed point, the evidence and the choices, from the
//! definitions, over the fits of [`AdaptiveOracle`].

use super::adaptive_oracle::{AdaptiveOracle, Framed, by_degree, plain_variances};
use super::mesh::Mesh;
use umbilic::{AdaptiveModel, Coordinates};

/// The smallest noise and the smallest sizes, in edge lengths.
const LEAST: f64 = 1e-8;

/// The quantiles at which noise is looked for: where it is quiet, and for a loud part.
const QUIET: f64 = 0.25;
const LOUD: f64 = 0.8;

/// Below this many vertices to learn from, nothing is chosen.
const FEW: usize = 32;

/// How noise and sizes go with the edges, and in what coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    pub coordinates: Coordinates,
    pub noise_exponent: u8,
    pub size_exponent: u8,
    /// The quantile of what plain jets leave that is taken for the noise.
    pub rank: f64,
}

pub struct LearningOracle<'a> {
    pub oracle: AdaptiveOracle<'a>,
    pub edge_length: f64,
    samples: Vec<Framed>,
}

/// `0..count`, or `most` evenly spaced of them.
fn spaced(count: usize, most: usize) -> Vec<usize> {
    if count <= most { (0..count).collect() } else { (0..most).map(|index| index * count / most).collect() }
}

/// The element of that rank.
fn quantile(mut numbers: Vec<f64>, rank: f64) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[((numbers.len() - 1) as f64 * rank) as usize]
}

impl<'a> LearningOracle<'a> {
    pub fn new(mesh: &'a Mesh) -> Self {
        let oracle = AdaptiveOracle::new(mesh);
        let known = |&vertex: &usize| oracle.around[vertex].normal != [0.0; 3] && oracle.around[vertex].length > 0.0;
        let count = mesh.positions.len();
        let edge_length =
            quantile((0..count).filter(known).map(|vertex| oracle.around[vertex].length).collect(), 0.5);
        // Of up to 1024 vertices up to 256 that are away from creases; if those are few, up to 256 of all.
        let candidates: Vec<usize> = spaced(count, 1024).into_iter().filter(known).collect();
        let clean: Vec<usize> = candidates.iter().copied().filter(|&vertex| oracle.is_clean(vertex)).collect();
        let candidates = if clean.len() < FEW { candidates } else { clean };
        let sampled = spaced(candidates.len(), 256).into_iter().map(|index| candidates[index]);
        let samples = sampled.map(|vertex| oracle.framed(vertex, 6).unwrap()).collect();
        LearningOracle { oracle, edge_length, samples }
    }

    pub fn sample_count(&self) -> usize {
        self.samples.len()
    }

    /// The mean edge length of a sample vertex, in the mesh's.
    fn grade(&self, sample: &Framed) -> f64 {
        self.oracle.around[sample.vertex].length / self.edge_length
    }

    /// Half of the least of what three plain jets leave, each by the quantile of that rank over the sample and in parts of what it
    /// is for normal noise: a variance in units of the mesh's edge length, or of what the noise goes with.
    fn noise(&self, choice: &Choice) -> f64 {
        let all: Vec<[Option<(f64, f64)>; 3]> =
            self.samples.iter().map(|sample| plain_variances(&sample.points)).collect();
        let of_jet = |jet: usize| {
            let left = self.samples.iter().zip(&all).filter_map(|(sample, variances)| {
                // In the mesh's units it is grade times as large, and noise is grade^exponent times that of the mesh.
                let grade = self.grade(sample).powi(1 - i32::from(choice.noise_exponent));
                variances[jet].map(|(variance, freedom)| (variance * grade * grade, freedom))
            });
            let (left, freedoms): (Vec<f64>, Vec<f64>) = left.unzip();
            // The quantile of a mean of so many squares (Wilson & Hilferty 1931).
            let normal = if choice.rank == LOUD { 0.8416 } else { -0.6745 };
            let typical =
                |freedom: f64| (1.0 - 2.0 / (9.0 * freedom) + normal * (2.0 / (9.0 * freedom)).sqrt()).powi(3);
            (left.len() >= 8).then(|| quantile(left, choice.rank) / typical(quantile(freedoms, 0.5)))
        };
        let least = (0..3).filter_map(of_jet).fold(f64::INFINITY, f64::min);
        if least.is_finite() { (least / 2.0).max(LEAST * LEAST) } else { LEAST * LEAST }
    }

    /// The numbers that the sample teaches, given a choice, and the mean logarithm of its evidence for them; after eight steps from
    /// nothing, or four from the sizes of another choice.
    fn learned(&self, choice: &Choice, start: Option<[f64; 4]>) -> (AdaptiveModel, f64) {
        let mut model = AdaptiveModel {
            edge_length: self.edge_length,
            noise: self.noise(choice).sqrt() * self.edge_length,
            sizes: start.unwrap_or([1e3, 0.3, 0.1, 0.03]),
            noise_exponent: choice.noise_exponent,
            size_exponent: choice.size_exponent,
            coordinates: choice.coordinates,
            ..AdaptiveModel::default()
        };
        for _ in 0..if start.is_some() { 4 } else { 8 } {
            let (mut squares, mut variances) = ([0.0; 3], [0.0; 3]);
            for sample in &self.samples {
                let priors = self.oracle.priors(sample, &model);
                let solved = priors.solved(sample, &inverse(&priors.variances(&sample.points)));
                let of_coefficients = by_degree(|term| solved.c[term].powi(2));
                let covariance = solved.factored.variances();
                let of_variances = by_degree(|term| covariance[term]);
                // In units of what the sizes go with.
                let grade = if choice.size_exponent == 0 { self.grade(sample) } else { 1.0 };
                for index in 0..3 {
                    let unit = grade.powi(2 * (index as i32 + 1));
                    squares[index] += of_coefficients[index] / unit;
                    variances[index] += of_variances[index] / unit;
                }
            }
            for (index, size) in model.sizes[..3].iter_mut().enumerate() {
                // MacKay: the sum of squares over how many coefficients the data decide.
                let count = ((index + 3) * self.samples.len()) as f64;
                let decided = (count - variances[index] / (*size * *size)).max(1e-3 * count);
                *size = (squares[index] / decided).sqrt().max(LEAST);
            }
            let [_, third, fourth, _] = model.sizes;
            model.sizes[3] = (fourth * fourth / third.max(1e-9)).clamp(0.02 * fourth, fourth);
        }
        let total: f64 = self.samples.iter().map(|sample| self.log_evidence(sample, &model)).sum();
        (model, total / self.samples.len() as f64)
    }

    /// `log ∫ exp(−½ (misfit + prior)) dc √(Π weights Π priors)`, without the powers of 2π: by the determinant of the stacked matrix
    /// and by what its solution leaves.
    fn log_evidence(&self, sample: &Framed, model: &AdaptiveModel) -> f64 {
        let priors = self.oracle.priors(sample, model);
        let weights = inverse(&priors.variances(&sample.points));
        let solved = priors.solved(sample, &weights);
        let data: f64 = weights.iter().map(|weight| weight.ln() / 2.0).sum();
        let prior: f64 = priors.roots(sample.points.len()).iter().skip(1).map(|root| root.ln()).sum();
        data + prior - solved.factored.log_determinant() - solved.factored.left / 2.0
    }

    /// What the library should come to: the choice and its numbers, the evidence for both coordinates, and by how much evidence the
    /// closest choice was made.
    pub fn model(&self) -> (Choice, AdaptiveModel, f64) {
        let choice = |coordinates, noise_exponent, size_exponent| Choice {
            coordinates,
            noise_exponent,
            size_exponent,
            rank: QUIET,
        };
        let (first, other) = (Coordinates::Circle, Coordinates::Height);
        let mut best = choice(first, 0, 0);
        let (mut model, mut own) = self.learned(&best, None);
        let mut evidence = [0.0; 2];
        evidence[first as usize] = own;
        let mut nearest = f64::INFINITY;
        let mut consider = |best: &mut Choice, next: Choice, margin: f64| {
            let (other, found) = self.learned(&next, Some(model.sizes));
            nearest = nearest.min((found - own - margin).abs());
            let seen = &mut evidence[next.coordinates as usize];
            if *seen == 0.0 || found > *seen + margin {
                *seen = found;
            }
            if found > own + margin {
                (*best, model, own) = (next, other, found);
            }
        };
        if self.samples.len() >= FEW {
            consider(&mut best, choice(other, 0, 0), 0.0);
            let grades = || self.samples.iter().map(|sample| self.grade(sample)).collect();
            if quantile(grades(), 0.95) > 2.0 * quantile(grades(), 0.05) {
                for (noise, size) in [(1, 0), (2, 0), (1, 1)] {
                    let next = choice(best.coordinates, noise, size);
                    consider(&mut best, next, 0.0);
                }
                let turned = if best.coordinates == first { other } else { first };
                let next = choice(turned, best.noise_exponent, best.size_exponent);
                consider(&mut best, next, 0.0);
            }
            let next = Choice { rank: LOUD, ..best };
            consider(&mut best, next, 20.0);
            if best == next {
                let turned = if best.coordinates == first { other } else { first };
                consider(&mut best, Choice { coordinates: turned, ..next }, 0.0);
            }
        }
        (best, AdaptiveModel { evidence, sample: self.samples.len() as u32, ..model }, nearest)
    }
}

fn inverse(numbers: &[f64]) -> Vec<f64> {
    numbers.iter().map(|x| 1.0 / x).collect()
}

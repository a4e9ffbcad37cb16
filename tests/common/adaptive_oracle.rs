//! The oracle of adaptive jets: from the definitions, sharing no code with the library.
//!
//! One vertex at a time. Each fit is one stacked problem of least squares, a row for every point and one for every coefficient
//! with a prior, solved by reflections; tangents are others than the library's, and curvatures are the eigenvalues of
//! `I^(−½) II I^(−½)`.
//!
//! Every decision notes how far from its threshold it was: an answer whose `nearest` is tiny may as well have gone the other way.

use super::answer::Answer;
use super::householder::{Factored, factored, least_independent};
use super::linear::{faces_of, tangents};
use super::mesh::Mesh;
use super::oracle::{Oracle, cleaned};
use super::{Vector, add, dot, length, scale, sub, unit};
use umbilic::{AdaptiveModel, Coordinates, Weight};

/// The degree of each of the 15 coefficients, and the binomial that goes with it.
const TERMS: [(usize, f64); 15] = [
    (0, 1.0),
    (1, 1.0),
    (1, 1.0),
    (2, 1.0),
    (2, 2.0),
    (2, 1.0),
    (3, 1.0),
    (3, 3.0),
    (3, 3.0),
    (3, 1.0),
    (4, 1.0),
    (4, 4.0),
    (4, 6.0),
    (4, 4.0),
    (4, 1.0),
];

/// How near decisions came to going the other way, in parts of their thresholds.
#[derive(Clone, Copy, Debug)]
pub struct Decisions {
    pub nearest: f64,
}

impl Decisions {
    pub fn new() -> Self {
        Decisions { nearest: f64::INFINITY }
    }
    pub fn below(&mut self, x: f64, threshold: f64) -> bool {
        self.nearest = self.nearest.min((x / threshold - 1.0).abs());
        x < threshold
    }
}

/// What the one-ring of a vertex is like.
#[derive(Clone, Copy, Debug)]
pub struct Around {
    /// Max's normal, zero where there is none.
    pub normal: Vector,
    /// The mean over its faces of the mean length of the face's two edges there.
    pub length: f64,
    /// Whether a face is more than 37° from the normal.
    pub sharp: bool,
    /// Whether the end of an edge is a spike.
    pub beside_spike: bool,
    /// Whether the vertex stands out of the mean of its neighbours by more than 0.85 edge lengths.
    pub spike: bool,
    pub nearest: f64,
}

impl Around {
    /// What is sharp because of a spike is no crease.
    fn may_be_creased(&self) -> bool {
        self.sharp && !self.spike && !self.beside_spike
    }
}

/// A neighbour in the frame of a vertex, in units of the vertex's mean edge length.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    pub vertex: usize,
    /// 0 for the vertex itself.
    pub ring: usize,
    pub u: f64,
    pub v: f64,
    pub w: f64,
}

/// A vertex with its points.
pub struct Framed {
    pub vertex: usize,
    /// Tangents and normal.
    pub axes: [Vector; 3],
    /// The slopes of Max's normal.
    pub slopes: [f64; 2],
    /// The vertex itself first.
    pub points: Vec<Point>,
    pub decisions: Decisions,
}

/// The numbers with which a vertex is fitted, in units of its mean edge length.
pub struct Priors {
    pub coordinates: Coordinates,
    /// The noise of each point.
    pub noise: Vec<f64>,
    /// `τ₂ … τ₅`
    pub sizes: [f64; 4],
}

/// The oracle's answer at a vertex.
#[derive(Clone, Debug)]
pub struct Expected {
    pub normal: Vector,
    pub answer: Answer,
    pub freedom: f64,
    /// That of the stacked problem.
    pub squared_condition: f64,
    /// Whether a face is far from the normal, and whether besides no smooth surface goes with the model: then only the normal is
    /// of use.
    pub sharp: bool,
    pub crease: bool,
    /// Whether the fit was repeated, and whether more noise was then added.
    pub repeated: bool,
    pub noisier: bool,
    pub nearest: f64,
}

pub struct AdaptiveOracle<'a> {
    mesh: &'a Mesh,
    oracle: Oracle<'a>,
    clean: Mesh,
    faces_of: Vec<Vec<usize>>,
    pub around: Vec<Around>,
}

impl<'a> AdaptiveOracle<'a> {
    pub fn new(mesh: &'a Mesh) -> Self {
        let oracle = Oracle::new(mesh);
        let clean = mesh.with_faces(mesh.faces().map(cleaned).filter(|face| !face.is_empty()).collect());
        let faces_of = faces_of(&clean);
        let count = mesh.positions.len();
        let mut found = AdaptiveOracle { mesh, oracle, clean, faces_of, around: vec![] };
        found.around = (0..count).map(|vertex| found.look(vertex)).collect();
        let spikes: Vec<Around> = found.around.clone();
        for vertex in 0..count {
            for (neighbour, _) in found.rings_of(vertex, 1) {
                let shares_edge =
                    found.oracle.corners(vertex).iter().any(|c| [c.next, c.prev].contains(&(neighbour as u32)));
                found.around[vertex].nearest = found.around[vertex].nearest.min(spikes[neighbour].nearest);
                found.around[vertex].beside_spike |= spikes[neighbour].spike && shares_edge;
            }
        }
        found
    }

    fn look(&self, vertex: usize) -> Around {
        let mut decisions = Decisions::new();
        let max = self.oracle.normal(vertex, Weight::Max);
        if max.condition > 1e7 {
            // Rounding has made it up.
            decisions.nearest = 0.0;
        }
        let (mut lengths, mut heights, mut sharp, mut count) = (0.0, 0.0, false, 0.0);
        for corner in self.oracle.corners(vertex) {
            let (a, b, _, normal, _) = self.oracle.measure(vertex, corner);
            lengths += (length(a) + length(b)) / 2.0;
            heights += dot(max.normal, add(a, b)) / 2.0;
            count += 1.0;
            sharp |= normal != [0.0; 3] && decisions.below(dot(normal, max.normal), 0.8);
        }
        let spike = lengths > 0.0 && !decisions.below(heights.abs() / lengths, 0.85);
        let length = if count > 0.0 { lengths / count } else { 0.0 };
        Around { normal: max.normal, length, sharp, beside_spike: false, spike, nearest: decisions.nearest }
    }

    /// The vertices within so many rings with the number of their ring, by breadth; those that share a face are neighbours.
    fn rings_of(&self, vertex: usize, rings: usize) -> Vec<(usize, usize)> {
        let mut ring_of = std::collections::HashMap::from([(vertex, 0)]);
        let mut found = vec![];
        let mut outer = vec![vertex];
        for ring in 1..=rings {
            let mut next = vec![];
            for &inner in &outer {
                for &face in &self.faces_of[inner] {
                    for &corner in self.clean.face(face) {
                        ring_of.entry(corner as usize).or_insert_with(|| {
                            next.push(corner as usize);
                            ring
                        });
                    }
                }
            }
            found.extend(next.iter().map(|&vertex| (vertex, ring)));
            outer = next;
        }
        found
    }

    /// The neighbours that count, with their rings: those within 60° of the vertex's normal (at a sharp vertex all of the first
    /// ring) that are no spikes. If that leaves fewer than six points, the first ring counts whatever it is like.
    fn chosen(&self, vertex: usize, rings: usize, decisions: &mut Decisions) -> Option<Vec<(usize, usize)>> {
        let own = &self.around[vertex];
        let all = self.rings_of(vertex, rings);
        if all.len() > 255 {
            return None;
        }
        let sharp = own.may_be_creased();
        let mut kept = vec![];
        let mut simple = vec![];
        for (neighbour, ring) in all {
            let other = &self.around[neighbour];
            let far = decisions.below(dot(own.normal, other.normal), 0.5);
            decisions.nearest = decisions.nearest.min(other.nearest);
            if (!far || sharp && ring == 1) && !other.spike {
                kept.push((neighbour, ring));
            }
            if !far || ring == 1 {
                simple.push((neighbour, ring));
            }
        }
        Some(if kept.len() + 1 < 6 { simple } else { kept })
    }

    /// Whether a vertex is away from creases: nothing sharp, no spike, all of two rings on its side.
    pub fn is_clean(&self, vertex: usize) -> bool {
        let own = &self.around[vertex];
        let near = |other: usize| dot(own.normal, self.around[other].normal) >= 0.5;
        !own.sharp
            && !own.spike
            && !own.beside_spike
            && self.rings_of(vertex, 2).into_iter().all(|(other, _)| near(other))
    }

    /// The points around a vertex in its frame; none where it has no normal, or more neighbours than the library takes.
    pub fn framed(&self, vertex: usize, rings: usize) -> Option<Framed> {
        let own = &self.around[vertex];
        if own.normal == [0.0; 3] || own.length == 0.0 {
            return None;
        }
        let mut decisions = Decisions { nearest: own.nearest };
        let chosen = self.chosen(vertex, rings, &mut decisions)?;
        let relative =
            |other: usize| scale(sub(self.mesh.positions[other], self.mesh.positions[vertex]), 1.0 / own.length);
        // The quadric that finds the frame.
        let [x, y] = tangents(own.normal);
        let mut rows = vec![vec![1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]];
        for &(other, _) in chosen.iter().filter(|(_, ring)| *ring <= 2) {
            let p = relative(other);
            let (u, v, w) = (dot(p, x), dot(p, y), dot(p, own.normal));
            let root = 1.0 / (1.0 + u * u + v * v).sqrt();
            rows.push([1.0, u, v, u * u, u * v, v * v, w].map(|term| term * root).to_vec());
        }
        // A ridge of 1e-6 of the mean over all directions, with the binomials that make it the same in all of them.
        let mean_of = |power: i32, over_directions: f64| {
            rows.iter()
                .map(|row| {
                    over_directions * (row[1].powi(2) + row[2].powi(2)).powi(power) * row[0].powi(2 - 2 * power)
                })
                .sum::<f64>()
        };
        let (linear, square) = (mean_of(1, 1.0 / 2.0), mean_of(2, 3.0 / 8.0));
        for (k, size) in [mean_of(0, 1.0), linear, linear, square, square / 2.0, square].into_iter().enumerate() {
            let mut row = vec![0.0; 7];
            row[k] = (1e-6 * size).sqrt();
            rows.push(row);
        }
        let c = factored(&rows).solution();
        let bent = unit(sub(own.normal, add(scale(x, c[1]), scale(y, c[2]))));
        let normal = if decisions.below(dot(bent, own.normal), 0.8) { own.normal } else { bent };
        let [x, y] = tangents(normal);
        let place = |(other, ring): (usize, usize)| {
            let p = relative(other);
            Point { vertex: other, ring, u: dot(p, x), v: dot(p, y), w: dot(p, normal) }
        };
        let points = std::iter::once((vertex, 0)).chain(chosen).map(place).collect();
        let upright = dot(own.normal, normal).max(0.4);
        let slopes = [-dot(own.normal, x) / upright, -dot(own.normal, y) / upright];
        Some(Framed { vertex, axes: [x, y, normal], slopes, points, decisions })
    }

    /// The numbers of a model as a vertex sees them.
    pub fn priors(&self, framed: &Framed, model: &AdaptiveModel) -> Priors {
        let own = self.around[framed.vertex].length;
        let noise = |point: &Point| {
            let grade = self.around[point.vertex].length / model.edge_length;
            model.noise * grade.powi(model.noise_exponent.into()) / own
        };
        let grade = if model.size_exponent == 0 { own / model.edge_length } else { 1.0 };
        let sizes: [f64; 4] = std::array::from_fn(|index| model.sizes[index] * grade.powi(index as i32 + 1));
        // No more points than coefficients: the prior must not drown in rounding.
        let least = if framed.points.len() <= TERMS.len() { 1e-4 * sizes[0] } else { 0.0 };
        let noise = framed.points.iter().map(|point| noise(point).max(least)).collect();
        Priors { coordinates: model.coordinates, noise, sizes }
    }

    /// What the definition says of a vertex, the vertex being no crease but by what it says.
    pub fn expected(&self, vertex: usize, model: &AdaptiveModel, rings: usize) -> Option<Expected> {
        let framed = self.framed(vertex, rings)?;
        let (points, mut decisions) = (&framed.points, framed.decisions);
        let mut priors = self.priors(&framed, model);
        let mut weights: Vec<f64> = priors.variances(points).iter().map(|variance| 1.0 / variance).collect();
        let mut solved = priors.solved(&framed, &weights);
        let mut expected = Expected {
            normal: [0.0; 3],
            answer: Answer::default(),
            freedom: 0.0,
            squared_condition: 0.0,
            sharp: self.around[vertex].sharp,
            crease: false,
            repeated: false,
            noisier: false,
            nearest: 0.0,
        };

        // A smooth surface through the vertex and its first ring contradicts the model.
        let squares = priors.squares(points, &solved.c);
        let misfits: Vec<f64> = squares.iter().zip(&weights).map(|(square, weight)| square * weight).collect();
        let near: Vec<usize> = (0..points.len()).filter(|&index| points[index].ring <= 1).collect();
        let mean = |of: &[f64]| near.iter().map(|&index| of[index]).sum::<f64>() / near.len() as f64;
        let own = &self.around[vertex];
        if own.may_be_creased() {
            let (by_model, by_length) =
                (decisions.below(mean(&misfits), 20.0), decisions.below(mean(&squares), 1e-4));
            if !by_model && !by_length {
                expected.crease = true;
                expected.normal = self.crease_normal(vertex, &mut decisions);
                expected.nearest = decisions.nearest;
                return Some(expected);
            }
        }

        // A point is far off: the fit is repeated with the weights of a Student distribution.
        let worst = misfits.iter().fold(0.0f64, |worst, &misfit| worst.max(misfit));
        let others = (misfits.iter().sum::<f64>() - worst) / (points.len() as f64 - 1.0).max(1.0);
        if !decisions.below(worst, 20.0 * others.max(1.0)) {
            expected.repeated = true;
            let variances = priors.variances(points);
            for _ in 0..3 {
                let squares = priors.squares(points, &solved.c);
                weights = squares.iter().zip(&variances).map(|(square, v)| 1.0 / (v + square / 9.0)).collect();
                solved = priors.solved(&framed, &weights);
            }
            let squares = priors.squares(points, &solved.c);
            let mut undecided = Decisions::new();
            let off =
                squares.iter().zip(&variances).filter(|(square, v)| !undecided.below(*square / *v, 9.0)).count();
            // A neighbourhood that is noisier than the mesh.
            let most = 0.2 * points.len() as f64;
            expected.noisier = off as f64 > most;
            if (off as f64 - most).abs() <= 1.0 {
                decisions.nearest = decisions.nearest.min(undecided.nearest);
            }
            if expected.noisier {
                let rest = plain_variances(points)
                    .into_iter()
                    .flatten()
                    .fold(f64::INFINITY, |least, (rest, _)| least.min(rest));
                let more = if rest < f64::INFINITY { rest } else { 0.0 };
                priors.noise.iter_mut().for_each(|noise| *noise = (*noise * *noise + more).sqrt());
                weights = priors.variances(points).iter().map(|variance| 1.0 / variance).collect();
                solved = priors.solved(&framed, &weights);
            }
        }

        let squares = priors.squares(points, &solved.c);
        let weighted: f64 = squares.iter().zip(&weights).map(|(square, weight)| square * weight).sum();
        let residual = (weighted / weights.iter().sum::<f64>()).sqrt() * own.length;
        let (normal, answer) = monge(&framed.axes, &solved.c, model.coordinates, own.length);
        expected.normal = normal;
        expected.answer = Answer { residual, ..answer };
        expected.freedom = solved.freedom();
        expected.squared_condition = solved.factored.squared_condition();
        expected.nearest = decisions.nearest;
        Some(expected)
    }

    /// The mean direction of the sides of a crease: the ring is cut where neighbouring faces differ by more than 37°, and each piece
    /// has the normal of its faces by Max's weights.
    fn crease_normal(&self, vertex: usize, decisions: &mut Decisions) -> Vector {
        let mut sides = [0.0; 3];
        for (fan, closed) in self.oracle.fans(vertex) {
            let faces: Vec<(Vector, Vector)> = fan
                .iter()
                .map(|corner| {
                    let (a, b, angle, normal, _) = self.oracle.measure(vertex, corner);
                    (normal, scale(normal, angle.sin().abs() / (length(a) * length(b))))
                })
                .collect();
            let count = faces.len();
            let mut cut = |index: usize| {
                let [before, after] = [(index + count - 1) % count, index].map(|index| faces[index].0);
                let both = length(before) > 0.0 && length(after) > 0.0;
                index == 0 && !closed || both && decisions.below(dot(before, after), 0.8)
            };
            let cuts: Vec<usize> = (0..count).filter(|&index| cut(index)).collect();
            let starts = if cuts.is_empty() { vec![0] } else { cuts };
            for (place, &start) in starts.iter().enumerate() {
                let end = if place + 1 < starts.len() { starts[place + 1] } else { starts[0] + count };
                let sum = (start..end).fold([0.0; 3], |sum, index| add(sum, faces[index % count].1));
                if length(sum) > 0.0 {
                    sides = add(sides, unit(sum));
                }
            }
        }
        if decisions.below(length(sides), 0.2) { self.around[vertex].normal } else { unit(sides) }
    }
}

/// The rings of a fit that is asked for none: 1.6 times as far as to where what a polynomial leaves out is as large as the noise,
/// but 3 to 6.
pub fn rings_by_itself(model: &AdaptiveModel) -> usize {
    let as_large = (model.noise / model.edge_length / model.sizes[3]).powf(0.2);
    (1.6 * as_large).ceil().clamp(3.0, 6.0) as usize
}

/// `u^d, u^(d−1) v … v^d` for each degree.
fn monomials(u: f64, v: f64, degree: i32) -> Vec<f64> {
    (0..=degree).flat_map(|d| (0..=d).map(move |place| u.powi(d - place) * v.powi(place))).collect()
}

/// The variance that plain jets leave of the points, and how many more points than coefficients they have: degrees 4 and 3 over two
/// rings, 4 over three; none where they have no more, or do not tell these apart.
pub fn plain_variances(points: &[Point]) -> [Option<(f64, f64)>; 3] {
    [(4, 2), (3, 2), (4, 3)].map(|(degree, rings)| {
        let inside = points.iter().filter(|point| point.ring <= rings);
        let rows: Vec<Vec<f64>> =
            inside.map(|&Point { u, v, w, .. }| monomials(u, v, degree).into_iter().chain([w]).collect()).collect();
        let unknowns = rows[0].len() - 1;
        let told_apart = rows.len() > unknowns && least_independent(&rows) > 0.5f64.powi(16);
        told_apart.then(|| {
            let freedom = (rows.len() - unknowns) as f64;
            (factored(&rows).left / freedom, freedom)
        })
    })
}

/// The most probable coefficients.
pub struct Solved {
    pub c: Vec<f64>,
    pub factored: Factored,
    rows: Vec<Vec<f64>>,
    /// How many of them are data.
    data: usize,
}

impl Solved {
    /// The trace of the matrix that takes heights to fitted heights.
    pub fn freedom(&self) -> f64 {
        self.rows[..self.data].iter().map(|row| self.factored.leverage(&row[..TERMS.len()])).sum()
    }
}

impl Priors {
    /// The values of all terms at a point, and `ρ²`.
    fn terms(&self, point: &Point) -> (Vec<f64>, f64) {
        let &Point { u, v, w, .. } = point;
        let flat = u * u + v * v;
        let (stretch, squared) = match self.coordinates {
            Coordinates::Height => (1.0, flat),
            Coordinates::Circle => {
                let squared = flat + w * w;
                (if flat > 1e-20 { (squared / flat).sqrt() } else { 1.0 }, squared)
            }
        };
        let mut terms = monomials(stretch * u, stretch * v, 4);
        (terms[1], terms[2]) = (u, v);
        (terms, squared)
    }

    /// `σ² + τ₅² ρ¹⁰`
    pub fn variances(&self, points: &[Point]) -> Vec<f64> {
        let variance =
            |(point, noise): (&Point, &f64)| noise * noise + self.sizes[3].powi(2) * self.terms(point).1.powi(5);
        points.iter().zip(&self.noise).map(variance).collect()
    }

    /// The squares of what the polynomial leaves of each point.
    fn squares(&self, points: &[Point], c: &[f64]) -> Vec<f64> {
        let left = |point: &Point| point.w - self.terms(point).0.iter().zip(c).map(|(t, c)| t * c).sum::<f64>();
        points.iter().map(|point| left(point).powi(2)).collect()
    }

    /// `1/σ` of the prior of each coefficient; none for the constant.
    pub fn roots(&self, points: usize) -> [f64; 15] {
        std::array::from_fn(|term| match TERMS[term] {
            (0, _) => 0.0,
            // About the slopes of Max's normal, which is as good as a few points are.
            (1, _) => {
                if points <= 8 {
                    1.0 / 0.1
                } else {
                    1.0 / 0.2
                }
            }
            (degree, binomial) => 1.0 / (self.sizes[degree - 2] * f64::sqrt(binomial)),
        })
    }

    pub fn solved(&self, framed: &Framed, weights: &[f64]) -> Solved {
        let points = &framed.points;
        let data = |(point, weight): (&Point, &f64)| -> Vec<f64> {
            self.terms(point).0.into_iter().chain([point.w]).map(|term| term * weight.sqrt()).collect()
        };
        let mut rows: Vec<Vec<f64>> = points.iter().zip(weights).map(data).collect();
        let data = rows.len();
        let roots = self.roots(points.len());
        rows.extend((1..TERMS.len()).map(|term| {
            let mut row = vec![0.0; TERMS.len() + 1];
            row[term] = roots[term];
            if term < 3 {
                row[TERMS.len()] = roots[term] * framed.slopes[term - 1];
            }
            row
        }));
        let factored = factored(&rows);
        Solved { c: factored.solution(), factored, rows, data }
    }
}

/// The sums over the coefficients of degrees 2, 3 and 4 of a number of each by its binomial.
pub fn by_degree(numbers: impl Fn(usize) -> f64) -> [f64; 3] {
    let sum = |degree: usize| {
        (0..TERMS.len()).filter(|&term| TERMS[term].0 == degree).map(|term| numbers(term) / TERMS[term].1).sum()
    };
    [2, 3, 4].map(sum)
}

/// Normal and curvatures of a surface with these coefficients, whose unit of length is `length`.
///
/// The axes of the frame become tangents by the root of the first fundamental form, which takes them to the nearest pair that is
/// perpendicular. Of a height field the shape operator in these is `I^(−½) II I^(−½)`. In circles, the curve in the direction `t` of
/// the frame's plane has the normal curvature `2 Q(t, t)/w` whatever its slope, and that is the shape operator.
pub fn monge([x, y, normal]: &[Vector; 3], c: &[f64], coordinates: Coordinates, length: f64) -> (Vector, Answer) {
    let (p, q) = (c[1], c[2]);
    let (slope, w) = (p.hypot(q), (1.0 + p * p + q * q).sqrt());
    // I is 1 across the slope and w² along it.
    let (cos, sin) = if slope > 0.0 { (p / slope, q / slope) } else { (1.0, 0.0) };
    let less = 1.0 / w - 1.0;
    let root = [[1.0 + less * cos * cos, less * cos * sin], [less * cos * sin, 1.0 + less * sin * sin]];
    let second = [[-2.0 * c[3] / w, -c[4] / w], [-c[4] / w, -2.0 * c[5] / w]];
    let sandwiched = |i: usize, j: usize| {
        (0..2).flat_map(|k| (0..2).map(move |l| (k, l))).map(|(k, l)| root[i][k] * second[k][l] * root[l][j]).sum()
    };
    let entry = |i: usize, j: usize| match coordinates {
        Coordinates::Height => sandwiched(i, j),
        Coordinates::Circle => second[i][j],
    };
    let along = [add(*x, scale(*normal, p)), add(*y, scale(*normal, q))];
    let tangent = |i: usize| add(scale(along[0], root[0][i]), scale(along[1], root[1][i]));
    let bent = unit(sub(*normal, add(scale(*x, p), scale(*y, q))));
    let operator = [entry(0, 0), entry(0, 1), entry(1, 1)].map(|k: f64| k / length);
    (bent, Answer::of_operator(bent, [tangent(0), tangent(1)], operator))
}

//! The oracle: vertex normals in plain `f64`, straight from the definitions, sharing no code with the library.
//!
//! Rings are found by hashing, angles by the host's `atan2`, tangents by its `tan`; nothing is scaled.

use super::mesh::Mesh;
use super::{Vector, add, cross, dot, largest_difference, length, scale, sub, unit};
use std::collections::HashMap;
use umbilic::Weight;

/// The corner of a face at a vertex.
#[derive(Clone, Debug)]
pub struct Corner {
    pub next: u32,
    pub prev: u32,
    pub face: usize,
}

/// An oracle's answer at a vertex.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// Unit normal; zero where there is none.
    pub normal: Vector,
    /// The sum it comes from.
    pub sum: Vector,
    /// By how much rounding errors of the input differences may grow: `√(Σ |term|² / sin² θ) / |sum|` over the terms of
    /// the sum, θ the smaller of the angles that made the term's face normals. Infinite where there is no sum.
    pub condition: f64,
}

/// A face without repetitions of a vertex in a row; none if fewer than three corners remain.
pub fn cleaned(face: &[u32]) -> Vec<u32> {
    let mut face = face.to_vec();
    face.dedup();
    while face.len() > 1 && face.first() == face.last() {
        face.pop();
    }
    if face.len() < 3 { vec![] } else { face }
}

pub struct Oracle<'a> {
    mesh: &'a Mesh,
    faces: Vec<Vec<u32>>,
    corners: Vec<Vec<Corner>>,
}

impl<'a> Oracle<'a> {
    pub fn new(mesh: &'a Mesh) -> Self {
        let faces: Vec<Vec<u32>> = mesh.faces().map(cleaned).collect();
        let mut corners = vec![vec![]; mesh.positions.len()];
        for (index, face) in faces.iter().enumerate() {
            for (place, &vertex) in face.iter().enumerate() {
                let next = face[(place + 1) % face.len()];
                let prev = face[(place + face.len() - 1) % face.len()];
                corners[vertex as usize].push(Corner { next, prev, face: index });
            }
        }
        Oracle { mesh, faces, corners }
    }

    /// The corners of a face, without repetitions.
    pub fn face(&self, face: usize) -> &[u32] {
        &self.faces[face]
    }

    pub fn corners(&self, vertex: usize) -> &[Corner] {
        &self.corners[vertex]
    }

    fn point(&self, vertex: u32) -> Vector {
        self.mesh.positions[vertex as usize]
    }

    /// `½ Σ (pₖ − p₀) × (pₖ₊₁ − p₀)`
    pub fn area_vector(&self, face: usize) -> Vector {
        let face = &self.faces[face];
        let relative = |index: usize| sub(self.point(face[index]), self.point(face[0]));
        let sum = (1..face.len().max(1) - 1).fold([0.0; 3], |sum, k| add(sum, cross(relative(k), relative(k + 1))));
        scale(sum, 0.5)
    }

    /// The centroid of the face's area, from `vertex`: of the fan of triangles around the mean of its corners, each
    /// counted by its signed area; the mean where there is no more to a face than three corners.
    fn centroid(&self, face: usize, vertex: usize) -> Vector {
        let area_vector = self.area_vector(face);
        let face = &self.faces[face];
        let relative = |index: usize| sub(self.point(face[index % face.len()]), self.mesh.positions[vertex]);
        let mean = scale((0..face.len()).fold([0.0; 3], |sum, k| add(sum, relative(k))), 1.0 / face.len() as f64);
        if face.len() == 3 {
            return mean;
        }
        // Sum of signed areas times triangle centroids, divided by the whole area, which the area vector knows.
        let whole = dot(area_vector, area_vector);
        (0..face.len()).fold([0.0; 3], |sum, k| {
            let share = dot(area_vector, cross(sub(relative(k), mean), sub(relative(k + 1), mean))) / 2.0 / whole;
            add(sum, scale(add(add(relative(k), relative(k + 1)), mean), share / 3.0))
        })
    }

    /// Both edges, the interior angle, the unit normal of the face, and its area.
    pub fn measure(&self, vertex: usize, corner: &Corner) -> (Vector, Vector, f64, Vector, f64) {
        let centre = self.mesh.positions[vertex];
        let (a, b) = (sub(self.point(corner.next), centre), sub(self.point(corner.prev), centre));
        let area_vector = self.area_vector(corner.face);
        let area = length(area_vector);
        let normal = if area > 0.0 { scale(area_vector, 1.0 / area) } else { [0.0; 3] };
        let turned = cross(a, b);
        let mut angle = length(turned).atan2(dot(a, b));
        if dot(turned, normal) < 0.0 && self.faces[corner.face].len() > 3 {
            angle = 2.0 * std::f64::consts::PI - angle;
        }
        (a, b, angle, normal, area)
    }

    /// The corners of a vertex as fans, counter-clockwise; and whether each is closed.
    pub fn fans(&self, vertex: usize) -> Vec<(Vec<Corner>, bool)> {
        let corners = &self.corners[vertex];
        let mut starting: HashMap<u32, Vec<usize>> = HashMap::new();
        let mut ending: HashMap<u32, Vec<usize>> = HashMap::new();
        for (index, corner) in corners.iter().enumerate() {
            starting.entry(corner.next).or_default().push(index);
            ending.entry(corner.prev).or_default().push(index);
        }
        let joined = |edge: u32| match (starting.get(&edge), ending.get(&edge)) {
            (Some(after), Some(before)) if after.len() == 1 && before.len() == 1 => Some((before[0], after[0])),
            _ => None,
        };
        let mut visited = vec![false; corners.len()];
        let mut fans = vec![];
        let opens = |index: usize| joined(corners[index].next).is_none();
        let order = (0..corners.len()).filter(|&i| opens(i)).chain((0..corners.len()).filter(|&i| !opens(i)));
        for start in order {
            let (mut fan, mut current) = (vec![], Some(start));
            while let Some(index) = current.filter(|&index| !visited[index]) {
                visited[index] = true;
                fan.push(corners[index].clone());
                current = joined(corners[index].prev).map(|(_, after)| after);
            }
            if !fan.is_empty() {
                fans.push((fan, !opens(start)));
            }
        }
        fans
    }

    pub fn normal(&self, vertex: usize, weight: Weight) -> Answer {
        let (sum, spread) =
            if weight == Weight::Conformal { self.conformal(vertex) } else { self.weighted(vertex, weight) };
        let size = length(sum);
        if size > 0.0 {
            Answer { normal: scale(sum, 1.0 / size), sum, condition: spread.sqrt() / size }
        } else {
            Answer { normal: [0.0; 3], sum, condition: f64::INFINITY }
        }
    }

    fn weighted(&self, vertex: usize, weight: Weight) -> (Vector, f64) {
        let (mut sum, mut spread) = ([0.0; 3], 0.0);
        for corner in &self.corners[vertex] {
            let (a, b, angle, normal, area) = self.measure(vertex, corner);
            if area == 0.0 {
                continue;
            }
            let (la, lb) = (length(a), length(b));
            let sine = angle.sin().abs();
            let sine_product = length(cross(a, b));
            let value = match weight {
                Weight::Uniform => 1.0,
                Weight::Angle => angle,
                Weight::Area => area,
                Weight::Max => sine_product / (la * la * lb * lb),
                Weight::CentroidArea => area / length(self.centroid(corner.face, vertex)),
                Weight::Centroid => 1.0 / dot(self.centroid(corner.face, vertex), self.centroid(corner.face, vertex)),
                Weight::InverseRootEdges => 1.0 / (la * lb).sqrt(),
                Weight::Sine => sine_product / (la * lb),
                Weight::AngleEdges => angle * la * lb,
                other => panic!("no oracle for {other:?}"),
            };
            sum = add(sum, scale(normal, value));
            spread += (value / self.sharpness(corner, sine)).powi(2);
        }
        (sum, spread)
    }

    /// How well a face's normal is determined: the sine at the corner for triangles, at best for polygons.
    fn sharpness(&self, corner: &Corner, sine: f64) -> f64 {
        let face = &self.faces[corner.face];
        if face.len() == 3 {
            return sine;
        }
        let longest =
            face.iter().fold(0.0, |longest: f64, &p| longest.max(length(sub(self.point(p), self.point(face[0])))));
        length(self.area_vector(corner.face)) / (longest * longest)
    }

    fn conformal(&self, vertex: usize) -> (Vector, f64) {
        let (mut all, mut all_spread) = ([0.0; 3], 0.0);
        for (fan, closed) in self.fans(vertex) {
            let measured: Vec<_> = fan.iter().map(|corner| self.measure(vertex, corner)).collect();
            let sharp: Vec<f64> =
                fan.iter().zip(&measured).map(|(corner, m)| self.sharpness(corner, m.2.sin().abs())).collect();
            let cone: f64 = measured.iter().map(|m| m.2).sum();
            let flat: Vec<f64> = measured
                .iter()
                .map(|m| if closed && cone > 0.0 { 2.0 * std::f64::consts::PI * m.2 / cone } else { m.2 })
                .map(|alpha| alpha.min(std::f64::consts::PI * (1.0 - 0.5f64.powi(20))))
                .collect();
            let count = fan.len();
            let (mut sum, mut total, mut spread) = ([0.0; 3], 0.0, 0.0);
            for edge in 0..count + !closed as usize {
                // The corners on either side of edge `edge`, which is the first edge of corner `edge`.
                let after = (edge < count).then_some(edge);
                let before = if edge > 0 { Some(edge - 1) } else { closed.then_some(count - 1) };
                let tangent = |corner: Option<usize>| corner.map_or(0.0, |c| (flat[c] / 2.0).tan());
                let normal = |corner: Option<usize>| corner.map_or([0.0; 3], |c| measured[c].3);
                let vector = match after {
                    Some(corner) => measured[corner].0,
                    None => measured[count - 1].1,
                };
                let both = add(normal(before), normal(after));
                if length(vector) == 0.0 || length(both) < 1e-12 {
                    continue;
                }
                let omega = (tangent(before) + tangent(after)) / length(vector);
                sum = add(sum, scale(unit(both), omega));
                total += omega;
                let blur = [before, after].into_iter().flatten().map(|c| sharp[c].powi(-2)).sum::<f64>();
                spread += (omega / length(both)).powi(2) * blur;
            }
            if total > 0.0 {
                all = add(all, scale(sum, 1.0 / total));
                all_spread += spread / (total * total);
            }
        }
        (all, all_spread)
    }
}

/// The largest difference between two normals' components, and the vertex where it is, over the vertices that `keep`
/// lets through.
pub fn worst(found: &[Vector], expected: impl Fn(usize) -> Vector, keep: impl Fn(usize) -> bool) -> (f64, usize) {
    (0..found.len()).filter(|&vertex| keep(vertex)).fold((0.0, 0), |worst, vertex| {
        let difference = largest_difference(found[vertex], expected(vertex));
        if difference > worst.0 || difference.is_nan() { (difference, vertex) } else { worst }
    })
}

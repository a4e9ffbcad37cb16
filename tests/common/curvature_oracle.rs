//! The oracle: curvatures in plain `f64`, straight from the definitions, sharing no code with the library.
//!
//! Vertex normals are taken as given (those of the library have an oracle of their own). Shape operators are tensors in
//! space, nothing is scaled.

use super::answer::{Answer, Tensor, outer, plus};
use super::linear::{faces_of, least_squares, neighbourhood, tangents, times};
use super::mesh::Mesh;
use super::oracle::{Corner, Oracle, cleaned};
use super::{Vector, add, cross, dot, length, scale, sub, unit};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::f64::consts::{PI, TAU};
use umbilic::capi::*;

/// Where a measure is taken.
#[derive(Clone, Copy, Debug)]
pub enum Region {
    Rings(usize),
    Ball(f64),
}

/// Integrals over a cell.
#[derive(Clone, Copy, Default)]
struct Cell {
    area: f64,
    mean: f64,
    gaussian: f64,
    tensor: Tensor,
    ambiguous: bool,
}

pub struct CurvatureOracle<'a> {
    mesh: &'a Mesh,
    oracle: Oracle<'a>,
    /// The faces that are not ignored, and those of each vertex.
    clean: Mesh,
    faces_of: Vec<Vec<usize>>,
    normals: &'a [Vector],
    /// Those that have been asked for.
    cells: RefCell<HashMap<usize, Cell>>,
}

impl<'a> CurvatureOracle<'a> {
    /// With unit vertex normals, or zeros.
    pub fn new(mesh: &'a Mesh, normals: &'a [Vector]) -> Self {
        let clean = mesh.with_faces(mesh.faces().map(cleaned).filter(|face| !face.is_empty()).collect());
        let faces_of = faces_of(&clean);
        CurvatureOracle { mesh, oracle: Oracle::new(mesh), clean, faces_of, normals, cells: RefCell::default() }
    }

    fn edge(&self, from: usize, to: usize) -> Vector {
        sub(self.mesh.positions[to], self.mesh.positions[from])
    }

    /// The edges of the ring, fan by fan, with the sums over the (one or two) faces of the fan at each of the area and of
    /// the angle at the vertex.
    fn ring(&self, vertex: usize) -> Vec<(Vector, f64, f64)> {
        let mut edges = vec![];
        for (fan, closed) in self.oracle.fans(vertex) {
            let measured: Vec<_> = fan.iter().map(|corner| self.oracle.measure(vertex, corner)).collect();
            let count = fan.len();
            for index in 0..count + !closed as usize {
                let before = if index > 0 { Some(index - 1) } else { closed.then_some(count - 1) };
                let sides = [before, (index < count).then_some(index)];
                let sum = |f: &dyn Fn(usize) -> f64| sides.into_iter().flatten().map(f).sum::<f64>();
                let edge = if index < count { measured[index].0 } else { measured[count - 1].1 };
                edges.push((edge, sum(&|i| measured[i].4), sum(&|i| measured[i].2)));
            }
        }
        edges
    }

    /// The sections along the ring's edges: unit tangents, curvatures, areas, angles.
    fn sections(&self, vertex: usize, section: umb_section) -> Vec<(Vector, f64, f64, f64)> {
        let normal = self.normals[vertex];
        let section = |(x, area, angle): (Vector, f64, f64)| {
            let height = dot(normal, x);
            let tangential = sub(x, scale(normal, height));
            let divisor = if section == UMB_SECTION_CIRCLE { dot(x, x) } else { dot(tangential, tangential) };
            (dot(tangential, tangential) > 0.0).then(|| (unit(tangential), -2.0 * height / divisor, area, angle))
        };
        self.ring(vertex).into_iter().filter_map(section).collect()
    }

    pub fn least_squares(&self, vertex: usize, section: umb_section) -> Option<Answer> {
        let normal = self.normals[vertex];
        let [x, y] = tangents(normal);
        let row = |&(t, k, ..): &(Vector, f64, f64, f64)| {
            let (c, s) = (dot(t, x), dot(t, y));
            vec![c * c, 2.0 * c * s, s * s, k]
        };
        let rows: Vec<Vec<f64>> = self.sections(vertex, section).iter().map(row).collect();
        let u = self.determined_part(&rows).or_else(|| least_squares(&rows))?;
        let left = rows.iter().map(|r| (r[3] - r[0] * u[0] - r[1] * u[1] - r[2] * u[2]).powi(2)).sum::<f64>();
        let residual = (left / rows.len() as f64).sqrt();
        Some(Answer { residual, ..Answer::of_operator(normal, [x, y], [u[0], u[1], u[2]]) })
    }

    /// What stands for the least-squares solution where the edges hardly tell a part of `κ = H + p cos 2φ + q sin 2φ` apart:
    /// that part is left out, and the rest is a regression on the one direction, or none, that they do tell apart.
    fn determined_part(&self, rows: &[Vec<f64>]) -> Option<Vec<f64>> {
        let doubled: Vec<[f64; 3]> = rows.iter().map(|r| [r[0] - r[2], r[1], r[3]]).collect();
        let mean = |f: &dyn Fn(&[f64; 3]) -> f64| doubled.iter().map(f).sum::<f64>() / doubled.len() as f64;
        let centre: [f64; 3] = std::array::from_fn(|i| mean(&|r| r[i]));
        let moment = |i: usize, j: usize| mean(&|r| (r[i] - centre[i]) * (r[j] - centre[j]));
        let (a, b, d) = (moment(0, 0), moment(0, 1), moment(1, 1));
        let spread = ((a - d) / 2.0).hypot(b);
        let [small, large] = [(a + d) / 2.0 - spread, (a + d) / 2.0 + spread];
        if rows.is_empty() || small > 0.001 {
            return None;
        }
        let axis = 0.5 * (2.0 * b).atan2(a - d);
        let slope = (axis.cos() * moment(0, 2) + axis.sin() * moment(1, 2)) / large;
        let (p, q) = if large > 0.001 { (slope * axis.cos(), slope * axis.sin()) } else { (0.0, 0.0) };
        let height = centre[2] - p * centre[0] - q * centre[1];
        Some(vec![height + p, q, height - p])
    }

    pub fn taubin(&self, vertex: usize, section: umb_section) -> Option<Answer> {
        let sections = self.sections(vertex, section);
        let total: f64 = sections.iter().map(|s| s.2).sum();
        let sum = |m, &(t, k, area, _): &(Vector, f64, f64, f64)| plus(m, outer(t, t, area / total * k));
        let [x, y] = tangents(self.normals[vertex]);
        let m = sections.iter().fold(Tensor::default(), sum);
        let [xx, xy, yy] = [(x, x), (x, y), (y, y)].map(|(a, b)| dot(a, times(&m, b)));
        // In the eigenvectors of M, k1 = 3 m1 − m2 and k2 = 3 m2 − m1.
        let operator = [3.0 * xx - yy, 4.0 * xy, 3.0 * yy - xx];
        (total > 0.0).then(|| Answer::of_operator(self.normals[vertex], [x, y], operator))
    }

    pub fn watanabe(&self, vertex: usize, section: umb_section) -> Option<Answer> {
        let sections = self.sections(vertex, section);
        let total: f64 = sections.iter().map(|s| s.3).sum();
        let mean = sections.iter().map(|s| s.1 * s.3).sum::<f64>() / total;
        let squared = sections.iter().map(|s| s.1 * s.1 * s.3).sum::<f64>() / total;
        let gaussian = 3.0 * mean * mean - 2.0 * squared;
        (total > 0.0).then(|| Answer::of_mean_and_gaussian(self.normals[vertex], mean, gaussian))
    }

    /// Meyer's part of a triangle, an equal share of a polygon.
    fn mixed_area(&self, vertex: usize, corner: &Corner) -> f64 {
        let (a, b, angle, _, area) = self.oracle.measure(vertex, corner);
        let count = self.oracle.face(corner.face).len();
        if count > 3 {
            return area / count as f64;
        }
        let far = |at: Vector, other: Vector| dot(scale(at, -1.0), sub(other, at));
        if angle > PI / 2.0 {
            area / 2.0
        } else if far(a, b) < 0.0 || far(b, a) < 0.0 {
            area / 4.0
        } else {
            let cotangent = |at: Vector, other: Vector| far(at, other) / length(cross(at, other));
            if area == 0.0 { 0.0 } else { (dot(a, a) * cotangent(b, a) + dot(b, b) * cotangent(a, b)) / 8.0 }
        }
    }

    /// The angle defect: a polygon's angles are made to sum up to `(n − 2) π` by an equal part of what they lack.
    fn defect(&self, vertex: usize) -> f64 {
        let angle = |corner: &Corner| {
            let face = self.oracle.face(corner.face);
            let lack = if face.len() == 3 {
                0.0
            } else {
                let at = |place: usize| {
                    let (next, prev) = (face[(place + 1) % face.len()], face[(place + face.len() - 1) % face.len()]);
                    let corner = Corner { next, prev, face: corner.face };
                    self.oracle.measure(face[place] as usize, &corner).2
                };
                ((face.len() - 2) as f64 * PI - (0..face.len()).map(at).sum::<f64>()) / face.len() as f64
            };
            self.oracle.measure(vertex, corner).2 + lack
        };
        let fan = |(fan, closed): &(Vec<Corner>, bool)| {
            (if *closed { TAU } else { PI }) - fan.iter().map(angle).sum::<f64>()
        };
        self.oracle.fans(vertex).iter().map(fan).sum()
    }

    pub fn angle_defect(&self, vertex: usize) -> Option<Answer> {
        let area: f64 = self.oracle.corners(vertex).iter().map(|corner| self.mixed_area(vertex, corner)).sum();
        let defect = self.defect(vertex);
        (area > 0.0).then(|| Answer {
            gaussian: defect / area,
            area,
            integrated_gaussian: defect,
            ..Answer::default()
        })
    }

    /// Equation 8: `½ Σ (cot α + cot β)(V − Vᵢ) / 2A`, a triangle's two cotangents with the edges opposite to them.
    pub fn meyer(&self, vertex: usize) -> Option<Answer> {
        let whole = self.angle_defect(vertex)?;
        let mut gradient = [0.0; 3];
        for corner in self.oracle.corners(vertex) {
            let (a, b, _, normal, area) = self.oracle.measure(vertex, corner);
            if area == 0.0 {
                continue;
            }
            let term = if self.oracle.face(corner.face).len() == 3 {
                let cotangent = |at: Vector, other: Vector| dot(at, sub(at, other)) / length(cross(at, other));
                scale(add(scale(a, cotangent(b, a)), scale(b, cotangent(a, b))), -0.5)
            } else {
                scale(cross(sub(a, b), normal), 0.5)
            };
            gradient = add(gradient, term);
        }
        let mean_normal = scale(gradient, 0.5 / whole.area);
        let mean = length(mean_normal) * if dot(gradient, self.normals[vertex]) < 0.0 { -1.0 } else { 1.0 };
        let values = Answer::of_mean_and_gaussian(self.normals[vertex], mean, whole.gaussian);
        let Answer { area, integrated_gaussian, .. } = whole;
        // At the boundary of something flat the gradient lies in the tangent plane: on neither side.
        let ambiguous = dot(mean_normal, self.normals[vertex]).abs() <= 1e-9 * length(mean_normal);
        let integrated_mean = mean * area;
        Some(Answer { mean_normal, area, integrated_mean, integrated_gaussian, ambiguous, ..values })
    }

    /// A polygon's mean of corners and of their normals.
    fn middle(&self, face: usize) -> (Vector, Vector) {
        let face = self.oracle.face(face);
        let mean = |values: &[Vector]| {
            scale(face.iter().fold([0.0; 3], |sum, &v| add(sum, values[v as usize])), 1.0 / face.len() as f64)
        };
        (mean(&self.mesh.positions), mean(self.normals))
    }

    pub fn rusinkiewicz(&self, vertex: usize) -> Option<Answer> {
        let own = self.normals[vertex];
        let (mut tensor, mut total, mut narrow) = (Tensor::default(), 0.0, 0.0f64);
        for corner in self.oracle.corners(vertex) {
            let (a, b, _, normal, area) = self.oracle.measure(vertex, corner);
            if area == 0.0 || dot(normal, own) < -1.0 + 1e-6 {
                continue;
            }
            let [at_a, at_b] = [corner.next, corner.prev].map(|v| self.normals[v as usize]);
            let mut edges = vec![(a, sub(at_a, own)), (b, sub(at_b, own)), (sub(b, a), sub(at_b, at_a))];
            if self.oracle.face(corner.face).len() > 3 {
                let (centre, mean) = self.middle(corner.face);
                edges.push((sub(centre, self.mesh.positions[vertex]), sub(mean, own)));
            }
            let [x, y] = tangents(normal);
            let mut rows = vec![];
            for (edge, turn) in edges {
                let (u, v) = (dot(edge, x), dot(edge, y));
                rows.push(vec![u, v, 0.0, dot(turn, x)]);
                rows.push(vec![0.0, u, v, dot(turn, y)]);
            }
            let size = length(a).max(length(b));
            rows.iter_mut().flatten().for_each(|x| *x /= size);
            let Some(s) = least_squares(&rows) else { continue };
            // The face's tangents after the shortest rotation from its normal to the vertex's (Rodrigues).
            let (axis, cosine) = (cross(normal, own), dot(normal, own));
            let turned = |t: Vector| {
                let along = scale(axis, dot(axis, t) / (1.0 + cosine));
                add(add(scale(t, cosine), cross(axis, t)), along)
            };
            let (x, y) = (turned(x), turned(y));
            let weight = self.mixed_area(vertex, corner);
            let mixed = plus(outer(x, y, s[1]), outer(y, x, s[1]));
            let sum = plus(plus(outer(x, x, s[0]), outer(y, y, s[2])), mixed);
            tensor = plus(tensor, sum.map(|row| scale(row, weight)));
            total += weight;
            narrow = narrow.max((dot(a, a) + dot(b, b)).powi(2) / dot(cross(a, b), cross(a, b)));
        }
        let values = Answer::of_tensor(own, tensor.map(|row| scale(row, 1.0 / total)));
        (total > 0.0).then_some(Answer { narrow, ..values })
    }

    /// The barycentric cell of the vertex: normal cycle.
    fn cycle_cell(&self, vertex: usize) -> Cell {
        let mut cell = Cell::default();
        for (fan, closed) in self.oracle.fans(vertex) {
            for (index, corner) in fan.iter().enumerate() {
                let (edge, _, _, after, area) = self.oracle.measure(vertex, corner);
                cell.area += area / self.oracle.face(corner.face).len() as f64;
                if index == 0 && !closed {
                    continue;
                }
                let before = &fan[(index + fan.len() - 1) % fan.len()];
                let before = self.oracle.measure(vertex, before).3;
                if length(edge) == 0.0 || length(before) == 0.0 || length(after) == 0.0 {
                    continue;
                }
                // The face after the edge, counter-clockwise, is on its left; where it is convex, after × before goes along.
                let angle = dot(cross(after, before), unit(edge)).atan2(dot(after, before));
                // Two faces back to back are folded either way.
                cell.ambiguous |= angle.abs() > PI - 1e-6;
                cell.mean += angle * length(edge) / 4.0;
                cell.tensor = plus(cell.tensor, outer(unit(edge), unit(edge), angle * length(edge) / 2.0));
            }
        }
        cell
    }

    /// Table 1 of the paper, for a part of a triangle.
    fn corrected_triangle(cell: &mut Cell, x: [Vector; 3], u: [Vector; 3], part: f64) {
        let mean = scale(add(add(u[0], u[1]), u[2]), 1.0 / 3.0);
        let (x1, x2) = (sub(x[1], x[0]), sub(x[2], x[0]));
        cell.area += part * dot(mean, cross(x1, x2)) / 2.0;
        let turn = add(cross(sub(u[0], u[2]), x1), cross(sub(u[1], u[0]), x2));
        cell.mean += part * dot(mean, turn) / 4.0;
        cell.gaussian += part * dot(u[0], cross(u[1], u[2])) / 2.0;
        cell.tensor = plus(cell.tensor, outer(cross(x2, mean), sub(u[1], u[0]), part / 2.0));
        cell.tensor = plus(cell.tensor, outer(cross(x1, mean), sub(u[2], u[0]), -part / 2.0));
    }

    fn corrected_cell(&self, vertex: usize) -> Cell {
        let mut cell = Cell::default();
        let at = |v: u32| (self.mesh.positions[v as usize], self.normals[v as usize]);
        for corner in self.oracle.corners(vertex) {
            let [v, a, b] = [vertex as u32, corner.next, corner.prev].map(at);
            if self.oracle.face(corner.face).len() == 3 {
                Self::corrected_triangle(&mut cell, [v.0, a.0, b.0], [v.1, a.1, b.1], 1.0 / 3.0);
            } else if length(self.oracle.area_vector(corner.face)) > 0.0 {
                let c = self.middle(corner.face);
                Self::corrected_triangle(&mut cell, [v.0, a.0, c.0], [v.1, a.1, c.1], 0.5);
                Self::corrected_triangle(&mut cell, [v.0, c.0, b.0], [v.1, c.1, b.1], 0.5);
            }
        }
        cell
    }

    /// The vertices of a region with their part in it.
    fn region(&self, vertex: usize, region: Region, cell: &dyn Fn(usize) -> Cell) -> BTreeMap<usize, f64> {
        let radius = match region {
            Region::Rings(rings) => {
                let all = neighbourhood(&self.clean, &self.faces_of, vertex, rings - 1);
                return all.into_iter().map(|v| (v, 1.0)).collect();
            }
            Region::Ball(radius) => radius,
        };
        let distance = |v: usize| length(self.edge(vertex, v));
        let (mut found, mut next) = (BTreeSet::from([vertex]), vec![vertex]);
        while let Some(v) = next.pop() {
            if distance(v) < radius {
                for corner in self.oracle.corners(v) {
                    next.extend([corner.next, corner.prev].map(|n| n as usize).iter().filter(|&&n| found.insert(n)));
                }
            }
        }
        let part = |v: usize| {
            let size = (cell(v).area.max(0.0) / PI).sqrt();
            (0.5 + (radius - distance(v)) / (2.0 * size)).clamp(0.0, 1.0)
        };
        found.into_iter().map(|v| (v, part(v))).collect()
    }

    fn measure(&self, vertex: usize, region: Region, cell: &dyn Fn(usize) -> Cell) -> Cell {
        let cell = &|v: usize| {
            let kept = self.cells.borrow().get(&v).copied();
            let found = kept.unwrap_or_else(|| cell(v));
            self.cells.borrow_mut().insert(v, found);
            found
        };
        self.region(vertex, region, cell).into_iter().fold(Cell::default(), |sum, (v, part)| {
            let other = cell(v);
            Cell {
                area: sum.area + part * other.area,
                mean: sum.mean + part * other.mean,
                gaussian: sum.gaussian + part * other.gaussian,
                tensor: plus(sum.tensor, other.tensor.map(|row| scale(row, part))),
                ambiguous: sum.ambiguous || other.ambiguous,
            }
        })
    }

    pub fn normal_cycle(&self, vertex: usize, region: Region) -> Option<Answer> {
        let cell = self.measure(vertex, region, &|v| self.cycle_cell(v));
        let along = Answer::of_tensor(self.normals[vertex], cell.tensor.map(|row| scale(row, 1.0 / cell.area)));
        // Each eigenvalue belongs to the direction of the other: trace times the projection, minus the tensor.
        let [x, y] = tangents(self.normals[vertex]);
        let plane = plus(outer(x, x, along.mean * 2.0), outer(y, y, along.mean * 2.0));
        let tensor = plus(plane, along.tensor.map(|row| scale(row, -1.0)));
        let Cell { area, mean: integrated_mean, ambiguous, .. } = cell;
        let known = Answer { area, integrated_mean, tensor, ambiguous, ..along };
        (cell.area > 0.0).then_some(known)
    }

    pub fn corrected_measure(&self, vertex: usize, region: Region) -> Option<Answer> {
        let normal = self.normals[vertex];
        let cell = self.measure(vertex, region, &|v| self.corrected_cell(v));
        let values = Answer::of_tensor(normal, cell.tensor.map(|row| scale(row, 1.0 / cell.area)));
        let mean = cell.mean / cell.area;
        (cell.area > 0.0).then(|| Answer {
            mean,
            gaussian: cell.gaussian / cell.area,
            mean_normal: scale(normal, mean),
            area: cell.area,
            integrated_mean: cell.mean,
            integrated_gaussian: cell.gaussian,
            ..values
        })
    }

    /// The height fits with a given normal; of Goldfeather and Interrante's kind if `slopes`.
    pub fn quadric(&self, vertex: usize, rings: usize, slopes: bool) -> Option<Answer> {
        let normal = self.normals[vertex];
        let [ex, ey] = tangents(normal);
        let others = neighbourhood(&self.clean, &self.faces_of, vertex, rings);
        let edge = |&v: &usize| (self.edge(vertex, v), self.normals[v]);
        let others: Vec<(Vector, Vector)> = others[1..].iter().map(edge).collect();
        // Slopes become lengths by the root mean square distance.
        let squares: f64 = others.iter().map(|other| dot(other.0, other.0)).sum();
        let distance = (squares / others.len() as f64).sqrt();
        let mut rows = vec![];
        for (point, n) in others {
            let [x, y, z] = [ex, ey, normal].map(|axis| dot(axis, point));
            let mut height = vec![x * x / 2.0, x * y, y * y / 2.0];
            if slopes {
                height.extend([x * x * x, x * x * y, x * y * y, y * y * y]);
                let [nx, ny, nz] = [ex, ey, normal].map(|axis| dot(axis, n));
                if nz > 0.05 {
                    let along_x = [x, y, 0.0, 3.0 * x * x, 2.0 * x * y, y * y, 0.0, -nx / nz];
                    let along_y = [0.0, x, y, 0.0, x * x, 2.0 * x * y, 3.0 * y * y, -ny / nz];
                    rows.extend([along_x, along_y].map(|row| row.map(|x| x * distance).to_vec()));
                }
            }
            height.push(z);
            rows.push(height);
        }
        let u = least_squares(&rows)?;
        Some(Answer::of_operator(normal, [ex, ey], [u[0], u[1], u[2]].map(|x| -x)))
    }
}

//! Solids as machines make them, of triangles or quads, with the face of the solid that each face of the mesh is a part of.

use super::Random;
use super::mesh::Mesh;
use super::{Vector, add, length, scale, sub, unit};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_4, TAU};

pub struct Solid {
    pub mesh: Mesh,
    /// By face of the mesh.
    pub sides: Vec<usize>,
}

impl Solid {
    fn new(name: &str, positions: Vec<Vector>, faces: Vec<(Vec<u32>, usize)>) -> Self {
        let (faces, sides) = faces.into_iter().unzip();
        Solid { mesh: Mesh::new(name, positions, faces), sides }
    }

    /// The number of sides.
    pub fn side_count(&self) -> usize {
        self.sides.iter().max().map_or(0, |most| most + 1)
    }

    /// Each quad cut along a diagonal drawn at random.
    pub fn triangles(&self, seed: u64) -> Solid {
        let (mut random, mut faces) = (Random::new(seed), vec![]);
        for (face, &side) in self.mesh.faces().zip(&self.sides) {
            match *face {
                [a, b, c, d] if random.unit() < 0.5 => faces.extend([(vec![a, b, c], side), (vec![a, c, d], side)]),
                [a, b, c, d] => faces.extend([(vec![a, b, d], side), (vec![b, c, d], side)]),
                _ => faces.push((face.to_vec(), side)),
            }
        }
        Solid::new(&self.mesh.name, self.mesh.positions.clone(), faces)
    }

    /// Every vertex moved by up to `part` of its shortest edge, in any direction.
    pub fn noisy(&self, part: f64, seed: u64) -> Solid {
        let mut shortest = vec![f64::INFINITY; self.mesh.positions.len()];
        for face in self.mesh.faces() {
            for (place, &a) in face.iter().enumerate() {
                let b = face[(place + 1) % face.len()];
                let edge = length(sub(self.mesh.positions[a as usize], self.mesh.positions[b as usize]));
                for v in [a, b] {
                    shortest[v as usize] = edge.min(shortest[v as usize]);
                }
            }
        }
        let (mut random, mut mesh) = (Random::new(seed), self.mesh.clone());
        for (position, &edge) in mesh.positions.iter_mut().zip(&shortest) {
            let moved = [(); 3].map(|()| random.signed());
            *position = add(*position, scale(moved, part * edge));
        }
        Solid { mesh, sides: self.sides.clone() }
    }
}

/// The surface of the cubes `(i, j, k)` of a grid that `is_inside`, each face cut into `cut × cut` quads. A side is all of a plane.
pub fn voxels(name: &str, size: i32, cut: i32, is_inside: impl Fn([i32; 3]) -> bool) -> Solid {
    let (mut positions, mut places, mut sides) = (vec![], HashMap::new(), HashMap::new());
    let mut faces = vec![];
    for cell in 0..size.pow(3) {
        let cell = [cell % size, cell / size % size, cell / size / size];
        if !is_inside(cell) {
            continue;
        }
        for axis in 0..3 {
            for end in [0, 1] {
                let mut beyond = cell;
                beyond[axis] += 2 * end - 1;
                if (0..size).contains(&beyond[axis]) && is_inside(beyond) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let plane = cell[axis] + end;
                let count = sides.len();
                let side = *sides.entry((axis, end, plane)).or_insert(count);
                for part in 0..cut * cut {
                    let mut at = |i: i32, j: i32| {
                        let mut place = [plane * cut; 3];
                        (place[u], place[v]) = (cell[u] * cut + part % cut + i, cell[v] * cut + part / cut + j);
                        *places.entry(place).or_insert_with(|| {
                            positions.push(place.map(|x| x as f64 / cut as f64));
                            positions.len() as u32 - 1
                        })
                    };
                    let mut quad = vec![at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                    if end == 0 {
                        quad.reverse();
                    }
                    faces.push((quad, side));
                }
            }
        }
    }
    Solid::new(name, positions, faces)
}

pub fn cuboid(cut: i32) -> Solid {
    voxels("box", 1, cut, |_| true)
}

/// A block of three by three by three with a square hole all through it.
pub fn holed_box(cut: i32) -> Solid {
    voxels("holed box", 3, cut, |[i, j, _]| (i, j) != (1, 1))
}

/// A profile of `(radius, height)` from the axis back to the axis, turned around it; each of its straight pieces is a side, and is cut
/// into as many parts as make its quads about square.
pub fn lathe(name: &str, profile: &[[f64; 2]], columns: usize) -> Solid {
    let (mut positions, mut faces): (Vec<Vector>, Vec<(Vec<u32>, usize)>) = (vec![], vec![]);
    let mut ring = |[radius, height]: [f64; 2]| -> Vec<u32> {
        let first = positions.len() as u32;
        let count = if radius == 0.0 { 1 } else { columns };
        for column in 0..count {
            let angle = TAU * column as f64 / columns as f64;
            positions.push([radius * angle.cos(), radius * angle.sin(), height]);
        }
        (0..columns).map(|column| first + (column % count) as u32).collect()
    };
    let mut below = ring(profile[0]);
    for (side, ends) in profile.windows(2).enumerate() {
        let [[r0, h0], [r1, h1]] = [ends[0], ends[1]];
        let edge = TAU * r0.max(r1) / columns as f64;
        let rows = ((r1 - r0).hypot(h1 - h0) / edge).ceil() as usize;
        for row in 1..=rows {
            let share = row as f64 / rows as f64;
            let end = if row == rows { ends[1] } else { [r0 + share * (r1 - r0), h0 + share * (h1 - h0)] };
            let above = ring(end);
            for column in 0..columns {
                let next = (column + 1) % columns;
                let mut corners = vec![below[column], below[next], above[next], above[column]];
                corners.dedup();
                if corners.first() == corners.last() {
                    corners.pop();
                }
                faces.push((corners, side));
            }
            below = above;
        }
    }
    Solid::new(name, positions, faces)
}

pub fn cylinder(columns: usize) -> Solid {
    lathe("cylinder", &[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]], columns)
}

pub fn cone_on_cylinder(columns: usize) -> Solid {
    let profile = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.6, 1.0], [0.0, 2.0]];
    lathe("cone on cylinder", &profile, columns)
}

pub fn stepped_shaft(columns: usize) -> Solid {
    let profile = [[0.0, 0.0], [0.6, 0.0], [0.6, 1.0], [1.0, 1.0], [1.0, 2.0], [0.5, 2.0], [0.5, 3.0], [0.0, 3.0]];
    lathe("stepped shaft", &profile, columns)
}

/// A box with the half sides `core + radius` whose edges and corners are rounded: 6 flats, 12 quarters of a cylinder, 8 octants of a ball.
/// `flat` quads across each flat, and `2 × steps` across each fillet.
pub fn filleted_box(core: Vector, radius: f64, flat: usize, steps: usize) -> Solid {
    let size = flat + 2 * steps;
    let (mut positions, mut places, mut sides) = (vec![], HashMap::new(), HashMap::new());
    // Where a line of the grid is on its axis, and the tangent of its angle.
    let line = |index: usize| -> (f64, f64) {
        let angle = |parts: usize| (FRAC_PI_4 * parts as f64 / steps as f64).tan();
        if index < steps {
            (-1.0, -angle(steps - index))
        } else if index > steps + flat {
            (1.0, angle(index - steps - flat))
        } else {
            (2.0 * (index - steps) as f64 / flat as f64 - 1.0, 0.0)
        }
    };
    let mut at = |place: [usize; 3]| {
        *places.entry(place).or_insert_with(|| {
            let lines = place.map(line);
            let middle = [0, 1, 2].map(|axis| lines[axis].0 * core[axis]);
            positions.push(add(middle, scale(unit(lines.map(|line| line.1)), radius)));
            positions.len() as u32 - 1
        })
    };
    let mut faces = vec![];
    for axis in 0..3 {
        for end in [0, size] {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for cell in 0..size * size {
                let (i, j) = (cell % size, cell / size);
                let mut corner = |i: usize, j: usize| {
                    let mut place = [end; 3];
                    (place[u], place[v]) = (i, j);
                    at(place)
                };
                let mut quad = vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                if end == 0 {
                    quad.reverse();
                }
                let part = |index: usize| (index >= steps) as i32 + (index >= steps + flat) as i32 - 1;
                let mut key = [if end == 0 { -1 } else { 1 }; 3];
                (key[u], key[v]) = (part(i), part(j));
                let count = sides.len();
                faces.push((quad, *sides.entry(key).or_insert(count)));
            }
        }
    }
    Solid::new("filleted box", positions, faces)
}

/// How far two partitions agree: the share of pairs of faces on which they do (W. M. Rand 1971).
pub fn rand_index(a: &[usize], b: &[usize]) -> f64 {
    let pairs = |count: usize| (count * count.saturating_sub(1) / 2) as f64;
    let (mut both, mut one, mut two) = (HashMap::new(), HashMap::new(), HashMap::new());
    for (&a, &b) in a.iter().zip(b) {
        *both.entry((a, b)).or_insert(0) += 1;
        *one.entry(a).or_insert(0) += 1;
        *two.entry(b).or_insert(0) += 1;
    }
    let sum = |counts: Vec<usize>| counts.into_iter().map(pairs).sum::<f64>();
    let (together, in_one, in_two) =
        (sum(both.into_values().collect()), sum(one.into_values().collect()), sum(two.into_values().collect()));
    let all = pairs(a.len());
    if all == 0.0 { 1.0 } else { (all + 2.0 * together - in_one - in_two) / all }
}

/// The same partition, numbered by first occurrence.
pub fn renamed(labels: &[usize]) -> Vec<usize> {
    let mut names = HashMap::new();
    labels
        .iter()
        .map(|label| {
            let count = names.len();
            *names.entry(*label).or_insert(count)
        })
        .collect()
}

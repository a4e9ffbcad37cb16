//! Meshes that are hard on a fit: creases, spikes, noise, edges of very different lengths. With the exact answer where there is one.

use super::linear::{eigenvalues, faces_of, neighbourhood, tangents, times};
use super::mesh::Mesh;
use super::{Random, Vector, add, cross, dot, length, scale, sub, unit};
use std::collections::HashMap;

/// Roughly normally distributed, of variance 1.
pub fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// The mean length of the sides of all faces.
pub fn mean_edge(mesh: &Mesh) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for face in mesh.faces() {
        for (place, &a) in face.iter().enumerate() {
            let b = face[(place + 1) % face.len()];
            sum += length(sub(mesh.positions[a as usize], mesh.positions[b as usize]));
            count += 1.0;
        }
    }
    sum / count
}

/// Positions moved along `normals` by so many mean edges (standard deviation).
pub fn noisy(mesh: &Mesh, normals: &[Vector], part: f64, seed: u64) -> Mesh {
    let (mut random, size) = (Random::new(seed), part * mean_edge(mesh));
    let mut moved = mesh.clone();
    for (position, &direction) in moved.positions.iter_mut().zip(normals) {
        *position = add(*position, scale(direction, size * normal(&mut random)));
    }
    moved.name += &format!(", noise {part}");
    moved
}

/// One vertex in so many, drawn at random.
pub fn some(mesh: &Mesh, one_in: usize, seed: u64) -> Vec<usize> {
    let (mut random, count) = (Random::new(seed), mesh.positions.len());
    (0..count / one_in).map(|_| random.below(count)).collect()
}

/// Likewise, but none with another within four rings, nor with a boundary within two.
pub fn some_apart(mesh: &Mesh, one_in: usize, seed: u64) -> Vec<usize> {
    let (faces_of, topology) = (faces_of(mesh), super::adaptive::topology(mesh));
    let mut found: Vec<usize> = vec![];
    for vertex in some(mesh, 1, seed) {
        let clear = |v: &usize| topology.flags()[*v] & umbilic::status::BOUNDARY == 0;
        let free = || !neighbourhood(mesh, &faces_of, vertex, 4).iter().any(|v| found.contains(v));
        if found.len() * one_in < mesh.positions.len()
            && neighbourhood(mesh, &faces_of, vertex, 2).iter().all(clear)
            && free()
        {
            found.push(vertex);
        }
    }
    found
}

/// Moves vertices by so many mean edges along their normals, to either side.
pub fn spiked(mesh: &Mesh, normals: &[Vector], spikes: &[usize], edges: f64) -> Mesh {
    let (mut random, size) = (Random::new(1), edges * mean_edge(mesh));
    let mut moved = mesh.clone();
    for &vertex in spikes {
        let side = if random.unit() < 0.5 { -size } else { size };
        moved.positions[vertex] = add(mesh.positions[vertex], scale(normals[vertex], side));
    }
    moved.name += &format!(", spikes {edges}");
    moved
}

/// The convex hull of points in general position, outwards.
pub fn hull(points: Vec<Vector>) -> Mesh {
    let above = |face: &[u32; 3], p: Vector| {
        let [a, b, c] = face.map(|v| points[v as usize]);
        dot(cross(sub(b, a), sub(c, a)), sub(p, a)) > 0.0
    };
    let mut faces: Vec<[u32; 3]> = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    if above(&faces[0], points[3]) {
        faces.iter_mut().for_each(|face| face.swap(1, 2));
    }
    for point in 4..points.len() as u32 {
        let (seen, kept): (Vec<[u32; 3]>, Vec<_>) =
            faces.iter().partition(|face| above(face, points[point as usize]));
        let edges: Vec<[u32; 2]> = seen.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
        let horizon = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a]));
        faces = kept.into_iter().chain(horizon.map(|&[a, b]| [a, b, point])).collect();
    }
    Mesh::new("hull", points, faces.iter().map(|face| face.to_vec()).collect())
}

/// Random points on a sphere, spread a little, and their hull.
pub fn random_sphere(count: usize, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut points: Vec<Vector> = (0..count).map(|_| unit([(); 3].map(|()| normal(&mut random)))).collect();
    for _ in 0..6 {
        let mesh = hull(points.clone());
        let mut sums = vec![[0.0; 3]; count];
        for face in mesh.faces() {
            let centre = face.iter().fold([0.0; 3], |sum, &v| add(sum, points[v as usize]));
            face.iter().for_each(|&v| sums[v as usize] = add(sums[v as usize], centre));
        }
        points = sums.into_iter().map(unit).collect();
    }
    Mesh { name: format!("random sphere {count}"), ..hull(points) }
}

/// Normals and curvatures `k1 ≥ k2` where `f = 0`, from gradient and Hessian of `f`.
pub fn exact(gradient: Vector, hessian: [Vector; 3]) -> (Vector, [f64; 2]) {
    let normal = unit(gradient);
    let [x, y] = tangents(normal);
    let entry = |a: Vector, b: Vector| dot(a, times(&hessian, b)) / length(gradient);
    (normal, eigenvalues([entry(x, x), entry(x, y), entry(y, y)]))
}

/// Of an ellipsoid with these half axes.
pub fn exact_ellipsoid(axes: Vector, p: Vector) -> (Vector, [f64; 2]) {
    let part = axes.map(|a| 2.0 / (a * a));
    let hessian = [[part[0], 0.0, 0.0], [0.0, part[1], 0.0], [0.0, 0.0, part[2]]];
    exact(times(&hessian, p), hessian)
}

/// Of the torus of radii 1 and 0.4.
pub fn exact_torus([x, y, z]: Vector) -> (Vector, [f64; 2]) {
    let axial = x.hypot(y);
    let inner = 2.0 * (1.0 - 1.0 / axial);
    let bend = |a: f64, b: f64| 2.0 * a * b / axial.powi(3);
    let hessian = [[2.0 - bend(y, y), bend(x, y), 0.0], [bend(x, y), 2.0 - bend(x, x), 0.0], [0.0, 0.0, 2.0]];
    exact([x * inner, y * inner, 2.0 * z], hessian)
}

/// A height field `z = 0.3 x² − 0.2 y² + 0.25 x y + 0.15 y³ + 0.1 sin 2x − 0.12 x² y`.
pub fn height(x: f64, y: f64) -> f64 {
    0.3 * x * x - 0.2 * y * y + 0.25 * x * y + 0.15 * y.powi(3) + 0.1 * (2.0 * x).sin() - 0.12 * x * x * y
}

pub fn exact_height([x, y, _]: Vector) -> (Vector, [f64; 2]) {
    let dx = 0.6 * x + 0.25 * y + 0.2 * (2.0 * x).cos() - 0.24 * x * y;
    let dy = -0.4 * y + 0.25 * x + 0.45 * y * y - 0.12 * x * x;
    let (xx, xy, yy) = (0.6 - 0.4 * (2.0 * x).sin() - 0.24 * y, 0.25 - 0.24 * x, -0.4 + 0.9 * y);
    exact([-dx, -dy, 1.0], [[-xx, -xy, 0.0], [-xy, -yy, 0.0], [0.0; 3]])
}

/// That height field over a grid of lines at `lines`, inner vertices jittered by a quarter of the spacing there, cut along
/// diagonals drawn at random.
pub fn height_grid(lines: &[f64], seed: u64) -> Mesh {
    let (mut random, side) = (Random::new(seed), lines.len());
    let mut place = |i: usize| {
        let moved = 0.25 * random.signed();
        if i == 0 || i == side - 1 { lines[i] } else { lines[i] + moved * (lines[i + 1] - lines[i - 1]) / 2.0 }
    };
    let positions = (0..side * side).map(|v| [place(v / side), place(v % side)]).map(|[x, y]| [x, y, height(x, y)]);
    let positions = positions.collect();
    let at = |i: usize, j: usize| (i * side + j) as u32;
    let mut faces = vec![];
    for i in 0..side - 1 {
        for j in 0..side - 1 {
            faces.extend(halves([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], &mut random));
        }
    }
    Mesh::new("height grid", positions, faces)
}

/// Lines over `[-1.2, 1.2]` whose spacing grows by that ratio from the first to the last.
pub fn graded(side: usize, ratio: f64) -> Vec<f64> {
    let line = |i: usize| (ratio.powf(i as f64 / (side - 1) as f64) - 1.0) / (ratio - 1.0) * 2.4 - 1.2;
    (0..side).map(line).collect()
}

/// A quad cut along a diagonal drawn at random.
fn halves([a, b, c, d]: [u32; 4], random: &mut Random) -> [Vec<u32>; 2] {
    if random.unit() < 0.5 { [vec![a, b, c], vec![a, c, d]] } else { [vec![a, b, d], vec![b, c, d]] }
}

/// The cube `[-1, 1]³` with `side × side` squares a face, cut at random, vertices of the faces jittered within their plane. The
/// normals are the mean directions of the sides, and a vertex is on as many sides as `sides` says.
pub struct Cube {
    pub mesh: Mesh,
    pub normals: Vec<Vector>,
    pub sides: Vec<usize>,
}

pub fn cube(side: usize, jitter: f64, seed: u64) -> Cube {
    let mut random = Random::new(seed);
    let (mut places, mut of_place): (Vec<[usize; 3]>, HashMap<[usize; 3], u32>) = Default::default();
    let mut faces = vec![];
    for axis in 0..3 {
        for end in [0, side] {
            for cell in 0..side * side {
                let (i, j) = (cell / side, cell % side);
                let mut at = |i: usize, j: usize| {
                    let mut place = [end; 3];
                    (place[(axis + 1) % 3], place[(axis + 2) % 3]) = (i, j);
                    *of_place.entry(place).or_insert_with(|| {
                        places.push(place);
                        places.len() as u32 - 1
                    })
                };
                let mut quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                if end == 0 {
                    quad.reverse();
                }
                faces.extend(halves(quad, &mut random));
            }
        }
    }
    let on = |place: &[usize; 3]| {
        place.map(|i| {
            if i == 0 {
                -1.0
            } else if i == side {
                1.0
            } else {
                0.0
            }
        })
    };
    let normals: Vec<Vector> = places.iter().map(|place| unit(on(place))).collect();
    let sides = places.iter().map(|place| on(place).iter().filter(|x| **x != 0.0).count()).collect();
    let move_to = |place: &[usize; 3]| {
        place.map(|i| {
            let inside = i != 0 && i != side;
            (i as f64 + if inside { jitter * random.signed() } else { 0.0 }) * 2.0 / side as f64 - 1.0
        })
    };
    let positions = places.iter().map(move_to).collect();
    Cube { mesh: Mesh::new(&format!("cube {side}"), positions, faces), normals, sides }
}

/// A closed cylinder of radius 1 and height 2; the caps are rings around their centres. `rim` says which vertices are on a crease.
pub struct Cylinder {
    pub mesh: Mesh,
    pub normals: Vec<Vector>,
    pub rim: Vec<bool>,
}

pub fn capped_cylinder(columns: usize, seed: u64) -> Cylinder {
    let mut random = Random::new(seed);
    let step = std::f64::consts::TAU / columns as f64;
    let (rows, rings) = ((2.0 / step).round() as usize + 1, (1.0 / step).round() as usize);
    let (mut positions, mut normals, mut rim, mut faces) = (vec![], vec![], vec![], vec![]);
    for row in 0..rows {
        for column in 0..columns {
            let inside = row > 0 && row < rows - 1;
            let mut jitter = || if inside { 0.25 * random.signed() } else { 0.0 };
            let angle = (column as f64 + jitter()) * step;
            let z = (row as f64 + jitter()) / (rows - 1) as f64 * 2.0 - 1.0;
            positions.push([angle.cos(), angle.sin(), z]);
            let up = if inside { 0.0 } else { z.signum() };
            normals.push(unit([angle.cos(), angle.sin(), up]));
            rim.push(!inside);
        }
    }
    let at = |row: usize, column: usize| (row * columns + column % columns) as u32;
    for row in 0..rows - 1 {
        for column in 0..columns {
            let quad = [at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)];
            faces.extend(halves(quad, &mut random));
        }
    }
    for (up, outer) in [(-1.0, 0), (1.0, rows - 1)] {
        let mut loops: Vec<Vec<u32>> = vec![(0..columns).map(|column| at(outer, column)).collect()];
        for ring in (0..rings).rev() {
            let count = if ring == 0 { 1 } else { columns };
            let first = positions.len() as u32;
            for column in 0..count {
                let (radius, angle) = (ring as f64 / rings as f64, column as f64 * step);
                positions.push([radius * angle.cos(), radius * angle.sin(), up]);
                normals.push([0.0, 0.0, up]);
                rim.push(false);
            }
            loops.push((0..columns).map(|column| first + (column % count) as u32).collect());
        }
        for pair in loops.windows(2) {
            for column in 0..columns {
                let next = (column + 1) % columns;
                let quad = [pair[0][column], pair[0][next], pair[1][next], pair[1][column]];
                let mut cut =
                    if quad[2] == quad[3] { vec![quad[..3].to_vec()] } else { halves(quad, &mut random).to_vec() };
                if up < 0.0 {
                    cut.iter_mut().for_each(|face| face.reverse());
                }
                faces.extend(cut);
            }
        }
    }
    Cylinder { mesh: Mesh::new(&format!("cylinder {columns}"), positions, faces), normals, rim }
}

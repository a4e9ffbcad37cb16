//! Generated meshes: polygons by offsets, positions in double precision.

use super::{Random, Vector, add, scale, unit};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub name: String,
    pub positions: Vec<Vector>,
    pub offsets: Vec<u32>,
    pub indices: Vec<u32>,
}

impl Mesh {
    pub fn new(name: &str, positions: Vec<Vector>, faces: Vec<Vec<u32>>) -> Self {
        let mut mesh = Mesh { name: name.into(), positions, offsets: vec![0], indices: vec![] };
        for face in faces {
            mesh.indices.extend(face);
            mesh.offsets.push(mesh.indices.len() as u32);
        }
        mesh
    }
    pub fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }
    pub fn face(&self, face: usize) -> &[u32] {
        &self.indices[self.offsets[face] as usize..self.offsets[face + 1] as usize]
    }
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.face_count()).map(|face| self.face(face))
    }
    pub fn is_triangles(&self) -> bool {
        self.faces().all(|face| face.len() == 3)
    }
    pub fn single(&self) -> Vec<[f32; 3]> {
        self.positions.iter().map(|point| point.map(|x| x as f32)).collect()
    }
    /// The same mesh with coordinates that `f32` holds exactly.
    pub fn rounded(&self) -> Self {
        let positions = self.positions.iter().map(|point| point.map(|x| x as f32 as f64)).collect();
        Mesh { positions, ..self.clone() }
    }
    pub fn mapped(&self, map: impl Fn(Vector) -> Vector) -> Self {
        Mesh { positions: self.positions.iter().map(|&point| map(point)).collect(), ..self.clone() }
    }
    pub fn with_faces(&self, faces: Vec<Vec<u32>>) -> Self {
        Mesh::new(&self.name, self.positions.clone(), faces)
    }
    pub fn face_vectors(&self) -> Vec<Vec<u32>> {
        self.faces().map(<[u32]>::to_vec).collect()
    }
    /// Every face the other way round.
    pub fn reversed(&self) -> Self {
        self.with_faces(self.faces().map(|face| face.iter().rev().copied().collect()).collect())
    }
}

/// The paper's sphere: two poles, `rings` rings of `segments` vertices, quads cut from (ring i, segment j) to
/// (ring i + 1, segment j + 1).
pub fn ring_sphere(segments: usize, rings: usize) -> Mesh {
    let mut positions = vec![[0.0, 0.0, 1.0]];
    for ring in 1..=rings {
        let polar = PI * ring as f64 / (rings + 1) as f64;
        for segment in 0..segments {
            let around = TAU * segment as f64 / segments as f64;
            positions.push([polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()]);
        }
    }
    positions.push([0.0, 0.0, -1.0]);
    let last = positions.len() as u32 - 1;
    let at = |ring: usize, segment: usize| (1 + ring * segments + segment % segments) as u32;
    let mut faces = vec![];
    for segment in 0..segments {
        faces.push(vec![0, at(0, segment), at(0, segment + 1)]);
        for ring in 0..rings - 1 {
            let (a, b) = (at(ring, segment), at(ring + 1, segment));
            let (c, d) = (at(ring + 1, segment + 1), at(ring, segment + 1));
            faces.push(vec![a, b, c]);
            faces.push(vec![a, c, d]);
        }
        faces.push(vec![last, at(rings - 1, segment + 1), at(rings - 1, segment)]);
    }
    Mesh::new(&format!("ring sphere {segments} x {rings}"), positions, faces)
}

/// A tetrahedron, each triangle cut in four and the midpoints pushed to the unit sphere, `levels` times.
pub fn tetrahedron_sphere(levels: usize) -> Mesh {
    let positions = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(unit).to_vec();
    let mut mesh =
        Mesh::new("tetrahedron sphere", positions, vec![vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 1], vec![1, 3, 2]]);
    for _ in 0..levels {
        mesh = subdivided(&mesh, unit);
    }
    mesh
}

/// Each triangle cut in four; `place` moves the midpoints.
pub fn subdivided(mesh: &Mesh, place: impl Fn(Vector) -> Vector) -> Mesh {
    let mut positions = mesh.positions.clone();
    let mut midpoints = HashMap::new();
    let mut midpoint = |a: u32, b: u32| {
        *midpoints.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let middle = scale(add(positions[a as usize], positions[b as usize]), 0.5);
            positions.push(place(middle));
            positions.len() as u32 - 1
        })
    };
    let mut faces = vec![];
    for face in mesh.faces() {
        let [a, b, c] = [face[0], face[1], face[2]];
        let (ab, bc, ca) = (midpoint(a, b), midpoint(b, c), midpoint(c, a));
        faces.extend([vec![a, ab, ca], vec![ab, b, bc], vec![ca, bc, c], vec![ab, bc, ca]]);
    }
    Mesh::new(&mesh.name, positions, faces)
}

/// A grid of quads on a torus, jittered; each quad stays whole with the probability `quads`, else it is cut along a
/// diagonal drawn at random.
pub fn torus(columns: usize, rows: usize, jitter: f64, quads: f64, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut positions = vec![];
    for column in 0..columns {
        for row in 0..rows {
            let u = TAU * (column as f64 + jitter * random.signed()) / columns as f64;
            let v = TAU * (row as f64 + jitter * random.signed()) / rows as f64;
            positions.push([(1.0 + 0.4 * v.cos()) * u.cos(), (1.0 + 0.4 * v.cos()) * u.sin(), 0.4 * v.sin()]);
        }
    }
    let at = |column: usize, row: usize| (column % columns * rows + row % rows) as u32;
    let mut faces = vec![];
    for column in 0..columns {
        for row in 0..rows {
            let quad = [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
            let [a, b, c, d] = quad;
            match random.unit() {
                x if x < quads => faces.push(quad.to_vec()),
                x if x < quads + (1.0 - quads) / 2.0 => faces.extend([vec![a, b, c], vec![a, c, d]]),
                _ => faces.extend([vec![a, b, d], vec![b, c, d]]),
            }
        }
    }
    Mesh::new(&format!("torus {columns} x {rows}"), positions, faces)
}

/// An open, irregular height field with a border; some quads stay whole.
pub fn height_field(side: usize, quads: f64, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut positions = vec![];
    for i in 0..side {
        for j in 0..side {
            let x = (i as f64 + 0.35 * random.signed()) / (side - 1) as f64 * 2.0 - 1.0;
            let y = (j as f64 + 0.35 * random.signed()) / (side - 1) as f64 * 2.0 - 1.0;
            positions.push([x, y, 0.2 * x * x * x - 0.3 * x * y + 0.1 * (3.0 * y).sin()]);
        }
    }
    let at = |i: usize, j: usize| (i * side + j) as u32;
    let mut faces = vec![];
    for i in 0..side - 1 {
        for j in 0..side - 1 {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            match random.unit() {
                x if x < quads => faces.push(vec![a, b, c, d]),
                x if x < quads + (1.0 - quads) / 2.0 => faces.extend([vec![a, b, c], vec![a, c, d]]),
                _ => faces.extend([vec![a, b, d], vec![b, c, d]]),
            }
        }
    }
    Mesh::new(&format!("height field {side}"), positions, faces)
}

/// A flat letter L of one hexagon (with a reflex corner), extruded to a prism; and one with a collinear corner.
pub fn letter_prism() -> Mesh {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]];
    let count = outline.len() as u32;
    let positions = [0.0, 0.7].iter().flat_map(|&z| outline.map(|[x, y]| [x, y, z])).collect();
    let mut faces: Vec<Vec<u32>> = vec![(0..count).rev().collect(), (count..2 * count).collect()];
    for i in 0..count {
        let next = (i + 1) % count;
        faces.push(vec![i, next, count + next, count + i]);
    }
    Mesh::new("letter prism", positions, faces)
}

/// Triangles between vertices drawn at random: every defect there is, on `vertices` vertices.
pub fn soup(vertices: usize, faces: usize, largest: usize, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let positions = (0..vertices).map(|_| [random.signed(), random.signed(), random.signed()]).collect();
    let faces = (0..faces)
        .map(|_| {
            let corners = if largest == 3 { 3 } else { random.below(largest) + 1 };
            (0..corners).map(|_| random.below(vertices) as u32).collect()
        })
        .collect();
    Mesh::new(&format!("soup {seed}"), positions, faces)
}

/// A fan of `count` triangles around vertex 0, on a paraboloid; closed, or with one triangle missing.
pub fn fan(count: usize, closed: bool, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut positions = vec![[0.0; 3]];
    for i in 0..count {
        let angle = TAU * (i as f64 + 0.3 * random.unit()) / count as f64;
        let radius = 1.0 + 0.5 * random.unit();
        positions.push([radius * angle.cos(), radius * angle.sin(), -0.2 * radius * radius]);
    }
    // A bystander, so that the last vertex is no neighbour.
    positions.push([9.0; 3]);
    let triangles = count - !closed as usize;
    let faces = (0..triangles).map(|i| vec![0, 1 + i as u32, 1 + ((i + 1) % count) as u32]).collect();
    Mesh::new(&format!("fan {count}"), positions, faces)
}

/// The surface of a cube cut into `side * side` quads a face, pushed to the unit sphere; jittered, so that the quads are
/// neither flat nor alike.
pub fn quad_sphere(side: usize, jitter: f64, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let (mut positions, mut places) = (vec![], HashMap::new());
    let mut at = |place: [usize; 3]| {
        *places.entry(place).or_insert_with(|| {
            let moved = place.map(|i| 2.0 * i as f64 / side as f64 - 1.0 + jitter * random.signed() / side as f64);
            positions.push(unit(moved));
            positions.len() as u32 - 1
        })
    };
    let mut faces = vec![];
    for axis in 0..3 {
        for end in [0, side] {
            for i in 0..side {
                for j in 0..side {
                    let mut place = |i: usize, j: usize| {
                        let mut place = [end; 3];
                        (place[(axis + 1) % 3], place[(axis + 2) % 3]) = (i, j);
                        at(place)
                    };
                    let mut quad = vec![place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
                    if end == 0 {
                        quad.reverse();
                    }
                    faces.push(quad);
                }
            }
        }
    }
    Mesh::new(&format!("quad sphere {side}"), positions, faces)
}

/// The dual of a closed mesh around the origin, on the unit sphere: a vertex for each face, and a polygon for each vertex.
pub fn dual_sphere(mesh: &Mesh) -> Mesh {
    let middle = |face: &[u32]| unit(face.iter().fold([0.0; 3], |sum, &v| add(sum, mesh.positions[v as usize])));
    let mut after = vec![HashMap::new(); mesh.positions.len()];
    for (index, face) in mesh.faces().enumerate() {
        for (place, &vertex) in face.iter().enumerate() {
            let (next, prev) = (face[(place + 1) % face.len()], face[(place + face.len() - 1) % face.len()]);
            after[vertex as usize].insert(next, (prev, index as u32));
        }
    }
    let around = |ring: &HashMap<u32, (u32, u32)>| {
        let start = *ring.keys().min().unwrap();
        let (mut at, mut face) = (start, vec![]);
        while face.is_empty() || at != start {
            let (prev, index) = ring[&at];
            face.push(index);
            at = prev;
        }
        face
    };
    Mesh::new(&format!("dual {}", mesh.name), mesh.faces().map(middle).collect(), after.iter().map(around).collect())
}

//! Generates sample meshes.
//!
//! All of them are closed surfaces around the origin, about two units wide, with their faces turning counterclockwise
//! seen from outside, and come out the same on every run. The resolution scales the number of faces; values too small
//! for a surface, or so large that the mesh would not fit in common memory, are replaced by the nearest sensible
//! ones.

use crate::mesh::PolygonMesh;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// The largest resolution, at which the largest sample has 20 million faces.
pub const LARGEST_RESOLUTION: u32 = 1000;

/// A unit sphere of triangles between two poles: `resolution` bands of twice as many segments.
pub fn sphere(resolution: u32) -> PolygonMesh {
    let bands = resolution.clamp(2, LARGEST_RESOLUTION);
    let segments = 2 * bands;
    let mut positions = vec![[0.0, 1.0, 0.0]];
    for ring in 1..bands {
        let (radius, height) = (PI * f64::from(ring) / f64::from(bands)).sin_cos();
        for segment in 0..segments {
            let (sin, cos) = (TAU * f64::from(segment) / f64::from(segments)).sin_cos();
            positions.push([radius * sin, height, radius * cos]);
        }
    }
    positions.push([0.0, -1.0, 0.0]);

    let vertex = |ring: u32, segment: u32| match ring {
        0 => 0,
        ring if ring == bands => 1 + (bands - 1) * segments,
        ring => 1 + (ring - 1) * segments + segment % segments,
    };
    let mut faces = Vec::new();
    for ring in 0..bands {
        for segment in 0..segments {
            let [a, b] = [vertex(ring, segment), vertex(ring + 1, segment)];
            let [c, d] = [vertex(ring + 1, segment + 1), vertex(ring, segment + 1)];
            // Next to the poles one of the two triangles has no area.
            if ring + 1 < bands {
                faces.push([a, b, c]);
            }
            if ring > 0 {
                faces.push([a, c, d]);
            }
        }
    }
    PolygonMesh::from_uniform_faces(positions, &faces)
}

/// A torus of quadrilaterals: `resolution` of them around the tube and twice as many along it.
pub fn torus(resolution: u32) -> PolygonMesh {
    const TUBE: f64 = 0.35;
    let around = resolution.clamp(3, LARGEST_RESOLUTION);
    let along = 2 * around;
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    for i in 0..along {
        let (sin_along, cos_along) = (TAU * f64::from(i) / f64::from(along)).sin_cos();
        for j in 0..around {
            let (sin, cos) = (TAU * f64::from(j) / f64::from(around)).sin_cos();
            let radius = 1.0 - TUBE + TUBE * cos;
            positions.push([radius * sin_along, TUBE * sin, radius * cos_along]);
            let [next_i, next_j] = [(i + 1) % along, (j + 1) % around];
            faces.push([i * around + j, next_i * around + j, next_i * around + next_j, i * around + next_j]);
        }
    }
    PolygonMesh::from_uniform_faces(positions, &faces)
}

/// A cube of 8 vertices and 6 quadrilaterals.
pub fn cube() -> PolygonMesh {
    let positions = (0..8).map(|corner| [0, 1, 2].map(|axis| f64::from(corner >> axis & 1) * 2.0 - 1.0)).collect();
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    PolygonMesh::from_uniform_faces(positions, &faces)
}

/// A sphere with smooth hills and valleys, of evenly sized triangles: each face of an icosahedron is divided into the
/// square of `resolution`.
pub fn bumpy(resolution: u32) -> PolygonMesh {
    let mut mesh = icosphere(resolution.clamp(1, LARGEST_RESOLUTION));
    for position in &mut mesh.positions {
        let radius = bump(*position);
        *position = position.map(|coordinate| coordinate * radius);
    }
    mesh
}

/// The distance of the bumpy sphere from the origin in a direction.
fn bump([x, y, z]: [f64; 3]) -> f64 {
    // A wave that winds through space without a preferred direction, like a gyroid, and a finer one on it.
    let wave = |frequency: f64, shift: f64| {
        let [x, y, z] = [x, y, z].map(|value| value * frequency + shift);
        x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos()
    };
    0.9 * (1.0 + 0.03 * wave(3.0, 0.8) + 0.042 * wave(12.0, 0.2))
}

/// An icosahedron whose edges are divided into `pieces`, blown up to the unit sphere.
fn icosphere(pieces: u32) -> PolygonMesh {
    let (corners, triangles) = icosahedron();
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    let mut shared = HashMap::new();
    for triangle in triangles {
        // The vertex that lies `weights` steps from the three sides. Vertices on an edge are shared: the corner
        // opposite to it has no weight there.
        let mut vertex = |weights: [u32; 3]| {
            let mut key = [0, 1, 2].map(|corner| (weights[corner], triangle[corner]));
            for entry in key.iter_mut().filter(|(weight, _)| *weight == 0) {
                *entry = (0, 0);
            }
            key.sort_unstable();
            *shared.entry(key).or_insert_with(|| {
                let mut sum = [0.0; 3];
                // The order of the key gives both sides of an edge the same rounding, whatever the order of the
                // corners.
                for (weight, corner) in key {
                    for (total, coordinate) in sum.iter_mut().zip(corners[corner]) {
                        *total += f64::from(weight) * coordinate;
                    }
                }
                positions.push(normalize(sum));
                positions.len() as u32 - 1
            })
        };
        for i in 0..pieces {
            for j in 0..pieces - i {
                let k = pieces - i - j;
                let right = vertex([i + 1, j, k - 1]);
                let left = vertex([i, j + 1, k - 1]);
                faces.push([vertex([i, j, k]), right, left]);
                if k > 1 {
                    faces.push([right, vertex([i + 1, j + 1, k - 2]), left]);
                }
            }
        }
    }
    PolygonMesh::from_uniform_faces(positions, &faces)
}

/// The corners and triangles of a regular icosahedron.
fn icosahedron() -> ([[f64; 3]; 12], [[usize; 3]; 20]) {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let corners = [
        [-1.0, golden, 0.0],
        [1.0, golden, 0.0],
        [-1.0, -golden, 0.0],
        [1.0, -golden, 0.0],
        [0.0, -1.0, golden],
        [0.0, 1.0, golden],
        [0.0, -1.0, -golden],
        [0.0, 1.0, -golden],
        [golden, 0.0, -1.0],
        [golden, 0.0, 1.0],
        [-golden, 0.0, -1.0],
        [-golden, 0.0, 1.0],
    ];
    let triangles = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (corners, triangles)
}

/// Scales a vector to unit length.
fn normalize(vector: [f64; 3]) -> [f64; 3] {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    vector.map(|coordinate| coordinate / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    /// Six times the signed volume, positive if the faces turn counterclockwise seen from outside.
    fn volume(mesh: &PolygonMesh) -> f64 {
        let mut sum = 0.0;
        for face in mesh.faces() {
            for pair in face[1..].windows(2) {
                let [a, b, c] = [face[0], pair[0], pair[1]].map(|v| mesh.positions[v as usize]);
                sum += a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
            }
        }
        sum
    }

    /// Whether every edge has two faces that pass it in opposite directions.
    fn is_closed(mesh: &PolygonMesh) -> bool {
        let mut edges = HashSet::new();
        let unique =
            mesh.faces().all(|face| (0..face.len()).all(|i| edges.insert((face[i], face[(i + 1) % face.len()]))));
        unique && edges.iter().all(|&(from, to)| edges.contains(&(to, from)))
    }

    #[test]
    fn samples_are_closed_and_face_outwards() {
        let samples = [sphere, torus, bumpy];
        let meshes = samples.iter().flat_map(|f| [0, 1, 2, 3, 8].map(f));
        for mesh in meshes.chain([cube()]) {
            assert!(is_closed(&mesh));
            assert!(volume(&mesh) > 0.0);
            let used: HashSet<u32> = mesh.indices.iter().copied().collect();
            assert_eq!(used.len(), mesh.vertex_count());
            let (low, high) = mesh.bounding_box().unwrap();
            assert!(low.iter().chain(&high).all(|value| value.abs() <= 1.5));
        }
    }

    #[test]
    fn samples_have_the_promised_sizes() {
        let sizes = |mesh: PolygonMesh| (mesh.vertex_count(), mesh.face_count());
        assert_eq!(sizes(sphere(8)), (2 + 7 * 16, 2 * 7 * 16));
        assert_eq!(sizes(torus(8)), (128, 128));
        assert_eq!(sizes(bumpy(8)), (10 * 64 + 2, 20 * 64));
        assert_eq!(sizes(cube()), (8, 6));
    }
}

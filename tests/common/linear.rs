//! Small linear algebra, in the plainest way.

use super::mesh::Mesh;
use super::{Random, Vector, cross, dot, unit};
use std::collections::BTreeSet;

/// Solves a square system by elimination with pivoting; none if it has no solution to rounding.
pub fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs()))?;
        if matrix[pivot][k].abs() < 1e-14 {
            return None;
        }
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        for row in k + 1..n {
            let (above, below) = matrix.split_at_mut(row);
            let factor = below[0][k] / above[k][k];
            for (number, pivot) in below[0][k..].iter_mut().zip(&above[k][k..]) {
                *number -= factor * pivot;
            }
            right[row] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        for later in k + 1..n {
            right[k] -= matrix[k][later] * right[later];
        }
        right[k] /= matrix[k][k];
    }
    Some(right)
}

/// The least-squares solution of `rows`, each of the left-hand sides and the right-hand side: the columns are made
/// perpendicular one after the other (Gram and Schmidt, modified), which is as good as the problem's condition. None if a
/// column depends on those before it to rounding.
pub fn least_squares(rows: &[Vec<f64>]) -> Option<Vec<f64>> {
    let n = rows.first()?.len() - 1;
    let mut columns: Vec<Vec<f64>> = (0..=n).map(|column| rows.iter().map(|row| row[column]).collect()).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut upper = vec![vec![0.0; n + 1]; n];
    for k in 0..n {
        let whole: f64 = rows.iter().map(|row| row[k] * row[k]).sum::<f64>().sqrt();
        upper[k][k] = product(&columns[k], &columns[k]).sqrt();
        if upper[k][k] <= 1e-13 * whole {
            return None;
        }
        let direction: Vec<f64> = columns[k].iter().map(|x| x / upper[k][k]).collect();
        for later in k + 1..=n {
            upper[k][later] = product(&direction, &columns[later]);
            columns[later].iter_mut().zip(&direction).for_each(|(x, d)| *x -= upper[k][later] * d);
        }
    }
    let mut unknowns = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|later| upper[k][later] * unknowns[later]).sum();
        unknowns[k] = (upper[k][n] - known) / upper[k][k];
    }
    Some(unknowns)
}

/// A rotation drawn at random, as its rows.
pub fn rotation(seed: u64) -> [Vector; 3] {
    let mut random = Random::new(seed);
    let x = unit([random.signed(), random.signed(), random.signed() + 2.0]);
    let y = unit(cross(x, [random.signed(), 3.0, random.signed()]));
    [x, y, cross(x, y)]
}

pub fn times(matrix: &[Vector; 3], v: Vector) -> Vector {
    matrix.map(|row| dot(row, v))
}

/// `A M Aᵀ`
pub fn conjugated(a: &[Vector; 3], m: &[Vector; 3]) -> [Vector; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| dot(a[i], times(m, a[j]))))
}

/// Two unit vectors that with the unit vector `normal` make a right-handed frame.
pub fn tangents(normal: Vector) -> [Vector; 2] {
    let axis = if normal[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let x = unit(cross(axis, normal));
    [x, cross(normal, x)]
}

/// The larger and the smaller eigenvalue of `(a b; b d)`.
pub fn eigenvalues([a, b, d]: [f64; 3]) -> [f64; 2] {
    let (mean, radius) = ((a + d) / 2.0, ((a - d) / 2.0).hypot(b));
    [mean + radius, mean - radius]
}

/// The faces of each vertex.
pub fn faces_of(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut faces_of = vec![vec![]; mesh.positions.len()];
    for (index, face) in mesh.faces().enumerate() {
        face.iter().for_each(|&v| faces_of[v as usize].push(index));
    }
    faces_of
}

/// The vertices within so many rings, the vertex itself first; those that share a face are neighbours.
pub fn neighbourhood(mesh: &Mesh, faces_of: &[Vec<usize>], vertex: usize, rings: usize) -> Vec<usize> {
    let (mut found, mut seen, mut first) = (vec![vertex], BTreeSet::from([vertex]), 0);
    for _ in 0..rings {
        for index in std::mem::replace(&mut first, found.len())..found.len() {
            for &face in &faces_of[found[index]] {
                found.extend(mesh.face(face).iter().map(|&v| v as usize).filter(|&v| seen.insert(v)));
            }
        }
    }
    found
}

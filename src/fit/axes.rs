//! The frame that a height field is fitted in: the directions of most and of least variance of the points.
//!
//! Reference: Cazals & Pouget 2005, section 4.1, as `Monge_via_jet_fitting` of CGAL has it: the principal axes of the points,
//! the vertex among them, around their centroid. The eigenvectors of the 3 × 3 covariance come from cyclic Jacobi rotations
//! (Golub & Van Loan 8.5), a lane standing still as soon as it is done, so that its bits do not depend on the others.
//!
//! Numerical notes: the covariance is turned into a frame about the vertex's normal first. There it is nearly diagonal, and
//! two or three rounds are enough. What an off-diagonal element below `2⁻⁵⁶` of the trace could turn is no more than rounding
//! has turned already.
//! Degenerate rule: points on a line, at one place or as far apart in all directions have *some* orthonormal frame, never NaN
//! unless a coordinate is infinite. Cost: two passes over the points, and two square roots and a division a rotation.

use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::Patch;

/// Right-handed and orthonormal.
#[derive(Clone, Copy)]
pub(crate) struct Axes<V: Vector> {
    pub x: Vector3<V>,
    pub y: Vector3<V>,
    /// The direction of heights.
    pub z: Vector3<V>,
    /// Lanes where `z` stands out from the other two, and is more than chance.
    pub distinct: V::Mask,
}

/// The variance along the principal `z` must be below this part of the next larger one. Across a right-angled crease it is a
/// quarter; around a tube, and in a small component that is gathered whole, it is anything up to 1.
const DISTINCT: f64 = 0.75;

/// Off-diagonal elements below this part of the trace are rounding.
const DIAGONAL: f64 = 1.0 / (1u64 << 56) as f64;

/// Rotations converge quadratically; from any start, this many rounds of three are more than enough.
const MOST_ROUNDS: usize = 10;

impl<V: Vector<Scalar = f64>> Axes<V> {
    /// The principal axes of a patch and the vertex itself, `z` that of least variance, on the side of the vertex's normal.
    #[inline(always)]
    pub fn principal(patch: &Patch<'_, V>) -> Self {
        let start = Axes::about(patch.normal);
        let covariance = covariance(patch);
        let cx = times(&covariance, start.x);
        let cy = times(&covariance, start.y);
        let cz = times(&covariance, start.z);
        let mut diagonal = [start.x.dot(cx), start.y.dot(cy), start.z.dot(cz)];
        let mut off = [start.y.dot(cz), start.x.dot(cz), start.x.dot(cy)];
        let mut axes = [start.x, start.y, start.z];
        let negligible = (diagonal[0] + diagonal[1] + diagonal[2]) * V::constant(DIAGONAL);
        for _ in 0..MOST_ROUNDS {
            let largest = off[0].abs().max(off[1].abs()).max(off[2].abs());
            if negligible.lt(largest).bits() == 0 {
                break;
            }
            rotate::<V, 0, 1, 2>(&mut diagonal, &mut off, &mut axes, negligible);
            rotate::<V, 0, 2, 1>(&mut diagonal, &mut off, &mut axes, negligible);
            rotate::<V, 1, 2, 0>(&mut diagonal, &mut off, &mut axes, negligible);
        }
        // The axis of least variance to the end, the others before it.
        let second = diagonal[1].lt(diagonal[2]);
        let (variance, mut z) = (diagonal[1].min(diagonal[2]), choose(second, axes[1], axes[2]));
        let larger = diagonal[1].max(diagonal[2]);
        let first = diagonal[0].lt(variance);
        let x = choose(first, axes[1], axes[0]);
        z = choose(first, axes[0], z);
        let next = V::select(first, variance, diagonal[0].min(larger));
        let distinct = variance.min(diagonal[0]).lt(next * V::constant(DISTINCT));
        let against = z.dot(patch.normal).lt(V::zero());
        z = choose(against, Vector3::zero() - z, z);
        // Rounding has left them orthonormal but for a few units in the last place.
        let z = z * (V::one() / z.squared().sqrt());
        let x = x - z * z.dot(x);
        let x = x * (V::one() / x.squared().sqrt());
        Axes { x, y: z.cross(x), z, distinct }
    }
}

impl<V: Vector> Axes<V> {
    /// A frame about a unit vector, or the coordinate axes in lanes where it is zero. Reference: Duff et al. 2017.
    #[inline(always)]
    pub fn about(normal: Vector3<V>) -> Self {
        let sign = V::select(normal.z.lt(V::zero()), -V::one(), V::one());
        let a = -V::one() / (sign + normal.z);
        let b = normal.x * normal.y * a;
        let x = Vector3 { x: V::one() + sign * normal.x * normal.x * a, y: sign * b, z: -(sign * normal.x) };
        let y = Vector3 { x: b, y: sign + normal.y * normal.y * a, z: -normal.y };
        let exists = V::zero().lt(normal.squared());
        let z = V::select(exists, normal.z, V::one());
        Axes { x, y, z: Vector3 { z, ..normal }, distinct: V::zero().lt(V::one()) }
    }

    /// Axes that are known.
    #[inline(always)]
    pub fn of(x: Vector3<V>, y: Vector3<V>, z: Vector3<V>) -> Self {
        Axes { x, y, z, distinct: V::zero().lt(V::one()) }
    }

    /// A vector's components along the axes.
    #[inline(always)]
    pub fn components(&self, vector: Vector3<V>) -> Vector3<V> {
        Vector3 { x: self.x.dot(vector), y: self.y.dot(vector), z: self.z.dot(vector) }
    }

    /// The vector with the given components.
    #[inline(always)]
    pub fn vector(&self, x: V, y: V, z: V) -> Vector3<V> {
        self.x * x + self.y * y + self.z * z
    }
}

#[inline(always)]
fn choose<V: Vector>(mask: V::Mask, yes: Vector3<V>, no: Vector3<V>) -> Vector3<V> {
    Vector3 { x: V::select(mask, yes.x, no.x), y: V::select(mask, yes.y, no.y), z: V::select(mask, yes.z, no.z) }
}

/// The symmetric matrix `xx, xy, xz, yy, yz, zz` times a vector.
#[inline(always)]
fn times<V: Vector>([xx, xy, xz, yy, yz, zz]: &[V; 6], v: Vector3<V>) -> Vector3<V> {
    Vector3 {
        x: *xx * v.x + *xy * v.y + *xz * v.z,
        y: *xy * v.x + *yy * v.y + *yz * v.z,
        z: *xz * v.x + *yz * v.y + *zz * v.z,
    }
}

/// The sums of products `xx, xy, xz, yy, yz, zz` of the points and the vertex about their centroid.
#[inline(always)]
fn covariance<V: Vector<Scalar = f64>>(patch: &Patch<'_, V>) -> [V; 6] {
    let mut mean = Vector3::zero();
    for index in 0..patch.len() {
        // A point that a lane does not have is at the origin.
        mean = mean + patch.point(index);
    }
    mean = mean * (V::one() / (patch.count + V::one()));
    // The vertex itself.
    let mut sums =
        [mean.x * mean.x, mean.x * mean.y, mean.x * mean.z, mean.y * mean.y, mean.y * mean.z, mean.z * mean.z];
    for index in 0..patch.len() {
        let mut d = patch.point(index) - mean;
        if index >= patch.full {
            d = d * patch.weight(index);
        }
        let products = [d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z];
        for term in 0..6 {
            sums[term] = sums[term] + products[term];
        }
    }
    sums
}

/// One Jacobi rotation in the plane of the axes `P` and `Q`, `R` being the third; `off[R]` is the element that goes to zero.
/// None in lanes where that is negligible already.
#[inline(always)]
fn rotate<V: Vector<Scalar = f64>, const P: usize, const Q: usize, const R: usize>(
    diagonal: &mut [V; 3],
    off: &mut [V; 3],
    axes: &mut [Vector3<V>; 3],
    negligible: V,
) {
    let (element, difference) = (off[R], diagonal[Q] - diagonal[P]);
    let active = negligible.lt(element.abs());
    let twice = element + element;
    let hypotenuse = (difference * difference + twice * twice).sqrt();
    let width = difference.abs() + hypotenuse;
    let signed = V::select(difference.lt(V::zero()), -twice, twice);
    // The tangent and the cosine of the smaller of the two angles that do it, with one division.
    let inverse = V::one() / V::select(active, hypotenuse * width, V::one());
    let tangent = V::select(active, signed * (inverse * hypotenuse), V::zero());
    let cosine = (V::constant(0.5) * width * (inverse * width)).sqrt();
    let sine = tangent * cosine;
    // A rotation by nothing would still turn -0 to 0, and how many rounds a lane goes through depends on its neighbours.
    diagonal[P] = V::select(active, diagonal[P] - tangent * element, diagonal[P]);
    diagonal[Q] = V::select(active, diagonal[Q] + tangent * element, diagonal[Q]);
    off[R] = V::select(active, V::zero(), element);
    let (p, q) = (off[Q], off[P]);
    off[Q] = V::select(active, cosine * p - sine * q, p);
    off[P] = V::select(active, sine * p + cosine * q, q);
    let (p, q) = (axes[P], axes[Q]);
    axes[P] = choose(active, p * cosine - q * sine, p);
    axes[Q] = choose(active, p * sine + q * cosine, q);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(points: &[[f64; 3]], normal: [f64; 3]) -> Axes<f64> {
        let flat: Vec<f64> = points.iter().flatten().copied().collect();
        let [x, y, z] = normal;
        let patch = Patch::of_points(&flat, Vector3 { x, y, z });
        let axes = Axes::principal(&patch);
        for (a, b) in [(axes.x, axes.y), (axes.y, axes.z), (axes.z, axes.x)] {
            assert!((a.squared() - 1.0).abs() < 2e-15 && a.dot(b).abs() < 2e-15, "{points:?}");
        }
        assert!((axes.x.cross(axes.y).dot(axes.z) - 1.0).abs() < 2e-15);
        assert!(axes.z.dot(patch.normal) >= -1e-15);
        // Eigenvectors: the covariance leaves their directions alone, and none has less variance than z.
        let [xx, xy, xz, yy, yz, zz] = covariance(&patch);
        let variance = |a: Vector3<f64>, b: Vector3<f64>| {
            xx * a.x * b.x
                + xy * (a.x * b.y + a.y * b.x)
                + xz * (a.x * b.z + a.z * b.x)
                + yy * a.y * b.y
                + yz * (a.y * b.z + a.z * b.y)
                + zz * a.z * b.z
        };
        let trace = xx + yy + zz;
        for (a, b) in [(axes.x, axes.y), (axes.y, axes.z), (axes.z, axes.x)] {
            assert!(variance(a, b).abs() <= 5e-15 * trace, "{points:?}: {:e}", variance(a, b) / trace);
        }
        for other in [axes.x, axes.y] {
            assert!(variance(axes.z, axes.z) <= variance(other, other) + 5e-15 * trace);
        }
        axes
    }

    #[test]
    fn principal_axes_of_clouds_of_every_kind() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for round in 0..4000 {
            let count = 1 + round % 30;
            let stretch = [1.0, 10f64.powi(-(round % 17)), 10f64.powi(-(round % 23))];
            let about = Axes::about({
                let v = Vector3 { x: next(), y: next(), z: next() };
                v * (1.0 / v.squared().sqrt())
            });
            let points: Vec<[f64; 3]> = (0..count)
                .map(|_| {
                    let p = about.vector(next() * stretch[0], next() * stretch[1], next() * stretch[2]);
                    [p.x, p.y, p.z].map(|x| if round % 5 == 0 { (2.0 * x).round() } else { x })
                })
                .collect();
            let normal = match round % 3 {
                0 => [0.0; 3],
                1 => [about.z.x, about.z.y, about.z.z],
                _ => [about.x.x, about.x.y, about.x.z],
            };
            check(&points, normal);
        }
        // The smallest and the most regular.
        check(&[], [0.0; 3]);
        check(&[[0.0; 3]; 4], [0.0, 0.0, -1.0]);
        check(&[[1.0, 1.0, 1.0], [-1.0, -1.0, -1.0]], [0.0, 1.0, 0.0]);
        check(
            &[
                [1.0, 0.0, 0.0],
                [-1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
                [0.0, 0.0, 1.0],
                [0.0, 0.0, -1.0],
            ],
            [0.0, 0.6, -0.8],
        );
        // A plane through two coordinate axes is found to the last bit.
        let plane: Vec<[f64; 3]> = (0..20).map(|_| [next(), 0.0, next()]).collect();
        let axes = check(&plane, [0.0, -1.0, 0.0]);
        assert_eq!((axes.z.x, axes.z.y, axes.z.z), (0.0, -1.0, 0.0));
    }
}

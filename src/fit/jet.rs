//! Osculating jets: the surface near a vertex as a polynomial height field.
//!
//! Reference: Cazals & Pouget 2005, "Estimating differential quantities using polynomial fitting of osculating jets". The
//! points of the neighbourhood and the vertex itself, all with weight 1, are written as heights `z(x, y)` over the plane of
//! their principal axes ([`Axes::principal`]), and a polynomial of degree `d` with all its `(d + 1)(d + 2)/2` coefficients is
//! fitted by least squares. Normal and shape operator are those of the fitted surface at `x = y = 0` ([`Surface`]), so the plane
//! need not be tangent. Degree 1 has a normal and no curvature.
//! The normal's error is of order `d` in the size of the neighbourhood, the curvatures' of order `d − 1` (their Theorem 1).
//!
//! Input: neighbourhoods of any kind of mesh; how the points hang together does not matter.
//! Degenerate rule: a lane is not trusted where the points do not determine the polynomial, where with the vertex they are
//! no more than its coefficients, where no direction of least variance stands out, and where its normal is more than
//! 75° from the vertex's: then the neighbourhood is no height field over the plane that was found (it wraps around a thin
//! tube, or around the whole of a small component). [`JetFit`] says what becomes of these.
//! Fitted by normal equations with refinement ([`fit_polynomial`]), or where their condition is large by reflections ([`solve`]): which
//! of them depends on the vertex's own points only.
//! Cost: that of the fit, and two passes over the points.

use super::JetFit;
use super::axes::Axes;
use super::least_squares::{condition, solve};
use super::moments::ROWS;
use super::normal_equations::{Polynomial, fit_polynomial};
use super::surface::Surface;
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::Patch;
use crate::topology::status;

/// The cosine of the largest angle between a jet's normal and the vertex's.
const AGREES: f64 = 0.25;

/// A jet of a condition beyond this says more about rounding, and about how the points happen to lie, than about the surface.
const ILL_CONDITIONED: f64 = 1e6;

/// The surface at a vertex.
#[derive(Clone, Copy)]
pub(crate) struct Jet<V: Vector> {
    /// Unit normal.
    pub normal: Vector3<V>,
    /// Unit tangent vectors; right-handed with the normal, and orthonormal.
    pub x: Vector3<V>,
    /// See `x`.
    pub y: Vector3<V>,
    /// The shape operator `a, b, d` in the axes `x`, `y`: the curvature of a section along `(c, s)` is `a c² + 2 b c s + d s²`.
    /// In the patch's units.
    pub shape: [V; 3],
    /// The root of the mean of the squared height differences, in the patch's units.
    pub residual: V,
    /// The condition of the least-squares problem.
    pub condition: V,
    /// Lanes that can be believed.
    pub trusted: V::Mask,
    /// Lanes whose points determine the polynomial, whatever its normal is like.
    determined: V::Mask,
}

const NOWHERE: Vector3<f64> = Vector3 { x: 0.0, y: 0.0, z: 0.0 };

/// A vertex of which nothing is known.
const NO_JET: Jet<f64> = Jet {
    normal: NOWHERE,
    x: NOWHERE,
    y: NOWHERE,
    shape: [0.0; 3],
    residual: 0.0,
    condition: 0.0,
    trusted: false,
    determined: false,
};

/// The number of coefficients of a polynomial of that degree in two variables.
pub(super) const fn coefficients(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

impl JetFit {
    /// The jets of a row of vertices.
    #[inline(always)]
    pub(crate) fn lanes<V: Vector<Scalar = f64>>(&self, patch: &Patch<'_, V>, scratch: &mut [V]) -> Jet<V> {
        self.fit(self.degree, patch, Axes::principal(patch), scratch)
    }

    /// The jet of a vertex that [`JetFit::lanes`] did not trust, and the status bits to report with it; none if a wider
    /// neighbourhood should be tried, which is never so if this is the `last`.
    ///
    /// In this order: the jet asked for; with heights along the vertex's normal instead, if its own plane is what is wrong;
    /// in wider neighbourhoods; of lower degree, in as few rings as have the points; the vertex's normal, without curvature; nothing.
    #[inline(never)]
    pub(crate) fn alone(&self, patch: &Patch<'_, f64>, last: bool, scratch: &mut [f64]) -> Option<(Jet<f64>, u8)> {
        let has_normal = patch.normal.squared() > 0.0;
        if !has_normal {
            return Some((NO_JET, status::DEGENERATE));
        }
        for degree in (1..=self.degree).rev() {
            let fallback = if degree < self.degree { status::FALLBACK } else { 0 };
            // Less needs fewer points, and the nearest are best.
            let inner = patch.with_at_least(if degree < self.degree { coefficients(degree) } else { patch.len() });
            let patch = &inner;
            let axes = Axes::principal(patch);
            let jet = self.fit(degree, patch, axes, scratch);
            if jet.trusted {
                return Some((jet, fallback));
            }
            if jet.determined || !axes.distinct || axes.z.dot(patch.normal) < AGREES {
                let jet = self.fit(degree, patch, Axes::about(patch.normal), scratch);
                if jet.trusted {
                    return Some((jet, status::FALLBACK));
                }
            }
            if !last {
                return None;
            }
        }
        let Axes { x, y, z: normal, .. } = Axes::about(patch.normal);
        Some((Jet { normal, x, y, ..NO_JET }, status::FALLBACK))
    }

    #[inline(always)]
    fn fit<V: Vector<Scalar = f64>>(
        &self,
        degree: usize,
        patch: &Patch<'_, V>,
        axes: Axes<V>,
        scratch: &mut [V],
    ) -> Jet<V> {
        match degree {
            1 => fit::<V, 3>(patch, axes, scratch),
            2 => fit::<V, 6>(patch, axes, scratch),
            3 => fit::<V, 10>(patch, axes, scratch),
            _ => fit::<V, 15>(patch, axes, scratch),
        }
    }
}

/// Fits the polynomial of `K` coefficients along `axes.z`.
#[inline(always)]
fn fit<V: Vector<Scalar = f64>, const K: usize>(patch: &Patch<'_, V>, axes: Axes<V>, scratch: &mut [V]) -> Jet<V> {
    let length = patch.len().next_multiple_of(ROWS);
    let (x, rest) = scratch.split_at_mut(length);
    let (y, rest) = rest.split_at_mut(length);
    let (z, scratch) = rest.split_at_mut(length);
    for row in 0..length {
        // A point that a lane does not have is at the origin.
        let point = if row < patch.len() { axes.components(patch.point(row)) } else { Vector3::zero() };
        (x[row], y[row], z[row]) = (point.x, point.y, point.z);
    }
    let mut solution = fit_polynomial::<V, K>([x, y, z], patch.count, patch.full);
    let mut full_rank = solution.well_conditioned;
    let has_points = V::zero().lt(patch.count).bits();
    if full_rank.bits() & has_points != has_points {
        let (reflected, trusted) = fit_by_reflections::<V, K>([x, y, z], patch, scratch);
        let well = full_rank;
        for term in 0..K {
            let coefficients = &mut solution.coefficients;
            coefficients[term] = V::select(well, coefficients[term], reflected.coefficients[term]);
        }
        solution.residual_squared = V::select(well, solution.residual_squared, reflected.residual_squared);
        solution.condition = V::select(well, solution.condition, reflected.condition);
        full_rank = well.or(trusted);
    }
    let u = &solution.coefficients;
    let residual = (solution.residual_squared / (patch.count + V::one())).sqrt();
    let condition = solution.condition;

    let two = V::constant(2.0);
    let second = if K > 3 { [two * u[3 % K], u[4 % K], two * u[5 % K]] } else { [V::zero(); 3] };
    let Surface { normal, x, y, shape } = Surface::of_derivatives(&axes, [u[1], u[2]], second);
    // A vertex without a normal has nothing to tell the sides of the surface by.
    let agrees = V::constant(AGREES).lt(normal.dot(patch.normal));
    // As many points as coefficients would be met exactly, noise and all.
    let enough = V::constant((K - 1) as f64).lt(patch.count);
    let determined = full_rank.and(enough).and(condition.lt(V::constant(ILL_CONDITIONED)));
    let trusted = determined.and(agrees).and(axes.distinct);
    Jet { normal, x, y, shape, residual, condition, trusted, determined }
}

/// The same by Householder reflections, for any condition; and lanes of full rank.
#[inline(always)]
fn fit_by_reflections<V: Vector<Scalar = f64>, const K: usize>(
    [x, y, z]: [&[V]; 3],
    patch: &Patch<'_, V>,
    scratch: &mut [V],
) -> (Polynomial<V, K>, V::Mask) {
    // Rows that are too few are filled up with zeros, as in lanes that have fewer than others.
    let rows = (patch.len() + 1).max(K);
    let columns = &mut scratch[..(K + 1) * rows];
    // The vertex itself.
    columns[0] = V::one();
    for column in 1..=K {
        columns[column * rows] = V::zero();
    }
    for row in 1..rows {
        let (mut weight, mut point) = (V::zero(), Vector3::zero());
        if row <= patch.len() {
            weight = patch.weight(row - 1);
            point = Vector3 { x: x[row - 1], y: y[row - 1], z: z[row - 1] };
        }
        // Monomials of each degree from those of the one below. A point that a lane does not have is at the origin, so its
        // only monomial that is not zero is the first.
        let mut monomials = [weight; K];
        let (mut first, mut length) = (0, 1);
        let (x, y) = (point.x, point.y);
        while first + length < K {
            let next = first + length;
            for term in 0..length {
                monomials[next + term] = if first == 0 { x } else { monomials[first + term] * x };
            }
            monomials[next + length] = if first == 0 { y } else { monomials[next - 1] * y };
            (first, length) = (next, length + 1);
        }
        for column in 0..K {
            columns[column * rows + row] = monomials[column];
        }
        columns[K * rows + row] = point.z;
    }
    let solution = solve::<V, K>(columns, rows);
    let fitted = Polynomial {
        coefficients: solution.unknowns,
        residual_squared: solution.residual_squared,
        condition: condition(columns, rows, &solution),
        well_conditioned: solution.trusted,
    };
    (fitted, solution.trusted)
}

#[cfg(test)]
mod tests {
    use super::super::JetOptions;
    use super::*;

    fn random(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn jet_fit(degree: u8) -> JetFit {
        JetFit::new(JetOptions { degree, rings: 2 }).unwrap()
    }

    fn unit(v: Vector3<f64>) -> Vector3<f64> {
        v * (1.0 / v.squared().sqrt())
    }

    /// The smaller and the larger principal curvature, and the direction of the larger.
    fn principal(jet: &Jet<f64>) -> (f64, f64, Vector3<f64>) {
        let [a, b, d] = jet.shape;
        let (mean, half) = ((a + d) / 2.0, ((a - d) / 2.0).hypot(b));
        let angle = 0.5 * (2.0 * b).atan2(a - d);
        (mean - half, mean + half, jet.x * angle.cos() + jet.y * angle.sin())
    }

    /// A polynomial of the jet's degree, steep at the vertex, over a plane of any direction: normal, curvatures and principal
    /// directions are exact. The curvatures are the roots of `det(II − κ I)`.
    #[test]
    fn polynomials_of_the_degree_are_reproduced() {
        let mut next = random(1);
        for round in 0..2000 {
            let degree = 1 + round % 4;
            let axes = Axes::about(unit(Vector3 { x: next(), y: next(), z: next() }));
            let mut coefficients: Vec<f64> = (0..super::coefficients(degree)).map(|_| next()).collect();
            if round % 5 == 0 {
                // Steeper than is believed.
                coefficients[1] += 4.0;
            }
            // The vertex is on the surface, or beside it by what the constant says: then so are all points.
            let height = |x: f64, y: f64| {
                let mut terms = (0..=degree as i32).flat_map(|t| (0..=t).map(move |j| x.powi(t - j) * y.powi(j)));
                coefficients.iter().fold(-coefficients[0], |sum, c| sum + c * terms.next().unwrap())
            };
            let points: Vec<f64> = (0..super::coefficients(degree) + 6 + round % 20)
                .flat_map(|_| {
                    let (x, y) = (next(), next());
                    let p = axes.vector(x, y, height(x, y));
                    [p.x, p.y, p.z]
                })
                .collect();
            let patch = Patch::of_points(&points, axes.z);
            let fit = jet_fit(degree as u8);
            let mut scratch = vec![0.0; fit.scratch(patch.len())];
            let jet = fit.fit(degree, &patch, axes, &mut scratch);
            if jet.condition > 1e4 {
                continue;
            }
            let (p, q) = (coefficients[1], coefficients[2]);
            let w = (1.0 + p * p + q * q).sqrt();
            let tolerance = 1e-13 * jet.condition * w;
            let normal = axes.vector(-p / w, -q / w, 1.0 / w);
            assert!((jet.normal - normal).squared().sqrt() < tolerance);
            assert!(jet.residual < tolerance);
            assert!((jet.x.squared() - 1.0).abs() < 1e-14 && jet.x.dot(jet.normal).abs() < 1e-14);
            assert!((jet.y.squared() - 1.0).abs() < 1e-14 && jet.x.cross(jet.y).dot(jet.normal) > 0.99999);
            assert!(jet.determined);
            assert_eq!(jet.trusted, 1.0 / w > AGREES);
            if degree == 1 {
                assert_eq!(jet.shape, [0.0; 3]);
                continue;
            }
            let (e, f, g) = (1.0 + p * p, p * q, 1.0 + q * q);
            let [l, m, n] = [2.0 * coefficients[3], coefficients[4], 2.0 * coefficients[5]].map(|x| -x / w);
            let determinant = e * g - f * f;
            let (mean, gauss) = ((l * g - 2.0 * m * f + n * e) / (2.0 * determinant), (l * n - m * m) / determinant);
            let half = (mean * mean - gauss).max(0.0).sqrt();
            let (small, large, direction) = principal(&jet);
            assert!(
                (small + large - 2.0 * mean).abs() < tolerance && (small * large - gauss).abs() < 10.0 * tolerance
            );
            assert!((large - (mean + half)).abs() < tolerance.sqrt());
            // The section along the direction of the larger, by the forms in the plane's coordinates.
            let (u, v) = (axes.x.dot(direction), axes.y.dot(direction));
            let section = (l * u * u + 2.0 * m * u * v + n * v * v) / (e * u * u + 2.0 * f * u * v + g * v * v);
            assert!((section - large).abs() < 10.0 * tolerance, "{section} {large}");
        }
    }

    /// A sphere with outward normals has positive curvatures, all the same: one over its radius.
    #[test]
    fn spheres_curve_the_right_way() {
        let mut next = random(2);
        for degree in 2..=4 {
            for size in [1e-3, 0.05] {
                let axes = Axes::about(unit(Vector3 { x: next(), y: next(), z: next() }));
                let points: Vec<f64> = (0..40)
                    .flat_map(|i| {
                        let (radius, angle) = (size * (1 + i / 8) as f64 / 5.0, i as f64 * 0.8);
                        let p =
                            axes.vector(radius.sin() * angle.cos(), radius.sin() * angle.sin(), radius.cos() - 1.0);
                        [p.x, p.y, p.z].map(|x| x / size)
                    })
                    .collect();
                let fit = jet_fit(degree);
                let patch = Patch::of_points(&points, axes.z);
                let jet = fit.lanes(&patch, &mut vec![0.0; fit.scratch(patch.len())]);
                assert!(jet.trusted);
                for (found, expected) in jet.shape.into_iter().zip([1.0, 0.0, 1.0]) {
                    assert!(
                        (found / size - expected).abs() < 3.0 * size * size + 1e-9 / size,
                        "{degree}, {size}: {found}"
                    );
                }
                // Turned inside out, it is a hollow one.
                let inside = Patch::of_points(&points, axes.z * -1.0);
                let hollow = fit.lanes(&inside, &mut vec![0.0; fit.scratch(patch.len())]);
                assert!((hollow.normal + jet.normal).squared().sqrt() < 1e-12);
                assert!((principal(&hollow).0 + principal(&jet).1).abs() < 1e-9);
            }
        }
    }

    /// What is left where the jet fails, step by step.
    #[test]
    fn fallbacks_in_their_order() {
        let normal = Vector3 { x: 0.0, y: 0.0, z: 1.0 };
        let fit = jet_fit(2);
        let alone = |points: &[f64], normal, last| {
            let patch = Patch::of_points(points, normal);
            fit.alone(&patch, last, &mut vec![0.0; fit.scratch(patch.len())])
        };
        let circle = |count: usize, z: f64| -> Vec<f64> {
            let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
            (0..count).flat_map(|i| [angle(i).cos(), angle(i).sin(), z]).collect()
        };
        // Enough points: the jet itself.
        let full = [circle(6, 0.1), circle(5, 0.025).iter().map(|x| x * 0.5).collect()].concat();
        let (jet, flags) = alone(&full, normal, false).unwrap();
        assert_eq!(flags, 0);
        assert!(jet.shape[0] < 0.0);
        // Points on a circle, with its centre: four directions only, which leave a quadric open.
        let four = circle(4, 0.1);
        assert!(alone(&four, normal, false).is_none());
        let (jet, flags) = alone(&four, normal, true).unwrap();
        assert_eq!((flags, jet.shape), (status::FALLBACK, [0.0; 3]));
        assert!((jet.normal - normal).squared() < 1e-28);
        // A tube: the direction of least variance is along it, or anywhere across it.
        let tube: Vec<f64> = (0..24i32)
            .filter(|i| *i != 12)
            .flat_map(|i| {
                let along = (i / 8) as f64 * 0.5 - 0.5;
                let angle = (i % 8 - 4) as f64 * std::f64::consts::FRAC_PI_4;
                [along, 2.0 * angle.sin(), 2.0 * angle.cos() - 2.0]
            })
            .collect();
        let (jet, flags) = alone(&tube, normal, false).unwrap();
        assert_eq!(flags, status::FALLBACK);
        assert!(jet.normal.z > 0.9);
        // A line, and nothing at all: the normal; and not even that.
        for points in [vec![1.0, 2.0, 3.0, 2.0, 4.0, 6.0], vec![], vec![f64::NAN; 60]] {
            assert!(alone(&points, normal, false).is_none());
            let (jet, flags) = alone(&points, normal, true).unwrap();
            assert_eq!((flags, jet.shape), (status::FALLBACK, [0.0; 3]));
            assert_eq!((jet.normal.x, jet.normal.y, jet.normal.z), (0.0, 0.0, 1.0));
            let (jet, flags) = alone(&points, NOWHERE, false).unwrap();
            assert_eq!((flags, jet.shape), (status::DEGENERATE, [0.0; 3]));
            assert_eq!((jet.normal.x, jet.normal.y, jet.normal.z), (0.0, 0.0, 0.0));
        }
    }
}

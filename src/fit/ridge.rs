//! The ridge regression of adaptive jets: the most probable coefficients of a polynomial of degree 4, given the variances of the points
//! and the sizes that coefficients are expected to have.
//!
//! The normal equations follow from 78 moments of the points, since a product of two monomials is a monomial; they are solved by
//! Cholesky's factorisation. The evidence is that of a linear model with normal noise and prior (MacKay 1992, "Bayesian interpolation",
//! eq. 4.8).
//!
//! Numerical notes: the weights of points differ by as much as 16 digits, which costs no accuracy, since Cholesky's error does not
//! depend on how rows are scaled. The last points are filled up with zeros that weigh nothing.
//! Degenerate rule: a lane whose equations are not definite to rounding is not [`Coefficients::definite`].
//! Cost: 78 products and sums a point; 680 products for the factor, as many again for the variances.

use super::adaptive_model::Coordinates;
use super::cholesky::factor_and_solve;
use super::heights::Heights;
use super::moments::{ROWS, Rows, add, add_degrees, first_of, raised, rows, times};
use crate::simd::{MAX_LANES, Vector, each};

/// The coefficients of a polynomial of degree 4.
pub(super) const TERMS: usize = 15;

/// The degree of each coefficient. Those of degree `d` belong to `u^d`, `u^(d−1) v` … `v^d`.
const DEGREES: [usize; TERMS] = [0, 1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4];

/// The binomial coefficients that go with them.
const BINOMIALS: [f64; TERMS] = [1.0, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 3.0, 3.0, 1.0, 1.0, 4.0, 6.0, 4.0, 1.0];

/// `1/variance` of the slopes about those of the one-ring normal, which is hardly ever more than 20° off: nothing beside what points
/// tell, unless these lie along a line.
const SLOPE_PRIOR: f64 = 25.0;

/// Where points are this few, with the vertex, that normal is as good as they are.
const FEW: f64 = 8.0;

/// `1/variance` of the slopes there.
const FEW_SLOPE_PRIOR: f64 = 100.0;

/// What a lane knows of its vertex and the mesh.
#[derive(Clone, Copy)]
pub(super) struct Setting<V> {
    /// The squared sizes `τ_d²` of degrees 2 to 4 and of what lies beyond, for lengths in the vertex's own units.
    pub sizes_squared: [V; 4],
    /// The number of points, the vertex among them.
    pub count: V,
    /// The slopes of the one-ring normal in the frame.
    pub slopes: [V; 2],
    pub coordinates: Coordinates,
}

/// The most probable coefficients of a row of vertices.
pub(super) struct Coefficients<V: Vector> {
    pub c: [V; TERMS],
    /// The diagonal of their covariance, if it was asked for.
    pub variances: [V; TERMS],
    /// `1/variance` of their prior.
    prior: [V; TERMS],
    /// `bᵀ c` and the reciprocals of the pivots, of which the evidence is made.
    explained: V,
    inverse_pivots: [V; TERMS],
    pub definite: V::Mask,
}

/// Solves for the coefficients, with the weights that are set.
#[inline(always)]
pub(super) fn solve<V: Vector<Scalar = f64>>(
    heights: &Heights<'_, V>,
    setting: &Setting<V>,
    with_variances: bool,
) -> Coefficients<V> {
    let Moments { plain, back, back_twice, right } = moments(heights, setting.coordinates);
    // A product of two terms is a monomial of the summed degrees, with a factor `back` for each that is linear.
    let mut matrix = [[V::zero(); TERMS]; TERMS];
    for row in 0..TERMS {
        for column in 0..=row {
            let (d, e) = (DEGREES[row], DEGREES[column]);
            let at = first_of(d + e) + (row - first_of(d)) + (column - first_of(e));
            matrix[row][column] = match (d == 1, e == 1) {
                (true, true) => back_twice[at],
                (true, false) | (false, true) => back[at],
                (false, false) => plain[at],
            };
        }
    }
    let few = setting.count.lt(V::constant(FEW + 0.5));
    let slope_prior = V::select(few, V::constant(FEW_SLOPE_PRIOR), V::constant(SLOPE_PRIOR));
    let mut prior = [V::zero(); TERMS];
    let mut right = right;
    // One division for each degree.
    let mut inverse_sizes = [V::zero(); 3];
    for (inverse, &size) in inverse_sizes.iter_mut().zip(&setting.sizes_squared) {
        *inverse = V::one() / size;
    }
    for term in 1..TERMS {
        prior[term] = match DEGREES[term] {
            1 => slope_prior,
            degree => inverse_sizes[degree - 2] * V::constant(1.0 / BINOMIALS[term]),
        };
        matrix[term][term] = matrix[term][term] + prior[term];
    }
    for axis in 0..2 {
        right[1 + axis] = right[1 + axis] + prior[1 + axis] * setting.slopes[axis];
    }
    let (factored, c) = factor_and_solve(&mut matrix, right);
    let mut explained = V::zero();
    for term in 0..TERMS {
        explained = explained + right[term] * c[term];
    }
    let variances = if with_variances { factored.inverse_diagonal() } else { [V::zero(); TERMS] };
    let (inverse_pivots, definite) = (*factored.inverse_pivots(), factored.definite);
    Coefficients { c, variances, prior, explained, inverse_pivots, definite }
}

/// Sums over the points of weight times monomials of `(u, v)` in the coordinates of degree 2 and more.
struct Moments<V> {
    /// Those up to degree 8 (but 1, which is not needed).
    plain: [V; first_of(9)],
    /// With a factor `back`, of degrees 1, 3, 4, 5.
    back: [V; first_of(6)],
    /// With its square, of degree 2.
    back_twice: [V; first_of(3)],
    /// Weight times height times each term.
    right: [V; TERMS],
}

#[inline(always)]
fn moments<V: Vector<Scalar = f64>>(heights: &Heights<'_, V>, coordinates: Coordinates) -> Moments<V> {
    let mut sums = Moments {
        plain: [V::zero(); first_of(9)],
        back: [V::zero(); first_of(6)],
        back_twice: [V::zero(); first_of(3)],
        right: [V::zero(); TERMS],
    };
    match coordinates {
        Coordinates::Height => {
            add_moments::<V, false>(heights, &mut sums);
            // Nothing leads back.
            sums.back.copy_from_slice(&sums.plain[..first_of(6)]);
            sums.back_twice.copy_from_slice(&sums.plain[..first_of(3)]);
        }
        Coordinates::Circle => add_moments::<V, true>(heights, &mut sums),
    }
    sums
}

#[inline(always)]
fn add_moments<V: Vector<Scalar = f64>, const BACK: bool>(heights: &Heights<'_, V>, sums: &mut Moments<V>) {
    for first in (0..heights.len()).step_by(ROWS) {
        let load = |column: &[V]| rows(column, first);
        let (u, v) = (&load(heights.u), &load(heights.v));
        let weight = [load(heights.weight)];
        add(&mut sums.plain, &weight);
        let linear: Rows<V, 2> = raised(weight, u, v);
        add_degrees!(linear, u, v, &mut sums.plain, 3 4 5 6 7 8 9);

        let right = times(weight, &load(heights.w));
        add(&mut sums.right, &right);
        let right: Rows<V, 2> = raised(right, u, v);
        add(&mut sums.right, &if BACK { times(right, &load(heights.back)) } else { right });
        add_degrees!(right, u, v, &mut sums.right, 3 4 5);

        if BACK {
            let back = &load(heights.back);
            let linear = times(linear, back);
            add(&mut sums.back, &linear);
            let squares: Rows<V, 3> = raised(linear, u, v);
            add(&mut sums.back_twice, &times(squares, back));
            add_degrees!(squares, u, v, &mut sums.back, 4 5 6);
        } else {
            add(&mut sums.plain, &linear);
        }
    }
}

/// The square of what the polynomial leaves of the height of a point; 0 in lanes that do not have it.
#[inline(always)]
pub(super) fn squared_residual<V: Vector<Scalar = f64>>(
    heights: &Heights<'_, V>,
    setting: &Setting<V>,
    c: &[V; TERMS],
    row: usize,
) -> V {
    let (u, v) = (heights.u[row], heights.v[row]);
    let (uu, uv, vv) = (u * u, u * v, v * v);
    let second = c[3] * uu + c[4] * uv + c[5] * vv;
    let third = (c[6] * uu + c[7] * uv + c[8] * vv) * u + c[9] * vv * v;
    let fourth = (c[10] * uu + c[11] * uv + c[12] * vv) * uu + (c[13] * uv + c[14] * vv) * vv;
    let first = (c[1] * u + c[2] * v) * heights.back[row];
    let left = heights.w[row] - (c[0] + first + second + third + fourth);
    V::select(V::constant(row as f64).lt(setting.count), left * left, V::zero())
}

impl<V: Vector<Scalar = f64>> Coefficients<V> {
    /// What the data tell of each prior size: for degrees 2 to 4, `Σ c²/binom`, and how many coefficients the prior decides,
    /// in units of `τ²`.
    pub fn shares(&self) -> [(V, V); 3] {
        each((V::zero(), V::zero()), |index| {
            let degree = index + 2;
            let (mut squares, mut variances) = (V::zero(), V::zero());
            let terms = first_of(degree)..first_of(degree + 1);
            for ((&c, &variance), binomial) in
                self.c[terms.clone()].iter().zip(&self.variances[terms.clone()]).zip(&BINOMIALS[terms])
            {
                let inverse = V::constant(1.0 / binomial);
                squares = squares + c * c * inverse;
                variances = variances + variance * inverse;
            }
            (squares, variances)
        })
    }

    /// How many of the coefficients the data decide; at least the height at the centre, however strong the prior and its rounding.
    #[inline(always)]
    pub fn freedom(&self) -> V {
        let mut freedom = V::constant(TERMS as f64);
        for term in 1..TERMS {
            freedom = freedom - self.prior[term] * self.variances[term];
        }
        freedom.max(V::one())
    }

    /// The logarithm of the evidence, but for constants that are the same for all models.
    pub fn log_evidence(&self, heights: &Heights<'_, V>, setting: &Setting<V>) -> [f64; MAX_LANES] {
        let mut logarithms = [0.0; MAX_LANES];
        let mut add = |x: V, factor: f64| {
            for (sum, x) in logarithms.iter_mut().zip(x.to_lanes()).take(V::LANES) {
                *sum += factor * libm::log(x);
            }
        };
        for term in 0..TERMS {
            add(self.inverse_pivots[term], 0.5);
            if term > 0 {
                add(self.prior[term], 0.5);
            }
        }
        let mut squares = V::zero();
        for row in 0..heights.len() {
            let counts = V::zero().lt(heights.weight[row]);
            add(V::select(counts, heights.weight[row], V::one()), 0.5);
            squares = squares + heights.weight[row] * heights.w[row] * heights.w[row];
        }
        let [p, q] = setting.slopes;
        squares = squares + (p * p + q * q) * self.prior[1];
        let rest = ((squares - self.explained) * V::constant(-0.5)).to_lanes();
        each(0.0, |lane| logarithms[lane] + rest[lane])
    }
}

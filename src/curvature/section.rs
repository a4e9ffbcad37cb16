//! Curvature from three points, and from one edge with a normal ("New Computation of Normal Vector and Curvature",
//! section 4). The formulas, over lanes.
//!
//! # Three points
//! `a = A − B` and `c = C − B` are the edges from the middle point `B` to its neighbours, `φ` is the angle between them,
//! `d = |C − A|`. Every formula is then one of `sin φ` and lengths:
//!
//! | section | the paper | here |
//! |---|---|---|
//! | [`Section::Circle`] | 2 N·a / \|a\|² | 2 sin φ / d |
//! | [`Section::Parabola`] | 4 \|(A − 2B + C) × (C − A)\| / d³ | 8 \|a\| \|c\| sin φ / d³ |
//! | [`Section::LengthParabola`] | not carried out | 2 (\|a\| + \|c\|)² sin φ / d³ |
//! | [`Section::SymmetricParabola`] | 2 h_m / v_m² | 4 cos(φ/2) / ((\|a\| + \|c\|) sin²(φ/2)) |
//!
//! *Circle.* The paper's formula is for one edge and the unit bisector `N`, and the two edges of a corner answer alike
//! only if they are equally long. The paper also says that all points of a circle have its curvature; any three points
//! lie on one circle, so that leaves no choice for edges of unequal lengths: the curvature is that of the circle
//! through the three points, `4 · area / (|a| |c| d)`. With `|a| = |c| = l` it is `2 cos(φ/2) / l`, the paper's.
//!
//! *Parabola.* `(a + c) × (c − a) = 2 a × c`.
//!
//! *Parabola by lengths.* The quadratic `Q` through `A` at 0, `B` at `t = |a| / L` and `C` at 1, where `L = |a| + |c|`,
//! has the divided differences `−a / t = −L a/|a|` before `B` and `c / (1 − t) = L c/|c|` after it. So
//! `Q'(t) = (1 − t)(−L a/|a|) + t L c/|c| = |a| c/|c| − |c| a/|a|`, which is as long as `c − a` is, and
//! `Q''(t) = 2 L (a/|a| + c/|c|)`; then `|Q' × Q''| = 2 L² sin φ`.
//!
//! *Symmetric parabola.* `h_m` and `v_m` are the means of `|a| cos(φ/2)`, `|c| cos(φ/2)` and of `|a| sin(φ/2)`,
//! `|c| sin(φ/2)`.
//!
//! From `4 |a| |c| ≤ L²` and `d ≤ L` follows κ_P ≤ κ_PL ≥ κ_C, and with `|a| = |c|`, κ_P = κ_PL = κ_SP ≥ κ_C. As the points
//! of a smooth curve get closer, κ_C, κ_PL and κ_SP tend to its curvature; κ_P tends to `4 |a| |c| / L²` times that, so it
//! is right only for evenly spaced points.
//!
//! Degenerate rule: points on one line, `B` between `A` and `C`: exactly 0. A *cusp*, `C` on the side of `A`: κ_SP is
//! infinite; the others are 0 by their formulas and in the limit, unless `A = C`, where κ_P and κ_PL are infinite and
//! κ_C takes the limit of the corner that closes symmetrically, `2 / |a|`. `a = 0` or `c = 0`: no value, 0 here.
//!
//! # One edge
//! `x` is the edge from the vertex to its neighbour, `N` the unit normal (Table 4):
//! `κ_C = −2 N·x / |x|²`, `κ_SP = −2 N·x / |x − (N·x) N|²`. The sign is a surface's: positive where it bends away from
//! the normal, so 1/r on a sphere of radius r with outward normals; `|κ_C| ≤ |κ_SP|`. The formulas are those of three
//! points, the third being the mirror image of the neighbour, for which all three parabolas agree.
//!
//! # Numerical notes
//! `sin φ` comes from a cross product. Where the edges are nearly opposite or nearly parallel, and of similar length,
//! one of them is replaced by their sum or by the chord, neither of which has lost digits, so that nearly straight and
//! needle-sharp corners keep theirs. Of `sin(φ/2)` and `cos(φ/2)` the larger comes from the cosine of φ and the smaller
//! from its sine, so none is a difference of nearly equal numbers. Exchanging `A` and `C` changes the sign of the cross
//! product and no other bit. Cost: about ten square roots and as many divisions for the first formula, one to three
//! divisions for each more.

use super::Section;
use crate::simd::{Mask, Real, Vector, Vector3};

/// Three points in every lane, as seen from the middle one.
///
/// Each edge comes in a scale of its own that brings its largest component to between 1 and 2, so that however much
/// their lengths differ, nothing over- or underflows. The *common units* are those of the longer edge.
#[derive(Clone, Copy)]
pub(crate) struct ThreePoints<V> {
    /// `a × c`, in units of which only the sign matters.
    pub cross: Vector3<V>,
    /// 1 at a cusp, 0 elsewhere.
    pub cusp: V,
    /// 1 where an edge has no length, 0 elsewhere.
    pub coincident: V,
    /// `sin φ`
    sine: V,
    /// `sin(φ/2)`
    half_sine: V,
    /// `cos(φ/2)`
    half_cosine: V,
    /// In common units.
    length_a: V,
    length_c: V,
    chord: V,
}

impl<V: Vector> ThreePoints<V> {
    /// `a` and `c` are the edges, each in its own scale, `a_unit` and `c_unit` (powers of two) bring them to common
    /// units, and `chord` is `C − A` in common units. `C − A` is asked for because it may be known more exactly than
    /// the difference of two rounded edges.
    #[inline(always)]
    pub fn new(a: Vector3<V>, a_unit: V, c: Vector3<V>, c_unit: V, chord: Vector3<V>) -> Self {
        let (zero, one) = (V::zero(), V::one());
        let (own_a, own_c) = (a.squared().sqrt(), c.squared().sqrt());
        let (length_a, length_c) = (own_a * a_unit, own_c * c_unit);
        let (long_a, long_c) = (a * a_unit, c * c_unit);
        let shorter = length_a.min(length_c);
        let shorter = shorter * shorter;

        // Symmetric in a and c, so that the reverse has the same bits; exactly 0 if a and c are multiples of each
        // other, because then the sum, or the chord, is exact.
        let sum = long_a + long_c;
        let straight = sum.squared().lt(shorter);
        let needle = chord.squared().lt(shorter);
        let half = V::constant(0.5);
        let by_sum = (long_a.cross(sum) + sum.cross(long_c)) * half;
        let by_chord = (long_a.cross(chord) + long_c.cross(chord)) * half;
        let direct = a.cross(c);
        let cross = select(straight, by_sum, select(needle, by_chord, direct));
        let product = length_a * length_c;
        let product = V::select(straight, product, V::select(needle, product, own_a * own_c));
        let safe_product = V::select(zero.lt(product), product, one);
        let sine = length(cross) / safe_product;

        let inner = a.dot(c);
        let safe_own = own_a * own_c;
        let safe_own = V::select(zero.lt(safe_own), safe_own, one);
        let cosine = (inner.abs() / safe_own).min(one);
        let larger = ((one + cosine) * half).sqrt();
        let smaller = sine * half / larger;
        let obtuse = inner.lt(zero);

        let distinct = zero.lt(own_a.min(own_c));
        let turns = zero.lt(cross.largest_component());
        let folded = V::select(zero.lt(inner), V::select(turns, zero, one), zero);
        ThreePoints {
            cross,
            cusp: V::select(distinct, folded, zero),
            coincident: V::select(distinct, zero, one),
            sine,
            half_sine: V::select(obtuse, larger, smaller),
            half_cosine: V::select(obtuse, smaller, larger),
            length_a,
            length_c,
            chord: length(chord),
        }
    }

    /// The curvature, at least 0, in mesh units if `scale` is the common units to a mesh unit; infinite or 0 at a cusp,
    /// as the file's header says, and 0 where an edge has no length.
    #[inline(always)]
    pub fn curvature(&self, section: Section, scale: V) -> V {
        let (zero, one) = (V::zero(), V::one());
        let infinity = V::splat(V::Scalar::INFINITY);
        let apart = zero.lt(self.chord);
        let chord = V::select(apart, self.chord, one);
        // 1/R/2 in common units: at most 1, even where both sine and chord are far below it.
        let ratio = self.sine / chord;
        let two = V::constant(2.0);
        let sum = self.length_a + self.length_c;
        let distinct = self.coincident.lt(one);
        // The scale stands between two divisions, so that only a result beyond the range leaves it.
        let curvature = match section {
            Section::Circle => {
                let length = V::select(distinct, self.length_a, one);
                V::select(apart, ratio * two, two / length) * scale
            }
            Section::Parabola => {
                let factor = V::constant(8.0) * self.length_a * self.length_c;
                V::select(apart, ratio * factor / chord * scale / chord, infinity)
            }
            Section::LengthParabola => V::select(apart, ratio * (two * sum * sum) / chord * scale / chord, infinity),
            Section::SymmetricParabola => {
                let sum = V::select(distinct, sum, one);
                V::constant(4.0) * self.half_cosine * scale / sum / self.half_sine / self.half_sine
            }
        };
        V::select(distinct, curvature, zero)
    }
}

#[inline(always)]
fn select<V: Vector>(mask: V::Mask, yes: Vector3<V>, no: Vector3<V>) -> Vector3<V> {
    Vector3 { x: V::select(mask, yes.x, no.x), y: V::select(mask, yes.y, no.y), z: V::select(mask, yes.z, no.z) }
}

/// The length of a vector of any size.
#[inline(always)]
fn length<V: Vector>(vector: Vector3<V>) -> V {
    let scale = vector.largest_component().unit_scale();
    (vector * scale).squared().sqrt() / scale
}

/// The curvature of a section, from one edge.
#[derive(Clone, Copy)]
pub(crate) struct EdgeCurvature<V> {
    /// In the edge's direction, in units of one by the edge's; 0 where there is none.
    pub curvature: V,
    /// 1, or 0 where there is none, so that a sum drops it.
    pub weight: V,
}

/// The curvature of the section through an edge, `squared` being its squared length, and a unit normal.
///
/// In single precision an edge so short, or so near the normal, that rounding would show has a curvature that is not a number,
/// so that the vertex is computed again in double precision.
///
/// No value: an edge whose squared length is not above [`Real::TINY`], and an edge along the normal to rounding error, for it
/// has no direction.
#[inline(always)]
pub(crate) fn edge<V: Vector>(
    edge: Vector3<V>,
    squared: V,
    normal: Vector3<V>,
    section: Section,
) -> EdgeCurvature<V> {
    let zero = V::zero();
    let long = V::splat(V::Scalar::TINY).lt(squared);
    let height = -(normal.dot(edge));
    // |x − (N·x) N| without the difference. Of a component along the normal, a few units in the last place are left by
    // rounding.
    let tangential = normal.cross(edge).squared();
    let rounding = if V::Scalar::SINGLE { 4.0 * f32::EPSILON as f64 } else { 4.0 * f64::EPSILON };
    let usable = (squared * V::constant(rounding * rounding)).lt(tangential).and(long);
    let divisor = match section {
        Section::Circle => squared,
        // The three parabolas are one here.
        Section::Parabola | Section::LengthParabola | Section::SymmetricParabola => tangential,
    };
    let safe = V::select(usable, divisor, V::one());
    let doubtful = if V::Scalar::SINGLE {
        let least = V::splat(V::Scalar::TINY) * V::constant(64.0);
        let clear = (squared * V::constant(STEEP)).max(least).lt(tangential);
        V::select(clear, zero, V::constant(f64::NAN))
    } else {
        zero
    };
    EdgeCurvature {
        curvature: V::select(usable, (height + height) / safe, zero) + doubtful,
        weight: V::select(usable, V::one(), zero),
    }
}

/// Edges whose tangential part, squared, is a smaller part than this are left to double precision.
const STEEP: f64 = 0.25;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Level, MAX_LANES, Task, Width, dispatch};

    fn vector(x: f64, y: f64, z: f64) -> Vector3<f64> {
        Vector3 { x, y, z }
    }

    /// Numbers between -1 and 1.
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn single(edge: Vector3<f64>, normal: Vector3<f64>, section: Section) -> EdgeCurvature<f64> {
        super::edge(edge, edge.squared(), normal, section)
    }

    #[test]
    fn table_4_of_the_paper() {
        let mut number = numbers(4);
        for _ in 0..20_000 {
            let (x, n) = (vector(number(), number(), number()), vector(number(), number(), number()));
            let normal = n.divided_by(n.squared().sqrt());
            let [circle, parabola] =
                [Section::Circle, Section::SymmetricParabola].map(|section| single(x, normal, section));
            assert_eq!((circle.weight, parabola.weight), (1.0, 1.0));
            // The formulas in the paper's words, N reversed.
            let height = normal.dot(x);
            let tangential = x - normal * height;
            assert!((circle.curvature + 2.0 * height / x.squared()).abs() <= 1e-14 * circle.curvature.abs());
            let expected = -2.0 * height / tangential.squared();
            assert!((parabola.curvature - expected).abs() <= 1e-9 * expected.abs());
            // "Magnitude", "Range".
            assert!(circle.curvature.abs() <= parabola.curvature.abs() * (1.0 + 1e-15));
            if x.squared() >= 1.0 {
                assert!(circle.curvature.abs() <= 2.0 * (1.0 + 1e-15));
            }
            for section in [Section::Parabola, Section::LengthParabola] {
                assert_eq!(single(x, normal, section).curvature, parabola.curvature);
            }
        }
    }

    #[test]
    fn an_edge_on_a_sphere_bends_away_from_the_outward_normal() {
        let mut number = numbers(5);
        for _ in 0..1000 {
            let [p, q] = [(); 2].map(|()| {
                let point = vector(number(), number(), number());
                point.divided_by(point.squared().sqrt())
            });
            let found = single((q - p) * 3.0, p, Section::Circle).curvature;
            assert!((found - 1.0 / 3.0).abs() < 1e-12, "{found}");
        }
        // On a parabola, the other formula: y = −x²/2 at its apex.
        let up = vector(0.0, 1.0, 0.0);
        assert_eq!(single(vector(2.0, -2.0, 0.0), up, Section::SymmetricParabola).curvature, 1.0);
        assert_eq!(single(vector(2.0, 2.0, 0.0), up, Section::SymmetricParabola).curvature, -1.0);
        assert_eq!(single(vector(2.0, 0.0, 7.0), up, Section::SymmetricParabola).curvature, 0.0);
    }

    #[test]
    fn edges_without_a_value_weigh_nothing() {
        let normal = vector(2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0);
        for along in [normal, normal * -1.5, normal * (1.0 / 3.0)] {
            for section in Section::ALL {
                let found = single(along, normal, section);
                assert_eq!((found.curvature, found.weight), (0.0, 0.0));
            }
        }
        for section in Section::ALL {
            let found = single(Vector3::zero(), normal, section);
            assert_eq!((found.curvature, found.weight), (0.0, 0.0));
            // Single precision leaves it to double precision.
            let found = super::edge(Vector3::<f32>::zero(), 0.0, Vector3::zero(), section);
            assert!(found.curvature.is_nan() && found.weight == 0.0);
        }
    }

    /// The lanes of any width answer as one lane does.
    struct Compare(u64);

    impl Task for Compare {
        #[inline(always)]
        fn run<W: Width>(self) {
            compare::<W::Double>(self.0);
        }
    }

    fn compare<V: Vector<Scalar = f64>>(seed: u64) {
        let mut number = numbers(seed);
        for round in 0..500 {
            let mut lanes = [[0.0; MAX_LANES]; 11];
            for lane in 0..V::LANES {
                for row in &mut lanes {
                    row[lane] = number();
                }
                // Cusps, straight corners and edges without length among them.
                match (round + lane) % 7 {
                    0 => (0..3).for_each(|axis| lanes[3 + axis][lane] = -2.0 * lanes[axis][lane]),
                    1 => (0..3).for_each(|axis| lanes[3 + axis][lane] = 4.0 * lanes[axis][lane]),
                    2 => (0..3).for_each(|axis| lanes[axis][lane] = 0.0),
                    3 => (0..3).for_each(|axis| lanes[3 + axis][lane] = lanes[axis][lane]),
                    _ => (),
                }
                (lanes[6][lane], lanes[7][lane]) = (1.0, if lane % 2 == 0 { 1.0 } else { 0.125 });
                for axis in 0..3 {
                    lanes[8 + axis][lane] = lanes[3 + axis][lane] * lanes[7][lane] - lanes[axis][lane];
                }
            }
            let three = |row: usize| [lanes[row], lanes[row + 1], lanes[row + 2]];
            let all = ThreePoints::<V>::new(
                Vector3::from_lanes(&three(0)),
                V::from_lanes(&lanes[6]),
                Vector3::from_lanes(&three(3)),
                V::from_lanes(&lanes[7]),
                Vector3::from_lanes(&three(8)),
            );
            #[expect(clippy::needless_range_loop, reason = "a lane is a column of every row")]
            for lane in 0..V::LANES {
                let point = |row: usize| vector(lanes[row][lane], lanes[row + 1][lane], lanes[row + 2][lane]);
                let one = ThreePoints::new(point(0), lanes[6][lane], point(3), lanes[7][lane], point(8));
                assert_eq!(one.cusp.to_bits(), all.cusp.to_lanes()[lane].to_bits());
                assert_eq!(one.coincident.to_bits(), all.coincident.to_lanes()[lane].to_bits());
                for section in Section::ALL {
                    let found = all.curvature(section, V::constant(4.0)).to_lanes()[lane];
                    assert_eq!(one.curvature(section, 4.0).to_bits(), found.to_bits(), "{section:?}");
                    assert!(found >= 0.0, "{section:?}: {found}");
                    let (edge, normal) = (Vector3::<V>::from_lanes(&three(0)), Vector3::from_lanes(&three(3)));
                    let found = super::edge(edge, edge.squared(), normal, section);
                    let expected = single(point(0), point(3), section);
                    assert_eq!(expected.curvature.to_bits(), found.curvature.to_lanes()[lane].to_bits());
                    assert_eq!(expected.weight.to_bits(), found.weight.to_lanes()[lane].to_bits());
                }
            }
        }
    }

    #[test]
    fn every_width_has_the_same_bits() {
        for level in Level::all() {
            dispatch(level, Compare(7));
        }
    }
}

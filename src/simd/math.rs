//! Angle and tangent from polynomials of our own, so that no host's `libm` decides a bit.
//!
//! - `atan(q)/q` on `q ∈ [0, 1]` is an even function; Chebyshev interpolation in `q²`, degree 9 for `f32`
//!   (relative error 2.8e-9 before rounding) and 20 for `f64` (5.4e-18).
//! - `tan(πy/2) = y·r(y²) / ((1 − y)(1 + y))`: the pole at `y = 1` is exact, and `r` is a polynomial of degree 5
//!   for `f32` (1.3e-9) and 10 for `f64` (1.1e-16).
//!
//! Coefficients: interpolation at the Chebyshev nodes of `q² ∈ [0, 1]`, solved in 40 digits.

use super::vector::{Real, Vector};

const ATAN_SINGLE: [f64; 10] = [
    0.9999999971605454,
    -0.3333327629198255,
    0.19998075281148714,
    -0.14260016082820906,
    0.10932341501303093,
    -0.08349724968301601,
    0.05708955593030619,
    -0.030351864785781172,
    0.010487649254949306,
    -0.0017011700640685973,
];
const ATAN_DOUBLE: [f64; 21] = [
    1.0,
    -0.3333333333333286,
    0.19999999999929946,
    -0.14285714281592693,
    0.11111110982087126,
    -0.09090906605656898,
    0.0769227555520563,
    -0.06666371187721098,
    0.05880342002401543,
    -0.052527255573225747,
    0.04719723992321112,
    -0.042125723963855326,
    0.03651081352721035,
    -0.02970071773623423,
    0.021740213830758134,
    -0.013674139288399478,
    0.007038646202989813,
    -0.0028047655531701315,
    0.0008033604181626027,
    -0.00014617088163625013,
    1.2631178430477426e-05,
];
const TANGENT_SINGLE: [f64; 6] = [
    1.5707963282706001,
    -0.278868237869289,
    -0.016844947255868634,
    -0.0016500477972181363,
    -0.00016625407683193034,
    -2.7294876298592456e-05,
];
const TANGENT_DOUBLE: [f64; 11] = [
    std::f64::consts::FRAC_PI_2,
    -0.2788681317823962,
    -0.016846175074134075,
    -0.001644895127107918,
    -0.0001758823729857074,
    -1.9296421091805877e-05,
    -2.1352377407442993e-06,
    -2.3588642902851896e-07,
    -2.7392218318030056e-08,
    -2.151102713983928e-09,
    -6.145273169294798e-10,
];

#[inline(always)]
fn horner<V: Vector>(coefficients: &[f64], x: V) -> V {
    let (last, rest) = coefficients.split_last().expect("a polynomial has a coefficient");
    let mut value = V::constant(*last);
    for &coefficient in rest.iter().rev() {
        value = value * x + V::constant(coefficient);
    }
    value
}

/// The angle in `[0, π]` whose sine and cosine are in the ratio `sine : cosine` (with `sine ≥ 0`), and `1/sine`.
///
/// One division serves both. Where `sine` is too small to divide by, the reciprocal is 0 and the angle is 0 or π
/// by the sign of `cosine`, and 0 where both are zero. Accurate to a few units in the last place over the whole
/// range, slivers included, because nothing is subtracted from 1.
#[inline(always)]
pub(crate) fn atan2_and_reciprocal<V: Vector>(sine: V, cosine: V) -> (V, V) {
    let width = cosine.abs();
    let small = sine.min(width);
    let large = sine.max(width);
    let reciprocal = (sine * large).reciprocal_or_zero();
    let quotient = small * (reciprocal * sine);
    let square = quotient * quotient;
    let polynomial = if V::Scalar::SINGLE { horner(&ATAN_SINGLE, square) } else { horner(&ATAN_DOUBLE, square) };
    let octant = quotient * polynomial;
    let quadrant = V::select(width.lt(sine), V::constant(std::f64::consts::FRAC_PI_2) - octant, octant);
    let obtuse = cosine.lt(V::zero());
    let angle = V::select(obtuse, V::constant(std::f64::consts::PI) - quadrant, quadrant);
    (angle, reciprocal * large)
}

/// Numerator and denominator of `tan(πy/2)` for `y ∈ [0, 1)`: `y·r(y²)` and `(1 − y)(1 + y)`.
#[inline(always)]
pub(crate) fn tangent_parts<V: Vector>(y: V) -> (V, V) {
    let square = y * y;
    let polynomial =
        if V::Scalar::SINGLE { horner(&TANGENT_SINGLE, square) } else { horner(&TANGENT_DOUBLE, square) };
    (y * polynomial, (V::one() - y) * (V::one() + y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angle_agrees_with_libm_over_every_octant_and_scale() {
        let mut worst = (0.0f64, 0.0f64);
        for step in 0..=200_000 {
            let angle = std::f64::consts::PI * step as f64 / 200_000.0;
            for radius in [1e-3, 1.0, 7.3] {
                let (sine, cosine) = ((radius * angle.sin()).max(0.0), radius * angle.cos());
                let expected = sine.atan2(cosine);
                let (double, inverse) = atan2_and_reciprocal(sine, cosine);
                worst.0 = worst.0.max((double - expected).abs() / expected.max(1e-12));
                if sine > 0.0 {
                    assert!((inverse * sine - 1.0).abs() < 1e-15);
                }
                let (sine, cosine) = (sine as f32, cosine as f32);
                let expected = (sine as f64).atan2(cosine as f64);
                let (single, _) = atan2_and_reciprocal(sine, cosine);
                worst.1 = worst.1.max((single as f64 - expected).abs() / expected.max(1e-12));
            }
        }
        assert!(worst.0 < 6e-16, "f64 {:e}", worst.0);
        assert!(worst.1 < 3e-7, "f32 {:e}", worst.1);
    }

    #[test]
    fn angle_of_slivers_and_of_nothing() {
        for power in 1..140 {
            let sine = 2f64.powi(-power);
            let (angle, expected) = (atan2_and_reciprocal(sine, 1.0).0, sine.atan2(1.0));
            assert!((angle - expected).abs() <= f64::EPSILON * expected, "2^-{power}: {angle} {expected}");
        }
        assert_eq!(atan2_and_reciprocal(0.0, 1.0), (0.0, 0.0));
        assert_eq!(atan2_and_reciprocal(0.0, -1.0), (std::f64::consts::PI, 0.0));
        assert_eq!(atan2_and_reciprocal(0.0, 0.0), (0.0, 0.0));
    }

    #[test]
    fn tangent_agrees_with_libm_up_to_the_pole() {
        let mut worst = (0.0f64, 0.0f64);
        for step in 1..100_000 {
            let y = step as f64 / 100_000.0;
            let expected = (std::f64::consts::FRAC_PI_2 * y).tan();
            let (numerator, denominator) = tangent_parts(y);
            // libm's argument is rounded: near the pole it is that rounding which is measured.
            let tolerance_of_argument = 4.0 * f64::EPSILON * expected.max(1.0);
            worst.0 =
                worst.0.max((numerator / denominator / expected - 1.0).abs() / (1.0 + tolerance_of_argument / 1e-16));
            let single = y as f32;
            let expected = (std::f64::consts::FRAC_PI_2 * single as f64).tan();
            let (numerator, denominator) = tangent_parts(single);
            worst.1 = worst.1.max(((numerator / denominator) as f64 / expected - 1.0).abs());
        }
        assert!(worst.0 < 1e-15, "f64 {:e}", worst.0);
        assert!(worst.1 < 6e-7, "f32 {:e}", worst.1);
    }
}

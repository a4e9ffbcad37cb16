//! Colors for numbers: blue below, nearly white at the center, red above.
//!
//! The map is computed in OKLab (Björn Ottosson 2020), a space in which equal steps look about equal. On both arms
//! lightness falls in equal steps from the center to the end, so that the map can be read without its hues too, and
//! arms of the same distance from the center are equally light and equally strong. Hue stays the same on an arm;
//! chroma rises by a parabola that stays within what sRGB can show at both hues. Blue and red remain apart for the
//! common kinds of color blindness.

/// The color of what has no value.
pub const NOTHING: [u8; 3] = [128; 3];

/// Lightness at the center and at the ends.
const LIGHTNESS: [f64; 2] = [0.95, 0.45];

/// The hues of the arms, in degrees: below and above.
const HUES: [f64; 2] = [260.0, 25.0];

/// The color at a place from -1 to 1; the center is 0. Places beyond have the color of the end.
pub fn color(place: f64) -> [u8; 3] {
    linear(place).map(encode)
}

/// The color at a place, in linear sRGB.
fn linear(place: f64) -> [f64; 3] {
    let distance = place.abs().min(1.0);
    let lightness = LIGHTNESS[0] + (LIGHTNESS[1] - LIGHTNESS[0]) * distance;
    let chroma = distance * (0.40 - 0.24 * distance);
    let (sin, cos) = HUES[usize::from(place > 0.0)].to_radians().sin_cos();
    oklab_to_linear([lightness, chroma * cos, chroma * sin])
}

/// From OKLab to linear sRGB, with the matrices of its definition.
pub fn oklab_to_linear([lightness, a, b]: [f64; 3]) -> [f64; 3] {
    let cones = [
        lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b,
        lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b,
        lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b,
    ]
    .map(|root| root * root * root);
    [
        [4.076_741_662_1, -3.307_711_591_3, 0.230_969_929_2],
        [-1.268_438_004_6, 2.609_757_401_1, -0.341_319_396_5],
        [-0.004_196_086_3, -0.703_418_614_7, 1.707_614_701_0],
    ]
    .map(|row| row[0] * cones[0] + row[1] * cones[1] + row[2] * cones[2])
}

/// Encodes linear light as a byte of sRGB.
pub fn encode(value: f64) -> u8 {
    let value = value.clamp(0.0, 1.0);
    let encoded = if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_and_gray_is_gray() {
        assert_eq!(oklab_to_linear([1.0, 0.0, 0.0]).map(encode), [255; 3]);
        assert_eq!(oklab_to_linear([0.6, 0.0, 0.0]).map(encode), [128; 3]);
    }

    #[test]
    fn all_colors_can_be_shown() {
        for step in -1000..=1000 {
            let color = linear(f64::from(step) / 1000.0);
            assert!(color.iter().all(|value| (0.0..=1.0).contains(value)), "{step}: {color:?}");
        }
    }

    #[test]
    fn both_arms_darken_steadily_and_alike() {
        let luminance = |place| {
            let [red, green, blue] = linear(place);
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        };
        for step in 0..100 {
            let [near, far] = [f64::from(step) / 100.0, f64::from(step + 1) / 100.0];
            assert!(luminance(far) < luminance(near) && luminance(-far) < luminance(-near), "{near}");
            assert!((luminance(far).cbrt() - luminance(-far).cbrt()).abs() < 0.06, "{far}");
        }
    }

    #[test]
    fn below_is_blue_and_above_is_red() {
        let [red, _, blue] = color(-1.0);
        assert!(blue > 2 * red.max(1));
        let [red, _, blue] = color(1.0);
        assert!(red > 2 * blue.max(1));
        let center = color(0.0);
        assert!(center[0] == center[1] && center[1] == center[2] && center[0] > 230, "{center:?}");
        assert_eq!((color(-7.0), color(f64::INFINITY)), (color(-1.0), color(1.0)));
    }
}

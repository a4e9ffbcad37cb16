//! Colors for labels: as many as are asked for, each far from those of the labels next to it.
//!
//! Hues go around by the golden angle, so that any run of labels has them well spread. Where hues come near each other
//! again, after 8, 13 or 21 labels, lightness differs: it has seven levels, in the order that keeps labels up to 20 apart
//! farthest from each other. Chroma is the largest that sRGB can show, up to a limit. All of it is computed in OKLab, as
//! the [`colormap`](crate::colormap).

use crate::colormap::{encode, oklab_to_linear};

/// The golden angle in degrees.
const STEP: f64 = 137.507_764_050_037_85;

/// The lightness of the first labels, and of as many after them again and again.
const LIGHTNESS: [f64; 7] = [0.48, 0.60, 0.72, 0.78, 0.85, 0.66, 0.54];

/// The largest chroma.
const CHROMA: f64 = 0.17;

/// The steps in which chroma is taken back to what can be shown.
const STEPS: u32 = 16;

/// The color of a label.
pub fn color(label: u32) -> [u8; 3] {
    oklab_to_linear(oklab(label)).map(encode)
}

/// The color of a label in OKLab.
fn oklab(label: u32) -> [f64; 3] {
    let (sin, cos) = (f64::from(label) * STEP).rem_euclid(360.0).to_radians().sin_cos();
    let lightness = LIGHTNESS[label as usize % LIGHTNESS.len()];
    let of_chroma = |chroma: f64| [lightness, chroma * cos, chroma * sin];
    (1..=STEPS)
        .rev()
        .map(|step| of_chroma(CHROMA * f64::from(step) / f64::from(STEPS)))
        .find(|&color| oklab_to_linear(color).iter().all(|value| (0.0..=1.0).contains(value)))
        .unwrap_or(of_chroma(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colormap::NOTHING;

    #[test]
    fn colors_of_near_labels_are_far_apart() {
        let distance = |a: u32, b: u32| {
            let squares = oklab(a).into_iter().zip(oklab(b)).map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>().sqrt()
        };
        // Black and white are 1 apart, and what differs by 0.02 can be told apart side by side.
        for (apart, least) in [(6, 0.08), (12, 0.07), (20, 0.06), (50, 0.015)] {
            for a in 0..100 {
                assert!((a + 1..=a + apart).all(|b| distance(a, b) > least), "{a}: {least}");
            }
        }
    }

    #[test]
    fn no_color_is_that_of_nothing_or_too_dark_to_be_shaded() {
        for label in (0..1000).chain([u32::MAX - 1]) {
            let color = color(label);
            let [low, high] = [color.iter().min(), color.iter().max()].map(|value| value.copied().unwrap_or(0));
            assert!(color != NOTHING && high - low > 20 && high > 95, "{label}: {color:?}");
        }
    }
}

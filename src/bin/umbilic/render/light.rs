//! Turns normals into colors.
//!
//! The lamps belong to the camera, so a mesh looks equally well lit from every side. Colors are computed in linear
//! light and encoded as sRGB at the end.

use super::raster::Shade;

/// The color of clay in linear light.
pub(super) const CLAY: [f32; 3] = [0.60, 0.54, 0.48];

/// The color that stands for a normal.
pub(super) fn show_normal(shade: Shade) -> [f32; 3] {
    unit(shade.normal).map(|value| srgb_to_linear(value * 0.5 + 0.5))
}

/// The light that a surface sends to the viewer, who looks along the third axis.
pub(super) fn light(Shade { normal, color }: Shade) -> [f32; 3] {
    /// A light that shines from a direction and falls off behind the edge of its half space instead of at it, as a
    /// large lamp does.
    struct Lamp {
        /// The direction to the lamp.
        direction: [f32; 3],
        /// Its color and strength.
        color: [f32; 3],
        /// How far it reaches around the edge.
        wrap: f32,
    }
    const LAMPS: [Lamp; 3] = [
        // The main light comes from the upper left.
        Lamp { direction: [-0.58, 0.64, 0.50], color: [0.98, 0.95, 0.90], wrap: 0.1 },
        // The head light shows the form where the main light is absent.
        Lamp { direction: [0.0, 0.0, 1.0], color: [0.17, 0.17, 0.17], wrap: 0.0 },
        // A soft cool light from the right keeps the shadow side apart.
        Lamp { direction: [0.87, -0.10, 0.48], color: [0.13, 0.16, 0.21], wrap: 0.3 },
    ];
    const SKY: [f32; 3] = [0.11, 0.12, 0.135];
    const GROUND: [f32; 3] = [0.05, 0.042, 0.037];
    const SHININESS: i32 = 32;
    const GLOSS: f32 = 0.10;

    let normal = unit(normal);
    let upwards = normal[1] * 0.5 + 0.5;
    let mut received: [f32; 3] = std::array::from_fn(|i| GROUND[i] + (SKY[i] - GROUND[i]) * upwards);
    let mut reflected = 0.0;
    for lamp in LAMPS {
        let cosine = dot32(normal, lamp.direction);
        let amount = ((cosine + lamp.wrap) / (1.0 + lamp.wrap)).max(0.0);
        for (total, lamp_color) in received.iter_mut().zip(lamp.color) {
            *total += lamp_color * amount;
        }
        let [x, y, z] = lamp.direction;
        let halfway = unit([x, y, z + 1.0]);
        reflected += dot32(normal, halfway).max(0.0).powi(SHININESS) * lamp.color[0];
    }
    std::array::from_fn(|i| color[i] * received[i] + GLOSS * reflected)
}

/// The color itself where the surface faces the viewer and the main light, darker elsewhere, but never of another hue.
pub(super) fn shade_mildly(Shade { normal, color }: Shade) -> [f32; 3] {
    const DARKEST: f32 = 0.35;
    const LAMP: [f32; 3] = [-0.45, 0.50, 0.74];
    let normal = unit(normal);
    let wrapped = (dot32(normal, LAMP) * 0.5 + 0.5).clamp(0.0, 1.0);
    let facing = normal[2].clamp(0.0, 1.0);
    let amount = DARKEST + (1.0 - DARKEST) * (wrapped * wrapped * (0.4 + 0.6 * facing.sqrt()));
    color.map(|value| value * amount)
}

/// Decodes a byte of the sRGB color space into linear light.
pub(super) fn to_linear(byte: u8) -> f32 {
    srgb_to_linear(f32::from(byte) / 255.0)
}

/// Decodes a value of the sRGB color space into linear light.
fn srgb_to_linear(value: f32) -> f32 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// Encodes linear light as a byte of the sRGB color space.
pub(super) fn to_srgb(value: f32) -> u8 {
    let encoded = if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

/// The scalar product of two vectors of single precision.
fn dot32(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Scales a vector to unit length; the zero vector stays.
fn unit(vector: [f32; 3]) -> [f32; 3] {
    let length = dot32(vector, vector).sqrt();
    if length > 0.0 { vector.map(|value| value / length) } else { vector }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_encoding_of_bytes_is_undone_exactly() {
        for byte in 0..=255 {
            assert_eq!(to_srgb(to_linear(byte)), byte);
        }
    }

    #[test]
    fn mild_shades_keep_hues() {
        let color = [0.8, 0.4, 0.2];
        for normal in [[0.0, 0.0, 1.0], [-0.6, 0.6, 0.5], [0.9, -0.4, 0.1], [0.0; 3]] {
            let [red, green, blue] = shade_mildly(Shade { normal, color });
            assert!((0.28..=0.8).contains(&red), "{normal:?}: {red}");
            assert!((green / red - 0.5).abs() < 1e-6 && (blue / red - 0.25).abs() < 1e-6);
        }
    }

    #[test]
    fn a_surface_is_brighter_towards_the_main_lamp() {
        let color = [0.5; 3];
        let brightness = |normal| light(Shade { normal, color })[1];
        assert!(brightness([-0.6, 0.6, 0.5]) > 2.0 * brightness([0.6, -0.6, 0.5]));
        assert!(brightness([0.0, -1.0, 0.0]) > 0.0);
    }
}

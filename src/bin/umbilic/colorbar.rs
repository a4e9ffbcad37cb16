//! Draws what the colors of a [`Scale`] stand for into a small PNG file.

use crate::output::{WriteError, write_file};
use crate::scale::Scale;
use crate::table;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use std::path::Path;

const WIDTH: usize = 480;
const HEIGHT: usize = 72;

/// The columns and rows of the colors, within a frame of one pixel.
const BAR: [usize; 4] = [40, 440, 12, 36];

/// How far ticks reach below the frame.
const TICK: usize = 6;

/// How many pixels along each side make a dot of a character.
const DOT: usize = 2;

/// The columns of a character, with the gap after it.
const ADVANCE: usize = 6 * DOT;

const WHITE: [u8; 3] = [255; 3];
const BLACK: [u8; 3] = [0; 3];

/// Writes a color bar, with ticks and numbers at the ends and at 0.
pub fn write_colorbar(path: &Path, scale: &Scale) -> Result<(), WriteError> {
    let pixels = draw(scale);
    write_file(path, |out| {
        PngEncoder::new(out)
            .write_image(pixels.as_flattened(), WIDTH as u32, HEIGHT as u32, ExtendedColorType::Rgb8)
            .map_err(std::io::Error::other)
    })
}

/// The rows of the picture.
fn draw(scale: &Scale) -> Vec<[u8; 3]> {
    let mut pixels = vec![WHITE; WIDTH * HEIGHT];
    let [left, right, top, bottom] = BAR;
    let steps = (right - 1 - left) as f64;
    for row in top - 1..=bottom {
        for column in left - 1..=right {
            let inside = (top..bottom).contains(&row) && (left..right).contains(&column);
            let part = (column.max(left) - left) as f64 / steps;
            // Not the difference times the part, which may leave the range.
            let value = scale.low * (1.0 - part) + scale.high * part;
            pixels[row * WIDTH + column] = if inside { scale.color(value) } else { BLACK };
        }
    }
    let mut free = [true; WIDTH];
    let zero = (scale.low < 0.0 && scale.high > 0.0).then(|| {
        let part = 1.0 / (1.0 + scale.high / -scale.low);
        (0.0, left + (part * steps).round() as usize)
    });
    // The ends come first: where there is no room for the zero's number, it keeps its tick.
    for (value, column) in [(scale.low, left), (scale.high, right - 1)].into_iter().chain(zero) {
        for row in bottom..bottom + TICK {
            pixels[row * WIDTH + column] = BLACK;
        }
        // Four digits are enough to read a color by.
        let label = table::number(format!("{value:.3e}").parse().unwrap_or(value));
        let length = (label.chars().count() * ADVANCE).min(WIDTH);
        let start = (column + DOT).saturating_sub(length / 2).min(WIDTH - length);
        let columns = start.saturating_sub(ADVANCE)..(start + length + ADVANCE).min(WIDTH);
        if free[columns.clone()].iter().all(|&free| free) {
            write(&mut pixels, &label, start, bottom + TICK + 2 * DOT);
            free[columns].fill(false);
        }
    }
    pixels
}

/// Writes a number, its upper left corner being there.
fn write(pixels: &mut [[u8; 3]], text: &str, left: usize, top: usize) {
    for (place, character) in text.chars().enumerate() {
        for (y, dots) in glyph(character).into_iter().enumerate() {
            for x in (0..5).filter(|x| dots >> (4 - x) & 1 == 1) {
                for pixel in 0..DOT * DOT {
                    let column = left + place * ADVANCE + x * DOT + pixel % DOT;
                    let row = top + y * DOT + pixel / DOT;
                    pixels[row * WIDTH + column] = BLACK;
                }
            }
        }
    }
}

/// The dots of a character that numbers are made of, seven rows of five.
fn glyph(character: char) -> [u8; 7] {
    match character {
        '0' => [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111],
        '3' => [0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b01110, 0b10000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b00100, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00001, 0b01110],
        '-' => [0, 0, 0, 0b01110, 0, 0, 0],
        '.' => [0, 0, 0, 0, 0, 0b00100, 0b00100],
        'e' => [0, 0, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110],
        _ => [0b11111; 7],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_the_ticks_and_the_numbers_are_there() {
        for (low, high) in [(-1.0, 1.0), (-12.3456, 1.5), (0.0, 1.5e-30), (2.0, 3.0), (-f64::MAX, f64::MAX)] {
            let scale = Scale { low, high };
            let pixels = draw(&scale);
            let [left, right, top, bottom] = BAR;
            assert_eq!(pixels[top * WIDTH + left], scale.color(low));
            assert_eq!(pixels[top * WIDTH + right - 1], scale.color(high));
            let ticks = pixels[(bottom + TICK - 1) * WIDTH..(bottom + TICK) * WIDTH].iter();
            assert_eq!(ticks.filter(|&&pixel| pixel == BLACK).count(), 2 + usize::from(low < 0.0 && high > 0.0));
            assert!(pixels[(bottom + TICK + 1) * WIDTH..].contains(&BLACK));
        }
    }

    #[test]
    fn every_character_of_a_number_has_dots() {
        for value in [-1.234_567e-300, 98_765.4] {
            assert!(table::number(value).chars().all(|character| glyph(character) != [0b11111; 7]));
        }
    }
}

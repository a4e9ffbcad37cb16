//! Fills triangles on a canvas with a depth for every sample.
//!
//! Corners are rounded to a fine integer grid, on which the side of an edge is decided exactly: triangles that share
//! an edge leave no gap along it, which rasterizers that work in floating point do. Nothing is clipped in depth, so
//! all corners must lie in front of the camera.

use std::ops::Range;

/// The grid points per sample along each side.
const GRID: i64 = 256;

/// How much farther away a triangle's back counts than it is, so that along the outline of a closed surface its back
/// does not show through the front.
const BACK_OFFSET: f32 = 1e-3;

/// A grid of samples with colors and depths.
pub(super) struct Canvas {
    /// The number of samples per row.
    width: usize,
    /// The number of rows.
    height: usize,
    /// The color of each sample in linear light, row after row.
    colors: Vec<[f32; 3]>,
    /// The depth of each sample.
    depths: Vec<f32>,
}

/// A corner of a triangle on the canvas.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// The position in samples from the upper left.
    pub(super) place: [f64; 2],
    /// What decides which of two triangles is in front: the smaller value. It must be linear on the canvas.
    pub(super) depth: f32,
    /// One over the distance by which perspective divides.
    pub(super) nearness: f32,
    /// What is interpolated in space.
    pub(super) shade: Shade,
}

/// What decides on the color of a sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shade {
    /// The normal, of any length.
    pub(super) normal: [f32; 3],
    /// The color of the surface in linear light.
    pub(super) color: [f32; 3],
}

/// How colors of corners become those of a triangle; normals are interpolated in any case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Blend {
    /// They are interpolated.
    Mixed,
    /// Each sample has the color of the corner that weighs most.
    Nearest,
}

impl Canvas {
    /// An empty canvas of one color.
    pub(super) fn new(width: usize, height: usize, background: [f32; 3]) -> Self {
        Self { width, height, colors: vec![background; width * height], depths: vec![f32::INFINITY; width * height] }
    }

    /// The rows of the canvas from top to bottom.
    pub(super) fn rows(&self) -> std::slice::ChunksExact<'_, [f32; 3]> {
        self.colors.chunks_exact(self.width)
    }

    /// Fills a triangle where it is in front, asking `paint` for the colors. Seen from its front, the corners go
    /// around counterclockwise.
    pub(super) fn fill(&mut self, mut corners: [Corner; 3], blend: Blend, paint: impl Fn(Shade) -> [f32; 3]) {
        let mut places = corners.map(snap);
        let is_front = doubled_area(places) < 0;
        if is_front {
            corners.swap(1, 2);
            places.swap(1, 2);
        }
        let area = doubled_area(places);
        if area == 0 {
            return;
        }
        let offset = if is_front { 0.0 } else { BACK_OFFSET };
        let [a, b, c] = places;
        let depths = corners.map(|corner| [corner.depth + offset]);
        let nearness = corners.map(|corner| corner.nearness);
        let normals = corners.map(|corner| corner.shade.normal);
        let colors = corners.map(|corner| corner.shade.color);

        for row in covered([a[1], b[1], c[1]], self.height) {
            for column in covered([a[0], b[0], c[0]], self.width) {
                let sample = [column, row].map(|index| index as i64 * GRID + GRID / 2);
                let sides = [[b, c, sample], [c, a, sample], [a, b, sample]].map(doubled_area);
                if sides.iter().any(|&side| side < 0) {
                    continue;
                }
                let weights = sides.map(|side| side as f32 / area as f32);
                let [depth] = mix(depths, weights);
                let index = row * self.width + column;
                if depth >= self.depths[index] {
                    continue;
                }
                self.depths[index] = depth;
                // Distances shrink on the canvas with the distance in space.
                let weights: [f32; 3] = std::array::from_fn(|i| weights[i] * nearness[i]);
                let total: f32 = weights.iter().sum();
                let weights = weights.map(|weight| weight / total);
                let color = match blend {
                    Blend::Mixed => mix(colors, weights),
                    Blend::Nearest => colors[heaviest(weights)],
                };
                self.colors[index] = paint(Shade { normal: mix(normals, weights), color });
            }
        }
    }
}

/// The samples, of `count` along an axis, that may lie between grid points.
fn covered(points: [i64; 3], count: usize) -> Range<usize> {
    let clamp = |point: i64| point.div_euclid(GRID).clamp(0, count as i64) as usize;
    let [a, b, c] = points;
    clamp(a.min(b).min(c))..clamp(a.max(b).max(c) + GRID)
}

/// Rounds the place of a corner to the grid.
fn snap(corner: Corner) -> [i64; 2] {
    corner.place.map(|value| (value * GRID as f64).round() as i64)
}

/// Twice the area of a triangle on the grid, positive if its corners go around clockwise, with rows going down.
fn doubled_area([a, b, c]: [[i64; 2]; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The place of the largest weight.
fn heaviest([a, b, c]: [f32; 3]) -> usize {
    match (a >= b && a >= c, b >= c) {
        (true, _) => 0,
        (_, true) => 1,
        _ => 2,
    }
}

/// The weighted sum of three vectors.
fn mix<const N: usize>(vectors: [[f32; N]; 3], weights: [f32; 3]) -> [f32; N] {
    std::array::from_fn(|i| vectors[0][i] * weights[0] + vectors[1][i] * weights[1] + vectors[2][i] * weights[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHADE: Shade = Shade { normal: [0.0, 0.0, 1.0], color: [1.0, 0.5, 0.25] };

    fn corner(x: f64, y: f64, depth: f32) -> Corner {
        Corner { place: [x, y], depth, nearness: 1.0, shade: SHADE }
    }

    #[test]
    fn triangles_around_a_point_leave_no_gap() {
        let mut canvas = Canvas::new(64, 64, [0.0; 3]);
        let around: Vec<[f64; 2]> = (0..=97)
            .map(|i| (f64::from(i % 97) / 97.0 * std::f64::consts::TAU).sin_cos())
            .map(|(sin, cos)| [32.3 + 90.0 * cos, 31.7 + 90.0 * sin])
            .collect();
        for pair in around.windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|[x, y]| corner(x, y, 0.0));
            canvas.fill([corner(32.3, 31.7, 0.0), from, to], Blend::Mixed, |shade| shade.color);
        }
        assert!(canvas.rows().flatten().all(|color| color[0] > 0.99));
    }

    #[test]
    fn the_nearer_triangle_wins_in_any_order() {
        let triangle = |depth| [[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]].map(|[x, y]| corner(x, y, depth));
        for near_first in [true, false] {
            let mut canvas = Canvas::new(4, 4, [0.0; 3]);
            for is_near in [near_first, !near_first] {
                let depth = if is_near { -0.5 } else { -0.2 };
                canvas.fill(triangle(depth), Blend::Mixed, |_| [f32::from(u8::from(is_near)); 3]);
            }
            assert_eq!(canvas.rows().next().unwrap()[0], [1.0; 3]);
        }
    }

    #[test]
    fn perspective_moves_the_middle_away() {
        let mut canvas = Canvas::new(101, 3, [0.0; 3]);
        let place = |x, y, nearness, red| Corner {
            place: [x, y],
            depth: 0.0,
            nearness,
            shade: Shade { color: [red, 0.0, 0.0], ..SHADE },
        };
        let near = place(0.0, 1.5, 1.0, 0.0);
        let far = [-9.0, 9.0].map(|y| place(101.0, y, 1.0 / 3.0, 1.0));
        canvas.fill([near, far[0], far[1]], Blend::Mixed, |shade| shade.color);
        // In the middle of the canvas, three quarters of the weight is near.
        let middle = canvas.rows().nth(1).unwrap()[50][0];
        assert!((middle - 0.25).abs() < 0.01, "{middle}");
    }

    #[test]
    fn without_mixing_every_sample_has_the_color_of_a_corner() {
        let colors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let places = [[0.0, 0.0], [0.0, 20.0], [20.0, 0.0]];
        let corners = [0, 1, 2].map(|at| Corner {
            shade: Shade { color: colors[at], ..SHADE },
            ..corner(places[at][0], places[at][1], 0.0)
        });
        let mut canvas = Canvas::new(20, 20, [0.5; 3]);
        canvas.fill(corners, Blend::Nearest, |shade| shade.color);
        let rows: Vec<_> = canvas.rows().collect();
        assert!(rows.iter().flat_map(|row| row.iter()).all(|color| *color == [0.5; 3] || colors.contains(color)));
        assert_eq!([rows[1][1], rows[17][1], rows[1][17]], colors);
    }

    #[test]
    fn triangles_without_area_or_outside_are_skipped() {
        let mut canvas = Canvas::new(4, 4, [0.0; 3]);
        canvas.fill([corner(1.0, 1.0, 0.0); 3], Blend::Mixed, |_| [1.0; 3]);
        let outside = [[-9.0, -9.0], [-9.0, -1.0], [-1.0, -9.0]];
        canvas.fill(outside.map(|[x, y]| corner(x, y, 0.0)), Blend::Mixed, |_| [1.0; 3]);
        assert!(canvas.rows().flatten().all(|color| *color == [0.0; 3]));
    }
}

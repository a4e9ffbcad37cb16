//! Places the camera and projects the mesh onto the canvas.
//!
//! The camera looks at the center of the vertices in use; afterwards the projected mesh is moved and magnified to
//! fill the canvas. Everything is in double precision, so that meshes far from the origin keep their details.

use super::raster::{Corner, Shade};
use super::{Projection, RenderOptions, SAMPLES, UpAxis};
use crate::mesh::PolygonMesh;

/// The part of the picture that the mesh may fill.
const FILLED: f64 = 0.9;

/// The distance of the perspective camera, in radii of the mesh.
const CAMERA_DISTANCE: f64 = 4.0;

/// Where the camera stands and what it sees of the mesh.
pub(super) struct Camera {
    /// The directions to the right, up and to the viewer, as rows.
    axes: [[f64; 3]; 3],
    /// The center of the mesh.
    center: [f64; 3],
    /// One over the radius of the mesh around its center.
    scale: f64,
    /// How depth is shown.
    projection: Projection,
    /// The projected point that comes to the middle of the picture.
    middle: [f64; 2],
    /// The width and height of the canvas in samples.
    canvas: [f64; 2],
    /// The samples per unit of the projection.
    zoom: f64,
}

impl Camera {
    /// Fits the view to the vertices of faces.
    pub(super) fn new(mesh: &PolygonMesh, options: &RenderOptions<'_>) -> Self {
        let (sin_azimuth, cos_azimuth) = options.azimuth.to_radians().sin_cos();
        let (sin_elevation, cos_elevation) = options.elevation.to_radians().sin_cos();
        let axes = [
            [cos_azimuth, 0.0, -sin_azimuth],
            [-sin_azimuth * sin_elevation, cos_elevation, -cos_azimuth * sin_elevation],
            [sin_azimuth * cos_elevation, sin_elevation, cos_azimuth * cos_elevation],
        ];
        let axes = match options.up {
            UpAxis::Y => axes,
            UpAxis::Z => axes.map(|[x, y, z]| [x, -z, y]),
        };
        let seen: Vec<[f64; 3]> = mesh
            .indices
            .iter()
            .map(|&vertex| mesh.positions[vertex as usize])
            .filter(|position| position.iter().all(|value| value.is_finite()))
            .collect();
        // Halves avoid an overflow of enormous coordinates.
        let center = bounds(&seen).map(|(low, high)| low / 2.0 + high / 2.0);
        let radius = seen.iter().map(|&position| length(subtract(position, center))).fold(0.0, f64::max);
        let mut camera = Self {
            axes,
            center,
            scale: Some(radius.recip()).filter(|s| s.is_finite()).unwrap_or(1.0),
            projection: options.projection,
            middle: [0.0; 2],
            canvas: [options.width, options.height].map(|side| f64::from(side) * SAMPLES as f64),
            zoom: 1.0,
        };
        let projected: Vec<[f64; 2]> = seen.iter().map(|&point| camera.project(point).0).collect();
        let bounds = bounds(&projected);
        camera.middle = bounds.map(|(low, high)| f64::midpoint(low, high));
        // A mesh that is seen edge-on has no height or width to fit.
        let [width, height] = bounds.map(|(low, high)| (high - low).max(1e-6));
        camera.zoom = FILLED * f64::min(camera.canvas[0] / width, camera.canvas[1] / height);
        camera
    }

    /// Turns a vector into the camera's axes.
    fn turn(&self, vector: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, vector))
    }

    /// Where a point is from the center in the camera's axes, in radii.
    fn place(&self, position: [f64; 3]) -> [f64; 3] {
        self.turn(subtract(position, self.center)).map(|value| value * self.scale)
    }

    /// The place of a point in the projection, with the second axis going up, and its depth and nearness on the
    /// canvas.
    fn project(&self, position: [f64; 3]) -> ([f64; 2], f64, f64) {
        let [x, y, z] = self.place(position);
        match self.projection {
            Projection::Perspective => {
                let nearness = (CAMERA_DISTANCE - z).recip();
                // The factor makes depths comparable to those without perspective.
                let depth = -nearness * CAMERA_DISTANCE * CAMERA_DISTANCE;
                ([x * nearness, y * nearness], depth, nearness)
            }
            Projection::Orthographic => ([x, y], -z, 1.0),
        }
    }

    /// Puts a triangle on the canvas. What is lit has its normals in the camera's axes; else they stay.
    pub(super) fn see(&self, triangle: [([f64; 3], Shade); 3], lit: bool) -> [Corner; 3] {
        let [a, b, c] = triangle.map(|(position, _)| self.place(position));
        let normal = cross(subtract(b, a), subtract(c, a));
        let viewer = match self.projection {
            Projection::Perspective => subtract([0.0, 0.0, CAMERA_DISTANCE], a),
            Projection::Orthographic => [0.0, 0.0, 1.0],
        };
        let sign = if dot(normal, viewer) < 0.0 { -1.0 } else { 1.0 };
        let front = normal.map(|value| value * sign);
        triangle.map(|(position, shade)| {
            let ([x, y], depth, nearness) = self.project(position);
            Corner {
                place: [
                    self.canvas[0] / 2.0 + (x - self.middle[0]) * self.zoom,
                    self.canvas[1] / 2.0 - (y - self.middle[1]) * self.zoom,
                ],
                depth: depth as f32,
                nearness: nearness as f32,
                shade: if lit { Shade { normal: self.face_viewer(shade.normal, front), ..shade } } else { shade },
            }
        })
    }

    /// Turns a normal into the camera's axes and to the side of the triangle that is seen, so that reversed normals
    /// do not turn dark.
    fn face_viewer(&self, normal: [f32; 3], front: [f64; 3]) -> [f32; 3] {
        let turned = self.turn(normal.map(f64::from));
        let sign = if dot(turned, front) < 0.0 { -1.0 } else { 1.0 };
        turned.map(|value| (sign * value) as f32)
    }
}

/// The smallest and the largest value along each axis, or zeros if there is nothing.
fn bounds<const N: usize>(points: &[[f64; N]]) -> [(f64, f64); N] {
    std::array::from_fn(|axis| {
        points
            .iter()
            .map(|point| (point[axis], point[axis]))
            .reduce(|(low, high), (value, _)| (low.min(value), high.max(value)))
            .unwrap_or((0.0, 0.0))
    })
}

/// The difference of two vectors.
fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// The scalar product of two vectors.
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product of two vectors.
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The length of a vector.
fn length(vector: [f64; 3]) -> f64 {
    dot(vector, vector).sqrt()
}

//! Draws a shaded picture of a mesh into a PNG file, in software, without a GPU.
//!
//! The picture shows the normals it is given: they are interpolated over the triangles and lit per pixel by lights
//! that are fixed to the camera. Both sides of a surface are lit alike, so reversed faces or normals show up in
//! [`Surface::NormalColors`] but not in the other modes. The view is fitted to the vertices in use. Pictures are
//! drawn at twice their size and averaged down. Surfaces are opaque; there are no shadows, and what lies exactly in
//! the same place is drawn in the order of the faces.

mod camera;
mod light;
mod raster;
mod triangulate;

use crate::mesh::PolygonMesh;
use crate::output::{WriteError, write_file};
use camera::Camera;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use light::{light, shade_mildly, show_normal, to_linear, to_srgb};
use raster::Canvas;
use std::path::Path;
use triangulate::Triangulator;

/// How many samples are averaged along each side of a pixel.
const SAMPLES: usize = 2;

/// The largest width or height; larger pictures would take gigabytes.
pub const LARGEST_SIDE: u32 = 8192;

/// What the picture shows and how.
#[derive(Debug, Clone)]
pub struct RenderOptions<'a> {
    /// The width of the picture in pixels.
    pub width: u32,
    /// The height of the picture in pixels.
    pub height: u32,
    /// The angle in degrees by which the camera goes around the mesh, to the right of the front.
    pub azimuth: f64,
    /// The angle in degrees by which the camera looks down on the mesh.
    pub elevation: f64,
    /// The axis of the mesh that points up in the picture.
    pub up: UpAxis,
    /// How depth is shown.
    pub projection: Projection,
    /// What the surface looks like.
    pub surface: Surface<'a>,
    /// The color behind the mesh.
    pub background: [u8; 3],
}

impl Default for RenderOptions<'_> {
    fn default() -> Self {
        Self {
            width: 1200,
            height: 900,
            azimuth: 30.0,
            elevation: 20.0,
            up: UpAxis::Y,
            projection: Projection::Perspective,
            surface: Surface::Clay,
            background: [255; 3],
        }
    }
}

/// The axis that points up; the front is the side that faces the positive `z` axis, or the negative `y` axis when `z`
/// points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UpAxis {
    /// Usual for models from animation.
    Y,
    /// Usual for models from engineering and scanning.
    Z,
}

/// How depth is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Projection {
    /// What is farther away is smaller.
    Perspective,
    /// Parallel lines stay parallel.
    Orthographic,
}

/// What the surface looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface<'a> {
    /// Neutral, matte and lit.
    Clay,
    /// One color per vertex, lit so mildly that it can be told apart from its neighbors in a colormap.
    VertexColors(&'a [[u8; 3]]),
    /// Not lit: the components of the normal from -1 to 1 are the amounts of red, green and blue.
    NormalColors,
}

/// Draws a mesh with one normal per vertex into a PNG file, which is replaced if it exists.
pub fn render_png(
    path: &Path,
    mesh: &PolygonMesh,
    normals: &[[f32; 3]],
    options: &RenderOptions<'_>,
) -> Result<(), WriteError> {
    let pixels = render(mesh, normals, options).map_err(|message| WriteError::new(path, message))?;
    write_file(path, |out| {
        PngEncoder::new(out)
            .write_image(&pixels, options.width, options.height, ExtendedColorType::Rgb8)
            .map_err(std::io::Error::other)
    })
}

/// Draws a mesh into rows of red, green and blue bytes.
fn render(mesh: &PolygonMesh, normals: &[[f32; 3]], options: &RenderOptions<'_>) -> Result<Vec<u8>, String> {
    let vertex_count = mesh.vertex_count();
    if normals.len() != vertex_count {
        let found = normals.len();
        return Err(format!("{found} normals for {vertex_count} vertices"));
    }
    if let Surface::VertexColors(colors) = options.surface
        && colors.len() != vertex_count
    {
        let found = colors.len();
        return Err(format!("{found} colors for {vertex_count} vertices"));
    }
    for side in [options.width, options.height] {
        if !(1..=LARGEST_SIDE).contains(&side) {
            return Err(format!(
                "a picture of {} by {} pixels is not between 1 and {LARGEST_SIDE} on each side",
                options.width, options.height
            ));
        }
    }
    let camera = Camera::new(mesh, options);
    let background = options.background.map(to_linear);
    let [width, height] = [options.width, options.height].map(|side| side as usize * SAMPLES);
    let mut canvas = Canvas::new(width, height, background);
    let mut triangulator = Triangulator::default();
    for face in mesh.faces() {
        for triangle in triangulator.triangulate(mesh, face) {
            let corners = camera.see(triangle, normals, options.surface);
            match options.surface {
                Surface::NormalColors => canvas.fill(corners, show_normal),
                Surface::VertexColors(_) => canvas.fill(corners, shade_mildly),
                Surface::Clay => canvas.fill(corners, light),
            }
        }
    }
    Ok(average(&canvas))
}

/// Averages the samples of each pixel and encodes them.
fn average(canvas: &Canvas) -> Vec<u8> {
    let rows: Vec<&[[f32; 3]]> = canvas.rows().collect();
    let mut pixels = Vec::new();
    for rows in rows.chunks_exact(SAMPLES) {
        for start in (0..rows[0].len()).step_by(SAMPLES) {
            let mut sum = [0.0; 3];
            for sample in rows.iter().flat_map(|row| &row[start..start + SAMPLES]) {
                for (total, value) in sum.iter_mut().zip(sample) {
                    // Clipping before the average keeps edges of glare smooth.
                    *total += value.clamp(0.0, 1.0);
                }
            }
            pixels.extend(sum.map(|value| to_srgb(value / (SAMPLES * SAMPLES) as f32)));
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;

    const SMALL: RenderOptions<'_> = RenderOptions {
        width: 80,
        height: 60,
        azimuth: 0.0,
        elevation: 0.0,
        up: UpAxis::Y,
        projection: Projection::Orthographic,
        surface: Surface::NormalColors,
        background: [255; 3],
    };

    fn pixel(picture: &[u8], column: usize, row: usize) -> [u8; 3] {
        let start = (row * SMALL.width as usize + column) * 3;
        [0, 1, 2].map(|channel| picture[start + channel])
    }

    /// A polygon like a `U`, seen from its front.
    fn concave() -> PolygonMesh {
        let outline =
            [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [2.0, 3.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        PolygonMesh {
            positions: outline.map(|[x, y]| [x, y, 7.0]).to_vec(),
            offsets: vec![0, 8],
            indices: (0..8).collect(),
        }
    }

    #[test]
    fn concave_polygons_keep_their_notch() {
        let mesh = concave();
        let normals = [[0.0, 0.0, 1.0]; 8];
        for projection in [Projection::Orthographic, Projection::Perspective] {
            let options = RenderOptions { projection, ..SMALL };
            let picture = render(&mesh, &normals, &options).unwrap();
            let blue = [128, 128, 255];
            // The square fills nine tenths of the height, 54 pixels.
            assert_eq!(pixel(&picture, 40, 10), [255; 3]);
            assert_eq!(pixel(&picture, 40, 50), blue);
            assert_eq!(pixel(&picture, 20, 10), blue);
            assert_eq!(pixel(&picture, 60, 10), blue);
            assert_eq!(pixel(&picture, 11, 30), [255; 3]);
            assert_eq!(pixel(&picture, 68, 30), [255; 3]);
        }
    }

    #[test]
    fn reversed_normals_and_faces_are_lit_alike() {
        let mut mesh = generate::sphere(12);
        let normal = |position: &[f64; 3]| position.map(|value| value as f32);
        let normals: Vec<[f32; 3]> = mesh.positions.iter().map(normal).collect();
        let reversed: Vec<[f32; 3]> = normals.iter().map(|n| n.map(|value| -value)).collect();
        let options = RenderOptions { surface: Surface::Clay, ..SMALL };
        let picture = render(&mesh, &normals, &options).unwrap();
        assert_eq!(render(&mesh, &reversed, &options).unwrap(), picture);
        mesh.indices.reverse();
        let turned = render(&mesh, &normals, &options).unwrap();
        assert_eq!(pixel(&turned, 40, 30), pixel(&picture, 40, 30));
        let brightness = pixel(&picture, 40, 30)[1];
        assert!((120..250).contains(&brightness), "{brightness}");
    }

    #[test]
    fn up_and_the_angles_turn_the_mesh() {
        let mesh = generate::cube();
        // A dominant axis tells which face of the cube is in the middle.
        let normal = |position: &[f64; 3]| position.map(|value| value as f32);
        let normals: Vec<[f32; 3]> = mesh.positions.iter().map(normal).collect();
        for (azimuth, elevation, up, expected) in [
            (0.0, 0.0, UpAxis::Y, [128, 128, 255]),
            (90.0, 0.0, UpAxis::Y, [255, 128, 128]),
            (0.0, 90.0, UpAxis::Y, [128, 255, 128]),
            (0.0, 0.0, UpAxis::Z, [128, 0, 128]),
            (0.0, 90.0, UpAxis::Z, [128, 128, 255]),
        ] {
            let options = RenderOptions { azimuth, elevation, up, ..SMALL };
            let found = pixel(&render(&mesh, &normals, &options).unwrap(), 40, 30);
            let near = (0..3).all(|channel| found[channel].abs_diff(expected[channel]) < 8);
            assert!(near, "{found:?} instead of {expected:?}");
        }
    }

    #[test]
    fn vertex_colors_are_shown() {
        let options = RenderOptions { surface: Surface::VertexColors(&[[255, 0, 0]; 8]), ..SMALL };
        let picture = render(&concave(), &[[0.0, 0.0, 1.0]; 8], &options).unwrap();
        let [red, green, blue] = pixel(&picture, 40, 50);
        assert!(red > 150 && green < 100 && blue < 100);
    }

    #[test]
    fn odd_meshes_give_some_picture() {
        let mesh = PolygonMesh {
            positions: vec![
                [f64::NAN; 3],
                [f64::MAX, 0.0, 0.0],
                [-f64::MAX, 1e-320, 0.0],
                [0.0, 0.0, f64::INFINITY],
                [0.0, 1e300, 0.0],
            ],
            offsets: vec![0, 3, 3, 4, 6, 10, 13],
            indices: vec![0, 1, 2, 1, 1, 2, 1, 2, 3, 4, 1, 2, 4],
        };
        let point = PolygonMesh { positions: vec![[1e-320; 3]], offsets: vec![0, 4], indices: vec![0; 4] };
        for mesh in [mesh, point, PolygonMesh::default()] {
            let normals = vec![[f32::NAN; 3]; mesh.vertex_count()];
            for surface in [Surface::Clay, Surface::NormalColors] {
                for projection in [Projection::Orthographic, Projection::Perspective] {
                    let options = RenderOptions { surface, projection, ..SMALL };
                    let picture = render(&mesh, &normals, &options).unwrap();
                    assert_eq!(picture.len(), 80 * 60 * 3);
                }
            }
        }
    }

    #[test]
    fn unfit_arguments_are_refused() {
        let mesh = concave();
        let normals = [[0.0, 0.0, 1.0]; 8];
        assert!(render(&mesh, &normals[1..], &SMALL).is_err());
        for (width, height) in [(0, 60), (80, 0), (u32::MAX, 60)] {
            let options = RenderOptions { width, height, ..SMALL };
            assert!(render(&mesh, &normals, &options).is_err());
        }
        let options = RenderOptions { surface: Surface::VertexColors(&[]), ..SMALL };
        assert!(render(&mesh, &normals, &options).is_err());
    }

    #[test]
    fn the_file_is_a_png_of_the_right_size() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        render_png(&path, &concave(), &[[0.0, 0.0, 1.0]; 8], &SMALL).unwrap();
        let picture = image::open(&path).unwrap();
        assert_eq!((picture.width(), picture.height()), (80, 60));
    }
}

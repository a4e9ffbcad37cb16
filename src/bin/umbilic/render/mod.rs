//! Draws a shaded picture of a mesh into a PNG file, in software, without a GPU.
//!
//! The picture shows the normals it is given, at vertices or at corners: they are interpolated over the triangles and lit
//! per pixel by lights that are fixed to the camera. Both sides of a surface are lit alike, so reversed faces or normals show up in
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
use light::{CLAY, light, shade_mildly, show_normal, to_linear, to_srgb};
use raster::{Blend, Canvas, Shade};
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
    /// One color around each vertex, halfway to the next, lit as mildly: for classes, of which a mixture would be another.
    VertexPatches(&'a [[u8; 3]]),
    /// One color per face, lit as mildly.
    FaceColors(&'a [[u8; 3]]),
    /// Not lit: the components of the normal from -1 to 1 are the amounts of red, green and blue.
    NormalColors,
}

impl Surface<'_> {
    /// The color of a corner of a face, in linear light; black where the normal decides.
    fn color(&self, face: usize, vertex: usize) -> [f32; 3] {
        match self {
            Surface::Clay => CLAY,
            Surface::VertexColors(colors) | Surface::VertexPatches(colors) => colors[vertex].map(to_linear),
            Surface::FaceColors(colors) => colors[face].map(to_linear),
            Surface::NormalColors => [0.0; 3],
        }
    }

    /// What makes a color of a normal and a color.
    fn paint(&self) -> fn(Shade) -> [f32; 3] {
        match self {
            Surface::Clay => light,
            Surface::VertexColors(_) | Surface::VertexPatches(_) | Surface::FaceColors(_) => shade_mildly,
            Surface::NormalColors => show_normal,
        }
    }

    /// How colors of corners become those of a triangle.
    fn blend(&self) -> Blend {
        if matches!(self, Surface::VertexPatches(_)) { Blend::Nearest } else { Blend::Mixed }
    }
}

/// The normals that a surface is lit by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normals<'a> {
    /// One for each vertex.
    Vertices(&'a [[f32; 3]]),
    /// One for each corner of each face, as corners stand in the mesh's indices. Where those at a vertex differ, a crease shows.
    Corners(&'a [[f32; 3]]),
}

/// Draws a mesh with its normals into a PNG file, which is replaced if it exists.
pub fn render_png(
    path: &Path,
    mesh: &PolygonMesh,
    normals: Normals<'_>,
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
fn render(mesh: &PolygonMesh, normals: Normals<'_>, options: &RenderOptions<'_>) -> Result<Vec<u8>, String> {
    check(mesh, normals, options)?;
    let camera = Camera::new(mesh, options);
    let background = options.background.map(to_linear);
    let [width, height] = [options.width, options.height].map(|side| side as usize * SAMPLES);
    let mut canvas = Canvas::new(width, height, background);
    let mut triangulator = Triangulator::default();
    let lit = options.surface != Surface::NormalColors;
    let (blend, paint) = (options.surface.blend(), options.surface.paint());
    for (face, (vertices, &first)) in mesh.faces().zip(&mesh.offsets).enumerate() {
        for triangle in triangulator.triangulate(mesh, vertices) {
            let corners = triangle.map(|(corner, position)| {
                let vertex = vertices[corner] as usize;
                let normal = match normals {
                    Normals::Vertices(normals) => normals[vertex],
                    Normals::Corners(normals) => normals[first as usize + corner],
                };
                (position, Shade { normal, color: options.surface.color(face, vertex) })
            });
            canvas.fill(camera.see(corners, lit), blend, paint);
        }
    }
    Ok(average(&canvas))
}

/// Checks that there is one of everything for each element, and the size of the picture.
fn check(mesh: &PolygonMesh, normals: Normals<'_>, options: &RenderOptions<'_>) -> Result<(), String> {
    let [vertices, corners, faces] =
        [(mesh.vertex_count(), "vertices"), (mesh.indices.len(), "corners"), (mesh.face_count(), "faces")];
    let normals = match normals {
        Normals::Vertices(normals) => (normals.len(), "normals", vertices),
        Normals::Corners(normals) => (normals.len(), "normals", corners),
    };
    let colors = match options.surface {
        Surface::VertexColors(colors) | Surface::VertexPatches(colors) => Some((colors.len(), "colors", vertices)),
        Surface::FaceColors(colors) => Some((colors.len(), "colors", faces)),
        Surface::Clay | Surface::NormalColors => None,
    };
    for (found, what, (count, elements)) in [Some(normals), colors].into_iter().flatten() {
        if found != count {
            return Err(format!("{found} {what} for {count} {elements}"));
        }
    }
    let RenderOptions { width, height, .. } = *options;
    if [width, height].iter().any(|side| !(1..=LARGEST_SIDE).contains(side)) {
        return Err(format!(
            "a picture of {width} by {height} pixels is not between 1 and {LARGEST_SIDE} on each side"
        ));
    }
    Ok(())
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
            let picture = render(&mesh, Normals::Vertices(&normals), &options).unwrap();
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
        let picture = render(&mesh, Normals::Vertices(&normals), &options).unwrap();
        assert_eq!(render(&mesh, Normals::Vertices(&reversed), &options).unwrap(), picture);
        mesh.indices.reverse();
        let turned = render(&mesh, Normals::Vertices(&normals), &options).unwrap();
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
            let found = pixel(&render(&mesh, Normals::Vertices(&normals), &options).unwrap(), 40, 30);
            let near = (0..3).all(|channel| found[channel].abs_diff(expected[channel]) < 8);
            assert!(near, "{found:?} instead of {expected:?}");
        }
    }

    #[test]
    fn vertex_colors_are_shown() {
        let options = RenderOptions { surface: Surface::VertexColors(&[[255, 0, 0]; 8]), ..SMALL };
        let picture = render(&concave(), Normals::Vertices(&[[0.0, 0.0, 1.0]; 8]), &options).unwrap();
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
                    let picture = render(&mesh, Normals::Vertices(&normals), &options).unwrap();
                    assert_eq!(picture.len(), 80 * 60 * 3);
                }
            }
        }
    }

    #[test]
    fn every_face_has_its_color_up_to_its_edges() {
        let colors = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0], [0, 255, 255], [255, 0, 255]];
        let mesh = generate::cube();
        let normal = |position: &[f64; 3]| position.map(|value| value as f32);
        let normals: Vec<[f32; 3]> = mesh.positions.iter().map(normal).collect();
        let options =
            RenderOptions { azimuth: 45.0, surface: Surface::FaceColors(&colors), background: [0; 3], ..SMALL };
        let picture = render(&mesh, Normals::Vertices(&normals), &options).unwrap();
        // The faces of x = 1 and z = 1 meet in the middle.
        for (column, face) in [(38, 5), (41, 1)] {
            let found = pixel(&picture, column, 30);
            assert!((0..3).all(|channel| (found[channel] > 60) == (colors[face][channel] > 60)), "{face}: {found:?}");
        }
    }

    #[test]
    fn normals_at_corners_make_creases() {
        let mesh = generate::cube();
        let normals: Vec<[f32; 3]> = mesh
            .faces()
            .flat_map(|face| {
                let sum: [f64; 3] = std::array::from_fn(|axis| {
                    face.iter().map(|&vertex| mesh.positions[vertex as usize][axis]).sum()
                });
                vec![sum.map(|value| value as f32); face.len()]
            })
            .collect();
        let options = RenderOptions { azimuth: 45.0, ..SMALL };
        let picture = render(&mesh, Normals::Corners(&normals), &options).unwrap();
        for (column, expected) in [(20, [128, 128, 255]), (38, [128, 128, 255]), (41, [255, 128, 128])] {
            assert_eq!(pixel(&picture, column, 30), expected, "{column}");
        }
    }

    #[test]
    fn unfit_arguments_are_refused() {
        let mesh = concave();
        let normals = [[0.0, 0.0, 1.0]; 8];
        let all = Normals::Vertices(&normals);
        for few in [Normals::Vertices(&normals[1..]), Normals::Corners(&normals[1..])] {
            assert!(render(&mesh, few, &SMALL).unwrap_err().starts_with("7 normals for 8 "));
        }
        for (width, height) in [(0, 60), (80, 0), (u32::MAX, 60)] {
            let options = RenderOptions { width, height, ..SMALL };
            assert!(render(&mesh, all, &options).is_err());
        }
        for surface in [Surface::VertexColors(&[]), Surface::VertexPatches(&[]), Surface::FaceColors(&[])] {
            let options = RenderOptions { surface, ..SMALL };
            assert!(render(&mesh, all, &options).unwrap_err().starts_with("0 colors for "));
        }
    }

    #[test]
    fn the_file_is_a_png_of_the_right_size() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        render_png(&path, &concave(), Normals::Vertices(&[[0.0, 0.0, 1.0]; 8]), &SMALL).unwrap();
        let picture = image::open(&path).unwrap();
        assert_eq!((picture.width(), picture.height()), (80, 60));
    }
}

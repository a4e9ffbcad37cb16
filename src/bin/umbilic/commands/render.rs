//! `umbilic render`: draws a mesh, shaded with its vertex normals, into a PNG file.

use super::Outcome;
use crate::args;
use crate::compute::{self, blame};
use crate::read::read_mesh;
use crate::render::{Projection, RenderOptions, Surface, UpAxis, render_png};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Draw a mesh with its vertex normals into a PNG file.
///
/// The camera looks at the mesh from the front, moved by --azimuth to the right and by --elevation upwards, and sees
/// all of it. Faces are lit on both sides.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic render cow.obj -o cow.png --azimuth -40 --color normals")]
pub struct Render {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The PNG file to write.
    #[arg(short, long, value_name = "OUT.png", value_parser = args::png_file)]
    output: PathBuf,
    #[command(flatten)]
    estimator: args::Estimator,
    /// What the surface looks like.
    #[arg(long, value_enum, default_value = "clay")]
    color: Color,
    /// The width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = args::size)]
    size: [u32; 2],
    /// How far the camera goes around the mesh to the right, in degrees.
    #[arg(long, value_name = "DEGREES", default_value = "30", allow_hyphen_values = true, value_parser = args::angle)]
    azimuth: f64,
    /// How far the camera rises above the mesh, in degrees.
    #[arg(long, value_name = "DEGREES", default_value = "20", allow_hyphen_values = true, value_parser = args::angle)]
    elevation: f64,
    /// The axis that points up.
    #[arg(long, value_enum, default_value = "y")]
    up: UpAxis,
    /// Draw without perspective: parallel lines stay parallel.
    #[arg(long)]
    orthographic: bool,
}

/// What the surface looks like.
#[derive(Clone, Copy, ValueEnum)]
enum Color {
    /// Matte and lit.
    Clay,
    /// Not lit: x, y and z of the normal as red, green and blue.
    Normals,
}

impl Render {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let weight = self.estimator.weight()?;
        let mesh = read_mesh(&self.input)?;
        let topology = compute::topology(&mesh).map_err(blame(&self.input))?;
        let found = compute::vertex_normals(&mesh, &topology, weight, 0).map_err(blame(&self.input))?;
        let [width, height] = self.size;
        let options = RenderOptions {
            width,
            height,
            azimuth: self.azimuth,
            elevation: self.elevation,
            up: self.up,
            projection: if self.orthographic { Projection::Orthographic } else { Projection::Perspective },
            surface: match self.color {
                Color::Clay => Surface::Clay,
                Color::Normals => Surface::NormalColors,
            },
            ..RenderOptions::default()
        };
        render_png(&self.output, &mesh, &found.normals, &options)?;
        Ok(String::new())
    }
}

//! `umbilic render`: draws a mesh, shaded with its vertex normals or colored by a curvature, into a PNG file.

use super::Outcome;
use crate::args;
use crate::colorbar::write_colorbar;
use crate::compute::{self, blame};
use crate::quantity::Quantity;
use crate::read::read_mesh;
use crate::render::{Projection, RenderOptions, Surface, UpAxis, render_png};
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Draw a mesh with its vertex normals, or colored by a curvature, into a PNG file.
///
/// The camera looks at the mesh from the front, moved by --azimuth to the right and by --elevation upwards, and sees
/// all of it. Faces are lit on both sides. Colors of curvatures are those of umbilic curvature, mildly shaded: blue is
/// negative, red positive (a sphere with outward normals), nearly white 0, gray where there is no result. The numbers
/// at the ends of the colors are printed.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic render cow.obj -o cow.png --azimuth -40 --color normals
  umbilic render cow.obj -o cow.png --color mean --colorbar bar.png")]
pub struct Render {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The PNG file to write.
    #[arg(short, long, value_name = "OUT.png", value_parser = args::png_file)]
    output: PathBuf,
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
    #[command(flatten)]
    curvature: args::CurvatureEstimator,
    #[command(flatten)]
    scale: args::ColorScale,
}

/// What the surface looks like.
#[derive(Clone, Copy)]
enum Color {
    Clay,
    Normals,
    Curvature(Quantity),
}

impl ValueEnum for Color {
    fn value_variants<'a>() -> &'a [Self] {
        const VARIANTS: [Color; Quantity::ALL.len() + 2] = {
            let mut variants = [Color::Clay; Quantity::ALL.len() + 2];
            variants[1] = Color::Normals;
            let mut index = 0;
            while index < Quantity::ALL.len() {
                variants[index + 2] = Color::Curvature(Quantity::ALL[index]);
                index += 1;
            }
            variants
        };
        &VARIANTS
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Color::Clay => Some(PossibleValue::new("clay").help("Matte and lit")),
            Color::Normals => {
                Some(PossibleValue::new("normals").help("Not lit: x, y and z of the normal as red, green and blue"))
            }
            Color::Curvature(quantity) => quantity.to_possible_value(),
        }
    }
}

impl Render {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        match self.color {
            Color::Clay => self.draw_normals(Surface::Clay),
            Color::Normals => self.draw_normals(Surface::NormalColors),
            Color::Curvature(quantity) => self.draw_curvature(quantity),
        }
    }

    fn draw_normals(&self, surface: Surface<'_>) -> Outcome {
        let weight = self.curvature.weight()?;
        self.scale.refuse()?;
        let mesh = read_mesh(&self.input)?;
        let topology = compute::topology(&mesh).map_err(blame(&self.input))?;
        let found = compute::vertex_normals(&mesh, &topology, weight, 0).map_err(blame(&self.input))?;
        render_png(&self.output, &mesh, &found.normals, &self.options(surface))?;
        Ok(String::new())
    }

    fn draw_curvature(&self, quantity: Quantity) -> Outcome {
        let options = self.curvature.options()?;
        self.curvature.check(quantity)?;
        let mesh = read_mesh(&self.input)?;
        let blame = self.curvature.blame(&self.input);
        let topology = compute::topology(&mesh).map_err(&blame)?;
        let found = compute::vertex_curvatures(&mesh, &topology, &options, 0).map_err(&blame)?;
        let scale = self.scale.scale(quantity, &mesh, &found);
        let colors = scale.colors(found.quantity(quantity).unwrap_or_default(), &found.status);
        render_png(&self.output, &mesh, &found.normals, &self.options(Surface::VertexColors(&colors)))?;
        if let Some(bar) = &self.scale.colorbar {
            write_colorbar(bar, &scale)?;
        }
        Ok(format!("{}\n", scale.describe(quantity)))
    }

    fn options<'a>(&self, surface: Surface<'a>) -> RenderOptions<'a> {
        let [width, height] = self.size;
        RenderOptions {
            width,
            height,
            azimuth: self.azimuth,
            elevation: self.elevation,
            up: self.up,
            projection: if self.orthographic { Projection::Orthographic } else { Projection::Perspective },
            surface,
            ..RenderOptions::default()
        }
    }
}

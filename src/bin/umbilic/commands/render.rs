//! `umbilic render`: draws a mesh, shaded with its vertex normals or colored by a curvature, into a PNG file.

use super::Outcome;
use crate::args;
use crate::colorbar::write_colorbar;
use crate::coloring::{Coloring, Subject};
use crate::compute::{self, blame};
use crate::read::read_mesh;
use crate::render::{Normals, Surface, render_png};
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Draw a mesh with its vertex normals, or colored by a curvature, into a PNG file.
///
/// The camera looks at the mesh from the front, moved by --azimuth to the right and by --elevation upwards, and sees
/// all of it. Faces are lit on both sides. Colors of curvatures are those of umbilic curvature, mildly shaded: blue is
/// negative, red positive (a sphere with outward normals), nearly white 0, gray where there is no result. The numbers
/// at the ends of the colors are printed, and with --color shape the color of each class.
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
    /// With clay and normals, split normals where those of two faces differ by more than this, in degrees, so that sharp
    /// edges look sharp; --weight angle goes well with it.
    #[arg(long, value_name = "DEGREES", value_parser = args::crease_angle)]
    crease_angle: Option<f64>,
    #[command(flatten)]
    view: args::View,
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
    Subject(Subject),
}

impl ValueEnum for Color {
    fn value_variants<'a>() -> &'a [Self] {
        const VARIANTS: [Color; Subject::ALL.len() + 2] = {
            let mut variants = [Color::Clay; Subject::ALL.len() + 2];
            variants[1] = Color::Normals;
            let mut index = 0;
            while index < Subject::ALL.len() {
                variants[index + 2] = Color::Subject(Subject::ALL[index]);
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
            Color::Subject(subject) => subject.to_possible_value(),
        }
    }
}

impl Render {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        match self.color {
            Color::Clay => self.draw_normals(Surface::Clay),
            Color::Normals => self.draw_normals(Surface::NormalColors),
            Color::Subject(subject) => self.draw_curvature(subject),
        }
    }

    fn draw_normals(&self, surface: Surface<'_>) -> Outcome {
        let weight = self.curvature.weight()?;
        self.scale.refuse()?;
        let mesh = read_mesh(&self.input)?;
        let blame = blame(&self.input);
        let options = self.view.options(surface);
        if let Some(angle) = self.crease_angle {
            let normals = compute::corner_normals(&mesh, angle.to_radians(), weight, 0).map_err(&blame)?;
            render_png(&self.output, &mesh, Normals::Corners(&normals), &options)?;
        } else {
            let topology = compute::topology(&mesh).map_err(&blame)?;
            let found = compute::vertex_normals(&mesh, &topology, weight, 0).map_err(&blame)?;
            render_png(&self.output, &mesh, Normals::Vertices(&found.normals), &options)?;
        }
        Ok(String::new())
    }

    fn draw_curvature(&self, subject: Subject) -> Outcome {
        let options = self.curvature.options()?;
        self.curvature.check(subject)?;
        self.scale.check(subject)?;
        if self.crease_angle.is_some() {
            return Err("--crease-angle is for --color clay and normals".into());
        }
        let mesh = read_mesh(&self.input)?;
        let blame = self.curvature.blame(&self.input);
        let topology = compute::topology(&mesh).map_err(&blame)?;
        let found = compute::vertex_curvatures(&mesh, &topology, &options, 0).map_err(&blame)?;
        let coloring = self.scale.coloring(subject, &mesh, &found).map_err(&blame)?;
        let colors = coloring.colors(&found);
        let surface = match coloring {
            Coloring::Scale(..) => Surface::VertexColors(&colors),
            Coloring::Shape { .. } => Surface::VertexPatches(&colors),
        };
        let options = self.view.options(surface);
        render_png(&self.output, &mesh, Normals::Vertices(&found.normals), &options)?;
        if let (Some(bar), Some(scale)) = (&self.scale.colorbar, coloring.scale()) {
            write_colorbar(bar, scale)?;
        }
        Ok(format!("{}\n", coloring.describe()))
    }
}

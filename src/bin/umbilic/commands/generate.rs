//! `umbilic generate`: writes a sample mesh as a PLY file.

use super::Outcome;
use crate::write::{PlyFormat, Properties, write_ply};
use crate::{args, generate};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Write a sample mesh as a PLY file.
///
/// All samples are closed surfaces around the origin, about two units wide.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic generate bumpy -o bumpy.ply --resolution 200")]
pub struct Generate {
    /// The shape.
    #[arg(value_enum)]
    shape: Shape,
    /// The PLY file to write.
    #[arg(short, long, value_name = "OUT.ply", value_parser = args::ply_file)]
    output: PathBuf,
    /// How finely the shape is divided; four times the faces for twice the number. A cube has always six.
    #[arg(long, value_name = "N", default_value_t = 64,
        value_parser = clap::value_parser!(u32).range(1..=i64::from(generate::LARGEST_RESOLUTION)))]
    resolution: u32,
}

/// The shape of a sample mesh.
#[derive(Clone, Copy, ValueEnum)]
enum Shape {
    /// A sphere with smooth hills and valleys, of even triangles.
    Bumpy,
    /// A unit sphere of triangles between two poles.
    Sphere,
    /// A torus of quadrilaterals.
    Torus,
    /// A cube of six squares.
    Cube,
}

impl Generate {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let mesh = match self.shape {
            Shape::Bumpy => generate::bumpy(self.resolution),
            Shape::Sphere => generate::sphere(self.resolution),
            Shape::Torus => generate::torus(self.resolution),
            Shape::Cube => generate::cube(),
        };
        write_ply(
            &self.output,
            &mesh,
            &Properties::default(),
            &Properties::default(),
            PlyFormat::BinaryLittleEndian,
        )?;
        Ok(format!("{} vertices, {} faces\n", mesh.vertex_count(), mesh.face_count()))
    }
}

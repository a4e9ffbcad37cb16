//! How a picture looks at a mesh, as options on the command line.

use super::{angle, size};
use crate::render::{Projection, RenderOptions, Surface, UpAxis};
use clap::Args;

/// How a picture looks at the mesh.
#[derive(Args)]
#[command(next_help_heading = "Options of the picture")]
pub struct View {
    /// The width and height in pixels [default: 1200x900].
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// How far the camera goes around the mesh to the right, in degrees [default: 30].
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle)]
    azimuth: Option<f64>,
    /// How far the camera rises above the mesh, in degrees [default: 20].
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle)]
    elevation: Option<f64>,
    /// The axis that points up [default: y].
    #[arg(long, value_enum)]
    up: Option<UpAxis>,
    /// Draw without perspective: parallel lines stay parallel.
    #[arg(long)]
    orthographic: bool,
}

impl View {
    /// Refuses all of this where there is no picture.
    pub fn refuse(&self) -> Result<(), String> {
        let Self { size, azimuth, elevation, up, orthographic } = self;
        match size.is_some() || azimuth.is_some() || elevation.is_some() || up.is_some() || *orthographic {
            true => Err("--size, --azimuth, --elevation, --up and --orthographic are for --picture".to_owned()),
            false => Ok(()),
        }
    }

    /// A picture of such a surface.
    pub fn options<'a>(&self, surface: Surface<'a>) -> RenderOptions<'a> {
        let default = RenderOptions::default();
        let [width, height] = self.size.unwrap_or([default.width, default.height]);
        RenderOptions {
            width,
            height,
            azimuth: self.azimuth.unwrap_or(default.azimuth),
            elevation: self.elevation.unwrap_or(default.elevation),
            up: self.up.unwrap_or(default.up),
            projection: if self.orthographic { Projection::Orthographic } else { default.projection },
            surface,
            ..default
        }
    }
}

//! `umbilic corners`: writes a mesh cut along its creases, with normals that are split there.

use super::Outcome;
use super::normals::COUNTS;
use crate::args;
use crate::compute::{self, blame};
use crate::read::read_mesh;
use crate::render::{Normals, Surface, render_png};
use crate::table::table;
use crate::write::{Column, ColumnValues, PlyFormat, Properties, write_ply};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

/// Compute corner normals, split at sharp edges, and write a PLY file with them.
///
/// Faces meet smoothly unless the angle between their normals is larger than --crease-angle. The file has the faces of the input and
/// each vertex once for every smooth run of its faces, with the unit normal of that run as nx, ny and nz, the status as umbilic normals
/// writes it (a crease counts as boundary), and the normal as a color.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic corners bracket.stl -o bracket.ply --picture bracket.png")]
pub struct Corners {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The PLY file to write.
    #[arg(short, long, value_name = "OUT.ply", value_parser = args::ply_file)]
    output: PathBuf,
    /// The largest angle between the normals of two faces that meet smoothly, in degrees.
    #[arg(long, value_name = "DEGREES", default_value = "30", value_parser = args::crease_angle)]
    crease_angle: f64,
    #[command(flatten)]
    estimator: args::Estimator,
    /// Draw the mesh with these normals into a PNG file as well.
    #[arg(long, value_name = "OUT.png", value_parser = args::png_file)]
    picture: Option<PathBuf>,
    /// Write text instead of binary numbers.
    #[arg(long)]
    ascii: bool,
    /// The number of threads; 0 for as many as pay.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    threads: u16,
    /// Print one JSON object instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    view: args::View,
}

impl Corners {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let weight = self.estimator.weight()?;
        if self.picture.is_none() {
            self.view.refuse()?;
        }
        let start = Instant::now();
        let mesh = read_mesh(&self.input)?;
        let read = Instant::now();
        let cut =
            compute::cut(&mesh, self.crease_angle.to_radians(), self.threads.into()).map_err(blame(&self.input))?;
        let made = Instant::now();
        let found = compute::vertex_normals(&cut.mesh, cut.parts.topology(), weight, self.threads.into())
            .map_err(blame(&self.input))?;
        let computed = Instant::now();
        let colors: Vec<[u8; 3]> =
            found.normals.iter().map(|normal| normal.map(|x| (127.5 + 127.5 * x).round() as u8)).collect();
        let properties = Properties {
            normals: Some(&found.normals),
            columns: vec![Column { name: "status", values: ColumnValues::Byte(&found.status) }],
            colors: Some(&colors),
        };
        let format = if self.ascii { PlyFormat::Ascii } else { PlyFormat::BinaryLittleEndian };
        write_ply(&self.output, &cut.mesh, &properties, &Properties::default(), format)?;
        if let Some(picture) = &self.picture {
            render_png(picture, &cut.mesh, Normals::Vertices(&found.normals), &self.view.options(Surface::Clay))?;
        }
        let times = [
            ("read", read - start),
            ("cut", made - read),
            ("normals", computed - made),
            ("write", computed.elapsed()),
        ];
        let counts =
            COUNTS.map(|(key, words, bit)| (key, words, found.status.iter().filter(|&s| s & bit != 0).count()));
        if self.json {
            let counts: serde_json::Map<_, _> =
                counts.into_iter().map(|(key, _, count)| (key.to_owned(), count.into())).collect();
            let seconds: serde_json::Map<_, _> =
                times.into_iter().map(|(key, time)| (key.to_owned(), time.as_secs_f64().into())).collect();
            let object = json!({
                "vertices": mesh.vertex_count(),
                "faces": mesh.face_count(),
                "crease_angle": self.crease_angle,
                "written_vertices": cut.mesh.vertex_count(),
                "weight": weight.name(),
                "status": counts,
                "seconds": seconds,
            });
            return Ok(format!("{object:#}\n"));
        }
        let mut rows = vec![
            ("vertices", mesh.vertex_count().to_string()),
            ("faces", mesh.face_count().to_string()),
            ("crease angle", format!("{}°", self.crease_angle)),
            ("vertices written", cut.mesh.vertex_count().to_string()),
            ("weight", weight.name().to_owned()),
        ];
        rows.extend(counts.map(|(_, words, count)| (words, count.to_string())));
        rows.push(("time", times.map(|(key, time)| format!("{key} {time:.1?}")).join(", ")));
        Ok(table(&rows))
    }
}

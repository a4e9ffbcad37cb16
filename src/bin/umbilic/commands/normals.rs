//! `umbilic normals`: writes a mesh with its vertex normals as a PLY file.

use super::Outcome;
use crate::args;
use crate::compute::{self, VertexNormals, blame};
use crate::read::read_mesh;
use crate::table::table;
use crate::write::{Column, ColumnValues, PlyFormat, Properties, write_ply};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;
use umbilic::status;

/// Compute vertex normals and write a PLY file with them.
///
/// The file has the positions and faces of the input, the unit normal of each vertex as nx, ny and nz, and its status
/// as the sum of: 1 boundary, 2 non-manifold, 4 faces that disagree on the orientation, 8 isolated, 16 the weight
/// left nothing and a simpler one took its place, 32 no normal could be computed, 64 the neighbourhood of a jet was
/// widened. Normals are zero where there is none.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic normals cow.obj -o cow.ply --weight angle")]
pub struct Normals {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The PLY file to write.
    #[arg(short, long, value_name = "OUT.ply", value_parser = args::ply_file)]
    output: PathBuf,
    #[command(flatten)]
    estimator: args::Estimator,
    /// Write text instead of binary numbers.
    #[arg(long)]
    ascii: bool,
    /// The number of threads; 0 for as many as pay.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    threads: u16,
    /// Print one JSON object instead of a table.
    #[arg(long)]
    json: bool,
}

/// What is counted of the vertices' statuses: a key, words and the bit.
pub(super) const COUNTS: [(&str, &str, u8); 7] = [
    ("boundary", "boundary vertices", status::BOUNDARY),
    ("non_manifold", "non-manifold vertices", status::NON_MANIFOLD),
    ("winding", "vertices of faces that disagree", status::WINDING),
    ("isolated", "isolated vertices", status::ISOLATED),
    ("fallback", "normals by a simpler weight", status::FALLBACK),
    ("degenerate", "vertices without any normal", status::DEGENERATE),
    ("widened", "widened neighbourhoods", status::WIDENED),
];

impl Normals {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let weight = self.estimator.weight()?;
        let start = Instant::now();
        let mesh = read_mesh(&self.input)?;
        let read = Instant::now();
        let topology = compute::topology(&mesh).map_err(blame(&self.input))?;
        let built = Instant::now();
        let VertexNormals { normals, status } =
            compute::vertex_normals(&mesh, &topology, weight, self.threads.into()).map_err(blame(&self.input))?;
        let computed = Instant::now();
        let properties = Properties {
            normals: Some(&normals),
            columns: vec![Column { name: "status", values: ColumnValues::Byte(&status) }],
            ..Properties::default()
        };
        let format = if self.ascii { PlyFormat::Ascii } else { PlyFormat::BinaryLittleEndian };
        write_ply(&self.output, &mesh, &properties, &Properties::default(), format)?;

        let times = [
            ("read", read - start),
            ("topology", built - read),
            ("normals", computed - built),
            ("write", computed.elapsed()),
        ];
        let counts = COUNTS.map(|(key, words, bit)| (key, words, status.iter().filter(|&s| s & bit != 0).count()));
        if self.json {
            let counts: serde_json::Map<_, _> =
                counts.into_iter().map(|(key, _, count)| (key.to_owned(), count.into())).collect();
            let seconds: serde_json::Map<_, _> =
                times.into_iter().map(|(key, time)| (key.to_owned(), time.as_secs_f64().into())).collect();
            let object = json!({
                "vertices": mesh.vertex_count(),
                "faces": mesh.face_count(),
                "weight": weight.name(),
                "status": counts,
                "seconds": seconds,
            });
            return Ok(format!("{object:#}\n"));
        }
        let mut rows = vec![
            ("vertices", mesh.vertex_count().to_string()),
            ("faces", mesh.face_count().to_string()),
            ("weight", weight.name().to_owned()),
        ];
        rows.extend(counts.map(|(_, words, count)| (words, count.to_string())));
        rows.push(("time", times.map(|(key, time)| format!("{key} {time:.1?}")).join(", ")));
        Ok(table(&rows))
    }
}

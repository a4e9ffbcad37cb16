//! The program `umbilic`: vertex normals, curvatures, segments, facts and pictures of meshes in files, and curvatures of polylines.
//!
//! Each of the [`commands`] has a file of its own. What they share: [`args`] (value parsers), [`compute`] (calls of the
//! library), [`read`], [`write`], [`render`] and [`generate`] for a [`mesh`], [`progress`] bars and printed [`table`]s.
//! For colors: a [`quantity`] goes by its [`quantiles`] to a [`scale`], by this to the [`colormap`] and its [`colorbar`]; which
//! of them, or classes of shape, is a [`coloring`]. A [`summary`] tells of them. [`segments`] have the colors of a [`palette`].

mod args;
mod colorbar;
mod coloring;
mod colormap;
mod commands;
mod compute;
mod generate;
mod mesh;
mod output;
mod palette;
mod progress;
mod quantiles;
mod quantity;
mod read;
mod render;
mod scale;
mod segments;
mod summary;
mod table;
mod write;

use clap::Parser;
use commands::Command;
use std::io::{self, Write};
use std::process::ExitCode;

/// Vertex normals, curvatures and segments of polygon meshes, curvatures of polylines.
///
/// Reads meshes from OBJ, PLY, STL and OFF files. Polygons are used as they are, not cut into triangles first.
#[derive(Parser)]
#[command(version, arg_required_else_help = true, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  umbilic generate torus -o torus.ply
  umbilic info torus.ply
  umbilic normals torus.ply -o with-normals.ply
  umbilic corners bracket.stl -o split-at-sharp-edges.ply
  umbilic curvature torus.ply -o with-curvatures.ply
  umbilic segment bracket.stl -o labels.ply --picture segments.png
  umbilic render torus.ply -o torus.png --color mean
  umbilic polyline outline.txt --closed

Exit status: 0 done, 1 failed, 2 wrong usage.";

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        let what = panic.to_string().replace('\n', " ");
        let _ = writeln!(io::stderr(), "umbilic: internal error, please report it: {what}");
        std::process::exit(1)
    }));
    match Cli::parse().command.run().and_then(|text| Ok(print(&text)?)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing is left to do where even this cannot be said.
            let _ = writeln!(io::stderr(), "umbilic: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints to the standard output, whose reader may have seen enough and left.
fn print(text: &str) -> Result<(), String> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(format!("standard output: {error}")),
        _ => Ok(()),
    }
}

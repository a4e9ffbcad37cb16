//! The commands, each with its arguments and a `run` that returns what to print.

mod completions;
mod corners;
mod curvature;
mod generate;
mod info;
mod man;
mod normals;
mod polyline;
mod render;
mod segment;

use clap::Subcommand;
use std::error::Error;

/// What a command hands back: the text for the standard output, or why it failed.
type Outcome = Result<String, Box<dyn Error>>;

#[derive(Subcommand)]
pub enum Command {
    Normals(normals::Normals),
    Corners(corners::Corners),
    Curvature(curvature::Curvature),
    Segment(segment::Segment),
    Polyline(polyline::Polyline),
    Info(info::Info),
    Render(render::Render),
    Generate(generate::Generate),
    Completions(completions::Completions),
    Man(man::Man),
}

impl Command {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        match self {
            Command::Normals(command) => command.run(),
            Command::Corners(command) => command.run(),
            Command::Curvature(command) => command.run(),
            Command::Segment(command) => command.run(),
            Command::Polyline(command) => command.run(),
            Command::Info(command) => command.run(),
            Command::Render(command) => command.run(),
            Command::Generate(command) => command.run(),
            Command::Completions(command) => command.run(),
            Command::Man(command) => command.run(),
        }
    }
}

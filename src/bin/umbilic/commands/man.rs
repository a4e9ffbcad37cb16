//! `umbilic man`: writes the manual pages.

use super::Outcome;
use crate::Cli;
use clap::{Args, CommandFactory};
use std::fs;
use std::path::PathBuf;

/// Write the manual pages, one for the program and one for each command.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic man ~/.local/share/man/man1")]
pub struct Man {
    /// The directory to write to; made if it is missing.
    directory: PathBuf,
}

impl Man {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        fs::create_dir_all(&self.directory)
            .and_then(|()| clap_mangen::generate_to(Cli::command(), &self.directory))
            .map_err(|error| format!("{}: {error}", self.directory.display()))?;
        Ok(String::new())
    }
}

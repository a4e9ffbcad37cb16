//! `umbilic completions`: prints a script that completes the program's command line in a shell.

use super::Outcome;
use crate::Cli;
use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

/// Print a script with which a shell completes commands, options and their values.
///
/// An installed program has those of bash, zsh and fish where these shells look for them.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic completions bash > ~/.local/share/bash-completion/completions/umbilic")]
pub struct Completions {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let mut script = Vec::new();
        generate(self.shell, &mut Cli::command(), "umbilic", &mut script);
        Ok(String::from_utf8(script)?)
    }
}

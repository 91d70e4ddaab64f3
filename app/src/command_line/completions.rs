//! Completions for shells.

use std::io::Write as _;

use amc_core::Error;
use clap::CommandFactory as _;
use clap_complete::Shell;

use super::Outcome;

/// Which shell.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// The shell that is to complete commands.
    shell: Shell,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut super::Arguments::command(), "amc-studio", &mut script);
    let written = std::io::stdout().write_all(&script);
    written.map_err(|error| Error::io("cannot write the completions", error).into())
}

//! The command line: one file per command, one place where errors are shown.
//!
//! Exit status: 0 done, 1 failed (one line on standard error), 2 wrong usage or not available.

mod bake;
mod build;
mod completions;
mod convert;
mod demo;
mod inspect;
mod log_output;
mod output;
mod progress;
mod render;
mod renderer;
mod tangents;
mod values;
mod window;

use std::ffi::OsString;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use output::Output;

/// What every command ends in.
type Outcome = Result<(), Failure>;

/// Why a command did not do what was asked.
#[derive(Debug)]
enum Failure {
    /// Something is wrong with the input or the machine: exit 1.
    Failed(amc_core::Error),
    /// The request is part of the program's plan but not of this version: exit 2.
    NotAvailable(String),
    /// The request makes no sense, in a way that the argument parser cannot see: exit 2.
    Usage(String),
}

impl From<amc_core::Error> for Failure {
    fn from(error: amc_core::Error) -> Self {
        Self::Failed(error)
    }
}

/// Anisotropic MatCap from the command line.
///
/// Without a command it opens the window; where there is no display or no graphics adapter it renders the bundled shirt and says where the picture
/// is.
#[derive(Debug, Parser)]
#[command(name = "amc-studio", version, about, args_conflicts_with_subcommands = true)]
struct Arguments {
    /// Print results as JSON.
    #[arg(long, global = true)]
    json: bool,
    /// Projects, meshes and fabrics to open in the window.
    files: Vec<PathBuf>,
    /// Print a line of JSON when the window, and when the garment in it, was first shown: seconds since the start.
    #[arg(long)]
    timings: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render a project, a mesh or a shape in its fabrics: a picture, a contact sheet, a turn.
    Render(Box<render::Arguments>),
    /// Make an AMC from pictures of a turning ball.
    Build(build::Arguments),
    /// Make an AMC from a reflectance under given lights.
    Bake(bake::Arguments),
    /// Export the panels' directions.
    Tangents(tangents::Arguments),
    /// Say what a project, a mesh, an AMC or a capture session holds.
    Inspect(inspect::Arguments),
    /// Convert an AMC to or from slice atlas, slice folder or ordinary MatCap.
    Convert(convert::Arguments),
    /// Print completions for a shell.
    Completions(completions::Arguments),
    /// Capture from a turntable and a camera (not available in this version).
    Capture(NotYet),
    /// Spatially varying cloth from a single view (not available in this version).
    Microfacet(NotYet),
    /// Validate a folder of shaders (not available in this version).
    Shaders(NotYet),
}

/// Whatever follows a command that is not available yet.
#[derive(Debug, clap::Args)]
struct NotYet {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<OsString>,
}

/// Runs the program with these arguments (the first is its own name) and gives its exit status.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            let usage = error.use_stderr();
            // Nothing is left to do where even the message cannot be written.
            error.print().ok();
            return if usage { ExitCode::from(2) } else { ExitCode::SUCCESS };
        }
    };
    log_output::show_warnings();
    let output = Output::new(arguments.json);
    let outcome = dispatch(arguments, &output);
    let (status, message) = match outcome {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Failed(error)) => (1, error.to_string()),
        Err(Failure::Usage(what)) => (2, what),
        Err(Failure::NotAvailable(what)) => (2, format!("{what} is not available in this version")),
    };
    writeln!(std::io::stderr(), "amc-studio: {message}").ok();
    ExitCode::from(status)
}

fn dispatch(arguments: Arguments, output: &Output) -> Outcome {
    let not_available = |what: &str| Err(Failure::NotAvailable(what.to_owned()));
    match arguments.command {
        None => window::run(arguments.files, arguments.timings, output),
        Some(Command::Render(arguments)) => render::run(&arguments, output),
        Some(Command::Build(arguments)) => build::run(&arguments, output),
        Some(Command::Bake(arguments)) => bake::run(&arguments, output),
        Some(Command::Tangents(arguments)) => tangents::run(&arguments, output),
        Some(Command::Inspect(arguments)) => inspect::run(&arguments, output),
        Some(Command::Convert(arguments)) => convert::run(&arguments, output),
        Some(Command::Completions(arguments)) => completions::run(&arguments),
        Some(Command::Capture(NotYet { .. })) => not_available("the command 'capture'"),
        Some(Command::Microfacet(NotYet { .. })) => not_available("the command 'microfacet'"),
        Some(Command::Shaders(NotYet { .. })) => not_available("the command 'shaders'"),
    }
}

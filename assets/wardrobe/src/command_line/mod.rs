//! The commands, one file each.

mod collection;
mod make;
mod pictures;
mod progress;
mod table;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Makes the garments that AMC Studio ships: pattern pieces cut flat, sewn and draped.
#[derive(Debug, Parser)]
#[command(version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Cut, sew and drape one garment, as fine as is asked for.
    Make(make::Arguments),
    /// Make the files of the collection anew.
    Collection(collection::Arguments),
    /// Print the figures of the collection's files.
    Table(table::Arguments),
    /// Draw the contact sheet, and the flat pieces of every garment.
    Pictures(pictures::Arguments),
}

pub(crate) fn run() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Make(arguments) => make::run(&arguments),
        Command::Collection(arguments) => collection::run(&arguments),
        Command::Table(arguments) => table::run(&arguments),
        Command::Pictures(arguments) => pictures::run(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            progress::say(&format!("wardrobe: {error}"));
            ExitCode::FAILURE
        }
    }
}

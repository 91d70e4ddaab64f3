//! The commands, one file each.

mod collection;
mod make;
mod pictures;
mod progress;
mod table;

use std::process::ExitCode;

use amc_core::Result;
use clap::{Parser, Subcommand};
use wardrobe::collection::{COLLECTION, Entry};

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

/// Which garments of the collection are meant, and how fine.
#[derive(Debug, clap::Args)]
struct Selection {
    /// Only these, by name.
    #[arg(long)]
    only: Vec<String>,
    /// About how many triangles each has, in place of those of the files kept: fine ones, for benchmarks.
    #[arg(long)]
    triangles: Option<usize>,
}

impl Selection {
    fn entries(&self) -> Result<Vec<Entry>> {
        for name in &self.only {
            Entry::named(name)?;
        }
        let wanted = |entry: &&Entry| self.only.is_empty() || self.only.iter().any(|name| name == entry.name);
        let entry = |entry: &Entry| self.triangles.map_or(Ok(*entry), |count| entry.with_triangles(count));
        COLLECTION.iter().filter(wanted).map(entry).collect()
    }
}

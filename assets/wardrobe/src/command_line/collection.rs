//! `wardrobe collection`: the files that are kept.

use std::path::PathBuf;

use amc_core::Result;
use amc_core::file::make_folder;
use wardrobe::collection::{COLLECTION, Entry};

use super::make::make;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Where the files go.
    folder: PathBuf,
    /// Only these, by name.
    #[arg(long)]
    only: Vec<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    make_folder(&arguments.folder)?;
    for name in &arguments.only {
        Entry::named(name)?;
    }
    let wanted =
        |entry: &&Entry| arguments.only.is_empty() || arguments.only.iter().any(|name| name == entry.name);
    for entry in COLLECTION.iter().filter(wanted) {
        make(&entry.pattern()?, entry.edge_length, None, &entry.file(&arguments.folder))?;
    }
    Ok(())
}

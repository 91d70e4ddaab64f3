//! `wardrobe collection`: the files that are kept.

use std::path::PathBuf;

use amc_core::Result;
use amc_core::file::make_folder;

use super::Selection;
use super::make::make;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Where the files go.
    folder: PathBuf,
    #[command(flatten)]
    selection: Selection,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    make_folder(&arguments.folder)?;
    for entry in arguments.selection.entries()? {
        make(&entry.pattern()?, entry.edge_length, None, &entry.file(&arguments.folder))?;
    }
    Ok(())
}

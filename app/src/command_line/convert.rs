//! `amc-studio convert`: an AMC to and from other files.

use std::path::PathBuf;

use amc_core::exchange;

use super::Outcome;
use super::output::Output;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// An AMC, a slice atlas, a slice folder, or an ordinary MatCap picture.
    input: PathBuf,
    /// What to make, by its name: .amc.ktx2 an AMC; .matcap.png|.exr the isotropic MatCap; .png|.exr a slice atlas;
    /// a name without suffix a slice folder.
    output: PathBuf,
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    let converted = exchange::convert(&arguments.input, &arguments.output)?;
    for notice in &converted.notices {
        output.notice(notice);
    }
    output.result(&converted, || format!("{} ({})", arguments.output.display(), converted.made))?;
    Ok(())
}

//! `amc-studio convert`: an AMC to and from other files.

use std::path::PathBuf;

use amc_core::exchange::{self, Hints, Kind};

use super::Outcome;
use super::output::Output;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// An AMC, a slice atlas, a slice folder, or an ordinary MatCap picture.
    input: PathBuf,
    /// What to make, by its name: .ktx2 an AMC; .png or .atlas.exr a slice atlas; .matcap.png or .exr the isotropic
    /// MatCap; a name without suffix a slice folder.
    output: PathBuf,
    /// What the input is, where its contents do not say it: amc, atlas, slices, matcap.
    #[arg(long, value_parser = kind)]
    from: Option<Kind>,
    /// What to make, whatever its name: amc, atlas, slices, matcap.
    #[arg(long, value_parser = kind)]
    to: Option<Kind>,
}

fn kind(name: &str) -> Result<Kind, String> {
    name.parse().map_err(|error: amc_core::Error| error.to_string())
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    let converted = exchange::convert(
        &arguments.input,
        &arguments.output,
        Hints { input: arguments.from, output: arguments.to },
    )?;
    for notice in &converted.lost {
        output.notice(notice);
    }
    output.result(&converted, || arguments.output.display().to_string())?;
    Ok(())
}

//! `wardrobe table`: how well the files of the collection are draped.

use std::path::PathBuf;

use amc_core::Result;
use wardrobe::body::Body;
use wardrobe::drape::{self, Energy, Options, Rest};
use wardrobe::measure::{self, Figures};

use super::Selection;
use super::progress::with_progress;

/// How long each garment is left lying, seconds.
const LINGERING: f64 = 0.1;

const REST_HEAD: &str =
    "| garment | energy (J) | after another 0.1 s (mJ) | fastest vertex (mm/s) |\n|---|---|---|---|";

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Where the files are.
    folder: PathBuf,
    #[command(flatten)]
    selection: Selection,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let mut lines = vec![Figures::HEAD.to_owned()];
    let mut rests = vec![REST_HEAD.to_owned()];
    for entry in arguments.selection.entries()? {
        let (cut, draped) = entry.draped(&arguments.folder)?;
        let body = Body::new(cut.figure);
        lines.push(measure::measure(&cut, &draped, &body).row(entry.name));
        let rest = with_progress(|progress| {
            drape::linger(&cut, &draped, &body, LINGERING, &Options::default(), progress)
        })?;
        rests.push(rest_row(entry.name, &rest));
    }
    lines.push(String::new());
    lines.append(&mut rests);
    #[allow(clippy::print_stdout, reason = "the command's result")]
    {
        println!("{}", lines.join("\n"));
    }
    Ok(())
}

/// How the energy goes, and how fast the fastest vertex still is.
fn rest_row(name: &str, rest: &Rest) -> String {
    let total = |energy: Option<&Energy>| energy.map_or(0.0, Energy::total);
    let (before, after) = (total(rest.energies.first()), total(rest.energies.last()));
    format!("| {name} | {before:.4} | {:+.2} | {:.1} |", (after - before) * 1e3, rest.fastest * 1e3)
}

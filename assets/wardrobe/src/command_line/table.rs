//! `wardrobe table`: how well the files of the collection are draped.

use std::path::PathBuf;

use amc_core::Result;
use wardrobe::body::Body;
use wardrobe::collection::COLLECTION;
use wardrobe::measure::{self, Figures};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Where the files are.
    folder: PathBuf,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let mut lines = vec![Figures::HEAD.to_owned()];
    for entry in &COLLECTION {
        let (cut, draped) = entry.draped(&arguments.folder)?;
        lines.push(measure::measure(&cut, &draped, &Body::new(cut.figure)).row(entry.name));
    }
    #[allow(clippy::print_stdout, reason = "the command's result")]
    {
        println!("{}", lines.join("\n"));
    }
    Ok(())
}

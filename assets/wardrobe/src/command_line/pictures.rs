//! `wardrobe pictures`: the collection to look at.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::bake::{BakeOptions, bake};
use amc_core::file::{make_folder, save_bytes};
use amc_core::image::encode;
use amc_core::mesh::Garment;
use amc_core::{Result, reflectance};
use wardrobe::collection::Entry;
use wardrobe::contact_sheet::{Tile, contact_sheet};
use wardrobe::{flat_sheet, garment_file};

use super::Selection;
use super::progress::with_progress;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Where the garments' files are.
    garments: PathBuf,
    /// Where the pictures go: `contact-sheet.png`, and one `NAME.svg` of flat pieces for each garment.
    #[arg(short, long)]
    output: PathBuf,
    /// Columns of one view on the contact sheet; its rows are a quarter more.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(16..=1024))]
    width: u32,
    #[command(flatten)]
    selection: Selection,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    make_folder(&arguments.output)?;
    let entries = arguments.selection.entries()?;
    for entry in &entries {
        let drawing = flat_sheet::svg(&entry.pattern()?)?;
        save_bytes(&arguments.output.join(format!("{}.svg", entry.name)), drawing.as_bytes())?;
    }
    let sheet = with_progress(|progress| {
        let garments = garments(&arguments.garments, &entries)?;
        let fabrics = reflectance::BUNDLED
            .iter()
            .map(|fabric| Ok(Arc::new(bake(&fabric.description()?, &BakeOptions::default(), progress)?)));
        let fabrics: Vec<_> = fabrics.collect::<Result<_>>()?;
        let tile = Tile { width: arguments.width, height: arguments.width * 5 / 4 };
        contact_sheet(&garments, &fabrics, tile, progress)
    })?;
    encode::write_png(&sheet, &arguments.output.join("contact-sheet.png"), &[])
}

fn garments(folder: &Path, entries: &[Entry]) -> Result<Vec<Garment>> {
    let garment = |entry: &Entry| {
        let (cut, draped) = entry.draped(folder)?;
        Garment::new(garment_file::mesh(&cut, &draped)?)
    };
    entries.iter().map(garment).collect()
}

//! `wardrobe make`: one garment.

use std::path::{Path, PathBuf};
use std::time::Instant;

use amc_core::{Error, Result};
use clap::ValueEnum;
use wardrobe::body::Body;
use wardrobe::collection::Entry;
use wardrobe::drape::{self, Options};
use wardrobe::garment_file::{self, Variant};
use wardrobe::measure;
use wardrobe::pattern::Pattern;

use super::progress::{say, with_progress};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A garment of the collection, or a pattern's file (.json).
    garment: PathBuf,
    /// The garment: .glb or .obj
    #[arg(short, long)]
    output: PathBuf,
    /// Length of the triangles' edges, metres.
    #[arg(long, default_value_t = 0.012, conflicts_with = "triangles")]
    edge_length: f64,
    /// About how many triangles, in place of their edges' length.
    #[arg(long)]
    triangles: Option<usize>,
    /// What is done to the UVs, for tests.
    #[arg(long, value_enum)]
    variant: Option<VariantName>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum VariantName {
    /// Drawn from the wrong side.
    Mirrored,
    /// Every panel turned off its grain.
    Turned,
    /// No UVs at all.
    WithoutUvs,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let pattern = pattern(&arguments.garment)?;
    let edge_length = match arguments.triangles {
        Some(triangles) => drape::edge_length_for(&pattern, triangles)?,
        None => arguments.edge_length,
    };
    let variant = arguments.variant.map(|name| match name {
        VariantName::Mirrored => Variant::Mirrored,
        VariantName::Turned => Variant::Turned,
        VariantName::WithoutUvs => Variant::WithoutUvs,
    });
    make(&pattern, edge_length, variant, &arguments.output)
}

/// The pattern in a file, or of a garment of the collection.
fn pattern(garment: &Path) -> Result<Pattern> {
    match garment.to_str() {
        Some(name) if garment.extension().is_none() => Entry::named(name)?.pattern(),
        _ => Pattern::read(garment),
    }
}

/// Makes a garment and says its figures.
pub(super) fn make(
    pattern: &Pattern,
    edge_length: f64,
    variant: Option<Variant>,
    output: &Path,
) -> Result<()> {
    let started = Instant::now();
    let levels = drape::levels(pattern, edge_length)?;
    let Some(finest) = levels.last() else { return Err(Error::invalid("nothing to cut")) };
    let body = Body::new(finest.figure);
    let (draped, rest) =
        with_progress(|progress| drape::drape(&levels, &body, &Options::default(), progress))?;
    let seconds = started.elapsed().as_secs_f64();
    let figures = measure::measure(finest, &draped, &body);
    say(&format!("{}\n{}", measure::Figures::HEAD, figures.row(&finest.name)));
    say(&format!(
        "{seconds:6.1} s in all, {} vertices, {} substeps, fastest {:.1} mm/s",
        figures.vertices,
        rest.substeps,
        rest.fastest * 1e3
    ));
    let mut mesh = garment_file::mesh(finest, &draped)?;
    if let Some(variant) = variant {
        variant.apply(&mut mesh);
    }
    garment_file::save_mesh(mesh, output)
}

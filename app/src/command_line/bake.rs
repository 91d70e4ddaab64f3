//! `amc-studio bake`: an AMC from a reflectance under given lights.

use std::path::{Path, PathBuf};

use amc_core::bake::{self, BakeOptions};
use amc_core::reflectance::{self, Lighting};

use super::output::Output;
use super::progress::with_progress;
use super::values::{AzimuthChoice, FormatChoice, SymmetryChoice};
use super::{Failure, Outcome};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// The reflectance (JSON).
    reflectance: PathBuf,
    /// The AMC: .amc.ktx2.
    #[arg(short, long)]
    output: PathBuf,
    /// Directional lights (JSON) in place of those in the reflectance's file.
    #[arg(long)]
    lights: Option<PathBuf>,
    /// Columns, and rows, of the table.
    #[arg(long, default_value_t = BakeOptions::default().side)]
    size: u32,
    /// Slices of the table [default: 2 size / symmetry].
    #[arg(long)]
    slices: Option<u32>,
    /// auto (the reflectance's own), 1, 2, 3 or 4.
    #[arg(long, default_value = "auto")]
    symmetry: SymmetryChoice,
    /// What the third axis means.
    #[arg(long, value_enum, default_value = "transported")]
    azimuth: AzimuthChoice,
    /// Samples per texel; 1: its centre.
    #[arg(long, default_value_t = BakeOptions::default().samples)]
    samples: u32,
    /// Seed of the samples.
    #[arg(long, default_value_t = BakeOptions::default().seed)]
    seed: u64,
    /// Texels: 8-bit sRGB, or 16-bit float.
    #[arg(long, value_enum, default_value = "srgb8")]
    format: FormatChoice,
}

/// What is said about a table that was baked.
#[derive(Debug, serde::Serialize)]
struct Baked<'a> {
    amc: &'a Path,
    size: u32,
    slices: u32,
    symmetry: u32,
    bytes: usize,
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    if let Some(file) = &arguments.lights
        && file
            .extension()
            .is_some_and(|suffix| suffix.eq_ignore_ascii_case("exr") || suffix.eq_ignore_ascii_case("hdr"))
    {
        return Err(Failure::NotAvailable("lighting by an environment picture".to_owned()));
    }
    let description = reflectance::read(&arguments.reflectance)?;
    let lighting = arguments.lights.as_deref().map(Lighting::read).transpose()?;
    let options = BakeOptions {
        side: arguments.size,
        slices: arguments.slices,
        symmetry: arguments.symmetry.0,
        azimuth: arguments.azimuth.into(),
        format: arguments.format.into(),
        samples: arguments.samples,
        seed: arguments.seed,
        lighting,
    };
    let amc = with_progress(|progress| {
        let amc = bake::bake(&description, &options, progress)?;
        amc.save(&arguments.output)?;
        Ok(amc)
    })?;
    let baked = Baked {
        amc: &arguments.output,
        size: amc.size().side(),
        slices: amc.size().slices(),
        symmetry: amc.symmetry.order(),
        bytes: amc.bytes(),
    };
    output.result(&baked, || {
        let Baked { size, slices, symmetry, .. } = baked;
        format!("{}: {size} x {size} x {slices}, symmetry {symmetry}", baked.amc.display())
    })?;
    Ok(())
}

//! `amc-studio build`: pictures of a turning ball to an AMC.

use std::path::PathBuf;

use amc_core::amc::Frame;
use amc_core::capture::{self, BuildOptions, Turn};
use clap::ValueEnum;

use super::output::Output;
use super::progress::with_progress;
use super::values::{AzimuthChoice, FieldOfView, FormatChoice, Sphere, SymmetryChoice};
use super::{Failure, Outcome};

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A folder of at least 8 pictures (JPEG, PNG, EXR), or a session folder with session.json.
    pictures: PathBuf,
    /// The AMC: .amc.ktx2.
    #[arg(short, long)]
    output: PathBuf,
    /// Columns, and rows, of the table.
    #[arg(long, default_value_t = 128)]
    size: u32,
    /// Slices of the table [default: the power of two nearest to pictures / symmetry, at least 8].
    #[arg(long)]
    slices: Option<u32>,
    /// auto, 1, 2, 3 or 4.
    #[arg(long, default_value = "auto")]
    symmetry: SymmetryChoice,
    /// The largest dissimilarity (0 identical, about 1 unrelated) at which a symmetry is taken.
    #[arg(long, default_value_t = BuildOptions::default().threshold)]
    threshold: f64,
    /// What the third axis means.
    #[arg(long, value_enum, default_value = "transported")]
    azimuth: AzimuthChoice,
    /// What normals are relative to, for a camera at a finite distance.
    #[arg(long, value_enum, default_value = "half")]
    frame: FrameChoice,
    /// Which way the ball turns, as the camera sees it [default: what the session says, else ccw].
    #[arg(long, value_enum)]
    turn: Option<TurnChoice>,
    /// auto, or X,Y,RADIUS in pixels.
    #[arg(long, default_value = "auto", allow_hyphen_values = true)]
    sphere: Sphere,
    /// ortho, or the camera's horizontal field of view in degrees.
    #[arg(long, default_value = "ortho")]
    fov: FieldOfView,
    /// Texels: 8-bit sRGB, or 16-bit float.
    #[arg(long, value_enum, default_value = "srgb8")]
    format: FormatChoice,
    /// A mask of folds and pins (not available in this version).
    #[arg(long)]
    mask: Option<PathBuf>,
    /// Merge exposures (not available in this version).
    #[arg(long)]
    hdr: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FrameChoice {
    Half,
    Full,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TurnChoice {
    Ccw,
    Cw,
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    if arguments.mask.is_some() {
        return Err(Failure::NotAvailable("--mask".to_owned()));
    }
    if arguments.hdr {
        return Err(Failure::NotAvailable("--hdr".to_owned()));
    }
    let options = BuildOptions {
        side: arguments.size,
        slices: arguments.slices,
        symmetry: arguments.symmetry.0,
        threshold: arguments.threshold,
        azimuth: arguments.azimuth.into(),
        frame: match arguments.frame {
            FrameChoice::Half => Frame::Half,
            FrameChoice::Full => Frame::Full,
        },
        turn: arguments.turn.map(|turn| match turn {
            TurnChoice::Ccw => Turn::Ccw,
            TurnChoice::Cw => Turn::Cw,
        }),
        sphere: match arguments.sphere {
            Sphere::Auto => None,
            Sphere::Given { x, y, radius } => Some((x.into(), y.into(), radius.into())),
        },
        horizontal_fov: match arguments.fov {
            FieldOfView::Orthographic => None,
            FieldOfView::Degrees(degrees) => Some(f64::from(degrees).to_radians()),
        },
        format: arguments.format.into(),
    };
    let built = with_progress(|progress| {
        let built = capture::build(&arguments.pictures, &options, progress)?;
        built.amc.save(&arguments.output)?;
        Ok(built)
    })?;
    let report = &built.report;
    for notice in &report.notices {
        output.notice(notice);
    }
    output.result(report, || {
        let size = built.amc.size();
        format!(
            "{}: {} x {} x {}, symmetry {}{}, ball at ({:.1}, {:.1}) radius {:.1} px{}",
            arguments.output.display(),
            size.side(),
            size.side(),
            size.slices(),
            report.symmetry.order(),
            if report.isotropic { " (isotropic)" } else { "" },
            report.ball.x,
            report.ball.y,
            report.ball.radius,
            report.ball.residual.map(|pixels| format!(" (residual {pixels:.2} px)")).unwrap_or_default(),
        )
    })?;
    Ok(())
}

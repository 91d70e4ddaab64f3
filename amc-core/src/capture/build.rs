//! The build: pictures to texels, texels along the turn to slices.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec2;

use super::ball;
use super::cone::{Lens, Sight};
use super::pictures::Plan;
use super::reading::{First, Reading};
use super::report::{Ball, BuildReport};
use super::resample::Footprints;
use super::session::Turn;
use super::slices::Slicing;
use super::symmetry::{self, Analysis, DEFAULT_THRESHOLD};
use super::turn::Spline;
use crate::amc::{Amc, Frame, Symmetry, TableSize, TexelFormat};
use crate::image::decode::{Orientation, Raster};
use crate::view_space::Azimuth;
use crate::{Error, Progress, Result};

/// The most bytes that the resampled texels of all pictures may take: 8 GiB.
const MOST_STACK_BYTES: u64 = 8 << 30;

/// The least share of the ball that must lie in the pictures: of less, most of the table would be made up.
const LEAST_IN_PICTURE: f64 = 0.5;

/// How to build.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildOptions {
    /// Columns and rows of the table.
    pub side: u32,
    /// Slices; none: the power of two nearest to the pictures over R, at least 8.
    pub slices: Option<u32>,
    /// R; none: detected.
    pub symmetry: Option<Symmetry>,
    /// The largest [`super::Similarity`] that counts as the same look.
    pub threshold: f64,
    /// What the third axis is to mean.
    pub azimuth: Azimuth,
    /// What normals are to be relative to. Orthographic pictures count as `Half`.
    pub frame: Frame,
    /// Which way the ball is turned; none: as the session says, else counter-clockwise.
    pub turn: Option<Turn>,
    /// Where the ball is: column, row (of the line to its centre) and mean semi-axis of its outline, pixels from the
    /// top-left corner; none: found.
    pub sphere: Option<(f64, f64, f64)>,
    /// The camera's horizontal field of view, radians, its axis through the picture's centre; none: orthographic.
    pub horizontal_fov: Option<f64>,
    /// How the texels are to be kept.
    pub format: TexelFormat,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self {
            side: 128,
            slices: None,
            symmetry: None,
            threshold: DEFAULT_THRESHOLD,
            azimuth: Azimuth::default(),
            frame: Frame::default(),
            turn: None,
            sphere: None,
            horizontal_fov: None,
            format: TexelFormat::default(),
        }
    }
}

/// What a build gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Built {
    /// The table. Its metadata's `capture` holds the report.
    pub amc: Amc,
    /// What was measured.
    pub report: BuildReport,
}

/// Builds an AMC from pictures of a turning ball (paper, section 5).
///
/// `source` is a folder of at least 8 pictures in even steps over a whole turn, sorted as people count, or a session:
/// a folder with `session.json`, or that file itself. Each picture is decoded once, most of them no further down than
/// the ball reaches, where the format allows it; memory holds one decoded picture per thread, a few kept to find the
/// ball in and read meanwhile, and the texels of all.
///
/// # Errors
/// A file is missing, broken or of another size than the rest, the session is faulty, there are fewer than 8
/// pictures, no ball is found or less than half of it lies in the pictures, an option makes no sense, or somebody
/// cancelled.
pub fn build(source: &Path, options: &BuildOptions, progress: &Progress<'_>) -> Result<Built> {
    check(options)?;
    let plan = Plan::of(source, options.turn)?;
    let reading = Reading::new(&plan, progress);
    let (first, mut kept) = reading.keep()?;
    let lens = Lens::new(options.horizontal_fov, first.width(), first.height())?;
    let (sight, residual) = match options.sphere {
        Some((x, y, radius)) => (Sight::new(lens, DVec2::new(x, y), radius)?, None),
        None => {
            let rasters: Vec<&Raster> = kept.iter().map(|(_, raster)| raster).collect();
            // The search is mostly one thread's work: the others read on meanwhile.
            let searching = AtomicBool::new(true);
            let search = || {
                let found = ball::find(&rasters, lens);
                searching.store(false, Ordering::Relaxed);
                found
            };
            let (found, ahead) = rayon::join(search, || reading.ahead(&first, &kept, &searching));
            let found = found.map_err(|error| error.in_file(source))?;
            kept.extend(ahead?);
            (found.sight, Some(found.residual))
        }
    };
    let frame = if options.horizontal_fov.is_some() { options.frame } else { Frame::Half };
    let share = sight.share_within(frame, first.width(), first.height());
    if share < LEAST_IN_PICTURE {
        return Err(out_of_picture(&sight, share, &first).in_file(source));
    }
    let covered = first.has_alpha;
    let footprints = Footprints::new(&sight, frame, options.side, first.width(), first.height(), covered);
    if footprints.texels.is_empty() {
        return Err(Error::invalid("the ball is too small: no texel of it is seen").in_file(source));
    }
    let bytes = footprints.texels.len() as u64 * 6 * plan.pictures.len() as u64;
    if bytes > MOST_STACK_BYTES {
        return Err(Error::too_large(format!(
            "{} pictures at a table size of {} take {bytes} bytes; the limit is {MOST_STACK_BYTES}",
            plan.pictures.len(),
            options.side
        )));
    }
    let stack = reading.resample(&first, kept, &footprints)?;
    let spline = Spline::new(plan.turns());
    progress.step("finding the symmetry", 0, 1)?;
    let analysis = symmetry::analyse(&stack, &footprints.texels, options.side, &spline);
    let symmetry = options.symmetry.unwrap_or_else(|| analysis.symmetry(options.threshold));
    let slices = options.slices.unwrap_or_else(|| nearest_slices(plan.pictures.len(), symmetry));
    let size = TableSize::new(options.side, slices)?;
    // The mean over the turn, unless the person asked for R = 1.
    let one_look = analysis.isotropic && options.symmetry.is_none();
    let slicing = Slicing::new(size, symmetry, options.azimuth, one_look, &footprints, &spline);
    let (texels, coverage) = slicing.table(&stack, options.format, progress)?;
    let mut amc = Amc::new(size, texels, symmetry, options.azimuth, frame)?;
    let (at, radius) = sight.ball();
    let report = BuildReport {
        pictures: plan.pictures.len(),
        picture_size: [first.width(), first.height()],
        turn: plan.direction,
        symmetry,
        isotropic: analysis.isotropic,
        similarity: analysis.similarity,
        threshold: options.threshold,
        noise: analysis.noise,
        ball: Ball {
            x: at.x,
            y: at.y,
            radius,
            residual,
            cone_half_angle_deg: sight.half_angle().to_degrees(),
        },
        coverage,
        size: size.side(),
        slices,
        azimuth: options.azimuth,
        frame,
        format: options.format,
        notices: notices(&plan, &first, options, size, &analysis, frame),
    };
    amc.metadata.capture = serde_json::to_value(&report)
        .map_err(|error| Error::invalid("the report cannot be kept as JSON").because(error))?;
    Ok(Built { amc, report })
}

fn check(options: &BuildOptions) -> Result<()> {
    TableSize::new(options.side, options.slices.unwrap_or(1))?;
    if options.side < 4 {
        return Err(Error::invalid(format!(
            "a table of {0} x {0} texels; at least 4 are needed",
            options.side
        )));
    }
    if !(options.threshold >= 0.0 && options.threshold.is_finite()) {
        return Err(Error::invalid(format!("a threshold of {}; it must be 0 or more", options.threshold)));
    }
    Ok(())
}

fn out_of_picture(sight: &Sight, share: f64, first: &First<'_>) -> Error {
    let (at, radius) = sight.ball();
    Error::invalid(format!(
        "{:.0} % of a ball of radius {radius:.0} pixels at {:.0}, {:.0} lies outside of the pictures, which have {} x {}; \
         at most half may, for what no picture shows is made up",
        100.0 * (1.0 - share),
        at.x,
        at.y,
        first.width(),
        first.height()
    ))
}

/// The power of two nearest to `pictures / R`, the larger of two equally near; at least 8.
fn nearest_slices(pictures: usize, symmetry: Symmetry) -> u32 {
    let wanted = pictures as f64 / f64::from(symmetry.order());
    let below = (wanted.max(1.0).log2().floor() as u32).min(10);
    let (low, high) = (1u32 << below, 2u32 << below);
    let nearest = if wanted - f64::from(low) < f64::from(high) - wanted { low } else { high };
    nearest.clamp(8, TableSize::LIMIT)
}

fn notices(
    plan: &Plan,
    first: &First<'_>,
    options: &BuildOptions,
    size: TableSize,
    analysis: &Analysis,
    frame: Frame,
) -> Vec<String> {
    let mut notices = plan.notices.clone();
    if first.orientation != Orientation::UPRIGHT {
        notices.push(format!(
            "the pictures were turned as their Exif orientation, {}, says; pixels count in them as they are turned",
            first.orientation.tag()
        ));
    }
    if !size.is_power_of_two() {
        notices.push(format!("the table's size {} x {} is no power of two", size.side(), size.slices()));
    }
    if frame != options.frame {
        notices.push("orthographic pictures count as frame half".to_owned());
    }
    if let Some(asked) = options.symmetry
        && analysis.symmetry(options.threshold) < asked
        && !analysis.isotropic
    {
        notices
            .push(format!("the pictures do not repeat {} times in a turn, as was asked for", asked.order()));
    }
    notices
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_are_the_nearest_power_of_two() {
        let cases =
            [(128, 2, 64), (96, 2, 64), (37, 1, 32), (100, 1, 128), (8, 4, 8), (100, 3, 32), (4096, 1, 2048)];
        for (pictures, order, slices) in cases {
            assert_eq!(
                nearest_slices(pictures, Symmetry::try_from(order).unwrap()),
                slices,
                "{pictures} {order}"
            );
        }
    }
}

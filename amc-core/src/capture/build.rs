//! The build: pictures to texels, texels along the turn to slices.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex};

use glam::DVec2;
use half::f16;
use half::slice::HalfFloatSliceExt as _;
use rayon::prelude::*;

use super::ball;
use super::cone::{Lens, Sight};
use super::fill::RimFill;
use super::pictures::{Plan, Planned};
use super::report::{Ball, BuildReport};
use super::resample::{Footprints, MOST_LIGHT, Texel};
use super::session::Turn;
use super::symmetry::{self, Analysis, DEFAULT_THRESHOLD};
use super::turn::{Direction, Spline, Stack, reading_turn};
use crate::amc::{Amc, Frame, Symmetry, TableSize, TexelFormat, Texels};
use crate::color::srgb8_from_linear;
use crate::image::decode::{MOST_BYTES, Orientation, Raster, decode_reusing};
use crate::view_space::Azimuth;
use crate::{Error, Progress, Result};

/// The most pictures kept to find the ball in (an odd number: a cloth of even R shows each a different look), and the most bytes that they may take beyond the first few.
const KEPT: usize = 5;
const KEPT_BYTES: u64 = 64 << 20;

/// The most bytes that the resampled texels of all pictures may take: 8 GiB.
const MOST_STACK_BYTES: u64 = 8 << 30;

/// The least share of the ball that must lie in the pictures: of less, most of the table would be made up.
const LEAST_IN_PICTURE: f64 = 0.5;

/// Texels resampled along the turn at once.
const BLOCK: usize = 64;

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
/// a folder with `session.json`, or that file itself. Each picture is decoded once; memory holds one decoded picture
/// per thread, a few kept to find the ball in and read meanwhile, and the texels of all.
///
/// # Errors
/// A file is missing, broken or of another size than the rest, the session is faulty, there are fewer than 8
/// pictures, no ball is found or less than half of it lies in the pictures, an option makes no sense, or somebody
/// cancelled.
pub fn build(source: &Path, options: &BuildOptions, progress: &Progress<'_>) -> Result<Built> {
    check(options)?;
    let plan = Plan::of(source, options.turn)?;
    let reading = Reading { plan: &plan, progress, done: AtomicUsize::new(0), buffers: Mutex::default() };
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
    let directions = symmetry.order() * slices;
    let slicing = Slicing {
        size,
        directions: (0..directions)
            .map(|k| Direction::new(std::f64::consts::TAU * f64::from(k) / f64::from(directions)))
            .collect(),
        symmetry,
        azimuth: options.azimuth,
        // The mean over the turn, unless the person asked for R = 1.
        one_look: analysis.isotropic && options.symmetry.is_none(),
        footprints: &footprints,
        spline: &spline,
        half_turns: if symmetry.order().is_multiple_of(2) { spline.of_half_turns() } else { None },
        progress,
    };
    let (texels, coverage) = slicing.table(&stack, options.format)?;
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

/// What all pictures must share, and what is known of the first.
struct First<'a> {
    path: &'a Path,
    size: [u32; 2],
    has_alpha: bool,
    orientation: Orientation,
}

impl First<'_> {
    fn width(&self) -> u32 {
        self.size[0]
    }

    fn height(&self) -> u32 {
        self.size[1]
    }
}

/// Reading the pictures.
struct Reading<'a> {
    plan: &'a Plan,
    progress: &'a Progress<'a>,
    done: AtomicUsize,
    /// Memory of pictures that are done with: about one for each thread.
    buffers: Mutex<Vec<Vec<u8>>>,
}

impl<'a> Reading<'a> {
    /// The texels of a picture, which is done with.
    fn texels(&self, footprints: &Footprints, raster: Raster) -> Vec<f16> {
        let texels = footprints.resample(&raster);
        if let (Some(buffer), Ok(mut buffers)) = (raster.into_buffer(), self.buffers.lock()) {
            buffers.push(buffer);
        }
        texels
    }

    fn read(&self, planned: &Planned) -> Result<Raster> {
        if self.progress.is_cancelled() {
            return Err(Error::cancelled());
        }
        let bytes = crate::file::read(&planned.path, MOST_BYTES)?;
        let buffer = self.buffers.lock().map_or_else(|_| None, |mut buffers| buffers.pop());
        let raster = decode_reusing(&bytes, buffer.unwrap_or_default())
            .map_err(|error| error.in_file(&planned.path))?;
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.progress.step("reading pictures", done, self.plan.pictures.len())?;
        Ok(raster)
    }

    /// Reads a few pictures, spread evenly over the turn, to find the ball in.
    fn keep(&self) -> Result<(First<'a>, Vec<(usize, Raster)>)> {
        let pictures = &self.plan.pictures;
        let Some(planned) = pictures.first() else { return Err(Error::invalid("there are no pictures")) };
        let raster = self.read(planned)?;
        let first = First {
            path: &planned.path,
            size: [raster.width(), raster.height()],
            has_alpha: raster.has_alpha(),
            orientation: raster.orientation(),
        };
        let kept = ((KEPT_BYTES / raster.bytes().max(1)) as usize).clamp(3, KEPT).min(pictures.len());
        let others: Vec<usize> = (1..kept).map(|k| k * pictures.len() / kept).collect();
        let mut rasters: Vec<(usize, Raster)> =
            others.par_iter().map(|&k| self.read_like(&first, k)).collect::<Result<_>>()?;
        rasters.insert(0, (0, raster));
        Ok((first, rasters))
    }

    /// Reads pictures more while the search goes on, at most [`KEPT_BYTES`] of them.
    fn ahead(
        &self,
        first: &First<'_>,
        kept: &[(usize, Raster)],
        searching: &AtomicBool,
    ) -> Result<Vec<(usize, Raster)>> {
        let bytes = kept.first().map_or(1, |(_, raster)| raster.bytes());
        let most = (KEPT_BYTES / bytes.max(1)) as usize;
        let others = (0..self.plan.pictures.len()).filter(|k| kept.iter().all(|(other, _)| other != k));
        let next: Vec<usize> = others.take(most).collect();
        let read = |&k: &usize| searching.load(Ordering::Relaxed).then(|| self.read_like(first, k));
        next.par_iter().with_max_len(1).filter_map(read).collect()
    }

    /// Reads a picture that must be of the first one's size.
    fn read_like(&self, first: &First<'_>, k: usize) -> Result<(usize, Raster)> {
        let planned = &self.plan.pictures[k];
        let raster = self.read(planned)?;
        check_size(first, &planned.path, &raster)?;
        Ok((k, raster))
    }

    /// The texels of all pictures: of those kept, and of all others, each dropped as soon as it is resampled.
    fn resample(
        &self,
        first: &First<'_>,
        kept: Vec<(usize, Raster)>,
        footprints: &Footprints,
    ) -> Result<Stack> {
        let mut texels: Vec<Option<Vec<f16>>> = vec![None; self.plan.pictures.len()];
        let from_kept: Vec<(usize, Vec<f16>)> =
            kept.into_par_iter().map(|(k, raster)| (k, self.texels(footprints, raster))).collect();
        for (k, resampled) in from_kept {
            texels[k] = Some(resampled);
        }
        // One at a time, or a thread that is done early waits for several of another's.
        texels.par_iter_mut().with_max_len(1).zip(&self.plan.pictures).try_for_each(
            |(texels, planned)| {
                if texels.is_none() {
                    let raster = self.read(planned)?;
                    check_size(first, &planned.path, &raster)?;
                    *texels = Some(self.texels(footprints, raster));
                }
                Ok(())
            },
        )?;
        Ok(Stack { pictures: texels.into_iter().flatten().collect() })
    }
}

fn check_size(first: &First<'_>, path: &Path, raster: &Raster) -> Result<()> {
    let name = first.path.file_name().unwrap_or(first.path.as_os_str()).to_string_lossy();
    if raster.orientation() != first.orientation {
        return Err(Error::invalid(format!(
            "its Exif orientation is {}, that of {name} is {}; a camera that stands still has one: take the tag out of all",
            raster.orientation().tag(),
            first.orientation.tag()
        ))
        .in_file(path));
    }
    if [raster.width(), raster.height()] == first.size {
        return Ok(());
    }
    Err(Error::invalid(format!(
        "{} x {} pixels, but {name} has {} x {}; all pictures must have one size",
        raster.width(),
        raster.height(),
        first.width(),
        first.height()
    ))
    .in_file(path))
}

/// The 8-bit sRGB value of each half float.
static SRGB8_FROM_HALF: LazyLock<Vec<u8>> =
    LazyLock::new(|| (0..=u16::MAX).map(|bits| srgb8_from_linear(f16::from_bits(bits).to_f32())).collect());

/// From the texels of all pictures to slices.
struct Slicing<'a> {
    size: TableSize,
    /// All directions of a turn, R times as many as slices.
    directions: Vec<Direction>,
    symmetry: Symmetry,
    azimuth: Azimuth,
    one_look: bool,
    footprints: &'a Footprints,
    spline: &'a Spline,
    /// Through the mean of each picture and the one half a turn on, where all directions come in such pairs: half
    /// the work, and the same curve.
    half_turns: Option<Spline>,
    progress: &'a Progress<'a>,
}

/// Some texels' colours, slice by slice.
struct Block {
    /// `[slice][texel]`, red, green and blue.
    colours: Vec<[f16; 3]>,
    /// The share of the pictures that showed the texel.
    shown: Vec<f32>,
}

impl Slicing<'_> {
    /// The table, and the share of its disc that was measured.
    fn table(&self, stack: &Stack, format: TexelFormat) -> Result<(Texels, f64)> {
        let all: Vec<usize> = (0..self.footprints.texels.len()).collect();
        let done = AtomicUsize::new(0);
        let total = all.len().div_ceil(BLOCK);
        let blocks: Vec<Block> = all
            .par_chunks(BLOCK)
            .map(|chunk| {
                let block = self.block(stack, chunk);
                self.progress.step("resampling the turn", done.fetch_add(1, Ordering::Relaxed) + 1, total)?;
                Ok(block)
            })
            .collect::<Result<_>>()?;
        let shown: Vec<f32> = blocks.iter().flat_map(|block| block.shown.iter().copied()).collect();
        // A texel that half of the pictures hide is filled like the rim.
        let measured: Vec<bool> = shown.iter().map(|&shown| shown >= 0.5).collect();
        let fill = RimFill::new(self.size.side(), &self.footprints.texels, &measured)?;
        let coverage =
            measured.iter().filter(|&&measured| measured).count() as f64 / disc_texels(self.size) as f64;
        let texels = match format {
            TexelFormat::Srgb8 => {
                let encode = &*SRGB8_FROM_HALF;
                let value = |half: f16| encode.get(usize::from(half.to_bits())).copied().unwrap_or(0);
                Texels::Srgb8(self.slices(&blocks, &shown, &fill, [0; 4], |[r, g, b], alpha| {
                    [value(r), value(g), value(b), (alpha * 255.0 + 0.5) as u8]
                }))
            }
            TexelFormat::Half => {
                Texels::Half(self.slices(&blocks, &shown, &fill, [f16::ZERO; 4], |[r, g, b], alpha| {
                    [r, g, b, f16::from_f32(alpha)]
                }))
            }
        };
        Ok((texels, coverage))
    }

    fn block(&self, stack: &Stack, chunk: &[usize]) -> Block {
        let lanes = 3 * chunk.len();
        let (mut values, shown) = stack.gather(chunk);
        let spline = match &self.half_turns {
            Some(half_turns) => {
                fold(&mut values);
                half_turns
            }
            None => self.spline,
        };
        let curves = spline.curves(lanes, values);
        let slices = self.size.slices() as usize;
        let copies = if self.half_turns.is_some() { 2 } else { 1 };
        let share = copies as f32 / self.symmetry.order() as f32;
        let mut colours = vec![[f16::ZERO; 3]; chunk.len() * slices];
        let mut sums = vec![[0.0f32; 3]; slices];
        let mut halves = vec![[f16::ZERO; 3]; slices];
        for (k, &texel) in chunk.iter().enumerate() {
            sums.fill([0.0; 3]);
            self.each_direction(&self.footprints.texels[texel], |slice, turn| {
                let colour = curves.colour(&spline.position(turn), 3 * k);
                for (sum, value) in sums[slice].iter_mut().zip(colour) {
                    *sum += value * share;
                }
            });
            if self.one_look {
                let mean =
                    std::array::from_fn(|c| sums.iter().map(|sum| sum[c]).sum::<f32>() / slices as f32);
                sums.fill(mean);
            }
            for value in sums.as_flattened_mut() {
                *value = value.min(MOST_LIGHT);
            }
            halves.as_flattened_mut().convert_from_f32_slice(sums.as_flattened());
            for (colour, half) in colours[k..].iter_mut().step_by(chunk.len()).zip(&halves) {
                *colour = *half;
            }
        }
        Block { colours, shown }
    }

    /// Calls `read` with each slice and each of the turns at which the curves show it: R of them, or, of half turns, R/2
    /// at twice the turn.
    fn each_direction(&self, texel: &Texel, mut read: impl FnMut(usize, f64)) {
        let slices = self.size.slices() as usize;
        let all = self.directions.len();
        // Half a turn of the tangent is half a turn of the ball, at every normal.
        let (reckoned, copies) = if all.is_multiple_of(2) { (all / 2, 2) } else { (all, 1) };
        for (k, direction) in self.directions[..reckoned].iter().enumerate() {
            let turn = reading_turn(texel, self.azimuth, direction);
            if self.half_turns.is_some() {
                read(k % slices, 2.0 * turn);
                continue;
            }
            for copy in 0..copies {
                read((k + copy * reckoned) % slices, turn + std::f64::consts::PI * copy as f64);
            }
        }
    }

    /// The slices one after the other: measured texels, and those filled in.
    fn slices<T: Copy + Send + Sync>(
        &self,
        blocks: &[Block],
        shown: &[f32],
        fill: &RimFill,
        empty: T,
        encode: impl Fn([f16; 3], f32) -> T + Sync,
    ) -> Vec<T> {
        let mut texels = vec![empty; self.size.texels()];
        texels.par_chunks_mut(self.size.slice_texels()).enumerate().for_each(|(slice, texels)| {
            let mut halves: Vec<[f16; 3]> = Vec::with_capacity(self.footprints.texels.len());
            for block in blocks {
                let count = block.shown.len();
                halves.extend_from_slice(&block.colours[slice * count..][..count]);
            }
            for ((texel, half), &shown) in self.footprints.texels.iter().zip(&halves).zip(shown) {
                let at = (texel.j * self.size.side() + texel.i) as usize;
                // Full only where every picture showed it.
                texels[at] = encode(*half, if shown >= 1.0 { 1.0 } else { 0.5 + shown * 0.49 });
            }
            let mut colours = vec![[0.0f32; 3]; halves.len()];
            halves.as_flattened().convert_to_f32_slice(colours.as_flattened_mut());
            fill.each(|at, sources| {
                let mut sum = [0.0; 3];
                for &(texel, weight) in sources {
                    for (sum, value) in sum.iter_mut().zip(colours[texel as usize]) {
                        *sum += weight * value;
                    }
                }
                texels[at] = encode(sum.map(f16::from_f32), RimFill::ALPHA);
            });
        });
        texels
    }
}

/// Leaves the mean of the first half of the pictures' values and the second.
fn fold(values: &mut Vec<f32>) {
    let half = values.len() / 2;
    let (first, second) = values.split_at_mut(half);
    for (value, other) in first.iter_mut().zip(second) {
        *value = (*value + *other) / 2.0;
    }
    values.truncate(half);
}

/// Texels whose centre lies on the disc.
fn disc_texels(size: TableSize) -> usize {
    let on_disc = |k: u32| size.normal_xy(k % size.side(), k / size.side()).length_squared() < 1.0;
    (0..size.side() * size.side()).filter(|&k| on_disc(k)).count()
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

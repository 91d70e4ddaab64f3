//! Reading the pictures, each once: a few are kept to find the ball in, all others are dropped as soon as they are texels.

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use half::f16;
use rayon::prelude::*;

use super::pictures::{Plan, Planned};
use super::resample::Footprints;
use super::turn::Stack;
use crate::image::decode::{MOST_BYTES, Orientation, Raster, decode_rows};
use crate::{Error, Progress, Result};

/// The most pictures kept to find the ball in (an odd number: a cloth of even R shows each a different look), and the most bytes that they may take beyond the first few.
const KEPT: usize = 5;
const KEPT_BYTES: u64 = 64 << 20;

/// What all pictures must share, and what is known of the first.
pub(super) struct First<'a> {
    path: &'a Path,
    size: [u32; 2],
    pub(super) has_alpha: bool,
    pub(super) orientation: Orientation,
}

impl First<'_> {
    pub(super) fn width(&self) -> u32 {
        self.size[0]
    }

    pub(super) fn height(&self) -> u32 {
        self.size[1]
    }
}

/// Reading the pictures.
pub(super) struct Reading<'a> {
    plan: &'a Plan,
    progress: &'a Progress<'a>,
    done: AtomicUsize,
    /// Memory of pictures that are done with: about one for each thread.
    buffers: Mutex<Vec<Vec<u8>>>,
}

impl<'a> Reading<'a> {
    pub(super) fn new(plan: &'a Plan, progress: &'a Progress<'a>) -> Self {
        Self { plan, progress, done: AtomicUsize::new(0), buffers: Mutex::default() }
    }

    /// The texels of a picture, which is done with.
    fn texels(&self, footprints: &Footprints, raster: Raster) -> Vec<f16> {
        let texels = footprints.resample(&raster);
        if let (Some(buffer), Ok(mut buffers)) = (raster.into_buffer(), self.buffers.lock()) {
            buffers.push(buffer);
        }
        texels
    }

    /// Reads a picture, of which at least the first `rows` rows are asked for.
    fn read(&self, planned: &Planned, rows: usize) -> Result<Raster> {
        if self.progress.is_cancelled() {
            return Err(Error::cancelled());
        }
        let bytes = crate::file::read(&planned.path, MOST_BYTES)?;
        let buffer = self.buffers.lock().map_or_else(|_| None, |mut buffers| buffers.pop());
        let raster = decode_rows(&bytes, buffer.unwrap_or_default(), rows)
            .map_err(|error| error.in_file(&planned.path))?;
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.progress.step("reading pictures", done, self.plan.pictures.len())?;
        Ok(raster)
    }

    /// Reads a few pictures, spread evenly over the turn, to find the ball in.
    pub(super) fn keep(&self) -> Result<(First<'a>, Vec<(usize, Raster)>)> {
        let pictures = &self.plan.pictures;
        let Some(planned) = pictures.first() else { return Err(Error::invalid("there are no pictures")) };
        let raster = self.read(planned, usize::MAX)?;
        let first = First {
            path: &planned.path,
            size: [raster.width(), raster.height()],
            has_alpha: raster.has_alpha(),
            orientation: raster.orientation(),
        };
        let kept = ((KEPT_BYTES / raster.bytes().max(1)) as usize).clamp(3, KEPT).min(pictures.len());
        let others: Vec<usize> = (1..kept).map(|k| k * pictures.len() / kept).collect();
        let mut rasters: Vec<(usize, Raster)> =
            others.par_iter().map(|&k| self.read_like(&first, k, usize::MAX)).collect::<Result<_>>()?;
        rasters.insert(0, (0, raster));
        Ok((first, rasters))
    }

    /// Reads pictures more while the search goes on, at most [`KEPT_BYTES`] of them.
    pub(super) fn ahead(
        &self,
        first: &First<'_>,
        kept: &[(usize, Raster)],
        searching: &AtomicBool,
    ) -> Result<Vec<(usize, Raster)>> {
        let bytes = kept.first().map_or(1, |(_, raster)| raster.bytes());
        let most = (KEPT_BYTES / bytes.max(1)) as usize;
        let others = (0..self.plan.pictures.len()).filter(|k| kept.iter().all(|(other, _)| other != k));
        let next: Vec<usize> = others.take(most).collect();
        let read =
            |&k: &usize| searching.load(Ordering::Relaxed).then(|| self.read_like(first, k, usize::MAX));
        next.par_iter().with_max_len(1).filter_map(read).collect()
    }

    /// Reads a picture that must be of the first one's size, and of which at least the first `rows` rows are asked for.
    fn read_like(&self, first: &First<'_>, k: usize, rows: usize) -> Result<(usize, Raster)> {
        let planned = &self.plan.pictures[k];
        let raster = self.read(planned, rows)?;
        check_size(first, &planned.path, &raster)?;
        Ok((k, raster))
    }

    /// The texels of all pictures: of those kept, and of all others, each dropped as soon as it is resampled.
    pub(super) fn resample(
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
        // Rows count in the file, before it is turned.
        let upright = first.orientation == Orientation::UPRIGHT;
        let rows = if upright { footprints.rows(first.width()) } else { usize::MAX };
        // One at a time, or a thread that is done early waits for several of another's.
        texels.par_iter_mut().enumerate().with_max_len(1).try_for_each(|(k, texels)| {
            if texels.is_none() {
                let (_, raster) = self.read_like(first, k, rows)?;
                *texels = Some(self.texels(footprints, raster));
            }
            Ok(())
        })?;
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

//! A whole turn of the garment, frame by frame.

use std::path::Path;

use amc_core::color::srgb8_from_linear;
use amc_core::image::Picture;
use amc_core::image::stream::{self, Backdrop, Palette, Timing};
use amc_core::render::Shading;
use amc_core::{Error, Progress, Result};

use super::format::MovingFormat;
use super::sheet::Sheet;
use super::{Painter, Size, Stand};

/// The most pixels of a frame: 3840 x 2160 fit. A frame is held as a whole, 128 MiB of them.
const FRAME_PIXELS: u64 = 1 << 23;

/// From how many sides a GIF's colours are chosen, and how large those pictures are, pixels along the longer side.
const COLOUR_VIEWS: u32 = 8;
const COLOUR_SIDE: u32 = 96;

/// A turn to be made.
#[derive(Debug)]
pub(super) struct Turn<'a> {
    pub(super) stand: &'a Stand,
    /// Of a frame.
    pub(super) size: Size,
    pub(super) shading: &'a Shading,
    pub(super) timing: Timing,
}

impl Turn<'_> {
    /// Whether it can be made.
    pub(super) fn check(&self) -> Result<()> {
        self.timing.check()?;
        let Size { width, height } = self.size;
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || pixels > FRAME_PIXELS {
            return Err(Error::too_large(format!(
                "frames of {width} x {height} pixels; a frame may have 1 to {FRAME_PIXELS}"
            )));
        }
        Ok(())
    }

    pub(super) fn save(
        &self,
        painter: &mut Painter,
        format: MovingFormat,
        file: &Path,
        progress: &Progress<'_>,
    ) -> Result<()> {
        self.check()?;
        let Size { width, height } = self.size;
        match format {
            MovingFormat::Png => {
                stream::save_apng(file, width, height, self.timing, |put| self.draw(painter, progress, put))
            }
            MovingFormat::Gif => {
                let palette = self.palette(painter, progress)?;
                let backdrop = match self.shading.background {
                    Some(_) => Backdrop::Opaque,
                    None => Backdrop::Transparent,
                };
                stream::save_gif(file, width, height, self.timing, (&palette, backdrop), |put| {
                    self.draw(painter, progress, put)
                })
            }
        }
    }

    fn draw(&self, painter: &mut Painter, progress: &Progress<'_>, put: stream::Put<'_>) -> Result<()> {
        let frames = self.timing.frames;
        for k in 0..frames {
            progress.step("drawing frames", k as usize, frames as usize)?;
            put(&self.frame(painter, self.size, f64::from(k) / f64::from(frames))?)?;
        }
        Ok(())
    }

    fn frame(&self, painter: &mut Painter, size: Size, share: f64) -> Result<Picture> {
        let view = self.stand.turned(share).view(size)?;
        let sheet = Sheet { cells: &[view], columns: 1, shading: self.shading };
        // Frames are told, not their parts.
        sheet.picture(painter, &Progress::none())
    }

    /// The colours of the garment from all around.
    fn palette(&self, painter: &mut Painter, progress: &Progress<'_>) -> Result<Palette> {
        let longer = self.size.width.max(self.size.height);
        let side = |length: u32| match longer > COLOUR_SIDE {
            true => (length * COLOUR_SIDE / longer).max(1),
            false => length,
        };
        let size = Size { width: side(self.size.width), height: side(self.size.height) };
        let mut samples = Vec::new();
        for k in 0..COLOUR_VIEWS {
            progress.step("choosing colours", k as usize, COLOUR_VIEWS as usize)?;
            samples.push(self.frame(painter, size, f64::from(k) / f64::from(COLOUR_VIEWS))?);
        }
        let behind = self.shading.background.map(|linear| linear.map(srgb8_from_linear));
        Ok(Palette::of(&samples, behind))
    }
}

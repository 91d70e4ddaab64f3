//! A picture of one view, or of several in equal cells, drawn band by band.

use amc_core::image::Picture;
use amc_core::render::{Part, Shading, View};
use amc_core::{Error, Progress, Result};

use super::Painter;

/// The most columns and the most rows of a picture.
pub(crate) const SIDE_LIMIT: u32 = 32_768;

/// The most pixels of a band: 64 MiB of them.
const BAND_PIXELS: u32 = 1 << 22;

/// The most rows of a band. Even, as all starts of parts must be.
const BAND_ROWS: u32 = 1024;

/// Of a picture, or of a cell, or of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Size {
    /// Columns.
    pub(crate) width: u32,
    /// Rows.
    pub(crate) height: u32,
}

/// Equal cells, row by row from the top.
#[derive(Debug)]
pub(super) struct Sheet<'a> {
    /// Of one size.
    pub(super) cells: &'a [View],
    /// Cells side by side.
    pub(super) columns: u32,
    pub(super) shading: &'a Shading,
}

impl Sheet<'_> {
    /// Its size.
    ///
    /// # Errors
    /// There is no pixel in it, or it is over [`SIDE_LIMIT`].
    pub(super) fn size(&self) -> Result<Size> {
        let cell = self.cell();
        let rows = (self.cells.len() as u64).div_ceil(u64::from(self.columns.max(1)));
        let sides = [u64::from(cell.width) * u64::from(self.columns), u64::from(cell.height) * rows];
        let [Some(width), Some(height)] =
            sides.map(|side| u32::try_from(side).ok().filter(|side| (1..=SIDE_LIMIT).contains(side)))
        else {
            return Err(Error::too_large(format!(
                "a picture of {} x {} pixels; each side must hold 1 to {SIDE_LIMIT}",
                sides[0], sides[1]
            )));
        };
        Ok(Size { width, height })
    }

    fn cell(&self) -> Size {
        let first = self.cells.first();
        first.map_or(Size { width: 0, height: 0 }, |view| Size { width: view.width, height: view.height })
    }

    /// Draws it band by band, each of which is given to `put`.
    pub(super) fn draw(
        &self,
        painter: &mut Painter,
        progress: &Progress<'_>,
        put: &mut dyn FnMut(&Picture) -> Result<()>,
    ) -> Result<()> {
        let (size, cell) = (self.size()?, self.cell());
        let rows = (BAND_PIXELS / size.width).clamp(2, BAND_ROWS) & !1;
        let columns = (painter.columns(rows.min(cell.height)) & !1).max(2);
        let total = self.cells.len()
            * (cell.height.div_ceil(rows) as usize)
            * (cell.width.div_ceil(columns) as usize);
        let mut done = 0;
        for cells in self.cells.chunks(self.columns as usize) {
            for (top, height) in spans(cell.height, rows) {
                let mut band = Picture::new(size.width, height, self.blank(size.width, height))?;
                for (number, view) in (0..).zip(cells) {
                    for (left, width) in spans(cell.width, columns) {
                        progress.step("drawing", done, total)?;
                        let part = view.part(Part { left, top, width, height });
                        let drawn = painter.draw(&part, self.shading, progress)?;
                        copy(&drawn, &mut band, number * cell.width + left);
                        done += 1;
                    }
                }
                put(&band)?;
            }
        }
        Ok(())
    }

    /// The whole of it, for frames.
    pub(super) fn picture(&self, painter: &mut Painter, progress: &Progress<'_>) -> Result<Picture> {
        let Size { width, height } = self.size()?;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        self.draw(painter, progress, &mut |band| {
            pixels.extend_from_slice(band.pixels());
            Ok(())
        })?;
        Picture::new(width, height, pixels)
    }

    /// What is where no cell is.
    fn blank(&self, width: u32, height: u32) -> Vec<[f32; 4]> {
        let pixel = self.shading.background.map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]);
        vec![pixel; width as usize * height as usize]
    }
}

/// A length cut into pieces: where each starts, and how long it is.
fn spans(length: u32, most: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..length).step_by(most as usize).map(move |start| (start, most.min(length - start)))
}

/// Copies a part of a band to where it belongs.
fn copy(part: &Picture, band: &mut Picture, left: u32) {
    let (width, left) = (band.width() as usize, left as usize);
    let columns = part.width() as usize;
    let rows = band.pixels_mut().chunks_exact_mut(width).zip(part.pixels().chunks_exact(columns));
    for (row, part) in rows {
        row[left..left + columns].copy_from_slice(part);
    }
}

//! What is wanted of a garment: pictures of which kind, how large, in which file.

use std::path::{Path, PathBuf};

use amc_core::image::stream::{self, Timing};
use amc_core::render::{Shading, View};
use amc_core::{Progress, Result};
use studio_plugin::document::NamedView;

use super::format::{MovingFormat, StillFormat};
use super::sheet::Sheet;
use super::turn::Turn;
use super::{Painter, Size, Stand};

/// The most cells side by side that need not be asked for.
const CELLS_IN_ROW: usize = 4;

/// What is made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Kind {
    /// One picture of the view.
    Still,
    /// A contact sheet: the garment from these sides, in equal cells, up to four of them side by side.
    Views(Vec<NamedView>),
    /// One turn of the garment about its own vertical axis, beginning with the view.
    Turn(Timing),
}

/// A picture, a contact sheet or a turn to be made.
#[derive(Debug, Clone)]
pub(crate) struct Order {
    pub(crate) kind: Kind,
    pub(crate) stand: Stand,
    /// Of the picture, of a cell, of a frame.
    pub(crate) size: Size,
    pub(crate) shading: Shading,
    pub(crate) file: PathBuf,
}

impl Order {
    /// Whether a file of this name can hold what is wanted.
    pub(crate) fn check_file(kind: &Kind, file: &Path) -> Result<()> {
        match kind {
            Kind::Still | Kind::Views(_) => StillFormat::of(file).map(|_| ()),
            Kind::Turn(_) => MovingFormat::of(file).map(|_| ()),
        }
    }

    /// Makes it.
    ///
    /// # Errors
    /// Sizes over the limits, a suffix that says nothing, the device or the file system refuses, cancelled; nothing is left
    /// behind then.
    pub(crate) fn carry_out(&self, painter: &mut Painter, progress: &Progress<'_>) -> Result<()> {
        let (size, shading) = (self.size, &self.shading);
        match &self.kind {
            Kind::Still => {
                let cells = [self.stand.view(size)?];
                self.save(&Sheet { cells: &cells, columns: 1, shading }, painter, progress)
            }
            Kind::Views(views) => {
                let cells: Vec<View> =
                    views.iter().map(|&named| self.stand.named(named).view(size)).collect::<Result<_>>()?;
                let columns = columns(cells.len());
                self.save(&Sheet { cells: &cells, columns, shading }, painter, progress)
            }
            Kind::Turn(timing) => {
                let turn = Turn { stand: &self.stand, size, shading, timing: *timing };
                turn.save(painter, MovingFormat::of(&self.file)?, &self.file, progress)
            }
        }
    }

    fn save(&self, sheet: &Sheet<'_>, painter: &mut Painter, progress: &Progress<'_>) -> Result<()> {
        let Size { width, height } = sheet.size()?;
        let make = |put: stream::Put<'_>| sheet.draw(painter, progress, put);
        match StillFormat::of(&self.file)? {
            StillFormat::Png => stream::save_png(&self.file, width, height, make),
            StillFormat::Exr => stream::save_exr(&self.file, width, height, make),
        }
    }
}

/// Cells side by side: all in one row, or two rows as even as they can be.
fn columns(cells: usize) -> u32 {
    let columns = if cells <= CELLS_IN_ROW { cells } else { cells.div_ceil(2) };
    columns.max(1) as u32
}

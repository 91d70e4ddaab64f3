//! The flat pattern for the cutting room: pieces to scale with name, grain, angle, fabric and laying.
//!
//! As a page (SVG, PDF), or piece by piece for pattern programs (DXF-AAMA, also ASTM D6673). A format is one file here and one
//! line in `FORMATS`.

mod dxf;
mod page;
mod pdf;
mod svg;
#[cfg(test)]
mod tests;

use std::path::Path;
use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::mesh::Garment;
use amc_core::{Error, Progress, Result, export, file};

use crate::assignments::{Assignment, Orientation};
use crate::sheet::{Piece, Sheet};
use crate::texts;

/// What is said of a panel on the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Said {
    /// Its direction.
    pub direction: Direction,
    /// Its fabric's name; none: no fabric.
    pub fabric: Option<String>,
    /// In which turns it may be laid, and the like.
    pub assignment: Assignment,
}

impl Said {
    /// The same for [`export::tangents`].
    pub fn exported(&self) -> export::Said {
        export::Said {
            fabric: self.fabric.clone(),
            orientation: self.assignment.orientation,
            is_locked: self.assignment.is_locked,
            is_linked: self.assignment.is_linked,
        }
    }
}

/// A sheet that is about to be written.
struct Content<'a> {
    title: &'a str,
    sheet: &'a Sheet,
    said: &'a [Said],
}

/// Makes the bytes of a file.
type Writer = fn(&Content<'_>) -> Vec<u8>;

/// Suffix and writer of each format.
const FORMATS: [(&str, Writer); 3] = [("svg", svg::bytes), ("pdf", pdf::bytes), ("dxf", dxf::bytes)];

/// Whether a file's suffix is that of a tech sheet: `.svg`, `.pdf` or `.dxf`.
pub fn is_tech_sheet(path: &Path) -> bool {
    format(path).is_some()
}

/// Saves the flat pattern of a garment; the suffix of `path` says how. `said` is of each panel, in their order.
///
/// - `.svg`, `.pdf`: one page, in millimetres, at the largest usual scale that fits A3; y down.
/// - `.dxf`: a block for each piece, millimetres at full size, outline on layer 1, grain on layer 7.
///
/// # Errors
/// Another suffix, a garment without a flat pattern, a file that cannot be written, or cancelled.
pub fn save(
    title: &str,
    garment: Arc<Garment>,
    said: &[Said],
    path: &Path,
    progress: &Progress<'_>,
) -> Result<()> {
    let Some(write) = format(path) else {
        return Err(Error::unsupported("a flat pattern is saved as .svg, .pdf or .dxf").in_file(path));
    };
    if said.len() != garment.panels.len() {
        return Err(Error::invalid("what is said is not of this garment's panels").in_file(path));
    }
    let sheet = Sheet::new(garment, progress)?;
    if sheet.pieces.is_empty() {
        return Err(Error::invalid("the garment has no flat pattern (UVs) to save").in_file(path));
    }
    file::save_bytes(path, &write(&Content { title, sheet: &sheet, said }))
}

fn format(path: &Path) -> Option<Writer> {
    let suffix = path.extension()?.to_string_lossy().to_ascii_lowercase();
    FORMATS.iter().find(|(known, _)| *known == suffix).map(|(_, write)| *write)
}

impl Content<'_> {
    fn said(&self, piece: &Piece) -> &Said {
        &self.said[piece.panel]
    }

    /// Where the warp runs on the sheet, y up.
    fn along(&self, piece: &Piece) -> glam::Vec2 {
        self.said(piece).direction.on_cloth(piece.uv_to_sheet.matrix2)
    }

    /// The ends of the piece's arrow, metres on the sheet.
    fn arrow(&self, piece: &Piece) -> [glam::Vec2; 2] {
        let along = self.along(piece);
        let half = along * piece.half_arrow(along);
        [piece.middle - half, piece.middle + half]
    }

    /// Name, angle of the warp, fabric and laying of a piece.
    fn label(&self, piece: &Piece) -> [String; 4] {
        let said = self.said(piece);
        let degrees = self.along(piece).to_angle().to_degrees().rem_euclid(360.0);
        let fabric = said.fabric.as_deref().unwrap_or(texts::NO_FABRIC);
        let laying = orientation(said.assignment.orientation);
        [self.sheet.panel(piece).name.clone(), texts::degrees(degrees), fabric.to_owned(), laying.to_owned()]
    }
}

fn orientation(orientation: Orientation) -> &'static str {
    match orientation {
        Orientation::TwoWay => texts::TWO_WAY,
        Orientation::OneWay => texts::ONE_WAY,
        Orientation::Nap => texts::NAP,
    }
}

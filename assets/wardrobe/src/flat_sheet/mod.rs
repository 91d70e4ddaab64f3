//! The sheet of flat pieces: all pieces of a garment, to one scale, as a patternmaker draws them.

mod drawing;
mod label;
mod layout;
mod piece;

#[cfg(test)]
mod tests;

use amc_core::Result;
use glam::DVec2;

use crate::pattern::{Pattern, Unfolded};
use drawing::{Anchor, Drawing, Style};
use piece::Placed;

/// Millimetres of the sheet for a metre of cloth.
const SCALE: f64 = 1000.0;

/// All pieces of a pattern as an SVG picture, one unit to a millimetre.
///
/// The pieces lie right side up with v upwards: outlines solid, folds dashed, lines inside thin, notches as ticks across
/// the edge, the warp's direction as a double-headed arrow; along every edge the name of its seam, or of the edge itself
/// where it is not sewn. A bar shows the scale.
///
/// # Errors
/// What [`Pattern::unfold`] finds.
pub fn svg(pattern: &Pattern) -> Result<String> {
    let whole = pattern.unfold()?;
    let type_size = type_size(&whole);
    let pieces: Vec<Placed<'_>> =
        (0..whole.pieces.len()).map(|i| Placed::new(&whole, i, type_size)).collect();
    let extents: Vec<_> = pieces.iter().map(Placed::extent).collect();
    let sizes: Vec<DVec2> = extents.iter().map(layout::Extent::size).collect();
    let layout = layout::lay_out(&sizes, 2.5 * type_size);
    let head = 5.0 * type_size;
    let mut drawing = Drawing::new(layout.size + DVec2::new(0.0, 2.0 * head), type_size);
    for ((piece, extent), lower_left) in pieces.iter().zip(&extents).zip(&layout.places) {
        piece
            .draw(&mut drawing, DVec2::new(lower_left.x - extent.low.x, head + lower_left.y - extent.high.y));
    }
    title(&mut drawing, &whole);
    scale_bar(&mut drawing, layout.size.y + head);
    Ok(drawing.finish())
}

/// The height of small type, in units: the same share of any garment's sheet.
fn type_size(whole: &Unfolded) -> f64 {
    let sizes = whole.pieces.iter().map(|piece| layout::extent(&piece.polygon()).size());
    let area: f64 = sizes.map(|size| (size.x + 0.1) * (size.y + 0.1)).sum();
    area.sqrt() * SCALE / 75.0
}

fn title(drawing: &mut Drawing, whole: &Unfolded) {
    let size = drawing.type_size;
    drawing.text(DVec2::new(2.0 * size, 3.0 * size), 0.0, Anchor::Start, 2.0, &whole.name);
    let key = "right side up; arrow: warp; dashed: fold";
    drawing.text(DVec2::new(2.0 * size, 4.6 * size), 0.0, Anchor::Start, 1.0, key);
}

/// A bar of a round length, about a sixth of the sheet's width.
fn scale_bar(drawing: &mut Drawing, top: f64) {
    let wanted = drawing.size.x / 6.0 / SCALE;
    let lengths = [0.05, 0.1, 0.2, 0.5, 1.0];
    let length = lengths.into_iter().rev().find(|&length| length <= wanted).unwrap_or(lengths[0]);
    let size = drawing.type_size;
    let start = DVec2::new(2.0 * size, top + 2.0 * size);
    for part in 0..5 {
        let at = |i: i32| start + DVec2::X * (f64::from(i) / 5.0 * length * SCALE);
        let thick = if part % 2 == 0 { Style::Bar } else { Style::Line };
        drawing.line(&[at(part), at(part + 1)], thick);
    }
    for (share, label) in [(0.0, "0".to_owned()), (1.0, format!("{:.0} cm", length * 100.0))] {
        let at = start + DVec2::new(share * length * SCALE, 1.6 * size);
        drawing.text(at, 0.0, Anchor::Middle, 1.0, &label);
    }
}

//! One piece on the sheet.

use glam::DVec2;

use super::SCALE;
use super::drawing::{Anchor, Drawing, Style};
use super::label::{Label, direction, flipped, width};
use super::layout::{Extent, extent};
use crate::pattern::crossing::inside;
use crate::pattern::{LineKind, Unfolded, WholePiece};

/// Steps of the grid on which a piece's middle is looked for: odd, so that the box's middle is one.
const STEPS: usize = 41;
/// The height of a piece's name, in small type's.
const NAME: f64 = 1.4;

/// A piece with what is written on it. Its own origin is the sheet's.
pub(super) struct Placed<'a> {
    piece: &'a WholePiece,
    polygon: Vec<DVec2>,
    type_size: f64,
    /// The grain's arrow, from end to end, metres.
    arrow: [DVec2; 2],
    labels: Vec<Label>,
}

impl<'a> Placed<'a> {
    pub(super) fn new(whole: &'a Unfolded, index: usize, type_size: f64) -> Self {
        let piece = &whole.pieces[index];
        let polygon = piece.polygon();
        let mut placed = Self { piece, polygon, type_size, arrow: [DVec2::ZERO; 2], labels: Vec::new() };
        for line in 0..piece.lines.len() {
            placed.line_labels(whole, index, line);
        }
        placed.arrow_and_name();
        placed
    }

    /// The box round the piece and all its words, in the sheet's units.
    pub(super) fn extent(&self) -> Extent {
        let outline = self.polygon.iter().map(|&point| flipped(point) * SCALE);
        let all: Vec<DVec2> = outline.chain(self.labels.iter().flat_map(Label::corners)).collect();
        extent(&all)
    }

    /// Draws the piece with its own origin at `origin` on the sheet.
    pub(super) fn draw(&self, drawing: &mut Drawing, origin: DVec2) {
        let on_sheet = |points: &[DVec2]| -> Vec<DVec2> {
            points.iter().map(|&point| origin + flipped(point) * SCALE).collect()
        };
        drawing.line(&on_sheet(&self.polygon), Style::Outline);
        for (i, line) in self.piece.lines.iter().enumerate() {
            let folded = self.piece.folds.iter().any(|fold| fold.line == i);
            match line.kind {
                LineKind::Edge => {}
                LineKind::Inner => {
                    drawing.line(&on_sheet(&line.points), if folded { Style::Fold } else { Style::Line })
                }
                LineKind::Points => {
                    for centre in on_sheet(&line.points) {
                        drawing.circle(centre, self.type_size * 0.4);
                    }
                }
            }
        }
        for notch in &self.piece.notches {
            let edge = &self.piece.lines[notch.line];
            let at = edge.at(notch.along);
            let inward = direction(edge, notch.along).perp() * (self.type_size / SCALE);
            drawing.line(&on_sheet(&[at, at + inward]), Style::Grain);
        }
        drawing.line(&on_sheet(&self.arrow), Style::Grain);
        for head in self.arrow_heads() {
            drawing.line(&on_sheet(&head), Style::Head);
        }
        for label in &self.labels {
            label.draw(drawing, origin);
        }
    }

    fn arrow_heads(&self) -> [[DVec2; 3]; 2] {
        let [start, end] = self.arrow;
        let length = (0.9 * self.type_size / SCALE).min(0.3 * start.distance(end));
        let along = (end - start).normalize_or(DVec2::Y) * length;
        let head =
            |tip: DVec2, back: DVec2| [tip, tip + back + 0.35 * back.perp(), tip + back - 0.35 * back.perp()];
        [head(start, along), head(end, -along)]
    }

    /// The arrow through the piece's middle along the warp. The name stands to the left of a steep arrow, above a level one, or
    /// below the piece where it has no room inside.
    fn arrow_and_name(&mut self) {
        let grain = DVec2::from_angle(self.piece.grain);
        let unit = self.type_size / SCALE;
        let middle = self.middle();
        let reach = self.reach(middle, grain).min(self.reach(middle, -grain));
        let half = (0.7 * reach).min(12.0 * unit);
        self.arrow = [middle - grain * half, middle + grain * half];
        let wide = width(&self.piece.name, NAME) * unit;
        let steep = grain.y.abs() > 0.5;
        let aside = if steep { DVec2::new(-1.2 * unit, 0.0) } else { DVec2::new(0.0, 1.6 * unit) };
        let at = middle + aside;
        let room =
            |towards: DVec2, needed: f64| inside(&self.polygon, at) && self.reach(at, towards) > needed;
        let (half_line, rest) = (NAME * unit, 0.5 * unit);
        let high_enough = room(DVec2::Y, half_line) && room(DVec2::NEG_Y, half_line);
        let type_height = (self.type_size, NAME);
        let name = &self.piece.name;
        let label = if high_enough && steep && room(DVec2::NEG_X, wide + rest) {
            Label::new(flipped(at) * SCALE, DVec2::X, Anchor::End, type_height, name)
        } else if high_enough && !steep && room(DVec2::NEG_X, wide / 2.0) && room(DVec2::X, wide / 2.0) {
            Label::new(flipped(at) * SCALE, DVec2::X, Anchor::Middle, type_height, name)
        } else {
            let all = self.extent();
            let below = DVec2::new(
                flipped(extent(&self.polygon).middle()).x * SCALE,
                all.high.y + NAME * self.type_size,
            );
            Label::new(below, DVec2::X, Anchor::Middle, type_height, name)
        };
        self.labels.push(label);
    }

    /// How far one can go inside from a point, metres.
    fn reach(&self, from: DVec2, towards: DVec2) -> f64 {
        let step = 0.001;
        let steps = (1..5000).map(|i| f64::from(i) * step);
        steps.take_while(|&d| inside(&self.polygon, from + towards * d)).last().unwrap_or(step)
    }

    /// The point of a grid inside that is farthest from the outline; of several the one nearest to the box's middle.
    fn middle(&self) -> DVec2 {
        let extent = extent(&self.polygon);
        let mut best = (extent.middle(), 0.0);
        for i in 0..STEPS * STEPS {
            let share = (DVec2::new((i % STEPS) as f64, (i / STEPS) as f64) + 0.5) / STEPS as f64;
            let point = extent.low + share * extent.size();
            if !inside(&self.polygon, point) {
                continue;
            }
            let clear =
                self.piece.outline().iter().map(|edge| edge.nearest(point).1).fold(f64::INFINITY, f64::min);
            let worth = clear - 0.05 * point.distance(extent.middle());
            if worth > best.1 {
                best = (point, worth);
            }
        }
        best.0
    }

    /// The names of the seams along a line; the line's own where it is in none.
    fn line_labels(&mut self, whole: &Unfolded, piece: usize, line: usize) {
        let own = &self.piece.lines[line];
        let mut sewn = false;
        for seam in &whole.seams {
            let parts =
                || seam.sides.iter().flatten().filter(|part| part.piece == piece && part.line == line);
            let from = parts().map(|part| part.from).fold(f64::INFINITY, f64::min);
            let to = parts().map(|part| part.to).fold(f64::NEG_INFINITY, f64::max);
            if from <= to {
                sewn = true;
                self.label(line, from.midpoint(to), to - from, &seam.name);
            }
        }
        if !sewn {
            self.label(line, own.length() / 2.0, own.length(), &own.name);
        }
    }

    /// Writes beside the part of a line that is `length` metres long about `along`.
    fn label(&mut self, line: usize, along: f64, length: f64, text: &str) {
        let line = &self.piece.lines[line];
        let mut label = Label::beside(line, along, length, self.type_size, text);
        if line.kind == LineKind::Points {
            label.make_room(&self.labels);
        }
        self.labels.push(label);
    }
}

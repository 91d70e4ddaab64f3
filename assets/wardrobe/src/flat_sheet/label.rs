//! Words on a piece.

use glam::DVec2;

use super::SCALE;
use super::drawing::{Anchor, Drawing};
use super::layout::{Extent, extent};
use crate::pattern::{Line, LineKind};

/// The mean width of a letter to the height of the type.
const LETTER: f64 = 0.54;

/// Words at a place of the piece. Units are the sheet's, from the piece's own origin, the second coordinate downwards.
#[derive(Debug, Clone)]
pub(super) struct Label {
    at: DVec2,
    /// Unit direction of reading.
    reading: DVec2,
    anchor: Anchor,
    /// The height of the type.
    height: f64,
    /// How many times small type that is.
    times: f64,
    text: String,
}

/// About how wide a text is.
pub(super) fn width(text: &str, height: f64) -> f64 {
    LETTER * height * text.chars().count() as f64
}

impl Label {
    pub(super) fn new(
        at: DVec2,
        reading: DVec2,
        anchor: Anchor,
        (type_size, times): (f64, f64),
        text: &str,
    ) -> Self {
        Self { at, reading, anchor, height: type_size * times, times, text: text.to_owned() }
    }

    /// The name of a seam, or of a line, beside the line's part of `length` metres about `along`: outside the piece, across the
    /// edge where that is shorter than the name.
    pub(super) fn beside(line: &Line, along: f64, length: f64, type_size: f64, text: &str) -> Self {
        let type_height = (type_size, 1.0);
        if line.kind == LineKind::Points {
            let at = flipped(line.start()) * SCALE + DVec2::X * type_size;
            return Self::new(at, DVec2::X, Anchor::Start, type_height, text);
        }
        let tangent = direction(line, along);
        // Counter-clockwise outlines have their outside on the right.
        let outward = -tangent.perp();
        let wide = width(text, type_size) / SCALE;
        if wide > 1.4 * length && line.kind == LineKind::Edge {
            let forward = outward.x >= -1e-9;
            let (reading, anchor) = if forward { (outward, Anchor::Start) } else { (-outward, Anchor::End) };
            let at = line.at(along) + outward * (0.6 * type_size / SCALE);
            return Self::new(flipped(at) * SCALE, flipped(reading), anchor, type_height, text);
        }
        let bulge = bulge(line, along, wide / 2.0, outward);
        let at = line.at(along) + outward * (bulge + 0.8 * type_size / SCALE);
        let reading = if tangent.x >= -1e-9 { tangent } else { -tangent };
        Self::new(flipped(at) * SCALE, flipped(reading), Anchor::Middle, type_height, text)
    }

    /// Goes down until no other words are in its way.
    pub(super) fn make_room(&mut self, others: &[Self]) {
        let taken: Vec<Extent> = others.iter().map(|other| extent(&other.corners())).collect();
        let meets = |own: &Extent| {
            taken.iter().any(|other| other.low.cmplt(own.high).all() && own.low.cmplt(other.high).all())
        };
        while meets(&extent(&self.corners())) {
            self.at.y += self.height;
        }
    }

    pub(super) fn draw(&self, drawing: &mut Drawing, origin: DVec2) {
        let degrees = self.reading.to_angle().to_degrees();
        drawing.text(origin + self.at, degrees, self.anchor, self.times, &self.text);
    }

    /// Corners of the box that the words fill.
    pub(super) fn corners(&self) -> [DVec2; 4] {
        let wide = width(&self.text, self.height);
        let (before, after) = match self.anchor {
            Anchor::Start => (0.0, wide),
            Anchor::Middle => (wide / 2.0, wide / 2.0),
            Anchor::End => (wide, 0.0),
        };
        let (start, end) = (self.at - self.reading * before, self.at + self.reading * after);
        let half = self.reading.perp() * (0.6 * self.height);
        [start - half, start + half, end - half, end + half]
    }
}

/// A direction or place of the piece as the sheet has it: the second coordinate downwards.
pub(super) fn flipped(point: DVec2) -> DVec2 {
    DVec2::new(point.x, -point.y)
}

/// How far the line within `reach` of `along` stands out beyond its point there.
fn bulge(line: &Line, along: f64, reach: f64, outward: DVec2) -> f64 {
    let at = line.at(along);
    let near = (-10..=10).map(|i| line.at(along + f64::from(i) / 10.0 * reach));
    near.map(|point| (point - at).dot(outward)).fold(0.0, f64::max)
}

/// The unit direction of a line, a little smoothed.
pub(super) fn direction(line: &Line, along: f64) -> DVec2 {
    let reach = (0.02 * line.length()).max(1e-4);
    (line.at(along + reach) - line.at(along - reach)).normalize_or(DVec2::X)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_make_room_for_each_other() {
        let at = |place: DVec2| Label::new(place, DVec2::X, Anchor::Start, (20.0, 1.0), "cuff button");
        let others = [at(DVec2::ZERO), at(DVec2::new(30.0, 25.0))];
        let mut label = at(DVec2::new(10.0, 4.0));
        label.make_room(&others);
        assert_eq!(label.at.x, 10.0);
        let highest = label.corners().into_iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        assert!((37.0..60.0).contains(&highest), "{highest}");
        let alone = label.at;
        label.make_room(&others);
        assert_eq!(label.at, alone);
    }
}

//! Lines of a piece, flattened.

use glam::DVec2;

/// The least turn at a joint of two segments that is a corner: its cosine (5 degrees).
const CORNER_COSINE: f64 = 0.996;

/// What a line of a piece is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineKind {
    /// A part of its outline.
    Edge,
    /// A line inside.
    Inner,
    /// Points inside, with nothing between them.
    Points,
}

/// A named line of a piece, flattened to a chain of straight lines within 0.02 mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: LineKind,
    /// Its points, metres; two at least, but for single [`LineKind::Points`].
    pub points: Vec<DVec2>,
    /// Where it has corners, metres along it, both ends left out.
    pub corners: Vec<f64>,
    /// The distance along it of each point.
    along: Vec<f64>,
}

impl Line {
    /// A line through `points`; `joints` are the indices of those where two segments meet, perhaps at a corner.
    pub(crate) fn new(name: &str, kind: LineKind, points: Vec<DVec2>, joints: &[usize]) -> Self {
        let mut along = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for (i, point) in points.iter().enumerate() {
            length += if i == 0 { 0.0 } else { point.distance(points[i - 1]) };
            along.push(length);
        }
        let is_corner = |i: &usize| {
            let (Some(before), Some(here), Some(after)) =
                (points.get(i.wrapping_sub(1)), points.get(*i), points.get(i + 1))
            else {
                return false;
            };
            let turn = (*here - *before).normalize_or_zero().dot((*after - *here).normalize_or_zero());
            turn < CORNER_COSINE
        };
        let corners = joints.iter().filter(|i| is_corner(i)).map(|&i| along[i]).collect();
        Self { name: name.to_owned(), kind, points, corners, along }
    }

    /// Its length, metres.
    pub fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or_default()
    }

    /// Where it starts.
    pub fn start(&self) -> DVec2 {
        self.points.first().copied().unwrap_or_default()
    }

    /// Where it ends.
    pub fn end(&self) -> DVec2 {
        self.points.last().copied().unwrap_or_default()
    }

    /// The distance along it of each of its points, metres.
    pub fn along(&self) -> &[f64] {
        &self.along
    }

    /// The point at a distance along it, metres; its ends beyond them.
    pub fn at(&self, along: f64) -> DVec2 {
        let next = self.along.partition_point(|&a| a <= along);
        if next == 0 || next >= self.points.len() {
            return if next == 0 { self.start() } else { self.end() };
        }
        let (from, to) = (self.along[next - 1], self.along[next]);
        self.points[next - 1].lerp(self.points[next], (along - from) / (to - from))
    }

    /// The part between two distances along it, metres.
    pub fn part(&self, from: f64, to: f64) -> Vec<DVec2> {
        let inner = self.along.iter().zip(&self.points).filter(|(a, _)| **a > from && **a < to);
        std::iter::once(self.at(from)).chain(inner.map(|(_, p)| *p)).chain([self.at(to)]).collect()
    }

    /// The place on it that is nearest to a point: how far along, and how far away, metres.
    pub fn nearest(&self, point: DVec2) -> (f64, f64) {
        let mut best = (0.0, self.start().distance(point));
        for (i, ends) in self.points.windows(2).enumerate() {
            let direction = ends[1] - ends[0];
            let share = (point - ends[0]).dot(direction) / direction.length_squared();
            let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
            let distance = ends[0].lerp(ends[1], share).distance(point);
            if distance < best.1 {
                best = (self.along[i] + share * (self.along[i + 1] - self.along[i]), distance);
            }
        }
        best
    }
}

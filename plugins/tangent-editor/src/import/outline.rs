//! Outlines, made comparable.

use amc_core::mesh::Garment;
use glam::Vec2;

/// Points that a line is compared by.
pub(super) const POINTS: usize = 128;
/// Most points of a line that are looked at: of longer ones every so many.
const MOST_POINTS: usize = 1024;

/// A closed line about its centre, counter-clockwise, scaled to an area of one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub(super) line: Vec<Vec2>,
    /// [`POINTS`] of it, evenly spaced.
    pub(super) points: Vec<Vec2>,
    pub(super) perimeter: f32,
    /// Before it was scaled, in the units of the file.
    pub(super) area: f32,
}

impl Shape {
    /// None where a line bounds nothing.
    pub(super) fn new(line: &[Vec2]) -> Option<Self> {
        let step = line.len().div_ceil(MOST_POINTS).max(1);
        let mut line: Vec<Vec2> = line.iter().step_by(step).copied().collect();
        line.dedup();
        let low = line.iter().copied().reduce(Vec2::min)?;
        // Near the origin first, so that the area is exact far from it.
        line.iter_mut().for_each(|at| *at -= low);
        let area = area(&line);
        if area < 0.0 {
            line.reverse();
        }
        let scale = area.abs().sqrt().recip();
        let points = evenly_spaced(&line)?;
        let centre = points.iter().sum::<Vec2>() / POINTS as f32;
        let place = |at: &Vec2| (*at - centre) * scale;
        let line: Vec<Vec2> = line.iter().map(place).collect();
        let shape = Self {
            points: points.iter().map(place).collect(),
            perimeter: length(&line),
            line,
            area: area.abs(),
        };
        let is_sound =
            scale.is_finite() && shape.perimeter.is_finite() && shape.points.iter().all(|at| at.is_finite());
        is_sound.then_some(shape)
    }

    /// As seen from the back.
    pub(super) fn mirrored(&self) -> Self {
        let mirror = |line: &[Vec2]| line.iter().rev().map(|at| Vec2::new(-at.x, at.y)).collect();
        Self { line: mirror(&self.line), points: mirror(&self.points), ..*self }
    }
}

/// The outline of each panel in metres, as its UVs draw it; none where it has none.
pub(super) fn of_panels(garment: &Garment) -> Vec<Option<Vec<Vec2>>> {
    let of = |panel| {
        let to_cloth = garment.uv_to_drawn_metres(panel).filter(|_| garment.has_uvs)?;
        let line = garment.outlines(panel).into_iter().next()?;
        Some(line.into_iter().map(|vertex| to_cloth.transform_point2(garment.uvs[vertex as usize])).collect())
    };
    garment.panels.iter().map(of).collect()
}

fn sides(line: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    (0..line.len()).map(|k| (line[k], line[(k + 1) % line.len()]))
}

/// Positive where a closed line runs counter-clockwise.
fn area(line: &[Vec2]) -> f32 {
    sides(line).map(|(a, b)| a.perp_dot(b)).sum::<f32>() / 2.0
}

fn length(line: &[Vec2]) -> f32 {
    sides(line).map(|(a, b)| a.distance(b)).sum()
}

fn evenly_spaced(line: &[Vec2]) -> Option<Vec<Vec2>> {
    let step = length(line) / POINTS as f32;
    if !step.is_finite() || step <= 0.0 {
        return None;
    }
    let (mut points, mut gone) = (Vec::with_capacity(POINTS), 0.0);
    for (a, b) in sides(line) {
        let side = a.distance(b);
        while points.len() < POINTS && points.len() as f32 * step <= gone + side {
            let share = (points.len() as f32 * step - gone) / side;
            points.push(if share.is_finite() { a.lerp(b, share) } else { a });
        }
        gone += side;
    }
    points.resize(POINTS, *line.first()?);
    Some(points)
}

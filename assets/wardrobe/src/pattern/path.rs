//! Paths of segments, flattened.

use amc_core::{Error, Result};
use glam::DVec2;

use super::Segment;

/// How far a flattened curve may lie from the true one, metres.
const TOLERANCE: f64 = 2e-5;
/// The most chords that one curve is flattened to.
const MOST_CHORDS: f64 = 1000.0;
/// The largest coordinate, metres.
const LARGEST: f64 = 10.0;
/// The most points of one flattened path.
const MOST_POINTS: usize = 20_000;

/// A path, flattened.
#[derive(Debug, Clone)]
pub(super) struct Path {
    pub(super) points: Vec<DVec2>,
    /// The points where two segments meet.
    pub(super) joints: Vec<usize>,
}

/// Flattens the path of `segments` from `start` on.
pub(super) fn flatten(start: DVec2, segments: &[Segment]) -> Result<Path> {
    let mut path = Path { points: vec![checked(start.to_array())?], joints: Vec::new() };
    for segment in segments {
        path.joints.push(path.points.len() - 1);
        match segment {
            Segment::Straight(to) => path.points.push(checked(*to)?),
            Segment::Curve { curve: [a, b, end] } => path.curve([checked(*a)?, checked(*b)?, checked(*end)?]),
            Segment::Arc { arc: [through, end] } => path.arc(checked(*through)?, checked(*end)?)?,
        }
        if path.points.len() > MOST_POINTS {
            return Err(Error::too_large(format!("more than {MOST_POINTS} points on one line")));
        }
    }
    path.joints.retain(|&i| i > 0);
    Ok(path)
}

/// The point, refused where it cannot be one of a garment's: see [`LARGEST`].
pub(super) fn checked(point: [f64; 2]) -> Result<DVec2> {
    if point.iter().all(|x| x.abs() <= LARGEST) {
        return Ok(DVec2::from(point));
    }
    Err(Error::invalid(format!(
        "the point {point:?} lies more than {LARGEST} m from the origin: coordinates are metres"
    )))
}

impl Path {
    fn last(&self) -> DVec2 {
        self.points.last().copied().unwrap_or_default()
    }

    /// A chord of a piece of length 1/n strays at most `|P''| / (8 n^2)` from the curve, and `|P''|` is greatest at an end.
    fn curve(&mut self, [a, b, end]: [DVec2; 3]) {
        let start = self.last();
        let bend = 6.0 * (start - 2.0 * a + b).length().max((a - 2.0 * b + end).length());
        let chords = (bend / (8.0 * TOLERANCE)).sqrt().ceil().clamp(1.0, MOST_CHORDS);
        for i in 1..chords as usize {
            let t = i as f64 / chords;
            let s = 1.0 - t;
            self.points.push(s * s * s * start + 3.0 * s * t * (s * a + t * b) + t * t * t * end);
        }
        self.points.push(end);
    }

    fn arc(&mut self, through: DVec2, end: DVec2) -> Result<()> {
        let start = self.last();
        let (a, b) = (through - start, end - start);
        let twice_area = a.perp_dot(b);
        if twice_area.abs() < 1e-4 * a.length() * b.length() || a.length() * b.length() == 0.0 {
            return Err(Error::invalid(format!(
                "no arc passes {:?}, {:?} and {:?}: they lie on a straight line",
                start.to_array(),
                through.to_array(),
                end.to_array()
            )));
        }
        let to_centre = DVec2::new(
            b.y * a.length_squared() - a.y * b.length_squared(),
            a.x * b.length_squared() - b.x * a.length_squared(),
        ) / (2.0 * twice_area);
        let centre = start + to_centre;
        let radius = to_centre.length();
        let turn = turn(start - centre, through - centre, end - centre);
        let chords = (turn.abs() / (8.0 * TOLERANCE / radius).sqrt()).ceil().clamp(1.0, MOST_CHORDS);
        for i in 1..chords as usize {
            let rotation = DVec2::from_angle(turn * i as f64 / chords);
            self.points.push(centre + rotation.rotate(start - centre));
        }
        self.points.push(end);
        Ok(())
    }
}

/// The angle from `start` to `end`, in the sense in which `through` is passed.
fn turn(start: DVec2, through: DVec2, end: DVec2) -> f64 {
    let full = std::f64::consts::TAU;
    let (first, whole) = (start.angle_to(through).rem_euclid(full), start.angle_to(end).rem_euclid(full));
    if first <= whole { whole } else { whole - full }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(path: &Path) -> f64 {
        path.points.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    }

    #[test]
    fn an_arc_has_the_length_of_its_circle() {
        for (through, end, angle) in [([0.0, 0.2], [-0.2, 0.0], 1.0), ([0.0, -0.2], [0.0, 0.2], 1.5)] {
            let path = flatten(DVec2::new(0.2, 0.0), &[Segment::Arc { arc: [through, end] }]).unwrap();
            assert!((length(&path) - 0.2 * angle * std::f64::consts::PI).abs() < 1e-4, "{}", length(&path));
            assert!(path.points.iter().all(|p| (p.length() - 0.2).abs() < 1e-12));
        }
    }

    #[test]
    fn a_flattened_curve_stays_within_the_tolerance() {
        let [a, b, end] = [[0.3, 0.0], [0.3, 0.4], [0.0, 0.4]];
        let path = flatten(DVec2::ZERO, &[Segment::Curve { curve: [a, b, end] }]).unwrap();
        // By symmetry the curve's middle is its farthest point from the chord: u = 3/4 * 0.3.
        let farthest = path.points.iter().map(|p| p.x).fold(0.0, f64::max);
        assert!((farthest - 0.225).abs() < TOLERANCE);
        assert!(path.points.len() < 150);
    }

    #[test]
    fn coordinates_that_are_no_metres_are_refused() {
        for bad in [f64::NAN, f64::INFINITY, 120.0] {
            assert!(flatten(DVec2::ZERO, &[Segment::Straight([bad, 0.0])]).is_err());
        }
    }
}

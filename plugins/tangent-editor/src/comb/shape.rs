//! How strokes change when they are dragged.

use amc_core::direction::comb::Comb;
use glam::{Mat3, Quat, Vec3};

use crate::sheet::line::simplified_open;

/// Where a stroke is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Grip {
    /// By its first point: the last stays.
    Start,
    /// By its last point: the first stays.
    End,
    /// Anywhere else: it is moved as it is.
    Middle,
}

/// A line whose held place is moved by `by`: whole, or turned and stretched about its other end.
pub(super) fn moved(points: &[Vec3], grip: Grip, by: Vec3) -> Vec<Vec3> {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return Vec::new() };
    let (fixed, held) = match grip {
        Grip::Middle => return points.iter().map(|&point| point + by).collect(),
        Grip::Start => (last, first),
        Grip::End => (first, last),
    };
    let (from, to) = (held - fixed, held + by - fixed);
    let (Some(from_unit), Some(to_unit)) = (from.try_normalize(), to.try_normalize()) else {
        return points.to_vec();
    };
    let turn = Mat3::from_quat(Quat::from_rotation_arc(from_unit, to_unit)) * (to.length() / from.length());
    points.iter().map(|&point| fixed + turn * (point - fixed)).collect()
}

/// The line that a hand made, with no more points than it needs to be within `tolerance`, and never more than a stroke may have.
pub(super) fn drawn(points: &[Vec3], tolerance: f32) -> Vec<Vec3> {
    let mut line = simplified_open(points, tolerance);
    line.truncate(Comb::MOST_POINTS);
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_follows_the_hand_and_the_other_stays() {
        let line = [Vec3::ZERO, Vec3::new(1.0, 0.5, 0.0), Vec3::new(2.0, 0.0, 0.0)];
        let by = Vec3::new(-2.0, 4.0, 0.0);
        let bent = moved(&line, Grip::End, by);
        assert!(bent[0].distance(line[0]) < 1e-6 && bent[2].distance(line[2] + by) < 1e-5);
        // A quarter turn, twice as long.
        assert!(bent[1].distance(Vec3::new(-1.0, 2.0, 0.0)) < 1e-5, "{}", bent[1]);
        let other = moved(&line, Grip::Start, Vec3::X);
        assert!(other[2].distance(line[2]) < 1e-6 && other[0].distance(Vec3::X) < 1e-6);
        assert_eq!(moved(&line, Grip::Middle, by)[1], line[1] + by);
        // An end put onto the other would have no direction left.
        assert_eq!(moved(&line, Grip::End, line[0] - line[2]), line);
        assert!(moved(&[], Grip::End, by).is_empty());
    }

    #[test]
    fn a_straight_line_needs_two_points_and_a_corner_stays() {
        let straight: Vec<Vec3> = (0..50).map(|k| Vec3::X * k as f32).collect();
        assert_eq!(drawn(&straight, 1e-3), [straight[0], straight[49]]);
        let corner = [Vec3::ZERO, Vec3::new(1.0, 0.01, 0.0), Vec3::new(1.0, 1.0, 0.0)];
        assert_eq!(drawn(&corner, 1e-3), corner);
        assert!(drawn(&[], 1.0).is_empty());
        let wild: Vec<Vec3> = (0..9000).map(|k| Vec3::new(k as f32, (k % 2) as f32, 0.0)).collect();
        assert_eq!(drawn(&wild, 0.1).len(), Comb::MOST_POINTS);
    }
}

//! Outlines as they are drawn and picked.

use glam::{Vec2, Vec3};

/// A turn of the outline by this much is a corner, radians.
const CORNER: f32 = 0.6;

/// A stretch of an outline between two corners.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Edge {
    pub(crate) line: Vec<Vec2>,
}

impl Edge {
    /// From its first point to its last; none where they are one.
    pub(crate) fn along(&self) -> Option<Vec2> {
        (*self.line.last()? - *self.line.first()?).try_normalize()
    }

    /// How far a point is from it.
    pub(crate) fn distance(&self, at: Vec2) -> f32 {
        distance(&self.line, at)
    }
}

/// How far a point is from an open line.
pub(crate) fn distance(line: &[Vec2], at: Vec2) -> f32 {
    line.windows(2).map(|ends| to_segment(ends[0], ends[1], at)).fold(f32::INFINITY, f32::min)
}

fn to_segment<V: Place>(a: V, b: V, at: V) -> f32 {
    let [a, b, at] = [a, b, at].map(Place::in_space);
    let along = b - a;
    let share = ((at - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    at.distance(if share.is_finite() { a + along * share } else { a })
}

/// A point of a line, flat or in space.
pub(crate) trait Place: Copy {
    /// What is flat lies in the plane z = 0.
    fn in_space(self) -> Vec3;
}

impl Place for Vec2 {
    fn in_space(self) -> Vec3 {
        self.extend(0.0)
    }
}

impl Place for Vec3 {
    fn in_space(self) -> Vec3 {
        self
    }
}

/// A closed line with fewer points, none of those left out farther from it than `tolerance`.
pub(crate) fn simplified(line: &[Vec2], tolerance: f32) -> Vec<Vec2> {
    let Some(&first) = line.first() else { return Vec::new() };
    let far = |k: &usize| line[*k].distance_squared(first);
    let Some(opposite) = (1..line.len()).max_by(|a, b| far(a).total_cmp(&far(b))) else {
        return line.to_vec();
    };
    // A closed line is two open ones.
    let (there, mut back) = (&line[..=opposite], line[opposite..].to_vec());
    back.push(first);
    let mut kept = simplified_open(there, tolerance);
    kept.pop();
    kept.extend(simplified_open(&back, tolerance));
    kept.pop();
    kept
}

/// An open line with fewer points, none of those left out farther from it than `tolerance` (Ramer 1972; Douglas and Peucker 1973).
pub(crate) fn simplified_open<V: Place>(line: &[V], tolerance: f32) -> Vec<V> {
    let mut kept = vec![false; line.len()];
    let Some(last) = line.len().checked_sub(1) else { return Vec::new() };
    (kept[0], kept[last]) = (true, true);
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let off = |k: &usize| to_segment(line[from], line[to], line[*k]);
        let farthest = (from + 1..to).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(k) = farthest.filter(|k| off(k) > tolerance) {
            kept[k] = true;
            open.extend([(from, k), (k, to)]);
        }
    }
    line.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// A closed line cut at its corners; whole where it has none.
pub(crate) fn edges(line: &[Vec2]) -> Vec<Edge> {
    let count = line.len();
    let point = |k: usize| line[k % count];
    let is_corner = |k: &usize| {
        let (before, after) = (point(*k) - point(k + count - 1), point(k + 1) - point(*k));
        before.angle_to(after).abs() > CORNER
    };
    let corners: Vec<usize> = (0..count).filter(is_corner).collect();
    let Some(&first) = corners.first() else {
        return vec![Edge { line: line.iter().chain(line.first()).copied().collect() }];
    };
    let ends = corners.iter().skip(1).copied().chain([first + count]);
    corners.iter().zip(ends).map(|(&from, to)| Edge { line: (from..=to).map(point).collect() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of side 4 with points at every quarter.
    fn square() -> Vec<Vec2> {
        let along = |from: (f32, f32), to: (f32, f32)| {
            (0..16).map(move |k| Vec2::new(from.0, from.1).lerp(Vec2::new(to.0, to.1), k as f32 / 16.0))
        };
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        (0..4).flat_map(|k| along(corners[k], corners[(k + 1) % 4])).collect()
    }

    #[test]
    fn straight_lines_keep_their_ends_and_corners_make_edges() {
        let simple = simplified(&square(), 1e-3);
        assert_eq!(simple, [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| Vec2::new(x, y)));
        let found = edges(&simple);
        assert_eq!(found.len(), 4);
        assert!(found.iter().any(|edge| edge.along() == Some(Vec2::Y)));
        assert_eq!(found.iter().map(|edge| edge.distance(Vec2::new(2.0, 0.5))).fold(9.0, f32::min), 0.5);
        assert_eq!(edges(&square()).len(), 4);
    }

    #[test]
    fn a_round_line_is_one_edge_and_stays_round() {
        let circle: Vec<Vec2> =
            (0..400).map(|k| Vec2::from_angle(k as f32 / 400.0 * std::f32::consts::TAU)).collect();
        let simple = simplified(&circle, 1e-3);
        assert!(simple.len() < 150 && simple.len() > 20, "{}", simple.len());
        for at in &circle {
            assert!(distance(&[simple.as_slice(), &simple[..1]].concat(), *at) <= 1e-3);
        }
        assert_eq!(edges(&circle).len(), 1);
        assert!(simplified(&[], 1.0).is_empty() && simplified(&[Vec2::ONE; 3], 1.0).len() <= 2);
    }
}

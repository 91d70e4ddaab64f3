//! The point of some triangles that is nearest to a given one.

use glam::Vec3;
use rayon::prelude::*;

/// Triangles in a leaf.
const LEAF: usize = 8;

/// Triangles in the order of a curve that fills space (Morton's), boxes around each eight of them, boxes around each two
/// boxes, and so on up.
#[derive(Debug)]
pub(super) struct Nearest {
    numbers: Vec<u32>,
    corners: Vec<[Vec3; 3]>,
    /// From the leaves up; the last has one box. Empty without triangles.
    levels: Vec<Vec<Bounds>>,
}

/// A point of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) triangle: u32,
    /// Barycentric coordinates.
    pub(super) shares: [f32; 3],
    /// How far off the point asked for is.
    pub(super) distance: f32,
}

/// A box.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    const NONE: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    pub(super) fn of(points: &[Vec3]) -> Self {
        let add = |bounds: Self, &point| Self { low: bounds.low.min(point), high: bounds.high.max(point) };
        points.iter().fold(Self::NONE, add)
    }

    fn around(boxes: &[Self]) -> Self {
        let add = |all: Self, one: &Self| Self { low: all.low.min(one.low), high: all.high.max(one.high) };
        boxes.iter().fold(Self::NONE, add)
    }

    /// A point of the box, brought to coordinates from 0 to 2^21 - 1.
    pub(super) fn scaled(&self, point: Vec3) -> Vec3 {
        (point - self.low) / (self.high - self.low).max(Vec3::splat(1e-30)) * 2_097_151.0
    }

    fn distance_squared(&self, point: Vec3) -> f32 {
        (point - point.clamp(self.low, self.high)).length_squared()
    }
}

impl Nearest {
    /// Of the triangles that `counts` says yes to, and that have an area.
    pub(super) fn new(positions: &[Vec3], triangles: &[[u32; 3]], counts: impl Fn([u32; 3]) -> bool) -> Self {
        let bounds = Bounds::of(positions);
        let corners = |triangle: [u32; 3]| triangle.map(|vertex| positions[vertex as usize]);
        let mut order: Vec<(u64, u32)> = Vec::with_capacity(triangles.len());
        for (&triangle, number) in triangles.iter().zip(0..) {
            let [a, b, c] = corners(triangle);
            if counts(triangle) && (b - a).cross(c - a) != Vec3::ZERO {
                let middle = a / 3.0 + b / 3.0 + c / 3.0;
                order.push((morton(bounds.scaled(middle)), number));
            }
        }
        order.par_sort_unstable();
        let numbers: Vec<u32> = order.into_iter().map(|(_, number)| number).collect();
        let corners: Vec<[Vec3; 3]> =
            numbers.iter().map(|&number| corners(triangles[number as usize])).collect();
        let mut levels = Vec::new();
        if !corners.is_empty() {
            levels.push(corners.chunks(LEAF).map(|leaf| Bounds::of(leaf.as_flattened())).collect::<Vec<_>>());
            while let Some(below) = levels.last().filter(|level| level.len() > 1) {
                let above = below.chunks(2).map(Bounds::around).collect();
                levels.push(above);
            }
        }
        Self { numbers, corners, levels }
    }

    /// None without triangles, or for a point that is not finite.
    pub(super) fn nearest(&self, point: Vec3) -> Option<Found> {
        let mut best: Option<Found> = None;
        let mut best_squared = f32::INFINITY;
        let mut open = vec![(0.0, self.levels.len().checked_sub(1)?, 0)];
        while let Some((squared, level, index)) = open.pop() {
            if squared >= best_squared {
                continue;
            }
            if level > 0 {
                let below = &self.levels[level - 1];
                let [first, second] = [2 * index, 2 * index + 1];
                let squared =
                    |child: usize| below.get(child).map_or(f32::INFINITY, |b| b.distance_squared(point));
                let (to_first, to_second) = (squared(first), squared(second));
                // The nearer one is looked at first: put last.
                let (near, far) = ((to_first, level - 1, first), (to_second, level - 1, second));
                open.extend(if to_first <= to_second { [far, near] } else { [near, far] });
                continue;
            }
            for place in index * LEAF..((index + 1) * LEAF).min(self.corners.len()) {
                let corners = self.corners[place];
                let shares = nearest_shares(point, corners);
                let at: Vec3 = corners.iter().zip(shares).map(|(&corner, share)| corner * share).sum();
                let squared = (point - at).length_squared();
                if squared < best_squared {
                    best_squared = squared;
                    best = Some(Found { triangle: self.numbers[place], shares, distance: squared.sqrt() });
                }
            }
        }
        best
    }
}

/// The place on the curve of a point with coordinates from 0 to 2^21 - 1.
pub(super) fn morton(point: Vec3) -> u64 {
    let spread = |x: f32| {
        let mut bits = (x as u64) & 0x1f_ffff;
        for (shift, mask) in [
            (32, 0x001f_0000_0000_ffff),
            (16, 0x001f_0000_ff00_00ff),
            (8, 0x100f_00f0_0f00_f00f),
            (4, 0x10c3_0c30_c30c_30c3),
            (2, 0x1249_2492_4924_9249),
        ] {
            bits = (bits | bits << shift) & mask;
        }
        bits
    };
    spread(point.x) | spread(point.y) << 1 | spread(point.z) << 2
}

/// The barycentric coordinates of a triangle's point nearest to `p` (C. Ericson, "Real-Time Collision Detection", 5.1.5).
fn nearest_shares(p: Vec3, [a, b, c]: [Vec3; 3]) -> [f32; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let beyond_ab = d1 * d4 - d3 * d2;
    if beyond_ab <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let share = part(d1, d1 - d3);
        return [1.0 - share, share, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let beyond_ac = d5 * d2 - d1 * d6;
    if beyond_ac <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let share = part(d2, d2 - d6);
        return [1.0 - share, 0.0, share];
    }
    let beyond_bc = d3 * d6 - d5 * d4;
    if beyond_bc <= 0.0 && d4 >= d3 && d5 >= d6 {
        let share = part(d4 - d3, (d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - share, share];
    }
    let whole = beyond_bc + beyond_ac + beyond_ab;
    let (of_b, of_c) = (part(beyond_ac, whole), part(beyond_ab, whole));
    [1.0 - of_b - of_c, of_b, of_c]
}

/// A quotient from 0 to 1; 0 where there is none.
fn part(of: f32, whole: f32) -> f32 {
    let part = of / whole;
    if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pseudo_random::PseudoRandom;

    #[test]
    fn nothing_is_nearer_than_what_is_found() {
        let mut numbers = PseudoRandom::new(3);
        let mut point = |scale: f32| Vec3::new(numbers.unit(), numbers.unit(), numbers.unit()) * scale;
        let positions: Vec<Vec3> = (0..300).map(|_| point(1.0)).collect();
        let triangles: Vec<[u32; 3]> = (0..100).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let tree = Nearest::new(&positions, &triangles, |triangle| triangle[0] != 30);
        for _ in 0..200 {
            let asked = point(2.0) - 0.5;
            let found = tree.nearest(asked).unwrap();
            assert!(found.triangle != 10);
            // A fine net of points on every triangle has none that is nearer, and one about as near.
            let mut least = f32::INFINITY;
            for triangle in triangles.iter().filter(|triangle| triangle[0] != 30) {
                let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
                for i in 0..=20 {
                    for j in 0..=20 - i {
                        let at = a + (b - a) * (i as f32 / 20.0) + (c - a) * (j as f32 / 20.0);
                        least = least.min((at - asked).length());
                    }
                }
            }
            assert!(found.distance <= least + 1e-6 && found.distance > least - 0.05);
            let [a, b, c] = triangles[found.triangle as usize].map(|vertex| positions[vertex as usize]);
            let at = a * found.shares[0] + b * found.shares[1] + c * found.shares[2];
            assert!(((at - asked).length() - found.distance).abs() < 1e-5);
        }
        assert!(Nearest::new(&positions, &triangles, |_| false).nearest(Vec3::ZERO).is_none());
        assert!(tree.nearest(Vec3::NAN).is_none());
    }
}

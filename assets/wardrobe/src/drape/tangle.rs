//! Cloth that has gone through itself, and how it comes apart.

use glam::DVec3;

use super::points::Points;

/// How fast an edge and the triangle that it pierces are drawn apart, metres per second.
const PULL: f64 = 0.1;

/// An edge that pierces a triangle. Both are moved so that the line in which the layers cut each other gets shorter (Volino and
/// Magnenat-Thalmann 2006, "Resolving surface collisions through intersection contour minimization", section 3).
#[derive(Debug, Clone, Copy)]
pub(super) struct Tangle {
    edge: [u32; 2],
    corners: [u32; 3],
    /// Where the edge is to go, the triangle going the other way: a unit direction.
    direction: DVec3,
}

impl Tangle {
    /// What each edge of a triangle that goes through another makes with it. An edge shared by two triangles counts with each.
    pub(super) fn between(one: &[u32; 3], other: &[u32; 3], places: &[DVec3]) -> impl Iterator<Item = Self> {
        let own = one.map(|corner| places[corner as usize]);
        let [a, b, c] = other.map(|corner| places[corner as usize]);
        let normal = (b - a).cross(c - a);
        let heights = own.map(|place| (place - a).dot(normal));
        (0..3).filter_map(move |i| {
            let j = (i + 1) % 3;
            if heights[i] * heights[j] >= 0.0 {
                return None;
            }
            let spot = own[i].lerp(own[j], heights[i] / (heights[i] - heights[j]));
            let left_of = |start: DVec3, end: DVec3| (end - start).cross(spot - start).dot(normal) >= 0.0;
            if !(left_of(a, b) && left_of(b, c) && left_of(c, a)) {
                return None;
            }
            let direction = shortening(own[i], own[j], own[(i + 2) % 3], normal.try_normalize()?)?;
            Some(Self { edge: [one[i], one[j]], corners: *other, direction })
        })
    }

    pub(super) fn pull(&self, points: &Points, inverse_mass: &[f64], step: f64) {
        let by = self.direction * (0.5 * PULL * step);
        let movable = |particle: &&u32| inverse_mass[**particle as usize] > 0.0;
        self.edge.iter().filter(movable).for_each(|particle| points.shift(*particle, by));
        self.corners.iter().filter(movable).for_each(|particle| points.shift(*particle, -by));
    }
}

/// Where an edge must go for the line in which its own triangle, with the corner `third`, cuts the plane of `normal` to get shorter fastest.
fn shortening(from: DVec3, to: DVec3, third: DVec3, normal: DVec3) -> Option<DVec3> {
    let edge = (to - from).try_normalize()?;
    let line = normal.cross(edge.cross(third - from)).try_normalize()?;
    let inwards =
        if line.dot(third - from) - line.dot(edge) * edge.dot(third - from) < 0.0 { -line } else { line };
    let upright = edge.dot(normal);
    (upright.abs() > 0.05).then(|| (inwards - normal * (edge.dot(inwards) / upright)).normalize_or_zero())
}

//! Clipping in clip space (Sutherland and Hodgman 1974), before the division by w.

use glam::Vec4;

use super::vertex::Corner;

/// How far outside of the picture a triangle may reach, in half pictures, before it is clipped: keeps fixed-point
/// positions within 32 bits, while nearly every triangle passes untouched.
const GUARD: f32 = 16.0;

/// A triangle has three corners, and each of the seven planes adds at most one.
const MOST_CORNERS: usize = 10;

/// What clipping leaves of a triangle.
#[derive(Debug)]
pub(super) enum Clipped {
    /// Nothing of it is in the picture.
    Nothing,
    /// All of it: its own corners serve.
    Whole,
    /// A convex polygon, in the triangle's order.
    Polygon(Vec<Corner>),
}

/// Signed distances of a point from the clipping planes, inside positive. The first keeps w positive, for views whose
/// near distance is not; then near and far; the others are the guard band.
fn distances(clip: Vec4) -> [f32; 7] {
    let guard = GUARD * clip.w;
    [clip.w - 1e-6, clip.z, clip.w - clip.z, guard - clip.x, guard + clip.x, guard - clip.y, guard + clip.y]
}

/// Whether all three corners lie beyond one side of the picture, or are no numbers.
fn is_outside(corners: [&Corner; 3]) -> bool {
    let sides = |c: Vec4| [c.w - c.x, c.w + c.x, c.w - c.y, c.w + c.y, c.z, c.w - c.z];
    let [a, b, c] = corners.map(|corner| sides(corner.clip));
    (0..6).any(|side| !(a[side] >= 0.0 || b[side] >= 0.0 || c[side] >= 0.0))
}

/// Clips a triangle.
pub(super) fn clip(corners: [&Corner; 3]) -> Clipped {
    if corners.iter().any(|corner| !corner.clip.is_finite()) || is_outside(corners) {
        return Clipped::Nothing;
    }
    if corners.iter().all(|corner| distances(corner.clip).iter().all(|&distance| distance >= 0.0)) {
        return Clipped::Whole;
    }
    let mut polygon = Vec::with_capacity(MOST_CORNERS);
    polygon.extend(corners.map(|corner| *corner));
    let mut kept = Vec::with_capacity(MOST_CORNERS);
    for plane in 0..7 {
        clip_at(plane, &polygon, &mut kept);
        std::mem::swap(&mut polygon, &mut kept);
    }
    if polygon.len() < 3 { Clipped::Nothing } else { Clipped::Polygon(polygon) }
}

fn clip_at(plane: usize, polygon: &[Corner], kept: &mut Vec<Corner>) {
    kept.clear();
    let following = polygon.iter().cycle().skip(1);
    for (here, next) in polygon.iter().zip(following) {
        let (d, e) = (distances(here.clip)[plane], distances(next.clip)[plane]);
        if d >= 0.0 {
            kept.push(*here);
        }
        // From the inside outwards always, so that two triangles get the same point on their shared edge.
        if d >= 0.0 && e < 0.0 {
            kept.push(here.towards(next, d / (d - e)));
        } else if d < 0.0 && e >= 0.0 {
            kept.push(next.towards(here, e / (e - d)));
        }
    }
}

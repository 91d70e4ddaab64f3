//! Whether lines cross.

use glam::DVec2;

/// A straight line from point to point, and what it belongs to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) ends: [DVec2; 2],
    /// The line it belongs to: an index of the caller's.
    pub(crate) line: usize,
    /// Its place in a chain: two strokes with the same joint as end and start are neighbours.
    pub(crate) joints: [usize; 2],
}

/// The first two strokes found to cross or touch, where they are not neighbours; or neighbours that fold back on each other.
pub(crate) fn crossing(strokes: &[Stroke]) -> Option<(Stroke, Stroke)> {
    let left = |stroke: &Stroke| stroke.ends[0].x.min(stroke.ends[1].x);
    let mut order: Vec<usize> = (0..strokes.len()).collect();
    order.sort_by(|&a, &b| left(&strokes[a]).total_cmp(&left(&strokes[b])));
    for (i, &first) in order.iter().enumerate() {
        let a = &strokes[first];
        let right = a.ends[0].x.max(a.ends[1].x);
        for &second in &order[i + 1..] {
            let b = &strokes[second];
            if left(b) > right {
                break;
            }
            if meet(a, b) {
                return Some((*a, *b));
            }
        }
    }
    None
}

fn meet(a: &Stroke, b: &Stroke) -> bool {
    if a.joints[1] == b.joints[0] {
        return folds_back(a.ends[1], a.ends[0], b.ends[1]);
    }
    if b.joints[1] == a.joints[0] {
        return folds_back(b.ends[1], b.ends[0], a.ends[1]);
    }
    let [p, q] = a.ends;
    let [r, s] = b.ends;
    let apart = p.y.max(q.y) < r.y.min(s.y) || r.y.max(s.y) < p.y.min(q.y);
    if apart {
        return false;
    }
    let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
    let (r_side, s_side, p_side, q_side) = (side(p, q, r), side(p, q, s), side(r, s, p), side(r, s, q));
    if r_side == 0.0 && s_side == 0.0 {
        // On one straight line, and their boxes overlap.
        return p.x.max(q.x) >= r.x.min(s.x);
    }
    r_side * s_side <= 0.0 && p_side * q_side <= 0.0
}

/// Whether the lines from `joint` to `a` and to `b` lie on each other.
fn folds_back(joint: DVec2, a: DVec2, b: DVec2) -> bool {
    let (a, b) = (a - joint, b - joint);
    a.perp_dot(b).abs() <= 1e-9 * a.length() * b.length() && a.dot(b) > 0.0
}

/// Whether a point lies inside a closed polygon.
pub(crate) fn inside(polygon: &[DVec2], point: DVec2) -> bool {
    let mut within = false;
    let mut last = polygon.last().copied().unwrap_or_default();
    for &next in polygon {
        if (last.y > point.y) != (next.y > point.y) {
            let x = last.x + (point.y - last.y) / (next.y - last.y) * (next.x - last.x);
            within ^= x > point.x;
        }
        last = next;
    }
    within
}

/// The area of a closed polygon, square metres; negative where it runs clockwise.
pub(crate) fn area(polygon: &[DVec2]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0
}

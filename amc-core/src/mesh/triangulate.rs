//! Polygons to triangles, on the shorter diagonals.

use glam::{Vec2, Vec3};

/// Most corners a polygon may have: the work grows with their square.
pub(super) const CORNER_LIMIT: usize = 4096;

/// How much work a polygon may cost when its ears run out, in looks at all of its corners. A whole polygon without
/// spikes and crossings needs none; what is left of a hostile one is cut anyhow.
const REFRESH_LIMIT: usize = 16;

/// Triangulates a polygon; hands out triples of indices into `points`, wound as the polygon is.
///
/// A quadrilateral is cut along the shorter of its diagonals that lie inside; a larger polygon has its ear with the
/// shortest diagonal clipped again and again, seen along its mean normal. `n` corners give `n - 2` triangles whatever
/// the shape; a polygon that crosses itself is covered as well as it can be. Fewer than three corners give nothing.
pub(super) fn triangulate(points: &[Vec3], mut emit: impl FnMut([usize; 3])) {
    match *points {
        [] | [_] | [_, _] => {}
        [_, _, _] => emit([0, 1, 2]),
        [a, b, c, d] => {
            let normal = (c - a).cross(d - b);
            // The diagonal ac lies inside where b and d are on different sides of it.
            let inside = |p: Vec3, q: Vec3, r: Vec3, s: Vec3| {
                (q - p).cross(r - p).dot(normal) > 0.0 && (r - p).cross(s - p).dot(normal) > 0.0
            };
            let shorter = a.distance_squared(c) <= b.distance_squared(d);
            let along_ac = match (inside(a, b, c, d), inside(b, c, d, a)) {
                (true, false) => true,
                (false, true) => false,
                _ => shorter,
            };
            if along_ac {
                emit([0, 1, 2]);
                emit([0, 2, 3]);
            } else {
                emit([0, 1, 3]);
                emit([1, 2, 3]);
            }
        }
        _ => clip_ears(points, emit),
    }
}

/// A polygon that is being clipped, as a ring over its flattened points.
struct Ring {
    points: Vec<Vec2>,
    previous: Vec<usize>,
    next: Vec<usize>,
    /// Length of the diagonal that cuts the corner off, squared; infinite where the corner is no ear.
    cost: Vec<f32>,
    reflex: Vec<bool>,
}

fn clip_ears(points: &[Vec3], mut emit: impl FnMut([usize; 3])) {
    let count = points.len();
    let mut ring = Ring::new(points);
    let mut corner = 0;
    let mut budget = REFRESH_LIMIT * count * count;
    for left in (4..=count).rev() {
        let mut ear = ring.cheapest(corner);
        if ring.cost[ear].is_infinite() && budget >= left * left {
            // An ear can be opened far from the last cut.
            budget -= left * left;
            ring.refresh(corner);
            ear = ring.cheapest(corner);
        }
        let (previous, next) = (ring.previous[ear], ring.next[ear]);
        emit([previous, ear, next]);
        ring.next[previous] = next;
        ring.previous[next] = previous;
        ring.update(previous);
        ring.update(next);
        corner = next;
    }
    emit([ring.previous[corner], corner, ring.next[corner]]);
}

impl Ring {
    fn new(points: &[Vec3]) -> Self {
        let count = points.len();
        // Newell's normal: twice the vector area.
        let normal: Vec3 =
            (0..count).map(|i| (points[i] - points[0]).cross(points[(i + 1) % count] - points[0])).sum();
        let (x, y) = normal.try_normalize().unwrap_or(Vec3::Z).any_orthonormal_pair();
        let mut ring = Self {
            points: points
                .iter()
                .map(|&p| Vec2::new((p - points[0]).dot(x), (p - points[0]).dot(y)))
                .collect(),
            previous: (0..count).map(|i| (i + count - 1) % count).collect(),
            next: (0..count).map(|i| (i + 1) % count).collect(),
            cost: vec![f32::INFINITY; count],
            reflex: vec![false; count],
        };
        for i in 0..count {
            ring.reflex[i] = ring.is_reflex(i);
        }
        ring.refresh(0);
        ring
    }

    fn is_reflex(&self, i: usize) -> bool {
        let [a, b, c] = self.triangle(i);
        (b - a).perp_dot(c - b) <= 0.0
    }

    fn triangle(&self, i: usize) -> [Vec2; 3] {
        [self.points[self.previous[i]], self.points[i], self.points[self.next[i]]]
    }

    fn update(&mut self, i: usize) {
        self.reflex[i] = self.is_reflex(i);
        self.cost[i] = self.cost_of(i, self.corners(i).filter(|&j| self.reflex[j]));
    }

    /// All corners of the ring that runs through `from`.
    fn corners(&self, from: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(from), move |&i| Some(self.next[i]).filter(|&next| next != from))
    }

    fn refresh(&mut self, from: usize) {
        let corners: Vec<usize> = self.corners(from).collect();
        let reflex: Vec<usize> = corners.iter().copied().filter(|&i| self.reflex[i]).collect();
        for i in corners {
            self.cost[i] = self.cost_of(i, reflex.iter().copied());
        }
    }

    /// `reflex`: the ring's reflex corners; only one of them can stand in the way.
    fn cost_of(&self, i: usize, mut reflex: impl Iterator<Item = usize>) -> f32 {
        let [a, b, c] = self.triangle(i);
        let (before, after) = (self.previous[i], self.next[i]);
        let inside = |p: Vec2| {
            (b - a).perp_dot(p - a) >= 0.0 && (c - b).perp_dot(p - b) >= 0.0 && (a - c).perp_dot(p - c) >= 0.0
        };
        // One that stands on the cut's own ends does not.
        let blocked = |j: usize| {
            let p = self.points[j];
            j != before && j != after && p != a && p != b && p != c && inside(p)
        };
        if self.reflex[i] || reflex.any(blocked) { f32::INFINITY } else { a.distance_squared(c) }
    }

    fn cheapest(&self, from: usize) -> usize {
        self.corners(from).min_by(|&i, &j| self.cost[i].total_cmp(&self.cost[j])).unwrap_or(from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[[f32; 2]]) -> Vec<[usize; 3]> {
        // Any plane will do: this one is oblique.
        let (x, y) = Vec3::new(1.0, 2.0, -2.0).normalize_or_zero().any_orthonormal_pair();
        let lifted: Vec<Vec3> = points.iter().map(|p| x * p[0] + y * p[1] + Vec3::splat(3.0)).collect();
        let mut triangles = Vec::new();
        triangulate(&lifted, |triangle| triangles.push(triangle));
        triangles
    }

    fn area(points: &[[f32; 2]], corners: &[usize]) -> f32 {
        let p = |i: usize| Vec2::from(points[corners[i % corners.len()]]);
        (0..corners.len()).map(|i| 0.5 * p(i).perp_dot(p(i + 1))).sum()
    }

    /// Covered once: no triangle is turned over, and the areas add up to the polygon's.
    fn assert_covers(points: &[[f32; 2]]) {
        let triangles = cut(points);
        let whole = area(points, &(0..points.len()).collect::<Vec<_>>());
        assert_eq!(triangles.len(), points.len() - 2);
        let areas: Vec<f32> = triangles.iter().map(|t| area(points, t)).collect();
        assert!(areas.iter().all(|&a| a > -1e-5), "{triangles:?} {areas:?}");
        assert!((areas.iter().sum::<f32>() - whole).abs() < 1e-4 * whole, "{triangles:?}");
    }

    #[test]
    fn a_quad_is_cut_on_its_shorter_diagonal() {
        assert_eq!(cut(&[[0.0, 0.0], [3.0, 0.0], [4.0, 1.0], [1.0, 1.0]]), [[0, 1, 3], [1, 2, 3]]);
        assert_eq!(cut(&[[0.0, 0.0], [3.0, 0.0], [2.0, 1.0], [-1.0, 1.0]]), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn a_dart_is_cut_inside_though_the_other_diagonal_is_shorter() {
        let dart = [[0.0, 0.0], [-1.0, -1.0], [3.0, 0.0], [-1.0, 1.0]];
        assert_covers(&dart);
        let dart = [[-1.0, 1.0], [0.0, 0.0], [-1.0, -1.0], [3.0, 0.0]];
        assert_covers(&dart);
    }

    #[test]
    fn concave_polygons_are_covered_once() {
        assert_covers(&[
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ]);
        let star: Vec<[f32; 2]> = (0..40)
            .map(|i| {
                let (radius, angle) =
                    (if i % 2 == 0 { 1.0 } else { 0.3 }, i as f32 * std::f32::consts::TAU / 40.0);
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect();
        assert_covers(&star);
    }

    #[test]
    fn any_polygon_gives_two_triangles_less_than_corners() {
        let crossing = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [0.5, 2.0]];
        assert_eq!(cut(&crossing).len(), 3);
        assert_eq!(cut(&[[0.0, 0.0]; 9]).len(), 7);
        assert!(cut(&[[0.0, 0.0]; 2]).is_empty());
    }

    #[test]
    fn the_largest_polygon_is_cut_in_good_time() {
        let comb: Vec<[f32; 2]> = (0..CORNER_LIMIT)
            .map(|i| match i {
                0 => [4096.0, -1.0],
                _ => [(CORNER_LIMIT - i) as f32, if i % 2 == 0 { 1.0 } else { 0.0 }],
            })
            .collect();
        let mut count = 0;
        let lifted: Vec<Vec3> = comb.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect();
        triangulate(&lifted, |_| count += 1);
        assert_eq!(count, CORNER_LIMIT - 2);
    }
}

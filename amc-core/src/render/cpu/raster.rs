//! Triangles in window space: set-up, and which samples of a 2x2 quad they cover.
//!
//! The rules are those of the graphics devices: positions are snapped to 1/256 pixel, a sample on an edge belongs to
//! the triangle for which the edge is a top or a left one, depth is linear in window space.

use glam::Vec4;

use super::vertex::Corner;

/// Sub-pixel steps per pixel.
const STEPS: i32 = 256;

/// Offsets of the samples from the pixel's centre, in steps, x right and y down.
const CENTRE: [(i64, i64); 1] = [(0, 0)];

/// Vulkan's standard sample locations for four samples.
const FOUR: [(i64, i64); 4] = [(-32, -96), (96, -32), (-96, 32), (32, 96)];

/// Where the samples of a pixel stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Samples {
    /// One, at the centre.
    One,
    /// The standard four.
    Four,
}

impl Samples {
    /// How many.
    pub(super) fn count(self) -> usize {
        self.offsets().len()
    }

    fn offsets(self) -> &'static [(i64, i64)] {
        match self {
            Self::One => &CENTRE,
            Self::Four => &FOUR,
        }
    }
}

/// A triangle in window space: x to the right, y down.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowTriangle {
    /// Snapped positions, in steps; so ordered that the doubled area is positive.
    x: [i32; 3],
    y: [i32; 3],
    /// Depth, 0 to 1.
    z: [f32; 3],
    /// 1/w of the corners.
    pub(super) inverse_w: [f32; 3],
    /// Into the corners, same order.
    pub(super) corners: [u32; 3],
    /// Which draw it belongs to.
    pub(super) draw: u32,
    /// Whether its front is seen.
    pub(super) front: bool,
}

/// A position in window space, snapped.
#[derive(Debug, Clone, Copy)]
struct WindowPosition {
    x: i32,
    y: i32,
    z: f32,
    inverse_w: f32,
}

fn window_position(clip: Vec4, width: f32, height: f32) -> WindowPosition {
    let inverse_w = 1.0 / clip.w;
    let x = clip.x * inverse_w * (width / 2.0) + width / 2.0;
    let y = clip.y * inverse_w * (-height / 2.0) + height / 2.0;
    let snap = |value: f32| (value * STEPS as f32).round_ties_even() as i32;
    WindowPosition { x: snap(x), y: snap(y), z: clip.z * inverse_w, inverse_w }
}

impl WindowTriangle {
    /// A clipped triangle in a picture of `width` x `height`; none where it has no area once snapped.
    pub(super) fn new(
        corners: [&Corner; 3],
        indices: [u32; 3],
        draw: u32,
        width: u32,
        height: u32,
    ) -> Option<Self> {
        let at = corners.map(|corner| window_position(corner.clip, width as f32, height as f32));
        let edge = |k: usize| (i64::from(at[k].x - at[0].x), i64::from(at[k].y - at[0].y));
        let (b, c) = (edge(1), edge(2));
        let doubled_area = b.0 * c.1 - b.1 * c.0;
        // Counter-clockwise with y up is clockwise with y down, where the area comes out negative.
        let order = match doubled_area.signum() {
            -1 => [0, 2, 1],
            1 => [0, 1, 2],
            _ => return None,
        };
        Some(Self {
            x: order.map(|k| at[k].x),
            y: order.map(|k| at[k].y),
            z: order.map(|k| at[k].z),
            inverse_w: order.map(|k| at[k].inverse_w),
            corners: order.map(|k| indices[k]),
            draw,
            front: doubled_area < 0,
        })
    }

    /// The first and the last column and row of pixels it may touch, x then y; may lie outside of the picture.
    pub(super) fn bounds(&self) -> [(i32, i32); 2] {
        [self.x, self.y].map(|values| {
            let low = values[0].min(values[1]).min(values[2]);
            let high = values[0].max(values[1]).max(values[2]);
            (low.div_euclid(STEPS), high.div_euclid(STEPS))
        })
    }
}

/// One edge as `a x + b y + c`: positive inside, in steps squared.
#[derive(Debug, Clone, Copy)]
struct Edge {
    a: i64,
    b: i64,
    c: i64,
    /// 0 for a top or left edge, -1 for the others: samples on those do not count.
    bias: i64,
    /// What lies furthest inside of a quad, relative to its first pixel's centre: where this is outside, all is.
    furthest: i64,
}

impl Edge {
    fn new(from: (i32, i32), to: (i32, i32), samples: Samples) -> Self {
        let (dx, dy) = (i64::from(to.0 - from.0), i64::from(to.1 - from.1));
        let (a, b) = (-dy, dx);
        let top_or_left = dy < 0 || (dy == 0 && dx > 0);
        let step = i64::from(STEPS);
        let furthest_sample = samples.offsets().iter().map(|&(x, y)| a * x + b * y).max().unwrap_or(0);
        Self {
            a,
            b,
            c: -(a * i64::from(from.0) + b * i64::from(from.1)),
            bias: if top_or_left { 0 } else { -1 },
            furthest: furthest_sample + (a * step).max(0) + (b * step).max(0),
        }
    }

    fn at(&self, x: i64, y: i64) -> i64 {
        self.a * x + self.b * y + self.c
    }
}

/// A triangle made ready to be asked, quad by quad, what it covers.
#[derive(Debug, Clone)]
pub(super) struct Coverage {
    /// The edge opposite to each corner.
    edges: [Edge; 3],
    samples: Samples,
    /// One over the doubled area in steps squared.
    inverse_area: f64,
    /// Depth at the first corner and its change per step.
    depth: [f64; 3],
    origin: (i64, i64),
}

/// The pixels of a quad, and its masks, are ordered: top left, top right, bottom left, bottom right.
pub(super) const QUAD: [(i64, i64); 4] = [(0, 0), (1, 0), (0, 1), (1, 1)];

impl Coverage {
    /// Of a triangle.
    pub(super) fn new(triangle: &WindowTriangle, samples: Samples) -> Self {
        let corner = |k: usize| (triangle.x[k], triangle.y[k]);
        let edges = [(1, 2), (2, 0), (0, 1)].map(|(from, to)| Edge::new(corner(from), corner(to), samples));
        let origin = (i64::from(triangle.x[0]), i64::from(triangle.y[0]));
        let inverse_area = 1.0 / edges[0].at(origin.0, origin.1) as f64;
        let slope = |per: fn(&Edge) -> i64| {
            let sum: f64 =
                edges.iter().zip(triangle.z).map(|(edge, z)| per(edge) as f64 * f64::from(z)).sum();
            sum * inverse_area
        };
        let depth = [f64::from(triangle.z[0]), slope(|edge| edge.a), slope(|edge| edge.b)];
        Self { edges, samples, inverse_area, depth, origin }
    }

    /// Which samples of the quad with the top left pixel `x`, `y` are covered: pixel by pixel, `samples` bits each,
    /// the first pixel in the lowest.
    pub(super) fn of_quad(&self, x: i32, y: i32) -> u16 {
        let (cx, cy) = centre(x, y);
        let at = self.edges.map(|edge| edge.at(cx, cy) + edge.bias);
        if (0..3).any(|k| at[k] + self.edges[k].furthest < 0) {
            return 0;
        }
        let mut mask = 0;
        let mut bit = 1;
        let step = i64::from(STEPS);
        for (right, down) in QUAD {
            for (dx, dy) in self.samples.offsets() {
                let (dx, dy) = (right * step + dx, down * step + dy);
                let inside = (0..3).all(|k| at[k] + self.edges[k].a * dx + self.edges[k].b * dy >= 0);
                mask |= if inside { bit } else { 0 };
                bit <<= 1;
            }
        }
        mask
    }

    /// The depth at a sample of the pixel `x`, `y`, held to 0..=1.
    pub(super) fn depth(&self, x: i32, y: i32, sample: usize) -> f32 {
        let (cx, cy) = centre(x, y);
        let (dx, dy) = self.samples.offsets()[sample];
        let [z, a, b] = self.depth;
        let at = z + a * (cx + dx - self.origin.0) as f64 + b * (cy + dy - self.origin.1) as f64;
        (at as f32).clamp(0.0, 1.0)
    }

    /// The shares of the three corners at the centre of the pixel `x`, `y`, linear in window space. They sum to one, and
    /// leave 0..=1 where the centre is outside of the triangle.
    pub(super) fn shares(&self, x: i32, y: i32) -> [f32; 3] {
        let (cx, cy) = centre(x, y);
        self.edges.map(|edge| (edge.at(cx, cy) as f64 * self.inverse_area) as f32)
    }
}

/// The centre of a pixel, in steps.
fn centre(x: i32, y: i32) -> (i64, i64) {
    let at = |pixel: i32| i64::from(pixel) * i64::from(STEPS) + i64::from(STEPS / 2);
    (at(x), at(y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::cpu::vertex::Varyings;
    use glam::{Vec2, Vec3};

    const SIDE: u32 = 32;

    /// A triangle of window positions, in pixels.
    fn triangle(points: [(f32, f32); 3]) -> Option<WindowTriangle> {
        let half = SIDE as f32 / 2.0;
        let varyings = Varyings {
            p: Vec3::ZERO,
            n: Vec3::Z,
            t: Vec3::X,
            uv: Vec2::ZERO,
            occlusion: Vec2::ONE,
            kappa: Vec4::ZERO,
        };
        let corners = points
            .map(|(x, y)| Corner { clip: Vec4::new(x / half - 1.0, 1.0 - y / half, 0.5, 1.0), varyings });
        let [a, b, c] = &corners;
        WindowTriangle::new([a, b, c], [0, 1, 2], 0, SIDE, SIDE)
    }

    /// How many of the triangles cover each sample, over the whole picture.
    fn counts(triangles: &[WindowTriangle], samples: Samples) -> Vec<u32> {
        let mut counts = vec![0; (SIDE * SIDE) as usize * samples.count()];
        for triangle in triangles {
            let coverage = Coverage::new(triangle, samples);
            for y in (0..SIDE).step_by(2) {
                for x in (0..SIDE).step_by(2) {
                    let mask = coverage.of_quad(x as i32, y as i32);
                    for (lane, (right, down)) in QUAD.iter().enumerate() {
                        for sample in 0..samples.count() {
                            let pixel = (y + *down as u32) * SIDE + x + *right as u32;
                            let bit = mask >> (lane * samples.count() + sample) & 1;
                            counts[pixel as usize * samples.count() + sample] += u32::from(bit);
                        }
                    }
                }
            }
        }
        counts
    }

    #[test]
    fn a_square_through_pixel_centres_has_its_top_and_left_ones_only() {
        let corners = [(4.5, 4.5), (4.5, 8.5), (8.5, 8.5), (8.5, 4.5)];
        for (first, other) in [([0, 1, 2], [0, 2, 3]), ([0, 1, 3], [3, 1, 2]), ([2, 1, 0], [0, 2, 3])] {
            let triangles = [first, other].map(|t| triangle(t.map(|k: usize| corners[k])).unwrap());
            for (index, count) in counts(&triangles, Samples::One).into_iter().enumerate() {
                let (x, y) = (index as u32 % SIDE, index as u32 / SIDE);
                let inside = (4..8).contains(&x) && (4..8).contains(&y);
                assert_eq!(count, u32::from(inside), "{x} {y}");
            }
        }
    }

    #[test]
    fn triangles_around_a_point_cover_every_sample_of_the_picture_exactly_once() {
        let rim: Vec<(f32, f32)> = (0..13)
            .map(|k| {
                let angle = k as f32 * std::f32::consts::TAU / 13.0;
                (16.0 + 40.0 * angle.cos(), 16.0 + 40.0 * angle.sin())
            })
            .collect();
        for centre in [(16.0, 16.0), (16.5, 16.5), (7.375, 20.125), (3.3, 29.7)] {
            let fan: Vec<WindowTriangle> =
                (0..13).map(|k| triangle([centre, rim[k], rim[(k + 1) % 13]]).unwrap()).collect();
            for samples in [Samples::One, Samples::Four] {
                assert!(counts(&fan, samples).into_iter().all(|count| count == 1));
            }
        }
    }

    #[test]
    fn the_side_that_is_seen_follows_the_order_of_corners_as_drawn_with_y_up() {
        // Window y is down: this order is clockwise on the screen.
        let clockwise = [(4.0, 4.0), (20.0, 4.0), (4.0, 20.0)];
        assert!(!triangle(clockwise).unwrap().front);
        let [a, b, c] = clockwise;
        assert!(triangle([a, c, b]).unwrap().front);
        assert!(triangle([a, b, (12.0, 4.001)]).is_none(), "no area once snapped to 1/256");
    }

    #[test]
    fn shares_and_depth_are_linear_in_the_window() {
        let mut made = triangle([(2.0, 3.0), (2.0, 27.0), (26.0, 3.0)]).unwrap();
        made.z = made.corners.map(|corner| [0.2, 0.5, 0.8][corner as usize]);
        let coverage = Coverage::new(&made, Samples::Four);
        let (x, y) = (9, 12);
        // The centre (9.5, 12.5) lies 7.5 / 24 towards the third corner and 9.5 / 24 towards the second.
        let expected = [1.0 - 17.0 / 24.0, 9.5 / 24.0, 7.5 / 24.0];
        for (share, corner) in coverage.shares(x, y).into_iter().zip(made.corners) {
            assert!((share - expected[corner as usize]).abs() < 1e-6);
        }
        // The second standard sample is (0.875, 0.375) into the pixel.
        let depth = 0.2 + 0.3 * (12.375 - 3.0) / 24.0 + 0.6 * (9.875 - 2.0) / 24.0;
        assert!((coverage.depth(x, y, 1) - depth).abs() < 1e-6);
    }
}

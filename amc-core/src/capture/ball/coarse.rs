//! The coarse guess: a Hough transform for circles on a small picture.

use glam::DVec2;
use rayon::prelude::*;

use super::super::cone::{Cone, Lens, Sight, ray};
use super::{Mean, perceived};

/// The small picture's longer side, at most.
const SIDE: usize = 256;

/// The most edges that vote.
const MOST_EDGES: usize = 6000;

/// How many guesses are handed on.
const GUESSES: usize = 4;

/// An edge: where, in the plane where the outline is a circle, and its unit normal there.
#[derive(Clone, Copy)]
struct Edge {
    at: DVec2,
    normal: DVec2,
}

/// A circle in that plane, in small pixels.
#[derive(Clone, Copy)]
struct Circle {
    centre: DVec2,
    radius: f64,
    score: f64,
}

/// Balls that may be in the picture, likeliest first.
pub(super) fn guess(mean: &Mean<'_>, lens: Lens) -> Vec<Sight> {
    let small = Small::new(mean);
    let plane = Plane { lens, step: small.step as f64 };
    let edges: Vec<Edge> =
        small.edges().into_iter().filter_map(|(at, normal)| plane.edge(at, normal)).collect();
    let Some(votes) = Votes::cast(&edges, &small) else { return Vec::new() };
    let mut circles: Vec<Circle> = votes
        .peaks()
        .into_par_iter()
        .filter_map(|centre| best_radius(centre, &edges, votes.most_radius))
        .collect();
    circles.sort_by(|a, b| b.score.total_cmp(&a.score));
    circles.truncate(GUESSES);
    circles.into_iter().filter_map(|circle| plane.sight(circle)).collect()
}

/// The plane in which the outline is a circle: the picture itself, or, with a pinhole camera, the stereographic
/// projection of the directions of sight. Both in small pixels near the middle.
struct Plane {
    lens: Lens,
    /// Picture pixels to a small pixel.
    step: f64,
}

impl Plane {
    /// A picture's point, in full pixels, in the plane.
    fn point(&self, pixel: DVec2) -> DVec2 {
        match self.lens {
            Lens::Orthographic => pixel / self.step,
            Lens::Pinhole { focal, centre } => {
                let q = ray(focal, centre, pixel);
                let around = DVec2::new(q.x, -q.y) * (2.0 * focal / (1.0 - q.z));
                (around + centre) / self.step
            }
        }
    }

    fn edge(&self, pixel: DVec2, normal: DVec2) -> Option<Edge> {
        let along = normal.perp() * 0.5;
        let tangent = self.point(pixel + along) - self.point(pixel - along);
        Some(Edge { at: self.point(pixel), normal: tangent.perp().try_normalize()? })
    }

    /// The unit direction of a point of the plane.
    fn direction(point: DVec2, focal: f64, centre: DVec2, step: f64) -> glam::DVec3 {
        let s = (point * step - centre) / (2.0 * focal);
        let k = 2.0 / (1.0 + s.length_squared());
        glam::DVec3::new(s.x * k, -s.y * k, 1.0 - k)
    }

    fn sight(&self, circle: Circle) -> Option<Sight> {
        match self.lens {
            Lens::Orthographic => {
                Some(Sight::Parallel { centre: circle.centre * self.step, radius: circle.radius * self.step })
            }
            Lens::Pinhole { focal, centre } => {
                // The circle's nearest and farthest point from the axis are the ends of a diameter of the cone.
                let outwards = (circle.centre * self.step - centre).normalize_or(DVec2::X) * circle.radius;
                let near = Self::direction(circle.centre - outwards, focal, centre, self.step);
                let far = Self::direction(circle.centre + outwards, focal, centre, self.step);
                let towards = (near + far).try_normalize()?;
                (towards.z < -0.01)
                    .then(|| Sight::Cone(Cone::new(focal, centre, towards, near.angle_between(far) / 2.0)))
            }
        }
    }
}

/// A small copy of the mean picture.
struct Small {
    width: usize,
    height: usize,
    /// Picture pixels to a small pixel.
    step: usize,
    pixels: Vec<[f32; 3]>,
}

impl Small {
    fn new(mean: &Mean<'_>) -> Self {
        let step = mean.width().max(mean.height()).div_ceil(SIDE).max(1);
        let (width, height) = (mean.width() / step, mean.height() / step);
        // Of large blocks only every n-th pixel is read, to end at about 2 x 2 of them.
        let stride = step.div_ceil(2).max(1);
        let block = |x: usize, y: usize| {
            let mut sum = [0.0; 3];
            let mut count = 0.0;
            for v in (0..step).step_by(stride) {
                for u in (0..step).step_by(stride) {
                    let pixel = mean.pixel(x * step + u, y * step + v);
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += value;
                    }
                    count += 1.0;
                }
            }
            sum.map(|value| perceived(value / count))
        };
        let pixels = (0..width * height).into_par_iter().map(|k| block(k % width, k / width)).collect();
        let mut small = Self { width, height, step, pixels };
        small.smooth();
        small
    }

    /// 1 2 1 both ways, against noise.
    fn smooth(&mut self) {
        for (du, dv) in [(1, 0), (0, 1)] {
            let old = std::mem::take(&mut self.pixels);
            let at = |x: usize, y: usize| old[y * self.width + x];
            self.pixels = (0..old.len())
                .map(|k| {
                    let (x, y) = (k % self.width, k / self.width);
                    let before = at(x.saturating_sub(du), y.saturating_sub(dv));
                    let after = at((x + du).min(self.width - 1), (y + dv).min(self.height - 1));
                    std::array::from_fn(|c| (before[c] + 2.0 * at(x, y)[c] + after[c]) / 4.0)
                })
                .collect();
        }
    }

    /// The gradient of the channel that has the largest, at an inner pixel.
    fn gradient(&self, x: usize, y: usize) -> DVec2 {
        let at = |dx: usize, dy: usize, c: usize| {
            f64::from(self.pixels[(y + dy - 1) * self.width + x + dx - 1][c])
        };
        let of = |c: usize| {
            let gx =
                at(2, 0, c) + 2.0 * at(2, 1, c) + at(2, 2, c) - at(0, 0, c) - 2.0 * at(0, 1, c) - at(0, 2, c);
            let gy =
                at(0, 2, c) + 2.0 * at(1, 2, c) + at(2, 2, c) - at(0, 0, c) - 2.0 * at(1, 0, c) - at(2, 0, c);
            DVec2::new(gx, gy) / 8.0
        };
        (1..3)
            .map(of)
            .fold(of(0), |best, g| if g.length_squared() > best.length_squared() { g } else { best })
    }

    /// The ridges of the gradient that stand out of the noise: full pixel coordinates, and the gradient's direction.
    fn edges(&self) -> Vec<(DVec2, DVec2)> {
        if self.width < 8 || self.height < 8 {
            return Vec::new();
        }
        let (width, height) = (self.width, self.height);
        let inner = |k: usize| {
            let (x, y) = (k % width, k / width);
            (x > 0 && y > 0 && x + 1 < width && y + 1 < height).then_some((x, y))
        };
        let gradients: Vec<DVec2> = (0..width * height)
            .into_par_iter()
            .map(|k| inner(k).map_or(DVec2::ZERO, |(x, y)| self.gradient(x, y)))
            .collect();
        let mut lengths: Vec<f64> = gradients.iter().map(|g| g.length()).collect();
        let middle = lengths.len() / 2;
        let typical = *lengths.select_nth_unstable_by(middle, f64::total_cmp).1;
        let least = (3.0 * typical).clamp(0.004, 0.05);
        let mut edges: Vec<(f64, DVec2, DVec2)> = gradients
            .iter()
            .enumerate()
            .filter_map(|(k, &g)| {
                let (x, y) = inner(k)?;
                let length = g.length();
                let direction = (length > least).then(|| g / length)?;
                let (dx, dy) = (direction.x.round() as isize, direction.y.round() as isize);
                let at = |sign: isize| {
                    let beside = k as isize + sign * (dy * width as isize + dx);
                    gradients.get(beside as usize).map_or(0.0, |g| g.length())
                };
                let pixel = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) * self.step as f64;
                (length >= at(1) && length > at(-1)).then_some((length, pixel, direction))
            })
            .collect();
        edges.sort_by(|a, b| b.0.total_cmp(&a.0));
        edges.truncate(MOST_EDGES);
        edges.into_iter().map(|(_, at, normal)| (at, normal)).collect()
    }
}

/// Votes for the circle's centre, one cell per small pixel.
struct Votes {
    width: usize,
    height: usize,
    most_radius: f64,
    cells: Vec<f32>,
}

impl Votes {
    /// `None` where there are too few edges to mean anything.
    fn cast(edges: &[Edge], small: &Small) -> Option<Self> {
        if edges.len() < 12 {
            return None;
        }
        // The plane's picture is never larger than the picture itself: stereographic shrinks towards the edges.
        let (width, height) = (small.width, small.height);
        let most_radius = 0.62 * width.max(height) as f64;
        let mut cells = vec![0.0; width * height];
        for edge in edges {
            for sign in [-1.0, 1.0] {
                for radius in 4..most_radius as usize {
                    let at = edge.at + edge.normal * (sign * radius as f64);
                    if at.x < 0.0 || at.y < 0.0 || at.x >= width as f64 || at.y >= height as f64 {
                        break;
                    }
                    cells[at.y as usize * width + at.x as usize] += 1.0;
                }
            }
        }
        let mut votes = Self { width, height, most_radius, cells };
        votes.smooth();
        Some(votes)
    }

    /// 3 x 3 sums, twice: the normals of edges are known to a degree or two.
    fn smooth(&mut self) {
        for (du, dv) in [(1, 0), (0, 1), (1, 0), (0, 1)] {
            let old = std::mem::take(&mut self.cells);
            let at = |x: usize, y: usize| old[y * self.width + x];
            self.cells = (0..old.len())
                .map(|k| {
                    let (x, y) = (k % self.width, k / self.width);
                    let before = at(x.saturating_sub(du), y.saturating_sub(dv));
                    before + at(x, y) + at((x + du).min(self.width - 1), (y + dv).min(self.height - 1))
                })
                .collect();
        }
    }

    /// The highest cells, at least a few apart.
    fn peaks(&self) -> Vec<DVec2> {
        let mut order: Vec<usize> = (0..self.cells.len()).collect();
        let count = order.len().min(2000);
        if count == 0 {
            return Vec::new();
        }
        order.select_nth_unstable_by(count - 1, |&a, &b| self.cells[b].total_cmp(&self.cells[a]));
        order.truncate(count);
        order.sort_by(|&a, &b| self.cells[b].total_cmp(&self.cells[a]));
        let mut peaks: Vec<DVec2> = Vec::new();
        for k in order {
            let at = DVec2::new((k % self.width) as f64 + 0.5, (k / self.width) as f64 + 0.5);
            if peaks.iter().all(|peak| peak.distance(at) > 5.0) {
                peaks.push(at);
                if peaks.len() == 12 {
                    break;
                }
            }
        }
        peaks
    }
}

/// The circle about `centre` on which most edges lie, for its length; moved to fit them.
fn best_radius(centre: DVec2, edges: &[Edge], most_radius: f64) -> Option<Circle> {
    let bins = most_radius as usize + 2;
    let mut histogram = vec![0.0f64; bins + 2];
    for edge in edges {
        let away = edge.at - centre;
        let radius = away.length();
        let slope = (edge.normal.dot(away) / radius.max(1e-9)).abs();
        if slope > 0.9 && radius < bins as f64 {
            histogram[radius as usize] += 1.0;
        }
    }
    let supported = |r: usize| histogram[r - 1] + histogram[r] + histogram[r + 1];
    // Edges along the outline, times the share of it that they make up: a long outline over a small highlight, a
    // whole one over a stray arc.
    let score = |r: usize| supported(r).powi(2) / (2.0 * std::f64::consts::PI * (r as f64 + 0.5));
    let radius = (4..bins).max_by(|&a, &b| score(a).total_cmp(&score(b)))?;
    let mut circle = Circle { centre, radius: radius as f64 + 0.5, score: score(radius) };
    for _ in 0..6 {
        circle = fit_near(circle, edges)?;
    }
    Some(circle)
}

/// The circle that fits the edges near this one: one least-squares step on centre and radius.
fn fit_near(circle: Circle, edges: &[Edge]) -> Option<Circle> {
    let mut normal_matrix = glam::DMat3::ZERO;
    let mut right = glam::DVec3::ZERO;
    for edge in edges {
        let away = edge.at - circle.centre;
        let distance = away.length();
        let miss = distance - circle.radius;
        if miss.abs() > 2.0 || distance < 1e-9 || (edge.normal.dot(away) / distance).abs() < 0.9 {
            continue;
        }
        let row = (away / distance).extend(1.0);
        normal_matrix += glam::DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        right += row * miss;
    }
    (normal_matrix.determinant().abs() > 1e-6).then(|| {
        let change = normal_matrix.inverse() * right;
        Circle { centre: circle.centre + change.truncate(), radius: circle.radius + change.z, ..circle }
    })
}

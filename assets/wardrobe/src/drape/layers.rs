//! Contact of the cloth with itself.
//!
//! Pairs of a particle and a triangle, and of two edges, that are near each other are found once in a while, with the
//! side on which they lie; until the next time they are kept apart on that side (Bridson, Fedkiw and Anderson 2002, sections 6 and 7).

use glam::DVec3;
use rayon::prelude::*;

use super::grid::CellGrid;
use super::model::Model;
use super::points::Points;

/// What may touch before the next search.
#[derive(Debug, Clone, Copy)]
enum Pair {
    /// A particle over a triangle: on the side of its normal where `side` is 1, else on the other.
    Face { particle: u32, corners: [u32; 3], side: f64, apart: f64 },
    /// Two edges, the first lying in `direction` from the second.
    Edges { first: [u32; 2], second: [u32; 2], direction: DVec3, apart: f64 },
}

/// What never changes while the sewing stays as it is.
#[derive(Debug)]
pub(super) struct Layers {
    edges: Vec<[u32; 2]>,
    /// Per particle, what it is once all seams are sewn.
    sewn: Vec<u32>,
    /// Per sewn particle, those it shares a triangle with, sorted.
    neighbours: Vec<Vec<u32>>,
    thickness: f64,
    pairs: Vec<Pair>,
}

/// Side of a cell of the search, at least, in mean edges.
const CELL_PER_EDGE: f64 = 1.2;

impl Layers {
    /// `sewn`: per particle, what it is once all seams are sewn: seams that are about to close do not repel each other.
    /// `thickness`: how far apart layers are kept, metres.
    pub(super) fn new(model: &Model, sewn: Vec<u32>, thickness: f64) -> Self {
        let mut edges: Vec<[u32; 2]> = Vec::new();
        let mut neighbours = vec![Vec::new(); sewn.iter().max().map_or(0, |most| *most as usize + 1)];
        for [a, b, c] in &model.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                edges.push([*from.min(to), *from.max(to)]);
                let (from, to) = (sewn[*from as usize], sewn[*to as usize]);
                neighbours[from as usize].extend([to, from]);
                neighbours[to as usize].push(from);
            }
        }
        edges.sort_unstable();
        edges.dedup();
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        Self { edges, sewn, neighbours, thickness, pairs: Vec::new() }
    }

    /// Finds all pairs that are within the thickness and `reach`, metres.
    pub(super) fn search(&mut self, model: &Model, places: &[DVec3], reach: f64) {
        let range = self.thickness + reach;
        let cell = (CELL_PER_EDGE * model.edge_length).max(2.0 * range);
        let mut pairs = self.faces(model, places, range, cell);
        pairs.extend(self.crossings(places, range, cell));
        self.pairs = pairs;
    }

    fn faces(&self, model: &Model, places: &[DVec3], range: f64, cell: f64) -> Vec<Pair> {
        let grow = DVec3::splat(range);
        let boxes: Vec<_> = model
            .triangles
            .iter()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| places[corner as usize]);
                (a.min(b).min(c) - grow, a.max(b).max(c) + grow)
            })
            .collect();
        let grid = CellGrid::new(&boxes, cell);
        let of_particle = |particle: usize| {
            let (place, grid, boxes) = (places[particle], &grid, &boxes);
            let near = grid.at(place).filter(move |index| {
                let (low, high) = boxes[*index as usize];
                place.cmpge(low).all() && place.cmple(high).all()
            });
            near.filter_map(move |index| self.face(particle as u32, model.triangles[index as usize], places, range))
        };
        let chunks = (0..places.len()).into_par_iter().with_min_len(256);
        chunks.flat_map_iter(of_particle).collect()
    }

    fn face(&self, particle: u32, corners: [u32; 3], places: &[DVec3], range: f64) -> Option<Pair> {
        if self.adjoin(particle, &corners) {
            return None;
        }
        let [a, b, c] = corners.map(|corner| places[corner as usize]);
        let normal = (b - a).cross(c - a).try_normalize()?;
        let height = (places[particle as usize] - a).dot(normal);
        if height.abs() > range {
            return None;
        }
        let side = if height < 0.0 { -1.0 } else { 1.0 };
        Some(Pair::Face { particle, corners, side, apart: self.thickness })
    }

    /// Whether a particle is, or shares a triangle with, one of those.
    fn adjoin(&self, particle: u32, others: &[u32]) -> bool {
        let near = &self.neighbours[self.sewn[particle as usize] as usize];
        others.iter().any(|other| near.binary_search(&self.sewn[*other as usize]).is_ok())
    }

    fn crossings(&self, places: &[DVec3], range: f64, cell: f64) -> Vec<Pair> {
        let grow = DVec3::splat(0.5 * range);
        let boxes: Vec<_> = self
            .edges
            .iter()
            .map(|edge| {
                let [a, b] = edge.map(|end| places[end as usize]);
                (a.min(b) - grow, a.max(b) + grow)
            })
            .collect();
        let grid = CellGrid::new(&boxes, cell);
        let of_edge = |index: usize| {
            let (low, high) = boxes[index];
            let overlaps = |other: &u32| {
                let (other_low, other_high) = boxes[*other as usize];
                *other as usize > index && low.cmple(other_high).all() && high.cmpge(other_low).all()
            };
            let mut near: Vec<u32> = grid.within(low, high).filter(overlaps).collect();
            near.sort_unstable();
            near.dedup();
            near.into_iter().filter_map(move |other| self.crossing(self.edges[index], self.edges[other as usize], places, range))
        };
        let chunks = (0..self.edges.len()).into_par_iter().with_min_len(256);
        chunks.flat_map_iter(of_edge).collect()
    }

    fn crossing(&self, first: [u32; 2], second: [u32; 2], places: &[DVec3], range: f64) -> Option<Pair> {
        if self.adjoin(first[0], &second) || self.adjoin(first[1], &second) {
            return None;
        }
        let [a, b] = first.map(|end| places[end as usize]);
        let [c, d] = second.map(|end| places[end as usize]);
        let (s, t) = nearest_on_edges(a, b, c, d)?;
        let between = a.lerp(b, s) - c.lerp(d, t);
        if between.length_squared() > range * range {
            return None;
        }
        let direction = between.try_normalize()?;
        Some(Pair::Edges { first, second, direction, apart: self.thickness })
    }

    /// Keeps every pair apart. `before`: places at the step's start, for friction.
    pub(super) fn solve(&self, points: &Points, before: &[DVec3], inverse_mass: &[f64], friction: f64) {
        let touching = |pair: &&Pair| touch(pair, points).is_some();
        let active: Vec<&Pair> = if self.pairs.len() < 4096 {
            self.pairs.iter().filter(touching).collect()
        } else {
            self.pairs.par_iter().with_min_len(1024).filter(touching).collect()
        };
        for pair in active {
            if let Some(touch) = touch(pair, points) {
                touch.resolve(points, before, inverse_mass, friction);
            }
        }
    }
}

/// Four particles that are too near: `sum weights x` is too short along `normal` by `depth`.
struct Touch {
    particles: [u32; 4],
    weights: [f64; 4],
    normal: DVec3,
    depth: f64,
}

impl Touch {
    /// Moves the four apart, then takes back sliding up to the friction's share (Mueller and others 2007; Macklin and others 2014, section 6.1).
    fn resolve(&self, points: &Points, before: &[DVec3], inverse_mass: &[f64], friction: f64) {
        let w = self.particles.map(|particle| inverse_mass[particle as usize]);
        let weight: f64 = w.iter().zip(self.weights).map(|(w, a)| w * a * a).sum();
        if weight <= 0.0 {
            return;
        }
        self.shift(points, &w, self.normal * (self.depth / weight));
        let slid: DVec3 = (0..4).map(|i| (points.get(self.particles[i]) - before[self.particles[i] as usize]) * self.weights[i]).sum();
        let slid = slid.reject_from_normalized(self.normal);
        let length = slid.length();
        if length > 0.0 {
            let back = (friction * self.depth / length).min(1.0);
            self.shift(points, &w, slid * (-back / weight));
        }
    }

    fn shift(&self, points: &Points, w: &[f64; 4], by: DVec3) {
        for i in 0..4 {
            points.shift(self.particles[i], by * (w[i] * self.weights[i]));
        }
    }
}

fn touch(pair: &Pair, points: &Points) -> Option<Touch> {
    match *pair {
        Pair::Face { particle, corners, side, apart } => {
            let [a, b, c] = corners.map(|corner| points.get(corner));
            let place = points.get(particle);
            let area = (b - a).cross(c - a);
            let square = area.length_squared();
            if square < 1e-20 {
                return None;
            }
            let normal = area * (side / square.sqrt());
            let depth = apart - (place - a).dot(normal);
            if depth <= 0.0 || depth > 2.0 * apart {
                return None;
            }
            let at_b = (place - a).cross(c - a).dot(area) / square;
            let at_c = (b - a).cross(place - a).dot(area) / square;
            let at_a = 1.0 - at_b - at_c;
            if at_a < 0.0 || at_b < 0.0 || at_c < 0.0 {
                return None;
            }
            let [p, q, r] = corners;
            Some(Touch { particles: [particle, p, q, r], weights: [1.0, -at_a, -at_b, -at_c], normal, depth })
        }
        Pair::Edges { first, second, direction, apart } => {
            let [a, b] = first.map(|end| points.get(end));
            let [c, d] = second.map(|end| points.get(end));
            let middle = (a + b - c - d) * 0.5;
            let reach = apart + 0.5 * (a.distance(b) + c.distance(d));
            if middle.length_squared() > reach * reach {
                return None;
            }
            let (s, t) = nearest_on_edges(a, b, c, d)?;
            let between = a.lerp(b, s) - c.lerp(d, t);
            let length = between.length();
            let upright = between.dot(direction);
            let (normal, depth) = if length < 1e-9 || upright < 0.0 { (direction, apart - upright) } else { (between / length, apart - length) };
            if depth <= 0.0 || depth > 2.0 * apart {
                return None;
            }
            let particles = [first[0], first[1], second[0], second[1]];
            Some(Touch { particles, weights: [1.0 - s, s, t - 1.0, -t], normal, depth })
        }
    }
}

/// Where two edges are nearest, as shares of their lengths, if that is inside both.
fn nearest_on_edges(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> Option<(f64, f64)> {
    let (first, second, between) = (b - a, d - c, a - c);
    let (ff, ss, fs) = (first.length_squared(), second.length_squared(), first.dot(second));
    let (fb, sb) = (first.dot(between), second.dot(between));
    let determinant = ff * ss - fs * fs;
    if determinant <= 1e-6 * ff * ss {
        return None;
    }
    let (s, t) = ((fs * sb - ss * fb) / determinant, (ff * sb - fs * fb) / determinant);
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)).then_some((s, t))
}

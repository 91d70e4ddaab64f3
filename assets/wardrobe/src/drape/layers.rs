//! Contact of the cloth with itself.
//!
//! Pairs of a particle and a triangle, and of two edges, that are near each other are found once in a while, with the
//! side on which they lie; until the next time they are kept apart on that side (Bridson, Fedkiw and Anderson 2002, sections 6 and 7).

use std::collections::HashSet;

use glam::DVec3;
use rayon::prelude::*;

use super::grid::CellGrid;
use super::model::Model;
use super::points::Points;
use super::tangle::Tangle;

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
    triangles: Vec<Owner>,
    /// Per particle, what it is once all seams are sewn.
    sewn: Vec<u32>,
    /// Per sewn particle, itself and those it shares a triangle with, sorted.
    neighbours: Vec<Vec<u32>>,
    thickness: f64,
    near: Near,
}

/// What a search finds.
#[derive(Debug, Default)]
struct Near {
    pairs: Vec<Pair>,
    tangles: Vec<Tangle>,
}

/// A triangle, and which of its corners and edges are looked at with it: each is with one triangle only.
#[derive(Debug, Clone, Copy)]
struct Owner {
    corners: [u32; 3],
    owns_corner: [bool; 3],
    /// Edge i goes from corner i to the next.
    owns_edge: [bool; 3],
}

impl Owner {
    fn own_corners(&self) -> impl Iterator<Item = u32> {
        self.corners.into_iter().zip(self.owns_corner).filter(|(_, own)| *own).map(|(corner, _)| corner)
    }

    fn own_edges(&self) -> impl Iterator<Item = [u32; 2]> {
        (0..3).filter(|i| self.owns_edge[*i]).map(|i| [self.corners[i], self.corners[(i + 1) % 3]])
    }
}

/// Side of a cell of the search, at least, in mean edges.
const CELL_PER_EDGE: f64 = 1.2;

impl Layers {
    /// `sewn`: per particle, what it is once all seams are sewn: seams that are about to close do not repel each other.
    /// `thickness`: how far apart layers are kept, metres.
    pub(super) fn new(model: &Model, sewn: Vec<u32>, thickness: f64) -> Self {
        let mut seen_corners = vec![false; sewn.len()];
        let mut seen_edges = HashSet::new();
        let mut neighbours = vec![Vec::new(); sewn.iter().max().map_or(0, |most| *most as usize + 1)];
        let mut own = |corners: &[u32; 3]| {
            let mut owner = Owner { corners: *corners, owns_corner: [false; 3], owns_edge: [false; 3] };
            for i in 0..3 {
                let (from, to) = (corners[i], corners[(i + 1) % 3]);
                owner.owns_corner[i] = !std::mem::replace(&mut seen_corners[from as usize], true);
                owner.owns_edge[i] = seen_edges.insert([from.min(to), from.max(to)]);
                let (from, to) = (sewn[from as usize], sewn[to as usize]);
                neighbours[from as usize].extend([to, from]);
                neighbours[to as usize].push(from);
            }
            owner
        };
        let triangles = model.triangles.iter().map(&mut own).collect();
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        Self { triangles, sewn, neighbours, thickness, near: Near::default() }
    }

    /// Finds all pairs that are within the thickness and `reach`, metres.
    pub(super) fn search(&mut self, model: &Model, places: &[DVec3], reach: f64) {
        let range = self.thickness + reach;
        let cell = (CELL_PER_EDGE * model.edge_length).max(2.0 * range);
        let grow = DVec3::splat(0.5 * range);
        let bounds = |triangle: &Owner| {
            let [a, b, c] = triangle.corners.map(|corner| places[corner as usize]);
            (a.min(b).min(c) - grow, a.max(b).max(c) + grow)
        };
        let boxes: Vec<_> = self.triangles.iter().map(bounds).collect();
        let grid = CellGrid::new(&boxes, cell);
        let this = &*self;
        let of_triangle = |index: usize| {
            let mut near = Near::default();
            for other in grid.overlapping(index as u32, &boxes) {
                this.add(&this.triangles[index], &this.triangles[other as usize], places, range, &mut near);
            }
            near
        };
        let found: Vec<Near> =
            (0..self.triangles.len()).into_par_iter().with_min_len(256).map(of_triangle).collect();
        self.near = Near::default();
        for near in found {
            self.near.pairs.extend(near.pairs);
            self.near.tangles.extend(near.tangles);
        }
    }

    fn add(&self, one: &Owner, other: &Owner, places: &[DVec3], range: f64, near: &mut Near) {
        if one.corners.iter().any(|corner| other.corners.contains(corner)) {
            return;
        }
        // Where two triangles have gone through each other neither knows its side any more: holding them there would only pull
        // the tangle tighter.
        let before = near.tangles.len();
        near.tangles.extend(Tangle::between(&one.corners, &other.corners, places).chain(Tangle::between(
            &other.corners,
            &one.corners,
            places,
        )));
        if near.tangles.len() > before {
            return;
        }
        for (from, to) in [(one, other), (other, one)] {
            near.pairs.extend(
                from.own_corners().filter_map(|particle| self.face(particle, to.corners, places, range)),
            );
        }
        for first in one.own_edges() {
            near.pairs
                .extend(other.own_edges().filter_map(|second| self.crossing(first, second, places, range)));
        }
    }

    fn face(&self, particle: u32, corners: [u32; 3], places: &[DVec3], range: f64) -> Option<Pair> {
        let [a, b, c] = corners.map(|corner| places[corner as usize]);
        let (place, grow) = (places[particle as usize], DVec3::splat(range));
        if place.cmplt(a.min(b).min(c) - grow).any() || place.cmpgt(a.max(b).max(c) + grow).any() {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let height = (place - a).dot(normal);
        if height * height > range * range * normal.length_squared() || self.adjoin(particle, &corners) {
            return None;
        }
        let side = if height < 0.0 { -1.0 } else { 1.0 };
        Some(Pair::Face { particle, corners, side, apart: self.thickness })
    }

    /// Whether a particle is, or shares a triangle with, one of those.
    fn adjoin(&self, particle: u32, others: &[u32]) -> bool {
        let near = &self.neighbours[self.sewn[particle as usize] as usize];
        others.iter().any(|other| near.contains(&self.sewn[*other as usize]))
    }

    fn crossing(&self, first: [u32; 2], second: [u32; 2], places: &[DVec3], range: f64) -> Option<Pair> {
        let [a, b] = first.map(|end| places[end as usize]);
        let [c, d] = second.map(|end| places[end as usize]);
        if (a.min(b) - DVec3::splat(range)).cmpgt(c.max(d)).any()
            || (a.max(b) + DVec3::splat(range)).cmplt(c.min(d)).any()
        {
            return None;
        }
        let (s, t) = nearest_on_edges(a, b, c, d)?;
        let between = a.lerp(b, s) - c.lerp(d, t);
        if between.length_squared() > range * range
            || self.adjoin(first[0], &second)
            || self.adjoin(first[1], &second)
        {
            return None;
        }
        let direction = between.try_normalize()?;
        Some(Pair::Edges { first, second, direction, apart: self.thickness })
    }

    /// Whether the cloth was found to go through itself.
    pub(super) fn tangled(&self) -> bool {
        !self.near.tangles.is_empty()
    }

    /// Draws apart what has gone through itself; `step` in seconds.
    pub(super) fn untangle(&self, points: &Points, inverse_mass: &[f64], step: f64) {
        self.near.tangles.iter().for_each(|tangle| tangle.pull(points, inverse_mass, step));
    }

    /// Keeps every pair apart. `before`: places at the step's start, for friction.
    pub(super) fn solve(&self, points: &Points, before: &[DVec3], inverse_mass: &[f64], friction: f64) {
        let touching = |pair: &&Pair| touch(pair, points).is_some();
        let active: Vec<&Pair> = if self.near.pairs.len() < 4096 {
            self.near.pairs.iter().filter(touching).collect()
        } else {
            self.near.pairs.par_iter().with_min_len(1024).filter(touching).collect()
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
        let slid: DVec3 = (0..4)
            .map(|i| (points.get(self.particles[i]) - before[self.particles[i] as usize]) * self.weights[i])
            .sum();
        let slid = slid.reject_from_normalized(self.normal);
        let length = slid.length();
        if length > 0.0 {
            let back = (friction * self.depth / length).min(1.0);
            self.shift(points, &w, slid * (-back / weight));
        }
    }

    fn shift(&self, points: &Points, w: &[f64; 4], by: DVec3) {
        for ((particle, weight), w) in self.particles.iter().zip(self.weights).zip(w) {
            points.shift(*particle, by * (w * weight));
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
            let (normal, depth) = if length < 1e-9 || upright < 0.0 {
                (direction, apart - upright)
            } else {
                (between / length, apart - length)
            };
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

//! Contact of the cloth with itself.
//!
//! Pairs of a particle and a triangle, and of two edges, that are near each other are found once in a while, with the
//! side on which they lie; until the next time they are kept apart on that side (Bridson, Fedkiw and Anderson 2002, sections 6 and 7).

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use rayon::prelude::*;

use super::grid::CellGrid;
use super::model::Model;
use super::points::Points;
use super::tangle::Tangle;

/// What may touch before the next search.
#[derive(Debug, Clone, Copy)]
enum Pair {
    /// A particle near a triangle: on the side of its normal where `side` is 1, else on the other; `over` where it was
    /// above or below the triangle when it was found.
    Face { particle: u32, corners: [u32; 3], side: f64, over: bool, apart: f64 },
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
    /// Whether seams are still to close.
    sewing: bool,
    near: Near,
    crossed: Crossed,
}

/// What a search finds.
#[derive(Debug, Default)]
struct Near {
    pairs: Vec<Pair>,
    tangles: Vec<Tangle>,
}

/// Pairs that have got past each other although they were kept apart: they keep the sides that they had.
#[derive(Debug, Default)]
struct Crossed {
    faces: HashMap<(u32, [u32; 3]), f64>,
    edges: HashMap<([u32; 2], [u32; 2]), DVec3>,
}

impl Crossed {
    fn new(pairs: &[Pair], points: &Points) -> Self {
        let past = |pair: &&Pair| touch(pair, points).is_some_and(|touch| touch.depth > pair.apart());
        let past: Vec<&Pair> = pairs.par_iter().with_min_len(1024).filter(past).collect();
        let mut crossed = Self::default();
        for pair in past {
            match *pair {
                Pair::Face { particle, corners, side, over: true, .. } => {
                    crossed.faces.insert((particle, corners), side);
                }
                // It came in from beside the triangle: it may have gone round it.
                Pair::Face { .. } => {}
                Pair::Edges { first, second, direction, .. } => {
                    crossed.edges.insert((first, second), direction);
                }
            }
        }
        crossed
    }

    fn holds(&self, pair: &Pair) -> bool {
        match pair {
            Pair::Face { particle, corners, .. } => self.faces.contains_key(&(*particle, *corners)),
            Pair::Edges { first, second, .. } => self.edges.contains_key(&(*first, *second)),
        }
    }
}

impl Pair {
    fn apart(&self) -> f64 {
        match self {
            Self::Face { apart, .. } | Self::Edges { apart, .. } => *apart,
        }
    }
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
/// The least distance that parts of one fold are kept apart, in thicknesses.
const LEAST_APART: f64 = 0.2;
/// Layers that are too near are pushed apart no faster, metres per second.
const MOST_PUSH: f64 = 0.3;
/// The share of what sewn layers are too near by that they are pushed apart in a step. All at once, layers that have no room would throw
/// each other to and fro for ever.
const PUSHED_SHARE: f64 = 0.1;

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
        let sewing = sewn.iter().enumerate().any(|(particle, sewn)| particle as u32 != *sewn);
        Self {
            triangles,
            sewn,
            neighbours,
            thickness,
            sewing,
            near: Near::default(),
            crossed: Crossed::default(),
        }
    }

    /// Finds all pairs that are within the thickness and `reach`, metres.
    pub(super) fn search(&mut self, model: &Model, points: &Points, reach: f64) {
        self.crossed = Crossed::new(&self.near.pairs, points);
        let places = &points.to_vec()[..];
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
            grid.overlapping(index as u32, &boxes, |other| {
                this.add(&this.triangles[index], &this.triangles[other as usize], places, range, &mut near);
            });
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
        let mut tangled = false;
        if !one.corners.iter().any(|corner| other.corners.contains(corner)) {
            let before = near.tangles.len();
            near.tangles.extend(
                Tangle::between(&one.corners, &other.corners, places).chain(Tangle::between(
                    &other.corners,
                    &one.corners,
                    places,
                )),
            );
            tangled = near.tangles.len() > before;
        }
        // Where two triangles have gone through each other, who does not know its side from before does not know it now:
        // holding it there would only pull the tangle tighter.
        let mut push = |pair: Option<Pair>| {
            near.pairs.extend(pair.filter(|pair| !tangled || self.crossed.holds(pair)));
        };
        for (from, to) in [(one, other), (other, one)] {
            from.own_corners().for_each(|corner| push(self.face(corner, to.corners, places, range)));
        }
        for first in one.own_edges() {
            other.own_edges().for_each(|second| push(self.crossing(first, second, places, range)));
        }
    }

    fn face(&self, particle: u32, corners: [u32; 3], places: &[DVec3], range: f64) -> Option<Pair> {
        if self.share(&[particle], &corners) {
            return None;
        }
        let [a, b, c] = corners.map(|corner| places[corner as usize]);
        let (place, grow) = (places[particle as usize], DVec3::splat(range));
        if place.cmplt(a.min(b).min(c) - grow).any() || place.cmpgt(a.max(b).max(c) + grow).any() {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let (height, length2) = ((place - a).dot(normal), normal.length_squared());
        if height * height > range * range * length2 || is_beside(place, [a, b, c], normal, range) {
            return None;
        }
        let apart = self.apart(&[particle], &corners, height.abs() / length2.sqrt().max(1e-12))?;
        let found = if height < 0.0 { -1.0 } else { 1.0 };
        let side = self.crossed.faces.get(&(particle, corners)).copied().unwrap_or(found);
        let over =
            shares(place, [a, b, c]).is_some_and(|shares| shares.into_iter().all(|share| share >= 0.0));
        Some(Pair::Face { particle, corners, side, over, apart })
    }

    /// Whether some are the same particle once all is sewn.
    fn share(&self, some: &[u32], others: &[u32]) -> bool {
        let sewn = |particle: &u32| self.sewn[*particle as usize];
        some.iter().any(|one| others.iter().any(|other| sewn(one) == sewn(other)))
    }

    /// How far to keep apart what is at `distance` now, metres. Where there is a triangle's edge between the two, cloth that is folded
    /// is nearer than its thickness: it is only kept from getting nearer, and not at all from being sewn.
    fn apart(&self, some: &[u32], others: &[u32], distance: f64) -> Option<f64> {
        let adjoin = |one: &u32| {
            let near = &self.neighbours[self.sewn[*one as usize] as usize];
            others.iter().any(|other| near.contains(&self.sewn[*other as usize]))
        };
        if !some.iter().any(adjoin) {
            return Some(self.thickness);
        }
        (!self.sewing).then(|| distance.clamp(LEAST_APART * self.thickness, self.thickness))
    }

    fn crossing(&self, first: [u32; 2], second: [u32; 2], places: &[DVec3], range: f64) -> Option<Pair> {
        if self.share(&first, &second) {
            return None;
        }
        let [a, b] = first.map(|end| places[end as usize]);
        let [c, d] = second.map(|end| places[end as usize]);
        if (a.min(b) - DVec3::splat(range)).cmpgt(c.max(d)).any()
            || (a.max(b) + DVec3::splat(range)).cmplt(c.min(d)).any()
        {
            return None;
        }
        let (s, t) = nearest_on_edges(a, b, c, d)?;
        let between = a.lerp(b, s) - c.lerp(d, t);
        if between.length_squared() > range * range {
            return None;
        }
        let apart = self.apart(&first, &second, between.length())?;
        let found = between.try_normalize()?;
        let direction = self.crossed.edges.get(&(first, second)).copied().unwrap_or(found);
        Some(Pair::Edges { first, second, direction, apart })
    }

    /// Whether the cloth was found to go through itself.
    pub(super) fn tangled(&self) -> bool {
        !self.near.tangles.is_empty()
    }

    /// Whether seams are still to close.
    pub(super) fn closing(&self) -> bool {
        self.sewing
    }

    /// Draws apart what has gone through itself; `step` in seconds.
    pub(super) fn untangle(&self, points: &Points, inverse_mass: &[f64], step: f64) {
        self.near.tangles.iter().for_each(|tangle| tangle.pull(points, inverse_mass, step));
    }

    /// Keeps every pair apart, and tells which touched. `before`: places at the step's start; `step`: seconds.
    pub(super) fn solve(
        &self,
        points: &Points,
        before: &[DVec3],
        inverse_mass: &[f64],
        friction: f64,
        step: f64,
    ) -> Vec<Touch> {
        let touching = |pair: &&Pair| touch(pair, points).is_some();
        let active: Vec<&Pair> = if self.near.pairs.len() < 4096 {
            self.near.pairs.iter().filter(touching).collect()
        } else {
            self.near.pairs.par_iter().with_min_len(1024).filter(touching).collect()
        };
        let share = if self.sewing { 1.0 } else { PUSHED_SHARE };
        let resolve = |pair: &Pair| {
            let touch = touch(pair, points)?;
            touch.resolve(points, before, inverse_mass, friction, (share, MOST_PUSH * step));
            Some(touch)
        };
        active.into_iter().filter_map(resolve).collect()
    }
}

/// Four particles that are too near: `sum weights x` is too short along `normal` by `depth`.
#[derive(Debug)]
pub(super) struct Touch {
    particles: [u32; 4],
    weights: [f64; 4],
    normal: DVec3,
    depth: f64,
}

impl Touch {
    /// Takes back what brought the four nearer in this step, pushes them apart by a `share` of what is left, `most_push` at most,
    /// metres, and takes back sliding up to the friction's share (Mueller and others 2007; Macklin and others 2014, section 6.1).
    fn resolve(
        &self,
        points: &Points,
        before: &[DVec3],
        inverse_mass: &[f64],
        friction: f64,
        (share, most_push): (f64, f64),
    ) {
        let w = self.particles.map(|particle| inverse_mass[particle as usize]);
        let weight = self.weight(&w);
        if weight <= 0.0 {
            return;
        }
        let moved = self.moved(points, before);
        let nearer = (-moved.dot(self.normal)).clamp(0.0, self.depth);
        let push = nearer + (share * (self.depth - nearer)).min(most_push);
        self.shift(points, &w, self.normal * (push / weight));
        let slid = moved.reject_from_normalized(self.normal);
        let length = slid.length();
        if length > 0.0 {
            let back = (friction * push / length).min(1.0);
            self.shift(points, &w, slid * (-back / weight));
        }
    }

    /// What touches moves neither nearer nor, by having been pushed, apart: takes that from the velocities (Mueller and others 2020,
    /// "Detailed rigid body simulation with extended position based dynamics", section 3.6, without bouncing). Cloth that is
    /// `tangled` while its seams close has to get back through itself: there only what moves apart is held.
    pub(super) fn calm(&self, velocities: &mut [DVec3], inverse_mass: &[f64], tangled: bool) {
        let w = self.particles.map(|particle| inverse_mass[particle as usize]);
        let weight = self.weight(&w);
        let apart: DVec3 =
            self.particles.iter().zip(self.weights).map(|(p, a)| velocities[*p as usize] * a).sum();
        let speed = apart.dot(self.normal);
        if weight <= 0.0 || (tangled && speed < 0.0) {
            return;
        }
        for ((particle, a), w) in self.particles.iter().zip(self.weights).zip(w) {
            velocities[*particle as usize] -= self.normal * (speed / weight * w * a);
        }
    }

    /// What the four weigh against being moved apart, 1/kilograms.
    fn weight(&self, w: &[f64; 4]) -> f64 {
        w.iter().zip(self.weights).map(|(w, a)| w * a * a).sum()
    }

    /// How far the four moved against each other in this step.
    fn moved(&self, points: &Points, before: &[DVec3]) -> DVec3 {
        (0..4)
            .map(|i| (points.get(self.particles[i]) - before[self.particles[i] as usize]) * self.weights[i])
            .sum()
    }

    fn shift(&self, points: &Points, w: &[f64; 4], by: DVec3) {
        for ((particle, weight), w) in self.particles.iter().zip(self.weights).zip(w) {
            points.shift(*particle, by * (w * weight));
        }
    }
}

fn touch(pair: &Pair, points: &Points) -> Option<Touch> {
    match *pair {
        Pair::Face { particle, corners, side, apart, .. } => {
            let [a, b, c] = corners.map(|corner| points.get(corner));
            let place = points.get(particle);
            let normal = (b - a).cross(c - a).try_normalize()? * side;
            let depth = apart - (place - a).dot(normal);
            if depth <= 0.0 || depth > 2.0 * apart {
                return None;
            }
            let [at_a, at_b, at_c] = shares(place, [a, b, c])?;
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

/// Whether a place lies farther than `range` from a triangle, seen along its `normal`.
fn is_beside(place: DVec3, [a, b, c]: [DVec3; 3], normal: DVec3, range: f64) -> bool {
    let outside = |start: DVec3, end: DVec3| {
        let outwards = (end - start).cross(normal);
        let distance = (place - start).dot(outwards);
        distance > 0.0 && distance * distance > range * range * outwards.length_squared()
    };
    outside(a, b) || outside(b, c) || outside(c, a)
}

/// Barycentric coordinates of a place's projection on a triangle's plane.
fn shares(place: DVec3, [a, b, c]: [DVec3; 3]) -> Option<[f64; 3]> {
    let area = (b - a).cross(c - a);
    let square = area.length_squared();
    if square < 1e-20 {
        return None;
    }
    let at_b = (place - a).cross(c - a).dot(area) / square;
    let at_c = (b - a).cross(place - a).dot(area) / square;
    Some([1.0 - at_b - at_c, at_b, at_c])
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

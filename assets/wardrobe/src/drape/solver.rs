//! Position-based dynamics in small steps.
//!
//! XPBD (Macklin, Mueller and Chentanez 2016) with many substeps and one pass over the constraints in each (Macklin and others
//! 2019, "Small steps in physics simulation"): so multipliers start at zero and need not be kept.

use glam::DVec3;
use rayon::prelude::*;

use super::hinge::Hinge;
use super::layers::Layers;
use super::model::Model;
use super::points::Points;
use crate::body::Body;

/// Particles that a thread takes at a time.
const CHUNK: usize = 1024;
/// Contacts are looked for anew once a particle has moved as far as the fastest will in so many substeps, but at least as the pace says, and
/// at most so many mean edges and so many metres.
const FREE_SUBSTEPS: f64 = 12.0;
const MOST_FREE_PATH: f64 = 0.25;
const FARTHEST_FREE_PATH: f64 = 0.004;
/// As long as the cloth is tangled a search is good for so many substeps.
const TANGLED_SUBSTEPS: usize = 16;
/// A particle farther from the origin has been thrown out by a fault, metres.
const FARTHEST: f64 = 50.0;

/// How fast cloth may move, and how far before contacts are looked for anew.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// No particle is faster, metres per second.
    most_speed: f64,
    /// Mean edges.
    least_free_path: f64,
}

impl Pace {
    /// Of cloth that falls into its place.
    const QUICK: Self = Self { most_speed: 1.5, least_free_path: 0.04 };
    /// Of fine cloth that is in its place but for its folds: searches, which take it as long as ten substeps, become rare, and still
    /// find no flat cloth's neighbours.
    pub(super) const SLOW: Self = Self { most_speed: 0.075, least_free_path: 0.15 };
}

/// How the world acts in a phase.
#[derive(Debug, Clone, Copy)]
pub(super) struct Conditions {
    /// Downwards, metres per second squared.
    pub(super) gravity: f64,
    /// Share of the speed lost per second, by the air: 1/seconds.
    pub(super) drag: f64,
    /// Factor on the membrane's compliances: above 1 the cloth is stretchier than it is.
    pub(super) softness: f64,
}

/// Two particles drawn together, or kept one layer apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thread {
    pub(super) ends: [u32; 2],
    /// The longest it may be now, metres.
    pub(super) most: f64,
}

/// Energies of the whole garment, joules.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Energy {
    /// Of motion.
    pub kinetic: f64,
    /// Of stretch, shear and bending.
    pub elastic: f64,
    /// Of height, from y = 0.
    pub height: f64,
}

impl Energy {
    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.height
    }
}

/// A plane that a particle may not pass: the body near it.
#[derive(Debug, Clone, Copy)]
struct Plane {
    normal: DVec3,
    /// `normal . x` on it.
    offset: f64,
}

/// The cloth in motion.
#[derive(Debug)]
pub(super) struct Solver<'a> {
    pub(super) model: &'a Model,
    body: &'a Body,
    margin: f64,
    pub(super) points: Points,
    velocities: Vec<DVec3>,
    before: Vec<DVec3>,
    free_path: f64,
    /// Places at the last search for contacts.
    searched: Vec<DVec3>,
    since_search: usize,
    planes: Vec<Option<Plane>>,
    layers: Layers,
    pub(super) threads: Vec<Thread>,
    /// Per hinge, where the cloth's own friction holds it; empty as long as that is left out.
    held: Vec<f64>,
    pub(super) pace: Pace,
    /// Seconds per substep.
    pub(super) step: f64,
    /// Places are no longer numbers that mean something.
    pub(super) blown_up: bool,
}

impl<'a> Solver<'a> {
    /// Cloth at rest at `places`; kept `margin` off the body, metres, and off itself by `layers`; `step` in seconds.
    pub(super) fn new(
        model: &'a Model,
        body: &'a Body,
        places: &[DVec3],
        margin: f64,
        layers: Layers,
        step: f64,
    ) -> Self {
        let mut solver = Self {
            model,
            body,
            margin,
            points: Points::new(places),
            velocities: vec![DVec3::ZERO; places.len()],
            before: places.to_vec(),
            free_path: 0.0,
            searched: Vec::new(),
            since_search: 0,
            planes: Vec::new(),
            layers,
            threads: Vec::new(),
            held: Vec::new(),
            pace: Pace::QUICK,
            step,
            blown_up: false,
        };
        solver.search();
        solver
    }

    /// One substep.
    pub(super) fn advance(&mut self, conditions: Conditions) {
        if self.blown_up {
            return;
        }
        self.predict(conditions);
        self.since_search += 1;
        if self.wandered() || (self.layers.tangled() && self.since_search >= TANGLED_SUBSTEPS) {
            self.search();
        }
        let (points, inverse_mass, step) = (&self.points, &self.model.inverse_mass, self.step);
        let membranes = &self.model.membranes;
        membranes.for_each(|_, membrane| membrane.solve(points, inverse_mass, conditions.softness, step));
        let held = |index: usize| self.held.get(index).copied();
        self.model.hinges.for_each(|index, hinge| hinge.solve(points, inverse_mass, step, held(index)));
        for thread in &self.threads {
            thread.solve(points, inverse_mass);
        }
        self.layers.untangle(points, inverse_mass, step);
        let touches = self.layers.solve(points, &self.before, inverse_mass, self.model.friction, step);
        self.rest_on_body();
        let tangled = self.layers.closing() && self.layers.tangled();
        touches.iter().for_each(|touch| touch.calm(&mut self.velocities, &self.model.inverse_mass, tangled));
    }

    /// Takes all motion away.
    pub(super) fn stop(&mut self) {
        self.velocities.fill(DVec3::ZERO);
    }

    /// Lets the cloth's own friction hold its bends as they are.
    pub(super) fn hold_bends(&mut self) {
        let held = |hinge: &Hinge| hinge.held(&self.points, None);
        self.held = self.model.hinges.all().par_iter().with_min_len(CHUNK).map(held).collect();
    }

    /// Lets bends slip that have gone too far from where they are held. To be called now and then.
    pub(super) fn slip_bends(&mut self) {
        let points = &self.points;
        let hinges = self.model.hinges.all().par_iter().with_min_len(CHUNK);
        let held = self.held.par_iter_mut().zip(hinges);
        held.for_each(|(held, hinge)| *held = hinge.held(points, Some(*held)));
    }

    /// Moves by the velocity of the last substep, after gravity and drag.
    fn predict(&mut self, conditions: Conditions) {
        let step = self.step;
        let most_speed = self.pace.most_speed;
        let kept = (-conditions.drag * step).exp();
        let (points, inverse_mass) = (&self.points, &self.model.inverse_mass);
        let chunks = self.velocities.par_chunks_mut(CHUNK).zip(self.before.par_chunks_mut(CHUNK)).enumerate();
        chunks.for_each(|(chunk, (velocities, before))| {
            for ((velocity, before), particle) in
                velocities.iter_mut().zip(before).zip((chunk * CHUNK) as u32..)
            {
                if inverse_mass[particle as usize] == 0.0 {
                    *velocity = DVec3::ZERO;
                    continue;
                }
                *velocity = ((*velocity - DVec3::Y * (conditions.gravity * step)) * kept)
                    .clamp_length_max(most_speed);
                *before = points.get(particle);
                points.set(particle, *before + *velocity * step);
            }
        });
    }

    fn wandered(&self) -> bool {
        let far = self.free_path * self.free_path;
        let moved = |(particle, searched): (usize, &DVec3)| {
            let moved = self.points.get(particle as u32).distance_squared(*searched);
            moved.is_nan() || moved > far
        };
        self.searched.par_iter().enumerate().with_min_len(CHUNK).any(moved)
    }

    /// Finds what each particle may touch until it has moved by the free path.
    fn search(&mut self) {
        self.searched = self.points.to_vec();
        self.since_search = 0;
        self.blown_up |= !self.searched.iter().all(|place| place.abs().max_element() < FARTHEST);
        if self.blown_up {
            return;
        }
        let edge = self.model.edge_length;
        let most = (MOST_FREE_PATH * edge).min(FARTHEST_FREE_PATH);
        self.free_path =
            (FREE_SUBSTEPS * self.step * self.fastest()).max(self.pace.least_free_path * edge).min(most);
        let (body, margin, reach) = (self.body, self.margin, self.margin + 1.5 * self.free_path);
        let plane = |place: &DVec3| {
            let (distance, normal) = body.surface(*place);
            (distance < reach).then(|| Plane { normal, offset: normal.dot(*place) - distance + margin })
        };
        self.planes = self.searched.par_iter().with_min_len(CHUNK).map(plane).collect();
        self.layers.search(self.model, &self.points, 2.0 * self.free_path);
    }

    /// Keeps particles off the body, with friction, and takes the velocities from the way made.
    fn rest_on_body(&mut self) {
        let (points, planes, before) = (&self.points, &self.planes, &self.before);
        let (friction, rate) = (self.model.friction, 1.0 / self.step);
        self.velocities.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, velocities)| {
            for (velocity, particle) in velocities.iter_mut().zip((chunk * CHUNK) as u32..) {
                let index = particle as usize;
                let place = points.get(particle);
                let Some(plane) = planes[index].filter(|plane| plane.depth(place) > 0.0) else {
                    *velocity = (place - before[index]) * rate;
                    continue;
                };
                let place = plane.keep_off(place, before[index], friction);
                points.set(particle, place);
                // Being pushed out is no motion to go on with.
                *velocity = ((place - before[index]) * rate).reject_from_normalized(plane.normal);
            }
        });
    }

    /// The largest distance of a particle from where it was, metres.
    pub(super) fn farthest_from(&self, places: &[DVec3]) -> f64 {
        let moved = places
            .iter()
            .enumerate()
            .map(|(particle, place)| self.points.get(particle as u32).distance_squared(*place));
        moved.fold(0.0, f64::max).sqrt()
    }

    /// The fastest particle's speed, metres per second.
    fn fastest(&self) -> f64 {
        self.velocities.iter().map(|velocity| velocity.length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// The energies now.
    pub(super) fn energy(&self, gravity: f64) -> Energy {
        let model = self.model;
        let kinetic =
            model.mass.iter().zip(&self.velocities).map(|(mass, v)| 0.5 * mass * v.length_squared()).sum();
        let stretch: f64 = model.membranes.all().iter().map(|membrane| membrane.energy(&self.points)).sum();
        let bending: f64 = model.hinges.all().iter().map(|hinge| hinge.energy(&self.points)).sum();
        let height =
            model.mass.iter().enumerate().map(|(i, mass)| mass * gravity * self.points.get(i as u32).y).sum();
        Energy { kinetic, elastic: stretch + bending, height }
    }
}

impl Plane {
    /// How far a place is behind it, metres.
    fn depth(&self, place: DVec3) -> f64 {
        self.offset - self.normal.dot(place)
    }

    /// Brings a place from behind it onto it.
    fn keep_off(&self, place: DVec3, before: DVec3, friction: f64) -> DVec3 {
        let depth = self.depth(place);
        let place = place + self.normal * depth;
        let slid = (place - before).reject_from_normalized(self.normal);
        let length = slid.length();
        if length <= friction * depth { place - slid } else { place - slid * (friction * depth / length) }
    }
}

impl Thread {
    fn solve(&self, points: &Points, inverse_mass: &[f64]) {
        let [a, b] = self.ends.map(|end| points.get(end));
        let [wa, wb] = self.ends.map(|end| inverse_mass[end as usize]);
        let between = b - a;
        let length = between.length();
        if length > self.most && wa + wb > 0.0 {
            let pull = between * ((1.0 - self.most / length) / (wa + wb));
            points.set(self.ends[0], a + pull * wa);
            points.set(self.ends[1], b - pull * wb);
        }
    }
}

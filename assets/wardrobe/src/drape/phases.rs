//! From pieces in the air to a garment at rest.

use amc_core::{Error, Progress, Result};
use glam::DVec3;

use super::layers::Layers;
use super::model::Model;
use super::solver::{Conditions, Energy, Pace, Solver, Thread};
use super::{Draped, place, sewing};
use crate::body::Body;
use crate::cut::{At, CutGarment, JoinKind};

/// How a garment is draped.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How far the cloth keeps off the body, metres.
    pub margin: f64,
    /// How far layers keep off each other, metres; at least a fifth and at most half of a triangle's edge.
    pub layer: f64,
    /// Substep, seconds per metre of the triangles' edges: one pass over the constraints makes the cloth stretch under its own
    /// weight by about `rows step^2 gravity / edge`, so finer cloth needs shorter steps.
    pub step: f64,
    /// How long seams take to close, seconds of the cloth's time.
    pub sewing: f64,
    /// How long the coarsest cloth may take to fall and come to rest, seconds.
    pub falling: f64,
    /// How long a finer cloth may take to come to rest from where the coarser one did, seconds per metre of its edges.
    pub relaxing: f64,
    /// Cloth with shorter edges, metres, is fine: it only smooths the folds in which the coarser one came to rest, and its own friction
    /// holds them.
    pub fine: f64,
    /// At rest no particle is faster, metres per second.
    pub rest_speed: f64,
    /// Metres per second squared.
    pub gravity: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            margin: 0.0025,
            layer: 0.0025,
            step: 1.0 / 30.0,
            sewing: 0.6,
            falling: 6.0,
            relaxing: 500.0,
            fine: 0.008,
            rest_speed: 0.005,
            gravity: 9.81,
        }
    }
}

/// How a garment came to rest.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rest {
    /// Substeps of the last level.
    pub substeps: usize,
    /// The fastest particle's speed at the end, over a sixtieth of a second, metres per second.
    pub fastest: f64,
    /// Energies of the last level, from its start, every sixtieth of a second.
    pub energies: Vec<Energy>,
}

impl Rest {
    /// Whether the fastest particle is slow enough.
    #[must_use]
    pub fn is_still(&self, options: &Options) -> bool {
        self.fastest <= options.rest_speed
    }
}

/// Bounds of the distance between layers, in mean edges.
const LEAST_LAYER: f64 = 0.2;
const MOST_LAYER: f64 = 0.5;
/// Between two looks at energies and speeds, seconds.
const FRAME: f64 = 1.0 / 60.0;
/// Cloth is still once it has been so for as many looks.
const STILL_FRAMES: usize = 6;
/// Drag of the air while seams settle, and then, 1/seconds. The folds of a skirt sway with a period of about 2.5 s: a drag of twice its
/// angular frequency ends that soonest.
const SETTLING_DRAG: f64 = 10.0;
const DRAG: f64 = 5.0;
/// Substeps in which fine cloth smooths the creases between the coarser one's triangles, before its own friction would hold them, and the
/// drag meanwhile.
const SMOOTHING: usize = 1200;
const SMOOTHING_DRAG: f64 = 40.0;
/// Drag once fine cloth is held by its own friction: what is left are short, quick waves.
const HELD_DRAG: f64 = 20.0;
/// How much stretchier the cloth is while it is sewn.
const SEWING_SOFTNESS: f64 = 20.0;
/// Seconds in which gravity comes and softness goes after sewing.
const SETTLING: f64 = 0.3;

/// Places, sews and drapes.
pub(super) fn sew_and_drape(
    garment: &CutGarment,
    body: &Body,
    options: &Options,
    progress: &Progress<'_>,
) -> Result<(Draped, Rest)> {
    let placed = place::place(garment, body, options.margin)?;
    let sewn = sewing::sew(garment, &placed, body, options, SEWING_SOFTNESS, progress)?;
    settle_and_drape(garment, &sewn, body, options, SEWING_SOFTNESS, progress)
}

/// Goes on from where a coarser cut came to rest.
pub(super) fn relax(
    garment: &CutGarment,
    start: &[Vec<DVec3>],
    body: &Body,
    options: &Options,
    progress: &Progress<'_>,
) -> Result<(Draped, Rest)> {
    let mut start = start.to_vec();
    start.iter_mut().flatten().for_each(|place| place::push_out(place, body, options.margin));
    settle_and_drape(garment, &start, body, options, 1.0, progress)
}

fn is_fine(model: &Model, options: &Options) -> bool {
    model.edge_length < options.fine
}

fn pairs(garment: &CutGarment, kind: JoinKind) -> impl Iterator<Item = (At, At)> {
    let joins = garment.joins.iter().filter(move |join| join.kind == kind);
    joins.flat_map(|join| join.pairs.iter().copied())
}

/// Which vertices become one.
pub(super) fn sewn_pairs(garment: &CutGarment) -> Vec<(At, At)> {
    pairs(garment, JoinKind::Sewn).collect()
}

/// How far layers keep off each other, metres.
pub(super) fn layer(model: &Model, options: &Options) -> f64 {
    options.layer.max(LEAST_LAYER * model.edge_length).min(MOST_LAYER * model.edge_length)
}

/// A garment without motion. `sewn`: per particle, what it is once all seams are sewn.
pub(super) fn solver<'a>(
    model: &'a Model,
    sewn: Vec<u32>,
    start: &[Vec<DVec3>],
    body: &'a Body,
    options: &Options,
) -> Solver<'a> {
    let layers = Layers::new(model, sewn, layer(model, options));
    let step = options.step * model.edge_length;
    Solver::new(model, body, &model.gather(start), options.margin, layers, step)
}

/// A garment whose seams are welded, without motion.
fn sewn<'a>(
    model: &'a Model,
    garment: &CutGarment,
    start: &[Vec<DVec3>],
    body: &'a Body,
    options: &Options,
) -> Solver<'a> {
    let mut solver = solver(model, (0..model.mass.len() as u32).collect(), start, body, options);
    let buttons =
        pairs(garment, JoinKind::Layered).map(|(one, other)| [model.particle(one), model.particle(other)]);
    solver.threads = buttons.map(|ends| Thread { ends, most: layer(model, options) }).collect();
    solver
}

/// Leaves a draped garment lying for some time, under the conditions in which it came to rest. Places do not tell how a fine one's own
/// friction holds it: that takes up its load first.
pub(super) fn linger(
    garment: &CutGarment,
    draped: &Draped,
    body: &Body,
    options: &Options,
    seconds: f64,
    progress: &Progress<'_>,
) -> Result<Rest> {
    let model = Model::new(garment, &sewn_pairs(garment));
    let mut solver = sewn(&model, garment, &draped.positions, body, options);
    if is_fine(&model, options) {
        solver.pace = Pace::SLOW;
        let seconds = options.relaxing * model.edge_length;
        hold(&mut solver, options, "taking hold", seconds, &mut Rest::default(), progress)?;
        solver.stop();
    }
    let mut rest = Rest { energies: vec![solver.energy(options.gravity)], ..Rest::default() };
    let lying = Phase { stage: "lying", seconds, until_still: false };
    lying.run(&mut solver, options, &mut rest, |_| conditions(options), progress)?;
    Ok(rest)
}

/// Welds the seams and lets the garment fall until it is still.
fn settle_and_drape(
    garment: &CutGarment,
    start: &[Vec<DVec3>],
    body: &Body,
    options: &Options,
    softness: f64,
    progress: &Progress<'_>,
) -> Result<(Draped, Rest)> {
    let model = Model::new(garment, &sewn_pairs(garment));
    let mut solver = sewn(&model, garment, start, body, options);
    let mut rest = Rest::default();
    let coarsest = softness > 1.0;
    let fine = !coarsest && is_fine(&model, options);
    if coarsest {
        let settling = Phase { stage: "settling", seconds: SETTLING, until_still: false };
        let ramp = |share: f64| Conditions {
            gravity: options.gravity * share,
            drag: SETTLING_DRAG,
            softness: softness.powf(1.0 - share),
        };
        settling.run(&mut solver, options, &mut rest, ramp, progress)?;
    }
    if fine {
        solver.pace = Pace::SLOW;
        let seconds = SMOOTHING as f64 * solver.step;
        let smoothing = Phase { stage: "smoothing", seconds, until_still: false };
        let thick_air = Conditions { drag: SMOOTHING_DRAG, ..conditions(options) };
        smoothing.run(&mut solver, options, &mut rest, |_| thick_air, progress)?;
    }
    let (stage, seconds) = if coarsest {
        ("falling", options.falling)
    } else {
        ("coming to rest, finer", options.relaxing * model.edge_length)
    };
    if fine {
        hold(&mut solver, options, stage, seconds, &mut rest, progress)?;
    } else {
        let falling = Phase { stage, seconds, until_still: true };
        falling.run(&mut solver, options, &mut rest, |_| conditions(options), progress)?;
    }
    Ok((Draped { positions: model.scatter(&solver.points.to_vec()) }, rest))
}

/// Lets fine cloth come to rest by its own friction, which begins to hold its bends as they are now.
fn hold(
    solver: &mut Solver<'_>,
    options: &Options,
    stage: &'static str,
    seconds: f64,
    rest: &mut Rest,
    progress: &Progress<'_>,
) -> Result<()> {
    solver.hold_bends();
    let conditions = Conditions { drag: HELD_DRAG, ..conditions(options) };
    Phase { stage, seconds, until_still: true }.run(solver, options, rest, |_| conditions, progress)
}

/// How the world is for a garment that is sewn.
fn conditions(options: &Options) -> Conditions {
    Conditions { gravity: options.gravity, drag: DRAG, softness: 1.0 }
}

pub(super) fn check(solver: &Solver<'_>) -> Result<()> {
    let what = "the cloth flew apart or fell off the body: look at its placement, its size and its stiffness";
    if solver.blown_up { Err(Error::invalid(what)) } else { Ok(()) }
}

/// A stretch of time under conditions of its own.
struct Phase {
    stage: &'static str,
    /// How long it lasts at most.
    seconds: f64,
    /// Whether it ends early once the cloth has been still for [`STILL_FRAMES`].
    until_still: bool,
}

impl Phase {
    /// Runs it. `conditions` by the share of the time that has passed.
    fn run(
        &self,
        solver: &mut Solver<'_>,
        options: &Options,
        rest: &mut Rest,
        conditions: impl Fn(f64) -> Conditions,
        progress: &Progress<'_>,
    ) -> Result<()> {
        let substeps = (self.seconds / solver.step).ceil() as usize;
        let frame = (FRAME / solver.step).ceil() as usize;
        let mut before = solver.points.to_vec();
        let mut still_frames = 0;
        for substep in 0..substeps {
            solver.advance(conditions((substep + 1) as f64 / substeps as f64));
            rest.substeps += 1;
            if (substep + 1) % frame > 0 {
                continue;
            }
            progress.step(self.stage, substep + 1, substeps)?;
            check(solver)?;
            rest.fastest = solver.farthest_from(&before) / (frame as f64 * solver.step);
            before = solver.points.to_vec();
            solver.slip_bends();
            rest.energies.push(solver.energy(options.gravity));
            still_frames = if rest.is_still(options) { still_frames + 1 } else { 0 };
            if self.until_still && still_frames >= STILL_FRAMES {
                break;
            }
        }
        Ok(())
    }
}

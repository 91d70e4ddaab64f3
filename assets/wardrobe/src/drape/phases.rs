//! From pieces in the air to a garment at rest.

use amc_core::{Error, Progress, Result};
use glam::DVec3;

use super::layers::Layers;
use super::model::Model;
use super::solver::{Conditions, Energy, Solver, Thread};
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
    /// How long the coarsest cloth falls, at most, seconds.
    pub falling: f64,
    /// How long it may take to come to rest after that, seconds.
    pub quieting: f64,
    /// How long a finer cloth falls from where the coarser one came to rest, and then at most quietens, seconds per metre of its edges.
    pub relaxing: [f64; 2],
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
            falling: 1.6,
            quieting: 1.2,
            relaxing: [40.0, 60.0],
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
/// Drag of the air while sewing, falling, relaxing on a finer level and quieting, 1/seconds.
const SEWING_DRAG: f64 = 10.0;
const FALLING_DRAG: f64 = 4.0;
const RELAXING_DRAG: f64 = 6.0;
const QUIETING_DRAG: f64 = 25.0;
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

/// A garment whose seams are welded, without motion.
fn sewn<'a>(
    model: &'a Model,
    garment: &CutGarment,
    start: &[Vec<DVec3>],
    body: &'a Body,
    options: &Options,
) -> Solver<'a> {
    let thickness = layer(model, options);
    let layers = Layers::new(model, (0..model.mass.len() as u32).collect(), thickness);
    let step = options.step * model.edge_length;
    let mut solver = Solver::new(model, body, &model.gather(start), options.margin, layers, step);
    let buttons =
        pairs(garment, JoinKind::Layered).map(|(one, other)| [model.particle(one), model.particle(other)]);
    solver.threads = buttons.map(|ends| Thread { ends, most: thickness }).collect();
    solver
}

/// Leaves a draped garment lying for some time, under the conditions in which it came to rest.
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
    let mut rest = Rest { energies: vec![solver.energy(options.gravity)], ..Rest::default() };
    let never_still = Options { rest_speed: -1.0, ..options.clone() };
    let quiet = |_| Conditions { gravity: options.gravity, drag: QUIETING_DRAG, softness: 1.0 };
    run(&mut solver, seconds, &never_still, &mut rest, quiet, ("lying", progress))?;
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
    let gravity = options.gravity;
    let coarsest = softness > 1.0;
    if coarsest {
        let ramp = |share: f64| Conditions {
            gravity: gravity * share,
            drag: SEWING_DRAG,
            softness: softness.powf(1.0 - share),
        };
        run(&mut solver, SETTLING, options, &mut rest, ramp, ("settling", progress))?;
    }
    let [falling, quieting] = if coarsest {
        [options.falling, options.quieting]
    } else {
        options.relaxing.map(|time| time * model.edge_length)
    };
    let almost_still = Options { rest_speed: 4.0 * options.rest_speed, ..options.clone() };
    let drag = if coarsest { FALLING_DRAG } else { RELAXING_DRAG };
    let fall = |_| Conditions { gravity, drag, softness: 1.0 };
    run(&mut solver, falling, &almost_still, &mut rest, fall, ("falling", progress))?;
    let quiet = |_| Conditions { gravity, drag: QUIETING_DRAG, softness: 1.0 };
    run(&mut solver, quieting, options, &mut rest, quiet, ("coming to rest", progress))?;
    Ok((Draped { positions: model.scatter(&solver.points.to_vec()) }, rest))
}

pub(super) fn check(solver: &Solver<'_>) -> Result<()> {
    let what = "the cloth flew apart or fell off the body: look at its placement, its size and its stiffness";
    if solver.blown_up { Err(Error::invalid(what)) } else { Ok(()) }
}

/// Runs a phase for `seconds`, or until the cloth is still.
fn run(
    solver: &mut Solver<'_>,
    seconds: f64,
    options: &Options,
    rest: &mut Rest,
    conditions: impl Fn(f64) -> Conditions,
    (stage, progress): (&str, &Progress<'_>),
) -> Result<()> {
    let substeps = (seconds / solver.step).ceil() as usize;
    let frame = (FRAME / solver.step).ceil() as usize;
    let mut before = solver.points.to_vec();
    for substep in 0..substeps {
        solver.advance(conditions((substep + 1) as f64 / substeps as f64));
        rest.substeps += 1;
        if (substep + 1) % frame == 0 {
            progress.step(stage, substep + 1, substeps)?;
            check(solver)?;
            rest.fastest = solver.farthest_from(&before) / (frame as f64 * solver.step);
            before = solver.points.to_vec();
            rest.energies.push(solver.energy(options.gravity));
            if rest.fastest <= options.rest_speed && substep > 2 * frame {
                break;
            }
        }
    }
    Ok(())
}

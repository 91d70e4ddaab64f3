//! Seams closed round the body.

use amc_core::{Error, Progress, Result};
use glam::DVec3;

use super::model::Model;
use super::phases::{Options, check, layer, sewn_pairs, solver};
use super::solver::{Conditions, Thread};
use crate::body::Body;
use crate::cut::{At, CutGarment, Join, JoinKind};

/// A seam wider than this after sewing has not closed, metres.
const CLOSED: f64 = 0.004;
/// Drag of the air, 1/seconds.
const DRAG: f64 = 10.0;

/// Closes the seams without weight and friction, late ones after the others. Each seam's threads shorten in the same time: to
/// nothing, or to one layer where it holds two layers together. `softness`: how much stretchier the cloth is meanwhile.
pub(super) fn sew(
    garment: &CutGarment,
    placed: &[Vec<DVec3>],
    body: &Body,
    options: &Options,
    softness: f64,
    progress: &Progress<'_>,
) -> Result<Vec<Vec<DVec3>>> {
    if garment.joins.is_empty() {
        return Ok(placed.to_vec());
    }
    let mut model = Model::new(garment, &[]);
    model.friction = 0.0;
    let welded = Model::new(garment, &sewn_pairs(garment));
    let identity = welded.particle_of.iter().flatten().copied().collect();
    let mut solver = solver(&model, identity, placed, body, options);
    let closings = closings(garment, &model, &solver.points.to_vec(), layer(&model, options));
    let substeps = (options.sewing / solver.step).ceil() as usize;
    let rounds = if closings.iter().any(|closing| closing.late) { 2 } else { 1 };
    let conditions = Conditions { gravity: 0.0, drag: DRAG, softness };
    for substep in 0..rounds * substeps + substeps / 4 {
        let time = (substep + 1) as f64 / substeps as f64;
        solver.threads = closings.iter().map(|closing| closing.thread(time)).collect();
        solver.advance(conditions);
        if substep % 64 == 0 {
            progress.step("sewing", substep, rounds * substeps)?;
        }
    }
    check(&solver)?;
    let places = solver.points.to_vec();
    closed(garment, &model, &places)?;
    Ok(model.scatter(&places))
}

/// A thread of a seam that is being closed.
struct Closing {
    ends: [u32; 2],
    /// Its length at first and in the end, metres.
    lengths: [f64; 2],
    /// Whether it waits for the others.
    late: bool,
}

impl Closing {
    /// The thread as it is at `time`: from 0 to 1 seams close, from 1 to 2 late ones.
    fn thread(&self, time: f64) -> Thread {
        let left = (1.0 + f64::from(u8::from(self.late)) - time).clamp(0.0, 1.0);
        let [first, last] = self.lengths;
        Thread { ends: self.ends, most: last + (first - last).max(0.0) * left }
    }
}

fn closings(garment: &CutGarment, model: &Model, places: &[DVec3], thickness: f64) -> Vec<Closing> {
    let of_join = |join: &Join| {
        let last = if join.kind == JoinKind::Sewn { 0.0 } else { thickness };
        let late = join.late;
        let closing = move |(one, other): &(At, At)| {
            let ends = [model.particle(*one), model.particle(*other)];
            let [a, b] = ends.map(|end| places[end as usize]);
            Closing { ends, lengths: [a.distance(b), last], late }
        };
        join.pairs.iter().map(closing).collect::<Vec<_>>()
    };
    garment.joins.iter().flat_map(of_join).collect()
}

/// Refuses a seam that stays open.
fn closed(garment: &CutGarment, model: &Model, places: &[DVec3]) -> Result<()> {
    let place = |at: At| places[model.particle(at) as usize];
    for join in garment.joins.iter().filter(|join| join.kind == JoinKind::Sewn) {
        for (one, other) in &join.pairs {
            let gap = place(*one).distance(place(*other));
            if gap.is_nan() || gap > CLOSED {
                let what = format!(
                    "the seam does not close: {:.1} mm stay open; place its pieces nearer to each other",
                    gap * 1e3
                );
                return Err(Error::invalid(what).at_element(format!("seam \"{}\"", join.name)));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn late_seams_stay_open_until_the_others_are_closed() {
        let most =
            |late: bool, time: f64| Closing { ends: [0, 1], lengths: [0.3, 0.002], late }.thread(time).most;
        assert!((most(false, 0.5) - 0.151).abs() < 1e-12);
        assert!((most(true, 0.5) - 0.3).abs() < 1e-12);
        assert!((most(false, 1.0) - 0.002).abs() < 1e-12);
        assert!((most(true, 1.5) - 0.151).abs() < 1e-12);
        assert!((most(true, 2.2) - 0.002).abs() < 1e-12);
    }

    #[test]
    fn layers_that_lie_close_are_not_drawn_apart_by_their_thread() {
        let near = Closing { ends: [0, 1], lengths: [0.001, 0.002], late: false };
        assert!((near.thread(0.0).most - 0.002).abs() < 1e-12);
    }
}

//! The solver against closed forms.

use std::f64::consts::PI;

use glam::DVec3;

use super::cloths;
use crate::body::{Body, Figure};
use crate::cut::CutGarment;
use crate::drape::layers::Layers;
use crate::drape::model::Model;
use crate::drape::points::Points;
use crate::drape::solver::{Conditions, Solver};
use crate::pattern::Placement;

const NOWHERE: Placement =
    Placement::Flat { point: [0.0; 2], at: [3.0, 2.0, 0.0], across: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0] };

fn strip(across: f64, up: f64, edge: f64) -> CutGarment {
    cloths::single(Figure::Ball, cloths::rectangle("strip", across, up, edge, NOWHERE))
}

fn layers(model: &Model) -> Layers {
    Layers::new(model, (0..model.mass.len() as u32).collect(), 0.0025)
}

fn places(garment: &CutGarment, map: impl Fn(f64, f64) -> DVec3) -> Vec<DVec3> {
    garment.pieces.iter().flat_map(|piece| piece.flat.iter().map(|flat| map(flat.x, flat.y))).collect()
}

/// A strip of density d, length L and modulus k, hung by its top, grows by `d g L^2 / (2 k)`.
#[test]
fn a_hanging_strip_stretches_as_its_modulus_says() {
    let mut garment = strip(0.06, 0.4, 0.02);
    garment.cloth.warp = 12.0;
    let mut model = Model::new(&garment, &[]);
    for top in &garment.pieces[0].lines["top"] {
        model.inverse_mass[*top as usize] = 0.0;
    }
    let body = Body::new(Figure::Ball);
    let start = places(&garment, |u, v| DVec3::new(3.0 + u, 2.0 + v, 0.0));
    let mut solver = Solver::new(&model, &body, &start, 0.0, layers(&model), 2.5e-4);
    for _ in 0..8000 {
        solver.advance(Conditions { gravity: 9.81, drag: 4.0, softness: 1.0 });
    }
    let bottom = &garment.pieces[0].lines["bottom"];
    let sunk = bottom.iter().map(|v| 2.0 - solver.points.get(*v).y).sum::<f64>() / bottom.len() as f64;
    let expected = garment.cloth.density * 9.81 * 0.4 * 0.4 / (2.0 * garment.cloth.warp);
    assert!((sunk / expected - 1.0).abs() < 0.06, "{sunk} m, expected {expected} m");
}

/// A plate of stiffness B bent to a radius r holds `B / (2 r^2)` per area.
#[test]
fn a_bent_sheet_holds_the_energy_of_a_plate_whichever_way_it_is_bent() {
    let garment = strip(0.8, 0.8, 0.01);
    let model = Model::new(&garment, &[]);
    let radius = 0.2;
    for degrees in [0.0f64, 25.0, 60.0, 90.0] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let bent = places(&garment, |u, v| {
            let (round, along) = (u * cosine + v * sine, v * cosine - u * sine);
            DVec3::new(radius * (round / radius).sin(), along, radius * (round / radius).cos())
        });
        let points = Points::new(&bent);
        let energy: f64 = model.hinges.all().iter().map(|hinge| hinge.energy(&points)).sum();
        let expected = garment.cloth.bending / (2.0 * radius * radius) * 0.64;
        assert!((energy / expected - 1.0).abs() < 0.08, "{degrees}: {energy} J, expected {expected} J");
    }
}

#[test]
fn a_fold_closes_to_the_side_it_is_told() {
    let mut garment = strip(0.1, 0.0866 * 2.0, 0.1);
    let rows = garment.pieces[0].flat.iter().filter(|flat| (flat.y - 0.0866).abs() < 1e-9).count();
    let first = garment.pieces[0].flat.iter().position(|flat| (flat.y - 0.0866).abs() < 1e-9).unwrap() as u32;
    garment.pieces[0].folds =
        vec![crate::cut::CutFold { vertices: (first..first + rows as u32).collect(), angle: 0.5 * PI }];
    let model = Model::new(&garment, &[]);
    let body = Body::new(Figure::Ball);
    let start = places(&garment, |u, v| DVec3::new(3.0 + u, 2.0 + v, 0.0));
    let mut solver = Solver::new(&model, &body, &start, 0.0, layers(&model), 1e-3);
    for _ in 0..4000 {
        solver.advance(Conditions { gravity: 0.0, drag: 8.0, softness: 1.0 });
    }
    let fold = solver.points.get(first).z;
    let top = solver.points.get(garment.pieces[0].lines["top"][0]).z;
    assert!(fold - top > 0.03, "the fold points to the right side, +z: {fold}, {top}");
}

#[test]
fn a_sheet_that_falls_on_another_stays_above_it() {
    let mut garment = strip(0.3, 0.3, 0.03);
    let mut upper = garment.pieces[0].clone();
    upper.name = "upper".to_owned();
    upper.flat.iter_mut().for_each(|flat| *flat *= 0.8);
    garment.pieces.push(upper);
    let mut model = Model::new(&garment, &[]);
    let lower = garment.pieces[0].flat.len();
    model.inverse_mass[..lower].fill(0.0);
    let body = Body::new(Figure::Ball);
    let mut start = places(&garment, |u, v| DVec3::new(3.0 + u, 2.0, -v));
    start[lower..].iter_mut().for_each(|place| *place += DVec3::new(0.033, 0.05, -0.027));
    let mut solver = Solver::new(&model, &body, &start, 0.0, layers(&model), 1e-3);
    for _ in 0..600 {
        solver.advance(Conditions { gravity: 9.81, drag: 2.0, softness: 1.0 });
    }
    let end = solver.points.to_vec();
    let lowest = end[lower..].iter().map(|place| place.y - 2.0).fold(f64::INFINITY, f64::min);
    let highest = end[lower..].iter().map(|place| place.y - 2.0).fold(f64::NEG_INFINITY, f64::max);
    assert!(lowest > 0.002 && highest < 0.004, "{lowest} to {highest} m above");
}

/// A strip that sticks out from a table and weighs `d` hangs down by `d g L^4 / (8 B)` at its end; its own friction holds a moment of
/// `37 B` per width, so that it sticks out as straight as it did where its weight's `d g L^2 / 2` is less.
#[test]
fn a_short_strip_is_held_straight_by_its_own_friction_and_a_long_one_is_not() {
    let bent = |length: f64, held: bool| {
        let garment = strip(0.02, length, 0.005);
        let mut model = Model::new(&garment, &[]);
        let root = garment.pieces[0].flat.iter().map(|flat| flat.y).fold(f64::NEG_INFINITY, f64::max) - 0.006;
        for (vertex, flat) in garment.pieces[0].flat.iter().enumerate() {
            if flat.y > root {
                model.inverse_mass[vertex] = 0.0;
            }
        }
        let start = places(&garment, |u, v| DVec3::new(3.0 + u, 2.0, -v));
        let body = Body::new(Figure::Ball);
        let mut solver = Solver::new(&model, &body, &start, 0.0, layers(&model), 2e-4);
        if held {
            solver.hold_bends();
        }
        for substep in 0..2500 {
            solver.advance(Conditions { gravity: 9.81, drag: 20.0, softness: 1.0 });
            if substep % 50 == 0 {
                solver.slip_bends();
            }
        }
        let lowest = solver.points.to_vec().iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
        (2.0 - lowest) / length
    };
    let (short, long) = (0.018, 0.07);
    assert!(bent(short, true) < 0.25 * bent(short, false), "{} {}", bent(short, true), bent(short, false));
    assert!(bent(long, true) > 0.7 * bent(long, false), "{} {}", bent(long, true), bent(long, false));
}

//! Whole garments, coarse.

use amc_core::Progress;

use super::cloths;
use crate::body::{Body, Figure};
use crate::cut::CutGarment;
use crate::drape::{Draped, Options, Rest, drape, linger};
use crate::measure::measure;

fn draped(levels: &[CutGarment]) -> (Draped, Rest) {
    drape(levels, &Body::new(levels[0].figure), &Options::default(), &Progress::none()).unwrap()
}

#[test]
fn a_square_lies_evenly_on_the_ball_and_comes_to_rest() {
    let garment = cloths::square(0.8, 0.045);
    let (draped, rest) = draped(std::slice::from_ref(&garment));
    let places = &draped.positions[0];
    let body = Body::new(Figure::Ball);
    let nearest = places.iter().map(|place| body.distance(*place)).fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.0015, "{nearest} m off the ball");
    let centre = places.iter().sum::<glam::DVec3>() / places.len() as f64;
    assert!(centre.x.abs() < 0.02 && centre.z.abs() < 0.02, "it slid to {centre}");
    let corner = |line: &str, last: bool| {
        let line = &garment.pieces[0].lines[line];
        places[*(if last { line.last() } else { line.first() }).unwrap() as usize].y
    };
    let heights =
        [corner("top", false), corner("top", true), corner("bottom", false), corner("bottom", true)];
    let (low, high) =
        (heights.iter().copied().fold(f64::INFINITY, f64::min), heights.iter().copied().fold(0.0, f64::max));
    assert!(high - low < 0.06 && high < 0.95, "corners hang at {heights:?}");
    assert!(rest.is_still(&Options::default()), "{} m/s", rest.fastest);
    let totals: Vec<f64> = rest.energies.iter().map(crate::drape::Energy::total).collect();
    let (first, last) = (totals[0], totals[totals.len() - 1]);
    assert!(first > last + 0.05, "{first} J to {last} J");
    let kinetic = |energy: &crate::drape::Energy| energy.kinetic;
    let peak = rest.energies.iter().map(kinetic).fold(0.0, f64::max);
    assert!(rest.energies.last().map(kinetic).unwrap() < 1e-3 * peak, "it still moves");
    // Contacts and friction do a little work of their own: the sum is level, not strictly falling.
    let quiet = &totals[totals.len() * 3 / 4..];
    let spread =
        quiet.iter().copied().fold(0.0, f64::max) - quiet.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(spread < 0.02 * (first - last), "the energy is not level: {quiet:?}");
}

#[test]
fn fine_cloth_lies_still_in_ordinary_air_from_standing() {
    let levels = [cloths::square(0.8, 0.09), cloths::square(0.8, 0.045)];
    let options = Options { fine: 0.06, ..Options::default() };
    let body = Body::new(Figure::Ball);
    let (draped, rest) = drape(&levels, &body, &options, &Progress::none()).unwrap();
    assert!(rest.is_still(&options), "{} m/s", rest.fastest);
    let nearest = draped.positions[0].iter().map(|place| body.distance(*place)).fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.0015, "{nearest} m off the ball");
    let lying = linger(&levels[1], &draped, &body, 0.5, &options, &Progress::none()).unwrap();
    assert!(lying.is_still(&options), "{} m/s", lying.fastest);
}

#[test]
fn a_tube_closes_its_seams_outside_the_body_and_is_not_strained() {
    let levels = [cloths::tube(0.05), cloths::tube(0.03)];
    let (draped, _) = draped(&levels);
    let figures = measure(&levels[1], &draped, &Body::new(Figure::Standing));
    assert_eq!(figures.seam_gap, 0.0);
    assert_eq!((figures.inside_body, figures.pierced), (0, 0));
    assert!(figures.angle.p5 > 80.0 && figures.angle.p95 < 100.0, "{figures:?}");
    assert!(figures.warp.p5 > 0.97 && figures.warp.p95 < 1.04 && figures.weft.p95 < 1.06, "{figures:?}");
}

#[test]
fn one_and_two_threads_give_the_same_places() {
    let levels = [cloths::tube(0.06), cloths::tube(0.025)];
    let options = Options { sewing: 0.15, falling: 0.1, relaxing: 8.0, ..Options::default() };
    let body = Body::new(Figure::Standing);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drape(&levels, &body, &options, &Progress::none()).unwrap().0.positions)
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn a_seam_that_cannot_close_is_named() {
    let mut garment = cloths::tube(0.06);
    garment.pieces.iter_mut().for_each(|piece| piece.flat.iter_mut().for_each(|flat| flat.x *= 0.3));
    garment.cloth.warp = 1e7;
    garment.cloth.weft = 1e7;
    let options = Options { sewing: 0.2, ..Options::default() };
    let error =
        drape(&[garment], &Body::new(Figure::Standing), &options, &Progress::none()).unwrap_err().to_string();
    assert!(error.contains("side"), "{error}");
}

#[test]
fn a_weightless_cloth_is_refused() {
    let mut garment = cloths::square(0.5, 0.1);
    garment.cloth.density = 0.0;
    let error = drape(&[garment], &Body::new(Figure::Ball), &Options::default(), &Progress::none())
        .unwrap_err()
        .to_string();
    assert!(error.contains("square") && error.contains("density"), "{error}");
}

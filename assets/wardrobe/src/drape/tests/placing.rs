//! Pieces laid round the body, and places carried between cuts.

use glam::{DVec2, DVec3};

use super::cloths;
use crate::body::{Body, Figure};
use crate::drape::place::place;
use crate::drape::{Draped, carry::carry};
use crate::pattern::Placement;

fn around(limb: &str, radius: f64, flare: f64) -> Placement {
    Placement::Around { limb: limb.to_owned(), point: [0.2, 0.3], along: 0.1, angle_deg: 20.0, radius, flare }
}

#[test]
fn wrapping_bends_but_does_not_stretch() {
    let body = Body::new(Figure::Standing);
    for flare in [0.0, 0.3, -0.2] {
        let garment = cloths::single(
            Figure::Standing,
            cloths::rectangle("piece", 0.4, 0.3, 0.01, around("torso", 0.4, flare)),
        );
        let places = place(&garment, &body, 0.0).unwrap();
        let piece = &garment.pieces[0];
        for [a, b, _] in &piece.triangles {
            let flat = piece.flat[*a as usize].distance(piece.flat[*b as usize]);
            let bent = places[0][*a as usize].distance(places[0][*b as usize]);
            assert!((bent / flat - 1.0).abs() < 1e-4, "flare {flare}: {flat} m became {bent} m");
        }
    }
}

#[test]
fn a_piece_faces_outwards_with_its_top_up() {
    let body = Body::new(Figure::Standing);
    let garment = cloths::single(
        Figure::Standing,
        cloths::rectangle("piece", 0.4, 0.3, 0.05, around("torso", 0.4, 0.2)),
    );
    let places = &place(&garment, &body, 0.0).unwrap()[0];
    for corners in &garment.pieces[0].triangles {
        let [a, b, c] = corners.map(|corner| places[corner as usize]);
        let outward = DVec3::new(a.x, 0.0, a.z);
        assert!((b - a).cross(c - a).dot(outward) > 0.0);
    }
    let height = |line: &str| places[garment.pieces[0].lines[line][0] as usize].y;
    assert!(height("top") > height("bottom") + 0.25);
}

#[test]
fn a_limb_the_figure_lacks_is_named_with_the_piece() {
    let garment =
        cloths::single(Figure::Ball, cloths::rectangle("sleeve", 0.4, 0.3, 0.05, around("tail", 0.4, 0.0)));
    let error = place(&garment, &Body::new(Figure::Ball), 0.0).unwrap_err().to_string();
    assert!(error.contains("tail") && error.contains("sleeve"), "{error}");
}

#[test]
fn a_finer_cut_lies_where_the_coarse_one_lay() {
    let nowhere =
        Placement::Flat { point: [0.0; 2], at: [0.0; 3], across: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0] };
    let cut =
        |edge: f64| cloths::single(Figure::Ball, cloths::rectangle("piece", 0.4, 0.3, edge, nowhere.clone()));
    let (coarse, fine) = (cut(0.04), cut(0.013));
    let map = |flat: &DVec2| DVec3::new(0.3 * flat.x - flat.y, 2.0 + flat.x, 0.5 * flat.y);
    let draped = Draped { positions: vec![coarse.pieces[0].flat.iter().map(map).collect()] };
    let carried = carry(&coarse, &draped, &fine).unwrap();
    for (flat, place) in fine.pieces[0].flat.iter().zip(&carried[0]) {
        assert!(place.distance(map(flat)) < 1e-12);
    }
}

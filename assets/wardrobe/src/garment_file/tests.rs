#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;

use amc_core::mesh::{self, Unit};

use super::*;
use crate::body::Figure;
use crate::cut::{At, Join, JoinKind};
use crate::pattern::{Cloth, Placement};

/// A square of side 0.3 m as two triangles; the vertices run counter-clockwise from the lower left.
fn square(name: &str, mirror: Option<usize>) -> CutPiece {
    let side = 0.3;
    let flat = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(u, v)| DVec2::new(u, v));
    CutPiece {
        name: name.to_owned(),
        flat: flat.to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        grain: std::f64::consts::FRAC_PI_2,
        cloth: None,
        placement: Placement::Flat {
            point: [0.0; 2],
            at: [0.0; 3],
            across: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
        },
        lines: BTreeMap::new(),
        folds: Vec::new(),
        mirror,
    }
}

fn join(name: &str, pairs: &[[u32; 4]]) -> Join {
    let pair =
        |&[piece, vertex, other, at]: &[u32; 4]| (At { piece, vertex }, At { piece: other, vertex: at });
    let pairs = pairs.iter().map(pair).collect();
    Join { name: name.to_owned(), kind: JoinKind::Sewn, late: false, pairs, sides: [Vec::new(), Vec::new()] }
}

/// Two squares sewn along the left one's right side, at a right angle, and a tab sewn to both of their upper sides.
fn garment() -> (CutGarment, Draped) {
    let cut = CutGarment {
        name: "corner".to_owned(),
        figure: Figure::Ball,
        cloth: Cloth::default(),
        pieces: vec![square("Left", None), square("Right", Some(0)), square("Tab", None)],
        joins: vec![
            join("middle", &[[0, 2, 1, 3], [0, 1, 1, 0]]),
            join("top", &[[0, 3, 2, 0], [0, 2, 2, 1], [1, 3, 2, 1], [1, 2, 2, 2]]),
            join("button", &[[0, 0, 1, 1]]),
        ],
    };
    let flat = |p: &DVec2| DVec3::new(p.x - 0.3, p.y, 0.0);
    let turned = |p: &DVec2| DVec3::new(0.0, p.y, -p.x);
    let above = |p: &DVec2| DVec3::new(p.x - 0.3, 0.3 + p.y, 0.0);
    let positions = vec![
        cut.pieces[0].flat.iter().map(flat).collect(),
        cut.pieces[1].flat.iter().map(turned).collect(),
        cut.pieces[2].flat.iter().map(above).collect(),
    ];
    (cut, Draped { positions })
}

#[test]
fn a_saved_garment_read_again_has_its_pieces() {
    let (cut, draped) = garment();
    let folder = tempfile::tempdir().unwrap();
    for name in ["corner.glb", "corner.obj"] {
        let path = folder.path().join(name);
        save(&cut, &draped, &path).unwrap();
        let read = Garment::new(mesh::read(&path, Unit::Metre).unwrap()).unwrap();
        let names: Vec<&str> = read.panels.iter().map(|panel| panel.name.as_str()).collect();
        assert_eq!((names, read.positions.len()), (vec!["Left", "Right", "Tab"], 12));
        for (uv, flat) in read.uvs.iter().zip(cut.pieces.iter().flat_map(|piece| &piece.flat)) {
            assert!((uv.as_dvec2() - *flat).length() < UV_STEP, "{name}: {uv} for {flat}");
        }
    }
    let glb = std::fs::read(folder.path().join("corner.glb")).unwrap();
    save(&cut, &draped, &folder.path().join("corner.glb")).unwrap();
    assert_eq!(std::fs::read(folder.path().join("corner.glb")).unwrap(), glb, "the same bytes each time");
}

#[test]
fn sewn_vertices_have_one_normal_and_seams_run_counter_clockwise() {
    let (cut, draped) = garment();
    let made = Garment::new(mesh(&cut, &draped).unwrap()).unwrap();
    assert!(made.notices.is_empty(), "{:?}", made.notices);
    // The lower end of the middle seam: one right angle of either square.
    assert_eq!(made.normals[1], made.normals[4]);
    assert!((made.normals[1] - glam::Vec3::new(1.0, 0.0, 1.0) / 2f32.sqrt()).length() < 1e-5);

    let [left, right, tab] = [0, 1, 2].map(|panel| &made.panels[panel].pattern);
    assert_eq!((left.mirror, right.mirror, tab.mirror), (Some(1), Some(0), None));
    let told = |pattern: &PatternPiece<usize>| -> Vec<(String, usize)> {
        pattern.seams.iter().map(|seam| (seam.name.clone(), seam.partner)).collect()
    };
    let (middle, top) = (|other| ("middle".to_owned(), other), |other| ("top".to_owned(), other));
    assert_eq!(told(left), [middle(1), top(2)]);
    assert_eq!(told(right), [middle(0), top(2)]);
    assert_eq!(told(tab), [top(0), top(1)]);
    // The join runs down; counter-clockwise runs up the left square's right side, and down the right one's left side.
    let corner = |u: f64, v: f64| uv(DVec2::new(u, v));
    assert_eq!(left.seams[0].edge, [corner(0.3, 0.0), corner(0.3, 0.3)]);
    assert_eq!(left.seams[0].partner_edge, [corner(0.0, 0.0), corner(0.0, 0.3)]);
    assert_eq!(right.seams[0].edge, [corner(0.0, 0.3), corner(0.0, 0.0)]);
    assert_eq!(right.seams[0].partner_edge, [corner(0.3, 0.3), corner(0.3, 0.0)]);
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let refused = |change: fn(&mut CutGarment, &mut Draped), what: &str| {
        let (mut cut, mut draped) = garment();
        change(&mut cut, &mut draped);
        let message = mesh(&cut, &draped).unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    };
    refused(|_, draped| draped.positions.truncate(2), "not as many");
    refused(|_, draped| draped.positions[1].truncate(2), "piece 'Right': 2 draped vertices of 4");
    refused(|_, draped| draped.positions[1][0].x = f64::NAN, "piece 'Right': a vertex that is nowhere");
    refused(|cut, _| cut.pieces[2].triangles[0][0] = 9, "piece 'Tab': a triangle");
    refused(|cut, _| cut.joins[1].pairs[0].0.vertex = 9, "seam 'top': joins a vertex");
}

/// The grain of a panel in space, told by its UVs: where the warp runs on its first triangle.
fn warp(garment: &Garment, panel: usize) -> glam::Vec3 {
    let corners = garment.triangles[garment.panels[panel].triangles.start as usize].map(|k| k as usize);
    let (p, uv) = (corners.map(|k| garment.positions[k]), corners.map(|k| garment.uvs[k]));
    let (e, f) = (uv[1] - uv[0], uv[2] - uv[0]);
    let warp = Vec2::from_angle(garment.panels[panel].pattern.grain.unwrap());
    let along = Vec2::new(warp.perp_dot(f), e.perp_dot(warp)) / e.perp_dot(f);
    (p[1] - p[0]) * along.x + (p[2] - p[0]) * along.y
}

#[test]
fn in_every_variant_the_cloth_lies_the_same_and_seams_end_at_the_same_places() {
    let (cut, draped) = garment();
    let place_of = |garment: &Garment, panel: usize, end: Vec2| {
        let range = &garment.panels[panel].triangles;
        let corners = garment.triangles[range.start as usize..range.end as usize].as_flattened();
        let at = corners.iter().find(|&&corner| garment.uvs[corner as usize] == end);
        garment.positions[*at.unwrap() as usize]
    };
    let before = Garment::new(mesh(&cut, &draped).unwrap()).unwrap();
    for variant in [Variant::Mirrored, Variant::Turned] {
        let mut mesh = mesh(&cut, &draped).unwrap();
        variant.apply(&mut mesh);
        let after = Garment::new(mesh).unwrap();
        assert!(after.notices.is_empty(), "{:?}", after.notices);
        for panel in 0..3 {
            let turned = after.panels[panel].pattern.grain.unwrap().to_degrees() % 90.0;
            assert_eq!(turned.abs() > 1.0, variant == Variant::Turned, "{turned}");
            assert_eq!(after.panels[panel].flags.mirrored, variant == Variant::Mirrored);
            let (now, then) = (warp(&after, panel), warp(&before, panel));
            assert!((now - then).length() < 1e-5 && (now.length() - 1.0).abs() < 1e-5, "{now} for {then}");
            for (seam, old) in
                after.panels[panel].pattern.seams.iter().zip(&before.panels[panel].pattern.seams)
            {
                let mut ends = seam.edge.map(|end| place_of(&after, panel, end));
                let other = seam.partner_edge.map(|end| place_of(&after, seam.partner, end));
                if variant == Variant::Mirrored {
                    ends.reverse();
                }
                assert_eq!(ends, old.edge.map(|end| place_of(&before, panel, end)), "{}", seam.name);
                assert_eq!(seam.partner, old.partner);
                assert!(seam.name != "middle" || other.contains(&ends[0]), "sewn to the same place");
            }
        }
    }
    let mut mesh = mesh(&cut, &draped).unwrap();
    Variant::WithoutUvs.apply(&mut mesh);
    let bare = Garment::new(mesh).unwrap();
    assert!(!bare.has_uvs && bare.panels[0].pattern.grain.is_none());
    assert_eq!(bare.panels[1].pattern.mirror, Some(0));
}

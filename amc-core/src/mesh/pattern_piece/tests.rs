use glam::Vec3;

use super::*;
use crate::mesh::Mesh;

/// Squares of side 1 in the plane, each an island of its own at `places` in the UV map, of the given parts.
fn squares(places: &[(f32, usize)], parts: Vec<Part>) -> Mesh {
    let mut mesh = Mesh { uvs: Some(Vec::new()), parts, ..Mesh::default() };
    for &(u, part) in places {
        let first = mesh.positions.len() as u32;
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(|corner| corner + Vec2::X * u);
        mesh.positions.extend(square.map(|p| p.extend(0.0)));
        mesh.uvs.as_mut().unwrap().extend(square);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        mesh.triangle_parts.extend([part as u32; 2]);
    }
    mesh.normals = vec![Vec3::Z; mesh.positions.len()];
    mesh
}

fn part(name: &str, pattern: PatternPiece<String>) -> Part {
    Part { name: name.into(), takes_fabric: true, pattern }
}

#[test]
fn a_part_of_several_islands_has_its_grain_in_each_and_a_seam_where_it_lies() {
    let at = |u: f32| [Vec2::new(u, 0.0), Vec2::new(u, 1.0)];
    let seam = |u: f32, partner: &str, v: f32| Seam {
        name: "side".into(),
        edge: at(u),
        partner: partner.into(),
        partner_edge: at(v),
    };
    let shirt = PatternPiece {
        grain: Some(0.5),
        seams: vec![seam(11.0, "shirt", 20.0), seam(0.0, "back", 5.0)],
        ..PatternPiece::default()
    };
    let back = PatternPiece { seams: vec![seam(5.0, "shirt", 0.0)], ..PatternPiece::default() };
    let parts = vec![part("shirt", shirt), part("back", back)];
    let garment = Garment::new(squares(&[(0.0, 0), (10.0, 0), (20.0, 0), (5.0, 1)], parts)).unwrap();
    assert!(garment.notices.is_empty(), "{:?}", garment.notices);
    let grains: Vec<_> = garment.panels.iter().map(|panel| panel.pattern.grain).collect();
    assert_eq!(grains, [Some(0.5), Some(0.5), Some(0.5), None]);
    let seams = |panel: usize| -> Vec<usize> {
        garment.panels[panel].pattern.seams.iter().map(|seam| seam.partner).collect()
    };
    assert_eq!([seams(0), seams(1), seams(2), seams(3)], [vec![3], vec![2], vec![], vec![0]]);
}

#[test]
fn numbers_and_partners_that_make_no_sense_are_left_out_and_told() {
    let wrong = PatternPiece {
        grain: Some(f32::NAN),
        mirror: Some("nobody".into()),
        seams: vec![Seam { edge: [Vec2::INFINITY; 2], partner: "a".into(), ..Seam::default() }],
        uv_unit: Some(0.0),
    };
    let garment = Garment::new(squares(&[(0.0, 0)], vec![part("a", wrong)])).unwrap();
    assert_eq!(garment.panels[0].pattern, PatternPiece::default());
    let notice = &garment.notices[0];
    assert!(
        notice.contains("a: the grain NaN; a: the unit 0; ") && notice.contains("and 1 more"),
        "{notice}"
    );
}

#[test]
fn parts_without_triangles_are_no_partners() {
    let lonely = PatternPiece {
        mirror: Some("gone".into()),
        seams: vec![Seam { partner: "gone".into(), ..Seam::default() }],
        ..PatternPiece::default()
    };
    let gone = PatternPiece { mirror: Some("a".into()), ..PatternPiece::default() };
    let garment = Garment::new(squares(&[(0.0, 0)], vec![part("a", lonely), part("gone", gone)])).unwrap();
    assert_eq!(garment.panels[0].pattern, PatternPiece::default());
    assert!(garment.notices[0].contains("'gone' is not there"), "{:?}", garment.notices);
}

#[test]
fn parts_of_several_islands_mirror_nothing_and_that_is_told() {
    let mirror_of = |name: &str| PatternPiece { mirror: Some(name.into()), ..PatternPiece::default() };
    let places = [(0.0, 0), (10.0, 0), (20.0, 1)];
    for (pair, single) in [("single", ""), ("", "pair")] {
        let pattern = |of: &str| if of.is_empty() { PatternPiece::default() } else { mirror_of(of) };
        let parts = vec![part("pair", pattern(pair)), part("single", pattern(single))];
        let garment = Garment::new(squares(&places, parts)).unwrap();
        assert!(garment.panels.iter().all(|panel| panel.pattern.mirror.is_none()));
        assert!(garment.notices[0].contains("in several islands of the UV map"), "{:?}", garment.notices);
    }
}

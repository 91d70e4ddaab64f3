use glam::{Quat, Vec3};

use super::*;
use crate::direction::{Direction, tangents};
use crate::mesh::{Mesh, Part, PatternPiece, Seam};
use crate::pseudo_random::PseudoRandom;

const CELLS: u32 = 12;

/// Two squares side by side, 1 m each: part `a` at u from 0 to 1, part `b` from 1 to 2. They are bent round a cylinder, and sewn together
/// where they meet; the top of `a` is sewn to the top of `b`.
fn pair() -> Garment {
    let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
    for part in 0..2u32 {
        let first = mesh.positions.len() as u32;
        for k in 0..(CELLS + 1) * (CELLS + 1) {
            let at = glam::UVec2::new(k % (CELLS + 1), k / (CELLS + 1)).as_vec2() / CELLS as f32;
            let uv = at + Vec2::X * part as f32;
            mesh.positions.push(Vec3::new(uv.x.sin(), uv.y, uv.x.cos()));
            mesh.normals.push(Vec3::new(uv.x.sin(), 0.0, uv.x.cos()));
            mesh.uvs.as_mut().unwrap().push(uv);
        }
        for k in 0..CELLS * CELLS {
            let corner = first + k / CELLS * (CELLS + 1) + k % CELLS;
            let (right, up) = (corner + 1, corner + CELLS + 1);
            mesh.triangles.extend([[corner, right, up + 1], [corner, up + 1, up]]);
            mesh.triangle_parts.extend([part; 2]);
        }
    }
    let at = |u: f32, v: f32| Vec2::new(u, v);
    let seam = |name: &str, partner: &str, edge: [Vec2; 2], partner_edge: [Vec2; 2]| Seam {
        name: name.to_owned(),
        edge,
        partner: partner.to_owned(),
        partner_edge,
    };
    let (side, top_a, top_b) =
        ([at(1.0, 0.0), at(1.0, 1.0)], [at(1.0, 1.0), at(0.0, 1.0)], [at(1.0, 1.0), at(2.0, 1.0)]);
    let of = |name: &str, other: &str, seams: Vec<Seam<String>>| Part {
        name: name.to_owned(),
        takes_fabric: true,
        pattern: PatternPiece { seams, mirror: Some(other.to_owned()), ..PatternPiece::default() },
    };
    mesh.parts = vec![
        of("a", "b", vec![seam("side", "b", side, side), seam("top", "b", top_a, top_b)]),
        of("b", "a", {
            let [from, to] = side;
            let [b_from, b_to] = top_b;
            vec![
                seam("side", "a", [to, from], [to, from]),
                seam("top", "a", [b_to, b_from], [at(0.0, 1.0), at(1.0, 1.0)]),
            ]
        }),
    ];
    Garment::new(mesh).unwrap()
}

fn split_a(line: [Vec2; 2]) -> Rearrangement {
    Rearrangement::Split { panel: "a".into(), line, into: ["a-1".into(), "a-2".into()] }
}

fn merge(ids: &[&str]) -> Rearrangement {
    Rearrangement::Merge(ids.iter().map(|id| (*id).to_owned()).collect())
}

fn arranged(changes: Vec<Rearrangement>) -> (Garment, Vec<String>) {
    pair().arranged(&Arrangement { changes, ..Arrangement::default() })
}

/// Every vertex is of one panel, panels stand one after the other, partners are mutual.
fn assert_sound(garment: &Garment) {
    let mut owners = vec![None; garment.positions.len()];
    let mut next = 0;
    for (number, panel) in garment.panels.iter().enumerate() {
        assert_eq!(panel.triangles.start, next);
        assert!(panel.triangles.end > next);
        next = panel.triangles.end;
        for triangle in &garment.triangles[panel.triangles.start as usize..panel.triangles.end as usize] {
            for &vertex in triangle {
                assert_eq!(*owners[vertex as usize].get_or_insert(number), number);
            }
        }
        if let Some(partner) = panel.pattern.mirror {
            assert_eq!(garment.panels[partner].pattern.mirror, Some(number));
        }
        for seam in &panel.pattern.seams {
            let back = &garment.panels[seam.partner].pattern.seams;
            assert!(back.iter().any(|back| back.partner == number && back.name == seam.name), "{seam:?}");
        }
    }
    assert_eq!(next as usize, garment.triangles.len());
    assert!(owners.iter().all(Option::is_some));
    assert_eq!(
        (garment.normals.len(), garment.uvs.len()),
        (garment.positions.len(), garment.positions.len())
    );
}

fn flat_area(garment: &Garment, panel: &Panel) -> f32 {
    let triangles = &garment.triangles[panel.triangles.start as usize..panel.triangles.end as usize];
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| garment.uvs[vertex as usize]);
        assert!((b - a).perp_dot(c - a) >= 0.0, "a triangle was turned over");
        (b - a).perp_dot(c - a) / 2.0
    };
    triangles.iter().map(area).sum()
}

#[test]
fn nothing_changes_nothing() {
    let (before, (after, faults)) = (pair(), arranged(Vec::new()));
    assert_eq!((&before.positions, &before.triangles), (&after.positions, &after.triangles));
    assert!(before.panels == after.panels && before.uvs == after.uvs && faults.is_empty());
    let names = [("b".to_owned(), "Rücken".to_owned())].into();
    let (named, _) = pair().arranged(&Arrangement { names, ..Arrangement::default() });
    assert_eq!((&*named.panels[1].name, &*named.panels[1].id), ("Rücken", "b"));
    assert_eq!(named.triangles, before.triangles);
}

#[test]
fn halves_have_the_areas_on_either_side_of_any_line() {
    let before = pair();
    let mut random = PseudoRandom::new(7);
    let mut number = || random.unit();
    for _ in 0..60 {
        // From the bottom to the top: a trapezium is on the left.
        let (low, high) = (0.05 + 0.9 * number(), 0.05 + 0.9 * number());
        let line = before.line_across(
            &before.panels[0],
            [Vec2::new(low, 0.0), Vec2::new(high, 1.0)].map(|it| {
                // Any two points of the line will do.
                it.lerp(Vec2::new((low + high) / 2.0, 0.5), 0.3)
            }),
        );
        let line = line.unwrap();
        assert!((line[0] - Vec2::new(low, 0.0)).length() < 1e-5, "{line:?} from {low} to {high}");
        let (after, faults) = arranged(vec![split_a(line)]);
        assert_eq!(faults, Vec::<String>::new());
        assert_sound(&after);
        let ids: Vec<&str> = after.panels.iter().map(|panel| panel.id.as_str()).collect();
        assert_eq!(ids, ["a-1", "a-2", "b"]);
        let areas: Vec<f32> = after.panels.iter().map(|panel| flat_area(&after, panel)).collect();
        // Vertices within 0.2 per mille of the line's length count as on it.
        let expected = (low + high) / 2.0;
        assert!(
            (areas[0] - expected).abs() < 1e-3 && (areas[1] - (1.0 - expected)).abs() < 1e-3,
            "{areas:?}"
        );
        let whole = after.panels[0].area + after.panels[1].area;
        assert!((whole / before.panels[0].area - 1.0).abs() < 1e-5, "{whole}");
    }
}

#[test]
fn the_surface_and_its_directions_stay() {
    let line = [Vec2::new(0.31, 0.0), Vec2::new(0.62, 1.0)];
    let (before, (after, _)) = (pair(), arranged(vec![split_a(line), merge(&["b", "a-1"])]));
    assert_sound(&after);
    let along = |count: usize| vec![Direction { angle: 0.4, ..Direction::default() }; count];
    let old = tangents(&before, &along(2)).unwrap().vectors;
    let new = tangents(&after, &along(2)).unwrap().vectors;
    let mut compared = 0;
    for (place, uv) in after.uvs.iter().enumerate() {
        let same = |k: &usize| before.uvs[*k] == *uv && before.positions[*k] == after.positions[place];
        // At the seam and the cut a mean is over the triangles of one side.
        let is_inside = (uv.x - 1.0).abs() > 1e-3 && {
            let off = (line[1] - line[0]).normalize_or(Vec2::Y).perp_dot(*uv - line[0]);
            off.abs() > 2.0 / CELLS as f32
        };
        if let Some(k) = (0..before.uvs.len()).find(same).filter(|_| is_inside) {
            assert!((old[k] - new[place]).length() < 1e-5, "{uv}");
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn what_is_merged_is_one_piece_where_it_is_drawn_together() {
    let (after, faults) = arranged(vec![merge(&["b", "a"])]);
    assert_eq!(faults, Vec::<String>::new());
    assert_sound(&after);
    let [one] = &after.panels[..] else { panic!("{:?}", after.panels) };
    assert_eq!((&*one.id, &*one.name, one.pattern.mirror), ("b", "b", None));
    assert_eq!(after.outlines(one).iter().map(Vec::len).collect::<Vec<_>>(), [6 * CELLS as usize]);
    // The seam along which it is drawn together is none any more; the other one is sewn to the piece itself.
    let names: Vec<&str> = one.pattern.seams.iter().map(|seam| seam.name.as_str()).collect();
    assert_eq!(names, ["top", "top"]);
    let mut sorted: Vec<[u32; 3]> = after.triangles.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, pair().triangles, "the same triangles");
}

#[test]
fn a_split_parts_seams_here_and_across_and_is_undone_by_a_merge() {
    let line = [Vec2::new(0.25, 0.0), Vec2::new(0.25, 1.0)];
    let (after, _) = arranged(vec![split_a(line)]);
    let seams = |panel: usize| -> Vec<(String, usize, [Vec2; 2], [Vec2; 2])> {
        let all = after.panels[panel].pattern.seams.iter();
        all.map(|seam| (seam.name.clone(), seam.partner, seam.edge, seam.partner_edge)).collect()
    };
    let near = |a: [Vec2; 2], b: [(f32, f32); 2]| (0..2).all(|k| a[k].distance(b[k].into()) < 1e-4);
    // `a-1` is left of the upward line.
    let left = seams(0);
    assert_eq!(left.iter().map(|seam| (&*seam.0, seam.1)).collect::<Vec<_>>(), [("top", 2), ("cut", 1)]);
    assert!(
        near(left[0].2, [(0.25, 1.0), (0.0, 1.0)]) && near(left[0].3, [(1.75, 1.0), (2.0, 1.0)]),
        "{left:?}"
    );
    let right = seams(1);
    assert_eq!(
        right.iter().map(|seam| (&*seam.0, seam.1)).collect::<Vec<_>>(),
        [("side", 2), ("top", 2), ("cut", 0)]
    );
    assert!(near(right[1].2, [(1.0, 1.0), (0.25, 1.0)]), "{right:?}");
    let across = seams(2);
    assert_eq!(
        across.iter().map(|seam| (&*seam.0, seam.1)).collect::<Vec<_>>(),
        [("side", 1), ("top", 0), ("top", 1)]
    );
    assert!(near(across[1].2, [(2.0, 1.0), (1.75, 1.0)]), "{across:?}");
    assert_eq!(after.panels[2].pattern.mirror, None, "what a half mirrors nobody knows");

    let (again, faults) = arranged(vec![split_a(line), merge(&["a-1", "a-2"])]);
    assert_eq!(faults, Vec::<String>::new());
    assert_sound(&again);
    let before = pair();
    assert!((again.panels[0].area / before.panels[0].area - 1.0).abs() < 1e-5);
    assert!(again.panels[0].pattern.seams.iter().all(|seam| seam.name != "cut"));
    assert_eq!(again.outlines(&again.panels[0]).len(), 1);
}

#[test]
fn what_does_not_fit_is_said_and_left_out() {
    let at = |u: f32, v: f32| Vec2::new(u, v);
    let changes = vec![
        merge(&["a", "c"]),
        split_a([at(0.2, 0.2), at(0.8, 0.7)]),
        split_a([at(5.0, 0.0), at(5.0, 1.0)]),
        Rearrangement::Split {
            panel: "a".into(),
            line: [at(0.5, 0.0), at(0.5, 1.0)],
            into: ["b".into(), "c".into()],
        },
    ];
    let (after, faults) = arranged(changes);
    let expected = ["no panel 'c'", "does not cut it in two", "does not cut it in two", "another panel 'b'"];
    assert_eq!(faults.len(), expected.len(), "{faults:?}");
    for (fault, expected) in faults.iter().zip(expected) {
        assert!(fault.contains(expected), "{fault}");
    }
    assert_eq!(after.panels, pair().panels);
    let bad = [
        merge(&["a"]),
        merge(&["a", "a"]),
        split_a([at(0.0, 0.0); 2]),
        split_a([at(f32::NAN, 0.0), at(0.0, 1.0)]),
    ];
    for change in bad {
        assert!(Arrangement { changes: vec![change], ..Arrangement::default() }.check().is_err());
    }
}

#[test]
fn a_half_may_keep_the_id_of_the_whole() {
    let mut garment = pair();
    let tilt = Quat::from_euler(glam::EulerRot::XYZ, 0.4, -0.7, 1.1);
    garment.positions.iter_mut().for_each(|position| *position = tilt * *position);
    let before = garment.panels[1].area;
    let change = Rearrangement::Split {
        panel: "b".into(),
        line: [Vec2::new(1.0, 0.3), Vec2::new(2.0, 0.9)],
        into: ["b".into(), "low".into()],
    };
    let (after, faults) = garment.arranged(&Arrangement { changes: vec![change], ..Arrangement::default() });
    assert_eq!(faults, Vec::<String>::new());
    assert_sound(&after);
    let [up, low] = [1, 2].map(|k| after.panels[k].area);
    assert!(((up + low) / before - 1.0).abs() < 1e-5 && (up / (up + low) - 0.4).abs() < 2e-3, "{up} {low}");
}

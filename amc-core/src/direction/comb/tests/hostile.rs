//! Meshes and numbers that nobody should send.

use std::sync::atomic::AtomicBool;

use super::*;
use crate::mesh::Panel;
use crate::pseudo_random::PseudoRandom;

/// Strokes of every sort over the unit square and the unit cube.
fn strokes() -> Vec<Stroke> {
    vec![
        stroke(&[[0.1, 0.1], [0.9, 0.8]]),
        Stroke { hold: Hold::Soft(1000.0), radius: 1000.0, ..stroke(&[[0.1, 0.1], [0.1, 0.2], [0.1, 0.1]]) },
        Stroke { hold: Hold::Soft(1e-30), radius: 1e-4, ..in_space(&[Vec3::ZERO, Vec3::ONE]) },
        Stroke { radius: 0.5, ..in_space(&[Vec3::X, Vec3::Y, Vec3::splat(1e30)]) },
    ]
}

/// Whatever is asked, there are unit directions, or an error.
fn survives(garment: &Garment) {
    let Ok(mesh) = PanelMesh::new(garment, &garment.panels[0]) else { return };
    let mut solver = CombSolver::new(mesh);
    let own: Vec<Vec3> = garment.normals.iter().map(|&n| n.any_orthonormal_vector()).collect();
    let centre = Vec2::splat(0.5);
    let elsewheres = [
        Elsewhere::Own,
        Elsewhere::Smooth,
        Elsewhere::Boundary,
        Elsewhere::Radial(centre),
        Elsewhere::Circular(centre),
        Elsewhere::Field(crate::direction::Field::Radial { origin: Vec3::ZERO }),
    ];
    let reaches = [Comb::SHORTEST, 0.1, Comb::LONGEST];
    for (round, elsewhere) in elsewheres.into_iter().cycle().take(12).enumerate() {
        let comb = Comb {
            strokes: strokes(),
            elsewhere,
            reach: reaches[(round + round / 6) % 3],
            ..Comb::default()
        };
        if let Ok(field) = solver.solve(&comb, round as u32 % 4 + 1, &own, Progress::none()) {
            assert_sound(garment, &field);
        }
    }
}

#[test]
fn any_heap_of_triangles_is_combed_or_refused() {
    let up = |mesh: Mesh| Mesh { normals: vec![Vec3::Z; mesh.positions.len()], ..mesh };
    let square: Vec<Vec2> = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from).to_vec();
    let corners: Vec<Vec3> = square.iter().map(|uv| uv.extend(0.0)).collect();
    let of = |triangles: &[[u32; 3]]| {
        up(Mesh {
            positions: corners.clone(),
            uvs: Some(square.clone()),
            triangles: triangles.to_vec(),
            ..Mesh::default()
        })
    };
    let point = Mesh { positions: vec![Vec3::ONE; 4], ..of(&[[0, 1, 2]]) };
    let no_uv_area = Mesh { uvs: Some(vec![Vec2::ONE; 4]), ..of(&[[0, 1, 2], [0, 2, 3]]) };
    for mesh in [
        of(&[]),
        of(&[[0, 0, 0]]),
        of(&[[0, 1, 1], [2, 2, 0]]),
        of(&[[0, 1, 2]]),
        // One edge with many triangles, in both senses, and both sides of one triangle.
        of(&[[0, 1, 2], [0, 1, 3], [1, 0, 2], [1, 0, 3], [0, 1, 2]]),
        of(&[[0, 1, 2], [2, 1, 0]]),
        point,
        no_uv_area,
    ] {
        survives(&garment_of(&[mesh]));
    }
    let mut strip = grid(12, |p| {
        // Moebius' strip: half a turn on the way round.
        let (sin, cos) = (p.x * std::f32::consts::TAU).sin_cos();
        let (lift, out) = (
            (p.x * std::f32::consts::PI).sin() * (p.y - 0.5),
            (p.x * std::f32::consts::PI).cos() * (p.y - 0.5),
        );
        Vec3::new(cos * (1.0 + out), lift, sin * (1.0 + out))
    });
    survives(&garment_of(&[strip.clone()]));
    strip.uvs = None;
    survives(&garment_of(&[strip]));
}

#[test]
fn random_heaps_at_any_scale_are_combed_or_refused() {
    let mut numbers = PseudoRandom::new(11);
    for round in 0..6 {
        let scale = 10f32.powi(round * 12 - 30);
        let count = 4 + numbers.below(30);
        let positions: Vec<Vec3> =
            (0..count).map(|_| Vec3::new(numbers.unit(), numbers.unit(), numbers.unit()) * scale).collect();
        let uvs = (0..count).map(|_| Vec2::new(numbers.unit(), numbers.unit())).collect();
        let triangles: Vec<[u32; 3]> =
            (0..60).map(|_| [0; 3].map(|_: u32| numbers.below(count) as u32)).collect();
        let normals = vec![Vec3::Y; count];
        survives(&garment_of(&[Mesh { positions, normals, uvs: Some(uvs), triangles, ..Mesh::default() }]));
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let garment = garment_of(&[flat(4)]);
    let own = vec![Vec3::X; garment.positions.len()];
    let refused = |comb: Comb, symmetry: u32, own: &[Vec3]| {
        solver(&garment).solve(&comb, symmetry, own, Progress::none()).unwrap_err().to_string()
    };
    let with = |stroke: Stroke| Comb { strokes: vec![self::stroke(&[]), stroke], ..Comb::default() };
    let plain = || stroke(&[[0.1, 0.1], [0.9, 0.9]]);
    for number in [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e9] {
        assert!(
            refused(with(Stroke { radius: number, ..plain() }), 1, &own).starts_with("stroke 2: the radius")
        );
        assert!(
            refused(with(Stroke { hold: Hold::Soft(number), ..plain() }), 1, &own).contains("the weight")
        );
        assert!(refused(Comb { reach: number, ..Comb::default() }, 1, &own).starts_with("the reach"));
    }
    assert!(refused(with(stroke(&[[0.0, f32::NAN]])), 1, &own).contains("stroke 2: a point is not finite"));
    assert!(refused(with(in_space(&[Vec3::INFINITY])), 1, &own).contains("not finite"));
    assert!(refused(with(stroke(&vec![[0.0, 0.0]; 4097])), 1, &own).contains("4097 points"));
    let many = Comb { strokes: vec![plain(); 257], ..Comb::default() };
    assert!(refused(many, 1, &own).contains("257 strokes"));
    assert!(refused(comb(Elsewhere::Radial(Vec2::NAN), vec![]), 1, &own).contains("centre"));
    assert!(
        refused(Comb::default(), 0, &own).contains("symmetry 0")
            && refused(Comb::default(), 5, &own).contains('5')
    );
    assert!(refused(Comb::default(), 1, &own[1..]).contains("fewer"));
    let mesh_of = |change: fn(&mut Garment)| {
        let mut garment = garment.clone();
        change(&mut garment);
        PanelMesh::new(&garment, &garment.panels[0]).unwrap_err().to_string()
    };
    assert!(mesh_of(|garment| garment.triangles[3][1] = 99).contains("id0 has a vertex that is not there"));
    assert!(mesh_of(|garment| garment.panels[0].triangles.end = 99).contains("triangles that are not there"));
    assert!(mesh_of(|garment| garment.positions[3].x = f32::NAN).contains("not finite"));
    assert!(mesh_of(|garment| garment.normals.truncate(9)).contains("not there"));
    let empty = Panel { triangles: 0..0, ..garment.panels[0].clone() };
    assert!(
        CombSolver::new(PanelMesh::new(&garment, &empty).unwrap())
            .solve(&with(plain()), 1, &own, Progress::none())
            .is_ok()
    );
}

#[test]
fn directions_of_its_own_that_are_none_do_no_harm() {
    let garment = garment_of(&[flat(6)]);
    for none in [Vec3::ZERO, Vec3::NAN, Vec3::Z, Vec3::splat(f32::MAX)] {
        let field = combed(&garment, &comb(Elsewhere::Own, vec![stroke(&[[0.1, 0.1], [0.9, 0.8]])]), 2, none);
        assert_sound(&garment, &field);
    }
}

#[test]
fn work_stops_when_it_is_told_to() {
    let garment = garment_of(&[flat(6)]);
    let own = vec![Vec3::X; garment.positions.len()];
    let (report, cancelled) = (|_: crate::Step<'_>| {}, AtomicBool::new(true));
    let comb = comb(Elsewhere::Own, vec![stroke(&[[0.1, 0.1], [0.9, 0.8]])]);
    let error = solver(&garment).solve(&comb, 1, &own, Progress::new(&report, &cancelled)).unwrap_err();
    assert!(error.is_cancelled());
}

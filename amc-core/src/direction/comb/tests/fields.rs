//! Fields whose form is known.

use super::*;
use crate::direction::Field;

#[test]
fn constant_strokes_on_a_flat_panel_give_a_constant_field() {
    let garment = garment_of(&[grid(12, |p| tilt() * p.extend(0.0))]);
    let (step, expected) = (angle(35.0), tilt() * angle(35.0));
    let along = |x: f32, y: f32| stroke(&[[x, y], [x + 0.2 * step.x, y + 0.2 * step.y]]);
    for hold in [Hold::Exact, Hold::Soft(0.3)] {
        let strokes = [along(0.1, 0.1), along(0.7, 0.3), along(0.3, 0.8)].map(|stroke| Stroke {
            hold,
            radius: 0.1,
            ..stroke
        });
        for symmetry in 1..=4 {
            let field =
                combed(&garment, &comb(Elsewhere::Smooth, strokes.to_vec()), symmetry, tilt() * angle(20.0));
            assert_sound(&garment, &field);
            assert!(field.singularities.is_empty() && field.unplaced.is_empty());
            let worst = field.directions.iter().map(|d| (*d - expected).length()).fold(0.0, f32::max);
            assert!(worst < 1e-4, "{hold:?} {symmetry}: {worst}");
            // The panel's own direction is the same: following it changes nothing.
            let field = combed(&garment, &comb(Elsewhere::Own, strokes.to_vec()), symmetry, expected);
            assert!(field.directions.iter().all(|d| (*d - expected).length() < 1e-4));
        }
    }
}

#[test]
fn indices_on_a_sphere_sum_to_two() {
    let garment = garment_of(&[icosphere(3)]);
    let arc = |from: f32, to: f32, lift: f32| -> Vec<Vec3> {
        (0..=20)
            .map(|k| angle(from + (to - from) * k as f32 / 20.0) + Vec3::Z * lift)
            .map(Vec3::normalize_or_zero)
            .collect()
    };
    let one = in_space(&arc(0.0, 80.0, 0.2));
    let two = Stroke {
        hold: Hold::Soft(1.0),
        radius: 0.2,
        ..in_space(&[Vec3::new(0.1, -0.9, -0.4), Vec3::new(0.4, -0.8, 0.4)])
    };
    for strokes in [vec![one.clone()], vec![one, two]] {
        for symmetry in 1..=4 {
            let field = combed(&garment, &comb(Elsewhere::Smooth, strokes.clone()), symmetry, Vec3::Y);
            assert_sound(&garment, &field);
            assert!(field.unplaced.is_empty());
            let sum: f32 = field.singularities.iter().map(|found| found.index).sum();
            assert_eq!(sum, 2.0, "{symmetry}: {:?}", field.singularities);
            let least = 1.0 / symmetry as f32;
            assert!(
                field
                    .singularities
                    .iter()
                    .all(|found| (found.index / least).fract() == 0.0 && found.index != 0.0)
            );
        }
    }
}

#[test]
fn a_turned_mesh_has_the_turned_field() {
    let bent = |p: Vec2| Vec3::new(p.x, p.y, 0.2 * (5.0 * p.x).sin() * (4.0 * p.y).cos());
    let strokes = vec![
        stroke(&[[0.1, 0.2], [0.5, 0.3], [0.6, 0.7]]),
        Stroke { hold: Hold::Soft(0.5), radius: 0.2, ..stroke(&[[0.9, 0.1], [0.8, 0.9]]) },
    ];
    let (plain, turned) =
        (garment_of(&[grid(10, bent)]), garment_of(&[grid(10, |p| tilt() * bent(p) + 3.0)]));
    for elsewhere in
        [Elsewhere::Smooth, Elsewhere::Own, Elsewhere::Boundary, Elsewhere::Circular(Vec2::splat(0.4))]
    {
        for symmetry in [1, 2, 4] {
            let comb = comb(elsewhere, strokes.clone());
            let field = combed(&plain, &comb, symmetry, Vec3::X);
            let other = combed(&turned, &comb, symmetry, tilt() * Vec3::X);
            for (a, b) in field.directions.iter().zip(&other.directions) {
                assert!(apart(tilt() * *a, *b, symmetry) < 0.05, "{elsewhere:?} {symmetry}: {a} {b}");
            }
            assert_eq!(field.singularities.len(), other.singularities.len());
        }
    }
}

#[test]
fn between_two_strokes_the_powers_are_blended_evenly() {
    // Across a strip z is linear: the harmonic function of one coordinate.
    let garment = garment_of(&[flat(16)]);
    let turn = 15.0f32;
    let upright = |x: f32, degrees: f32| -> Vec<Stroke> {
        // Short strokes, one beside the other, along a line that no direction of theirs follows.
        (0..64)
            .map(|k| {
                let (y, step) = ((k as f32 + 0.5) / 64.0, angle(degrees) * 1e-4);
                stroke(&[[x - step.x, y - step.y], [x + step.x, y + step.y]])
            })
            .collect()
    };
    let strokes = [upright(0.001, 0.0), upright(0.999, turn)].concat();
    for symmetry in [1, 2, 4] {
        let field = combed(&garment, &comb(Elsewhere::Smooth, strokes.clone()), symmetry, Vec3::X);
        let n = symmetry as f32;
        let end = Vec2::from_angle(n * turn.to_radians());
        // Each stroke holds the corners of its triangles, one column from the edge.
        let (first, last) = (garment.positions[1].x, garment.positions[15].x);
        for (&p, &d) in
            garment.positions.iter().zip(&field.directions).filter(|(p, _)| p.x > 0.15 && p.x < 0.85)
        {
            let share = (p.x - first) / (last - first);
            let expected = Vec2::X.lerp(end, share).to_angle().to_degrees() / n;
            let got = d.truncate().to_angle().to_degrees();
            // The columns are shaken by up to a third of a cell, so the ends are not straight.
            assert!((got - expected).abs() < 1.5, "{symmetry} at {p}: {got} for {expected}");
        }
    }
}

#[test]
fn a_stroke_is_forgotten_by_a_factor_of_e_in_each_reach() {
    // A stroke at 2 degrees along the left edge, the panel's own direction at 0: the angle is 2 exp(-x / reach), for
    // small angles.
    let garment = garment_of(&[flat(60)]);
    let own = Vec3::Y;
    let lean = 2f32.to_radians().tan();
    let side: Vec<Stroke> = (0..10)
        .map(|k| {
            let y = k as f32 / 10.0;
            stroke(&[[0.004, y], [0.004 - 0.1 * lean, y + 0.1]])
        })
        .collect();
    let comb = Comb { reach: 0.15, ..comb(Elsewhere::Own, side) };
    let field = combed(&garment, &comb, 1, own);
    // The strokes' triangles reach to the second column.
    let edge = garment.positions[61 * 30 + 1].x;
    for (&p, &d) in garment.positions.iter().zip(&field.directions).filter(|(p, _)| p.x > 0.1 && p.x < 0.6) {
        let expected = 2.0 * (-(p.x - edge) / 0.15).exp();
        let got = degrees_between(d, own);
        assert!((got - expected).abs() < 0.06, "at {p}: {got} for {expected}");
    }
}

#[test]
fn subdividing_four_times_keeps_the_direction_on_the_strokes() {
    let bent = |p: Vec2| Vec3::new(0.7 * (p.x / 0.7).sin(), p.y, 0.7 * (p.x / 0.7).cos());
    // A circle's arc, of which an edge of the coarse mesh spans 5 degrees.
    let bow = |k: u32| (Vec2::from_angle(0.3 + 0.02 * k as f32) * 1.1 - Vec2::new(0.3, 0.1)).to_array();
    let bow: Vec<[f32; 2]> = (0..=40).map(bow).collect();
    let straight = [[0.12, 0.1], [0.4, 0.25]];
    // A soft stroke is a compromise that depends on the mesh where its edges are longer than half its radius.
    let soft = Hold::Soft(5.0);
    for (cells, shape, hold) in
        [(10, true, Hold::Exact), (10, false, Hold::Exact), (14, true, soft), (14, false, soft)]
    {
        let coarse = grid(cells, |p| if shape { p.extend(0.0) } else { bent(p) });
        let strokes = [stroke(&bow), stroke(&straight)].map(|stroke| Stroke { hold, radius: 0.15, ..stroke });
        let comb = comb(Elsewhere::Own, strokes.to_vec());
        // A hundred places on the strokes: the directions there, and the normals of the triangles.
        let bow_at =
            |k: usize| Vec2::from(bow[k / 2]).lerp(bow[k / 2 + 1].into(), 0.25 + 0.5 * (k % 2) as f32);
        let straight_at =
            |k: usize| Vec2::from(straight[0]).lerp(straight[1].into(), (k as f32 + 0.5) / 20.0);
        let places: Vec<Vec2> = (0..80).map(bow_at).chain((0..20).map(straight_at)).collect();
        let on_strokes = |mesh: Mesh| -> Vec<(Vec3, Vec3)> {
            let garment = garment_of(&[mesh]);
            let field = combed(&garment, &comb, 1, Vec3::X);
            let solver = solver(&garment);
            let at = |place: &Vec2| {
                let found = solver.mesh().in_pattern().nearest(place.extend(0.0)).unwrap();
                let corners = garment.triangles[found.triangle as usize].map(|corner| corner as usize);
                let [a, b, c] = corners.map(|corner| garment.positions[corner]);
                let shares = corners.iter().zip(found.shares);
                let mean: Vec3 = shares.map(|(&corner, share)| field.directions[corner] * share).sum();
                (mean, (b - a).cross(c - a).normalize_or_zero())
            };
            places.iter().map(at).collect()
        };
        let (few, many) = (on_strokes(coarse.clone()), on_strokes(subdivided(coarse, 4)));
        // In the plane of the coarse triangle: the fine ones within it lie there too.
        let off = |(&(a, normal), &(b, _)): (&(Vec3, Vec3), &(Vec3, Vec3))| {
            let [a, b] = [a, b].map(|direction| crate::view_space::perpendicular(direction, normal));
            degrees_between(a, b)
        };
        let worst = few.iter().zip(&many).map(off).fold(0.0, f32::max);
        assert!(worst < 1.0, "flat {shape} {hold:?}: {worst}");
    }
}

#[test]
fn a_field_goes_round_a_fold_as_if_it_lay_flat() {
    // Two halves at a right angle, their vertices along the fold doubled.
    let half = |side: f32, to_space: fn(Vec2) -> Vec3| {
        let mut half = flat(8);
        let uvs = half.uvs.as_mut().unwrap();
        uvs.iter_mut().for_each(|uv| *uv = Vec2::new((uv.x - 0.5) * side + 0.5 * side, uv.y));
        half.positions = uvs.iter().map(|&uv| to_space(uv)).collect();
        if side < 0.0 {
            half.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        half.normals = cloth_normals(&half.positions, &half.triangles);
        half
    };
    let level = half(1.0, |p| p.extend(0.0));
    let upright = half(-1.0, |p| Vec3::new(0.0, p.y, -p.x));
    let mut garment = garment_of(&[level, upright]);
    garment.panels.pop();
    garment.panels[0].triangles.end *= 2;
    let drawn = stroke(&[[0.3, 0.2], [0.7, 0.5]]);
    let field = combed(&garment, &comb(Elsewhere::Smooth, vec![drawn]), 1, Vec3::Y);
    assert_sound(&garment, &field);
    let step = Vec2::new(0.8, 0.6);
    for (vertex, &direction) in field.directions.iter().enumerate() {
        let expected = if vertex < 81 { step.extend(0.0) } else { Vec3::new(0.0, step.y, -step.x) };
        assert!(degrees_between(direction, expected) < 0.01, "{vertex}: {direction} for {expected}");
    }
}

#[test]
fn the_boundary_leads_round_a_disc_and_along_a_square() {
    let sides = garment_of(&[flat(10)]);
    let field = combed(&sides, &comb(Elsewhere::Boundary, vec![]), 4, angle(10.0));
    assert!(field.singularities.is_empty());
    assert!(field.directions.iter().all(|&d| degrees_between(d, Vec3::X) < 0.01), "{:?}", field.directions);
    // The square's grid, drawn out into a disc.
    let round = |p: Vec2| {
        let p = 2.0 * p - 1.0;
        Vec3::new(p.x * (1.0 - p.y * p.y / 2.0).sqrt(), p.y * (1.0 - p.x * p.x / 2.0).sqrt(), 0.0)
    };
    let disc = garment_of(&[grid(20, round)]);
    for symmetry in [1, 2, 4] {
        let field = combed(&disc, &comb(Elsewhere::Boundary, vec![]), symmetry, Vec3::X);
        assert_eq!(field.singularities.iter().map(|found| found.index).sum::<f32>(), 1.0);
        for (p, &d) in disc.positions.iter().zip(&field.directions).filter(|(p, _)| p.length() > 0.99) {
            assert!(apart(d, Vec3::Z.cross(*p), symmetry) < 4.0, "{symmetry} {p}: {d}");
        }
    }
    let field = combed(&disc, &comb(Elsewhere::Boundary, vec![]), 1, Vec3::X);
    let round = |(p, d): (&Vec3, &Vec3)| p.length() < 0.2 || degrees_between(*d, Vec3::Z.cross(*p)) < 10.0;
    assert!(disc.positions.iter().zip(&field.directions).all(round), "counter-clockwise all over");
}

#[test]
fn rays_and_rings_of_the_pattern_lie_on_the_surface() {
    // The pattern is laid on a cylinder: x along its girth.
    let on_cylinder = |p: Vec2| Vec3::new(p.x.sin(), p.y, p.x.cos());
    let garment = garment_of(&[grid(30, on_cylinder)]);
    let centre = Vec2::new(0.45, 0.55);
    let uvs = garment.uvs.clone();
    let expected = |vertex: usize, step: Vec2| {
        let x = uvs[vertex].x;
        Vec3::new(x.cos() * step.x, step.y, -x.sin() * step.x)
    };
    type Step = fn(Vec2) -> Vec2;
    let cases: [(Elsewhere, Step); 2] =
        [(Elsewhere::Radial(centre), |e| e), (Elsewhere::Circular(centre), Vec2::perp)];
    for (elsewhere, step) in cases {
        let field = combed(&garment, &comb(elsewhere, vec![]), 1, Vec3::Y);
        assert_sound(&garment, &field);
        for (vertex, &d) in field.directions.iter().enumerate() {
            let e = uvs[vertex] - centre;
            let expected = expected(vertex, step(e));
            assert!(
                e.length() < 0.1 || degrees_between(d, expected) < 1.5,
                "{elsewhere:?} {vertex}: {d} for {expected}"
            );
        }
    }
    // A field in object space is what it is without a comb.
    let field = Elsewhere::Field(Field::Along { direction: Vec3::new(0.0, 2.0, 0.0) });
    let field = combed(&garment, &comb(field, vec![]), 2, Vec3::X);
    for (&d, &normal) in field.directions.iter().zip(&garment.normals) {
        assert!(degrees_between(d, crate::view_space::perpendicular(Vec3::Y, normal)) < 0.05);
    }
}

#[test]
fn of_equal_directions_neighbours_have_the_same() {
    // A stroke almost against the panel's own direction: a line field does not care, and no neighbours may differ.
    let garment = garment_of(&[flat(20)]);
    for (symmetry, degrees) in [(2, 170.0), (4, 80.0), (2, 100.0), (3, 110.0)] {
        let step = angle(degrees);
        let against =
            Stroke { radius: 0.1, ..stroke(&[[0.5, 0.5], [0.5 + 0.1 * step.x, 0.5 + 0.1 * step.y]]) };
        let field = combed(&garment, &comb(Elsewhere::Own, vec![against]), symmetry, Vec3::X);
        for triangle in &garment.triangles {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let [a, b] = [a, b].map(|corner: usize| field.directions[triangle[corner] as usize]);
                assert!(
                    degrees_between(a, b) < 180.0 / symmetry as f32 + 0.1,
                    "{symmetry} {degrees}: {a} {b}"
                );
            }
        }
        // In the corners all is as before.
        for vertex in [0, 20, 420, 440] {
            assert!(degrees_between(field.directions[vertex], Vec3::X) < 3.0, "{}", field.directions[vertex]);
        }
    }
}

#[test]
fn a_turned_comb_turns_its_field_as_the_pattern_is_drawn() {
    let bent = |p: Vec2| Vec3::new(p.x, p.y, 0.1 * (5.0 * p.x).sin());
    let mirrored = |mut mesh: Mesh| {
        mesh.uvs.as_mut().unwrap().iter_mut().for_each(|uv| uv.x = 1.0 - uv.x);
        mesh
    };
    for (mesh, sign) in [(grid(12, bent), 1.0), (mirrored(grid(12, bent)), -1.0)] {
        let garment = garment_of(&[mesh]);
        for elsewhere in [Elsewhere::Smooth, Elsewhere::Boundary, Elsewhere::Circular(Vec2::splat(0.3))] {
            let straight = comb(elsewhere, vec![stroke(&[[0.2, 0.3], [0.7, 0.4]])]);
            let turned = Comb { turn: 0.7, ..straight.clone() };
            let [straight, turned] = [straight, turned].map(|comb| combed(&garment, &comb, 2, Vec3::X));
            let triples = straight.directions.iter().zip(&turned.directions).zip(&garment.normals);
            for ((&before, &after), &normal) in triples {
                let expected = Quat::from_axis_angle(normal, sign * 0.7) * before;
                assert!(apart(expected, after, 2) < 0.5, "{elsewhere:?} {sign}: {expected} {after}");
            }
        }
    }
}

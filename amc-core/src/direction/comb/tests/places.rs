//! Where strokes come to lie.

use super::*;

#[test]
fn a_stroke_of_the_pattern_runs_on_the_surface() {
    let garment = garment_of(&[grid(20, |p| Vec3::new(p.x.sin(), p.y, p.x.cos()))]);
    let solver = solver(&garment);
    let points = solver.trace(&stroke(&[[0.2, 0.3], [0.8, 0.6]]));
    assert!(points.len() > 20);
    for (k, point) in points.iter().enumerate() {
        let share = (k as f32 + 0.5) / points.len() as f32;
        let (x, y) = (0.2 + 0.6 * share, 0.3 + 0.3 * share);
        // The chords of the cylinder lie a little inside of it.
        assert!((*point - Vec3::new(x.sin(), y, x.cos())).length() < 1e-3, "{point}");
    }
    let back = solver.mesh().pattern_point(points[10]).unwrap();
    let share = 10.5 / points.len() as f32;
    assert!((back - Vec2::new(0.2 + 0.6 * share, 0.3 + 0.3 * share)).length() < 1e-4);
}

#[test]
fn a_stroke_in_space_says_the_same_as_in_the_pattern() {
    let garment = garment_of(&[grid(20, |p| Vec3::new(p.x, p.y, 0.1 * (5.0 * p.x).sin()))]);
    let in_pattern = Stroke { radius: 0.1, ..stroke(&[[0.2, 0.3], [0.8, 0.6]]) };
    let traced = solver(&garment).trace(&in_pattern);
    let in_space = Stroke { path: Path::Space(traced), ..in_pattern.clone() };
    let [a, b] = [in_pattern, in_space]
        .map(|stroke| combed(&garment, &comb(Elsewhere::Own, vec![stroke]), 1, Vec3::X));
    // Where a stroke grazes a corner, the one may hold it and the other not.
    let pairs = a.directions.iter().zip(&b.directions);
    let mut off: Vec<f32> = pairs.map(|(a, b)| degrees_between(*a, *b)).collect();
    off.sort_by(f32::total_cmp);
    let [most, all] = [off[off.len() * 95 / 100], off[off.len() - 1]];
    assert!(most < 1.0 && all < 10.0, "{most} {all}");
}

#[test]
fn what_runs_off_the_panel_is_left_out_and_said() {
    let garment = garment_of(&[flat(10)]);
    let strokes = vec![
        Stroke { radius: 0.05, ..stroke(&[[0.5, 0.5], [1.5, 0.5]]) },
        stroke(&[[2.0, 2.0], [3.0, 3.0]]),
        stroke(&[[0.5, 0.5]]),
        stroke(&[]),
        stroke(&[[0.5, 0.5], [0.5, 0.5], [0.5, 0.5]]),
        Stroke { is_on: false, ..stroke(&[]) },
        in_space(&[Vec3::new(0.5, 0.5, 0.3), Vec3::new(0.6, 0.5, 0.3)]),
        // Straight into the cloth.
        Stroke { radius: 0.2, ..in_space(&[Vec3::new(0.2, 0.2, 0.1), Vec3::new(0.2, 0.2, -0.1)]) },
    ];
    let field = combed(&garment, &comb(Elsewhere::Own, strokes.clone()), 1, Vec3::Y);
    assert_eq!(field.unplaced, [1, 2, 3, 4, 6, 7]);
    let trace = solver(&garment).trace(&strokes[0]);
    assert!(trace.iter().all(|point| point.x <= 1.0) && trace.len() > 20);
    // Without UVs a stroke of the pattern has no place.
    let mut bare = flat(10);
    bare.uvs = None;
    let bare = garment_of(&[bare]);
    let mesh = PanelMesh::new(&bare, &bare.panels[0]).unwrap();
    assert!(!mesh.has_uvs() && mesh.pattern_point(Vec3::ZERO).is_none());
    let on_surface = in_space(&[Vec3::new(0.2, 0.5, 0.0), Vec3::new(0.7, 0.5, 0.0)]);
    let comb = comb(Elsewhere::Smooth, vec![strokes[0].clone(), on_surface]);
    let field = combed(&bare, &comb, 1, Vec3::Y);
    assert_eq!(field.unplaced, [0]);
    assert!(field.directions.iter().all(|&d| degrees_between(d, Vec3::X) < 0.01));
}

#[test]
fn a_stroke_does_not_jump_to_the_layer_behind() {
    // A strip laid double: its ends lie 1 mm apart, the way round is long.
    let hairpin = |p: Vec2| {
        let (s, turn) = (p.x * 2.0, 0.1 * std::f32::consts::PI);
        match s {
            s if s < 0.9 => Vec3::new(s, p.y, 0.0),
            s if s < 0.9 + turn => {
                let (sin, cos) = ((s - 0.9) / 0.1).sin_cos();
                Vec3::new(0.9 + 0.1 * sin, p.y, 0.1 - 0.1 * cos)
            }
            s => Vec3::new(0.9 - (s - 0.9 - turn), p.y, 0.2),
        }
    };
    let garment = garment_of(&[grid(40, hairpin)]);
    let solver = solver(&garment);
    let drawn = Stroke { radius: 0.25, ..stroke(&[[0.1, 0.3], [0.1, 0.7]]) };
    let samples = lift::lift(solver.mesh(), &drawn, 1);
    let reached = spread::Spreader::new(solver.mesh()).reach(&samples, 0.25);
    assert!(reached.len() > 100);
    assert!(reached.iter().all(|found| solver.mesh().positions[found.vertex as usize].z < 0.01));
    for found in &reached {
        let uv = solver.mesh().uvs[found.vertex as usize];
        let nearest = Vec2::new(0.1, uv.y.clamp(0.3, 0.7));
        let metres = (uv - nearest) * Vec2::new(2.0, 1.0);
        assert!((found.distance - f64::from(metres.length())).abs() < 0.01, "{uv}: {}", found.distance);
    }
}

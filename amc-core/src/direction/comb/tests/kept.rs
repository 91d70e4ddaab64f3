//! What stays as it is, and what is used again.

use super::*;
use crate::pseudo_random::PseudoRandom;

/// Directions that no formula gives.
fn odd_directions(garment: &Garment) -> Vec<Vec3> {
    let mut numbers = PseudoRandom::new(5);
    let mut some = |&normal: &Vec3| {
        let vector = Vec3::new(numbers.unit(), numbers.unit(), numbers.unit()) - 0.5;
        crate::view_space::perpendicular(vector, normal)
    };
    garment.normals.iter().map(&mut some).collect()
}

#[test]
fn without_strokes_a_panel_keeps_its_direction_to_the_bit() {
    let garment = garment_of(&[flat(6), flat(5)]);
    let own = odd_directions(&garment);
    let off = Stroke { is_on: false, ..stroke(&[[0.1, 0.1], [0.9, 0.9]]) };
    for elsewhere in [Elsewhere::Own, Elsewhere::Smooth] {
        for strokes in [vec![], vec![off.clone()]] {
            for symmetry in 1..=4 {
                let comb = comb(elsewhere, strokes.clone());
                let field = solver(&garment).solve(&comb, symmetry, &own, Progress::none()).unwrap();
                assert_eq!(field.directions, own[..49]);
                assert!(field.unplaced.is_empty() && field.singularities.is_empty());
            }
        }
    }
}

#[test]
fn strokes_on_one_piece_leave_the_other_alone() {
    // One panel of two pieces, side by side in the pattern and one above the other in space, nearer than the radius.
    let above = grid(9, |p| p.extend(0.01));
    let above =
        Mesh { uvs: above.uvs.map(|uvs| uvs.iter().map(|uv| *uv + Vec2::X * 2.0).collect()), ..above };
    let mut garment = garment_of(&[flat(9), above]);
    garment.panels.pop();
    garment.panels[0].triangles.end *= 2;
    let own = odd_directions(&garment);
    let wide = Stroke { radius: 0.3, ..stroke(&[[0.2, 0.5], [0.8, 0.5]]) };
    for elsewhere in [Elsewhere::Own, Elsewhere::Smooth] {
        let field =
            solver(&garment).solve(&comb(elsewhere, vec![wide.clone()]), 2, &own, Progress::none()).unwrap();
        assert_eq!(field.directions[100..], own[100..]);
        assert!(field.directions[..100].iter().zip(&own).all(|(a, b)| a != b));
    }
}

#[test]
fn a_factor_used_again_gives_what_a_fresh_one_gives() {
    let garment = garment_of(&[grid(12, |p| Vec3::new(p.x, p.y, 0.1 * (5.0 * p.x).sin()))]);
    let own = vec![Vec3::X; garment.positions.len()];
    let there = Stroke { radius: 0.1, hold: Hold::Soft(1.0), ..stroke(&[[0.2, 0.3], [0.7, 0.6]]) };
    let back =
        Stroke { path: Path::Pattern(vec![Vec2::new(0.7, 0.6), Vec2::new(0.2, 0.3)]), ..there.clone() };
    let moved = stroke(&[[0.5, 0.1], [0.5, 0.9]]);
    let mut kept = solver(&garment);
    for strokes in [vec![there.clone()], vec![back], vec![moved.clone()], vec![], vec![there, moved]] {
        for symmetry in [1, 4, 4] {
            let comb = comb(Elsewhere::Own, strokes.clone());
            let again = kept.solve(&comb, symmetry, &own, Progress::none()).unwrap();
            assert_eq!(again, solver(&garment).solve(&comb, symmetry, &own, Progress::none()).unwrap());
        }
    }
}

#[test]
fn a_system_is_factored_only_when_its_values_change() {
    // A chain of three: 2 -1 on the diagonal's sides.
    let mut system = system::System::new(&[0, 0, 1, 2], &[0, 1]).unwrap();
    let [one, two] = [1.0, 2.0].map(|x| faer::c64::new(x, 0.0));
    let turn = faer::c64::new(0.0, 1.0);
    let values = vec![two, -turn, two, -turn, two];
    assert!(system.factor(values.clone()).unwrap());
    assert!(!system.factor(values.clone()).unwrap());
    // The upper half is [2 -i 0; . 2 -i; . . 2]; the solution of A x = (1, 0, 0) by hand: (3, 2 i*, -1) / 4.
    let mut right = [one, edges::ZERO, edges::ZERO];
    system.solve(&mut right).unwrap();
    let expected = [faer::c64::new(0.75, 0.0), faer::c64::new(0.0, -0.5), faer::c64::new(-0.25, 0.0)];
    assert!(right.iter().zip(expected).all(|(a, b)| (a - b).norm() < 1e-12), "{right:?}");
    assert!(system.factor(vec![two, edges::ZERO, two, edges::ZERO, two]).unwrap());
    // Not positive: refused, and nothing is solved with half a factor.
    assert!(system.factor(vec![-one, turn, one, turn, one]).is_err());
    assert!(system.solve(&mut right).is_err());
    assert!(system.factor(values).unwrap());
}

#[test]
fn a_comb_is_kept_in_a_project() {
    let kept = comb(
        Elsewhere::Circular(Vec2::new(0.5, 0.25)),
        vec![
            stroke(&[[0.1, 0.2], [0.3, 0.4]]),
            Stroke { hold: Hold::Soft(2.5), is_on: false, ..in_space(&[Vec3::X, Vec3::Y]) },
        ],
    );
    let text = serde_json::to_string(&kept).unwrap();
    assert_eq!(serde_json::from_str::<Comb>(&text).unwrap(), kept);
    assert_eq!(serde_json::from_str::<Comb>("{}").unwrap(), Comb::default());
    assert!(serde_json::from_str::<Comb>(r#"{"elsewhere":"anywhere"}"#).is_err());
}

#[test]
fn a_preview_is_near_to_the_field() {
    let garment = garment_of(&[grid(115, |p| Vec3::new(p.x, p.y, 0.1 * (5.0 * p.x).sin()))]);
    let own = vec![Vec3::X; garment.positions.len()];
    let strokes = vec![
        Stroke { radius: 0.1, ..stroke(&[[0.3, 0.2], [0.35, 0.8]]) },
        Stroke { radius: 0.1, hold: Hold::Soft(1.0), ..stroke(&[[0.7, 0.2], [0.9, 0.3]]) },
    ];
    for (elsewhere, symmetry) in [(Elsewhere::Own, 1), (Elsewhere::Smooth, 4)] {
        let comb = Comb { reach: 0.2, ..comb(elsewhere, strokes.clone()) };
        let mut solver = solver(&garment);
        let near = solver.preview(&comb, symmetry, &own, Progress::none()).unwrap();
        let exact = solver.solve(&comb, symmetry, &own, Progress::none()).unwrap();
        assert_sound(&garment, &near);
        let pairs = near.directions.iter().zip(&exact.directions);
        let mut off: Vec<f32> = pairs.map(|(a, b)| apart(*a, *b, symmetry)).collect();
        off.sort_by(f32::total_cmp);
        let [middle, most] = [off.len() / 2, off.len() * 99 / 100].map(|place| off[place]);
        assert!(middle < 2.0 && most < 8.0, "{elsewhere:?} {symmetry}: {middle} {most}");
    }
}

use super::*;
use crate::body::Figure;

const UNIT: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
const TWO: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn sheet(places: &[DVec3], grain_deg: f64) -> Sheet<'_> {
    Sheet { flat: &UNIT, places, triangles: &TWO, grain: f64::to_radians(grain_deg) }
}

fn far_off(map: impl Fn(DVec2) -> DVec3) -> Vec<DVec3> {
    UNIT.iter().map(|flat| map(*flat) + DVec3::Y * 5.0).collect()
}

#[test]
fn a_stretched_and_sheared_square_has_the_strain_it_was_given() {
    let body = Body::new(Figure::Ball);
    let places = far_off(|flat| DVec3::new(1.1 * flat.x, 0.0, 0.9 * flat.y));
    let upright = measure_sheets(&[sheet(&places, 0.0)], [], &body);
    assert!((upright.warp.p50 - 1.1).abs() < 1e-12 && (upright.weft.p50 - 0.9).abs() < 1e-12);
    assert!((upright.angle.p50 - 90.0).abs() < 1e-9);
    let bias = measure_sheets(&[sheet(&places, 45.0)], [], &body);
    // The warp rises by 0.9 for 1.1 across, the weft falls so: the angle over the rise is more than a right one.
    let expected = 180.0 - 2.0 * (0.9f64 / 1.1).atan().to_degrees();
    assert!((bias.angle.p50 - expected).abs() < 1e-9, "{} {expected}", bias.angle.p50);
    assert!((bias.warp.p95 - (1.1f64.hypot(0.9) / 2f64.sqrt())).abs() < 1e-12);
}

#[test]
fn a_sheet_stuck_through_another_is_found_and_seen_unless_boxed_in() {
    let body = Body::new(Figure::Ball);
    let floor = far_off(|flat| DVec3::new(flat.x, 0.0, flat.y));
    let wall = far_off(|flat| DVec3::new(0.3 + 0.1 * flat.x, flat.y - 0.5, 0.35));
    let apart = far_off(|flat| DVec3::new(0.3 + 0.1 * flat.x, flat.y + 0.1, 0.35));
    let cut = measure_sheets(&[sheet(&floor, 0.0), sheet(&wall, 0.0)], [], &body);
    assert!(cut.pierced > 0 && cut.pierced_in_view == cut.pierced, "{cut:?}");
    assert_eq!(measure_sheets(&[sheet(&floor, 0.0), sheet(&apart, 0.0)], [], &body).pierced, 0);
    let sides: Vec<Vec<DVec3>> = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
        .iter()
        .map(|out| {
            let across = out.any_orthonormal_vector();
            far_off(|flat| *out * 3.0 + (across * (flat.x - 0.5) + out.cross(across) * (flat.y - 0.5)) * 6.0)
        })
        .collect();
    let mut sheets = vec![sheet(&floor, 0.0), sheet(&wall, 0.0)];
    sheets.extend(sides.iter().map(|places| sheet(places, 0.0)));
    let boxed = measure_sheets(&sheets[..], [], &body);
    assert!(boxed.pierced >= cut.pierced && boxed.pierced_in_view == 0, "{boxed:?}");
}

#[test]
fn a_seam_is_as_wide_as_its_widest_pair_and_the_inside_counts() {
    let body = Body::new(Figure::Ball);
    let floor = far_off(|flat| DVec3::new(flat.x, 0.0, flat.y));
    let at = |vertex| At { piece: 0, vertex };
    let wide = measure_sheets(&[sheet(&floor, 0.0)], [(at(0), at(1)), (at(0), at(2))], &body);
    assert!((wide.seam_gap - 2f64.sqrt()).abs() < 1e-12);
    assert_eq!(wide.inside_body, 0);
    let through: Vec<DVec3> =
        UNIT.iter().map(|flat| DVec3::new(flat.x, 1.0, flat.y) * 0.1 + DVec3::Y * 0.9).collect();
    assert_eq!(measure_sheets(&[sheet(&through, 0.0)], [], &body).inside_body, 6);
}

use std::f64::consts::TAU;

use super::*;

/// Girth of the body's section through `centre` across `axis`, metres: a polygon of rays.
fn girth(body: &Body, centre: DVec3, axis: DVec3) -> f64 {
    let across = axis.any_orthonormal_vector();
    let up = axis.cross(across);
    let rim = |step: usize| {
        let angle = step as f64 / 180.0 * TAU;
        let ray = across * angle.cos() + up * angle.sin();
        let mut inside = 0.0;
        while body.distance(centre + ray * (inside + 0.002)) < 0.0 {
            inside += 0.002;
        }
        let mut outside = inside + 0.002;
        for _ in 0..20 {
            let middle = 0.5 * (inside + outside);
            if body.distance(centre + ray * middle) < 0.0 { inside = middle } else { outside = middle }
        }
        centre + ray * inside
    };
    (0..180).map(|step| rim(step).distance(rim(step + 1))).sum()
}

#[test]
fn the_adult_has_the_girths_of_the_size_table() {
    let body = Body::new(Figure::Standing);
    let arm = body.limb("left arm").unwrap().clone();
    let level = |y: f64| (DVec3::new(0.0, y, 0.0), DVec3::Y);
    let sections = [
        ("chest", level(1.22), 0.96),
        ("waist", level(1.06), 0.80),
        ("hips", level(0.90), 0.98),
        ("neck", level(1.50), 0.38),
        ("upper arm", (arm.start + arm.axis * 0.16, arm.axis), 0.30),
        ("wrist", (arm.start + arm.axis * 0.555, arm.axis), 0.17),
    ];
    for (name, (centre, axis), expected) in sections {
        let found = girth(&body, centre, axis);
        assert!((found / expected - 1.0).abs() < 0.04, "{name}: {found:.3} m, expected {expected} m");
    }
}

#[test]
fn the_adult_is_as_wide_and_tall_as_stated() {
    let body = Body::new(Figure::Standing);
    assert!(body.distance(DVec3::new(0.0, 0.70, 0.0)) > 0.0, "legs apart below the crotch");
    assert!(body.distance(DVec3::new(0.0, 0.84, 0.0)) < 0.0, "closed above it");
    let tip = (0..400)
        .map(|i| f64::from(i) * 0.001)
        .take_while(|x| body.distance(DVec3::new(*x, 1.40, -0.01)) < 0.0)
        .last();
    let width = 2.0 * tip.unwrap();
    assert!((width - 0.42).abs() < 0.03, "shoulders {width} m");
}

#[test]
fn distance_grows_by_one_per_metre_near_the_skin() {
    let body = Body::new(Figure::Standing);
    let mut checked = 0;
    for step in 0..40_000 {
        let share = |prime: f64| (f64::from(step) * prime).fract();
        let point = DVec3::new(share(0.618_034) - 0.5, share(0.754_878) * 1.5, share(0.569_840) * 0.4 - 0.2);
        let (distance, outward) = body.surface(point);
        if distance.abs() > 0.008 {
            continue;
        }
        let rise = (body.distance(point + outward * 0.002) - body.distance(point - outward * 0.002)) / 0.004;
        assert!((rise - 1.0).abs() < 0.25, "{rise} at {point}");
        checked += 1;
    }
    assert!(checked > 500, "{checked}");
}

#[test]
fn limbs_lie_inside_and_their_frames_are_right_handed() {
    let body = Body::new(Figure::Standing);
    for limb in body.limbs() {
        assert!(body.distance(limb.start + limb.axis * 0.05) < 0.0, "{}", limb.name);
        assert!(limb.axis.dot(limb.front).abs() < 1e-9, "{}", limb.name);
    }
    assert!(body.limb("torso").unwrap().side().distance(DVec3::X) < 1e-9);
}

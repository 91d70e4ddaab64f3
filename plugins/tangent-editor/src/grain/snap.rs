//! Angles drawn to others nearby.

/// The multiple of `step` (radians) nearest to `angle`.
pub(crate) fn to_step(angle: f32, step: f32) -> f32 {
    (angle / step).round() * step
}

/// `angle`, or the one of `lines` it is within `reach` of (radians, each a line: half a turn on is the same line).
pub(crate) fn to_lines(angle: f32, lines: impl IntoIterator<Item = f32>, reach: f32) -> f32 {
    let half = std::f32::consts::PI;
    let away = |line: f32| {
        let difference = (line - angle).rem_euclid(half);
        if difference > half / 2.0 { difference - half } else { difference }
    };
    let nearest = lines.into_iter().map(away).min_by(|a, b| a.abs().total_cmp(&b.abs()));
    nearest.filter(|difference| difference.abs() <= reach).map_or(angle, |difference| angle + difference)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::{FRAC_PI_2, PI};

    #[test]
    fn angles_go_to_the_nearest_line_within_reach_and_keep_their_sense() {
        let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
        assert!(near(to_step(0.8, FRAC_PI_2 / 2.0), FRAC_PI_2 / 2.0));
        assert!(near(to_lines(1.5, [0.0, FRAC_PI_2], 0.1), FRAC_PI_2));
        assert!(near(to_lines(1.5, [0.0, FRAC_PI_2], 0.01), 1.5));
        assert!(near(to_lines(PI - 0.05, [0.0], 0.1), PI), "the other way along the line");
        assert!(near(to_lines(-0.05, [PI], 0.1), 0.0));
        assert!(near(to_lines(0.3, [], 1.0), 0.3));
    }
}

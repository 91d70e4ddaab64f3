//! How a piece lies against a panel: by which turn its outline comes to lie on the panel's.

use std::f32::consts::{PI, TAU};

use glam::{Mat2, Mat3, Vec2, Vec3};

use super::outline::{POINTS, Shape};

/// How far two outlines may be apart in the mean to be the same, of the root of their area.
const TOLERANCE: f32 = 0.01;
/// The same for outlines that differ by no more than the points they are drawn by.
const EXACT: f32 = 0.001;
/// A fit that is better by this factor is the one.
const CLEARLY: f32 = 3.0;
/// Most that two perimeters may differ by, of them.
const PERIMETERS: f32 = 0.06;
/// A turn below this is none: that of an outline which was rounded, radians.
const NO_TURN: f32 = 0.05 * PI / 180.0;
/// Lying by less than this against the panel, a piece is drawn as it is, whatever else would fit.
const SLIGHT: f32 = 3.0 * PI / 180.0;
/// Turns that are this far apart are two.
const APART: f32 = 10.0 * PI / 180.0;
/// Turns that are looked at more closely.
const MOST_TURNS: usize = 8;
/// Most steps of [`refined`], and a step that is no more worth it.
const STEPS: usize = 12;
const SMALL: f32 = 1e-6;
/// Points that are farther apart in the mean when turned best will not come near.
const HOPELESS: f32 = 0.06;

/// A way in which a piece fits a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fit {
    /// By which the piece (mirrored left to right first, where it is) is turned to lie as the panel's pattern does: radians
    /// counter-clockwise, within half a turn.
    pub(super) angle: f32,
    pub(super) is_mirrored: bool,
    /// Whether no other turn fits as well, but half a turn, which leaves a line of the grain where it is.
    pub(super) is_sure: bool,
    /// How far the outlines are apart in the mean, of the root of their area.
    pub(super) error: f32,
}

impl Fit {
    /// Where a direction on the piece runs on the panel.
    pub(super) fn turned(&self, along: Vec2) -> Vec2 {
        let along = if self.is_mirrored { Vec2::new(-along.x, along.y) } else { along };
        if self.angle == 0.0 { along } else { Vec2::from_angle(self.angle).rotate(along) }
    }
}

/// How `piece` fits `panel`; none where it does not.
pub(super) fn fit(piece: &Shape, panel: &Shape) -> Option<Fit> {
    if (piece.perimeter - panel.perimeter).abs() > PERIMETERS * panel.perimeter {
        return None;
    }
    let straight = one_sided(piece, panel, false);
    if straight.is_some_and(|fit| fit.error < EXACT) {
        return straight;
    }
    // A piece that is nearly its own mirror image fits both ways, but not as well.
    let mirrored = one_sided(&piece.mirrored(), panel, true);
    let bound = straight.map_or(f32::INFINITY, |fit| fit.error / CLEARLY);
    mirrored.filter(|fit| fit.error < bound).or(straight)
}

fn one_sided(piece: &Shape, panel: &Shape, is_mirrored: bool) -> Option<Fit> {
    let made = |(angle, error): (f32, f32), is_sure: bool| Fit {
        angle: if angle.abs() < NO_TURN { 0.0 } else { angle },
        is_mirrored,
        is_sure,
        error,
    };
    let as_drawn = refined(piece, panel, 0.0);
    if as_drawn.1 < EXACT && as_drawn.0.abs() < SLIGHT {
        return Some(made(as_drawn, true));
    }
    let refined = turns(piece, panel).into_iter().map(|angle| refined(piece, panel, angle));
    let mut fits: Vec<(f32, f32)> = refined.chain([as_drawn]).filter(|fit| fit.1 < TOLERANCE).collect();
    let least = fits.iter().map(|fit| fit.1).reduce(f32::min)?;
    fits.retain(|fit| fit.1 < 1.5 * least + EXACT);
    let best = fits.iter().copied().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    // As lines.
    let is_other = |fit: &(f32, f32)| (fit.0 - best.0).sin().abs() > SLIGHT.sin();
    Some(made(best, !fits.iter().any(is_other)))
}

/// The turns at which the outlines' points agree best, the best first: for every pair of starting points the turn is that of the
/// least sum of squares (Procrustes in the plane).
fn turns(piece: &Shape, panel: &Shape) -> Vec<f32> {
    let agreement = |shift: usize| {
        let pairs = piece.points.iter().zip(panel.points.iter().cycle().skip(shift));
        pairs.map(|(a, b)| Vec2::new(a.dot(*b), a.perp_dot(*b))).sum::<Vec2>()
    };
    let mut all: Vec<Vec2> = (0..POINTS).map(agreement).collect();
    all.sort_by(|a, b| b.length_squared().total_cmp(&a.length_squared()));
    let mut turns: Vec<f32> = Vec::new();
    let squares: f32 = piece.points.iter().chain(&panel.points).map(|at| at.length_squared()).sum();
    let far = |it: &Vec2| squares - 2.0 * it.length() > HOPELESS * HOPELESS * POINTS as f32;
    for angle in all.into_iter().filter(|it| !far(it)).map(Vec2::to_angle) {
        if turns.len() < MOST_TURNS && turns.iter().all(|known| wrapped(known - angle).abs() > APART) {
            turns.push(angle);
        }
    }
    turns
}

/// The turn near `angle` that brings the piece's points nearest to the panel's line, and the root of their mean square distance:
/// Gauss and Newton's method on the distances to the nearest sides.
fn refined(piece: &Shape, panel: &Shape, mut angle: f32) -> (f32, f32) {
    let (mut by, mut error) = (Vec2::ZERO, f32::INFINITY);
    for _ in 0..=STEPS {
        let turn = Mat2::from_angle(angle);
        let (mut matrix, mut right, mut sum) = (Mat3::ZERO, Vec3::ZERO, 0.0);
        for point in &piece.points {
            let turned = turn * *point;
            let (off, along) = off(&panel.line, turned + by);
            sum += off.length_squared();
            // Only the distance across the nearest side counts; at a corner all of it.
            let normal = off.try_normalize().unwrap_or(along.perp());
            let row = normal.extend(normal.dot(turned.perp()));
            matrix += Mat3::from_cols(row * row.x, row * row.y, row * row.z);
            right += row * normal.dot(off);
        }
        error = (sum / POINTS as f32).sqrt();
        // A circle fits at any turn: leave it where it is.
        let step = (matrix + Mat3::from_diagonal(Vec3::splat(1e-4))).inverse() * right;
        if !step.is_finite() || !error.is_finite() {
            return (wrapped(angle), f32::INFINITY);
        }
        (by, angle) = (by - step.truncate(), angle - step.z);
        if step.abs().max_element() < SMALL {
            break;
        }
    }
    (wrapped(angle), error)
}

/// From the nearest point of a closed line to `at`, and the direction of its side.
fn off(line: &[Vec2], at: Vec2) -> (Vec2, Vec2) {
    let mut best = (Vec2::INFINITY, Vec2::X, f32::INFINITY);
    for k in 0..line.len() {
        let (a, b) = (line[k], line[(k + 1) % line.len()]);
        let along = b - a;
        let share = ((at - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let off = at - a - if share.is_finite() { along * share } else { Vec2::ZERO };
        let distance = off.length_squared();
        if distance < best.2 {
            best = (off, along.normalize_or(Vec2::X), distance);
        }
    }
    (best.0, best.1)
}

/// The same angle within half a turn of 0.
fn wrapped(angle: f32) -> f32 {
    (angle + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A piece like no other, its points as far apart as they come.
    fn sleeve() -> Vec<Vec2> {
        let bell = |k: i32| Vec2::new(0.3 - 0.02 * k as f32, 0.5 + 0.15 * (k as f32 * 0.21).sin().powi(2));
        let mut line = vec![Vec2::new(-0.2, 0.0), Vec2::new(0.22, 0.0), Vec2::new(0.3, 0.48)];
        line.extend((0..31).map(bell));
        line
    }

    fn placed(line: &[Vec2], degrees: f32, mirrored: bool) -> Shape {
        let turn = Mat2::from_angle(degrees.to_radians());
        let place = |at: &Vec2| {
            let at = if mirrored { Vec2::new(-at.x, at.y) } else { *at };
            1000.0 * (turn * at) + Vec2::new(700.0, -200.0)
        };
        // It starts elsewhere too.
        let mut line: Vec<Vec2> = line.iter().map(place).collect();
        let third = line.len() / 3;
        line.rotate_left(third);
        Shape::new(&line).unwrap()
    }

    #[test]
    fn a_turned_piece_is_found_again_to_a_hundredth_of_a_degree() {
        let panel = Shape::new(&sleeve()).unwrap();
        for degrees in [0.0, 0.7, 30.0, 90.0, 123.4, -179.0, -45.0] {
            for mirrored in [false, true] {
                let found = fit(&placed(&sleeve(), degrees, mirrored), &panel).unwrap();
                // Turned after it was mirrored: undone the other way round.
                let expected = if mirrored { degrees } else { -degrees };
                let off = wrapped(found.angle - expected.to_radians()).to_degrees();
                assert!(off.abs() < 0.01, "{degrees} {mirrored}: {off}");
                assert!(found.is_mirrored == mirrored && found.is_sure && found.error < 1e-3, "{found:?}");
                let along = Vec2::from_angle(0.3);
                let drawn = Mat2::from_angle(degrees.to_radians())
                    * if mirrored { Vec2::new(-along.x, along.y) } else { along };
                assert!(found.turned(drawn).distance(along) < 1e-3);
            }
        }
    }

    #[test]
    fn what_fits_in_several_ways_is_not_sure_and_other_shapes_do_not_fit() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let square_shape = Shape::new(&square).unwrap();
        let turned = fit(&placed(&square, 30.0, false), &square_shape).unwrap();
        assert!(!turned.is_sure && (turned.angle.to_degrees() + 30.0).abs() < 0.01, "{turned:?}");
        assert!(fit(&placed(&square, 0.0, false), &square_shape).unwrap().is_sure, "as it is drawn");
        let strip = [Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(3.0, 1.0), Vec2::Y];
        let found = fit(&placed(&strip, 40.0, false), &Shape::new(&strip).unwrap()).unwrap();
        assert!(found.is_sure, "half a turn is the same line: {found:?}");
        assert_eq!(fit(&square_shape, &Shape::new(&strip).unwrap()), None);
        assert_eq!(fit(&placed(&sleeve(), 0.0, false), &square_shape), None);
    }

    #[test]
    fn lines_that_bound_nothing_have_no_shape() {
        for line in [vec![], vec![Vec2::ONE], vec![Vec2::ZERO, Vec2::X], vec![Vec2::ZERO; 9]] {
            assert_eq!(Shape::new(&line), None);
        }
        assert_eq!(Shape::new(&[Vec2::ZERO, Vec2::splat(f32::MAX), Vec2::new(f32::MAX, 0.0)]), None);
    }
}

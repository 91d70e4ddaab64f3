//! What gestures do to a view. Pure: from settings and places to settings.
//!
//! A *place* is a point of the picture: from its middle to the right and up, in half heights of the picture.

use amc_core::render::{Bounds, Projection};
use glam::{DQuat, DVec3, Vec2};
use studio_plugin::document::{Angles, TurningStyle, ViewSettings};

/// How far from upright a turntable tips: short of 90 degrees, where yaw and roll would be one.
const MOST_TIP_DEGREES: f64 = 89.9;

/// How much of the picture a framed object fills.
const FRAMED: f64 = 0.85;

/// The radius, in half heights, of the ball that drags turn: at zoom 1 it holds the object. `aspect` is the picture's
/// width over its height.
pub fn ball_radius(aspect: f32) -> f32 {
    aspect.min(1.0)
}

/// Turns the object, which stood in `start` when the drag began at the place `from`, for the pointer at `to`.
pub fn turn(settings: &mut ViewSettings, start: DQuat, from: Vec2, to: Vec2, aspect: f32) {
    let [from, to] = [from, to].map(|place| place / ball_radius(aspect));
    match settings.turning {
        TurningStyle::Arcball => settings.set_orientation(arcball(from, to) * start),
        TurningStyle::Turntable => turn_table(settings, start, to - from),
    }
}

/// The turn of a ball of radius 1 that is grabbed at `from` and held at `to`; outside of the ball it is held at its
/// outline. Source: K. Shoemake, "ARCBALL: A User Interface for Specifying Three-Dimensional Orientation Using a Mouse",
/// Graphics Interface 1992; there the turn is twice as far, here the grabbed point stays under the pointer.
pub fn arcball(from: Vec2, to: Vec2) -> DQuat {
    let (from, to) = (on_ball(from), on_ball(to));
    let axis = from.cross(to);
    // From outline to outline right across: over the ball's front.
    let axis = axis.try_normalize().or_else(|| from.cross(DVec3::Z).try_normalize());
    match axis {
        Some(axis) if from.dot(to) < 1.0 - 1e-14 => DQuat::from_axis_angle(axis, from.angle_between(to)),
        _ => DQuat::IDENTITY,
    }
}

fn on_ball(place: Vec2) -> DVec3 {
    let place = place.as_dvec2();
    match 1.0 - place.length_squared() {
        z if z > 0.0 => place.extend(z.sqrt()),
        _ => place.normalize_or(glam::DVec2::X).extend(0.0),
    }
}

/// A drag as long as the ball is wide is half a turn, here too.
fn turn_table(settings: &mut ViewSettings, start: DQuat, by: Vec2) {
    settings.set_orientation(start);
    let Angles { yaw, pitch, roll } = settings.angles();
    settings.set_angles(Angles {
        yaw: yaw + 90.0 * f64::from(by.x),
        pitch: (pitch - 90.0 * f64::from(by.y)).clamp(-MOST_TIP_DEGREES, MOST_TIP_DEGREES),
        roll,
    });
}

/// Turns the object by degrees to the right and up, as the settings' style turns.
pub fn turn_by(settings: &mut ViewSettings, right: f64, up: f64) {
    let start = settings.orientation();
    match settings.turning {
        TurningStyle::Turntable => {
            turn_table(settings, start, (glam::DVec2::new(right, up) / 90.0).as_vec2());
        }
        TurningStyle::Arcball => {
            let turn = DQuat::from_rotation_y(right.to_radians()) * DQuat::from_rotation_x(-up.to_radians());
            settings.set_orientation(turn * start);
        }
    }
}

/// Turns the object about its own vertical axis, by degrees.
pub fn spin(settings: &mut ViewSettings, degrees: f64) {
    settings.set_orientation(settings.orientation() * DQuat::from_rotation_y(degrees.to_radians()));
}

/// Turns the object about the line of sight, as the pointer goes around the picture's middle.
pub fn roll(settings: &mut ViewSettings, start: DQuat, from: Vec2, to: Vec2) {
    // No direction at the very middle: no turn.
    let angle = if from == Vec2::ZERO || to == Vec2::ZERO { 0.0 } else { from.angle_to(to) };
    settings.set_orientation(DQuat::from_rotation_z(angle.into()) * start);
}

/// Moves the object, which stood at the pan `start`, along with the pointer.
pub fn pan(settings: &mut ViewSettings, start: Vec2, from: Vec2, to: Vec2) {
    set_pan(settings, start + to - from);
}

/// Magnifies by `factor`; what is seen at `place` stays there. In perspective that holds in the plane of the object's
/// centre.
pub fn zoom(settings: &mut ViewSettings, place: Vec2, factor: f32) {
    if !factor.is_finite() {
        return;
    }
    let before = settings.zoom;
    settings.zoom = (before * factor).clamp(ViewSettings::LEAST_ZOOM, ViewSettings::MOST_ZOOM);
    set_pan(settings, place - (place - settings.pan) * (settings.zoom / before));
}

/// Brings the part of the object within `target` into the middle of a picture of `width` x `height` pixels, and makes it
/// fill that. `bounds` are the whole object's.
pub fn frame(settings: &mut ViewSettings, bounds: Bounds, target: Bounds, width: u32, height: u32) {
    settings.fit();
    let view = settings.view(bounds, width, height);
    let shorter_side = (f64::from(width) / f64::from(height)).min(1.0);
    let centre = view.object_to_view.as_dmat4().transform_point3(target.centre);
    let wanted = target.radius / shorter_side / FRAMED;
    let zoom = match view.projection {
        Projection::Orthographic { half_height } => f64::from(half_height) / wanted,
        Projection::Perspective { fov_y } => {
            // Where a sphere reaches to, in a plane as far away as its centre.
            let depth = (-centre.z).max(1.01 * target.radius);
            let reach = wanted * depth / (depth * depth - target.radius * target.radius).sqrt();
            (f64::from(fov_y) / 2.0).tan() * depth / reach
        }
    };
    settings.zoom = (zoom as f32).clamp(ViewSettings::LEAST_ZOOM, ViewSettings::MOST_ZOOM);
    let half_height = settings.half_height(bounds, width, height);
    set_pan(settings, -(centre.truncate() / half_height).as_vec2());
}

fn set_pan(settings: &mut ViewSettings, pan: Vec2) {
    if pan.is_finite() {
        settings.pan = pan.clamp(Vec2::splat(-ViewSettings::MOST_PAN), Vec2::splat(ViewSettings::MOST_PAN));
    }
}

#[cfg(test)]
mod tests;

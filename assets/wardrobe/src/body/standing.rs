//! The standing adult: a lofted torso with round arms and legs, smoothly joined.
//!
//! Girths are of the order of common size tables for a height of 1.75 m: chest 0.96 m, waist 0.80 m, hips 0.98 m, neck 0.38 m,
//! upper arm 0.30 m, wrist 0.17 m. The head is an egg: it keeps a scarf from slipping off.

use glam::{DVec2, DVec3};

use super::Limb;
use super::field::Space;

/// The space that holds the figure.
pub(super) const SPACE: Space =
    Space { low: DVec3::new(-0.75, -0.05, -0.30), high: DVec3::new(0.75, 1.82, 0.35) };

/// A horizontal section of the torso: an ellipse.
struct Section {
    height: f64,
    half_width: f64,
    half_depth: f64,
    /// How far its centre lies before the body's axis.
    forward: f64,
}

const fn section(height: f64, half_width: f64, half_depth: f64, forward: f64) -> Section {
    Section { height, half_width, half_depth, forward }
}

/// From the crotch into the head, metres.
const TORSO: [Section; 13] = [
    section(0.76, 0.120, 0.085, -0.005),
    section(0.82, 0.168, 0.118, -0.006),
    section(0.90, 0.178, 0.132, -0.008),
    section(0.98, 0.164, 0.120, 0.000),
    section(1.06, 0.145, 0.107, 0.004),
    section(1.14, 0.156, 0.116, 0.003),
    section(1.22, 0.175, 0.128, 0.000),
    section(1.31, 0.180, 0.118, -0.006),
    section(1.38, 0.172, 0.092, -0.012),
    section(1.425, 0.125, 0.076, -0.012),
    section(1.46, 0.068, 0.066, -0.006),
    section(1.52, 0.058, 0.062, 0.004),
    section(1.60, 0.058, 0.062, 0.016),
];

/// A length of an arm or leg: round, from one radius to another.
struct Bone {
    from: DVec3,
    from_radius: f64,
    to: DVec3,
    to_radius: f64,
}

const SHOULDER: DVec3 = DVec3::new(0.160, 1.372, -0.008);
/// Unit direction of the left arm: 42 degrees from the side.
const ARM: DVec3 = DVec3::new(0.669_130_606, -0.743_144_825, 0.0);
const HIP: DVec3 = DVec3::new(0.092, 0.86, -0.005);
const KNEE: DVec3 = DVec3::new(0.112, 0.48, 0.005);
const ANKLE: DVec3 = DVec3::new(0.130, 0.08, -0.02);
const TOES: DVec3 = DVec3::new(0.145, 0.035, 0.11);
const HEAD: DVec3 = DVec3::new(0.0, 1.645, 0.022);
const HEAD_RADII: DVec3 = DVec3::new(0.076, 0.112, 0.096);
/// How far from the shoulder joint the elbow, the wrist and the knuckles are.
const ELBOW_AT: f64 = 0.30;
const WRIST_AT: f64 = 0.555;
const KNUCKLES_AT: f64 = 0.65;

/// Width of the joins between torso and limbs, metres.
const BLEND: f64 = 0.035;

/// The limbs that pieces can be wrapped round.
pub(super) fn limbs() -> Vec<Limb> {
    let mirrored = |p: DVec3| DVec3::new(-p.x, p.y, p.z);
    let wrist = SHOULDER + ARM * WRIST_AT;
    vec![
        Limb::new("torso", DVec3::new(0.0, 1.45, 0.0), DVec3::new(0.0, 0.80, 0.0), DVec3::Z),
        Limb::new("neck", DVec3::new(0.0, 1.55, 0.0), DVec3::new(0.0, 1.45, 0.0), DVec3::Z),
        Limb::new("left arm", SHOULDER, wrist, DVec3::X),
        Limb::new("right arm", mirrored(SHOULDER), mirrored(wrist), DVec3::NEG_X),
        Limb::new("left leg", HIP, ANKLE, DVec3::Z),
        Limb::new("right leg", mirrored(HIP), mirrored(ANKLE), DVec3::Z),
    ]
}

/// Zero on the skin, negative inside; a distance but for a slowly varying factor.
pub(super) fn distance(point: DVec3) -> f64 {
    let mirrored = DVec3::new(point.x.abs(), point.y, point.z);
    let arm = arm_bones()
        .iter()
        .map(|bone| bone_distance(bone, mirrored))
        .fold(f64::INFINITY, |a, b| smooth_least(a, b, 0.015));
    let leg = leg_bones()
        .iter()
        .map(|bone| bone_distance(bone, mirrored))
        .fold(f64::INFINITY, |a, b| smooth_least(a, b, 0.02));
    let trunk = smooth_least(torso_distance(point), head_distance(point), 0.02);
    smooth_least(smooth_least(trunk, arm, BLEND), leg, BLEND)
}

fn head_distance(point: DVec3) -> f64 {
    let arm = point - HEAD;
    let (scaled, steep) = ((arm / HEAD_RADII).length(), (arm / (HEAD_RADII * HEAD_RADII)).length());
    if steep > 1e-9 { scaled * (scaled - 1.0) / steep } else { -HEAD_RADII.min_element() }
}

fn arm_bones() -> [Bone; 3] {
    let at = |along: f64| SHOULDER + ARM * along;
    [
        Bone { from: SHOULDER, from_radius: 0.054, to: at(ELBOW_AT), to_radius: 0.0415 },
        Bone { from: at(ELBOW_AT), from_radius: 0.0415, to: at(WRIST_AT), to_radius: 0.027 },
        Bone { from: at(WRIST_AT + 0.03), from_radius: 0.028, to: at(KNUCKLES_AT), to_radius: 0.033 },
    ]
}

fn leg_bones() -> [Bone; 3] {
    [
        Bone { from: HIP, from_radius: 0.090, to: KNEE, to_radius: 0.060 },
        Bone { from: KNEE, from_radius: 0.060, to: ANKLE, to_radius: 0.038 },
        Bone { from: ANKLE - DVec3::Y * 0.03, from_radius: 0.036, to: TOES, to_radius: 0.032 },
    ]
}

fn torso_distance(point: DVec3) -> f64 {
    let section = torso_section(point.y);
    let planar = DVec2::new(point.x, point.z - section.forward);
    let radii = DVec2::new(section.half_width, section.half_depth);
    let (scaled, steep) = ((planar / radii).length(), (planar / (radii * radii)).length());
    let across = if steep > 1e-9 { scaled * (scaled - 1.0) / steep } else { -radii.min_element() };
    let (bottom, top) = (TORSO[0].height, TORSO[TORSO.len() - 1].height);
    let beyond = (bottom - point.y).max(point.y - top);
    let rim = 0.03;
    let (a, b) = (across + rim, beyond + rim);
    a.max(b).min(0.0) + DVec2::new(a.max(0.0), b.max(0.0)).length() - rim
}

/// The section at a height, by a spline through the table's (Catmull and Rom 1974).
fn torso_section(height: f64) -> Section {
    let last = TORSO.len() - 1;
    let height = height.clamp(TORSO[0].height, TORSO[last].height);
    let upper = TORSO.iter().position(|s| s.height >= height).unwrap_or(last).clamp(1, last);
    let (a, b) = (&TORSO[upper - 1], &TORSO[upper]);
    let (before, after) = (&TORSO[(upper - 1).saturating_sub(1)], &TORSO[(upper + 1).min(last)]);
    let t = (height - a.height) / (b.height - a.height);
    let curve = |value: fn(&Section) -> f64| {
        let width = b.height - a.height;
        let slope_a = (value(b) - value(before)) / (b.height - before.height) * width;
        let slope_b = (value(after) - value(a)) / (after.height - a.height) * width;
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * value(a)
            + (t3 - 2.0 * t2 + t) * slope_a
            + (3.0 * t2 - 2.0 * t3) * value(b)
            + (t3 - t2) * slope_b
    };
    section(height, curve(|s| s.half_width), curve(|s| s.half_depth), curve(|s| s.forward))
}

/// A cone with ball ends, the radius taken at the nearest point of the axis.
fn bone_distance(bone: &Bone, point: DVec3) -> f64 {
    let axis = bone.to - bone.from;
    let t = ((point - bone.from).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    point.distance(bone.from + axis * t) - (bone.from_radius + (bone.to_radius - bone.from_radius) * t)
}

/// The lesser of two distances, rounded where they are within `width` of each other (quadratic polynomial, after Quilez).
fn smooth_least(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0) / width;
    a.min(b) - overlap * overlap * width * 0.25
}

//! What garments are draped on: simple shapes as signed distances.

mod field;
mod standing;
#[cfg(test)]
mod tests;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use field::Field;

/// What a garment is draped on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// A standing adult, 1.75 m, arms held away from the sides. Feet at y = 0, front towards +z, the wearer's left at +x.
    ///
    /// Limbs to wrap pieces round: `torso` (start: the neck's root), `neck` (start: the chin), `left arm`, `right arm`
    /// (start: the shoulder joint), `left leg`, `right leg` (start: the hip joint).
    Standing,
    /// A ball of 0.3 m radius, centre at y = 1 m. No limbs.
    Ball,
}

impl Figure {
    /// What pieces can be wrapped round.
    #[must_use]
    pub fn limbs(self) -> Vec<Limb> {
        match self {
            Self::Standing => standing::limbs(),
            Self::Ball => Vec::new(),
        }
    }
}

/// The centre of [`Figure::Ball`], metres.
pub const BALL_CENTRE: DVec3 = DVec3::new(0.0, 1.0, 0.0);
/// The radius of [`Figure::Ball`], metres.
pub const BALL_RADIUS: f64 = 0.3;

/// A part of a body that a piece can be wrapped round: a straight line with a front.
#[derive(Debug, Clone, PartialEq)]
pub struct Limb {
    /// Its name: see [`Figure`].
    pub name: &'static str,
    /// Where it starts, metres.
    pub start: DVec3,
    /// Unit direction from its start to its end.
    pub axis: DVec3,
    /// Unit direction of angle 0, perpendicular to the axis: the front, on an arm the outer side.
    pub front: DVec3,
}

impl Limb {
    fn new(name: &'static str, start: DVec3, end: DVec3, towards_front: DVec3) -> Self {
        let axis = (end - start).normalize_or(DVec3::NEG_Y);
        Self { name, start, axis, front: towards_front.reject_from(axis).normalize_or(DVec3::Z) }
    }

    /// Unit direction of angle 90 degrees, counter-clockwise from the front as seen from the start.
    #[must_use]
    pub fn side(&self) -> DVec3 {
        self.front.cross(self.axis)
    }
}

/// A figure ready for collision: its signed distance and its limbs.
#[derive(Debug, Clone)]
pub struct Body {
    field: Field,
    limbs: Vec<Limb>,
}

impl Body {
    /// The body of a figure. The standing adult is sampled once on a grid of 1 cm, about half a second's work.
    #[must_use]
    pub fn new(figure: Figure) -> Self {
        let field = match figure {
            Figure::Standing => Field::sampled(&standing::SPACE, standing::distance),
            Figure::Ball => Field::ball(BALL_CENTRE, BALL_RADIUS),
        };
        Self { field, limbs: figure.limbs() }
    }

    /// Distance from the surface, metres, negative inside; close to the true one near the surface, of the right sign
    /// and order elsewhere.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        self.field.distance(point)
    }

    /// The distance, and the unit direction in which it grows fastest.
    #[must_use]
    pub fn surface(&self, point: DVec3) -> (f64, DVec3) {
        self.field.surface(point)
    }

    /// The limb of that name.
    #[must_use]
    pub fn limb(&self, name: &str) -> Option<&Limb> {
        self.limbs.iter().find(|limb| limb.name == name)
    }

    /// All limbs.
    #[must_use]
    pub fn limbs(&self) -> &[Limb] {
        &self.limbs
    }
}

//! What a person draws, as it is kept in a project.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::super::Field;
use crate::{Error, Result};

/// A panel's direction combed by strokes, as hair is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Comb {
    /// In the order they were drawn; at most [`Comb::MOST_STROKES`].
    pub strokes: Vec<Stroke>,
    /// What the direction follows away from the strokes.
    pub elsewhere: Elsewhere,
    /// Metres over which the direction turns from that of a stroke to that of elsewhere: it comes nearer by a factor
    /// of e in each. Positive. With [`Elsewhere::Boundary`] it is how loosely the boundary holds; with
    /// [`Elsewhere::Smooth`] it has no meaning.
    pub reach: f32,
    /// Radians by which the direction is turned from that of strokes, fields and boundary, counter-clockwise in the flat
    /// pattern (without one: as seen from the front): 0 lays the warp along the strokes, a quarter turn the weft.
    /// In files, degrees: `turn_deg`.
    #[serde(rename = "turn_deg", with = "degrees")]
    pub turn: f32,
}

/// Radians, written as degrees.
mod degrees {
    use serde::{Deserialize, Deserializer, Serializer};

    use crate::mesh::extras::shortest_degrees;

    pub(super) fn serialize<S: Serializer>(radians: &f32, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(shortest_degrees(*radians))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
        f64::deserialize(from).map(|degrees| degrees.to_radians() as f32)
    }
}

/// What a direction follows away from the strokes.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Elsewhere {
    /// The panel's own direction: that of its UVs, at its angle.
    #[default]
    Own,
    /// Nothing: the smoothest field that follows the strokes.
    Smooth,
    /// A field in object space: around an axis, away from a point, along an axis.
    Field(Field),
    /// Away from a point of the flat pattern, in UVs: straight lines there.
    Radial(Vec2),
    /// Around a point of the flat pattern, in UVs, counter-clockwise as drawn with v up: circles there.
    Circular(Vec2),
    /// Along the panel's boundary, the cloth on the left as seen from the front; as smooth as can be inside.
    Boundary,
}

/// One stroke of the comb: its direction is from its first point to its last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Where it goes.
    pub path: Path,
    /// How it is followed.
    pub hold: Hold,
    /// Metres to either side within which the direction is held too, less and less; positive.
    pub radius: f32,
    /// Whether it counts.
    pub is_on: bool,
}

/// Where a stroke goes: a line through at most [`Comb::MOST_POINTS`] points. One without length says nothing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Path {
    /// In the flat pattern, in UVs: it stays on the cloth whatever the mesh's resolution and drape.
    Pattern(Vec<Vec2>),
    /// In object space, metres, taken to the nearest point of the surface: for panels without UVs.
    Space(Vec<Vec3>),
}

/// How a stroke is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Hold {
    /// The corners of every triangle that the stroke crosses have its direction.
    Exact,
    /// Approximately, the more so the greater the weight, in (0, [`Comb::MOST_WEIGHT`]]. With weight 1 a stroke whose radius
    /// is the reach is followed to about nine tenths of the way from what elsewhere asks for.
    Soft(f32),
}

impl Default for Comb {
    fn default() -> Self {
        Self { strokes: Vec::new(), elsewhere: Elsewhere::Own, reach: 0.1, turn: 0.0 }
    }
}

impl Comb {
    /// Most strokes of a panel.
    pub const MOST_STROKES: usize = 256;
    /// Most points of a stroke.
    pub const MOST_POINTS: usize = 4096;
    /// Greatest weight of a soft stroke.
    pub const MOST_WEIGHT: f32 = 1000.0;
    /// Longest radius and reach, metres.
    pub const LONGEST: f32 = 1000.0;
    /// Shortest radius and reach, metres.
    pub const SHORTEST: f32 = 1e-4;

    /// About how much memory it takes.
    pub fn bytes(&self) -> usize {
        let points = |stroke: &Stroke| match &stroke.path {
            Path::Pattern(points) => size_of_val(&points[..]),
            Path::Space(points) => size_of_val(&points[..]),
        };
        size_of::<Self>()
            + self.strokes.iter().map(|stroke| size_of::<Stroke>() + points(stroke)).sum::<usize>()
    }

    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// More strokes or points than the limits, a number that is not finite or not in its range. The place is the stroke.
    pub fn check(&self) -> Result<()> {
        if self.strokes.len() > Self::MOST_STROKES {
            return Err(Error::too_large(format!(
                "{} strokes on a panel; at most {} are allowed: delete some",
                self.strokes.len(),
                Self::MOST_STROKES
            )));
        }
        check_length("the reach", self.reach)?;
        if !self.turn.is_finite() {
            return Err(Error::invalid("the turn is not a finite number"));
        }
        match self.elsewhere {
            Elsewhere::Field(field) => field.check()?,
            Elsewhere::Radial(centre) | Elsewhere::Circular(centre) if !centre.is_finite() => {
                return Err(Error::invalid("the centre in the flat pattern is not finite"));
            }
            _ => {}
        }
        for (index, stroke) in self.strokes.iter().enumerate() {
            stroke.check().map_err(|error| error.at_element(format!("stroke {}", index + 1)))?;
        }
        Ok(())
    }
}

impl Stroke {
    fn check(&self) -> Result<()> {
        let (count, is_finite) = match &self.path {
            Path::Pattern(points) => (points.len(), points.iter().all(|point| point.is_finite())),
            Path::Space(points) => (points.len(), points.iter().all(|point| point.is_finite())),
        };
        if count > Comb::MOST_POINTS {
            let most = Comb::MOST_POINTS;
            return Err(Error::too_large(format!("{count} points; at most {most} are allowed")));
        }
        if !is_finite {
            return Err(Error::invalid("a point is not finite"));
        }
        if let Hold::Soft(weight) = self.hold
            && !(weight > 0.0 && weight <= Comb::MOST_WEIGHT)
        {
            let most = Comb::MOST_WEIGHT;
            return Err(Error::invalid(format!("the weight {weight} is not above 0 and at most {most}")));
        }
        check_length("the radius", self.radius)
    }
}

fn check_length(name: &str, length: f32) -> Result<()> {
    if (Comb::SHORTEST..=Comb::LONGEST).contains(&length) {
        return Ok(());
    }
    let (low, high) = (Comb::SHORTEST, Comb::LONGEST);
    Err(Error::invalid(format!("{name}, {length} metres, is not from {low} to {high}")))
}

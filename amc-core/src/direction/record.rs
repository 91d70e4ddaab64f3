//! What a file says of one panel's direction.

use serde::Deserialize;

use super::{Orientation, Source};

/// What a file says of one panel's direction: an entry of the JSON that [`crate::export::tangents`] writes, or the `extras`
/// of a primitive in its GLB. Whatever is not said is none; other keys are passed over.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Record {
    /// The panel's id.
    pub id: Option<String>,
    /// The panel's name.
    pub name: Option<String>,
    /// Where the direction comes from.
    pub source: Option<Source>,
    /// Degrees in the flat pattern, as [`super::Direction::angle`] counts them.
    pub angle_deg: Option<f64>,
    /// Whether strokes comb the panel: the direction is the one under them.
    pub combed: Option<bool>,
    /// In which turns the panel may be laid.
    pub orientation: Option<Orientation>,
    /// The name of its fabric.
    pub fabric: Option<String>,
    /// Whether its direction is kept from being changed.
    pub locked: Option<bool>,
    /// Whether its mirror partner follows it.
    pub linked: Option<bool>,
}

//! What is said of a panel beside its vertices.

use serde::Serialize;

use super::Piece;
use crate::direction::{Direction, Orientation, Source};
use crate::mesh::Garment;
use crate::mesh::extras::{Extras, shortest_degrees};

/// What is said of a panel beside its direction.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Said {
    /// The name of its fabric; none: it has none, or nobody knows.
    pub fabric: Option<String>,
    /// In which turns it may be laid on the cloth.
    pub orientation: Orientation,
    /// Whether its direction is kept from being changed.
    pub is_locked: bool,
    /// Whether its mirror partner follows it.
    pub is_linked: bool,
}

/// The same as a file has it. [`crate::direction::Record`] reads it.
#[derive(Debug, Serialize)]
pub(super) struct About<'a> {
    id: &'a str,
    name: &'a str,
    source: Source,
    angle_deg: f64,
    takes_fabric: bool,
    grain_deg: Option<f64>,
    follows_pattern: bool,
    combed: bool,
    warp_weft_swapped: bool,
    fabric: Option<&'a str>,
    orientation: Orientation,
    locked: bool,
    linked: bool,
    mirror_partner: Option<&'a str>,
    unit: &'static str,
}

impl<'a> About<'a> {
    pub(super) fn new(garment: &'a Garment, piece: &Piece<'a>) -> Self {
        let (panel, said) = (piece.mesh.panel, piece.said);
        let mirror = panel.pattern.mirror.and_then(|partner| garment.panels.get(partner));
        Self {
            id: &panel.id,
            name: &panel.name,
            source: piece.direction.source,
            angle_deg: shortest_degrees(piece.direction.angle),
            takes_fabric: panel.takes_fabric,
            grain_deg: piece.frame.grain.map(shortest_degrees),
            follows_pattern: piece.frame.follows_pattern,
            combed: piece.is_combed,
            warp_weft_swapped: piece.frame.follows_pattern && is_swapped(piece),
            fabric: said.fabric.as_deref(),
            orientation: said.orientation,
            locked: said.is_locked,
            linked: said.is_linked,
            mirror_partner: mirror.map(|panel| panel.id.as_str()),
            unit: if piece.frame.in_metres { "m" } else { "as in the file" },
        }
    }
}

/// Whether the warp runs where the weft of the panel's own grain would, to a degree.
fn is_swapped(piece: &Piece<'_>) -> bool {
    let off = piece.direction.angle - Direction::along_grain(piece.mesh.panel).angle;
    off.cos().abs() < 1f32.to_radians().sin()
}

/// What this program wants to be told when it reads the file again: there the turned UVs are the pattern.
pub(super) fn pattern(garment: &Garment, piece: &Piece<'_>) -> Extras {
    let place = |panel: usize, at| match piece.frames.get(panel) {
        Some(frame) => frame.turned.transform_point2(at),
        None => at,
    };
    Extras {
        grain_deg: piece.frame.follows_pattern.then_some(0.0),
        uv_unit_m: piece.frame.in_metres.then_some(1.0),
        ..Extras::moved(garment, piece.mesh.panel, place)
    }
}

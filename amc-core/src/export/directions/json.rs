//! Directions as JSON.

use std::io::Write;

use glam::{Vec3, Vec4};
use serde::{Serialize, Serializer};

use super::Piece;
use super::about::About;
use crate::export::GENERATOR;
use crate::mesh::Garment;
use crate::{Error, Result};

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    generator: &'static str,
    /// What the numbers mean.
    space: &'static str,
    panels: Vec<PanelRecord<'a>>,
}

#[derive(Serialize)]
struct PanelRecord<'a> {
    #[serde(flatten)]
    about: About<'a>,
    mean_direction: Option<Vec3>,
    vertices: usize,
    filled: u32,
    made_up: bool,
    positions: &'a [Vec3],
    #[serde(serialize_with = "without_w")]
    tangents: &'a [Vec4],
}

fn without_w<S: Serializer>(tangents: &&[Vec4], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(tangents.iter().map(|tangent| tangent.truncate()))
}

pub(super) fn write(garment: &Garment, pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    let panels = pieces.iter().map(|piece| PanelRecord {
        about: About::new(garment, piece),
        mean_direction: piece.mean_direction(),
        vertices: piece.mesh.positions.len(),
        filled: piece.filled,
        made_up: piece.made_up,
        positions: &piece.mesh.positions,
        tangents: &piece.tangents,
    });
    let document = Document {
        version: 1,
        generator: GENERATOR,
        space: "object space, Y up, metres",
        panels: panels.collect(),
    };
    serde_json::to_writer(out, &document).map_err(|error| Error::io("cannot write", error.into()))
}

//! Directions as the UVs of an OBJ.

use std::io::{self, Write};

use super::Piece;
use crate::direction::Source;
use crate::export::GENERATOR;
use crate::export::obj::{Obj, one_word};
use crate::{Error, Result};

pub(super) fn write(pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    for piece in pieces.iter().filter(|piece| piece.mesh.panel.takes_fabric) {
        let here = |why: &str| {
            Err(Error::unsupported(format!(
                "an OBJ holds directions as UVs only, and {why}: export .glb or .json"
            ))
            .at_element(format!("panel {}", piece.mesh.panel.id)))
        };
        if matches!(piece.direction.source, Source::Field(_)) {
            return here("this one is a procedural field");
        }
        if piece.mesh.uvs.is_none() {
            return here("there are none");
        }
    }
    write_all(pieces, out).map_err(|source| Error::io("cannot write", source))
}

fn write_all(pieces: &[Piece<'_>], out: &mut dyn Write) -> io::Result<()> {
    let mut obj = Obj::new(out);
    obj.comment(GENERATOR)?;
    obj.comment("Metres, Y up. The UVs of each group are turned so that +u is the direction of its panel.")?;
    for piece in pieces {
        let id = one_word(&piece.mesh.panel.id);
        let source = if piece.direction.source == Source::Yarn { "yarn" } else { "gradient" };
        obj.comment(format_args!("panel id={id} angle_deg={} source={source}", piece.angle_deg()))?;
        obj.panel(&piece.mesh, piece.turned_uvs().as_deref())?;
    }
    Ok(())
}

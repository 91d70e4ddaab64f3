//! Directions as the UVs of an OBJ.

use std::io::{self, Write};

use super::Piece;
use crate::direction::Source;
use crate::export::GENERATOR;
use crate::export::obj::{Obj, one_word};
use crate::mesh::Garment;
use crate::mesh::extras::shortest_degrees;
use crate::{Error, Result};

pub(super) fn write(_: &Garment, pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    for piece in pieces.iter().filter(|piece| piece.mesh.panel.takes_fabric) {
        let here = |why: &str| {
            Err(Error::unsupported(format!(
                "an OBJ holds directions as UVs only, and {why}: export .glb or .json"
            ))
            .at_element(format!("panel {}", piece.mesh.panel.id)))
        };
        if piece.mesh.uvs.is_none() {
            return here("there are none");
        }
        if piece.frame.is_field {
            return here("this one is a field or combed");
        }
    }
    write_all(pieces, out).map_err(|source| Error::io("cannot write", source))
}

fn write_all(pieces: &[Piece<'_>], out: &mut dyn Write) -> io::Result<()> {
    let mut obj = Obj::new(out);
    obj.comment(GENERATOR)?;
    obj.comment("Metres, Y up. The UVs of each group are in metres too, +u along the warp of its panel, +v along the weft.")?;
    for piece in pieces {
        let id = one_word(&piece.mesh.panel.id);
        let source = if piece.direction.source == Source::Yarn { "yarn" } else { "gradient" };
        let degrees = shortest_degrees(piece.direction.angle);
        obj.comment(format_args!("panel id={id} angle_deg={degrees} source={source}"))?;
        obj.panel(&piece.mesh, piece.turned_uvs().as_deref())?;
    }
    Ok(())
}

//! Directions as the UVs of an OBJ.

use std::fmt::Display;
use std::io::{self, Write};

use super::{GENERATOR, Piece};
use crate::direction::Source;
use crate::{Error, Result};

pub(super) fn write(pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    for piece in pieces.iter().filter(|piece| piece.panel.takes_fabric) {
        let here = |why: &str| {
            Err(Error::unsupported(format!(
                "an OBJ holds directions as UVs only, and {why}: export .glb or .json"
            ))
            .at_element(format!("panel {}", piece.panel.id)))
        };
        if matches!(piece.direction.source, Source::Field(_)) {
            return here("this one is a procedural field");
        }
        if piece.uvs.is_none() {
            return here("there are none");
        }
    }
    write_all(pieces, out).map_err(|source| Error::io("cannot write", source))
}

fn write_all(pieces: &[Piece<'_>], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "# {GENERATOR}")?;
    writeln!(
        out,
        "# Metres, Y up. The UVs of each group are turned so that +u is the direction of its panel."
    )?;
    let mut first = 1;
    for piece in pieces {
        let id = one_word(&piece.panel.id);
        let source = if piece.direction.source == Source::Yarn { "yarn" } else { "gradient" };
        writeln!(out, "# panel id={id} angle_deg={} source={source}", piece.angle_deg())?;
        writeln!(out, "g {}", one_word(&piece.panel.name))?;
        lines(out, "v", piece.positions.iter().map(|p| p.to_array()))?;
        lines(out, "vn", piece.normals.iter().map(|n| n.to_array()))?;
        let uvs = piece.turned_uvs();
        if let Some(uvs) = &uvs {
            lines(out, "vt", uvs.iter().map(|uv| uv.to_array()))?;
        }
        for corners in &piece.triangles {
            write!(out, "f")?;
            for corner in corners {
                let k = first + u64::from(*corner);
                // Without UVs there are none in the whole file, so their count never runs behind the vertices'.
                if uvs.is_some() { write!(out, " {k}/{k}/{k}")? } else { write!(out, " {k}//{k}")? }
            }
            writeln!(out)?;
        }
        first += piece.positions.len() as u64;
    }
    Ok(())
}

fn lines<const N: usize>(
    out: &mut dyn Write,
    keyword: &str,
    rows: impl Iterator<Item = [impl Display; N]>,
) -> io::Result<()> {
    for row in rows {
        write!(out, "{keyword}")?;
        for number in row {
            write!(out, " {number}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// A name as one word on one line, which is all that OBJ can hold.
fn one_word(name: &str) -> String {
    let word: String =
        name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
    if word.is_empty() { "panel".to_owned() } else { word }
}

//! Directions as a glTF 2.0 binary.

use std::io::Write;

use serde_json::json;

use super::about::{About, pattern};
use super::{Piece, material};
use crate::Result;
use crate::export::glb::{Attributes, Glb, check_size, plain_material};
use crate::mesh::Garment;

/// Bytes of a vertex: position, normal, tangent, warp, weft, two sets of UVs.
const PER_VERTEX: usize = 12 + 12 + 16 + 12 + 12 + 8 + 8;

pub(super) fn write(garment: &Garment, pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    check_size(pieces.iter().map(|piece| &piece.mesh), PER_VERTEX)?;
    let mut glb = Glb::default();
    let texture = if garment.has_uvs { Some(glb.add_texture(&material::texture()?)) } else { None };
    for piece in pieces {
        let (mesh, mut attributes) = (&piece.mesh, Attributes::default());
        glb.add(&mut attributes, "TANGENT", "VEC4", &piece.tangents);
        for (name, yarns) in ["_WARP", "_WEFT"].into_iter().zip(&piece.yarns) {
            glb.add(&mut attributes, name, "VEC3", yarns);
        }
        for (name, uvs) in [("TEXCOORD_0", piece.turned_uvs()), ("TEXCOORD_1", mesh.uvs.clone())] {
            if let Some(uvs) = uvs {
                glb.add_uvs(&mut attributes, name, uvs);
            }
        }
        let material = match mesh.panel.takes_fabric {
            true => material::cloth(piece.said.fabric.as_deref().unwrap_or("cloth"), texture),
            false => plain_material("no cloth"),
        };
        let material = glb.add_material(material);
        let mut extras = json!(About::new(garment, piece));
        extras["amc"] = json!(pattern(garment, piece));
        glb.add_panel(mesh, attributes, material, extras);
    }
    glb.write(out)
}

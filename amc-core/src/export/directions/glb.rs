//! Directions as the tangents of a glTF 2.0 binary.

use std::io::Write;

use serde_json::json;

use super::Piece;
use crate::Result;
use crate::export::glb::{Attributes, Glb, check_size};

/// Bytes of a vertex: position, normal, tangent, two sets of UVs.
const PER_VERTEX: usize = 12 + 12 + 16 + 8 + 8;

pub(super) fn write(pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    check_size(pieces.iter().map(|piece| &piece.mesh), PER_VERTEX)?;
    let mut glb = Glb::default();
    for piece in pieces {
        let (mesh, mut attributes) = (&piece.mesh, Attributes::default());
        glb.add(&mut attributes, "TANGENT", "VEC4", &piece.tangents);
        for (name, uvs) in [("TEXCOORD_0", piece.turned_uvs()), ("TEXCOORD_1", mesh.uvs.clone())] {
            if let Some(uvs) = uvs {
                glb.add_uvs(&mut attributes, name, uvs);
            }
        }
        let extras = json!({
            "id": mesh.panel.id,
            "name": mesh.panel.name,
            "source": piece.direction.source,
            "angle_deg": piece.angle_deg(),
            "takes_fabric": mesh.panel.takes_fabric,
        });
        glb.add_panel(mesh, attributes, extras);
    }
    glb.write(out)
}

//! Garments as they are, with what their pattern says.

#[cfg(test)]
mod tests;

use std::io::{self, Write};
use std::path::Path;

use serde_json::json;

use super::glb::{Attributes, Glb, check_size, plain_material};
use super::obj::{Obj, one_word};
use super::{GENERATOR, PanelMesh, check};
use crate::mesh::extras::{Extras, shortest_degrees};
use crate::mesh::{Garment, Seam};
use crate::{Error, Result, file};

/// Bytes of a vertex: position, normal, UVs.
const PER_VERTEX: usize = 12 + 12 + 8;

/// Saves a garment as it is, without directions; the suffix of `path` says how.
///
/// - `.glb`: glTF 2.0, a node and a mesh of one primitive per panel, named like the panel, with `POSITION`, `NORMAL`,
///   `TEXCOORD_0` (the flat pattern, v down as glTF has it: 1 - v) and in `extras` name, fabric, grain, unit, mirror
///   partner and seams (see [`crate::mesh::gltf`]). Indices have 16 bits where they fit. Read again it is the same garment; UVs
///   are so to the bit where v is a multiple of 2^-22 between -3 and 4, because then 1 - v is exact.
/// - `.obj`: a group per panel, UVs with v up and to the bit; what the pattern says stands in comments, for people.
///
/// Metres, Y up. The same garment gives the same bytes.
///
/// # Errors
/// Another suffix, arrays and indices that do not fit together, no triangles, more than a GLB can hold, or a file that
/// cannot be written.
pub fn garment(garment: &Garment, path: &Path) -> Result<()> {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let write = match suffix.as_deref() {
        Some("glb") => write_glb,
        Some("obj") => write_obj,
        _ => return Err(Error::unsupported("garments are saved as .glb or .obj").in_file(path)),
    };
    check(garment).map_err(|error| error.in_file(path))?;
    file::save(path, |out| write(garment, out))
}

fn write_glb(garment: &Garment, out: &mut dyn Write) -> Result<()> {
    let meshes: Vec<PanelMesh<'_>> = PanelMesh::all(garment).map(|(_, mesh)| mesh).collect();
    check_size(meshes.iter(), PER_VERTEX)?;
    let mut glb = Glb::default();
    let material = glb.add_material(plain_material("cloth"));
    for mesh in &meshes {
        let mut attributes = Attributes::default();
        if let Some(uvs) = &mesh.uvs {
            glb.add_uvs(&mut attributes, "TEXCOORD_0", uvs.clone());
        }
        glb.add_panel(mesh, attributes, material, json!({ "amc": Extras::of(garment, mesh.panel) }));
    }
    glb.write(out)
}

fn write_obj(garment: &Garment, out: &mut dyn Write) -> Result<()> {
    if garment.triangles.is_empty() {
        return Err(Error::invalid("there is no triangle to export"));
    }
    write_lines(garment, &mut Obj::new(out)).map_err(|source| Error::io("cannot write", source))
}

fn write_lines(garment: &Garment, obj: &mut Obj<'_>) -> io::Result<()> {
    obj.comment(GENERATOR)?;
    obj.comment("Metres, Y up. UVs: the flat pattern, v up. Angles: degrees counter-clockwise from +u.")?;
    let name = |panel: usize| garment.panels.get(panel).map(|panel| one_word(&panel.name));
    for (_, mesh) in PanelMesh::all(garment) {
        let pattern = &mesh.panel.pattern;
        let mut line = format!("panel {}", one_word(&mesh.panel.name));
        if let Some(grain) = pattern.grain {
            line += &format!(" grain_deg={}", shortest_degrees(grain));
        }
        if let Some(unit) = pattern.uv_unit {
            line += &format!(" uv_unit_m={unit}");
        }
        if let Some(mirror) = pattern.mirror.and_then(name) {
            line += &format!(" mirror={mirror}");
        }
        obj.comment(line)?;
        for Seam { name: seam, edge: [a, b], partner, partner_edge: [c, d] } in &pattern.seams {
            let (seam, partner) = (one_word(seam), name(*partner).unwrap_or_default());
            obj.comment(format_args!("seam {seam} from {a} to {b}, sewn to {partner} from {c} to {d}"))?;
        }
        obj.panel(&mesh, mesh.uvs.as_deref())?;
    }
    Ok(())
}

//! Directions.

mod about;
mod frame;
mod glb;
mod json;
mod material;
mod obj;
mod piece;
#[cfg(test)]
mod read_back;
#[cfg(test)]
mod tests;

pub use about::Said;

use std::io;
use std::path::Path;

use super::{PanelMesh, check};
use crate::direction::{Direction, Source, Tangents};
use crate::mesh::Garment;
use crate::{Error, Result, file};
use frame::Frame;
use piece::{All, Piece};

/// Writes a garment in a format.
type Write = fn(&Garment, &[Piece<'_>], &mut dyn io::Write) -> Result<()>;

/// Saves a garment with its panels' directions; the suffix of `path` says how.
///
/// - `.glb`: glTF 2.0, a mesh of one primitive per panel.
///   - `TANGENT`: the direction (w is -1 where the UVs are mirrored).
///   - `TEXCOORD_0`: the pattern in metres, +u along the warp and +v along the weft, so that programs that make tangents of
///     their own find the same direction (where the direction is the gradient, as far as the cloth is not sheared).
///     `TEXCOORD_1`: the pattern as it was drawn. Both with v down, as glTF has it: 1 - v.
///   - `_WARP`, `_WEFT`: dP/du and dP/dv of `TEXCOORD_0` as unit vectors in object space: the yarns, which hold the shear.
///   - A material per fabric, with KHR_materials_anisotropy: its direction is square to `TANGENT`, because the highlight of
///     warp yarns is drawn out across them. Strength and roughness are a middling cloth's.
///   - `extras`: `id`, `name`, `source`, `angle_deg` (in the pattern as drawn), `grain_deg` (the same on the cloth in its true
///     proportions; null where it is a field or there are no UVs), `follows_pattern` (whether the direction is one in the
///     pattern: false says that `TANGENT` and the yarns hold a field, and `TEXCOORD_0` is not turned), `combed` (whether the
///     field is one of strokes: `source` and `angle_deg` are the direction under them), `warp_weft_swapped`
///     (whether it runs across the panel's own grain), `takes_fabric`, `fabric`, `orientation` (`two-way`, `one-way`, `nap`),
///     `locked`, `linked`, `mirror_partner` (an id) and `unit`; and under `amc` what [`crate::mesh::gltf`] says.
/// - `.obj`: a group per panel. OBJ has no tangents, so the UVs are those of `TEXCOORD_0`, v up.
/// - `.json`: per panel the same as in `extras`, mean direction, how many vertices' directions were filled in and whether all
///   were made up, and the position and tangent of each vertex.
///
/// `tangents` are those of `directions`, one per panel (see [`crate::direction::tangents`]); `said` is of each panel too, or
/// empty: nothing is said. Metres, Y up.
///
/// # Errors
/// Another suffix, counts that do not match the garment's, an OBJ of a direction that UVs cannot hold (a field, a panel
/// without UVs), more than a GLB can hold, or a file that cannot be written.
pub fn tangents(
    garment: &Garment,
    tangents: &Tangents,
    directions: &[Direction],
    said: &[Said],
    path: &Path,
) -> Result<()> {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let write: Write = match suffix.as_deref() {
        Some("glb") => glb::write,
        Some("obj") => obj::write,
        Some("json") => json::write,
        _ => {
            let what = "directions are exported as .glb, .obj or .json";
            return Err(Error::unsupported(what).in_file(path));
        }
    };
    check(garment).map_err(|error| error.in_file(path))?;
    let panels = garment.panels.len();
    let nothing = vec![Said::default(); if said.is_empty() { panels } else { 0 }];
    let said = if said.is_empty() { &nothing } else { said };
    let Tangents { vectors, filled, made_up, combed } = tangents;
    if vectors.len() != garment.positions.len()
        || [filled.len(), made_up.len(), combed.len(), directions.len(), said.len()] != [panels; 5]
    {
        return Err(Error::invalid("the directions are not those of this garment").in_file(path));
    }
    let is_field =
        |index: usize| matches!(directions[index].source, Source::Field(_)) || tangents.combed[index];
    let frames: Vec<Frame> = (directions.iter().enumerate())
        .map(|(index, direction)| Frame::new(garment, index, direction, is_field(index)))
        .collect();
    let yarns = frame::yarns(garment, &frames).map_err(|error| error.in_file(path))?;
    let all = All { tangents, directions, said, frames: &frames, yarns: &yarns };
    let pieces: Vec<Piece<'_>> =
        PanelMesh::all(garment).map(|(index, mesh)| Piece::new(mesh, index, all)).collect();
    file::save(path, |out| write(garment, &pieces, out))
}

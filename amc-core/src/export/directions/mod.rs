//! Directions.

mod glb;
mod json;
mod obj;
mod piece;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::{PanelMesh, check};
use crate::direction::{Direction, Tangents};
use crate::mesh::Garment;
use crate::{Error, Result, file};
use piece::Piece;

/// Saves a garment with its panels' directions; the suffix of `path` says how.
///
/// - `.glb`: glTF 2.0, a mesh of one primitive per panel, with `POSITION`, `NORMAL`, `TANGENT` (w is -1 where the UVs are
///   mirrored), `TEXCOORD_0`, the pattern turned so that +u is the panel's direction, `TEXCOORD_1`, the pattern as it was
///   drawn (both with v down, as glTF has it), and in `extras` the panel's `id`, `name`, `source`, `angle_deg` and
///   `takes_fabric`. Programs that make their own tangents from `TEXCOORD_0` so find the same direction.
/// - `.obj`: a group per panel. OBJ has no tangents, so the UVs are turned as in `TEXCOORD_0`, v up.
/// - `.json`: per panel its id, name, source, angle in degrees, whether it takes a fabric, mean direction, how many
///   vertices' directions were filled in and whether all were made up, and the position and tangent of each vertex.
///
/// `tangents` are those of `directions`, one per panel (see [`crate::direction::tangents`]). Metres, Y up.
///
/// # Errors
/// Another suffix, counts that do not match the garment's, an OBJ of a direction that UVs cannot hold (a procedural
/// field, a panel without UVs), more than a GLB can hold, or a file that cannot be written.
pub fn tangents(garment: &Garment, tangents: &Tangents, directions: &[Direction], path: &Path) -> Result<()> {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let write = match suffix.as_deref() {
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
    if tangents.vectors.len() != garment.positions.len()
        || [tangents.filled.len(), tangents.made_up.len(), directions.len()] != [panels; 3]
    {
        return Err(Error::invalid("the directions are not those of this garment").in_file(path));
    }
    let pieces: Vec<Piece<'_>> = PanelMesh::all(garment)
        .map(|(index, mesh)| Piece::new(mesh, tangents, index, &directions[index]))
        .collect();
    file::save(path, |out| write(&pieces, out))
}

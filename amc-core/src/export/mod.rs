//! Directions, written for other programs.

mod glb;
mod json;
mod obj;
mod piece;
#[cfg(test)]
mod tests;

use std::path::Path;

use crate::direction::{Direction, Tangents};
use crate::mesh::Garment;
use crate::{Error, Result, file};
use piece::Piece;

/// Saves a garment with its panels' directions; the suffix of `path` says how.
///
/// - `.glb`: glTF 2.0, a mesh of one primitive per panel, with `POSITION`, `NORMAL`, `TANGENT` (w is -1 where the UVs are
///   mirrored), `TEXCOORD_0`, the pattern turned so that +u is the panel's direction, `TEXCOORD_1`, the pattern as it was
///   drawn (both with v down, as glTF has it), and in `extras` the panel's `id`, `name`, `source` and `angle_deg`. Programs
///   that make their own tangents from `TEXCOORD_0` so find the same direction.
/// - `.obj`: a group per panel. OBJ has no tangents, so the UVs are turned as in `TEXCOORD_0`, v up.
/// - `.json`: per panel its id, name, source, angle, mean direction, and the position and tangent of each vertex.
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
    check(garment, tangents, directions).map_err(|error| error.in_file(path))?;
    let pieces: Vec<Piece<'_>> = (garment.panels.iter().zip(directions))
        .enumerate()
        .map(|(index, (panel, direction))| Piece::new(garment, tangents, index, panel, direction))
        // glTF has no empty primitives.
        .filter(|piece| !piece.triangles.is_empty())
        .collect();
    file::save(path, |out| write(&pieces, out))
}

/// Who wrote a file.
const GENERATOR: &str = concat!("AMC Studio ", env!("CARGO_PKG_VERSION"));

fn check(garment: &Garment, tangents: &Tangents, directions: &[Direction]) -> Result<()> {
    let (vertices, panels) = (garment.positions.len(), garment.panels.len());
    if [garment.normals.len(), garment.uvs.len(), tangents.vectors.len()] != [vertices; 3]
        || [tangents.filled.len(), tangents.made_up.len(), directions.len()] != [panels; 3]
    {
        return Err(Error::invalid("the directions are not those of this garment"));
    }
    let sound = |range: &std::ops::Range<u32>| {
        range.start <= range.end && range.end as usize <= garment.triangles.len()
    };
    if !garment.panels.iter().all(|panel| sound(&panel.triangles))
        || garment.triangles.as_flattened().iter().any(|&corner| corner as usize >= vertices)
    {
        return Err(Error::invalid("a panel or triangle refers to what is not there"));
    }
    Ok(())
}

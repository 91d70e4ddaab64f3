//! Draped garments as the files that the studio opens.

mod seams;
#[cfg(test)]
mod tests;
mod variant;

use std::path::Path;

use amc_core::mesh::{Garment, Mesh, Part, PatternPiece, cloth_normals};
use amc_core::{Error, Result, export};
use glam::{DVec2, DVec3, Vec2};

use crate::cut::{CutGarment, CutPiece};
use crate::drape::Draped;

pub use variant::{Variant, turn_of_part};

/// UVs are multiples of this, metres (a quarter of a micrometre): so they come back from a file to the bit, as
/// [`export::garment`] says.
const UV_STEP: f64 = 1.0 / (1 << 22) as f64;

/// A draped garment as a mesh: one part per piece, named like it; UVs are the flat piece in metres, rounded to a
/// quarter of a micrometre; one normal where vertices are sewn to one place.
///
/// # Errors
/// Not one place per vertex; a place or a flat point that is not finite; a corner, mirror partner or join that refers to
/// what is not there. The error names the piece.
pub fn mesh(cut: &CutGarment, draped: &Draped) -> Result<Mesh> {
    if draped.positions.len() != cut.pieces.len() {
        return Err(Error::invalid("not as many draped pieces as cut ones"));
    }
    let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
    for ((piece, positions), part) in cut.pieces.iter().zip(&draped.positions).zip(0..) {
        append(&mut mesh, part, piece, positions)
            .map_err(|error| error.at_element(format!("piece '{}'", piece.name)))?;
    }
    let mut seams = seams::seams(cut)?;
    for ((piece, seams), mirror) in cut.pieces.iter().zip(&mut seams).zip(mirrors(&cut.pieces)) {
        mesh.parts.push(Part {
            name: piece.name.clone(),
            takes_fabric: true,
            pattern: PatternPiece {
                grain: Some(piece.grain as f32),
                mirror: mirror.and_then(|other| cut.pieces.get(other)).map(|other| other.name.clone()),
                seams: std::mem::take(seams),
                uv_unit: Some(1.0),
            },
        });
    }
    mesh.normals = cloth_normals(&mesh.positions, &mesh.triangles);
    mesh.file_vertices = mesh.positions.len();
    Ok(mesh)
}

/// Saves a draped garment as `.glb` or `.obj`: see [`mesh()`] and [`export::garment`].
///
/// # Errors
/// As [`mesh()`] and [`export::garment`]; besides, whatever of the pattern the file could not keep.
pub fn save(cut: &CutGarment, draped: &Draped, path: &Path) -> Result<()> {
    save_mesh(mesh(cut, draped)?, path)
}

/// Saves a garment's mesh, of [`mesh()`] or changed since, as `.glb` or `.obj`.
///
/// # Errors
/// As [`export::garment`]; besides, whatever of the pattern the file could not keep.
pub fn save_mesh(mesh: Mesh, path: &Path) -> Result<()> {
    let garment = Garment::new(mesh).map_err(|error| error.in_file(path))?;
    if let Some(notice) = garment.notices.first() {
        return Err(Error::invalid(notice).in_file(path));
    }
    export::garment(&garment, path)
}

/// Appends a piece's vertices and triangles as those of `part`.
fn append(mesh: &mut Mesh, part: u32, piece: &CutPiece, positions: &[DVec3]) -> Result<()> {
    let count = piece.flat.len();
    if positions.len() != count {
        return Err(Error::invalid(format!("{} draped vertices of {count}", positions.len())));
    }
    if !positions.iter().all(|p| p.is_finite()) || !piece.flat.iter().all(|p| p.is_finite()) {
        return Err(Error::invalid("a vertex that is nowhere"));
    }
    if piece.triangles.as_flattened().iter().any(|&corner| corner as usize >= count) {
        return Err(Error::invalid("a triangle with a corner that is not there"));
    }
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(positions.iter().map(|p| p.as_vec3()));
    mesh.uvs.get_or_insert_default().extend(piece.flat.iter().map(|&p| uv(p)));
    mesh.triangles.extend(piece.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
    mesh.triangle_parts.resize(mesh.triangles.len(), part);
    Ok(())
}

/// The UV of a flat point.
fn uv(flat: DVec2) -> Vec2 {
    ((flat / UV_STEP).round() * UV_STEP).as_vec2()
}

/// The mirror partner of every piece: its own word and its partner's, so that it is mutual.
fn mirrors(pieces: &[CutPiece]) -> Vec<Option<usize>> {
    let mut mirrors: Vec<Option<usize>> = pieces.iter().map(|piece| piece.mirror).collect();
    for (index, piece) in pieces.iter().enumerate() {
        if let Some(original) = piece.mirror.and_then(|original| mirrors.get_mut(original)) {
            original.get_or_insert(index);
        }
    }
    mirrors
}

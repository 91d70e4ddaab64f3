//! Wavefront OBJ.
//!
//! The crate `tobj` reads the file; before it, every line is checked and brought into a plain form (see `lines`), so
//! that a fault is told with its line and nothing reaches `tobj` that it would trip over. Faces stay polygons there
//! and are cut here, on the shorter diagonals.
//!
//! A part is all faces under the same `o`, `g` and `usemtl`. Material files are not read. Colours and weights of
//! vertices, smoothing groups, points, lines and curves are left out.

mod lines;
#[cfg(test)]
mod tests;

use glam::{Vec2, Vec3};

use super::draft::{Draft, DraftPart};
use super::triangulate::triangulate;
use super::{Mesh, check};
use crate::{Error, Result};
use lines::Lines;

/// Reads an OBJ file; its numbers are taken for metres.
///
/// # Errors
/// A line that is not OBJ, an index out of range, a number that is not finite (all with their line), or no triangle
/// that has an area.
pub fn parse(bytes: &[u8]) -> Result<Mesh> {
    let mut lines = Lines::new(bytes);
    let options = tobj::LoadOptions { single_index: true, ..Default::default() };
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let loaded = tobj::load_obj_buf(&mut lines, &options, no_materials);
    let read = lines.finish()?;
    let (models, _) = loaded.map_err(|error| Error::malformed(error.to_string()))?;

    let mut models_of: Vec<Vec<tobj::Mesh>> = Vec::new();
    models_of.resize_with(read.parts.len(), Vec::new);
    for model in models {
        if model.mesh.indices.is_empty() {
            continue;
        }
        let part = model.name.parse::<usize>().ok().and_then(|part| models_of.get_mut(part));
        part.ok_or_else(|| Error::malformed("faces of no known group"))?.push(model.mesh);
    }
    let mut draft = Draft { file_vertices: read.vertices, notices: read.notices, ..Draft::default() };
    for (part, meshes) in read.parts.into_iter().zip(models_of) {
        if meshes.is_empty() {
            continue;
        }
        let (vertices, triangles) = (draft.positions.len(), draft.triangles.len());
        let (mut has_normals, mut has_uvs) = (false, false);
        for mesh in meshes {
            has_normals |= !mesh.normals.is_empty();
            has_uvs |= !mesh.texcoords.is_empty();
            append(&mut draft, mesh)?;
        }
        draft.parts.push(DraftPart {
            part,
            vertices: vertices..draft.positions.len(),
            triangles: triangles..draft.triangles.len(),
            has_normals,
            has_uvs,
        });
    }
    check::check(draft)
}

/// Appends one of `tobj`'s meshes, cut into triangles. `lines` made sure that all of its vertices have the same
/// attributes.
fn append(draft: &mut Draft, mesh: tobj::Mesh) -> Result<()> {
    let base = draft.positions.len();
    draft.positions.extend(mesh.positions.as_chunks::<3>().0.iter().copied().map(Vec3::from));
    draft.normals.extend(mesh.normals.as_chunks::<3>().0.iter().copied().map(Vec3::from));
    draft.normals.resize(draft.positions.len(), Vec3::ZERO);
    draft.uvs.extend(mesh.texcoords.as_chunks::<2>().0.iter().copied().map(Vec2::from));
    draft.uvs.resize(draft.positions.len(), Vec2::ZERO);
    if u32::try_from(draft.positions.len()).is_err() {
        return Err(Error::too_large("more than 4294967295 vertices"));
    }
    let base = base as u32;
    if mesh.face_arities.is_empty() {
        let triangles = mesh.indices.as_chunks::<3>().0;
        draft.triangles.extend(triangles.iter().map(|triangle| triangle.map(|i| base + i)));
        return Ok(());
    }
    let mut rest = mesh.indices.as_slice();
    let mut points = Vec::new();
    for arity in mesh.face_arities {
        let face =
            rest.split_off(..arity as usize).ok_or_else(|| Error::malformed("a face without its corners"))?;
        points.clear();
        points.extend(face.iter().map(|&i| draft.positions[(base + i) as usize]));
        triangulate(&points, |triangle| draft.triangles.push(triangle.map(|k| base + face[k])));
    }
    Ok(())
}

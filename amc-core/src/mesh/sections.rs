//! The triangles and vertices of each part of a mesh.

use std::ops::Range;

use glam::Vec2;
use rayon::prelude::*;

use super::Mesh;
use crate::{Error, Result};

/// Corners that one task looks at.
const CHUNK: usize = 64 * 1024;

/// The triangles and vertices of one part: no other section uses either.
pub(super) struct Section {
    /// Index of the part.
    pub(super) part: u32,
    pub(super) triangles: Range<usize>,
    /// Some of them may be used by no triangle.
    pub(super) vertices: Range<usize>,
}

/// The sections of a mesh whose attributes are of one length, in the order of their parts; parts without triangles
/// have none. Where triangles or vertices are not in the order of their parts they are put in it, and vertices that
/// several parts use are doubled.
///
/// # Errors
/// An index out of range.
pub(super) fn sections(mesh: &mut Mesh, uvs: &mut Vec<Vec2>) -> Result<Vec<Section>> {
    check_indices(mesh)?;
    if let Some(sections) = as_they_stand(mesh) {
        return Ok(sections);
    }
    put_in_order(mesh, uvs);
    as_they_stand(mesh).ok_or_else(|| Error::invalid("a mesh whose parts cannot be put in order"))
}

fn check_indices(mesh: &Mesh) -> Result<()> {
    let part = mesh.triangle_parts.par_chunks(CHUNK).filter_map(|parts| parts.iter().copied().max()).max();
    let corner = range(&mesh.triangles).end;
    if corner > mesh.positions.len() || part.is_some_and(|part| part as usize >= mesh.parts.len()) {
        return Err(Error::invalid("a mesh with an index out of range"));
    }
    Ok(())
}

/// From the least vertex that some triangles use to the largest.
fn range(triangles: &[[u32; 3]]) -> Range<usize> {
    let of = |corners: &[u32]| {
        corners.iter().fold((u32::MAX, 0), |(low, high), &corner| (corner.min(low), corner.max(high)))
    };
    let chunks = triangles.as_flattened().par_chunks(CHUNK).map(of);
    let (low, high) = chunks.reduce(|| (u32::MAX, 0), |a, b| (a.0.min(b.0), a.1.max(b.1)));
    low as usize..high as usize + 1
}

/// None where the triangles are not in the order of their parts, or the ranges of the parts' vertices overlap.
fn as_they_stand(mesh: &Mesh) -> Option<Vec<Section>> {
    if !mesh.triangle_parts.is_sorted() {
        return None;
    }
    let mut start = 0;
    let mut sections = Vec::new();
    for run in mesh.triangle_parts.chunk_by(|a, b| a == b) {
        let triangles = start..start + run.len();
        start = triangles.end;
        let vertices = range(&mesh.triangles[triangles.clone()]);
        sections.push(Section { part: run[0], triangles, vertices });
    }
    let mut ranges: Vec<&Range<usize>> = sections.iter().map(|section| &section.vertices).collect();
    ranges.sort_by_key(|range| range.start);
    let apart = ranges.windows(2).all(|pair| pair[0].end <= pair[1].start);
    apart.then_some(sections)
}

/// Sorts triangles by part, and vertices by the first triangle that uses them, one for each part; those that none uses
/// are left out.
fn put_in_order(mesh: &mut Mesh, uvs: &mut Vec<Vec2>) {
    let mut order: Vec<usize> = (0..mesh.triangles.len()).collect();
    order.sort_by_key(|&t| mesh.triangle_parts[t]);
    mesh.triangles = order.iter().map(|&t| mesh.triangles[t]).collect();
    mesh.triangle_parts = order.iter().map(|&t| mesh.triangle_parts[t]).collect();
    let mut places = vec![(u32::MAX, 0); mesh.positions.len()];
    let mut sources: Vec<u32> = Vec::with_capacity(mesh.positions.len());
    for (triangle, &part) in mesh.triangles.iter_mut().zip(&mesh.triangle_parts) {
        for corner in triangle {
            let place = &mut places[*corner as usize];
            if place.0 != part {
                *place = (part, sources.len() as u32);
                sources.push(*corner);
            }
            *corner = place.1;
        }
    }
    mesh.positions = sources.iter().map(|&source| mesh.positions[source as usize]).collect();
    mesh.normals = sources.iter().map(|&source| mesh.normals[source as usize]).collect();
    *uvs = sources.iter().map(|&source| uvs[source as usize]).collect();
}

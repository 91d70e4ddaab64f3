//! Panels: the pieces a garment is sewn from, found as UV islands.

use std::ops::Range;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::fold::part_orientations;
use super::identity::{Nameable, identify};
use super::measure::{Figures, measure};
use super::sections::{Section, sections};
use super::split::append_copies;
use super::{Mesh, Part, PatternPiece, islands, pattern_piece};
use crate::{Error, Result};

/// A mesh cut into panels. Every vertex belongs to one panel and one UV orientation, so that means over a vertex's
/// triangles never cross a seam or a fold of the UV map.
#[derive(Debug, Clone, Default)]
pub struct Garment {
    /// In metres, object space, Y up.
    pub positions: Vec<Vec3>,
    /// Unit vectors.
    pub normals: Vec<Vec3>,
    /// One per position, v up; zeros where the file has none.
    pub uvs: Vec<Vec2>,
    /// Whether the UVs are from the file.
    pub has_uvs: bool,
    /// Corners, counter-clockwise as seen from the front; the triangles of a panel stand together, in the order of `panels`.
    pub triangles: Vec<[u32; 3]>,
    /// The panels.
    pub panels: Vec<Panel>,
    /// Vertices as the file counts them.
    pub file_vertices: usize,
    /// Things a person should know.
    pub notices: Vec<String>,
}

/// One piece of cloth.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Stable: the same file gives the same ids, and so does the file saved again with vertices, triangles or parts
    /// in another order, in another unit, or with other panels added. It is the part's name in lower case
    /// (`left-sleeve`), followed by digits for the panel's place in the UV map where a part has several
    /// (`shirt-4c1f`). It changes when the part is renamed or, among several, the panel is moved in the UV map.
    pub id: String,
    /// What people call it: the part's name, numbered from the top of the flat pattern where a part has several islands.
    pub name: String,
    /// Its triangles: a range of [`Garment::triangles`].
    pub triangles: Range<u32>,
    /// Whether it takes a fabric (else it is drawn in plain grey).
    pub takes_fabric: bool,
    /// Area in square metres.
    pub area: f32,
    /// What is unusual about its UVs.
    pub flags: PanelFlags,
    /// What the file says of it as a piece of a sewing pattern; partners are indices of [`Garment::panels`].
    pub pattern: PatternPiece<usize>,
}

/// What is unusual about a panel's UVs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PanelFlags {
    /// More than half of its area has mirrored UVs.
    pub mirrored: bool,
    /// Some of it has no UVs or UVs without area: directions there are filled from the neighbours.
    pub degenerate: bool,
}

impl Garment {
    /// Cuts a mesh into panels.
    ///
    /// A panel is a UV island of one part: triangles connected by vertices, which count as one where position and UV
    /// are the same, so a crease in the normals does not cut. A part without UVs is one panel. Vertices are doubled
    /// where triangles of different panels or UV orientations use them, and left out where none does; triangles
    /// without UV area go with their neighbours.
    ///
    /// What a sewing pattern says of the parts (see [`PatternPiece`]) goes to their panels; partners that are not there
    /// and numbers that make no sense are left out, with a notice.
    ///
    /// # Errors
    /// No triangles, or arrays and indices that do not fit together.
    pub fn new(mut mesh: Mesh) -> Result<Self> {
        validate(&mesh)?;
        let has_uvs = mesh.uvs.is_some();
        let mut uvs = mesh.uvs.take().unwrap_or_else(|| vec![Vec2::ZERO; mesh.positions.len()]);
        let sections = sections(&mut mesh, &mut uvs)?;
        let cuts = cut(&mesh.positions, &uvs, &mut mesh.triangles, &sections);
        let found = cuts.iter().zip(&sections).flat_map(|(cut, section)| {
            cut.islands.iter().map(|(size, figures)| (section.part, *size, figures))
        });
        let found: Vec<(u32, usize, &Figures)> = found.collect();
        let ranges = ranges(found.iter().map(|island| island.1));
        if found.iter().any(|(_, _, figures)| figures.folded) {
            let copies = part_orientations(&uvs, &mut mesh.triangles, &ranges);
            append_copies(&mut mesh.positions, &copies);
            append_copies(&mut mesh.normals, &copies);
            append_copies(&mut uvs, &copies);
        }
        let within: usize = sections.iter().map(|section| section.vertices.len()).sum();
        if within < mesh.positions.len() || cuts.iter().any(|cut| cut.unused) {
            drop_unused(&mut mesh, &mut uvs);
        }
        let panels = panels(&mesh.parts, ranges, &found);
        let part_of: Vec<u32> = found.iter().map(|island| island.0).collect();
        let mut garment = Self {
            positions: mesh.positions,
            normals: mesh.normals,
            uvs,
            has_uvs,
            triangles: mesh.triangles,
            panels,
            file_vertices: mesh.file_vertices,
            notices: mesh.notices,
        };
        pattern_piece::assign(&mut garment, &mesh.parts, &part_of);
        Ok(garment)
    }
}

/// A part cut into islands.
struct Cut {
    /// Number of triangles and figures of each island, in the order of the triangles.
    islands: Vec<(usize, Figures)>,
    /// Whether some vertex in the section's range is used by no triangle.
    unused: bool,
}

/// Cuts every section into islands and puts the triangles of each together.
fn cut(positions: &[Vec3], uvs: &[Vec2], triangles: &mut [[u32; 3]], sections: &[Section]) -> Vec<Cut> {
    let mut rest = triangles;
    let mut parted = Vec::with_capacity(sections.len());
    for section in sections {
        let (of_section, after) = std::mem::take(&mut rest).split_at_mut(section.triangles.len());
        parted.push((section, of_section));
        rest = after;
    }
    let cut_one = |(section, triangles): (&Section, &mut [[u32; 3]])| {
        let vertices = section.vertices.clone();
        // Zeros are how a mesh says that a part has no UVs.
        let no_uv = |triangle: &[u32; 3]| triangle.iter().all(|&vertex| uvs[vertex as usize] == Vec2::ZERO);
        let whole = triangles.iter().all(no_uv);
        let first = vertices.start as u32;
        let mut found = islands::find(&positions[vertices.clone()], &uvs[vertices], triangles, first, whole);
        let ranges = ranges(found.sort(triangles).into_iter());
        let measured = ranges.par_iter().zip(&found.uv_boxes).map(|(range, &uv_box)| {
            let triangles = &triangles[range.start as usize..range.end as usize];
            (range.len(), measure(positions, uvs, triangles, uv_box))
        });
        Cut { islands: measured.collect(), unused: found.unused }
    };
    parted.into_par_iter().with_max_len(1).map(cut_one).collect()
}

/// Ranges of the given sizes, one after the other.
fn ranges(sizes: impl Iterator<Item = usize>) -> Vec<Range<u32>> {
    let mut start = 0;
    let range = |size: usize| {
        let range = start..start + size as u32;
        start = range.end;
        range
    };
    sizes.map(range).collect()
}

fn validate(mesh: &Mesh) -> Result<()> {
    let count = mesh.positions.len();
    let fits = mesh.normals.len() == count
        && mesh.uvs.as_ref().is_none_or(|uvs| uvs.len() == count)
        && mesh.triangle_parts.len() == mesh.triangles.len();
    if !fits {
        return Err(Error::invalid("a mesh whose arrays differ in length"));
    }
    if mesh.triangles.is_empty() {
        return Err(Error::invalid("a mesh without triangles"));
    }
    if count.saturating_add(mesh.triangles.len().saturating_mul(3)) >= u32::MAX as usize {
        return Err(Error::too_large("more vertices and corners than 32 bits can number"));
    }
    Ok(())
}

fn drop_unused(mesh: &mut Mesh, uvs: &mut Vec<Vec2>) {
    let mut used = vec![false; mesh.positions.len()];
    for &vertex in mesh.triangles.as_flattened() {
        used[vertex as usize] = true;
    }
    let mut kept = 0;
    let mut place = vec![0; used.len()];
    for (old, _) in used.iter().enumerate().filter(|(_, used)| **used) {
        place[old] = kept as u32;
        mesh.positions[kept] = mesh.positions[old];
        mesh.normals[kept] = mesh.normals[old];
        uvs[kept] = uvs[old];
        kept += 1;
    }
    mesh.positions.truncate(kept);
    mesh.normals.truncate(kept);
    uvs.truncate(kept);
    for vertex in mesh.triangles.as_flattened_mut() {
        *vertex = place[*vertex as usize];
    }
}

fn panels(parts: &[Part], ranges: Vec<Range<u32>>, islands: &[(u32, usize, &Figures)]) -> Vec<Panel> {
    let nameable: Vec<Nameable<'_>> = islands
        .iter()
        .map(|&(part, _, figures)| Nameable { part_name: &parts[part as usize].name, figures })
        .collect();
    let identities = identify(&nameable);
    let described = identities.into_iter().zip(ranges).zip(islands);
    described
        .map(|((identity, triangles), &(part, _, figures))| Panel {
            id: identity.id,
            name: identity.name,
            triangles,
            takes_fabric: parts[part as usize].takes_fabric,
            area: figures.area,
            flags: figures.flags,
            pattern: PatternPiece::default(),
        })
        .collect()
}

#[cfg(test)]
mod tests;

//! Panels: the pieces a garment is sewn from, found as UV islands.

use std::ops::Range;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::identity::{Nameable, identify};
use super::islands::{self, Islands};
use super::measure::{Figures, measure, uv_area};
use super::split::{append_copies, split};
use super::{Mesh, Part};
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
    /// Larger singular value of the UV-to-surface map over the panel's mean scale, the area-weighted mean of
    /// sqrt(surface area / UV area); by area. 1 where the pattern is only scaled; 0 where there are no UVs.
    pub stretch: Percentiles,
    /// Angle between dP/du and dP/dv in radians; by area. 0 where there are no UVs.
    pub shear: Percentiles,
}

/// What is unusual about a panel's UVs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PanelFlags {
    /// More than half of its area has mirrored UVs.
    pub mirrored: bool,
    /// Some of it has no UVs or UVs without area: directions there are filled from the neighbours.
    pub degenerate: bool,
}

/// Percentiles over a panel's area.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Percentiles {
    /// 5 % of the area lie below.
    pub p5: f32,
    /// Half of the area lies below.
    pub p50: f32,
    /// 95 % of the area lie below.
    pub p95: f32,
}

impl Garment {
    /// Cuts a mesh into panels.
    ///
    /// A panel is a UV island of one part: triangles connected by vertices, which count as one where position and UV
    /// are the same, so a crease in the normals does not cut. A part without UVs is one panel. Vertices are doubled where triangles of different panels or UV orientations use them, and left out
    /// where none does; triangles without UV area go with their neighbours.
    ///
    /// # Errors
    /// No triangles, or arrays and indices that do not fit together.
    pub fn new(mut mesh: Mesh) -> Result<Self> {
        validate(&mesh)?;
        let has_uvs = mesh.uvs.is_some();
        let mut uvs = mesh.uvs.take().unwrap_or_else(|| vec![Vec2::ZERO; mesh.positions.len()]);
        // From here on no vertex is used by two parts.
        if !parts_have_own_vertices(&mesh) {
            let parts = &mesh.triangle_parts;
            let done = split(&mut mesh.triangles, mesh.positions.len(), |t, _| parts[t]);
            append(&mut mesh, &mut uvs, &done.copies);
        }
        let whole = parts_without_uvs(&mesh, &uvs);
        let islands = islands::find(&mesh.positions, &uvs, &mesh.triangles, &mesh.triangle_parts, &whole);
        let classes = orientation_classes(&uvs, &mesh.triangles, &islands.of_triangle);
        if has_mixed_island(&classes, islands.count) {
            let done = split(&mut mesh.triangles, mesh.positions.len(), |t, _| classes[t]);
            append(&mut mesh, &mut uvs, &done.copies);
        }
        if islands.unused {
            drop_unused(&mut mesh, &mut uvs);
        }

        let (ranges, parts) = sort_by_island(&mut mesh, &islands);
        let measured: Vec<Figures> = ranges
            .par_iter()
            .map(|range| {
                measure(&mesh.positions, &uvs, &mesh.triangles, range.start as usize..range.end as usize)
            })
            .collect();
        let panels = panels(&mesh.parts, ranges, &parts, &measured);
        Ok(Self {
            positions: mesh.positions,
            normals: mesh.normals,
            uvs,
            has_uvs,
            triangles: mesh.triangles,
            panels,
            file_vertices: mesh.file_vertices,
            notices: mesh.notices,
        })
    }
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
    let corner = mesh.triangles.as_flattened().par_iter().with_min_len(1 << 16).copied().max();
    let part = mesh.triangle_parts.iter().copied().max();
    if corner.is_some_and(|i| i as usize >= count) || part.is_some_and(|i| i as usize >= mesh.parts.len()) {
        return Err(Error::invalid("a mesh with an index out of range"));
    }
    Ok(())
}

fn append(mesh: &mut Mesh, uvs: &mut Vec<Vec2>, copies: &[u32]) {
    if !copies.is_empty() {
        append_copies(&mut mesh.positions, copies);
        append_copies(&mut mesh.normals, copies);
        append_copies(uvs, copies);
    }
}

/// Whether the parts use ranges of vertices that do not overlap, as the readers make them.
fn parts_have_own_vertices(mesh: &Mesh) -> bool {
    let mut ranges = vec![(u32::MAX, 0); mesh.parts.len()];
    for (&[a, b, c], &part) in mesh.triangles.iter().zip(&mesh.triangle_parts) {
        let (low, high) = &mut ranges[part as usize];
        (*low, *high) = ((*low).min(a.min(b).min(c)), (*high).max(a.max(b).max(c)));
    }
    ranges.retain(|range| range.0 <= range.1);
    ranges.sort_unstable();
    ranges.windows(2).all(|pair| pair[0].1 < pair[1].0)
}

/// Parts all of whose UVs are zero, which is how a mesh says that a part has none.
fn parts_without_uvs(mesh: &Mesh, uvs: &[Vec2]) -> Vec<bool> {
    let mut without = vec![true; mesh.parts.len()];
    for (triangle, &part) in mesh.triangles.iter().zip(&mesh.triangle_parts) {
        let without = &mut without[part as usize];
        *without = *without && triangle.iter().all(|&i| uvs[i as usize] == Vec2::ZERO);
    }
    without
}

/// Twice the island of each triangle, plus one where its UVs are mirrored.
fn orientation_classes(uvs: &[Vec2], triangles: &[[u32; 3]], islands: &[u32]) -> Vec<u32> {
    let area = |triangle: &[u32; 3]| uv_area(triangle.map(|i| uvs[i as usize]));
    let mut flat = Vec::new();
    let mut classes = vec![0; triangles.len()];
    let signs = classes.par_iter_mut().zip(triangles).zip(islands).with_min_len(1 << 14);
    signs.for_each(|((class, triangle), &island)| {
        let area = area(triangle);
        *class = if area == 0.0 { u32::MAX } else { island * 2 + u32::from(area < 0.0) };
    });
    if classes.contains(&u32::MAX) {
        flat.extend((0..triangles.len()).filter(|&t| classes[t] == u32::MAX));
        follow_neighbours(uvs.len(), triangles, islands, &mut classes, flat);
    }
    classes
}

/// Whether some island has triangles of both UV orientations; islands themselves share no vertex.
fn has_mixed_island(classes: &[u32], islands: usize) -> bool {
    let mut seen = vec![false; islands * 2];
    for &class in classes {
        seen[class as usize] = true;
    }
    seen.as_chunks::<2>().0.contains(&[true; 2])
}

/// Gives each of the `flat` triangles an orientation that one of its vertices has; spreads over areas of them.
fn follow_neighbours(
    vertices: usize,
    triangles: &[[u32; 3]],
    islands: &[u32],
    classes: &mut [u32],
    mut flat: Vec<usize>,
) {
    let mut seen = vec![[false; 2]; vertices];
    for (triangle, &class) in triangles.iter().zip(&*classes).filter(|(_, class)| **class != u32::MAX) {
        for &vertex in triangle {
            seen[vertex as usize][class as usize & 1] = true;
        }
    }
    // A large area without UVs is not worth a perfect spread: what is left after some rounds is upright.
    const ROUNDS: usize = 8;
    for round in 0..ROUNDS {
        flat.retain(|&t| {
            let has = |mirrored: usize| triangles[t].iter().any(|&vertex| seen[vertex as usize][mirrored]);
            let mirrored = match (has(0), has(1)) {
                (true, _) => 0,
                (false, true) => 1,
                (false, false) if round + 1 == ROUNDS => 0,
                (false, false) => return true,
            };
            classes[t] = islands[t] * 2 + mirrored as u32;
            for &vertex in &triangles[t] {
                seen[vertex as usize][mirrored] = true;
            }
            false
        });
    }
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

/// Puts the triangles of an island together, islands in the order of their parts; gives the range and the part of each.
fn sort_by_island(mesh: &mut Mesh, islands: &Islands) -> (Vec<Range<u32>>, Vec<u32>) {
    let mut sizes = vec![0u32; islands.count];
    let mut parts = vec![0u32; islands.count];
    for (&island, &part) in islands.of_triangle.iter().zip(&mesh.triangle_parts) {
        sizes[island as usize] += 1;
        parts[island as usize] = part;
    }
    let mut order: Vec<usize> = (0..islands.count).collect();
    order.sort_by_key(|&island| parts[island]);
    let mut next = vec![0u32; islands.count];
    let mut ranges = Vec::with_capacity(islands.count);
    let mut start = 0;
    for &island in &order {
        next[island] = start;
        ranges.push(start..start + sizes[island]);
        start += sizes[island];
    }
    let starts: &[u32] = &next;
    if !islands.of_triangle.is_sorted_by_key(|&island| starts[island as usize]) {
        let mut sorted = vec![[0; 3]; mesh.triangles.len()];
        for (&triangle, &island) in mesh.triangles.iter().zip(&islands.of_triangle) {
            sorted[next[island as usize] as usize] = triangle;
            next[island as usize] += 1;
        }
        mesh.triangles = sorted;
    }
    (ranges, order.iter().map(|&island| parts[island]).collect())
}

fn panels(parts: &[Part], ranges: Vec<Range<u32>>, part_of: &[u32], measured: &[Figures]) -> Vec<Panel> {
    let nameable: Vec<Nameable<'_>> = part_of
        .iter()
        .zip(measured)
        .map(|(&part, figures)| Nameable { part_name: &parts[part as usize].name, figures })
        .collect();
    let identities = identify(&nameable);
    let described = identities.into_iter().zip(ranges).zip(part_of.iter().zip(measured));
    described
        .map(|((identity, triangles), (&part, figures))| Panel {
            id: identity.id,
            name: identity.name,
            triangles,
            takes_fabric: parts[part as usize].takes_fabric,
            area: figures.area,
            flags: figures.flags,
            stretch: figures.stretch,
            shear: figures.shear,
        })
        .collect()
}

#[cfg(test)]
mod tests;

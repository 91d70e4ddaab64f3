//! Folds: where the UV map turns over within a panel.

use std::ops::Range;

use glam::Vec2;
use rayon::prelude::*;

use super::measure::uv_area;
use super::split::split;

/// Doubles the vertices that triangles of both UV orientations use; triangles without UV area go with their
/// neighbours. Gives, for each vertex appended, the one it copies. Panels share no vertex.
pub(super) fn part_orientations(uvs: &[Vec2], triangles: &mut [[u32; 3]], panels: &[Range<u32>]) -> Vec<u32> {
    let classes = orientation_classes(uvs, triangles, panels);
    split(triangles, uvs.len(), |t, _| classes[t]).copies
}

/// Twice the panel of each triangle, plus one where its UVs are mirrored.
fn orientation_classes(uvs: &[Vec2], triangles: &[[u32; 3]], panels: &[Range<u32>]) -> Vec<u32> {
    let numbered = panels.iter().zip(0u32..);
    let panels: Vec<u32> =
        numbered.flat_map(|(range, panel)| std::iter::repeat_n(panel, range.len())).collect();
    let mut classes = vec![0; triangles.len()];
    let signs = classes.par_iter_mut().zip(triangles).zip(&panels).with_min_len(1 << 14);
    signs.for_each(|((class, triangle), &panel)| {
        let area = uv_area(triangle.map(|i| uvs[i as usize]));
        *class = if area == 0.0 { u32::MAX } else { panel * 2 + u32::from(area < 0.0) };
    });
    let flat: Vec<usize> = (0..triangles.len()).filter(|&t| classes[t] == u32::MAX).collect();
    if !flat.is_empty() {
        follow_neighbours(uvs.len(), triangles, &panels, &mut classes, flat);
    }
    classes
}

/// Gives each of the `flat` triangles an orientation that one of its vertices has; spreads over areas of them.
fn follow_neighbours(
    vertices: usize,
    triangles: &[[u32; 3]],
    panels: &[u32],
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
            classes[t] = panels[t] * 2 + mirrored as u32;
            for &vertex in &triangles[t] {
                seen[vertex as usize][mirrored] = true;
            }
            false
        });
    }
}

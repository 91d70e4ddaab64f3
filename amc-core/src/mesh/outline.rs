//! The outlines of panels, as they are cut.

use super::{Garment, Panel};

impl Garment {
    /// The closed lines that bound a panel: vertices in order, each line once round, the cloth on their left as seen from the
    /// front. The longest line (by its number of vertices) comes first. Vertices that are doubled at a crease count as one, so a
    /// crease is no edge. Where three triangles or more meet at an edge, it bounds nothing.
    pub fn outlines(&self, panel: &Panel) -> Vec<Vec<u32>> {
        let range = panel.triangles.start as usize..panel.triangles.end as usize;
        let triangles = self.triangles.get(range).unwrap_or_default();
        let same = self.welded(triangles);
        let place =
            |vertex: u32| same.binary_search_by_key(&vertex, |pair| pair.0).map_or(vertex, |k| same[k].1);
        let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * triangles.len());
        for triangle in triangles {
            let [a, b, c] = triangle.map(place);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                edges.push((from.min(to), from.max(to), from < to));
            }
        }
        edges.sort_unstable();
        let alone = edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|chunk| chunk.len() == 1);
        let ways =
            alone.flatten().map(|&(low, high, forward)| if forward { (low, high) } else { (high, low) });
        let mut loops = closed(ways.collect());
        loops.sort_by_key(|line| std::cmp::Reverse(line.len()));
        loops
    }

    /// Each vertex of `triangles`, and the first of those with the same position and UV; by vertex.
    pub(super) fn welded(&self, triangles: &[[u32; 3]]) -> Vec<(u32, u32)> {
        let mut vertices = triangles.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        // Adding zero makes the two zeros one.
        let key = |&vertex: &u32| {
            let (p, uv) = (self.positions[vertex as usize] + 0.0, self.uvs[vertex as usize] + 0.0);
            [p.x, p.y, p.z, uv.x, uv.y].map(f32::to_bits)
        };
        vertices.sort_by_cached_key(|vertex| (key(vertex), *vertex));
        let mut same: Vec<(u32, u32)> = Vec::with_capacity(vertices.len());
        for chunk in vertices.chunk_by(|a, b| key(a) == key(b)) {
            same.extend(chunk.iter().map(|&vertex| (vertex, chunk[0])));
        }
        same.sort_unstable();
        same
    }
}

/// Directed edges joined to closed lines. Where lines touch at a vertex, they are parted in some way; what does not close is
/// left out.
fn closed(mut edges: Vec<(u32, u32)>) -> Vec<Vec<u32>> {
    edges.sort_unstable();
    let mut used = vec![false; edges.len()];
    let mut loops = Vec::new();
    for start in 0..edges.len() {
        let (mut line, mut edge) = (Vec::new(), Some(start).filter(|&edge| !used[edge]));
        while let Some(now) = edge {
            used[now] = true;
            let (from, to) = edges[now];
            line.push(from);
            if to == edges[start].0 {
                loops.push(std::mem::take(&mut line));
                break;
            }
            let first = edges.partition_point(|&(other, _)| other < to);
            edge = (first..edges.len()).take_while(|&next| edges[next].0 == to).find(|&next| !used[next]);
        }
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::tests::{flat, garment_of};
    use glam::{Quat, Vec2};

    /// Twice the area that a line of UVs encloses.
    fn area(garment: &Garment, line: &[u32]) -> f32 {
        let at = |k: usize| garment.uvs[line[k % line.len()] as usize];
        (0..line.len()).map(|k| at(k).perp_dot(at(k + 1))).sum()
    }

    #[test]
    fn a_square_has_one_line_round_it_and_a_hole_one_more() {
        let mut garment = garment_of(&[flat(Quat::IDENTITY, |p| p)]);
        let lines = garment.outlines(&garment.panels[0]);
        assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [24]);
        assert!(area(&garment, &lines[0]) > 0.0, "the cloth is on the left");
        // Without the cell in the middle.
        garment.triangles.drain(2 * (3 * 6 + 3)..2 * (3 * 6 + 4));
        garment.panels[0].triangles.end -= 2;
        let lines = garment.outlines(&garment.panels[0]);
        assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [24, 4]);
        assert!(area(&garment, &lines[1]) < 0.0, "the cloth is on the left of the hole's line too");
    }

    #[test]
    fn a_crease_is_no_edge_but_a_cut_is() {
        let mut garment = garment_of(&[flat(Quat::IDENTITY, |p| p)]);
        // The right half of the grid gets vertices of its own along the middle.
        for row in 0..7 {
            let old = row * 7 + 3;
            garment.positions.push(garment.positions[old]);
            garment.uvs.push(garment.uvs[old]);
            let new = garment.positions.len() as u32 - 1;
            for triangle in
                garment.triangles.iter_mut().filter(|triangle| triangle.iter().any(|&k| k < 49 && k % 7 > 3))
            {
                triangle.iter_mut().filter(|corner| **corner == old as u32).for_each(|corner| *corner = new);
            }
        }
        assert_eq!(garment.outlines(&garment.panels[0])[0].len(), 24);
        garment.uvs[49..].iter_mut().for_each(|uv| *uv += Vec2::X);
        assert_eq!(garment.outlines(&garment.panels[0]).len(), 2);
    }

    #[test]
    fn triangles_that_share_an_edge_too_often_stop_nobody() {
        let mut garment = garment_of(&[flat(Quat::IDENTITY, |p| p)]);
        garment.triangles[1] = garment.triangles[0];
        garment.triangles[2] = garment.triangles[0];
        garment.outlines(&garment.panels[0]);
    }
}

//! Doubling vertices so that each belongs to one class of triangles.

use std::collections::HashMap;

/// What [`split`] did.
pub(super) struct Split {
    /// For each vertex appended after the old ones, the vertex it copies.
    pub(super) copies: Vec<u32>,
}

/// Renumbers the corners of `triangles` over `vertices` vertices so that no vertex is used under two classes.
///
/// `class` gives the class of a triangle's corner (0 to 2). The first class that meets a vertex keeps it; every
/// other gets a copy. Every index must be below `vertices`; fewer than 2^32 corners.
pub(super) fn split(
    triangles: &mut [[u32; 3]],
    vertices: usize,
    class: impl Fn(usize, usize) -> u32,
) -> Split {
    const NOBODY: u32 = u32::MAX;
    let mut owners = vec![NOBODY; vertices];
    let mut copies = Vec::new();
    let mut copy_of = HashMap::new();
    for (t, triangle) in triangles.iter_mut().enumerate() {
        for (c, corner) in triangle.iter_mut().enumerate() {
            let class = class(t, c);
            let owner = &mut owners[*corner as usize];
            if *owner == NOBODY {
                *owner = class;
            } else if *owner != class {
                *corner = *copy_of.entry((*corner, class)).or_insert_with(|| {
                    copies.push(*corner);
                    (vertices + copies.len() - 1) as u32
                });
            }
        }
    }
    Split { copies }
}

/// Appends the copies that a [`Split`] asks for to one attribute.
pub(super) fn append_copies<T: Copy>(attribute: &mut Vec<T>, copies: &[u32]) {
    attribute.reserve_exact(copies.len());
    for &source in copies {
        attribute.push(attribute[source as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_under_two_classes_is_doubled_once() {
        let mut triangles = [[0, 1, 2], [2, 1, 3], [1, 3, 4]];
        let classes = [7, 9, 9];
        let done = split(&mut triangles, 6, |t, _| classes[t]);
        assert_eq!(triangles, [[0, 1, 2], [6, 7, 3], [7, 3, 4]]);
        assert_eq!(done.copies, [2, 1]);
    }
}

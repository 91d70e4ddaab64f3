//! UV islands: the connected pieces of the flat pattern.

use glam::{Vec2, Vec3};

use super::forest::Forest;
use super::weld::{bits, weld};

/// Which island each triangle belongs to.
pub(super) struct Islands {
    /// Numbered in the order of their first triangles.
    pub(super) of_triangle: Vec<u32>,
    /// How many there are.
    pub(super) count: usize,
    /// Whether some vertex is used by no triangle.
    pub(super) unused: bool,
}

/// Above this many pieces it is quicker to compare all vertices than all pairs of pieces.
const PIECES_COMPARED: usize = 512;

/// Finds the UV islands of triangles that share no vertex across parts; `parts` gives each triangle's part, and
/// triangles of parts in `whole` are joined into one island whatever their UVs.
///
/// Vertices count as one where position and UV are the same, so a crease (normals doubled) does not cut. Triangles
/// that share a vertex belong together; pieces that touch in the UV map but not on the surface stay apart.
pub(super) fn find(
    positions: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    parts: &[u32],
    whole: &[bool],
) -> Islands {
    let mut forest = connect(triangles, positions.len());
    let pieces = Pieces::new(&mut forest, triangles, parts, positions.len());
    let mut changed = join_equal(positions, uvs, &pieces, &mut forest);
    if whole.contains(&true) {
        changed = true;
        let mut first = vec![u32::MAX; whole.len()];
        for (triangle, &part) in triangles.iter().zip(parts).filter(|(_, part)| whole[**part as usize]) {
            let first = &mut first[part as usize];
            *first = (*first).min(triangle[0]);
            forest.join(*first, triangle[0]);
        }
    }
    if changed {
        let (of_triangle, _, count) = number(&mut forest, triangles, positions.len());
        return Islands { of_triangle, count, unused: pieces.unused };
    }
    Islands { of_triangle: pieces.of_triangle, count: pieces.parts.len(), unused: pieces.unused }
}

fn connect(triangles: &[[u32; 3]], count: usize) -> Forest {
    let mut forest = Forest::new(count);
    for &[a, b, c] in triangles {
        forest.join(a, b);
        forest.join(b, c);
    }
    forest
}

/// Numbers the sets in the order of their first triangles: the number of each triangle, of each root, and how many.
fn number(forest: &mut Forest, triangles: &[[u32; 3]], count: usize) -> (Vec<u32>, Vec<u32>, usize) {
    let mut numbers = vec![u32::MAX; count];
    let mut next = 0;
    let of_triangle = triangles
        .iter()
        .map(|triangle| {
            let number = &mut numbers[forest.root(triangle[0]) as usize];
            if *number == u32::MAX {
                *number = next;
                next += 1;
            }
            *number
        })
        .collect();
    (of_triangle, numbers, next as usize)
}

/// The pieces connected by their indices alone.
struct Pieces {
    of_triangle: Vec<u32>,
    /// The part of each piece.
    parts: Vec<u32>,
    /// The piece of each vertex; `u32::MAX` where no triangle uses it.
    of_vertex: Vec<u32>,
    unused: bool,
}

impl Pieces {
    fn new(forest: &mut Forest, triangles: &[[u32; 3]], parts: &[u32], vertices: usize) -> Self {
        let (of_triangle, mut numbers, count) = number(forest, triangles, vertices);
        let mut part_of = vec![0; count];
        for (&piece, &part) in of_triangle.iter().zip(parts) {
            part_of[piece as usize] = part;
        }
        // A root is the least of its set: its number is there before the others ask for it.
        for vertex in 0..vertices as u32 {
            numbers[vertex as usize] = numbers[forest.root(vertex) as usize];
        }
        let unused = numbers.contains(&u32::MAX);
        Self { of_triangle, parts: part_of, of_vertex: numbers, unused }
    }
}

/// Joins the vertices of one part with the same position and UV; whether there were any.
///
/// Only pieces of one part whose boxes meet can share a vertex, and only vertices of those are compared.
fn join_equal(positions: &[Vec3], uvs: &[Vec2], pieces: &Pieces, forest: &mut Forest) -> bool {
    let count = pieces.parts.len();
    let suspect =
        if count > PIECES_COMPARED { vec![true; count] } else { meeting_pieces(positions, uvs, pieces) };
    let compared: Vec<u32> = (0..positions.len() as u32)
        .filter(|&vertex| suspect.get(pieces.of_vertex[vertex as usize] as usize) == Some(&true))
        .collect();
    let first = weld(compared.len(), |k| {
        let vertex = compared[k] as usize;
        let ([x, y, z], [u, v]) = (positions[vertex].to_array(), uvs[vertex].to_array());
        let part = pieces.parts[pieces.of_vertex[vertex] as usize];
        [bits(x), bits(y), bits(z), bits(u), bits(v), part]
    });
    let mut any = false;
    for (&vertex, &first) in compared.iter().zip(&first) {
        let first = compared[first as usize];
        any |= first != vertex;
        forest.join(first, vertex);
    }
    any
}

/// The pieces whose box in space and in the UV map meets that of another piece of the same part.
fn meeting_pieces(positions: &[Vec3], uvs: &[Vec2], pieces: &Pieces) -> Vec<bool> {
    let count = pieces.parts.len();
    let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY, Vec2::INFINITY, Vec2::NEG_INFINITY);
    let mut boxes = vec![empty; count];
    for ((&p, &uv), &piece) in positions.iter().zip(uvs).zip(&pieces.of_vertex) {
        if let Some((low, high, uv_low, uv_high)) = boxes.get_mut(piece as usize) {
            (*low, *high) = (low.min(p), high.max(p));
            (*uv_low, *uv_high) = (uv_low.min(uv), uv_high.max(uv));
        }
    }
    let mut suspect = vec![false; count];
    for i in 0..count {
        for j in 0..i {
            let ((a, b, c, d), (e, f, g, h)) = (boxes[i], boxes[j]);
            let space = a.cmple(f).all() && e.cmple(b).all();
            let pattern = c.cmple(h).all() && g.cmple(d).all();
            if pieces.parts[i] == pieces.parts[j] && space && pattern {
                suspect[i] = true;
                suspect[j] = true;
            }
        }
    }
    suspect
}

#[cfg(test)]
mod tests {
    use super::*;

    fn islands(uvs: &[[f32; 2]], triangles: &[[u32; 3]]) -> Vec<u32> {
        let uvs: Vec<Vec2> = uvs.iter().map(|&uv| Vec2::from(uv)).collect();
        let positions: Vec<Vec3> = uvs.iter().map(|uv| uv.extend(0.0)).collect();
        find(&positions, &uvs, triangles, &vec![0; triangles.len()], &[false]).of_triangle
    }

    #[test]
    fn pieces_that_share_an_edge_by_value_are_one_island() {
        let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 1.0], [0.0, 1.0], [-0.0, 0.0]];
        assert_eq!(islands(&uvs, &[[0, 1, 2], [3, 4, 5]]), [0, 0]);
    }

    #[test]
    fn pieces_that_share_a_corner_are_one_island() {
        let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 1.0]];
        assert_eq!(islands(&uvs, &[[0, 1, 2], [2, 3, 4]]), [0, 0]);
        assert_eq!(islands(&uvs, &[[0, 1, 2], [5, 3, 4]]), [0, 0]);
    }

    #[test]
    fn pieces_that_touch_in_the_uv_map_only_stay_apart() {
        let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::ONE, Vec2::new(2.0, 1.0), Vec2::splat(2.0)];
        let positions: Vec<Vec3> =
            uvs.iter().enumerate().map(|(i, uv)| uv.extend(f32::from(i > 2))).collect();
        let found = find(&positions, &uvs, &[[0, 1, 2], [3, 4, 5]], &[0, 0], &[false]);
        assert_eq!(found.of_triangle, [0, 1]);
    }

    #[test]
    fn same_uv_elsewhere_in_space_does_not_join() {
        let uv = [Vec2::ZERO, Vec2::X, Vec2::Y];
        let uvs = [uv, uv].concat();
        let mut positions: Vec<Vec3> = uvs.iter().map(|uv| uv.extend(0.0)).collect();
        positions[3..].iter_mut().for_each(|p| p.z = 1.0);
        let found = find(&positions, &uvs, &[[0, 1, 2], [3, 4, 5]], &[0, 0], &[false]);
        assert_eq!((found.of_triangle, found.count), (vec![0, 1], 2));
    }

    #[test]
    fn loose_triangles_are_put_together() {
        // More pieces than are compared in pairs: a grid of 20 x 20 squares, no vertex shared.
        let (mut uvs, mut triangles) = (Vec::new(), Vec::new());
        for k in 0..400 {
            let (x, y) = ((k % 20) as f32, (k / 20) as f32);
            for square in [[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]] {
                let base = uvs.len() as u32;
                uvs.extend(square.map(|[u, v]| [x + u, y + v]));
                triangles.push([base, base + 1, base + 2]);
            }
        }
        assert_eq!(islands(&uvs, &triangles), [0; 800]);
    }

    #[test]
    fn a_part_without_uvs_is_one_island() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE, -Vec3::ONE];
        let found = find(&positions, &[Vec2::ZERO; 6], &[[0, 1, 2], [3, 4, 5]], &[0, 0], &[true]);
        assert_eq!(found.count, 1);
    }
}

//! UV islands: the connected pieces of the flat pattern.

use glam::{Vec2, Vec3};

use super::forest::Forest;
use super::weld::{bits, weld};

/// The islands of one part.
pub(super) struct Islands {
    /// Triangles of one island that stand together, in the order of the triangles.
    runs: Vec<Run>,
    /// The box of each island in the flat pattern; islands are numbered in the order of their first triangles.
    pub(super) uv_boxes: Vec<(Vec2, Vec2)>,
    /// Whether some vertex is used by no triangle.
    pub(super) unused: bool,
}

/// Triangles of one piece or island that stand together.
#[derive(Clone, Copy)]
struct Run {
    of: u32,
    start: u32,
    end: u32,
}

/// Above this many pieces it is quicker to compare all vertices than all pairs of pieces.
const PIECES_COMPARED: usize = 512;

/// Finds the UV islands of a part: its vertices, and its triangles, which count vertices from `first`. With `whole`
/// all are one island.
///
/// Vertices count as one where position and UV are the same, so a crease (normals doubled) does not cut. Triangles
/// that share a vertex belong together; pieces that touch in the UV map but not on the surface stay apart.
pub(super) fn find(
    positions: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    first: u32,
    whole: bool,
) -> Islands {
    let mut forest = Forest::new(positions.len());
    for triangle in triangles {
        forest.join_three(triangle.map(|vertex| vertex - first));
    }
    let pieces = Pieces::new(forest.into_roots(), positions, uvs, triangles, first);
    let count = pieces.boxes.len();
    let mut joined = Forest::new(count);
    if whole {
        (1..count as u32).for_each(|piece| joined.join(0, piece));
    } else if count > 1 {
        join_equal(positions, uvs, &pieces, &mut joined);
    }
    pieces.into_islands(joined)
}

impl Islands {
    /// Puts the triangles of each island together, islands in their order; gives how many each has.
    pub(super) fn sort(&mut self, triangles: &mut [[u32; 3]]) -> Vec<usize> {
        let mut sizes = vec![0; self.uv_boxes.len()];
        for run in &self.runs {
            sizes[run.of as usize] += (run.end - run.start) as usize;
        }
        if !self.runs.is_sorted_by_key(|run| run.of) {
            self.runs.sort_by_key(|run| run.of);
            let mut sorted = Vec::with_capacity(triangles.len());
            for run in &self.runs {
                sorted.extend_from_slice(&triangles[run.start as usize..run.end as usize]);
            }
            triangles.copy_from_slice(&sorted);
        }
        sizes
    }
}

/// The box of some vertices in space and in the flat pattern.
#[derive(Clone, Copy)]
struct Bounds {
    low: Vec3,
    high: Vec3,
    uv_low: Vec2,
    uv_high: Vec2,
}

impl Bounds {
    const EMPTY: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
        uv_low: Vec2::INFINITY,
        uv_high: Vec2::NEG_INFINITY,
    };

    #[inline]
    fn add(&mut self, position: Vec3, uv: Vec2) {
        (self.low, self.high) = (self.low.min(position), self.high.max(position));
        (self.uv_low, self.uv_high) = (self.uv_low.min(uv), self.uv_high.max(uv));
    }

    fn meet(&self, other: &Self) -> bool {
        let space = self.low.cmple(other.high).all() && other.low.cmple(self.high).all();
        space && self.uv_low.cmple(other.uv_high).all() && other.uv_low.cmple(self.uv_high).all()
    }
}

/// The pieces connected by their indices alone, numbered in the order of their first triangles.
struct Pieces {
    runs: Vec<Run>,
    boxes: Vec<Bounds>,
    /// The least vertex of the piece of each vertex.
    roots: Vec<u32>,
    /// One more than the number of each piece, at its least vertex; zero elsewhere.
    numbers: Vec<u32>,
    unused: bool,
}

impl Pieces {
    fn new(roots: Vec<u32>, positions: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]], first: u32) -> Self {
        let mut numbers = vec![0u32; roots.len()];
        let (mut runs, mut count, mut start) = (Vec::new(), 0, 0);
        let same =
            |a: &[u32; 3], b: &[u32; 3]| roots[(a[0] - first) as usize] == roots[(b[0] - first) as usize];
        for run in triangles.chunk_by(same) {
            let number = &mut numbers[roots[(run[0][0] - first) as usize] as usize];
            if *number == 0 {
                count += 1;
                *number = count;
            }
            let end = start + run.len() as u32;
            runs.push(Run { of: *number - 1, start, end });
            start = end;
        }
        let mut pieces =
            Self { runs, boxes: vec![Bounds::EMPTY; count as usize], roots, numbers, unused: false };
        pieces.bound(positions, uvs);
        pieces
    }

    fn bound(&mut self, positions: &[Vec3], uvs: &[Vec2]) {
        let mut start = 0;
        for run in self.roots.chunk_by(|a, b| a == b) {
            let (vertices, piece) = (start..start + run.len(), self.numbers[run[0] as usize]);
            start = vertices.end;
            // A vertex that no triangle uses is alone and has no number.
            let Some(bounds) = self.boxes.get_mut((piece as usize).wrapping_sub(1)) else {
                self.unused = true;
                continue;
            };
            let mut within = Bounds::EMPTY;
            for (&position, &uv) in positions[vertices.clone()].iter().zip(&uvs[vertices]) {
                within.add(position, uv);
            }
            bounds.add(within.low, within.uv_low);
            bounds.add(within.high, within.uv_high);
        }
    }

    /// The piece of a vertex; none where no triangle uses it.
    fn of(&self, vertex: u32) -> Option<u32> {
        self.numbers[self.roots[vertex as usize] as usize].checked_sub(1)
    }

    /// Joins pieces to islands.
    fn into_islands(mut self, joined: Forest) -> Islands {
        let roots = joined.into_roots();
        let mut islands = vec![0; roots.len()];
        let mut boxes: Vec<(Vec2, Vec2)> = Vec::new();
        for (piece, (&root, bounds)) in roots.iter().zip(&self.boxes).enumerate() {
            // A root is the least of its set: its number is there before the others ask for it.
            if root as usize == piece {
                islands[piece] = boxes.len() as u32;
                boxes.push((bounds.uv_low, bounds.uv_high));
            }
            islands[piece] = islands[root as usize];
            let (low, high) = &mut boxes[islands[piece] as usize];
            (*low, *high) = (low.min(bounds.uv_low), high.max(bounds.uv_high));
        }
        self.runs.iter_mut().for_each(|run| run.of = islands[run.of as usize]);
        Islands { runs: self.runs, uv_boxes: boxes, unused: self.unused }
    }
}

/// Joins the pieces that have vertices with the same position and UV.
///
/// Only pieces whose boxes meet can share a vertex, and only vertices of those are compared.
fn join_equal(positions: &[Vec3], uvs: &[Vec2], pieces: &Pieces, joined: &mut Forest) {
    let suspect = meeting(&pieces.boxes);
    if !suspect.contains(&true) {
        return;
    }
    let compared: Vec<(u32, u32)> = (0..positions.len() as u32)
        .filter_map(|vertex| Some((vertex, pieces.of(vertex)?)))
        .filter(|&(_, piece)| suspect[piece as usize])
        .collect();
    let same = weld(compared.len(), |k| {
        let vertex = compared[k].0 as usize;
        let ([x, y, z], [u, v]) = (positions[vertex].to_array(), uvs[vertex].to_array());
        [bits(x), bits(y), bits(z), bits(u), bits(v)]
    });
    for (&(_, piece), &same) in compared.iter().zip(&same) {
        joined.join(compared[same as usize].1, piece);
    }
}

/// The pieces whose box meets that of another; all, where they are many.
fn meeting(boxes: &[Bounds]) -> Vec<bool> {
    let mut suspect = vec![boxes.len() > PIECES_COMPARED; boxes.len()];
    if boxes.len() <= PIECES_COMPARED {
        for i in 0..boxes.len() {
            for j in (0..i).filter(|&j| boxes[i].meet(&boxes[j])) {
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

    /// The island of each triangle, taken from the numbers of triangles before and after sorting.
    fn find_in(positions: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]], whole: bool) -> Vec<usize> {
        let mut islands = find(positions, uvs, triangles, 0, whole);
        let mut sorted = triangles.to_vec();
        let sizes = islands.sort(&mut sorted);
        let of: Vec<usize> = sizes.iter().enumerate().flat_map(|(k, &size)| vec![k; size]).collect();
        let place = |triangle| sorted.iter().position(|other| other == triangle);
        triangles.iter().map(|triangle| of[place(triangle).unwrap()]).collect()
    }

    fn islands(uvs: &[[f32; 2]], triangles: &[[u32; 3]]) -> Vec<usize> {
        let uvs: Vec<Vec2> = uvs.iter().map(|&uv| Vec2::from(uv)).collect();
        let positions: Vec<Vec3> = uvs.iter().map(|uv| uv.extend(0.0)).collect();
        find_in(&positions, &uvs, triangles, false)
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
        assert_eq!(find_in(&positions, &uvs, &[[0, 1, 2], [3, 4, 5]], false), [0, 1]);
    }

    #[test]
    fn same_uv_elsewhere_in_space_does_not_join() {
        let uv = [Vec2::ZERO, Vec2::X, Vec2::Y];
        let uvs = [uv, uv].concat();
        let mut positions: Vec<Vec3> = uvs.iter().map(|uv| uv.extend(0.0)).collect();
        positions[3..].iter_mut().for_each(|p| p.z = 1.0);
        assert_eq!(find_in(&positions, &uvs, &[[0, 1, 2], [3, 4, 5]], false), [0, 1]);
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
        assert_eq!(find_in(&positions, &[Vec2::ZERO; 6], &[[0, 1, 2], [3, 4, 5]], true), [0, 0]);
    }

    #[test]
    fn islands_that_take_turns_are_put_together_in_the_order_of_their_first_triangles() {
        // Two strips of squares far apart; the second comes first, and a vertex of neither follows.
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for k in 0..10u32 {
            for x in [0.0, 100.0] {
                positions.push(Vec3::new(x, k as f32, 0.0));
                positions.push(Vec3::new(x + 1.0, k as f32, 0.0));
            }
        }
        positions.push(Vec3::ONE * 0.5);
        for k in 0..9u32 {
            for strip in [2, 0] {
                let a = 7 + 4 * k + strip;
                triangles.extend([[a, a + 1, a + 5], [a, a + 5, a + 4]]);
            }
        }
        let uvs: Vec<Vec2> = positions.iter().map(|p| p.truncate()).collect();
        let mut found = find(&positions, &uvs, &triangles, 7, false);
        let mut sorted = triangles.clone();
        assert_eq!((found.sort(&mut sorted), found.unused), (vec![18, 18], true));
        let far = |triangle: &[u32; 3]| positions[triangle[0] as usize - 7].x >= 100.0;
        assert!(sorted[..18].iter().all(far) && !sorted[18..].iter().any(far));
        let kept = |all: &[[u32; 3]]| all.iter().copied().filter(far).collect::<Vec<_>>();
        assert_eq!(kept(&sorted), kept(&triangles));
        let (low, high) = found.uv_boxes[0];
        assert_eq!((low, high), (Vec2::new(100.0, 0.0), Vec2::new(101.0, 9.0)));
    }
}

//! The area of panels, and the orientation of their UVs.

use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::lanes::{Edges, LANES, Lanes, larger};
use super::panel::PanelFlags;

/// Twice the signed area of a triangle in the flat pattern; zero where it is lost in rounding.
pub(crate) fn uv_area([a, b, c]: [Vec2; 3]) -> f32 {
    let area = (b - a).perp_dot(c - a);
    let squares = (b - a).length_squared() + (c - a).length_squared();
    if area.abs() > lost_area(squares, largest([a, b, c])) && area.is_finite() { area } else { 0.0 }
}

/// The largest coordinate, unsigned.
#[inline(always)]
fn largest([a, b, c]: [Vec2; 3]) -> f32 {
    let ab = larger(larger(a.x.abs(), a.y.abs()), larger(b.x.abs(), b.y.abs()));
    larger(ab, larger(c.x.abs(), c.y.abs()))
}

/// The error that twice an area may have, from the sum of the squares of two edges and the largest coordinate: each
/// coordinate is known to half a unit in its last place.
#[inline(always)]
fn lost_area(squares: f32, largest: f32) -> f32 {
    // The sum of two lengths is at most the root of twice the sum of their squares.
    larger(1e-6 * squares, f32::EPSILON * largest * (2.0 * squares).sqrt())
}

/// The figures of a panel.
#[derive(Debug, Default)]
pub(super) struct Figures {
    pub(super) area: f32,
    pub(super) flags: PanelFlags,
    /// Whether it has triangles of both UV orientations.
    pub(super) folded: bool,
    /// Area-weighted centre on the surface.
    pub(super) centre: Vec3,
    /// Corners of the box in the flat pattern.
    pub(super) uv_box: (Vec2, Vec2),
}

/// Triangles that one task measures.
const CHUNK: usize = 16 * 1024;

/// Triangles whose figures are summed in single precision.
const SINGLE: usize = 64 * LANES;

/// Some triangles, one array per coordinate.
pub(super) struct Batch {
    /// Their first corners: x, y, z.
    pub(super) corner: [Lanes; 3],
    /// Edges in space.
    pub(super) edges: Edges,
    /// Edges in the flat pattern: the first edge's u, v, then the second's.
    pub(super) uv_edges: [Lanes; 4],
    /// The largest coordinate in the flat pattern, unsigned.
    largest_uv: Lanes,
}

impl Batch {
    pub(super) fn new() -> Self {
        let zeros = [0.0; LANES];
        Self { corner: [zeros; 3], edges: Edges::NONE, uv_edges: [zeros; 4], largest_uv: zeros }
    }

    /// Takes at most [`LANES`] triangles; the other lanes have no area.
    pub(super) fn fill(&mut self, positions: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) {
        if triangles.len() < LANES {
            *self = Self::new();
        }
        for (i, &triangle) in triangles.iter().take(LANES).enumerate() {
            let corners = triangle.map(|vertex| positions[vertex as usize]);
            let [a, b, c] = triangle.map(|vertex| uvs[vertex as usize]);
            for (lanes, x) in self.corner.iter_mut().zip(corners[0].to_array()) {
                lanes[i] = x;
            }
            self.edges.set(i, corners);
            let uv_edges = [b - a, c - a].map(|edge| edge.to_array());
            for (lanes, &x) in self.uv_edges.iter_mut().zip(uv_edges.as_flattened()) {
                lanes[i] = x;
            }
            self.largest_uv[i] = largest([a, b, c]);
        }
    }

    /// Areas, square metres.
    pub(super) fn areas(&self) -> Lanes {
        std::array::from_fn(|i| {
            let [x, y, z] = self.edges.cross(i);
            0.5 * (x * x + y * y + z * z).sqrt()
        })
    }

    /// Twice the signed areas in the flat pattern, as [`uv_area`] gives them.
    pub(super) fn uv_areas(&self) -> Lanes {
        let [au, av, bu, bv] = &self.uv_edges;
        std::array::from_fn(|i| {
            let area = au[i] * bv[i] - av[i] * bu[i];
            let squares = (au[i] * au[i] + av[i] * av[i]) + (bu[i] * bu[i] + bv[i] * bv[i]);
            if area.abs() > lost_area(squares, self.largest_uv[i]) { area } else { 0.0 }
        })
    }
}

/// Sums over some triangles.
#[derive(Default)]
struct Sums {
    area: f64,
    mirrored_area: f64,
    /// Area times centre.
    moment: DVec3,
    /// Triangles whose UVs have an area, as seen from the front.
    upright: u32,
    mirrored: u32,
}

impl Sums {
    fn new(positions: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) -> Self {
        let mut sums = Self::default();
        let mut batch = Batch::new();
        for triangles in triangles.chunks(SINGLE) {
            let zeros = [0.0; LANES];
            let (mut area, mut mirrored_area, mut moment) = (zeros, zeros, [zeros; 3]);
            let (mut upright, mut mirrored) = ([0; LANES], [0; LANES]);
            for triangles in triangles.chunks(LANES) {
                batch.fill(positions, uvs, triangles);
                let (areas, uv_areas) = (batch.areas(), batch.uv_areas());
                for i in 0..LANES {
                    area[i] += areas[i];
                    mirrored_area[i] += if uv_areas[i] < 0.0 { areas[i] } else { 0.0 };
                    upright[i] += u32::from(uv_areas[i] > 0.0);
                    mirrored[i] += u32::from(uv_areas[i] < 0.0);
                }
                for (axis, moment) in moment.iter_mut().enumerate() {
                    let (corner, p, q) =
                        (&batch.corner[axis], &batch.edges.0[axis], &batch.edges.0[axis + 3]);
                    for i in 0..LANES {
                        moment[i] += areas[i] * (corner[i] + (p[i] + q[i]) * (1.0 / 3.0));
                    }
                }
            }
            let sum = |lanes: &Lanes| lanes.iter().map(|&x| f64::from(x)).sum::<f64>();
            sums.add(&Self {
                area: sum(&area),
                mirrored_area: sum(&mirrored_area),
                moment: DVec3::from(moment.each_ref().map(sum)),
                upright: upright.iter().sum(),
                mirrored: mirrored.iter().sum(),
            });
        }
        sums
    }

    fn add(&mut self, other: &Self) {
        self.area += other.area;
        self.mirrored_area += other.mirrored_area;
        self.moment += other.moment;
        self.upright += other.upright;
        self.mirrored += other.mirrored;
    }
}

/// Measures the triangles of a panel with the given box in the flat pattern.
pub(super) fn measure(
    positions: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    uv_box: (Vec2, Vec2),
) -> Figures {
    let chunks = triangles.par_chunks(CHUNK).map(|triangles| Sums::new(positions, uvs, triangles));
    // Added in their order, so that the result does not depend on how tasks were shared out.
    let sums = chunks.collect::<Vec<_>>().iter().fold(Sums::default(), |mut all, sums| {
        all.add(sums);
        all
    });
    let with_uv_area = sums.upright as usize + sums.mirrored as usize;
    Figures {
        area: sums.area as f32,
        flags: PanelFlags {
            mirrored: sums.mirrored_area > 0.5 * sums.area,
            degenerate: with_uv_area < triangles.len(),
        },
        folded: sums.upright > 0 && sums.mirrored > 0,
        centre: if sums.area > 0.0 { (sums.moment / sums.area).as_vec3() } else { Vec3::ZERO },
        uv_box,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pseudo_random::PseudoRandom;

    const NO_BOX: (Vec2, Vec2) = (Vec2::ZERO, Vec2::ZERO);

    #[test]
    fn a_pyramid_has_its_area_and_centre() {
        // Four faces over a square of side 6 with its apex 4 above: slant height 5, faces of 15 each. Each face's
        // centre is a third of the way up.
        let positions = [
            Vec3::new(3.0, 0.0, 3.0),
            Vec3::new(3.0, 0.0, -3.0),
            Vec3::new(-3.0, 0.0, -3.0),
            Vec3::new(-3.0, 0.0, 3.0),
            Vec3::new(0.0, 4.0, 0.0),
        ]
        .map(|p| p + Vec3::new(1.0, 2.0, 3.0));
        let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y, Vec2::splat(0.5)];
        let faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let many: Vec<[u32; 3]> = faces.repeat(10_001);
        for (triangles, count) in [(&faces[..], 1.0), (&many[..], 10_001.0)] {
            let figures = measure(&positions, &uvs, triangles, NO_BOX);
            assert!((figures.area / (60.0 * count) - 1.0).abs() < 1e-5, "{}", figures.area);
            assert!((figures.centre - Vec3::new(1.0, 2.0 + 4.0 / 3.0, 3.0)).length() < 1e-4);
            assert!(!figures.folded && figures.flags == PanelFlags::default());
        }
    }

    #[test]
    fn mirrored_by_more_than_half_the_area_is_flagged() {
        // An upright triangle of area 1/2 and a mirrored square of side `side` beside it.
        let flags = |side: f32| {
            let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
            let positions = [square, square.map(|p| p * side + 5.0)].concat();
            let flipped = square.map(|uv| Vec2::new(-uv.x, uv.y));
            let positions: Vec<Vec3> = positions.iter().map(|p| p.extend(0.0)).collect();
            let uvs = [square, flipped].concat();
            let figures = measure(&positions, &uvs, &[[0, 1, 2], [4, 5, 6], [4, 6, 7]], NO_BOX);
            assert!(figures.folded && !figures.flags.degenerate);
            figures.flags.mirrored
        };
        assert!(flags(0.75) && !flags(0.7));
    }

    #[test]
    fn uvs_without_area_are_degenerate() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let line = measure(&positions, &[Vec2::ZERO, Vec2::ONE, Vec2::ONE * 2.0], &[[0, 1, 2]], NO_BOX);
        assert!(line.flags.degenerate && line.area == 0.5 && !line.flags.mirrored && !line.folded);
    }

    #[test]
    fn lanes_and_single_triangles_agree_on_uv_areas() {
        let mut numbers = PseudoRandom::new(7);
        for exponent in 0..40 {
            let offset = Vec2::splat(0.3 * 2f32.powi(exponent - 20));
            let uvs: Vec<Vec2> =
                (0..3 * LANES).map(|_| offset + Vec2::new(numbers.unit(), numbers.unit()) * 0.01).collect();
            let triangles: Vec<[u32; 3]> = (0..LANES as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
            let mut batch = Batch::new();
            batch.fill(&vec![Vec3::ZERO; uvs.len()], &uvs, &triangles);
            let one = |triangle: &[u32; 3]| uv_area(triangle.map(|i| uvs[i as usize]));
            assert_eq!(batch.uv_areas().to_vec(), triangles.iter().map(one).collect::<Vec<_>>());
        }
    }
}

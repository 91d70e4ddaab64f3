//! Normals that a file lacks.

use glam::Vec3;
use rayon::prelude::*;

use super::check::vector_area;
use super::draft::Draft;
use super::split::{append_copies, split};
use super::weld::{bits, weld};

/// Faces that meet at a larger angle than this form a crease: their normals are not averaged.
pub(super) const CREASE_DEGREES: f32 = 60.0;

/// Makes every normal unit; one that has no direction (zero, not a number) becomes zero. Returns how many those are.
pub(super) fn make_unit(normals: &mut [Vec3]) -> usize {
    let make = |chunk: &mut [Vec3]| {
        let mut without = 0;
        for normal in chunk {
            let length_squared = normal.length_squared();
            // Most files keep unit normals: they stay as they are, to the bit.
            if (length_squared - 1.0).abs() > 1e-6 {
                *normal = if normal.is_finite() { direction(*normal) } else { Vec3::ZERO };
                without += usize::from(*normal == Vec3::ZERO);
            } else if length_squared.is_nan() {
                *normal = Vec3::ZERO;
                without += 1;
            }
        }
        without
    };
    normals.par_chunks_mut(16 * 1024).map(make).sum()
}

/// Unit vector along a finite vector of any length; zero for zero.
fn direction(v: Vec3) -> Vec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 { (v / largest).normalize_or_zero() } else { Vec3::ZERO }
}

/// Gives each zero normal in the parts that have normals the angle-weighted mean of its triangles' normals. Returns
/// how many there were.
pub(super) fn fill_zeros(draft: &mut Draft) -> usize {
    let mut filled = 0;
    for part in draft.parts.iter().filter(|part| part.has_normals) {
        let zeros: Vec<bool> =
            draft.normals[part.vertices.clone()].iter().map(|&n| n == Vec3::ZERO).collect();
        if !zeros.contains(&true) {
            continue;
        }
        let first = part.vertices.start;
        let mut sums = vec![Vec3::ZERO; zeros.len()];
        let mut last = vec![Vec3::ZERO; zeros.len()];
        for &triangle in &draft.triangles[part.triangles.clone()] {
            let face = face_normal(&draft.positions, triangle);
            for (c, &vertex) in triangle.iter().enumerate() {
                sums[vertex as usize - first] += face * corner_angle(&draft.positions, triangle, c);
                last[vertex as usize - first] = face;
            }
        }
        for (i, _) in zeros.iter().enumerate().filter(|(_, zero)| **zero) {
            // A vertex that no triangle uses gets any unit vector.
            let normal = sums[i].try_normalize().or_else(|| last[i].try_normalize()).unwrap_or(Vec3::Y);
            draft.normals[first + i] = normal;
            filled += 1;
        }
    }
    filled
}

/// Computes the normals of the parts that have none; vertices on a crease are doubled.
///
/// Vertices at the same position count as one, so a UV seam leaves no edge in the shading. Around it, faces that
/// share an edge and meet at less than [`CREASE_DEGREES`] form a group; each group's normal is the mean of its faces'
/// weighted by their angle there (Thuermer and Wuethrich, "Computing vertex normals from polygonal facets", 1998).
pub(super) fn compute_missing(draft: &mut Draft) {
    let vertices = std::mem::take(&mut draft.positions);
    let mut out = Draft::default();
    // Parts grow by their copies, so all of them move up.
    for index in 0..draft.parts.len() {
        let part = &mut draft.parts[index];
        let (old, base) = (part.vertices.clone(), out.positions.len());
        let mut positions = vertices[old.clone()].to_vec();
        let mut uvs = draft.uvs[old.clone()].to_vec();
        let mut triangles: Vec<[u32; 3]> = draft.triangles[part.triangles.clone()].to_vec();
        for corner in triangles.as_flattened_mut() {
            *corner -= old.start as u32;
        }
        let normals = if part.has_normals {
            draft.normals[old].to_vec()
        } else {
            let (normals, copies) = creased(&positions, &mut triangles);
            append_copies(&mut positions, &copies);
            append_copies(&mut uvs, &copies);
            normals
        };
        for corner in triangles.as_flattened_mut() {
            *corner += base as u32;
        }
        out.positions.extend(positions);
        out.uvs.extend(uvs);
        out.normals.extend(normals);
        out.triangles.extend(triangles);
        part.vertices = base..out.positions.len();
        part.has_normals = true;
    }
    draft.positions = out.positions;
    draft.normals = out.normals;
    draft.uvs = out.uvs;
    draft.triangles = out.triangles;
}

pub(super) fn face_normal(positions: &[Vec3], triangle: [u32; 3]) -> Vec3 {
    vector_area(positions, triangle).map_or(Vec3::ZERO, direction)
}

/// The angle of a triangle at one of its corners, radians.
pub(super) fn corner_angle(positions: &[Vec3], triangle: [u32; 3], corner: usize) -> f32 {
    let at = |k: usize| positions[triangle[(corner + k) % 3] as usize];
    let (p, q) = (at(1) - at(0), at(2) - at(0));
    p.cross(q).length().atan2(p.dot(q))
}

/// A corner of a triangle, and where its two edges lead.
#[derive(Clone, Copy)]
struct Edge {
    point: u32,
    to: u32,
    corner: u32,
}

/// The normals of one part, and the vertices doubled for them; `triangles` are renumbered.
fn creased(positions: &[Vec3], triangles: &mut [[u32; 3]]) -> (Vec<Vec3>, Vec<u32>) {
    let points = weld(positions.len(), |i| positions[i].to_array().map(bits));
    let faces: Vec<Vec3> = triangles.iter().map(|&triangle| face_normal(positions, triangle)).collect();
    let groups = smoothing_groups(&points, triangles, &faces);
    let mut sums = vec![Vec3::ZERO; triangles.len() * 3];
    for (corner, &group) in groups.iter().enumerate() {
        let t = corner / 3;
        sums[group as usize] += faces[t] * corner_angle(positions, triangles[t], corner % 3);
    }
    let done = split(triangles, positions.len(), |t, c| groups[t * 3 + c]);
    // A vertex that no triangle uses gets any unit vector.
    let mut normals = vec![Vec3::Y; positions.len() + done.copies.len()];
    for (t, triangle) in triangles.iter().enumerate() {
        for (c, &vertex) in triangle.iter().enumerate() {
            normals[vertex as usize] = sums[groups[t * 3 + c] as usize].try_normalize().unwrap_or(faces[t]);
        }
    }
    (normals, done.copies)
}

/// For each corner (three per triangle) the first corner of its group: those at the same point, joined over edges
/// that are no creases.
fn smoothing_groups(points: &[u32], triangles: &[[u32; 3]], faces: &[Vec3]) -> Vec<u32> {
    let mut edges = Vec::with_capacity(triangles.len() * 6);
    for (t, triangle) in triangles.iter().enumerate() {
        let at = triangle.map(|vertex| points[vertex as usize]);
        for c in 0..3 {
            let corner = (t * 3 + c) as u32;
            edges.push(Edge { point: at[c], to: at[(c + 1) % 3], corner });
            edges.push(Edge { point: at[c], to: at[(c + 2) % 3], corner });
        }
    }
    edges.par_sort_unstable_by_key(|edge| (edge.point, edge.to, edge.corner));
    let mut groups = super::forest::Forest::new(triangles.len() * 3);
    let smooth = CREASE_DEGREES.to_radians().cos();
    for pair in edges.windows(2) {
        let [one, two] = pair else { continue };
        let meet = one.point == two.point && one.to == two.to;
        if meet && faces[one.corner as usize / 3].dot(faces[two.corner as usize / 3]) > smooth {
            groups.join(one.corner, two.corner);
        }
    }
    groups.into_roots()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of two squares that share an edge and meet at `angle`.
    fn bent(angle: f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (sin, cos) = angle.sin_cos();
        let mut positions = Vec::new();
        for y in [0.0, 1.0] {
            positions.extend([Vec3::new(-1.0, y, 0.0), Vec3::new(0.0, y, 0.0), Vec3::new(cos, y, -sin)]);
        }
        (positions, vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    }

    #[test]
    fn a_sharp_bend_is_creased_and_a_soft_one_is_smooth() {
        let (positions, mut triangles) = bent(1.2);
        let (normals, copies) = creased(&positions, &mut triangles);
        assert_eq!(copies, [1, 4]);
        assert!((normals[triangles[0][1] as usize] - Vec3::Z).length() < 1e-6);

        let angle = 0.8f32;
        let (positions, mut triangles) = bent(angle);
        let (normals, copies) = creased(&positions, &mut triangles);
        assert!(copies.is_empty());
        // At vertex 1 the angles are 90 degrees left (one triangle) and 45 + 45 right: the bisector.
        let bisector = Vec3::new((angle / 2.0).sin(), 0.0, (angle / 2.0).cos());
        assert!((normals[1] - bisector).length() < 1e-6, "{}", normals[1]);
    }

    #[test]
    fn a_sphere_has_its_own_normals_across_the_seam() {
        let (rings, sides) = (24u32, 32u32);
        let mut positions = Vec::new();
        for i in 0..=rings {
            let polar = std::f32::consts::PI * i as f32 / rings as f32;
            for j in 0..=sides {
                // The last column repeats the first, as at a UV seam.
                let azimuth = std::f32::consts::TAU * (j % sides) as f32 / sides as f32;
                positions.push(Vec3::new(
                    polar.sin() * azimuth.cos(),
                    polar.cos(),
                    -polar.sin() * azimuth.sin(),
                ));
            }
        }
        let mut triangles = Vec::new();
        for i in 1..rings - 1 {
            for j in 0..sides {
                let a = i * (sides + 1) + j;
                let b = a + sides + 1;
                triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            }
        }
        let (normals, copies) = creased(&positions, &mut triangles);
        assert!(copies.is_empty());
        for &vertex in triangles.as_flattened() {
            let (n, p) = (normals[vertex as usize], positions[vertex as usize]);
            assert!(n.dot(p) > 0.99, "{n} {p}");
            let i = vertex / (sides + 1);
            // Inner rings: within the tessellation's error.
            assert!(!(2..rings - 2).contains(&i) || n.dot(p) > 0.9995, "{n} {p}");
        }
        let seam = 8 * (sides + 1);
        assert_eq!(normals[seam as usize], normals[(seam + sides) as usize]);
    }

    #[test]
    fn normals_of_any_length_become_unit_and_hopeless_ones_zero() {
        let mut normals = [
            Vec3::new(0.0, 3.0, 4.0),
            Vec3::X * 1e-30,
            Vec3::X * 1e30,
            Vec3::ZERO,
            Vec3::NAN,
            Vec3::INFINITY,
        ];
        assert_eq!(make_unit(&mut normals), 3);
        assert_eq!(normals[..3], [Vec3::new(0.0, 0.6, 0.8), Vec3::X, Vec3::X]);
        assert_eq!(normals[3..], [Vec3::ZERO; 3]);
    }
}

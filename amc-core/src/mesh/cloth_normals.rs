//! Normals of sewn cloth.

use glam::Vec3;

use super::normals::{corner_angle, face_normal};
use super::weld::{bits, weld};

/// Unit normals, one per position, of cloth sewn from panels: smooth within a panel and across its seams, since cloth
/// does not crease at every seam.
///
/// Each is the mean of the normals of the triangles there, weighted by their angles. Vertices at the same position, to
/// the bit, count as one: so sewn vertices have one normal. Where layers lie against each other, as at the turned edge of
/// a collar, a vertex whose own triangles look away from that mean keeps its own.
///
/// `triangles` are corners, counter-clockwise as seen from the front; one with an index out of range adds nothing. A
/// vertex without any triangle that has an area has +y.
pub fn cloth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let first = weld(positions.len(), |vertex| positions[vertex].to_array().map(bits));
    let mut own = vec![Vec3::ZERO; positions.len()];
    for &triangle in triangles.iter().filter(|t| t.iter().all(|&corner| (corner as usize) < positions.len()))
    {
        let face = face_normal(positions, triangle);
        for (corner, &vertex) in triangle.iter().enumerate() {
            own[vertex as usize] += face * corner_angle(positions, triangle, corner);
        }
    }
    let mut shared = vec![Vec3::ZERO; positions.len()];
    for (&first, &own) in first.iter().zip(&own) {
        shared[first as usize] += own;
    }
    let normal = |(&first, &own): (&u32, &Vec3)| {
        let shared = shared[first as usize];
        let normal = if shared.dot(own) > 0.0 || own == Vec3::ZERO { shared } else { own };
        normal.try_normalize().unwrap_or(Vec3::Y)
    };
    first.iter().zip(&own).map(normal).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two squares sewn along x = 0, the right one turned up by `angle`; six vertices of which two pairs coincide.
    fn sewn(angle: f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (sin, cos) = angle.sin_cos();
        let square = |x: Vec3| [Vec3::ZERO, x, x + Vec3::Y, Vec3::Y];
        let right = square(Vec3::new(cos, 0.0, sin));
        let left = square(Vec3::NEG_X);
        ([right, left].concat(), vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]])
    }

    #[test]
    fn sewn_vertices_share_the_bisector_however_sharp_the_bend() {
        for angle in [0.0f32, 0.5, 1.4, 2.0] {
            let (positions, triangles) = sewn(angle);
            let normals = cloth_normals(&positions, &triangles);
            // Both squares have a right angle at each corner, so they weigh alike.
            let bisector = Vec3::new(-(angle / 2.0).sin(), 0.0, (angle / 2.0).cos());
            for vertex in [0, 3, 4, 7] {
                assert!((normals[vertex] - bisector).length() < 1e-5, "{angle}: {}", normals[vertex]);
            }
            assert!((normals[5] - Vec3::Z).length() < 1e-6);
        }
    }

    #[test]
    fn layers_back_to_back_keep_their_own() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let positions = [positions, positions].concat();
        let normals = cloth_normals(&positions, &[[0, 1, 2], [3, 5, 4]]);
        assert_eq!((normals[0], normals[3]), (Vec3::Z, Vec3::NEG_Z));
        assert_eq!(cloth_normals(&[Vec3::ONE], &[[0, 0, 0], [0, 1, 2]]), [Vec3::Y]);
    }
}

//! The flat pattern in its true proportions.

use glam::{Affine2, DMat2, DVec2, Mat2, Vec2};

use super::{Garment, Panel};

impl Garment {
    /// From a panel's UVs to metres on its cloth laid flat, the front up, the origin in the middle of the panel's box.
    ///
    /// Lengths are those that its file says ([`super::PatternPiece::uv_unit`]); else those of the symmetric map that agrees
    /// best with the surface: the root of the area-weighted mean of J^T J, J taking UVs to the surface. So UVs that were
    /// scaled, or drawn out along one axis, get the proportions of the cloth. Mirrored UVs are turned over.
    ///
    /// None where the panel has no UVs with an area.
    pub fn uv_to_metres(&self, panel: &Panel) -> Option<Affine2> {
        let triangles = self.triangles.get(panel.triangles.start as usize..panel.triangles.end as usize)?;
        let lengths = match panel.pattern.uv_unit {
            Some(unit) => Mat2::from_diagonal(Vec2::splat(unit)),
            None => root(self.metric(triangles))?.as_mat2(),
        };
        let front = if panel.flags.mirrored { Vec2::new(-1.0, 1.0) } else { Vec2::ONE };
        let to_metres = Mat2::from_diagonal(front) * lengths;
        let metres = triangles.as_flattened().iter().map(|&vertex| to_metres * self.uvs[vertex as usize]);
        let (low, high) =
            metres.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let found = Affine2::from_mat2_translation(to_metres, -(low + high) / 2.0);
        (found.is_finite() && to_metres.determinant() != 0.0).then_some(found)
    }

    /// As [`Garment::uv_to_metres`], but as the UVs draw the panel: mirrored ones are not turned over.
    pub fn uv_to_drawn_metres(&self, panel: &Panel) -> Option<Affine2> {
        let drawn = if panel.flags.mirrored { Vec2::new(-1.0, 1.0) } else { Vec2::ONE };
        Some(Affine2::from_scale(drawn) * self.uv_to_metres(panel)?)
    }

    /// The mean of J^T J over the area; no number where no UVs have an area.
    fn metric(&self, triangles: &[[u32; 3]]) -> DMat2 {
        let (mut metric, mut total) = (DMat2::ZERO, 0.0);
        for triangle in triangles {
            let [a, b, c] = triangle.map(|vertex| self.positions[vertex as usize].as_dvec3());
            let [flat_a, flat_b, flat_c] = triangle.map(|vertex| self.uvs[vertex as usize].as_dvec2());
            let (p, q) = (b - a, c - a);
            // Products of the edges in space, brought back to the UVs.
            let products = DMat2::from_cols(DVec2::new(p.dot(p), p.dot(q)), DVec2::new(p.dot(q), q.dot(q)));
            let back = DMat2::from_cols(flat_b - flat_a, flat_c - flat_a).inverse();
            let of_triangle = back.transpose() * products * back;
            let area = p.cross(q).length();
            if area > 0.0 && of_triangle.is_finite() {
                metric += of_triangle * area;
                total += area;
            }
        }
        metric * (1.0 / total)
    }
}

/// The positive root of a symmetric positive matrix: (M + s I) / sqrt(trace M + 2 s), s the root of the determinant.
fn root(matrix: DMat2) -> Option<DMat2> {
    let s = matrix.determinant().sqrt();
    let scale = (matrix.x_axis.x + matrix.y_axis.y + 2.0 * s).sqrt();
    (scale > 0.0).then(|| (matrix + DMat2::from_diagonal(DVec2::splat(s))) * (1.0 / scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::tests::{flat, garment_of};
    use glam::Quat;

    /// The map of a panel whose UVs are its places after `to_uv`.
    fn map(to_uv: impl Fn(Vec2) -> Vec2, change: impl Fn(&mut Panel)) -> Option<Affine2> {
        let mut garment = garment_of(&[flat(Quat::from_rotation_x(0.7), to_uv)]);
        change(&mut garment.panels[0]);
        garment.uv_to_metres(&garment.panels[0])
    }

    #[test]
    fn uvs_drawn_out_along_one_axis_get_the_proportions_of_the_cloth() {
        let found = map(|p| Vec2::new(p.x / 40.0, p.y / 10.0) + 0.3, |_| {}).unwrap();
        assert!(found.matrix2.abs_diff_eq(Mat2::from_diagonal(Vec2::new(40.0, 10.0)), 1e-3), "{found:?}");
        let middle = found.transform_point2(Vec2::new(0.3, 0.3) + Vec2::new(3.0 / 40.0, 3.0 / 10.0));
        assert!(middle.length() < 0.5, "the middle of the box: {middle}");
    }

    #[test]
    fn the_unit_of_the_file_goes_before_what_is_measured_and_mirrored_uvs_are_turned_over() {
        let said = map(|p| p / 3.0, |panel| panel.pattern.uv_unit = Some(2.0)).unwrap();
        assert_eq!(said.matrix2, Mat2::from_diagonal(Vec2::splat(2.0)));
        let mirrored = map(|p| Vec2::new(-p.x, p.y), |panel| panel.flags.mirrored = true).unwrap();
        assert!(
            mirrored.matrix2.abs_diff_eq(Mat2::from_diagonal(Vec2::new(-1.0, 1.0)), 1e-5),
            "{mirrored:?}"
        );
        assert_eq!(map(|_| Vec2::ZERO, |_| {}), None);
    }
}

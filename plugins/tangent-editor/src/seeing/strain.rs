//! How the cloth is stretched and sheared on the garment, along its threads.

use amc_core::mesh::Garment;
use glam::{Mat2, Vec2};

use super::FlatPanel;

/// Of a triangle, against the cloth laid flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strain {
    /// Length on the garment over length on the flat cloth, along the warp.
    pub(super) warp: f32,
    /// The same along the weft.
    pub(super) weft: f32,
    /// From the warp to the weft on the garment, radians: a right angle where the cloth is not sheared.
    pub(super) angle: f32,
    /// From where `yarn` runs to where `gradient` does, radians, unsigned.
    pub(super) turn: f32,
}

impl Strain {
    /// Of the map from the flat cloth to the surface whose first fundamental form is `form`; `warp` is unit. None where it makes no sense.
    pub(super) fn new(form: Mat2, warp: Vec2) -> Option<Self> {
        let weft = warp.perp();
        let inverse = form.inverse();
        let length = |form: Mat2, d: Vec2| d.dot(form * d).max(0.0).sqrt();
        let (along, across) = (length(form, warp), length(form, weft));
        let cosine = warp.dot(form * weft) / (along * across);
        // The gradient of the coordinate along the warp is J G^-1 w, and J w is the yarn: their product is w.w = 1.
        let turn = (1.0 / (along * length(inverse, warp))).clamp(-1.0, 1.0).acos();
        let strain = Self { warp: along, weft: across, angle: cosine.clamp(-1.0, 1.0).acos(), turn };
        let is_known = [along, across, cosine, turn].iter().all(|value| value.is_finite());
        (is_known && along > 0.0 && across > 0.0).then_some(strain)
    }
}

/// Of every triangle, and its area on the garment; `warp` gives the unit direction in the flat pattern of a triangle.
pub(super) fn strains(
    panel: &FlatPanel,
    garment: &Garment,
    warp: impl Fn([u32; 3]) -> Vec2,
) -> Vec<Option<(Strain, f32)>> {
    let of = |&triangle: &[u32; 3]| {
        let ([a, b, c], [p, q, r]) = (panel.corners(triangle), panel.positions(garment, triangle));
        let edges = [q - p, r - p];
        let products = Mat2::from_cols(
            Vec2::new(edges[0].dot(edges[0]), edges[0].dot(edges[1])),
            Vec2::new(edges[0].dot(edges[1]), edges[1].dot(edges[1])),
        );
        let back = Mat2::from_cols(b - a, c - a).inverse();
        let form = back.transpose() * products * back;
        let mut strain = Strain::new(form, warp(triangle)).filter(|_| form.is_finite())?;
        if panel.is_mirrored {
            // The weft is on the other side of the warp.
            strain.angle = std::f32::consts::PI - strain.angle;
        }
        Some((strain, edges[0].cross(edges[1]).length() / 2.0))
    };
    panel.triangles.iter().map(of).collect()
}

/// For every vertex the mean of what its triangles have, by their areas; no number where none has any.
pub(super) fn at_vertices(panel: &FlatPanel, values: &[Option<(f32, f32)>]) -> Vec<f32> {
    let mut sums = vec![(0.0f32, 0.0f32); panel.places.len()];
    for (triangle, value) in panel.triangles.iter().zip(values) {
        let Some((value, area)) = value else { continue };
        for &vertex in triangle {
            let sum = &mut sums[vertex as usize];
            *sum = (sum.0 + value * area, sum.1 + area);
        }
    }
    sums.into_iter().map(|(sum, area)| sum / area).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::sheet;
    use super::*;
    use glam::{Quat, Vec3};

    #[test]
    fn a_sheet_under_a_known_matrix_has_the_closed_form() {
        let map = Mat2::from_cols(Vec2::new(1.1, 0.05), Vec2::new(0.3, 0.95));
        let turn = Quat::from_rotation_y(0.8);
        for degrees in [0.0f32, 30.0, 90.0] {
            let (garment, panel) = sheet(6, |p| turn * (map * p).extend(0.0));
            // The pattern's true size is not known from the map: the file has to say it.
            let warp = Vec2::from_angle(degrees.to_radians());
            let found = strains(&panel, &garment, |_| warp);
            let (along, across) = (map * warp, map * warp.perp());
            let shear = along.angle_to(across);
            let gradient = map.inverse().transpose() * warp;
            let off = gradient.angle_to(along).abs();
            assert_eq!(found.len(), panel.triangles.len());
            for (strain, area) in found.into_iter().flatten() {
                assert!((strain.warp - along.length()).abs() < 1e-3, "{strain:?}");
                assert!((strain.weft - across.length()).abs() < 1e-3, "{strain:?}");
                assert!((strain.angle - shear).abs() < 1e-3, "{strain:?} {shear}");
                assert!((strain.turn - off).abs() < 1e-3, "{strain:?} {off}");
                assert!(area > 0.0);
            }
        }
    }

    #[test]
    fn what_has_no_area_has_no_strain_and_vertices_have_means() {
        assert_eq!(Strain::new(Mat2::ZERO, Vec2::X), None);
        assert_eq!(Strain::new(Mat2::NAN, Vec2::X), None);
        let (garment, panel) = sheet(2, |p| Vec3::new(p.x, p.y, 0.0));
        let values: Vec<Option<(f32, f32)>> = vec![Some((1.0, 3.0)), Some((5.0, 1.0))];
        let means = at_vertices(&panel, &values);
        assert!(means.iter().all(|mean| [1.0, 2.0, 5.0].contains(mean)), "{means:?}");
        assert!(at_vertices(&panel, &[None, None]).iter().all(|mean| mean.is_nan()));
        let flat = strains(&panel, &garment, |_| Vec2::Y)[0].unwrap().0;
        assert!((flat.warp - 1.0).abs() < 1e-5 && flat.turn < 1e-3, "{flat:?}");
    }
}

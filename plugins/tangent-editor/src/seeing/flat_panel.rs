//! A panel laid flat, and what is known of it there.

use amc_core::mesh::Garment;
use glam::{Affine2, Mat2, Vec2, Vec3};

/// A panel's triangles on the cloth laid flat: metres, as the UVs draw them, v up.
#[derive(Debug, Clone)]
pub(super) struct FlatPanel {
    /// From UVs to metres.
    pub(super) uv_to_flat: Affine2,
    /// Whether the UVs draw it from its back.
    pub(super) is_mirrored: bool,
    /// The garment's vertices that it uses, rising.
    pub(super) vertices: Vec<u32>,
    /// Where each lies.
    pub(super) places: Vec<Vec2>,
    /// By [`FlatPanel::vertices`].
    pub(super) triangles: Vec<[u32; 3]>,
    /// The corners of its box.
    pub(super) low: Vec2,
    /// See [`FlatPanel::low`].
    pub(super) high: Vec2,
}

impl FlatPanel {
    /// Of the panel of this number; none where it has no flat pattern.
    pub(super) fn new(garment: &Garment, panel: usize) -> Option<Self> {
        let panel = garment.panels.get(panel)?;
        let is_mirrored = panel.flags.mirrored;
        // The front up is not as a mirrored pattern is drawn.
        let drawn = if is_mirrored { Mat2::from_diagonal(Vec2::new(-1.0, 1.0)) } else { Mat2::IDENTITY };
        let uv_to_flat = Affine2::from_mat2(drawn) * garment.uv_to_metres(panel)?;
        let triangles =
            garment.triangles.get(panel.triangles.start as usize..panel.triangles.end as usize)?;
        let mut vertices = triangles.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let local = |vertex: &u32| vertices.binary_search(vertex).unwrap_or_default() as u32;
        let triangles: Vec<[u32; 3]> =
            triangles.iter().map(|corners| corners.each_ref().map(local)).collect();
        let places: Vec<Vec2> = vertices
            .iter()
            .map(|&vertex| uv_to_flat.transform_point2(garment.uvs[vertex as usize]))
            .collect();
        let low = places.iter().copied().reduce(Vec2::min)?;
        let high = places.iter().copied().reduce(Vec2::max)?;
        (low.is_finite() && high.is_finite()).then_some(Self {
            uv_to_flat,
            is_mirrored,
            vertices,
            places,
            triangles,
            low,
            high,
        })
    }

    /// How large its box is, metres.
    pub(super) fn size(&self) -> Vec2 {
        self.high - self.low
    }

    /// Where a triangle's corners lie.
    pub(super) fn corners(&self, triangle: [u32; 3]) -> [Vec2; 3] {
        triangle.map(|vertex| self.places[vertex as usize])
    }

    /// Where they are on the garment.
    pub(super) fn positions(&self, garment: &Garment, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|vertex| garment.positions[self.vertices[vertex as usize] as usize])
    }

    /// The directions of a garment's vertices (object space) taken back to the flat pattern: a unit vector for each of
    /// [`FlatPanel::vertices`], zero where there is none.
    ///
    /// Within a triangle the map to the surface is linear, so that of a vector is its inverse on the part in the triangle's plane. A
    /// vertex has the mean over its triangles, by their areas.
    pub(super) fn taken_back(&self, garment: &Garment, vectors: &[Vec3]) -> Vec<Vec2> {
        let mut sums = vec![Vec2::ZERO; self.places.len()];
        for &triangle in &self.triangles {
            let ([a, b, c], [p, q, r]) = (self.corners(triangle), self.positions(garment, triangle));
            let (flat, edges) = ([b - a, c - a], [q - p, r - p]);
            let products = Mat2::from_cols(
                Vec2::new(edges[0].dot(edges[0]), edges[0].dot(edges[1])),
                Vec2::new(edges[0].dot(edges[1]), edges[1].dot(edges[1])),
            );
            let area = products.determinant().max(0.0).sqrt();
            let back = Mat2::from_cols(flat[0], flat[1]) * products.inverse();
            if !(area > 0.0 && back.is_finite()) {
                continue;
            }
            for vertex in triangle {
                let Some(&vector) = vectors.get(self.vertices[vertex as usize] as usize) else { continue };
                let taken = back * Vec2::new(edges[0].dot(vector), edges[1].dot(vector));
                sums[vertex as usize] += taken.normalize_or_zero() * area;
            }
        }
        sums.into_iter().map(Vec2::normalize_or_zero).collect()
    }
}

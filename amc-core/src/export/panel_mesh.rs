//! One panel with vertices of its own, as all formats want it.

use glam::{Vec2, Vec3};

use crate::mesh::{Garment, Panel};

/// A panel's part of a garment.
#[derive(Debug)]
pub(super) struct PanelMesh<'a> {
    pub(super) panel: &'a Panel,
    /// Corners, into the vectors below.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Which of the garment's vertices each is; ascending, so that they keep their order.
    pub(super) vertices: Vec<u32>,
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    /// As drawn, v up; none where there are none.
    pub(super) uvs: Option<Vec<Vec2>>,
}

impl<'a> PanelMesh<'a> {
    /// The panels of a garment that is [checked](super::check), each with its index; those without triangles are left
    /// out, for glTF has no empty primitives.
    pub(super) fn all(garment: &'a Garment) -> impl Iterator<Item = (usize, Self)> {
        let meshes =
            garment.panels.iter().enumerate().map(|(index, panel)| (index, Self::new(garment, panel)));
        meshes.filter(|(_, mesh)| !mesh.triangles.is_empty())
    }

    fn new(garment: &Garment, panel: &'a Panel) -> Self {
        let range = panel.triangles.start as usize..panel.triangles.end as usize;
        let old = garment.triangles.get(range).unwrap_or_default();
        let mut vertices = old.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let place = |vertex: u32| vertices.partition_point(|&other| other < vertex) as u32;
        let triangles = old.iter().map(|corners| corners.map(place)).collect();
        let uvs = || vertices.iter().map(|&vertex| garment.uvs[vertex as usize]).collect();
        Self {
            panel,
            triangles,
            positions: vertices.iter().map(|&vertex| garment.positions[vertex as usize]).collect(),
            normals: vertices.iter().map(|&vertex| garment.normals[vertex as usize]).collect(),
            uvs: garment.has_uvs.then(uvs),
            vertices,
        }
    }
}

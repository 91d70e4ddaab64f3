//! Flat sheets to look at.

use amc_core::mesh::{Garment, Mesh, Part};
use glam::{Vec2, Vec3};

use super::*;

/// A square of `count` x `count` vertices whose UVs are metres from -1/2 to 1/2, put on a surface.
pub(super) fn sheet(count: u32, surface: impl Fn(Vec2) -> Vec3) -> (Garment, FlatPanel) {
    let flat: Vec<Vec2> = (0..count * count)
        .map(|k| Vec2::new((k % count) as f32, (k / count) as f32) / (count - 1) as f32 - 0.5)
        .collect();
    let cells = (0..(count - 1) * (count - 1)).map(|k| k % (count - 1) + k / (count - 1) * count);
    let triangles: Vec<[u32; 3]> =
        cells.flat_map(|a| [[a, a + 1, a + count + 1], [a, a + count + 1, a + count]]).collect();
    let mesh = Mesh {
        positions: flat.iter().map(|&at| surface(at)).collect(),
        normals: vec![Vec3::Z; flat.len()],
        uvs: Some(flat),
        triangle_parts: vec![0; triangles.len()],
        triangles,
        parts: vec![Part { name: "sheet".into(), takes_fabric: true, pattern: Default::default() }],
        ..Mesh::default()
    };
    let mut garment = Garment::new(mesh).unwrap();
    garment.panels[0].pattern.uv_unit = Some(1.0);
    let panel = FlatPanel::new(&garment, 0).unwrap();
    (garment, panel)
}

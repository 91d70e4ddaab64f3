//! Garments of any number of triangles and panels, for benchmarks.

use std::f32::consts::TAU;

use amc_core::mesh::{Garment, Panel};
use glam::{Vec2, Vec3};

/// A binary glTF of so many primitives, each of so many waving sheets, side by side in the UV map; each sheet has `2 side^2`
/// triangles.
pub fn glb(primitives: usize, islands: usize, side: usize) -> Vec<u8> {
    let (mut bin, mut views, mut accessors, mut parts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for part in 0..primitives {
        let (mut positions, mut normals, mut uvs, mut indices) = (vec![], vec![], vec![], vec![]);
        for island in 0..islands {
            let base = (positions.len() / 3) as u32;
            for j in 0..=side {
                for i in 0..=side {
                    let (x, y) = (i as f32 / side as f32, j as f32 / side as f32);
                    let (slope, height) = (0.5 * (5.0 * x + 3.0 * y).cos(), 0.1 * (5.0 * x + 3.0 * y).sin());
                    let length = (1.0 + 1.36 * slope * slope).sqrt();
                    positions.extend([x + part as f32, y, height + island as f32]);
                    normals.extend([-slope / length, -0.6 * slope / length, 1.0 / length]);
                    uvs.extend([(x * 0.9 + island as f32) / islands as f32, y]);
                }
            }
            let row = side as u32 + 1;
            for j in 0..side as u32 {
                for i in 0..side as u32 {
                    let a = base + j * row + i;
                    indices.extend([a, a + 1, a + row + 1, a, a + row + 1, a + row]);
                }
            }
        }
        let count = positions.len() / 3;
        let first = accessors.len();
        for (floats, kind, width) in [(&positions, "VEC3", 3), (&normals, "VEC3", 3), (&uvs, "VEC2", 2)] {
            views.push(
                serde_json::json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": floats.len() * 4}),
            );
            let mut accessor = serde_json::json!({"bufferView": views.len() - 1, "componentType": 5126, "count": count, "type": kind});
            if accessors.len() == first {
                accessor["min"] = serde_json::json!(vec![-100.0; width]);
                accessor["max"] = serde_json::json!(vec![100.0; width]);
            }
            accessors.push(accessor);
            bin.extend(floats.iter().flat_map(|x| x.to_le_bytes()));
        }
        views
            .push(serde_json::json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": indices.len() * 4}));
        accessors.push(serde_json::json!(
            {"bufferView": views.len() - 1, "componentType": 5125, "count": indices.len(), "type": "SCALAR"}
        ));
        bin.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
        parts.push(serde_json::json!({
            "attributes": {"POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2}, "indices": first + 3
        }));
    }
    let json = serde_json::json!({
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": bin.len()}],
        "bufferViews": views,
        "accessors": accessors,
        "meshes": [{"primitives": parts}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0
    });
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let words = [0x4654_6c67, 2, 12 + 8 + json.len() + 8 + bin.len(), json.len(), 0x4e4f_534a];
    let mut glb: Vec<u8> = words.iter().flat_map(|&word| (word as u32).to_le_bytes()).collect();
    glb.extend(json);
    glb.extend([bin.len(), 0x004e_4942].iter().flat_map(|&word| (word as u32).to_le_bytes()));
    glb.extend(bin);
    glb
}

/// So many waving panels side by side, of 2 x `cells`^2 triangles each, their UVs sheared a little.
pub fn waving_panels(panels: u32, cells: u32) -> Garment {
    let mut garment = Garment { has_uvs: true, ..Garment::default() };
    for panel in 0..panels {
        let (first, start) = (garment.positions.len() as u32, garment.triangles.len() as u32);
        for row in 0..=cells {
            for column in 0..=cells {
                let p = Vec2::new(column as f32, row as f32) / cells as f32;
                let (sin, cos) = (p.x * TAU * 3.0 + p.y + panel as f32).sin_cos();
                let slope = Vec2::new(TAU * 3.0, 1.0) * (0.05 * cos);
                garment.positions.push(Vec3::new(p.x + panel as f32 * 1.1, p.y, 0.05 * sin));
                garment.normals.push((-slope).extend(1.0).normalize_or(Vec3::Z));
                garment.uvs.push(Vec2::new(p.x + 0.1 * p.y * p.y, p.y));
                if row < cells && column < cells {
                    let k = first + row * (cells + 1) + column;
                    let above = k + cells + 1;
                    garment.triangles.extend([[k, k + 1, above + 1], [k, above + 1, above]]);
                }
            }
        }
        garment.panels.push(Panel {
            id: panel.to_string(),
            name: panel.to_string(),
            triangles: start..garment.triangles.len() as u32,
            takes_fabric: true,
            area: 1.0,
            flags: Default::default(),
            pattern: Default::default(),
        });
    }
    garment
}

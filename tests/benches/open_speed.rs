//! How long it takes to open a 500,000-triangle GLB as a checked mesh with panels, against the crate `gltf`: its
//! `import` and its readers collecting positions, normals, UVs and indices. Both in one run, taking turns.
//!
//! Prints the median times and their ratio; ends with 1 where the ratio is over 2.0.

use std::path::Path;
use std::process::ExitCode;

use amc_core::mesh::{Garment, Unit};
use studio_tests::timing::{is_wanted, median, milliseconds, timed};

const LIMIT: f64 = 2.0;
const ROUNDS: usize = 21;
/// Primitives, and islands in each.
const PRIMITIVES: usize = 6;
const ISLANDS: usize = 8;
/// Squares along a side of an island: 2 x 6 x 8 x 72 x 72 = 497,664 triangles.
const SIDE: usize = 72;

fn main() -> ExitCode {
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("garment.glb");
    amc_core::file::save_bytes(&path, &garment()).expect("the file is written");
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        theirs.push(timed(|| import(&path)));
        ours.push(timed(|| open(&path)));
    }
    let (ours, theirs) = (median(ours), median(theirs));
    let ratio = ours.as_secs_f64() / theirs.as_secs_f64();
    #[expect(clippy::print_stdout, reason = "a benchmark's figures are its output")]
    {
        println!(
            "open {:.1} ms, gltf import and readers {:.1} ms: ratio {ratio:.2}, limit {LIMIT}",
            milliseconds(ours),
            milliseconds(theirs)
        );
    }
    ExitCode::from(u8::from(ratio > LIMIT))
}

fn open(path: &Path) -> Garment {
    let mesh = amc_core::mesh::read(path, Unit::Metre).expect("the file is valid");
    let garment = Garment::new(mesh).expect("the mesh is valid");
    assert_eq!(garment.panels.len(), PRIMITIVES * ISLANDS);
    garment
}

/// Positions, normals, UVs and indices of a primitive.
type Arrays = (Vec<[f32; 3]>, Vec<[f32; 3]>, Vec<[f32; 2]>, Vec<u32>);

fn import(path: &Path) -> Vec<Arrays> {
    let (document, buffers, _) = gltf::import(path).expect("the file is valid");
    let read = |primitive: gltf::Primitive<'_>| {
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| data.0.as_slice()));
        let positions = reader.read_positions().expect("positions").collect();
        let normals = reader.read_normals().expect("normals").collect();
        let uvs = reader.read_tex_coords(0).expect("UVs").into_f32().collect();
        let indices = reader.read_indices().expect("indices").into_u32().collect();
        (positions, normals, uvs, indices)
    };
    document.meshes().flat_map(|mesh| mesh.primitives().map(read).collect::<Vec<_>>()).collect()
}

/// Waving sheets, side by side in the UV map.
fn garment() -> Vec<u8> {
    let (mut bin, mut views, mut accessors, mut primitives) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for part in 0..PRIMITIVES {
        let (mut positions, mut normals, mut uvs, mut indices) = (vec![], vec![], vec![], vec![]);
        for island in 0..ISLANDS {
            let base = (positions.len() / 3) as u32;
            for j in 0..=SIDE {
                for i in 0..=SIDE {
                    let (x, y) = (i as f32 / SIDE as f32, j as f32 / SIDE as f32);
                    let (slope, height) = (0.5 * (5.0 * x + 3.0 * y).cos(), 0.1 * (5.0 * x + 3.0 * y).sin());
                    let length = (1.0 + 1.36 * slope * slope).sqrt();
                    positions.extend([x + part as f32, y, height + island as f32]);
                    normals.extend([-slope / length, -0.6 * slope / length, 1.0 / length]);
                    uvs.extend([(x * 0.9 + island as f32) / ISLANDS as f32, y]);
                }
            }
            let row = SIDE as u32 + 1;
            for j in 0..SIDE as u32 {
                for i in 0..SIDE as u32 {
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
        primitives.push(serde_json::json!({
            "attributes": {"POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2}, "indices": first + 3
        }));
    }
    let json = serde_json::json!({
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": bin.len()}],
        "bufferViews": views,
        "accessors": accessors,
        "meshes": [{"primitives": primitives}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0
    });
    let glb = gltf::Glb {
        header: gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 },
        json: json.to_string().into_bytes().into(),
        bin: Some(bin.into()),
    };
    glb.to_vec().expect("memory takes it")
}

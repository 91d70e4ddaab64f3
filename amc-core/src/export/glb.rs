//! Directions as the tangents of a glTF 2.0 binary.

use std::io::Write;

use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use super::{GENERATOR, Piece};
use crate::{Error, Result};

/// `componentType` of 32-bit floats and unsigned integers, `target` of vertices and indices.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The buffer, and what the document says of it.
#[derive(Default)]
struct Builder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Builder {
    /// Appends numbers of four bytes each as a view and an accessor of their own; returns the accessor's index.
    fn add<T: bytemuck::Pod>(&mut self, numbers: &[T], component: u32, kind: &str) -> usize {
        let bytes: &[u8] = bytemuck::cast_slice(numbers);
        let target = if component == UNSIGNED_INT { ELEMENT_ARRAY_BUFFER } else { ARRAY_BUFFER };
        self.accessors.push(json!({
            "bufferView": self.views.len(), "componentType": component, "type": kind, "count": numbers.len()
        }));
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(), "target": target
        }));
        self.bytes.extend_from_slice(bytes);
        self.accessors.len() - 1
    }

    /// [`Builder::add`], with the least and largest of each component, which positions must have.
    fn add_positions(&mut self, positions: &[Vec3]) -> usize {
        let index = self.add(positions, FLOAT, "VEC3");
        let least = positions.iter().copied().reduce(Vec3::min).unwrap_or_default();
        let largest = positions.iter().copied().reduce(Vec3::max).unwrap_or_default();
        self.accessors[index]["min"] = json!(least.as_dvec3().to_array());
        self.accessors[index]["max"] = json!(largest.as_dvec3().to_array());
        index
    }

    fn add_primitive(&mut self, piece: &Piece<'_>) -> Value {
        let mut attributes = json!({
            "POSITION": self.add_positions(&piece.positions),
            "NORMAL": self.add(&piece.normals, FLOAT, "VEC3"),
            "TANGENT": self.add(&piece.tangents, FLOAT, "VEC4"),
        });
        for (name, uvs) in [("TEXCOORD_0", piece.turned_uvs()), ("TEXCOORD_1", piece.uvs.clone())] {
            if let Some(mut uvs) = uvs {
                uvs.iter_mut().for_each(|uv| *uv = Vec2::new(uv.x, 1.0 - uv.y));
                attributes[name] = json!(self.add(&uvs, FLOAT, "VEC2"));
            }
        }
        json!({
            "attributes": attributes,
            "indices": self.add(piece.triangles.as_flattened(), UNSIGNED_INT, "SCALAR"),
            "material": 0,
            "extras": {
                "id": piece.panel.id,
                "name": piece.panel.name,
                "source": piece.direction.source,
                "angle_deg": piece.angle_deg(),
                "takes_fabric": piece.panel.takes_fabric,
            },
        })
    }
}

pub(super) fn write(pieces: &[Piece<'_>], out: &mut dyn Write) -> Result<()> {
    if pieces.is_empty() {
        return Err(Error::invalid("there is no triangle to export"));
    }
    // Before a buffer is made that could not be written: 56 bytes a vertex, 12 a triangle.
    let size: u64 =
        pieces.iter().map(|p| 56 * p.positions.len() as u64 + 12 * p.triangles.len() as u64).sum();
    let too_large = || Error::too_large("a GLB holds at most 4 GiB: export .obj or .json");
    if size > u64::from(u32::MAX) {
        return Err(too_large());
    }
    let mut builder = Builder::default();
    let meshes: Vec<Value> = pieces
        .iter()
        .map(|piece| json!({"name": piece.panel.name, "primitives": [builder.add_primitive(piece)]}))
        .collect();
    let nodes: Vec<Value> = (pieces.iter().enumerate())
        .map(|(mesh, piece)| json!({"name": piece.panel.name, "mesh": mesh}))
        .collect();
    let document = json!({
        "asset": {"version": "2.0", "generator": GENERATOR},
        "scene": 0,
        "scenes": [{"nodes": (0..nodes.len()).collect::<Vec<_>>()}],
        "nodes": nodes,
        "meshes": meshes,
        // Cloth is seen from both sides.
        "materials": [{"name": "cloth", "doubleSided": true}],
        "accessors": builder.accessors,
        "bufferViews": builder.views,
        "buffers": [{"byteLength": builder.bytes.len()}],
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    // Every number has four bytes, so the binary part is aligned as it is.
    let length = |bytes: usize| u32::try_from(bytes).map_err(|_| too_large());
    let header: [&[u8]; 7] = [
        b"glTF",
        &2u32.to_le_bytes(),
        &length(12 + 8 + text.len() + 8 + builder.bytes.len())?.to_le_bytes(),
        &length(text.len())?.to_le_bytes(),
        b"JSON",
        &text,
        &length(builder.bytes.len())?.to_le_bytes(),
    ];
    for bytes in header.into_iter().chain([&b"BIN\0"[..], &builder.bytes]) {
        out.write_all(bytes).map_err(|source| Error::io("cannot write", source))?;
    }
    Ok(())
}

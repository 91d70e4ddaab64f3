//! A glTF 2.0 binary of one mesh and one node per panel.

use std::collections::BTreeSet;
use std::io::Write;

use bytemuck::Pod;
use glam::{Vec2, Vec3};
use serde_json::{Map, Value, json};

use super::{GENERATOR, PanelMesh};
use crate::{Error, Result};

/// `componentType` of floats and unsigned integers, `target` of vertices and indices.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The buffer, and what the document says of it.
#[derive(Debug, Default)]
pub(super) struct Glb {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    /// The view of each picture; there is one texture for each.
    pictures: Vec<usize>,
}

/// What a panel has beyond positions and normals.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    accessors: Map<String, Value>,
}

impl Glb {
    /// Appends floats, `kind` of them (`VEC4`) a vertex, for the attribute `name`.
    pub(super) fn add<T: Pod>(&mut self, to: &mut Attributes, name: &str, kind: &str, vectors: &[T]) {
        let accessor = self.accessor(vectors, FLOAT, kind, ARRAY_BUFFER);
        to.accessors.insert(name.to_owned(), json!(accessor));
    }

    /// Appends UVs, given with v up, with v down as glTF has it.
    pub(super) fn add_uvs(&mut self, to: &mut Attributes, name: &str, mut uvs: Vec<Vec2>) {
        uvs.iter_mut().for_each(|uv| *uv = Vec2::new(uv.x, 1.0 - uv.y));
        self.add(to, name, "VEC2", &uvs);
    }

    /// Appends a material, unless the same is there already; returns its index.
    pub(super) fn add_material(&mut self, material: Value) -> usize {
        let known = self.materials.iter().position(|other| *other == material);
        known.unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        })
    }

    /// Appends a PNG file as a texture; returns its index.
    pub(super) fn add_texture(&mut self, png: &[u8]) -> usize {
        let view = self.view(png, None);
        self.pictures.push(view);
        self.pictures.len() - 1
    }

    /// Appends a panel as a mesh of one primitive.
    pub(super) fn add_panel(
        &mut self,
        mesh: &PanelMesh<'_>,
        attributes: Attributes,
        material: usize,
        extras: Value,
    ) {
        let mut all = json!({ "POSITION": self.positions(&mesh.positions) });
        let normals = self.accessor(&mesh.normals, FLOAT, "VEC3", ARRAY_BUFFER);
        all["NORMAL"] = json!(normals);
        for (name, accessor) in attributes.accessors {
            all[name] = accessor;
        }
        let indices = self.indices(mesh.triangles.as_flattened(), mesh.positions.len());
        self.meshes.push(json!({
            "name": mesh.panel.name,
            "primitives": [{ "attributes": all, "indices": indices, "material": material, "extras": extras }],
        }));
    }

    /// Appends items as a view and an accessor of their own; returns the accessor's index.
    fn accessor<T: Pod>(&mut self, items: &[T], component: u32, kind: &str, target: u32) -> usize {
        let view = self.view(bytemuck::cast_slice(items), Some(target));
        self.accessors.push(json!({
            "bufferView": view, "componentType": component, "type": kind, "count": items.len()
        }));
        self.accessors.len() - 1
    }

    /// Appends bytes as a view; returns its index.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.bytes.extend_from_slice(bytes);
        // A view of floats begins at a multiple of four bytes.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    /// Positions have their accessor say the least and largest of each component.
    fn positions(&mut self, positions: &[Vec3]) -> usize {
        let index = self.accessor(positions, FLOAT, "VEC3", ARRAY_BUFFER);
        let least = positions.iter().copied().reduce(Vec3::min).unwrap_or_default();
        let largest = positions.iter().copied().reduce(Vec3::max).unwrap_or_default();
        self.accessors[index]["min"] = json!(least.as_dvec3().to_array());
        self.accessors[index]["max"] = json!(largest.as_dvec3().to_array());
        index
    }

    /// Indices in 16 bits where they fit; the largest number of 16 bits is no index in glTF.
    fn indices(&mut self, corners: &[u32], vertices: usize) -> usize {
        if vertices <= usize::from(u16::MAX) {
            let short: Vec<u16> = corners.iter().map(|&corner| corner as u16).collect();
            self.accessor(&short, UNSIGNED_SHORT, "SCALAR", ELEMENT_ARRAY_BUFFER)
        } else {
            self.accessor(corners, UNSIGNED_INT, "SCALAR", ELEMENT_ARRAY_BUFFER)
        }
    }

    /// The names of the extensions that materials have.
    fn extensions(&self) -> BTreeSet<&str> {
        let all = self.materials.iter().filter_map(|material| material["extensions"].as_object());
        all.flat_map(|extensions| extensions.keys().map(String::as_str)).collect()
    }

    /// Writes the file.
    ///
    /// # Errors
    /// No panel, more than a GLB can hold, or `out` refuses.
    pub(super) fn write(self, out: &mut dyn Write) -> Result<()> {
        if self.meshes.is_empty() {
            return Err(Error::invalid("there is no triangle to export"));
        }
        let nodes: Vec<Value> = (self.meshes.iter().enumerate())
            .map(|(index, mesh)| json!({"name": mesh["name"], "mesh": index}))
            .collect();
        let mut document = json!({
            "asset": {"version": "2.0", "generator": GENERATOR},
            "scene": 0,
            "scenes": [{"nodes": (0..nodes.len()).collect::<Vec<_>>()}],
            "nodes": nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": self.bytes.len()}],
        });
        // glTF has no empty lists.
        if !self.pictures.is_empty() {
            let pictures = self.pictures.iter();
            document["images"] =
                pictures.map(|view| json!({ "bufferView": view, "mimeType": "image/png" })).collect();
            document["textures"] =
                (0..self.pictures.len()).map(|source| json!({ "source": source })).collect();
        }
        let extensions = self.extensions();
        if !extensions.is_empty() {
            document["extensionsUsed"] = json!(extensions);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = |bytes: usize| u32::try_from(bytes).map_err(|_| too_large());
        let header: [&[u8]; 7] = [
            b"glTF",
            &2u32.to_le_bytes(),
            &length(12 + 8 + text.len() + 8 + self.bytes.len())?.to_le_bytes(),
            &length(text.len())?.to_le_bytes(),
            b"JSON",
            &text,
            &length(self.bytes.len())?.to_le_bytes(),
        ];
        for bytes in header.into_iter().chain([&b"BIN\0"[..], &self.bytes]) {
            out.write_all(bytes).map_err(|source| Error::io("cannot write", source))?;
        }
        Ok(())
    }
}

/// A material without any property of its own. Cloth is seen from both sides.
pub(super) fn plain_material(name: &str) -> Value {
    json!({ "name": name, "doubleSided": true })
}

/// Refuses meshes that cannot be written, before a buffer is made of them.
///
/// # Errors
/// More than a GLB can hold, at `per_vertex` bytes a vertex.
pub(super) fn check_size<'a>(
    meshes: impl Iterator<Item = &'a PanelMesh<'a>>,
    per_vertex: usize,
) -> Result<()> {
    let size: u64 =
        meshes.map(|mesh| (per_vertex * mesh.positions.len() + 12 * mesh.triangles.len()) as u64).sum();
    if size > u64::from(u32::MAX) { Err(too_large()) } else { Ok(()) }
}

fn too_large() -> Error {
    Error::too_large("a GLB holds at most 4 GiB: export another format")
}

//! glTF 2.0, as `.gltf` and as `.glb`.
//!
//! The crate `gltf` reads and validates the JSON; the container, the buffers and the accessors are read here, with
//! every offset and count checked first (the crate's own readers trust them). A part is a primitive in a node.
//! Triangles, strips and fans are read, sparse and quantised accessors (KHR_mesh_quantization) too; points and lines,
//! skins, morph targets and animations are left out. Texture v runs down in glTF and is turned up.
//!
//! # What `extras` may say
//!
//! The primitive, its material, its mesh or its node may have an object `amc` in its `extras`. Of each key the first of
//! these four counts that has it. All keys may be missing, others are passed over, and extras that cannot be read become
//! a notice.
//!
//! ```json
//! {"amc": {
//!     "version": 1,
//!     "name": "Left sleeve",
//!     "fabric": true,
//!     "uv_unit_m": 1.0,
//!     "grain_deg": 90.0,
//!     "mirror": "Right sleeve",
//!     "seams": [
//!         {"name": "left underarm", "edge": [[0.1, 0.0], [0.15, 0.45]],
//!          "partner": "Left sleeve", "partner_edge": [[0.5, 0.0], [0.45, 0.45]]}
//!     ]
//! }}
//! ```
//!
//! - `version`: 1, which is also what a missing one means. Extras of another version are passed over.
//! - `name`: the panel's name, in place of the node's or mesh's.
//! - `fabric`: whether it takes a fabric (see [`Part::takes_fabric`](super::Part::takes_fabric)).
//! - `uv_unit_m`: metres that 1 in the UVs stands for.
//! - `grain_deg`: the warp's direction in the flat pattern, degrees counter-clockwise from +u, seen with v up.
//! - `mirror`: the name of the panel that is its mirror image.
//! - `seams`: where it is sewn: see [`Seam`](super::Seam). Points are u and v with v up, which is 1 - V of `TEXCOORD_0`.
//!
//! [`crate::export::garment`] writes them.

mod accessor;
mod anisotropic_material;
mod anisotropy;
mod container;
mod extras_reader;
mod primitive;
mod scene;
#[cfg(test)]
mod tests;

pub use anisotropy::{Anisotropy, anisotropy};

use super::draft::Draft;
use super::{Mesh, Resolve, check};
use crate::{Error, Result};
use container::Buffers;
use extras_reader::ExtrasReader;

/// Reads a glTF or GLB file; its numbers are taken for metres. `resolve` gives the content of a file beside it that
/// it names (relative, percent-decoded).
///
/// # Errors
/// Bytes that are not glTF 2.0, an extension that is required and not known, an accessor out of its buffer, an index
/// out of range, a number that is not finite (naming mesh and primitive), or no triangle that has an area.
pub fn parse(bytes: &[u8], resolve: Resolve<'_>) -> Result<Mesh> {
    let (json, chunk) = container::split(bytes)?;
    let document = container::document(json)?;
    let buffers = Buffers::read(&document, chunk, resolve)?;
    let mut draft = Draft::default();
    let mut left_out = 0;
    // An instance costs a few bytes of JSON and a whole mesh of memory.
    let budget = bytes.len() + buffers.bytes() + (1 << 20);
    let instances = scene::instances(&document)?;
    let mut extras = ExtrasReader::new(budget);
    primitive::reserve(&mut draft, &instances, budget);
    for instance in &instances {
        for primitive in instance.mesh.primitives() {
            let place = format!("mesh {}, primitive {}", instance.mesh.index(), primitive.index());
            let read = primitive::append(&mut draft, &primitive, instance, &buffers, &mut extras);
            left_out += usize::from(!read.map_err(|error| error.at_element(place.clone()))?);
            if draft.positions.len().max(draft.triangles.len()) > budget {
                return Err(Error::too_large("more copies of meshes than the file's size justifies")
                    .at_element(place));
            }
        }
    }
    if left_out > 0 {
        draft.notices.push(format!("{left_out} primitives of points or lines were left out"));
    }
    if document.skins().len() > 0 {
        draft.notices.push("skins were left out: the mesh stands as it was bound".to_owned());
    }
    draft.notices.extend(extras.notice());
    primitive::tell_apart(&mut draft);
    check::check(draft)
}

//! Garments as triangles: reading, checking, panels.
//!
//! A [`Mesh`] is what a file or a shape gives; [`Garment`] is that mesh cut into panels, ready for directions and drawing.
//! Reading: [`read()`], or [`obj::parse`] and [`gltf::parse`] on bytes in memory. A reader fills a draft, one
//! common check makes a [`Mesh`] of it. Panels: islands of the UV map, their vertices parted, their figures measured;
//! an [`Arrangement`] merges, splits and renames them.

mod arrangement;
mod check;
mod cloth_normals;
mod distortion;
mod draft;
pub(crate) mod extras;
mod fabric_words;
mod flat;
mod flat_locator;
mod fold;
pub(crate) mod forest;
pub mod gltf;
mod identity;
mod islands;
mod lanes;
mod measure;
#[cfg(test)]
mod mutations;
mod normals;
pub mod obj;
mod outline;
mod panel;
mod pattern_piece;
mod pick;
pub(crate) mod ray_tree;
mod read;
mod sections;
mod split;
mod triangulate;
mod unit;
pub(crate) mod weld;

pub use arrangement::{Arrangement, Rearrangement};
pub use cloth_normals::cloth_normals;
pub use distortion::{Distortion, Percentiles};
pub use flat_locator::{FlatLocator, SurfacePlace};
pub(crate) use measure::uv_area;
pub use panel::{Garment, Panel, PanelFlags};
pub use pattern_piece::{PatternPiece, Seam};
pub use pick::{Hit, Picker};
pub use read::{FILE_LIMIT, Resolve, read, read_anisotropy, suffixes};
pub use unit::Unit;

use glam::{Vec2, Vec3};

/// Most characters of a name that are kept.
const NAME_LIMIT: usize = 120;

/// Triangles with normals and, where the file has them, UVs. Checked: every index is in range, every number finite,
/// every normal a unit vector, no triangle uses a vertex twice or is without area.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// In metres, object space, Y up.
    pub positions: Vec<Vec3>,
    /// Unit vectors, one per position.
    pub normals: Vec<Vec3>,
    /// One per position, v up; none where the file has none, zeros in parts that have none.
    pub uvs: Option<Vec<Vec2>>,
    /// Corners, counter-clockwise as seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Which part each triangle belongs to: index into `parts`.
    pub triangle_parts: Vec<u32>,
    /// OBJ groups and materials, or glTF primitives.
    pub parts: Vec<Part>,
    /// Vertices as the file counts them (OBJ: `v` lines; glTF: positions of the primitives).
    pub file_vertices: usize,
    /// Things a person should know: normals made up, triangles dropped, UVs missing.
    pub notices: Vec<String>,
}

/// A named part of a mesh file: panels never reach across parts.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Part {
    /// Its name in the file, or one made up.
    pub name: String,
    /// Whether it takes a fabric; what does not is drawn in plain grey.
    ///
    /// A part takes none where one of its names in the file (OBJ object, group, material; glTF node, mesh, material)
    /// ends in a word for a body, hair, eyes, shoes, buttons, zippers or the like: "shirt buttons", "Body", but not
    /// "body suit". In glTF, `extras` may decide instead (see [`gltf`]). Where every part would take none, all of them do.
    pub takes_fabric: bool,
    /// What a sewing pattern says of it; partners are names of parts. Checked when the mesh is cut into panels.
    pub pattern: PatternPiece<String>,
}

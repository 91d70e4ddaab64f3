//! Garments as triangles: reading, checking, panels.
//!
//! A [`Mesh`] is what a file or a shape gives; [`Garment`] is that mesh cut into panels, ready for directions and drawing.

mod panel;

pub use panel::{Garment, Panel, PanelFlags, Percentiles};

use glam::{Vec2, Vec3};

/// Triangles with normals and, where the file has them, UVs. Checked: every index is in range, every number finite,
/// every normal a unit vector, no triangle uses a vertex twice.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// In metres, object space, Y up.
    pub positions: Vec<Vec3>,
    /// Unit vectors, one per position.
    pub normals: Vec<Vec3>,
    /// One per position, v up; none where the file has none.
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
    /// Whether it takes a fabric; a body or buttons do not, and are drawn in plain grey. A glTF primitive or OBJ
    /// group says so by its name (see the readers).
    pub takes_fabric: bool,
}

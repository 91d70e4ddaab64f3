//! Panels: the pieces a garment is sewn from, found as UV islands.

use glam::{Vec2, Vec3};

/// A mesh cut into panels. Every vertex belongs to one panel and one UV orientation, so that means over a vertex's
/// triangles never cross a seam or a fold of the UV map.
#[derive(Debug, Clone, Default)]
pub struct Garment {
    /// In metres, object space, Y up.
    pub positions: Vec<Vec3>,
    /// Unit vectors.
    pub normals: Vec<Vec3>,
    /// One per position, v up; zeros where the file has none.
    pub uvs: Vec<Vec2>,
    /// Whether the UVs are from the file.
    pub has_uvs: bool,
    /// Corners, counter-clockwise as seen from the front; the triangles of a panel stand together, in the order of `panels`.
    pub triangles: Vec<[u32; 3]>,
    /// The panels.
    pub panels: Vec<Panel>,
    /// Vertices as the file counts them.
    pub file_vertices: usize,
    /// Things a person should know.
    pub notices: Vec<String>,
}

/// One piece of cloth.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Stable: the same file gives the same ids, and so does the file saved again with vertices in another order.
    pub id: String,
    /// What people call it: the part's name, numbered where a part has several islands.
    pub name: String,
    /// Its triangles: a range of [`Garment::triangles`].
    pub triangles: std::ops::Range<u32>,
    /// Whether it takes a fabric (else it is drawn in plain grey).
    pub takes_fabric: bool,
    /// Area in square metres.
    pub area: f32,
    /// What is unusual about its UVs.
    pub flags: PanelFlags,
    /// Larger singular value of the UV-to-surface map over the panel's area-weighted mean scale; by area.
    pub stretch: Percentiles,
    /// Angle between dP/du and dP/dv in radians; by area.
    pub shear: Percentiles,
}

/// What is unusual about a panel's UVs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PanelFlags {
    /// More than half of its area has mirrored UVs.
    pub mirrored: bool,
    /// Some of it has no UVs or UVs without area: directions there are filled from the neighbours.
    pub degenerate: bool,
}

/// Percentiles over a panel's area.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Percentiles {
    /// 5 % of the area lie below.
    pub p5: f32,
    /// Half of the area lies below.
    pub p50: f32,
    /// 95 % of the area lie below.
    pub p95: f32,
}

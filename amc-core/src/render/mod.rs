//! Drawing a garment in its fabrics: one description, two renderers of the same picture.
//!
//! A [`Drawing`] is what is drawn (vertices with directions, panels with fabrics), a [`View`] from where, a
//! [`Shading`] how. `cpu` is the reference in plain Rust; `gpu` (feature of that name) is WGSL through wgpu.
//! [`shade`] holds the shading functions, twins of those in `shaders/`.

mod camera;
pub mod cpu;
mod drawing;
#[cfg(feature = "gpu")]
pub mod gpu;
mod laid_print;
mod print;
pub mod shade;
mod view;

pub use camera::{Bounds, Camera, Orientation};
pub use laid_print::{LaidPrint, Laying};
pub use print::{Level, Print};
pub use view::{Part, Projection, Ray, View};

use std::ops::Range;
use std::sync::Arc;

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::amc::Amc;
use crate::image::Picture;

/// One vertex as both renderers take it, but for its direction.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Vertex {
    /// Object space, metres.
    pub position: Vec3,
    /// Unit, object space.
    pub normal: Vec3,
    /// v up.
    pub uv: Vec2,
    /// Share of the sky that is open on the side of `normal`, and on the other, 0 to 1: that of the side which is seen
    /// multiplies the colour (paper, section 6.1; there of one side).
    pub occlusion: Vec2,
}

/// What a range of triangles is drawn in.
#[derive(Debug, Clone, PartialEq)]
pub enum Cloth {
    /// Index into [`Drawing::fabrics`].
    Fabric(usize),
    /// A fabric with a picture over it, multiplied in.
    Printed(usize, LaidPrint),
    /// No fabric but a picture, lit from the viewer: what shows something of the cloth in place of how it looks.
    Covered(LaidPrint),
    /// No fabric: plain grey, lit from the viewer.
    Plain,
}

impl Cloth {
    /// Its fabric's index into [`Drawing::fabrics`].
    pub fn fabric(&self) -> Option<usize> {
        match self {
            Self::Fabric(fabric) | Self::Printed(fabric, _) => Some(*fabric),
            Self::Covered(_) | Self::Plain => None,
        }
    }

    /// Its picture.
    pub fn print(&self) -> Option<&LaidPrint> {
        match self {
            Self::Printed(_, print) | Self::Covered(print) => Some(print),
            Self::Fabric(_) | Self::Plain => None,
        }
    }
}

/// A range of triangles in one cloth.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// Into [`Drawing::triangles`].
    pub triangles: Range<u32>,
    /// What they are drawn in.
    pub cloth: Cloth,
}

/// Everything that is drawn, whatever the view.
///
/// Drawings of one garment share what does not change with its directions and fabrics; what is shared is uploaded once.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// The vertices.
    pub vertices: Arc<Vec<Vertex>>,
    /// The direction of every vertex: unit, object space, perpendicular to the normal.
    pub tangents: Arc<Vec<Vec3>>,
    /// Corners, counter-clockwise as seen from the front.
    pub triangles: Arc<Vec<[u32; 3]>>,
    /// Which triangles in which cloth, one per panel.
    pub draws: Vec<Draw>,
    /// The fabrics in use.
    pub fabrics: Vec<Arc<Amc>>,
}

/// What the colour of a fragment is.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Mode {
    /// The AMC looked up by normal and tangent azimuth.
    #[default]
    Amc,
    /// The mean over the AMC's slices, an ordinary MatCap (paper, section 5.3).
    Isotropic,
    /// An ordinary MatCap picture of a ball, for every panel that takes a fabric.
    MatCap(Arc<Picture>),
    /// The view-space normal after two-sidedness, as `n/2 + 1/2`, sRGB-encoded values.
    Normals,
    /// The view-space tangent, made perpendicular to the normal, as `t/2 + 1/2`, sRGB-encoded values.
    Tangents,
    /// The UV coordinates' fractional part in red and green, sRGB-encoded values; a checker in blue.
    Uv,
    /// A shader from outside. Only the graphics device draws it.
    Own(OwnMode),
}

/// A shading mode from outside: WGSL that takes the place of a built-in mode's.
///
/// It has the entry points `vertex_main` and `fragment_main` (`#import surface` brings a `vertex_main`), and may import all
/// that `shaders/` holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct OwnMode {
    /// The shader's name: letters, digits, `-` and `_`; none that `shaders/` has.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
    /// Whether it looks up the fabric (`#import table`). Then parts without one stay grey. Prints are not shown.
    pub reads_fabric: bool,
}

/// How the cyclic coordinate of the azimuth gets from vertices to fragments (paper, section 6.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cyclic {
    /// Interpolated as it is: streaks where a triangle crosses the wrap (the paper's figure 9).
    Naive,
    /// Interpolated together with a twin half a turn further on; the one with the smaller derivative is taken.
    #[default]
    Cyclic,
    /// The tangent is interpolated, and its azimuth taken per fragment.
    Fragment,
}

/// How normals and tangents are turned where the line of sight is not the optical axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Perspective {
    /// Not at all.
    Off,
    /// The paper's equation 4, with the position in view space: x and y separately, `n_z` kept.
    Paper,
    /// By the least rotation that takes the line of sight to +z.
    Full,
    /// By the least rotation that takes the half vector of the line of sight and +z to +z: where highlights of distant
    /// lights are.
    #[default]
    Half,
}

/// How a drawing is shaded.
#[derive(Debug, Clone, PartialEq)]
pub struct Shading {
    /// What the colour is.
    pub mode: Mode,
    /// How the azimuth gets to the fragments.
    pub cyclic: Cyclic,
    /// What is done about perspective.
    pub perspective: Perspective,
    /// Whether the vertices' occlusion multiplies the colour.
    pub occlusion: bool,
    /// Samples per pixel, 1 or 4.
    pub samples: u32,
    /// Linear Rec. 709 behind everything; none: transparent.
    pub background: Option<[f32; 3]>,
}

impl Default for Shading {
    fn default() -> Self {
        Self {
            mode: Mode::Amc,
            cyclic: Cyclic::Cyclic,
            perspective: Perspective::Half,
            occlusion: true,
            samples: 4,
            background: None,
        }
    }
}

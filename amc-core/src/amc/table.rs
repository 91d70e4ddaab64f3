//! The table itself, as it is stored and as it is reckoned with.

use half::f16;

use super::{Frame, Metadata, Symmetry};
use crate::color::{LINEAR_FROM_SRGB8, srgb8_from_linear};
use crate::view_space::Azimuth;
use crate::{Error, Result};

/// How many texels: `side x side x slices` (Si, Si, Sk in the paper).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TableSize {
    pub(super) side: u32,
    pub(super) slices: u32,
}

impl TableSize {
    /// The largest side and slice count: what 3D textures of every wgpu device hold.
    pub const LIMIT: u32 = 2048;

    /// A size of 1 to [`TableSize::LIMIT`] texels along each axis.
    ///
    /// # Errors
    /// Zero, or over the limit.
    pub fn new(side: u32, slices: u32) -> Result<Self> {
        let fits = |value| (1..=Self::LIMIT).contains(&value);
        if fits(side) && fits(slices) {
            Ok(Self { side, slices })
        } else {
            Err(Error::too_large(format!(
                "a table of {side} x {side} x {slices} texels; each axis must hold 1 to {}",
                Self::LIMIT
            )))
        }
    }

    /// Columns, and rows, of one slice.
    pub fn side(self) -> u32 {
        self.side
    }

    /// Slices along the azimuth.
    pub fn slices(self) -> u32 {
        self.slices
    }

    /// Texels in one slice.
    pub fn slice_texels(self) -> usize {
        self.side as usize * self.side as usize
    }

    /// Texels in all.
    pub fn texels(self) -> usize {
        self.slice_texels() * self.slices as usize
    }

    /// Whether both are powers of two, as the paper asks for compatibility (section 4.1).
    pub fn is_power_of_two(self) -> bool {
        self.side.is_power_of_two() && self.slices.is_power_of_two()
    }

    /// `(n_x, n_y)` at the centre of column `i`, row `j` (j upwards); each in (-1, 1).
    pub fn normal_xy(self, i: u32, j: u32) -> glam::Vec2 {
        let at = |k: u32| (2 * k + 1) as f32 / self.side as f32 - 1.0;
        glam::Vec2::new(at(i), at(j))
    }
}

/// Texels as a file and a texture hold them: index `(s * side + j) * side + i`, i to the right, j up, s the slice.
/// The fourth channel says how a texel came about: full = measured, below = filled in. Shading ignores it.
#[derive(Debug, Clone, PartialEq)]
pub enum Texels {
    /// Red, green, blue sRGB-encoded.
    Srgb8(Vec<[u8; 4]>),
    /// Red, green, blue linear Rec. 709.
    Half(Vec<[f16; 4]>),
}

impl Texels {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Srgb8(texels) => texels.len(),
            Self::Half(texels) => texels.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes of one texel.
    pub fn texel_bytes(&self) -> usize {
        match self {
            Self::Srgb8(_) => 4,
            Self::Half(_) => 8,
        }
    }

    /// The bytes as they are uploaded and stored (little-endian).
    pub fn as_bytes(&self) -> &[u8] {
        match self {
            Self::Srgb8(texels) => bytemuck::cast_slice(texels),
            Self::Half(texels) => bytemuck::cast_slice(texels),
        }
    }
}

/// An Anisotropic MatCap: the table and what is needed to look things up in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Amc {
    size: TableSize,
    texels: Texels,
    /// The table holds 1/R of a turn.
    pub symmetry: Symmetry,
    /// What the table's third axis means.
    pub azimuth: Azimuth,
    /// What its normals are relative to.
    pub frame: Frame,
    /// What is said about it.
    pub metadata: Metadata,
}

impl Amc {
    /// A table of `size` with these texels.
    ///
    /// # Errors
    /// The number of texels is not that of `size`.
    pub fn new(
        size: TableSize,
        texels: Texels,
        symmetry: Symmetry,
        azimuth: Azimuth,
        frame: Frame,
    ) -> Result<Self> {
        if texels.len() != size.texels() {
            return Err(Error::malformed(format!(
                "{} texels given for a table of {} x {} x {}, which has {}",
                texels.len(),
                size.side,
                size.side,
                size.slices,
                size.texels()
            )));
        }
        Ok(Self { size, texels, symmetry, azimuth, frame, metadata: Metadata::default() })
    }

    /// Its size.
    pub fn size(&self) -> TableSize {
        self.size
    }

    /// Its texels.
    pub fn texels(&self) -> &Texels {
        &self.texels
    }

    /// Bytes of its texels in memory, which are those of its texture.
    pub fn bytes(&self) -> usize {
        self.texels.as_bytes().len()
    }

    /// The bytes of slice `s`, as they are uploaded: how one slice is replaced while drawing.
    pub fn slice_bytes(&self, s: u32) -> &[u8] {
        let bytes = self.size.slice_texels() * self.texels.texel_bytes();
        &self.texels.as_bytes()[s as usize * bytes..][..bytes]
    }

    /// All texels in linear light, to reckon with.
    pub fn to_linear(&self) -> LinearTable {
        let texels = match &self.texels {
            Texels::Srgb8(texels) => texels
                .iter()
                .map(|&[r, g, b, a]| {
                    let linear = |value: u8| LINEAR_FROM_SRGB8[usize::from(value)];
                    [linear(r), linear(g), linear(b), f32::from(a) / 255.0]
                })
                .collect(),
            Texels::Half(texels) => texels.iter().map(|texel| texel.map(f16::to_f32)).collect(),
        };
        LinearTable { size: self.size, texels, symmetry: self.symmetry, azimuth: self.azimuth }
    }
}

/// A table in linear Rec. 709 light, 32-bit: what filtering, averaging and the CPU renderer work on. Indexed as [`Texels`].
#[derive(Debug, Clone, PartialEq)]
pub struct LinearTable {
    /// Its size.
    pub size: TableSize,
    /// Red, green, blue, and how the texel came about (1 = measured, below = filled in); `size.texels()` of them.
    pub texels: Vec<[f32; 4]>,
    /// The table holds 1/R of a turn.
    pub symmetry: Symmetry,
    /// What the third axis means.
    pub azimuth: Azimuth,
}

impl LinearTable {
    /// The texel at column `i`, row `j`, slice `s`.
    pub fn texel(&self, i: u32, j: u32, s: u32) -> [f32; 4] {
        let side = self.size.side as usize;
        self.texels[(s as usize * side + j as usize) * side + i as usize]
    }

    /// The colour at texture coordinates `u`, `v` (clamped) and `w` (repeating): trilinear, in linear light, texel
    /// centres at (k + 1/2) / size, as a GPU filters.
    pub fn sample(&self, u: f32, v: f32, w: f32) -> [f32; 3] {
        let clamped = |x: f32, size: u32| {
            let at = x * size as f32 - 0.5;
            let low = at.floor();
            let index = |k: f32| k.clamp(0.0, size as f32 - 1.0) as usize;
            (index(low), index(low + 1.0), at - low)
        };
        let (side, slices) = (self.size.side, self.size.slices);
        let (i0, i1, fu) = clamped(u, side);
        let (j0, j1, fv) = clamped(v, side);
        let at = w * slices as f32 - 0.5;
        let low = at.floor();
        let s0 = (low as i64).rem_euclid(i64::from(slices)) as usize;
        let s1 = (s0 + 1) % slices as usize;
        let fw = at - low;
        let side = side as usize;
        let mut colour = [0.0; 3];
        for (s, ws) in [(s0, 1.0 - fw), (s1, fw)] {
            for (j, wj) in [(j0, 1.0 - fv), (j1, fv)] {
                let row = (s * side + j) * side;
                for (i, wi) in [(i0, 1.0 - fu), (i1, fu)] {
                    let weight = ws * wj * wi;
                    let texel = &self.texels[row + i];
                    for (sum, value) in colour.iter_mut().zip(texel) {
                        *sum += weight * value;
                    }
                }
            }
        }
        colour
    }

    /// The texture coordinate along the azimuth of `phi` radians: `R * phi / (2 pi) + 1 / (2 Sk)`.
    pub fn w(&self, phi: f32) -> f32 {
        self.symmetry.order() as f32 * phi / std::f32::consts::TAU + 0.5 / self.size.slices as f32
    }

    /// The colour at the view-space normal's `(n_x, n_y)` and the tangent azimuth `phi` in radians.
    pub fn look_up(&self, normal_xy: glam::Vec2, phi: f32) -> [f32; 3] {
        self.sample((normal_xy.x + 1.0) / 2.0, (normal_xy.y + 1.0) / 2.0, self.w(phi))
    }

    /// The table as 8-bit sRGB texels; values outside 0..=1 are clamped.
    pub fn to_srgb8(&self) -> Texels {
        let encode = |&[r, g, b, a]: &[f32; 4]| {
            [
                srgb8_from_linear(r),
                srgb8_from_linear(g),
                srgb8_from_linear(b),
                (a.clamp(0.0, 1.0) * 255.0 + 0.5) as u8,
            ]
        };
        Texels::Srgb8(self.texels.iter().map(encode).collect())
    }

    /// The table as 16-bit float texels.
    pub fn to_half(&self) -> Texels {
        Texels::Half(self.texels.iter().map(|texel| texel.map(f16::from_f32)).collect())
    }
}

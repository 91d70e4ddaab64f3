//! AMCs from a reflectance under given lights: what a perfect capture of a perfect ball would give.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use serde_json::json;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::amc::{Amc, FILLED, Frame, LinearTable, Metadata, Symmetry, TableSize, TexelFormat};
use crate::reflectance::{Description, Lighting, Reflectance};
use crate::view_space::Azimuth;
use crate::{Error, Progress, Result};

/// The most sub-samples per texel.
pub const MOST_SAMPLES: u32 = 4096;

/// What table is made.
#[derive(Debug, Clone, PartialEq)]
pub struct BakeOptions {
    /// Columns, and rows, of a slice.
    pub side: u32,
    /// Slices; none: `2 side / R`, the paper's shape (section 4.1), a power of two.
    pub slices: Option<u32>,
    /// R; none: the reflectance's own, as far as it is exact in the azimuth asked for.
    pub symmetry: Option<Symmetry>,
    /// What the third axis means.
    pub azimuth: Azimuth,
    /// How texels are stored.
    pub format: TexelFormat,
    /// 1: the value at the texel's centre. More: the mean over that many points spread over the texel's area and its
    /// stretch of the azimuth, for highlights finer than texels; at most [`MOST_SAMPLES`].
    pub samples: u32,
    /// Where those points lie. The same seed gives the same table.
    pub seed: u64,
    /// The lights; none: those of the description.
    pub lighting: Option<Lighting>,
}

impl Default for BakeOptions {
    fn default() -> Self {
        Self {
            side: 128,
            slices: None,
            symmetry: None,
            azimuth: Azimuth::Transported,
            format: TexelFormat::Srgb8,
            samples: 1,
            seed: 0,
            lighting: None,
        }
    }
}

/// Bakes a described reflectance.
///
/// # Errors
/// The sizes are out of their ranges, there are no lights, or it was cancelled.
pub fn bake(description: &Description, options: &BakeOptions, progress: &Progress<'_>) -> Result<Amc> {
    let lighting = options.lighting.as_ref().or(description.lighting.as_ref()).ok_or_else(|| {
        Error::invalid("the description has no `lighting`: give the lights to see it under")
    })?;
    if !(1..=MOST_SAMPLES).contains(&options.samples) {
        return Err(Error::invalid(format!("{} samples; 1 to {MOST_SAMPLES} are taken", options.samples)));
    }
    let symmetry =
        options.symmetry.unwrap_or_else(|| exact_symmetry(&*description.reflectance, options.azimuth));
    let slices =
        options.slices.unwrap_or_else(|| (2 * options.side / symmetry.order()).max(1).next_power_of_two());
    let size = TableSize::new(options.side, slices)?;
    size.check_bytes(options.format)?;
    let baker = Baker { reflectance: &*description.reflectance, lighting, options, size, symmetry };
    let table = baker.table(progress)?;
    let cut = table.texels.iter().filter(|texel| texel[..3].iter().any(|&value| value > 1.0)).count();
    if cut > 0 && options.format == TexelFormat::Srgb8 {
        log::warn!("{cut} of {} texels are brighter than 8 bits hold and were cut", table.texels.len());
    }
    let metadata = Metadata {
        name: description.name.clone(),
        tags: description.tags.clone(),
        notes: description.notes.clone(),
        lighting: serde_json::to_value(lighting).map_err(|error| Error::invalid(error.to_string()))?,
        capture: json!({
            "baked": description.model,
            "samples": options.samples,
            "seed": options.seed,
            "texels_above_1": cut,
        }),
        ..Metadata::default()
    };
    Amc::from_linear(&table, options.format, Frame::Half, metadata)
}

/// The reflectance's symmetry, as far as a table with this azimuth has it exactly.
fn exact_symmetry(reflectance: &dyn Reflectance, azimuth: Azimuth) -> Symmetry {
    match azimuth {
        Azimuth::Transported => reflectance.symmetry(),
        Azimuth::Projected => reflectance.symmetry().in_both_azimuths(),
    }
}

struct Baker<'a> {
    reflectance: &'a dyn Reflectance,
    lighting: &'a Lighting,
    options: &'a BakeOptions,
    size: TableSize,
    symmetry: Symmetry,
}

impl Baker<'_> {
    fn table(&self, progress: &Progress<'_>) -> Result<LinearTable> {
        let mut texels = vec![[0.0; 4]; self.size.texels()];
        let slices = self.size.slices() as usize;
        let done = AtomicUsize::new(0);
        progress.step("baking slices", 0, slices)?;
        texels.par_chunks_mut(self.size.slice_texels()).enumerate().try_for_each(|(s, slice)| {
            let side = self.size.side();
            for (k, texel) in slice.iter_mut().enumerate() {
                *texel = self.texel(k as u32 % side, k as u32 / side, s as u32);
            }
            progress.step("baking slices", done.fetch_add(1, Ordering::Relaxed) + 1, slices)
        })?;
        let (symmetry, azimuth) = (self.symmetry, self.options.azimuth);
        Ok(LinearTable { size: self.size, texels, symmetry, azimuth })
    }

    /// A texel on the disc: its normal. Off the disc: the normal on the rim at its radius, which is what filling from the
    /// rim aims at, without its error.
    fn texel(&self, i: u32, j: u32, s: u32) -> [f32; 4] {
        let centre = self.size.normal_xy(i, j);
        let on_disc = self.size.is_on_disc(i, j);
        let mut sum = Vec3::ZERO;
        let mut count = 0.0f32;
        for [x, y, z] in Jitter::new(self.options, i, j, s) {
            let xy = centre + (Vec2::new(x, y) - 0.5) * (2.0 / self.size.side() as f32);
            if on_disc && xy.length_squared() > 1.0 && self.options.samples > 1 {
                continue;
            }
            sum += self.folded(xy, s as f32 + z - 0.5);
            count += 1.0;
        }
        let colour = sum / count.max(1.0);
        [colour.x, colour.y, colour.z, if on_disc { 1.0 } else { FILLED }]
    }

    /// The mean over the R directions that a folded slice stands for; where the symmetry is the reflectance's own they are
    /// all alike, and one is looked at.
    fn folded(&self, xy: Vec2, slice: f32) -> Vec3 {
        let order = self.symmetry.order();
        let own = exact_symmetry(self.reflectance, self.options.azimuth).order();
        let directions = if own.is_multiple_of(order) { 1 } else { order };
        let sum: Vec3 = (0..directions)
            .map(|c| {
                let turn = (slice / self.size.slices() as f32 + c as f32) / order as f32;
                self.seen(xy, turn * std::f32::consts::TAU)
            })
            .sum();
        sum / directions as f32
    }

    /// Radiance to the viewer at the normal `xy` (off the disc: at its rim) and the azimuth `phi`.
    fn seen(&self, xy: Vec2, phi: f32) -> Vec3 {
        let z = (1.0 - xy.length_squared()).max(0.0).sqrt();
        let n = xy.extend(z).normalize_or(Vec3::Z);
        let t = self.options.azimuth.tangent(n, phi);
        let b = n.cross(t);
        let in_cloth = |x: Vec3| Vec3::new(x.dot(t), x.dot(b), x.dot(n));
        let to_viewer = in_cloth(Vec3::Z);
        let lit: Vec3 = self
            .lighting
            .lights
            .iter()
            .map(|light| {
                let to_light = in_cloth(light.towards.normalize_or_zero());
                self.reflectance.reflect(to_light, to_viewer) * light.irradiance
            })
            .sum();
        lit + self.reflectance.ambient() * self.lighting.ambient
    }
}

/// Points in the unit cube: one in its middle, or an evenly spread sequence shifted by an amount of the texel's own.
struct Jitter {
    next: u32,
    count: u32,
    shift: [f32; 3],
}

impl Jitter {
    fn new(options: &BakeOptions, i: u32, j: u32, s: u32) -> Self {
        let mut state = options.seed ^ (u64::from(i) | u64::from(j) << 16 | u64::from(s) << 32);
        let mut random = || {
            // SplitMix64 (Steele, Lea, Flood 2014).
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
        };
        Self { next: 0, count: options.samples, shift: [random(), random(), random()] }
    }
}

impl Iterator for Jitter {
    type Item = [f32; 3];

    fn next(&mut self) -> Option<[f32; 3]> {
        if self.next == self.count {
            return None;
        }
        let k = self.next;
        self.next += 1;
        if self.count == 1 {
            return Some([0.5; 3]);
        }
        // The additive recurrence of Roberts' R3 sequence: powers of the root of x^4 = x + 1.
        const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_2];
        let at = |axis: usize| (f64::from(k) * STEPS[axis] + f64::from(self.shift[axis])).fract() as f32;
        Some([at(0), at(1), at(2)])
    }
}

#[cfg(test)]
mod tests;

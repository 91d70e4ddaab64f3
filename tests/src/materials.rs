//! Cloth of a known symmetry, and pictures of a ball in it: independent of the program's own reflectances.
//!
//! The cloth is made of facets that lean out of its plane in R evenly spread directions, each with a highlight about
//! the half vector. R = 0 facets: isotropic.

use std::path::Path;

use amc_core::Result;
use amc_core::image::{Picture, encode};
use glam::{Vec2, Vec3};

/// A cloth whose look comes back after 1/R of a turn and no sooner.
#[derive(Debug, Clone, Copy)]
pub struct Facets {
    /// R, or 0: isotropic.
    pub directions: u32,
    /// How far the facets lean, radians.
    pub lean: f32,
    /// The highlight's exponent.
    pub exponent: i32,
    /// Diffuse colour, linear.
    pub diffuse: [f32; 3],
}

impl Facets {
    /// A cloth of symmetry `directions` (0: isotropic) with highlights broad enough for a coarse table.
    pub fn new(directions: u32) -> Self {
        Self { directions, lean: 0.35, exponent: 24, diffuse: [0.25, 0.08, 0.05] }
    }

    /// Linear colour at the normal `n` and the tangent `t` (unit, perpendicular), seen along +z.
    pub fn colour(&self, lights: &[Vec3], n: Vec3, t: Vec3) -> [f32; 3] {
        let bitangent = n.cross(t);
        let mut colour = [0.01; 3];
        for &light in lights {
            let cosine = n.dot(light).max(0.0);
            let half = (light + Vec3::Z).normalize_or(Vec3::Z);
            let highlight = if self.directions == 0 {
                half.dot(n).max(0.0).powi(self.exponent)
            } else {
                let each = (0..self.directions).map(|k| {
                    let angle = std::f32::consts::TAU * k as f32 / self.directions as f32;
                    let facet =
                        n * self.lean.cos() + (t * angle.cos() + bitangent * angle.sin()) * self.lean.sin();
                    half.dot(facet).max(0.0).powi(self.exponent)
                });
                each.sum::<f32>() / self.directions as f32
            };
            for (sum, diffuse) in colour.iter_mut().zip(self.diffuse) {
                *sum += (diffuse + 0.8 * highlight) * cosine / lights.len() as f32;
            }
        }
        colour
    }

    /// An orthographic picture of a ball that fills the square, turned by `angle` radians counter-clockwise from the
    /// warp lying horizontal; alpha is coverage. `noise` is the standard deviation of Gaussian noise, in 1/255 of sRGB.
    pub fn picture(&self, lights: &[Vec3], side: u32, angle: f32, noise: f32, seed: u64) -> Result<Picture> {
        const GRID: u32 = 3;
        let mut random = Noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        let mut pixels = Vec::with_capacity((side * side) as usize);
        for y in 0..side {
            for x in 0..side {
                let mut sum = [0.0; 3];
                let mut covered = 0;
                for k in 0..GRID * GRID {
                    let at = |pixel: u32, k: u32| {
                        (pixel as f32 + (k as f32 + 0.5) / GRID as f32) / side as f32 * 2.0 - 1.0
                    };
                    let p = Vec2::new(at(x, k % GRID), -at(y, k / GRID));
                    if p.length_squared() >= 1.0 {
                        continue;
                    }
                    let n = p.extend((1.0 - p.length_squared()).sqrt());
                    let across = Vec2::from_angle(angle);
                    // The tangent whose projection on the picture is `across`.
                    let t = (across * n.z).extend(-p.dot(across)).normalize_or(Vec3::X);
                    for (sum, value) in sum.iter_mut().zip(self.colour(lights, n, t)) {
                        *sum += value;
                    }
                    covered += 1;
                }
                let mean = sum.map(|value| value / covered.max(1) as f32);
                let noisy = mean.map(|linear| {
                    let encoded =
                        amc_core::color::srgb_from_linear(linear) + random.gaussian() * noise / 255.0;
                    amc_core::color::linear_from_srgb(encoded.clamp(0.0, 1.0))
                });
                pixels.push([noisy[0], noisy[1], noisy[2], covered as f32 / (GRID * GRID) as f32]);
            }
        }
        Picture::new(side, side, pixels)
    }

    /// A whole turn of `count` pictures in `folder`, as `0000.png` and so on.
    pub fn save_turn(&self, folder: &Path, lights: &[Vec3], side: u32, count: u32, noise: f32) -> Result<()> {
        for k in 0..count {
            let angle = std::f32::consts::TAU * k as f32 / count as f32;
            let picture = self.picture(lights, side, angle, noise, u64::from(k) + 1)?;
            encode::write_png(&picture, &folder.join(format!("{k:04}.png")), &[])?;
        }
        Ok(())
    }
}

/// Three lights from different sides, as in a small studio.
pub fn three_lights() -> Vec<Vec3> {
    [Vec3::new(0.5, 0.6, 0.7), Vec3::new(-0.7, 0.2, 0.5), Vec3::new(0.1, -0.6, 0.8)]
        .map(|light| light.normalize_or(Vec3::Z))
        .to_vec()
}

/// A small generator of Gaussian noise, the same on every machine (xorshift64*, sum of four uniforms).
#[derive(Debug)]
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 40) as f32 / (1 << 24) as f32
    }

    fn gaussian(&mut self) -> f32 {
        let sum: f32 = (0..4).map(|_| self.uniform()).sum();
        (sum - 2.0) * 3f32.sqrt()
    }
}

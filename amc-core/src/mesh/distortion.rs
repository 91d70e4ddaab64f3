//! How the map from the flat pattern to the surface stretches and shears.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::Garment;
use super::lanes::{LANES, Lanes, larger, smaller};
use super::measure::Batch;

/// How far a panel's map from the flat pattern to the surface is from a uniform scale.
///
/// From the singular values of each triangle's map, as the texture stretch metric of Sander, Snyder, Gortler and
/// Hoppe, "Texture mapping progressive meshes" (2001); percentiles over the panel's area in place of their norms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distortion {
    /// Larger singular value of a triangle's map over the panel's mean scale, the area-weighted mean of
    /// sqrt(surface area / UV area). 1 where the pattern is only scaled; 0 where there are no UVs.
    pub stretch: Percentiles,
    /// Angle between dP/du and dP/dv in radians. 0 where there are no UVs.
    pub shear: Percentiles,
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

impl Garment {
    /// The distortion of each panel, in the order of [`Garment::panels`]. It is measured anew at every call.
    pub fn distortion(&self) -> Vec<Distortion> {
        let of = |range: std::ops::Range<u32>| {
            let triangles = self.triangles.get(range.start as usize..range.end as usize);
            measure(&self.positions, &self.uvs, triangles.unwrap_or_default())
        };
        self.panels.par_iter().map(|panel| of(panel.triangles.clone())).collect()
    }
}

/// The map of some triangles.
struct Maps {
    /// Larger singular value, metres per unit.
    larger: Lanes,
    /// (1 - cos)/2 of the angle between dP/du and dP/dv: grows with the angle, from 0 to 1.
    shear_key: Lanes,
    /// Root of area over UV area.
    scale: Lanes,
}

fn maps(batch: &Batch, areas: &Lanes) -> Maps {
    let zeros = [0.0; LANES];
    let mut out = Maps { larger: zeros, shear_key: zeros, scale: zeros };
    let ([px, py, pz, qx, qy, qz], [au, av, bu, bv]) = (&batch.edges.0, &batch.uv_edges);
    for i in 0..LANES {
        let (px, py, pz, qx, qy, qz) = (px[i], py[i], pz[i], qx[i], qy[i], qz[i]);
        let (au, av, bu, bv) = (au[i], av[i], bu[i], bv[i]);
        let inverse = 1.0 / (au * bv - av * bu);
        // dP/du and dP/dv.
        let (ux, uy, uz) = (px * bv - qx * av, py * bv - qy * av, pz * bv - qz * av);
        let (vx, vy, vz) = (qx * au - px * bu, qy * au - py * bu, qz * au - pz * bu);
        // The first fundamental form (E F; F G); its eigenvalues are the squares of the map's singular values.
        let square = inverse * inverse;
        let e = (ux * ux + uy * uy + uz * uz) * square;
        let f = (ux * vx + uy * vy + uz * vz) * square;
        let g = (vx * vx + vy * vy + vz * vz) * square;
        let (mean, difference) = (0.5 * (e + g), 0.5 * (e - g));
        let cosine = smaller(larger(f / (e * g).sqrt(), -1.0), 1.0);
        out.larger[i] = (mean + (difference * difference + f * f).sqrt()).sqrt();
        out.shear_key[i] = 0.5 - 0.5 * cosine;
        out.scale[i] = (2.0 * areas[i] * inverse.abs()).sqrt();
    }
    out
}

/// The distortion of some triangles; those whose UVs have no area do not count.
fn measure(positions: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) -> Distortion {
    let mut stretch = Weighted::with_capacity(triangles.len());
    let mut shear = Vec::with_capacity(triangles.len());
    let (mut area, mut scale) = (0.0f64, 0.0f64);
    let mut batch = Batch::new();
    for triangles in triangles.chunks(LANES) {
        batch.fill(positions, uvs, triangles);
        let (areas, uv_areas) = (batch.areas(), batch.uv_areas());
        let maps = maps(&batch, &areas);
        let (mut batch_area, mut batch_scale) = (0.0f32, 0.0f32);
        for i in 0..triangles.len() {
            let (value, key) = (maps.larger[i], maps.shear_key[i]);
            if uv_areas[i] != 0.0 && value.is_finite() && key.is_finite() {
                batch_area += areas[i];
                batch_scale += areas[i] * maps.scale[i];
                stretch.push(value, areas[i]);
                shear.push(key);
            }
        }
        area += f64::from(batch_area);
        scale += f64::from(batch_scale);
    }
    if shear.is_empty() {
        return Distortion::default();
    }
    let shear = Weighted { values: shear, weights: stretch.weights.clone() };
    let mean_scale = if scale > 0.0 { scale / area } else { 1.0 };
    Distortion {
        stretch: stretch.percentiles().map(|x| (f64::from(x) / mean_scale) as f32),
        shear: shear.percentiles().map(|key| (1.0 - 2.0 * key).acos()),
    }
}

impl Percentiles {
    fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self { p5: f(self.p5), p50: f(self.p50), p95: f(self.p95) }
    }
}

/// Finite values with weights.
struct Weighted {
    values: Vec<f32>,
    weights: Vec<f32>,
}

const BINS: usize = 512;

/// A histogram of weights over equal steps from the least value to the largest.
struct Bins {
    low: f32,
    scale: f32,
    weights: [f32; BINS],
}

impl Weighted {
    fn with_capacity(count: usize) -> Self {
        Self { values: Vec::with_capacity(count), weights: Vec::with_capacity(count) }
    }

    fn push(&mut self, value: f32, weight: f32) {
        self.values.push(value);
        self.weights.push(weight);
    }

    fn iter(&self) -> impl Iterator<Item = (f32, f32)> + '_ {
        self.values.iter().copied().zip(self.weights.iter().copied())
    }

    /// By weight: the least value that, with all below, holds at least that share. Zeros where there are no values.
    fn percentiles(&self) -> Percentiles {
        let bins = Bins::new(self);
        let total: f64 = bins.weights.iter().map(|&weight| f64::from(weight)).sum();
        let [p5, p50, p95] = self.select(&bins, [0.05 * total, 0.5 * total, 0.95 * total]);
        Percentiles { p5, p50, p95 }
    }

    /// For each target the least value that, with all below, holds at least that weight.
    fn select<const N: usize>(&self, bins: &Bins, targets: [f64; N]) -> [f32; N] {
        let wanted = targets.map(|target| bins.find(target));
        let mut is_wanted = [false; BINS];
        wanted.iter().for_each(|&(bin, _)| is_wanted[bin] = true);
        let mut inside: Vec<(usize, f32, f32)> = Vec::new();
        for (value, weight) in self.iter() {
            let bin = bins.bin(value);
            if is_wanted[bin] {
                inside.push((bin, value, weight));
            }
        }
        let mut k = 0;
        targets.map(|target| {
            let (bin, mut below) = wanted[k];
            k += 1;
            let mut items: Vec<(f32, f32)> = inside
                .iter()
                .filter(|item| item.0 == bin)
                .map(|&(_, value, weight)| (value, weight))
                .collect();
            // The bins of the least and the largest value differ, so what is inside grows less each time.
            if items.len() > 4 * BINS && items.len() < self.values.len() {
                let (values, weights) = items.into_iter().unzip();
                let inside = Self { values, weights };
                return inside.select(&Bins::new(&inside), [target - below])[0];
            }
            items.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let reached = items.iter().find(|item| {
                below += f64::from(item.1);
                below >= target
            });
            reached.or(items.last()).map_or(0.0, |item| item.0)
        })
    }
}

impl Bins {
    fn new(items: &Weighted) -> Self {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for &value in &items.values {
            (low, high) = (smaller(value, low), larger(value, high));
        }
        let mut bins = Self { low, scale: (BINS - 1) as f32 / (high - low), weights: [0.0; BINS] };
        for (value, weight) in items.iter() {
            bins.weights[bins.bin(value)] += weight;
        }
        bins
    }

    /// The bin in which a weight is reached, counted from the least value, and the weight below that bin.
    fn find(&self, target: f64) -> (usize, f64) {
        let (mut below, mut found) = (0.0, (0, 0.0));
        for (bin, &weight) in self.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
            found = (bin, below);
            below += f64::from(weight);
            if below >= target {
                break;
            }
        }
        found
    }

    /// The least value is in the first bin, the largest in the last (all in the first where they are the same), and
    /// bins are in the order of their values.
    #[inline]
    fn bin(&self, value: f32) -> usize {
        (((value - self.low) * self.scale) as usize).min(BINS - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pseudo_random::PseudoRandom;

    /// A grid of `n` x `n` squares over the unit square of the UV map, put on a surface.
    fn grid(n: u32, surface: impl Fn(Vec2) -> Vec3) -> Distortion {
        let (mut uvs, mut triangles) = (Vec::new(), Vec::new());
        for j in 0..=n {
            for i in 0..=n {
                uvs.push(Vec2::new(i as f32, j as f32) / n as f32);
            }
        }
        for j in 0..n {
            for i in 0..n {
                let a = j * (n + 1) + i;
                triangles.extend([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
            }
        }
        let positions: Vec<Vec3> = uvs.iter().map(|&uv| surface(uv)).collect();
        measure(&positions, &uvs, &triangles)
    }

    #[test]
    fn a_cylinder_is_stretched_by_the_root_of_its_ratio() {
        // Around: 2 pi r per u; along: h per v. Mean scale sqrt(2 pi r h), so the stretch is sqrt(2 pi r / h).
        let (radius, height) = (0.5, 0.8);
        let distortion = grid(100, |uv| {
            let (sin, cos) = (uv.x * std::f32::consts::TAU).sin_cos();
            Vec3::new(radius * sin, height * uv.y, radius * cos)
        });
        let stretch = (std::f32::consts::TAU * radius / height).sqrt();
        for p in [distortion.stretch.p5, distortion.stretch.p50, distortion.stretch.p95] {
            assert!((p - stretch).abs() < 1e-3 * stretch, "{p} {stretch}");
        }
        assert!((distortion.shear.p50 - std::f32::consts::FRAC_PI_2).abs() < 1e-3);
    }

    #[test]
    fn a_sheared_sheet_has_its_angle() {
        let angle = 1.1f32;
        let distortion = grid(10, |uv| Vec3::new(uv.x + angle.cos() * uv.y, angle.sin() * uv.y, 2.0) * 3.0);
        for p in [distortion.shear.p5, distortion.shear.p50, distortion.shear.p95] {
            assert!((p - angle).abs() < 1e-3, "{p}");
        }
        // Singular values of (1 cos; 0 sin): sqrt(1 +- cos).
        let stretch = ((1.0 + angle.cos()) / angle.sin()).sqrt();
        assert!((distortion.stretch.p50 - stretch).abs() < 1e-3);
    }

    #[test]
    fn without_uv_area_there_is_no_distortion() {
        let line = [Vec2::ZERO, Vec2::ONE, Vec2::ONE * 2.0];
        assert_eq!(measure(&[Vec3::ZERO, Vec3::X, Vec3::Y], &line, &[[0, 1, 2]]), Distortion::default());
    }

    #[test]
    fn percentiles_by_weight_agree_with_sorting() {
        let mut numbers = PseudoRandom::new(1);
        let percentiles = |items: &[(f32, f32)]| {
            let (values, weights) = items.iter().copied().unzip();
            Weighted { values, weights }.percentiles()
        };
        for outlier in [1.0, 1e6, 1e30] {
            let mut items: Vec<(f32, f32)> =
                (0..20_000).map(|_| (numbers.unit().powi(3), 0.1 + numbers.unit())).collect();
            items[77].0 = outlier;
            let found = percentiles(&items);
            items.sort_by(|a, b| a.0.total_cmp(&b.0));
            let total: f64 = items.iter().map(|item| f64::from(item.1)).sum();
            for (share, p) in [(0.05, found.p5), (0.5, found.p50), (0.95, found.p95)] {
                let below: f64 = items.iter().filter(|item| item.0 < p).map(|item| f64::from(item.1)).sum();
                let upto: f64 = items.iter().filter(|item| item.0 <= p).map(|item| f64::from(item.1)).sum();
                assert!(below <= (share + 1e-5) * total && upto >= (share - 1e-5) * total, "{share} {p}");
            }
        }
        assert_eq!(percentiles(&[(3.0, 1.0)]), Percentiles { p5: 3.0, p50: 3.0, p95: 3.0 });
        assert_eq!(percentiles(&[]), Percentiles::default());
    }
}

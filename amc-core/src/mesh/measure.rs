//! A panel's area, and how its cloth is stretched and sheared.

use std::ops::Range;

use glam::{DVec3, Vec2, Vec3};

use super::panel::{PanelFlags, Percentiles};

/// Twice the signed area of a triangle in the flat pattern; zero where it is lost in rounding.
pub(crate) fn uv_area([a, b, c]: [Vec2; 3]) -> f32 {
    let area = (b - a).perp_dot(c - a);
    let squares = (b - a).length_squared() + (c - a).length_squared();
    if area.abs() > lost_area(squares, largest([a, b, c])) && area.is_finite() { area } else { 0.0 }
}

/// The largest coordinate, unsigned.
#[inline(always)]
fn largest([a, b, c]: [Vec2; 3]) -> f32 {
    let ab = larger(larger(a.x.abs(), a.y.abs()), larger(b.x.abs(), b.y.abs()));
    larger(ab, larger(c.x.abs(), c.y.abs()))
}

/// The error that twice an area may have, from the sum of the squares of two edges and the largest coordinate: each
/// coordinate is known to half a unit in its last place.
#[inline(always)]
fn lost_area(squares: f32, largest: f32) -> f32 {
    // The sum of two lengths is at most the root of twice the sum of their squares.
    larger(1e-6 * squares, f32::EPSILON * largest * (2.0 * squares).sqrt())
}

/// Unlike `f32::max` this is one instruction.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The figures of a panel.
#[derive(Debug, Default)]
pub(super) struct Figures {
    pub(super) area: f32,
    pub(super) flags: PanelFlags,
    pub(super) stretch: Percentiles,
    pub(super) shear: Percentiles,
    /// Area-weighted centre on the surface.
    pub(super) centre: Vec3,
    /// Corners of the box in the flat pattern.
    pub(super) uv_box: (Vec2, Vec2),
}

/// Triangles measured at a time, so that the compiler can use vector instructions.
const LANES: usize = 16;

type Lanes = [f32; LANES];

/// Edges of some triangles, from their first corners; one array per coordinate.
struct Batch {
    /// In space: the first edge's x, y, z, then the second's.
    edges: [Lanes; 6],
    /// In the flat pattern: the first edge's u, v, then the second's.
    uv_edges: [Lanes; 4],
    /// The largest coordinate in the flat pattern, unsigned.
    largest_uv: Lanes,
}

/// Figures of some triangles.
struct Measured {
    /// Area, square metres.
    size: Lanes,
    /// Twice the signed area in the flat pattern; zero where it is lost.
    uv_area: Lanes,
    /// Larger singular value of the map from the flat pattern to the surface, metres per unit.
    larger: Lanes,
    /// (1 - cos)/2 of the angle between dP/du and dP/dv: grows with the angle, from 0 to 1.
    shear_key: Lanes,
    /// Area times the root of area over UV area.
    scale: Lanes,
}

impl Batch {
    fn measure(&self) -> Measured {
        let zeros = [0.0; LANES];
        let mut out = Measured { size: zeros, uv_area: zeros, larger: zeros, shear_key: zeros, scale: zeros };
        let ([px, py, pz, qx, qy, qz], [au, av, bu, bv]) = (&self.edges, &self.uv_edges);
        for i in 0..LANES {
            let (px, py, pz, qx, qy, qz) = (px[i], py[i], pz[i], qx[i], qy[i], qz[i]);
            let (au, av, bu, bv) = (au[i], av[i], bu[i], bv[i]);
            let (nx, ny, nz) = (py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx);
            let size = 0.5 * (nx * nx + ny * ny + nz * nz).sqrt();
            let area = au * bv - av * bu;
            let inverse = 1.0 / area;
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
            let squares = au * au + av * av + bu * bu + bv * bv;
            let lost = lost_area(squares, self.largest_uv[i]);
            out.size[i] = size;
            out.uv_area[i] = if area.abs() > lost { area } else { 0.0 };
            out.larger[i] = (mean + (difference * difference + f * f).sqrt()).sqrt();
            out.shear_key[i] = 0.5 - 0.5 * cosine;
            out.scale[i] = size * (2.0 * size * inverse.abs()).sqrt();
        }
        out
    }
}

/// Measures the triangles in `range`.
///
/// Stretch is each triangle's larger singular value over the panel's mean scale, the area-weighted mean of
/// sqrt(surface area / UV area): 1 everywhere where the pattern is only scaled. Triangles whose UVs have no area
/// count for the area and the flag `degenerate` only.
pub(super) fn measure(
    positions: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    range: Range<usize>,
) -> Figures {
    let count = range.len();
    let mut stretch = Weighted::with_capacity(count);
    let mut shear = Vec::with_capacity(count);
    let (mut area, mut mirrored, mut scale) = (0.0f64, 0.0f64, 0.0f64);
    let (mut moment, mut low, mut high) = (DVec3::ZERO, Vec2::INFINITY, Vec2::NEG_INFINITY);
    let zeros = [0.0; LANES];
    let mut batch = Batch { edges: [zeros; 6], uv_edges: [zeros; 4], largest_uv: zeros };
    let mut sums = [Vec3::ZERO; LANES];
    for triangles in triangles[range].chunks(LANES) {
        for (i, &triangle) in triangles.iter().enumerate() {
            let [p, q, r] = triangle.map(|vertex| positions[vertex as usize]);
            let [a, b, c] = triangle.map(|vertex| uvs[vertex as usize]);
            let edges = [q - p, r - p].map(|edge| edge.to_array());
            for (lanes, &x) in batch.edges.iter_mut().zip(edges.as_flattened()) {
                lanes[i] = x;
            }
            let uv_edges = [b - a, c - a].map(|edge| edge.to_array());
            for (lanes, &x) in batch.uv_edges.iter_mut().zip(uv_edges.as_flattened()) {
                lanes[i] = x;
            }
            batch.largest_uv[i] = largest([a, b, c]);
            sums[i] = p + q + r;
            for uv in [a, b, c] {
                low = Vec2::new(smaller(uv.x, low.x), smaller(uv.y, low.y));
                high = Vec2::new(larger(uv.x, high.x), larger(uv.y, high.y));
            }
        }
        let measured = batch.measure();
        let (mut batch_area, mut batch_mirrored, mut batch_scale) = (0.0f32, 0.0f32, 0.0f32);
        let mut batch_moment = Vec3::ZERO;
        for (i, &sum) in sums[..triangles.len()].iter().enumerate() {
            let size = measured.size[i];
            batch_area += size;
            batch_moment += sum * size;
            let (value, key) = (measured.larger[i], measured.shear_key[i]);
            if measured.uv_area[i] != 0.0 && value.is_finite() && key.is_finite() {
                batch_mirrored += if measured.uv_area[i] < 0.0 { size } else { 0.0 };
                batch_scale += measured.scale[i];
                stretch.push(value, size);
                shear.push(key);
            }
        }
        area += f64::from(batch_area);
        mirrored += f64::from(batch_mirrored);
        scale += f64::from(batch_scale);
        moment += batch_moment.as_dvec3() / 3.0;
    }
    let degenerate = shear.len() < count;
    let shear = Weighted { values: shear, weights: stretch.weights.clone() };
    let flat_area: f64 = shear.weights.iter().map(|&weight| f64::from(weight)).sum();
    let mean_scale = if scale > 0.0 { scale / flat_area } else { 1.0 };
    Figures {
        area: area as f32,
        flags: PanelFlags { mirrored: mirrored > 0.5 * area, degenerate },
        stretch: stretch.percentiles().map(|x| (f64::from(x) / mean_scale) as f32),
        shear: shear
            .percentiles()
            .map(|key| if degenerate && flat_area == 0.0 { 0.0 } else { (1.0 - 2.0 * key).acos() }),
        centre: if area > 0.0 { (moment / area).as_vec3() } else { Vec3::ZERO },
        uv_box: if count > 0 { (low, high) } else { (Vec2::ZERO, Vec2::ZERO) },
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

    /// A grid of `n` x `n` squares over the unit square of the UV map, put on a surface.
    fn grid(n: u32, surface: impl Fn(Vec2) -> Vec3) -> Figures {
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
        measure(&positions, &uvs, &triangles, 0..triangles.len())
    }

    #[test]
    fn a_cylinder_is_stretched_by_the_root_of_its_ratio() {
        // Around: 2 pi r per u; along: h per v. Mean scale sqrt(2 pi r h), so the stretch is sqrt(2 pi r / h).
        let (radius, height) = (0.5, 0.8);
        let figures = grid(100, |uv| {
            let (sin, cos) = (uv.x * std::f32::consts::TAU).sin_cos();
            Vec3::new(radius * sin, height * uv.y, radius * cos)
        });
        let stretch = (std::f32::consts::TAU * radius / height).sqrt();
        for p in [figures.stretch.p5, figures.stretch.p50, figures.stretch.p95] {
            assert!((p - stretch).abs() < 1e-3 * stretch, "{p} {stretch}");
        }
        assert!((figures.shear.p50 - std::f32::consts::FRAC_PI_2).abs() < 1e-3);
        assert!((figures.area - std::f32::consts::TAU * radius * height).abs() < 1e-2);
        assert_eq!(figures.flags, PanelFlags::default());
    }

    #[test]
    fn a_sheared_sheet_has_its_angle() {
        let angle = 1.1f32;
        let figures = grid(10, |uv| Vec3::new(uv.x + angle.cos() * uv.y, angle.sin() * uv.y, 2.0) * 3.0);
        for p in [figures.shear.p5, figures.shear.p50, figures.shear.p95] {
            assert!((p - angle).abs() < 1e-3, "{p}");
        }
        // Singular values of (1 cos; 0 sin): sqrt(1 +- cos).
        let stretch = ((1.0 + angle.cos()) / angle.sin()).sqrt();
        assert!((figures.stretch.p50 - stretch).abs() < 1e-3);
        assert!((figures.area - 9.0 * angle.sin()).abs() < 1e-4);
    }

    #[test]
    fn mirrored_by_more_than_half_the_area_is_flagged() {
        let folded_at = |at: f32| grid(10, move |uv| Vec3::new((uv.x - at).abs(), uv.y, 0.0));
        // Where the surface folds back, the winding turns with it and the UV map does not: seen as area, unsigned.
        assert!(!folded_at(0.3).flags.mirrored);
        let mirrored = |share: f32| {
            let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(|uv| uv * Vec2::new(share, 1.0));
            let positions = uvs.map(|uv| uv.extend(0.0));
            let flipped = uvs.map(|uv| Vec2::new(-uv.x, uv.y));
            let all = [positions, positions.map(|p| p + Vec3::Z)].concat();
            measure(&all, &[uvs, flipped].concat(), &[[0, 1, 2], [4, 5, 6], [4, 6, 7]], 0..3)
        };
        assert!(mirrored(1.0).flags.mirrored);
    }

    #[test]
    fn uvs_without_area_are_degenerate() {
        let figures = grid(4, |uv| Vec3::new(uv.x, uv.y, 0.0));
        assert!(!figures.flags.degenerate);
        let line = measure(
            &[Vec3::ZERO, Vec3::X, Vec3::Y],
            &[Vec2::ZERO, Vec2::ONE, Vec2::ONE * 2.0],
            &[[0, 1, 2]],
            0..1,
        );
        assert!(line.flags.degenerate && line.area == 0.5 && line.stretch == Percentiles::default());
    }

    #[test]
    fn percentiles_by_weight_agree_with_sorting() {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        let percentiles = |items: &[(f32, f32)]| {
            let (values, weights) = items.iter().copied().unzip();
            Weighted { values, weights }.percentiles()
        };
        for outlier in [1.0, 1e6, 1e30] {
            let mut items: Vec<(f32, f32)> =
                (0..20_000).map(|_| (random().powi(3), 0.1 + random())).collect();
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

//! A panel's area, and how its cloth is stretched and sheared.

use std::ops::Range;

use glam::{Vec2, Vec3};

use super::panel::{PanelFlags, Percentiles};

/// The first fundamental form of the map from the flat pattern to the surface on one triangle: `|dP/du|^2`,
/// `dP/du . dP/dv`, `|dP/dv|^2`, in square metres.
#[derive(Debug, Clone, Copy)]
struct Form {
    e: f32,
    f: f32,
    g: f32,
}

/// Twice the signed area of a triangle in the flat pattern; zero where it is lost in rounding.
pub(super) fn uv_area([a, b, c]: [Vec2; 3]) -> f32 {
    let (ab, ac) = (b - a, c - a);
    let area = ab.perp_dot(ac);
    // Each coordinate is known to half a unit in its last place.
    let rounding = f32::EPSILON * a.abs().max(b.abs()).max(c.abs()).max_element();
    let lost =
        (1e-6 * (ab.length_squared() + ac.length_squared())).max(rounding * (ab.length() + ac.length()));
    if area.abs() > lost && area.is_finite() { area } else { 0.0 }
}

impl Form {
    /// Of a triangle whose [`uv_area`] is not zero.
    fn new([p, q, r]: [Vec3; 3], [a, b, c]: [Vec2; 3], area: f32) -> Self {
        let (pq, pr, ab, ac) = (q - p, r - p, b - a, c - a);
        let inverse = 1.0 / area;
        let du = (pq * ac.y - pr * ab.y) * inverse;
        let dv = (pr * ab.x - pq * ac.x) * inverse;
        Self { e: du.length_squared(), f: du.dot(dv), g: dv.length_squared() }
    }

    /// The larger singular value of the map, metres per unit of the UV map.
    fn larger_singular_value(self) -> f32 {
        // The singular values are the roots of the form's eigenvalues.
        let (mean, difference) = (0.5 * (self.e + self.g), 0.5 * (self.e - self.g));
        (mean + (difference * difference + self.f * self.f).sqrt()).sqrt()
    }

    /// (1 - cos)/2 of the angle between dP/du and dP/dv: grows with the angle, from 0 to 1.
    fn shear_key(self) -> f32 {
        0.5 - 0.5 * (self.f / (self.e * self.g).sqrt()).clamp(-1.0, 1.0)
    }
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
    let (mut stretch, mut shear) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let (mut area, mut mirrored, mut flat_area, mut scale) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    let (mut moment, mut low, mut high) = (glam::DVec3::ZERO, Vec2::INFINITY, Vec2::NEG_INFINITY);
    for &triangle in &triangles[range] {
        let corners = triangle.map(|i| positions[i as usize]);
        let corner_uvs = triangle.map(|i| uvs[i as usize]);
        let [p, q, r] = corners;
        let size = 0.5 * (q - p).cross(r - p).length();
        area += f64::from(size);
        moment += ((corners[0] + corners[1] + corners[2]) * (size / 3.0)).as_dvec3();
        for uv in corner_uvs {
            (low, high) = (low.min(uv), high.max(uv));
        }
        let uv_size = uv_area(corner_uvs);
        if uv_size == 0.0 {
            continue;
        }
        let map = Form::new(corners, corner_uvs, uv_size);
        let (larger, key) = (map.larger_singular_value(), map.shear_key());
        if !(larger.is_finite() && key.is_finite()) {
            continue;
        }
        flat_area += f64::from(size);
        mirrored += if uv_size < 0.0 { f64::from(size) } else { 0.0 };
        scale += f64::from(size * (2.0 * size / uv_size.abs()).sqrt());
        stretch.push((larger, size));
        shear.push((key, size));
    }
    let degenerate = shear.len() < count;
    let mean_scale = if flat_area > 0.0 { scale / flat_area } else { 1.0 };
    Figures {
        area: area as f32,
        flags: PanelFlags { mirrored: mirrored > 0.5 * area, degenerate },
        stretch: percentiles(&stretch).map(|x| (f64::from(x) / mean_scale) as f32),
        shear: percentiles(&shear).map(|key| (1.0 - 2.0 * key).acos()),
        centre: if area > 0.0 { (moment / area).as_vec3() } else { Vec3::ZERO },
        uv_box: if count > 0 { (low, high) } else { (Vec2::ZERO, Vec2::ZERO) },
    }
}

impl Percentiles {
    fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self { p5: f(self.p5), p50: f(self.p50), p95: f(self.p95) }
    }
}

/// Percentiles of finite values by weight: the least value that, with all below, holds at least that share. Zeros
/// where there are no values.
fn percentiles(items: &[(f32, f32)]) -> Percentiles {
    let bins = Bins::new(items);
    let total: f64 = bins.weights.iter().sum();
    let at = |share: f64| bins.select(items, share * total);
    Percentiles { p5: at(0.05), p50: at(0.5), p95: at(0.95) }
}

const BINS: usize = 512;

/// A histogram of weighted values over equal steps from the least to the largest.
struct Bins {
    low: f32,
    high: f32,
    weights: [f64; BINS],
}

impl Bins {
    fn new(items: &[(f32, f32)]) -> Self {
        let (low, high) =
            items.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &(value, _)| {
                (low.min(value), high.max(value))
            });
        let mut bins = Self { low, high, weights: [0.0; BINS] };
        let scale = bins.scale();
        for &(value, weight) in items {
            bins.weights[bins.bin(value, scale)] += f64::from(weight);
        }
        bins
    }

    fn scale(&self) -> f64 {
        (BINS - 1) as f64 / (f64::from(self.high) - f64::from(self.low)).max(f64::MIN_POSITIVE)
    }

    /// The least value is in the first bin, the largest in the last, and bins are in the order of their values.
    fn bin(&self, value: f32, scale: f64) -> usize {
        ((f64::from(value) - f64::from(self.low)) * scale) as usize & (BINS - 1)
    }

    fn select(&self, items: &[(f32, f32)], target: f64) -> f32 {
        if items.is_empty() {
            return 0.0;
        }
        if self.low == self.high {
            return self.low;
        }
        let mut below = 0.0;
        let mut wanted = BINS - 1;
        for (bin, &weight) in self.weights.iter().enumerate() {
            if weight > 0.0 {
                wanted = bin;
                if below + weight >= target {
                    break;
                }
                below += weight;
            }
        }
        let scale = self.scale();
        let mut inside: Vec<(f32, f32)> =
            items.iter().copied().filter(|&(value, _)| self.bin(value, scale) == wanted).collect();
        // The bins of the least and the largest value differ: what is inside is always less than all.
        if inside.len() > 4 * BINS && inside.len() < items.len() {
            return Self::new(&inside).select(&inside, target - below);
        }
        inside.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        for &(value, weight) in &inside {
            below += f64::from(weight);
            if below >= target {
                return value;
            }
        }
        inside.last().map_or(self.high, |item| item.0)
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
                assert!(below <= share * total + 1e-6 && upto >= share * total - 1e-6, "{share} {p}");
            }
        }
        assert_eq!(percentiles(&[(3.0, 1.0)]), Percentiles { p5: 3.0, p50: 3.0, p95: 3.0 });
        assert_eq!(percentiles(&[]), Percentiles::default());
    }
}

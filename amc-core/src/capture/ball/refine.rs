//! The refit: the edge found along rays across the outline, and circle or cone fitted to it.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::super::cone::{Cone, Lens, Sight, ray};
use super::{Mean, perceived};

/// Samples along a ray are half a pixel apart.
const STEP: f64 = 0.5;

/// The most rays across the outline.
const MOST_RAYS: usize = 720;

/// The least step in perceived brightness, of 1, that counts as an edge.
const LEAST_CONTRAST: f32 = 0.012;

/// A fit of the outline.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    pub(super) sight: Sight,
    /// Root mean square distance of the edge points that count, pixels.
    pub(super) residual: f64,
    /// The share of the outline inside of the picture where an edge was found on it.
    pub(super) support: f64,
}

impl Fit {
    /// To choose among fits: how much outline is explained, in pixels.
    pub(super) fn score(&self) -> f64 {
        let (_, radius) = self.sight.ball();
        self.support * self.support * radius.sqrt()
    }
}

/// An edge point of the outline.
#[derive(Clone, Copy)]
struct EdgePoint {
    azimuth: f64,
    at: DVec2,
}

/// Fits the outline from a guess; `None` where no ball is.
pub(super) fn refine(mean: &Mean<'_>, lens: Lens, guess: Sight) -> Option<Fit> {
    let (_, radius) = guess.ball();
    let wide = (0.05 * radius).max(2.0 * (mean.width().max(mean.height()) as f64 / 256.0).ceil()) + 1.0;
    let narrow = (0.015 * radius).clamp(3.0, 6.0);
    let mut sight = guess;
    // A wide search needs few rays; the last fit takes them all.
    for (window, most_rays) in [(wide, 120), ((wide * narrow).sqrt().max(narrow), 180), (narrow, 240)] {
        let (points, _) = edge_points(mean, &sight, window, most_rays);
        sight = fit(sight, lens, &points)?.0;
    }
    let (points, tried) = edge_points(mean, &sight, narrow, MOST_RAYS);
    let (sight, inliers, residual) = fit(sight, lens, &points)?;
    let support = inliers.len() as f64 / tried.max(1) as f64;
    let (_, radius) = sight.ball();
    // A third of the outline may do, where the light comes from one side; but it must reach around the ball.
    let fine = tried >= 16 && support > 0.3 && widest_gap(&inliers) < 0.68 * TAU;
    // Edges found anywhere in the window, as in a picture of noise, would lie 0.58 of it off.
    let most = (0.012 * radius).max(1.0).min(0.35 * narrow);
    let fine = fine && residual < most && radius > 3.0 && radius.is_finite();
    fine.then_some(Fit { sight, residual, support })
}

/// The largest part of a whole turn, radians, without an edge point. `points` come in order of azimuth.
fn widest_gap(points: &[EdgePoint]) -> f64 {
    let around = points.first().map(|point| point.azimuth + TAU);
    let next = points.iter().skip(1).map(|point| point.azimuth).chain(around);
    points.iter().zip(next).map(|(point, next)| next - point.azimuth).fold(0.0, f64::max)
}

/// The edge points within `window` pixels of the outline, and how many rays lay inside of the picture.
fn edge_points(mean: &Mean<'_>, sight: &Sight, window: f64, most_rays: usize) -> (Vec<EdgePoint>, usize) {
    let (_, radius) = sight.ball();
    let rays = ((TAU * radius / 2.0) as usize).clamp(48, most_rays);
    let found: Vec<Option<Option<EdgePoint>>> = (0..rays)
        .into_par_iter()
        .map(|k| {
            let azimuth = TAU * k as f64 / rays as f64;
            let (at, outwards) = sight.outline(azimuth)?;
            let profile = Profile::along(mean, at, outwards, window)?;
            let offset = if mean.covered { profile.covered_edge() } else { profile.edge() };
            Some(offset.map(|offset| EdgePoint { azimuth, at: at + outwards * offset }))
        })
        .collect();
    let tried = found.iter().flatten().count();
    (found.into_iter().flatten().flatten().collect(), tried)
}

/// The mean picture along a ray across the outline, from inside to outside.
struct Profile {
    samples: Vec<[f32; 3]>,
    /// The first sample's offset from the outline, pixels.
    start: f64,
}

/// How far the profile reaches beyond the window, in samples: what the derivative needs.
const MARGIN: usize = 6;

impl Profile {
    /// `None` where the window leaves the picture. Beyond the window the picture's last pixels are repeated.
    fn along(mean: &Mean<'_>, at: DVec2, outwards: DVec2, window: f64) -> Option<Self> {
        let half = (window / STEP).ceil() as usize + MARGIN;
        let start = -(half as f64) * STEP;
        let last = mean.sample(at + outwards * (window.min(2.0)))?;
        mean.sample(at - outwards * window)?;
        let mut samples = Vec::with_capacity(2 * half + 1);
        for k in 0..=2 * half {
            let offset = start + k as f64 * STEP;
            let sample = mean.sample(at + outwards * offset);
            samples.push(sample.unwrap_or_else(|| samples.last().copied().unwrap_or(last)));
        }
        Some(Self { samples, start })
    }

    /// The offset of the steepest change, all three channels together; in linear light, where a pixel half covered
    /// has half the light.
    fn edge(&self) -> Option<f64> {
        // The derivative of a Gaussian of one pixel.
        let kernel: [f32; 2 * MARGIN + 1] = std::array::from_fn(|k| {
            let x = (k as f32 - MARGIN as f32) * STEP as f32;
            x * (-x * x / 2.0).exp()
        });
        let slope = |k: usize| -> f32 {
            let part = &self.samples[k - MARGIN..=k + MARGIN];
            let of =
                |c: usize| part.iter().zip(kernel).map(|(sample, weight)| sample[c] * weight).sum::<f32>();
            (0..3).map(of).map(|d| d * d).sum::<f32>().sqrt()
        };
        let last = self.samples.len() - MARGIN;
        let slopes: Vec<f32> = (MARGIN..last).map(slope).collect();
        let (k, &most) = slopes.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
        if k == 0 || k + 1 == slopes.len() || most <= 0.0 || self.contrast(k + MARGIN) < LEAST_CONTRAST {
            return None;
        }
        let (before, after) = (slopes[k - 1], slopes[k + 1]);
        let bend = before - 2.0 * most + after;
        let shift = if bend < 0.0 { f64::from((before - after) / (2.0 * bend)) } else { 0.0 };
        Some(self.start + ((k + MARGIN) as f64 + shift) * STEP)
    }

    /// The step in perceived brightness from 1 to 2.5 pixels before a sample to as much after it.
    fn contrast(&self, k: usize) -> f32 {
        let mean = |range: std::ops::Range<usize>, c: usize| {
            let count = range.len() as f32;
            perceived(range.map(|k| self.samples[k.min(self.samples.len() - 1)][c]).sum::<f32>() / count)
        };
        (0..3)
            .map(|c| (mean(k + 2..k + 6, c) - mean(k.saturating_sub(5)..k.saturating_sub(1), c)).abs())
            .fold(0.0, f32::max)
    }

    /// The offset of the edge of coverage, 1 inside and 0 outside: as long as the covered part of the ray is.
    fn covered_edge(&self) -> Option<f64> {
        let (first, last) = (self.samples.first()?[0], self.samples.last()?[0]);
        if first < 0.9 || last > 0.1 {
            return None;
        }
        let length: f32 = self.samples.iter().map(|sample| sample[0]).sum();
        // Half of the first sample's cell lies before the profile's start.
        Some(self.start + (f64::from(length) - 0.5) * STEP)
    }
}

/// Fits to edge points, again and again with those far off counting less (Tukey's biweight). Gives the fit, the
/// points that count, and their root mean square distance.
fn fit(start: Sight, lens: Lens, points: &[EdgePoint]) -> Option<(Sight, Vec<EdgePoint>, f64)> {
    if points.len() < 8 {
        return None;
    }
    let mut sight = start;
    let mut scale = f64::MAX;
    for _ in 0..12 {
        let misses: Vec<f64> = points.iter().map(|point| -sight.depth(point.at)).collect();
        scale = spread_of(&misses);
        let (moved, by) = step(sight, lens, points, &misses, scale)?;
        sight = moved;
        if by < 1e-4 {
            break;
        }
    }
    let kept: Vec<EdgePoint> =
        points.iter().copied().filter(|point| weight(sight.depth(point.at), scale) > 0.0).collect();
    let squares: f64 = kept.iter().map(|point| sight.depth(point.at).powi(2)).sum();
    let residual = (squares / kept.len().max(1) as f64).sqrt();
    Some((sight, kept, residual))
}

/// 1.48 times the median distance, the standard deviation of what is not an outlier; at least a tenth of a pixel.
fn spread_of(misses: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = misses.iter().map(|miss| miss.abs()).collect();
    let middle = sizes.len() / 2;
    let median = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
    (1.4826 * median).max(0.1)
}

/// Tukey's biweight at 4.7 standard deviations.
fn weight(miss: f64, scale: f64) -> f64 {
    let at = miss / (4.7 * scale);
    if at.abs() < 1.0 { (1.0 - at * at).powi(2) } else { 0.0 }
}

/// One step of Gauss and Newton, and how many pixels it moves the outline by, about.
fn step(sight: Sight, lens: Lens, points: &[EdgePoint], misses: &[f64], scale: f64) -> Option<(Sight, f64)> {
    let mut normal_matrix = DMat3::ZERO;
    let mut right = DVec3::ZERO;
    for (point, &miss) in points.iter().zip(misses) {
        // How the distance from the outline changes as the centre moves and the radius grows.
        let row = match (&sight, lens) {
            (Sight::Parallel { centre, .. }, _) => (point.at - *centre).normalize_or(DVec2::X).extend(1.0),
            (Sight::Cone(cone), Lens::Pinhole { focal, centre }) => {
                let local = cone.local(ray(focal, centre, point.at));
                DVec2::new(local.x, local.y).normalize_or(DVec2::X).extend(1.0) * cone.scale(point.at)
            }
            (Sight::Cone(_), Lens::Orthographic) => return None,
        };
        let weighted = row * weight(miss, scale);
        normal_matrix += DMat3::from_cols(row * weighted.x, row * weighted.y, row * weighted.z);
        right += weighted * miss;
    }
    let size = normal_matrix.x_axis.x + normal_matrix.y_axis.y + normal_matrix.z_axis.z;
    let determinant = normal_matrix.determinant();
    if determinant.is_nan() || determinant <= 1e-9 * size.powi(3) {
        return None;
    }
    let change = normal_matrix.inverse() * right;
    match sight {
        Sight::Parallel { centre, radius } => {
            let radius = radius + change.z;
            let moved = Sight::Parallel { centre: centre + change.truncate(), radius };
            (radius > 1.0).then_some((moved, change.length()))
        }
        Sight::Cone(cone) => {
            let Lens::Pinhole { focal, .. } = lens else { return None };
            Some((Sight::Cone(cone.moved(change)?), change.length() * focal))
        }
    }
}

impl Cone {
    /// The cone whose direction is moved by `change.xy` radians along the axes about c, its half-angle by `change.z`.
    fn moved(&self, change: DVec3) -> Option<Self> {
        let towards = (self.towards() + self.carried(change.truncate().extend(0.0))).try_normalize()?;
        let half_angle = self.half_angle() + change.z;
        let fine = towards.z < -0.01 && half_angle > 1e-4 && half_angle < 1.5;
        fine.then(|| self.with(towards, half_angle))
    }
}

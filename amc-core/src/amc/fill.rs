//! Texels that nobody measured: off the unit disc, or unseen by the camera.
//!
//! In the fourth channel 0 means that a texel holds nothing, [`FILLED`] that it was filled from its neighbours, and 1
//! that it was measured (or worked out from texels that all were).

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::{LinearTable, TableSize};
use crate::{Error, Result};

/// The fourth channel of a texel that was filled in. Above 0, so that no picture editor drops its colour.
pub const FILLED: f32 = 128.0 / 255.0;

impl TableSize {
    /// Whether the centre of column `i`, row `j` lies on the unit disc, where normals are.
    pub fn is_on_disc(self, i: u32, j: u32) -> bool {
        self.normal_xy(i, j).length_squared() <= 1.0
    }

    /// For every texel of a slice whether its centre lies on the unit disc, row by row.
    pub(super) fn disc(self) -> Vec<bool> {
        let texels = (0..self.side()).flat_map(|j| (0..self.side()).map(move |i| (i, j)));
        texels.map(|(i, j)| self.is_on_disc(i, j)).collect()
    }
}

impl LinearTable {
    /// Fills every texel that holds nothing (fourth channel 0): on the disc by growing the neighbours in the same slice,
    /// then, where a slice holds nothing at all, from the nearest slices before and after it along the azimuth; then all
    /// texels off the disc from its rim.
    ///
    /// Within a slice first, because a texel hidden in one picture is seen in others only for *another* tangent.
    ///
    /// # Errors
    /// No texel on the disc holds anything.
    pub fn fill(&mut self) -> Result<()> {
        let disc = self.size.disc();
        let side = self.size.side() as usize;
        let holds: Vec<bool> =
            self.texels.par_chunks_mut(side * side).map(|slice| grow(slice, &disc, side)).collect();
        if !holds.contains(&true) {
            return Err(Error::invalid("no texel of the table was measured"));
        }
        self.fill_empty_slices(&holds);
        self.fill_off_disc();
        Ok(())
    }

    /// Fills all texels off the unit disc from the disc's rim, so that filtering at a silhouette stays inside: each gets
    /// the colour of the rim point on its radius, found from the texels on the disc nearby.
    pub fn fill_off_disc(&mut self) {
        let sources = rim_sources(self.size, &self.size.disc());
        self.texels.par_chunks_mut(self.size.slice_texels()).for_each(|slice| {
            for source in &sources {
                slice[source.texel] = source.colour(slice);
            }
        });
    }

    fn fill_empty_slices(&mut self, holds: &[bool]) {
        let (count, texels) = (holds.len(), self.size.slice_texels());
        for s in (0..count).filter(|&s| !holds[s]) {
            let held = |step: &usize| holds[(s + step) % count];
            let (Some(after), Some(before)) = ((1..count).find(held), (1..count).rev().find(held)) else {
                continue;
            };
            let back = count - before;
            let share = back as f32 / (back + after) as f32;
            let (before, after) = ((s + before) % count * texels, (s + after) % count * texels);
            for k in 0..texels {
                let (a, b) = (self.texels[before + k], self.texels[after + k]);
                let mut mixed: [f32; 4] = std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share);
                mixed[3] = FILLED;
                self.texels[s * texels + k] = mixed;
            }
        }
    }
}

/// Grows the texels that hold something over those on the disc that do not, ring by ring, each the mean of its
/// neighbours; whether there was anything to grow.
fn grow(slice: &mut [[f32; 4]], disc: &[bool], side: usize) -> bool {
    // Off the disc nothing counts as known: what stands there is background.
    let mut known: Vec<bool> = slice.iter().zip(disc).map(|(texel, &on)| on && texel[3] > 0.0).collect();
    if !known.contains(&true) {
        return false;
    }
    let mut waiting: Vec<bool> = disc.iter().zip(&known).map(|(&on, &known)| on && !known).collect();
    let mut ring: Vec<usize> =
        (0..slice.len()).filter(|&k| waiting[k] && around(side, k).any(|near| known[near])).collect();
    ring.iter().for_each(|&k| waiting[k] = false);
    while !ring.is_empty() {
        let means: Vec<_> = ring.iter().map(|&k| neighbour_mean(slice, &known, side, k)).collect();
        for (&k, mean) in ring.iter().zip(means) {
            slice[k] = mean.unwrap_or(slice[k]);
            known[k] = true;
        }
        // Only beside what has just become known can the next ring be: every texel is looked at once, however large
        // the hole.
        let beside = ring.iter().flat_map(|&k| around(side, k));
        ring = beside.filter(|&near| std::mem::take(&mut waiting[near])).collect();
    }
    true
}

/// A texel and its up to eight neighbours.
fn around(side: usize, k: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (k % side, k / side);
    let near = move |at: usize| at.saturating_sub(1)..(at + 2).min(side);
    near(y).flat_map(move |y| near(x).map(move |x| y * side + x))
}

/// The mean of the known ones among the eight neighbours, the diagonal ones at 1/sqrt 2.
fn neighbour_mean(slice: &[[f32; 4]], known: &[bool], side: usize, k: usize) -> Option<[f32; 4]> {
    let (mut sum, mut weights) = ([0.0f32; 3], 0.0f32);
    for near in around(side, k).filter(|&near| known[near]) {
        let straight = near % side == k % side || near / side == k / side;
        let weight = if straight { 1.0 } else { std::f32::consts::FRAC_1_SQRT_2 };
        weights += weight;
        for (sum, value) in sum.iter_mut().zip(slice[near]) {
            *sum += weight * value;
        }
    }
    (weights > 0.0).then(|| [sum[0] / weights, sum[1] / weights, sum[2] / weights, FILLED])
}

/// What an unknown texel near the rim is made of: known texels of the same slice, and their coefficients.
#[derive(Debug)]
pub(crate) struct RimSource {
    /// The unknown texel's place in a slice.
    pub(crate) texel: usize,
    /// The known ones' places, and their coefficients, which add up to 1; some may be below 0.
    pub(crate) taps: Vec<(usize, f32)>,
}

impl RimSource {
    /// The sum of the taps, kept within three times the tapped colours' range, and from going below 0.
    pub(crate) fn colour(&self, slice: &[[f32; 4]]) -> [f32; 4] {
        let mut colour = [0.0, 0.0, 0.0, FILLED];
        for (c, value) in colour[..3].iter_mut().enumerate() {
            let (mut sum, mut low, mut high) = (0.0f32, f32::INFINITY, f32::NEG_INFINITY);
            for &(index, weight) in &self.taps {
                let tapped = slice[index][c];
                sum += weight * tapped;
                low = low.min(tapped);
                high = high.max(tapped);
            }
            let room = high - low;
            *value = sum.clamp(low - room, high + room).max(0.0);
        }
        colour
    }
}

/// What each texel that is not `known` (row by row) is made of, as far as there are known ones within four texels of
/// it, or of the rim point on its radius where it lies off the disc.
pub(crate) fn rim_sources(size: TableSize, known: &[bool]) -> Vec<RimSource> {
    let side = size.side() as usize;
    let unknown = (0..known.len()).into_par_iter().filter(|&k| !known[k]);
    unknown
        .map(|k| {
            let xy = size.normal_xy((k % side) as u32, (k / side) as u32).as_dvec2();
            RimSource { texel: k, taps: rim_taps(size, known, xy / xy.length().max(1.0)) }
        })
        .filter(|source| !source.taps.is_empty())
        .collect()
}

/// A known texel near a point of the disc.
struct Near {
    index: usize,
    weight: f64,
    /// 1, by how much its `n_z` differs from the point's, and its offset along the rim in texels: what the fit is
    /// linear in.
    terms: DVec3,
}

/// The coefficients that give the colour at a point at or near the rim. Towards the rim a reflectance is smooth in
/// `n_z`, not in the radius, so a weighted least-squares fit to the known texels nearby, linear in `n_z` and along the
/// rim, is read at the point's own `n_z`.
fn rim_taps(size: TableSize, known: &[bool], xy: DVec2) -> Vec<(usize, f32)> {
    let mut near = Vec::new();
    // Two texels around hold enough, but for tables of a few texels in all.
    for radius in [2.0, 3.0, 4.0] {
        near = nearby(size, known, xy, radius);
        if near.len() >= 6 {
            break;
        }
    }
    let mut normal = DMat3::from_diagonal(DVec3::new(0.0, 1e-4, 1e-4));
    for Near { weight, terms, .. } in &near {
        normal += DMat3::from_cols(*terms * terms.x, *terms * terms.y, *terms * terms.z) * *weight;
    }
    let total = normal.x_axis.x;
    // Too few for a slope: their mean.
    let row = if near.len() >= 6 { normal.inverse().x_axis } else { DVec3::X / total.max(f64::MIN_POSITIVE) };
    near.iter().map(|texel| (texel.index, (texel.weight * row.dot(texel.terms)) as f32)).collect()
}

fn nearby(size: TableSize, known: &[bool], xy: DVec2, radius: f64) -> Vec<Near> {
    let side = f64::from(size.side());
    let at = (xy + 1.0) / 2.0 * side - 0.5;
    let along_rim = xy.normalize_or_zero().perp();
    let range = |x: f64| {
        let bounded = |x: f64| x.clamp(0.0, side - 1.0) as u32;
        bounded((x - radius).ceil())..=bounded((x + radius).floor())
    };
    let mut near = Vec::new();
    for j in range(at.y) {
        for i in range(at.x) {
            let index = (j * size.side() + i) as usize;
            let offset = DVec2::new(f64::from(i), f64::from(j)) - at;
            let share = 1.0 - offset.length_squared() / (radius * radius);
            if share > 0.0 && known[index] {
                let further_in = n_z(size.normal_xy(i, j).as_dvec2()) - n_z(xy);
                let terms = DVec3::new(1.0, further_in, offset.dot(along_rim));
                near.push(Near { index, weight: share * share, terms });
            }
        }
    }
    near
}

fn n_z(xy: DVec2) -> f64 {
    (1.0 - xy.length_squared()).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amc::tests::table;

    #[test]
    fn no_background_is_left_after_filling() {
        for side in [2, 3, 8, 33] {
            let size = TableSize::new(side, 2).unwrap();
            // Garish background that must never show, a plain disc.
            let mut filled = table(side, 2, |i, j, _| {
                if size.is_on_disc(i, j) { [0.25, 0.5, 0.75, 1.0] } else { [99.0, 99.0, 99.0, 1.0] }
            });
            filled.fill().unwrap();
            for (k, texel) in filled.texels.iter().enumerate() {
                let on = size.disc()[k % size.slice_texels()];
                assert_eq!(texel[3], if on { 1.0 } else { FILLED });
                assert!(
                    (texel[0] - 0.25).abs() < 1e-6 && (texel[2] - 0.75).abs() < 1e-6,
                    "{side}: {texel:?}"
                );
            }
        }
    }

    #[test]
    fn a_texel_off_the_disc_takes_the_colour_of_its_radius() {
        // A colour that depends on the direction only: the fill must carry it outwards.
        let size = TableSize::new(64, 1).unwrap();
        let angle = |i, j| size.normal_xy(i, j).to_angle();
        let mut filled = table(64, 1, |i, j, _| [2.0 + angle(i, j).sin(), 2.0 + angle(i, j).cos(), 0.0, 1.0]);
        let truth = filled.clone();
        filled.fill().unwrap();
        for (a, b) in filled.texels.iter().zip(&truth.texels) {
            assert!((a[0] - b[0]).abs() < 0.04 && (a[1] - b[1]).abs() < 0.04, "{a:?} {b:?}");
        }
    }

    #[test]
    fn the_rim_is_found_from_what_is_smooth_in_n_z() {
        // Linear in n_z and around the disc: as steep as can be in the radius. The last half texel before the
        // rim is unknown too.
        let size = TableSize::new(64, 1).unwrap();
        let value = |xy: DVec2| 1.0 + n_z(xy) + 0.2 * xy.normalize_or_zero().x;
        let texels = (0..64u32 * 64).map(|k| size.normal_xy(k % 64, k / 64).as_dvec2());
        let known: Vec<bool> = texels.clone().map(|xy| xy.length() < 1.0 - 1.0 / 64.0).collect();
        let slice: Vec<[f32; 4]> = texels.clone().map(|xy| [value(xy) as f32, 0.0, 0.0, 1.0]).collect();
        let sources = rim_sources(size, &known);
        let mut checked = 0;
        for (source, xy) in sources.iter().map(|source| (source, texels.clone().nth(source.texel).unwrap())) {
            let expected = value(xy / xy.length().max(1.0));
            // The nearest known texels are up to 0.25 off; what is left is that colours may not leave thrice their range.
            assert!((f64::from(source.colour(&slice)[0]) - expected).abs() < 0.08, "{xy}");
            checked += 1;
        }
        // All of the square outside of the known disc.
        assert_eq!(checked, known.iter().filter(|known| !**known).count());
    }

    #[test]
    fn holes_are_grown_over_and_empty_slices_taken_from_their_neighbours() {
        let mut filled = table(16, 4, |i, j, s| {
            let hole = (6..9).contains(&i) && (5..9).contains(&j);
            match s {
                1 | 2 => [0.0; 4],
                _ if hole => [0.0; 4],
                _ => [s as f32, i as f32, 0.0, 1.0],
            }
        });
        filled.fill().unwrap();
        let inside = filled.texel(7, 7, 0);
        assert!((inside[1] - 7.0).abs() < 0.7 && inside[3] == FILLED, "{inside:?}");
        // Slices 1 and 2 lie at one and two thirds of the way from slice 0 to slice 3.
        assert!((filled.texel(3, 8, 1)[0] - 1.0).abs() < 1e-5);
        assert!((filled.texel(3, 8, 2)[0] - 2.0).abs() < 1e-5);
        assert_eq!(filled.texel(3, 8, 3), [3.0, 3.0, 0.0, 1.0]);
    }

    #[test]
    fn one_texel_fills_a_whole_disc_ring_by_ring() {
        let mut filled =
            table(
                33,
                1,
                |i, j, _| if (i, j) == (16, 16) { [0.5, 0.25, 2.0, 1.0] } else { [9.0, 9.0, 9.0, 0.0] },
            );
        filled.fill().unwrap();
        for (k, texel) in filled.texels.iter().enumerate() {
            assert!((texel[0] - 0.5).abs() < 1e-4 && (texel[2] - 2.0).abs() < 1e-3, "{k}: {texel:?}");
        }
    }

    #[test]
    fn a_table_that_holds_nothing_is_refused() {
        assert!(table(4, 2, |_, _, _| [0.0; 4]).fill().is_err());
    }
}

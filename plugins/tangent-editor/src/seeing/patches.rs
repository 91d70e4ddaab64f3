//! A weave along a direction that varies: in patches, each woven straight.
//!
//! No weave follows every field: where a field turns, threads would have to come closer or end. So each patch is woven true to count, and is
//! laid so that its threads meet those of the patch it was reached from.

use std::collections::VecDeque;

use amc_core::Result;
use amc_core::color::LINEAR_FROM_SRGB8;
use amc_core::render::Level;
use glam::{Affine2, Vec2};

use super::convolution::hash;
use super::{Field, Weave};

/// Threads across a patch.
const THREADS: f32 = 10.0;
/// Texels across a thread, at least.
const TEXELS: f32 = 6.0;

/// The weave as it can be drawn in texels of this side (metres): larger where it must be.
pub(super) fn drawable(weave: Weave, texel: f32) -> Weave {
    let least = TEXELS * texel * weave.ends.max(weave.picks) * 100.0;
    Weave { enlargement: weave.enlargement.max(least), ..weave }
}

/// The colour of every texel that the field reaches, linear; alpha is 0 elsewhere.
///
/// # Errors
/// As [`Weave::tile`].
pub(super) fn woven(field: &Field, weave: &Weave) -> Result<Vec<[f32; 4]>> {
    let grid = field.grid;
    let tile = weave.tile()?;
    let thread = weave.repeat_size() / weave.binding.repeat() as f32;
    // The level whose texels are as large as the picture's.
    let wanted = (32.0 * grid.texel / thread.max_element()).max(1.0).log2() as usize;
    let levels = tile.levels();
    let level = &levels[wanted.min(levels.len() - 1)];
    let patches = Patches::new(field, THREADS * thread.max_element() / grid.texel, weave);
    let pixel = |index: usize| {
        if !field.holds(index) {
            return [0.0; 4];
        }
        let at = Vec2::new((index % grid.width) as f32 + 0.5, (index / grid.width) as f32 + 0.5);
        let laying = patches.nearest(at);
        laying.map_or([0.0; 4], |laying| look_up(level, laying.transform_point2(grid.to_metres(at))))
    };
    Ok((0..grid.count()).map(pixel).collect())
}

/// A tile's colour, linear between texels.
fn look_up(level: &Level, at: Vec2) -> [f32; 4] {
    let size = Vec2::new(level.width as f32, level.height as f32);
    let from = at * size - 0.5;
    let share = from - from.floor();
    let texel = |x: f32, y: f32| {
        let wrap = |at: f32, size: u32| (at as i64).rem_euclid(i64::from(size)) as usize;
        let texel = level.texels[wrap(y, level.height) * level.width as usize + wrap(x, level.width)];
        texel.map(|byte| LINEAR_FROM_SRGB8[usize::from(byte)])
    };
    let mut mixed = [0.0, 0.0, 0.0, 1.0];
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let weight = (Vec2::new(x, y) - (Vec2::ONE - share)).abs();
        let colour = texel(from.x.floor() + x, from.y.floor() + y);
        for k in 0..3 {
            mixed[k] += colour[k] * weight.element_product();
        }
    }
    mixed
}

/// Patches round scattered middles.
struct Patches {
    /// Texels.
    side: f32,
    columns: usize,
    rows: usize,
    middles: Vec<Vec2>,
    /// From metres to the tile; none where there is no cloth.
    layings: Vec<Option<Affine2>>,
}

impl Patches {
    fn new(field: &Field, side: f32, weave: &Weave) -> Self {
        let grid = field.grid;
        let side = side.max(4.0);
        let count = |texels: usize| (texels as f32 / side).ceil().max(1.0) as usize;
        let (columns, rows) = (count(grid.width), count(grid.height));
        let middle = |k: usize| {
            let off = Vec2::new(hash(k as u32, 1), hash(k as u32, 2)) * 0.5 + 0.25;
            (Vec2::new((k % columns) as f32, (k / columns) as f32) + off) * side
        };
        let middles: Vec<Vec2> = (0..columns * rows).map(middle).collect();
        // Lines are summed by twice their angles.
        let mut sums = vec![Vec2::ZERO; middles.len()];
        for (index, d) in field.directions.iter().enumerate() {
            let (x, y) = ((index % grid.width) as f32 / side, (index / grid.width) as f32 / side);
            sums[y as usize * columns + x as usize] += Vec2::new(d.x * d.x - d.y * d.y, -2.0 * d.x * d.y);
        }
        let mut patches = Self { side, columns, rows, middles, layings: Vec::new() };
        patches.layings = patches.laid(field, &sums, weave);
        patches
    }

    /// From patch to patch, each so that its threads meet those of the one before in the middle between them.
    fn laid(&self, field: &Field, sums: &[Vec2], weave: &Weave) -> Vec<Option<Affine2>> {
        let line = |patch: usize| {
            (sums[patch].length() > 1e-3).then(|| Vec2::from_angle(sums[patch].to_angle() / 2.0))
        };
        let metres = |patch: usize| field.grid.to_metres(self.middles[patch]);
        let mut layings: Vec<Option<Affine2>> = vec![None; self.middles.len()];
        let mut along = vec![Vec2::ZERO; self.middles.len()];
        for first in 0..self.middles.len() {
            let Some(start) = line(first).filter(|_| layings[first].is_none()) else { continue };
            (along[first], layings[first]) = (start, Some(weave.laying(start)));
            let mut open = VecDeque::from([first]);
            while let Some(patch) = open.pop_front() {
                let Some(known) = layings[patch] else { continue };
                for next in self.neighbours(patch) {
                    let Some(way) = line(next).filter(|_| layings[next].is_none()) else { continue };
                    let way = if way.dot(along[patch]) < 0.0 { -way } else { way };
                    let between = (metres(patch) + metres(next)) / 2.0;
                    let laying = weave.laying(way);
                    let off = known.transform_point2(between) - laying.transform_point2(between);
                    (along[next], layings[next]) = (way, Some(Affine2::from_translation(off) * laying));
                    open.push_back(next);
                }
            }
        }
        layings
    }

    fn neighbours(&self, patch: usize) -> impl Iterator<Item = usize> {
        let (column, row) = (patch % self.columns, patch / self.columns);
        let (columns, rows) = (self.columns, self.rows);
        [(1, 0), (-1, 0), (0, 1), (0, -1)].into_iter().filter_map(move |(x, y)| {
            let column = column.checked_add_signed(x).filter(|&it| it < columns)?;
            let row = row.checked_add_signed(y).filter(|&it| it < rows)?;
            Some(row * columns + column)
        })
    }

    /// The laying of the patch with the nearest middle.
    fn nearest(&self, at: Vec2) -> Option<&Affine2> {
        let (column, row) = ((at.x / self.side) as usize, (at.y / self.side) as usize);
        let mut best: Option<(f32, &Affine2)> = None;
        for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                let patch = row * self.columns + column;
                let Some(laying) = &self.layings[patch] else { continue };
                let distance = self.middles[patch].distance_squared(at);
                if best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, laying));
                }
            }
        }
        best.map(|(_, laying)| laying)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::sheet;
    use super::super::{Field, Grid};
    use super::*;

    #[test]
    fn patches_of_a_constant_field_join_without_a_seam() {
        let (_, panel) = sheet(5, |p| p.extend(0.0));
        let grid = Grid::over(&panel, 0.004);
        let along = Vec2::from_angle(0.6);
        let field = Field::new(&panel, grid, &vec![along; panel.places.len()]);
        let weave = drawable(Weave::default(), grid.texel);
        assert!(weave.enlargement > 50.0);
        let woven = woven(&field, &weave).unwrap();
        let patches = Patches::new(&field, 40.0, &weave);
        let first = patches.layings.iter().flatten().next().unwrap();
        for laying in patches.layings.iter().flatten() {
            let off = laying.transform_point2(Vec2::ONE) - first.transform_point2(Vec2::ONE);
            assert!((off - off.round()).abs().max_element() < 1e-2, "{off}");
        }
        for (index, pixel) in woven.iter().enumerate() {
            assert_eq!(pixel[3] > 0.0, field.holds(index));
        }
    }

    #[test]
    fn patches_of_a_circular_field_follow_it() {
        let (_, panel) = sheet(33, |p| p.extend(0.0));
        let grid = Grid::over(&panel, 0.004);
        let around: Vec<Vec2> = panel.places.iter().map(|at| at.perp().normalize_or_zero()).collect();
        let field = Field::new(&panel, grid, &around);
        let weave = Weave { enlargement: 80.0, ..Weave::default() };
        let patches = Patches::new(&field, 20.0, &weave);
        for (middle, laying) in patches.middles.iter().zip(&patches.layings) {
            let at = grid.to_metres(*middle);
            let Some(laying) = laying.filter(|_| at.length() > 0.2) else { continue };
            // Along the warp the tile is passed down its rows only.
            let step = laying.transform_vector2(at.perp().normalize_or_zero()) * weave.repeat_size();
            assert!(step.x.abs() < 0.3 && (step.y.abs() - 1.0).abs() < 0.1, "{step} at {at}");
        }
    }
}

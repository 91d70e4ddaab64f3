//! Texels that no picture shows, filled from the disc's rim, so that filtering there finds no background.

use glam::Vec2;

use super::resample::Texel;
use crate::{Error, Result};

/// Which measured texels fill which others: the same in every slice.
pub(super) struct RimFill {
    /// Each filled texel's place in a slice, and where its sources end.
    filled: Vec<(u32, u32)>,
    /// A measured texel's index in the list of those seen, and its weight; a texel's weights sum to 1.
    sources: Vec<(u32, f32)>,
}

impl RimFill {
    /// How a filled texel is marked.
    pub(super) const ALPHA: f32 = 0.5;

    /// The fill for a table of `side`. A texel takes the colour found on the way from it to the disc's middle, where
    /// that way first meets what was measured: the transported azimuth is the same all along such a way.
    ///
    /// # Errors
    /// Nothing was measured.
    pub(super) fn new(side: u32, texels: &[Texel], measured: &[bool]) -> Result<Self> {
        let mut grid = vec![u32::MAX; side as usize * side as usize];
        for (k, texel) in texels.iter().enumerate().filter(|(k, _)| measured[*k]) {
            grid[(texel.j * side + texel.i) as usize] = k as u32;
        }
        let any = texels.iter().zip(measured).position(|(_, &measured)| measured);
        let Some(any) = any else {
            return Err(Error::invalid("no texel of the ball is seen in at least half of the pictures"));
        };
        let mut fill = Self { filled: Vec::new(), sources: Vec::new() };
        for at in (0..side * side).filter(|&at| grid[at as usize] == u32::MAX) {
            let found = inwards(&grid, side, at);
            if found.is_empty() {
                // A hole in the middle.
                fill.sources.push((nearest(texels, measured, side, at).unwrap_or(any as u32), 1.0));
            }
            fill.sources.extend(found);
            fill.filled.push((at, fill.sources.len() as u32));
        }
        Ok(fill)
    }

    /// Calls `set` with each filled texel's place in a slice and its sources.
    pub(super) fn each(&self, mut set: impl FnMut(usize, &[(u32, f32)])) {
        let mut start = 0;
        for &(at, end) in &self.filled {
            set(at as usize, &self.sources[start as usize..end as usize]);
            start = end;
        }
    }
}

/// The measured texels around the first point towards the middle that is surrounded by them at least by half.
fn inwards(grid: &[u32], side: u32, at: u32) -> Vec<(u32, f32)> {
    let middle = Vec2::splat((side as f32 - 1.0) / 2.0);
    let start = Vec2::new((at % side) as f32, (at / side) as f32);
    let distance = start.distance(middle);
    let step = (middle - start) / distance.max(1e-6) * 0.25;
    for k in 1..=(4.0 * distance) as u32 {
        let point = start + step * k as f32;
        let (x, y) = (point.x.floor(), point.y.floor());
        let (fx, fy) = (point.x - x, point.y - y);
        let mut sources = Vec::new();
        let corners = [
            (0, 0, (1.0 - fx) * (1.0 - fy)),
            (1, 0, fx * (1.0 - fy)),
            (0, 1, (1.0 - fx) * fy),
            (1, 1, fx * fy),
        ];
        for (dx, dy, weight) in corners {
            let (i, j) = (x as u32 + dx, y as u32 + dy);
            if i < side && j < side && weight > 0.0 {
                let texel = grid[(j * side + i) as usize];
                if texel != u32::MAX {
                    sources.push((texel, weight));
                }
            }
        }
        let sum: f32 = sources.iter().map(|(_, weight)| weight).sum();
        if sum >= 0.5 {
            return sources.into_iter().map(|(texel, weight)| (texel, weight / sum)).collect();
        }
    }
    Vec::new()
}

fn nearest(texels: &[Texel], measured: &[bool], side: u32, at: u32) -> Option<u32> {
    let distance = |texel: &Texel| {
        let (dx, dy) = (i64::from(texel.i) - i64::from(at % side), i64::from(texel.j) - i64::from(at / side));
        dx * dx + dy * dy
    };
    let there = texels.iter().enumerate().filter(|(k, _)| measured[*k]);
    there.min_by_key(|(_, texel)| distance(texel)).map(|(k, _)| k as u32)
}

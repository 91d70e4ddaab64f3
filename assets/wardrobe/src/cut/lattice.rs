//! Interior vertices on a regular lattice.

use std::collections::HashMap;

use glam::DVec2;

/// How close to a line an interior vertex may lie, in edge lengths.
const CLEARANCE: f64 = 0.6;

/// The points of a hexagonal lattice that lie inside the closed `polygon` and clear of all `strokes` and `dots`, row by row from below.
///
/// The lattice is symmetric about u = 0, so a symmetric piece is cut symmetrically.
pub(super) fn fill(
    polygon: &[DVec2],
    strokes: &[[DVec2; 2]],
    dots: &[DVec2],
    edge_length: f64,
) -> Vec<DVec2> {
    let near = Near::new(strokes, dots, edge_length);
    let row_height = edge_length * 3f64.sqrt() / 2.0;
    let low = polygon.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let high = polygon.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let rows = ((high - low) / row_height).ceil() as usize;
    // Half of what is over is left below, half above.
    let first = low + (high - low - rows as f64 * row_height) / 2.0;
    let mut points = Vec::new();
    for row in 0..=rows {
        let v = first + row as f64 * row_height;
        let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
        for within in crossings(polygon, v).chunks_exact(2) {
            let from = (within[0] / edge_length - shift).ceil() as i64;
            let to = (within[1] / edge_length - shift).floor() as i64;
            let on_row = (from..=to).map(|k| DVec2::new((k as f64 + shift) * edge_length, v));
            points.extend(on_row.filter(|&p| !near.closer(p, CLEARANCE * edge_length)));
        }
    }
    points
}

/// Where the line at height v crosses a closed polygon, rising.
fn crossings(polygon: &[DVec2], v: f64) -> Vec<f64> {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(next).filter(|(a, b)| (a.y > v) != (b.y > v));
    let mut all: Vec<f64> = crossed.map(|(a, b)| a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x)).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Finds what is near a point: strokes and dots by the cells of a grid.
struct Near<'a> {
    strokes: &'a [[DVec2; 2]],
    dots: &'a [DVec2],
    cell: f64,
    /// Indices of strokes, then of dots, by cell.
    cells: HashMap<(i64, i64), Vec<usize>>,
}

impl<'a> Near<'a> {
    fn new(strokes: &'a [[DVec2; 2]], dots: &'a [DVec2], cell: f64) -> Self {
        let mut near = Self { strokes, dots, cell, cells: HashMap::new() };
        for (i, ends) in strokes.iter().enumerate() {
            near.add(i, ends[0].min(ends[1]), ends[0].max(ends[1]));
        }
        for (i, dot) in dots.iter().enumerate() {
            near.add(strokes.len() + i, *dot, *dot);
        }
        near
    }

    fn add(&mut self, index: usize, low: DVec2, high: DVec2) {
        let (low, high) = (self.cell_of(low), self.cell_of(high));
        for i in low.0..=high.0 {
            for j in low.1..=high.1 {
                self.cells.entry((i, j)).or_default().push(index);
            }
        }
    }

    fn cell_of(&self, point: DVec2) -> (i64, i64) {
        ((point.x / self.cell).floor() as i64, (point.y / self.cell).floor() as i64)
    }

    /// Whether anything is closer to the point than `distance`, at most a cell's size.
    fn closer(&self, point: DVec2, distance: f64) -> bool {
        let (i, j) = self.cell_of(point);
        let around = (i - 1..=i + 1).flat_map(|i| (j - 1..=j + 1).map(move |j| (i, j)));
        let mut found = around.filter_map(|cell| self.cells.get(&cell)).flatten();
        found.any(|&index| self.distance(index, point) < distance)
    }

    fn distance(&self, index: usize, point: DVec2) -> f64 {
        match self.strokes.get(index) {
            Some([a, b]) => {
                let share = (point - *a).dot(*b - *a) / a.distance_squared(*b);
                let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
                a.lerp(*b, share).distance(point)
            }
            None => self.dots[index - self.strokes.len()].distance(point),
        }
    }
}

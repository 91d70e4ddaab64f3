//! Where the pieces lie on the sheet.

use glam::DVec2;

/// Width to height that a sheet should have.
const ASPECT: f64 = 1.6;

/// A box.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Extent {
    pub(super) fn size(&self) -> DVec2 {
        self.high - self.low
    }

    pub(super) fn middle(&self) -> DVec2 {
        self.low.midpoint(self.high)
    }
}

/// Where everything lies, in the sheet's units, the second coordinate downwards.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// The lower left corner of every piece's box.
    pub(super) places: Vec<DVec2>,
    pub(super) size: DVec2,
}

pub(super) fn extent(points: &[DVec2]) -> Extent {
    Extent {
        low: points.iter().copied().fold(DVec2::INFINITY, DVec2::min),
        high: points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max),
    }
}

/// Lays the pieces, each as large as given, in rows, in their order, with `gap` around each: of all row lengths the one that
/// comes nearest to the aspect.
pub(super) fn lay_out(sizes: &[DVec2], gap: f64) -> Layout {
    let mut width = gap;
    let mut best: Option<(f64, Layout)> = None;
    for size in sizes {
        width += size.x + gap;
        let layout = in_rows(sizes, width, gap);
        let miss = (layout.size.x / layout.size.y / ASPECT).ln().abs();
        if best.as_ref().is_none_or(|(least, _)| miss < *least) {
            best = Some((miss, layout));
        }
    }
    best.map_or(Layout { places: Vec::new(), size: DVec2::splat(gap) }, |(_, layout)| layout)
}

/// Pieces one above the other, the first lowest.
struct Column {
    pieces: Vec<usize>,
    size: DVec2,
}

/// Rows no longer than `width`. A piece goes on top of the one before it where both fit below the row's height.
fn in_rows(sizes: &[DVec2], width: f64, gap: f64) -> Layout {
    let mut rows: Vec<Vec<Column>> = Vec::new();
    let mut right = f64::INFINITY;
    for (i, &size) in sizes.iter().enumerate() {
        let height = rows.last().map_or(0.0, |row| row_height(row));
        if let Some(column) = rows.last_mut().and_then(|row| row.last_mut()) {
            let stacked = column.size.y + gap + size.y;
            if stacked <= height * 1.02 && size.x <= column.size.x * 1.02 {
                column.pieces.push(i);
                column.size.y = stacked;
                continue;
            }
        }
        if right + size.x + gap > width * (1.0 + 1e-9) {
            rows.push(Vec::new());
            right = gap;
        }
        right += size.x + gap;
        if let Some(row) = rows.last_mut() {
            row.push(Column { pieces: vec![i], size });
        }
    }
    place(&rows, sizes, gap)
}

fn row_height(row: &[Column]) -> f64 {
    row.iter().map(|column| column.size.y).fold(0.0, f64::max)
}

fn place(rows: &[Vec<Column>], sizes: &[DVec2], gap: f64) -> Layout {
    let mut places = vec![DVec2::ZERO; sizes.len()];
    let mut base = gap;
    let mut right: f64 = 0.0;
    for row in rows {
        base += row_height(row);
        let mut x = gap;
        for column in row {
            let mut y = base;
            for &i in &column.pieces {
                places[i] = DVec2::new(x, y);
                y -= sizes[i].y + gap;
            }
            x += column.size.x + gap;
        }
        right = right.max(x);
        base += gap;
    }
    Layout { places, size: DVec2::new(right, base) }
}

//! A cloth sheet that hangs in folds.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};

use super::grid::{self, Point};
use crate::mesh::Mesh;

/// The cloth as it is cut, metres.
const WIDTH: f64 = 2.1;
/// See [`WIDTH`].
const HEIGHT: f64 = 1.7;
/// How far its upper edge leans towards the viewer, radians: seen from a little above, the hem shows the folds.
const LEAN: f64 = 0.3;
/// Cells along the width and the height: 20,160 triangles.
const CELLS: [u32; 2] = [140, 72];
/// Steps of the sum that measures a row's length.
const STEPS: usize = 2048;

/// A sheet of 2.1 m x 1.7 m that faces +z and hangs from its upper edge; the folds deepen downwards. The grain u runs
/// across the folds, true to length on the cloth, v up.
pub(super) fn sheet() -> Mesh {
    let rows: Vec<Row> =
        (0..=CELLS[1]).map(|row| Row::new((f64::from(row) / f64::from(CELLS[1]) - 0.5) * HEIGHT)).collect();
    let lean = DQuat::from_rotation_x(LEAN);
    grid::mesh("sheet", CELLS, [false; 2], |s, t| {
        let u = (s - 0.5) * WIDTH;
        let row = &rows[((t * f64::from(CELLS[1])).round() as usize).min(rows.len() - 1)];
        let x = row.x(u);
        let (z, slope) = surface(x, row.y);
        Point {
            position: (lean * DVec3::new(x, row.y, z)).as_vec3(),
            normal: (lean * DVec3::new(-slope.x, -slope.y, 1.0).normalize()).as_vec3(),
            uv: DVec2::new(u, row.y).as_vec2(),
        }
    })
}

/// The depth of the cloth at (x, y), and its slopes along x and y.
fn surface(x: f64, y: f64) -> (f64, DVec2) {
    // Waves: length in metres, lean (x shift per metre down), phase in turns, amplitude at the top and at the bottom.
    const WAVES: [[f64; 5]; 4] = [
        [0.46, 0.06, 0.10, 0.020, 0.070],
        [0.71, -0.16, 0.35, 0.015, 0.050],
        [0.29, 0.10, 0.80, 0.002, 0.012],
        [1.90, 0.35, 0.60, 0.050, 0.090],
    ];
    let (mut z, mut slope) = (0.0, DVec2::ZERO);
    let down = 0.5 - y / HEIGHT;
    // Folds set in gently below the edge the sheet hangs from.
    let (depth, depth_dy) = (down * down * (3.0 - 2.0 * down), -6.0 * down * (1.0 - down) / HEIGHT);
    for [length, lean, phase, top, bottom] in WAVES {
        let (amplitude, amplitude_dy) = (top + (bottom - top) * depth, (bottom - top) * depth_dy);
        let (sin, cos) = (TAU * ((x + lean * y) / length + phase)).sin_cos();
        let turn = amplitude * cos * TAU / length;
        z += amplitude * sin;
        slope += DVec2::new(turn, turn * lean + amplitude_dy * sin);
    }
    (z, slope)
}

/// One row of the cloth: where on it each length along the thread is.
struct Row {
    y: f64,
    /// Lengths along the row at even steps of x from -WIDTH / 2 to WIDTH / 2, zero in the middle.
    lengths: Vec<f64>,
}

impl Row {
    fn new(y: f64) -> Self {
        let step = WIDTH / STEPS as f64;
        let mut lengths = Vec::with_capacity(STEPS + 1);
        let mut length = 0.0;
        for k in 0..=STEPS {
            lengths.push(length);
            // The slope in the middle of the step.
            let slope = surface((k as f64 + 0.5) * step - WIDTH / 2.0, y).1.x;
            length += slope.hypot(1.0) * step;
        }
        let middle = lengths[STEPS / 2];
        lengths.iter_mut().for_each(|length| *length -= middle);
        Self { y, lengths }
    }

    /// The x at which the cloth has run `u` along the row. The row is at least as long as it is wide, so it is there.
    fn x(&self, u: f64) -> f64 {
        let after = self.lengths.partition_point(|&length| length <= u).clamp(1, STEPS);
        let (low, high) = (self.lengths[after - 1], self.lengths[after]);
        let place = (after - 1) as f64 + (u - low) / (high - low);
        place * WIDTH / STEPS as f64 - WIDTH / 2.0
    }
}

//! Triangles assembled: every draw's vertices staged, clipped and brought to window space.

use rayon::prelude::*;

use super::clip::{Clipped, clip};
use super::fragment::Coat;
use super::raster::WindowTriangle;
use super::vertex::{Axis, Corner, VertexStage};
use crate::render::{Drawing, Shading, View};
use crate::{Error, Result};

/// Triangles that one task of the thread pool sets up.
const CHUNK: usize = 4096;

/// The triangles that may be seen, in drawing order, and the corners they refer to.
#[derive(Debug)]
pub(super) struct Assembly {
    /// The vertices, once for every axis in use, then those that clipping has made.
    pub(super) corners: Vec<Corner>,
    /// In drawing order.
    pub(super) triangles: Vec<WindowTriangle>,
}

/// A run of triangles of one draw.
#[derive(Debug, Clone, Copy)]
struct Run<'a> {
    triangles: &'a [[u32; 3]],
    draw: u32,
    /// Where the corners of this draw's axis begin.
    base: usize,
}

/// What one run has come to; indices from `corners` on are into `made`.
#[derive(Debug, Default)]
struct SetUp {
    triangles: Vec<WindowTriangle>,
    made: Vec<Corner>,
}

impl Assembly {
    /// Of a checked drawing; `coats` has one entry for each draw.
    pub(super) fn new(drawing: &Drawing, view: &View, shading: &Shading, coats: &[Coat]) -> Result<Self> {
        let axes: Vec<Option<Axis>> = coats.iter().map(|coat| coat.paint.axis(shading.cyclic)).collect();
        let mut distinct: Vec<Option<Axis>> = Vec::new();
        for axis in &axes {
            if !distinct.contains(axis) {
                distinct.push(*axis);
            }
        }
        let perspective = shading.perspective;
        let mut corners = Vec::new();
        for &axis in &distinct {
            corners.append(
                &mut VertexStage { view, perspective, axis }.run(&drawing.vertices, &drawing.tangents),
            );
        }
        let base_of = |axis: &Option<Axis>| {
            let position = distinct.iter().position(|other| other == axis).unwrap_or(0);
            position * drawing.vertices.len()
        };
        let runs: Vec<Run<'_>> = drawing
            .draws
            .iter()
            .zip(&axes)
            .enumerate()
            .flat_map(|(draw, (range, axis))| {
                let triangles =
                    &drawing.triangles[range.triangles.start as usize..range.triangles.end as usize];
                let base = base_of(axis);
                triangles.chunks(CHUNK).map(move |triangles| Run { triangles, draw: draw as u32, base })
            })
            .collect();
        let set_up: Vec<SetUp> = runs.par_iter().map(|run| run.set_up(&corners, view)).collect();
        Self::joined(corners, set_up)
    }

    fn joined(mut corners: Vec<Corner>, runs: Vec<SetUp>) -> Result<Self> {
        let staged = corners.len();
        let total = staged + runs.iter().map(|run| run.made.len()).sum::<usize>();
        if u32::try_from(total).is_err() {
            return Err(Error::too_large(format!("{total} vertices to draw, more than 32 bits can count")));
        }
        let mut triangles = Vec::with_capacity(runs.iter().map(|run| run.triangles.len()).sum());
        for mut run in runs {
            let shift = (corners.len() - staged) as u32;
            for mut triangle in run.triangles {
                for corner in &mut triangle.corners {
                    if *corner as usize >= staged {
                        *corner += shift;
                    }
                }
                triangles.push(triangle);
            }
            corners.append(&mut run.made);
        }
        Ok(Self { corners, triangles })
    }
}

impl Run<'_> {
    fn set_up(&self, corners: &[Corner], view: &View) -> SetUp {
        let mut result = SetUp { triangles: Vec::with_capacity(self.triangles.len()), made: Vec::new() };
        for triangle in self.triangles {
            let indices = triangle.map(|index| (self.base + index as usize) as u32);
            let [Some(a), Some(b), Some(c)] = indices.map(|index| corners.get(index as usize)) else {
                continue;
            };
            match clip([a, b, c]) {
                Clipped::Nothing => {}
                Clipped::Whole => {
                    let made = WindowTriangle::new([a, b, c], indices, self.draw, view.width, view.height);
                    result.triangles.extend(made);
                }
                Clipped::Polygon(polygon) => self.set_up_polygon(&polygon, corners.len(), view, &mut result),
            }
        }
        result
    }

    /// A polygon as a fan of triangles around its first corner.
    fn set_up_polygon(&self, polygon: &[Corner], staged: usize, view: &View, result: &mut SetUp) {
        let first = staged + result.made.len();
        for k in 1..polygon.len().saturating_sub(1) {
            let indices = [first, first + k, first + k + 1].map(|index| index as u32);
            let fan = [&polygon[0], &polygon[k], &polygon[k + 1]];
            result.triangles.extend(WindowTriangle::new(fan, indices, self.draw, view.width, view.height));
        }
        result.made.extend_from_slice(polygon);
    }
}

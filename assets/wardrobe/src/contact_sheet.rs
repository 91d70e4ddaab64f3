//! The contact sheet: every garment in every fabric from four sides, on one picture.

use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::direction::{Direction, tangents};
use amc_core::image::Picture;
use amc_core::mesh::Garment;
use amc_core::occlusion;
use amc_core::render::{Cloth, Drawing, Orientation, Shading, View, cpu};
use amc_core::{Progress, Result};

/// Columns and rows of one view, pixels.
#[derive(Debug, Clone, Copy)]
pub struct Tile {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// What is behind the garments, linear light.
const PAPER: [f32; 3] = [0.82, 0.81, 0.79];

/// A little from above, as one looks at a garment on a stand.
const PITCH: f32 = 0.12;

/// Front, left, back and right.
const SIDES: u32 = 4;

/// A row for each garment; in it, fabric by fabric, the garment from the front, its left, the back and its right, cut along
/// its grain.
///
/// # Errors
/// A garment that cannot be drawn, or somebody cancelled.
pub fn contact_sheet(
    garments: &[Garment],
    fabrics: &[Arc<Amc>],
    tile: Tile,
    progress: &Progress<'_>,
) -> Result<Picture> {
    let columns = SIDES * fabrics.len() as u32;
    let (width, height) = (tile.width * columns, tile.height * garments.len() as u32);
    let [r, g, b] = PAPER;
    let empty = vec![[r, g, b, 1.0]; width as usize * height as usize];
    let mut sheet = Picture::new(width, height, empty)?;
    for (row, garment) in garments.iter().enumerate() {
        progress.step("drawing the contact sheet", row, garments.len())?;
        let directions: Vec<Direction> = garment.panels.iter().map(Direction::along_grain).collect();
        let tangents = tangents(garment, &directions)?;
        let open = occlusion::compute(garment, occlusion::Options::default(), &Progress::none())?;
        for (place, fabric) in fabrics.iter().enumerate() {
            let drawing =
                Drawing::new(garment, tangents.vectors.clone(), Some(&open), vec![fabric.clone()], |_| {
                    Cloth::Fabric(0)
                })?;
            for side in 0..SIDES {
                let yaw = -FRAC_PI_2 * side as f32;
                let orientation = Orientation { yaw, pitch: PITCH, roll: 0.0 };
                let view = View::fitted(&garment.positions, orientation, tile.width, tile.height)?;
                let picture = cpu::render(&drawing, &view, &Shading::default(), progress)?;
                let column = place as u32 * SIDES + side;
                lay(&mut sheet, &picture, column * tile.width, row as u32 * tile.height);
            }
        }
    }
    Ok(sheet)
}

/// Lays a picture over the sheet at its place.
fn lay(sheet: &mut Picture, picture: &Picture, left: u32, top: u32) {
    let (width, across) = (sheet.width() as usize, picture.width() as usize);
    let rows = picture.pixels().chunks_exact(across);
    let places = sheet.pixels_mut().chunks_exact_mut(width).skip(top as usize);
    for (row, place) in rows.zip(places) {
        for (under, over) in place[left as usize..].iter_mut().zip(row) {
            for (under, over_colour) in under[..3].iter_mut().zip(over) {
                *under += (over_colour - *under) * over[3];
            }
        }
    }
}

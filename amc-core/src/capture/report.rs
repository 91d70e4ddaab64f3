//! What a build says about itself.

use serde::{Deserialize, Serialize};

use super::build::TexelFormat;
use super::session::Turn;
use super::symmetry::Similarity;
use crate::amc::{Frame, Symmetry};
use crate::view_space::Azimuth;

/// Where the ball is in the pictures. Pixel coordinates: (0, 0) is the top-left corner, pixel centres at +0.5.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ball {
    /// Column where the line to its centre meets the picture, pixels.
    pub x: f64,
    /// Row where the line to its centre meets the picture, pixels.
    pub y: f64,
    /// The outline's mean semi-axis, pixels.
    pub radius: f64,
    /// Root mean square distance of the outline found from the fit, pixels; nothing where the ball was given.
    pub residual: Option<f64>,
    /// Half-angle of the cone in which the camera sees the ball, degrees; 0 for parallel lines of sight.
    pub cone_half_angle_deg: f64,
}

/// What was built, from what, and what was measured on the way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BuildReport {
    /// How many pictures.
    pub pictures: usize,
    /// Columns and rows of each.
    pub picture_size: [u32; 2],
    /// Which way the ball was turned.
    pub turn: Turn,
    /// R: the table holds 1/R of a turn.
    pub symmetry: Symmetry,
    /// Whether the look stays the same all around the turn, but for noise. Then `symmetry` is 1.
    pub isotropic: bool,
    /// The measure for R = 2, 3 and 4; all 0 where the cloth is isotropic.
    pub similarity: Similarity,
    /// The threshold under which a symmetry was taken.
    pub threshold: f64,
    /// Standard deviation of the noise of one texel in one picture, in perceived (square root) brightness of 1.
    pub noise: f64,
    /// Where the ball is.
    pub ball: Ball,
    /// The share of the disc's texels that were measured; the others were filled in.
    pub coverage: f64,
    /// Columns and rows of the table.
    pub size: u32,
    /// Slices of the table.
    pub slices: u32,
    /// What its third axis means.
    pub azimuth: Azimuth,
    /// What its normals are relative to.
    pub frame: Frame,
    /// How its texels are kept.
    pub format: TexelFormat,
    /// What a person should know: files left out, gaps in the turn.
    pub notices: Vec<String>,
}

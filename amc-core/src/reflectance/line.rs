//! Line illumination: cloth as a sheet of fine straight fibres, each lit as a line.
//!
//! Source: W. Heidrich, H.-P. Seidel, "Efficient Rendering of Anisotropic Surfaces Using Computer Graphics Hardware",
//! 1998 ("the 1998 paper"). A line has a normal in every direction across it; the paper takes, for diffuse light, the
//! normal nearest to the light, and for the highlight the largest value over all of them (section 2, after Banks and
//! Stalling). Its text calls the latter the value at that same normal, which it is not.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{Parameters, Reflectance, check_amount};
use crate::amc::Symmetry;
use crate::{Error, Result};

/// A cloth of one set of fibres along the warp, or of two that cross.
///
/// Crossed fibres (section 4: one pass each, added) have their own weight, colours and exponent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Fibres along +x.
    pub warp: Option<Fibre>,
    /// Fibres along +y.
    pub weft: Option<Fibre>,
    /// Reflectance for ambient light, the paper's `k_a`. Apart from the fibres, because self-shadowing must not touch it.
    #[serde(default)]
    pub ambient: Vec3,
    /// Whether light is weighted by the cosine at the cloth and gone below it (section 3.1: `max(0, <N, L>)`; the paper
    /// prints -N, as its L runs from the light).
    #[serde(default = "yes")]
    pub self_shadow: bool,
}

/// One set of parallel fibres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fibre {
    /// The set's share of what is seen; multiplies both colours.
    #[serde(default = "one")]
    pub weight: f32,
    /// The paper's `k_d`: radiance per irradiance where the light is perpendicular to the fibre.
    pub diffuse: Vec3,
    /// The paper's `k_s`: radiance per irradiance at the top of the highlight.
    pub specular: Vec3,
    /// The paper's n: how narrow the highlight is; 1 or more.
    pub exponent: f32,
}

fn yes() -> bool {
    true
}

fn one() -> f32 {
    1.0
}

impl Fibre {
    /// Diffuse and specular light of a line along the unit vector `t` (1998 paper, section 2):
    /// `k_d sqrt(1 - (L.T)^2) + k_s max(0, V.R)^n` with `V.R = sqrt(1 - (L.T)^2) sqrt(1 - (V.T)^2) - (L.T)(V.T)`.
    fn line(&self, t: Vec3, to_light: Vec3, to_viewer: Vec3) -> Vec3 {
        let (light_along, viewer_along) = (to_light.dot(t), to_viewer.dot(t));
        let across = |along: f32| (1.0 - along * along).max(0.0).sqrt();
        let reflected = across(light_along) * across(viewer_along) - light_along * viewer_along;
        let highlight = reflected.clamp(0.0, 1.0).powf(self.exponent);
        (self.diffuse * across(light_along) + self.specular * highlight) * self.weight
    }

    fn check(&self, name: &str) -> Result<()> {
        check_amount(self.diffuse, &format!("parameters.{name}.diffuse"))?;
        check_amount(self.specular, &format!("parameters.{name}.specular"))?;
        let element = |key: &str| format!("parameters.{name}.{key}");
        if !(self.weight.is_finite() && self.weight >= 0.0) {
            let message = format!("{} must be 0 or more", self.weight);
            return Err(Error::invalid(message).at_element(element("weight")));
        }
        if !(self.exponent.is_finite() && self.exponent >= 1.0) {
            let message = format!("{} must be 1 or more", self.exponent);
            return Err(Error::invalid(message).at_element(element("exponent")));
        }
        Ok(())
    }
}

impl Reflectance for Line {
    fn reflect(&self, to_light: Vec3, to_viewer: Vec3) -> Vec3 {
        let shadow = if self.self_shadow { to_light.z.max(0.0) } else { 1.0 };
        if shadow == 0.0 {
            return Vec3::ZERO;
        }
        let along =
            |fibre: &Option<Fibre>, t| fibre.map_or(Vec3::ZERO, |fibre| fibre.line(t, to_light, to_viewer));
        (along(&self.warp, Vec3::X) + along(&self.weft, Vec3::Y)) * shadow
    }

    fn ambient(&self) -> Vec3 {
        self.ambient
    }

    fn symmetry(&self) -> Symmetry {
        // A line reversed is the same line; crossed fibres that are alike change places in a quarter turn.
        if self.warp == self.weft { Symmetry::Four } else { Symmetry::Two }
    }
}

impl Parameters for Line {
    fn check(&self) -> Result<()> {
        if self.warp.is_none() && self.weft.is_none() {
            return Err(Error::invalid("a cloth needs `warp` or `weft`, or both").at_element("parameters"));
        }
        for (fibre, name) in [(&self.warp, "warp"), (&self.weft, "weft")] {
            fibre.iter().try_for_each(|fibre| fibre.check(name))?;
        }
        check_amount(self.ambient, "parameters.ambient")
    }
}

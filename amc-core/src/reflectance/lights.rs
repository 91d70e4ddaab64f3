//! Distant lights, fixed before the camera.

use std::path::Path;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{VERSION, check_amount, from_json};
use crate::{Error, Result, file};

/// The lights a cloth is seen under. As a file: `{"version": 1, "lights": [..], "ambient": [r, g, b]}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lighting {
    /// The version of the JSON.
    #[serde(default = "version")]
    pub version: u32,
    /// Distant lights.
    pub lights: Vec<Light>,
    /// Radiance that comes from everywhere alike, linear Rec. 709.
    #[serde(default)]
    pub ambient: Vec3,
}

/// A distant light: parallel rays.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Light {
    /// Towards the light, in view space (+x right, +y up, +z to the viewer); any length but 0.
    pub towards: Vec3,
    /// Irradiance on a surface that faces it, linear Rec. 709.
    pub irradiance: Vec3,
}

fn version() -> u32 {
    VERSION
}

impl Lighting {
    /// Reads a lighting's file.
    ///
    /// # Errors
    /// As [`Lighting::parse`], or the file cannot be read; the error names the file.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = file::read(path, 16 << 20)?;
        let text = std::str::from_utf8(&bytes).map_err(|error| {
            Error::malformed("not text in UTF-8").at_byte(error.valid_up_to() as u64).in_file(path)
        })?;
        Self::parse(text).map_err(|error| error.in_file(path))
    }

    /// Parses a lighting.
    ///
    /// # Errors
    /// No such JSON (with line and column), another version, a direction without length, an amount below 0.
    pub fn parse(text: &str) -> Result<Self> {
        let lighting: Self = from_json(text)?;
        lighting.check()?;
        Ok(lighting)
    }

    pub(super) fn check(&self) -> Result<()> {
        if self.version != VERSION {
            let message = format!("version {} of a lighting; this program reads {VERSION}", self.version);
            return Err(Error::unsupported(message).at_element("lighting.version"));
        }
        check_amount(self.ambient, "ambient")?;
        for (k, light) in self.lights.iter().enumerate() {
            check_amount(light.irradiance, &format!("lights[{k}].irradiance"))?;
            if light.towards.try_normalize().is_none() {
                let message = format!("{} is no direction", light.towards);
                return Err(Error::invalid(message).at_element(format!("lights[{k}].towards")));
            }
        }
        Ok(())
    }
}

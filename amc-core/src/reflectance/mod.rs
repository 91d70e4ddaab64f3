//! Reflectances: how much light a cloth sends to the viewer, for light from any direction.
//!
//! A description is JSON: `{"version": 1, "model": "line", "name": .., "notes": .., "parameters": {..}, "lighting": {..}}`.
//! A model is one file here, with its parameters' type, and one line in [`MODELS`].

mod bundled;
mod lights;
mod line;
#[cfg(test)]
mod tests;

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};

pub use bundled::{BUNDLED, Bundled, bundled};
pub use lights::{Light, Lighting};
pub use line::{Fibre, Line};

use crate::amc::Symmetry;
use crate::{Error, Place, Result, file};

/// How a cloth reflects light. Directions are unit vectors in the cloth's frame: +z its normal, +x along the warp, +y
/// along the weft; they point away from the cloth.
pub trait Reflectance: std::fmt::Debug + Send + Sync {
    /// Radiance sent to `to_viewer` under light from the direction `to_light` that brings unit irradiance to a surface
    /// facing it; linear Rec. 709. The cosine at the cloth, where the model has one, is part of this. Either direction may
    /// lie below the cloth.
    fn reflect(&self, to_light: Vec3, to_viewer: Vec3) -> Vec3;

    /// Radiance sent to the viewer under ambient light of unit radiance.
    fn ambient(&self) -> Vec3;

    /// The largest R such that a turn by 1/R about the normal changes nothing.
    fn symmetry(&self) -> Symmetry;
}

/// A reflectance with its name, and perhaps the lights to see it under.
#[derive(Debug, Clone)]
pub struct Description {
    /// The model's name, as in the file.
    pub model: String,
    /// What people call the fabric.
    pub name: String,
    /// Words to find it by.
    pub tags: Vec<String>,
    /// Anything else worth saying.
    pub notes: String,
    /// The reflectance itself.
    pub reflectance: Arc<dyn Reflectance>,
    /// The lights it is meant to be seen under.
    pub lighting: Option<Lighting>,
}

/// A model: its name in files, and how a description of it is read.
type Model = (&'static str, fn(&str) -> Result<Description>);

/// The models that are known.
const MODELS: [Model; 1] = [("line", read_as::<Line>)];

/// The version of the JSON that is read.
const VERSION: u32 = 1;

/// The largest description that is read, in bytes.
const MOST_BYTES: u64 = 64 << 20;

/// What every description has, around its model's parameters.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document<Parameters> {
    version: u32,
    model: String,
    #[serde(default)]
    name: String,
    #[serde(default)]
    tags: Vec<String>,
    #[serde(default)]
    notes: String,
    parameters: Parameters,
    lighting: Option<Lighting>,
}

/// Reads a description's file.
///
/// # Errors
/// As [`parse`], or the file cannot be read; the error names the file.
pub fn read(path: &Path) -> Result<Description> {
    let bytes = file::read(path, MOST_BYTES)?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        Error::malformed("not text in UTF-8").at_byte(error.valid_up_to() as u64).in_file(path)
    })?;
    parse(text).map_err(|error| error.in_file(path))
}

/// Parses a description.
///
/// # Errors
/// No such JSON (with line and column), a version or model that is not known, or parameters out of their ranges.
pub fn parse(text: &str) -> Result<Description> {
    // First only as far as the model's name, then as that model's: so both passes know lines and columns.
    let document: Document<IgnoredAny> = from_json(text)?;
    if document.version != VERSION {
        let message = format!("version {} of a reflectance; this program reads {VERSION}", document.version);
        return Err(Error::unsupported(message).at_element("version"));
    }
    let model = MODELS.iter().find(|(name, _)| *name == document.model);
    let (_, read) = model.ok_or_else(|| {
        let known: Vec<&str> = MODELS.iter().map(|(name, _)| *name).collect();
        let message = format!("the model {:?} is not known; these are: {}", document.model, known.join(", "));
        Error::unsupported(message).at_element("model")
    })?;
    read(text)
}

/// A model's parameters, checked when they are read.
trait Parameters: Reflectance + DeserializeOwned + 'static {
    /// # Errors
    /// A parameter is out of its range; the error names it.
    fn check(&self) -> Result<()>;
}

fn read_as<P: Parameters>(text: &str) -> Result<Description> {
    let Document { model, name, tags, notes, parameters, lighting, .. } = from_json::<Document<P>>(text)?;
    parameters.check()?;
    if let Some(lighting) = &lighting {
        lighting.check()?;
    }
    Ok(Description { model, name, tags, notes, reflectance: Arc::new(parameters), lighting })
}

fn from_json<T: DeserializeOwned>(text: &str) -> Result<T> {
    serde_json::from_str(text).map_err(|error| {
        // serde_json ends its messages with the place; ours come first.
        let message = error.to_string();
        let what = message.split(" at line ").next().unwrap_or(&message).to_owned();
        Error::malformed(what).at(Place::LineColumn(error.line() as u64, error.column() as u64))
    })
}

/// Checks a colour or other triple: finite, and nowhere below 0.
fn check_amount(amount: Vec3, element: &str) -> Result<()> {
    if amount.is_finite() && amount.min_element() >= 0.0 {
        Ok(())
    } else {
        Err(Error::invalid(format!("{amount} must be three numbers of 0 or more")).at_element(element))
    }
}

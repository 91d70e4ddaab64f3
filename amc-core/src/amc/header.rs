//! What every file of an AMC says in JSON beside the texels, whatever holds them.

use serde_json::{Map, Value};

use super::{Amc, Frame, Metadata, Symmetry, TableSize, Texels};
use crate::view_space::Azimuth;
use crate::{Error, Place, Result};

/// The version of the JSON this program writes, and the latest it reads.
const VERSION: u64 = 1;

/// Keys that say how to read the table; all others are [`Metadata`].
const OWN_KEYS: [&str; 4] = ["version", "symmetry", "azimuth", "frame"];

/// How to read a table, and what is said about it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Header {
    pub(crate) symmetry: Symmetry,
    pub(crate) azimuth: Azimuth,
    pub(crate) frame: Frame,
    pub(crate) metadata: Metadata,
}

impl Header {
    pub(crate) fn of(amc: &Amc) -> Self {
        let Amc { symmetry, azimuth, frame, metadata, .. } = amc;
        Self { symmetry: *symmetry, azimuth: *azimuth, frame: *frame, metadata: metadata.clone() }
    }

    /// The JSON object: `version`, `symmetry`, `azimuth`, `frame`, then the metadata.
    pub(crate) fn to_json(&self) -> Result<Map<String, Value>> {
        let json = |error: serde_json::Error| Error::invalid(format!("the metadata is no JSON: {error}"));
        let mut map = Map::new();
        map.insert("version".into(), VERSION.into());
        map.insert("symmetry".into(), self.symmetry.order().into());
        map.insert("azimuth".into(), serde_json::to_value(self.azimuth).map_err(json)?);
        map.insert("frame".into(), serde_json::to_value(self.frame).map_err(json)?);
        if let Value::Object(metadata) = serde_json::to_value(&self.metadata).map_err(json)? {
            map.extend(metadata.into_iter().filter(|(key, _)| !OWN_KEYS.contains(&key.as_str())));
        }
        Ok(map)
    }

    /// Reads the JSON object; keys that are not known go to [`Metadata::other`].
    pub(crate) fn from_json(mut map: Map<String, Value>) -> Result<Self> {
        let mut take = |key: &str| {
            map.remove(key)
                .ok_or_else(|| Error::malformed(format!("the key `{key}` is missing")).at_element(key))
        };
        let [version, symmetry, azimuth, frame] =
            [take("version")?, take("symmetry")?, take("azimuth")?, take("frame")?];
        match version.as_u64() {
            Some(1..=VERSION) => {}
            Some(later) if later > VERSION => {
                let message = format!(
                    "version {later} was written by a later program; this one reads version {VERSION}"
                );
                return Err(Error::unsupported(message).at_element("version"));
            }
            _ => return Err(Error::malformed(format!("{version} is no version")).at_element("version")),
        }
        Ok(Self {
            symmetry: value("symmetry", symmetry)?,
            azimuth: value("azimuth", azimuth)?,
            frame: value("frame", frame)?,
            metadata: value("metadata", Value::Object(map))?,
        })
    }

    /// The AMC of these texels.
    pub(crate) fn amc(self, size: TableSize, texels: Texels) -> Result<Amc> {
        let mut amc = Amc::new(size, texels, self.symmetry, self.azimuth, self.frame)?;
        amc.metadata = self.metadata;
        Ok(amc)
    }
}

fn value<T: serde::de::DeserializeOwned>(key: &str, value: Value) -> Result<T> {
    serde_json::from_value(value).map_err(|error| Error::malformed(error.to_string()).at_element(key))
}

/// Parses a JSON object out of text; `what` names the text in the message.
pub(crate) fn parse_object(text: &[u8], what: &str) -> Result<Map<String, Value>> {
    serde_json::from_slice(text).map_err(|error| {
        let place = Place::LineColumn(error.line() as u64, error.column() as u64);
        Error::malformed(format!("{what}: {error}")).at(place)
    })
}

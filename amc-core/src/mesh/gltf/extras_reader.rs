//! Reading `extras`: whatever they hold, at worst a notice comes of it.

use gltf::json::Extras as Raw;
use serde::Deserialize;

use crate::mesh::check::list;
use crate::mesh::extras::{Extras, VERSION};

/// Reads extras, as long as their length is what the file's size justifies: those of a mesh are read once for each of
/// its instances.
pub(super) struct ExtrasReader {
    bytes_left: usize,
    faults: Vec<String>,
}

#[derive(Deserialize)]
struct Document {
    amc: Option<serde_json::Value>,
}

impl ExtrasReader {
    pub(super) fn new(bytes: usize) -> Self {
        Self { bytes_left: bytes, faults: Vec::new() }
    }

    /// What `raw`, the extras of `element`, says to us; nothing where it speaks to others only.
    pub(super) fn read(&mut self, raw: &Raw, element: impl FnOnce() -> String) -> Extras {
        let Some(text) = raw.as_ref().map(|raw| raw.get()) else { return Extras::default() };
        let Some(left) = self.bytes_left.checked_sub(text.len()) else {
            self.faults.push(format!("{}: too many copies", element()));
            return Extras::default();
        };
        self.bytes_left = left;
        let ours = serde_json::from_str::<Document>(text).ok().and_then(|document| document.amc);
        let Some(ours) = ours else { return Extras::default() };
        let read = serde_json::from_value::<Extras>(ours).map_err(|error| error.to_string());
        let read = read.and_then(|extras| match extras.version {
            Some(version) if version != VERSION => {
                Err(format!("version {version}; this program reads {VERSION}"))
            }
            _ => Ok(extras),
        });
        read.unwrap_or_else(|fault| {
            self.faults.push(format!("{}: {fault}", element()));
            Extras::default()
        })
    }

    /// What was passed over, in one line.
    pub(super) fn notice(&self) -> Option<String> {
        let faults = list(&self.faults, "; ");
        (!faults.is_empty()).then(|| format!("extras that cannot be read were passed over: {faults}"))
    }
}

//! Fabrics that come with the program, as descriptions to bake.

use super::{Description, parse};
use crate::{Error, Result};

/// A fabric that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bundled {
    /// Its name, as one word.
    pub name: &'static str,
    /// Its description (see [`parse`]): what a cache of the baked table may be keyed by.
    pub json: &'static str,
}

/// All of them; the first is the default.
pub const BUNDLED: [Bundled; 2] = [
    Bundled { name: "satin", json: include_str!("../../../assets/fabrics/satin.json") },
    Bundled { name: "changeant", json: include_str!("../../../assets/fabrics/changeant.json") },
];

/// The bundled fabric of this name.
///
/// # Errors
/// There is none of this name; the message lists those there are.
pub fn bundled(name: &str) -> Result<Bundled> {
    BUNDLED.into_iter().find(|fabric| fabric.name == name).ok_or_else(|| {
        let known: Vec<&str> = BUNDLED.iter().map(|fabric| fabric.name).collect();
        Error::invalid(format!("no fabric {name:?} is bundled; these are: {}", known.join(", ")))
    })
}

impl Bundled {
    /// The description, parsed.
    ///
    /// # Errors
    /// None, unless the program was built with a broken asset (a test parses them all).
    pub fn description(self) -> Result<Description> {
        parse(self.json)
    }
}

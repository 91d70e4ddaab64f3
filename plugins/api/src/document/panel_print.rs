//! Prints on panels.

use amc_core::render::Laying;
use amc_core::{Error, Result};
use serde::{Deserialize, Serialize};

use super::Asset;

/// A colour picture over a panel's fabric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PanelPrint {
    /// The picture's file.
    pub picture: Asset,
    /// How it lies on the cloth.
    pub laying: Laying,
}

impl PanelPrint {
    /// The widest a picture may be on the cloth, and the farthest it may be shifted, metres.
    pub const WIDEST: f32 = 100.0;

    /// The narrowest, metres.
    pub const NARROWEST: f32 = 1e-3;

    /// Whether it can be printed.
    ///
    /// # Errors
    /// It is no file, or too wide, too narrow or too far off.
    pub fn check(&self) -> Result<()> {
        self.picture.check_picture()?;
        let Laying { width, turn, shift, .. } = self.laying;
        if !(Self::NARROWEST..=Self::WIDEST).contains(&width) {
            let limits = format!("{} m to {} m", Self::NARROWEST, Self::WIDEST);
            return Err(Error::invalid(format!("the print is {width} m wide; it can be {limits} wide")));
        }
        if !turn.is_finite() || shift.abs().max_element() > Self::WIDEST || !shift.is_finite() {
            return Err(Error::invalid(format!(
                "the print is turned by {turn} and shifted by {shift}; at most {} m make sense",
                Self::WIDEST
            )));
        }
        Ok(())
    }
}

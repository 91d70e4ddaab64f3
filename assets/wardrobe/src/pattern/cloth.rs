//! How a cloth resists.

use serde::{Deserialize, Serialize};

/// How a cloth resists, and what it weighs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Cloth {
    /// Mass of a square metre, kilograms.
    pub density: f64,
    /// Tension per metre of width at full stretch along the warp, newtons per metre.
    pub warp: f64,
    /// The same along the weft.
    pub weft: f64,
    /// Resistance to shear between warp and weft, newtons per metre.
    pub shear: f64,
    /// Bending stiffness, newton metres.
    pub bending: f64,
    /// Coulomb friction with the body and with itself.
    pub friction: f64,
    /// Thickness, metres.
    pub thickness: f64,
}

impl Default for Cloth {
    /// A plain cotton shirting: figures of the order that fabric tests (KES, FAST) give.
    fn default() -> Self {
        Self {
            density: 0.13,
            warp: 2000.0,
            weft: 1500.0,
            shear: 60.0,
            bending: 8e-6,
            friction: 0.3,
            thickness: 0.0006,
        }
    }
}

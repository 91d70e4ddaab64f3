//! What a mesh file's numbers mean.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::{Error, Result};

/// The length that a mesh file's 1 stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Unit {
    /// 1 m: the default, and what glTF demands.
    #[default]
    #[serde(rename = "m")]
    Metre,
    /// 0.1 m: MakeHuman.
    #[serde(rename = "dm")]
    Decimetre,
    /// 0.01 m.
    #[serde(rename = "cm")]
    Centimetre,
    /// 0.001 m: most pattern programs.
    #[serde(rename = "mm")]
    Millimetre,
}

impl Unit {
    /// All units, largest first.
    pub const ALL: [Self; 4] = [Self::Metre, Self::Decimetre, Self::Centimetre, Self::Millimetre];

    /// Its length in metres.
    pub fn metres(self) -> f32 {
        match self {
            Self::Metre => 1.0,
            Self::Decimetre => 0.1,
            Self::Centimetre => 0.01,
            Self::Millimetre => 0.001,
        }
    }

    /// Its symbol: `m`, `dm`, `cm` or `mm`.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Decimetre => "dm",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

impl FromStr for Unit {
    type Err = Error;

    fn from_str(symbol: &str) -> Result<Self> {
        Self::ALL
            .into_iter()
            .find(|unit| unit.symbol() == symbol)
            .ok_or_else(|| Error::invalid(format!("no such unit: {symbol}; the units are m, dm, cm and mm")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_read_as_it_is_written() {
        for unit in Unit::ALL {
            assert_eq!(unit.to_string().parse::<Unit>().unwrap(), unit);
        }
        assert!("inch".parse::<Unit>().unwrap_err().to_string().contains("inch"));
    }
}

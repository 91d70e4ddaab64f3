//! In which turns a piece may be laid on the cloth.

use serde::{Deserialize, Serialize};

/// In which turns a piece may be laid on the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Orientation {
    /// As it is drawn, and turned by 180 degrees: the cloth looks the same both ways.
    #[default]
    TwoWay,
    /// Only as it is drawn, each piece for itself: the cloth has an up and a down.
    OneWay,
    /// Only one way, the same for all pieces: a pile or a nap lies all one way.
    Nap,
}

impl Orientation {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::TwoWay, Self::OneWay, Self::Nap];

    /// As files and the command line name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::TwoWay => "two-way",
            Self::OneWay => "one-way",
            Self::Nap => "nap",
        }
    }

    /// The one of this [name](Self::name).
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|orientation| orientation.name() == name)
    }
}

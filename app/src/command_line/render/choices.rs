//! What can be chosen by name.

use amc_core::render::{Cyclic, Perspective};
use clap::ValueEnum;
use studio_plugin::document::NamedView;

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum CyclicChoice {
    Naive,
    Cyclic,
    Fragment,
}

impl From<CyclicChoice> for Cyclic {
    fn from(choice: CyclicChoice) -> Self {
        match choice {
            CyclicChoice::Naive => Self::Naive,
            CyclicChoice::Cyclic => Self::Cyclic,
            CyclicChoice::Fragment => Self::Fragment,
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum PerspectiveChoice {
    Off,
    Paper,
    Full,
    Half,
}

impl From<PerspectiveChoice> for Perspective {
    fn from(choice: PerspectiveChoice) -> Self {
        match choice {
            PerspectiveChoice::Off => Self::Off,
            PerspectiveChoice::Paper => Self::Paper,
            PerspectiveChoice::Full => Self::Full,
            PerspectiveChoice::Half => Self::Half,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Switch {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum ViewChoice {
    Front,
    Right,
    Back,
    Left,
    Top,
    Bottom,
}

impl From<ViewChoice> for NamedView {
    fn from(choice: ViewChoice) -> Self {
        match choice {
            ViewChoice::Front => Self::Front,
            ViewChoice::Right => Self::Right,
            ViewChoice::Back => Self::Back,
            ViewChoice::Left => Self::Left,
            ViewChoice::Top => Self::Top,
            ViewChoice::Bottom => Self::Bottom,
        }
    }
}

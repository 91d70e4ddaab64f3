//! What the form holds, kept with the person's settings.

use amc_core::color::LINEAR_FROM_SRGB8;
use amc_core::image::stream::Timing;
use amc_core::render::Shading;
use amc_core::{Error, Result};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use studio_plugin::document::NamedView;

use crate::pictures::{Kind, SIDE_LIMIT, Size};
use crate::studio::texts::export as texts;

/// What is exported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum What {
    #[default]
    Picture,
    /// A contact sheet.
    Views,
    Turn,
}

impl What {
    pub(super) const ALL: [Self; 3] = [Self::Picture, Self::Views, Self::Turn];

    /// Of its command and its question.
    pub(super) const fn id(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Views => "views",
            Self::Turn => "turn",
        }
    }

    pub(super) fn of(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|what| what.id() == id)
    }
}

/// What is behind the garment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Background {
    /// What the project's view says; where it says nothing, nothing.
    #[default]
    View,
    /// Nothing: transparent.
    None,
    /// sRGB.
    Colour([u8; 3]),
}

/// The sides a contact sheet can show, and what they are called, in the order that it shows them.
pub(super) const SIDES: [(NamedView, &str); 6] = [
    (NamedView::Front, texts::FRONT),
    (NamedView::Right, texts::RIGHT),
    (NamedView::Back, texts::BACK),
    (NamedView::Left, texts::LEFT),
    (NamedView::Top, texts::TOP),
    (NamedView::Bottom, texts::BOTTOM),
];

/// The form.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Settings {
    pub(super) what: What,
    /// Width and height in pixels of the picture, of a cell of the contact sheet, of a frame of the turn.
    pub(super) sizes: [[u32; 2]; 3],
    pub(super) background: Background,
    /// Four samples per pixel, or one.
    pub(super) smooth: bool,
    /// Which of [`SIDES`] the contact sheet shows.
    pub(super) sides: [bool; 6],
    pub(super) frames: u32,
    pub(super) per_second: u16,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            what: What::default(),
            sizes: [[2048, 2048], [1024, 1024], [640, 640]],
            background: Background::default(),
            smooth: true,
            sides: [true, true, true, true, false, false],
            frames: 72,
            per_second: 24,
        }
    }
}

impl Settings {
    /// What was kept, perhaps by another version.
    pub(super) fn restored(kept: Value) -> Result<Self> {
        let settings: Self = serde_json::from_value(kept)
            .map_err(|error| Error::malformed(format!("not the export's settings: {error}")))?;
        let sides = settings.sizes.as_flattened();
        let timing = Timing { frames: settings.frames, per_second: settings.per_second };
        match sides.iter().all(|side| (1..=SIDE_LIMIT).contains(side)) {
            true => timing.check().map(|()| settings),
            false => Err(Error::invalid(format!("a size out of 1 to {SIDE_LIMIT}"))),
        }
    }

    pub(super) fn size(&self, what: What) -> Size {
        let [width, height] = self.sizes[what as usize];
        Size { width, height }
    }

    pub(super) fn kind(&self, what: What) -> Kind {
        match what {
            What::Picture => Kind::Still,
            What::Views => Kind::Views(self.chosen_sides()),
            What::Turn => Kind::Turn(Timing { frames: self.frames, per_second: self.per_second }),
        }
    }

    pub(super) fn chosen_sides(&self) -> Vec<NamedView> {
        SIDES.iter().zip(self.sides).filter(|(_, chosen)| *chosen).map(|((side, _), _)| *side).collect()
    }

    /// The view's shading, over the background that was chosen.
    pub(super) fn shading(&self, shading: Shading) -> Shading {
        let linear = |encoded: u8| LINEAR_FROM_SRGB8[usize::from(encoded)];
        let background = match self.background {
            Background::View => shading.background,
            Background::None => None,
            Background::Colour(colour) => Some(colour.map(linear)),
        };
        Shading { background, samples: if self.smooth { 4 } else { 1 }, ..shading }
    }
}

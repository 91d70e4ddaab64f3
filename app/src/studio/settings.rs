//! What is kept from one start of the studio to the next: preferences, layouts, and what plugins keep.

use std::collections::BTreeMap;
use std::path::Path;

use amc_core::Result;
use eframe::egui;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use studio_plugin::{Notices, Registry};

use super::dock::{self, Layout};
use super::shortcuts::Shortcuts;
use crate::project::{System, settings};

/// The file, in the settings' folder.
const FILE: &str = "studio.json";

/// How large the interface may be made, and how small, of 1.
pub(super) const SCALES: std::ops::RangeInclusive<f32> = 0.5..=2.5;

/// The file, as it is written.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Kept {
    layout: Option<Layout>,
    preferences: Preferences,
    /// By the plugins' ids; those of plugins that are not there today are kept for when they are.
    plugins: BTreeMap<String, Value>,
}

/// What the person chose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Preferences {
    pub(super) theme: Theme,
    /// Of the whole interface, within [`SCALES`].
    pub(super) scale: f32,
    pub(super) shortcuts: Shortcuts,
    /// Layouts by the names that the person gave them.
    pub(super) layouts: BTreeMap<String, Layout>,
    /// Whether the first steps are no longer shown.
    pub(super) welcomed: bool,
}

/// Which of the two themes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Theme {
    /// That of the system.
    #[default]
    System,
    Light,
    Dark,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            theme: Theme::default(),
            scale: 1.0,
            shortcuts: Shortcuts::default(),
            layouts: BTreeMap::new(),
            welcomed: false,
        }
    }
}

impl Preferences {
    /// Makes the window look so.
    pub(super) fn apply(&self, context: &egui::Context) {
        context.set_theme(match self.theme {
            Theme::System => egui::ThemePreference::System,
            Theme::Light => egui::ThemePreference::Light,
            Theme::Dark => egui::ThemePreference::Dark,
        });
        if self.scale.is_finite() {
            context.set_zoom_factor(self.scale.clamp(*SCALES.start(), *SCALES.end()));
        }
    }
}

/// Gives plugins back what they kept; gives the layout and the preferences. What cannot be read is said, and the default
/// takes its place.
pub(super) fn restore(
    folder: &Path,
    registry: &mut Registry,
    notices: &mut Notices,
) -> (Option<Layout>, Preferences) {
    let loaded = settings::load::<Kept>(&System, &folder.join(FILE));
    loaded.notice.iter().for_each(|notice| notices.note(notice));
    for (id, value) in loaded.value.plugins {
        let Some(plugin) = registry.get_mut(&id) else { continue };
        if let Some(Err(error)) = plugin.restore(value, notices) {
            notices.note(format!(
                "the settings of '{}' are its defaults again: {error}",
                plugin.plugin().name()
            ));
        }
    }
    (loaded.value.layout.filter(dock::is_usable), loaded.value.preferences)
}

/// Keeps the layout, the preferences, and what plugins want kept.
///
/// # Errors
/// The file cannot be written.
pub(super) fn keep(
    folder: &Path,
    registry: &mut Registry,
    (layout, preferences): (&Layout, &Preferences),
    notices: &mut Notices,
) -> Result<()> {
    let path = folder.join(FILE);
    let mut kept = settings::load::<Kept>(&System, &path).value;
    kept.layout = Some(layout.clone());
    kept.preferences = preferences.clone();
    for plugin in registry.plugins_mut() {
        let id = plugin.plugin().id().to_owned();
        if let Some(Some(value)) = plugin.settings(notices) {
            kept.plugins.insert(id, value);
        }
    }
    settings::save(&System, &path, &kept)
}

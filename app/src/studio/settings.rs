//! What is kept from one start of the studio to the next: the layout, and what plugins keep.

use std::collections::BTreeMap;
use std::path::Path;

use amc_core::Result;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use studio_plugin::{Notices, Registry};

use super::dock::{self, Layout};
use crate::project::{System, settings};

/// The file, in the settings' folder.
const FILE: &str = "studio.json";

/// The file, as it is written.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Kept {
    layout: Option<Layout>,
    /// By the plugins' ids; those of plugins that are not there today are kept for when they are.
    plugins: BTreeMap<String, Value>,
}

/// Gives plugins back what they kept; gives the layout. What cannot be read is said, and the default takes its place.
pub(super) fn restore(folder: &Path, registry: &mut Registry, notices: &mut Notices) -> Option<Layout> {
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
    loaded.value.layout.filter(dock::is_usable)
}

/// Keeps the layout, and what plugins want kept.
///
/// # Errors
/// The file cannot be written.
pub(super) fn keep(
    folder: &Path,
    registry: &mut Registry,
    layout: &Layout,
    notices: &mut Notices,
) -> Result<()> {
    let path = folder.join(FILE);
    let mut kept = settings::load::<Kept>(&System, &path).value;
    kept.layout = Some(layout.clone());
    for plugin in registry.plugins_mut() {
        let id = plugin.plugin().id().to_owned();
        if let Some(Some(value)) = plugin.settings(notices) {
            kept.plugins.insert(id, value);
        }
    }
    settings::save(&System, &path, &kept)
}

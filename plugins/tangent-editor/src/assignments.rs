//! What the editor keeps with the project beside fabrics and directions.

use std::collections::BTreeMap;

pub use amc_core::direction::Orientation;
use amc_core::{Error, Result};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use studio_plugin::document::{Edit, Project};

/// By which the project knows what the editor keeps.
pub const ID: &str = "tangent-editor";

/// What was said of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Assignment {
    /// In which turns it may be laid on the cloth.
    pub orientation: Orientation,
    /// Whether its direction is kept from being changed.
    pub is_locked: bool,
    /// Whether its mirror partner follows it.
    pub is_linked: bool,
    /// How far its flat piece is turned on the screen from how the UVs draw it, degrees counter-clockwise: no matter of its grain.
    pub screen_turn_deg: f32,
}

/// What was said of all panels, by their ids.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Assignments {
    version: u32,
    panels: BTreeMap<String, Assignment>,
}

/// The version that is written.
const VERSION: u32 = 1;

impl Assignments {
    /// Those of a project.
    ///
    /// # Errors
    /// They are of a newer program, or make no sense.
    pub fn of(project: &Project) -> Result<Self> {
        let Some(state) = project.plugins.get(ID) else { return Ok(Self::default()) };
        let place = |error: Error| error.at_element(format!("plugins.{ID}"));
        let read: Self = serde_json::from_value(state.clone())
            .map_err(|error| place(Error::malformed(error.to_string())))?;
        if read.version > VERSION {
            let what = format!("version {} is of a newer program; this one knows {VERSION}", read.version);
            return Err(place(Error::unsupported(what)));
        }
        Ok(read)
    }

    /// What was said of the panel of this id.
    pub fn panel(&self, id: &str) -> Assignment {
        self.panels.get(id).copied().unwrap_or_default()
    }

    /// The edit that says it anew of these panels; `what` is its name in the history.
    pub fn changed<'a>(
        mut self,
        panels: impl IntoIterator<Item = &'a str>,
        what: String,
        change: impl Fn(&mut Assignment),
    ) -> Edit {
        panels.into_iter().for_each(|id| self.change(id, &change));
        self.into_edit(what)
    }

    /// Says it anew of one panel.
    pub(crate) fn change(&mut self, id: &str, change: impl Fn(&mut Assignment)) {
        let mut assignment = self.panels.remove(id).unwrap_or_default();
        change(&mut assignment);
        if assignment != Assignment::default() {
            self.panels.insert(id.to_owned(), assignment);
        }
    }

    /// The edit that makes a project say this; `what` is its name in the history.
    pub(crate) fn into_edit(mut self, what: String) -> Edit {
        self.version = VERSION;
        let state = if self.panels.is_empty() {
            Value::Null
        } else {
            serde_json::to_value(&self).unwrap_or_default()
        };
        Edit::SetPluginState { plugin: ID.to_owned(), what, state }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use studio_plugin::document::Document;

    #[test]
    fn what_is_said_is_kept_and_what_is_default_again_is_dropped() {
        let mut document = Document::new(Project::default());
        let lock = |yes: bool| move |assignment: &mut Assignment| assignment.is_locked = yes;
        let edit = Assignments::default().changed(["front", "back"], "Lock 2 panels".to_owned(), lock(true));
        document.submit(edit, None).unwrap();
        let kept = Assignments::of(document.project()).unwrap();
        assert!(
            kept.panel("front").is_locked && kept.panel("back").is_locked && !kept.panel("cuff").is_locked
        );
        assert_eq!(document.undo_name(), Some("Lock 2 panels"));
        document.submit(kept.changed(["front", "back"], "Unlock".to_owned(), lock(false)), None).unwrap();
        assert!(document.project().plugins.is_empty());
    }

    #[test]
    fn what_is_of_a_newer_program_or_makes_no_sense_is_refused() {
        let said = |state: Value| {
            let mut project = Project::default();
            project.plugins.insert(ID.to_owned(), state);
            Assignments::of(&project).unwrap_err().to_string()
        };
        assert!(said(serde_json::json!({"version": 9, "panels": {}})).contains("newer program"));
        assert!(said(serde_json::json!(["front"])).starts_with("plugins.tangent-editor: "));
    }
}

//! What the person has picked, shared by all panes and the viewport.

use std::collections::BTreeSet;

/// The panels that are selected, and the one under the pointer. No part of the document.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Selection {
    /// Ids of the selected panels.
    pub panels: BTreeSet<String>,
    /// Id of the panel under the pointer, in the viewport or in a list.
    pub hovered: Option<String>,
}

impl Selection {
    /// A click on a panel: it alone is selected, or, where `add`, it too, or no longer.
    pub fn click(&mut self, panel: &str, add: bool) {
        if !add {
            self.panels = BTreeSet::from([panel.to_owned()]);
        } else if !self.panels.remove(panel) {
            self.panels.insert(panel.to_owned());
        }
    }

    /// Leaves out panels that are not in the garment (any more).
    pub fn retain(&mut self, there: impl Fn(&str) -> bool) {
        self.panels.retain(|panel| there(panel));
        self.hovered.take_if(|panel| !there(panel));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clicks_select_add_and_take_away() {
        let mut selection = Selection::default();
        selection.click("front", false);
        selection.click("back", true);
        assert_eq!(selection.panels.len(), 2);
        selection.click("front", true);
        assert!(selection.panels.iter().eq(["back"]));
        selection.click("sleeve", false);
        assert!(selection.panels.iter().eq(["sleeve"]));
        selection.hovered = Some("back".into());
        selection.retain(|panel| panel == "cuff");
        assert_eq!(selection, Selection::default());
    }
}

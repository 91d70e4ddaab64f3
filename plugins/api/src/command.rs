//! What a person can ask for by menu, palette or key.

use egui::KeyboardShortcut;

/// A command: shown in the menu and in the palette under its name, and run by its shortcut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Command {
    /// Stable, and unique within its plugin: settings keep shortcuts by it.
    pub id: &'static str,
    /// A few words, beginning with a verb: "Swap warp and weft".
    pub name: &'static str,
    /// One sentence more.
    pub tooltip: &'static str,
    /// The shortcut that it has until the person gives it another.
    pub shortcut: Option<KeyboardShortcut>,
}

//! The page of settings.

pub(crate) const APPEARANCE: &str = "Appearance";
pub(crate) const SHORTCUTS: &str = "Shortcuts";
pub(crate) const LAYOUTS: &str = "Layouts";
pub(crate) const FIND: &str = "Find";
pub(crate) const AS_THEY_COME: &str = "All as they come";
pub(crate) const HOW: &str = "Click a shortcut, then press the new keys. Backspace: none. Escape: as it was.";
pub(crate) const PRESS: &str = "press keys ...";
pub(crate) const NONE: &str = "none";
pub(crate) const LAYOUT_NAME: &str = "Name";
pub(crate) const KEEP_LAYOUT: &str = "Keep the present layout";
pub(crate) const NO_LAYOUT: &str =
    "No layout is kept yet. Drag tabs to arrange the window, then keep it under a name.";
pub(crate) const USE: &str = "Use";
pub(crate) const REMOVE: &str = "Remove";
pub(crate) const THEME: &str = "Theme";
pub(crate) const AS_SYSTEM: &str = "As the system";
pub(crate) const LIGHT: &str = "Light";
pub(crate) const DARK: &str = "Dark";
pub(crate) const SCALE: &str = "Size of the interface";

/// What a shortcut's button says to a screen reader.
pub(crate) fn shortcut_of(command: &str, shortcut: &str) -> String {
    format!("Shortcut of {command}: {shortcut}")
}

/// What using a layout does.
pub(crate) fn use_layout(name: &str) -> String {
    format!("Arranges the window as '{name}'")
}

/// What removing a layout does.
pub(crate) fn remove_layout(name: &str) -> String {
    format!("Forgets '{name}'")
}

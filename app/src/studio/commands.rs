//! What the studio itself can be asked for, and all commands of all plugins.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};
use studio_plugin::{Command, Registry};

use super::texts;

const fn key(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

const fn shift(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key))
}

/// A command of the studio itself: what, under which menu, and the command.
pub(super) struct Own {
    pub(super) action: Action,
    pub(super) menu: &'static str,
    pub(super) command: Command,
}

/// What the studio itself does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Action {
    New,
    Open,
    Save,
    SaveAs,
    Quit,
    Undo,
    Redo,
    SelectAll,
    SelectNone,
    Palette,
    Theme,
    ResetLayout,
    Larger,
    Smaller,
}

const fn own(
    action: Action,
    menu: &'static str,
    id: &'static str,
    name: &'static str,
    tooltip: &'static str,
    shortcut: Option<KeyboardShortcut>,
) -> Own {
    Own { action, menu, command: Command { id, name, tooltip, shortcut } }
}

/// All of them, in the order of the menus. A command is one line here and one arm where it is run.
pub(super) const OWN: [Own; 14] = [
    own(Action::New, texts::FILE_MENU, "new", "New project", "Begins with the bundled shirt", key(Key::N)),
    own(
        Action::Open,
        texts::FILE_MENU,
        "open",
        "Open ...",
        "Opens a project, a garment or a fabric",
        key(Key::O),
    ),
    own(Action::Save, texts::FILE_MENU, "save", "Save", "Saves the project where it is", key(Key::S)),
    own(
        Action::SaveAs,
        texts::FILE_MENU,
        "save-as",
        "Save as ...",
        "Saves the project elsewhere",
        shift(Key::S),
    ),
    own(Action::Quit, texts::FILE_MENU, "quit", "Quit", "Closes the window", key(Key::Q)),
    own(Action::Undo, texts::EDIT_MENU, "undo", texts::UNDO, "Takes back the last step", key(Key::Z)),
    own(Action::Redo, texts::EDIT_MENU, "redo", texts::REDO, "Does again what was taken back", shift(Key::Z)),
    own(
        Action::SelectAll,
        texts::SELECT_MENU,
        "select-all",
        "Select all panels",
        "All that take a fabric",
        key(Key::A),
    ),
    own(
        Action::SelectNone,
        texts::SELECT_MENU,
        "select-none",
        "Select nothing",
        "Nothing is selected",
        shift(Key::A),
    ),
    own(
        Action::Palette,
        texts::WINDOW_MENU,
        "palette",
        "All commands ...",
        "Finds a command by its name",
        key(Key::P),
    ),
    own(Action::Theme, texts::WINDOW_MENU, "theme", "Light or dark", "Changes the window's theme", None),
    own(Action::ResetLayout, texts::WINDOW_MENU, "reset-layout", "Reset layout", "Puts all panes back", None),
    own(
        Action::Larger,
        texts::WINDOW_MENU,
        "larger",
        "Larger text",
        "Makes the whole interface larger",
        key(Key::Plus),
    ),
    own(
        Action::Smaller,
        texts::WINDOW_MENU,
        "smaller",
        "Smaller text",
        "Makes the whole interface smaller",
        key(Key::Minus),
    ),
];

/// A command of the studio or of a plugin, a pane to be brought forward, or a project to be opened again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Own(Action),
    Plugin {
        plugin: &'static str,
        command: &'static str,
    },
    Pane {
        plugin: &'static str,
        pane: &'static str,
    },
    /// One of the projects opened or saved lately.
    Recent(usize),
}

/// Every command there is: the studio's, then the plugins', each with whose it is.
pub(super) fn all(registry: &Registry) -> Vec<(&'static str, Command, Wanted)> {
    let own = OWN.iter().map(|own| (own.menu, own.command, Wanted::Own(own.action)));
    let plugins = registry.plugins().iter().filter(|plugin| !plugin.is_off()).flat_map(|plugin| {
        let (id, name) = (plugin.plugin().id(), plugin.plugin().name());
        let wanted = move |command: Command| Wanted::Plugin { plugin: id, command: command.id };
        plugin.plugin().commands().into_iter().map(move |command| (name, command, wanted(command)))
    });
    let panes = registry.plugins().iter().filter(|plugin| !plugin.is_off()).flat_map(|plugin| {
        let id = plugin.plugin().id();
        plugin.plugin().panes().into_iter().map(move |pane| {
            let tooltip = "Brings this pane forward";
            let command = Command { id: pane.id, name: pane.title, tooltip, shortcut: None };
            (texts::WINDOW_MENU, command, Wanted::Pane { plugin: id, pane: pane.id })
        })
    });
    own.chain(plugins).chain(panes).collect()
}

//! What the studio itself can be asked for, and all commands of all plugins.

use std::borrow::Cow;

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
    Settings,
    Guide,
    FirstSteps,
    About,
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
pub(super) const OWN: [Own; 18] = [
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
    own(
        Action::Theme,
        texts::WINDOW_MENU,
        "theme",
        "Light or dark",
        "Changes the window's theme",
        shift(Key::L),
    ),
    own(
        Action::ResetLayout,
        texts::WINDOW_MENU,
        "reset-layout",
        "Reset layout",
        "Puts all panes back",
        shift(Key::R),
    ),
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
    own(
        Action::Settings,
        texts::WINDOW_MENU,
        "settings",
        texts::SETTINGS,
        "Theme, text size, shortcuts, layouts",
        key(Key::Comma),
    ),
    own(
        Action::Guide,
        texts::HELP_MENU,
        "guide",
        texts::GUIDE,
        "How everything is done",
        Some(KeyboardShortcut::new(Modifiers::NONE, Key::F1)),
    ),
    own(
        Action::FirstSteps,
        texts::HELP_MENU,
        "first-steps",
        texts::FIRST_STEPS,
        "Three things to try",
        Some(KeyboardShortcut::new(Modifiers::SHIFT, Key::F1)),
    ),
    own(
        Action::About,
        texts::HELP_MENU,
        "about",
        texts::ABOUT,
        "The version, and the licences of all that it is made of",
        Some(KeyboardShortcut::new(Modifiers::COMMAND, Key::F1)),
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
    /// Chooses a tool; chosen again, it is put away.
    Tool {
        plugin: &'static str,
        tool: &'static str,
    },
    Pane {
        plugin: &'static str,
        pane: &'static str,
    },
    /// One of the projects opened or saved lately.
    Recent(usize),
}

/// A command as menus, palette and keys have it.
#[derive(Debug, Clone)]
pub(super) struct Offered {
    /// Whose it is: the name of a menu.
    pub(super) of: &'static str,
    /// Unique among all: settings keep its shortcut by it.
    pub(super) key: Cow<'static, str>,
    /// With the shortcut that the person gave it.
    pub(super) command: Command,
    pub(super) wanted: Wanted,
}

/// Every command there is, with the shortcuts it comes with: the studio's, then the plugins', then one for each pane.
pub(super) fn all(registry: &Registry) -> Vec<Offered> {
    let own = OWN.iter().map(|own| Offered {
        of: own.menu,
        key: own.command.id.into(),
        command: own.command,
        wanted: Wanted::Own(own.action),
    });
    let on = || registry.plugins().iter().filter(|plugin| !plugin.is_off()).map(|it| it.plugin());
    let plugins = on().flat_map(|plugin| {
        let (id, name) = (plugin.id(), plugin.name());
        plugin.commands().into_iter().map(move |command| Offered {
            of: name,
            key: format!("{id}/{}", command.id).into(),
            command,
            wanted: Wanted::Plugin { plugin: id, command: command.id },
        })
    });
    let tools = on().flat_map(|plugin| {
        let (id, name) = (plugin.id(), plugin.name());
        plugin.tools().into_iter().map(move |command| Offered {
            of: name,
            key: format!("tool/{id}/{}", command.id).into(),
            command,
            wanted: Wanted::Tool { plugin: id, tool: command.id },
        })
    });
    let panes = on().flat_map(|plugin| {
        let id = plugin.id();
        plugin.panes().into_iter().map(move |pane| Offered {
            of: texts::WINDOW_MENU,
            key: format!("pane/{id}/{}", pane.id).into(),
            command: Command {
                id: pane.id,
                name: pane.title,
                tooltip: "Brings this pane forward",
                shortcut: None,
            },
            wanted: Wanted::Pane { plugin: id, pane: pane.id },
        })
    });
    own.chain(plugins).chain(tools).chain(panes).collect()
}

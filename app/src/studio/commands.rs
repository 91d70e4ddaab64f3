//! What the studio itself can be asked for, and all commands of all plugins.

use std::borrow::Cow;

use eframe::egui::{Key, KeyboardShortcut, Modifiers};
use studio_plugin::{Command, Registry};

use super::texts::{self, commands as words};

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
    own(Action::New, texts::FILE_MENU, "new", words::NEW, words::NEW_TIP, key(Key::N)),
    own(Action::Open, texts::FILE_MENU, "open", words::OPEN, words::OPEN_TIP, key(Key::O)),
    own(Action::Save, texts::FILE_MENU, "save", words::SAVE, words::SAVE_TIP, key(Key::S)),
    own(Action::SaveAs, texts::FILE_MENU, "save-as", words::SAVE_AS, words::SAVE_AS_TIP, shift(Key::S)),
    own(Action::Quit, texts::FILE_MENU, "quit", words::QUIT, words::QUIT_TIP, key(Key::Q)),
    own(Action::Undo, texts::EDIT_MENU, "undo", texts::UNDO, words::UNDO_TIP, key(Key::Z)),
    own(Action::Redo, texts::EDIT_MENU, "redo", texts::REDO, words::REDO_TIP, shift(Key::Z)),
    own(
        Action::SelectAll,
        texts::SELECT_MENU,
        "select-all",
        words::SELECT_ALL,
        words::SELECT_ALL_TIP,
        key(Key::A),
    ),
    own(
        Action::SelectNone,
        texts::SELECT_MENU,
        "select-none",
        words::SELECT_NONE,
        words::SELECT_NONE_TIP,
        shift(Key::A),
    ),
    own(Action::Palette, texts::WINDOW_MENU, "palette", words::PALETTE, words::PALETTE_TIP, key(Key::P)),
    own(Action::Theme, texts::WINDOW_MENU, "theme", words::THEME, words::THEME_TIP, shift(Key::L)),
    own(
        Action::ResetLayout,
        texts::WINDOW_MENU,
        "reset-layout",
        words::RESET_LAYOUT,
        words::RESET_LAYOUT_TIP,
        shift(Key::R),
    ),
    own(Action::Larger, texts::WINDOW_MENU, "larger", words::LARGER, words::LARGER_TIP, key(Key::Plus)),
    own(Action::Smaller, texts::WINDOW_MENU, "smaller", words::SMALLER, words::SMALLER_TIP, key(Key::Minus)),
    own(
        Action::Settings,
        texts::WINDOW_MENU,
        "settings",
        texts::SETTINGS,
        words::SETTINGS_TIP,
        key(Key::Comma),
    ),
    own(
        Action::Guide,
        texts::HELP_MENU,
        "guide",
        texts::GUIDE,
        words::GUIDE_TIP,
        Some(KeyboardShortcut::new(Modifiers::NONE, Key::F1)),
    ),
    own(
        Action::FirstSteps,
        texts::HELP_MENU,
        "first-steps",
        texts::FIRST_STEPS,
        words::FIRST_STEPS_TIP,
        Some(KeyboardShortcut::new(Modifiers::SHIFT, Key::F1)),
    ),
    own(
        Action::About,
        texts::HELP_MENU,
        "about",
        texts::ABOUT,
        words::ABOUT_TIP,
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
            command: Command { id: pane.id, name: pane.title, tooltip: words::PANE_TIP, shortcut: None },
            wanted: Wanted::Pane { plugin: id, pane: pane.id },
        })
    });
    own.chain(plugins).chain(tools).chain(panes).collect()
}

//! Shortcuts that the person has changed.

use std::collections::BTreeMap;

use eframe::egui::{Key, KeyboardShortcut, Modifiers};
use serde::{Deserialize, Serialize};

use super::commands::Offered;

/// Changed shortcuts by the commands' keys: `Command+Shift+S`, or nothing where a command shall have none. What cannot be
/// understood counts as not changed.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Shortcuts(BTreeMap<String, String>);

impl Shortcuts {
    /// Gives the commands the shortcuts that the person chose.
    pub(super) fn apply(&self, commands: &mut [Offered]) {
        for offered in commands {
            match self.0.get(offered.key.as_ref()).map(String::as_str) {
                Some("") => offered.command.shortcut = None,
                Some(text) => offered.command.shortcut = parse(text).or(offered.command.shortcut),
                None => {}
            }
        }
    }

    /// Gives a command of `all` another shortcut, or none. Another command that had it has none from then on.
    pub(super) fn set(&mut self, all: &[Offered], key: &str, shortcut: Option<KeyboardShortcut>) {
        let had = all.iter().filter(|it| shortcut.is_some() && it.command.shortcut == shortcut);
        for other in had.filter(|it| it.key != key) {
            self.0.insert(other.key.to_string(), String::new());
        }
        self.0.insert(key.to_owned(), shortcut.map(|it| text(&it)).unwrap_or_default());
    }

    /// Whether anything is not as it comes.
    pub(super) fn is_changed(&self) -> bool {
        !self.0.is_empty()
    }

    /// All as they come.
    pub(super) fn reset(&mut self) {
        self.0.clear();
    }
}

/// A key that was pressed, as a shortcut: what is held with it, told as each system tells it.
pub(super) fn pressed(key: Key, modifiers: Modifiers) -> KeyboardShortcut {
    let held = [
        (modifiers.command, Modifiers::COMMAND),
        (modifiers.alt, Modifiers::ALT),
        (modifiers.shift, Modifiers::SHIFT),
    ];
    let sum = held.into_iter().filter(|(is, _)| *is).fold(Modifiers::NONE, |sum, (_, one)| sum.plus(one));
    KeyboardShortcut::new(sum, key)
}

fn text(shortcut: &KeyboardShortcut) -> String {
    let KeyboardShortcut { modifiers, logical_key } = shortcut;
    let held = [(modifiers.command, "Command+"), (modifiers.alt, "Alt+"), (modifiers.shift, "Shift+")];
    let held: String = held.into_iter().filter(|(is, _)| *is).map(|(_, name)| name).collect();
    held + logical_key.name()
}

fn parse(text: &str) -> Option<KeyboardShortcut> {
    let mut modifiers = Modifiers::NONE;
    let (held, key) = text.rsplit_once('+').unwrap_or(("", text));
    for name in held.split('+').filter(|name| !name.is_empty()) {
        modifiers = modifiers.plus(match name {
            "Command" => Modifiers::COMMAND,
            "Alt" => Modifiers::ALT,
            "Shift" => Modifiers::SHIFT,
            _ => return None,
        });
    }
    Some(KeyboardShortcut::new(modifiers, Key::from_name(key)?))
}

#[cfg(test)]
mod tests {
    use super::super::commands::{Action, OWN, Wanted};
    use super::*;

    fn all() -> Vec<Offered> {
        let offered = |own: &super::super::commands::Own| Offered {
            of: own.menu,
            key: own.command.id.into(),
            command: own.command,
            wanted: Wanted::Own(own.action),
        };
        OWN.iter().map(offered).collect()
    }

    fn of(all: &[Offered], action: Action) -> Option<KeyboardShortcut> {
        all.iter().find(|it| it.wanted == Wanted::Own(action)).unwrap().command.shortcut
    }

    #[test]
    fn every_shortcut_is_written_so_that_it_is_read_again() {
        for key in Key::ALL {
            for modifiers in [Modifiers::NONE, Modifiers::COMMAND.plus(Modifiers::SHIFT), Modifiers::ALT] {
                let shortcut = KeyboardShortcut::new(modifiers, *key);
                assert_eq!(parse(&text(&shortcut)), Some(shortcut), "{key:?}");
            }
        }
        assert_eq!(parse("Hyper+S"), None);
        assert_eq!(parse("Shift+Nothing"), None);
    }

    #[test]
    fn a_shortcut_belongs_to_one_command() {
        let mut shortcuts = Shortcuts::default();
        let undo = of(&all(), Action::Undo);
        shortcuts.set(&all(), "redo", undo);
        let mut now = all();
        shortcuts.apply(&mut now);
        assert_eq!((of(&now, Action::Redo), of(&now, Action::Undo)), (undo, None));
        shortcuts.0.insert("save".into(), "nonsense".into());
        shortcuts.apply(&mut now);
        assert_eq!(of(&now, Action::Save), of(&all(), Action::Save));
        shortcuts.reset();
        assert!(!shortcuts.is_changed());
    }
}

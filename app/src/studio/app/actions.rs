//! Commands: which can be run, which key runs them, and what the studio's own do.

use eframe::egui::{self, Modifiers, ViewportCommand};

use super::App;
use crate::studio::commands::{Action, Offered, Wanted};
use crate::studio::dock::{self, Pane};
use crate::studio::files::Purpose;
use crate::studio::settings::{SCALES, Theme};
use crate::studio::welcome::{Chosen, Step};

/// With the command key these select all, copy, cut, paste, undo and redo in a text that is being edited.
const OF_TEXTS: [egui::Key; 6] =
    [egui::Key::A, egui::Key::C, egui::Key::V, egui::Key::X, egui::Key::Y, egui::Key::Z];

/// By these keys, without others, whatever has the keyboard is worked.
const OF_WIDGETS: [egui::Key; 12] = [
    egui::Key::ArrowDown,
    egui::Key::ArrowLeft,
    egui::Key::ArrowRight,
    egui::Key::ArrowUp,
    egui::Key::Backspace,
    egui::Key::End,
    egui::Key::Enter,
    egui::Key::Home,
    egui::Key::PageDown,
    egui::Key::PageUp,
    egui::Key::Space,
    egui::Key::Tab,
];

impl App {
    pub(super) fn run(&mut self, wanted: Wanted, ui: &egui::Ui) {
        match wanted {
            Wanted::Own(action) => self.act(action, ui),
            Wanted::Recent(index) => {
                if let Some(path) = self.desk.recent.get(index).cloned() {
                    self.open(&path);
                }
            }
            Wanted::Pane { plugin, pane } => {
                let pane = Pane::Plugin { plugin: plugin.to_owned(), pane: pane.to_owned() };
                dock::bring_forward(&mut self.layout, &pane);
            }
            Wanted::Tool { plugin, tool } => self.take(plugin, tool),
            Wanted::Plugin { plugin, command } => self.with_context(|registry, studio| {
                if let Some(plugin) = registry.get_mut(plugin) {
                    plugin.call(studio, |plugin, studio| {
                        if plugin.can_run(command, studio) {
                            plugin.run(command, studio);
                        }
                    });
                }
            }),
        }
    }

    fn act(&mut self, action: Action, ui: &egui::Ui) {
        match action {
            Action::New => self.desk.begin(),
            Action::Open => self.ask(Purpose::Open),
            Action::Save => self.save(),
            Action::SaveAs => self.ask(Purpose::Save),
            Action::Quit => ui.send_viewport_cmd(ViewportCommand::Close),
            Action::Undo => {
                self.desk.document.undo();
            }
            Action::Redo => {
                self.desk.document.redo();
            }
            Action::SelectAll => {
                let panels = self.stager.stage.garment.iter().flat_map(|garment| &garment.panels);
                let panels = panels.filter(|panel| panel.takes_fabric).map(|panel| panel.id.clone());
                self.selection.panels = panels.collect();
            }
            Action::SelectNone => self.selection.panels.clear(),
            Action::Palette => self.palette.toggle(),
            Action::Theme => {
                let is_dark = ui.theme() == egui::Theme::Dark;
                self.preferences.theme = if is_dark { Theme::Light } else { Theme::Dark };
                self.preferences.apply(ui);
            }
            Action::ResetLayout => self.layout = dock::initial(&self.registry),
            Action::Larger => self.rescale(ui, 0.1),
            Action::Smaller => self.rescale(ui, -0.1),
            Action::Settings => self.settings_page.toggle(),
            Action::Guide => self.help.toggle_guide(),
            Action::FirstSteps => self.preferences.welcomed = !self.preferences.welcomed,
            Action::About => self.help.toggle_about(),
        }
    }

    fn rescale(&mut self, ui: &egui::Ui, by: f32) {
        let scale = self.preferences.scale + by;
        self.preferences.scale = scale.clamp(*SCALES.start(), *SCALES.end());
        self.preferences.apply(ui);
    }

    /// Shows the settings while they are open, and makes the window as they say.
    pub(super) fn show_settings(&mut self, ui: &egui::Ui, all: &[Offered]) {
        let before = (self.preferences.theme, self.preferences.scale);
        self.settings_page.show(ui, &mut self.preferences, &mut self.layout, all);
        if before != (self.preferences.theme, self.preferences.scale) {
            self.preferences.apply(ui);
        }
    }

    /// Does what a card of the first steps offers.
    pub(super) fn take_step(&mut self, chosen: Chosen, ui: &egui::Ui) {
        let wanted = match chosen {
            Chosen::Close => {
                self.preferences.welcomed = true;
                return;
            }
            Chosen::Step(Step::Turn) => Wanted::Plugin { plugin: "look", command: "auto-turn" },
            Chosen::Step(Step::Dress) => Wanted::Pane { plugin: "fabrics", pane: "list" },
            Chosen::Step(Step::Swap) => Wanted::Plugin { plugin: "inspector", command: "swap" },
        };
        self.run(wanted, ui);
    }

    pub(super) fn can_run(&self, wanted: Wanted) -> bool {
        match wanted {
            Wanted::Own(Action::Undo) => self.desk.document.undo_name().is_some(),
            Wanted::Own(Action::Redo) => self.desk.document.redo_name().is_some(),
            Wanted::Own(Action::SelectNone) => !self.selection.panels.is_empty(),
            Wanted::Own(_)
            | Wanted::Plugin { .. }
            | Wanted::Tool { .. }
            | Wanted::Pane { .. }
            | Wanted::Recent(_) => true,
        }
    }

    /// The plugins' commands that cannot be run now.
    pub(super) fn blocked(&mut self, all: &[Offered]) -> Vec<Wanted> {
        self.with_context(|registry, studio| {
            let mut is_blocked = |wanted: &Wanted| {
                let Wanted::Plugin { plugin, command } = *wanted else { return false };
                let plugin = registry.get_mut(plugin);
                plugin.and_then(|it| it.call(studio, |plugin, studio| plugin.can_run(command, studio)))
                    == Some(false)
            };
            all.iter().map(|it| it.wanted).filter(|wanted| is_blocked(wanted)).collect()
        })
    }

    /// The command whose shortcut was pressed, unless somebody types a text.
    pub(super) fn pressed(&self, ui: &egui::Ui, all: &[Offered]) -> Option<Wanted> {
        // What is asked in front of the window comes first.
        if self.settings_page.is_listening() || ui.memory(|memory| memory.top_modal_layer().is_some()) {
            return None;
        }
        let (focused, in_text) = (ui.egui_wants_keyboard_input(), ui.text_edit_focused());
        let fires = |shortcut: &egui::KeyboardShortcut| {
            // A text is edited by letters and by its own keys; what else has the keyboard is worked by a few.
            let (key, plain) = (shortcut.logical_key, !shortcut.modifiers.command && !shortcut.modifiers.alt);
            let edits_text = in_text && (plain || OF_TEXTS.contains(&key));
            let is_theirs = edits_text || focused && plain && OF_WIDGETS.contains(&key);
            !is_theirs && ui.input_mut(|input| input.consume_shortcut(shortcut))
        };
        // Those with more modifiers first: what is pressed with Shift is not what is pressed without.
        let mut with_keys: Vec<_> =
            all.iter().filter_map(|it| Some((it.command.shortcut?, it.wanted))).collect();
        let count = |modifiers: Modifiers| {
            u8::from(modifiers.command) + u8::from(modifiers.shift) + u8::from(modifiers.alt)
        };
        with_keys.sort_by_key(|(shortcut, _)| std::cmp::Reverse(count(shortcut.modifiers)));
        with_keys.into_iter().find(|(shortcut, _)| fires(shortcut)).map(|(_, wanted)| wanted)
    }
}

//! The command palette: type a few letters, press Enter.

use eframe::egui::{self, Key, Modifiers};

use super::commands::{Offered, Wanted};
use super::texts;
use super::theme::{STEP, Tokens};

/// How many commands are shown at once.
const MOST: usize = 12;

#[derive(Debug, Default)]
pub(super) struct Palette {
    open: bool,
    query: String,
    chosen: usize,
}

/// How well a query fits a name: its letters in this order, wherever they stand; none where they do not. The less the
/// better: letters left out between, and where it begins.
fn distance(query: &str, name: &str) -> Option<usize> {
    let mut rest = name.chars().enumerate();
    let mut last = None;
    let mut sum = 0;
    for wanted in query.chars().filter(|letter| !letter.is_whitespace()).flat_map(char::to_lowercase) {
        let (at, _) = rest.find(|(_, letter)| letter.to_lowercase().eq([wanted]))?;
        sum += last.map_or(at, |last| 2 * (at - last - 1));
        last = Some(at);
    }
    Some(sum)
}

impl Palette {
    pub(super) fn toggle(&mut self) {
        *self = Self { open: !self.open, ..Self::default() };
    }

    /// Shows it while it is open; gives what was chosen.
    pub(super) fn show(&mut self, ui: &egui::Ui, commands: &[Offered]) -> Option<Wanted> {
        if !self.open {
            return None;
        }
        let mut found: Vec<_> = commands
            .iter()
            .filter_map(|offered| Some((distance(&self.query, offered.command.name)?, offered)))
            .collect();
        found.sort_by_key(|(distance, ..)| *distance);
        found.truncate(MOST);
        self.chosen = self.chosen.min(found.len().saturating_sub(1));
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::ArrowDown) {
            self.chosen = (self.chosen + 1).min(found.len().saturating_sub(1));
        }
        if pressed(Key::ArrowUp) {
            self.chosen = self.chosen.saturating_sub(1);
        }
        let mut taken = pressed(Key::Enter).then_some(self.chosen);
        let tokens = Tokens::of(ui);
        let area = egui::Modal::default_area(egui::Id::unique("palette"))
            .anchor(egui::Align2::CENTER_TOP, egui::vec2(0.0, 24.0 * STEP));
        let shown = egui::Modal::new(egui::Id::unique("palette")).area(area).show(ui, |ui| {
            ui.set_width(110.0 * STEP);
            let field = egui::TextEdit::singleline(&mut self.query)
                .hint_text(texts::PALETTE_HINT)
                .desired_width(f32::INFINITY);
            let field = ui.add(field);
            field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, texts::PALETTE_HINT));
            field.request_focus();
            if field.changed() {
                self.chosen = 0;
            }
            if found.is_empty() {
                ui.weak(texts::PALETTE_NOTHING);
            }
            for (index, (_, Offered { of, command, .. })) in found.iter().enumerate() {
                let shortcut =
                    command.shortcut.map(|shortcut| ui.format_shortcut(&shortcut)).unwrap_or_default();
                let chosen = index == self.chosen;
                let weak = if chosen { tokens.on_accent } else { tokens.text_weak };
                let text = egui::RichText::new(*of).color(weak);
                let button = egui::Button::selectable(chosen, (command.name, text))
                    .right_text(egui::RichText::new(shortcut).color(weak))
                    .min_size(egui::vec2(ui.available_width(), 0.0));
                if ui.add(button).on_hover_text(command.tooltip).clicked() {
                    taken = Some(index);
                }
            }
        });
        let wanted = taken.and_then(|index| found.get(index)).map(|(_, offered)| offered.wanted);
        if wanted.is_some() || shown.should_close() {
            *self = Self::default();
        }
        wanted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_found_in_order_and_the_nearest_come_first() {
        assert_eq!(distance("", "Save"), Some(0));
        assert!(distance("sw", "Swap warp and weft").unwrap() < distance("sw", "Show the weft").unwrap());
        assert!(distance("warp", "Swap warp and weft") < distance("wapt", "Swap warp and weft"));
        assert_eq!(distance("evas", "Save"), None);
        assert_eq!(distance("ÄRM", "ärmel"), Some(0));
    }
}

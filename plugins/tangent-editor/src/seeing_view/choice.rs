//! The choice of what is seen.

use egui::{ComboBox, DragValue, Ui};

use super::SeeingView;
use crate::seeing::{Binding, COUNTS, Show, Square, Weave};
use crate::texts;

/// How many times larger a weave may be drawn.
const ENLARGEMENTS: [f32; 5] = [1.0, 5.0, 10.0, 20.0, 50.0];

impl SeeingView {
    /// The choice, in a tool bar.
    pub(crate) fn choice(&mut self, ui: &mut Ui) {
        let label = ui.label(texts::SHOW);
        let mut show = self.show;
        let list = ComboBox::from_id_salt("show").selected_text(name(show)).show_ui(ui, |ui| {
            for choice in std::iter::once(None).chain(Show::ALL.map(Some)) {
                ui.selectable_value(&mut show, choice, name(choice));
            }
        });
        list.response.labelled_by(label.id).on_hover_text(texts::SHOW_TIP);
        if show != self.show {
            self.choose(show);
        }
        match show {
            Some(Show::Weave) => self.weave(ui),
            Some(Show::Checker) => {
                let square = &mut self.settings.square;
                choose(ui, "square", texts::SQUARE, square, &Square::ALL, |it| texts::square(*it).to_owned());
            }
            _ => {}
        }
    }

    fn weave(&mut self, ui: &mut Ui) {
        let Weave { binding, ends, picks, enlargement } = &mut self.settings.weave;
        choose(ui, "binding", texts::BINDING, binding, &Binding::ALL, |it| texts::binding(*it).to_owned());
        for (name, tip, value) in
            [(texts::ENDS, texts::ENDS_TIP, ends), (texts::PICKS, texts::PICKS_TIP, picks)]
        {
            let label = ui.label(name);
            let field = DragValue::new(value).range(COUNTS).speed(0.2).max_decimals(1).suffix(texts::PER_CM);
            ui.add(field.update_while_editing(false)).labelled_by(label.id).on_hover_text(tip);
        }
        choose(ui, "enlargement", texts::ENLARGEMENT, enlargement, &ENLARGEMENTS, |it| texts::times(*it));
    }
}

fn name(show: Option<Show>) -> &'static str {
    show.map_or(texts::NOTHING, texts::show)
}

fn choose<T: PartialEq + Copy>(
    ui: &mut Ui,
    id: &str,
    label: &str,
    value: &mut T,
    all: &[T],
    name: impl Fn(&T) -> String,
) {
    let label = ui.label(label);
    let list = ComboBox::from_id_salt(id).selected_text(name(value)).show_ui(ui, |ui| {
        for choice in all {
            ui.selectable_value(value, *choice, name(choice));
        }
    });
    list.response.labelled_by(label.id);
}

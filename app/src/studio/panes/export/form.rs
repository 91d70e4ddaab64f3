//! The form, as it is drawn.

use amc_core::image::stream::Timing;
use eframe::egui::{self, DragValue};
use studio_plugin::JobView;

use super::settings::{Background, SIDES, Settings, What};
use crate::pictures::SIDE_LIMIT;
use crate::studio::texts::export as texts;
use crate::studio::theme::STEP;

/// Sizes by name, pixels.
const PRESETS: [(&str, [u32; 2]); 8] = [
    ("640 x 640", [640, 640]),
    ("1024 x 1024", [1024, 1024]),
    ("2048 x 2048", [2048, 2048]),
    (texts::HD, [1920, 1080]),
    (texts::FOUR_K, [3840, 2160]),
    (texts::A4, [2480, 3508]),
    (texts::A3, [3508, 4961]),
    (texts::A1, [7016, 9933]),
];

/// Shows the form; whether the export is asked for.
pub(super) fn show(ui: &mut egui::Ui, settings: &mut Settings, has_garment: bool) -> bool {
    ui.horizontal(|ui| {
        for (what, name, tooltip) in [
            (What::Picture, texts::PICTURE, texts::PICTURE_TIP),
            (What::Views, texts::VIEWS, texts::VIEWS_TIP),
            (What::Turn, texts::TURN, texts::TURN_TIP),
        ] {
            ui.radio_value(&mut settings.what, what, name).on_hover_text(tooltip);
        }
    });
    ui.add_space(STEP);
    egui::Grid::new("export").num_columns(2).show(ui, |ui| {
        size(ui, settings);
        background(ui, settings);
        if settings.what == What::Turn {
            turn(ui, settings);
        }
    });
    if settings.what == What::Views {
        ui.horizontal_wrapped(|ui| {
            for ((_, name), shown) in SIDES.iter().zip(&mut settings.sides) {
                ui.checkbox(shown, *name);
            }
        });
    }
    ui.checkbox(&mut settings.smooth, texts::SMOOTH).on_hover_text(texts::SMOOTH_TIP);
    let has_sides = settings.what != What::Views || settings.sides.contains(&true);
    ui.add_space(STEP);
    let button = ui.add_enabled(has_garment && has_sides, egui::Button::new(texts::BUTTON));
    button.on_hover_text(texts::BUTTON_TIP).clicked()
}

/// An export that is under way.
pub(super) fn show_running(ui: &mut egui::Ui, name: &str, view: Option<&JobView>, cancel: impl FnOnce()) {
    ui.add_space(STEP);
    ui.label(name);
    ui.horizontal(|ui| {
        if ui.button(texts::CANCEL).on_hover_text(texts::stops(name)).clicked() {
            cancel();
        }
        match view.and_then(|view| view.share) {
            Some(share) => ui.add(egui::ProgressBar::new(share).desired_width(40.0 * STEP).show_percentage()),
            None => ui.spinner(),
        };
    });
}

fn size(ui: &mut egui::Ui, settings: &mut Settings) {
    let sides = &mut settings.sizes[settings.what as usize];
    let label = ui.label(match settings.what {
        What::Picture => texts::SIZE,
        What::Views => texts::VIEW_SIZE,
        What::Turn => texts::FRAME_SIZE,
    });
    let shown = PRESETS.iter().find(|(_, preset)| preset == sides).map_or(texts::OTHER, |(name, _)| name);
    let list = egui::ComboBox::from_id_salt("size").selected_text(shown).show_ui(ui, |ui| {
        for (name, preset) in PRESETS {
            ui.selectable_value(sides, preset, name);
        }
    });
    list.response.labelled_by(label.id);
    ui.end_row();
    for (name, side) in [texts::WIDTH, texts::HEIGHT].into_iter().zip(sides) {
        let label = ui.label(name);
        let field = DragValue::new(side).range(1..=SIDE_LIMIT).speed(4.0).suffix(" px");
        ui.add(field).labelled_by(label.id);
        ui.end_row();
    }
}

fn background(ui: &mut egui::Ui, settings: &mut Settings) {
    let background = &mut settings.background;
    let colour = match *background {
        Background::Colour(colour) => colour,
        Background::View | Background::None => [255; 3],
    };
    let choices = [
        (Background::View, texts::AS_VIEW, texts::AS_VIEW_TIP),
        (Background::None, texts::TRANSPARENT, texts::TRANSPARENT_TIP),
        (Background::Colour(colour), texts::COLOUR, texts::COLOUR_TIP),
    ];
    let label = ui.label(texts::BACKGROUND);
    let shown = choices.iter().find(|choice| choice.0 == *background).map_or("", |choice| choice.1);
    ui.horizontal(|ui| {
        let list = egui::ComboBox::from_id_salt("background").selected_text(shown).show_ui(ui, |ui| {
            for (choice, name, tooltip) in choices {
                ui.selectable_value(background, choice, name).on_hover_text(tooltip);
            }
        });
        list.response.labelled_by(label.id);
        if let Background::Colour(colour) = background {
            ui.color_edit_button_srgb(colour).labelled_by(label.id);
        }
    });
    ui.end_row();
}

fn turn(ui: &mut egui::Ui, settings: &mut Settings) {
    let label = ui.label(texts::FRAMES);
    let field = DragValue::new(&mut settings.frames).range(1..=Timing::MOST_FRAMES);
    ui.add(field).labelled_by(label.id).on_hover_text(texts::FRAMES_TIP);
    ui.end_row();
    let label = ui.label(texts::PER_SECOND);
    let field = DragValue::new(&mut settings.per_second).range(1..=Timing::FASTEST);
    ui.add(field).labelled_by(label.id);
    ui.end_row();
    ui.label(texts::TAKES);
    ui.label(format!("{:.1} s", f64::from(settings.frames) / f64::from(settings.per_second.max(1))));
    ui.end_row();
}

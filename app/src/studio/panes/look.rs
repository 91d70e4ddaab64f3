//! How the garment is looked at: angles, lens, shading.

use amc_core::render::{Cyclic, Perspective};
use eframe::egui::{self, Key, KeyboardShortcut, Modifiers};
use studio_plugin::document::{Comparison, Lens, NamedView, TurningStyle, ViewSettings};
use studio_plugin::{Command, Context, Pane, Place, Plugin};

use crate::studio::texts::look as texts;
use crate::studio::theme::STEP;

pub(super) struct Look;

/// The named views, in the order of [`NamedView::ALL`].
const NAMED: [(&str, &str, Key); 6] = [
    ("front", texts::FRONT, Key::Num1),
    ("back", texts::BACK, Key::Num2),
    ("left", texts::LEFT, Key::Num3),
    ("right", texts::RIGHT, Key::Num4),
    ("top", texts::ABOVE, Key::Num5),
    ("bottom", texts::BELOW, Key::Num6),
];

const FIT: Command = Command {
    id: "fit",
    name: texts::FIT,
    tooltip: texts::FIT_TIP,
    shortcut: Some(KeyboardShortcut::new(Modifiers::NONE, Key::Num0)),
};
const AUTO_TURN: Command = Command {
    id: "auto-turn",
    name: texts::AUTO_TURN,
    tooltip: texts::AUTO_TURN_TIP,
    shortcut: Some(KeyboardShortcut::new(Modifiers::NONE, Key::T)),
};
const COMPARE: Command = Command {
    id: "compare",
    name: texts::COMPARE,
    tooltip: texts::COMPARE_TIP,
    shortcut: Some(KeyboardShortcut::new(Modifiers::NONE, Key::C)),
};

/// The background that the person begins with: middle grey.
const BACKGROUND: [u8; 3] = [119; 3];

/// Degrees per second of a garment that turns by itself.
const TURNING_SPEED: f32 = 30.0;

/// The focal length that perspective begins with, millimetres: a portrait lens.
const FOCAL_LENGTH: f32 = 85.0;

impl Plugin for Look {
    fn id(&self) -> &'static str {
        "look"
    }

    fn name(&self) -> &'static str {
        crate::studio::texts::VIEW_MENU
    }

    fn commands(&self) -> Vec<Command> {
        let named = NAMED.into_iter().map(|(id, name, key)| Command {
            id,
            name,
            tooltip: texts::NAMED_TIP,
            shortcut: Some(KeyboardShortcut::new(Modifiers::NONE, key)),
        });
        named.chain([FIT, AUTO_TURN, COMPARE]).collect()
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        let mut view = studio.document.project().view.clone();
        if command == FIT.id {
            view.fit();
        } else if command == AUTO_TURN.id {
            view.auto_turn = if view.auto_turn.is_some() { None } else { Some(TURNING_SPEED) };
        } else if command == COMPARE.id {
            view.compared = if view.compared.is_some() { None } else { Some(first_comparison()) };
        } else if let Some(index) = NAMED.iter().position(|(id, ..)| *id == command) {
            view.look(NamedView::ALL[index]);
        }
        studio.set_view(view);
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "settings", title: texts::PANE, place: Place::Right }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let before = &studio.document.project().view;
        let mut view = before.clone();
        egui::Grid::new("look").num_columns(2).show(ui, |ui| {
            angles(ui, &mut view);
            lens(ui, &mut view);
            shading(ui, &mut view, studio);
        });
        ui.checkbox(&mut view.occlusion, texts::OCCLUSION).on_hover_text(texts::OCCLUSION_TIP);
        background(ui, &mut view);
        auto_turn(ui, &mut view);
        ui.add_space(2.0 * STEP);
        compare(ui, &mut view, studio);
        if view != *before {
            studio.set_view(view);
        }
    }
}

fn angles(ui: &mut egui::Ui, view: &mut ViewSettings) {
    let mut angles = view.angles();
    let before = angles;
    for (name, tooltip, value) in [
        (texts::YAW, texts::YAW_TIP, &mut angles.yaw),
        (texts::PITCH, texts::PITCH_TIP, &mut angles.pitch),
        (texts::ROLL, texts::ROLL_TIP, &mut angles.roll),
    ] {
        let label = ui.label(name);
        let field = egui::DragValue::new(value).speed(0.5).max_decimals(1).suffix("°");
        ui.add(field).labelled_by(label.id).on_hover_text(tooltip);
        ui.end_row();
    }
    if angles != before {
        view.set_angles(angles);
    }
    choice(
        ui,
        texts::DRAGGING,
        &mut view.turning,
        &[(TurningStyle::Arcball, texts::ARCBALL), (TurningStyle::Turntable, texts::TURNTABLE)],
    );
}

fn lens(ui: &mut egui::Ui, view: &mut ViewSettings) {
    let mut perspective = view.lens != Lens::Orthographic;
    choice(ui, texts::LENS, &mut perspective, &[(false, texts::PARALLEL), (true, texts::PERSPECTIVE)]);
    let mut focal_length = match view.lens {
        Lens::Orthographic => FOCAL_LENGTH,
        Lens::Perspective { focal_length_mm } => focal_length_mm,
    };
    if perspective {
        let label = ui.label(texts::FOCAL_LENGTH);
        let field = egui::DragValue::new(&mut focal_length).range(12.0..=1200.0).speed(1.0).suffix(" mm");
        ui.add(field).labelled_by(label.id).on_hover_text(texts::FOCAL_LENGTH_TIP);
        ui.end_row();
    }
    view.lens =
        if perspective { Lens::Perspective { focal_length_mm: focal_length } } else { Lens::Orthographic };
}

fn shading(ui: &mut egui::Ui, view: &mut ViewSettings, studio: &Context<'_>) {
    let modes: Vec<_> = studio.stage.modes.iter().map(|mode| (mode.id.to_owned(), mode.name)).collect();
    choice(ui, texts::SHADING, &mut view.mode, &modes);
    choice(
        ui,
        texts::AZIMUTH,
        &mut view.cyclic,
        &[
            (Cyclic::Cyclic, texts::CYCLIC),
            (Cyclic::Fragment, texts::FRAGMENT),
            (Cyclic::Naive, texts::NAIVE),
        ],
    );
    choice(
        ui,
        texts::PERSPECTIVE,
        &mut view.perspective,
        &[
            (Perspective::Half, texts::HALF),
            (Perspective::Full, texts::FULL),
            (Perspective::Paper, texts::PAPER),
            (Perspective::Off, texts::OFF),
        ],
    );
}

/// A background of the view's own, in place of the window's colour and of transparency in pictures.
fn background(ui: &mut egui::Ui, view: &mut ViewSettings) {
    ui.horizontal(|ui| {
        let mut own = view.background.is_some();
        if ui.checkbox(&mut own, texts::BACKGROUND).on_hover_text(texts::BACKGROUND_TIP).changed() {
            view.background = own.then_some(BACKGROUND);
        }
        if let Some(colour) = &mut view.background {
            let picker = ui.color_edit_button_srgb(colour).on_hover_text(texts::COLOUR_TIP);
            picker.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ColorWell, true, texts::COLOUR));
        }
    });
}

fn auto_turn(ui: &mut egui::Ui, view: &mut ViewSettings) {
    ui.horizontal(|ui| {
        let mut turns = view.auto_turn.is_some();
        let label = ui.checkbox(&mut turns, AUTO_TURN.name).on_hover_text(AUTO_TURN.tooltip);
        if label.changed() {
            view.auto_turn = turns.then_some(TURNING_SPEED);
        }
        if let Some(speed) = &mut view.auto_turn {
            let range = -ViewSettings::MOST_AUTO_TURN..=ViewSettings::MOST_AUTO_TURN;
            let field = egui::DragValue::new(speed).range(range).speed(1.0).suffix(texts::PER_SECOND);
            ui.add(field).labelled_by(label.id).on_hover_text(texts::PER_SECOND_TIP);
        }
    });
}

/// What a split view begins with: warp and weft swapped, which is what anisotropy is about.
fn first_comparison() -> Comparison {
    Comparison { turned_deg: 90.0, ..Comparison::default() }
}

fn compare(ui: &mut egui::Ui, view: &mut ViewSettings, studio: &Context<'_>) {
    let mut is_split = view.compared.is_some();
    if ui.checkbox(&mut is_split, COMPARE.name).on_hover_text(COMPARE.tooltip).changed() {
        view.compared = is_split.then(first_comparison);
    }
    let Some(compared) = &mut view.compared else { return };
    egui::Grid::new("compare").num_columns(2).show(ui, |ui| {
        let colourways = &studio.document.project().colourways;
        if colourways.count() > 1 {
            let colourways: Vec<_> = std::iter::once((None, texts::SAME_COLOURWAY))
                .chain(colourways.labels().map(|label| (Some(label.id), label.name.as_str())))
                .collect();
            choice(ui, texts::RIGHT_COLOURWAY, &mut compared.colourway, &colourways);
        }
        let fabrics = studio.document.project().fabrics.iter();
        let fabrics: Vec<_> = std::iter::once((None, texts::OWN_FABRIC))
            .chain(fabrics.map(|fabric| (Some(fabric.id), fabric.name.as_str())))
            .collect();
        choice(ui, texts::RIGHT_FABRIC, &mut compared.fabric, &fabrics);
        let label = ui.label(texts::RIGHT_TURNED);
        let field = egui::DragValue::new(&mut compared.turned_deg).range(-360.0..=360.0).suffix("°");
        ui.add(field).labelled_by(label.id).on_hover_text(texts::RIGHT_TURNED_TIP);
        ui.end_row();
        let modes: Vec<_> = std::iter::once((None, texts::SAME_SHADING))
            .chain(studio.stage.modes.iter().map(|mode| (Some(mode.id.to_owned()), mode.name)))
            .collect();
        choice(ui, texts::RIGHT_SHADING, &mut compared.mode, &modes);
    });
}

/// A row with one of several to choose.
fn choice<T: PartialEq + Clone>(ui: &mut egui::Ui, name: &str, value: &mut T, all: &[(T, &str)]) {
    let label = ui.label(name);
    let shown = all.iter().find(|(each, _)| each == value).map_or("", |(_, name)| name);
    let list = egui::ComboBox::from_id_salt(name).selected_text(shown).show_ui(ui, |ui| {
        for (each, name) in all {
            ui.selectable_value(value, each.clone(), *name);
        }
    });
    list.response.labelled_by(label.id);
    ui.end_row();
}

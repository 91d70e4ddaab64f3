//! Colourways: worn by a click, named, compared side by side.

use amc_core::mesh::Garment;
use eframe::egui::{self, Sense, vec2};
use studio_plugin::document::{
    ColourwayId, ColourwayLabel, Comparison, Edit, FabricId, FabricInUse, Project,
};
use studio_plugin::{Command, Context, Pane, Place, Plugin};

use crate::studio::texts::colourways as texts;
use crate::studio::theme::STEP;
use crate::studio::thumbnail::Textures;

/// How large a swatch is, and how far the next is from it.
const SWATCH: f32 = 7.0 * STEP;
const APART: f32 = 4.0 * STEP;

/// The most swatches in a row.
const MOST_SWATCHES: usize = 3;

/// How wide the button is that compares.
const COMPARE_WIDTH: f32 = 18.0 * STEP;

/// The list, and the textures of its balls.
#[derive(Default)]
pub(super) struct Colourways {
    textures: Textures,
    renaming: Option<Renaming>,
}

/// A name that is being typed.
struct Renaming {
    label: ColourwayLabel,
    has_begun: bool,
}

const NEXT: Command = Command { id: "next", name: texts::NEXT, tooltip: texts::STEP_TIP, shortcut: None };
const PREVIOUS: Command =
    Command { id: "previous", name: texts::PREVIOUS, tooltip: texts::STEP_TIP, shortcut: None };
const ADD: Command = Command { id: "add", name: texts::ADD, tooltip: texts::ADD_TIP, shortcut: None };
const UP: Command = Command { id: "up", name: texts::UP, tooltip: texts::MOVE_TIP, shortcut: None };
const DOWN: Command = Command { id: "down", name: texts::DOWN, tooltip: texts::MOVE_TIP, shortcut: None };

impl Plugin for Colourways {
    fn id(&self) -> &'static str {
        "colourways"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn commands(&self) -> Vec<Command> {
        vec![NEXT, PREVIOUS, ADD, UP, DOWN]
    }

    fn can_run(&self, command: &str, studio: &Context<'_>) -> bool {
        let colourways = &studio.document.project().colourways;
        let (place, count) = (colourways.place(), colourways.count());
        match command {
            _ if command == UP.id => place > 0,
            _ if command == DOWN.id => place + 1 < count,
            _ => command == ADD.id || count > 1,
        }
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        let colourways = &studio.document.project().colourways;
        let (colourway, place) = (colourways.worn().id, colourways.place());
        match command {
            _ if command == NEXT.id => wear(colourways.next().id, studio),
            _ if command == PREVIOUS.id => wear(colourways.previous().id, studio),
            _ if command == UP.id => {
                studio.submit(Edit::MoveColourway { colourway, place: place.saturating_sub(1) });
            }
            _ if command == DOWN.id => studio.submit(Edit::MoveColourway { colourway, place: place + 1 }),
            _ => studio.submit(Edit::AddColourway(colourways.free_label())),
        }
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "list", title: texts::NAME, place: Place::Left }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        ui.weak(texts::HINT);
        ui.add_space(STEP);
        let labels: Vec<ColourwayLabel> = studio.document.project().colourways.labels().cloned().collect();
        if self.renaming.as_ref().is_some_and(|it| labels.iter().all(|label| label.id != it.label.id)) {
            self.renaming = None;
        }
        for label in &labels {
            ui.horizontal(|ui| self.row(ui, label, studio));
        }
        ui.add_space(STEP);
        ui.horizontal_wrapped(|ui| self.buttons(ui, labels.len(), studio));
    }
}

impl Colourways {
    fn row(&mut self, ui: &mut egui::Ui, label: &ColourwayLabel, studio: &mut Context<'_>) {
        ui.spacing_mut().item_spacing.x = STEP;
        let garment = studio.stage.garment.clone();
        let project = studio.document.project();
        let fabrics = garment.map_or_else(Vec::new, |garment| worn_in(project, label.id, &garment));
        let ids: Vec<FabricId> = fabrics.iter().map(|fabric| fabric.id).collect();
        let names: Vec<&str> = fabrics.iter().map(|fabric| fabric.name.as_str()).collect();
        let said = texts::row(&label.name, &names);
        let is_worn = project.colourways.worn().id == label.id;
        let compared = project.view.compared.as_ref().and_then(|compared| compared.colourway);
        self.swatches(ui, &ids, studio);
        let width = (ui.available_width() - COMPARE_WIDTH - STEP).max(COMPARE_WIDTH);
        ui.allocate_ui(vec2(width, SWATCH), |ui| {
            if self.renaming.as_ref().is_some_and(|renaming| renaming.label.id == label.id) {
                return self.field(ui, label, studio);
            }
            let row = egui::Button::selectable(is_worn, &label.name).right_text("").truncate();
            let row = ui.add(row.min_size(vec2(width, SWATCH))).on_hover_text(texts::WEAR_TIP);
            row.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::RadioButton, true, is_worn, said.as_str())
            });
            if row.double_clicked() {
                self.renaming = Some(Renaming { label: label.clone(), has_begun: false });
            } else if row.clicked() && !is_worn {
                wear(label.id, studio);
            }
        });
        if !is_worn {
            let is_compared = compared == Some(label.id);
            let button = egui::Button::new(texts::COMPARE).selected(is_compared);
            let button = ui.add(button.min_size(vec2(COMPARE_WIDTH, SWATCH)));
            let button = button.on_hover_text(texts::COMPARE_TIP);
            button.widget_info(|| {
                let said = texts::compare(&label.name);
                egui::WidgetInfo::selected(egui::Role::Button, true, is_compared, said)
            });
            if button.clicked() {
                compare((!is_compared).then_some(label.id), studio);
            }
        }
    }

    /// Balls in the first few of the fabrics, one over the other.
    fn swatches(&mut self, ui: &mut egui::Ui, fabrics: &[FabricId], studio: &Context<'_>) {
        let width = SWATCH + (MOST_SWATCHES - 1) as f32 * APART;
        let (rect, _) = ui.allocate_exact_size(vec2(width, SWATCH), Sense::hover());
        let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
        let balls = fabrics.iter().filter_map(|id| studio.stage.swatches.get(id)).take(MOST_SWATCHES);
        for (k, ball) in balls.enumerate() {
            let corner = rect.min + vec2(k as f32 * APART, 0.0);
            let place = egui::Rect::from_min_size(corner, vec2(SWATCH, SWATCH));
            ui.painter().image(self.textures.of(ui, ball), place, whole, egui::Color32::WHITE);
        }
    }

    /// The name as it is typed. It counts when the field is left, but by Escape.
    fn field(&mut self, ui: &mut egui::Ui, label: &ColourwayLabel, studio: &mut Context<'_>) {
        let Some(renaming) = &mut self.renaming else { return };
        let field = egui::TextEdit::singleline(&mut renaming.label.name)
            .char_limit(Project::LONGEST_NAME / 4)
            .desired_width(ui.available_width());
        let field = ui.add(field);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, texts::NAME_FIELD));
        if !renaming.has_begun {
            field.request_focus();
            select_all(ui, &field, &renaming.label.name);
            renaming.has_begun = true;
        } else if !field.has_focus() {
            let name = renaming.label.name.trim().to_owned();
            let is_meant = !name.is_empty() && name != label.name;
            if is_meant && !ui.input(|input| input.key_pressed(egui::Key::Escape)) {
                studio.submit(Edit::RenameColourway(ColourwayLabel { name, ..label.clone() }));
            }
            self.renaming = None;
        }
    }

    fn buttons(&mut self, ui: &mut egui::Ui, count: usize, studio: &mut Context<'_>) {
        if ui.button(texts::ADD).on_hover_text(texts::ADD_TIP).clicked() {
            let label = studio.document.project().colourways.free_label();
            studio.submit(Edit::AddColourway(label.clone()));
            self.renaming = Some(Renaming { label, has_begun: false });
        }
        let worn = studio.document.project().colourways.worn().clone();
        if ui.button(texts::RENAME).on_hover_text(texts::RENAME_TIP).clicked() {
            self.renaming = Some(Renaming { label: worn.clone(), has_begun: false });
        }
        let remove = ui.add_enabled(count > 1, egui::Button::new(texts::REMOVE));
        if remove.on_hover_text(texts::REMOVE_TIP).clicked() {
            studio.submit(Edit::RemoveColourway(worn.id));
        }
    }
}

/// All of a field's text is selected, so that typing replaces it.
fn select_all(ui: &egui::Ui, field: &egui::Response, text: &str) {
    let mut state = egui::TextEdit::load_state(ui, field.id).unwrap_or_default();
    state.cursor.set_char_range(Some(egui::text::CCursorRange::select_all_str(text)));
    egui::TextEdit::store_state(ui, field.id, state);
}

/// The fabrics that are worn in a colourway, in the order of the project's.
fn worn_in<'a>(project: &'a Project, colourway: ColourwayId, garment: &Garment) -> Vec<&'a FabricInUse> {
    let worn: Vec<Option<FabricId>> =
        garment.panels.iter().map(|panel| project.look_in(colourway, panel).fabric).collect();
    project.fabrics.iter().filter(|fabric| worn.contains(&Some(fabric.id))).collect()
}

/// Wears a colourway. One that is compared with the worn one changes places with it.
fn wear(colourway: ColourwayId, studio: &mut Context<'_>) {
    let project = studio.document.project();
    let before = project.colourways.worn().id;
    if before == colourway {
        return;
    }
    let mut view = project.view.clone();
    if let Some(compared) = view.compared.as_mut().filter(|it| it.colourway == Some(colourway)) {
        compared.colourway = Some(before);
        studio.set_view(view);
    }
    studio.submit(Edit::WearColourway(colourway));
}

/// Shows a colourway right of a divider; none: the view is whole.
fn compare(colourway: Option<ColourwayId>, studio: &mut Context<'_>) {
    let mut view = studio.document.project().view.clone();
    view.compared = colourway.map(|_| Comparison { colourway, ..Comparison::default() });
    studio.set_view(view);
}

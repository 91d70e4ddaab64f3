//! Prints: a picture over the fabric of the selected panels, and how it lies.

use std::path::Path;
use std::sync::Arc;

use amc_core::mesh::Panel;
use amc_core::render::{Laying, Print};
use eframe::egui::{self, vec2};
use studio_plugin::document::{Asset, Edit, Gesture, PanelPrint};
use studio_plugin::{Ask, Command, Context, FileKind, Importer, Pane, Place, Plugin};

use super::picked;
use crate::studio::texts::{OPENING, print as texts};
use crate::studio::theme::STEP;
use crate::studio::thumbnail::Textures;

/// How wide the preview is, steps.
const PREVIEW: f32 = 24.0;

/// The pane, and its preview.
#[derive(Default)]
pub(super) struct Prints {
    /// A drag of a number is one gesture.
    dragged: Option<Gesture>,
    preview: Option<(Arc<Print>, Arc<egui::ColorImage>)>,
    textures: Textures,
}

const CHOOSE: Command =
    Command { id: "choose", name: texts::CHOOSE, tooltip: texts::CHOOSE_TIP, shortcut: None };
const REMOVE: Command =
    Command { id: "remove", name: texts::REMOVE, tooltip: texts::REMOVE_TIP, shortcut: None };

const SUFFIXES: &[&str] = &["png", "jpg", "jpeg", "exr"];

impl Plugin for Prints {
    fn id(&self) -> &'static str {
        "prints"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn commands(&self) -> Vec<Command> {
        vec![CHOOSE, REMOVE]
    }

    fn can_run(&self, command: &str, studio: &Context<'_>) -> bool {
        let Some(garment) = &studio.stage.garment else { return false };
        let project = studio.document.project();
        command == CHOOSE.id || picked(garment, studio).iter().any(|panel| project.print(&panel.id).is_some())
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        if command == CHOOSE.id {
            const KINDS: &[FileKind] = &[FileKind { name: texts::PICTURES, suffixes: SUFFIXES }];
            let (title, name) = (texts::TITLE.to_owned(), String::new());
            studio.ask_which(Ask { id: CHOOSE.id, title, name, kinds: KINDS });
        } else {
            set(None, studio);
        }
    }

    fn chosen(&mut self, _what: &str, file: &Path, studio: &mut Context<'_>) {
        self.import(file, studio);
    }

    fn importers(&self) -> Vec<Importer> {
        vec![Importer { name: texts::PICTURES, suffixes: SUFFIXES }]
    }

    fn import(&mut self, file: &Path, studio: &mut Context<'_>) {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        let laying = first(studio).map(|print| print.laying).unwrap_or_default();
        set(Some(PanelPrint { picture: Asset::file(file), laying }), studio);
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "print", title: texts::NAME, place: Place::Left }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else {
            ui.weak(OPENING);
            return;
        };
        let panels = picked(&garment, studio);
        ui.weak(texts::HINT);
        ui.add_space(STEP);
        match first(studio) {
            Some(print) => self.form(ui, &print, &panels, studio),
            None => {
                if ui.button(texts::CHOOSE).on_hover_text(texts::CHOOSE_TIP).clicked() {
                    self.run(CHOOSE.id, studio);
                }
            }
        }
        if let [panel] = panels.as_slice() {
            ui.add_space(STEP);
            if garment.uv_to_metres(panel).is_none() {
                ui.label(texts::NO_UVS);
            } else if studio.document.project().look_of(panel).fabric.is_none() {
                ui.label(texts::NO_FABRIC);
            }
        }
    }
}

/// The print of the first of the picked panels that has one.
fn first(studio: &Context<'_>) -> Option<PanelPrint> {
    let project = studio.document.project();
    let panels = picked(studio.stage.garment.as_ref()?, studio);
    panels.iter().find_map(|panel| project.print(&panel.id)).cloned()
}

/// Gives the picked panels `print`.
fn set(print: Option<PanelPrint>, studio: &mut Context<'_>) {
    let Some(garment) = &studio.stage.garment else { return };
    let panels = picked(garment, studio).iter().map(|panel| panel.id.clone()).collect();
    studio.submit(Edit::SetPrint { panels, print });
}

impl Prints {
    fn form(&mut self, ui: &mut egui::Ui, print: &PanelPrint, panels: &[&Panel], studio: &mut Context<'_>) {
        ui.strong(print.picture.name());
        if let Some(there) = studio.stage.prints.get(&print.picture) {
            let (there, width) = (Arc::clone(there), (PREVIEW * STEP).min(ui.available_width()));
            let size = vec2(width, width * there.aspect().clamp(0.25, 1.5));
            let image = self.preview(&there);
            let texture = self.textures.of(ui, &image);
            ui.add(egui::Image::new((texture, size)).alt_text(print.picture.name()));
        }
        let project = studio.document.project();
        let is_other =
            |panel: &&&Panel| project.print(&panel.id).is_none_or(|it| it.picture != print.picture);
        match panels.iter().filter(is_other).count() {
            0 => {}
            others => drop(ui.weak(texts::others(others))),
        }
        ui.add_space(STEP);
        let mut laying = print.laying;
        self.numbers(ui, &mut laying);
        if laying != print.laying {
            let edit =
                Edit::LayPrint { panels: panels.iter().map(|panel| panel.id.clone()).collect(), laying };
            match self.dragged {
                Some(gesture) => studio.submit_in(gesture, edit),
                None => studio.submit(edit),
            }
        }
        if ui.input(|input| input.pointer.any_released()) {
            self.dragged = None;
        }
        ui.add_space(STEP);
        if ui.button(texts::OTHER).on_hover_text(texts::CHOOSE_TIP).clicked() {
            self.run(CHOOSE.id, studio);
        }
        if ui.button(texts::REMOVE).on_hover_text(texts::REMOVE_TIP).clicked() {
            self.run(REMOVE.id, studio);
        }
    }

    fn numbers(&mut self, ui: &mut egui::Ui, laying: &mut Laying) {
        let farthest = PanelPrint::WIDEST * 100.0;
        let mut centimetres = [laying.width, laying.shift.x, laying.shift.y].map(|metres| metres * 100.0);
        let mut degrees = laying.turn.to_degrees();
        let before = (centimetres, degrees);
        let [width, across, up] = &mut centimetres;
        let rows = [
            (texts::WIDTH, texts::WIDTH_TIP, texts::CENTIMETRES, width, PanelPrint::NARROWEST * 100.0),
            (texts::TURN, texts::TURN_TIP, texts::DEGREES, &mut degrees, -farthest),
            (texts::ACROSS, texts::ACROSS_TIP, texts::CENTIMETRES, across, -farthest),
            (texts::UP, texts::UP_TIP, texts::CENTIMETRES, up, -farthest),
        ];
        egui::Grid::new("print").num_columns(2).show(ui, |ui| {
            for (name, tooltip, suffix, value, least) in rows {
                let label = ui.label(name);
                let field = egui::DragValue::new(value).speed(0.1).max_decimals(1).suffix(suffix);
                let field =
                    ui.add(field.range(least..=farthest)).labelled_by(label.id).on_hover_text(tooltip);
                if field.drag_started() {
                    self.dragged = Some(Gesture::begin());
                }
                ui.end_row();
            }
        });
        // What nobody has touched keeps its last bit.
        if before != (centimetres, degrees) {
            let [width, across, up] = centimetres.map(|centimetres| centimetres / 100.0);
            (laying.width, laying.turn) = (width, degrees.to_radians());
            laying.shift = glam::Vec2::new(across, up);
        }
        ui.checkbox(&mut laying.is_repeated, texts::REPEAT).on_hover_text(texts::REPEAT_TIP);
    }

    /// A small picture of the print that was shown last.
    fn preview(&mut self, print: &Arc<Print>) -> Arc<egui::ColorImage> {
        if let Some((known, image)) = &self.preview
            && Arc::ptr_eq(known, print)
        {
            return Arc::clone(image);
        }
        let wanted = 4 * (PREVIEW * STEP) as u32;
        let level = print.levels().iter().find(|level| level.width.max(level.height) <= wanted);
        let image = level.map_or_else(
            || egui::ColorImage::filled([1, 1], egui::Color32::WHITE),
            |level| {
                let size = [level.width as usize, level.height as usize];
                egui::ColorImage::from_rgba_unmultiplied(size, level.texels.as_flattened())
            },
        );
        let image = Arc::new(image);
        self.preview = Some((Arc::clone(print), Arc::clone(&image)));
        image
    }
}

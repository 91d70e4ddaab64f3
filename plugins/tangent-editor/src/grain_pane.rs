//! The pane of the grain: the picked panels' direction by number, by name, by what it is aligned to.

use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::mesh::Garment;
use egui::Ui;
use studio_plugin::Context;
use studio_plugin::document::Gesture;

use crate::assignments::{Assignments, Orientation};
use crate::commands::{self, COMMANDS, Given};
use crate::grain::{self, expression, partners};
use crate::pattern::shown_degrees;
use crate::sheet::Sheet;
use crate::texts;
use crate::warnings::{self, Warning};

/// Between groups, points.
const SPACE: f32 = 8.0;

/// What the pane remembers from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct GrainPane {
    dragged: Option<Gesture>,
    /// What is odd, in the document of this revision and this garment.
    odd: Option<(u64, Arc<Garment>, Vec<Warning>)>,
}

impl GrainPane {
    /// Draws it; gives the id of a command that was clicked.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        sheet: &Sheet,
        given: &Given,
        studio: &mut Context<'_>,
    ) -> Option<&'static str> {
        let garment = &sheet.garment;
        let panels = grain::picked(garment, studio);
        match (studio.selection.panels.len(), panels.as_slice()) {
            (0, _) => ui.heading(texts::ALL),
            (_, [panel]) => ui.heading(&garment.panels[*panel].name),
            (count, _) => ui.heading(texts::panels(count)),
        };
        self.angle(ui, sheet, &panels, studio);
        let mut clicked = None;
        let mut row = |ui: &mut Ui,
                       title: Option<&str>,
                       ids: &[(&'static str, &str)],
                       studio: &Context<'_>| {
            ui.add_space(SPACE);
            title.into_iter().for_each(|title| drop(ui.weak(title)));
            ui.horizontal_wrapped(|ui| {
                for &(id, short) in ids {
                    let Some(command) = COMMANDS.iter().find(|command| command.id == id) else { continue };
                    let button =
                        ui.add_enabled(commands::can_run(id, sheet, given, studio), egui::Button::new(short));
                    if button.on_hover_text(format!("{}. {}", command.name, command.tooltip)).clicked() {
                        clicked = Some(id);
                    }
                }
            });
        };
        row(
            ui,
            None,
            &[("turn-left", texts::LEFT_90), ("turn-right", texts::RIGHT_90), ("turn-around", texts::AROUND)],
            studio,
        );
        let cuts = [
            ("warp", texts::WARP_SHORT),
            ("weft", texts::WEFT_SHORT),
            ("bias-45", texts::BIAS_45_SHORT),
            ("bias-135", texts::BIAS_135_SHORT),
        ];
        row(ui, Some(texts::PRESETS), &cuts, studio);
        let aligned = [
            ("align-edge", texts::EDGE_SHORT),
            ("align-partner", texts::PARTNER_SHORT),
            ("align-up", texts::UP_SHORT),
            ("align-across", texts::ACROSS_SHORT),
            ("align-forward", texts::FORWARD_SHORT),
        ];
        row(ui, Some(texts::ALIGN), &aligned, studio);
        let copied = [
            ("copy", texts::SHORT_COPY),
            ("paste", texts::SHORT_PASTE),
            ("paste-relative", texts::SHORT_PASTE_RELATIVE),
            ("paste-mirrored", texts::SHORT_PASTE_MIRRORED),
            ("mirror", texts::SHORT_MIRROR),
            ("reset", texts::SHORT_RESET),
        ];
        row(ui, Some(texts::GRAIN), &copied, studio);
        let lying = [
            ("lie-left", texts::LEFT_90),
            ("lie-right", texts::RIGHT_90),
            ("lie-drawn", texts::SHORT_LIE_DRAWN),
        ];
        row(ui, Some(texts::LIE), &lying, studio);
        ui.add_space(SPACE);
        said(ui, sheet, &panels, studio);
        self.told(ui, sheet, studio);
        clicked
    }

    /// What to look at; a click selects the panel.
    fn told(&mut self, ui: &mut Ui, sheet: &Sheet, studio: &mut Context<'_>) {
        let revision = studio.document.revision();
        let is_known =
            |odd: &(u64, Arc<Garment>, _)| odd.0 == revision && Arc::ptr_eq(&odd.1, &sheet.garment);
        let found = match self.odd.take().filter(is_known) {
            Some(known) => known.2,
            None => warnings::warnings(sheet, studio.document.project()),
        };
        if !found.is_empty() {
            ui.add_space(SPACE);
            ui.weak(texts::WARNINGS);
        }
        for warning in &found {
            let text = egui::RichText::new(&warning.text).color(ui.visuals().warn_fg_color);
            if ui.add(egui::Button::new(text).wrap().frame(false)).clicked() {
                studio.selection.click(&sheet.garment.panels[warning.panel].id, false);
            }
        }
        self.odd = Some((revision, Arc::clone(&sheet.garment), found));
    }

    /// The angle of the first panel; all are turned with it. A drag of it is one gesture.
    fn angle(&mut self, ui: &mut Ui, sheet: &Sheet, panels: &[usize], studio: &mut Context<'_>) {
        let Some(piece) = panels.iter().find_map(|&panel| sheet.piece(panel)) else { return };
        let before = shown_degrees(sheet, piece, studio);
        let mut degrees = f64::from(before);
        ui.horizontal(|ui| {
            let label = ui.label(texts::ANGLE);
            let field = egui::DragValue::new(&mut degrees).speed(0.5).max_decimals(1).suffix(texts::DEGREES);
            let field = field.custom_parser(expression::value).update_while_editing(false);
            let field = ui.add(field).labelled_by(label.id).on_hover_text(texts::ANGLE_TIP);
            if field.drag_started() {
                self.dragged = Some(Gesture::begin());
            }
            if degrees != f64::from(before) {
                let now = grain::direction(sheet.panel(piece), studio.document.project());
                let along = glam::Vec2::from_angle(degrees.to_radians() as f32 + piece.turn);
                let wanted = Direction::along_cloth(now.source, along, piece.uv_to_sheet.matrix2);
                grain::turn(panels, wanted.angle - now.angle, self.dragged, &sheet.garment, studio);
            }
            if field.drag_stopped() {
                self.dragged = None;
            }
        });
    }
}

/// Laying, lock, partner.
fn said(ui: &mut Ui, sheet: &Sheet, panels: &[usize], studio: &mut Context<'_>) {
    let garment = &sheet.garment;
    let assignments = match Assignments::of(studio.document.project()) {
        Ok(assignments) => assignments,
        Err(error) => {
            ui.label(error.to_string());
            return;
        }
    };
    let of = |panel: usize| assignments.panel(&garment.panels[panel].id);
    let Some(&first) = panels.first() else { return };
    let ids: Vec<&str> = panels.iter().map(|&panel| garment.panels[panel].id.as_str()).collect();
    let now = of(first);
    let name = |orientation: Orientation| match orientation {
        Orientation::TwoWay => texts::TWO_WAY,
        Orientation::OneWay => texts::ONE_WAY,
        Orientation::Nap => texts::NAP,
    };
    let is_same = panels.iter().all(|&panel| of(panel).orientation == now.orientation);
    ui.horizontal(|ui| {
        let label = ui.label(texts::ORIENTATION);
        let shown = if is_same { name(now.orientation) } else { texts::SEVERAL };
        let list = egui::ComboBox::from_id_salt("orientation").selected_text(shown).show_ui(ui, |ui| {
            for orientation in Orientation::ALL {
                if ui.selectable_label(is_same && orientation == now.orientation, name(orientation)).clicked()
                {
                    let what = texts::laid(ids.len(), name(orientation));
                    let change = |it: &mut crate::assignments::Assignment| it.orientation = orientation;
                    studio.submit(assignments.clone().changed(ids.iter().copied(), what, change));
                }
            }
        });
        list.response.labelled_by(label.id).on_hover_text(texts::ORIENTATION_TIP);
    });
    let mut is_locked = panels.iter().all(|&panel| of(panel).is_locked);
    if ui.checkbox(&mut is_locked, texts::LOCK).on_hover_text(texts::LOCK_TIP).changed() {
        let what = texts::locking(ids.len(), is_locked);
        studio.submit(assignments.clone().changed(ids.iter().copied(), what, |it| it.is_locked = is_locked));
    }
    let partnered: Vec<usize> =
        panels.iter().copied().filter(|&panel| partners::partner(garment, panel).is_some()).collect();
    if partnered.is_empty() {
        return;
    }
    let mut is_linked = partnered.iter().all(|&panel| of(panel).is_linked);
    if ui.checkbox(&mut is_linked, texts::LINK).on_hover_text(texts::LINK_TIP).changed() {
        let both = partnered
            .iter()
            .flat_map(|&panel| std::iter::once(panel).chain(partners::partner(garment, panel)));
        let mut both: Vec<&str> = both.map(|panel| garment.panels[panel].id.as_str()).collect();
        both.sort_unstable();
        both.dedup();
        let what = texts::linking(partnered.len(), is_linked);
        studio.submit(assignments.clone().changed(both, what, |it| it.is_linked = is_linked));
    }
    if let [panel] = partnered.as_slice()
        && let Some(partner) = partners::partner(garment, *panel)
    {
        ui.weak(texts::partner(studio.document.project().panel_name(&garment.panels[partner])));
    }
}

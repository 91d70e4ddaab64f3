//! The pane of the comb: strokes of the selected panel, and what its direction follows elsewhere.

use amc_core::direction::Field;
use amc_core::direction::comb::{Comb, Elsewhere, Hold};
use amc_core::mesh::Garment;
use egui::Ui;
use glam::{Vec2, Vec3};
use studio_plugin::Context;
use studio_plugin::document::Gesture;

use super::{Chosen, Stylus, TOOL, comb_of, is_flat, is_free, submit};
use crate::grain;
use crate::sheet::Sheet;
use crate::texts::comb as texts;

/// Between groups, points.
const SPACE: f32 = 8.0;
/// A soft stroke's weight until another is chosen.
const WEIGHT: f32 = 1.0;

/// What the pane remembers from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct CombPane {
    dragged: Option<Gesture>,
}

impl CombPane {
    /// Draws it.
    pub(crate) fn show(&mut self, ui: &mut Ui, sheet: &Sheet, stylus: &mut Stylus, studio: &mut Context<'_>) {
        let garment = &*sheet.garment;
        let holds = studio.holds(TOOL);
        ui.horizontal_wrapped(|ui| {
            let draw = ui.add(egui::Button::new(texts::DRAW).selected(holds));
            if draw.on_hover_text(texts::DRAW_TIP).clicked() {
                studio.take(TOOL);
            }
        });
        ui.add_space(SPACE);
        ui.weak(texts::NEW);
        (stylus.hold, stylus.radius) = followed(ui, (stylus.hold, stylus.radius), &mut self.dragged).0;
        ui.add_space(SPACE);
        let panels = grain::picked(garment, studio);
        let &[panel] = panels.as_slice() else {
            ui.label(texts::ONE_PANEL);
            return;
        };
        let of = &garment.panels[panel];
        ui.heading(&of.name);
        let before = comb_of(studio.document.project(), &of.id);
        let mut comb = before.clone();
        let mut change = self.strokes(ui, panel, &mut comb, stylus, studio);
        change = self.elsewhere(ui, sheet, panel, &mut comb).or(change);
        self.said(ui, panel, studio);
        if comb != Comb::default() {
            ui.add_space(SPACE);
            if ui.button(texts::REMOVE).on_hover_text(texts::REMOVE_TIP).clicked() {
                (comb, change) = (Comb::default(), Some(texts::REMOVED));
            }
        }
        if let Some(what) = change.filter(|_| comb != before)
            && is_free(&of.id, studio)
        {
            submit(&of.id, comb, what, self.dragged, studio);
        }
        if !ui.input(|input| input.pointer.any_down()) {
            self.dragged = None;
        }
    }

    /// The list of strokes, and what can be changed of the chosen one. Gives what was done.
    fn strokes(
        &mut self,
        ui: &mut Ui,
        panel: usize,
        comb: &mut Comb,
        stylus: &mut Stylus,
        studio: &Context<'_>,
    ) -> Option<&'static str> {
        let mut what = None;
        let mut gone = None;
        let unplaced = unplaced(panel, studio);
        for (number, stroke) in comb.strokes.iter_mut().enumerate() {
            let this = Chosen { panel, stroke: number };
            let name = texts::stroke(number + 1);
            ui.horizontal(|ui| {
                let tick = ui.checkbox(&mut stroke.is_on, "").on_hover_text(texts::ON_TIP);
                tick.widget_info(|| {
                    egui::WidgetInfo::selected(egui::Role::CheckBox, true, stroke.is_on, texts::on(&name))
                });
                if tick.changed() {
                    what = Some(if stroke.is_on { texts::SWITCHED_ON } else { texts::SWITCHED_OFF });
                }
                if ui.selectable_label(stylus.chosen == Some(this), &name).clicked() {
                    stylus.chosen = Some(this);
                }
                let delete = ui.button(texts::DELETE).on_hover_text(texts::DELETE_TIP);
                delete.widget_info(|| {
                    egui::WidgetInfo::labeled(egui::Role::Button, true, texts::delete(&name))
                });
                if delete.clicked() {
                    gone = Some(number);
                }
                if unplaced.contains(&number) {
                    ui.label(egui::RichText::new(texts::UNPLACED).color(ui.visuals().warn_fg_color))
                        .on_hover_text(texts::UNPLACED_TIP);
                }
            });
        }
        if let Some(number) = gone {
            comb.strokes.remove(number);
            stylus.chosen = None;
            return Some(texts::DELETED);
        }
        let chosen = stylus.chosen.filter(|chosen| chosen.panel == panel)?;
        let stroke = comb.strokes.get_mut(chosen.stroke)?;
        ui.indent("chosen", |ui| {
            let ((hold, radius), is_changed) = followed(ui, (stroke.hold, stroke.radius), &mut self.dragged);
            if is_changed {
                (stroke.hold, stroke.radius, what) = (hold, radius, Some(texts::FOLLOWED));
            }
            if ui.button(texts::REVERSE).on_hover_text(texts::REVERSE_TIP).clicked() {
                let points = super::points(stroke).into_iter().rev().collect();
                super::set_points(stroke, points);
                what = Some(texts::REVERSED);
            }
        });
        what
    }

    /// What the direction follows away from strokes.
    fn elsewhere(
        &mut self,
        ui: &mut Ui,
        sheet: &Sheet,
        panel: usize,
        comb: &mut Comb,
    ) -> Option<&'static str> {
        let mut what = None;
        ui.add_space(SPACE);
        let now = Away::of(comb.elsewhere);
        ui.horizontal(|ui| {
            let label = ui.label(texts::ELSEWHERE);
            let shown = now.map_or(texts::OTHER, Away::name);
            let list = egui::ComboBox::from_id_salt("elsewhere").selected_text(shown);
            let list = list.width(ui.available_width()).truncate().show_ui(ui, |ui| {
                for away in Away::ALL {
                    let is_there = is_flat(sheet, panel) || !matches!(away, Away::Radial | Away::Circular);
                    let item = egui::Button::selectable(now == Some(away), away.name());
                    if ui.add_enabled(is_there, item).clicked() && now != Some(away) {
                        (comb.elsewhere, what) = (away.about(sheet, panel), Some(texts::ELSEWHERE_CHANGED));
                    }
                }
            });
            list.response.labelled_by(label.id).on_hover_text(texts::ELSEWHERE_TIP);
        });
        if matches!(comb.elsewhere, Elsewhere::Radial(_) | Elsewhere::Circular(_)) {
            ui.weak(texts::CENTRE);
        }
        let mut reach = comb.reach * 100.0;
        if length(ui, texts::REACH, texts::REACH_TIP, &mut reach, &mut self.dragged) {
            (comb.reach, what) = (reach / 100.0, Some(texts::REACH_CHANGED));
        }
        ui.horizontal(|ui| {
            ui.label(texts::ALONG);
            for (name, turn) in [(texts::WARP, 0.0), (texts::WEFT, std::f32::consts::FRAC_PI_2)] {
                let is_so = (comb.turn - turn).abs() < 1e-4;
                if ui.selectable_label(is_so, name).on_hover_text(texts::ALONG_TIP).clicked() && !is_so {
                    (comb.turn, what) = (turn, Some(texts::TURNED));
                }
            }
        });
        what
    }

    /// How many singular points the field has.
    fn said(&self, ui: &mut Ui, panel: usize, studio: &Context<'_>) {
        let field = studio.stage.directions.as_ref().and_then(|drawn| drawn.fields.get(panel)?.clone());
        if let Some(field) = field {
            ui.add_space(SPACE);
            ui.label(texts::singular(field.singularities.len())).on_hover_text(texts::SINGULAR_TIP);
        }
    }
}

/// The strokes of a panel that have no say.
fn unplaced(panel: usize, studio: &Context<'_>) -> Vec<usize> {
    let drawn = studio.stage.directions.as_ref();
    let field = drawn.and_then(|drawn| drawn.fields.get(panel)?.as_ref());
    field.map(|field| field.unplaced.clone()).unwrap_or_default()
}

/// What can be chosen for elsewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Away {
    Own,
    Smooth,
    Boundary,
    Radial,
    Circular,
    AlongX,
    AlongY,
    AlongZ,
    AroundY,
}

impl Away {
    const ALL: [Self; 9] = [
        Self::Own,
        Self::Smooth,
        Self::Boundary,
        Self::Radial,
        Self::Circular,
        Self::AlongX,
        Self::AlongY,
        Self::AlongZ,
        Self::AroundY,
    ];

    /// None for a field that can be made only by hand, in a file.
    fn of(elsewhere: Elsewhere) -> Option<Self> {
        Some(match elsewhere {
            Elsewhere::Own => Self::Own,
            Elsewhere::Smooth => Self::Smooth,
            Elsewhere::Boundary => Self::Boundary,
            Elsewhere::Radial(_) => Self::Radial,
            Elsewhere::Circular(_) => Self::Circular,
            Elsewhere::Field(Field::Along { direction: Vec3::X }) => Self::AlongX,
            Elsewhere::Field(Field::Along { direction: Vec3::Y }) => Self::AlongY,
            Elsewhere::Field(Field::Along { direction: Vec3::Z }) => Self::AlongZ,
            Elsewhere::Field(Field::Around { direction: Vec3::Y, .. }) => Self::AroundY,
            Elsewhere::Field(_) => return None,
        })
    }

    fn name(self) -> &'static str {
        match self {
            Self::Own => texts::OWN,
            Self::Smooth => texts::SMOOTH,
            Self::Boundary => texts::BOUNDARY,
            Self::Radial => texts::RADIAL,
            Self::Circular => texts::CIRCULAR,
            Self::AlongX => texts::ALONG_X,
            Self::AlongY => texts::ALONG_Y,
            Self::AlongZ => texts::ALONG_Z,
            Self::AroundY => texts::AROUND_Y,
        }
    }

    /// On a panel; centres are in its middle.
    fn about(self, sheet: &Sheet, panel: usize) -> Elsewhere {
        let along = |direction| Elsewhere::Field(Field::Along { direction });
        let flat_middle = || {
            let piece = sheet.piece(panel);
            piece.map_or(Vec2::ZERO, |piece| piece.uv_to_sheet.inverse().transform_point2(piece.middle))
        };
        match self {
            Self::Own => Elsewhere::Own,
            Self::Smooth => Elsewhere::Smooth,
            Self::Boundary => Elsewhere::Boundary,
            Self::Radial => Elsewhere::Radial(flat_middle()),
            Self::Circular => Elsewhere::Circular(flat_middle()),
            Self::AlongX => along(Vec3::X),
            Self::AlongY => along(Vec3::Y),
            Self::AlongZ => along(Vec3::Z),
            Self::AroundY => {
                let origin = middle(&sheet.garment, panel);
                Elsewhere::Field(Field::Around { origin, direction: Vec3::Y })
            }
        }
    }
}

/// The mean of a panel's corners, object space.
fn middle(garment: &Garment, panel: usize) -> Vec3 {
    let range = &garment.panels[panel].triangles;
    let triangles = garment.triangles.get(range.start as usize..range.end as usize).unwrap_or_default();
    let corners = triangles.as_flattened();
    let sum: Vec3 = corners.iter().map(|&corner| garment.positions[corner as usize]).sum();
    sum / corners.len().max(1) as f32
}

/// How a stroke is followed: exactly or softly, and how wide.
fn followed(
    ui: &mut Ui,
    (mut hold, radius): (Hold, f32),
    dragged: &mut Option<Gesture>,
) -> ((Hold, f32), bool) {
    let before = (hold, radius);
    ui.horizontal(|ui| {
        let is_exact = hold == Hold::Exact;
        if ui.selectable_label(is_exact, texts::EXACT).on_hover_text(texts::EXACT_TIP).clicked() {
            hold = Hold::Exact;
        }
        if ui.selectable_label(!is_exact, texts::SOFT).on_hover_text(texts::SOFT_TIP).clicked() && is_exact {
            hold = Hold::Soft(WEIGHT);
        }
        if let Hold::Soft(weight) = &mut hold {
            let field = egui::DragValue::new(weight).speed(0.05).range(0.01..=Comb::MOST_WEIGHT);
            let field = ui.add(field).on_hover_text(texts::WEIGHT_TIP);
            field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::SpinButton, true, texts::WEIGHT));
            if field.drag_started() {
                *dragged = Some(Gesture::begin());
            }
        }
    });
    let mut centimetres = radius * 100.0;
    length(ui, texts::RADIUS, texts::RADIUS_TIP, &mut centimetres, dragged);
    let after = (hold, if centimetres == radius * 100.0 { radius } else { centimetres / 100.0 });
    (after, after != before)
}

/// A length in centimetres; says whether it was changed.
fn length(ui: &mut Ui, name: &str, tip: &str, centimetres: &mut f32, dragged: &mut Option<Gesture>) -> bool {
    ui.horizontal(|ui| {
        let label = ui.label(name);
        let range = Comb::SHORTEST * 100.0..=Comb::LONGEST * 100.0;
        let field = egui::DragValue::new(centimetres).speed(0.1).range(range).max_decimals(2).suffix(" cm");
        let field = ui.add(field).labelled_by(label.id).on_hover_text(tip);
        if field.drag_started() {
            *dragged = Some(Gesture::begin());
        }
        field.changed()
    })
    .inner
}

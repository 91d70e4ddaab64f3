//! The divider between the two looks of a split view.

use eframe::egui;

use super::texts;

/// Width of what can be grabbed, points.
const GRIP: f32 = 12.0;
/// What an arrow key moves the divider by, as a share of the width.
const KEY_STEP: f32 = 0.02;

/// Where the divider stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Split {
    share: f32,
}

/// The divider in this frame.
#[derive(Debug)]
pub(super) struct Divider {
    x: f32,
    y: egui::Rangef,
    response: egui::Response,
}

impl Default for Split {
    fn default() -> Self {
        Self { share: 0.5 }
    }
}

impl Split {
    pub(super) fn share(&self) -> f32 {
        self.share
    }

    pub(super) fn set_share(&mut self, share: f32) {
        if share.is_finite() {
            self.share = share.clamp(0.0, 1.0);
        }
    }

    /// What each look covers of `rect`.
    pub(super) fn halves(&self, rect: egui::Rect, is_split: bool) -> [egui::Rect; 2] {
        if !is_split {
            return [rect, egui::Rect::NOTHING];
        }
        let x = self.x(rect);
        [rect.with_max_x(x), rect.with_min_x(x)]
    }

    /// Takes this frame's drag or keys; none where there is no room for a divider.
    pub(super) fn take(&mut self, ui: &egui::Ui, rect: egui::Rect) -> Option<Divider> {
        if rect.width() < GRIP {
            return None;
        }
        let grip = egui::Rect::from_x_y_ranges(
            self.x(rect) - GRIP / 2.0..=self.x(rect) + GRIP / 2.0,
            rect.y_range(),
        );
        let id = ui.scope_id().with("divider");
        let response = ui
            .interact(grip, id, egui::Sense::click_and_drag())
            .on_hover_and_drag_cursor(egui::CursorIcon::ResizeHorizontal);
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            self.set_share((pointer.x - rect.left()) / rect.width());
        }
        if response.clicked() {
            response.request_focus();
        }
        if response.has_focus() {
            self.take_keys(ui, &response);
        }
        let share = f64::from(self.share);
        response.widget_info(|| egui::WidgetInfo::slider(ui.is_enabled(), share, texts::DIVIDER));
        Some(Divider { x: self.x(rect), y: rect.y_range(), response })
    }

    fn take_keys(&mut self, ui: &egui::Ui, response: &egui::Response) {
        let filter = egui::EventFilter { horizontal_arrows: true, ..egui::EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let presses =
            |key| ui.input_mut(|input| input.count_and_consume_key(egui::Modifiers::NONE, key)) as f32;
        let steps = presses(egui::Key::ArrowRight) - presses(egui::Key::ArrowLeft);
        self.set_share(self.share + steps * KEY_STEP);
    }

    fn x(&self, rect: egui::Rect) -> f32 {
        rect.left() + self.share * rect.width()
    }
}

impl Divider {
    pub(super) fn paint(&self, ui: &egui::Ui) {
        let stroke = ui.style().interact(&self.response).fg_stroke;
        let contrast = egui::Stroke::new(stroke.width + 2.0, ui.visuals().extreme_bg_color);
        ui.painter().vline(self.x, self.y, contrast);
        ui.painter().vline(self.x, self.y, stroke);
        let middle = egui::pos2(self.x, self.y.center());
        ui.painter().circle(middle, 5.0, ui.visuals().extreme_bg_color, stroke);
    }
}

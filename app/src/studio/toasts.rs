//! Notices, shown for a moment over the window.

use std::time::{Duration, SystemTime};

use eframe::egui;
use studio_plugin::{NoticeKind, Notices};

use super::theme::{STEP, Tokens};

/// How long a notice is shown; one of something that failed twice as long.
const SHOWN: Duration = Duration::from_secs(6);

/// The most shown at once.
const MOST: usize = 4;

/// Shows the latest notices in the lower right corner.
pub(super) fn show(ui: &egui::Ui, notices: &Notices) {
    let tokens = Tokens::of(ui);
    let now = SystemTime::now();
    let left = |notice: &studio_plugin::Notice| {
        let shown = if notice.kind == NoticeKind::Failed { 2 * SHOWN } else { SHOWN };
        shown.checked_sub(now.duration_since(notice.at).unwrap_or_default())
    };
    let fresh: Vec<_> = notices.all().iter().rev().filter_map(|n| Some((n, left(n)?))).take(MOST).collect();
    let Some(soonest) = fresh.iter().map(|(_, left)| *left).min() else { return };
    ui.request_repaint_after(soonest);
    egui::Area::new(egui::Id::unique("toasts"))
        .anchor(egui::Align2::RIGHT_BOTTOM, egui::vec2(-4.0 * STEP, -10.0 * STEP))
        .order(egui::Order::Foreground)
        .interactable(false)
        .show(ui, |ui| {
            for (notice, _) in fresh.iter().rev() {
                let colour = match notice.kind {
                    NoticeKind::Done => tokens.done,
                    NoticeKind::Note => tokens.text_weak,
                    NoticeKind::Failed => tokens.failed,
                };
                egui::Frame::popup(ui.style()).stroke(egui::Stroke::new(1.0, colour)).show(ui, |ui| {
                    ui.set_max_width(110.0 * STEP);
                    ui.label(egui::RichText::new(&notice.text).color(tokens.text));
                });
            }
        });
}

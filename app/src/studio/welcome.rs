//! The first steps: three cards over the view that say what to try.

use eframe::egui;

use super::texts::{self, welcome as words};
use super::theme::{STEP, Tokens};

/// What a card offers to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The garment turns by itself.
    Turn,
    /// The fabrics come forward.
    Dress,
    /// Warp and weft change places.
    Swap,
}

/// What was chosen on the cards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Chosen {
    Step(Step),
    Close,
}

const CARDS: [(Step, &str, &str, &str); 3] = [
    (Step::Turn, words::TURN, words::TURN_TEXT, words::TURN_BUTTON),
    (Step::Dress, words::DRESS, words::DRESS_TEXT, words::DRESS_BUTTON),
    (Step::Swap, words::DIRECT, words::DIRECT_TEXT, words::DIRECT_BUTTON),
];

/// Narrowest and widest that a card is, points.
const WIDTHS: [f32; 2] = [40.0 * STEP, 60.0 * STEP];

/// Shows the cards at the foot of `view`.
pub(super) fn show(ui: &egui::Ui, view: egui::Rect) -> Option<Chosen> {
    let mut chosen = None;
    let tokens = Tokens::of(ui);
    let [narrowest, widest] = WIDTHS;
    let room = (view.width() - 24.0 * STEP) / CARDS.len() as f32;
    let (fits, width) = (room >= narrowest, room.clamp(narrowest, widest));
    egui::Area::new(egui::Id::unique("first steps"))
        .order(egui::Order::Middle)
        .pivot(egui::Align2::CENTER_BOTTOM)
        .fixed_pos(view.center_bottom() - egui::vec2(0.0, 4.0 * STEP))
        .constrain_to(view)
        .show(ui, |ui| {
            let frame = egui::Frame::window(ui.style()).stroke(egui::Stroke::new(1.0, tokens.line));
            frame.show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.strong(texts::FIRST_STEPS);
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                        if ui.button(texts::CLOSE).clicked() {
                            chosen = Some(Chosen::Close);
                        }
                    });
                });
                let cards = |ui: &mut egui::Ui| {
                    for (number, (step, title, text, button)) in (1..).zip(CARDS) {
                        ui.vertical(|ui| {
                            ui.set_width(width);
                            ui.label(egui::RichText::new(format!("{number}. {title}")).color(tokens.accent));
                            // Where there is little room the buttons must do.
                            if fits {
                                ui.label(text);
                            }
                            if ui.button(button).clicked() {
                                chosen = Some(Chosen::Step(step));
                            }
                        });
                    }
                };
                if fits {
                    ui.horizontal_top(cards)
                } else {
                    ui.vertical(cards)
                };
            });
        });
    chosen
}

//! What runs, and what was told.

use eframe::egui;
use studio_plugin::{Context, NoticeKind, Pane, Place, Plugin};

use crate::studio::texts::activity as texts;
use crate::studio::theme::{STEP, Tokens};

pub(super) struct Activity;

impl Plugin for Activity {
    fn id(&self) -> &'static str {
        "activity"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn panes(&self) -> Vec<Pane> {
        vec![
            Pane { id: "jobs", title: texts::JOBS, place: Place::Bottom },
            Pane { id: "log", title: texts::LOG, place: Place::Bottom },
        ]
    }

    fn show(&mut self, pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        if pane == "jobs" { jobs(ui, studio) } else { log(ui, studio) }
    }
}

fn jobs(ui: &mut egui::Ui, studio: &Context<'_>) {
    let views = studio.jobs.views();
    if views.is_empty() {
        ui.weak(texts::NO_JOBS);
    }
    for (index, job) in views.iter().enumerate() {
        ui.horizontal(|ui| {
            if ui.button(texts::CANCEL).on_hover_text(texts::stops(&job.name)).clicked() {
                studio.jobs.cancel(index);
            }
            let text =
                if job.stage.is_empty() { job.name.clone() } else { format!("{}: {}", job.name, job.stage) };
            match job.share {
                Some(share) => {
                    ui.add(egui::ProgressBar::new(share).desired_width(40.0 * STEP).show_percentage());
                }
                None => {
                    ui.spinner();
                }
            }
            ui.label(text);
        });
    }
}

fn log(ui: &mut egui::Ui, studio: &Context<'_>) {
    let tokens = Tokens::of(ui);
    if studio.notices.all().is_empty() {
        ui.weak(texts::NO_NOTICES);
    }
    for notice in studio.notices.all().iter().rev() {
        let colour = match notice.kind {
            NoticeKind::Done => tokens.done,
            NoticeKind::Note => tokens.text,
            NoticeKind::Failed => tokens.failed,
        };
        ui.label(egui::RichText::new(&notice.text).color(colour));
    }
}

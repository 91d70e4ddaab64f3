//! Directions to and from files, in the window.

use std::path::Path;
use std::sync::Arc;

use amc_core::amc::Symmetry;
use amc_core::direction::{self, Direction, PanelDirection};
use amc_core::mesh::{Garment, Panel};
use amc_core::{Progress, export};
use egui::Context as Egui;
use studio_plugin::document::{Gesture, Project};
use studio_plugin::{Ask, Context, FileKind, Job};

use crate::import::{self, Import};
use crate::tech_sheet::Said;
use crate::{grain, texts};

/// Width of the question, points.
const WIDTH: f32 = 480.0;

/// By which the answers of dialogs are known; also the commands.
pub(crate) const IMPORT: &str = "import-directions";
pub(crate) const EXPORT: &str = "export-directions";

/// What is being read or waits for an answer.
#[derive(Debug, Default)]
pub(crate) struct Exchange {
    reading: Option<Reading>,
    asked: Option<Question>,
}

#[derive(Debug)]
struct Reading {
    file: String,
    garment: Arc<Garment>,
    job: Job<Import>,
}

/// An import that has something to say before it is applied.
#[derive(Debug)]
struct Question {
    file: String,
    garment: Arc<Garment>,
    import: Import,
    notices: Vec<String>,
}

/// Asks for a file.
pub(crate) fn ask(command: &str, studio: &mut Context<'_>) {
    const READ: &[FileKind] = &[FileKind { name: texts::DIRECTIONS, suffixes: &import::SUFFIXES }];
    const WRITTEN: &[FileKind] = &[
        FileKind { name: texts::GLB, suffixes: &["glb"] },
        FileKind { name: texts::OBJ, suffixes: &["obj"] },
        FileKind { name: texts::JSON, suffixes: &["json"] },
    ];
    if command == IMPORT {
        let title = texts::IMPORT_TITLE.to_owned();
        studio.ask_which(Ask { id: IMPORT, title, name: String::new(), kinds: READ });
    } else {
        let name = format!("{}.glb", studio.document.project().garment.name());
        studio.ask_where(Ask { id: EXPORT, title: texts::EXPORT_TITLE.to_owned(), name, kinds: WRITTEN });
    }
}

/// Starts to write the directions to a file.
pub(crate) fn export(
    file: &Path,
    said: Vec<Said>,
    garment: Arc<Garment>,
    studio: &mut Context<'_>,
) -> Job<()> {
    let path = file.to_owned();
    let project = studio.document.project();
    // Strokes are followed as the fabric's symmetry has it.
    let symmetry = |panel: &Panel| {
        let table = project.look_of(panel).fabric.and_then(|fabric| studio.stage.fabrics.get(&fabric));
        table.map_or(Symmetry::Two, |table| table.symmetry).order()
    };
    let directions: Vec<PanelDirection> = garment
        .panels
        .iter()
        .map(|panel| PanelDirection {
            own: grain::direction(panel, project),
            comb: project.comb(&panel.id).cloned(),
            symmetry: symmetry(panel),
        })
        .collect();
    let write = move |progress: &Progress<'_>| save(&garment, &directions, &said, &path, *progress);
    studio.jobs.start(texts::saving(file.display()), write)
}

/// Saves the directions of a garment: see [`export::tangents`]. `said` is of each panel.
fn save(
    garment: &Garment,
    directions: &[PanelDirection],
    said: &[Said],
    path: &Path,
    progress: Progress<'_>,
) -> amc_core::Result<()> {
    let tangents = direction::combed_tangents(garment, directions, progress)?;
    let own: Vec<Direction> = directions.iter().map(|direction| direction.own).collect();
    let said: Vec<export::Said> = said.iter().map(Said::exported).collect();
    export::tangents(garment, &tangents, &own, &said, path)
}

fn directions(garment: &Garment, project: &Project) -> Vec<Direction> {
    garment.panels.iter().map(|panel| grain::direction(panel, project)).collect()
}

impl Exchange {
    /// Starts to read a file for the garment on stage.
    pub(crate) fn read(&mut self, file: &Path, studio: &mut Context<'_>) {
        let Some(garment) = studio.stage.garment.clone() else { return };
        let now = directions(&garment, studio.document.project());
        let (path, of) = (file.to_owned(), studio.document.project().named(&garment));
        let read = move |progress: &Progress<'_>| import::read(&of, &now, &path, progress);
        let job = studio.jobs.start(texts::reading(file.display()), read);
        let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
        self.reading = Some(Reading { file: name, garment, job });
    }

    /// Takes in what was read: at once, or after a question where there is something to say.
    pub(crate) fn update(&mut self, studio: &mut Context<'_>) {
        let Some(result) = self.reading.as_ref().and_then(|reading| reading.job.poll()) else { return };
        let Some(Reading { file, garment, .. }) = self.reading.take() else { return };
        let planned = result.and_then(|import| {
            let planned = import::edits(&import, &garment, studio.document.project())?;
            Ok((import, planned.notices))
        });
        match planned {
            Err(error) => studio.notices.failed(error),
            Ok((import, more)) => {
                let notices: Vec<String> = import.notices.iter().cloned().chain(more).collect();
                let question = Question { file, garment, import, notices };
                if question.notices.is_empty() {
                    question.apply(studio);
                } else {
                    self.asked = Some(question);
                }
            }
        }
    }

    /// Shows what there is to say, and applies the import where the person wants it.
    pub(crate) fn show(&mut self, context: &Egui, studio: &mut Context<'_>) {
        let Some(question) = &self.asked else { return };
        let mut answer = None;
        let modal = egui::Modal::new(egui::Id::unique("import-directions")).show(context, |ui| {
            ui.set_max_width(WIDTH);
            ui.heading(texts::IMPORT_TITLE);
            ui.label(texts::reaches(&question.file, question.import.found.len()));
            egui::ScrollArea::vertical().max_height(WIDTH / 2.0).show(ui, |ui| {
                for notice in &question.notices {
                    ui.label(notice);
                }
            });
            ui.horizontal(|ui| {
                if ui.button(texts::APPLY).clicked() {
                    answer = Some(true);
                }
                if ui.button(texts::CANCEL).clicked() {
                    answer = Some(false);
                }
            });
        });
        if modal.should_close() {
            answer = answer.or(Some(false));
        }
        if answer.is_some()
            && let Some(question) = self.asked.take()
            && answer == Some(true)
        {
            question.apply(studio);
        }
    }
}

impl Question {
    /// All of it as one step.
    fn apply(self, studio: &mut Context<'_>) {
        // The project may have changed since it was read.
        let is_same = studio.stage.garment.as_ref().is_some_and(|now| Arc::ptr_eq(now, &self.garment));
        match import::edits(&self.import, &self.garment, studio.document.project()) {
            Err(error) => studio.notices.failed(error),
            Ok(planned) if is_same => {
                let gesture = Gesture::begin();
                planned.edits.into_iter().for_each(|edit| studio.submit_in(gesture, edit));
                studio.notices.done(texts::imported(planned.panels));
            }
            Ok(_) => studio.notices.note(texts::ANOTHER_GARMENT),
        }
    }
}

//! The editor as a plugin.

use std::path::Path;
use std::sync::Arc;

use amc_core::mesh::{Garment, SurfacePlace};
use egui::Painter;
use serde_json::Value;
use studio_plugin::document::Project;
use studio_plugin::{Ask, Command, Context, Cover, FileKind, Hand, Job, Pane, Place, Plugin, ViewportView};

use crate::assignments::{Assignments, ID};
use crate::comb::pane::CombPane;
use crate::comb::{self, Stylus};
use crate::commands::{self, Given};
use crate::exchange::{self, Exchange};
use crate::grain;
use crate::grain::arrow::Arrow;
use crate::grain_pane::GrainPane;
use crate::pattern::PatternPane;
use crate::seeing_view::SeeingView;
use crate::sheet::Sheet;
use crate::splitting::{self, Cutter};
use crate::tech_sheet::{self, Said};
use crate::{overlay, texts};

/// The editor, to be registered.
#[derive(Debug, Default)]
pub struct TangentEditor {
    sheet: Option<Sheet>,
    laying_out: Option<(Arc<Garment>, Job<Sheet>)>,
    pattern: PatternPane,
    grain: GrainPane,
    comb: CombPane,
    stylus: Stylus,
    cutter: Cutter,
    seeing: SeeingView,
    given: Given,
    /// An arrow that is dragged on the garment.
    held: Option<Arrow>,
    /// The revision of the document after which the pieces lie on the screen.
    lain: Option<u64>,
    /// The place on the garment under the pointer: in the flat pattern, and in the viewport.
    under_pointer: (Option<SurfacePlace>, Option<SurfacePlace>),
    saving: Vec<(String, Job<()>)>,
    exchange: Exchange,
}

impl Plugin for TangentEditor {
    fn id(&self) -> &'static str {
        ID
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn commands(&self) -> Vec<Command> {
        commands::COMMANDS.iter().copied().chain(SeeingView::commands()).collect()
    }

    fn tools(&self) -> Vec<Command> {
        vec![commands::COMB_TOOL, commands::SPLIT_TOOL]
    }

    fn use_tool(&mut self, tool: &str, hand: &Hand<'_>, studio: &mut Context<'_>) {
        if let Some(sheet) = &self.sheet {
            let finder = overlay::OnGarment { view: &hand.viewport, sheet };
            match tool {
                splitting::TOOL => self.cutter.use_in(hand.response, &finder, sheet, studio),
                _ => self.stylus.use_in(hand.response, &finder, sheet, studio),
            }
        }
    }

    fn can_run(&self, command: &str, studio: &Context<'_>) -> bool {
        if command == "delete-stroke" {
            return self.sheet.is_some() && self.stylus.chosen.is_some();
        }
        SeeingView::commands().any(|known| known.id == command)
            || self.sheet.as_ref().is_some_and(|sheet| commands::can_run(command, sheet, &self.given, studio))
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        match &self.sheet {
            _ if self.seeing.run(command) => {}
            _ if command == "fit" => self.pattern.fit(),
            _ if command == "save-sheet" => ask(studio),
            Some(sheet) if command == "delete-stroke" => {
                if let Some(chosen) = self.stylus.chosen.take() {
                    comb::delete(&sheet.garment, chosen, studio);
                }
            }
            _ if [exchange::IMPORT, exchange::EXPORT].contains(&command) => exchange::ask(command, studio),
            Some(sheet) => commands::run(command, sheet, &mut self.given, studio),
            None => {}
        }
    }

    fn chosen(&mut self, what: &str, file: &Path, studio: &mut Context<'_>) {
        if what == exchange::IMPORT {
            return self.exchange.read(file, studio);
        }
        let project = studio.document.project();
        let Some(garment) = studio.stage.garment.as_ref().map(|garment| project.named(garment)) else {
            return;
        };
        let said = match said(project, &garment) {
            Ok(said) => said,
            Err(error) => return studio.notices.failed(error),
        };
        let (title, path) = (project.garment.name(), file.to_owned());
        let name = file.display().to_string();
        if what == exchange::EXPORT {
            return self.saving.push((name, exchange::export(file, said, garment, studio)));
        }
        let write = move |progress: &amc_core::Progress<'_>| {
            tech_sheet::save(&title, garment, &said, &path, progress)
        };
        self.saving.push((name.clone(), studio.jobs.start(texts::saving(&name), write)));
    }

    fn cover(&self) -> Option<Arc<Cover>> {
        self.seeing.cover()
    }

    fn settings(&self) -> Option<Value> {
        Some(self.seeing.kept())
    }

    fn restore(&mut self, settings: Value) -> amc_core::Result<()> {
        self.seeing.restore(settings)
    }

    fn update(&mut self, studio: &mut Context<'_>) {
        self.seeing.take(studio);
        self.saving.retain(|(name, job)| match job.poll() {
            None => true,
            Some(result) => {
                match result {
                    Ok(()) => studio.notices.done(texts::saved(name)),
                    Err(error) => studio.notices.failed(error),
                }
                false
            }
        });
        self.exchange.update(studio);
        let Some(garment) = &studio.stage.garment else {
            (self.sheet, self.laying_out) = (None, None);
            return;
        };
        let is_new = |known: Option<&Arc<Garment>>| known.is_none_or(|known| !Arc::ptr_eq(known, garment));
        let laid_out = self.sheet.as_ref().map(|sheet| &sheet.garment);
        let coming = self.laying_out.as_ref().map(|(garment, _)| garment);
        if is_new(laid_out) && is_new(coming) {
            self.sheet = None;
            let of = Arc::clone(garment);
            let job = studio.jobs.start(texts::OPENING, move |progress| Sheet::new(of, progress));
            self.laying_out = Some((Arc::clone(garment), job));
        }
        self.lie(studio);
        if let Some(result) = self.laying_out.as_ref().and_then(|(_, job)| job.poll()) {
            self.laying_out = None;
            (self.pattern, self.given.picked) = (PatternPane::default(), None);
            match result {
                Ok(sheet) => (self.sheet, self.lain) = (Some(sheet), None),
                Err(error) => studio.notices.failed(error),
            }
        }
    }

    fn panes(&self) -> Vec<Pane> {
        vec![
            Pane { id: "pattern", title: texts::PATTERN, place: Place::Beside },
            Pane { id: "grain", title: texts::GRAIN, place: Place::Right },
            Pane { id: "comb", title: texts::COMB, place: Place::Right },
        ]
    }

    fn show(&mut self, pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        let Some(sheet) = &self.sheet else {
            ui.weak(texts::OPENING);
            return;
        };
        if pane == "comb" {
            self.comb.show(ui, sheet, &mut self.stylus, studio);
        } else if sheet.pieces.is_empty() {
            ui.label(texts::NO_UVS);
        } else if pane == "pattern" {
            self.seeing.ask(studio);
            let marked = self.under_pointer.1;
            let given = (&mut self.given.picked, &mut self.stylus, &mut self.cutter, &mut self.seeing);
            self.under_pointer.0 = self.pattern.show(ui, sheet, given, marked, studio);
        } else if let Some(clicked) = self.grain.show(ui, sheet, &self.given, studio) {
            self.run(clicked, studio);
        }
    }

    fn overlay(&mut self, painter: &Painter, view: &ViewportView<'_>, studio: &mut Context<'_>) {
        self.exchange.show(painter.ctx(), studio);
        self.seeing.ask(studio);
        let Some(sheet) = &self.sheet else { return };
        let visuals = painter.ctx().global_style().visuals.clone();
        let about = (&sheet.garment, &*studio.selection);
        self.seeing.legend(painter, view.rect, &visuals, about);
        overlay::arrows(painter, view, sheet, &mut self.held, studio);
        overlay::strokes(painter, view, sheet, self.stylus.chosen, studio);
        if let Some(place) = &self.under_pointer.0 {
            overlay::mark(painter, view, &sheet.garment, place);
        }
        let pointer = painter.ctx().input(|input| input.pointer.hover_pos());
        let within = pointer.filter(|at| view.rect.contains(*at));
        self.under_pointer.1 = within.and_then(|at| overlay::place_at(view, at, &sheet.garment));
    }
}

impl TangentEditor {
    /// Turns the pieces on the screen as the project has it.
    fn lie(&mut self, studio: &Context<'_>) {
        let revision = Some(studio.document.revision());
        let Some(sheet) = self.sheet.as_mut().filter(|_| self.lain != revision) else { return };
        self.lain = revision;
        // What makes no sense is told wherever it is used.
        let assignments = Assignments::of(studio.document.project()).unwrap_or_default();
        if sheet.lie(|panel| assignments.panel(panel).screen_turn_deg.to_radians()) {
            self.given.picked = None;
            self.pattern.fit();
        }
    }
}

/// Asks where the tech sheet is to be saved.
fn ask(studio: &mut Context<'_>) {
    const KINDS: &[FileKind] = &[
        FileKind { name: texts::PDF, suffixes: &["pdf"] },
        FileKind { name: texts::SVG, suffixes: &["svg"] },
        FileKind { name: texts::DXF, suffixes: &["dxf"] },
    ];
    let name = format!("{}.pdf", studio.document.project().garment.name());
    studio.ask_where(Ask { id: "save-sheet", title: texts::SAVE_TITLE.to_owned(), name, kinds: KINDS });
}

/// What a project says of the garment's panels.
fn said(project: &Project, garment: &Garment) -> amc_core::Result<Vec<Said>> {
    let assignments = Assignments::of(project)?;
    let of = |panel: &amc_core::mesh::Panel| Said {
        direction: grain::direction(panel, project),
        fabric: project
            .look_of(panel)
            .fabric
            .and_then(|id| project.fabric(id))
            .map(|fabric| fabric.name.clone()),
        assignment: assignments.panel(&panel.id),
    };
    Ok(garment.panels.iter().map(of).collect())
}

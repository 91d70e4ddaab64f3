//! Pictures, contact sheets and turns of the garment, into files. Of a split view it is the left half's look, whole.

mod form;
mod settings;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use amc_core::direction::combed_tangents;
use amc_core::mesh::Garment;
use amc_core::render::{Bounds, Cloth, Drawing, Shading};
use amc_core::{Progress, Result};
use eframe::egui;
use serde_json::Value;
use studio_plugin::document::{FabricInUse, Project};
use studio_plugin::{Ask, Command, Context, FileKind, Job, Pane, Place, Plugin};

use self::settings::{Settings, What};
use crate::pictures::{Device, MOVING_SUFFIXES, Order, Painter, STILL_SUFFIXES, Stand};
use crate::scene::{Outfit, document_looks, dressed, hidden_panels, vertex_occlusion, worn_prints};
use crate::studio::texts::export as texts;

/// The export's form, and what is being exported.
#[derive(Debug, Default)]
pub(super) struct Export {
    settings: Settings,
    running: Vec<Running>,
}

/// An export that is under way.
#[derive(Debug)]
struct Running {
    job: Job<()>,
    /// The job's.
    name: String,
    file: PathBuf,
}

/// How long the window waits, when it closes, for exports to stop and to remove what they have begun.
const FAREWELL: Duration = Duration::from_secs(2);

const STILLS: &[FileKind] = &[FileKind { name: texts::PICTURES, suffixes: STILL_SUFFIXES }];
const TURNS: &[FileKind] = &[FileKind { name: texts::ANIMATIONS, suffixes: MOVING_SUFFIXES }];

const fn command(what: What, name: &'static str, tooltip: &'static str) -> Command {
    Command { id: what.id(), name, tooltip, shortcut: None }
}

const COMMANDS: [Command; 3] = [
    command(What::Picture, texts::EXPORT_PICTURE, texts::EXPORT_PICTURE_TIP),
    command(What::Views, texts::EXPORT_VIEWS, texts::EXPORT_VIEWS_TIP),
    command(What::Turn, texts::EXPORT_TURN, texts::EXPORT_TURN_TIP),
];

impl Plugin for Export {
    fn id(&self) -> &'static str {
        "export"
    }

    fn name(&self) -> &'static str {
        texts::NAME
    }

    fn commands(&self) -> Vec<Command> {
        COMMANDS.to_vec()
    }

    fn can_run(&self, _command: &str, studio: &Context<'_>) -> bool {
        studio.stage.garment.is_some()
    }

    fn run(&mut self, command: &str, studio: &mut Context<'_>) {
        if let Some(what) = What::of(command) {
            ask(what, studio);
        }
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "form", title: texts::NAME, place: Place::Right }]
    }

    fn show(&mut self, _pane: &str, ui: &mut egui::Ui, studio: &mut Context<'_>) {
        if form::show(ui, &mut self.settings, studio.stage.garment.is_some()) {
            ask(self.settings.what, studio);
        }
        for running in &self.running {
            let view = studio.jobs.views().into_iter().find(|view| view.name == running.name);
            form::show_running(ui, &running.name, view.as_ref(), || running.job.cancel());
        }
    }

    fn chosen(&mut self, what: &str, file: &Path, studio: &mut Context<'_>) {
        if let Some(what) = What::of(what) {
            self.start(what, file, studio);
        }
    }

    fn update(&mut self, studio: &mut Context<'_>) {
        let notices = &mut *studio.notices;
        self.running.retain(|Running { job, file, .. }| {
            match job.poll() {
                None => return true,
                Some(Ok(())) => notices.done(texts::exported(file.display())),
                Some(Err(error)) if error.is_cancelled() => {
                    notices.note(texts::cancelled(file.display()));
                }
                Some(Err(error)) => notices.failed(error),
            }
            false
        });
    }

    fn settings(&self) -> Option<Value> {
        serde_json::to_value(&self.settings).ok()
    }

    fn restore(&mut self, settings: Value) -> Result<()> {
        self.settings = Settings::restored(settings)?;
        Ok(())
    }
}

/// Asks where the export is to be saved.
fn ask(what: What, studio: &mut Context<'_>) {
    let garment = studio.document.project().garment.name();
    let (title, name, kinds) = match what {
        What::Picture => (texts::SAVE_PICTURE, format!("{garment}.png"), STILLS),
        What::Views => (texts::SAVE_VIEWS, format!("{garment}-views.png"), STILLS),
        What::Turn => (texts::SAVE_TURN, format!("{garment}-turn.gif"), TURNS),
    };
    studio.ask_where(Ask { id: what.id(), title: title.to_owned(), name, kinds });
}

impl Drop for Export {
    fn drop(&mut self) {
        let deadline = Instant::now() + FAREWELL;
        self.running.iter().for_each(|running| running.job.cancel());
        for running in &self.running {
            while running.job.poll().is_none() && Instant::now() < deadline {
                std::thread::sleep(Duration::from_millis(5));
            }
        }
    }
}

impl Export {
    /// Exports the document as it is now; what is changed from here on is in the next one.
    fn start(&mut self, what: What, file: &Path, studio: &mut Context<'_>) {
        let kind = self.settings.kind(what);
        if let Err(error) = Order::check_file(&kind, file) {
            return studio.notices.failed(error);
        }
        let Some(garment) = studio.stage.garment.clone() else {
            return studio.notices.failed(texts::NO_GARMENT);
        };
        let project = studio.document.project().clone();
        let (fabrics, prints) = (studio.stage.fabrics.clone(), studio.stage.prints.clone());
        let is_worn = |fabric: &FabricInUse| {
            garment.panels.iter().any(|panel| project.look_of(panel).fabric == Some(fabric.id))
        };
        let not_loaded = |fabric: &&FabricInUse| !fabrics.contains_key(&fabric.id) && is_worn(fabric);
        for fabric in project.fabrics.iter().filter(not_loaded) {
            studio.notices.note(format!(
                "'{}' is not loaded: what wears it is grey in {}",
                fabric.name,
                file.display()
            ));
        }
        let device = studio.gpu.cloned().map_or(Device::Cpu, Device::Gpu);
        let (shading, size) =
            (self.settings.shading(studio.stage.shading(&project.view)), self.settings.size(what));
        let order = {
            let file = file.to_owned();
            move |stand| Order { kind, stand, size, shading, file }
        };
        let name = texts::exporting(file.file_name().unwrap_or(file.as_os_str()).to_string_lossy());
        let job = studio.jobs.start(name.clone(), move |progress| {
            let order = order(stand(&project, &garment)?);
            let worn = (&project, project.colourways.worn().id);
            let looks = document_looks(worn, &garment, &fabrics);
            let outfit = Outfit { looks, prints: worn_prints(worn, &garment, &prints), fabrics };
            let occlusion = occlusion(&garment, &order.shading, progress)?;
            let upright = garment.normals.clone();
            let plain = Drawing::new(&garment, upright, occlusion.as_deref(), Vec::new(), |_| Cloth::Plain)?;
            let tangents = combed_tangents(&garment, &outfit.directions(), *progress)?;
            let drawing = dressed(&plain, &garment, &outfit, &tangents.vectors)?;
            let mut painter = Painter::new(device, drawing, &hidden_panels(&project, &garment))?;
            order.carry_out(&mut painter, progress)
        });
        self.running.push(Running { job, name, file: file.to_owned() });
    }
}

/// From where the window looks.
fn stand(project: &Project, garment: &Garment) -> Result<Stand> {
    let bounds = Bounds::of(&garment.positions)?;
    Ok(Stand::Settings { settings: Box::new(project.view.clone()), bounds })
}

fn occlusion(
    garment: &Garment,
    shading: &Shading,
    progress: &Progress<'_>,
) -> Result<Option<Vec<glam::Vec2>>> {
    shading.occlusion.then(|| vertex_occlusion(garment, progress)).transpose()
}

//! A lost graphics device: the window opens anew on another, and nothing of the work is lost.
//!
//! A real window in a display of its own, on the main thread, as window systems want it; run by `tests/more`.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking and says what it did"
)]

use std::process::{Command, ExitCode};
use std::time::Duration;

use amc_core::direction::Direction;
use amc_studio::studio::Studio;
use studio_plugin::document::{Edit, Project};
use studio_plugin::{Context, Plugin};
use studio_tests::display::Display;

/// Set for the process that opens the window.
const INSIDE: &str = "AMC_STUDIO_DEVICE_LOSS";

/// So many devices in a row.
const LOSSES: u8 = 2;

/// How long it all may take before it counts as hung.
const PATIENCE: Duration = Duration::from_secs(120);

fn main() -> ExitCode {
    if !cfg!(feature = "full") {
        println!("not run: a lost device: needs Xvfb and the feature full");
        return ExitCode::SUCCESS;
    }
    if std::env::var_os(INSIDE).is_some() {
        window();
        return ExitCode::SUCCESS;
    }
    let display = Display::start();
    let mut inside = Command::new(std::env::current_exe().unwrap());
    inside.env(INSIDE, "1").env("DISPLAY", &display.name).env_remove("WAYLAND_DISPLAY");
    assert!(inside.status().unwrap().success());
    println!("a lost device: ok");
    ExitCode::SUCCESS
}

fn window() {
    let watch = || {
        std::thread::sleep(PATIENCE);
        println!("the window hangs");
        std::process::exit(2);
    };
    std::thread::Builder::new().name("patience".to_owned()).spawn(watch).unwrap();
    let folder = tempfile::tempdir().unwrap();
    Studio::new().with_plugin(Saboteur::default()).keeping_in(folder.path()).run().unwrap();
    unreachable!("the saboteur ends the process");
}

/// Turns all panels, destroys the device, looks whether the work is as it was on the next one; as often as [`LOSSES`] says.
#[derive(Default)]
struct Saboteur {
    losses: u8,
    /// The project as it was when the last device was destroyed, until the next window is there.
    project: Option<Project>,
}

impl Plugin for Saboteur {
    fn id(&self) -> &'static str {
        "saboteur"
    }

    fn name(&self) -> &'static str {
        "Saboteur"
    }

    // A panic in here would only switch the plugin off.
    fn update(&mut self, studio: &mut Context<'_>) {
        let (Some(gpu), project) = (studio.gpu, studio.document.project()) else { return };
        let Some(garment) = &studio.stage.garment else {
            // A new window begins with an empty stage.
            if self.project.take().is_some_and(|before| before != *project || !studio.document.is_changed()) {
                println!("the work is not as it was");
                std::process::exit(1);
            }
            return;
        };
        if self.project.is_some() {
            return;
        }
        let angle = f32::from(self.losses + 1).to_radians();
        let direction = Some(Direction { angle, ..Direction::default() });
        let panels: Vec<String> = garment.panels.iter().map(|panel| panel.id.clone()).collect();
        if panels.iter().any(|id| project.look(id).direction != direction) {
            studio.submit(Edit::SetDirection { panels, direction });
        } else if self.losses == LOSSES {
            std::process::exit(0);
        } else {
            self.losses += 1;
            self.project = Some(project.clone());
            gpu.device.destroy();
        }
    }
}

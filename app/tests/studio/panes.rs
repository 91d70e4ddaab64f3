//! Every pane of every plugin as a picture, in both themes and two scales: `UPDATE_SNAPSHOTS=1` makes them anew.

use amc_studio::studio::Studio;
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::{SnapshotOptions, SnapshotResults};

use super::*;

/// The window, with one pane in the place of all.
struct Alone {
    app: App,
    pane: (&'static str, &'static str),
}

impl eframe::App for Alone {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.app.show_alone(ui, self.pane);
    }
}

#[test]
fn every_pane_looks_as_it_did() {
    let folder = tempfile::tempdir().unwrap();
    let panes = window(Studio::new(), folder.path()).state().panes();
    assert!(panes.len() >= 8);
    let mut results = SnapshotResults::new();
    for (theme, theme_name) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
        for scale in [1.0, 1.5] {
            let kept = tempfile::tempdir().unwrap();
            let mut harness = alone(Studio::new().keeping_in(kept.path()), panes[0], (theme, scale));
            // Something for the history to show.
            harness.key_press_modifiers(Modifiers::NONE, Key::R);
            harness.run_steps(2);
            settle(&mut harness);
            harness.remove_cursor();
            for &pane in &panes {
                harness.state_mut().pane = pane;
                harness.run_steps(3);
                let options = SnapshotOptions::new().output_path("tests/snapshots");
                let file = format!("{}-{}-{theme_name}-{}", pane.0, pane.1, (scale * 100.0) as u32);
                results.add(harness.try_snapshot_options(&file, &options));
            }
        }
    }
}

/// A window with one pane.
fn alone(
    studio: Studio,
    pane: (&'static str, &'static str),
    (theme, scale): (egui::Theme, f32),
) -> Harness<'static, Alone> {
    let mut harness = Harness::builder()
        .with_size([300.0 * scale, 400.0 * scale])
        .with_pixels_per_point(1.0)
        .with_theme(theme)
        .with_max_steps(100)
        .wgpu()
        .build_eframe(move |creation| Alone { app: studio.into_app(creation), pane });
    harness.ctx.set_zoom_factor(scale);
    settle(&mut harness);
    harness
}

#[test]
fn several_colourways_look_as_they_did() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("three.amcproj");
    let text = r#"{"version": 1,
        "fabrics": [{"id": 0, "name": "Satin", "asset": "fabric:satin"},
            {"id": 1, "name": "Changeant", "asset": "fabric:changeant"}],
        "colourways": [{"id": 0, "name": "Summer"},
            {"id": 1, "name": "Winter, for all who would rather stay at home", "panels": {"back": {"fabric": 1}}},
            {"id": 2, "name": "Toile", "panels": {"back": {"fabric": null}}}],
        "view": {"compared": {"colourway": 1}}}"#;
    amc_core::file::save_bytes(&file, text.as_bytes()).unwrap();
    let mut results = SnapshotResults::new();
    for (theme, theme_name) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
        let kept = tempfile::tempdir().unwrap();
        let studio = Studio::new().open([file.clone()]).keeping_in(kept.path());
        let mut harness = alone(studio, ("colourways", "list"), (theme, 1.0));
        harness.remove_cursor();
        harness.run_steps(3);
        let options = SnapshotOptions::new().output_path("tests/snapshots");
        results.add(harness.try_snapshot_options(format!("colourways-several-{theme_name}"), &options));
    }
}

fn settle(harness: &mut Harness<'_, Alone>) {
    let start = Instant::now();
    while !harness.state().app.is_settled() {
        assert!(start.elapsed() < PATIENCE, "still not settled");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
}

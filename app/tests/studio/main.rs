//! Journeys through the real interface: every step as a person takes it, by its label, drawn by the real renderer.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod arranging;
mod by_keyboard;
mod colourways;
mod directions;
mod export;
mod journeys;
mod panes;
mod pictures;
mod plugins;
mod seeing;
mod settings;

use std::path::Path;
use std::time::{Duration, Instant};

use amc_studio::studio::{App, Studio};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

/// How long loading may take before the test counts as hung.
const PATIENCE: Duration = Duration::from_secs(240);

/// A window that keeps its things in `folder`.
fn window(studio: Studio, folder: &Path) -> Harness<'static, App> {
    let studio = studio.keeping_in(folder.join("kept"));
    let mut harness = Harness::builder()
        .with_size([1280.0, 800.0])
        .with_max_steps(100)
        .wgpu()
        .build_eframe(move |creation| studio.into_app(creation));
    settle(&mut harness);
    harness
}

/// Runs frames until all that the document asks for is drawn.
fn settle(harness: &mut Harness<'_, App>) {
    let start = Instant::now();
    harness.step();
    while !harness.state().is_settled() {
        assert!(start.elapsed() < PATIENCE, "still not settled");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    harness.run_steps(2);
}

fn press(harness: &mut Harness<'_, App>, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    settle(harness);
}

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

/// Brings a pane to the front by its tab.
fn show_tab(harness: &mut Harness<'_, App>, title: &str) {
    harness
        .get_by(|node| node.label().is_some_and(|label| label == title) && node.toggled().is_some())
        .click();
    settle(harness);
}

/// Selects a panel in the list.
fn select(harness: &mut Harness<'_, App>, panel: &str) {
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with(panel))).click();
    settle(harness);
}

/// The degrees of a panel's direction, where it was given one.
fn degrees(harness: &Harness<'_, App>, panel: &str) -> Option<f32> {
    let look = harness.state().document().project().look(panel);
    look.direction.map(|direction| direction.angle.to_degrees())
}

/// Whether something in the window reads like this.
fn reads(harness: &Harness<'_, App>, parts: &[&str]) -> bool {
    let all = |text: String| parts.iter().all(|part| text.contains(part));
    harness
        .query_all_by(|node| node.label().is_some_and(all) || node.value().is_some_and(all))
        .next()
        .is_some()
}

fn picture(harness: &mut Harness<'_, App>) -> Vec<u8> {
    harness.render().unwrap().into_raw()
}

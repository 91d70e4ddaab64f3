//! Journeys through the real interface: every step as a person takes it, by its label, drawn by the real renderer.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use std::time::{Duration, Instant};

use amc_studio::studio::{App, Studio};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use studio_plugin::{Context, Pane, Place, Plugin};

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

#[test]
fn a_panel_is_picked_turned_undone_saved_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.amcproj");
    let mut harness = window(Studio::new(), folder.path());
    let first = picture(&mut harness);

    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("back"))).click();
    settle(&mut harness);
    let panel = "back";
    let before = degrees(&harness, panel);
    press(&mut harness, Modifiers::NONE, Key::R);
    let turned = degrees(&harness, panel).unwrap();
    assert_eq!(harness.state().document().undo_name(), Some("Swap warp and weft of 1 panel"));
    let swapped = picture(&mut harness);
    assert_ne!(first, swapped);

    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(degrees(&harness, panel), before);
    press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert_eq!(degrees(&harness, panel), Some(turned));

    harness.state_mut().save_to(&file);
    settle(&mut harness);
    assert!(!harness.state().document().is_changed());
    let saved = harness.state().document().project().clone();
    drop(harness);

    let mut again = window(Studio::new().open([file]), folder.path());
    assert_eq!(again.state().document().project(), &saved);
    assert_eq!(degrees(&again, panel), Some(turned));
    picture(&mut again);
    drop(again);

    // The project is offered among the recent ones.
    let mut third = window(Studio::new(), folder.path());
    assert_eq!(degrees(&third, panel), before);
    click(&mut third, "File");
    click(&mut third, "mine.amcproj");
    assert_eq!(degrees(&third, panel), Some(turned));
}

#[test]
fn the_palette_finds_a_command_by_a_few_letters() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    press(&mut harness, Modifiers::COMMAND, Key::P);
    harness.get_by_label("Type what you want to do").type_text("bias");
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    let project = harness.state().document().project();
    assert!(project.panels.values().all(|look| look.direction.is_some()));
    assert!(harness.state().document().undo_name().is_some_and(|name| name.contains("45")));
}

#[test]
fn unsaved_work_of_a_window_that_died_is_offered_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    press(&mut harness, Modifiers::NONE, Key::R);
    let turned = degrees(&harness, "back");
    let recovery = folder.path().join("kept/recovery");
    let start = Instant::now();
    let kept =
        || std::fs::read_dir(&recovery).unwrap().flatten().any(|it| it.metadata().unwrap().len() > 200);
    while !kept() {
        assert!(start.elapsed() < PATIENCE, "nothing was kept");
        std::thread::sleep(Duration::from_millis(20));
    }
    // Dropped without having been closed.
    drop(harness);
    let mut again = window(Studio::new(), folder.path());
    assert_eq!(degrees(&again, "back"), None);
    click(&mut again, "Take it back");
    assert_eq!(degrees(&again, "back"), turned);
    assert!(again.state().document().is_changed());
}

#[test]
fn a_command_that_cannot_be_run_is_greyed_out() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    let greyed = |harness: &Harness<'_, App>| {
        harness.get_by_label_contains("Hide selected panels").accesskit_node().is_disabled()
    };
    // The menu stands left of the tab of the same name.
    harness.get_all_by_label("Panels").next().unwrap().click();
    settle(&mut harness);
    assert!(greyed(&harness));
    press(&mut harness, Modifiers::COMMAND, Key::A);
    assert!(!greyed(&harness));
}

/// A plugin that keeps a number with the settings, one more each time.
struct Counting(std::sync::Arc<std::sync::atomic::AtomicU64>);

impl Plugin for Counting {
    fn id(&self) -> &'static str {
        "counting"
    }

    fn name(&self) -> &'static str {
        "Counting"
    }

    fn settings(&self) -> Option<serde_json::Value> {
        Some((self.0.load(std::sync::atomic::Ordering::Relaxed) + 1).into())
    }

    fn restore(&mut self, settings: serde_json::Value) -> amc_core::Result<()> {
        let number = settings.as_u64().ok_or_else(|| amc_core::Error::invalid("no number"))?;
        self.0.store(number, std::sync::atomic::Ordering::Relaxed);
        Ok(())
    }
}

#[test]
fn plugins_get_back_what_they_keep() {
    let folder = tempfile::tempdir().unwrap();
    for expected in 0..3 {
        let number = std::sync::Arc::<std::sync::atomic::AtomicU64>::default();
        let mut harness = window(Studio::new().with_plugin(Counting(number.clone())), folder.path());
        assert_eq!(number.load(std::sync::atomic::Ordering::Relaxed), expected);
        eframe::App::on_exit(harness.state_mut());
    }
    let file = folder.path().join("kept/studio.json");
    amc_core::file::save_bytes(&file, b"{").unwrap();
    let mut harness = window(Studio::new(), folder.path());
    click(&mut harness, "Log");
    assert!(reads(&harness, &["studio.json", "kept as"]));
}

/// A plugin that fails when its pane is drawn.
struct Faulty;

impl Plugin for Faulty {
    fn id(&self) -> &'static str {
        "faulty"
    }

    fn name(&self) -> &'static str {
        "Faulty"
    }

    fn panes(&self) -> Vec<Pane> {
        vec![Pane { id: "pane", title: "Faulty pane", place: Place::Right }]
    }

    fn update(&mut self, _studio: &mut Context<'_>) {
        panic!("on purpose");
    }
}

#[test]
fn a_plugin_that_panics_is_switched_off_and_the_rest_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new().with_plugin(Faulty), folder.path());
    click(&mut harness, "Log");
    assert!(reads(&harness, &["'Faulty' failed"]));
    assert!(harness.query_by_label("Faulty pane").is_none());
    press(&mut harness, Modifiers::NONE, Key::R);
    assert!(harness.state().document().undo_name().is_some());
}

#[test]
fn what_cannot_be_opened_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let odd = folder.path().join("notes.txt");
    amc_core::file::save_bytes(&odd, b"hello").unwrap();
    let mut harness = window(Studio::new().open([odd, folder.path().join("gone.glb")]), folder.path());
    click(&mut harness, "Log");
    assert!(reads(&harness, &["nothing here opens 'notes.txt'"]));
    assert!(reads(&harness, &["gone.glb", "cannot open"]));
}

/// The pictures of the README, made anew: `cargo test -p amc-studio --test studio -- --ignored`.
#[test]
#[ignore = "writes pictures, asserts nothing about them"]
fn pictures_of_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/pictures");
    std::fs::create_dir_all(&pictures).unwrap();
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        let mut harness = Harness::builder()
            .with_size([1440.0, 900.0])
            .with_theme(theme)
            .wgpu()
            .build_eframe(|creation| Studio::new().keeping_in(folder.path()).into_app(creation));
        settle(&mut harness);
        let name = format!("studio-{}.png", if theme == egui::Theme::Dark { "dark" } else { "light" });
        harness.render().unwrap().save(pictures.join(name)).unwrap();
    }
}

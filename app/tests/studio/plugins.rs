//! What plugins may do, and what they may not.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use amc_core::render::{Mode, OwnMode};
use amc_studio::studio::Studio;
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use studio_plugin::document::Edit;
use studio_plugin::{Command, Context, Hand, Pane, Place, Plugin, ShadingChoice, ViewportView};

use super::*;

/// A plugin that keeps a number with the settings, one more each time.
struct Counting(Arc<AtomicU64>);

impl Plugin for Counting {
    fn id(&self) -> &'static str {
        "counting"
    }

    fn name(&self) -> &'static str {
        "Counting"
    }

    fn settings(&self) -> Option<serde_json::Value> {
        Some((self.0.load(Ordering::Relaxed) + 1).into())
    }

    fn restore(&mut self, settings: serde_json::Value) -> amc_core::Result<()> {
        let number = settings.as_u64().ok_or_else(|| amc_core::Error::invalid("no number"))?;
        self.0.store(number, Ordering::Relaxed);
        Ok(())
    }
}

#[test]
fn plugins_get_back_what_they_keep() {
    let folder = tempfile::tempdir().unwrap();
    for expected in 0..3 {
        let number = Arc::<AtomicU64>::default();
        let mut harness = window(Studio::new().with_plugin(Counting(number.clone())), folder.path());
        assert_eq!(number.load(Ordering::Relaxed), expected);
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

/// A plugin that marks the panels it is shown with a tool, keeps them with the project, and brings a shading mode.
struct Marking;

const MARK: Command = Command {
    id: "mark",
    name: "Mark panels",
    tooltip: "Click the panels to be marked",
    shortcut: Some(egui::KeyboardShortcut::new(Modifiers::NONE, Key::M)),
};

/// All in pure red.
const RED: &str = "#import color\n#import surface\n@fragment\n\
    fn fragment_main(surface: Surface) -> @location(0) vec4<f32> { return opaque(vec3<f32>(1.0, 0.0, 0.0)); }";

impl Plugin for Marking {
    fn id(&self) -> &'static str {
        "marking"
    }

    fn name(&self) -> &'static str {
        "Marking"
    }

    fn tools(&self) -> Vec<Command> {
        vec![MARK]
    }

    fn use_tool(&mut self, _tool: &str, hand: &Hand<'_>, studio: &mut Context<'_>) {
        let clicked = hand.response.interact_pointer_pos().filter(|_| hand.response.clicked());
        if let Some(panel) = clicked.and_then(|at| hand.viewport.panel_at(at)) {
            let (plugin, what) = ("marking".to_owned(), "Mark a panel".to_owned());
            studio.submit(Edit::SetPluginState { plugin, what, state: panel.into() });
        }
    }

    fn overlay(&mut self, painter: &egui::Painter, view: &ViewportView<'_>, studio: &mut Context<'_>) {
        if studio.document.project().plugins.contains_key("marking") {
            painter.rect_filled(view.rect, 0.0, egui::Color32::from_rgb(0, 255, 0));
        }
    }

    fn shading_modes(&self) -> Vec<ShadingChoice> {
        let mode = Mode::Own(OwnMode { name: "marking-red", text: RED, reads_fabric: false });
        vec![ShadingChoice { id: "marking-red", name: "Red", mode }]
    }
}

/// How many pixels of the window have exactly this colour.
fn count(harness: &mut Harness<'_, App>, colour: [u8; 3]) -> usize {
    let picture = harness.render().unwrap();
    picture.pixels().filter(|pixel| pixel.0[..3] == colour).count()
}

#[test]
fn a_tool_an_overlay_and_state_in_the_project() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("marked.amcproj");
    let mut harness = window(Studio::new().with_plugin(Marking), folder.path());
    press(&mut harness, Modifiers::NONE, Key::M);
    assert_eq!(count(&mut harness, [0, 255, 0]), 0);
    harness.get_by_label("Garment").click();
    settle(&mut harness);
    let kept = harness.state().document().project().plugins.get("marking").cloned();
    assert!(kept.as_ref().is_some_and(serde_json::Value::is_u64));
    assert_eq!(harness.state().document().undo_name(), Some("Mark a panel"));
    // The click was the tool's: nothing is selected.
    assert!(reads(&harness, &["All panels"]));
    assert!(count(&mut harness, [0, 255, 0]) > 100_000);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(count(&mut harness, [0, 255, 0]), 0);
    press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    harness.state_mut().save_to(&file);
    settle(&mut harness);
    drop(harness);
    // Without the plugin what it kept stays.
    let mut without = window(Studio::new().open([file.clone()]), folder.path());
    assert_eq!(without.state().document().project().plugins.get("marking"), kept.as_ref());
    press(&mut without, Modifiers::NONE, Key::R);
    without.state_mut().save_to(&file);
    settle(&mut without);
    drop(without);
    let again = window(Studio::new().with_plugin(Marking).open([file]), folder.path());
    assert_eq!(again.state().document().project().plugins.get("marking"), kept.as_ref());
}

#[test]
fn a_plugins_shading_mode_is_offered_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new().with_plugin(Marking), folder.path());
    click(&mut harness, "Look");
    click(&mut harness, "Shading");
    click(&mut harness, "Red");
    assert_eq!(harness.state().document().project().view.mode, "marking-red");
    assert!(count(&mut harness, [255, 0, 0]) > 10_000);
}

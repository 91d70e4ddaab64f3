//! The pictures of the README and of the guide, made anew: `cargo test -p amc-studio --test studio -- --ignored`.

use std::path::Path;

use amc_studio::studio::Studio;
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::*;

fn save(harness: &mut Harness<'_, App>, name: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets").join(name);
    harness.remove_cursor();
    settle(harness);
    harness.render().unwrap().save(file).unwrap();
}

fn sized(size: [f32; 2], theme: egui::Theme, folder: &Path) -> Harness<'static, App> {
    let studio = Studio::new().keeping_in(folder);
    let mut harness = Harness::builder()
        .with_size(size)
        .with_theme(theme)
        .wgpu()
        .build_eframe(move |creation| studio.into_app(creation));
    settle(&mut harness);
    harness
}

/// Draws a few strokes on the left front.
fn comb(harness: &mut Harness<'_, App>) {
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("left front"))).click();
    settle(harness);
    press(harness, Modifiers::NONE, Key::B);
    show_tab(harness, "Flat pattern");
    let named = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        node.label().is_some_and(|label| label.starts_with("Piece left front,"))
    };
    let rect = harness.get_by(named).rect();
    let at = |x: f32, y: f32| rect.lerp_inside(egui::vec2(x, y));
    for [from, to] in [[at(0.25, 0.85), at(0.7, 0.75)], [at(0.25, 0.55), at(0.7, 0.65)]] {
        directions::drag(harness, from, to);
    }
    show_tab(harness, "Comb");
}

#[test]
#[ignore = "writes pictures, asserts nothing about them"]
fn pictures_of_the_window() {
    let folder = tempfile::tempdir().unwrap();
    for (theme, name) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
        let mut harness = sized([1440.0, 900.0], theme, folder.path());
        click(&mut harness, "Close");
        save(&mut harness, &format!("pictures/studio-{name}.png"));
    }
    let mut harness = sized([1120.0, 720.0], egui::Theme::Dark, folder.path());
    save(&mut harness, "guide/pictures/window.png");
    click(&mut harness, "Close");
    press(&mut harness, Modifiers::NONE, Key::C);
    save(&mut harness, "guide/pictures/split.png");
    press(&mut harness, Modifiers::NONE, Key::C);
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("left front"))).click();
    settle(&mut harness);
    save(&mut harness, "guide/pictures/panel.png");
    comb(&mut harness);
    save(&mut harness, "guide/pictures/comb.png");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    press(&mut harness, Modifiers::COMMAND, Key::Comma);
    click(&mut harness, "Shortcuts");
    save(&mut harness, "guide/pictures/shortcuts.png");
}

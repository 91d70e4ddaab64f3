//! The designer's journey by the keyboard alone.

use amc_core::mesh::{self, Garment, Unit};
use amc_studio::studio::Studio;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::directions::{grain, near, turned_shirt};
use super::*;

/// Runs a command by typing its name into the palette.
fn command(harness: &mut Harness<'_, App>, name: &str) {
    press(harness, Modifiers::COMMAND, Key::P);
    harness.event(Event::Text(name.to_owned()));
    settle(harness);
    press(harness, Modifiers::NONE, Key::Enter);
}

/// Goes on with Tab until a piece of the flat pattern has the keyboard, and selects it.
fn select_piece(harness: &mut Harness<'_, App>, panel: &str) {
    let named = format!("Piece {panel},");
    for _ in 0..300 {
        harness.key_press(Key::Tab);
        harness.step();
        let is_there = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
            node.is_focused() && node.label().is_some_and(|label| label.starts_with(&named))
        };
        if harness.query_by(is_there).is_some() {
            return press(harness, Modifiers::NONE, Key::Enter);
        }
    }
    panic!("Tab never comes to the piece of {panel}");
}

#[test]
fn a_shirt_is_set_straight_combed_and_its_tech_sheet_exported_by_keys_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (garment, cut) = turned_shirt();
    let grain = |panel: &str| grain(&cut, panel);
    let mut harness = window(Studio::new().open([garment]), folder.path());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    let before = harness.state().document().project().clone();
    let first = harness.state().document().steps().count();

    // Edge after edge, until one is nearly along the grain: the back's side.
    select_piece(&mut harness, "back");
    let off = |harness: &Harness<'_, App>, panel: &str| {
        let off = (degrees(harness, panel).unwrap() - grain(panel)).rem_euclid(180.0);
        off.min(180.0 - off)
    };
    for _ in 0..12 {
        press(&mut harness, Modifiers::SHIFT, Key::E);
        press(&mut harness, Modifiers::NONE, Key::E);
        if off(&harness, "back") < 6.0 {
            break;
        }
    }
    assert!(off(&harness, "back") < 6.0, "no edge of the back is near its grain");
    command(&mut harness, "comb along the picked edge");
    assert_eq!(harness.state().document().project().comb("back").unwrap().strokes.len(), 1);

    select_piece(&mut harness, "left sleeve");
    command(&mut harness, "align wearer's up");
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    press(&mut harness, Modifiers::SHIFT, Key::M);
    assert!(degrees(&harness, "right-sleeve").is_some());
    select_piece(&mut harness, "yoke");
    command(&mut harness, "across the grain");
    let yoke = (degrees(&harness, "yoke").unwrap() - grain("yoke")).rem_euclid(180.0);
    assert!((yoke - 90.0).abs() < 0.01, "{yoke}");

    // All undone and redone.
    let after = harness.state().document().project().clone();
    let steps = harness.state().document().steps().count();
    for _ in first..steps {
        press(&mut harness, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(*harness.state().document().project(), before);
    for _ in first..steps {
        press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    }
    assert_eq!(harness.state().document().project().panels, after.panels);

    let sheet = folder.path().join("shirt.svg");
    command(&mut harness, "save the tech sheet");
    press(&mut harness, Modifiers::COMMAND, Key::A);
    harness.event(Event::Text(sheet.to_str().unwrap().to_owned()));
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    let start = Instant::now();
    while !sheet.is_file() {
        assert!(start.elapsed() < PATIENCE, "the tech sheet is written");
        harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
    let drawn = String::from_utf8(amc_core::file::read(&sheet, 1 << 24).unwrap()).unwrap();
    assert!(drawn.contains("yoke") && drawn.contains("<svg"));
}

#[test]
fn a_skirt_goes_on_the_bias_by_keys_alone() {
    let folder = tempfile::tempdir().unwrap();
    let garment = std::path::absolute("../assets/garments/a-line-skirt.glb").unwrap();
    let cut = Garment::new(mesh::read(&garment, Unit::Metre).unwrap()).unwrap();
    let mut harness = window(Studio::new().open([garment]), folder.path());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    // Nothing is selected: all panels are meant.
    command(&mut harness, "bias 45");
    for panel in cut.panels.iter().filter(|panel| panel.takes_fabric) {
        let straight = panel.pattern.grain.map_or(90.0, f32::to_degrees);
        near(&harness, &panel.id, straight - 45.0);
    }
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(cut.panels.iter().all(|panel| degrees(&harness, &panel.id).is_none()));
}

//! Panels renamed, grouped, merged and split, and another garment for what was chosen.

use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::Harness;

use super::directions::{command, drag};
use super::*;

fn type_name(harness: &mut Harness<'_, App>, name: &str) {
    harness.event(Event::Text(name.to_owned()));
    harness.step();
    press(harness, Modifiers::NONE, Key::Enter);
}

/// Adds a panel to what is selected.
fn select_too(harness: &mut Harness<'_, App>, panel: &str) {
    harness
        .get_by(|node| node.label().is_some_and(|label| label.starts_with(panel)))
        .click_modifiers(Modifiers::SHIFT);
    settle(harness);
}

fn undo(harness: &mut Harness<'_, App>) {
    press(harness, Modifiers::COMMAND, Key::Z);
}

/// The list has a row that starts so.
fn lists(harness: &Harness<'_, App>, panel: &str) -> bool {
    harness.query_all_by(|node| node.label().is_some_and(|label| label.starts_with(panel))).next().is_some()
}

#[test]
fn panels_are_renamed_grouped_merged_split_undone_saved_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    select(&mut harness, "left sleeve");
    press(&mut harness, Modifiers::NONE, Key::F2);
    type_name(&mut harness, "Linker Ärmel");
    assert_eq!(harness.state().document().undo_name(), Some("Rename a panel to Linker Ärmel"));
    assert!(lists(&harness, "Linker Ärmel") && !lists(&harness, "left sleeve"));
    assert!(reads(&harness, &["Piece Linker Ärmel"]), "the flat pattern calls it so too");

    select_too(&mut harness, "right sleeve");
    press(&mut harness, Modifiers::COMMAND, Key::G);
    type_name(&mut harness, "Sleeves");
    select(&mut harness, "back");
    click(&mut harness, "Sleeves (2)");
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    assert_eq!(harness.state().document().undo_name(), Some("Turn 2 panels by 1°"));
    assert!(degrees(&harness, "left-sleeve").is_some() && degrees(&harness, "right-sleeve").is_some());

    // Both run alike, so only what the second is called would be lost, and it was not renamed.
    command(&mut harness, "merge panels");
    assert_eq!(harness.state().document().undo_name(), Some("Merge 2 panels"));
    assert!(!lists(&harness, "right sleeve") && lists(&harness, "Linker Ärmel"));
    undo(&mut harness);
    assert!(lists(&harness, "right sleeve"));

    // What cannot be kept is said before it is done.
    select(&mut harness, "right sleeve");
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    click(&mut harness, "Sleeves (2)");
    command(&mut harness, "merge panels");
    assert!(reads(&harness, &["right sleeve: its angle (92.0"]));
    click(&mut harness, "Cancel");
    assert_eq!(harness.state().document().undo_name(), Some("Turn 1 panel by 1°"));
    command(&mut harness, "merge panels");
    click(&mut harness, "Merge");
    assert_eq!(harness.state().document().undo_name(), Some("Merge 2 panels"));

    select(&mut harness, "back");
    command(&mut harness, "cut panel in two across");
    assert_eq!(harness.state().document().undo_name(), Some("Split a panel"));
    assert!(lists(&harness, "back 1") && lists(&harness, "back 2"));
    undo(&mut harness);
    assert!(!lists(&harness, "back 1"));
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!(lists(&harness, "back 2"));
    // The halves are panels like any.
    select(&mut harness, "back 2");
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    assert!(degrees(&harness, "back-2").is_some() && degrees(&harness, "back-1").is_none());

    let file = folder.path().join("shirt.amcproj");
    harness.state_mut().save_to(&file);
    settle(&mut harness);
    let saved = harness.state().document().project().clone();
    drop(harness);
    let mut harness = window(Studio::new().open([file]), folder.path());
    settle(&mut harness);
    assert_eq!(harness.state().document().project().arrangement, saved.arrangement);
    for row in ["Linker Ärmel", "Sleeves (1)", "back 1", "back 2"] {
        assert!(lists(&harness, row), "{row}");
    }
    assert!(!lists(&harness, "right sleeve"));
}

#[test]
fn a_line_is_dragged_across_a_piece() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    show_tab(&mut harness, "Flat pattern");
    command(&mut harness, "split panel");
    let piece =
        harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("Piece back,"))).rect();
    drag(
        &mut harness,
        piece.left_center() - egui::vec2(4.0, 20.0),
        piece.right_center() + egui::vec2(4.0, 20.0),
    );
    assert_eq!(harness.state().document().undo_name(), Some("Split a panel"));
    // The halves are asked for in the frame after the line is drawn.
    settle(&mut harness);
    assert!(lists(&harness, "back 1") && lists(&harness, "back 2"));
    undo(&mut harness);
    settle(&mut harness);
    assert!(!lists(&harness, "back 1"));
}

#[test]
fn what_another_garment_has_no_panel_for_is_said_before_it_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = folder.path().join("sheet.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\ng cloth\nf 1/1 2/2 3/3\n";
    amc_core::file::save_bytes(&sheet, text.as_bytes()).unwrap();
    let mut harness = window(Studio::new(), folder.path());
    select(&mut harness, "left sleeve");
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    harness.state_mut().open(&sheet);
    settle(&mut harness);
    assert!(reads(&harness, &["left sleeve: its angle (91.0"]));
    click(&mut harness, "Cancel");
    assert_eq!(harness.state().document().undo_name(), Some("Turn 1 panel by 1°"));
    harness.state_mut().open(&sheet);
    settle(&mut harness);
    click(&mut harness, "Open anyway");
    // The garment is asked for in the frame after the answer.
    settle(&mut harness);
    assert_eq!(harness.state().document().undo_name(), Some("Change the garment to sheet"));
    assert!(lists(&harness, "cloth") && degrees(&harness, "left-sleeve").is_some());
}

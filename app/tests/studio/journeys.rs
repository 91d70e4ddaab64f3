//! What a person does, from the first click to the saved project.

use std::time::{Duration, Instant};

use amc_studio::studio::Studio;
use eframe::egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::*;

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

#[test]
fn a_split_view_shows_what_is_compared_and_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("split.amcproj");
    let mut harness = window(Studio::new(), folder.path());
    let whole = picture(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::C);
    let split = picture(&mut harness);
    assert_ne!(whole, split);
    click(&mut harness, "Look");
    harness.get_by_label("Right: shading").click();
    settle(&mut harness);
    harness.state_mut().save_to(&file);
    settle(&mut harness);
    let compared = harness.state().document().project().view.compared.clone();
    assert_eq!(compared.as_ref().map(|it| it.turned_deg), Some(90.0));
    drop(harness);
    let mut again = window(Studio::new().open([file]), folder.path());
    assert_eq!(again.state().document().project().view.compared, compared);
    press(&mut again, Modifiers::NONE, Key::C);
    assert_eq!(again.state().document().project().view.compared, None);
}

#[test]
fn notes_are_one_step_of_the_undo_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    let field =
        harness.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, "Notes on the project");
    field.focus();
    settle(&mut harness);
    for text in ["ask ", "the ", "mill"] {
        harness
            .get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, "Notes on the project")
            .type_text(text);
        settle(&mut harness);
    }
    assert_eq!(harness.state().document().project().notes, "ask the mill");
    assert_eq!(harness.state().document().undo_name(), Some("Edit the notes"));
    click(&mut harness, "History");
    click(&mut harness, "The beginning");
    assert_eq!(harness.state().document().project().notes, "");
}

#[test]
fn the_first_steps_do_what_they_say_and_go_for_good() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    click(&mut harness, "Swap them now");
    let undo = harness.state().document().undo_name().map(str::to_owned);
    assert!(undo.is_some_and(|name| name.starts_with("Swap warp and weft")));
    click(&mut harness, "Show the fabrics");
    assert!(reads(&harness, &["A click puts a fabric on"]));
    click(&mut harness, "Close");
    assert!(harness.query_by_label("Swap them now").is_none());
    eframe::App::on_exit(harness.state_mut());
    drop(harness);
    let mut again = window(Studio::new(), folder.path());
    assert!(again.query_by_label("Swap them now").is_none());
    press(&mut again, Modifiers::SHIFT, Key::F1);
    assert!(again.query_by_label("Swap them now").is_some());
}

#[test]
fn the_guide_and_the_licences_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    press(&mut harness, Modifiers::NONE, Key::F1);
    click(&mut harness, "Directions");
    assert!(reads(&harness, &["counter-clockwise from the right"]));
    press(&mut harness, Modifiers::NONE, Key::F1);
    press(&mut harness, Modifiers::COMMAND, Key::F1);
    assert!(reads(&harness, &["accesskit"]));
}

#[test]
fn an_obj_file_is_taken_in_the_unit_that_is_said() {
    let folder = tempfile::tempdir().unwrap();
    // A square of 500 millimetres.
    let file = folder.path().join("square.obj");
    let text =
        "v 0 0 0\nv 500 0 0\nv 500 500 0\nv 0 500 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    amc_core::file::save_bytes(&file, text.as_bytes()).unwrap();
    let mut harness = window(Studio::new().open([file]), folder.path());
    click(&mut harness, "Log");
    assert!(reads(&harness, &["is 707.11 m large"]));
    click(&mut harness, "Unit of the file");
    click(&mut harness, "mm");
    assert_eq!(harness.state().document().undo_name(), Some("Take the garment's numbers as mm"));
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("panel "))).click();
    settle(&mut harness);
    assert!(reads(&harness, &["2500 cm2"]));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(!reads(&harness, &["2500 cm2"]));
}

#[test]
fn where_there_are_no_dialogs_a_path_is_typed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("typed.amcproj");
    let mut harness = window(Studio::new().without_dialogs(), folder.path());
    let field = |harness: &Harness<'_, App>| harness.get_by_role(egui::Role::TextInput).value().unwrap();
    press(&mut harness, Modifiers::NONE, Key::R);
    press(&mut harness, Modifiers::COMMAND, Key::S);
    assert!(field(&harness).ends_with(".amcproj"));
    // Called off, nothing is saved.
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.state().document().is_changed());

    press(&mut harness, Modifiers::COMMAND, Key::S);
    type_over(&mut harness, folder.path().join("typed").to_str().unwrap());
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(file.exists() && !harness.state().document().is_changed());

    // What is there is not replaced unawares.
    press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::S);
    assert_eq!(field(&harness), file.to_str().unwrap());
    assert!(harness.query_by_label("Replace").is_some());
    click(&mut harness, "Cancel");

    press(&mut harness, Modifiers::COMMAND, Key::N);
    press(&mut harness, Modifiers::COMMAND, Key::O);
    type_over(&mut harness, folder.path().join("nothing").to_str().unwrap());
    assert!(harness.get_by_label("Open").accesskit_node().is_disabled());
    type_over(&mut harness, file.to_str().unwrap());
    click(&mut harness, "Open");
    assert!(degrees(&harness, "back").is_some());
}

/// Replaces the text of the only field.
fn type_over(harness: &mut Harness<'_, App>, text: &str) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.step();
    harness.get_by_role(egui::Role::TextInput).type_text(text);
    settle(harness);
}

/// Stripes, red and clear.
pub(super) fn stripes(file: &Path) {
    let stripe = |k: u32| if (k / 8).is_multiple_of(2) { [0.7, 0.05, 0.05, 1.0] } else { [0.0; 4] };
    let pixels = (0..32 * 32).map(stripe).collect();
    let picture = amc_core::image::Picture::new(32, 32, pixels).unwrap();
    amc_core::image::encode::write_png(&picture, file, &[]).unwrap();
}

#[test]
fn a_print_is_dropped_laid_undone_saved_moved_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("here");
    amc_core::file::make_folder(&place).unwrap();
    let (roses, file) = (place.join("stripes.png"), place.join("printed.amcproj"));
    stripes(&roses);
    let mut harness = window(Studio::new(), folder.path());
    let plain = picture(&mut harness);
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("back"))).click();
    settle(&mut harness);
    let selected = picture(&mut harness);

    harness.state_mut().open(&roses);
    settle(&mut harness);
    let print = harness.state().document().project().print("back").cloned().unwrap();
    assert_eq!(harness.state().document().undo_name(), Some("Print stripes on 1 panel"));
    assert!(harness.state().document().project().print("yoke").is_none());
    show_tab(&mut harness, "Print");
    let printed = picture(&mut harness);
    assert_ne!(printed, selected);

    // A number is typed, the picture printed once; each is a step.
    harness.get_by_role_and_label(egui::Role::SpinButton, "Width").focus();
    settle(&mut harness);
    // In a field this selects the text, not the panels.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.step();
    harness.event(egui::Event::Text("12.5".to_owned()));
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    click(&mut harness, "Repeat all over");
    assert_eq!(harness.state().document().undo_name(), Some("Move the print of 1 panel"));
    let laying = harness.state().document().project().print("back").unwrap().laying;
    assert_eq!((laying.width, laying.is_repeated), (0.125, false));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(harness.state().document().project().print("back"), Some(&print));

    harness.state_mut().save_to(&file);
    settle(&mut harness);
    drop(harness);
    // The folder is moved as it is: nothing is missing.
    let moved = folder.path().join("there");
    std::fs::rename(&place, &moved).unwrap();
    let mut again = window(Studio::new().open([moved.join("printed.amcproj")]), folder.path());
    let found = again.state().document().project().print("back").cloned().unwrap();
    assert_eq!(found.laying, print.laying);
    assert!(found.picture.path().unwrap().starts_with(&moved));
    show_tab(&mut again, "Print");
    let before = picture(&mut again);
    click(&mut again, "Take the print off");
    assert!(again.state().document().project().print("back").is_none());
    assert_ne!(picture(&mut again), before);
    press(&mut again, Modifiers::COMMAND, Key::Z);
    assert_eq!(again.state().document().project().print("back"), Some(&found));
    assert_ne!(plain, before);
}

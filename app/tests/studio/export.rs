//! Exports through the real interface, against the command line.

use std::path::PathBuf;
use std::process::Command;

use amc_core::image::compare::Difference;
use amc_core::image::decode;
use eframe::egui::Role;

use super::*;

/// A window that keeps its things in `folder`, and asks for files by a path to be typed.
fn exporting(folder: &Path, settings: &str) -> Harness<'static, App> {
    let kept = folder.join("kept");
    std::fs::create_dir_all(&kept).unwrap();
    let settings = format!(r#"{{"plugins": {{"export": {settings}}}}}"#);
    amc_core::file::save_bytes(&kept.join("studio.json"), settings.as_bytes()).unwrap();
    window(Studio::new().without_dialogs(), folder)
}

/// Types where to save, over what is suggested (which is `name`), and presses the button.
fn save_as(harness: &mut Harness<'_, App>, name: &str, file: &Path) {
    harness.run_steps(5);
    let field = harness.get_by_label_contains("A file that ends in");
    assert!(field.value().is_some_and(|text| text.ends_with(name)), "{:?}", field.value());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(2);
    harness.get_by_label_contains("A file that ends in").type_text(file.to_str().unwrap());
    harness.run_steps(2);
    harness.get_by_label("Save").click();
    harness.run_steps(2);
}

/// Runs the command of this name, by the palette.
fn command(harness: &mut Harness<'_, App>, name: &str) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::P);
    harness.run_steps(2);
    harness.get_by_label("Type what you want to do").type_text(name);
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    settle(harness);
}

/// What the command line renders of the project `mine.amcproj` in `folder`.
fn rendered(folder: &Path, options: &[&str]) -> PathBuf {
    let file = folder.join(options[0]);
    let output = Command::new(env!("CARGO_BIN_EXE_amc-studio"))
        .args(["render", "mine.amcproj", "-o"])
        .args(options)
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    file
}

#[test]
fn the_window_exports_what_the_command_line_renders() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let settings = r#"{"sizes": [[300, 220], [90, 120], [64, 64]], "frames": 4, "sides": [true, false, true, false, false, false]}"#;
    let mut harness = exporting(here, settings);
    // Something to be seen in the picture: another direction, another view, a hidden panel.
    command(&mut harness, "Turn to the bias");
    command(&mut harness, "Left view");
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("left sleeve"))).click();
    settle(&mut harness);
    command(&mut harness, "Hide selected panels");
    harness.state_mut().save_to(&here.join("mine.amcproj"));
    settle(&mut harness);

    for (name, suggested, said, options) in [
        ("Export picture ...", "shirt.png", "picture", &["cli.png", "--size", "300x220"][..]),
        (
            "Export contact sheet ...",
            "shirt-views.png",
            "sheet.exr",
            &["cli.exr", "--size", "90x120", "--views", "front,back"],
        ),
        (
            "Export turn ...",
            "shirt-turn.gif",
            "turn.png",
            &["turn-cli.png", "--size", "64x64", "--turn-frames", "4"],
        ),
    ] {
        command(&mut harness, name);
        save_as(&mut harness, suggested, &here.join(said));
        settle(&mut harness);
        // A name without a suffix gets the first.
        let file = if said == "picture" { "picture.png" } else { said };
        let exported = decode::read(&here.join(file)).unwrap();
        let expected = decode::read(&rendered(here, options)).unwrap();
        let difference = Difference::new(&exported, &expected).unwrap();
        assert!(difference.share_within(2) > 0.999, "{name}: {difference:?}");
        let covered = exported.pixels().iter().filter(|pixel| pixel[3] > 0.5).count();
        assert!(covered > exported.pixels().len() / 12, "{name}: {covered} pixels of cloth");
    }
    harness.get_by_label("Log").click();
    settle(&mut harness);
    assert!(reads(&harness, &["exported: "]) && reads(&harness, &["turn.png"]));
}

#[test]
fn the_form_says_how_large_and_a_dialog_called_off_does_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = exporting(folder.path(), "{}");
    // The menu of the same name comes first.
    harness.get_all_by_label("Export").last().unwrap().click();
    settle(&mut harness);
    harness.get_by_role_and_label(Role::ComboBox, "Size").click();
    harness.run_steps(2);
    harness.get_by_label("640 x 640").click();
    settle(&mut harness);
    harness.get_by_role_and_label(Role::ComboBox, "Background").click();
    harness.run_steps(2);
    harness.get_by_label("A colour").click();
    settle(&mut harness);
    harness.get_by_label("Export ...").click();
    harness.run_steps(5);
    harness.get_by_label("Cancel").click();
    settle(&mut harness);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "what is kept, and nothing else");
    harness.get_by_label("Export ...").click();
    save_as(&mut harness, "shirt.png", &folder.path().join("a.png"));
    settle(&mut harness);
    let picture = decode::read(&folder.path().join("a.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (640, 640));
    assert_eq!(picture.pixel(0, 0), [1.0; 4], "white, unless another colour is chosen");
}

/// Presses the form's button, and waits for the export of `huge.png` to be under way.
fn begin(harness: &mut Harness<'_, App>, file: &Path) {
    harness.get_by_label("Export ...").click();
    save_as(harness, "shirt.png", file);
    let start = Instant::now();
    while !reads(harness, &["Exporting huge.png"]) {
        assert!(start.elapsed() < PATIENCE, "it does not begin");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
}

#[test]
fn an_export_is_cancelled_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let settings = r#"{"sizes": [[32768, 32768], [1024, 1024], [640, 640]]}"#;
    let mut harness = exporting(folder.path(), settings);
    harness.get_all_by_label("Export").last().unwrap().click();
    settle(&mut harness);
    let file = folder.path().join("huge.png");
    begin(&mut harness, &file);
    // The list of jobs below the view has one, too.
    harness.get_all_by_label("Cancel").find(|button| button.rect().left() > 900.0).unwrap().click();
    settle(&mut harness);
    assert!(!reads(&harness, &["Exporting huge.png"]));
    let left = || -> Vec<_> {
        std::fs::read_dir(folder.path()).unwrap().flatten().map(|file| file.file_name()).collect()
    };
    assert_eq!(left(), ["kept"]);
    harness.get_by_label("Log").click();
    settle(&mut harness);
    assert!(reads(&harness, &["the export was cancelled"]));
    // A window that is closed leaves nothing either.
    begin(&mut harness, &file);
    drop(harness);
    assert_eq!(left(), ["kept"]);
}

#[test]
fn settings_that_make_no_sense_give_way_to_the_defaults() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = exporting(folder.path(), r#"{"sizes": [[0, 5], [1, 1], [1, 1]]}"#);
    harness.get_by_label("Log").click();
    settle(&mut harness);
    assert!(reads(&harness, &["the settings of 'Export' are its defaults again"]));
}

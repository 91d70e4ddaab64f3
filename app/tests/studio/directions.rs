//! The tangent-field editor, as a designer uses it.

use std::path::PathBuf;

use amc_core::direction::comb::{Path as StrokePath, Stroke};
use amc_core::mesh::{self, Garment, Unit};
use amc_studio::studio::Studio;
use eframe::egui::{self, Event, Key, Modifiers, PointerButton, Pos2, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::*;

pub(super) fn near(harness: &Harness<'_, App>, panel: &str, expected: f32) {
    let found = degrees(harness, panel).unwrap_or(f32::NAN);
    assert!((found - expected).abs() < 0.05, "{panel}: {found}, expected {expected}");
}

/// Runs a command by typing its name into the palette.
pub(crate) fn command(harness: &mut Harness<'_, App>, name: &str) {
    press(harness, Modifiers::COMMAND, Key::P);
    harness.get_by_label("Type what you want to do").type_text(name);
    settle(harness);
    press(harness, Modifiers::NONE, Key::Enter);
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

/// Drags from one point to another, in a few moves.
pub(super) fn drag(harness: &mut Harness<'_, App>, from: Pos2, to: Pos2) {
    harness.event(Event::PointerMoved(from));
    harness.step();
    harness.event(button(from, true));
    for k in 1..=4 {
        harness.event(Event::PointerMoved(from.lerp(to, k as f32 / 4.0)));
        harness.step();
    }
    harness.event(button(to, false));
    settle(harness);
}

#[test]
fn sleeves_are_turned_by_keys_mirrored_locked_and_undone() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    select(&mut harness, "left sleeve");
    for _ in 0..3 {
        press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    }
    near(&harness, "left-sleeve", 93.0);
    press(&mut harness, Modifiers::SHIFT, Key::M);
    near(&harness, "right-sleeve", 87.0);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(degrees(&harness, "right-sleeve"), None);

    // Linked, the partner follows; it is one step.
    show_tab(&mut harness, "Grain");
    click(&mut harness, "The mirror partner follows");
    command(&mut harness, "bias 45");
    near(&harness, "left-sleeve", 45.0);
    near(&harness, "right-sleeve", 135.0);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    near(&harness, "left-sleeve", 93.0);
    assert_eq!(degrees(&harness, "right-sleeve"), None);

    click(&mut harness, "Locked");
    assert_eq!(harness.state().document().undo_name(), Some("Lock 1 panel"));
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    near(&harness, "left-sleeve", 93.0);
    assert!(reads(&harness, &["1 panel is locked"]));
    while harness.state().document().undo_name().is_some() {
        press(&mut harness, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(degrees(&harness, "left-sleeve"), None);
}

#[test]
fn an_arrow_is_dragged_and_a_sum_is_typed() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    show_tab(&mut harness, "Flat pattern");
    let tip = harness.get_by_label("Grain of back").rect().center();
    // The arrow points up; a quarter of the piece's width to the right of its tip is 45 degrees or so.
    drag(&mut harness, tip, tip + vec2(60.0, 0.0));
    let turned = degrees(&harness, "back").unwrap();
    assert!((10.0..80.0).contains(&turned), "{turned}");
    assert_eq!(harness.state().document().steps().count(), 1, "a drag is one step");
    let before = picture(&mut harness);

    select(&mut harness, "back");
    show_tab(&mut harness, "Grain");
    harness.get_by_role_and_label(egui::Role::SpinButton, "Warp").focus();
    settle(&mut harness);
    harness.event(Event::Text("90-67,5".to_owned()));
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    near(&harness, "back", 22.5);
    assert_ne!(picture(&mut harness), before);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    near(&harness, "back", turned);
}

/// A project's strokes on a panel.
pub(super) fn strokes(harness: &Harness<'_, App>, panel: &str) -> Vec<Stroke> {
    let comb = harness.state().document().project().comb(panel);
    comb.map(|comb| comb.strokes.clone()).unwrap_or_default()
}

/// Where a piece of the flat pattern is in the window.
pub(super) fn piece(harness: &Harness<'_, App>, name: &str) -> Rect {
    let named = format!("Piece {name},");
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with(&named))).rect()
}

#[test]
fn strokes_comb_a_panel_and_are_moved_switched_off_deleted_undone_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    show_tab(&mut harness, "Flat pattern");
    select(&mut harness, "back");
    let plain = picture(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::B);
    let back = piece(&harness, "back");
    let (from, to) = (back.center() + vec2(-25.0, 10.0), back.center() + vec2(30.0, -5.0));
    drag(&mut harness, from, to);
    let drawn = strokes(&harness, "back");
    assert_eq!((drawn.len(), harness.state().document().steps().count()), (1, 1), "a stroke is one step");
    let StrokePath::Pattern(points) = &drawn[0].path else { panic!("a stroke of the pattern") };
    assert!(points.len() >= 2);
    let combed = picture(&mut harness);
    assert_ne!(combed, plain);

    // Its end is dragged: it turns about its start.
    drag(&mut harness, to, to + vec2(0.0, -30.0));
    let moved = strokes(&harness, "back");
    let StrokePath::Pattern(turned) = &moved[0].path else { panic!("a stroke of the pattern") };
    assert!(turned[0].distance(points[0]) < 1e-4);
    assert!(turned[turned.len() - 1].distance(points[points.len() - 1]) > 1e-3);

    show_tab(&mut harness, "Comb");
    click(&mut harness, "Stroke 1 counts");
    assert!(!strokes(&harness, "back")[0].is_on);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(strokes(&harness, "back")[0].is_on);
    click(&mut harness, "Weft");
    assert!(
        (harness.state().document().project().comb("back").unwrap().turn.to_degrees() - 90.0).abs() < 0.01
    );

    // Turning the panel turns all of it.
    press(&mut harness, Modifiers::SHIFT, Key::CloseBracket);
    assert!(
        (harness.state().document().project().comb("back").unwrap().turn.to_degrees() - 180.0).abs() < 0.01
    );
    let kept = harness.state().document().project().clone();
    press(&mut harness, Modifiers::NONE, Key::Delete);
    assert!(strokes(&harness, "back").is_empty());
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(*harness.state().document().project(), kept);
    while harness.state().document().undo_name().is_some() {
        press(&mut harness, Modifiers::COMMAND, Key::Z);
    }
    assert!(harness.state().document().project().comb("back").is_none());
    press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert_eq!(strokes(&harness, "back"), drawn);
}

#[test]
fn a_stroke_is_drawn_on_the_garment_and_lies_in_its_flat_pattern() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    let plain = picture(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::B);
    let view = harness.get_by_label("Garment").rect();
    let from = view.center() + vec2(-30.0, 10.0);
    drag(&mut harness, from, from + vec2(0.0, 60.0));
    let project = harness.state().document().project().clone();
    let combed: Vec<_> = project.panels.iter().filter(|(_, choice)| choice.comb.is_some()).collect();
    let [(panel, _)] = combed[..] else { panic!("one panel is combed, not {}", combed.len()) };
    let drawn = strokes(&harness, panel);
    assert!(matches!(&drawn[0].path, StrokePath::Pattern(points) if points.len() >= 2));
    assert_ne!(picture(&mut harness), plain);

    // Put away, the button selects again.
    press(&mut harness, Modifiers::NONE, Key::B);
    drag(&mut harness, from, from + vec2(40.0, 0.0));
    assert_eq!(strokes(&harness, panel), drawn);
}

#[test]
fn a_garment_without_a_flat_pattern_is_combed_in_space() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bare.obj");
    let mut text = "o cloth\n".to_owned();
    for k in 0..11 * 11 {
        text += &format!("v {} {} 0\n", (k % 11) as f32 * 0.1, (k / 11) as f32 * 0.1);
    }
    for k in (1..11 * 10).filter(|k| k % 11 != 0) {
        text += &format!("f {} {} {} {}\n", k, k + 1, k + 12, k + 11);
    }
    amc_core::file::save_bytes(&file, text.as_bytes()).unwrap();
    let mut harness = window(Studio::new().open([file]), folder.path());
    click(&mut harness, "Close");
    let plain = picture(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::B);
    let middle = harness.get_by_label("Garment").rect().center();
    drag(&mut harness, middle + vec2(-40.0, 30.0), middle + vec2(40.0, -30.0));
    let project = harness.state().document().project();
    let (_, choice) = project.panels.iter().find(|(_, choice)| choice.comb.is_some()).unwrap();
    let stroke = &choice.comb.as_ref().unwrap().strokes[0];
    let StrokePath::Space(points) = &stroke.path else { panic!("a stroke in space") };
    let along = (points[points.len() - 1] - points[0]).truncate();
    let degrees = along.to_angle().to_degrees();
    assert!((degrees - (30.0_f32).atan2(40.0).to_degrees()).abs() < 3.0, "{degrees}");
    press(&mut harness, Modifiers::NONE, Key::B);
    assert_ne!(picture(&mut harness), plain);
}

#[test]
fn an_edge_is_clicked_and_the_grain_laid_along_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    let piece = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        node.label().is_some_and(|label| label.starts_with("Piece back"))
    };
    let place = harness.get_by(piece).rect();
    // The side seam is the left edge of the back, below the armhole.
    let at = egui::pos2(place.left() + 1.0, place.top() + 0.7 * place.height());
    for event in [Event::PointerMoved(at), button(at, true), button(at, false)] {
        harness.event(event);
    }
    settle(&mut harness);
    command(&mut harness, "bias 45");
    near(&harness, "back", 45.0);
    press(&mut harness, Modifiers::NONE, Key::E);
    let along = degrees(&harness, "back").unwrap();
    assert!((along - 90.0).abs() < 8.0 && (along - 45.0).abs() > 30.0, "{along}");
    assert_eq!(degrees(&harness, "yoke"), None, "the edge's panel alone");
}

#[test]
fn the_arrow_on_the_garment_is_dragged_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    // A pocket lies on it.
    select(&mut harness, "left front");
    let garment = harness.get_by_label("Garment").rect();
    let tips: Vec<Rect> = harness.get_all_by_label("Grain of left front").map(|node| node.rect()).collect();
    let on_garment = tips.iter().find(|tip| garment.contains_rect(**tip)).expect("a tip on the garment");
    let before = picture(&mut harness);
    let tip = on_garment.center();
    // The front hangs down with its warp upright: to the wearer's left is clockwise as it is seen.
    drag(&mut harness, tip, tip + vec2(40.0, 0.0));
    let turned = degrees(&harness, "left-front").unwrap();
    assert!((30.0..85.0).contains(&turned), "{turned}");
    assert_eq!(harness.state().document().steps().count(), 1, "a drag is one step");
    assert_ne!(picture(&mut harness), before);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(degrees(&harness, "left-front"), None);
}

#[test]
fn two_points_make_a_line_and_a_piece_is_turned_on_the_screen_but_not_its_grain() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    let back = piece(&harness, "back");
    for share in [vec2(0.25, 0.75), vec2(0.75, 0.45)] {
        let at = back.lerp_inside(share);
        let modifiers = Modifiers::ALT;
        let click =
            |pressed| Event::PointerButton { pos: at, button: PointerButton::Primary, pressed, modifiers };
        harness.event_modifiers(Event::PointerMoved(at), modifiers);
        harness.event_modifiers(click(true), modifiers);
        harness.event_modifiers(click(false), modifiers);
        settle(&mut harness);
    }
    press(&mut harness, Modifiers::NONE, Key::E);
    let expected = (0.3 * back.height()).atan2(0.5 * back.width()).to_degrees();
    let found = degrees(&harness, "back").unwrap().rem_euclid(180.0);
    assert!((found - expected).abs() < 1.0, "{found}, expected {expected}");

    // On the screen a quarter turn: the piece lies down, its grain stays.
    select(&mut harness, "back");
    command(&mut harness, "on the screen by +90");
    let lying = piece(&harness, "back");
    let proportions = |rect: Rect| rect.width() / rect.height();
    assert!((proportions(lying) * proportions(back) - 1.0).abs() < 0.02, "{back} {lying}");
    let after = degrees(&harness, "back").unwrap().rem_euclid(180.0);
    assert_eq!(found, after);
    show_tab(&mut harness, "Grain");
    let shown = harness.get_by_role_and_label(egui::Role::SpinButton, "Warp").value().unwrap();
    assert!(
        (shown.trim_end_matches('\u{b0}').parse::<f32>().unwrap().rem_euclid(180.0) - found).abs() < 0.06
    );

    // As far off the grain of the yoke as off that of the back.
    press(&mut harness, Modifiers::COMMAND, Key::C);
    select(&mut harness, "yoke");
    command(&mut harness, "relative to the piece");
    near(&harness, "yoke", degrees(&harness, "back").unwrap() - 90.0);
}

/// A shirt whose pieces lie off the axes of its UVs: its file, and what is in it.
pub(super) fn turned_shirt() -> (PathBuf, Garment) {
    let file = std::path::absolute("../assets/garments/variants/shirt-turned.glb").unwrap();
    let garment = Garment::new(mesh::read(&file, Unit::Metre).unwrap()).unwrap();
    (file, garment)
}

/// The grain that a panel's file says, degrees.
pub(super) fn grain(garment: &Garment, panel: &str) -> f32 {
    let panel = garment.panels.iter().find(|it| it.id == panel).unwrap();
    panel.pattern.grain.unwrap().to_degrees()
}

#[test]
fn a_shirt_that_lies_off_its_grain_is_set_straight() {
    let folder = tempfile::tempdir().unwrap();
    let (garment, cut) = turned_shirt();
    let grain = |panel: &str| grain(&cut, panel);
    let mut harness = window(Studio::new().open([garment]), folder.path());
    // The back hangs straight down, so upright is its grain.
    select(&mut harness, "back");
    command(&mut harness, "align wearer's up");
    let off = (degrees(&harness, "back").unwrap() - grain("back")).rem_euclid(360.0);
    assert!(off.min(360.0 - off) < 3.0, "{off}");
    // The yoke on the cross grain.
    select(&mut harness, "yoke");
    command(&mut harness, "across the grain");
    let off = (degrees(&harness, "yoke").unwrap() - grain("yoke") - 90.0).rem_euclid(360.0);
    assert!(off.min(360.0 - off) < 0.01, "{off}");
    // Sleeves: one is taken from its seam partner, the other mirrored from it.
    select(&mut harness, "left sleeve");
    command(&mut harness, "align seam partner");
    assert!(degrees(&harness, "left-sleeve").is_some());
    press(&mut harness, Modifiers::SHIFT, Key::M);
    assert!(degrees(&harness, "right-sleeve").is_some());
    let after = harness.state().document().project().clone();
    let steps = harness.state().document().steps().count();
    for _ in 0..steps {
        press(&mut harness, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(degrees(&harness, "back"), None);
    for _ in 0..steps {
        press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    }
    assert_eq!(harness.state().document().project().panels, after.panels);
}

/// Runs a command that asks for a file, and types it.
pub(super) fn command_with_file(harness: &mut Harness<'_, App>, name: &str, file: &Path, button: &str) {
    command(harness, name);
    let field = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        node.role() == egui::Role::TextInput && node.is_focused()
    };
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(2);
    harness.get_by(field).type_text(file.to_str().unwrap());
    harness.run_steps(2);
    harness.get_by_label(button).click();
    settle(harness);
}

#[test]
fn directions_are_exported_and_imported_and_what_is_not_matched_is_said_first() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new().without_dialogs(), folder.path());
    select(&mut harness, "back");
    command(&mut harness, "bias 45");
    let file = folder.path().join("shirt.json");
    command_with_file(&mut harness, "Export directions ...", &file, "Save");
    assert!(reads(&harness, &["Saved", "shirt.json"]));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(degrees(&harness, "back"), None);
    // All of it is matched, so nothing is asked.
    command_with_file(&mut harness, "Import directions ...", &file, "Use");
    near(&harness, "back", 45.0);
    assert!(reads(&harness, &["Import directions of 12 panels"]));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(degrees(&harness, "back"), None, "it was one step");

    let hand = r#"{"panels": [{"name": "Back", "angle_deg": 12}, {"name": "Hood", "angle_deg": 3}]}"#;
    let file = folder.path().join("hand.json");
    amc_core::file::save_bytes(&file, hand.as_bytes()).unwrap();
    command_with_file(&mut harness, "Import directions ...", &file, "Use");
    assert!(
        reads(&harness, &["left out: Hood"]) && reads(&harness, &["hand.json says something of 1 panel"])
    );
    assert_eq!(degrees(&harness, "back"), None, "not before it was read");
    click(&mut harness, "Cancel");
    assert_eq!(degrees(&harness, "back"), None);
    command_with_file(&mut harness, "Import directions ...", &file, "Use");
    click(&mut harness, "Apply");
    near(&harness, "back", 12.0);
}

//! What is seen over the cloth, on the pattern and on the garment.

use std::path::PathBuf;

use amc_studio::studio::Studio;
use eframe::egui::{self, Key, Modifiers, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::directions::command;
use super::*;

/// A flat sheet, 8 cm wide and high, that faces the front; the UVs are metres.
fn flat_sheet(folder: &Path) -> PathBuf {
    let mut text = String::new();
    let corners = || (0..25).map(|k| ((k % 5) as f32 * 0.02 - 0.04, (k / 5) as f32 * 0.02 - 0.04));
    for (x, y) in corners() {
        text += &format!("v {x} {y} 0\nvt {x} {y}\n");
    }
    for cell in (0..16).map(|k| k % 4 + k / 4 * 5 + 1) {
        let [a, b, c, d] = [cell, cell + 1, cell + 6, cell + 5];
        text += &format!("f {a}/{a} {b}/{b} {c}/{c} {d}/{d}\n");
    }
    let file = folder.join("sheet.obj");
    amc_core::file::save_bytes(&file, text.as_bytes()).unwrap();
    file
}

/// The window's picture: columns, and the brightness of every pixel.
fn brightness(harness: &mut Harness<'_, App>) -> (usize, Vec<[u8; 3]>) {
    harness.remove_cursor();
    settle(harness);
    let image = harness.render().unwrap();
    (image.width() as usize, image.pixels().map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2]]).collect())
}

/// How often a row of the window goes from light to dark or back.
fn changes(pixels: &(usize, Vec<[u8; 3]>), row: f32, columns: (f32, f32)) -> usize {
    let row = &pixels.1[row as usize * pixels.0..][columns.0 as usize..columns.1 as usize];
    row.windows(2).filter(|pair| (pair[0][1] > 175) != (pair[1][1] > 175)).count()
}

fn piece(harness: &Harness<'_, App>) -> Rect {
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("Piece "))).rect()
}

#[test]
fn a_checker_has_squares_of_true_size_on_the_pattern_and_on_the_garment() {
    let folder = tempfile::tempdir().unwrap();
    let file = flat_sheet(folder.path());
    let mut harness = window(Studio::new().open([file]), folder.path());
    click(&mut harness, "Close");
    let steps = harness.state().document().steps().count();
    command(&mut harness, "checker of true size");
    assert!(reads(&harness, &["Checker", "1 cm"]));
    let seen = brightness(&mut harness);
    let place = piece(&harness);
    // In the squares of the second row, above their letters.
    let row = place.center().y - 2.9 / 8.0 * place.height();
    assert_eq!(changes(&seen, row, (place.left() + 3.0, place.right() - 3.0)), 7);
    // Most rows are without letters; they begin or end in a light square.
    let garment = harness.get_by_label("Garment").rect();
    let mut counts = [0; 64];
    for row in garment.top() as usize + 1..garment.bottom() as usize - 1 {
        let count = changes(&seen, row as f32, (garment.left() + 2.0, garment.right() - 2.0));
        counts[count.min(63)] += 1;
    }
    let most = (1..64).max_by_key(|&count| counts[count]);
    assert_eq!(most, Some(8), "{counts:?}");

    command(&mut harness, "shear");
    assert!(reads(&harness, &["Shear", "50 %: 90.0"]));
    let (width, pixels) = brightness(&mut harness);
    let at = place.min + 0.2 * place.size();
    let grey = pixels[at.y as usize * width + at.x as usize];
    assert!(grey.iter().all(|value| value.abs_diff(221) <= 1), "what is not sheared is grey: {grey:?}");
    assert_eq!(harness.state().document().steps().count(), steps, "looking changes nothing");
}

#[test]
fn lines_along_the_warp_are_shown_follow_a_turn_and_go_away() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    click(&mut harness, "Close");
    let look = |harness: &mut Harness<'_, App>| {
        let (width, pixels) = brightness(harness);
        let of = |rect: Rect| -> Vec<[u8; 3]> {
            let rows = rect.top() as usize + 1..rect.bottom() as usize - 1;
            let columns = rect.left() as usize + 1..rect.right() as usize - 1;
            rows.flat_map(|row| pixels[row * width..][columns.clone()].to_vec()).collect()
        };
        let back = harness.get_by(|node| node.label().is_some_and(|label| label.starts_with("Piece back")));
        [of(harness.get_by_label("Garment").rect()), of(back.rect())]
    };
    let before = look(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::W);
    let lines = look(&mut harness);
    assert!(lines[0] != before[0] && lines[1] != before[1], "on the garment and on the pattern");
    assert!(reads(&harness, &["Fine lines"]));
    // Nothing goes on by itself.
    assert!(look(&mut harness) == lines);
    select(&mut harness, "back");
    command(&mut harness, "bias 45");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    let turned = look(&mut harness);
    assert!(turned[1] != lines[1]);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(look(&mut harness) == lines, "what is undone is seen as before");
    press(&mut harness, Modifiers::NONE, Key::W);
    assert!(look(&mut harness) == before, "nothing is left of it");
}

#[test]
fn a_weave_has_the_threads_that_are_typed() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    click(&mut harness, "Close");
    command(&mut harness, "show the weave");
    assert!(reads(&harness, &["plain, 40.0 ends and 32.0 picks", "true to size"]));
    harness.get_by_role_and_label(egui::Role::SpinButton, "Ends").focus();
    settle(&mut harness);
    harness.event(egui::Event::Text("24".to_owned()));
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(reads(&harness, &["plain, 24.0 ends and 32.0 picks"]));
    command(&mut harness, "show nothing");
    assert!(!reads(&harness, &["24.0 ends"]));
}

#[test]
fn without_a_flat_pattern_nothing_is_shown_and_that_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bare.obj");
    amc_core::file::save_bytes(&file, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let mut harness = window(Studio::new().open([file]), folder.path());
    click(&mut harness, "Close");
    press(&mut harness, Modifiers::NONE, Key::W);
    assert!(reads(&harness, &["nothing can be shown over its cloth"]));
}

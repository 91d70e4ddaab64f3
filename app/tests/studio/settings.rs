//! What is kept from one start to the next.

use amc_studio::studio::Studio;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::*;

#[test]
fn theme_size_shortcuts_and_layouts_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    press(&mut harness, Modifiers::COMMAND, Key::Comma);
    click(&mut harness, "Light");
    click(&mut harness, "Shortcuts");
    harness.get_by_label("Find").focus();
    settle(&mut harness);
    harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "Find").type_text("swap");
    settle(&mut harness);
    harness.get_by_label_contains("Shortcut of Swap warp and weft").click();
    settle(&mut harness);
    press(&mut harness, Modifiers::ALT, Key::W);
    assert!(reads(&harness, &["Shortcut of Swap warp and weft: Alt+W"]));
    click(&mut harness, "Layouts");
    harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "Name").focus();
    settle(&mut harness);
    harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "Name").type_text("Mine");
    settle(&mut harness);
    click(&mut harness, "Keep the present layout");
    // No command runs behind the page.
    press(&mut harness, Modifiers::ALT, Key::W);
    assert!(harness.state().document().undo_name().is_none());
    harness.get_all_by_label("Close").last().unwrap().click();
    settle(&mut harness);
    press(&mut harness, Modifiers::COMMAND, Key::Plus);
    assert!((harness.ctx.zoom_factor() - 1.1).abs() < 1e-4);
    eframe::App::on_exit(harness.state_mut());
    drop(harness);

    let mut again = window(Studio::new(), folder.path());
    assert!((again.ctx.zoom_factor() - 1.1).abs() < 1e-4);
    press(&mut again, Modifiers::NONE, Key::R);
    assert!(again.state().document().undo_name().is_none(), "R was given away");
    press(&mut again, Modifiers::ALT, Key::W);
    assert!(again.state().document().undo_name().is_some());
    press(&mut again, Modifiers::COMMAND, Key::Comma);
    let light = again.get_by_label("Light").accesskit_node().toggled();
    assert_eq!(light, Some(egui::accesskit::Toggled::True));
    click(&mut again, "Layouts");
    assert!(reads(&again, &["Mine"]));
}

#[test]
fn listening_for_a_shortcut_ends_with_escape() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    press(&mut harness, Modifiers::COMMAND, Key::Comma);
    click(&mut harness, "Shortcuts");
    harness.get_by_label_contains("Shortcut of New project").click();
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(reads(&harness, &["Shortcut of New project: Ctrl+N"]));
    harness.get_by_label_contains("Shortcut of New project").click();
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Backspace);
    assert!(reads(&harness, &["Shortcut of New project: none"]));
    // What was typed meanwhile went nowhere else.
    harness.event(Event::Text("x".into()));
    settle(&mut harness);
    assert!(harness.state().document().undo_name().is_none());
}

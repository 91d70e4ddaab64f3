//! Steps, gestures, what is saved, and the memory limit.

use super::super::{Document, Edit, Gesture, Project, ViewSettings};
use super::{panels, turn};

fn hide(panel: &str) -> Edit {
    Edit::SetVisible { panels: panels(&[panel]), visible: false }
}

#[test]
fn a_drag_is_one_step_and_is_called_by_its_whole_turn() {
    let mut document = Document::new(Project::default());
    let drag = Gesture::begin();
    // As a widget does that turns by what is new since the last frame ...
    for k in 0..10 {
        document.submit(turn("a", 0.1 * k as f32, 0.1), Some(drag)).unwrap();
    }
    assert_eq!(document.steps().collect::<Vec<_>>(), ["Turn 1 panel by 57.3°"]);
    // ... and as one does that turns by the whole drag.
    let drag = Gesture::begin();
    for k in 1..=10 {
        document.submit(turn("b", 0.5, 0.1 * k as f32), Some(drag)).unwrap();
    }
    assert_eq!(document.steps().collect::<Vec<_>>(), ["Turn 1 panel by 57.3°"; 2]);
    document.undo().unwrap();
    document.undo().unwrap();
    assert_eq!(document.project(), &Project::default());
}

#[test]
fn a_drag_back_to_its_start_leaves_no_step() {
    let mut document = Document::new(Project::default());
    document.submit(Edit::SetNotes("kept".to_owned()), None).unwrap();
    document.mark_saved();
    let typing = Gesture::begin();
    for notes in ["kept!", "kept"] {
        document.submit(Edit::SetNotes(notes.to_owned()), Some(typing)).unwrap();
    }
    assert_eq!((document.position(), document.is_changed()), (1, false));
    document.submit(Edit::SetNotes("kept?".to_owned()), Some(typing)).unwrap();
    assert_eq!((document.position(), document.is_changed()), (2, true));
}

#[test]
fn an_undo_ends_the_gesture() {
    let mut document = Document::new(Project::default());
    let typing = Gesture::begin();
    document.submit(hide("a"), Some(typing)).unwrap();
    document.submit(hide("b"), None).unwrap();
    document.undo().unwrap();
    document.submit(hide("c"), Some(typing)).unwrap();
    assert_eq!(document.position(), 2, "a step of its own");
}

#[test]
fn what_changes_nothing_makes_no_step() {
    let mut document = Document::new(Project::default());
    document.submit(hide("a"), None).unwrap();
    let revision = document.revision();
    document.submit(hide("a"), None).unwrap();
    assert_eq!((document.position(), document.revision()), (1, revision));
    assert_eq!(document.undo().unwrap(), "Hide 1 panel");
    // Nothing was done, so what was undone can still be done again.
    document.submit(Edit::SetNotes(String::new()), None).unwrap();
    assert_eq!(document.redo_name(), Some("Hide 1 panel"));
    assert_eq!((document.undo(), document.undo_name()), (None, None));
}

#[test]
fn what_is_saved_is_known_through_undo_and_later_edits() {
    let mut document = Document::new(Project::default());
    assert!(!document.is_changed());
    document.submit(hide("a"), None).unwrap();
    let saving = document.snapshot();
    document.submit(hide("b"), None).unwrap();
    document.mark_snapshot_saved(&saving);
    assert!(document.is_changed(), "b was hidden while a save was under way");
    document.undo().unwrap();
    assert!(!document.is_changed());
    document.undo().unwrap();
    assert!(document.is_changed());
    document.mark_saved();
    assert!(!document.is_changed());
    document.mark_unsaved();
    assert!(document.is_changed());
}

#[test]
fn a_save_that_ends_late_marks_no_other_document() {
    let saving = Document::new(Project::default()).snapshot();
    let mut other = Document::new(Project::default());
    other.mark_unsaved();
    other.mark_snapshot_saved(&saving);
    assert!(other.is_changed());
}

#[test]
fn the_view_is_no_work_and_is_not_undone() {
    let mut document = Document::new(Project::default());
    document.submit(hide("a"), None).unwrap();
    document.mark_saved();
    let revision = document.revision();
    let mut view = ViewSettings::default();
    view.zoom = f32::NAN;
    document.set_view(view.clone());
    assert_eq!(document.project().view, ViewSettings::default());
    view.zoom = 2.0;
    document.set_view(view.clone());
    assert_eq!((document.revision(), document.is_changed(), document.position()), (revision, false, 1));
    document.undo().unwrap();
    assert_eq!(document.project().view, view);
    document.submit(hide("b"), None).unwrap();
    assert_eq!(document.project().view, view);
}

#[test]
fn the_oldest_steps_go_when_memory_runs_out() {
    let limit = 1 << 20;
    let mut document = Document::new(Project::default()).with_limit(limit);
    let notes = |k: usize| format!("{k:05}").repeat(1000);
    for k in 0..1000 {
        document.submit(Edit::SetNotes(notes(k)), None).unwrap();
        assert!(document.history_bytes() <= limit);
    }
    let kept = document.steps().count();
    assert!((150..250).contains(&kept), "{kept} steps of 5 KB in 1 MiB");
    while document.undo().is_some() {}
    assert_eq!(document.project().notes, notes(999 - kept));
    // One step larger than everything: it can still be undone.
    document.submit(Edit::SetNotes("x".repeat(Project::LONGEST_NOTES)), None).unwrap();
    assert_eq!(document.steps().count(), 1);
    document.undo().unwrap();
    assert_eq!(document.project().notes, notes(999 - kept));
}

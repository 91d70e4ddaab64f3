//! Autosave, recovery, and locks.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use studio_plugin::document::{Document, Edit, Project};

use super::super::{Autosave, Claim, ProjectLock, Recoverable, System, Unknown, recoverable, save};
use super::{Faulty, rich, write_files};

const SOON: Duration = Duration::from_millis(2);

fn with_notes(notes: &str) -> Arc<Project> {
    Arc::new(Project { notes: notes.to_owned(), ..Project::default() })
}

fn works(folder: &Path) -> Vec<Recoverable> {
    let found = recoverable(&System, folder).unwrap();
    assert!(found.notices.is_empty(), "{:?}", found.notices);
    found.works
}

fn files(folder: &Path) -> usize {
    std::fs::read_dir(folder).unwrap().count()
}

#[test]
fn a_dead_sessions_work_is_offered_once_and_a_living_ones_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("coat.amcproj");
    let project = Arc::new(rich(folder.path()));
    let autosave = Autosave::start_every(SOON, folder.path(), Arc::new(System)).unwrap();
    autosave.keep(Arc::clone(&project), Arc::default(), Some(&file));
    while autosave.kept().is_none() {
        std::thread::yield_now();
    }
    assert!(works(folder.path()).is_empty(), "it is alive");
    // Dropped, not finished: the lock goes as it does when the process dies.
    drop(autosave);
    let offered = works(folder.path());
    assert_eq!(offered.len(), 1);
    assert_eq!((&offered[0].read.project, offered[0].belongs_to.as_deref()), (&*project, Some(&*file)));
    assert!(!offered[0].is_older);
    assert!(works(folder.path()).is_empty(), "another window is not offered it meanwhile");
    drop(offered);
    works(folder.path()).remove(0).discard(&System).unwrap();
    assert_eq!(files(folder.path()), 0);
}

#[test]
fn nothing_stays_after_a_clean_end_or_a_save() {
    let folder = tempfile::tempdir().unwrap();
    let autosave = Autosave::start_every(SOON, folder.path(), Arc::new(System)).unwrap();
    autosave.keep(with_notes("work"), Arc::default(), None);
    autosave.finish();
    assert_eq!(files(folder.path()), 0);
    let autosave = Autosave::start_every(SOON, folder.path(), Arc::new(System)).unwrap();
    autosave.keep(with_notes("work"), Arc::default(), None);
    autosave.forget();
    drop(autosave);
    assert!(works(folder.path()).is_empty());
    assert_eq!(files(folder.path()), 0);
}

#[test]
fn a_document_that_is_followed_is_kept_while_it_is_unsaved() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Arc::new(Faulty::default());
    let mut autosave = Autosave::start_every(SOON, folder.path(), Arc::clone(&disk) as _).unwrap();
    let mut document = Document::new(Project::default());
    let mut frames = |document: &Document, is_kept: bool| {
        for _ in 0..2000 {
            autosave.follow(document, &Arc::default(), None);
            if autosave.kept().is_some() == is_kept {
                break;
            }
            std::thread::sleep(SOON);
        }
        assert_eq!(
            autosave.kept().map(|kept| kept.notes.clone()),
            is_kept.then(|| document.project().notes.clone())
        );
    };
    frames(&document, false);
    document.submit(Edit::SetNotes("work".to_owned()), None).unwrap();
    frames(&document, true);
    document.mark_saved();
    frames(&document, false);
    document.undo().unwrap();
    frames(&document, true);
    // Idle frames write nothing.
    let writes = disk.saves.load(Ordering::SeqCst);
    (0..100).for_each(|_| frames(&document, true));
    assert_eq!(disk.saves.load(Ordering::SeqCst), writes);
    drop(autosave);
    assert_eq!(works(folder.path()).len(), 1);
}

#[test]
fn adopted_work_is_the_new_sessions() {
    let folder = tempfile::tempdir().unwrap();
    let first = Autosave::start_every(SOON, folder.path(), Arc::new(System)).unwrap();
    first.keep(with_notes("work"), Arc::default(), None);
    drop(first);
    let second = Autosave::start_every(SOON, folder.path(), Arc::new(System)).unwrap();
    let offered = works(folder.path()).remove(0);
    second.adopt(offered, None);
    drop(second);
    let again = works(folder.path());
    assert_eq!(again.len(), 1, "moved, neither lost nor doubled");
    assert_eq!(again[0].read.project.notes, "work");
}

#[test]
fn work_that_its_file_holds_is_not_offered() {
    let folder = tempfile::tempdir().unwrap();
    let (kept, file) = (folder.path().join("recovery"), folder.path().join("a.amcproj"));
    // With files that nobody has looked into before the save.
    write_files(&folder.path().join("coat"));
    let project = rich(&folder.path().join("coat"));
    for (saved, offers) in [(project.notes.as_str(), false), ("something else", true)] {
        let autosave = Autosave::start_every(SOON, &kept, Arc::new(System)).unwrap();
        autosave.keep(Arc::new(project.clone()), Arc::default(), Some(&file));
        drop(autosave);
        // Killed after the save, before the recovery file was removed.
        std::thread::sleep(Duration::from_millis(20));
        let saved = Project { notes: saved.to_owned(), ..project.clone() };
        save(&System, &file, &saved, &Unknown::default()).unwrap();
        let offered = works(&kept);
        assert_eq!(offered.len(), usize::from(offers));
        assert!(offered.iter().all(|work| work.is_older));
    }
}

#[test]
fn it_writes_no_more_often_than_it_says_and_never_holds_the_caller() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Arc::new(Faulty::default());
    let interval = Duration::from_millis(100);
    let autosave = Autosave::start_every(interval, folder.path(), Arc::clone(&disk) as _).unwrap();
    let started = Instant::now();
    let mut edits = 0;
    let mut slowest = Duration::ZERO;
    while started.elapsed() < Duration::from_millis(450) {
        let edit = Instant::now();
        autosave.keep(with_notes(&format!("edit {edits}")), Arc::default(), None);
        slowest = slowest.max(edit.elapsed());
        edits += 1;
        std::thread::sleep(Duration::from_millis(1));
    }
    // At 0, 100, 200, 300 and 400 ms, later where the machine is busy.
    let writes = disk.saves.load(Ordering::SeqCst);
    assert!((2..=5).contains(&writes), "{writes} writes in 450 ms");
    // A frame has 16 ms; the rest is for a busy machine.
    assert!(slowest < Duration::from_millis(100), "{slowest:?}");
    drop(autosave);
    assert_eq!(works(folder.path())[0].read.project.notes, format!("edit {}", edits - 1));
}

#[test]
fn hostile_recovery_files_are_set_aside_and_newer_ones_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let texts = [
        ("a", "nothing", true),
        ("b", r#"{"version": 1, "process": 1, "belongs_to": null, "project": [1]}"#, true),
        ("c", r#"{"version": 2, "process": 1, "belongs_to": null, "project": {}}"#, false),
        ("d", r#"{"version": 1, "process": 1, "belongs_to": null, "project": {"version": 9}}"#, false),
    ];
    for (name, text, _) in texts {
        super::put(&folder.path().join(format!("{name}.lock")), "");
        super::put(&folder.path().join(format!("{name}.amcrecovery")), text);
    }
    let found = recoverable(&System, folder.path()).unwrap();
    assert_eq!((found.works.len(), found.notices.len()), (0, texts.len()));
    for (name, _, is_set_aside) in texts {
        assert_eq!(folder.path().join(format!("{name}.amcrecovery.broken")).exists(), is_set_aside, "{name}");
        assert_eq!(folder.path().join(format!("{name}.amcrecovery")).exists(), !is_set_aside, "{name}");
    }
}

#[test]
fn the_second_window_on_a_project_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let (locks, file) = (folder.path().join("locks"), folder.path().join("a.amcproj"));
    let Claim::Ours(first) = ProjectLock::claim(&locks, &file).unwrap() else { panic!("nobody had it") };
    // By another way to the same file, which is there by now.
    super::put(&file, "{}");
    let other_way = folder.path().join("locks").join("..").join("a.amcproj");
    match ProjectLock::claim(&locks, &other_way).unwrap() {
        Claim::Theirs { process } => assert!(process.is_none_or(|process| process == std::process::id())),
        Claim::Ours(_) => panic!("it is open already"),
    }
    let other = ProjectLock::claim(&locks, &folder.path().join("b.amcproj")).unwrap();
    assert!(matches!(other, Claim::Ours(_)), "another project is free");
    drop(first);
    assert!(matches!(ProjectLock::claim(&locks, &file).unwrap(), Claim::Ours(_)));
}

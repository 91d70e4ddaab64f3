//! Disks that are full, read-only, or refuse to rename: nothing is lost, and the person is told what to do.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use studio_plugin::document::Project;

use super::super::{Autosave, System, Unknown, recent, recoverable, save};
use super::Faulty;

fn with_notes(notes: &str) -> Project {
    Project { notes: notes.to_owned(), ..Project::default() }
}

#[test]
fn a_failed_save_leaves_the_old_file_and_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.amcproj");
    let disk = Faulty::default();
    save(&disk, &path, &with_notes("old"), &Unknown::default()).unwrap();
    let old = std::fs::read(&path).unwrap();
    let faults: [(&AtomicBool, &str); 3] = [
        (&disk.full, "no room on the disk"),
        (&disk.read_only, "may not be written"),
        (&disk.refuses_rename, "may not be written"),
    ];
    for (fault, advice) in faults {
        fault.store(true, Ordering::SeqCst);
        let said = save(&disk, &path, &with_notes("new"), &Unknown::default()).unwrap_err().to_string();
        assert!(
            said.contains("a.amcproj") && said.contains(advice) && said.contains("save it elsewhere"),
            "{said}"
        );
        assert_eq!(std::fs::read(&path).unwrap(), old);
        fault.store(false, Ordering::SeqCst);
    }
    save(&disk, &path, &with_notes("new"), &Unknown::default()).unwrap();
    assert_ne!(std::fs::read(&path).unwrap(), old);
}

#[test]
fn the_systems_own_refusals_leave_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    // A rename that fails: a folder that is not empty has the name.
    let taken = folder.path().join("taken.amcproj");
    std::fs::create_dir_all(taken.join("inside")).unwrap();
    let said = save(&System, &taken, &Project::default(), &Unknown::default()).unwrap_err().to_string();
    assert!(said.contains("taken.amcproj") && said.contains("not saved"), "{said}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file");
    let gone = folder.path().join("gone").join("a.amcproj");
    let said = save(&System, &gone, &Project::default(), &Unknown::default()).unwrap_err().to_string();
    assert!(said.contains("its folder is gone"), "{said}");
}

/// Waits up to ten seconds.
fn until(mut is_so: impl FnMut() -> bool) {
    for _ in 0..2000 {
        if is_so() {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("it did not come to be");
}

#[test]
fn unsaved_work_that_could_not_be_kept_is_said_and_kept_once_it_can_be() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Arc::new(Faulty::default());
    disk.full.store(true, Ordering::SeqCst);
    let autosave =
        Autosave::start_every(Duration::from_millis(5), folder.path(), Arc::clone(&disk) as _).unwrap();
    autosave.keep(Arc::new(with_notes("work")), Arc::default(), None);
    let mut trouble = None;
    until(|| {
        trouble = trouble.take().or_else(|| autosave.trouble());
        trouble.is_some()
    });
    let said = trouble.unwrap().to_string();
    assert!(said.contains("not kept on the disk, save it yourself"), "{said}");
    assert!(autosave.kept().is_none());
    disk.full.store(false, Ordering::SeqCst);
    until(|| autosave.kept().is_some());
    // A crash, as far as files can tell.
    drop(autosave);
    let found = recoverable(&System, folder.path()).unwrap();
    assert_eq!(found.works[0].read.project.notes, "work");
}

#[test]
fn unreadable_work_that_cannot_be_set_aside_stays() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Faulty::default();
    for name in ["dead.lock", "dead.amcrecovery"] {
        super::put(&folder.path().join(name), "{ nonsense");
    }
    disk.refuses_rename.store(true, Ordering::SeqCst);
    assert_eq!(recoverable(&disk, folder.path()).unwrap().notices.len(), 1);
    assert!(folder.path().join("dead.amcrecovery").exists());
    disk.refuses_rename.store(false, Ordering::SeqCst);
    assert_eq!(recoverable(&disk, folder.path()).unwrap().notices.len(), 1);
    assert_eq!(recoverable(&disk, folder.path()).unwrap().notices.len(), 0);
    assert!(folder.path().join("dead.amcrecovery.broken").exists());
}

#[test]
fn a_list_of_recent_projects_that_cannot_be_written_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Faulty::default();
    disk.read_only.store(true, Ordering::SeqCst);
    let said = recent::add(&disk, folder.path(), &folder.path().join("a.amcproj")).unwrap_err().to_string();
    assert!(said.contains("recent.json"), "{said}");
}

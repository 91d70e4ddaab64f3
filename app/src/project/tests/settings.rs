//! Small files of settings, and the list of recent projects.

use std::path::PathBuf;

use super::super::{System, recent, settings};
use super::put;

#[test]
fn the_latest_projects_come_first_and_each_once() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("not").join("yet");
    let project = |k: usize| folder.path().join(format!("{k}.amcproj"));
    assert!(recent::list(&System, &settings).value.is_empty());
    for k in (0..20).chain([15, 3]) {
        recent::add(&System, &settings, &project(k)).unwrap();
    }
    recent::forget(&System, &settings, &project(19)).unwrap();
    let expected: Vec<PathBuf> =
        [3, 15, 18, 17, 16, 14, 13, 12, 11, 10, 9].into_iter().map(project).collect();
    assert_eq!(recent::list(&System, &settings).value, expected);
}

#[test]
fn unreadable_settings_are_set_aside_and_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recent.json");
    for (k, aside) in ["recent.json.broken", "recent.json.broken-1"].into_iter().enumerate() {
        put(&path, &format!("{{\"projects\": {k}}}"));
        let loaded = recent::list(&System, folder.path());
        assert!(loaded.value.is_empty());
        let notice = loaded.notice.unwrap();
        assert!(notice.contains("recent.json: ") && notice.ends_with(aside), "{notice}");
        assert!(!path.exists() && folder.path().join(aside).exists());
        assert_eq!(recent::list(&System, folder.path()).notice, None);
    }
    put(&path, "[\"an entry too\"]");
    assert!(settings::load::<Vec<String>>(&System, &path).notice.is_none());
}

//! Projects and the files beside them: moved, missing, changed, located.

use std::path::Path;

use amc_core::Progress;
use studio_plugin::document::{Asset, Document, Project};
use tempfile::TempDir;

use super::super::{Opened, System, Unknown, locate, open, save};
use super::{put, rich, write_files};

const FILE: &str = "coat.amcproj";

/// A project in `around/coat` with its files, saved.
fn saved() -> (TempDir, Project) {
    let around = tempfile::tempdir().unwrap();
    let folder = around.path().join("coat");
    write_files(&folder);
    let project = rich(&folder);
    save(&System, &folder.join(FILE), &project, &Unknown::default()).unwrap();
    (around, project)
}

fn opened(path: &Path) -> Opened {
    open(&System, path, &Progress::none()).unwrap()
}

fn content(asset: &Asset) -> Option<&str> {
    match asset {
        Asset::Bundled(_) => None,
        Asset::File { content, .. } => content.as_deref(),
    }
}

#[test]
fn what_was_saved_is_opened_with_what_its_files_hold() {
    let (around, mut project) = saved();
    let opened = opened(&around.path().join("coat").join(FILE));
    assert!(opened.missing.is_empty() && opened.notices.is_empty() && !opened.is_changed);
    // The only thing that saving added.
    let tweed = amc_core::file::content_key(b"tweed");
    assert_eq!(content(&opened.project.fabrics[2].asset), Some(&*tweed));
    for (asset, now) in project.assets_mut().zip(opened.project.assets()) {
        *asset = now.clone();
    }
    assert_eq!(opened.project, project);
}

#[test]
fn a_project_moved_with_its_files_opens() {
    let (around, _) = saved();
    let elsewhere = tempfile::tempdir().unwrap();
    let there = elsewhere.path().join("moved").join("here");
    std::fs::create_dir_all(elsewhere.path().join("moved")).unwrap();
    std::fs::rename(around.path().join("coat"), &there).unwrap();
    std::fs::rename(around.path().join("library"), there.parent().unwrap().join("library")).unwrap();
    let opened = opened(&there.join(FILE));
    assert!(opened.missing.is_empty(), "{:?}", opened.missing);
    assert_eq!(opened.project.garment.path(), Some(&*there.join("coat.glb")));
    let tweed = elsewhere.path().join("moved").join("library").join("tweed.amc.ktx2");
    assert_eq!(opened.project.fabrics[2].asset.path(), Some(&*tweed));
}

#[test]
fn a_changed_file_is_said_once() {
    let (around, _) = saved();
    let path = around.path().join("coat").join(FILE);
    put(&around.path().join("library/tweed.amc.ktx2"), "another weave");
    let again = opened(&path);
    let [notice] = &again.notices[..] else { panic!("{:?}", again.notices) };
    assert!(notice.contains("tweed.amc.ktx2") && notice.contains("has changed"), "{notice}");
    save(&System, &path, &again.project, &again.unknown).unwrap();
    assert!(opened(&path).notices.is_empty());
}

#[test]
fn a_missing_file_is_listed_and_others_of_its_folder_are_found_with_it() {
    let (around, _) = saved();
    let folder = around.path().join("coat");
    let mut project = opened(&folder.join(FILE)).project;
    // Three in one folder, one of which has changed meanwhile.
    for (k, name) in ["a", "b", "c"].into_iter().enumerate() {
        let path = around.path().join("lost").join(format!("{name}.amc.ktx2"));
        put(&path, name);
        let mut fabric = project.fabrics[0].clone();
        fabric.id = project.free_fabric_id();
        fabric.asset = Asset::file(path);
        project.fabrics.push(fabric);
        assert_eq!(project.fabrics.len(), 4 + k);
    }
    save(&System, &folder.join(FILE), &project, &Unknown::default()).unwrap();
    std::fs::rename(around.path().join("lost"), around.path().join("found")).unwrap();
    put(&around.path().join("found/c.amc.ktx2"), "not c at all");

    let again = opened(&folder.join(FILE));
    let lost = |name: &str| around.path().join("lost").join(format!("{name}.amc.ktx2"));
    let paths: Vec<_> =
        again.missing.iter().map(|missing| missing.asset.path().unwrap().to_owned()).collect();
    assert_eq!(paths, [lost("a"), lost("b"), lost("c")]);
    assert_eq!(again.missing[0].looked_for, [lost("a"), folder.join("a.amc.ktx2")]);

    let found = |name: &str| around.path().join("found").join(format!("{name}.amc.ktx2"));
    let edits = locate(&System, &again.missing, &lost("a"), &found("a")).unwrap();
    let mut document = Document::new(again.project);
    edits.into_iter().for_each(|edit| document.submit(edit, None).unwrap());
    let now: Vec<_> =
        document.project().fabrics[3..].iter().map(|it| it.asset.path().unwrap().to_owned()).collect();
    assert_eq!(now, [found("a"), found("b"), lost("c")], "c is not what it was");
    assert!(locate(&System, &[], &lost("c"), &found("nowhere")).unwrap_err().to_string().contains("nowhere"));
}

#[test]
fn a_file_from_far_away_is_found_beside_the_project() {
    let (far, near) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    put(&far.path().join("deep/down/hat.glb"), "a hat");
    let project =
        Project { garment: Asset::file(far.path().join("deep/down/hat.glb")), ..Project::default() };
    let path = near.path().join("inner").join("hat.amcproj");
    std::fs::create_dir(near.path().join("inner")).unwrap();
    save(&System, &path, &project, &Unknown::default()).unwrap();
    drop(far);
    put(&near.path().join("inner/hat.glb"), "another hat");
    assert_eq!(opened(&path).missing.len(), 1, "the same name is not enough");
    put(&near.path().join("inner/hat.glb"), "a hat");
    let opened = opened(&path);
    assert!(opened.missing.is_empty() && opened.is_changed);
    assert_eq!(opened.project.garment.path(), Some(&*near.path().join("inner").join("hat.glb")));
}

#[test]
fn what_is_no_file_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("coat.glb")).unwrap();
    let path = folder.path().join(FILE);
    put(&path, r#"{"version": 1, "garment": "coat.glb", "fabrics": [{"id": 0, "asset": "/dev/zero"}]}"#);
    assert_eq!(opened(&path).missing.len(), 2);
}

#[test]
fn an_unreadable_project_is_named_with_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(FILE);
    put(&path, "{\"version\": 1,\n oops}");
    let said = open(&System, &path, &Progress::none()).unwrap_err().to_string();
    assert!(said.starts_with(&format!("{}: line 2, column 2: ", path.display())), "{said}");
    let gone = folder.path().join("gone.amcproj");
    assert!(open(&System, &gone, &Progress::none()).unwrap_err().to_string().contains("gone.amcproj"));
}

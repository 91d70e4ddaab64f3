//! Opening and saving: by dialog, by argument, by dropping.

use std::path::{Path, PathBuf};

use amc_core::Result;
use studio_plugin::document::{Asset, Edit, Project};
use studio_plugin::{Job, Jobs};

use super::stager::{Kind, kind};

/// What a dialog is for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Purpose {
    Open,
    Save,
    /// Finding a file that is missing.
    Find(PathBuf),
}

/// A dialog that is open, on a thread of its own: the window goes on.
#[derive(Debug)]
pub(super) struct Dialog {
    pub(super) purpose: Purpose,
    job: Job<Option<PathBuf>>,
}

impl Dialog {
    pub(super) fn open(purpose: Purpose, name: &str, jobs: &mut Jobs) -> Self {
        let name = name.to_owned();
        let asked = purpose.clone();
        let job = jobs.start("Choosing a file", move |_| {
            let dialog = rfd::FileDialog::new();
            Ok(match asked {
                Purpose::Find(missing) => dialog.set_title(format!("Where is {}?", missing.display())).pick_file(),
                Purpose::Open => dialog
                    .add_filter("All that can be opened", &["amcproj", "glb", "gltf", "obj", "ktx2"])
                    .add_filter("Projects", &["amcproj"])
                    .add_filter("Garments", &["glb", "gltf", "obj"])
                    .add_filter("Fabrics", &["ktx2"])
                    .pick_file(),
                Purpose::Save => {
                    dialog.add_filter("Projects", &["amcproj"]).set_file_name(name).save_file()
                }
            })
        });
        Self { purpose, job }
    }

    /// What was chosen, once it is closed; nothing where it was called off.
    pub(super) fn poll(&self) -> Option<Result<Option<PathBuf>>> {
        self.job.poll()
    }
}

/// What becomes of a file that is opened or dropped.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Opened {
    /// It takes the place of the document.
    Project(PathBuf),
    /// One edit.
    Edit(Edit),
    /// It is for a plugin that takes in such files.
    Import(PathBuf),
}

/// What `file` is opened as.
pub(super) fn opened(file: &Path) -> Opened {
    match kind(file) {
        Some(Kind::Project) => Opened::Project(file.to_owned()),
        Some(Kind::Garment) => Opened::Edit(Edit::SetGarment(asset(file))),
        Some(Kind::Fabric) | None => Opened::Import(file.to_owned()),
    }
}

/// A file as the document knows it: its content's key is reckoned when the project is saved.
fn asset(file: &Path) -> Asset {
    Asset::file(std::path::absolute(file).unwrap_or_else(|_| file.to_owned()))
}

/// A name for a project that has none yet, after its garment.
pub(super) fn suggested_name(project: &Project) -> String {
    format!("{}.amcproj", project.garment.name())
}

//! Opening and saving: by dialog, by argument, by dropping.

use std::path::{Path, PathBuf};

use amc_core::Result;
use eframe::egui;
use studio_plugin::document::{Asset, Project};
use studio_plugin::{Ask, Jobs};
#[cfg(feature = "dialogs")]
use studio_plugin::{FileKind, Job};

use super::path_field::PathField;
use super::stager::{Kind, kind};
#[cfg(feature = "dialogs")]
use super::texts::{dialogs as words, files::where_is};
use crate::project::SUFFIX;

/// What a dialog is for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Purpose {
    Open,
    Save,
    /// Finding a file that is missing.
    Find(PathBuf),
    /// Where the plugin of this id is to save something.
    Where(&'static str, Ask),
    /// Which file it is to take in.
    Which(&'static str, Ask),
}

/// A question for a file, which does not hold the window up.
#[derive(Debug)]
pub(super) struct Dialog {
    pub(super) purpose: Purpose,
    form: Form,
}

#[derive(Debug)]
enum Form {
    /// The system's, on a thread of its own.
    #[cfg(feature = "dialogs")]
    System(Job<Option<PathBuf>>),
    Field(PathField),
}

/// Whether the system has dialogs to choose files in. On Unix they come over the session's bus; a rig has none.
pub(super) fn system_has_dialogs() -> bool {
    let named = |variable: &str| std::env::var_os(variable).filter(|value| !value.is_empty());
    let has_bus = || {
        let socket = named("XDG_RUNTIME_DIR").map(|folder| Path::new(&folder).join("bus"));
        named("DBUS_SESSION_BUS_ADDRESS").is_some() || socket.is_some_and(|socket| socket.exists())
    };
    cfg!(feature = "dialogs") && (!cfg!(all(unix, not(target_os = "macos"))) || has_bus())
}

impl Dialog {
    /// `name` is offered for a new project, `file` is where the present one is.
    pub(super) fn open(
        purpose: Purpose,
        (name, file): (&str, Option<&Path>),
        of_system: bool,
        jobs: &mut Jobs,
    ) -> Self {
        #[cfg(feature = "dialogs")]
        if of_system {
            let form = Form::System(ask_system(purpose.clone(), name.to_owned(), jobs));
            return Self { purpose, form };
        }
        #[cfg(not(feature = "dialogs"))]
        let _: (bool, &mut Jobs) = (of_system, jobs);
        let form = Form::Field(PathField::new(&purpose, name, file));
        Self { purpose, form }
    }

    /// What was chosen, once it is closed; nothing where it was called off. To be called once a frame.
    pub(super) fn poll(&mut self, ui: &egui::Ui) -> Option<Result<Option<PathBuf>>> {
        let answer = match &mut self.form {
            #[cfg(feature = "dialogs")]
            Form::System(job) => job.poll(),
            Form::Field(field) => field.show(ui, &self.purpose).map(Ok),
        };
        answer.map(|answer| Ok(answer?.map(|path| with_suffix(path, &self.purpose))))
    }
}

/// `path`, ending as what was asked for does.
pub(super) fn with_suffix(path: PathBuf, purpose: &Purpose) -> PathBuf {
    let suffixes: Vec<&str> = match purpose {
        Purpose::Open | Purpose::Find(_) | Purpose::Which(..) => return path,
        Purpose::Save => vec![SUFFIX],
        Purpose::Where(_, ask) => ask.kinds.iter().flat_map(|kind| kind.suffixes).copied().collect(),
    };
    let Some(name) = path.file_name().map(|name| name.to_string_lossy().to_lowercase()) else { return path };
    let has_one = suffixes.iter().any(|suffix| name.ends_with(&format!(".{suffix}")));
    match suffixes.first() {
        Some(first) if !has_one && !path.is_dir() => {
            let mut named = path.into_os_string();
            named.push(format!(".{first}"));
            named.into()
        }
        _ => path,
    }
}

#[cfg(feature = "dialogs")]
fn ask_system(purpose: Purpose, name: String, jobs: &mut Jobs) -> Job<Option<PathBuf>> {
    jobs.start(words::CHOOSING, move |_| {
        let dialog = rfd::FileDialog::new();
        Ok(match purpose {
            Purpose::Find(missing) => dialog.set_title(where_is(missing.display())).pick_file(),
            Purpose::Open => dialog
                .add_filter(words::ALL_KINDS, &["amcproj", "glb", "gltf", "obj", "ktx2"])
                .add_filter(words::PROJECTS, &["amcproj"])
                .add_filter(words::GARMENTS, &["glb", "gltf", "obj"])
                .add_filter(words::FABRICS, &["ktx2"])
                .pick_file(),
            Purpose::Save => dialog.add_filter(words::PROJECTS, &["amcproj"]).set_file_name(name).save_file(),
            Purpose::Where(_, ask) => {
                of_kinds(dialog.set_file_name(ask.name), ask.kinds).set_title(ask.title).save_file()
            }
            Purpose::Which(_, ask) => of_kinds(dialog, ask.kinds).set_title(ask.title).pick_file(),
        })
    })
}

#[cfg(feature = "dialogs")]
fn of_kinds(dialog: rfd::FileDialog, kinds: &[FileKind]) -> rfd::FileDialog {
    kinds.iter().fold(dialog, |dialog, kind| dialog.add_filter(kind.name, kind.suffixes))
}

/// What becomes of a file that is opened or dropped.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Opened {
    /// It takes the place of the document.
    Project(PathBuf),
    /// The project's garment from then on.
    Garment(Asset),
    /// It is for a plugin that takes in such files.
    Import(PathBuf),
}

/// What `file` is opened as.
pub(super) fn opened(file: &Path) -> Opened {
    match kind(file) {
        Some(Kind::Project) => Opened::Project(file.to_owned()),
        Some(Kind::Garment) => Opened::Garment(asset(file)),
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

#[cfg(test)]
mod tests {
    use super::*;
    use studio_plugin::FileKind;

    #[test]
    fn a_file_without_a_known_suffix_gets_the_first() {
        const KINDS: &[FileKind] = &[FileKind { name: "Pictures", suffixes: &["png", "exr"] }];
        let ask = Ask { id: "", title: String::new(), name: String::new(), kinds: KINDS };
        let purpose = Purpose::Where("", ask);
        for (given, kept) in
            [("a", "a.png"), ("a.EXR", "a.EXR"), ("a.b/c", "a.b/c.png"), ("v1.2", "v1.2.png")]
        {
            assert_eq!(with_suffix(given.into(), &purpose), PathBuf::from(kept));
        }
        assert_eq!(with_suffix("a".into(), &Purpose::Save), PathBuf::from("a.amcproj"));
        assert_eq!(with_suffix("a".into(), &Purpose::Open), PathBuf::from("a"));
    }
}

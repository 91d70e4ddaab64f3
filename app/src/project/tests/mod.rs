//! Files of projects, whole and broken, on disks that are well and on those that are not.

mod faults;
mod files;
mod form;
mod mutations;
mod recovery;
mod settings;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::SystemTime;

use amc_core::direction::comb::{Comb, Elsewhere, Hold, Path as StrokePath, Stroke};
use amc_core::direction::{Direction, Field, Source};
use amc_core::mesh::Rearrangement;
use amc_core::render::Laying;
use amc_core::{Error, Result};
use glam::{Vec2, Vec3};
use studio_plugin::document::{
    Angles, Asset, Colourway, ColourwayId, ColourwayLabel, Colourways, FabricId, FabricInUse, PanelChoice,
    PanelPrint, PanelWear, Project,
};

use super::{Disk, System};

/// A project that has something of everything; its files lie in `folder`.
fn rich(folder: &Path) -> Project {
    let mut project = Project { garment: Asset::file(folder.join("coat.glb")), ..Project::default() };
    for (number, asset) in [
        (4, Asset::file(folder.join("fabrics/silk.amc.ktx2"))),
        (9, Asset::file(folder.parent().unwrap().join("library/tweed.amc.ktx2"))),
    ] {
        project.fabrics.push(FabricInUse { id: FabricId::new(number), name: asset.name(), asset });
    }
    let around = Field::Around { origin: Vec3::new(0.1, -2.5, 1e-9), direction: Vec3::Y };
    let directions = [
        None,
        Some(Direction { source: Source::Yarn, angle: std::f32::consts::FRAC_PI_2 }),
        Some(Direction { source: Source::Field(around), angle: 0.1 }),
    ];
    for (k, direction) in directions.into_iter().enumerate() {
        let fabric = [None, Some(None), Some(Some(FabricId::new(9)))][k];
        let print = (k == 2).then(|| print(folder, "roses.png"));
        let comb = (k == 1).then(|| Arc::new(comb()));
        let choice = PanelChoice { fabric, direction, comb, print, visible: k != 1 };
        project.panels.insert(format!("panel-{k}"), choice);
    }
    let merge = Rearrangement::Merge(vec!["panel-0".to_owned(), "panel-4".to_owned()]);
    let into = ["panel-1-1".to_owned(), "panel-1-2".to_owned()];
    let line = [Vec2::new(0.1, 1e-7), Vec2::new(-0.3, 0.7)];
    let split = Rearrangement::Split { panel: "panel-1".to_owned(), line, into };
    project.arrangement.changes = vec![merge, split];
    project.arrangement.names.insert("panel-2".to_owned(), "Ärmel".to_owned());
    project.groups.insert("body".to_owned(), ["panel-0".to_owned(), "panel-2".to_owned()].into());
    project.view.set_angles(Angles { yaw: 12.3, pitch: -45.6, roll: 78.9 });
    project.view.zoom = 1.7;
    project.colourways = colourways(folder);
    project.notes = "two \"lines\"\nof Grüße".to_owned();
    project
}

fn print(folder: &Path, name: &str) -> PanelPrint {
    let laying = Laying { width: 0.15, turn: 0.3, shift: Vec2::new(0.01, -0.02), is_repeated: false };
    PanelPrint { picture: Asset::file(folder.join("prints").join(name)), laying }
}

/// Three, of which the second is worn and the third lists panels.
fn colourways(folder: &Path) -> Colourways {
    let list = [(3, "Spring"), (0, "Summer"), (7, "Winter")].map(|(number, name)| {
        let label = ColourwayLabel { id: ColourwayId::new(number), name: name.to_owned() };
        Colourway { label, panels: BTreeMap::new() }
    });
    let mut list = list.to_vec();
    for (panel, fabric, print) in [
        ("panel-0", Some(Some(FabricId::new(4))), Some(print(folder, "snow.png"))),
        ("panel-1", Some(None), None),
        ("panel-9", None, Some(print(folder, "roses.png"))),
    ] {
        list[2].panels.insert(panel.to_owned(), PanelWear { fabric, print });
    }
    Colourways::new(list, Some(ColourwayId::new(0))).unwrap()
}

/// A stroke of each kind.
fn comb() -> Comb {
    let flat = StrokePath::Pattern(vec![Vec2::new(0.1, 0.25), Vec2::new(1e-7, -0.3)]);
    let free = StrokePath::Space(vec![Vec3::new(0.1, 1.7, 0.3), Vec3::ZERO]);
    let strokes = vec![
        Stroke { path: flat, hold: Hold::Exact, radius: 0.03, is_on: true },
        Stroke { path: free, hold: Hold::Soft(0.7), radius: 0.11, is_on: false },
    ];
    Comb { strokes, elsewhere: Elsewhere::Circular(Vec2::new(0.2, 0.1)), reach: 0.07, turn: 0.3 }
}

/// Writes the files that [`rich`] names.
fn write_files(folder: &Path) {
    let around = folder.parent().unwrap();
    for name in ["coat.glb", "fabrics/silk.amc.ktx2", "prints/roses.png", "prints/snow.png"] {
        let path = folder.join(name);
        put(&path, path.to_str().unwrap());
    }
    put(&around.join("library/tweed.amc.ktx2"), "tweed");
}

fn put(path: &Path, content: &str) {
    amc_core::file::make_folder(path.parent().unwrap()).unwrap();
    amc_core::file::save_bytes(path, content.as_bytes()).unwrap();
}

/// A disk that is well until it is told otherwise.
#[derive(Debug, Default)]
struct Faulty {
    full: AtomicBool,
    read_only: AtomicBool,
    refuses_rename: AtomicBool,
    saves: AtomicUsize,
}

impl Faulty {
    fn is(flag: &AtomicBool) -> bool {
        flag.load(Ordering::SeqCst)
    }

    fn refused(kind: io::ErrorKind, path: &Path) -> Error {
        Error::io("cannot write", io::Error::from(kind)).in_file(path)
    }
}

impl Disk for Faulty {
    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>> {
        System.read(path, limit)
    }

    fn save(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        if Self::is(&self.read_only) {
            return Err(Self::refused(io::ErrorKind::ReadOnlyFilesystem, path));
        }
        if Self::is(&self.full) {
            // As it goes: the beginning fits.
            let half = path.with_extension("half");
            System.save(&half, &bytes[..bytes.len() / 2])?;
            System.remove(&half)?;
            return Err(Self::refused(io::ErrorKind::StorageFull, path));
        }
        if Self::is(&self.refuses_rename) {
            return Err(Self::refused(io::ErrorKind::PermissionDenied, path));
        }
        self.saves.fetch_add(1, Ordering::SeqCst);
        System.save(path, bytes)
    }

    fn remove(&self, path: &Path) -> Result<()> {
        if Self::is(&self.read_only) && path.exists() {
            return Err(Self::refused(io::ErrorKind::ReadOnlyFilesystem, path));
        }
        System.remove(path)
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<()> {
        if Self::is(&self.read_only) || Self::is(&self.refuses_rename) {
            return Err(Self::refused(io::ErrorKind::PermissionDenied, from));
        }
        System.rename(from, to)
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>> {
        System.list(folder)
    }

    fn is_file(&self, path: &Path) -> bool {
        System.is_file(path)
    }

    fn modified(&self, path: &Path) -> Option<SystemTime> {
        System.modified(path)
    }
}

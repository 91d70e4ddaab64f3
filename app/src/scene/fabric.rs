//! The fabrics of a scene: each file read once, the bundled ones baked on first use and kept.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::bake::{self, BakeOptions};
use amc_core::reflectance;
use amc_core::{Progress, Result};

use crate::storage::cache_folder;

/// The fabrics in use, numbered in the order they were asked for.
#[derive(Debug, Default)]
pub(crate) struct Fabrics {
    tables: Vec<Arc<Amc>>,
    files: Vec<Option<PathBuf>>,
}

impl Fabrics {
    /// The number of the fabric in `file`, which is read the first time it is asked for.
    pub(crate) fn read(&mut self, file: &Path) -> Result<usize> {
        let known = self.files.iter().position(|known| known.as_deref() == Some(file));
        match known {
            Some(number) => Ok(number),
            None => Ok(self.push(Some(file.to_owned()), Amc::read(file)?)),
        }
    }

    /// The number of the bundled satin.
    pub(crate) fn bundled(&mut self, progress: &Progress<'_>) -> Result<usize> {
        match self.files.iter().position(Option::is_none) {
            Some(number) => Ok(number),
            None => Ok(self.push(None, bundled_fabric(progress)?)),
        }
    }

    fn push(&mut self, file: Option<PathBuf>, table: Amc) -> usize {
        self.files.push(file);
        self.tables.push(Arc::new(table));
        self.tables.len() - 1
    }

    /// The tables, in their order.
    pub(crate) fn into_tables(self) -> Vec<Arc<Amc>> {
        self.tables
    }
}

/// The bundled satin: from the cache, else baked and cached.
fn bundled_fabric(progress: &Progress<'_>) -> Result<Amc> {
    let bundled = reflectance::BUNDLED[0];
    let options = BakeOptions::default();
    let bake = || bake::bake(&bundled.description()?, &options, progress);
    let Some(folder) = cache_folder() else { return bake() };
    // The version of the program is part of the key: another version may bake otherwise.
    let key = format!("{}\n{options:?}\n{}", bundled.json, env!("CARGO_PKG_VERSION"));
    let file =
        folder.join("fabrics").join(format!("{}.amc.ktx2", amc_core::file::content_key(key.as_bytes())));
    if file.exists() {
        match Amc::read(&file) {
            Ok(table) => return Ok(table),
            Err(error) => log::warn!("the cached fabric is baked anew: {error}"),
        }
    }
    let table = bake()?;
    let kept = amc_core::file::make_folder(&folder.join("fabrics")).and_then(|()| table.save(&file));
    if let Err(error) = kept {
        log::warn!("the baked fabric is not kept: {error}");
    }
    Ok(table)
}

//! The fabrics of a scene: each file read once, the bundled ones baked on first use and kept.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::bake::{self, BakeOptions};
use amc_core::reflectance::{self, BUNDLED, Bundled};
use amc_core::{Progress, Result};

use crate::storage::cache_folder;

/// How a scene names a bundled fabric, in place of a file.
const FABRIC_PREFIX: &str = "fabric:";

/// The fabrics in use, numbered in the order they were asked for.
#[derive(Debug, Default)]
pub(crate) struct Fabrics {
    tables: Vec<Arc<Amc>>,
    /// What each was asked for as.
    names: Vec<PathBuf>,
}

impl Fabrics {
    /// The number of the fabric that `named` is: a file or `fabric:NAME`. It is read or baked the first time it is asked
    /// for.
    pub(crate) fn find(&mut self, named: &Path, progress: &Progress<'_>) -> Result<usize> {
        if let Some(number) = self.names.iter().position(|known| known == named) {
            return Ok(number);
        }
        self.tables.push(Arc::new(load_fabric(named, progress)?));
        self.names.push(named.to_owned());
        Ok(self.tables.len() - 1)
    }

    /// The number of the fabric for whoever asked for none.
    pub(crate) fn default_fabric(&mut self, progress: &Progress<'_>) -> Result<usize> {
        self.find(Path::new(&format!("{FABRIC_PREFIX}{}", BUNDLED[0].name)), progress)
    }

    /// The tables, in their order.
    pub(crate) fn into_tables(self) -> Vec<Arc<Amc>> {
        self.tables
    }
}

/// A fabric by its file, or a bundled one by `fabric:NAME`.
pub(crate) fn load_fabric(named: &Path, progress: &Progress<'_>) -> Result<Amc> {
    match named.to_str().and_then(|text| text.strip_prefix(FABRIC_PREFIX)) {
        Some(name) => bundled_fabric(reflectance::bundled(name)?, progress),
        None => Amc::read(named),
    }
}

/// A bundled fabric: from the cache, else baked and cached.
fn bundled_fabric(bundled: Bundled, progress: &Progress<'_>) -> Result<Amc> {
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

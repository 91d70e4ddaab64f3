//! The garments that the program ships: which there are, and how fine the files kept are.

use std::path::{Path, PathBuf};

use amc_core::mesh::{self, Unit};
use amc_core::{Error, Result};
use glam::DVec3;

use crate::cut::{CutGarment, cut};
use crate::drape::{Draped, edge_length_for};
use crate::pattern::Pattern;

/// A garment of the collection.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its name, as one word: the file's name without suffix.
    pub name: &'static str,
    /// Its pattern, JSON.
    pattern: &'static str,
    /// Length of the triangles' edges, metres: those of the file kept, unless it was changed.
    pub edge_length: f64,
}

macro_rules! entry {
    ($name:literal, $edge_length:literal) => {
        Entry {
            name: $name,
            pattern: include_str!(concat!("../patterns/", $name, ".json")),
            edge_length: $edge_length,
        }
    };
}

/// All of them. A garment is one line here and one pattern.
pub const COLLECTION: [Entry; 7] = [
    entry!("t-shirt", 0.013),
    entry!("shirt", 0.012),
    entry!("trousers", 0.013),
    entry!("a-line-skirt", 0.012),
    entry!("bias-skirt", 0.012),
    entry!("scarf", 0.013),
    entry!("square", 0.0155),
];

impl Entry {
    /// The garment of this name.
    ///
    /// # Errors
    /// There is none; the message lists those there are.
    pub fn named(name: &str) -> Result<&'static Self> {
        COLLECTION.iter().find(|entry| entry.name == name).ok_or_else(|| {
            let known: Vec<&str> = COLLECTION.iter().map(|entry| entry.name).collect();
            Error::invalid(format!("no garment '{name}': there are {}", known.join(", ")))
        })
    }

    /// Its pattern.
    ///
    /// # Errors
    /// As [`Pattern::from_json`].
    pub fn pattern(&self) -> Result<Pattern> {
        Pattern::from_json(self.pattern).map_err(|error| error.in_file(Path::new(self.name)))
    }

    /// The same garment in about so many triangles.
    ///
    /// # Errors
    /// As [`edge_length_for`].
    pub fn with_triangles(self, triangles: usize) -> Result<Self> {
        Ok(Self { edge_length: edge_length_for(&self.pattern()?, triangles)?, ..self })
    }

    /// Its pieces as its file has them.
    ///
    /// # Errors
    /// As [`cut()`].
    pub fn cut(&self) -> Result<CutGarment> {
        cut(&self.pattern()?, self.edge_length)
    }

    /// Its file in a folder.
    pub fn file(&self, folder: &Path) -> PathBuf {
        folder.join(format!("{}.glb", self.name))
    }

    /// The garment cut anew, and draped as its file in the folder has it.
    ///
    /// # Errors
    /// The file cannot be read, or is not of this cut: the pattern has changed since it was made.
    pub fn draped(&self, folder: &Path) -> Result<(CutGarment, Draped)> {
        let file = self.file(folder);
        let cut = self.cut()?;
        let mesh = mesh::read(&file, Unit::Metre)?;
        let count: usize = cut.pieces.iter().map(|piece| piece.flat.len()).sum();
        if mesh.positions.len() != count {
            let message = format!(
                "{} vertices, but the pattern is cut into {count}: make the file anew with `wardrobe collection`",
                mesh.positions.len()
            );
            return Err(Error::invalid(message).in_file(&file));
        }
        let mut rest = mesh.positions.iter().map(|position| position.as_dvec3());
        let of_piece = |count: usize| -> Vec<DVec3> { rest.by_ref().take(count).collect() };
        let positions = cut.pieces.iter().map(|piece| piece.flat.len()).map(of_piece).collect();
        Ok((cut, Draped { positions }))
    }
}

//! What a project is made from: garments and fabrics, bundled or in files.

use std::path::{Path, PathBuf};

use amc_core::{Error, Result};
use serde::{Deserialize, Serialize};

/// How a bundled garment is named: `garment:shirt`.
const GARMENT: &str = "garment:";

/// How a shape is named: `shape:sheet`.
const SHAPE: &str = "shape:";

/// How a bundled fabric is named: `fabric:satin`.
const FABRIC: &str = "fabric:";

/// Where a garment or a fabric comes from.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Asset {
    /// One that comes with the program: `garment:shirt`, `shape:sheet` or `fabric:satin`.
    Bundled(String),
    /// A file.
    File {
        /// Where it lies; best absolute, as the program's own folder may change.
        path: PathBuf,
        /// What it held when it was last seen, by [`amc_core::file::content_key`]; none where nobody has looked.
        content: Option<String>,
    },
}

impl Asset {
    /// What `named` is: a bundled asset by its prefix, else a file nobody has looked into.
    pub fn named(named: &str) -> Self {
        match [GARMENT, SHAPE, FABRIC].iter().any(|prefix| named.starts_with(prefix)) {
            true => Self::Bundled(named.to_owned()),
            false => Self::file(named),
        }
    }

    /// A file nobody has looked into.
    pub fn file(path: impl Into<PathBuf>) -> Self {
        Self::File { path: path.into(), content: None }
    }

    /// The file, where it is one.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Bundled(_) => None,
            Self::File { path, .. } => Some(path),
        }
    }

    /// What people call it: the bundled name without its prefix, the file's name without its suffixes.
    pub fn name(&self) -> String {
        match self {
            Self::Bundled(name) => name.split_once(':').map_or(name.as_str(), |(_, name)| name).to_owned(),
            Self::File { path, .. } => {
                let file = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
                match file.split_once('.') {
                    Some((stem, _)) if !stem.is_empty() => stem.to_owned(),
                    _ => file.into_owned(),
                }
            }
        }
    }

    /// Whether it can be a garment: a file, `garment:NAME` or `shape:NAME`.
    ///
    /// # Errors
    /// It cannot; the message says what can.
    pub fn check_garment(&self) -> Result<()> {
        self.check("garment", &[GARMENT, SHAPE])
    }

    /// Whether it can be a fabric: a file or `fabric:NAME`.
    ///
    /// # Errors
    /// It cannot; the message says what can.
    pub fn check_fabric(&self) -> Result<()> {
        self.check("fabric", &[FABRIC])
    }

    /// Whether it can be a picture: a file.
    ///
    /// # Errors
    /// It cannot; the message says what can.
    pub fn check_picture(&self) -> Result<()> {
        match self {
            Self::Bundled(name) => Err(Error::invalid(format!("'{name}' is no picture: that is a file"))),
            Self::File { .. } => self.check("picture", &[]),
        }
    }

    fn check(&self, what: &str, prefixes: &[&str]) -> Result<()> {
        match self {
            Self::Bundled(name) => {
                let is_named =
                    |prefix: &&str| name.strip_prefix(*prefix).is_some_and(|rest| !rest.is_empty());
                if !prefixes.iter().any(is_named) {
                    return Err(Error::invalid(format!(
                        "'{name}' is no bundled {what}: those are named {}NAME",
                        prefixes.join("NAME or ")
                    )));
                }
            }
            Self::File { path, content } => {
                if path.as_os_str().is_empty() {
                    return Err(Error::invalid(format!("the {what}'s file has no name")));
                }
                if content.as_ref().is_some_and(|key| !is_content_key(key)) {
                    return Err(Error::invalid(format!(
                        "the content key of the {what} {} is not 32 hexadecimal digits: leave it out",
                        path.display()
                    )));
                }
            }
        }
        Ok(())
    }
}

fn is_content_key(key: &str) -> bool {
    key.len() == 32 && key.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Which of a project's fabrics: a number that stays the same while others come and go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct FabricId(u32);

impl FabricId {
    /// The fabric of this number.
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// Its number.
    pub const fn number(self) -> u32 {
        self.0
    }
}

/// A fabric of a project.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FabricInUse {
    /// What panels refer to it by.
    pub id: FabricId,
    /// Where it comes from: a file or `fabric:NAME`.
    pub asset: Asset,
    /// What people call it; not empty.
    pub name: String,
}

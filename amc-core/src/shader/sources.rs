//! Where the text of a shader comes from.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::{Error, Result, file};

/// The largest shader file that is read.
const FILE_LIMIT: u64 = 1 << 20;

macro_rules! embedded {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../shaders/", $name, ".wgsl")))),*]
    };
}

/// Every file of `shaders/`, by name. A test holds this against the folder.
static EMBEDDED: &[(&str, &str)] = embedded![
    "amc_surface",
    "ball",
    "ball_surface",
    "color",
    "cyclic",
    "facing",
    "mark",
    "mode_amc",
    "mode_amc_printed",
    "mode_ball",
    "mode_ball_printed",
    "mode_covered",
    "mode_normals",
    "mode_plain",
    "mode_tangents",
    "mode_uv",
    "perspective",
    "print",
    "surface",
    "table",
    "vertex",
    "view",
    "view_space",
    "viewport",
];

/// The text of one shader file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Where a person finds it: a path, or `shaders/NAME.wgsl` for an embedded one.
    pub file: PathBuf,
    /// Its text.
    pub text: Cow<'static, str>,
}

/// Where shaders are looked for, by name: in a folder, if one is given, then among those embedded in the program, then
/// among those from outside.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sources {
    folder: Option<PathBuf>,
    /// Shaders from outside, by name.
    own: Vec<(&'static str, &'static str)>,
}

impl Sources {
    /// Only the embedded shaders.
    pub fn embedded() -> Self {
        Self::default()
    }

    /// The files of `folder` before the embedded ones: a development tree, or a folder that overrides some of them.
    pub fn folder(folder: impl Into<PathBuf>) -> Self {
        Self { folder: Some(folder.into()), own: Vec::new() }
    }

    /// These, and one shader more.
    ///
    /// # Errors
    /// `name` is no name, or that of an embedded shader.
    pub fn with(&self, name: &'static str, text: &'static str) -> Result<Self> {
        check_name(name)?;
        if EMBEDDED.iter().any(|(known, _)| *known == name) {
            return Err(Error::invalid(format!("the program has a shader {name:?}: choose another name")));
        }
        let mut more = self.clone();
        more.own.retain(|(known, _)| *known != name);
        more.own.push((name, text));
        Ok(more)
    }

    /// The names of all shaders there are, sorted.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn names(&self) -> Result<Vec<String>> {
        let mut names: Vec<String> = EMBEDDED.iter().map(|(name, _)| (*name).to_owned()).collect();
        if let Some(folder) = &self.folder {
            let io = |source| Error::io("cannot list", source).in_file(folder);
            for entry in std::fs::read_dir(folder).map_err(io)? {
                let path = entry.map_err(io)?.path();
                let stem = path.file_stem().and_then(|stem| stem.to_str());
                match stem {
                    Some(stem) if path.extension().is_some_and(|e| e == "wgsl") && is_name(stem) => {
                        names.push(stem.to_owned());
                    }
                    _ => {}
                }
            }
        }
        names.extend(self.own.iter().map(|(name, _)| (*name).to_owned()));
        names.sort();
        names.dedup();
        Ok(names)
    }

    /// The text of the shader `name`; none where no place has it.
    ///
    /// # Errors
    /// `name` is no name (letters, digits, `_`, `-`), or its file cannot be read, is larger than 1 MiB or not UTF-8.
    pub fn read(&self, name: &str) -> Result<Option<Source>> {
        check_name(name)?;
        if let Some(folder) = &self.folder {
            let path = folder.join(format!("{name}.wgsl"));
            if path.exists() {
                return read_file(&path).map(Some);
            }
        }
        let embedded = EMBEDDED.iter().chain(&self.own).find(|(known, _)| *known == name);
        Ok(embedded.map(|(name, text)| Source {
            file: PathBuf::from(format!("shaders/{name}.wgsl")),
            text: Cow::Borrowed(text),
        }))
    }
}

fn read_file(path: &Path) -> Result<Source> {
    let text = String::from_utf8(file::read(path, FILE_LIMIT)?).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        Error::malformed("not UTF-8 text").at_byte(valid as u64).in_file(path)
    })?;
    Ok(Source { file: path.to_owned(), text: Cow::Owned(text) })
}

fn check_name(name: &str) -> Result<()> {
    if is_name(name) {
        return Ok(());
    }
    Err(Error::malformed(format!("{name:?} is no name of a shader: letters, digits, - and _ make one")))
}

fn is_name(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-'))
}

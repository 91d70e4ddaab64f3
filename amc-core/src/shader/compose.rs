//! One WGSL text from a shader and what it imports.

use std::path::{Path, PathBuf};

use super::{Source, Sources};
use crate::{Error, Result};

/// How deep imports may nest: far more than any sensible shader, and little stack.
const DEPTH_LIMIT: usize = 64;

/// The largest composed text.
const TEXT_LIMIT: usize = 4 << 20;

/// Where a line of a composed text comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Origin<'a> {
    /// The file, as [`Source::file`] has it.
    pub file: &'a Path,
    /// The line there, from 1.
    pub line: u64,
}

/// A shader with everything it imports, as one WGSL text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Composition {
    text: String,
    names: Vec<String>,
    files: Vec<PathBuf>,
    /// Of each line of `text`: the file's index and the line there, from 1.
    lines: Vec<(u32, u32)>,
}

impl Composition {
    /// The WGSL.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The names of the shaders in it: the one that was asked for, then its imports in the order they were met.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The files in it, in the order of [`Composition::names`].
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Where line `line` (from 1) of the text comes from; past the end, the last line's origin.
    pub fn origin(&self, line: u64) -> Option<Origin<'_>> {
        let index = usize::try_from(line).ok()?.checked_sub(1)?.min(self.lines.len().checked_sub(1)?);
        let &(file, line) = self.lines.get(index)?;
        Some(Origin { file: self.files.get(file as usize)?, line: u64::from(line) })
    }
}

/// Composes the shader `name` and all it imports.
///
/// # Errors
/// A shader that is not there, imports that run in a circle or nest deeper than 64, or a text of more than 4 MiB; the
/// error names the file and line of the import.
pub fn compose(sources: &Sources, name: &str) -> Result<Composition> {
    let source = sources.read(name)?.ok_or_else(|| Error::invalid(format!("there is no shader {name:?}")))?;
    let mut composer = Composer {
        sources,
        open: Vec::new(),
        done: Composition { text: String::new(), names: Vec::new(), files: Vec::new(), lines: Vec::new() },
    };
    composer.add(name, &source)?;
    Ok(composer.done)
}

struct Composer<'a> {
    sources: &'a Sources,
    /// The files that are being read, outermost first.
    open: Vec<String>,
    done: Composition,
}

impl Composer<'_> {
    fn add(&mut self, name: &str, source: &Source) -> Result<()> {
        let file = self.done.files.len() as u32;
        self.done.files.push(source.file.clone());
        self.done.names.push(name.to_owned());
        self.open.push(name.to_owned());
        for (line, text) in (1..).zip(source.text.lines()) {
            match imported(text) {
                Some(import) => self.import(import).map_err(|error| {
                    // A fault inside the import knows its own place and keeps it.
                    error.at_line(u64::from(line)).in_file(&source.file)
                })?,
                None => self.push_line(text, file, line)?,
            }
        }
        self.open.pop();
        Ok(())
    }

    fn import(&mut self, name: &str) -> Result<()> {
        if let Some(from) = self.open.iter().position(|open| open == name) {
            let circle = self.open[from..].join(" imports ");
            return Err(Error::invalid(format!("imports run in a circle: {circle} imports {name}")));
        }
        if self.done.names.iter().any(|known| known == name) {
            return Ok(());
        }
        if self.open.len() >= DEPTH_LIMIT {
            return Err(Error::too_large(format!("imports nest deeper than {DEPTH_LIMIT}")));
        }
        let source = self
            .sources
            .read(name)?
            .ok_or_else(|| Error::invalid(format!("there is no shader {name:?} to import")))?;
        self.add(name, &source)
    }

    fn push_line(&mut self, text: &str, file: u32, line: u32) -> Result<()> {
        if self.done.text.len() + text.len() > TEXT_LIMIT {
            return Err(Error::too_large(format!("the composed shader exceeds {TEXT_LIMIT} bytes")));
        }
        self.done.text.push_str(text);
        self.done.text.push('\n');
        self.done.lines.push((file, line));
        Ok(())
    }
}

/// What a line imports, if it is an import. A comment may follow.
fn imported(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("#import")?;
    let rest = rest.split("//").next().unwrap_or_default();
    if rest.is_empty() || rest.starts_with(char::is_whitespace) { Some(rest.trim()) } else { None }
}

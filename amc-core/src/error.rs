//! The one error of this crate.
//!
//! An error says what is wrong, where (file, then byte, line or element) and, where it helps, what to do.
//! It is built where the fault is found, given its place and file on the way up, and shown once, by the program.

use std::fmt;
use std::path::{Path, PathBuf};

/// The result of everything in this crate that can fail.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What kind of fault an [`Error`] tells of. Programs decide by it; people read the message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The operating system refused: a file that is missing, a full disk.
    Io,
    /// Bytes that are not what their format demands.
    Malformed,
    /// A valid file or request of a sort this program does not handle.
    Unsupported,
    /// More than a stated limit, or more than the file's own size can justify.
    TooLarge,
    /// Well-formed input that makes no sense: no ball in the picture, a mesh of one point.
    Invalid,
    /// The person, or the program, asked to stop.
    Cancelled,
    /// The graphics device failed, or there is none.
    Device,
}

/// Where in a file a fault was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// Offset from the start of the file.
    Byte(u64),
    /// Line number, from 1.
    Line(u64),
    /// Line and column, both from 1.
    LineColumn(u64, u64),
    /// A named element: `mesh 2, primitive 0`, `pictures[3].angle_deg`.
    Element(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Line(line) => write!(f, "line {line}"),
            Self::LineColumn(line, column) => write!(f, "line {line}, column {column}"),
            Self::Element(element) => f.write_str(element),
        }
    }
}

/// A fault: its kind, what is wrong, and where.
///
/// Shown as `FILE: PLACE: what is wrong`, on one line.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.line())]
pub struct Error {
    kind: ErrorKind,
    what: String,
    place: Option<Place>,
    file: Option<PathBuf>,
    #[source]
    source: Option<Box<dyn std::error::Error + Send + Sync>>,
}

impl Error {
    /// A fault of `kind`; `what` is a sentence without a full stop that a user can act on.
    pub fn new(kind: ErrorKind, what: impl Into<String>) -> Self {
        Self { kind, what: what.into(), place: None, file: None, source: None }
    }

    /// Bytes that are not what their format demands.
    pub fn malformed(what: impl Into<String>) -> Self {
        Self::new(ErrorKind::Malformed, what)
    }

    /// Well-formed input that makes no sense.
    pub fn invalid(what: impl Into<String>) -> Self {
        Self::new(ErrorKind::Invalid, what)
    }

    /// A valid file or request of a sort this program does not handle.
    pub fn unsupported(what: impl Into<String>) -> Self {
        Self::new(ErrorKind::Unsupported, what)
    }

    /// More than a stated limit.
    pub fn too_large(what: impl Into<String>) -> Self {
        Self::new(ErrorKind::TooLarge, what)
    }

    /// The graphics device failed, or there is none.
    pub fn device(what: impl Into<String>) -> Self {
        Self::new(ErrorKind::Device, what)
    }

    /// The person, or the program, asked to stop.
    pub fn cancelled() -> Self {
        Self::new(ErrorKind::Cancelled, "cancelled")
    }

    /// The operating system refused to `what` (such as "cannot read").
    pub fn io(what: &str, source: std::io::Error) -> Self {
        let mut error = Self::new(ErrorKind::Io, format!("{what}: {source}"));
        error.source = Some(Box::new(source));
        error
    }

    /// Keeps `source` as the cause.
    #[must_use]
    pub fn because(mut self, source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        self.source = Some(source.into());
        self
    }

    /// Says where in the file, unless that is known already.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.place.get_or_insert(place);
        self
    }

    /// Says at which byte, unless the place is known already.
    #[must_use]
    pub fn at_byte(self, byte: u64) -> Self {
        self.at(Place::Byte(byte))
    }

    /// Says at which line (from 1), unless the place is known already.
    #[must_use]
    pub fn at_line(self, line: u64) -> Self {
        self.at(Place::Line(line))
    }

    /// Says at which named element, unless the place is known already.
    #[must_use]
    pub fn at_element(self, element: impl Into<String>) -> Self {
        self.at(Place::Element(element.into()))
    }

    /// Says in which file, unless that is known already.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        self.file.get_or_insert_with(|| file.to_owned());
        self
    }

    /// The kind of fault.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The file at fault, where there is one.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// The place in the file, where it is known.
    pub fn place(&self) -> Option<&Place> {
        self.place.as_ref()
    }

    /// Whether somebody asked to stop: no fault to show.
    pub fn is_cancelled(&self) -> bool {
        self.kind == ErrorKind::Cancelled
    }

    fn line(&self) -> String {
        let mut line = String::new();
        if let Some(file) = &self.file {
            line = format!("{}: ", file.display());
        }
        if let Some(place) = &self.place {
            line += &format!("{place}: ");
        }
        line += &self.what;
        // Some libraries' messages run over several lines; a report is one.
        line.split(['\n', '\r']).map(str::trim).filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_one_line_with_file_and_place_first() {
        let error = Error::malformed("no triangle\nat all").at_line(3).at_byte(9).in_file(Path::new("a.obj"));
        assert_eq!(error.to_string(), "a.obj: line 3: no triangle; at all");
    }
}

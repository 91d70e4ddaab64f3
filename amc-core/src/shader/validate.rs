//! Whether a shader is valid WGSL, found out without a GPU.

use wgpu::naga;

use super::{Composition, Sources, compose};
use crate::{Error, Place, Result};

/// A shader that is valid WGSL.
#[derive(Debug, Clone)]
pub struct Checked {
    composition: Composition,
    module: naga::Module,
}

/// How a structure lies in memory, by WGSL's rules.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StructLayout {
    /// Bytes, padding at the end included.
    pub size: u32,
    /// Its members, in order.
    pub members: Vec<Member>,
}

/// A member of a structure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Bytes from the start of the structure.
    pub offset: u32,
}

/// Composes the shader `name`, parses and validates it. It may use what every WebGL 2 class device has, no more.
///
/// # Errors
/// As [`compose`], and every fault in the WGSL, with its file, line and column.
pub fn validate(sources: &Sources, name: &str) -> Result<Checked> {
    let composition = compose(sources, name)?;
    let module = naga::front::wgsl::parse_str(composition.text()).map_err(|error| {
        place(&composition, message(error.message(), error.notes()), error.location(composition.text()))
    })?;
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map_err(|error| {
        let spans = error.spans().map(|(_, description)| description.as_str());
        place(&composition, message(&causes(error.as_inner()), spans), error.location(composition.text()))
    })?;
    Ok(Checked { composition, module })
}

impl Checked {
    /// The composed text.
    pub fn composition(&self) -> &Composition {
        &self.composition
    }

    /// The names of the entry points.
    pub fn entry_points(&self) -> impl Iterator<Item = &str> {
        self.module.entry_points.iter().map(|entry| entry.name.as_str())
    }

    /// The names of the functions that are no entry points.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        self.module.functions.iter().filter_map(|(_, function)| function.name.as_deref())
    }

    /// The names of the constants that a pipeline may set (`override`).
    pub fn overrides(&self) -> impl Iterator<Item = &str> {
        self.module.overrides.iter().filter_map(|(_, constant)| constant.name.as_deref())
    }

    /// How the structure `name` lies in memory; none where there is none of that name.
    pub fn struct_layout(&self, name: &str) -> Option<StructLayout> {
        self.module.types.iter().find_map(|(_, kind)| match &kind.inner {
            naga::TypeInner::Struct { members, span } if kind.name.as_deref() == Some(name) => {
                let member = |member: &naga::StructMember| Member {
                    name: member.name.clone().unwrap_or_default(),
                    offset: member.offset,
                };
                Some(StructLayout { size: *span, members: members.iter().map(member).collect() })
            }
            _ => None,
        })
    }
}

fn message<'a>(what: &str, notes: impl Iterator<Item = &'a str>) -> String {
    let mut message = what.to_owned();
    for note in notes.filter(|note| !note.is_empty()) {
        message += &format!(": {note}");
    }
    message
}

/// The message of an error and of what caused it.
fn causes(error: &dyn std::error::Error) -> String {
    let mut message = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        message += &format!(": {cause}");
        source = cause.source();
    }
    message
}

/// The error at its place in the file it comes from, columns counted in characters.
fn place(composition: &Composition, what: String, location: Option<naga::SourceLocation>) -> Error {
    let error = Error::malformed(what);
    let Some(location) = location else {
        return match composition.files().first() {
            Some(file) => error.in_file(file),
            None => error,
        };
    };
    let line = composition.text().lines().nth(location.line_number.saturating_sub(1) as usize);
    let bytes = location.line_position.saturating_sub(1) as usize;
    let before = line.and_then(|line| line.get(..bytes));
    let column = before.map_or(bytes, |before| before.chars().count()) as u64 + 1;
    match composition.origin(u64::from(location.line_number)) {
        Some(origin) => error.at(Place::LineColumn(origin.line, column)).in_file(origin.file),
        None => error,
    }
}

//! AMCs from and to other forms: a slice atlas, a folder of slices, an ordinary MatCap.
//!
//! A form is one file here and one line in `FORMS`.

mod atlas;
mod folder;
mod ktx2;
mod matcap;
mod sheet;
#[cfg(test)]
mod tests;

use std::path::Path;

use serde::Serialize;

use crate::amc::{Amc, TableSize};
use crate::{Error, Result, file};

/// What a file or folder holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// An AMC file (KTX2).
    Amc,
    /// A picture of all slices side by side: PNG, or OpenEXR for half floats.
    Atlas,
    /// A folder with a picture of each slice.
    Slices,
    /// An ordinary MatCap: a picture of a ball.
    MatCap,
}

impl std::str::FromStr for Kind {
    type Err = Error;

    /// By its name on the command line: `amc`, `atlas`, `slices`, `matcap`.
    fn from_str(name: &str) -> Result<Self> {
        Ok(match name {
            "amc" => Self::Amc,
            "atlas" => Self::Atlas,
            "slices" => Self::Slices,
            "matcap" => Self::MatCap,
            _ => return Err(Error::invalid(format!("{name:?} is none of amc, atlas, slices, matcap"))),
        })
    }
}

/// What is read and written, where names and contents do not say it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Hints {
    /// What the input is; else its contents tell.
    pub input: Option<Kind>,
    /// What the output becomes; else its name tells (see [`convert`]).
    pub output: Option<Kind>,
}

/// What a conversion did.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Converted {
    /// What the input was.
    pub from: Kind,
    /// What was written.
    pub to: Kind,
    /// What did not come along, and what that means; a sentence each.
    pub lost: Vec<String>,
}

/// The input of a conversion.
enum Source<'a> {
    Folder(&'a Path),
    File(Vec<u8>),
}

/// A form that an AMC can take.
struct Form {
    kind: Kind,
    /// For messages.
    name: &'static str,
    /// Ends of output names, in lower case, that mean this form. The longest that fits wins.
    ends: &'static [&'static str],
    /// Whether the input is of this form; asked in the order of [`FORMS`].
    is: fn(&Source<'_>) -> bool,
    read: fn(&Source<'_>) -> Result<Amc>,
    /// Writes, and says what was lost.
    write: fn(&Amc, &Path) -> Result<Vec<String>>,
}

const FORMS: [Form; 4] = [ktx2::FORM, folder::FORM, atlas::FORM, matcap::FORM];

/// Files larger than this are not read: a table of 2 GiB with room to spare.
const MOST_BYTES: u64 = TableSize::MOST_BYTES + (64 << 20);

/// Converts `input` to `output`.
///
/// What the input is its contents tell: KTX2; a folder with `slices.json`; a PNG or OpenEXR that carries an atlas's
/// description; any other picture is a MatCap. What the output becomes its name tells: `.ktx2`; `.atlas.png`, `.atlas.exr`
/// or `.png` alone an atlas; `.matcap.png`, `.matcap.exr` or `.exr` alone a MatCap; no suffix a folder of slices.
/// [`Hints`] override both.
///
/// # Errors
/// The input cannot be read as what it is, the output's name says nothing, or it cannot be written. Errors name the file.
pub fn convert(input: &Path, output: &Path, hints: Hints) -> Result<Converted> {
    let to = match hints.output {
        Some(kind) => form(kind),
        None => form_of_name(output)?,
    };
    let (from, amc) = read_as(input, hints.input)?;
    let lost = (to.write)(&amc, output).map_err(|error| error.in_file(output))?;
    Ok(Converted { from, to: to.kind, lost })
}

/// Reads an AMC out of any of the forms.
///
/// # Errors
/// The input cannot be read as what it is; the error names the file.
pub fn read(input: &Path) -> Result<Amc> {
    Ok(read_as(input, None)?.1)
}

/// Reads an AMC out of the bytes of any of the forms that are one file.
///
/// # Errors
/// The bytes are none of them, or broken.
pub fn parse(bytes: &[u8]) -> Result<Amc> {
    Ok(parse_as(&Source::File(bytes.to_owned()), None)?.1)
}

/// Reads an AMC out of a list of slices, the content of a `slices.json`, and the pictures that it names; `picture` gives
/// the bytes of each.
///
/// # Errors
/// The list or a picture is broken, or `picture` fails; the error names which.
pub fn parse_slices(list: &[u8], picture: &dyn Fn(&str) -> Result<Vec<u8>>) -> Result<Amc> {
    folder::assemble(Path::new(""), list, picture)
}

fn read_as(input: &Path, kind: Option<Kind>) -> Result<(Kind, Amc)> {
    let source =
        if input.is_dir() { Source::Folder(input) } else { Source::File(file::read(input, MOST_BYTES)?) };
    parse_as(&source, kind).map_err(|error| error.in_file(input))
}

fn parse_as(source: &Source<'_>, kind: Option<Kind>) -> Result<(Kind, Amc)> {
    let form = match kind {
        Some(kind) => form(kind),
        None => FORMS.iter().find(|form| (form.is)(source)).ok_or_else(|| {
            Error::unsupported(match source {
                Source::Folder(_) => "a folder without `slices.json`",
                Source::File(_) => "neither an AMC nor a picture (PNG, JPEG, OpenEXR)",
            })
        })?,
    };
    Ok((form.kind, (form.read)(source)?))
}

fn form(kind: Kind) -> &'static Form {
    // FORMS holds every kind; a test goes through them.
    FORMS.iter().find(|form| form.kind == kind).unwrap_or(&FORMS[0])
}

fn form_of_name(output: &Path) -> Result<&'static Form> {
    if output.is_dir() {
        return Ok(form(Kind::Slices));
    }
    let name = output.file_name().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default();
    let fits = |form: &'static Form| {
        let ends = form.ends.iter().filter(|end| name.ends_with(**end));
        ends.map(|end| end.len()).max().map(|length| (length, form))
    };
    if let Some((_, form)) = FORMS.iter().filter_map(fits).max_by_key(|(length, _)| *length) {
        return Ok(form);
    }
    if output.extension().is_none() {
        return Ok(form(Kind::Slices));
    }
    let known: Vec<String> =
        FORMS.iter().map(|form| format!("{}: {}", form.name, form.ends.join(" "))).collect();
    Err(Error::unsupported(format!(
        "the name does not say what to write ({}; no suffix: a folder of slices)",
        known.iter().filter(|line| !line.ends_with(": ")).cloned().collect::<Vec<_>>().join("; ")
    ))
    .in_file(output))
}

impl Source<'_> {
    /// The file's bytes.
    fn bytes(&self) -> Result<&[u8]> {
        match self {
            Self::File(bytes) => Ok(bytes),
            Self::Folder(_) => Err(Error::unsupported("a folder, where a file is expected")),
        }
    }
}

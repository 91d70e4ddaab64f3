//! DXF in ASCII: pairs of a group code and a value, a line each.

use std::borrow::Cow;

use amc_core::{Error, Result};

/// How the other kind of DXF begins.
const BINARY: &[u8] = b"AutoCAD Binary DXF";
/// Largest coordinate.
const COORDINATE_LIMIT: f64 = 1e8;

/// A group code with its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group<'a> {
    pub(super) code: i32,
    pub(super) value: Cow<'a, str>,
    /// Of the value, from 1.
    pub(super) line: u64,
}

impl Group<'_> {
    /// The value as a coordinate.
    ///
    /// # Errors
    /// It is no number, not finite or too large.
    pub(super) fn number(&self) -> Result<f32> {
        let number = self.value.parse::<f64>().ok().filter(|number| number.abs() <= COORDINATE_LIMIT);
        let number = number.ok_or_else(|| {
            let shown: String = self.value.chars().filter(|letter| !letter.is_control()).take(40).collect();
            Error::malformed(format!("'{shown}' where a coordinate is needed")).at_line(self.line)
        })?;
        Ok(number as f32)
    }
}

/// The pairs of a file.
pub(super) struct Groups<'a> {
    rest: &'a [u8],
    line: u64,
}

impl<'a> Groups<'a> {
    /// # Errors
    /// A binary DXF.
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self> {
        if bytes.starts_with(BINARY) {
            return Err(Error::unsupported("a binary DXF: save it as ASCII (R12)"));
        }
        Ok(Self { rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), line: 0 })
    }

    fn line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.line += 1;
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let line = &self.rest[..end.unwrap_or(self.rest.len())];
        self.rest = end.and_then(|end| self.rest.get(end + 1..)).unwrap_or_default();
        Some(line.trim_ascii())
    }

    /// The next pair; none at the end.
    ///
    /// # Errors
    /// A code that is no number, or one without a value.
    pub(super) fn next(&mut self) -> Result<Option<Group<'a>>> {
        let Some(code) = self.line() else { return Ok(None) };
        if code.is_empty() && self.rest.trim_ascii().is_empty() {
            return Ok(None);
        }
        let code = str::from_utf8(code)
            .ok()
            .and_then(|code| code.parse().ok())
            .ok_or_else(|| Error::malformed("no DXF: a group code is a number").at_line(self.line))?;
        let cut_short = Error::malformed("cut short: a group code without a value").at_line(self.line);
        let value = self.line().ok_or(cut_short)?;
        Ok(Some(Group { code, value: String::from_utf8_lossy(value), line: self.line }))
    }
}

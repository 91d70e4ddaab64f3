//! A capture session's `session.json`: which pictures there are, and how far the ball was turned in each.

use std::path::{Component, Path};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::{Error, Place, Result};

/// The file that makes a folder a session.
pub const SESSION_FILE: &str = "session.json";

/// The most bytes that a `session.json` may have: 64 MiB.
const MOST_BYTES: u64 = 64 << 20;

/// Which way the ball is turned from picture to picture, as the camera sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Turn {
    /// Counter-clockwise.
    #[default]
    Ccw,
    /// Clockwise.
    Cw,
}

impl Turn {
    /// +1 for counter-clockwise, -1 for clockwise.
    pub fn sign(self) -> f64 {
        match self {
            Self::Ccw => 1.0,
            Self::Cw => -1.0,
        }
    }
}

/// One picture of a session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SessionPicture {
    /// The file, relative to the session's folder.
    pub file: String,
    /// How far the ball stands turned from picture 0, degrees, in the session's turn direction.
    pub angle_deg: f64,
    /// Keys of later versions, or of other programs.
    #[serde(flatten)]
    pub other: Map<String, Value>,
}

/// What `session.json` holds. Keys this program does not know are kept as they are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Session {
    /// 1.
    pub version: u32,
    /// Which way the angles count.
    #[serde(default)]
    pub turn: Turn,
    /// The pictures, in the order they were taken.
    pub pictures: Vec<SessionPicture>,
    /// Keys of later versions, or of other programs.
    #[serde(flatten)]
    pub other: Map<String, Value>,
}

impl Session {
    /// The version this program reads and writes.
    pub const VERSION: u32 = 1;

    /// Reads and checks a `session.json`.
    ///
    /// # Errors
    /// As [`Session::parse`]; or the file cannot be read. The error names the file.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = crate::file::read(path, MOST_BYTES)?;
        Self::parse(&bytes).map_err(|error| error.in_file(path))
    }

    /// Reads and checks the bytes of a `session.json`.
    ///
    /// # Errors
    /// No JSON (with line and column), another version, a file name that leaves the folder, an angle that is no
    /// number, or two pictures at one angle (with the element).
    pub fn parse(bytes: &[u8]) -> Result<Self> {
        let session: Self = serde_json::from_slice(bytes).map_err(|error| {
            let place = Place::LineColumn(error.line() as u64, error.column() as u64);
            // The place is said by ours; serde_json says it again at the end of its message.
            let message = error.to_string();
            let what = message.split(" at line ").next().unwrap_or(&message).to_owned();
            Error::malformed(format!("not a session: {what}")).at(place)
        })?;
        if session.version != Self::VERSION {
            return Err(Error::unsupported(format!(
                "session version {} is not known; version {} is",
                session.version,
                Self::VERSION
            ))
            .at_element("version"));
        }
        for (k, picture) in session.pictures.iter().enumerate() {
            check_name(&picture.file).map_err(|error| error.at_element(format!("pictures[{k}].file")))?;
            if !picture.angle_deg.is_finite() {
                return Err(Error::invalid("the angle is not a finite number")
                    .at_element(format!("pictures[{k}].angle_deg")));
            }
        }
        session.check_angles_differ()?;
        Ok(session)
    }

    fn check_angles_differ(&self) -> Result<()> {
        let mut turned: Vec<(f64, usize)> = self
            .pictures
            .iter()
            .enumerate()
            .map(|(k, picture)| (picture.angle_deg.rem_euclid(360.0), k))
            .collect();
        turned.sort_by(|a, b| a.0.total_cmp(&b.0));
        let around = turned.first().map(|&(angle, k)| (angle + 360.0, k));
        for (&(a, first), (b, second)) in turned.iter().zip(turned.iter().skip(1).copied().chain(around)) {
            // Closer than any turntable steps; the interpolation between them would blow up.
            if b - a < 1e-4 && first != second {
                let (first, second) = (first.min(second), first.max(second));
                return Err(Error::invalid(format!(
                    "the same angle as pictures[{first}], {} degrees, up to whole turns",
                    self.pictures[first].angle_deg
                ))
                .at_element(format!("pictures[{second}].angle_deg")));
            }
        }
        Ok(())
    }
}

/// A name must stay inside of the session's folder.
fn check_name(name: &str) -> Result<()> {
    let inside = |component| matches!(component, Component::Normal(_) | Component::CurDir);
    if name.is_empty() || name.contains('\0') || !Path::new(name).components().all(inside) {
        return Err(Error::invalid(format!(
            "the file name {name:?} must be relative and stay in the session's folder"
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn session(pictures: &str) -> Result<Session> {
        Session::parse(
            format!(r#"{{"version": 1, "turn": "cw", "pictures": [{pictures}], "rig": {{"a": 1}}}}"#)
                .as_bytes(),
        )
    }

    fn message(pictures: &str) -> String {
        session(pictures).unwrap_err().to_string()
    }

    #[test]
    fn unknown_keys_are_kept() {
        let read = session(r#"{"file": "frames/0000.jpg", "angle_deg": 0.0, "exposure": 4}"#).unwrap();
        assert_eq!(read.turn, Turn::Cw);
        let again = Session::parse(&serde_json::to_vec(&read).unwrap()).unwrap();
        assert_eq!(again, read);
        assert_eq!(again.other["rig"]["a"], 1);
        assert_eq!(again.pictures[0].other["exposure"], 4);
    }

    #[test]
    fn names_that_leave_the_folder_are_refused() {
        for name in ["../a.jpg", "/etc/a.jpg", "frames/../../a.jpg", ""] {
            let message = message(&format!(r#"{{"file": "{name}", "angle_deg": 0}}"#));
            assert!(message.starts_with("pictures[0].file: "), "{message}");
        }
    }

    #[test]
    fn equal_angles_are_refused_up_to_whole_turns() {
        let message = message(
            r#"{"file": "a", "angle_deg": 359.99999}, {"file": "b", "angle_deg": 5}, {"file": "c", "angle_deg": 0}"#,
        );
        assert!(
            message.starts_with("pictures[2].angle_deg: ") && message.contains("pictures[0]"),
            "{message}"
        );
    }

    #[test]
    fn broken_json_is_told_by_line_and_column() {
        let error = Session::parse(b"{\"version\": 1,\n \"pictures\": [}").unwrap_err();
        assert_eq!(error.place(), Some(&Place::LineColumn(2, 15)));
        // NaN is no JSON, an overflowing number no angle.
        assert!(session(r#"{"file": "a", "angle_deg": NaN}"#).is_err());
        assert!(session(r#"{"file": "a", "angle_deg": 1e999}"#).is_err());
        assert!(
            Session::parse(br#"{"version": 2, "pictures": []}"#)
                .unwrap_err()
                .to_string()
                .contains("version 2")
        );
    }
}

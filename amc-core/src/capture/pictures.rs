//! The reading plan: which files hold the pictures, and how far the ball is turned in each.

use std::cmp::Ordering;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::session::{SESSION_FILE, Session, Turn};
use crate::image::decode::Format;
use crate::{Error, Result};

/// The fewest pictures that a table is built from.
pub const FEWEST_PICTURES: usize = 8;

/// The most pictures: a tenth of a degree apart.
pub const MOST_PICTURES: usize = 4096;

/// One picture to read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Planned {
    /// Its file.
    pub(super) path: PathBuf,
    /// How far the ball stands turned, radians in [0, 2 pi), counter-clockwise as the camera sees it.
    pub(super) turn: f64,
}

/// What is to be read, sorted by turn.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Plan {
    pub(super) pictures: Vec<Planned>,
    pub(super) direction: Turn,
    pub(super) notices: Vec<String>,
}

impl Plan {
    /// The plan for a folder of pictures, a session's folder, or a `session.json` itself. `direction` overrides what
    /// the session says.
    pub(super) fn of(source: &Path, direction: Option<Turn>) -> Result<Self> {
        let about =
            std::fs::metadata(source).map_err(|error| Error::io("cannot open", error).in_file(source))?;
        if !about.is_dir() {
            if source.file_name().is_some_and(|name| name == SESSION_FILE) {
                return Self::of_session(source, direction);
            }
            return Err(Error::invalid(format!(
                "neither a folder of pictures nor a {SESSION_FILE}; give the folder"
            ))
            .in_file(source));
        }
        let session = source.join(SESSION_FILE);
        if session.is_file() {
            Self::of_session(&session, direction)
        } else {
            Self::of_folder(source, direction)
        }
    }

    fn of_session(path: &Path, direction: Option<Turn>) -> Result<Self> {
        let session = Session::read(path)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut notices = Vec::new();
        let used = direction.unwrap_or(session.turn);
        if used != session.turn {
            notices.push("the turn direction was given and differs from the session's".to_owned());
        }
        let angles = session.pictures.iter().map(|picture| picture.angle_deg.to_radians());
        let paths = session.pictures.iter().map(|picture| folder.join(&picture.file));
        Self::new(path, paths.zip(angles).collect(), used, notices)
    }

    fn of_folder(folder: &Path, direction: Option<Turn>) -> Result<Self> {
        let (mut paths, mut notices) = list(folder)?;
        let frames = folder.join("frames");
        if paths.is_empty() && frames.is_dir() {
            let (inner, more) = list(&frames)?;
            paths = inner;
            notices.extend(more);
        }
        let step = std::f64::consts::TAU / paths.len().max(1) as f64;
        let angles = (0..paths.len()).map(|k| k as f64 * step);
        Self::new(folder, paths.into_iter().zip(angles).collect(), direction.unwrap_or_default(), notices)
    }

    fn new(
        source: &Path,
        pictures: Vec<(PathBuf, f64)>,
        direction: Turn,
        notices: Vec<String>,
    ) -> Result<Self> {
        if pictures.len() < FEWEST_PICTURES {
            return Err(Error::invalid(format!(
                "{} pictures; at least {FEWEST_PICTURES} are needed, spread over a whole turn of the ball",
                pictures.len()
            ))
            .in_file(source));
        }
        if pictures.len() > MOST_PICTURES {
            return Err(Error::too_large(format!(
                "{} pictures; the limit is {MOST_PICTURES}",
                pictures.len()
            ))
            .in_file(source));
        }
        let mut pictures: Vec<Planned> = pictures
            .into_iter()
            .map(|(path, angle)| Planned { path, turn: whole_turn(direction.sign() * angle) })
            .collect();
        pictures.sort_by(|a, b| a.turn.total_cmp(&b.turn));
        let mut plan = Self { pictures, direction, notices };
        plan.notice_gaps();
        Ok(plan)
    }

    /// The turns, radians, rising.
    pub(super) fn turns(&self) -> Vec<f64> {
        self.pictures.iter().map(|picture| picture.turn).collect()
    }

    fn notice_gaps(&mut self) {
        let turns = self.turns();
        let around = turns.first().map(|first| first + std::f64::consts::TAU);
        let next = turns.iter().skip(1).copied().chain(around);
        let gap = turns.iter().zip(next).map(|(a, b)| b - a).fold(0.0, f64::max);
        if gap > std::f64::consts::FRAC_PI_3 {
            self.notices.push(format!(
                "no picture over {:.0} degrees of the turn; the table is interpolated there",
                gap.to_degrees()
            ));
        }
    }
}

fn whole_turn(angle: f64) -> f64 {
    let turned = angle.rem_euclid(std::f64::consts::TAU);
    // A tiny negative angle rounds up to the whole turn itself.
    if turned >= std::f64::consts::TAU { 0.0 } else { turned }
}

/// The pictures in a folder, sorted as people count, and notices of what else lies there.
fn list(folder: &Path) -> Result<(Vec<PathBuf>, Vec<String>)> {
    let io = |error| Error::io("cannot read the folder", error).in_file(folder);
    let mut paths = Vec::new();
    let mut notices = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if name.starts_with('.') || !path.is_file() {
            continue;
        }
        if has_picture_suffix(&path) || sniffs_as_picture(&path)? {
            paths.push(path);
        } else {
            notices.push(format!("{name} is not a picture and was left out"));
        }
    }
    paths.sort_by(|a, b| natural_order(&a.to_string_lossy(), &b.to_string_lossy()));
    notices.sort();
    Ok((paths, notices))
}

fn has_picture_suffix(path: &Path) -> bool {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_lowercase());
    suffix.is_some_and(|suffix| matches!(suffix.as_str(), "jpg" | "jpeg" | "png" | "exr"))
}

fn sniffs_as_picture(path: &Path) -> Result<bool> {
    let io = |error| Error::io("cannot read", error).in_file(path);
    let mut start = Vec::with_capacity(8);
    File::open(path).map_err(io)?.take(8).read_to_end(&mut start).map_err(io)?;
    Ok(Format::of(&start).is_some())
}

/// Compares runs of digits by their value: `a2` comes before `a10`.
fn natural_order(a: &str, b: &str) -> Ordering {
    let (mut a, mut b) = (a.as_bytes(), b.as_bytes());
    while let (Some(&x), Some(&y)) = (a.first(), b.first()) {
        let order = if x.is_ascii_digit() && y.is_ascii_digit() {
            let (digits_a, digits_b) = (leading_digits(a), leading_digits(b));
            (a, b) = (&a[digits_a.len()..], &b[digits_b.len()..]);
            by_value(digits_a, digits_b)
        } else {
            (a, b) = (&a[1..], &b[1..]);
            x.cmp(&y)
        };
        if order != Ordering::Equal {
            return order;
        }
    }
    a.len().cmp(&b.len())
}

fn leading_digits(text: &[u8]) -> &[u8] {
    let end = text.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(text.len());
    &text[..end]
}

fn by_value(a: &[u8], b: &[u8]) -> Ordering {
    let start = |digits: &[u8]| digits.iter().position(|&digit| digit != b'0').unwrap_or(digits.len());
    let (value_a, value_b) = (&a[start(a)..], &b[start(b)..]);
    value_a.len().cmp(&value_b.len()).then_with(|| value_a.cmp(value_b)).then_with(|| a.len().cmp(&b.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_sorted_as_people_count() {
        let mut names = ["f10", "f2", "f002", "f1b", "f1", "g0", "f99999999999999999999999"];
        names.sort_by(|a, b| natural_order(a, b));
        assert_eq!(names, ["f1", "f1b", "f2", "f002", "f10", "f99999999999999999999999", "g0"]);
    }

    fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            crate::file::save_bytes(&path, bytes).unwrap();
        }
        folder
    }

    #[test]
    fn odd_files_are_noticed_and_frames_are_found_below() {
        let names: Vec<String> = (0..12).map(|k| format!("frames/{k}.JPG")).collect();
        let mut files: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), &b"x"[..])).collect();
        files.push(("notes.txt", b"hello"));
        files.push(("frames/.DS_Store", b"hidden"));
        let folder = folder(&files);
        let plan = Plan::of(folder.path(), Some(Turn::Cw)).unwrap();
        assert_eq!(plan.pictures.len(), 12);
        assert_eq!(plan.notices, ["notes.txt is not a picture and was left out"]);
        // Clockwise: picture 3 stands three quarters of a turn counter-clockwise.
        assert!(plan.pictures[9].path.ends_with("3.JPG"));
        assert!((plan.pictures[9].turn - 1.5 * std::f64::consts::PI).abs() < 1e-9);
    }

    #[test]
    fn too_few_pictures_are_refused() {
        let folder = folder(&[("a.png", b"x"), ("b.png", b"x")]);
        let message = Plan::of(folder.path(), None).unwrap_err().to_string();
        assert!(message.contains("2 pictures; at least 8"), "{message}");
    }

    #[test]
    fn a_session_gives_angles_and_direction() {
        let pictures: Vec<String> =
            (0..9).map(|k| format!(r#"{{"file": "{k}.png", "angle_deg": {}}}"#, k * k * 4)).collect();
        let json = format!(r#"{{"version": 1, "turn": "cw", "pictures": [{}]}}"#, pictures.join(","));
        let folder = folder(&[("session.json", json.as_bytes())]);
        let plan = Plan::of(folder.path(), None).unwrap();
        assert_eq!(plan.direction, Turn::Cw);
        assert!(plan.pictures[0].path.ends_with("0.png"));
        assert!(plan.pictures[8].path.ends_with("1.png"));
        assert!((plan.pictures[8].turn - 356f64.to_radians()).abs() < 1e-9);
        assert!(plan.notices[0].contains("no picture over 104 degrees"), "{:?}", plan.notices);
    }
}

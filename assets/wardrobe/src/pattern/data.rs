//! What a pattern file holds.

use std::path::Path;

use amc_core::{Error, Result, file};
use serde::{Deserialize, Serialize};

use super::{Cloth, Placement, Unfolded, unfold};
use crate::body::Figure;

/// The version of the format that this program reads.
const VERSION: u32 = 1;
/// The longest pattern file that is read, bytes.
const LONGEST: u64 = 4 << 20;

/// A garment: its pieces, and how they are sewn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pattern {
    /// The format's version: 1.
    pub version: u32,
    /// The garment's name.
    pub name: String,
    /// What it is draped on.
    pub figure: Figure,
    /// The cloth of every piece that has none of its own.
    #[serde(default)]
    pub cloth: Cloth,
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// The seams.
    #[serde(default)]
    pub seams: Vec<Seam>,
}

/// A piece of cloth, as it is cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// Its name, the only one such in the pattern; no colon.
    pub name: String,
    /// The piece of which it is the mirror image in everything: outline, grain, placement, `left` and `right` exchanged in
    /// the names of its lines. Nothing else is given then, save a cloth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mirror_of: Option<String>,
    /// Whether the outline is the half at u >= 0 of a piece cut on the fold: it then runs from the fold line u = 0 to the
    /// fold line. The other half is its mirror image, with `left` and `right` exchanged in the names; an edge that
    /// reaches the fold line, and has neither word in its name, is one edge across it.
    #[serde(default)]
    pub mirrored: bool,
    /// The grain: the warp's direction, degrees counter-clockwise from +u. 90, along v, where it is not given.
    #[serde(default = "upright")]
    pub grain_deg: f64,
    /// Where the outline starts, metres.
    #[serde(default)]
    pub start: [f64; 2],
    /// The outline, counter-clockwise: each edge goes on where the last one ended, and the last one ends at `start`.
    #[serde(default)]
    pub outline: Vec<Edge>,
    /// Marks on the outline.
    #[serde(default)]
    pub notches: Vec<Notch>,
    /// Lines inside the piece.
    #[serde(default)]
    pub lines: Vec<InnerLine>,
    /// Lines along which it is folded.
    #[serde(default)]
    pub folds: Vec<Fold>,
    /// Points inside the piece: buttons and buttonholes.
    #[serde(default)]
    pub points: Vec<Points>,
    /// Where it lies before it is sewn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement: Option<Placement>,
    /// Its own cloth, where it is not the garment's: an interfaced collar.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cloth: Option<Cloth>,
}

fn upright() -> f64 {
    90.0
}

/// A named part of an outline.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edge {
    /// Its name, the only one such among the lines of its piece.
    pub name: String,
    /// Where it goes, segment by segment.
    pub path: Vec<Segment>,
}

/// A stretch of a path, from where the last one ended. Metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "a path is made of points [u, v], of {\"curve\": [control, control, end]} and of {\"arc\": [through, end]}"
)]
pub enum Segment {
    /// Straight to the point: `[u, v]`.
    Straight([f64; 2]),
    /// A cubic Bezier curve: `{"curve": [control, control, end]}`.
    Curve {
        /// Two control points and the end.
        curve: [[f64; 2]; 3],
    },
    /// An arc of the circle through three points: `{"arc": [through, end]}`.
    Arc {
        /// A point that it passes, and its end.
        arc: [[f64; 2]; 2],
    },
}

/// A mark on an edge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Notch {
    /// The edge.
    pub edge: String,
    /// Where along it, 0 its start, 1 its end, by length.
    pub at: f64,
    /// Its name, where a seam refers to it.
    #[serde(default)]
    pub name: String,
}

/// A named line inside a piece. An end within 0.1 mm of the outline, or of a line before it, is joined to that.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InnerLine {
    /// Its name, the only one such among the lines of its piece.
    pub name: String,
    /// Where it starts, metres.
    pub start: [f64; 2],
    /// Where it goes, segment by segment.
    pub path: Vec<Segment>,
}

/// A line along which a piece is folded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fold {
    /// Where.
    pub along: FoldPlace,
    /// How far, degrees, -180 to 180: 0 flat, positive where the two right sides move apart (the fold points to the right
    /// side, as a shirt collar's), negative where they move together.
    pub angle_deg: f64,
}

/// Where a fold lies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "a fold lies along an inner line's name or between two points [[u, v], [u, v]]"
)]
pub enum FoldPlace {
    /// Along the inner line of that name.
    Line(String),
    /// Straight from point to point, metres.
    Across([[f64; 2]; 2]),
}

/// Points inside a piece: buttons, or the buttonholes that they meet, first to first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// Their name, the only one such among the lines of the piece.
    pub name: String,
    /// Where they are, metres.
    pub at: Vec<[f64; 2]>,
}

/// What is sewn to what.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seam {
    /// Its name, the only one such in the pattern.
    pub name: String,
    /// One side, edge after edge, each as it is drawn.
    pub a: Vec<SeamPart>,
    /// The other side, edge after edge in the same order, each *against* the way it is drawn: so two outlines meet that
    /// are laid right sides together.
    pub b: Vec<SeamPart>,
    /// How they are joined.
    #[serde(default)]
    pub kind: SeamKind,
    /// How much longer one side may be than the other, as a fraction of the shorter: 0.03 a sleeve's cap, 0.5 a gathered
    /// skirt. 0 to 2; a millimetre is always allowed.
    #[serde(default)]
    pub ease: f64,
    /// The two notches on the longer side between which the ease is spread; evenly along the whole seam where not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// Whether it is closed only once the others are: a collar's, which would bar their way.
    #[serde(default)]
    pub late: bool,
    /// Whether its mirror image is sewn as well: `left` and `right` exchanged in all its names.
    #[serde(default)]
    pub mirrored: bool,
}

/// How two lines are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SeamKind {
    /// Sewn edge to edge.
    #[default]
    Sewn,
    /// Laid one on the other: a button, a pocket's topstitch.
    Layered,
}

/// A line, or a part of it, in a seam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "one side of a seam is made of \"piece: line\" and of {\"line\": \"piece: line\", \"from\": 0 to 1, \"to\": 0 to 1, \"reversed\": true or false}"
)]
pub enum SeamPart {
    /// The whole line: `"piece: line"`.
    Whole(String),
    /// A part of it, or all of it the other way round.
    Part(LinePart),
}

/// A part of a line in a seam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinePart {
    /// `"piece: line"`.
    pub line: String,
    /// Where the part starts, as a fraction of the line's length.
    #[serde(default)]
    pub from: f64,
    /// Where it ends: more than `from`.
    #[serde(default = "whole")]
    pub to: f64,
    /// Whether it is taken the other way round than its side is.
    #[serde(default)]
    pub reversed: bool,
}

fn whole() -> f64 {
    1.0
}

impl SeamPart {
    /// The part, with all its fields.
    pub fn part(&self) -> LinePart {
        match self {
            Self::Whole(line) => LinePart { line: line.clone(), from: 0.0, to: 1.0, reversed: false },
            Self::Part(part) => part.clone(),
        }
    }
}

impl Pattern {
    /// Reads a pattern from JSON and checks it.
    ///
    /// # Errors
    /// `Malformed` with line and column where it is not such JSON, `Unsupported` for another version, and what
    /// [`Self::unfold`] finds.
    pub fn from_json(text: &str) -> Result<Self> {
        let pattern: Self = serde_json::from_str(text).map_err(|error| {
            let place = amc_core::Place::LineColumn(error.line() as u64, error.column() as u64);
            let what = error.to_string();
            let what = what.split(" at line ").next().unwrap_or_default();
            Error::malformed(what).at(place)
        })?;
        if pattern.version != VERSION {
            return Err(Error::unsupported(format!(
                "version {} of the pattern format; this program reads {VERSION}",
                pattern.version
            )));
        }
        pattern.unfold()?;
        Ok(pattern)
    }

    /// Reads a pattern file and checks it.
    ///
    /// # Errors
    /// As [`Self::from_json`], `Io` and `TooLarge`, with the file's name.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = file::read(path, LONGEST)?;
        let text = std::str::from_utf8(&bytes)
            .map_err(|error| Error::malformed("not UTF-8 text").at_byte(error.valid_up_to() as u64));
        text.and_then(Self::from_json).map_err(|error| error.in_file(path))
    }

    /// Writes every piece and every seam out whole, curves flattened, and checks all of it.
    ///
    /// # Errors
    /// `Invalid` with the piece's or the seam's name and what is wrong with it: an outline that is open, crosses itself or runs
    /// clockwise, a name that is not there, a size out of range, lengths that do not match, a line sewn twice.
    pub fn unfold(&self) -> Result<Unfolded> {
        unfold::unfold(self)
    }
}

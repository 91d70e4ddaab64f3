//! Directions from files: the JSON that is exported, DXF (AAMA, ASTM D6673), glTF with KHR_materials_anisotropy.
//!
//! A file speaks of pieces. Each is matched to a panel, by id, by name, else by its shape; where the piece lies turned or mirrored
//! against the panel's pattern its grain is turned along. What could not be matched, and what had to be guessed, is said by name
//! before anything is changed.

mod dxf;
mod edits;
mod fit;
mod gltf;
mod json;
mod matching;
mod outline;
#[cfg(test)]
mod tests;

pub use dxf::parse as parse_dxf;
pub use edits::{Planned, edits};
pub use json::parse as parse_json;

use std::path::Path;

use amc_core::direction::{Direction, Orientation, Record, Source};
use amc_core::mesh::{FILE_LIMIT, Garment};
use amc_core::{Error, Progress, Result, file};
use glam::Vec2;

use fit::Fit;
use matching::Match;

/// Most characters of a name that are shown.
const NAME_LIMIT: usize = 120;
/// Most pieces of a file.
const MOST_PIECES: usize = 10_000;
/// Names of a list that are told before the rest is counted.
const TOLD: usize = 12;

/// Ends of the names of the files that can be read.
pub const SUFFIXES: [&str; 4] = ["json", "dxf", "glb", "gltf"];

/// What a file says of one piece.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Entry {
    /// What people call it.
    name: String,
    /// Orientation, fabric, lock and link, as far as they are said; the id, where it is known.
    record: Record,
    way: Way,
    /// Lines that may be the piece's outline, y up; none where it has no shape.
    outlines: Vec<Vec<Vec2>>,
    /// How many panels may be cut from it.
    quantity: usize,
    /// What is to be told of it.
    remarks: Vec<&'static str>,
}

/// Where the warp of a piece runs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
enum Way {
    /// The file does not say.
    #[default]
    Unsaid,
    /// By the panel's own UVs; what is not said stays.
    InUvs { source: Option<Source>, angle: Option<f32> },
    /// Along this on the flat piece as the file draws it.
    OnPiece(Vec2),
}

/// What a file says, matched to the panels of a garment.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Import {
    /// In the order of the file.
    pub found: Vec<Found>,
    /// What could not be matched, or had to be guessed.
    pub notices: Vec<String>,
}

/// What a file says of a panel; what it does not say is none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Found {
    /// The panel's number.
    pub panel: usize,
    /// Its direction.
    pub direction: Option<Direction>,
    /// In which turns it may be laid.
    pub orientation: Option<Orientation>,
    /// The name of its fabric.
    pub fabric: Option<String>,
    /// Whether its direction is kept from being changed.
    pub is_locked: Option<bool>,
    /// Whether its mirror partner follows it.
    pub is_linked: Option<bool>,
}

/// Reads a file for `garment`, whose panels have the directions `now`; its suffix says what it is. Nothing is changed.
///
/// - `.json`: what [`amc_core::export::tangents`] writes, or by hand: `{"panels": [{"id": "front", "angle_deg": 45}]}`, each entry
///   with `id` or `name` and any of the keys of [`Record`].
/// - `.dxf`: a block for each piece, its grain line on layer 7. The angle is counted in the piece's drawing; where the outline
///   (layer 14, else 1) is that of the panel turned or mirrored, the grain is turned along.
/// - `.glb`, `.gltf`: materials with KHR_materials_anisotropy, by the mesh's tangents or, without, its UVs. The warp lies across
///   the direction of the highlight. What our own export says of a panel goes before.
///
/// # Errors
/// Another suffix, a file that cannot be read or makes no sense, no piece that is matched, or cancelled.
pub fn read(garment: &Garment, now: &[Direction], path: &Path, progress: &Progress<'_>) -> Result<Import> {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let entries = match suffix.as_deref() {
        Some("json") => json::parse(&file::read(path, FILE_LIMIT)?),
        Some("dxf") => dxf::parse(&file::read(path, FILE_LIMIT)?),
        Some("glb" | "gltf") => gltf::read(garment, path),
        _ => Err(Error::unsupported("directions are read from .json, .dxf, .glb and .gltf")),
    };
    let entries = entries.map_err(|error| error.in_file(path))?;
    place(garment, now, &entries, progress).map_err(|error| error.in_file(path))
}

/// Matches what a file says to the panels of `garment`, which have the directions `now`.
///
/// # Errors
/// No entry is matched, or cancelled.
pub fn place(
    garment: &Garment,
    now: &[Direction],
    entries: &[Entry],
    progress: &Progress<'_>,
) -> Result<Import> {
    let shapes = outline::of_panels(garment);
    let (matches, mut notices) = matching::matched(garment, &shapes, entries, progress)?;
    if matches.is_empty() {
        let names = listed(entries.iter().map(|entry| entry.name.as_str()));
        let what = match entries.is_empty() {
            true => "it says nothing of any panel".to_owned(),
            false => format!("none of its pieces is a panel of this garment by name or shape: {names}"),
        };
        return Err(Error::invalid(what));
    }
    let found = matches.iter().map(|it| found(garment, now, &entries[it.entry], it));
    let import = Import { found: found.collect(), notices: Vec::new() };
    notices.extend(remarks(entries, &matches));
    let is_said = |panel: usize| import.found.iter().any(|found| found.panel == panel);
    let unsaid = (0..garment.panels.len()).filter(|&it| garment.panels[it].takes_fabric && !is_said(it));
    let unsaid = listed(unsaid.map(|panel| garment.panels[panel].name.as_str()));
    if !unsaid.is_empty() {
        notices.push(format!("the file says nothing of: {unsaid}"));
    }
    Ok(Import { notices, ..import })
}

/// What an entry says of the panel it is matched to.
fn found(garment: &Garment, now: &[Direction], entry: &Entry, it: &Match) -> Found {
    let panel = &garment.panels[it.panel];
    let now = now.get(it.panel).copied().unwrap_or_else(|| Direction::along_grain(panel));
    let direction = match entry.way {
        Way::Unsaid => None,
        Way::InUvs { source: None, angle: None } => None,
        Way::InUvs { source, angle } => {
            Some(Direction { source: source.unwrap_or(now.source), angle: angle.unwrap_or(now.angle) })
        }
        Way::OnPiece(along) => garment.uv_to_drawn_metres(panel).map(|to_cloth| {
            let along = it.fit.map_or(along, |fit| fit.turned(along));
            // A field has no angle on the flat cloth.
            let source = if matches!(now.source, Source::Field(_)) { Source::default() } else { now.source };
            Direction::along_cloth(source, along, to_cloth.matrix2)
        }),
    };
    Found {
        panel: it.panel,
        direction,
        orientation: entry.record.orientation,
        fabric: entry.record.fabric.clone(),
        is_locked: entry.record.locked,
        is_linked: entry.record.linked,
    }
}

/// What is to be told of the entries that were matched.
fn remarks(entries: &[Entry], matches: &[Match]) -> Vec<String> {
    let mut told: Vec<(String, Vec<&str>)> = Vec::new();
    let mut tell = |what: String, name| match told.iter_mut().find(|(known, _)| *known == what) {
        Some((_, names)) => names.push(name),
        None => told.push((what, vec![name])),
    };
    for it in matches {
        let entry = &entries[it.entry];
        entry.remarks.iter().for_each(|what| tell((*what).to_owned(), &entry.name));
        let Way::OnPiece(_) = entry.way else { continue };
        match it.fit {
            None => {
                tell("the outline is not the panel's, so the angle is taken as drawn".to_owned(), &entry.name)
            }
            Some(Fit { is_sure: false, .. }) => {
                tell(
                    "the outline fits turned in several ways; the least turn is taken".to_owned(),
                    &entry.name,
                );
            }
            Some(fit) => {
                let degrees = fit.angle.to_degrees();
                let mirrored = if fit.is_mirrored { "mirrored and " } else { "" };
                if fit.is_mirrored || degrees != 0.0 {
                    tell(format!("{mirrored}turned by {degrees:.1}\u{b0} against the panel"), &entry.name);
                }
            }
        }
    }
    told.into_iter().map(|(what, names)| format!("{}: {what}", listed(names.into_iter()))).collect()
}

/// Names in one line; of many the first.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    let more = names.len().saturating_sub(TOLD);
    let told = names[..names.len() - more].join(", ");
    if more > 0 { format!("{told} and {more} more") } else { told }
}

/// A name from a file, fit to be shown.
fn clean(name: &str) -> String {
    let shown: String =
        name.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).take(NAME_LIMIT).collect();
    shown.trim().to_owned()
}

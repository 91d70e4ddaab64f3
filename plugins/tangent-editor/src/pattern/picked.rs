//! What a grain can be laid along: an edge of a piece, or the way between two of its points.

use glam::Vec2;

use crate::sheet::Sheet;

/// A line that was picked on a piece, on the sheet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PickedLine {
    /// The panel's number.
    pub(crate) panel: usize,
    /// At least two points.
    pub(crate) line: Vec<Vec2>,
    /// From its first point to its last: unit.
    pub(crate) along: Vec2,
    /// Its number among the piece's edges, where it is one.
    edge: Option<usize>,
}

impl PickedLine {
    /// An edge of the piece of a panel; none where it ends where it begins.
    pub(crate) fn edge(sheet: &Sheet, panel: usize, edge: usize) -> Option<Self> {
        let of = sheet.piece(panel)?.edges.get(edge)?;
        Some(Self { panel, line: of.line.clone(), along: of.along()?, edge: Some(edge) })
    }

    /// The way between two points; none where they are one.
    pub(crate) fn between(panel: usize, from: Vec2, to: Vec2) -> Option<Self> {
        Some(Self { panel, line: vec![from, to], along: (to - from).try_normalize()?, edge: None })
    }

    /// The edge of the panel that comes after `picked`; the first, where none of its is picked.
    pub(crate) fn next(sheet: &Sheet, panel: usize, picked: Option<&Self>) -> Option<Self> {
        let count = sheet.piece(panel)?.edges.len();
        let start = picked.filter(|picked| picked.panel == panel).and_then(|picked| picked.edge);
        let start = start.map_or(0, |edge| edge + 1);
        (0..count).find_map(|k| Self::edge(sheet, panel, (start + k) % count))
    }
}

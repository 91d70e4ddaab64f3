//! Panels merged, split and renamed after a garment was cut into them.

mod cut;
mod merge;
mod seams;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use glam::Vec2;
use serde::{Deserialize, Serialize};

use super::measure::measure;
use super::split::{append_copies, split};
use super::{Garment, Panel};
use crate::{Error, Result};

/// What people make of a garment's panels. Panels go by their ids, so it holds for the same garment saved again.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Arrangement {
    /// One after the other: later ones speak of panels that earlier ones made. At most [`Arrangement::MOST_CHANGES`].
    pub changes: Vec<Rearrangement>,
    /// What panels are called, by their ids.
    pub names: BTreeMap<String, String>,
}

/// One change of a garment's panels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rearrangement {
    /// Two panels or more become one, which has the id, the name and the grain of the first.
    Merge(Vec<String>),
    /// A panel is cut in two along a straight line of its flat pattern.
    Split {
        /// The panel.
        panel: String,
        /// The ends of the line, on its outline: in UVs.
        line: [Vec2; 2],
        /// The ids of the half on the left of the line (v up) and of the one on the right.
        into: [String; 2],
    },
}

impl Arrangement {
    /// Most changes.
    pub const MOST_CHANGES: usize = 4096;

    /// Whether it changes nothing.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty() && self.names.is_empty()
    }

    /// Whether it makes sense for any garment.
    ///
    /// # Errors
    /// Too many changes, a panel merged with itself, a line without length, ids that are the same or empty.
    pub fn check(&self) -> Result<()> {
        if self.changes.len() > Self::MOST_CHANGES {
            let what = format!("panels were merged or split more than {} times", Self::MOST_CHANGES);
            return Err(Error::too_large(what));
        }
        for (number, change) in self.changes.iter().enumerate() {
            change.check().map_err(|error| error.at_element(format!("changes[{number}]")))?;
        }
        Ok(())
    }
}

impl Rearrangement {
    fn check(&self) -> Result<()> {
        match self {
            Self::Merge(panels) => {
                let mut sorted: Vec<&String> = panels.iter().collect();
                sorted.sort_unstable();
                sorted.dedup();
                if sorted.len() < 2 || sorted.len() < panels.len() {
                    return Err(Error::invalid("two panels or more can be merged, each named once"));
                }
            }
            Self::Split { line, into, .. } => {
                let is_line = line[0].is_finite() && line[1].is_finite() && line[0] != line[1];
                if !is_line {
                    return Err(Error::invalid("the line along which a panel is split has no length"));
                }
                if into[0] == into[1] || into.iter().any(|id| id.trim().is_empty()) {
                    return Err(Error::invalid("the halves of a split panel need ids of their own"));
                }
            }
        }
        Ok(())
    }
}

impl Garment {
    /// The garment with its panels arranged so, and what did not fit it: a change that names a panel which is not there, or
    /// a line that does not cut its panel in two, is left out.
    ///
    /// Merging moves nothing: triangles are put in another order. A split cuts the triangles on its line, so the surface
    /// stays what it was. Seams and mirror partners stay as far as they still hold: halves are sewn to each other, and mirror
    /// nothing. Without any change the garment is the same to the bit.
    #[must_use]
    pub fn arranged(mut self, arrangement: &Arrangement) -> (Self, Vec<String>) {
        let mut faults = Vec::new();
        for change in &arrangement.changes {
            if let Err(fault) = self.rearrange(change) {
                faults.push(fault);
            }
        }
        self.rename_panels(&arrangement.names);
        (self, faults)
    }

    /// Calls panels by the names that are given for their ids.
    pub fn rename_panels(&mut self, names: &BTreeMap<String, String>) {
        for panel in &mut self.panels {
            if let Some(name) = names.get(&panel.id) {
                panel.name.clone_from(name);
            }
        }
    }

    /// The straight line through two points of a panel's flat pattern, from outline to outline: the stretch of it on which
    /// the middle between the points lies, or, where that is off the cloth, the stretch nearest to it.
    pub fn line_across(&self, panel: &Panel, through: [Vec2; 2]) -> Option<[Vec2; 2]> {
        cut::line_across(&seams::lines(self, panel), through)
    }

    /// Whether a line cuts a panel in two.
    ///
    /// # Errors
    /// It does not; why.
    pub fn check_split(&self, panel: &Panel, line: [Vec2; 2]) -> Result<()> {
        cut::cut(self, panel, line).map(drop).map_err(Error::invalid)
    }

    fn rearrange(&mut self, change: &Rearrangement) -> Result<(), String> {
        let number = |id: &String| self.panels.iter().position(|panel| panel.id == *id);
        let there = |id: &String| number(id).ok_or_else(|| format!("the garment has no panel '{id}'"));
        match change {
            Rearrangement::Merge(ids) => {
                let members: Result<Vec<usize>, String> = ids.iter().map(there).collect();
                members
                    .and_then(|members| merge::merge(self, &members))
                    .map_err(|why| format!("{} were not merged: {why}", ids.join(", ")))
            }
            Rearrangement::Split { panel, line, into } => {
                let taken = into.iter().find(|&id| id != panel && number(id).is_some());
                let found = match taken {
                    Some(id) => Err(format!("there is another panel '{id}'")),
                    None => there(panel),
                };
                found
                    .and_then(|number| self.split_panel(number, *line, into))
                    .map_err(|why| format!("{panel} was not split: {why}"))
            }
        }
    }

    fn split_panel(&mut self, panel: usize, line: [Vec2; 2], into: &[String; 2]) -> Result<(), String> {
        let cut = cut::cut(self, &self.panels[panel], line)?;
        let patterns = seams::of_halves(self, panel, line, &cut);
        let range = self.panels[panel].triangles.clone();
        let mut of = self.panel_numbers();
        of.iter_mut().filter(|number| **number as usize > panel).for_each(|number| *number += 1);
        let range = range.start as usize..range.end as usize;
        self.triangles.splice(range.clone(), cut.triangles);
        of.splice(range, cut.is_left.iter().map(|&left| panel as u32 + u32::from(!left)));
        self.positions.extend(cut.added.iter().map(|added| added.position));
        self.normals.extend(cut.added.iter().map(|added| added.normal));
        self.uvs.extend(cut.added.iter().map(|added| added.uv));
        let mut right = self.panels[panel].clone();
        right.id.clone_from(&into[1]);
        right.name.push_str(" 2");
        self.panels.insert(panel + 1, right);
        let left = &mut self.panels[panel];
        left.id.clone_from(&into[0]);
        left.name.push_str(" 1");
        for (panel, pattern) in self.panels.iter_mut().zip(patterns) {
            panel.pattern = pattern;
        }
        self.regroup(&of, &[panel, panel + 1]);
        Ok(())
    }

    /// The number of the panel of each triangle.
    fn panel_numbers(&self) -> Vec<u32> {
        let ranges = self.panels.iter().zip(0u32..);
        ranges.flat_map(|(panel, number)| std::iter::repeat_n(number, panel.triangles.len())).collect()
    }

    /// Puts the triangles in the order of the panels, of which `of` names that of each triangle; vertices that panels would
    /// share are doubled. The panels `changed` are measured anew.
    fn regroup(&mut self, of: &[u32], changed: &[usize]) {
        let mut order: Vec<usize> = (0..of.len()).collect();
        // Stable: within a panel the order stays.
        order.sort_by_key(|&triangle| of[triangle]);
        self.triangles = order.iter().map(|&triangle| self.triangles[triangle]).collect();
        let copies =
            split(&mut self.triangles, self.positions.len(), |triangle, _| of[order[triangle]]).copies;
        append_copies(&mut self.positions, &copies);
        append_copies(&mut self.normals, &copies);
        append_copies(&mut self.uvs, &copies);
        let mut sizes = vec![0u32; self.panels.len()];
        of.iter().for_each(|&panel| sizes[panel as usize] += 1);
        let mut start = 0;
        for (panel, size) in self.panels.iter_mut().zip(sizes) {
            panel.triangles = start..start + size;
            start += size;
        }
        for &number in changed {
            let range = self.panels[number].triangles.clone();
            let triangles = &self.triangles[range.start as usize..range.end as usize];
            let figures = measure(&self.positions, &self.uvs, triangles, (Vec2::ZERO, Vec2::ZERO));
            let panel = &mut self.panels[number];
            (panel.area, panel.flags) = (figures.area, figures.flags);
        }
    }
}

//! What edits are called in menus and in the history.

use std::f32::consts::FRAC_PI_2;

use amc_core::direction::Direction;

use super::edit::wrapped;
use super::{Asset, ColourwayId, Edit, FabricId, Project};

/// Turns this close to a quarter turn are called one, radians.
const QUARTER_TOLERANCE: f32 = 1e-3;

impl Edit {
    /// What it does, for people: `Swap warp and weft of 3 panels`. Fabrics and colourways are called as in `project`,
    /// the one before the edit.
    pub fn name(&self, project: &Project) -> String {
        match self {
            Self::SetGarment(garment) => format!("Change the garment to {}", garment.name()),
            Self::SetUnit(unit) => format!("Take the garment's numbers as {unit}"),
            Self::AddFabric(fabric) => format!("Add {}", fabric.name),
            Self::RemoveFabric(id) => format!("Remove {}", fabric_name(project, *id)),
            Self::SetFabric { panels, fabric: Some(id) } => {
                format!("Put {} on {}", fabric_name(project, *id), counted(panels.len()))
            }
            Self::SetFabric { panels, fabric: None } => {
                format!("Take the fabric off {}", counted(panels.len()))
            }
            Self::SetDirection { panels, direction } => direction_name(panels.len(), *direction),
            Self::TurnDirection { panels, by } => turn_name(panels.len(), *by),
            Self::SetVisible { panels, visible: true } => format!("Show {}", counted(panels.len())),
            Self::SetVisible { panels, visible: false } => format!("Hide {}", counted(panels.len())),
            Self::SetPrint { panels, print: Some(print) } => {
                format!("Print {} on {}", print.picture.name(), counted(panels.len()))
            }
            Self::SetPrint { panels, print: None } => format!("Take the print off {}", counted(panels.len())),
            Self::LayPrint { panels, .. } => format!("Move the print of {}", counted(panels.len())),
            Self::RenamePanel { name: Some(name), .. } => format!("Rename a panel to {name}"),
            Self::RenamePanel { name: None, .. } => "Name a panel as its garment does".to_owned(),
            Self::GroupPanels { panels, group: Some(group) } => {
                format!("Group {} as {group}", counted(panels.len()))
            }
            Self::GroupPanels { panels, group: None } => format!("Ungroup {}", counted(panels.len())),
            Self::MergePanels { panels, .. } => format!("Merge {}", counted(panels.len())),
            Self::SplitPanel { .. } => "Split a panel".to_owned(),
            Self::AddColourway(label) => format!("Add the colourway '{}'", label.name),
            Self::WearColourway(id) => format!("Wear {}", colourway_name(project, *id)),
            Self::RenameColourway(label) => {
                format!("Rename {} to '{}'", colourway_name(project, label.id), label.name)
            }
            Self::RemoveColourway(id) => format!("Remove {}", colourway_name(project, *id)),
            Self::MoveColourway { colourway, .. } => format!("Move {}", colourway_name(project, *colourway)),
            Self::SetNotes(_) => "Edit the notes".to_owned(),
            Self::SetPluginState { what, .. } | Self::SetComb { what, .. } => what.clone(),
            Self::Relocate { old, .. } => format!("Locate {}", Asset::file(old.as_path()).name()),
        }
    }

    /// Where a turn started or stands: the angle of its first panel, radians.
    pub(super) fn turned_from(&self) -> Option<f32> {
        match self {
            Self::TurnDirection { panels, .. } => panels.first().map(|(_, now)| now.angle),
            _ => None,
        }
    }

    /// Its name as the end of a drag that began with the first panel at `start`: turns are counted from there.
    pub(super) fn name_in_drag(&self, project: &Project, start: Option<f32>) -> String {
        match (self, start, self.turned_from()) {
            (Self::TurnDirection { panels, by }, Some(start), Some(now)) => {
                turn_name(panels.len(), now + by - start)
            }
            _ => self.name(project),
        }
    }
}

fn fabric_name(project: &Project, id: FabricId) -> String {
    project.fabric(id).map_or_else(|| format!("fabric {}", id.number()), |fabric| fabric.name.clone())
}

fn colourway_name(project: &Project, id: ColourwayId) -> String {
    let known = project.colourways.get(id);
    known.map_or_else(|| format!("colourway {}", id.number()), |label| format!("'{}'", label.name))
}

fn counted(panels: usize) -> String {
    if panels == 1 { "1 panel".to_owned() } else { format!("{panels} panels") }
}

fn direction_name(panels: usize, direction: Option<Direction>) -> String {
    let panels = counted(panels);
    match direction {
        None => format!("Lay {panels} along the grain"),
        Some(direction) => format!("Set the direction of {panels} to {}", degrees(direction.angle)),
    }
}

fn turn_name(panels: usize, by: f32) -> String {
    let (panels, by) = (counted(panels), wrapped(by));
    match (by.abs() - FRAC_PI_2).abs() < QUARTER_TOLERANCE {
        true => format!("Swap warp and weft of {panels}"),
        false => format!("Turn {panels} by {}", degrees(by)),
    }
}

/// An angle as people read it, to a tenth of a degree.
fn degrees(angle: f32) -> String {
    let tenths = (angle.to_degrees() * 10.0).round() / 10.0;
    // No minus before a zero.
    format!("{}°", if tenths == 0.0 { 0.0 } else { tenths })
}

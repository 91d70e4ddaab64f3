//! The grain of panels: what it is, and the edits that change it.

pub(crate) mod align;
pub(crate) mod arrow;
pub(crate) mod expression;
pub(crate) mod partners;
pub(crate) mod snap;

use std::f32::consts::PI;

use amc_core::direction::Direction;
use amc_core::mesh::{Garment, Panel};
use studio_plugin::document::{Edit, Gesture, Project};
use studio_plugin::{Context, Notices};

use crate::assignments::Assignments;
use crate::texts;

/// The panels a command is for: those that are selected; where none is, all that take a fabric.
pub(crate) fn picked(garment: &Garment, studio: &Context<'_>) -> Vec<usize> {
    let selected = &studio.selection.panels;
    let is_picked = |panel: &Panel| {
        if selected.is_empty() { panel.takes_fabric } else { selected.contains(&panel.id) }
    };
    (0..garment.panels.len()).filter(|&panel| is_picked(&garment.panels[panel])).collect()
}

/// A panel's direction.
pub(crate) fn direction(panel: &Panel, project: &Project) -> Direction {
    project.look_of(panel).direction.unwrap_or_else(|| Direction::along_grain(panel))
}

/// The angle of a panel's mirror image: the flat pieces mirror each other left to right, unless the UVs of one are mirrored and
/// the two are drawn alike.
pub(crate) fn mirrored(direction: Direction, from: &Panel, to: &Panel) -> Direction {
    if from.flags.mirrored != to.flags.mirrored {
        return direction;
    }
    Direction { angle: PI - direction.angle, ..direction }
}

/// Turns every panel from where it is. A drag is one gesture.
pub(crate) fn turn(
    panels: &[usize],
    by: f32,
    gesture: Option<Gesture>,
    garment: &Garment,
    studio: &mut Context<'_>,
) {
    let project = studio.document.project();
    let Some(free) = Free::of(panels, garment, project, studio.notices) else { return };
    let now = |sense: bool| -> Vec<(String, Direction)> {
        let turned = free.panels.iter().filter(|panel| panel.is_mirrored == sense);
        turned
            .map(|it| (garment.panels[it.panel].id.clone(), direction(&garment.panels[it.panel], project)))
            .collect()
    };
    let (turned, against) = (now(false), now(true));
    let gesture = gesture.or_else(|| (!against.is_empty()).then(Gesture::begin));
    for (panels, by) in [(against, -by), (turned, by)] {
        if !panels.is_empty() {
            submit(Edit::TurnDirection { panels, by }, gesture, studio);
        }
    }
}

/// Gives every panel the direction that `to` says; where it says none, it stays. All are one step.
pub(crate) fn set(
    panels: &[usize],
    garment: &Garment,
    studio: &mut Context<'_>,
    to: impl Fn(usize, Direction) -> Option<Direction>,
) {
    let project = studio.document.project();
    let Some(free) = Free::of(panels, garment, project, studio.notices) else { return };
    let mut groups: Vec<(Direction, Vec<String>)> = Vec::new();
    for it in &free.panels {
        let (panel, model) = (&garment.panels[it.panel], &garment.panels[it.model]);
        let Some(wanted) = to(it.model, direction(model, project)) else { continue };
        let wanted = if it.is_mirrored { mirrored(wanted, model, panel) } else { wanted };
        match groups.iter_mut().find(|(known, _)| *known == wanted) {
            Some((_, ids)) => ids.push(panel.id.clone()),
            None => groups.push((wanted, vec![panel.id.clone()])),
        }
    }
    let gesture = Some(Gesture::begin());
    for (direction, panels) in groups {
        submit(Edit::SetDirection { panels, direction: Some(direction) }, gesture, studio);
    }
}

fn submit(edit: Edit, gesture: Option<Gesture>, studio: &mut Context<'_>) {
    match gesture {
        Some(gesture) => studio.submit_in(gesture, edit),
        None => studio.submit(edit),
    }
}

/// The panels that an edit reaches.
struct Free {
    panels: Vec<Reached>,
}

/// A panel, and the one whose direction it takes: itself, or the partner that it is linked to.
struct Reached {
    panel: usize,
    model: usize,
    is_mirrored: bool,
}

impl Free {
    /// `panels` without those that are locked (which is said), with the partners that follow them.
    fn of(panels: &[usize], garment: &Garment, project: &Project, notices: &mut Notices) -> Option<Self> {
        let assignments = match Assignments::of(project) {
            Ok(assignments) => assignments,
            Err(error) => {
                notices.failed(error);
                return None;
            }
        };
        let is_locked = |panel: usize| assignments.panel(&garment.panels[panel].id).is_locked;
        let locked = panels.iter().filter(|&&panel| is_locked(panel)).count();
        if locked > 0 {
            notices.note(texts::locked(locked));
        }
        let free = panels.iter().copied().filter(|&panel| !is_locked(panel));
        let mut reached: Vec<Reached> =
            free.map(|panel| Reached { panel, model: panel, is_mirrored: false }).collect();
        for model in panels.iter().copied().filter(|&panel| !is_locked(panel)) {
            if !assignments.panel(&garment.panels[model].id).is_linked {
                continue;
            }
            let partner = partners::partner(garment, model);
            if let Some(panel) = partner.filter(|partner| !panels.contains(partner) && !is_locked(*partner)) {
                let is_mirrored =
                    garment.panels[model].flags.mirrored == garment.panels[panel].flags.mirrored;
                reached.push(Reached { panel, model, is_mirrored });
            }
        }
        Some(Self { panels: reached })
    }
}

//! What an import changes in a project.

use amc_core::Result;
use amc_core::direction::Direction;
use amc_core::mesh::Garment;
use studio_plugin::document::{Edit, FabricId, Project};

use super::{Found, Import, listed};
use crate::assignments::{Assignment, Assignments};
use crate::texts;

/// What is to be done, and what cannot be.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Planned {
    /// To be submitted together, as one step.
    pub edits: Vec<Edit>,
    /// How many panels they reach.
    pub panels: usize,
    /// What else there is to say.
    pub notices: Vec<String>,
}

/// The edits by which `project`, which wears `garment`, takes in what was read for it. The directions of locked panels stay, and
/// a fabric that the project does not have is not made up; both are said.
///
/// # Errors
/// What the project says of locks cannot be read.
pub fn edits(import: &Import, garment: &Garment, project: &Project) -> Result<Planned> {
    let assignments = Assignments::of(project)?;
    let id = |found: &Found| garment.panels.get(found.panel).map(|panel| panel.id.clone());
    let name = |found: &&Found| garment.panels.get(found.panel).map_or("", |panel| project.panel_name(panel));
    let is_locked = |found: &Found| id(found).is_some_and(|id| assignments.panel(&id).is_locked);
    let mut planned = Planned { panels: import.found.len(), ..Planned::default() };
    let mut directions: Vec<(Direction, Vec<String>)> = Vec::new();
    let mut fabrics: Vec<(FabricId, Vec<String>)> = Vec::new();
    let mut unknown = Vec::new();
    for found in &import.found {
        let Some(id) = id(found) else { continue };
        if let Some(direction) = found.direction.filter(|_| !is_locked(found)) {
            group(&mut directions, direction, id.clone());
        }
        if let Some(wanted) = &found.fabric {
            match project.fabrics.iter().find(|fabric| fabric.name == *wanted) {
                Some(fabric) => group(&mut fabrics, fabric.id, id),
                None if unknown.contains(wanted) => {}
                None => unknown.push(wanted.clone()),
            }
        }
    }
    let turned = |(direction, panels)| Edit::SetDirection { panels, direction: Some(direction) };
    planned.edits.extend(directions.into_iter().map(turned));
    let worn = |(fabric, panels)| Edit::SetFabric { panels, fabric: Some(fabric) };
    planned.edits.extend(fabrics.into_iter().map(worn));
    let locked = import.found.iter().filter(|found| found.direction.is_some() && is_locked(found));
    let locked = listed(locked.map(|found| name(&found)));
    if !locked.is_empty() {
        planned.notices.push(texts::kept_locked(&locked));
    }
    let combed = import
        .found
        .iter()
        .filter(|found| found.direction.is_some() && id(found).is_some_and(|id| project.comb(&id).is_some()));
    let combed = listed(combed.map(|found| name(&found)));
    if !combed.is_empty() {
        planned.notices.push(texts::kept_strokes(&combed));
    }
    if !unknown.is_empty() {
        planned.notices.push(texts::no_such_fabrics(&listed(unknown.iter().map(String::as_str))));
    }
    planned.edits.extend(said(import, assignments, &id));
    Ok(planned)
}

/// Puts a panel with those that get the same.
fn group<T: PartialEq>(groups: &mut Vec<(T, Vec<String>)>, what: T, panel: String) {
    match groups.iter_mut().find(|(known, _)| *known == what) {
        Some((_, panels)) => panels.push(panel),
        None => groups.push((what, vec![panel])),
    }
}

/// The edit that keeps laying, locks and links; none where nothing is said of them.
fn said(
    import: &Import,
    mut assignments: Assignments,
    id: &dyn Fn(&Found) -> Option<String>,
) -> Option<Edit> {
    let says = |found: &&Found| {
        found.orientation.is_some() || found.is_locked.is_some() || found.is_linked.is_some()
    };
    let mut panels = Vec::new();
    for found in import.found.iter().filter(says) {
        let Some(id) = id(found) else { continue };
        assignments.change(&id, |it: &mut Assignment| {
            it.orientation = found.orientation.unwrap_or(it.orientation);
            // What the person locked here is not unlocked by a file.
            it.is_locked |= found.is_locked.unwrap_or_default();
            it.is_linked = found.is_linked.unwrap_or(it.is_linked);
        });
        panels.push(id);
    }
    (!panels.is_empty()).then(|| assignments.into_edit(texts::imported(panels.len())))
}

//! Combing: strokes that a panel's direction follows, drawn on the garment or on the flat pattern.

pub(crate) mod marks;
pub(crate) mod pane;
mod shape;
mod stylus;

use std::sync::Arc;

use amc_core::direction::comb::{Comb, Path, Stroke};
use amc_core::mesh::{Garment, SurfacePlace};
use glam::{Vec2, Vec3};
use studio_plugin::Context;
use studio_plugin::document::{Edit, Gesture, Project};

pub(crate) use self::stylus::{Finder, Stylus};
use crate::assignments::Assignments;
use crate::sheet::Sheet;
use crate::texts::comb as texts;

/// The id of the tool.
pub(crate) const TOOL: &str = "comb";

/// A stroke of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Chosen {
    /// The panel's number.
    pub(crate) panel: usize,
    /// The stroke's, among the panel's.
    pub(crate) stroke: usize,
}

/// The comb of a panel; of one that has none, an empty one.
pub(crate) fn comb_of(project: &Project, panel: &str) -> Comb {
    project.comb(panel).map(|comb| (**comb).clone()).unwrap_or_default()
}

/// Gives a panel another comb; `what` is what the person did.
pub(crate) fn submit(
    panel: &str,
    comb: Comb,
    what: &str,
    gesture: Option<Gesture>,
    studio: &mut Context<'_>,
) {
    let comb = (comb != Comb::default()).then(|| Arc::new(comb));
    let edit = Edit::SetComb { panel: panel.to_owned(), comb, what: what.to_owned() };
    match gesture {
        Some(gesture) => studio.submit_in(gesture, edit),
        None => studio.submit(edit),
    }
}

/// Whether a panel may be combed; says so where it may not.
pub(crate) fn is_free(panel: &str, studio: &mut Context<'_>) -> bool {
    match Assignments::of(studio.document.project()) {
        Ok(assignments) if assignments.panel(panel).is_locked => {
            studio.notices.note(crate::texts::locked(1));
            false
        }
        Ok(_) => true,
        Err(error) => {
            studio.notices.failed(error);
            false
        }
    }
}

/// Adds an exact stroke through points of a panel's flat pattern (UVs).
pub(crate) fn add(sheet: &Sheet, panel: usize, points: impl Iterator<Item = Vec2>, studio: &mut Context<'_>) {
    let id = &sheet.garment.panels[panel].id;
    let mut comb = comb_of(studio.document.project(), id);
    if comb.strokes.len() >= Comb::MOST_STROKES {
        return studio.notices.note(texts::FULL);
    }
    if is_free(id, studio) {
        let Stylus { hold, radius, .. } = Stylus::default();
        let path = Path::Pattern(points.take(Comb::MOST_POINTS).collect());
        comb.strokes.push(Stroke { path, hold, radius, is_on: true });
        submit(id, comb, texts::DRAWN, None, studio);
    }
}

/// Deletes a stroke.
pub(crate) fn delete(garment: &Garment, chosen: Chosen, studio: &mut Context<'_>) {
    let id = &garment.panels[chosen.panel].id;
    let mut comb = comb_of(studio.document.project(), id);
    if chosen.stroke < comb.strokes.len() && is_free(id, studio) {
        comb.strokes.remove(chosen.stroke);
        submit(id, comb, texts::DELETED, None, studio);
    }
}

/// The panel that a triangle is of.
pub(crate) fn panel_of(garment: &Garment, place: &SurfacePlace) -> Option<usize> {
    garment.panels.iter().position(|panel| panel.triangles.contains(&place.triangle))
}

/// Whether strokes on a panel are kept in its flat pattern: they then survive another mesh and another drape.
pub(crate) fn is_flat(sheet: &Sheet, panel: usize) -> bool {
    sheet.piece(panel).is_some()
}

/// A point of a stroke, where strokes of its panel are kept.
fn point(sheet: &Sheet, panel: usize, place: &SurfacePlace) -> Vec3 {
    let garment = &*sheet.garment;
    if is_flat(sheet, panel) { place.uv(garment).extend(0.0) } else { place.position(garment) }
}

/// The points of a stroke: in UVs with a third coordinate of zero, or in space.
pub(crate) fn points(stroke: &Stroke) -> Vec<Vec3> {
    match &stroke.path {
        Path::Pattern(points) => points.iter().map(|point| point.extend(0.0)).collect(),
        Path::Space(points) => points.clone(),
    }
}

fn set_points(stroke: &mut Stroke, points: Vec<Vec3>) {
    match &mut stroke.path {
        Path::Pattern(of) => *of = points.into_iter().map(Vec3::truncate).collect::<Vec<Vec2>>(),
        Path::Space(of) => *of = points,
    }
}

//! Drawing and dragging strokes, in whichever view.

use amc_core::direction::comb::{Comb, Elsewhere, Hold, Path, Stroke};
use amc_core::mesh::{Garment, SurfacePlace};
use egui::{Pos2, Response};
use glam::{Vec2, Vec3};
use studio_plugin::Context;
use studio_plugin::document::Gesture;

use super::shape::{Grip, drawn, moved};
use super::{Chosen, comb_of, is_free, panel_of, point, points, set_points, submit};
use crate::sheet::{Sheet, line};
use crate::texts::comb as texts;

/// How near the pointer must be to a stroke to take hold of it, points.
const REACH: f32 = 7.0;
/// The pointer makes a point of a stroke when it has come this far, points.
const STEP: f32 = 4.0;
/// How far a stroke may be off the way the hand went, of its own length.
const TOLERANCE: f32 = 2e-3;

/// What finds places in a view.
pub(crate) trait Finder {
    /// The place on the garment at a point of the window.
    fn place(&self, at: Pos2) -> Option<SurfacePlace>;

    /// Where a stroke's points are in the window, as far as they are seen.
    fn line(&self, panel: usize, stroke: &Stroke) -> Vec<Pos2>;
}

/// What the hand does.
#[derive(Debug)]
pub(crate) struct Stylus {
    /// How strokes that are drawn are followed.
    pub(crate) hold: Hold,
    /// Their radius, metres.
    pub(crate) radius: f32,
    /// The stroke that was drawn or taken last.
    pub(crate) chosen: Option<Chosen>,
    held: Option<Held>,
}

#[derive(Debug)]
struct Held {
    panel: usize,
    gesture: Gesture,
    /// The comb when the hand came down.
    before: Comb,
    what: What,
}

#[derive(Debug)]
enum What {
    /// A new stroke: its points, and where the last of them was in the window.
    New(Vec<Vec3>, Pos2),
    /// A stroke that is there, held somewhere.
    Old { stroke: usize, grip: Grip, from: Vec3 },
    /// The point that the direction goes round or away from.
    Centre,
}

impl Default for Stylus {
    fn default() -> Self {
        Self { hold: Hold::Exact, radius: 0.03, chosen: None, held: None }
    }
}

impl Stylus {
    /// What the left button does in a view.
    pub(crate) fn use_in(
        &mut self,
        response: &Response,
        finder: &impl Finder,
        sheet: &Sheet,
        studio: &mut Context<'_>,
    ) {
        let garment = &*sheet.garment;
        let at = response.interact_pointer_pos();
        if response.drag_started_by(egui::PointerButton::Primary) {
            // Where it came down, not where it was when that was known to be a drag.
            let down = response.ctx.input(|input| input.pointer.press_origin()).or(at);
            self.held = down.and_then(|down| self.take(down, finder, sheet, studio));
        }
        if let Some(at) = at.filter(|_| response.dragged_by(egui::PointerButton::Primary)) {
            self.go_on(at, finder, sheet, studio);
        }
        if response.drag_stopped() {
            self.held = None;
        }
        if let Some(at) = at.filter(|_| response.clicked()) {
            self.chosen = near(at, finder, garment, studio).map(|(chosen, _)| chosen);
            if let Some(panel) = finder.place(at).and_then(|place| panel_of(garment, &place)) {
                studio.selection.click(&garment.panels[panel].id, false);
            }
        }
    }

    fn take(
        &mut self,
        at: Pos2,
        finder: &impl Finder,
        sheet: &Sheet,
        studio: &mut Context<'_>,
    ) -> Option<Held> {
        let garment = &*sheet.garment;
        let place = finder.place(at)?;
        let old = near(at, finder, garment, studio);
        let panel = old.map_or_else(|| panel_of(garment, &place), |(chosen, _)| Some(chosen.panel))?;
        let id = &garment.panels[panel].id;
        if !is_free(id, studio) {
            return None;
        }
        studio.selection.click(id, false);
        let before = comb_of(studio.document.project(), id);
        let from = point(sheet, panel, &place);
        let centre = centre_stroke(&before).map(|stroke| finder.line(panel, &stroke));
        let what = if centre.is_some_and(|line| line.iter().any(|it| it.distance(at) <= REACH)) {
            What::Centre
        } else if let Some((chosen, grip)) = old {
            self.chosen = Some(chosen);
            What::Old { stroke: chosen.stroke, grip, from }
        } else if before.strokes.len() >= Comb::MOST_STROKES {
            studio.notices.note(texts::FULL);
            return None;
        } else {
            self.chosen = Some(Chosen { panel, stroke: before.strokes.len() });
            What::New(vec![from], at)
        };
        Some(Held { panel, gesture: Gesture::begin(), before, what })
    }

    fn go_on(&mut self, at: Pos2, finder: &impl Finder, sheet: &Sheet, studio: &mut Context<'_>) {
        let garment = &*sheet.garment;
        let Some(held) = &mut self.held else { return };
        let on_panel = |place: &SurfacePlace| panel_of(garment, place) == Some(held.panel);
        let Some(place) = finder.place(at).filter(on_panel) else { return };
        let to = point(sheet, held.panel, &place);
        let mut comb = held.before.clone();
        let what = match &mut held.what {
            What::New(drawn, last) => {
                if at.distance(*last) < STEP {
                    return;
                }
                drawn.push(to);
                *last = at;
                comb.strokes.push(stroke(sheet, held.panel, drawn, self.hold, self.radius));
                texts::DRAWN
            }
            What::Old { stroke, grip, from } => {
                let Some(stroke) = comb.strokes.get_mut(*stroke) else { return };
                let moved = moved(&points(stroke), *grip, to - *from);
                set_points(stroke, moved);
                texts::MOVED
            }
            What::Centre => {
                comb.elsewhere = match comb.elsewhere {
                    Elsewhere::Radial(_) => Elsewhere::Radial(to.truncate()),
                    Elsewhere::Circular(_) => Elsewhere::Circular(to.truncate()),
                    other => other,
                };
                texts::MOVED_CENTRE
            }
        };
        submit(&garment.panels[held.panel].id, comb, what, Some(held.gesture), studio);
    }
}

/// A stroke through points that a hand made.
fn stroke(sheet: &Sheet, panel: usize, hand: &[Vec3], hold: Hold, radius: f32) -> Stroke {
    let length: f32 = hand.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
    let line = drawn(hand, TOLERANCE * length);
    let path = match super::is_flat(sheet, panel) {
        true => Path::Pattern(line.into_iter().map(Vec3::truncate).collect()),
        false => Path::Space(line),
    };
    Stroke { path, hold, radius, is_on: true }
}

/// The centre of a radial or circular direction, as a stroke of one point.
pub(super) fn centre_stroke(comb: &Comb) -> Option<Stroke> {
    let (Elsewhere::Radial(centre) | Elsewhere::Circular(centre)) = comb.elsewhere else { return None };
    Some(Stroke { path: Path::Pattern(vec![centre]), hold: Hold::Exact, radius: Comb::SHORTEST, is_on: true })
}

/// The stroke at a point of the window, and where it is held there.
fn near(at: Pos2, finder: &impl Finder, garment: &Garment, studio: &Context<'_>) -> Option<(Chosen, Grip)> {
    let place = finder.place(at)?;
    let panel = panel_of(garment, &place)?;
    let comb = studio.document.project().comb(&garment.panels[panel].id)?;
    let lines = comb.strokes.iter().map(|stroke| finder.line(panel, stroke));
    let flat = |at: Pos2| Vec2::new(at.x, at.y);
    let distance =
        |line: &[Pos2]| line::distance(&line.iter().map(|&at| flat(at)).collect::<Vec<_>>(), flat(at));
    let (stroke, line, off) = lines
        .enumerate()
        .map(|(stroke, line)| {
            let off = distance(&line);
            (stroke, line, off)
        })
        .min_by(|a, b| a.2.total_cmp(&b.2))?;
    if off > REACH {
        return None;
    }
    let is_at = |end: Option<&Pos2>| end.is_some_and(|end| end.distance(at) <= REACH);
    let grip = match (is_at(line.last()), is_at(line.first())) {
        (true, _) => Grip::End,
        (_, true) => Grip::Start,
        _ => Grip::Middle,
    };
    Some((Chosen { panel, stroke }, grip))
}

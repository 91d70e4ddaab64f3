//! What the editor can be asked for.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use amc_core::direction::{Direction, Source};
use egui::{Key, KeyboardShortcut, Modifiers};
use glam::{Vec2, Vec3};
use studio_plugin::document::Edit;
use studio_plugin::{Command, Context};

use crate::assignments::Assignments;
use crate::comb;
use crate::exchange;
use crate::grain::{self, align, partners};
use crate::pattern::PickedLine;
use crate::sheet::Sheet;
use crate::splitting;
use crate::texts::{self, comb as comb_texts};

const fn command(id: &'static str, name: &'static str, tooltip: &'static str) -> Command {
    Command { id, name, tooltip, shortcut: None }
}

const fn keyed(command: Command, modifiers: Modifiers, key: Key) -> Command {
    Command { shortcut: Some(KeyboardShortcut::new(modifiers, key)), ..command }
}

/// All of them.
pub(crate) const COMMANDS: &[Command] = &[
    command("fit", texts::FIT, texts::FIT_TIP),
    keyed(command("turn-left", texts::TURN_LEFT, texts::TURN_TIP), Modifiers::SHIFT, Key::CloseBracket),
    keyed(command("turn-right", texts::TURN_RIGHT, texts::TURN_TIP), Modifiers::SHIFT, Key::OpenBracket),
    command("turn-around", texts::TURN_AROUND, texts::TURN_TIP),
    keyed(command("nudge-left", texts::NUDGE_LEFT, texts::NUDGE_TIP), Modifiers::NONE, Key::CloseBracket),
    keyed(command("nudge-right", texts::NUDGE_RIGHT, texts::NUDGE_TIP), Modifiers::NONE, Key::OpenBracket),
    command("warp", texts::WARP, texts::PRESET_TIP),
    command("weft", texts::WEFT, texts::PRESET_TIP),
    command("bias-45", texts::BIAS_45, texts::PRESET_TIP),
    command("bias-135", texts::BIAS_135, texts::PRESET_TIP),
    keyed(command("align-edge", texts::EDGE, texts::EDGE_TIP), Modifiers::NONE, Key::E),
    keyed(command("next-edge", texts::NEXT_EDGE, texts::NEXT_EDGE_TIP), Modifiers::SHIFT, Key::E),
    command("comb-edge", comb_texts::EDGE, comb_texts::EDGE_TIP),
    command("align-partner", texts::PARTNER, texts::PARTNER_TIP),
    command("align-up", texts::UP, texts::AXIS_TIP),
    command("align-across", texts::ACROSS, texts::AXIS_TIP),
    command("align-forward", texts::FORWARD, texts::AXIS_TIP),
    keyed(command("copy", texts::COPY, texts::COPY_TIP), Modifiers::COMMAND, Key::C),
    keyed(command("paste", texts::PASTE, texts::PASTE_TIP), Modifiers::COMMAND, Key::V),
    command("paste-mirrored", texts::PASTE_MIRRORED, texts::PASTE_TIP),
    command("paste-relative", texts::PASTE_RELATIVE, texts::PASTE_RELATIVE_TIP),
    keyed(command("mirror", texts::MIRROR, texts::MIRROR_TIP), Modifiers::SHIFT, Key::M),
    command("reset", texts::RESET, texts::RESET_TIP),
    keyed(
        command("delete-stroke", comb_texts::DELETE_COMMAND, comb_texts::DELETE_TIP),
        Modifiers::NONE,
        Key::Delete,
    ),
    command("lie-left", texts::LIE_LEFT, texts::LIE_TIP),
    command("lie-right", texts::LIE_RIGHT, texts::LIE_TIP),
    command("lie-drawn", texts::LIE_DRAWN, texts::LIE_TIP),
    command("split-picked", texts::SPLIT_PICKED, texts::SPLIT_PICKED_TIP),
    command("split-along", texts::SPLIT_ALONG, texts::SPLIT_ALONG_TIP),
    command("split-across", texts::SPLIT_ACROSS, texts::SPLIT_ALONG_TIP),
    command("save-sheet", texts::SAVE, texts::SAVE_TIP),
    command(exchange::IMPORT, texts::IMPORT, texts::IMPORT_TIP),
    command(exchange::EXPORT, texts::EXPORT, texts::EXPORT_TIP),
];

/// The tool that draws strokes.
pub(crate) const COMB_TOOL: Command =
    keyed(command(comb::TOOL, comb_texts::TOOL, comb_texts::TOOL_TIP), Modifiers::NONE, Key::B);

/// A grain that was copied.
#[derive(Debug, Clone, Copy)]
struct Copied {
    direction: Direction,
    /// From the grain of its own piece, radians.
    off_straight: f32,
}

/// The tool that splits panels.
pub(crate) const SPLIT_TOOL: Command = command(splitting::TOOL, texts::SPLIT, texts::SPLIT_TIP);

/// What commands take from earlier ones.
#[derive(Debug, Default)]
pub(crate) struct Given {
    copied: Option<Copied>,
    /// The edge that was clicked last, or the way between the two points that were.
    pub(crate) picked: Option<PickedLine>,
}

/// Whether a command can be run.
pub(crate) fn can_run(id: &str, sheet: &Sheet, given: &Given, studio: &Context<'_>) -> bool {
    let panels = || grain::picked(&sheet.garment, studio);
    match id {
        "paste" | "paste-mirrored" | "paste-relative" => given.copied.is_some(),
        "align-edge" | "comb-edge" | "split-picked" => given.picked.is_some(),
        "copy" => !studio.selection.panels.is_empty(),
        "split-along" | "split-across" => {
            matches!(panels()[..], [panel] if sheet.piece(panel).is_some())
                && studio.selection.panels.len() == 1
        }
        "mirror" => panels().iter().any(|&panel| partners::partner(&sheet.garment, panel).is_some()),
        "align-partner" => {
            panels().iter().any(|&panel| !sheet.garment.panels[panel].pattern.seams.is_empty())
        }
        _ => !sheet.pieces.is_empty(),
    }
}

/// Runs a command that changes grains.
pub(crate) fn run(id: &str, sheet: &Sheet, given: &mut Given, studio: &mut Context<'_>) {
    let garment = &*sheet.garment;
    let panels = grain::picked(garment, studio);
    let turn = |by: f32, studio: &mut Context<'_>| grain::turn(&panels, by, None, garment, studio);
    let cut = |angle: f32, studio: &mut Context<'_>| {
        let along = |panel: usize, now: Direction| {
            Some(Direction { angle: wrapped(straight(sheet, panel) + angle), source: flat(now.source) })
        };
        grain::set(&panels, garment, studio, along);
    };
    match id {
        "turn-left" => turn(FRAC_PI_2, studio),
        "turn-right" => turn(-FRAC_PI_2, studio),
        "turn-around" => turn(PI, studio),
        "nudge-left" => turn(PI / 180.0, studio),
        "nudge-right" => turn(-PI / 180.0, studio),
        "warp" => cut(0.0, studio),
        "weft" => cut(FRAC_PI_2, studio),
        "bias-45" => cut(-FRAC_PI_4, studio),
        "bias-135" => cut(FRAC_PI_4, studio),
        "align-edge" => align_edge(sheet, given.picked.as_ref(), studio),
        "comb-edge" => comb_edge(sheet, given.picked.as_ref(), studio),
        "next-edge" => {
            let next = panels.iter().find_map(|&panel| PickedLine::next(sheet, panel, given.picked.as_ref()));
            given.picked = next;
        }
        "lie-left" => lie(&panels, sheet, studio, |turn| turn + 90.0),
        "lie-right" => lie(&panels, sheet, studio, |turn| turn - 90.0),
        "lie-drawn" => lie(&panels, sheet, studio, |_| 0.0),
        "align-partner" => {
            let project = studio.document.project().clone();
            let of = |partner: usize| grain::direction(&garment.panels[partner], &project);
            aligned(&panels, sheet, studio, |panel, now| {
                align::to_seam_partner(garment, &garment.panels[panel], now.source, of)
            });
        }
        "align-up" => align_axis(&panels, sheet, studio, Vec3::Y),
        // The wearer looks along +z, and has the right hand at -x.
        "align-across" => align_axis(&panels, sheet, studio, Vec3::NEG_X),
        "align-forward" => align_axis(&panels, sheet, studio, Vec3::Z),
        "copy" => {
            let of = |&panel: &usize| {
                let direction = grain::direction(&garment.panels[panel], studio.document.project());
                Copied { direction, off_straight: direction.angle - straight(sheet, panel) }
            };
            given.copied = panels.first().map(of);
        }
        "paste" => {
            if let Some(Copied { direction, .. }) = given.copied {
                grain::set(&panels, garment, studio, |_, _| Some(direction));
            }
        }
        "paste-mirrored" => {
            if let Some(Copied { direction, .. }) = given.copied {
                let angle = wrapped(PI - direction.angle);
                grain::set(&panels, garment, studio, |_, _| Some(Direction { angle, ..direction }));
            }
        }
        "paste-relative" => {
            if let Some(Copied { direction, off_straight }) = given.copied {
                let along = |panel: usize| wrapped(straight(sheet, panel) + off_straight);
                grain::set(&panels, garment, studio, |panel, _| {
                    Some(Direction { angle: along(panel), ..direction })
                });
            }
        }
        "mirror" => mirror(&panels, sheet, studio),
        "split-picked" => {
            if let Some(picked) = &given.picked {
                splitting::along(sheet, picked, studio);
            }
        }
        "split-along" | "split-across" => {
            if let [panel] = panels[..] {
                splitting::through_middle(sheet, panel, id == "split-across", studio);
            }
        }
        "reset" => {
            let panels = panels.iter().map(|&panel| garment.panels[panel].id.clone()).collect();
            studio.submit(Edit::SetDirection { panels, direction: None });
        }
        _ => {}
    }
}

fn flat(source: Source) -> Source {
    if matches!(source, Source::Field(_)) { Source::default() } else { source }
}

/// The angle of the piece's own grain: as its file says, else upright in the flat pattern.
fn straight(sheet: &Sheet, panel: usize) -> f32 {
    sheet.garment.panels[panel].pattern.grain.unwrap_or(FRAC_PI_2)
}

/// The same angle within half a turn of 0.
fn wrapped(angle: f32) -> f32 {
    (angle + PI).rem_euclid(2.0 * PI) - PI
}

fn align_axis(panels: &[usize], sheet: &Sheet, studio: &mut Context<'_>, axis: Vec3) {
    let garment = &*sheet.garment;
    aligned(panels, sheet, studio, |panel, now| {
        align::to_axis(garment, &garment.panels[panel], axis, now.source)
    });
}

/// Sets the directions that `to` finds; says so where it finds none.
fn aligned(
    panels: &[usize],
    sheet: &Sheet,
    studio: &mut Context<'_>,
    to: impl Fn(usize, Direction) -> Option<Direction>,
) {
    let project = studio.document.project().clone();
    let now = |panel: usize| grain::direction(&sheet.garment.panels[panel], &project);
    if panels.iter().all(|&panel| to(panel, now(panel)).is_none()) {
        return studio.notices.note(texts::NOT_ALIGNED);
    }
    grain::set(panels, &sheet.garment, studio, to);
}

/// Along the edge; of its two ways the one nearer to where the grain is.
fn align_edge(sheet: &Sheet, picked: Option<&PickedLine>, studio: &mut Context<'_>) {
    let found = picked.and_then(|picked| Some((picked, sheet.piece(picked.panel)?)));
    let Some((picked, piece)) = found else {
        return studio.notices.note(texts::EDGE_TIP);
    };
    let matrix = piece.uv_to_sheet.matrix2;
    grain::set(&[piece.panel], &sheet.garment, studio, |_, now| {
        let along: Vec2 = picked.along;
        let along = if along.dot(now.on_cloth(matrix)) < 0.0 { -along } else { along };
        Some(Direction::along_cloth(flat(now.source), along, matrix))
    });
}

/// Adds a stroke along what was picked.
fn comb_edge(sheet: &Sheet, picked: Option<&PickedLine>, studio: &mut Context<'_>) {
    let found = picked.and_then(|picked| Some((picked, sheet.piece(picked.panel)?)));
    let Some((picked, piece)) = found else {
        return studio.notices.note(texts::EDGE_TIP);
    };
    let to_uvs = piece.uv_to_sheet.inverse();
    comb::add(sheet, picked.panel, picked.line.iter().map(|&at| to_uvs.transform_point2(at)), studio);
}

/// Turns the pieces of panels on the screen; `to` goes from degrees to degrees.
fn lie(panels: &[usize], sheet: &Sheet, studio: &mut Context<'_>, to: impl Fn(f32) -> f32) {
    let assignments = match Assignments::of(studio.document.project()) {
        Ok(assignments) => assignments,
        Err(error) => return studio.notices.failed(error),
    };
    let ids = panels.iter().map(|&panel| sheet.garment.panels[panel].id.as_str());
    let edit = assignments.changed(ids, texts::lying(panels.len()), |it| {
        let turned = to(it.screen_turn_deg).rem_euclid(360.0);
        it.screen_turn_deg = if turned.is_finite() { turned } else { 0.0 };
    });
    studio.submit(edit);
}

/// Gives the partners of the panels the mirrored directions.
fn mirror(panels: &[usize], sheet: &Sheet, studio: &mut Context<'_>) {
    let garment = &*sheet.garment;
    let project = studio.document.project().clone();
    let pairs: Vec<(usize, usize)> = panels
        .iter()
        .filter_map(|&panel| Some((panel, partners::partner(garment, panel)?)))
        // Where both are picked nothing says which is the model.
        .filter(|(_, partner)| !panels.contains(partner))
        .collect();
    if pairs.is_empty() {
        return studio.notices.note(texts::NO_PARTNER);
    }
    let partners: Vec<usize> = pairs.iter().map(|pair| pair.1).collect();
    grain::set(&partners, garment, studio, |partner, _| {
        let model = pairs.iter().find(|pair| pair.1 == partner)?.0;
        let (model, partner) = (&garment.panels[model], &garment.panels[partner]);
        let mirrored = grain::mirrored(grain::direction(model, &project), model, partner);
        Some(Direction { angle: wrapped(mirrored.angle), ..mirrored })
    });
}

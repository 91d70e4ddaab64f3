//! What the editor can be asked for.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use amc_core::direction::{Direction, Source};
use egui::{Key, KeyboardShortcut, Modifiers};
use glam::{Vec2, Vec3};
use studio_plugin::document::Edit;
use studio_plugin::{Command, Context};

use crate::comb;
use crate::exchange;
use crate::grain::{self, align, partners};
use crate::pattern::PickedEdge;
use crate::sheet::Sheet;
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
    command("align-partner", texts::PARTNER, texts::PARTNER_TIP),
    command("align-up", texts::UP, texts::AXIS_TIP),
    command("align-across", texts::ACROSS, texts::AXIS_TIP),
    command("align-forward", texts::FORWARD, texts::AXIS_TIP),
    keyed(command("copy", texts::COPY, texts::COPY_TIP), Modifiers::COMMAND, Key::C),
    keyed(command("paste", texts::PASTE, texts::PASTE_TIP), Modifiers::COMMAND, Key::V),
    command("paste-mirrored", texts::PASTE_MIRRORED, texts::PASTE_TIP),
    keyed(command("mirror", texts::MIRROR, texts::MIRROR_TIP), Modifiers::SHIFT, Key::M),
    command("reset", texts::RESET, texts::RESET_TIP),
    keyed(
        command("delete-stroke", comb_texts::DELETE_COMMAND, comb_texts::DELETE_TIP),
        Modifiers::NONE,
        Key::Delete,
    ),
    command("save-sheet", texts::SAVE, texts::SAVE_TIP),
    command(exchange::IMPORT, texts::IMPORT, texts::IMPORT_TIP),
    command(exchange::EXPORT, texts::EXPORT, texts::EXPORT_TIP),
];

/// The tool that draws strokes.
pub(crate) const COMB_TOOL: Command =
    keyed(command(comb::TOOL, comb_texts::TOOL, comb_texts::TOOL_TIP), Modifiers::NONE, Key::B);

/// What commands take from earlier ones.
#[derive(Debug, Default)]
pub(crate) struct Given {
    /// What was copied.
    copied: Option<Direction>,
    /// The edge that was clicked last.
    pub(crate) picked_edge: Option<PickedEdge>,
}

/// Whether a command can be run.
pub(crate) fn can_run(id: &str, sheet: &Sheet, given: &Given, studio: &Context<'_>) -> bool {
    let panels = || grain::picked(&sheet.garment, studio);
    match id {
        "paste" | "paste-mirrored" => given.copied.is_some(),
        "align-edge" => given.picked_edge.is_some(),
        "copy" => !studio.selection.panels.is_empty(),
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
        "align-edge" => align_edge(sheet, given.picked_edge.as_ref(), studio),
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
            let first = panels
                .first()
                .map(|&panel| grain::direction(&garment.panels[panel], studio.document.project()));
            given.copied = first;
        }
        "paste" => {
            if let Some(direction) = given.copied {
                grain::set(&panels, garment, studio, |_, _| Some(direction));
            }
        }
        "paste-mirrored" => {
            if let Some(direction) = given.copied {
                let angle = wrapped(PI - direction.angle);
                grain::set(&panels, garment, studio, |_, _| Some(Direction { angle, ..direction }));
            }
        }
        "mirror" => mirror(&panels, sheet, studio),
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
fn align_edge(sheet: &Sheet, picked: Option<&PickedEdge>, studio: &mut Context<'_>) {
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

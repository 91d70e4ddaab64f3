//! What can be done to a project.

use std::f32::consts::{PI, TAU};
use std::path::PathBuf;
use std::sync::Arc;

use amc_core::direction::Direction;
use amc_core::direction::comb::Comb;
use amc_core::mesh::Unit;
use amc_core::render::Laying;
use amc_core::{Error, Result};
use glam::Vec2;
use serde_json::Value;

use super::{Asset, ColourwayId, ColourwayLabel, FabricId, FabricInUse, PanelChoice, PanelPrint, Project};

/// One change of a project. Panels are named by their ids.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// Another garment, in metres until something else is said. What was chosen for panels stays, by their ids.
    SetGarment(Asset),
    /// What the numbers of the garment's file mean.
    SetUnit(Unit),
    /// One fabric more, at the end of those in use.
    AddFabric(FabricInUse),
    /// One fabric less: panels it was chosen for wear the default again, in all colourways.
    RemoveFabric(FabricId),
    /// The panels' fabric.
    SetFabric {
        /// The panels.
        panels: Vec<String>,
        /// None: plain grey.
        fabric: Option<FabricId>,
    },
    /// The panels' direction.
    SetDirection {
        /// The panels.
        panels: Vec<String>,
        /// None: along the grain.
        direction: Option<Direction>,
    },
    /// Each panel's direction turned from what it is now, combed or not; a quarter turn swaps warp and weft.
    TurnDirection {
        /// The panels, each with its direction now (which whoever knows the grain can say).
        panels: Vec<(String, Direction)>,
        /// Radians, counter-clockwise in the flat pattern.
        by: f32,
    },
    /// The strokes that comb a panel's direction.
    SetComb {
        /// The panel.
        panel: String,
        /// None: no strokes.
        comb: Option<Arc<Comb>>,
        /// What the person did, for the history: "Draw a stroke".
        what: String,
    },
    /// Whether the panels are drawn.
    SetVisible {
        /// The panels.
        panels: Vec<String>,
        /// Drawn, or hidden.
        visible: bool,
    },
    /// The panels' print.
    SetPrint {
        /// The panels.
        panels: Vec<String>,
        /// None: the fabric alone.
        print: Option<PanelPrint>,
    },
    /// How the panels' prints lie on the cloth. Panels without one stay without.
    LayPrint {
        /// The panels.
        panels: Vec<String>,
        /// The same for all.
        laying: Laying,
    },
    /// What a panel is called.
    RenamePanel {
        /// The panel.
        panel: String,
        /// None: as the garment calls it.
        name: Option<String>,
    },
    /// The group the panels are in.
    GroupPanels {
        /// The panels.
        panels: Vec<String>,
        /// None: in no group.
        group: Option<String>,
    },
    /// Two panels or more become one, which is known by the id of the first and looks as that does.
    MergePanels {
        /// The panels, each once.
        panels: Vec<String>,
        /// The strokes that comb it then.
        comb: Option<Arc<Comb>>,
    },
    /// A panel is cut in two; the halves look as it does.
    SplitPanel {
        /// The panel.
        panel: String,
        /// The ends of the cut, on its outline: in UVs.
        line: [Vec2; 2],
        /// Ids for the half on the left of the line (v up) and for the one on the right:
        /// [`Project::free_panel_ids`].
        into: [String; 2],
    },
    /// One colourway more, at the end: a copy of the worn one, and worn at once.
    AddColourway(ColourwayLabel),
    /// Another colourway is worn. Directions, strokes and what is hidden stay.
    WearColourway(ColourwayId),
    /// Another name for the colourway of this id.
    RenameColourway(ColourwayLabel),
    /// One colourway less, but for the only one. In place of the worn one the next is worn, or the last.
    RemoveColourway(ColourwayId),
    /// A colourway at another place in their order.
    MoveColourway {
        /// Which.
        colourway: ColourwayId,
        /// Where to, counted from 0; beyond the end: to the end.
        place: usize,
    },
    /// The notes, whole.
    SetNotes(String),
    /// What a plugin keeps with the project.
    SetPluginState {
        /// Its id.
        plugin: String,
        /// What the person did, for the history: "Paint a stroke".
        what: String,
        /// All that it keeps; null: nothing.
        state: Value,
    },
    /// Another asset in place of every use of a file: one that was moved, or is missing.
    Relocate {
        /// The file's path, as the project has it.
        old: PathBuf,
        /// What takes its place.
        new: Asset,
    },
}

impl Edit {
    /// `project` with this change, unchecked.
    ///
    /// # Errors
    /// The edit speaks of a fabric, a colourway or a file that `project` does not have, or of the only colourway.
    pub(super) fn apply(self, project: &mut Project) -> Result<()> {
        match self {
            Self::SetGarment(garment) => (project.garment, project.unit) = (garment, Unit::Metre),
            Self::SetUnit(unit) => project.unit = unit,
            Self::AddFabric(fabric) => project.fabrics.push(fabric),
            Self::RemoveFabric(id) => remove_fabric(project, id)?,
            Self::SetFabric { panels, fabric } => {
                choose(project, panels, |choice| choice.fabric = Some(fabric))
            }
            Self::SetDirection { panels, direction } => {
                choose(project, panels, |choice| choice.direction = direction);
            }
            Self::TurnDirection { panels, by } => {
                for (panel, now) in panels {
                    let turned = Direction { angle: wrapped(now.angle + by), ..now };
                    choose(project, vec![panel], |choice| {
                        choice.direction = Some(turned);
                        if let Some(comb) = &mut choice.comb {
                            let turn = wrapped(comb.turn + by);
                            Arc::make_mut(comb).turn = turn;
                        }
                    });
                }
            }
            Self::SetComb { panel, comb, .. } => {
                choose(project, vec![panel], |choice| choice.comb.clone_from(&comb));
            }
            Self::SetVisible { panels, visible } => {
                choose(project, panels, |choice| choice.visible = visible)
            }
            Self::SetPrint { panels, print } => {
                choose(project, panels, |choice| choice.print.clone_from(&print));
            }
            Self::LayPrint { panels, laying } => choose(project, panels, |choice| {
                if let Some(print) = &mut choice.print {
                    print.laying = laying;
                }
            }),
            Self::RenamePanel { panel, name: Some(name) } => {
                project.arrangement.names.insert(panel, name);
            }
            Self::RenamePanel { panel, name: None } => {
                project.arrangement.names.remove(&panel);
            }
            Self::GroupPanels { panels, group } => project.group(&panels, group),
            Self::MergePanels { panels, comb } => project.merge_panels(panels, comb),
            Self::SplitPanel { panel, line, into } => project.split_panel(panel, line, into),
            Self::AddColourway(label) => project.add_colourway(&label)?,
            Self::WearColourway(id) => project.wear(id)?,
            Self::RenameColourway(label) => project.rename_colourway(&label)?,
            Self::RemoveColourway(id) => project.remove_colourway(id)?,
            Self::MoveColourway { colourway, place } => project.move_colourway(colourway, place)?,
            Self::SetNotes(notes) => project.notes = notes,
            Self::SetPluginState { plugin, state: Value::Null, .. } => {
                project.plugins.remove(&plugin);
            }
            Self::SetPluginState { plugin, state, .. } => {
                project.plugins.insert(plugin, state);
            }
            Self::Relocate { old, new } => {
                let mut uses = project.assets_mut().filter(|asset| asset.path() == Some(&old)).peekable();
                if uses.peek().is_none() {
                    return Err(Error::invalid("the project does not use this file").in_file(&old));
                }
                uses.for_each(|asset| *asset = new.clone());
            }
        }
        Ok(())
    }
}

fn remove_fabric(project: &mut Project, id: FabricId) -> Result<()> {
    let Some(place) = project.fabrics.iter().position(|fabric| fabric.id == id) else {
        return Err(Error::invalid(format!("there is no fabric {} to remove", id.number())));
    };
    project.fabrics.remove(place);
    project.take_off_in_colourways(id);
    project.panels.retain(|_, choice| {
        if choice.fabric == Some(Some(id)) {
            choice.fabric = None;
        }
        *choice != PanelChoice::default()
    });
    Ok(())
}

/// Changes the choices of `panels`; a panel with none left is no longer listed.
fn choose(project: &mut Project, panels: Vec<String>, change: impl Fn(&mut PanelChoice)) {
    for panel in panels {
        let mut choice = project.panels.remove(&panel).unwrap_or_default();
        change(&mut choice);
        if choice != PanelChoice::default() {
            project.panels.insert(panel, choice);
        }
    }
}

/// The same angle within half a turn of 0; what is so already is not touched.
pub(super) fn wrapped(angle: f32) -> f32 {
    if angle.abs() <= PI { angle } else { (angle + PI).rem_euclid(TAU) - PI }
}

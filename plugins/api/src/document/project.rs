//! A project: plain data, and what must be true of it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use amc_core::direction::comb::Comb;
use amc_core::direction::{Direction, Field, Source};
use amc_core::mesh::{Arrangement, Panel, Unit};
use amc_core::{Error, Result};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Asset, Colourways, FabricId, FabricInUse, PanelPrint, ViewSettings};

/// What the person works on.
///
/// Panels are known by their ids ([`Panel::id`]); looks of panels that the garment does not have are kept, as the
/// garment may be exchanged and come back.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Project {
    /// The garment: a file, `garment:NAME` or `shape:NAME`.
    pub garment: Asset,
    /// What the numbers of the garment's file mean. (glTF demands metres; not every file obeys.)
    pub unit: Unit,
    /// The fabrics in use, in the order they were added. The first is worn wherever nobody has chosen.
    pub fabrics: Vec<FabricInUse>,
    /// What was chosen for each panel, by its id. A panel that is not listed is all as by default.
    pub panels: BTreeMap<String, PanelChoice>,
    /// What the person made of the garment's panels: merged, split, renamed.
    pub arrangement: Arrangement,
    /// Panels that the person put together, by the groups' names. A panel is in one group at most.
    pub groups: BTreeMap<String, BTreeSet<String>>,
    /// What else panels could wear, in place of the fabrics and prints in `panels`.
    pub colourways: Colourways,
    /// How it is looked at.
    pub view: ViewSettings,
    /// What plugins keep with the project, by their ids; at most [`Project::MOST_PLUGIN_STATE`] bytes each. That of plugins
    /// which are not there is kept too.
    pub plugins: BTreeMap<String, Value>,
    /// Whatever the person wrote down, at most [`Project::LONGEST_NOTES`] bytes.
    pub notes: String,
}

/// What was chosen for a panel; what was not chosen follows the default.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PanelChoice {
    /// Its fabric: `Some(None)` is plain grey, none is whatever is worn by default.
    pub fabric: Option<Option<FabricId>>,
    /// Its direction; none: along its grain.
    pub direction: Option<Direction>,
    /// The strokes that comb its direction.
    pub comb: Option<Arc<Comb>>,
    /// The print over its fabric.
    pub print: Option<PanelPrint>,
    /// Whether it is drawn.
    pub visible: bool,
}

impl Default for PanelChoice {
    fn default() -> Self {
        Self { fabric: None, direction: None, comb: None, print: None, visible: true }
    }
}

/// How a panel is to be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelLook {
    /// Its fabric; none: plain grey.
    pub fabric: Option<FabricId>,
    /// Its direction; none: along its grain ([`Direction::along_grain`]).
    pub direction: Option<Direction>,
    /// Whether it is drawn.
    pub visible: bool,
}

impl Default for Project {
    /// The bundled shirt in the bundled satin.
    fn default() -> Self {
        let satin = FabricInUse {
            id: FabricId::new(0),
            asset: Asset::Bundled("fabric:satin".to_owned()),
            name: "Satin".to_owned(),
        };
        Self {
            garment: Asset::Bundled("garment:shirt".to_owned()),
            unit: Unit::Metre,
            fabrics: vec![satin],
            panels: BTreeMap::new(),
            arrangement: Arrangement::default(),
            groups: BTreeMap::new(),
            colourways: Colourways::default(),
            plugins: BTreeMap::new(),
            view: ViewSettings::default(),
            notes: String::new(),
        }
    }
}

impl Project {
    /// The most fabrics a project may use.
    pub const MOST_FABRICS: usize = 4096;

    /// The most panels that may be listed.
    pub const MOST_PANELS: usize = 65_536;

    /// The most plugins that may keep something.
    pub const MOST_PLUGINS: usize = 256;

    /// The most that a plugin may keep, bytes of JSON.
    pub const MOST_PLUGIN_STATE: usize = 1 << 20;

    /// The longest notes, bytes.
    pub const LONGEST_NOTES: usize = 1 << 20;

    /// The longest name of a fabric or a colourway and the longest panel id, bytes.
    pub const LONGEST_NAME: usize = 1024;

    /// The look of the panel of this id, as cloth: where nobody has chosen it wears the first fabric, along its grain,
    /// and is visible. For a panel at hand use [`Project::look_of`], which knows buttons from cloth.
    pub fn look(&self, panel: &str) -> PanelLook {
        self.look_or(panel, self.fabrics.first().map(|fabric| fabric.id))
    }

    /// The look of `panel`. One that takes no fabric ([`Panel::takes_fabric`]) is plain grey until a fabric is chosen for
    /// it.
    pub fn look_of(&self, panel: &Panel) -> PanelLook {
        match panel.takes_fabric {
            true => self.look(&panel.id),
            false => self.look_or(&panel.id, None),
        }
    }

    fn look_or(&self, panel: &str, fabric: Option<FabricId>) -> PanelLook {
        match self.panels.get(panel) {
            Some(choice) => PanelLook {
                fabric: choice.fabric.unwrap_or(fabric),
                direction: choice.direction,
                visible: choice.visible,
            },
            None => PanelLook { fabric, direction: None, visible: true },
        }
    }

    /// The strokes that comb the panel of this id.
    pub fn comb(&self, panel: &str) -> Option<&Arc<Comb>> {
        self.panels.get(panel)?.comb.as_ref()
    }

    /// The print on the panel of this id.
    pub fn print(&self, panel: &str) -> Option<&PanelPrint> {
        self.panels.get(panel)?.print.as_ref()
    }

    /// The fabric of this id.
    pub fn fabric(&self, id: FabricId) -> Option<&FabricInUse> {
        self.fabrics.iter().find(|fabric| fabric.id == id)
    }

    /// An id that no fabric has: one above the largest.
    pub fn free_fabric_id(&self) -> FabricId {
        let used: BTreeSet<u32> = self.fabrics.iter().map(|fabric| fabric.id.number()).collect();
        let above = used.last().map_or(Some(0), |last| last.checked_add(1));
        // Only a file made by hand gets that far.
        let gap = || (0..=u32::MAX).find(|number| !used.contains(number));
        FabricId::new(above.or_else(gap).unwrap_or_default())
    }

    /// Every asset: the garment, then the fabrics', then the prints' of all colourways, the worn one's first (one that is on
    /// several panels is there as often).
    pub fn assets(&self) -> impl Iterator<Item = &Asset> {
        let prints = self.panels.values().filter_map(|choice| choice.print.as_ref());
        let kept = self.colourways.kept().flat_map(|colourway| colourway.panels.values());
        let kept = kept.filter_map(|wear| wear.print.as_ref());
        std::iter::once(&self.garment)
            .chain(self.fabrics.iter().map(|fabric| &fabric.asset))
            .chain(prints.chain(kept).map(|print| &print.picture))
    }

    /// Every asset, to be replaced.
    pub fn assets_mut(&mut self) -> impl Iterator<Item = &mut Asset> {
        let prints = self.panels.values_mut().filter_map(|choice| choice.print.as_mut());
        let kept = self.colourways.kept_mut().flat_map(|colourway| colourway.panels.values_mut());
        let kept = kept.filter_map(|wear| wear.print.as_mut());
        std::iter::once(&mut self.garment)
            .chain(self.fabrics.iter_mut().map(|fabric| &mut fabric.asset))
            .chain(prints.chain(kept).map(|print| &mut print.picture))
    }

    /// Checks what must be true of every project: assets that can be what they are used as, fabrics with names and ids of
    /// their own, colourways likewise, chosen fabrics that are in use, directions that are numbers, a view that makes sense, and the limits above.
    ///
    /// # Errors
    /// The first thing that is not so, and where.
    pub fn check(&self) -> Result<()> {
        self.garment.check_garment().map_err(|error| error.at_element("garment"))?;
        self.check_fabrics()?;
        self.check_panels()?;
        self.check_arrangement()?;
        self.check_colourways()?;
        self.check_plugins()?;
        self.view.check()?;
        if self.notes.len() > Self::LONGEST_NOTES {
            return Err(Error::too_large(format!(
                "the notes are longer than {} KiB: keep the rest in a file beside the project",
                Self::LONGEST_NOTES >> 10
            ))
            .at_element("notes"));
        }
        Ok(())
    }

    fn check_fabrics(&self) -> Result<()> {
        if self.fabrics.len() > Self::MOST_FABRICS {
            let what = format!("a project may use {} fabrics: remove some", Self::MOST_FABRICS);
            return Err(Error::too_large(what).at_element("fabrics"));
        }
        let mut ids = BTreeSet::new();
        for (k, fabric) in self.fabrics.iter().enumerate() {
            let place = |error: Error| error.at_element(format!("fabrics[{k}]"));
            fabric.asset.check_fabric().map_err(place)?;
            check_name(&fabric.name, "the fabric's name").map_err(place)?;
            if !ids.insert(fabric.id) {
                let what = format!("another fabric has the id {} too", fabric.id.number());
                return Err(place(Error::invalid(what)));
            }
        }
        Ok(())
    }

    fn check_plugins(&self) -> Result<()> {
        if self.plugins.len() > Self::MOST_PLUGINS {
            let what = format!("more than {} plugins keep something", Self::MOST_PLUGINS);
            return Err(Error::too_large(what).at_element("plugins"));
        }
        for (plugin, state) in &self.plugins {
            check_name(plugin, "the plugin's id").map_err(|error| error.at_element("plugins"))?;
            if json_bytes(state) > Self::MOST_PLUGIN_STATE {
                let what = format!("it keeps more than {} KiB", Self::MOST_PLUGIN_STATE >> 10);
                return Err(Error::too_large(what).at_element(format!("plugins.{plugin}")));
            }
        }
        Ok(())
    }

    fn check_panels(&self) -> Result<()> {
        check_count(self.panels.len()).map_err(|error| error.at_element("panels"))?;
        let fabrics = self.fabric_ids();
        for (panel, choice) in &self.panels {
            let place = |error: Error| error.at_element(format!("panels.{panel}"));
            check_name(panel, "the panel's id").map_err(|error| error.at_element("panels"))?;
            check_wear(choice.fabric, choice.print.as_ref(), &fabrics).map_err(place)?;
            if choice.direction.is_some_and(|direction| !is_finite(direction)) {
                return Err(place(Error::invalid("its direction is not a finite number")));
            }
            choice.comb.as_ref().map_or(Ok(()), |comb| comb.check()).map_err(place)?;
        }
        Ok(())
    }

    fn check_colourways(&self) -> Result<()> {
        if self.colourways.count() > Colourways::MOST {
            let what = format!("a project may have {} colourways: remove some", Colourways::MOST);
            return Err(Error::too_large(what).at_element("colourways"));
        }
        let fabrics = self.fabric_ids();
        let (mut ids, mut names) = (BTreeSet::new(), BTreeSet::new());
        for (k, (label, kept)) in self.colourways.all().enumerate() {
            let place = |error: Error| error.at_element(format!("colourways[{k}]"));
            check_name(&label.name, "the colourway's name").map_err(place)?;
            if !ids.insert(label.id) {
                let what = format!("another colourway has the id {} too", label.id.number());
                return Err(place(Error::invalid(what)));
            }
            if !names.insert(&label.name) {
                return Err(place(Error::invalid(format!(
                    "another colourway is called '{}' too",
                    label.name
                ))));
            }
            let Some(panels) = kept else { continue };
            check_count(panels.len()).map_err(place)?;
            for (panel, wear) in panels {
                let place = |error: Error| error.at_element(format!("colourways[{k}].panels.{panel}"));
                check_name(panel, "the panel's id").map_err(place)?;
                check_wear(wear.fabric, wear.print.as_ref(), &fabrics).map_err(place)?;
            }
        }
        Ok(())
    }

    fn fabric_ids(&self) -> BTreeSet<FabricId> {
        self.fabrics.iter().map(|fabric| fabric.id).collect()
    }

    /// About how much memory it takes, bytes: what its strings hold, and each entry with what a tree spends on it.
    pub(super) fn bytes(&self) -> usize {
        let asset = |asset: &Asset| match asset {
            Asset::Bundled(name) => name.len(),
            Asset::File { path, content } => path.as_os_str().len() + content.as_ref().map_or(0, String::len),
        };
        let fabrics = self.fabrics.iter().map(|fabric| size_of::<FabricInUse>() + fabric.name.len());
        let entry = size_of::<(String, PanelChoice)>();
        // Nodes of the tree are at least half full.
        let strokes = |choice: &PanelChoice| choice.comb.as_ref().map_or(0, |comb| comb.bytes());
        let panels = self.panels.iter().map(|(id, choice)| 2 * entry + id.len() + strokes(choice));
        size_of::<Self>()
            + self.assets().map(asset).sum::<usize>()
            + fabrics.sum::<usize>()
            + panels.sum::<usize>()
            + self.colourways.bytes()
            + self.plugins.iter().map(|(id, state)| id.len() + json_bytes(state)).sum::<usize>()
            + self.arrangement_bytes()
            + self.notes.len()
    }
}

/// About how long a value is as JSON, and how much memory it takes, bytes.
fn json_bytes(value: &Value) -> usize {
    match value {
        Value::Null | Value::Bool(_) | Value::Number(_) => 16,
        Value::String(text) => 16 + text.len(),
        Value::Array(values) => 16 + values.iter().map(json_bytes).sum::<usize>(),
        Value::Object(entries) => {
            16 + entries.iter().map(|(key, value)| 16 + key.len() + json_bytes(value)).sum::<usize>()
        }
    }
}

fn check_count(panels: usize) -> Result<()> {
    if panels > Project::MOST_PANELS {
        return Err(Error::too_large(format!("more than {} panels are listed", Project::MOST_PANELS)));
    }
    Ok(())
}

/// What a panel may wear, with these fabrics in use.
fn check_wear(
    fabric: Option<Option<FabricId>>,
    print: Option<&PanelPrint>,
    fabrics: &BTreeSet<FabricId>,
) -> Result<()> {
    if let Some(Some(id)) = fabric
        && !fabrics.contains(&id)
    {
        let what = format!("it wears fabric {}, which is not among the fabrics in use", id.number());
        return Err(Error::invalid(what));
    }
    print.map_or(Ok(()), PanelPrint::check)
}

pub(super) fn check_name(name: &str, what: &str) -> Result<()> {
    if name.trim().is_empty() {
        return Err(Error::invalid(format!("{what} is empty")));
    }
    if name.len() > Project::LONGEST_NAME {
        return Err(Error::too_large(format!("{what} is longer than {} bytes", Project::LONGEST_NAME)));
    }
    Ok(())
}

fn is_finite(direction: Direction) -> bool {
    let field = match direction.source {
        Source::Gradient | Source::Yarn => true,
        Source::Field(Field::Around { origin, direction }) => origin.is_finite() && direction.is_finite(),
        Source::Field(Field::Along { direction }) => direction.is_finite(),
        Source::Field(Field::Radial { origin }) => origin.is_finite(),
    };
    field && direction.angle.is_finite()
}

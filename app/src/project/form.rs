//! How a project looks in its file, version 1. Directions are in degrees there, as people read and write it.

mod colourways;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use amc_core::Result;
use amc_core::direction::comb::Comb;
use amc_core::direction::{Direction, Source};
use amc_core::mesh::{Arrangement, Rearrangement, Unit};
use amc_core::render::Laying;
use glam::Vec2;
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use studio_plugin::document::{
    Asset, ColourwayId, FabricId, FabricInUse, PanelChoice, PanelPrint, Project, ViewSettings,
};

use self::colourways::ColourwayForm;
use super::paths;

/// A `.amcproj`. Every key is always written, but for those of panels' names, groups and changes where there are none; any but
/// the version may be left out.
#[derive(Debug, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct ProjectForm {
    version: u32,
    garment: AssetForm,
    unit: Unit,
    fabrics: Vec<FabricForm>,
    panels: BTreeMap<String, PanelForm>,
    /// What the garment's panels were merged and split to, one after the other.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    changes: Vec<Rearrangement>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    names: BTreeMap<String, String>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    groups: BTreeMap<String, BTreeSet<String>>,
    /// None: a single one, called as by default.
    colourways: Vec<ColourwayForm>,
    /// None: the first.
    worn_colourway: Option<ColourwayId>,
    plugins: BTreeMap<String, Value>,
    view: ViewSettings,
    notes: String,
}

impl Default for ProjectForm {
    fn default() -> Self {
        let Project { garment, view, notes, .. } = Project::default();
        let garment = AssetForm::Named(match garment {
            Asset::Bundled(name) => name,
            Asset::File { .. } => String::new(),
        });
        let plugins = BTreeMap::new();
        Self {
            version: super::VERSION,
            garment,
            unit: Unit::Metre,
            fabrics: Vec::new(),
            panels: BTreeMap::new(),
            changes: Vec::new(),
            names: BTreeMap::new(),
            groups: BTreeMap::new(),
            colourways: Vec::new(),
            worn_colourway: None,
            plugins,
            view,
            notes,
        }
    }
}

/// A bundled asset by its name, a file by its path and what it holds.
#[derive(Debug, Serialize, Deserialize)]
#[serde(untagged, expecting = "an asset is a name in quotes or {\"path\": ..., \"content\": ...}")]
enum AssetForm {
    Named(String),
    File {
        path: String,
        #[serde(default)]
        content: Option<String>,
    },
}

#[derive(Debug, Serialize, Deserialize)]
struct FabricForm {
    id: FabricId,
    /// After its asset, where it is left out.
    #[serde(default)]
    name: String,
    asset: AssetForm,
}

#[derive(Debug, Serialize, Deserialize)]
struct PanelForm {
    /// Left out: as by default. Null: plain grey.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    fabric: Option<Option<FabricId>>,
    #[serde(default)]
    direction: Option<DirectionForm>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    comb: Option<Comb>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    print: Option<PrintForm>,
    #[serde(default = "yes")]
    visible: bool,
}

/// A picture over a fabric. Lengths are in metres.
#[derive(Debug, Serialize, Deserialize)]
struct PrintForm {
    picture: AssetForm,
    width: f32,
    #[serde(default)]
    turn_deg: f64,
    #[serde(default)]
    shift: Vec2,
    #[serde(default = "yes")]
    repeated: bool,
}

/// Null is a value, too.
fn present<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Option<FabricId>>, D::Error> {
    Option::deserialize(from).map(Some)
}

fn yes() -> bool {
    true
}

#[derive(Debug, Serialize, Deserialize)]
struct DirectionForm {
    #[serde(default)]
    source: Source,
    angle_deg: f64,
}

impl ProjectForm {
    /// `project` as it is written in `folder`, or apart from any.
    pub(super) fn new(project: &Project, folder: Option<&Path>) -> Result<Self> {
        let fabrics = project.fabrics.iter().map(|fabric| {
            let FabricInUse { id, asset, name } = fabric;
            Ok(FabricForm { id: *id, name: name.clone(), asset: AssetForm::new(asset, folder)? })
        });
        let panels = project.panels.iter().map(|(id, choice)| {
            let direction = choice.direction.map(DirectionForm::new);
            let print = choice.print.as_ref().map(|print| PrintForm::new(print, folder)).transpose()?;
            let comb = choice.comb.as_deref().cloned();
            let PanelChoice { fabric, visible, .. } = *choice;
            Ok((id.clone(), PanelForm { fabric, direction, comb, print, visible }))
        });
        Ok(Self {
            version: super::VERSION,
            garment: AssetForm::new(&project.garment, folder)?,
            unit: project.unit,
            fabrics: fabrics.collect::<Result<_>>()?,
            panels: panels.collect::<Result<_>>()?,
            changes: project.arrangement.changes.clone(),
            names: project.arrangement.names.clone(),
            groups: project.groups.clone(),
            colourways: colourways::written(&project.colourways, folder)?,
            worn_colourway: Some(project.colourways.worn().id),
            plugins: project.plugins.clone(),
            view: project.view.clone(),
            notes: project.notes.clone(),
        })
    }

    /// The project that is meant, unchecked, in `folder`.
    ///
    /// # Errors
    /// The worn colourway is not there, or lists panels of its own.
    pub(super) fn into_project(self, folder: Option<&Path>) -> Result<Project> {
        let fabrics = self.fabrics.into_iter().map(|FabricForm { id, name, asset }| {
            let asset = asset.into_asset(folder);
            let name = if name.is_empty() { asset.name() } else { name };
            FabricInUse { id, asset, name }
        });
        let panels = self.panels.into_iter().map(|(id, form)| {
            let PanelForm { fabric, direction, comb, print, visible } = form;
            let direction = direction.map(DirectionForm::into_direction);
            let print = print.map(|print| print.into_print(folder));
            (id, PanelChoice { fabric, direction, comb: comb.map(Arc::new), print, visible })
        });
        Ok(Project {
            garment: self.garment.into_asset(folder),
            unit: self.unit,
            fabrics: fabrics.collect(),
            panels: panels.collect(),
            arrangement: Arrangement { changes: self.changes, names: self.names },
            groups: self.groups,
            colourways: colourways::meant(self.colourways, self.worn_colourway, folder)?,
            plugins: self.plugins,
            view: self.view,
            notes: self.notes,
        })
    }
}

impl AssetForm {
    fn new(asset: &Asset, folder: Option<&Path>) -> Result<Self> {
        Ok(match asset {
            Asset::Bundled(name) => Self::Named(name.clone()),
            Asset::File { path, content } => {
                Self::File { path: paths::written(path, folder)?, content: content.clone() }
            }
        })
    }

    fn into_asset(self, folder: Option<&Path>) -> Asset {
        let file = |path: &str, content| Asset::File { path: paths::meant(path, folder), content };
        match self {
            Self::Named(name) => match Asset::named(&name) {
                Asset::File { .. } => file(&name, None),
                bundled @ Asset::Bundled(_) => bundled,
            },
            Self::File { path, content } => file(&path, content),
        }
    }
}

impl DirectionForm {
    fn new(direction: Direction) -> Self {
        Self { source: direction.source, angle_deg: short_degrees(direction.angle) }
    }

    fn into_direction(self) -> Direction {
        Direction { source: self.source, angle: self.angle_deg.to_radians() as f32 }
    }
}

impl PrintForm {
    fn new(print: &PanelPrint, folder: Option<&Path>) -> Result<Self> {
        let Laying { width, turn, shift, is_repeated } = print.laying;
        let picture = AssetForm::new(&print.picture, folder)?;
        Ok(Self { picture, width, turn_deg: short_degrees(turn), shift, repeated: is_repeated })
    }

    fn into_print(self, folder: Option<&Path>) -> PanelPrint {
        let Self { picture, width, turn_deg, shift, repeated } = self;
        let turn = turn_deg.to_radians() as f32;
        let laying = Laying { width, turn, shift, is_repeated: repeated };
        PanelPrint { picture: picture.into_asset(folder), laying }
    }
}

/// The degrees of the fewest decimals that are this angle again when they are read.
fn short_degrees(radians: f32) -> f64 {
    let exact = f64::from(radians).to_degrees();
    let rounded = |decimals: i32| {
        let scale = 10_f64.powi(decimals);
        (exact * scale).round() / scale
    };
    let is_same = |degrees: &f64| degrees.to_radians() as f32 == radians;
    (0..12).map(rounded).find(is_same).unwrap_or(exact)
}

//! How colourways look in a project's file: a list in their order, and the id of the worn one, whose panels' fabrics and
//! prints are with the project's `panels`.

use std::collections::BTreeMap;
use std::path::Path;

use amc_core::Result;
use serde::{Deserialize, Serialize};
use studio_plugin::document::{Colourway, ColourwayId, ColourwayLabel, Colourways, FabricId, PanelWear};

use super::{PrintForm, present};

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ColourwayForm {
    id: ColourwayId,
    name: String,
    /// Left out: all as by default. Of the worn one always.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    panels: BTreeMap<String, WearForm>,
}

/// What a panel wears; the keys are those of a project's panel.
#[derive(Debug, Serialize, Deserialize)]
struct WearForm {
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    fabric: Option<Option<FabricId>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    print: Option<PrintForm>,
}

/// `colourways` as they are written in `folder`.
pub(super) fn written(colourways: &Colourways, folder: Option<&Path>) -> Result<Vec<ColourwayForm>> {
    let panel = |(id, wear): (&String, &PanelWear)| {
        let print = wear.print.as_ref().map(|print| PrintForm::new(print, folder)).transpose()?;
        Ok((id.clone(), WearForm { fabric: wear.fabric, print }))
    };
    let form = |(label, kept): (&ColourwayLabel, Option<&BTreeMap<String, PanelWear>>)| {
        let panels = kept.into_iter().flatten().map(panel).collect::<Result<_>>()?;
        Ok(ColourwayForm { id: label.id, name: label.name.clone(), panels })
    };
    colourways.all().map(form).collect()
}

/// The colourways that are meant, unchecked.
///
/// # Errors
/// `worn` is none of them, or lists panels of its own.
pub(super) fn meant(
    forms: Vec<ColourwayForm>,
    worn: Option<ColourwayId>,
    folder: Option<&Path>,
) -> Result<Colourways> {
    let panel = |(id, WearForm { fabric, print }): (String, WearForm)| {
        (id, PanelWear { fabric, print: print.map(|print| print.into_print(folder)) })
    };
    let colourway = |ColourwayForm { id, name, panels }| Colourway {
        label: ColourwayLabel { id, name },
        panels: panels.into_iter().map(panel).filter(|(_, wear)| *wear != PanelWear::default()).collect(),
    };
    let list = forms.into_iter().map(colourway).collect();
    Colourways::new(list, worn).map_err(|error| error.at_element("colourways"))
}

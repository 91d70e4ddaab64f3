//! `--show`: what is seen over the cloth.

use std::str::FromStr;
use std::sync::Arc;

use amc_core::mesh::{Garment, Panel};
use amc_core::render::{Cloth, Drawing};
use amc_core::{Error, Progress, Result};
use studio_plugin::document::Project;
use tangent_editor::seeing::{Asked, Cut, ENLARGEMENTS, Settings, Show, seen};

use crate::scene::PanelLook;

/// What is shown, and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShowChoice {
    show: Show,
    settings: Settings,
}

impl FromStr for ShowChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, times) = text.split_once('=').map_or((text, None), |(name, times)| (name, Some(times)));
        let Some(show) = Show::ALL.into_iter().find(|show| show.id() == name) else {
            return Err(format!("'{name}' is none of {}", Show::ALL.map(Show::id).join(", ")));
        };
        let mut settings = Settings::default();
        match times.map(str::parse) {
            None => {}
            Some(Ok(times)) if show == Show::Weave && ENLARGEMENTS.contains(&times) => {
                settings.weave.enlargement = times;
            }
            Some(_) => {
                return Err(format!(
                    "only weave takes a number, from {} to {}",
                    ENLARGEMENTS.start(),
                    ENLARGEMENTS.end()
                ));
            }
        }
        Ok(Self { show, settings })
    }
}

impl ShowChoice {
    /// Lays it over a drawing of `garment`.
    pub(super) fn over(
        self,
        (garment, project): (&Garment, Option<&Project>),
        looks: &[PanelLook],
        drawing: &Drawing,
        progress: &Progress<'_>,
    ) -> Result<Drawing> {
        let is_combed = |panel: &Panel| project.is_some_and(|it| it.comb(&panel.id).is_some());
        let cut = |(look, panel): (&PanelLook, &Panel)| Cut {
            direction: look.direction,
            is_combed: is_combed(panel),
        };
        let asked = Asked {
            garment: Arc::new(garment.clone()),
            vectors: Arc::clone(&drawing.tangents),
            cuts: looks.iter().zip(&garment.panels).map(cut).collect(),
            show: self.show,
            settings: self.settings,
        };
        let seen = seen(&asked, None, progress)?;
        if seen.panels.iter().all(Option::is_none) {
            return Err(Error::unsupported(
                "the garment has no flat pattern (UVs): nothing can be shown over its cloth",
            ));
        }
        drawing.in_cloths(|panel, _| {
            seen.panels
                .get(panel)
                .and_then(Option::as_ref)
                .map_or(Cloth::Plain, |seen| Cloth::Covered(seen.laid.clone()))
        })
    }
}

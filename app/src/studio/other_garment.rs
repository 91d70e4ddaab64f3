//! Another garment for a project in which something was chosen for panels: read first, and asked about where it has not all of them.

use std::collections::BTreeSet;
use std::sync::Arc;

use amc_core::Result;
use amc_core::mesh::{Garment, Unit};
use studio_plugin::document::{Asset, PanelChoice, Project};
use studio_plugin::{Job, Jobs};

use super::texts::{files as words, notices, panels as parts};
use crate::scene::{asset_path, load_garment};

/// A garment that is to be opened.
#[derive(Debug)]
pub(super) struct OtherGarment {
    pub(super) asset: Asset,
    /// While it is being read.
    job: Option<Job<Read>>,
    /// Once it is read: as its file has it.
    pub(super) garment: Option<Arc<Garment>>,
    /// The panels that it has not, and what was chosen for each.
    pub(super) lost: Vec<String>,
}

#[derive(Debug)]
struct Read {
    as_cut: Arc<Garment>,
    /// Those of its panels, arranged as the project says.
    ids: BTreeSet<String>,
}

/// Whether something was chosen for a panel that could be missed.
pub(super) fn has_choices(project: &Project) -> bool {
    project.panels.values().any(|choice| !chosen(choice).is_empty())
}

impl OtherGarment {
    /// Starts to read it.
    pub(super) fn new(asset: Asset, project: &Project, jobs: &mut Jobs) -> Self {
        let (file, arrangement) = (asset.clone(), project.arrangement.clone());
        let read = move |_: &amc_core::Progress<'_>| {
            let as_cut = Arc::new(load_garment(&asset_path(&file), Unit::Metre)?);
            let ids = |garment: &Garment| garment.panels.iter().map(|panel| panel.id.clone()).collect();
            let ids = match arrangement.changes.is_empty() {
                true => ids(&as_cut),
                false => ids(&Garment::clone(&as_cut).arranged(&arrangement).0),
            };
            Ok(Read { as_cut, ids })
        };
        let job = Some(jobs.start(notices::opening(asset.name()), read));
        Self { asset, job, garment: None, lost: Vec::new() }
    }

    pub(super) fn is_being_read(&self) -> bool {
        self.job.is_some()
    }

    /// Whether it has just been read; `on_stage` is the garment that it would take the place of.
    ///
    /// # Errors
    /// It cannot be read.
    pub(super) fn poll(&mut self, project: &Project, on_stage: Option<&Garment>) -> Result<bool> {
        let Some(result) = self.job.as_ref().and_then(Job::poll) else { return Ok(false) };
        self.job = None;
        let Read { as_cut, ids } = result?;
        self.lost = lost(project, on_stage, &ids);
        self.garment = Some(as_cut);
        Ok(true)
    }
}

/// What was chosen for panels that are on stage now, and not among `ids`.
fn lost(project: &Project, on_stage: Option<&Garment>, ids: &BTreeSet<String>) -> Vec<String> {
    let panel = |id: &String| on_stage.and_then(|it| it.panels.iter().find(|panel| panel.id == *id));
    let is_lost = |id: &String| !ids.contains(id) && (on_stage.is_none() || panel(id).is_some());
    let chosen = project.panels.iter().filter(|(id, _)| is_lost(id)).map(|(id, choice)| (id, chosen(choice)));
    let named = |id: &String| panel(id).map_or(id.clone(), |panel| project.panel_name(panel).to_owned());
    chosen.filter(|it| !it.1.is_empty()).map(|(id, what)| parts::of_panel(&named(id), &what)).collect()
}

fn chosen(choice: &PanelChoice) -> Vec<String> {
    let strokes = choice.comb.as_ref().map_or(0, |comb| comb.strokes.len());
    let all = [
        choice.fabric.map(|_| words::ITS_FABRIC.to_owned()),
        choice.direction.map(|direction| parts::its_angle(direction.angle.to_degrees())),
        (strokes > 0).then(|| parts::its_strokes(strokes, strokes)),
        choice.print.as_ref().map(|_| parts::ITS_PRINT.to_owned()),
    ];
    all.into_iter().flatten().collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use amc_core::direction::Direction;
    use studio_plugin::document::FabricId;

    #[test]
    fn what_no_panel_would_have_is_named_with_its_panel() {
        let garment = Garment::new(amc_core::shape::mesh("sheet").unwrap()).unwrap();
        let here = garment.panels[0].id.clone();
        let mut project = Project::default();
        assert!(!has_choices(&project));
        let direction = Some(Direction { angle: 0.5, ..Direction::default() });
        let choice =
            PanelChoice { fabric: Some(Some(FabricId::new(0))), direction, ..PanelChoice::default() };
        project.panels.insert(here.clone(), choice.clone());
        project.panels.insert("of another garment".to_owned(), choice);
        project.arrangement.names.insert(here.clone(), "Laken".to_owned());
        assert!(has_choices(&project));
        let said = lost(&project, Some(&garment), &BTreeSet::new());
        assert_eq!(said, ["Laken: its fabric, its angle (28.6\u{b0})"]);
        assert!(lost(&project, Some(&garment), &[here].into()).is_empty());
        assert_eq!(lost(&project, None, &BTreeSet::new()).len(), 2, "nothing is on stage to tell them apart");
    }
}

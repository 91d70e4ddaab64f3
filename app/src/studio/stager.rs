//! From the document to what is drawn, in jobs: garment and fabrics loaded, directions and vertices made.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::path::Path;
use std::sync::Arc;

use amc_core::Result;
use amc_core::amc::Amc;
use amc_core::direction::{Direction, Fineness, KeptTangents};
use amc_core::mesh::{Arrangement, Garment, Picker, Rearrangement, Unit};
use amc_core::render::{Bounds, Cloth, Drawing, Print};
use eframe::egui::ColorImage;
use studio_plugin::document::{Asset, ColourwayId, FabricId, Project};
use studio_plugin::{Cover, Directions, Job, Jobs, Notices, Registry, Stage};

use super::texts::notices as words;
use super::thumbnail;
use crate::scene::{
    Outfit, asset_path, document_looks, dressed, load_fabric, load_garment, load_print, vertex_occlusion,
    worn_prints,
};

/// How large things are that people wear or lay out, metres.
const LIKELY_SIZES: std::ops::RangeInclusive<f64> = 0.05..=8.0;

/// Keeps what is drawn in step with the document.
#[derive(Debug, Default)]
pub(super) struct Stager {
    pub(super) stage: Stage,
    /// What is drawn.
    pub(super) drawn: Drawn,
    /// What is drawn right of the divider of a split view, where that is not the same.
    pub(super) compared: Drawn,
    /// What is drawn, with what lies over it.
    covered: Option<Covered>,
    garment: Loading<Wanted, Loaded>,
    /// The garment as its file has it, so that panels are arranged without reading it again.
    as_cut: Option<AsCut>,
    /// What darkens the folds takes longest, and comes when the garment is seen already.
    shaded: Option<Job<Arc<Drawing>>>,
    fabrics: BTreeMap<FabricId, Loading<Asset, (Arc<Amc>, ColorImage)>>,
    /// Those that were begun; none: done.
    prints: HashMap<Asset, Option<Job<Arc<Print>>>>,
    loaded: Option<Loaded>,
}

/// What a garment on stage is made of: where it is, its unit, and what became of its panels. Their names are no part of it.
type Wanted = ((Asset, Unit), Vec<Rearrangement>);

/// A garment as its file has it.
#[derive(Debug, Clone)]
struct AsCut {
    of: (Asset, Unit),
    garment: Arc<Garment>,
    /// Whether what is odd about it was said.
    is_told: bool,
}

/// A drawing under a cover.
#[derive(Debug)]
struct Covered {
    of: Arc<Drawing>,
    cover: Arc<Cover>,
    drawing: Arc<Drawing>,
}

/// A drawing, made anew when its recipe changes.
#[derive(Debug, Default)]
pub(super) struct Drawn {
    /// The drawing, and to pick panels in it.
    pub(super) latest: Option<(Arc<Drawing>, Arc<Picker>)>,
    directions: Option<Directions>,
    job: Option<Job<Made>>,
    /// What it was last made of, or is being made of.
    of: Option<Recipe>,
    /// The tangents; none while a job has them.
    kept: Option<KeptTangents>,
    /// Whether strokes are followed nearly as yet, and the rest is to come.
    is_preview: bool,
}

/// What a job made of a recipe.
#[derive(Debug)]
struct Made {
    kept: KeptTangents,
    drawing: Result<Drawing>,
    is_preview: bool,
}

/// Something that is loaded once, until it is to be something else.
#[derive(Debug)]
struct Loading<K, T> {
    wanted: Option<K>,
    job: Option<Job<T>>,
}

impl<K, T> Default for Loading<K, T> {
    fn default() -> Self {
        Self { wanted: None, job: None }
    }
}

/// A garment with what is reckoned from it alone.
#[derive(Debug, Clone)]
struct Loaded {
    as_cut: Arc<Garment>,
    garment: Arc<Garment>,
    /// What there is to say of it.
    notices: Vec<String>,
    /// All panels plain: what the drawings of it share.
    plain: Arc<Drawing>,
    picker: Arc<Picker>,
    pieces: Vec<Arc<ColorImage>>,
}

/// Everything a drawing follows from: equal recipes make equal drawings.
#[derive(Debug, Clone)]
struct Recipe {
    loaded: Loaded,
    outfit: Outfit,
}

impl PartialEq for Recipe {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.loaded.plain, &other.loaded.plain) && self.outfit == other.outfit
    }
}

impl Stager {
    /// With the shading modes of the studio and of all plugins.
    pub(super) fn new(registry: &Registry) -> Self {
        let mut stager = Self::default();
        let own = registry.plugins().iter().flat_map(|plugin| plugin.plugin().shading_modes());
        stager.stage.modes.extend(own);
        stager
    }

    /// Starts what is to be done and takes in what is done. To be called once a frame.
    pub(super) fn update(&mut self, project: &Project, jobs: &mut Jobs, notices: &mut Notices) {
        self.update_garment(project, jobs, notices);
        self.update_fabrics(project, jobs, notices);
        self.update_prints(project, jobs, notices);
        self.update_drawings(project, jobs, notices);
        self.stage.directions.clone_from(&self.drawn.directions);
    }

    /// Takes in a garment that was read already, for when the document asks for it.
    pub(super) fn offer(&mut self, asset: Asset, unit: Unit, garment: Arc<Garment>) {
        self.as_cut = Some(AsCut { of: (asset, unit), garment, is_told: false });
    }

    /// Lays a cover over what is drawn from now on; none: nothing lies over it.
    pub(super) fn cover(&mut self, cover: Option<Arc<Cover>>) {
        let cover = cover.filter(|cover| {
            self.drawn.directions.as_ref().is_some_and(|it| Arc::ptr_eq(&it.garment, &cover.garment))
        });
        self.covered = match (cover, &self.drawn.latest, self.covered.take()) {
            (Some(cover), Some((of, _)), Some(known))
                if Arc::ptr_eq(&known.of, of) && Arc::ptr_eq(&known.cover, &cover) =>
            {
                Some(known)
            }
            (Some(cover), Some((of, _)), _) => Covered::new(of, cover),
            _ => None,
        };
    }

    /// What is to be seen: left of the divider of a split view, and right of it where that is not the same.
    pub(super) fn shown(&self) -> Option<Shown> {
        let (plain, picker) = self.drawn.latest.clone()?;
        let compared = self.compared.latest.as_ref().map(|(drawing, _)| Arc::clone(drawing));
        Some(match &self.covered {
            Some(covered) => {
                Shown { drawing: Arc::clone(&covered.drawing), picker, compared: compared.or(Some(plain)) }
            }
            None => Shown { drawing: plain, picker, compared },
        })
    }

    /// Whether something is still to come.
    pub(super) fn is_busy(&self) -> bool {
        self.garment.job.is_some()
            || self.shaded.is_some()
            || self.drawn.job.is_some()
            || self.compared.job.is_some()
            || self.fabrics.values().any(|it| it.job.is_some())
            || self.prints.values().any(Option::is_some)
    }

    fn update_garment(&mut self, project: &Project, jobs: &mut Jobs, notices: &mut Notices) {
        let wanted = ((project.garment.clone(), project.unit), project.arrangement.changes.clone());
        if self.garment.wanted.as_ref() != Some(&wanted) {
            let known = self.as_cut.clone().filter(|known| known.of == wanted.0);
            self.garment.wanted = Some(wanted.clone());
            let load = move |_: &amc_core::Progress<'_>| Loaded::new(wanted, known);
            self.garment.job = Some(jobs.start(words::opening(project.garment.name()), load));
        }
        if let Some(result) = self.garment.job.as_ref().and_then(Job::poll) {
            self.garment.job = None;
            match result {
                Ok(loaded) => {
                    self.shaded = Some(loaded.start_shading(&project.garment, jobs));
                    loaded.notices.iter().for_each(|notice| notices.note(notice));
                    let of = self.garment.wanted.as_ref().map(|wanted| wanted.0.clone());
                    let garment = Arc::clone(&loaded.as_cut);
                    self.as_cut = of.map(|of| AsCut { of, garment, is_told: true });
                    self.stage.garment = Some(Arc::clone(&loaded.garment));
                    self.stage.pieces.clone_from(&loaded.pieces);
                    self.loaded = Some(loaded);
                }
                Err(error) => notices.failed(error),
            }
        }
        if let Some(result) = self.shaded.as_ref().and_then(Job::poll) {
            self.shaded = None;
            match (result, &mut self.loaded) {
                (Ok(plain), Some(loaded)) => loaded.plain = plain,
                (Ok(_), None) => {}
                (Err(error), _) => notices.failed(error),
            }
        }
    }

    fn update_fabrics(&mut self, project: &Project, jobs: &mut Jobs, notices: &mut Notices) {
        let wanted: BTreeSet<FabricId> = project.fabrics.iter().map(|fabric| fabric.id).collect();
        self.fabrics.retain(|id, _| wanted.contains(id));
        self.stage.fabrics.retain(|id, _| wanted.contains(id));
        self.stage.swatches.retain(|id, _| wanted.contains(id));
        for fabric in &project.fabrics {
            let loading = self.fabrics.entry(fabric.id).or_default();
            if loading.wanted.as_ref() != Some(&fabric.asset) {
                let asset = fabric.asset.clone();
                loading.wanted = Some(asset.clone());
                loading.job = Some(jobs.start(words::opening(&fabric.name), move |progress| {
                    let amc = load_fabric(&asset_path(&asset), progress)?;
                    let ball = thumbnail::ball(&amc);
                    Ok((Arc::new(amc), ball))
                }));
            }
            if let Some(result) = loading.job.as_ref().and_then(Job::poll) {
                loading.job = None;
                match result {
                    Ok((amc, ball)) => {
                        self.stage.fabrics.insert(fabric.id, amc);
                        self.stage.swatches.insert(fabric.id, Arc::new(ball));
                    }
                    Err(error) => notices.failed(error),
                }
            }
        }
    }

    fn update_prints(&mut self, project: &Project, jobs: &mut Jobs, notices: &mut Notices) {
        let worn = project.panels.values().filter_map(|choice| choice.print.as_ref());
        let compared = project.view.compared.as_ref().map(|it| it.colourway(&project.colourways));
        let kept = project.colourways.all().filter(|(label, _)| Some(label.id) == compared);
        let kept = kept.filter_map(|(_, kept)| kept).flat_map(|panels| panels.values());
        let prints = worn.chain(kept.filter_map(|wear| wear.print.as_ref()));
        let wanted: HashSet<&Asset> = prints.map(|print| &print.picture).collect();
        self.prints.retain(|picture, _| wanted.contains(picture));
        self.stage.prints.retain(|picture, _| wanted.contains(picture));
        for picture in wanted {
            let loading = self.prints.entry(picture.clone()).or_insert_with(|| {
                let file = picture.clone();
                Some(jobs.start(words::opening(picture.name()), move |_| load_print(&file).map(Arc::new)))
            });
            if let Some(result) = loading.as_ref().and_then(Job::poll) {
                *loading = None;
                match result {
                    Ok(print) => drop(self.stage.prints.insert(picture.clone(), print)),
                    Err(error) => notices.failed(error),
                }
            }
        }
    }

    fn update_drawings(&mut self, project: &Project, jobs: &mut Jobs, notices: &mut Notices) {
        let colourways = &project.colourways;
        let recipe = self.loaded.as_ref().map(|loaded| self.recipe(loaded, project, colourways.worn().id));
        let compared = project.view.compared.as_ref().filter(|compared| compared.changes_panels(colourways));
        let other = compared.zip(self.loaded.as_ref()).map(|(compared, loaded)| {
            let mut recipe = self.recipe(loaded, project, compared.colourway(colourways));
            let Outfit { looks, fabrics, .. } = &mut recipe.outfit;
            for look in looks {
                *look = compared.look(look.clone(), |id| fabrics.contains_key(&id));
            }
            recipe
        });
        self.drawn.update(recipe, jobs, notices);
        self.compared.update(other, jobs, notices);
    }

    fn recipe(&self, loaded: &Loaded, project: &Project, colourway: ColourwayId) -> Recipe {
        let (worn, garment) = ((project, colourway), &loaded.garment);
        let outfit = Outfit {
            looks: document_looks(worn, garment, &self.stage.fabrics),
            prints: worn_prints(worn, garment, &self.stage.prints),
            fabrics: self.stage.fabrics.clone(),
        };
        Recipe { loaded: loaded.clone(), outfit }
    }
}

/// What a viewport is given.
#[derive(Debug, Clone)]
pub(super) struct Shown {
    pub(super) drawing: Arc<Drawing>,
    pub(super) picker: Arc<Picker>,
    pub(super) compared: Option<Arc<Drawing>>,
}

impl Covered {
    /// None where the two do not belong together.
    fn new(of: &Arc<Drawing>, cover: Arc<Cover>) -> Option<Self> {
        let picture = |panel: usize, _: &Cloth| {
            cover.panels.get(panel).cloned().flatten().map_or(Cloth::Plain, Cloth::Covered)
        };
        let drawing = Arc::new(of.in_cloths(picture).ok()?);
        Some(Self { of: Arc::clone(of), cover, drawing })
    }
}

impl Drawn {
    fn update(&mut self, recipe: Option<Recipe>, jobs: &mut Jobs, notices: &mut Notices) {
        if let Some(result) = self.job.as_ref().and_then(Job::poll) {
            self.job = None;
            match result {
                Ok(made) => self.take_in(made, notices),
                Err(error) => notices.failed(error),
            }
        }
        let Some(recipe) = recipe else {
            *self = Self::default();
            return;
        };
        let is_new = self.of.as_ref() != Some(&recipe);
        match &self.job {
            // One at a time. What is only made finer gives way to what is new.
            Some(job) if is_new && self.is_preview => job.cancel(),
            Some(_) => {}
            None if is_new => self.draw(recipe, Fineness::Preview, jobs, notices),
            None if self.is_preview => self.draw(recipe, Fineness::Whole, jobs, notices),
            None => {}
        }
    }

    fn take_in(&mut self, made: Made, notices: &mut Notices) {
        match (made.drawing, &self.of) {
            (Ok(drawing), Some(recipe)) => {
                self.latest = Some((Arc::new(drawing), Arc::clone(&recipe.loaded.picker)));
                self.directions = Some(Directions {
                    garment: Arc::clone(made.kept.garment()),
                    vectors: Arc::clone(&made.kept.tangents().vectors),
                    fields: made.kept.fields(),
                });
                self.is_preview = made.is_preview;
            }
            (Ok(_), None) => {}
            // It made way for another.
            (Err(error), _) if error.is_cancelled() => self.of = None,
            (Err(error), _) => {
                self.is_preview = false;
                notices.failed(error);
            }
        }
        self.kept = Some(made.kept);
    }

    /// Now where that is a matter of a frame, else in a job.
    fn draw(&mut self, recipe: Recipe, fineness: Fineness, jobs: &mut Jobs, notices: &mut Notices) {
        self.of = Some(recipe.clone());
        let of_garment = |kept: &KeptTangents| Arc::ptr_eq(kept.garment(), &recipe.loaded.garment);
        let kept = self.kept.take().filter(of_garment);
        if kept.as_ref().is_some_and(|kept| kept.is_quick(&recipe.outfit.directions())) {
            match recipe.drawing(kept, Fineness::Whole, &amc_core::Progress::none()) {
                Ok(made) => self.take_in(made, notices),
                Err(error) => notices.failed(error),
            }
            return;
        }
        let work = move |progress: &amc_core::Progress<'_>| recipe.drawing(kept, fineness, progress);
        self.job = Some(jobs.start(words::DIRECTIONS, work));
    }
}

impl Loaded {
    /// `known`: the garment was read already.
    fn new(((asset, unit), changes): Wanted, known: Option<AsCut>) -> Result<Self> {
        let is_told = known.as_ref().is_some_and(|known| known.is_told);
        let as_cut = match known {
            Some(known) => known.garment,
            None => Arc::new(load_garment(&asset_path(&asset), unit)?),
        };
        let mut notices = Vec::new();
        if !is_told {
            notices.extend(as_cut.notices.iter().cloned().chain(unlikely_size(&as_cut)));
        }
        let garment = match changes.is_empty() {
            true => Arc::clone(&as_cut),
            false => {
                let arrangement = Arrangement { changes, ..Arrangement::default() };
                let (arranged, faults) = Garment::clone(&as_cut).arranged(&arrangement);
                notices.extend(faults);
                Arc::new(arranged)
            }
        };
        let tangents = garment.normals.clone();
        let plain = Drawing::new(&garment, tangents, None, Vec::new(), |_| Cloth::Plain)?;
        let picker = Picker::new(&plain)?;
        let piece = |panel| Arc::new(thumbnail::piece(&garment, panel));
        let pieces = garment.panels.iter().map(piece).collect();
        Ok(Self { as_cut, garment, notices, plain: Arc::new(plain), picker: Arc::new(picker), pieces })
    }

    /// The plain drawing with the occlusion of every vertex.
    fn start_shading(&self, asset: &Asset, jobs: &mut Jobs) -> Job<Arc<Drawing>> {
        let (garment, plain) = (Arc::clone(&self.garment), Arc::clone(&self.plain));
        jobs.start(words::shading(asset.name()), move |progress| {
            let occlusion = vertex_occlusion(&garment, progress)?;
            plain.with_occlusion(&occlusion).map(Arc::new)
        })
    }
}

impl Recipe {
    /// `kept` are the tangents of this garment as they were last.
    fn drawing(
        &self,
        kept: Option<KeptTangents>,
        fineness: Fineness,
        progress: &amc_core::Progress<'_>,
    ) -> Result<Made> {
        let (garment, directions) = (&self.loaded.garment, self.outfit.directions());
        let mut kept = match kept {
            Some(kept) => kept,
            None => {
                let own: Vec<Direction> = directions.iter().map(|direction| direction.own).collect();
                KeptTangents::new(Arc::clone(garment), &own)?
            }
        };
        let set = kept.set(&directions, fineness, *progress);
        let is_preview = matches!(set, Ok(false));
        let dress = |_| dressed(&self.loaded.plain, garment, &self.outfit, &kept.tangents().vectors);
        let drawing = set.and_then(dress);
        Ok(Made { drawing, is_preview, kept })
    }
}

/// What to say of a garment that nobody could wear: most likely its numbers are no metres.
fn unlikely_size(garment: &Garment) -> Option<String> {
    let size = 2.0 * Bounds::of(&garment.positions).ok()?.radius;
    (!LIKELY_SIZES.contains(&size)).then(|| super::texts::files::unlikely_size(size))
}

/// The end of a file's name by which it is known, and what it then is.
pub(super) fn kind(file: &Path) -> Option<Kind> {
    let name = file.file_name()?.to_string_lossy().to_lowercase();
    let ends = |suffixes: &[&str]| suffixes.iter().any(|suffix| name.ends_with(suffix));
    if ends(&[".amcproj"]) {
        Some(Kind::Project)
    } else if ends(&[".glb", ".gltf", ".obj"]) {
        Some(Kind::Garment)
    } else if ends(&[".ktx2"]) {
        Some(Kind::Fabric)
    } else {
        None
    }
}

/// What a file is, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Project,
    Garment,
    Fabric,
}

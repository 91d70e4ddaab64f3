//! Random sequences of 10,000 commands against a plain model: a list of all projects there were, and for each edit what
//! it does to a handful of panels.

use std::sync::Arc;

use amc_core::direction::comb::Comb;
use amc_core::mesh::{Rearrangement, Unit};
use amc_core::render::Laying;

use super::super::{
    Asset, ColourwayId, ColourwayLabel, Document, Edit, FabricId, Gesture, PanelPrint, PanelWear, Project,
};
use super::{at, fabric, turn};

const COMMANDS: usize = 10_000;
const PANELS: [&str; 5] = ["front", "back", "sleeve-1", "sleeve-2", "collar"];

/// splitmix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) % bound as u64) as usize
    }

    fn chance(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }
}

/// What each panel wears.
type Worn = [(i64, Option<f32>); PANELS.len()];

/// A project as tables of numbers.
#[derive(Debug, Clone, PartialEq)]
struct Plain {
    garment: String,
    unit: Unit,
    fabrics: Vec<u32>,
    /// In their order: id, name, and per panel chosen fabric (-2 default, -1 grey) and width of the print.
    colourways: Vec<(u32, String, Worn)>,
    worn: usize,
    /// Per panel: angle, visible.
    panels: [(Option<f32>, bool); PANELS.len()],
    /// Per panel: how far its comb is turned; none: not combed.
    combed: [Option<f32>; PANELS.len()],
    /// Per panel: its group, and its name.
    grouped: [(Option<u8>, Option<u8>); PANELS.len()],
    /// How many panels were merged each time.
    merged: Vec<usize>,
    notes: String,
    /// What a plugin keeps.
    kept: Option<usize>,
}

impl Plain {
    fn new() -> Self {
        Self {
            garment: "garment:shirt".to_owned(),
            unit: Unit::Metre,
            fabrics: vec![0],
            colourways: vec![(0, "Colourway 1".to_owned(), [(-2, None); PANELS.len()])],
            worn: 0,
            panels: [(None, true); PANELS.len()],
            combed: [None; PANELS.len()],
            grouped: [(None, None); PANELS.len()],
            merged: Vec::new(),
            notes: String::new(),
            kept: None,
        }
    }

    fn is(&self, project: &Project) -> bool {
        let fabrics: Vec<u32> = project.fabrics.iter().map(|fabric| fabric.id.number()).collect();
        let worn = |chosen: i64| match chosen {
            -2 => self.fabrics.first().copied(),
            -1 => None,
            id => Some(id as u32),
        };
        let wear = self.colourways[self.worn].2;
        let looks = PANELS.iter().zip(&self.panels).zip(&wear).all(|((name, panel), &(chosen, print))| {
            let &(angle, visible) = panel;
            let look = project.look(name);
            let printed = project.print(name).map(|print| print.laying.width);
            let is_turned = look.direction.map(|direction| direction.angle);
            look.fabric.map(FabricId::number) == worn(chosen)
                && (is_turned, look.visible, printed) == (angle, visible, print)
        });
        let combed =
            PANELS.iter().zip(&self.combed).all(|(name, turn)| project.comb(name).map(|it| it.turn) == *turn);
        let number = |text: &str| text.parse::<u8>().ok();
        let grouped = PANELS.iter().zip(&self.grouped).all(|(name, known)| {
            let called = project.arrangement.names.get(*name);
            (project.group_of(name).and_then(number), called.and_then(|name| number(name))) == *known
        });
        let merged = project.arrangement.changes.iter().map(|change| match change {
            Rearrangement::Merge(panels) => panels.len(),
            Rearrangement::Split { .. } => 0,
        });
        looks
            && combed
            && grouped
            && merged.eq(self.merged.iter().copied())
            && self.is_in_colourways(project)
            && fabrics == self.fabrics
            && project.garment == Asset::Bundled(self.garment.clone())
            && project.unit == self.unit
            && project.notes == self.notes
            && project.plugins.get("counting").and_then(|state| state.as_u64())
                == self.kept.map(|it| it as u64)
    }

    fn is_in_colourways(&self, project: &Project) -> bool {
        let fabric = |chosen: i64| match chosen {
            -2 => None,
            -1 => Some(None),
            id => Some(Some(FabricId::new(id as u32))),
        };
        let all: Vec<_> = project.colourways.all().collect();
        let same =
            all.iter().zip(&self.colourways).enumerate().all(|(k, ((label, kept), (id, name, wear)))| {
                let is_worn = k == self.worn;
                let wears = PANELS.iter().zip(wear).all(|(panel, &(chosen, print))| {
                    let kept = kept.and_then(|kept| kept.get(*panel)).cloned().unwrap_or_default();
                    let width = project.print_in(label.id, panel).map(|print| print.laying.width);
                    (is_worn || kept.fabric == fabric(chosen)) && width == print
                });
                let lists = kept.is_none_or(|kept| kept.values().all(|wear| *wear != PanelWear::default()));
                label.id.number() == *id && label.name == *name && kept.is_none() == is_worn && wears && lists
            });
        same && all.len() == self.colourways.len()
    }

    fn wear(&mut self) -> &mut [(i64, Option<f32>); PANELS.len()] {
        &mut self.colourways[self.worn].2
    }

    /// A random edit of colourways, and the tables after it; none: it must be refused.
    fn random_colourway_edit(&self, random: &mut Random) -> (Edit, Option<Self>) {
        let mut after = self.clone();
        let number = random.below(4) as u32;
        let (id, name) = (ColourwayId::new(number), ["A", "B", "C", ""][random.below(4)].to_owned());
        let label = ColourwayLabel { id, name: name.clone() };
        let place = self.colourways.iter().position(|it| it.0 == number);
        let is_taken = |but: Option<usize>| {
            name.is_empty()
                || self.colourways.iter().enumerate().any(|(k, it)| Some(k) != but && it.1 == name)
        };
        let what = random.below(6);
        if what == 0 {
            let copy = (number, name.clone(), self.colourways[self.worn].2);
            after.colourways.push(copy);
            after.worn = self.colourways.len();
            let is_fine = place.is_none() && !is_taken(None);
            return (Edit::AddColourway(label), is_fine.then_some(after));
        }
        let edit = |to| match what {
            1 => Edit::RenameColourway(label),
            2 => Edit::RemoveColourway(id),
            3 => Edit::MoveColourway { colourway: id, place: to },
            _ => Edit::WearColourway(id),
        };
        let to = random.below(5);
        let Some(place) = place else { return (edit(to), None) };
        let last = self.colourways.len() - 1;
        let is_fine = match what {
            1 => {
                after.colourways[place].1.clone_from(&name);
                !is_taken(Some(place))
            }
            2 => {
                let worn = self.colourways[self.worn].0;
                after.colourways.remove(place);
                let still = after.colourways.iter().position(|it| it.0 == worn);
                after.worn = still.unwrap_or(if place == last { last.max(1) - 1 } else { place });
                last > 0
            }
            3 => {
                let worn = self.colourways[self.worn].0;
                let moved = after.colourways.remove(place);
                after.colourways.insert(to.min(last), moved);
                after.worn = after.colourways.iter().position(|it| it.0 == worn).unwrap();
                true
            }
            _ => {
                after.worn = place;
                true
            }
        };
        (edit(to), is_fine.then_some(after))
    }

    /// A random edit, and the tables after it; none: it must be refused.
    fn random_edit(&self, random: &mut Random) -> (Edit, Option<Self>) {
        let mut after = self.clone();
        let chosen: Vec<usize> = (0..PANELS.len()).filter(|_| random.chance(2)).collect();
        let names: Vec<String> = chosen.iter().map(|&k| PANELS[k].to_owned()).collect();
        if random.chance(5) {
            return self.random_colourway_edit(random);
        }
        let edit = match random.below(16) {
            0 => {
                after.unit = Unit::Metre;
                after.garment = ["garment:shirt", "shape:sheet", "garment:scarf"][random.below(3)].to_owned();
                Edit::SetGarment(Asset::Bundled(after.garment.clone()))
            }
            1 => {
                let id = random.below(6) as u32;
                let edit = Edit::AddFabric(fabric(id, "any"));
                if self.fabrics.contains(&id) {
                    return (edit, None);
                }
                after.fabrics.push(id);
                edit
            }
            2 => {
                let id = random.below(6) as u32;
                let edit = Edit::RemoveFabric(FabricId::new(id));
                let Some(place) = self.fabrics.iter().position(|&known| known == id) else {
                    return (edit, None);
                };
                after.fabrics.remove(place);
                let wear = after.colourways.iter_mut().flat_map(|colourway| &mut colourway.2);
                wear.filter(|wear| wear.0 == i64::from(id)).for_each(|wear| wear.0 = -2);
                edit
            }
            3 => {
                let id = random.below(7) as i64 - 1;
                chosen.iter().for_each(|&k| after.wear()[k].0 = id);
                let fabric = u32::try_from(id).ok().map(FabricId::new);
                let edit = Edit::SetFabric { panels: names, fabric };
                let is_known = fabric.is_none_or(|fabric| self.fabrics.contains(&fabric.number()));
                if !is_known && !chosen.is_empty() {
                    return (edit, None);
                }
                edit
            }
            4 => {
                let angle = [None, Some(0.0), Some(1.5)][random.below(3)];
                chosen.iter().for_each(|&k| after.panels[k].0 = angle);
                Edit::SetDirection { panels: names, direction: angle.map(at) }
            }
            5 => {
                let panel = random.below(PANELS.len());
                let now = self.panels[panel].0.unwrap_or(0.25);
                // Within half a turn and exact in binary.
                let by = [0.0, if now > 0.0 { -1.25 } else { 0.5 }][random.below(2)];
                let is_far = |turn: f32| (turn + by).abs() > 3.0;
                let by = if after.combed[panel].is_some_and(is_far) { 0.0 } else { by };
                after.panels[panel].0 = Some(now + by);
                after.combed[panel] = after.combed[panel].map(|turn| turn + by);
                turn(PANELS[panel], now, by)
            }
            6 => {
                let visible = random.chance(2);
                chosen.iter().for_each(|&k| after.panels[k].1 = visible);
                Edit::SetVisible { panels: names, visible }
            }
            8 => {
                after.unit = Unit::ALL[random.below(Unit::ALL.len())];
                Edit::SetUnit(after.unit)
            }
            7 => {
                after.notes = "lore ".repeat(random.below(4));
                Edit::SetNotes(after.notes.clone())
            }
            9 => {
                let width = [None, Some(0.25), Some(200.0)][random.below(3)];
                let laying = Laying { width: width.unwrap_or_default(), ..Laying::default() };
                let print = width.map(|_| PanelPrint { picture: Asset::file("roses.png"), laying });
                chosen.iter().for_each(|&k| after.wear()[k].1 = width);
                let edit = Edit::SetPrint { panels: names, print };
                if width == Some(200.0) && !chosen.is_empty() {
                    return (edit, None);
                }
                edit
            }
            11 => {
                let panel = random.below(PANELS.len());
                let reach = [0.1, -1.0][usize::from(random.chance(4))];
                let comb =
                    (!random.chance(3)).then(|| Arc::new(Comb { reach, turn: 0.25, ..Comb::default() }));
                let is_bad = comb.is_some() && reach < 0.0;
                after.combed[panel] = comb.as_ref().map(|comb| comb.turn);
                let (name, what) = (PANELS[panel].to_owned(), "Comb".to_owned());
                let edit = Edit::SetComb { panel: name, comb, what };
                if is_bad {
                    return (edit, None);
                }
                edit
            }
            12 => {
                let group = [None, Some(1), Some(2)][random.below(3)];
                chosen.iter().for_each(|&k| after.grouped[k].0 = group);
                Edit::GroupPanels { panels: names, group: group.map(|it: u8| it.to_string()) }
            }
            13 => {
                let (panel, name) = (random.below(PANELS.len()), [None, Some(1), Some(2)][random.below(3)]);
                after.grouped[panel].1 = name;
                Edit::RenamePanel { panel: PANELS[panel].to_owned(), name: name.map(|it: u8| it.to_string()) }
            }
            14 => {
                after.merged.push(names.len());
                if let Some(&first) = chosen.first() {
                    after.combed[first] = None;
                }
                let edit = Edit::MergePanels { panels: names, comb: None };
                if chosen.len() < 2 || after.merged.len() > 4096 {
                    return (edit, None);
                }
                edit
            }
            10 => {
                let laying = Laying { width: 0.5, ..Laying::default() };
                for &k in &chosen {
                    after.wear()[k].1 = after.wear()[k].1.map(|_| 0.5);
                }
                Edit::LayPrint { panels: names, laying }
            }
            _ => {
                after.kept = [None, Some(1), Some(2)][random.below(3)];
                let (plugin, what) = ("counting".to_owned(), "Count".to_owned());
                Edit::SetPluginState { plugin, what, state: after.kept.into() }
            }
        };
        (edit, Some(after))
    }
}

/// All projects there were, the last one undone or not, and where we are.
struct Model {
    states: Vec<Plain>,
    position: usize,
    open: Option<Gesture>,
    /// Whether the last state is the open gesture's.
    has_step: bool,
}

impl Model {
    fn now(&self) -> &Plain {
        &self.states[self.position]
    }

    fn go_to(&mut self, position: usize) {
        self.position = position.min(self.states.len() - 1);
        self.open = None;
    }

    fn submit(&mut self, after: Plain, gesture: Option<Gesture>) {
        let goes_on = gesture.is_some() && self.open == gesture;
        let has_step = goes_on && self.has_step;
        (self.open, self.has_step) = (gesture, has_step);
        if after == *self.now() {
            return;
        }
        self.states.truncate(self.position + 1);
        if has_step {
            self.states.pop();
        }
        let is_back = has_step && self.states.last() == Some(&after);
        if !is_back {
            self.states.push(after);
        }
        self.has_step = !is_back;
        self.position = self.states.len() - 1;
    }
}

fn agree(document: &Document, model: &Model, k: usize) {
    assert!(model.now().is(document.project()), "{k}: {:?} is not {:?}", document.project(), model.now());
    document.project().check().unwrap();
    assert_eq!(
        (document.position(), document.steps().count()),
        (model.position, model.states.len() - 1),
        "{k}"
    );
    assert_eq!(document.undo_name().is_some(), model.position > 0);
    assert_eq!(document.undo_name(), document.steps().nth(model.position.wrapping_sub(1)));
    assert_eq!(document.redo_name(), document.steps().nth(model.position));
    assert!(document.history_bytes() <= Document::HISTORY_BYTES);
}

fn run(seed: u64) {
    let mut random = Random(seed);
    let mut document = Document::new(Project::default());
    let mut model = Model { states: vec![Plain::new()], position: 0, open: None, has_step: false };
    let mut gesture = Gesture::begin();
    for k in 0..COMMANDS {
        let revision = document.revision();
        let before = document.snapshot().project;
        match random.below(10) {
            0 | 1 => {
                assert_eq!(document.undo().is_some(), model.position > 0);
                if model.position > 0 {
                    model.go_to(model.position - 1);
                }
            }
            2 => {
                let has_undone = model.position + 1 < model.states.len();
                assert_eq!(document.redo().is_some(), has_undone);
                if has_undone {
                    model.go_to(model.position + 1);
                }
            }
            3 if random.chance(20) => {
                let position = random.below(model.states.len() + 3);
                document.go_to(position);
                model.go_to(position);
            }
            _ => {
                let (edit, after) = model.now().random_edit(&mut random);
                if random.chance(4) {
                    gesture = Gesture::begin();
                }
                let gesture = random.chance(2).then_some(gesture);
                let done = document.submit(edit, gesture);
                assert_eq!(done.is_ok(), after.is_some(), "{k}: {done:?}");
                if let Some(after) = after {
                    model.submit(after, gesture);
                }
            }
        }
        agree(&document, &model, k);
        let has_changed = *before != *document.project();
        assert!(document.revision() >= revision && (document.revision() > revision || !has_changed), "{k}");
    }
}

#[test]
fn ten_thousand_commands_end_where_they_should() {
    run(1);
    run(2);
}

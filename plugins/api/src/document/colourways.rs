//! Colourways: named sets of what panels wear. One is worn; the others keep theirs until they are.
//!
//! What the worn one's panels wear is in [`Project::panels`], beside what all colourways share: directions, strokes and what
//! is hidden. So a change of colourway can lose none of those.

use std::collections::BTreeMap;

use amc_core::mesh::Panel;
use amc_core::{Error, Result};
use serde::{Deserialize, Serialize};

use super::{FabricId, PanelChoice, PanelLook, PanelPrint, Project};

/// Which of a project's colourways: a number that stays the same while others come and go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ColourwayId(u32);

impl ColourwayId {
    /// The colourway of this number.
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// Its number.
    pub const fn number(self) -> u32 {
        self.0
    }
}

/// What a colourway is known by.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ColourwayLabel {
    /// What views refer to it by.
    pub id: ColourwayId,
    /// What people call it; not empty, and no other's.
    pub name: String,
}

/// What was chosen for a panel to wear; what was not chosen follows the default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct PanelWear {
    /// Its fabric, as [`PanelChoice::fabric`].
    pub fabric: Option<Option<FabricId>>,
    /// The print over its fabric.
    pub print: Option<PanelPrint>,
}

/// A colourway, and what its panels wear.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Colourway {
    /// What it is known by.
    pub label: ColourwayLabel,
    /// What was chosen for each panel, by its id. A panel that is not listed wears the default.
    pub panels: BTreeMap<String, PanelWear>,
}

/// A project's colourways, in their order: at least one, of which one is worn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Colourways {
    before: Vec<Colourway>,
    /// What its panels wear is in the project.
    worn: ColourwayLabel,
    after: Vec<Colourway>,
}

/// A colourway in its place: what it is known by, and what its panels wear; none for the worn one.
type Listed<'a> = (&'a ColourwayLabel, Option<&'a BTreeMap<String, PanelWear>>);

impl Default for Colourways {
    /// One, called `Colourway 1`.
    fn default() -> Self {
        let worn = ColourwayLabel { id: ColourwayId::default(), name: numbered(1) };
        Self { before: Vec::new(), worn, after: Vec::new() }
    }
}

fn numbered(number: usize) -> String {
    format!("Colourway {number}")
}

impl Colourways {
    /// The most there may be.
    pub const MOST: usize = 256;

    /// These, in this order, of which `worn` is worn (none: the first). Without any: one by default.
    ///
    /// # Errors
    /// `worn` is none of them, or lists panels of its own: what those wear is in the project.
    pub fn new(list: Vec<Colourway>, worn: Option<ColourwayId>) -> Result<Self> {
        let place = match worn {
            None => 0,
            Some(id) => list
                .iter()
                .position(|colourway| colourway.label.id == id)
                .ok_or_else(|| Error::invalid(format!("there is no colourway {}", id.number())))?,
        };
        match Self::parted(list, place) {
            None => Ok(Self::default()),
            Some((all, kept)) if kept.is_empty() => Ok(all),
            Some((all, _)) => Err(Error::invalid(format!(
                "'{}' is worn, so what its panels wear belongs to the project's panels",
                all.worn.name
            ))),
        }
    }

    /// The colourway at `worn` is worn: what its panels wear is returned. None: there are none.
    fn parted(mut list: Vec<Colourway>, worn: usize) -> Option<(Self, BTreeMap<String, PanelWear>)> {
        let after = list.split_off((worn + 1).min(list.len()));
        let Colourway { label, panels } = list.pop()?;
        Some((Self { before: list, worn: label, after }, panels))
    }

    /// All in one list, with the worn one's place in it, where its panels wear `panels`.
    fn joined(self, panels: BTreeMap<String, PanelWear>) -> (Vec<Colourway>, usize) {
        let (mut list, worn) = (self.before, Colourway { label: self.worn, panels });
        let place = list.len();
        list.push(worn);
        list.extend(self.after);
        (list, place)
    }

    /// All of them in their order, with what their panels wear; none for the worn one: that is in the project.
    pub fn all(&self) -> impl Iterator<Item = Listed<'_>> {
        fn kept(Colourway { label, panels }: &Colourway) -> Listed<'_> {
            (label, Some(panels))
        }
        self.before.iter().map(kept).chain([(&self.worn, None)]).chain(self.after.iter().map(kept))
    }

    /// What a panel wears in those that are not worn is worn by these panels too.
    pub(super) fn hand_on(&mut self, from: &str, to: &[String]) {
        for colourway in self.before.iter_mut().chain(&mut self.after) {
            if let Some(wear) = colourway.panels.get(from).cloned() {
                colourway.panels.extend(to.iter().map(|id| (id.clone(), wear.clone())));
            }
        }
    }

    /// What they are known by, in their order.
    pub fn labels(&self) -> impl Iterator<Item = &ColourwayLabel> {
        self.all().map(|(label, _)| label)
    }

    /// The one that is worn.
    pub fn worn(&self) -> &ColourwayLabel {
        &self.worn
    }

    /// How many there are, at least 1.
    pub fn count(&self) -> usize {
        self.before.len() + 1 + self.after.len()
    }

    /// The one of this id.
    pub fn get(&self, id: ColourwayId) -> Option<&ColourwayLabel> {
        self.labels().find(|label| label.id == id)
    }

    /// The place of the one that is worn, from 0.
    pub fn place(&self) -> usize {
        self.before.len()
    }

    /// The one after the worn one; after the last comes the first.
    pub fn next(&self) -> &ColourwayLabel {
        let next = self.after.first().or(self.before.first());
        next.map_or(&self.worn, |colourway| &colourway.label)
    }

    /// The one before the worn one; before the first comes the last.
    pub fn previous(&self) -> &ColourwayLabel {
        let previous = self.before.last().or(self.after.last());
        previous.map_or(&self.worn, |colourway| &colourway.label)
    }

    /// An id and a name that none has.
    pub fn free_label(&self) -> ColourwayLabel {
        let is_free = |id: &ColourwayId| self.get(*id).is_none();
        let above = self.labels().map(|label| label.id.number()).max().and_then(|most| most.checked_add(1));
        let id = above.or_else(|| (0..=u32::MAX).find(|number| is_free(&ColourwayId(*number))));
        let is_new = |name: &String| self.labels().all(|label| label.name != *name);
        let name = (self.count() + 1..).map(numbered).find(is_new);
        ColourwayLabel { id: ColourwayId(id.unwrap_or_default()), name: name.unwrap_or_default() }
    }

    /// All that are not worn.
    pub(super) fn kept(&self) -> impl Iterator<Item = &Colourway> {
        self.before.iter().chain(&self.after)
    }

    pub(super) fn kept_mut(&mut self) -> impl Iterator<Item = &mut Colourway> {
        self.before.iter_mut().chain(&mut self.after)
    }

    /// About how much memory they take beside the files' names, bytes.
    pub(super) fn bytes(&self) -> usize {
        let entry = size_of::<(String, PanelWear)>();
        // Nodes of the tree are at least half full.
        let panels = self.kept().flat_map(|colourway| colourway.panels.keys()).map(|id| 2 * entry + id.len());
        let labels = self.labels().map(|label| size_of::<Colourway>() + label.name.len());
        panels.sum::<usize>() + labels.sum::<usize>()
    }
}

/// What is done to a list of colourways, each with what its panels wear, and to the place of the worn one.
type Change<'a> = &'a dyn Fn(&mut Vec<Colourway>, &mut usize) -> Result<()>;

impl Project {
    /// Wears another colourway: nothing but fabrics and prints changes.
    ///
    /// # Errors
    /// There is none of this id.
    pub fn wear(&mut self, colourway: ColourwayId) -> Result<()> {
        self.change_colourways(&|list, worn| {
            *worn = place_of(list, colourway)?;
            Ok(())
        })
    }

    /// The look of `panel` in a colourway; as [`Project::look_of`] in the worn one, and in one that is not there.
    pub fn look_in(&self, colourway: ColourwayId, panel: &Panel) -> PanelLook {
        let look = self.look_of(panel);
        let Some(kept) = self.kept(colourway) else { return look };
        let fabric = match kept.panels.get(&panel.id).and_then(|wear| wear.fabric) {
            Some(chosen) => chosen,
            None => self.fabrics.first().map(|fabric| fabric.id).filter(|_| panel.takes_fabric),
        };
        PanelLook { fabric, ..look }
    }

    /// The print on the panel of this id in a colourway; as [`Project::print`] in the worn one, and in one that is not there.
    pub fn print_in(&self, colourway: ColourwayId, panel: &str) -> Option<&PanelPrint> {
        match self.kept(colourway) {
            Some(kept) => kept.panels.get(panel)?.print.as_ref(),
            None => self.print(panel),
        }
    }

    /// A colourway that is there, and not worn.
    fn kept(&self, colourway: ColourwayId) -> Option<&Colourway> {
        self.colourways.kept().find(|kept| kept.label.id == colourway)
    }

    /// Adds a copy of the worn colourway at the end, and wears it.
    pub(super) fn add_colourway(&mut self, label: &ColourwayLabel) -> Result<()> {
        self.change_colourways(&|list, worn| {
            let panels = list.get(*worn).map(|copied| copied.panels.clone()).unwrap_or_default();
            *worn = list.len();
            list.push(Colourway { label: label.clone(), panels });
            Ok(())
        })
    }

    pub(super) fn rename_colourway(&mut self, label: &ColourwayLabel) -> Result<()> {
        self.change_colourways(&|list, _| {
            let place = place_of(list, label.id)?;
            list[place].label = label.clone();
            Ok(())
        })
    }

    /// Removes a colourway. In place of the worn one the next is worn, or the last.
    pub(super) fn remove_colourway(&mut self, colourway: ColourwayId) -> Result<()> {
        self.change_colourways(&|list, worn| {
            let place = place_of(list, colourway)?;
            if list.len() == 1 {
                return Err(Error::invalid("the only colourway cannot be removed: add another first"));
            }
            list.remove(place);
            *worn = if place < *worn { *worn - 1 } else { (*worn).min(list.len() - 1) };
            Ok(())
        })
    }

    /// Moves a colourway to another place, counted from 0; beyond the end: to the end.
    pub(super) fn move_colourway(&mut self, colourway: ColourwayId, place: usize) -> Result<()> {
        self.change_colourways(&|list, worn| {
            let was_worn = list.get(*worn).map(|colourway| colourway.label.id);
            let moved = list.remove(place_of(list, colourway)?);
            list.insert(place.min(list.len()), moved);
            *worn = was_worn.map_or(Ok(0), |id| place_of(list, id))?;
            Ok(())
        })
    }

    /// Forgets that panels of colourways that are not worn wear this fabric.
    pub(super) fn take_off_in_colourways(&mut self, fabric: FabricId) {
        for colourway in self.colourways.kept_mut() {
            colourway.panels.retain(|_, wear| {
                if wear.fabric == Some(Some(fabric)) {
                    wear.fabric = None;
                }
                *wear != PanelWear::default()
            });
        }
    }

    fn change_colourways(&mut self, change: Change<'_>) -> Result<()> {
        let (mut list, mut worn) = self.colourways.clone().joined(self.taken_off());
        change(&mut list, &mut worn)?;
        if let Some((colourways, panels)) = Colourways::parted(list, worn) {
            self.colourways = colourways;
            self.put_on(panels);
        }
        Ok(())
    }

    /// What panels wear, apart from all else that was chosen for them.
    fn taken_off(&self) -> BTreeMap<String, PanelWear> {
        let wear = |(id, choice): (&String, &PanelChoice)| {
            let wear = PanelWear { fabric: choice.fabric, print: choice.print.clone() };
            (wear != PanelWear::default()).then(|| (id.clone(), wear))
        };
        self.panels.iter().filter_map(wear).collect()
    }

    /// All panels wear `panels`, and nothing else.
    fn put_on(&mut self, panels: BTreeMap<String, PanelWear>) {
        for choice in self.panels.values_mut() {
            (choice.fabric, choice.print) = (None, None);
        }
        for (id, PanelWear { fabric, print }) in panels {
            let choice = self.panels.entry(id).or_default();
            (choice.fabric, choice.print) = (fabric, print);
        }
        self.panels.retain(|_, choice| *choice != PanelChoice::default());
    }
}

fn place_of(list: &[Colourway], id: ColourwayId) -> Result<usize> {
    let place = list.iter().position(|colourway| colourway.label.id == id);
    place.ok_or_else(|| Error::invalid(format!("there is no colourway {}", id.number())))
}

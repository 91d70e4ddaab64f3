//! Panels under names of the person's own: called otherwise, grouped, merged, split.

use std::collections::BTreeSet;
use std::sync::Arc;

use amc_core::direction::comb::Comb;
use amc_core::mesh::{Garment, Panel, Rearrangement};
use amc_core::{Error, Result};

use super::project::check_name;
use super::{PanelChoice, Project};

impl Project {
    /// What a panel is called: by the person, else by the garment.
    pub fn panel_name<'a>(&'a self, panel: &'a Panel) -> &'a str {
        self.arrangement.names.get(&panel.id).unwrap_or(&panel.name)
    }

    /// The garment with its panels called so: the same one where nobody has renamed any.
    pub fn named(&self, garment: &Arc<Garment>) -> Arc<Garment> {
        let is_renamed = |panel: &Panel| self.panel_name(panel) != panel.name;
        match garment.panels.iter().any(is_renamed) {
            false => Arc::clone(garment),
            true => {
                let mut named = Garment::clone(garment);
                named.rename_panels(&self.arrangement.names);
                Arc::new(named)
            }
        }
    }

    /// The group that the panel of this id is in.
    pub fn group_of(&self, panel: &str) -> Option<&str> {
        let (name, _) = self.groups.iter().find(|(_, panels)| panels.contains(panel))?;
        Some(name)
    }

    /// Ids for the halves of a panel which no panel of `garment` has, and nothing was chosen for.
    pub fn free_panel_ids(&self, panel: &str, garment: &Garment) -> [String; 2] {
        let is_taken = |id: &str| {
            self.panels.contains_key(id)
                || garment.panels.iter().any(|known| known.id == id)
                || self.arrangement.changes.iter().any(|change| match change {
                    Rearrangement::Merge(ids) => ids.iter().any(|known| known == id),
                    Rearrangement::Split { panel, into, .. } => {
                        panel == id || into.iter().any(|known| known == id)
                    }
                })
        };
        let mut free = (1..).map(|number| format!("{panel}-{number}")).filter(|id| !is_taken(id));
        [(); 2].map(|()| free.next().unwrap_or_default())
    }

    /// Puts panels into a group; none: into none. A panel is in one group at most, and a group without panels is none.
    pub(super) fn group(&mut self, panels: &[String], group: Option<String>) {
        self.groups.values_mut().for_each(|members| members.retain(|id| !panels.contains(id)));
        if let Some(group) = group {
            self.groups.entry(group).or_default().extend(panels.iter().cloned());
        }
        self.groups.retain(|_, members| !members.is_empty());
    }

    pub(super) fn merge_panels(&mut self, panels: Vec<String>, comb: Option<Arc<Comb>>) {
        if let Some(first) = panels.first() {
            let mut choice = self.panels.remove(first).unwrap_or_default();
            choice.comb = comb;
            if choice != PanelChoice::default() {
                self.panels.insert(first.clone(), choice);
            }
        }
        self.arrangement.changes.push(Rearrangement::Merge(panels));
    }

    /// Both halves take over what was chosen for the whole.
    pub(super) fn split_panel(&mut self, panel: String, line: [glam::Vec2; 2], into: [String; 2]) {
        let choice = self.panels.get(&panel).cloned();
        let name = self.arrangement.names.get(&panel).cloned();
        let group = self.group_of(&panel).map(str::to_owned);
        self.colourways.hand_on(&panel, &into);
        for (id, number) in into.iter().zip(1..) {
            if let Some(choice) = &choice {
                self.panels.insert(id.clone(), choice.clone());
            }
            if let Some(name) = &name {
                self.arrangement.names.insert(id.clone(), format!("{name} {number}"));
            }
        }
        if let Some(members) = group.and_then(|group| self.groups.get_mut(&group)) {
            members.extend(into.iter().cloned());
        }
        self.arrangement.changes.push(Rearrangement::Split { panel, line, into });
    }

    pub(super) fn check_arrangement(&self) -> Result<()> {
        self.arrangement.check()?;
        let ids = self.arrangement.changes.iter().flat_map(|change| match change {
            Rearrangement::Merge(ids) => ids.iter().collect::<Vec<_>>(),
            Rearrangement::Split { panel, into, .. } => into.iter().chain([panel]).collect(),
        });
        for id in ids {
            check_name(id, "the panel's id").map_err(|error| error.at_element("changes"))?;
        }
        for (id, name) in &self.arrangement.names {
            let place = |error: Error| error.at_element(format!("names.{id}"));
            check_name(id, "the panel's id")
                .and_then(|()| check_name(name, "the panel's name"))
                .map_err(place)?;
        }
        let mut grouped = BTreeSet::new();
        for (group, members) in &self.groups {
            let place = |error: Error| error.at_element(format!("groups.{group}"));
            check_name(group, "the group's name").map_err(place)?;
            for id in members {
                check_name(id, "the panel's id").map_err(place)?;
                if !grouped.insert(id) {
                    return Err(place(Error::invalid(format!("'{id}' is in another group too"))));
                }
            }
        }
        let listed = self.arrangement.names.len().max(grouped.len()).max(self.groups.len());
        if listed > Self::MOST_PANELS {
            let what = format!("more than {} panels are named or grouped", Self::MOST_PANELS);
            return Err(Error::too_large(what).at_element("names"));
        }
        Ok(())
    }

    /// About how much memory it takes, bytes.
    pub(super) fn arrangement_bytes(&self) -> usize {
        let text = |text: &String| 2 * size_of::<String>() + text.len();
        let names = self.arrangement.names.iter().map(|(id, name)| text(id) + text(name));
        let groups = self.groups.iter();
        let groups = groups.map(|(name, ids)| text(name) + ids.iter().map(text).sum::<usize>());
        let changes = self.arrangement.changes.iter().map(|change| {
            size_of::<Rearrangement>()
                + match change {
                    Rearrangement::Merge(ids) => ids.iter().map(text).sum::<usize>(),
                    Rearrangement::Split { panel, into, .. } => {
                        panel.len() + into.iter().map(String::len).sum::<usize>()
                    }
                }
        });
        names.sum::<usize>() + groups.sum::<usize>() + changes.sum::<usize>()
    }
}

//! Documents against a plain model, and what each edit does.

mod against_model;
mod colourways;
mod edits;
mod history;

use amc_core::direction::{Direction, Source};

use super::{Asset, Edit, FabricId, FabricInUse};

fn fabric(number: u32, name: &str) -> FabricInUse {
    FabricInUse {
        id: FabricId::new(number),
        asset: Asset::Bundled(format!("fabric:{name}")),
        name: name.to_owned(),
    }
}

fn panels(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn at(angle: f32) -> Direction {
    Direction { source: Source::Gradient, angle }
}

fn turn(panel: &str, now: f32, by: f32) -> Edit {
    Edit::TurnDirection { panels: vec![(panel.to_owned(), at(now))], by }
}

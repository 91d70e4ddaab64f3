//! The panes around the viewport: docked, moved, put back.

use eframe::egui;
use egui_tiles::{Container, Linear, LinearDir, Tabs, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};
use studio_plugin::{Place, Registry};

use super::theme::{STEP, Tokens};

/// What a tile holds. Kept by names, so that a layout of another version is read as far as it goes.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub(super) enum Pane {
    Viewport,
    Plugin { plugin: String, pane: String },
}

/// The layout as kept with the settings.
pub(super) type Layout = Tree<Pane>;

/// The layout that a studio begins with.
pub(super) fn initial(registry: &Registry) -> Layout {
    let mut tiles = Tiles::default();
    let mut at = |place: Place| -> Vec<TileId> {
        let mut ids = Vec::new();
        for plugin in registry.plugins() {
            let plugin = plugin.plugin();
            for pane in plugin.panes().iter().filter(|pane| pane.place == place) {
                let pane = Pane::Plugin { plugin: plugin.id().to_owned(), pane: pane.id.to_owned() };
                ids.push(tiles.insert_pane(pane));
            }
        }
        ids
    };
    let [left, right, beside, bottom] =
        [Place::Left, Place::Right, Place::Beside, Place::Bottom].map(&mut at);
    let mut looked_at = vec![tiles.insert_pane(Pane::Viewport)];
    looked_at.extend(tabs(&mut tiles, beside));
    let mut middle = vec![shared(&mut tiles, LinearDir::Horizontal, looked_at, &[3.0, 2.0])];
    middle.extend(tabs(&mut tiles, bottom));
    let middle = shared(&mut tiles, LinearDir::Vertical, middle, &[4.0, 1.0]);
    let mut columns = Vec::new();
    columns.extend(tabs(&mut tiles, left));
    columns.push(middle);
    columns.extend(tabs(&mut tiles, right));
    let shares: &[f32] = if columns.len() == 3 { &[1.25, 3.2, 1.1] } else { &[3.4, 1.1] };
    let root = shared(&mut tiles, LinearDir::Horizontal, columns, shares);
    Tree::new(egui::Id::unique("layout"), root, tiles)
}

fn tabs(tiles: &mut Tiles<Pane>, children: Vec<TileId>) -> Option<TileId> {
    let first = *children.first()?;
    let mut tabs = Tabs::new(children);
    tabs.set_active(first);
    Some(tiles.insert_container(tabs))
}

fn shared(tiles: &mut Tiles<Pane>, dir: LinearDir, children: Vec<TileId>, shares: &[f32]) -> TileId {
    let mut linear = Linear::new(dir, children.clone());
    for (&child, &share) in children.iter().zip(shares) {
        linear.shares.set_share(child, share);
    }
    tiles.insert_container(Container::Linear(linear))
}

/// Whether the layout shows the viewport: one that does not is of no use.
pub(super) fn is_usable(layout: &Layout) -> bool {
    layout.tiles.tiles().any(|tile| matches!(tile, Tile::Pane(Pane::Viewport)))
}

/// Brings a pane to the front.
pub(super) fn bring_forward(layout: &mut Layout, wanted: &Pane) {
    layout.make_active(|_, tile| matches!(tile, Tile::Pane(pane) if pane == wanted));
}

/// What is around a pane.
pub(super) fn pane_frame(tokens: Tokens) -> egui::Frame {
    egui::Frame::new().fill(tokens.surface).inner_margin(2.0 * STEP)
}

/// Shows the panes through `show`.
pub(super) struct Behavior<'a> {
    pub(super) tokens: Tokens,
    pub(super) title: &'a dyn Fn(&Pane) -> Option<String>,
    pub(super) show: &'a mut dyn FnMut(&Pane, &mut egui::Ui),
}

impl egui_tiles::Behavior<Pane> for Behavior<'_> {
    fn pane_ui(&mut self, ui: &mut egui::Ui, _tile: TileId, pane: &mut Pane) -> egui_tiles::UiResponse {
        if *pane == Pane::Viewport {
            (self.show)(pane, ui);
        } else {
            pane_frame(self.tokens).show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| (self.show)(pane, ui));
            });
        }
        egui_tiles::UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        (self.title)(pane).unwrap_or_default().into()
    }

    fn retain_pane(&mut self, pane: &Pane) -> bool {
        (self.title)(pane).is_some()
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions { all_panes_must_have_tabs: true, ..Default::default() }
    }

    fn is_tab_bar_visible(&self, _tile: TileId, _tabs: &Tabs) -> bool {
        true
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        7.0 * STEP
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        STEP / 2.0
    }

    fn min_size(&self) -> f32 {
        30.0 * STEP
    }

    fn tab_bar_color(&self, _visuals: &egui::Visuals) -> egui::Color32 {
        self.tokens.gap
    }
}

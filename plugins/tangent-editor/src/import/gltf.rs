//! Directions out of glTF.

use std::path::Path;

use amc_core::direction::{Direction, Source};
use amc_core::mesh::{self, Garment, Panel};
use amc_core::{Error, Result};
use glam::Vec2;

use super::{Entry, MOST_PIECES, Way, clean, json, outline};

/// How far the boxes of two patterns may be apart to be the same, of their size.
const SAME: f32 = 1e-3;

/// Reads the pieces of a file, which may be those of `garment`.
pub(super) fn read(garment: &Garment, path: &Path) -> Result<Vec<Entry>> {
    let (of_file, said) = mesh::read_anisotropy(path)?;
    if of_file.panels.len() > MOST_PIECES {
        return Err(Error::too_large(format!("more than {MOST_PIECES} panels")));
    }
    let mut outlines = outline::of_panels(&of_file);
    let entries = of_file.panels.iter().zip(said).enumerate().map(|(index, (panel, said))| {
        let mut record = said.record.unwrap_or_default();
        record.id.get_or_insert_with(|| panel.id.clone());
        let on_piece = of_file.uv_to_drawn_metres(panel).zip(said.warp).map(|(to_cloth, warp)| {
            // `warp` counts yarns.
            let along = Direction { source: Source::Yarn, angle: warp.to_angle() };
            Way::OnPiece(along.on_cloth(to_cloth.matrix2))
        });
        let is_field = matches!(record.source, Some(Source::Field(_)));
        let in_uvs = || {
            let here = |error: Error| error.at_element(format!("panel {}", panel.name));
            json::way(&record).map_err(here)
        };
        let is_ours = record.angle_deg.is_some();
        let same = said.drawn.is_some_and(|drawn| is_drawn_so(garment, &record.id, drawn));
        let mut remarks: Vec<&str> = Vec::new();
        let way = match on_piece {
            _ if is_ours && (is_field || same) => in_uvs()?,
            Some(way) => way,
            None if is_ours => in_uvs()?,
            None => {
                remarks.push("no anisotropy, or no UVs: the direction stays");
                Way::Unsaid
            }
        };
        if said.varies && matches!(way, Way::OnPiece(_)) {
            remarks.push("the direction differs from place to place: the mean is taken");
        }
        if matches!(way, Way::InUvs { .. }) {
            remarks.extend(json::strokes(&record));
        }
        let name = clean(record.name.as_deref().unwrap_or(&panel.name));
        let outlines = std::mem::take(&mut outlines[index]).into_iter().collect();
        Ok(Entry { name, record, way, outlines, quantity: 1, remarks })
    });
    entries.collect()
}

/// Whether the panel of this id has its pattern in this box: then angles in that pattern are angles in the panel's.
fn is_drawn_so(garment: &Garment, id: &Option<String>, [low, high]: [Vec2; 2]) -> bool {
    let Some(panel) = garment.panels.iter().find(|panel| Some(&panel.id) == id.as_ref()) else {
        return false;
    };
    let corners = corners(garment, panel);
    let bounds = corners.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(l, h), at| (l.min(at), h.max(at)));
    let size = (high - low).length();
    bounds.0.distance(low) <= SAME * size && bounds.1.distance(high) <= SAME * size
}

fn corners<'a>(garment: &'a Garment, panel: &Panel) -> impl Iterator<Item = Vec2> + 'a {
    let range = panel.triangles.start as usize..panel.triangles.end as usize;
    let triangles = garment.triangles.get(range).unwrap_or_default();
    triangles.as_flattened().iter().map(|&vertex| garment.uvs[vertex as usize])
}

//! What a sewing pattern says of its pieces: grain, mirror partners, seams.

use std::collections::HashMap;

use glam::Vec2;

use super::check::list;
use super::draft::COORDINATE_LIMIT;
use super::{Garment, Part};

/// Most seams of a garment that are kept: far more than anybody sews.
const SEAM_LIMIT: usize = 4096;

/// What a sewing pattern says of one piece of cloth; a mesh file need not say any of it.
///
/// `Partner` stands for another piece: its name in a [`Part`], its index in [`Garment::panels`] in a [`Panel`](super::Panel).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PatternPiece<Partner> {
    /// The warp's direction: radians in the flat pattern, counter-clockwise from +u as drawn with v up.
    pub grain: Option<f32>,
    /// The piece of which this is the mirror image, as a left sleeve is of a right one.
    pub mirror: Option<Partner>,
    /// Where it is sewn. A seam stands in both of its pieces, and twice in one that is sewn to itself.
    pub seams: Vec<Seam<Partner>>,
    /// Metres that 1 in the UVs stands for.
    pub uv_unit: Option<f32>,
}

/// A line along which a piece is sewn to another or to itself. It is told by its ends in the UVs, so it holds for
/// meshes of any resolution.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Seam<Partner> {
    /// What people call it: `left side`.
    pub name: String,
    /// Its two ends on this piece: the part of the outline that runs counter-clockwise (v up) from the first to the
    /// second; within the piece, the line between them.
    pub edge: [Vec2; 2],
    /// The piece on the other side; the piece itself where two of its own edges are sewn together.
    pub partner: Partner,
    /// Where on the partner the ends of `edge` are sewn, in the same order.
    pub partner_edge: [Vec2; 2],
}

/// Gives the panels what the pattern says of their parts, `part_of` being the part of each. What makes no sense is left
/// out, with a notice.
///
/// Every panel of a part has its grain and unit. A seam goes to the panel of its part that is nearest to its ends. Mirror
/// partners are parts of one panel each: which of several mirrors which is not said.
pub(super) fn assign(garment: &mut Garment, parts: &[Part], part_of: &[u32]) {
    if parts.iter().all(|part| part.pattern == PatternPiece::default()) {
        return;
    }
    let mut panels_of = vec![Vec::new(); parts.len()];
    part_of.iter().enumerate().for_each(|(panel, &part)| panels_of[part as usize].push(panel));
    let mut by_name = HashMap::new();
    for (part, panels) in parts.iter().zip(&panels_of) {
        by_name.entry(part.name.as_str()).or_insert(panels.as_slice());
    }
    let mut resolver = Resolver { garment, by_name, faults: Vec::new(), seams: 0 };
    let mut pieces = vec![PatternPiece::default(); part_of.len()];
    for (part, panels) in parts.iter().zip(&panels_of) {
        resolver.take_part(part, panels, &mut pieces);
    }
    resolver.pair_mirrors(&mut pieces);
    let faults = resolver.faults;
    for (panel, piece) in garment.panels.iter_mut().zip(pieces) {
        panel.pattern = piece;
    }
    if !faults.is_empty() {
        garment.notices.push(format!("left out of what the pattern says: {}", list(&faults, "; ")));
    }
}

/// Finds the panels that names mean.
struct Resolver<'a> {
    garment: &'a Garment,
    /// The panels of each part.
    by_name: HashMap<&'a str, &'a [usize]>,
    /// What was left out, and why.
    faults: Vec<String>,
    seams: usize,
}

impl Resolver<'_> {
    fn take_part(&mut self, part: &Part, panels: &[usize], pieces: &mut [PatternPiece<usize>]) {
        let pattern = &part.pattern;
        let grain = self.sound(pattern.grain, f32::is_finite, part, "grain");
        let unit = |unit: f32| unit > 0.0 && unit <= COORDINATE_LIMIT;
        let uv_unit = self.sound(pattern.uv_unit, unit, part, "unit");
        for &panel in panels {
            (pieces[panel].grain, pieces[panel].uv_unit) = (grain, uv_unit);
        }
        if let (Some(name), &[first, ..]) = (&pattern.mirror, panels) {
            match self.mirror(name, panels) {
                Ok(partner) => pieces[first].mirror = Some(partner),
                Err(fault) => self.faults.push(format!("{}: {fault}", part.name)),
            }
        }
        for seam in pattern.seams.iter().filter(|_| !panels.is_empty()) {
            self.seams += 1;
            if let Some((panel, seam)) = self.seam(part, panels, seam) {
                pieces[panel].seams.push(seam);
            }
        }
    }

    /// A number of a part, if it is sound.
    fn sound(
        &mut self,
        number: Option<f32>,
        is_sound: fn(f32) -> bool,
        part: &Part,
        what: &str,
    ) -> Option<f32> {
        if let Some(number) = number.filter(|&number| !is_sound(number)) {
            self.faults.push(format!("{}: the {what} {number}", part.name));
        }
        number.filter(|&number| is_sound(number))
    }

    /// The panel that mirrors a part of these panels, or why there is none.
    fn mirror(&self, name: &str, panels: &[usize]) -> Result<usize, String> {
        match (panels, self.by_name.get(name).copied().unwrap_or_default()) {
            (_, []) => Err(format!("the mirror partner '{name}' is not there")),
            (&[panel], &[partner]) if partner != panel => Ok(partner),
            ([_], [_]) => Err("it is named as its own mirror partner".to_owned()),
            _ => Err(format!("it or its mirror partner '{name}' is in several islands of the UV map")),
        }
    }

    fn seam(&mut self, part: &Part, panels: &[usize], seam: &Seam<String>) -> Option<(usize, Seam<usize>)> {
        let within = |end: &Vec2| end.abs().cmple(Vec2::splat(COORDINATE_LIMIT)).all();
        let fault = if self.seams > SEAM_LIMIT {
            format!("more than {SEAM_LIMIT} seams")
        } else if !seam.edge.iter().chain(&seam.partner_edge).all(within) {
            format!("the seam '{}' has an end that is no place", seam.name)
        } else if let Some(partners) = self.by_name.get(seam.partner.as_str()).filter(|p| !p.is_empty()) {
            let partner = self.nearest(partners, seam.partner_edge)?;
            let panel = self.nearest(panels, seam.edge)?;
            let Seam { name, edge, partner_edge, .. } = seam.clone();
            return Some((panel, Seam { name, edge, partner, partner_edge }));
        } else {
            format!("the seam '{}' is sewn to '{}', which is not there", seam.name, seam.partner)
        };
        self.faults.push(format!("{}: {fault}", part.name));
        None
    }

    /// Which of some panels has vertices nearest to both ends.
    fn nearest(&self, panels: &[usize], ends: [Vec2; 2]) -> Option<usize> {
        if let &[only] = panels {
            return Some(only);
        }
        let distance = |panel: usize| -> f32 {
            let range = &self.garment.panels[panel].triangles;
            let triangles = &self.garment.triangles[range.start as usize..range.end as usize];
            let mut least = [f32::INFINITY; 2];
            for &vertex in triangles.as_flattened() {
                let uv = self.garment.uvs[vertex as usize];
                least = [0, 1].map(|k| least[k].min(uv.distance_squared(ends[k])));
            }
            least[0].sqrt() + least[1].sqrt()
        };
        let found = panels.iter().map(|&panel| (distance(panel), panel));
        found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, panel)| panel)
    }

    /// Makes mirror partners mutual: a partner that says nothing is told, one that names another is believed.
    fn pair_mirrors(&mut self, pieces: &mut [PatternPiece<usize>]) {
        for panel in 0..pieces.len() {
            let Some(partner) = pieces[panel].mirror else { continue };
            match pieces[partner].mirror {
                None => pieces[partner].mirror = Some(panel),
                Some(back) if back == panel => {}
                Some(_) => {
                    pieces[panel].mirror = None;
                    let [name, other] = [panel, partner].map(|k| &self.garment.panels[k].name);
                    self.faults.push(format!("{name}: its mirror partner '{other}' names another"));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;

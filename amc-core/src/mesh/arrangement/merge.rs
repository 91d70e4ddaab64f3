//! Panels that become one.

use super::super::{Garment, PatternPiece, Seam};

/// Ends of a seam this near to each other, of its length, are one place of the flat pattern.
const SAME_PLACE: f32 = 1e-4;

/// Merges the panels of these numbers into the first of them.
pub(super) fn merge(garment: &mut Garment, members: &[usize]) -> Result<(), String> {
    let &[lead, _, ..] = members else { return Err("two panels or more can be merged".to_owned()) };
    let is_member = |panel: usize| members.contains(&panel);
    let is_gone = |panel: usize| panel != lead && is_member(panel);
    let mut next = 0;
    let mut places: Vec<usize> = Vec::with_capacity(garment.panels.len());
    for panel in 0..garment.panels.len() {
        places.push(next);
        next += usize::from(!is_gone(panel));
    }
    members.iter().filter(|&&panel| panel != lead).for_each(|&panel| places[panel] = places[lead]);
    let of: Vec<u32> =
        garment.panel_numbers().into_iter().map(|panel| places[panel as usize] as u32).collect();

    garment.panels[lead].pattern = pattern(garment, members);
    for (number, panel) in garment.panels.iter_mut().enumerate() {
        let mirror = panel.pattern.mirror;
        // Who mirrors a part of the new panel only mirrors it no longer.
        let holds = |partner: &usize| !(is_gone(*partner) || is_member(*partner) && is_member(number));
        panel.pattern.mirror = mirror.filter(holds).map(|partner| places[partner]);
        panel.pattern.seams.iter_mut().for_each(|seam| seam.partner = places[seam.partner]);
    }
    let mut number = 0;
    garment.panels.retain(|_| {
        number += 1;
        !is_gone(number - 1)
    });
    garment.regroup(&of, &[places[lead]]);
    Ok(())
}

/// What a pattern says of the panels as one: the grain of the first, all seams but those along which they are drawn together.
fn pattern(garment: &Garment, members: &[usize]) -> PatternPiece<usize> {
    let of = |panel: &usize| &garment.panels[*panel].pattern;
    let lead = of(&members[0]);
    let is_inside = |seam: &Seam<usize>| {
        let [from, to] = seam.edge;
        let near = SAME_PLACE * from.distance(to);
        let ends = seam.edge.iter().zip(&seam.partner_edge);
        members.contains(&seam.partner) && ends.into_iter().all(|(here, there)| here.distance(*there) <= near)
    };
    PatternPiece {
        seams: members
            .iter()
            .flat_map(|panel| &of(panel).seams)
            .filter(|it| !is_inside(it))
            .cloned()
            .collect(),
        uv_unit: lead.uv_unit.filter(|_| members.iter().all(|panel| of(panel).uv_unit == lead.uv_unit)),
        ..lead.clone()
    }
}

//! Directions taken from something else: an axis of the garment, the piece across a seam.

use amc_core::direction::{Direction, Source};
use amc_core::mesh::{Garment, Panel, Seam};
use glam::{DMat2, DVec2, DVec3, Mat2, Vec2, Vec3};

/// The source that an angle in the flat pattern can belong to.
fn flat(source: Source) -> Source {
    match source {
        Source::Field(_) => Source::default(),
        other => other,
    }
}

/// The direction in which the panel rises most along `axis` (object space, unit), in the mean over its area. None where it lies
/// square to the axis or has no flat pattern.
pub(crate) fn to_axis(garment: &Garment, panel: &Panel, axis: Vec3, source: Source) -> Option<Direction> {
    let metres = garment.uv_to_metres(panel)?.matrix2;
    let back = metres.as_dmat2().inverse().transpose();
    let triangles = garment.triangles.get(panel.triangles.start as usize..panel.triangles.end as usize)?;
    let (mut rise, mut total) = (DVec2::ZERO, 0.0);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| garment.positions[vertex as usize].as_dvec3());
        let [flat_a, flat_b, flat_c] = triangle.map(|vertex| garment.uvs[vertex as usize].as_dvec2());
        let height = |to: DVec3| (to - a).dot(axis.as_dvec3());
        // The gradient of the height over the UVs, then over the flat cloth.
        let edges = DMat2::from_cols(flat_b - flat_a, flat_c - flat_a).transpose();
        let gradient = back * (edges.inverse() * DVec2::new(height(b), height(c)));
        let area = (b - a).cross(c - a).length();
        if gradient.is_finite() {
            rise += gradient * area;
            total += area;
        }
    }
    // In the mean it climbs at least one part in a hundred.
    (rise.length() > 0.01 * total && total > 0.0)
        .then(|| Direction::along_cloth(flat(source), rise.as_vec2().normalize_or(Vec2::X), metres))
}

/// The direction that goes on across a seam from the partner's: laid beside each other along the seam, both pieces have one
/// direction. The longest seam to another panel counts. `partner_direction` says a panel's direction.
pub(crate) fn to_seam_partner(
    garment: &Garment,
    panel: &Panel,
    source: Source,
    partner_direction: impl Fn(usize) -> Direction,
) -> Option<Direction> {
    let own = oriented(garment, panel)?;
    let length = |seam: &&Seam<usize>| (own * (seam.edge[1] - seam.edge[0])).length();
    let to_others = panel
        .pattern
        .seams
        .iter()
        .filter(|seam| garment.panels.get(seam.partner).is_some_and(|it| it.id != panel.id));
    let seam = to_others.max_by(|a, b| length(a).total_cmp(&length(b)))?;
    let partner = garment.panels.get(seam.partner)?;
    let others = oriented(garment, partner)?;
    let along = (own * (seam.edge[1] - seam.edge[0])).try_normalize()?;
    let partner_along = (others * (seam.partner_edge[1] - seam.partner_edge[0])).try_normalize()?;
    let theirs = partner_direction(seam.partner).on_cloth(others);
    // Seen from the seam, and then from ours.
    let turned = along.rotate(theirs.rotate(Vec2::new(partner_along.x, -partner_along.y)));
    Some(Direction::along_cloth(flat(source), turned, own))
}

/// From a panel's UVs to its cloth laid flat, the front up.
fn oriented(garment: &Garment, panel: &Panel) -> Option<Mat2> {
    garment.uv_to_metres(panel).map(|map| map.matrix2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use amc_core::mesh::{Mesh, Part, PatternPiece};

    /// Two upright squares side by side, sewn along the middle; the right one's UVs are turned by `turn`.
    fn sewn(turn: f32) -> Garment {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
        let spun = |uv: Vec2| Vec2::from_angle(turn).rotate(uv) + Vec2::splat(5.0);
        let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
        for right in [false, true] {
            let first = mesh.positions.len() as u32;
            for corner in corners {
                mesh.positions.push(Vec3::new(corner.x + if right { 1.0 } else { 0.0 }, corner.y, 0.0));
                mesh.normals.push(Vec3::Z);
                mesh.uvs.as_mut().unwrap().push(if right { spun(corner) } else { corner });
            }
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            mesh.triangle_parts.extend([u32::from(right); 2]);
        }
        let left_edge = [corners[1], corners[2]];
        let right_edge = [spun(corners[0]), spun(corners[3])];
        let seam = |edge, partner: &str, partner_edge| Seam {
            name: "middle".into(),
            edge,
            partner: partner.into(),
            partner_edge,
        };
        let part = |name: &str, seam| Part {
            name: name.into(),
            takes_fabric: true,
            pattern: PatternPiece { seams: vec![seam], ..PatternPiece::default() },
        };
        mesh.parts = vec![
            part("left", seam(left_edge, "right", right_edge)),
            part("right", seam(right_edge, "left", left_edge)),
        ];
        Garment::new(mesh).unwrap()
    }

    #[test]
    fn across_a_seam_the_direction_goes_straight_on() {
        for turn in [0.0, 0.7, -2.0] {
            let garment = sewn(turn);
            for angle in [0.0, 0.4, 1.9] {
                let theirs = Direction { source: Source::Yarn, angle };
                let found = to_seam_partner(&garment, &garment.panels[1], Source::Yarn, |_| theirs).unwrap();
                let difference = (found.angle - angle - turn).rem_euclid(std::f32::consts::TAU);
                assert!(
                    difference.min(std::f32::consts::TAU - difference) < 1e-4,
                    "{turn} {angle}: {}",
                    found.angle
                );
            }
        }
    }

    #[test]
    fn the_wearers_up_is_found_in_turned_pieces_and_not_in_level_ones() {
        let garment = sewn(0.7);
        let up = |panel: usize| {
            to_axis(&garment, &garment.panels[panel], Vec3::Y, Source::Gradient).unwrap().angle
        };
        assert!((up(0) - std::f32::consts::FRAC_PI_2).abs() < 1e-4);
        assert!((up(1) - std::f32::consts::FRAC_PI_2 - 0.7).abs() < 1e-4);
        assert_eq!(to_axis(&garment, &garment.panels[0], Vec3::Z, Source::Gradient), None);
    }
}

//! The same garment with other UVs, as files from elsewhere have them: to test programs with.

use std::f32::consts::PI;

use amc_core::mesh::{Mesh, PatternPiece};
use glam::{DVec2, Vec2};

use super::uv;

/// What is other than in the garment as it was cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// Every piece as seen from the cloth's wrong side: u is turned round.
    Mirrored,
    /// Every piece lies askew, each at another angle: see [`turn_of_part`].
    Turned,
    /// No UVs; of the pattern, only the mirror partners are left.
    WithoutUvs,
}

/// How far [`Variant::Turned`] turns the part of this index, radians counter-clockwise.
pub fn turn_of_part(part: usize) -> f64 {
    // Never a multiple of 90 degrees, and no two alike in any garment.
    (17.0 + 23.0 * part as f64).to_radians()
}

impl Variant {
    /// Changes a mesh of [`super::mesh()`].
    pub fn apply(self, mesh: &mut Mesh) {
        match self {
            Self::WithoutUvs => {
                mesh.uvs = None;
                for part in &mut mesh.parts {
                    part.pattern =
                        PatternPiece { mirror: part.pattern.mirror.take(), ..PatternPiece::default() };
                }
            }
            Self::Mirrored => {
                let turn_round = |point: Vec2| Vec2::new(-point.x, point.y);
                move_points(mesh, |_, point| turn_round(point));
                for pattern in mesh.parts.iter_mut().map(|part| &mut part.pattern) {
                    pattern.grain = pattern.grain.map(|grain| PI - grain);
                    // Counter-clockwise is the other way round now.
                    for seam in &mut pattern.seams {
                        seam.edge.reverse();
                        seam.partner_edge.reverse();
                    }
                }
            }
            Self::Turned => {
                move_points(mesh, |part, point| {
                    uv(DVec2::from_angle(turn_of_part(part)).rotate(point.as_dvec2()))
                });
                for (index, part) in mesh.parts.iter_mut().enumerate() {
                    let turned = |grain: f32| (f64::from(grain) + turn_of_part(index)) as f32;
                    part.pattern.grain = part.pattern.grain.map(turned);
                }
            }
        }
    }
}

/// Moves the UVs of every part, and the ends of its seams with them.
fn move_points(mesh: &mut Mesh, to: impl Fn(usize, Vec2) -> Vec2) {
    let mut part_of = vec![0; mesh.positions.len()];
    for (corners, &part) in mesh.triangles.iter().zip(&mesh.triangle_parts) {
        corners.iter().for_each(|&corner| part_of[corner as usize] = part as usize);
    }
    for (point, &part) in mesh.uvs.iter_mut().flatten().zip(&part_of) {
        *point = to(part, *point);
    }
    let names: Vec<String> = mesh.parts.iter().map(|part| part.name.clone()).collect();
    for (index, part) in mesh.parts.iter_mut().enumerate() {
        for seam in &mut part.pattern.seams {
            let partner = names.iter().position(|name| *name == seam.partner).unwrap_or(index);
            seam.edge = seam.edge.map(|end| to(index, end));
            seam.partner_edge = seam.partner_edge.map(|end| to(partner, end));
        }
    }
}

//! What a person should look at before cloth is cut.

use std::f32::consts::PI;

use studio_plugin::document::Project;

use crate::grain::{self, partners};
use crate::sheet::Sheet;
use crate::texts;

/// Mirror partners whose grains differ by more than this are told, radians.
const MOST_OFF: f32 = 0.0087;

/// A panel and what is odd about it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Warning {
    /// Its number.
    pub(crate) panel: usize,
    pub(crate) text: String,
}

/// Of all panels that take a fabric, in their order.
pub(crate) fn warnings(sheet: &Sheet, project: &Project) -> Vec<Warning> {
    let garment = &*sheet.garment;
    let mut found = Vec::new();
    for (number, panel) in garment.panels.iter().enumerate().filter(|(_, panel)| panel.takes_fabric) {
        let name = project.panel_name(panel);
        let mut tell = |text: String| found.push(Warning { panel: number, text });
        if sheet.piece(number).is_none() {
            tell(texts::no_uvs(name));
        } else if panel.flags.degenerate {
            tell(texts::degenerate(name));
        }
        if panel.flags.mirrored {
            tell(texts::mirrored(name));
        }
        // Each pair once.
        let partner = partners::partner(garment, number).filter(|&partner| number < partner);
        if let Some(partner) = partner.and_then(|partner| garment.panels.get(partner)) {
            let wanted = grain::mirrored(grain::direction(panel, project), panel, partner).angle;
            let off = (grain::direction(partner, project).angle - wanted).rem_euclid(PI);
            let off = off.min(PI - off);
            if off > MOST_OFF {
                tell(texts::partners_differ(name, project.panel_name(partner), off.to_degrees()));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use amc_core::Progress;
    use amc_core::direction::Direction;
    use amc_core::mesh::{Garment, Mesh, Part};
    use glam::{Vec2, Vec3};
    use std::sync::Arc;
    use studio_plugin::document::{Document, Edit};

    /// Two squares, the second without UVs where `bare`.
    fn sleeves(bare: bool) -> Sheet {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
        let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
        for part in 0..2u32 {
            let first = mesh.positions.len() as u32;
            for corner in corners {
                mesh.positions.push(corner.extend(0.0) + Vec3::X * 2.0 * part as f32);
                mesh.normals.push(Vec3::Z);
                let uv = corner + Vec2::X * 2.0 * part as f32;
                mesh.uvs.as_mut().unwrap().push(if bare && part == 1 { Vec2::ZERO } else { uv });
            }
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            mesh.triangle_parts.extend([part; 2]);
        }
        mesh.parts = ["left sleeve", "right sleeve"]
            .map(|name| Part { name: name.into(), takes_fabric: true, pattern: Default::default() })
            .into();
        Sheet::new(Arc::new(Garment::new(mesh).unwrap()), &Progress::none()).unwrap()
    }

    #[test]
    fn partners_are_compared_as_mirror_images_and_missing_patterns_told() {
        let sheet = sleeves(false);
        let mut document = Document::new(Project::default());
        let mut turn = |panel: &str, degrees: f32| {
            let direction = Some(Direction { angle: degrees.to_radians(), ..Direction::default() });
            document.submit(Edit::SetDirection { panels: vec![panel.to_owned()], direction }, None).unwrap();
            warnings(&sheet, document.project())
        };
        assert_eq!(turn("left-sleeve", 100.0).len(), 1);
        let told = turn("right-sleeve", 75.0);
        assert!(told[0].panel == 0 && told[0].text.contains("5.0"), "{told:?}");
        assert!(turn("right-sleeve", 80.0).is_empty());
        assert!(turn("right-sleeve", 260.0).is_empty(), "a line has no sense");
        let bare = warnings(&sleeves(true), &Project::default());
        assert!(bare.iter().any(|it| it.panel == 1 && it.text.contains("no flat pattern")), "{bare:?}");
    }
}

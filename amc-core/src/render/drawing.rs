//! Drawings made from garments, and checked.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::{Cloth, Draw, Drawing, Vertex};
use crate::amc::Amc;
use crate::mesh::Garment;
use crate::{Error, Result};

impl Drawing {
    /// A garment with a direction for every vertex (unit, object space, perpendicular to the normal), an occlusion for
    /// every vertex (share of the sky that is open on its front and on its back; none: all of it), and a cloth for
    /// every panel, asked for by the panel's index.
    ///
    /// # Errors
    /// Lists of different lengths; triangles, panels or cloths that refer to what is not there.
    pub fn new(
        garment: &Garment,
        tangents: impl Into<Arc<Vec<Vec3>>>,
        occlusion: Option<&[Vec2]>,
        fabrics: Vec<Arc<Amc>>,
        cloth_of_panel: impl Fn(usize) -> Cloth,
    ) -> Result<Self> {
        let count = garment.positions.len();
        check_length("normals", garment.normals.len(), count)?;
        check_length("UVs", garment.uvs.len(), count)?;
        if let Some(occlusion) = occlusion {
            check_length("occlusion values", occlusion.len(), count)?;
        }
        let vertex = |k: usize| Vertex {
            position: garment.positions[k],
            normal: garment.normals[k],
            uv: garment.uvs[k],
            occlusion: occlusion.map_or(Vec2::ONE, |values| values[k]),
        };
        let draw = |(index, panel): (usize, &crate::mesh::Panel)| Draw {
            triangles: panel.triangles.clone(),
            cloth: cloth_of_panel(index),
        };
        let drawing = Self {
            vertices: Arc::new((0..count).map(vertex).collect()),
            tangents: tangents.into(),
            triangles: Arc::new(garment.triangles.clone()),
            draws: garment.panels.iter().enumerate().map(draw).collect(),
            fabrics,
        };
        drawing.check()?;
        Ok(drawing)
    }

    /// The same panels in other directions, fabrics and cloths; what does not change with them is shared.
    ///
    /// # Errors
    /// As [`Drawing::new`].
    pub fn dressed(
        &self,
        tangents: impl Into<Arc<Vec<Vec3>>>,
        fabrics: Vec<Arc<Amc>>,
        cloth_of_panel: impl Fn(usize) -> Cloth,
    ) -> Result<Self> {
        let draws = self.draws.iter().enumerate();
        let draws = draws
            .map(|(index, draw)| Draw { triangles: draw.triangles.clone(), cloth: cloth_of_panel(index) })
            .collect();
        let (vertices, triangles) = (Arc::clone(&self.vertices), Arc::clone(&self.triangles));
        let drawing = Self { vertices, tangents: tangents.into(), triangles, draws, fabrics };
        drawing.check_tangents()?;
        drawing.check_draws()?;
        Ok(drawing)
    }

    /// The same panels in other cloths; all else is shared.
    ///
    /// # Errors
    /// A cloth that refers to a fabric that is not there.
    pub fn in_cloths(&self, cloth_of_panel: impl Fn(usize, &Cloth) -> Cloth) -> Result<Self> {
        let draw = |(index, draw): (usize, &Draw)| Draw {
            triangles: draw.triangles.clone(),
            cloth: cloth_of_panel(index, &draw.cloth),
        };
        let drawing = Self { draws: self.draws.iter().enumerate().map(draw).collect(), ..self.clone() };
        drawing.check_draws()?;
        Ok(drawing)
    }

    /// The same with an occlusion for every vertex, as [`Drawing::new`] takes it.
    ///
    /// # Errors
    /// Not one for every vertex.
    pub fn with_occlusion(&self, occlusion: &[Vec2]) -> Result<Self> {
        check_length("occlusion values", occlusion.len(), self.vertices.len())?;
        let pairs = self.vertices.iter().zip(occlusion);
        let vertices = pairs.map(|(vertex, &occlusion)| Vertex { occlusion, ..*vertex }).collect();
        Ok(Self { vertices: Arc::new(vertices), ..self.clone() })
    }

    /// Whether all that it refers to is there: what both renderers rely on.
    ///
    /// # Errors
    /// Not one tangent for every vertex; a triangle's vertex, a draw's triangles or a cloth's fabric is out of range.
    pub fn check(&self) -> Result<()> {
        self.check_tangents()?;
        self.check_triangles()?;
        self.check_draws()
    }

    pub(super) fn check_tangents(&self) -> Result<()> {
        check_length("tangents", self.tangents.len(), self.vertices.len())
    }

    fn check_triangles(&self) -> Result<()> {
        let vertices = self.vertices.len();
        let stray = |triangle: &[u32; 3]| triangle.iter().any(|&index| index as usize >= vertices);
        if let Some(index) = self.triangles.iter().position(stray) {
            let what = format!("refers to a vertex that is not there; there are {vertices}");
            return Err(Error::malformed(what).at_element(format!("triangle {index}")));
        }
        Ok(())
    }

    pub(super) fn check_draws(&self) -> Result<()> {
        for (index, draw) in self.draws.iter().enumerate() {
            let Draw { triangles, cloth } = draw;
            let fault = if triangles.start > triangles.end || triangles.end as usize > self.triangles.len() {
                let held = self.triangles.len();
                format!("triangles {} to {} of a drawing of {held}", triangles.start, triangles.end)
            } else if let Some(fabric) = cloth.fabric()
                && fabric >= self.fabrics.len()
            {
                format!("fabric {fabric} of a drawing that has {}", self.fabrics.len())
            } else {
                continue;
            };
            return Err(Error::malformed(fault).at_element(format!("panel {index}")));
        }
        Ok(())
    }
}

fn check_length(what: &str, held: usize, vertices: usize) -> Result<()> {
    if held == vertices {
        return Ok(());
    }
    Err(Error::malformed(format!("{held} {what} for {vertices} vertices")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Panel, PanelFlags};
    use glam::Vec2;

    fn garment() -> Garment {
        let panel = Panel {
            id: "a".into(),
            name: "a".into(),
            triangles: 0..1,
            takes_fabric: true,
            area: 0.5,
            flags: PanelFlags::default(),
            pattern: Default::default(),
        };
        Garment {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::ZERO; 3],
            triangles: vec![[0, 1, 2]],
            panels: vec![panel],
            ..Garment::default()
        }
    }

    #[test]
    fn what_does_not_fit_together_is_refused_with_its_place() {
        let tangents = [Vec3::X; 3];
        let made = |garment: &Garment, tangents: &[Vec3], occlusion: Option<&[Vec2]>, cloth: Cloth| {
            Drawing::new(garment, tangents.to_vec(), occlusion, Vec::new(), |_| cloth.clone())
        };
        let drawing =
            made(&garment(), &tangents, Some(&[0.1, 0.2, 0.3].map(Vec2::splat)), Cloth::Plain).unwrap();
        assert_eq!(drawing.vertices[2].occlusion, Vec2::splat(0.3));
        assert_eq!(drawing.draws, [Draw { triangles: 0..1, cloth: Cloth::Plain }]);

        let message = |result: Result<Drawing>| result.unwrap_err().to_string();
        assert!(message(made(&garment(), &tangents[..2], None, Cloth::Plain)).contains("2 tangents"));
        assert!(
            message(made(&garment(), &tangents, Some(&[Vec2::ONE]), Cloth::Plain)).contains("1 occlusion")
        );
        assert!(message(made(&garment(), &tangents, None, Cloth::Fabric(0))).contains("panel 0"));
        let mut stray = garment();
        stray.triangles[0][1] = 3;
        assert!(message(made(&stray, &tangents, None, Cloth::Plain)).contains("triangle 0"));
        let mut long = garment();
        long.panels[0].triangles = 0..2;
        assert!(message(made(&long, &tangents, None, Cloth::Plain)).contains("0 to 2"));
        let open = drawing.with_occlusion(&[Vec2::ONE; 3]).unwrap();
        assert!(open.vertices[2] == Vertex { occlusion: Vec2::ONE, ..drawing.vertices[2] });
        assert!(message(drawing.with_occlusion(&[Vec2::ONE])).contains("1 occlusion"));
        let other = drawing.dressed(vec![Vec3::Y; 3], Vec::new(), |_| Cloth::Plain).unwrap();
        assert!(Arc::ptr_eq(&other.vertices, &drawing.vertices) && *other.tangents == [Vec3::Y; 3]);
        let bare = drawing.in_cloths(|_, _| Cloth::Plain).unwrap();
        assert!(Arc::ptr_eq(&bare.tangents, &drawing.tangents) && bare.draws == drawing.draws);
        assert!(message(drawing.in_cloths(|panel, _| Cloth::Fabric(panel))).contains("panel 0"));
        let dressed =
            |count: usize, cloth: Cloth| drawing.dressed(vec![Vec3::Y; count], Vec::new(), |_| cloth.clone());
        assert!(message(dressed(2, Cloth::Plain)).contains("2 tangents"));
        assert!(message(dressed(3, Cloth::Fabric(0))).contains("panel 0"));
    }
}

//! The fragment stage: the colour of one fragment.

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::texture::Texture;
use super::vertex::{Axis, Varyings};
use crate::amc::{Amc, LinearTable};
use crate::image::Picture;
use crate::render::shade::{
    cover_light, direction_colour, facing_normal, fragment_kappa, linear_colour, look_up_normal,
    picture_coordinates, plain, seen_light, table_coordinates, uv_colour,
};
use crate::render::{Cloth, Cyclic, Draw, Drawing, LaidPrint, Mode, Shading, View};
use crate::view_space::perpendicular;
use crate::{Error, Result};

/// What the triangles of one draw look like.
#[derive(Debug, Clone)]
pub(super) struct Coat {
    pub(super) paint: Paint,
    /// Over it.
    pub(super) print: Option<LaidPrint>,
}

impl Coat {
    /// That of every draw, in their order.
    pub(super) fn of_draws(drawing: &Drawing, mode: &Mode) -> Result<Vec<Self>> {
        let coat = |(draw, paint): (&Draw, Paint)| {
            let print = draw.cloth.print().filter(|_| paint.is_cloth()).cloned();
            Self { paint, print }
        };
        Ok(drawing.draws.iter().zip(Paint::of_draws(drawing, mode)?).map(coat).collect())
    }
}

/// What the triangles of one draw are painted with.
#[derive(Debug, Clone)]
pub(super) enum Paint {
    /// An AMC.
    Table(Arc<LinearTable>),
    /// An ordinary MatCap.
    Picture(Arc<Texture>),
    /// No fabric.
    Plain,
    /// No fabric, and a picture over it.
    Covered,
    /// The normal as a colour.
    Normals,
    /// The tangent as a colour.
    Tangents,
    /// The UV coordinates as a colour.
    Uv,
}

impl Paint {
    /// The paint of every draw, in their order; tables and pictures are made ready once per fabric.
    fn of_draws(drawing: &Drawing, mode: &Mode) -> Result<Vec<Self>> {
        let per_fabric = Self::of_fabrics(drawing, mode)?;
        let of_cloth = |cloth: &Cloth| match (mode, cloth) {
            (Mode::Normals, _) => Ok(Self::Normals),
            (Mode::Tangents, _) => Ok(Self::Tangents),
            (Mode::Uv, _) => Ok(Self::Uv),
            (Mode::Own(own), _) => Err(Error::unsupported(format!(
                "the shading mode '{}' is drawn by a graphics device only: choose another mode, or the renderer 'gpu'",
                own.name
            ))),
            (Mode::Amc | Mode::Isotropic | Mode::MatCap(_), Cloth::Plain) => Ok(Self::Plain),
            (Mode::Amc | Mode::Isotropic | Mode::MatCap(_), Cloth::Covered(_)) => Ok(Self::Covered),
            (_, Cloth::Fabric(index) | Cloth::Printed(index, _)) => {
                let paint = per_fabric.get(*index).cloned().flatten();
                paint.ok_or_else(|| Error::invalid(format!("the drawing has no fabric {index}")))
            }
        };
        drawing.draws.iter().map(|draw| of_cloth(&draw.cloth)).collect()
    }

    /// The paint of every fabric that a draw uses.
    fn of_fabrics(drawing: &Drawing, mode: &Mode) -> Result<Vec<Option<Self>>> {
        let picture = |picture: &Picture| match Texture::of_picture(picture) {
            Some(texture) => Ok(Self::Picture(Arc::new(texture))),
            None => Err(Error::invalid("the MatCap picture has no pixels")),
        };
        let matcap = if let Mode::MatCap(ball) = mode { Some(picture(ball)?) } else { None };
        let in_use = |index: usize| drawing.draws.iter().any(|draw| draw.cloth.fabric() == Some(index));
        let of_fabric = |(index, fabric): (usize, &Arc<Amc>)| match mode {
            _ if !in_use(index) => Ok(None),
            Mode::Amc => Ok(Some(Self::Table(Arc::new(fabric.to_linear())))),
            Mode::Isotropic => picture(&fabric.isotropic()).map(Some),
            Mode::MatCap(_) => Ok(matcap.clone()),
            Mode::Normals | Mode::Tangents | Mode::Uv | Mode::Own(_) => Ok(None),
        };
        drawing.fabrics.par_iter().enumerate().map(of_fabric).collect()
    }

    /// Whether there may be a picture over it.
    fn is_cloth(&self) -> bool {
        matches!(self, Self::Table(_) | Self::Picture(_) | Self::Covered)
    }

    /// The axis whose cyclic coordinate the vertices must send for it.
    pub(super) fn axis(&self, cyclic: Cyclic) -> Option<Axis> {
        match self {
            Self::Table(table) if cyclic != Cyclic::Fragment => {
                Some(Axis { azimuth: table.azimuth, symmetry: table.symmetry })
            }
            _ => None,
        }
    }
}

/// What is the same for every fragment.
#[derive(Debug, Clone, Copy)]
pub(super) struct FragmentStage<'a> {
    /// From where.
    pub(super) view: &'a View,
    /// How.
    pub(super) shading: &'a Shading,
}

impl FragmentStage<'_> {
    /// The colour of a fragment, linear. `kappa` is the coordinate chosen from the interpolated pair; it is not used in
    /// mode `Fragment`, nor by other paints than a table.
    pub(super) fn colour(&self, paint: &Paint, front: bool, at: &Varyings, kappa: f32) -> Vec3 {
        let n = facing_normal(at.n, front);
        let lit = match paint {
            Paint::Table(table) => self.amc_colour(table, at, n, kappa),
            Paint::Picture(picture) => self.matcap_colour(picture, at, n),
            Paint::Plain => plain(n.z),
            Paint::Covered => Vec3::splat(cover_light(n.z)),
            Paint::Normals => return linear_colour(direction_colour(n)),
            Paint::Tangents => return linear_colour(direction_colour(perpendicular(at.t, n))),
            Paint::Uv => return linear_colour(uv_colour(at.uv)),
        };
        if self.shading.occlusion { lit * seen_light(at.occlusion.x, at.occlusion.y, front) } else { lit }
    }

    /// The AMC looked up by the normal and the tangent's azimuth.
    fn amc_colour(&self, table: &LinearTable, at: &Varyings, n: Vec3, kappa: f32) -> Vec3 {
        let perspective = self.shading.perspective;
        let kappa = match self.shading.cyclic {
            Cyclic::Naive | Cyclic::Cyclic => kappa,
            Cyclic::Fragment => {
                let order = table.symmetry.order();
                fragment_kappa(self.view, perspective, table.azimuth, order, at.p, n, at.t)
            }
        };
        let xy = look_up_normal(self.view, perspective, at.p, n);
        let uvw = table_coordinates(xy, kappa, table.size.slices());
        Vec3::from_array(table.sample(uvw.x, uvw.y, uvw.z))
    }

    /// A picture of a ball looked up by the normal.
    fn matcap_colour(&self, picture: &Texture, at: &Varyings, n: Vec3) -> Vec3 {
        let xy = look_up_normal(self.view, self.shading.perspective, at.p, n);
        picture.sample(picture_coordinates(xy))
    }
}

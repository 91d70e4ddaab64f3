//! One panel with its direction.

use glam::{Vec2, Vec3, Vec4};

use super::about::Said;
use super::frame::Frame;
use super::{PanelMesh, Tangents};
use crate::direction::Direction;
use crate::mesh::uv_area;

/// A panel's part of a garment, with its tangents.
#[derive(Debug)]
pub(super) struct Piece<'a> {
    pub(super) mesh: PanelMesh<'a>,
    pub(super) direction: &'a Direction,
    pub(super) said: &'a Said,
    /// How its pattern is laid; and those of all panels, in their order.
    pub(super) frame: &'a Frame,
    pub(super) frames: &'a [Frame],
    /// Vertices whose direction its source does not give.
    pub(super) filled: u32,
    pub(super) made_up: bool,
    /// Whether strokes comb its direction.
    pub(super) is_combed: bool,
    /// xyz the direction; w +1, or -1 where the UVs are mirrored: with v up, v runs along `w * cross(normal, xyz)`.
    pub(super) tangents: Vec<Vec4>,
    /// Unit vectors along warp and weft.
    pub(super) yarns: [Vec<Vec3>; 2],
}

/// What is known of all panels of a garment, one per panel or per vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct All<'a> {
    pub(super) tangents: &'a Tangents,
    pub(super) directions: &'a [Direction],
    pub(super) said: &'a [Said],
    pub(super) frames: &'a [Frame],
    pub(super) yarns: &'a [Tangents; 2],
}

impl<'a> Piece<'a> {
    /// The panel `index` of a garment.
    pub(super) fn new(mesh: PanelMesh<'a>, index: usize, all: All<'a>) -> Self {
        let usual = if mesh.panel.flags.mirrored { -1.0 } else { 1.0 };
        let signs = match &mesh.uvs {
            Some(uvs) => orientations(&mesh.triangles, uvs, usual),
            None => vec![usual; mesh.vertices.len()],
        };
        let of = |vectors: &[Vec3]| mesh.vertices.iter().map(|&vertex| vectors[vertex as usize]).collect();
        let along: Vec<Vec3> = of(&all.tangents.vectors);
        let frame = &all.frames[index];
        let yarns = if frame.follows_pattern {
            [of(&all.yarns[0].vectors), of(&all.yarns[1].vectors)]
        } else {
            let across = mesh.normals.iter().zip(&along).zip(&signs);
            [along.clone(), across.map(|((normal, along), sign)| normal.cross(*along) * *sign).collect()]
        };
        Self {
            direction: &all.directions[index],
            said: &all.said[index],
            frame,
            frames: all.frames,
            filled: all.tangents.filled[index],
            made_up: all.tangents.made_up[index],
            is_combed: all.tangents.combed[index],
            tangents: along.iter().zip(signs).map(|(along, sign)| along.extend(sign)).collect(),
            yarns,
            mesh,
        }
    }

    /// The UVs, v up, turned so that +u is the warp and +v the weft, in metres. Their dP/du is the direction: exactly, where
    /// its source is the yarn; where it is the gradient, as far as the cloth is not sheared. A field leaves them unturned.
    pub(super) fn turned_uvs(&self) -> Option<Vec<Vec2>> {
        Some(self.mesh.uvs.as_ref()?.iter().map(|uv| self.frame.turned.transform_point2(*uv)).collect())
    }

    /// The mean of the directions; none where they cancel to less than a twentieth.
    pub(super) fn mean_direction(&self) -> Option<Vec3> {
        let sum: Vec3 = self.tangents.iter().map(|tangent| tangent.truncate()).sum();
        (sum.length() > 0.05 * self.tangents.len() as f32).then(|| sum.normalize_or_zero())
    }
}

/// +1 or -1 per vertex: how the UVs of its triangles run; `usual` where they have no area.
fn orientations(triangles: &[[u32; 3]], uvs: &[Vec2], usual: f32) -> Vec<f32> {
    let mut sums = vec![0.0; uvs.len()];
    for corners in triangles {
        // Never both signs at one vertex: a garment's vertices belong to one orientation.
        let area = uv_area(corners.map(|corner| uvs[corner as usize]));
        for &corner in corners {
            sums[corner as usize] += area;
        }
    }
    sums.into_iter().map(|sum| if sum == 0.0 { usual } else { f32::signum(sum) }).collect()
}

//! One panel with its direction.

use glam::{Vec2, Vec3, Vec4};

use super::PanelMesh;
use crate::direction::{Direction, Source, Tangents};
use crate::mesh::extras::shortest_degrees;
use crate::mesh::uv_area;

/// A panel's part of a garment, with its tangents.
#[derive(Debug)]
pub(super) struct Piece<'a> {
    pub(super) mesh: PanelMesh<'a>,
    pub(super) direction: &'a Direction,
    /// Vertices whose direction its source does not give.
    pub(super) filled: u32,
    pub(super) made_up: bool,
    /// xyz the direction; w +1, or -1 where the UVs are mirrored: with v up, v runs along `w * cross(normal, xyz)`.
    pub(super) tangents: Vec<Vec4>,
}

impl<'a> Piece<'a> {
    /// The panel `index` of a garment, whose `tangents` are one per vertex.
    pub(super) fn new(
        mesh: PanelMesh<'a>,
        tangents: &Tangents,
        index: usize,
        direction: &'a Direction,
    ) -> Self {
        let usual = if mesh.panel.flags.mirrored { -1.0 } else { 1.0 };
        let signs = match &mesh.uvs {
            Some(uvs) => orientations(&mesh.triangles, uvs, usual),
            None => vec![usual; mesh.vertices.len()],
        };
        Self {
            direction,
            filled: tangents.filled[index],
            made_up: tangents.made_up[index],
            tangents: (mesh.vertices.iter().zip(signs))
                .map(|(&vertex, sign)| tangents.vectors[vertex as usize].extend(sign))
                .collect(),
            mesh,
        }
    }

    /// The UVs, v up, turned so that +u is the panel's direction: for both sources, since grad of (cos a u + sin a v) is
    /// the one sum, and dP/du of the pattern turned by -a the other. A field leaves them as they are.
    pub(super) fn turned_uvs(&self) -> Option<Vec<Vec2>> {
        let turn = match self.direction.source {
            Source::Gradient | Source::Yarn => Vec2::from_angle(-self.direction.angle),
            Source::Field(_) => Vec2::X,
        };
        Some(self.mesh.uvs.as_ref()?.iter().map(|uv| turn.rotate(*uv)).collect())
    }

    /// The angle in degrees, as short as it can be: what a person typed comes back.
    pub(super) fn angle_deg(&self) -> f64 {
        shortest_degrees(self.direction.angle)
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

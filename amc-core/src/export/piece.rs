//! One panel with vertices of its own, as all formats want it.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use crate::direction::{Direction, Source, Tangents};
use crate::mesh::{Garment, Panel, uv_area};

/// A panel's part of a garment.
#[derive(Debug)]
pub(super) struct Piece<'a> {
    pub(super) panel: &'a Panel,
    pub(super) direction: &'a Direction,
    /// Vertices whose direction its source does not give.
    pub(super) filled: u32,
    pub(super) made_up: bool,
    /// Corners, into the vectors below.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    /// xyz the direction; w +1, or -1 where the UVs are mirrored: with v up, v runs along `w * cross(normal, xyz)`.
    pub(super) tangents: Vec<Vec4>,
    /// As drawn, v up; none where there are none.
    pub(super) uvs: Option<Vec<Vec2>>,
}

impl<'a> Piece<'a> {
    pub(super) fn new(
        garment: &Garment,
        tangents: &Tangents,
        index: usize,
        panel: &'a Panel,
        direction: &'a Direction,
    ) -> Self {
        let range = panel.triangles.start as usize..panel.triangles.end as usize;
        let old = garment.triangles.get(range).unwrap_or_default();
        let (mut places, mut vertices) = (HashMap::new(), Vec::new());
        let mut place = |vertex: u32| {
            *places.entry(vertex).or_insert_with(|| {
                vertices.push(vertex as usize);
                vertices.len() as u32 - 1
            })
        };
        let triangles: Vec<[u32; 3]> = old.iter().map(|corners| corners.map(&mut place)).collect();
        let uvs: Vec<Vec2> = vertices.iter().map(|&vertex| garment.uvs[vertex]).collect();
        let signs = orientations(&triangles, &uvs, if panel.flags.mirrored { -1.0 } else { 1.0 });
        Self {
            panel,
            direction,
            filled: tangents.filled[index],
            made_up: tangents.made_up[index],
            triangles,
            positions: vertices.iter().map(|&vertex| garment.positions[vertex]).collect(),
            normals: vertices.iter().map(|&vertex| garment.normals[vertex]).collect(),
            tangents: (vertices.iter().zip(signs))
                .map(|(&vertex, sign)| tangents.vectors[vertex].extend(sign))
                .collect(),
            uvs: garment.has_uvs.then_some(uvs),
        }
    }

    /// The UVs, v up, turned so that +u is the panel's direction: for both sources, since grad of (cos a u + sin a v) is
    /// the one sum, and dP/du of the pattern turned by -a the other. A field leaves them as they are.
    pub(super) fn turned_uvs(&self) -> Option<Vec<Vec2>> {
        let turn = match self.direction.source {
            Source::Gradient | Source::Yarn => Vec2::from_angle(-self.direction.angle),
            Source::Field(_) => Vec2::X,
        };
        Some(self.uvs.as_ref()?.iter().map(|uv| turn.rotate(*uv)).collect())
    }

    /// The angle in degrees, to four places: what a person typed comes back.
    pub(super) fn angle_deg(&self) -> f64 {
        (f64::from(self.direction.angle).to_degrees() * 1e4).round() / 1e4
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

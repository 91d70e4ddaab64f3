//! The vertex stage: once per vertex, and once more per kind of fabric, since the cyclic coordinate depends on it.

use glam::{Mat4, Vec2, Vec3, Vec4};
use rayon::prelude::*;

use crate::amc::Symmetry;
use crate::render::shade::vertex_kappa;
use crate::render::{Perspective, Vertex, View};
use crate::view_space::{Azimuth, perpendicular};

/// What is interpolated over a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Varyings {
    /// View space, metres.
    pub(super) p: Vec3,
    /// View space, of unit length at the vertices.
    pub(super) n: Vec3,
    /// View space, as the drawing has it: not made perpendicular to `n`.
    pub(super) t: Vec3,
    /// v up.
    pub(super) uv: Vec2,
    /// On the front and on the back, 0 to 1.
    pub(super) occlusion: Vec2,
    /// The cyclic pair for front faces, then that for back faces.
    pub(super) kappa: Vec4,
}

/// A vertex in clip space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// wgpu's clip space: depth from 0 to w.
    pub(super) clip: Vec4,
    /// What is interpolated.
    pub(super) varyings: Varyings,
}

/// What the cyclic coordinate is reckoned for: fabrics that share it share their vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Axis {
    /// What the angle means.
    pub(super) azimuth: Azimuth,
    /// R.
    pub(super) symmetry: Symmetry,
}

/// What is the same for every vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct VertexStage<'a> {
    /// From where.
    pub(super) view: &'a View,
    /// What is done about perspective.
    pub(super) perspective: Perspective,
    /// None where no cyclic coordinate is needed: it is zero then.
    pub(super) axis: Option<Axis>,
}

impl VertexStage<'_> {
    /// All vertices with their tangents, in their order.
    pub(super) fn run(&self, vertices: &[Vertex], tangents: &[Vec3]) -> Vec<Corner> {
        let clip = self.view.view_to_clip();
        let both = vertices.par_iter().zip(tangents).with_min_len(1024);
        both.map(|(vertex, tangent)| self.corner(&clip, vertex, *tangent)).collect()
    }

    fn corner(&self, view_to_clip: &Mat4, vertex: &Vertex, tangent: Vec3) -> Corner {
        let rotation = self.view.rotation();
        let p = self.view.object_to_view.transform_point3(vertex.position);
        let n = (rotation * vertex.normal).try_normalize().unwrap_or(Vec3::Z);
        let t = rotation * tangent;
        let kappa = self.axis.map_or(Vec4::ZERO, |Axis { azimuth, symmetry }| {
            let t = perpendicular(t, n);
            vertex_kappa(self.view, self.perspective, azimuth, symmetry.order(), p, n, t)
        });
        let varyings = Varyings { p, n, t, uv: vertex.uv, occlusion: vertex.occlusion, kappa };
        Corner { clip: *view_to_clip * p.extend(1.0), varyings }
    }
}

impl Corner {
    /// The point at `share` of the way from `self` to `other`: everything is linear in clip space.
    pub(super) fn towards(&self, other: &Self, share: f32) -> Self {
        let (a, b) = (&self.varyings, &other.varyings);
        Self {
            clip: self.clip.lerp(other.clip, share),
            varyings: Varyings {
                p: a.p.lerp(b.p, share),
                n: a.n.lerp(b.n, share),
                t: a.t.lerp(b.t, share),
                uv: a.uv.lerp(b.uv, share),
                occlusion: a.occlusion.lerp(b.occlusion, share),
                kappa: a.kappa.lerp(b.kappa, share),
            },
        }
    }
}

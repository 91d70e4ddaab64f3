//! Triangles in a tree, for rays.

use std::time::Duration;

use glam::{DVec3, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;

/// Triangles are scaled into a cube of this half side: the tree overlooks what is nearer to a ray's origin than 1e-4.
const HALF_SIDE: f64 = 4096.0;

/// From object space into the cube that trees are built in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placement {
    middle: DVec3,
    scale: f64,
}

impl Placement {
    /// Of all `positions`, finite.
    pub(crate) fn of(positions: &[Vec3]) -> Self {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) =
            positions.iter().fold(start, |(low, high), p| (low.min(p.as_dvec3()), high.max(p.as_dvec3())));
        let (middle, half) = ((low + high) / 2.0, ((high - low) / 2.0).max_element());
        let scale = if half > 0.0 { HALF_SIDE / half } else { 1.0 };
        Self { middle, scale }
    }

    pub(crate) fn place(self, position: Vec3) -> Vec3 {
        ((position.as_dvec3() - self.middle) * self.scale).as_vec3()
    }
}

/// Triangles whose corners are placed by a [`Placement`], in a tree.
pub(crate) struct RayTree {
    tree: CwBvh,
    /// In the order of the tree's leaves.
    triangles: Vec<RtTriangle>,
}

impl RayTree {
    /// `positions` are placed, `triangles` refer to them.
    pub(crate) fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let triangle = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| Vec3A::from(positions[corner as usize]));
            RtTriangle::new(a, b, c)
        };
        let unordered: Vec<RtTriangle> = triangles.iter().map(triangle).collect();
        let tree = build_cwbvh(&unordered, BvhBuildParams::medium_build(), &mut Duration::default());
        let triangles = tree.primitive_indices.iter().map(|&index| unordered[index as usize]).collect();
        Self { tree, triangles }
    }

    /// Whether a ray meets nothing, however far it goes.
    pub(crate) fn is_open(&self, origin: Vec3, direction: Vec3) -> bool {
        let ray = Ray::new_inf(origin.into(), direction.into());
        self.tree.ray_traverse_miss(ray, |ray, leaf| self.triangles[leaf].intersect(ray))
    }

    /// The triangle that a ray meets first among those that `counts` says yes to, from either side.
    pub(crate) fn first(&self, origin: Vec3, direction: Vec3, counts: impl Fn(u32) -> bool) -> Option<u32> {
        let triangle = |leaf: usize| self.tree.primitive_indices[leaf];
        let mut hit = RayHit::none();
        let ray = Ray::new_inf(origin.into(), direction.into());
        let met = self.tree.ray_traverse(ray, &mut hit, |ray, leaf| {
            if counts(triangle(leaf)) { self.triangles[leaf].intersect(ray) } else { f32::INFINITY }
        });
        met.then(|| triangle(hit.primitive_id as usize))
    }
}

//! Some triangles at a time, one array per coordinate, so that the compiler can use vector instructions.

use glam::Vec3;

/// Triangles looked at together.
pub(super) const LANES: usize = 16;

/// One number of some triangles.
pub(super) type Lanes = [f32; LANES];

/// Edges in space from the first corners of some triangles: the first edge's x, y, z, then the second's.
pub(super) struct Edges(pub(super) [Lanes; 6]);

impl Edges {
    pub(super) const NONE: Self = Self([[0.0; LANES]; 6]);

    /// Sets those of the triangle `i`.
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, [p, q, r]: [Vec3; 3]) {
        let edges = [q - p, r - p].map(|edge| edge.to_array());
        for (lanes, &x) in self.0.iter_mut().zip(edges.as_flattened()) {
            lanes[i] = x;
        }
    }

    /// Their cross product: twice the vector area of the triangle `i`.
    #[inline(always)]
    pub(super) fn cross(&self, i: usize) -> [f32; 3] {
        let [px, py, pz, qx, qy, qz] = self.0.each_ref().map(|lanes| lanes[i]);
        [py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx]
    }
}

/// Unlike `f32::max` this is one instruction.
#[inline(always)]
pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
pub(super) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

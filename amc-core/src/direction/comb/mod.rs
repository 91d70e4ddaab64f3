//! The direction inside a panel, combed by strokes.
//!
//! A person draws strokes; the direction follows them, and is a smooth unit field in between. The field is a power field: at
//! each vertex the complex number `z = u^n`, u the direction in the vertex's tangent frame, n the fabric's rotational symmetry
//! (1 a direction with a sense, 2 a line, 4 a cross), so that directions which look the same are the same. It minimises
//!
//! `sum over edges w |z_j - r^n z_i|^2  +  sum over vertices a |z - c|^2`
//!
//! where r carries a tangent along an edge, w are the cotangent weights, and c what strokes (a falls off to
//! their sides) and the panel's own direction (a = area / reach^2) ask for. That is one sparse Hermitian positive system.
//!
//! Source: the energy is the one of F. Knöppel, K. Crane, U. Pinkall, P. Schröder, "Globally Optimal Direction Fields" (2013),
//! on the vertex connection Laplacian as in N. Sharp, Y. Soliman, K. Crane, "The Vector Heat Method" (2019).
//! What we changed:
//! - r is the least rotation between the vertices' normals, not a difference of rescaled polar angles. It needs no order of
//!   the triangles around a vertex, so any heap of triangles has it; its turn around a triangle is the solid angle of the
//!   normals, whose sum over a closed surface is the Gauss map's: 4 pi on a sphere.
//! - The energy is lumped: no curvature term inside of triangles; weights are held positive.
//! - No eigenvector: there always are constraints, or the panel keeps its own direction to the bit.
//! - Exact strokes are eliminated from the system, in its old pattern, so that the order of elimination is kept.

mod branches;
mod clusters;
mod couplings;
mod demands;
mod edges;
mod elsewhere;
mod frame;
mod lift;
mod nearest;
mod panel_mesh;
mod singularities;
mod solver;
mod spread;
mod stroke;
mod system;
#[cfg(test)]
mod tests;

pub use panel_mesh::PanelMesh;
pub use singularities::Singularity;
pub use solver::{CombSolver, CombedField};
pub use stroke::{Comb, Elsewhere, Hold, Path, Stroke};

/// A tangent as a complex number in a frame, or a power of one.
type Complex = faer::c64;

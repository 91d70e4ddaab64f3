//! Meshes over a grid of two parameters.

use glam::{Vec2, Vec3};

use crate::mesh::{Mesh, Part};

/// A point of a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) position: Vec3,
    /// Unit.
    pub(super) normal: Vec3,
    pub(super) uv: Vec2,
}

/// A mesh of `columns` x `rows` cells, two triangles each. `point` takes 0..=1 to the right and 0..=1 up, as the
/// front of the surface is seen.
///
/// A `pinched` bottom or top row is one point of space (a pole): the cells there are single triangles, and each has
/// its own vertex there, at the middle of its column, so that the direction there is its own.
pub(super) fn mesh(
    name: &str,
    [columns, rows]: [u32; 2],
    [pinched_bottom, pinched_top]: [bool; 2],
    point: impl Fn(f64, f64) -> Point,
) -> Mesh {
    let mut mesh = Mesh {
        uvs: Some(Vec::new()),
        parts: vec![Part { name: name.to_owned(), takes_fabric: true, ..Part::default() }],
        ..Mesh::default()
    };
    for row in 0..=rows {
        let pole = (row == 0 && pinched_bottom) || (row == rows && pinched_top);
        for column in 0..=columns - u32::from(pole) {
            let middle = if pole { 0.5 } else { 0.0 };
            let s = (f64::from(column) + middle) / f64::from(columns);
            push(&mut mesh, point(s, f64::from(row) / f64::from(rows)));
        }
    }
    // A pole's row is one vertex shorter.
    let start = |row: u32| row * (columns + 1) - u32::from(row > 0 && pinched_bottom);
    for row in 0..rows {
        for column in 0..columns {
            let (below, above) = (start(row) + column, start(row + 1) + column);
            if !(row == 0 && pinched_bottom) {
                // A top pole's vertex of this column stands in place of the upper right one.
                let top = if row + 1 == rows && pinched_top { above } else { above + 1 };
                mesh.triangles.push([below, below + 1, top]);
            }
            if !(row + 1 == rows && pinched_top) {
                let upper_right = above + 1;
                mesh.triangles.push([below, upper_right, above]);
            }
        }
    }
    mesh.triangle_parts = vec![0; mesh.triangles.len()];
    mesh.file_vertices = mesh.positions.len();
    mesh
}

fn push(mesh: &mut Mesh, point: Point) {
    mesh.positions.push(point.position);
    mesh.normals.push(point.normal);
    mesh.uvs.get_or_insert_default().push(point.uv);
}

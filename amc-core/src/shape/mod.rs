//! Shapes by name, in place of a mesh file. About a metre in radius, centred on the origin, Y up.
//!
//! Normals are exact. UVs are in metres, v up, and made so that grad U and dP/du are the grain that the name promises.
//! Where a shape closes, the vertices of the seam stand there twice.

mod disc;
mod grid;
mod round;
mod sheet;

use crate::mesh::Mesh;
use crate::{Error, Result};

/// A shape's name and what makes it.
type Shape = (&'static str, fn() -> Mesh);

/// Every shape. A new shape is one line here and one file.
const SHAPES: [Shape; 7] = [
    ("sphere", round::sphere),
    ("torus", round::torus),
    ("torus-poloidal", round::torus_poloidal),
    ("disc-circular", disc::circular),
    ("disc-radial", disc::radial),
    ("cylinder", round::cylinder),
    ("sheet", sheet::sheet),
];

/// The names of the shapes.
pub const NAMES: [&str; SHAPES.len()] = {
    let mut names = [""; SHAPES.len()];
    let mut index = 0;
    while index < names.len() {
        names[index] = SHAPES[index].0;
        index += 1;
    }
    names
};

/// The shape of that name.
///
/// # Errors
/// No shape has that name; the message lists those there are.
pub fn mesh(name: &str) -> Result<Mesh> {
    match SHAPES.iter().find(|shape| shape.0 == name) {
        Some((_, make)) => Ok(make()),
        None => Err(Error::invalid(format!("no shape is called '{name}': there are {}", NAMES.join(", ")))),
    }
}

#[cfg(test)]
mod tests;

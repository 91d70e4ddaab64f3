//! Garments, written for other programs and for this one: as they are, or with their panels' directions.

mod directions;
mod garment;
mod glb;
mod obj;
mod panel_mesh;

pub use directions::{Said, tangents};
pub use garment::garment;

use crate::mesh::Garment;
use crate::{Error, Result};
use panel_mesh::PanelMesh;

/// Who wrote a file.
const GENERATOR: &str = concat!("AMC Studio ", env!("CARGO_PKG_VERSION"));

/// Refuses what cannot be written, before a file is touched.
///
/// # Errors
/// Arrays and indices that do not fit together.
fn check(garment: &Garment) -> Result<()> {
    let vertices = garment.positions.len();
    if [garment.normals.len(), garment.uvs.len()] != [vertices; 2] {
        return Err(Error::invalid("not one normal and one UV per vertex"));
    }
    let sound = |range: &std::ops::Range<u32>| {
        range.start <= range.end && range.end as usize <= garment.triangles.len()
    };
    if !garment.panels.iter().all(|panel| sound(&panel.triangles))
        || garment.triangles.as_flattened().iter().any(|&corner| corner as usize >= vertices)
    {
        return Err(Error::invalid("a panel or triangle refers to what is not there"));
    }
    Ok(())
}

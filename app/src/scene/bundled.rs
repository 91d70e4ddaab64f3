//! Garments that come with the program, made by the crate `wardrobe`.

use amc_core::mesh::{Mesh, gltf};
use amc_core::{Error, Result};

/// A garment that comes with the program.
struct Bundled {
    /// Its name, as one word.
    name: &'static str,
    glb: &'static [u8],
}

/// All of them. A garment is one line here and one file, for example
/// `Bundled { name: "shirt", glb: include_bytes!("../../../assets/garments/shirt.glb") }`.
const GARMENTS: [Bundled; 0] = [];

/// The bundled garment of this name.
///
/// # Errors
/// There is none of this name; the message lists those there are.
pub(super) fn garment(name: &str) -> Result<Mesh> {
    let Some(found) = GARMENTS.iter().find(|garment| garment.name == name) else {
        let known: Vec<&str> = GARMENTS.iter().map(|garment| garment.name).collect();
        let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
        return Err(Error::invalid(format!("no garment '{name}' is bundled: there are {known}")));
    };
    gltf::parse(found.glb, &|_| Err(Error::invalid("a bundled garment is one file")))
}

#[cfg(test)]
mod tests {
    use amc_core::mesh::Garment;

    use super::*;

    #[test]
    fn every_bundled_garment_is_whole() {
        for Bundled { name, .. } in &GARMENTS {
            let garment = Garment::new(garment(name).unwrap()).unwrap();
            assert!(garment.notices.is_empty(), "{name}: {:?}", garment.notices);
            assert!(garment.panels.iter().all(|panel| panel.pattern.grain.is_some()), "{name}");
        }
    }
}

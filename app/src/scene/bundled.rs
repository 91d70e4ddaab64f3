//! Garments that come with the program, made by the crate `wardrobe`.

use amc_core::mesh::{Mesh, gltf};
use amc_core::{Error, Result};

/// A garment that comes with the program.
struct Bundled {
    /// Its name, as one word.
    name: &'static str,
    glb: &'static [u8],
}

macro_rules! bundled {
    ($name:literal) => {
        Bundled { name: $name, glb: include_bytes!(concat!("../../../assets/garments/", $name, ".glb")) }
    };
}

/// All of them. A garment is one line here and one file.
const GARMENTS: [Bundled; 7] = [
    bundled!("t-shirt"),
    bundled!("shirt"),
    bundled!("trousers"),
    bundled!("a-line-skirt"),
    bundled!("bias-skirt"),
    bundled!("scarf"),
    bundled!("square"),
];

/// The bundled garment of this name.
///
/// # Errors
/// There is none of this name; the message lists those there are.
pub(super) fn garment(name: &str) -> Result<Mesh> {
    let Some(found) = GARMENTS.iter().find(|garment| garment.name == name) else {
        let known: Vec<&str> = GARMENTS.iter().map(|garment| garment.name).collect();
        return Err(Error::invalid(format!(
            "no garment '{name}' is bundled: there are {}",
            known.join(", ")
        )));
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

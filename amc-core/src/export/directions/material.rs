//! The look of cloth in glTF: a highlight drawn out across the warp.
//!
//! KHR_materials_anisotropy draws the highlight out *along* the direction `cos r T + sin r B`: like that of grooves which run
//! across it. Yarns are such grooves, so with T along the warp the direction is B, a quarter turn on: r and the texel make 90
//! degrees together. A quarter turn is the same line whichever way it is counted, so programs that mistake the sense of r, or
//! pass over the sign of a mirrored panel's B, show it right too.
//!
//! The texture is there for Blender, which makes tangents from the UVs only where there is one. Eight bits cannot say a
//! direction along T: the nearest texel is 1/255 off in G. The factor makes up for that, so the sum is right to a thousandth
//! of a degree, and programs that pass over the texture are 0.22 degrees off.

use std::f64::consts::FRAC_PI_2;

use serde_json::{Value, json};

use crate::{Error, Result};

/// Side of the texture: a block of compressed texels.
const SIDE: u32 = 4;
/// Direction (R, G) and strength (B) of all texels.
const TEXEL: [u8; 3] = [255, 128, 255];
/// A middling cloth's: nobody measured this one's.
const STRENGTH: f64 = 0.8;
const ROUGHNESS: f64 = 0.4;

/// A material of cloth; `texture` is that of [`texture`], none where there are no UVs to see it by.
pub(super) fn cloth(name: &str, texture: Option<usize>) -> Value {
    let mut anisotropy = json!({ "anisotropyStrength": STRENGTH, "anisotropyRotation": FRAC_PI_2 });
    if let Some(texture) = texture {
        let [along, across] = [TEXEL[0], TEXEL[1]].map(|byte| 2.0 * f64::from(byte) / 255.0 - 1.0);
        anisotropy["anisotropyRotation"] = json!(FRAC_PI_2 - across.atan2(along));
        anisotropy["anisotropyTexture"] = json!({ "index": texture, "texCoord": 0 });
    }
    json!({
        "name": name,
        "doubleSided": true,
        "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": ROUGHNESS },
        "extensions": { "KHR_materials_anisotropy": anisotropy },
    })
}

/// The constant texture, a PNG file.
///
/// # Errors
/// None in practice: the encoder's are passed on.
pub(super) fn texture() -> Result<Vec<u8>> {
    let wrong = |error: png::EncodingError| Error::invalid("a texture that cannot be encoded").because(error);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE, SIDE);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(wrong)?;
    writer.write_image_data(&TEXEL.repeat((SIDE * SIDE) as usize)).map_err(wrong)?;
    writer.finish().map_err(wrong)?;
    Ok(bytes)
}

//! What KHR_materials_anisotropy says in a material.

use std::collections::HashMap;

use glam::{DVec2, Vec2};
use gltf::Document;
use serde::Deserialize;

use super::container::Buffers;
use crate::image::decode::{Raster, Samples, decode};
use crate::mesh::Resolve;
use crate::{Error, Result};

/// Most texels of a texture: what is wanted of it is one direction.
const MOST_TEXELS: u64 = 1 << 22;
/// Where the mean of the texels' unit directions is shorter than this, they differ by more than some degrees.
const LEAST_AGREEMENT: f64 = 0.998;

/// The part of the JSON that speaks of it.
#[derive(Deserialize)]
struct Root {
    #[serde(default)]
    materials: Vec<Material>,
}

#[derive(Deserialize)]
struct Material {
    #[serde(default)]
    extensions: Extensions,
}

#[derive(Deserialize, Default)]
struct Extensions {
    #[serde(rename = "KHR_materials_anisotropy")]
    anisotropy: Option<Said>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Said {
    #[serde(default)]
    anisotropy_rotation: f32,
    anisotropy_texture: Option<Texture>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Texture {
    index: usize,
    #[serde(default)]
    tex_coord: u32,
}

/// The way of a material's anisotropy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Way {
    /// Radians from T to B: the texture's direction turned by the factor.
    pub(super) angle: f32,
    /// The set of UVs by which T is meant where the mesh has no tangents.
    pub(super) tex_coord: u32,
    /// Whether the texture has more than one direction: the angle is their mean.
    pub(super) varies: bool,
}

/// The way of each material that has one, by its index.
///
/// # Errors
/// A texture that is not there, cannot be decoded or is too large; a factor that is not finite.
pub(super) fn ways(
    json: &[u8],
    document: &Document,
    buffers: &Buffers<'_>,
    resolve: Resolve<'_>,
) -> Result<HashMap<usize, Way>> {
    let root: Root = serde_json::from_slice(json)
        .map_err(|error| Error::malformed(format!("not glTF: {error}")).because(error))?;
    let mut textures: HashMap<usize, (Vec2, bool)> = HashMap::new();
    let mut ways = HashMap::new();
    for (index, material) in root.materials.into_iter().enumerate() {
        let Some(said) = material.extensions.anisotropy else { continue };
        let here = |error: Error| error.at_element(format!("materials[{index}]"));
        if !said.anisotropy_rotation.is_finite() {
            return Err(here(Error::invalid("an anisotropyRotation that is not finite")));
        }
        let (texel, varies) = match said.anisotropy_texture.as_ref().map(|texture| texture.index) {
            None => (Vec2::X, false),
            Some(texture) => match textures.get(&texture) {
                Some(known) => *known,
                None => {
                    let read = texel(texture, document, buffers, resolve).map_err(here)?;
                    *textures.entry(texture).or_insert(read)
                }
            },
        };
        let angle = said.anisotropy_rotation + texel.to_angle();
        let tex_coord = said.anisotropy_texture.map_or(0, |texture| texture.tex_coord);
        ways.insert(index, Way { angle, tex_coord, varies });
    }
    Ok(ways)
}

/// The mean direction of a texture, and whether it has others too.
fn texel(
    texture: usize,
    document: &Document,
    buffers: &Buffers<'_>,
    resolve: Resolve<'_>,
) -> Result<(Vec2, bool)> {
    let missing = || Error::malformed(format!("texture {texture} is not there"));
    let image = document.textures().nth(texture).ok_or_else(missing)?.source();
    let of_uri;
    let bytes = match image.source() {
        gltf::image::Source::View { view, .. } => {
            let buffer = buffers.get(view.buffer().index()).ok_or_else(missing)?;
            let end = view.offset().checked_add(view.length()).ok_or_else(missing)?;
            buffer.get(view.offset()..end).ok_or_else(missing)?
        }
        gltf::image::Source::Uri { uri, .. } => {
            of_uri = super::container::read_uri(uri, resolve)?;
            &of_uri
        }
    };
    let raster =
        decode(bytes).map_err(|error| Error::new(error.kind(), format!("texture {texture}: {error}")))?;
    if u64::from(raster.width()) * u64::from(raster.height()) > MOST_TEXELS {
        return Err(Error::too_large(format!("texture {texture} has more than {MOST_TEXELS} texels")));
    }
    let (sum, count) = sum(&raster);
    let mean = sum / count.max(1) as f64;
    let unit = mean.try_normalize().ok_or_else(|| Error::invalid("a texture whose directions cancel"))?;
    Ok((unit.as_vec2(), mean.length() < LEAST_AGREEMENT))
}

/// The sum of the texels' unit directions, and their number.
fn sum(raster: &Raster) -> (DVec2, usize) {
    let channels = raster.channels() as usize;
    // A grey one has R and G alike.
    let green = usize::from(channels >= 3);
    match raster.samples() {
        Samples::U8(samples) => {
            add(samples, channels, |texel| [texel[0], texel[green]].map(f64::from), 255.0)
        }
        Samples::U16(samples) => {
            add(samples, channels, |texel| [texel[0], texel[green]].map(f64::from), 65535.0)
        }
        Samples::F32(samples) => add(samples, channels, |texel| [texel[0], texel[green]].map(f64::from), 1.0),
    }
}

fn add<T>(
    samples: &[T],
    channels: usize,
    red_green: impl Fn(&[T]) -> [f64; 2],
    largest: f64,
) -> (DVec2, usize) {
    let direction = |texel: &[T]| (2.0 * DVec2::from(red_green(texel)) / largest - 1.0).normalize_or_zero();
    (samples.chunks_exact(channels).map(direction).sum(), samples.len() / channels)
}

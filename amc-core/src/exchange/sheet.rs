//! A picture whose pixels are texels: how slices are written to PNG and OpenEXR, and read again, exactly.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::image::{AnyChannel, FlatSamples};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels as _, ReadLayers as _, ReadSpecificChannel as _};
use half::f16;

use crate::amc::{Amc, TexelFormat, Texels};
use crate::image::decode::{Format, Samples, decode};
use crate::image::encode;
use crate::{Error, Result};

/// In OpenEXR, alpha would mean premultiplied colours, and be divided out with loss. So a texel's fourth channel is a
/// channel of its own there.
const MEASURED: &str = "measured";

/// A grid of texels, rows from the top.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) texels: Texels,
}

impl Sheet {
    /// As PNG (8-bit texels) or OpenEXR (half-float ones), with a text.
    pub(super) fn encode(&self, text: &[(&str, &str)]) -> Result<Vec<u8>> {
        match &self.texels {
            Texels::Srgb8(texels) => encode::png_of_pixels(self.width, self.height, texels, text),
            Texels::Half(texels) => {
                let channel = |name, c: usize| {
                    AnyChannel::new(name, FlatSamples::F16(texels.iter().map(|texel| texel[c]).collect()))
                };
                let channels = [channel("R", 0), channel("G", 1), channel("B", 2), channel(MEASURED, 3)];
                encode::exr_of_channels(self.width, self.height, channels, text)
            }
        }
    }

    /// Reads a picture of any sort: 8-bit pictures give 8-bit texels, all others half floats.
    pub(super) fn decode(bytes: &[u8]) -> Result<Self> {
        let raster = decode(bytes)?;
        let picture = raster.to_picture();
        let (width, height) = (picture.width(), picture.height());
        let half = |texel: &[f32; 4]| texel.map(f16::from_f32);
        let texels = match raster.samples() {
            Samples::U8(samples) => Texels::Srgb8(rgba8(samples, raster.channels())),
            Samples::U16(_) => Texels::Half(picture.pixels().iter().map(half).collect()),
            Samples::F32(_) => {
                let mut texels: Vec<[f16; 4]> = picture.pixels().iter().map(half).collect();
                if Format::of(bytes) == Some(Format::Exr) {
                    read_measured(bytes, width, height, &mut texels)?;
                }
                Texels::Half(texels)
            }
        };
        Ok(Self { width, height, texels })
    }
}

fn rgba8(samples: &[u8], channels: u32) -> Vec<[u8; 4]> {
    let pixel = |pixel: &[u8]| match *pixel {
        [y] => [y, y, y, 255],
        [y, a] => [y, y, y, a],
        [r, g, b] => [r, g, b, 255],
        [r, g, b, a, ..] => [r, g, b, a],
        [] => [0; 4],
    };
    samples.chunks_exact(channels as usize).map(pixel).collect()
}

/// Puts the channel `measured` into the texels' fourth channel, where the file has it. Its size has been checked when
/// the colours were decoded.
fn read_measured(bytes: &[u8], width: u32, height: u32, texels: &mut [[f16; 4]]) -> Result<()> {
    let (width, height) = (width as usize, height as usize);
    let broken = |what: String| Error::malformed(format!("broken OpenEXR: {what}"));
    let values = guarded(|| measured_values(bytes, width))
        .ok_or_else(|| broken("beyond what the decoder can tell".to_owned()))?
        .map_err(|error| broken(error.to_string()))?;
    if values.len() != width * height {
        return Err(Error::unsupported("an OpenEXR whose layer is not the whole picture"));
    }
    for (texel, value) in texels.iter_mut().zip(values).filter(|(_, value)| value.is_finite()) {
        texel[3] = value;
    }
    Ok(())
}

fn measured_values(bytes: &[u8], width: usize) -> exr::error::Result<Vec<f16>> {
    let image = exr::image::read::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .optional(MEASURED, f16::NAN)
        .collect_pixels(
            |size, _| vec![f16::NAN; size.width() * size.height()],
            move |values: &mut Vec<f16>, at, (value,): (f16,)| {
                if let Some(slot) = values.get_mut(at.y() * width + at.x()) {
                    *slot = value;
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))?;
    Ok(image.layer_data.channel_data.pixels)
}

/// The text of this name in a PNG's text chunks or an OpenEXR's attributes; `None` where there is none, or no such file.
pub(super) fn text(bytes: &[u8], name: &str) -> Option<String> {
    match Format::of(bytes)? {
        Format::Png => guarded(|| png_text(bytes, name)).flatten(),
        Format::Exr => guarded(|| exr_text(bytes, name)).flatten(),
        Format::Jpeg => None,
    }
}

/// Runs other people's decoder; should it panic on a broken file, there is no answer.
fn guarded<T>(decoder: impl FnOnce() -> T) -> Option<T> {
    catch_unwind(AssertUnwindSafe(decoder)).ok()
}

fn png_text(bytes: &[u8], name: &str) -> Option<String> {
    // What texts may take altogether: the decoder counts them against this.
    let limits = png::Limits { bytes: 16 << 20 };
    let reader = png::Decoder::new_with_limits(Cursor::new(bytes), limits).read_info().ok()?;
    let info = reader.info();
    let plain = info.uncompressed_latin1_text.iter().find(|chunk| chunk.keyword == name);
    let packed = || info.compressed_latin1_text.iter().find(|chunk| chunk.keyword == name)?.get_text().ok();
    let wide = || info.utf8_text.iter().find(|chunk| chunk.keyword == name)?.get_text().ok();
    plain.map(|chunk| chunk.text.clone()).or_else(packed).or_else(wide)
}

fn exr_text(bytes: &[u8], name: &str) -> Option<String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).ok()?;
    let attributes = meta
        .headers
        .iter()
        .flat_map(|header| header.own_attributes.other.iter().chain(&header.shared_attributes.other));
    attributes.filter(|(key, _)| **key == *name).find_map(|(_, value)| match value {
        AttributeValue::Text(text) => Some(text.to_string()),
        _ => None,
    })
}

/// JSON with every letter beyond ASCII escaped: plain text chunks and OpenEXR's attributes hold no others.
pub(super) fn ascii(json: &str) -> String {
    let mut escaped = String::with_capacity(json.len());
    for letter in json.chars() {
        if letter.is_ascii() {
            escaped.push(letter);
        } else {
            let mut units = [0; 2];
            escaped.extend(letter.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")));
        }
    }
    escaped
}

/// Whether a picture's name asks for OpenEXR; PNG otherwise.
///
/// # Errors
/// It asks for neither.
pub(super) fn is_exr(path: &Path) -> Result<bool> {
    match path.extension().map(|suffix| suffix.to_ascii_lowercase()) {
        Some(suffix) if suffix == "exr" => Ok(true),
        Some(suffix) if suffix == "png" => Ok(false),
        _ => Err(Error::unsupported("pictures are written as .png or .exr")),
    }
}

/// The texels of an AMC as the picture named can hold them, and what is lost by that.
pub(super) fn texels_for(amc: &Amc, path: &Path) -> Result<(Texels, Vec<String>)> {
    Ok(match (amc.texels(), is_exr(path)?) {
        (Texels::Half(_), false) => {
            let table = amc.to_linear();
            (table.to_srgb8(), lost_in_png(TexelFormat::Half, &table.texels).into_iter().collect())
        }
        (Texels::Srgb8(_), true) => {
            let lost = "the 8-bit storage: from OpenEXR the table comes back in half floats".to_owned();
            (amc.to_linear().to_half(), vec![lost])
        }
        (texels, _) => (texels.clone(), Vec::new()),
    })
}

/// What an 8-bit PNG loses of colours that were stored as `format`.
pub(super) fn lost_in_png(format: TexelFormat, colours: &[[f32; 4]]) -> Option<String> {
    if format == TexelFormat::Srgb8 {
        return None;
    }
    let cut = colours.iter().filter(|colour| colour[..3].iter().any(|&value| value > 1.0)).count();
    Some(format!(
        "what 8 bits do not hold of half floats, and light above 1 ({cut} of {} colours); .exr keeps both",
        colours.len()
    ))
}

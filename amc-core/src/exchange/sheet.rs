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

/// What a PNG's texts may take, bytes: altogether as they are packed, and the one that is wanted unpacked.
const MOST_TEXT: usize = 16 << 20;

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
        let (width, height) = (raster.width(), raster.height());
        let texels = match raster.samples() {
            Samples::U8(samples) => Texels::Srgb8(raster.spread(samples, |value| value, |alpha| alpha, 255)),
            Samples::U16(_) => Texels::Half(raster.linear(f16::from_f32)),
            Samples::F32(_) => {
                let mut texels = raster.linear(f16::from_f32);
                check_finite(&texels, width)?;
                if Format::of(bytes) == Some(Format::Exr) {
                    read_measured(bytes, width, height, &mut texels)?;
                }
                Texels::Half(texels)
            }
        };
        Ok(Self { width, height, texels })
    }
}

/// 32-bit light can be more than 16 bits hold.
fn check_finite(texels: &[[f16; 4]], width: u32) -> Result<()> {
    match texels.iter().position(|texel| !texel.iter().copied().all(f16::is_finite)) {
        Some(k) => Err(Error::invalid("a colour is larger than half floats hold").at_element(format!(
            "pixel {}, {}",
            k % width as usize,
            k / width as usize
        ))),
        None => Ok(()),
    }
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
    let limits = png::Limits { bytes: MOST_TEXT };
    let reader = png::Decoder::new_with_limits(Cursor::new(bytes), limits).read_info().ok()?;
    let info = reader.info();
    let plain = info.uncompressed_latin1_text.iter().find(|chunk| chunk.keyword == name);
    let packed = || {
        let mut chunk = info.compressed_latin1_text.iter().find(|chunk| chunk.keyword == name)?.clone();
        chunk.decompress_text_with_limit(MOST_TEXT).ok()?;
        chunk.get_text().ok()
    };
    let wide = || {
        let mut chunk = info.utf8_text.iter().find(|chunk| chunk.keyword == name)?.clone();
        chunk.decompress_text_with_limit(MOST_TEXT).ok()?;
        chunk.get_text().ok()
    };
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

//! OpenEXR, through the crate exr.

use std::io::Cursor;

use exr::image::{AnyChannels, FlatSamples};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{ReadChannels, ReadLayers};

use super::{Raster, Samples, check_size};
use crate::{Error, Result};

/// Deflate reaches 1032 to 1, PIZ less; twice that.
const MOST_RATIO: u64 = 2064;

pub(super) fn decode(bytes: &[u8]) -> Result<Raster> {
    let mut cursor = Cursor::new(bytes);
    let meta = MetaData::read_from_buffered(&mut cursor, false);
    let meta = meta.map_err(|error| broken(&error).at_byte(cursor.position()))?;
    for header in &meta.headers {
        check(header, bytes.len())?;
    }
    let mut cursor = Cursor::new(bytes);
    let image = exr::image::read::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(&mut cursor);
    let image = image.map_err(|error| broken(&error).at_byte(cursor.position()))?;
    let layer = image.layer_data;
    let window = image.attributes.display_window;
    let size = |value: usize| u32::try_from(value).map_err(|_| Error::too_large("the picture is too large"));
    let placed = Placed {
        layer: [layer.size.width(), layer.size.height()],
        picture: [window.size.width(), window.size.height()],
        // Both lie in 32 bits, their difference in 64.
        shift: [
            i64::from(layer.attributes.layer_position.x()) - i64::from(window.position.x()),
            i64::from(layer.attributes.layer_position.y()) - i64::from(window.position.y()),
        ],
    };
    let channels = find_channels(&layer.channel_data)?;
    let samples = placed.samples(&channels)?;
    let [width, height] = placed.picture;
    Raster::new(size(width)?, size(height)?, channels.len() as u32, Samples::F32(samples))
}

fn broken(error: &exr::error::Error) -> Error {
    match error {
        exr::error::Error::NotSupported(what) => {
            Error::unsupported(format!("OpenEXR of a sort that is not read: {what}"))
        }
        error => Error::malformed(format!("broken OpenEXR: {error}")),
    }
}

/// Checks what the reader would allocate for, before it does.
fn check(header: &Header, length: usize) -> Result<()> {
    let area = |width: usize, height: usize| (width as u64).saturating_mul(height as u64);
    let pixel_bytes = header.channels.bytes_per_pixel as u64;
    let layer = header.layer_size;
    let bytes = area(layer.width(), layer.height()).saturating_mul(pixel_bytes);
    check_size(layer.width() as u64, layer.height() as u64, bytes, length, MOST_RATIO)?;
    let window = header.shared_attributes.display_window.size;
    let bytes = area(window.width(), window.height()).saturating_mul(16);
    check_size(window.width() as u64, window.height() as u64, bytes, length, MOST_RATIO)?;
    if let BlockDescription::Tiles(tiles) = header.blocks {
        let [width, height] = [tiles.tile_size.width(), tiles.tile_size.height()];
        let bytes = area(width, height).saturating_mul(pixel_bytes);
        check_size(width as u64, height as u64, bytes, length, MOST_RATIO)
            .map_err(|error| error.at_element("tiles"))?;
    }
    Ok(())
}

/// The channels Y; Y, A; R, G, B; or R, G, B, A.
fn find_channels(channels: &AnyChannels<FlatSamples>) -> Result<Vec<&FlatSamples>> {
    let find = |name: &str| {
        let found = channels.list.iter().find(|channel| channel.name.eq_case_insensitive(name));
        match found {
            Some(channel) if channel.sampling.x() != 1 || channel.sampling.y() != 1 => {
                Err(Error::unsupported(format!("the OpenEXR channel {name} is subsampled")))
            }
            Some(channel) if matches!(channel.sample_data, FlatSamples::U32(_)) => {
                Err(Error::unsupported(format!("the OpenEXR channel {name} holds whole numbers, not light")))
            }
            found => Ok(found.map(|channel| &channel.sample_data)),
        }
    };
    let alpha = find("A")?;
    if let (Some(r), Some(g), Some(b)) = (find("R")?, find("G")?, find("B")?) {
        return Ok([r, g, b].into_iter().chain(alpha).collect());
    }
    if let Some(y) = find("Y")? {
        return Ok([y].into_iter().chain(alpha).collect());
    }
    let names: Vec<String> = channels.list.iter().map(|channel| channel.name.to_string()).collect();
    Err(Error::unsupported(format!("OpenEXR with the channels {}; R, G, B or Y are read", names.join(", "))))
}

/// Where the layer's pixels lie in the picture.
struct Placed {
    layer: [usize; 2],
    picture: [usize; 2],
    shift: [i64; 2],
}

impl Placed {
    /// The picture's samples, straight alpha; outside of the layer they are 0.
    fn samples(&self, channels: &[&FlatSamples]) -> Result<Vec<f32>> {
        let [width, height] = self.picture;
        let mut samples = vec![0.0; width * height * channels.len()];
        for (k, pixel) in samples.chunks_exact_mut(channels.len()).enumerate() {
            let (x, y) = (k % width, k / width);
            let Some(from) = self.layer_index(x, y) else { continue };
            for (sample, channel) in pixel.iter_mut().zip(channels) {
                *sample = value(channel, from);
            }
            if pixel.iter().any(|sample| !sample.is_finite()) {
                return Err(Error::invalid("a sample is infinite or not a number")
                    .at_element(format!("pixel {x}, {y}")));
            }
            unmultiply(pixel);
        }
        Ok(samples)
    }

    fn layer_index(&self, x: usize, y: usize) -> Option<usize> {
        let inside = |at: usize, k: usize| {
            usize::try_from(at as i64 - self.shift[k]).ok().filter(|&at| at < self.layer[k])
        };
        Some(inside(y, 1)? * self.layer[0] + inside(x, 0)?)
    }
}

fn value(samples: &FlatSamples, at: usize) -> f32 {
    match samples {
        FlatSamples::F16(samples) => samples.get(at).map_or(0.0, |value| value.to_f32()),
        FlatSamples::F32(samples) => samples.get(at).copied().unwrap_or(0.0),
        FlatSamples::U32(_) => 0.0,
    }
}

/// EXR's colour is premultiplied. Where nothing covers the pixel, what light there is stays.
fn unmultiply(pixel: &mut [f32]) {
    let (colour, alpha) = match pixel {
        [colour @ .., alpha] if colour.len() == 1 || colour.len() == 3 => (colour, *alpha),
        _ => return,
    };
    if alpha > 0.0 {
        for value in colour {
            *value /= alpha;
        }
    }
}

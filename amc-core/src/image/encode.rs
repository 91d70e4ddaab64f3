//! Pictures written as PNG (8-bit sRGB, straight alpha) and OpenEXR (linear, premultiplied).

use std::io::Cursor;
use std::path::Path;

use exr::image::write::WritableImage as _;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::LayerAttributes;
use rayon::prelude::*;

use super::Picture;
use crate::color::srgb8_from_linear;
use crate::{Error, Result, file};

/// Saves a picture as [`png()`] encodes it; the old or the new file is whole at every instant.
///
/// # Errors
/// As [`png()`], or the file cannot be written; the error names the file.
pub fn write_png(picture: &Picture, path: &Path, text: &[(&str, &str)]) -> Result<()> {
    let bytes = png(picture, text).map_err(|error| error.in_file(path))?;
    file::save_bytes(path, &bytes)
}

/// A picture as 8-bit sRGB PNG with straight alpha, light cut at 1, with `text` chunks of keyword and text.
///
/// # Errors
/// The picture has no pixels, or a keyword is not 1 to 79 characters of Latin-1.
pub fn png(picture: &Picture, text: &[(&str, &str)]) -> Result<Vec<u8>> {
    png_of_pixels(picture.width(), picture.height(), &srgb8(picture), text)
}

/// The pixels as 8-bit sRGB with straight alpha, light cut at 1.
pub(crate) fn srgb8(picture: &Picture) -> Vec<[u8; 4]> {
    let encode = |&[r, g, b, a]: &[f32; 4]| {
        let alpha = (a.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        [srgb8_from_linear(r), srgb8_from_linear(g), srgb8_from_linear(b), alpha]
    };
    picture.pixels().par_iter().map(encode).collect()
}

/// 8-bit sRGB pixels with straight alpha, rows from the top, as PNG.
pub(crate) fn png_of_pixels(
    width: u32,
    height: u32,
    pixels: &[[u8; 4]],
    text: &[(&str, &str)],
) -> Result<Vec<u8>> {
    let failed = |error: png::EncodingError| Error::invalid(format!("cannot write a PNG: {error}"));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    for &(keyword, text) in text {
        let (keyword, text) = (keyword.to_owned(), text.to_owned());
        // A plain text chunk is Latin-1; only the international one holds the rest.
        if text.chars().all(|letter| u32::from(letter) < 256) {
            encoder.add_text_chunk(keyword, text).map_err(failed)?;
        } else {
            encoder.add_itxt_chunk(keyword, text).map_err(failed)?;
        }
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(bytemuck::cast_slice(pixels)).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Saves a picture as [`exr()`] encodes it; the old or the new file is whole at every instant.
///
/// # Errors
/// As [`exr()`], or the file cannot be written; the error names the file.
pub fn write_exr(picture: &Picture, path: &Path) -> Result<()> {
    let bytes = exr(picture).map_err(|error| error.in_file(path))?;
    file::save_bytes(path, &bytes)
}

/// A picture as OpenEXR: linear Rec. 709, 32-bit floats, premultiplied by alpha.
///
/// # Errors
/// The picture has no pixels.
pub fn exr(picture: &Picture) -> Result<Vec<u8>> {
    let channel = |name, value: fn(&[f32; 4]) -> f32| {
        AnyChannel::new(name, FlatSamples::F32(picture.pixels().iter().map(value).collect()))
    };
    let channels = [
        channel("R", |pixel| pixel[0] * pixel[3]),
        channel("G", |pixel| pixel[1] * pixel[3]),
        channel("B", |pixel| pixel[2] * pixel[3]),
        channel("A", |pixel| pixel[3]),
    ];
    exr_of_channels(picture.width(), picture.height(), channels, &[])
}

/// OpenEXR of four channels, packed without loss, with texts as attributes.
pub(crate) fn exr_of_channels(
    width: u32,
    height: u32,
    channels: [AnyChannel<FlatSamples>; 4],
    text: &[(&str, &str)],
) -> Result<Vec<u8>> {
    if width == 0 || height == 0 {
        return Err(Error::invalid("a picture without pixels cannot be written"));
    }
    let mut attributes =
        LayerAttributes { software_name: Some(Text::from("AMC Studio")), ..LayerAttributes::default() };
    for &(name, text) in text {
        let latin = |text: &str| {
            Text::new_or_none(text)
                .ok_or_else(|| Error::invalid(format!("OpenEXR cannot hold the text {text:?}")))
        };
        attributes.other.insert(latin(name)?, AttributeValue::Text(latin(text)?));
    }
    let size = (width as usize, height as usize);
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let layer = Layer::new(size, attributes, Encoding::SMALL_FAST_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.map_err(|error| Error::invalid(format!("cannot write an OpenEXR: {error}")))?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::decode;

    fn picture() -> Picture {
        let pixels = (0..35).map(|k| {
            let value = k as f32 / 30.0;
            [value, value * value, 0.5, if k % 3 == 0 { 0.25 } else { 1.0 }]
        });
        Picture::new(7, 5, pixels.collect()).unwrap()
    }

    #[test]
    fn an_exr_comes_back_as_it_was() {
        let picture = picture();
        assert_eq!(decode::decode(&exr(&picture).unwrap()).unwrap().to_picture(), picture);
    }

    #[test]
    fn a_png_comes_back_within_half_a_step_of_its_encoding() {
        let picture = picture();
        let back = decode::decode(&png(&picture, &[]).unwrap()).unwrap().to_picture();
        for (a, b) in picture.pixels().iter().zip(back.pixels()) {
            for c in 0..3 {
                let encoded = |linear| crate::color::srgb_from_linear(linear) * 255.0;
                assert!((encoded(a[c]) - encoded(b[c])).abs() <= 0.501);
            }
            assert!((a[3] - b[3]).abs() <= 0.5 / 255.0);
        }
    }

    #[test]
    fn texts_in_any_letters_are_kept() {
        let bytes = png(&picture(), &[("plain", "silk"), ("more", "Ατλάζι")]).unwrap();
        let info = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        assert_eq!(info.info().uncompressed_latin1_text[0].text, "silk");
        assert_eq!(info.info().utf8_text[0].get_text().unwrap(), "Ατλάζι");
    }

    #[test]
    fn a_picture_without_pixels_is_refused() {
        let empty = Picture::new(0, 3, Vec::new()).unwrap();
        assert!(png(&empty, &[]).is_err() && exr(&empty).is_err());
    }
}

//! OpenEXR block by block.

use std::path::Path;

use exr::block::writer::ChunksWriter;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, LineOrder, SampleType, Text};
use exr::meta::header::{Header, LayerAttributes};
use exr::meta::{BlockDescription, MetaData};
use rayon::prelude::*;

use super::{Put, Rows, file};
use crate::{Error, Result};

/// Rows of a block of the compression used.
const BLOCK_ROWS: usize = 32;

/// The channels, in the order of their names, which is the file's; and where they are in a pixel.
const CHANNELS: [(&str, usize); 4] = [("A", 3), ("B", 2), ("G", 1), ("R", 0)];

/// Saves an OpenEXR as [`crate::image::encode::write_exr`] does (linear, 32-bit floats, premultiplied), from bands that
/// `make` puts.
///
/// # Errors
/// `make` failed, its bands do not add up to the picture, or the file cannot be written; the error names the file.
pub fn save_exr(
    path: &Path,
    width: u32,
    height: u32,
    make: impl FnOnce(Put<'_>) -> Result<()>,
) -> Result<()> {
    let mut rows = Rows::of(width, height).map_err(|error| error.in_file(path))?;
    file::save_seekable(path, |out| {
        // What `make` says is more to the point than what the encoder makes of it.
        let mut fault = None;
        let headers = [header(width as usize, height as usize)].into_iter().collect();
        let written = exr::block::write(out, headers, true, |meta, chunks| {
            let mut blocks =
                Blocks { meta: &meta, chunks, pending: Vec::new(), width: width as usize, row: 0 };
            let made = make(&mut |band| {
                rows.take(band)?;
                blocks.pending.extend_from_slice(band.pixels());
                blocks.write(BLOCK_ROWS).map_err(failed)
            });
            fault = made.and_then(|()| rows.finish()).err();
            if fault.is_some() {
                return Err(exr::error::Error::Aborted);
            }
            blocks.write(1)
        });
        match fault {
            Some(fault) => Err(fault),
            None => written.map_err(failed),
        }
    })
}

fn header(width: usize, height: usize) -> Header {
    let channel = |(name, _)| ChannelDescription {
        name: Text::from(name),
        sample_type: SampleType::F32,
        quantize_linearly: name == "A",
        sampling: Vec2(1, 1),
    };
    let attributes =
        LayerAttributes { software_name: Some(Text::from("AMC Studio")), ..LayerAttributes::default() };
    Header::new(Text::from(""), (width, height), CHANNELS.into_iter().map(channel).collect())
        .with_attributes(attributes)
        .with_encoding(exr::compression::Compression::PIZ, BlockDescription::ScanLines, LineOrder::Increasing)
}

/// Rows on their way into blocks.
struct Blocks<'a, W> {
    meta: &'a MetaData,
    chunks: &'a mut W,
    /// Pixels of rows that make no whole block yet.
    pending: Vec<[f32; 4]>,
    width: usize,
    /// The first of them.
    row: usize,
}

impl<W: ChunksWriter> Blocks<'_, W> {
    /// Writes the pending rows, as far as they make blocks of at least `least` rows.
    fn write(&mut self, least: usize) -> exr::error::UnitResult {
        let rows = self.pending.len() / self.width;
        let count = if least == 1 { rows.div_ceil(BLOCK_ROWS) } else { rows / BLOCK_ROWS };
        let compressed: Vec<_> = (0..count)
            .into_par_iter()
            .map(|k| {
                let first = k * BLOCK_ROWS;
                let rows = BLOCK_ROWS.min(rows - first);
                let pixels = &self.pending[first * self.width..(first + rows) * self.width];
                block(self.meta, pixels, self.width, self.row + first)?.compress_to_chunk(&self.meta.headers)
            })
            .collect();
        for (k, chunk) in compressed.into_iter().enumerate() {
            self.chunks.write_chunk(self.row / BLOCK_ROWS + k, chunk?)?;
        }
        let written = rows.min(count * BLOCK_ROWS);
        self.pending.drain(..written * self.width);
        self.row += written;
        Ok(())
    }
}

fn block(
    meta: &MetaData,
    pixels: &[[f32; 4]],
    width: usize,
    row: usize,
) -> exr::error::Result<UncompressedBlock> {
    let index = BlockIndex {
        layer: 0,
        pixel_position: Vec2(0, row),
        pixel_size: Vec2(width, pixels.len() / width),
        level: Vec2(0, 0),
    };
    let channels = &meta.headers[0].channels;
    let mut fault = Ok(());
    let block = UncompressedBlock::from_lines(channels, index, |line| {
        let place = line.location;
        let row = &pixels[(place.position.y() - row) * width..][..width];
        let sample = CHANNELS[place.channel].1;
        let value = |k: usize| if sample == 3 { row[k][3] } else { row[k][sample] * row[k][3] };
        let written = line.write_samples(value);
        if fault.is_ok() {
            fault = written;
        }
    });
    fault.map(|()| block)
}

fn failed(error: exr::error::Error) -> Error {
    match error {
        exr::error::Error::Io(error) => Error::io("cannot write", error),
        other => Error::invalid(format!("cannot write an OpenEXR: {other}")),
    }
}

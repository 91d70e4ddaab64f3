//! Reading KTX2.

use ::ktx2::{LevelIndex, SupercompressionScheme};
use half::f16;

use super::super::header::{Header, parse_object};
use super::{KEY, is_justified};
use crate::amc::{Amc, TableSize, TexelFormat, Texels, texel_name};
use crate::{Error, Result};

impl Amc {
    /// Reads an AMC file's bytes.
    ///
    /// Rows stored from the top (`KTXorientation` = `rdo` or `rdi`) are turned over. The third letter makes no
    /// difference: the third axis is an azimuth, which lies neither inwards nor outwards.
    ///
    /// # Errors
    /// No KTX2, none of ours (the key `amc` is missing), another texture than a 3D one of one level in a format that an
    /// AMC can have, or damaged; sizes beyond [`TableSize::LIMIT`] or beyond what the file's own length can hold.
    pub fn from_ktx2(bytes: &[u8]) -> Result<Self> {
        let header = parse_header(bytes)?;
        let keys = key_values(bytes, header.index.kvd_byte_offset, header.index.kvd_byte_length)?;
        let find = |name: &str| keys.iter().find(|(key, _)| *key == name.as_bytes()).map(|(_, value)| *value);
        let json = find(KEY).ok_or_else(|| {
            Error::unsupported(
                "a KTX2 file, but no AMC: it has no key `amc` that says how to read its texels",
            )
        })?;
        let rows_from_the_top = orientation(find("KTXorientation"))?;
        let described = Header::from_json(parse_object(trim_nul(json), "the key `amc`")?)?;
        let (size, format) = shape(&header)?;
        let mut texels = texels(bytes, &header, size, format)?;
        check_finite(&texels, size)?;
        if rows_from_the_top {
            turn_rows_over(&mut texels, size);
        }
        described.amc(size, texels)
    }
}

fn parse_header(bytes: &[u8]) -> Result<::ktx2::Header> {
    if !bytes.starts_with(&::ktx2::MAGIC) {
        return Err(Error::malformed("not a KTX2 file").at_byte(0));
    }
    let header = bytes.first_chunk().ok_or_else(|| truncated("header", bytes))?;
    ::ktx2::Header::from_bytes(header)
        .map_err(|error| Error::malformed(format!("KTX2 header: {error}")).at_byte(12))
}

fn truncated(what: &str, bytes: &[u8]) -> Error {
    Error::malformed(format!("the file ends within its {what}")).at_byte(bytes.len() as u64)
}

/// The key/value pairs that the file's index points at.
fn key_values(bytes: &[u8], offset: u32, length: u32) -> Result<Vec<(&[u8], &[u8])>> {
    let end = u64::from(offset) + u64::from(length);
    let mut at = offset as usize;
    let data = usize::try_from(end).ok().and_then(|end| bytes.get(..end));
    let data = data.ok_or_else(|| truncated("key/value data", bytes))?;
    let mut pairs = Vec::new();
    while at < data.len() {
        let broken = |what: &str| Error::malformed(format!("key/value data: {what}")).at_byte(at as u64);
        let size = data[at..].first_chunk().map(|size| u32::from_le_bytes(*size));
        let size = size.ok_or_else(|| broken("the last pair is cut short"))? as usize;
        let pair = data[at + 4..].get(..size).ok_or_else(|| broken("a pair is longer than the data"))?;
        let nul = pair.iter().position(|&byte| byte == 0).ok_or_else(|| broken("a key has no end"))?;
        pairs.push((&pair[..nul], &pair[nul + 1..]));
        at = (at + 4 + size).next_multiple_of(4);
    }
    Ok(pairs)
}

fn trim_nul(text: &[u8]) -> &[u8] {
    text.strip_suffix(&[0]).unwrap_or(text)
}

/// Whether the rows are stored from the top.
fn orientation(value: Option<&[u8]>) -> Result<bool> {
    match value.map(trim_nul) {
        Some(b"ruo" | b"rui") => Ok(false),
        Some(b"rdo" | b"rdi") => Ok(true),
        Some(other) => Err(Error::unsupported(format!(
            "the orientation is {:?}; an AMC's is ruo (or rui, rdo, rdi)",
            String::from_utf8_lossy(other)
        ))
        .at_element("KTXorientation")),
        None => Err(Error::malformed("the key is missing: which way the rows run is not known")
            .at_element("KTXorientation")),
    }
}

/// The table's size and format as the header has them.
fn shape(header: &::ktx2::Header) -> Result<(TableSize, TexelFormat)> {
    let formats = [TexelFormat::Srgb8, TexelFormat::Half];
    let format =
        formats.into_iter().find(|format| Some(format.ktx2()) == header.format).ok_or_else(|| {
            let is = header.format.map_or("undefined or unknown".to_owned(), |format| format!("{format:?}"));
            Error::unsupported(format!(
                "the texel format is {is}; an AMC's is R8G8B8A8_SRGB or R16G16B16A16_SFLOAT"
            ))
            .at_byte(12)
        })?;
    let plain = header.layer_count == 0 && header.face_count == 1 && header.level_count <= 1;
    if header.pixel_depth == 0 || !plain {
        return Err(Error::unsupported("not a single level of a 3D texture, which an AMC is").at_byte(20));
    }
    if header.pixel_width != header.pixel_height {
        let (width, height) = (header.pixel_width, header.pixel_height);
        return Err(
            Error::malformed(format!("slices of {width} x {height} texels; an AMC's are square")).at_byte(20)
        );
    }
    let size = TableSize::new(header.pixel_width, header.pixel_depth).map_err(|error| error.at_byte(20))?;
    size.check_bytes(format).map_err(|error| error.at_byte(20))?;
    Ok((size, format))
}

/// Unpacks the texels; nothing is allocated before the sizes agree with each other and with the file's length.
fn texels(bytes: &[u8], header: &::ktx2::Header, size: TableSize, format: TexelFormat) -> Result<Texels> {
    let index = bytes.get(::ktx2::Header::LENGTH..).and_then(|rest| rest.first_chunk());
    let index = LevelIndex::from_bytes(index.ok_or_else(|| truncated("level index", bytes))?);
    let expected = size.texels() * format.bytes();
    let at_index = ::ktx2::Header::LENGTH as u64;
    if index.uncompressed_byte_length != expected as u64 {
        return Err(Error::malformed(format!(
            "the level is said to have {} bytes, but {} x {} x {} texels have {expected}",
            index.uncompressed_byte_length,
            size.side(),
            size.side(),
            size.slices()
        ))
        .at_byte(at_index + 16));
    }
    let end = index.byte_offset.checked_add(index.byte_length).and_then(|end| usize::try_from(end).ok());
    let level = end.and_then(|end| bytes.get(index.byte_offset as usize..end));
    let level = level.ok_or_else(|| truncated("texels", bytes))?;
    let packed = match header.supercompression_scheme {
        Some(SupercompressionScheme::Zstandard) => true,
        None => false,
        Some(scheme) => {
            let message = format!("supercompression {scheme:?}; an AMC's is Zstandard or none");
            return Err(Error::unsupported(message).at_byte(44));
        }
    };
    if packed && !is_justified(level.len() as u64, expected as u64) {
        return Err(Error::too_large(format!(
            "{} bytes are said to unpack to {expected}, which is more than a table can shrink",
            level.len()
        ))
        .at_byte(index.byte_offset));
    }
    if !packed && level.len() != expected {
        return Err(Error::malformed(format!("{} bytes of texels instead of {expected}", level.len()))
            .at_byte(at_index + 8));
    }
    Ok(match format {
        TexelFormat::Srgb8 => Texels::Srgb8(unpack(level, packed, size, index.byte_offset)?),
        TexelFormat::Half => Texels::Half(unpack(level, packed, size, index.byte_offset)?),
    })
}

fn unpack<T: bytemuck::Pod>(level: &[u8], packed: bool, size: TableSize, offset: u64) -> Result<Vec<T>> {
    let mut texels = vec![T::zeroed(); size.texels()];
    let bytes = bytemuck::cast_slice_mut::<T, u8>(&mut texels);
    if !packed {
        bytes.copy_from_slice(level);
        return Ok(texels);
    }
    let damaged =
        |what: String| Error::malformed(format!("the packed texels are damaged: {what}")).at_byte(offset);
    let length =
        zstd::bulk::decompress_to_buffer(level, bytes).map_err(|error| damaged(error.to_string()))?;
    if length == bytes.len() {
        Ok(texels)
    } else {
        Err(damaged(format!("{length} bytes instead of {}", bytes.len())))
    }
}

fn check_finite(texels: &Texels, size: TableSize) -> Result<()> {
    let Texels::Half(texels) = texels else { return Ok(()) };
    match texels.iter().position(|texel| !texel.iter().copied().all(f16::is_finite)) {
        Some(k) => Err(Error::malformed("a colour is no finite number").at_element(texel_name(size, k))),
        None => Ok(()),
    }
}

fn turn_rows_over(texels: &mut Texels, size: TableSize) {
    match texels {
        Texels::Srgb8(texels) => turn_over(texels, size),
        Texels::Half(texels) => turn_over(texels, size),
    }
}

fn turn_over<T>(texels: &mut [T], size: TableSize) {
    let side = size.side() as usize;
    for slice in texels.chunks_mut(side * side) {
        for j in 0..side / 2 {
            let (low, high) = slice.split_at_mut((side - 1 - j) * side);
            low[j * side..(j + 1) * side].swap_with_slice(&mut high[..side]);
        }
    }
}

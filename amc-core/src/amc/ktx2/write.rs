//! Writing KTX2.

use ::ktx2::{Header, Index, LevelIndex, SupercompressionScheme, dfd};

use super::super::header;
use super::{KEY, is_justified};
use crate::amc::Amc;
use crate::{Error, Result};

/// Zstandard's level: at 3 a table packs faster than a disk takes it.
const LEVEL: i32 = 3;

impl Amc {
    /// The bytes of an AMC file.
    ///
    /// # Errors
    /// The table is larger than readers take (2 GiB of texels), or its metadata cannot be written.
    pub fn to_ktx2(&self) -> Result<Vec<u8>> {
        let texels = self.texels().as_bytes();
        self.size().check_bytes(self.format())?;
        let packed = zstd::bulk::compress(texels, LEVEL)
            .map_err(|source| Error::io("cannot pack the texels", source))?;
        let packed = is_justified(packed.len() as u64, texels.len() as u64).then_some(packed);
        let (descriptor, type_size) = self.descriptor()?;
        let scheme = packed.as_ref().map(|_| SupercompressionScheme::Zstandard);
        let level = packed.as_deref().unwrap_or(texels);
        self.assemble(&descriptor, type_size, &self.key_values()?, scheme, level)
    }

    /// The data format descriptor with its total size before it, and the size of the type.
    ///
    /// The bytes of a texel stay in it under supercompression, as revision 4 of the specification demands; earlier ones
    /// wanted 0 there, and readers take both.
    fn descriptor(&self) -> Result<(Vec<u8>, u32)> {
        let (basic, type_size) = dfd::Basic::from_format(self.format().ktx2())
            .map_err(|error| Error::unsupported(format!("no data format descriptor: {error:?}")))?;
        let block = dfd::Block::Basic(basic).to_vec();
        let mut descriptor = (block.len() as u32 + 4).to_le_bytes().to_vec();
        descriptor.extend(block);
        Ok((descriptor, type_size))
    }

    /// The key/value data: keys sorted, values ended by NUL, entries padded to four bytes.
    fn key_values(&self) -> Result<Vec<u8>> {
        let json = serde_json::to_string(&header::Header::of(self).to_json()?)
            .map_err(|error| Error::invalid(format!("the metadata is no JSON: {error}")))?;
        let writer = concat!("AMC Studio ", env!("CARGO_PKG_VERSION"));
        let mut bytes = Vec::with_capacity(json.len() + 128);
        for (key, value) in [("KTXorientation", "ruo"), ("KTXwriter", writer), (KEY, &json)] {
            let length = u32::try_from(key.len() + value.len() + 2)
                .map_err(|_| Error::too_large("the metadata is larger than 4 GiB"))?;
            bytes.extend(length.to_le_bytes());
            for part in [key, value] {
                bytes.extend(part.as_bytes());
                bytes.push(0);
            }
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        Ok(bytes)
    }

    fn assemble(
        &self,
        descriptor: &[u8],
        type_size: u32,
        key_values: &[u8],
        scheme: Option<SupercompressionScheme>,
        level: &[u8],
    ) -> Result<Vec<u8>> {
        let too_large = |_| Error::too_large("the metadata is larger than 4 GiB");
        let descriptor_at = Header::LENGTH + LevelIndex::LENGTH;
        let key_values_at = descriptor_at + descriptor.len();
        let unpadded = key_values_at + key_values.len();
        // A level that is not packed starts at a multiple of its texel (and of 4); a packed one anywhere.
        let level_at = if scheme.is_some() { unpadded } else { unpadded.next_multiple_of(8) };
        let header = Header {
            format: Some(self.format().ktx2()),
            type_size,
            pixel_width: self.size().side(),
            pixel_height: self.size().side(),
            pixel_depth: self.size().slices(),
            layer_count: 0,
            face_count: 1,
            level_count: 1,
            supercompression_scheme: scheme,
            index: Index {
                dfd_byte_offset: descriptor_at as u32,
                dfd_byte_length: descriptor.len() as u32,
                kvd_byte_offset: key_values_at as u32,
                kvd_byte_length: u32::try_from(key_values.len()).map_err(too_large)?,
                sgd_byte_offset: 0,
                sgd_byte_length: 0,
            },
        };
        let index = LevelIndex {
            byte_offset: level_at as u64,
            byte_length: level.len() as u64,
            uncompressed_byte_length: self.texels().as_bytes().len() as u64,
        };
        let mut bytes = Vec::with_capacity(level_at + level.len());
        bytes.extend(header.as_bytes());
        bytes.extend(index.as_bytes());
        bytes.extend(descriptor);
        bytes.extend(key_values);
        bytes.resize(level_at, 0);
        bytes.extend(level);
        Ok(bytes)
    }
}

//! The GLB container, the JSON and the buffers.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::Document;
use gltf::buffer::Source;

use crate::mesh::Resolve;
use crate::{Error, Result};

/// Most objects in the JSON: each takes some hundred bytes in memory for as few as three in the file.
const OBJECT_LIMIT: usize = 200_000;

/// Extensions that may be required: they change nothing here, or only what accessors hold.
const KNOWN_EXTENSIONS: [&str; 6] = [
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_texture_basisu",
    "KHR_lights_punctual",
    "EXT_texture_webp",
    "MSFT_texture_dds",
];

/// The JSON and, in a GLB file, the binary chunk.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>)> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let word = |at: usize| {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk::<4>());
        four.map(|four| u32::from_le_bytes(*four))
            .ok_or_else(|| Error::malformed("cut short").at_byte(at as u64))
    };
    if word(4)? != 2 {
        return Err(Error::unsupported(format!("glTF version {}, not 2", word(4)?)).at_byte(4));
    }
    let length = word(8)? as usize;
    let bytes = bytes.get(..length).ok_or_else(|| {
        Error::malformed(format!("the header says {length} bytes, the file has {}", bytes.len())).at_byte(8)
    })?;
    let chunk = |at: usize| -> Result<&[u8]> {
        let length = word(at)? as usize;
        bytes.get(at + 8..).and_then(|rest| rest.get(..length)).ok_or_else(|| {
            Error::malformed(format!("a chunk of {length} bytes reaches past the end")).at_byte(at as u64)
        })
    };
    if word(16)? != u32::from_le_bytes(*b"JSON") {
        return Err(Error::malformed("the first chunk is not JSON").at_byte(16));
    }
    let json = chunk(12)?;
    let mut at = 20 + json.len();
    while at + 8 <= bytes.len() {
        let content = chunk(at)?;
        if word(at + 4)? == u32::from_le_bytes(*b"BIN\0") {
            return Ok((json, Some(content)));
        }
        at += 8 + content.len();
    }
    Ok((json, None))
}

/// The document, validated: every index in it is in range.
pub(super) fn document(json: &[u8]) -> Result<Document> {
    if json.iter().filter(|&&byte| byte == b'{').count() > OBJECT_LIMIT {
        return Err(Error::too_large(format!("more than {OBJECT_LIMIT} JSON objects")));
    }
    let mut root: gltf::json::Root = gltf::json::deserialize::from_slice(json)
        .map_err(|error| Error::malformed(format!("not glTF: {error}")).because(error))?;
    // The crate refuses extensions that need nothing from it.
    for extension in std::mem::take(&mut root.extensions_required) {
        if !KNOWN_EXTENSIONS.contains(&extension.as_str()) && !extension.starts_with("KHR_materials_") {
            return Err(Error::unsupported(format!(
                "requires the extension {}: save it uncompressed",
                crate::mesh::draft::clean_name(&extension)
            )));
        }
    }
    // The crate's validation looks up the positions' accessor before it checks that there is one.
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            if primitive.attributes.values().any(|accessor| accessor.value() >= root.accessors.len()) {
                let place = format!("meshes[{m}].primitives[{p}].attributes");
                return Err(Error::malformed("names an accessor that is not there").at_element(place));
            }
        }
    }
    Document::from_json(root).map_err(|error| match error {
        gltf::Error::Validation(faults) => match faults.first() {
            Some((path, fault)) => Error::malformed(fault.to_string()).at_element(path.to_string()),
            None => Error::malformed("not valid glTF"),
        },
        other => Error::malformed(other.to_string()),
    })
}

/// What the buffers hold. Several of them may name one file, or the one binary chunk: it is in memory once.
pub(super) struct Buffers<'a> {
    chunk: Option<&'a [u8]>,
    /// Read from files beside the mesh's, or decoded.
    owned: Vec<Vec<u8>>,
    /// One per buffer.
    contents: Vec<Content>,
}

#[derive(Clone, Copy)]
enum Content {
    Chunk,
    /// Index in [`Buffers::owned`].
    Owned(usize),
}

impl<'a> Buffers<'a> {
    /// Reads all buffers.
    ///
    /// # Errors
    /// A buffer that cannot be read, or is shorter than the document says; the error names it.
    pub(super) fn read(document: &Document, chunk: Option<&'a [u8]>, resolve: Resolve<'_>) -> Result<Self> {
        let mut buffers = Self { chunk, owned: Vec::new(), contents: Vec::new() };
        // Paths compare by their components: `a//b` is `a/b`.
        let mut files: HashMap<PathBuf, usize> = HashMap::new();
        for buffer in document.buffers() {
            let read = buffers.append(&buffer, &mut files, resolve);
            read.map_err(|error| error.at_element(format!("buffer {}", buffer.index())))?;
        }
        Ok(buffers)
    }

    fn append(
        &mut self,
        buffer: &gltf::Buffer<'_>,
        files: &mut HashMap<PathBuf, usize>,
        resolve: Resolve<'_>,
    ) -> Result<()> {
        let content = match buffer.source() {
            Source::Bin => Content::Chunk,
            Source::Uri(uri) => Content::Owned(match uri.strip_prefix("data:") {
                Some(data) => self.keep(decode_data(data)?),
                None => {
                    let name = decode_percent(uri)?;
                    match files.entry(PathBuf::from(&name)) {
                        Entry::Occupied(known) => *known.get(),
                        Entry::Vacant(new) => *new.insert(self.keep(resolve(&name)?)),
                    }
                }
            }),
        };
        self.contents.push(content);
        let length = match self.get(buffer.index()) {
            Some(bytes) => bytes.len(),
            None => return Err(Error::malformed("no binary chunk in the file")),
        };
        if length < buffer.length() {
            return Err(Error::malformed(format!("{length} bytes, not {}", buffer.length())));
        }
        Ok(())
    }

    fn keep(&mut self, bytes: Vec<u8>) -> usize {
        self.owned.push(bytes);
        self.owned.len() - 1
    }

    /// The content of a buffer.
    pub(super) fn get(&self, index: usize) -> Option<&[u8]> {
        match *self.contents.get(index)? {
            Content::Chunk => self.chunk,
            Content::Owned(owned) => self.owned.get(owned).map(Vec::as_slice),
        }
    }

    /// Bytes altogether: what they justify to allocate, however many buffers refer to the same.
    pub(super) fn bytes(&self) -> usize {
        self.chunk.map_or(0, <[u8]>::len) + self.owned.iter().map(Vec::len).sum::<usize>()
    }
}

/// What a URI stands for: data in it, or a file beside the document's.
pub(super) fn read_uri(uri: &str, resolve: Resolve<'_>) -> Result<Vec<u8>> {
    match uri.strip_prefix("data:") {
        Some(data) => decode_data(data),
        None => resolve(&decode_percent(uri)?),
    }
}

fn decode_data(data: &str) -> Result<Vec<u8>> {
    let (_, text) =
        data.split_once(";base64,").ok_or_else(|| Error::unsupported("a data URI that is not base64"))?;
    let config = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    let decoded = GeneralPurpose::new(&base64::alphabet::STANDARD, config).decode(text);
    decoded.map_err(|error| Error::malformed(format!("not base64: {error}")).because(error))
}

fn decode_percent(uri: &str) -> Result<String> {
    if uri.contains(':') {
        return Err(Error::unsupported(format!(
            "refers to {}: only files beside it are read",
            crate::mesh::draft::clean_name(uri)
        )));
    }
    let malformed = || Error::malformed("a file name that is not percent-encoded UTF-8");
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        if first == b'%' {
            let digits = after.first_chunk::<2>().and_then(|two| std::str::from_utf8(two).ok());
            bytes.push(digits.and_then(|two| u8::from_str_radix(two, 16).ok()).ok_or_else(malformed)?);
            rest = &after[2..];
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    String::from_utf8(bytes).map_err(|_| malformed())
}

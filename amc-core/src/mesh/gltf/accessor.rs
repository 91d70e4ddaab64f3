//! Numbers out of buffers.

use std::borrow::Cow;

use bytemuck::Pod;
use gltf::Accessor;
use gltf::accessor::sparse::IndexType;
use gltf::accessor::{DataType, Dimensions};
use rayon::prelude::*;

use super::container::Buffers;
use crate::{Error, Result};

/// Items that one task converts.
const CHUNK: usize = 8 * 1024;

/// Equally spaced items in a buffer, all of them inside it.
struct Items<'b> {
    bytes: &'b [u8],
    stride: usize,
    size: usize,
}

impl<'b> Items<'b> {
    fn new(
        buffers: &'b Buffers<'_>,
        view: &gltf::buffer::View<'_>,
        offset: usize,
        count: usize,
        size: usize,
    ) -> Result<Self> {
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(Error::malformed(format!("a stride of {stride} bytes for items of {size}")));
        }
        let outside =
            || Error::malformed(format!("{count} items reach past the end of buffer view {}", view.index()));
        let buffer = buffers.get(view.buffer().index()).ok_or_else(outside)?;
        let end = view.offset().checked_add(view.length()).ok_or_else(outside)?;
        let view_bytes = buffer.get(view.offset()..end).ok_or_else(outside)?;
        let length = match count.checked_sub(1) {
            None => Some(0),
            Some(steps) => steps.checked_mul(stride).and_then(|to_last| to_last.checked_add(size)),
        };
        let end = length.and_then(|length| offset.checked_add(length)).ok_or_else(outside)?;
        let bytes = view_bytes.get(offset..end).ok_or_else(outside)?;
        Ok(Self { bytes, stride, size })
    }

    fn iter(&self) -> impl Iterator<Item = &'b [u8]> + use<'b> {
        let size = self.size;
        // The last item may be shorter than a stride.
        self.bytes.chunks(self.stride).map(move |item| &item[..size.min(item.len())])
    }
}

/// Vectors of `N` floats: 32-bit, or 8 and 16-bit integers, normalised where the accessor says so. Each is appended
/// to `out` after `convert`.
pub(super) fn vectors<const N: usize, V>(
    accessor: &Accessor<'_>,
    buffers: &Buffers<'_>,
    out: &mut Vec<V>,
    convert: impl Fn(V) -> V + Sync,
) -> Result<()>
where
    V: Pod + From<[f32; N]> + Send + Sync,
{
    let wanted = match N {
        2 => Dimensions::Vec2,
        4 => Dimensions::Vec4,
        _ => Dimensions::Vec3,
    };
    if accessor.dimensions() != wanted {
        return Err(Error::malformed(format!("{:?} where {wanted:?} is needed", accessor.dimensions())));
    }
    if accessor.data_type() == DataType::F32
        && let Some(plain) = as_they_lie::<V>(accessor, buffers)?
    {
        out.par_extend(plain.par_iter().with_min_len(CHUNK).map(|&vector| convert(vector)));
        return Ok(());
    }
    let normalized = accessor.normalized();
    let vectors: Vec<[f32; N]> = match (accessor.data_type(), normalized) {
        (DataType::F32, _) => read(accessor, buffers, |b: [u8; 4]| f32::from_le_bytes(b)),
        (DataType::I8, false) => read(accessor, buffers, |[b]: [u8; 1]| f32::from(b as i8)),
        (DataType::U8, false) => read(accessor, buffers, |[b]: [u8; 1]| f32::from(b)),
        (DataType::I16, false) => read(accessor, buffers, |b: [u8; 2]| f32::from(i16::from_le_bytes(b))),
        (DataType::U16, false) => read(accessor, buffers, |b: [u8; 2]| f32::from(u16::from_le_bytes(b))),
        (DataType::I8, true) => {
            read(accessor, buffers, |[b]: [u8; 1]| (f32::from(b as i8) / 127.0).max(-1.0))
        }
        (DataType::U8, true) => read(accessor, buffers, |[b]: [u8; 1]| f32::from(b) / 255.0),
        (DataType::I16, true) => {
            read(accessor, buffers, |b: [u8; 2]| (f32::from(i16::from_le_bytes(b)) / 32767.0).max(-1.0))
        }
        (DataType::U16, true) => {
            read(accessor, buffers, |b: [u8; 2]| f32::from(u16::from_le_bytes(b)) / 65535.0)
        }
        (DataType::U32, _) => Err(Error::malformed("32-bit integers where floats are needed")),
    }?;
    out.extend(vectors.into_iter().map(V::from).map(convert));
    Ok(())
}

/// Indices of any width.
pub(super) fn indices<'b>(accessor: &Accessor<'_>, buffers: &'b Buffers<'_>) -> Result<Cow<'b, [u32]>> {
    if accessor.dimensions() != Dimensions::Scalar {
        return Err(Error::malformed("indices that are not scalars"));
    }
    if accessor.data_type() == DataType::U32
        && let Some(plain) = as_they_lie(accessor, buffers)?
    {
        return Ok(Cow::Borrowed(plain));
    }
    let vectors: Vec<[u32; 1]> = match accessor.data_type() {
        DataType::U8 => read(accessor, buffers, |[b]: [u8; 1]| u32::from(b)),
        DataType::U16 => read(accessor, buffers, |b: [u8; 2]| u32::from(u16::from_le_bytes(b))),
        DataType::U32 => read(accessor, buffers, u32::from_le_bytes),
        other => Err(Error::malformed(format!("indices of type {other:?}"))),
    }?;
    Ok(Cow::Owned(vectors.into_iter().flatten().collect()))
}

/// The items of a buffer in which they lie as they do in memory; none where they do not.
fn as_they_lie<'b, V: Pod>(accessor: &Accessor<'_>, buffers: &'b Buffers<'_>) -> Result<Option<&'b [V]>> {
    let size = size_of::<V>();
    let Some(view) = accessor.view().filter(|view| {
        cfg!(target_endian = "little")
            && accessor.sparse().is_none()
            && view.stride().is_none_or(|stride| stride == size)
    }) else {
        return Ok(None);
    };
    let items = Items::new(buffers, &view, accessor.offset(), accessor.count(), size)?;
    // Not where the file aligns them badly.
    Ok(bytemuck::try_cast_slice(items.bytes).ok())
}

/// All items of an accessor, components of `W` bytes turned by `decode`; sparse ones in their places.
fn read<T: Copy + Default, const N: usize, const W: usize>(
    accessor: &Accessor<'_>,
    buffers: &Buffers<'_>,
    decode: impl Fn([u8; W]) -> T,
) -> Result<Vec<[T; N]>> {
    let (count, size) = (accessor.count(), N * W);
    let item = |bytes: &[u8]| {
        let mut item = [T::default(); N];
        for (component, bytes) in item.iter_mut().zip(bytes.as_chunks::<W>().0) {
            *component = decode(*bytes);
        }
        item
    };
    let mut all: Vec<[T; N]> = match (accessor.view(), accessor.sparse()) {
        (Some(view), _) => {
            let items = Items::new(buffers, &view, accessor.offset(), count, size)?;
            if items.stride == size {
                items.bytes.chunks_exact(size).map(item).collect()
            } else {
                items.iter().map(item).collect()
            }
        }
        (None, Some(_)) if count <= buffers.bytes() => {
            vec![[T::default(); N]; count]
        }
        (None, Some(_)) => {
            return Err(Error::too_large(format!("{count} items, more than the file's size justifies")));
        }
        (None, None) => return Err(Error::malformed("an accessor without a buffer view")),
    };
    if let Some(sparse) = accessor.sparse() {
        let (indices, values) = (sparse.indices(), sparse.values());
        let width = match indices.index_type() {
            IndexType::U8 => 1,
            IndexType::U16 => 2,
            IndexType::U32 => 4,
        };
        let places = Items::new(buffers, &indices.view(), indices.offset(), sparse.count(), width)?;
        let values = Items::new(buffers, &values.view(), values.offset(), sparse.count(), size)?;
        for (place, value) in places.iter().zip(values.iter()) {
            let place = place.iter().rev().fold(0usize, |number, &byte| number << 8 | usize::from(byte));
            let slot = all.get_mut(place);
            *slot.ok_or_else(|| Error::malformed(format!("sparse index {place}, of {count}")))? = item(value);
        }
    }
    Ok(all)
}

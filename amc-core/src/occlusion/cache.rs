//! Occlusion kept in a folder, under a name made from what it is computed from.

use std::path::Path;

use glam::Vec2;

use super::{Options, compute};
use crate::mesh::Garment;
use crate::{Error, Progress, Result, file};

/// The first bytes of a cache file; raised when the way occlusion is computed changes, for it goes into the key.
const MAGIC: &[u8; 8] = b"AMCOCC02";
/// Magic and the BLAKE3 hash of the numbers that follow.
const HEAD: usize = 8 + 32;

/// As [`compute`], but read from `folder` where it was computed before, and kept there afterwards.
///
/// The file's name is the BLAKE3 hash of the geometry and the options. A damaged file is computed again, a file that
/// cannot be written is not kept: both are said in the log. The folder can be deleted at any time.
///
/// # Errors
/// As [`compute`].
pub fn cached(
    garment: &Garment,
    options: Options,
    folder: &Path,
    progress: &Progress<'_>,
) -> Result<Vec<Vec2>> {
    let path = folder.join(format!("{}.occlusion", key(garment, options).to_hex()));
    if path.exists() {
        match read(&path, garment.positions.len()) {
            Ok(open) => return Ok(open),
            Err(error) => log::warn!("occlusion is computed again: {error}"),
        }
    }
    let open = compute(garment, options, progress)?;
    if let Err(error) = save(&path, folder, &open) {
        log::warn!("occlusion is not kept: {error}");
    }
    Ok(open)
}

fn key(garment: &Garment, options: Options) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(MAGIC).update(&options.rays.to_le_bytes());
    for count in [garment.positions.len(), garment.triangles.len()] {
        hasher.update(&(count as u64).to_le_bytes());
    }
    hasher.update(bytemuck::cast_slice(&garment.positions));
    hasher.update(bytemuck::cast_slice(&garment.normals));
    hasher.update(bytemuck::cast_slice(&garment.triangles));
    hasher.finalize()
}

fn read(path: &Path, vertices: usize) -> Result<Vec<Vec2>> {
    let expected = HEAD + 8 * vertices;
    let bytes = file::read(path, expected as u64)?;
    let damaged = |what: &str| Error::malformed(what).in_file(path);
    let (head, numbers) = bytes.split_at_checked(HEAD).ok_or_else(|| damaged("it is cut short"))?;
    if bytes.len() != expected || !head.starts_with(MAGIC) {
        return Err(damaged("it is not the occlusion of this mesh"));
    }
    if head[MAGIC.len()..] != *blake3::hash(numbers).as_bytes() {
        return Err(damaged("its checksum is wrong"));
    }
    let numbers: Vec<f32> = numbers.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
    Ok(numbers.as_chunks().0.iter().map(|&sides| Vec2::from_array(sides)).collect())
}

fn save(path: &Path, folder: &Path, open: &[Vec2]) -> Result<()> {
    std::fs::create_dir_all(folder)
        .map_err(|source| Error::io("cannot make the folder", source).in_file(folder))?;
    let numbers: Vec<u8> = open.iter().flat_map(|open| open.to_array()).flat_map(f32::to_le_bytes).collect();
    let mut bytes = MAGIC.to_vec();
    bytes.extend(blake3::hash(&numbers).as_bytes());
    bytes.extend(numbers);
    file::save_bytes(path, &bytes)
}

//! A folder with a picture of each slice (PNG for 8-bit tables, OpenEXR for half-float ones) and `slices.json`: the JSON
//! of an AMC file and, under `slices`, the pictures' names in order. The top row of a picture is `n_y` near 1.

use std::collections::HashSet;
use std::path::{Component, Path};

use super::sheet::Sheet;
use super::{Form, Kind, MOST_BYTES, Source};
use crate::amc::{Amc, Header, TableSize, TexelFormat, Texels, parse_object};
use crate::{Error, Result, file};

const LIST: &str = "slices.json";

pub(super) const FORM: Form = Form {
    kind: Kind::Slices,
    name: "slice folder",
    ends: &[],
    is: |source| matches!(source, Source::Folder(path) if path.join(LIST).is_file()),
    read: |source| match source {
        Source::Folder(path) => read(path),
        Source::File(_) => Err(Error::unsupported("a file, where a folder of slices is expected")),
    },
    write,
};

/// The most bytes of a list.
const MOST_LIST_BYTES: u64 = 64 << 20;

fn read(folder: &Path) -> Result<Amc> {
    let json = file::read(&folder.join(LIST), MOST_LIST_BYTES)?;
    assemble(folder, &json, &|name| file::read(&folder.join(name), MOST_BYTES))
}

/// The table of a list and of the pictures that it names; `picture` gives their bytes, errors name them as files of
/// `folder`.
pub(super) fn assemble(folder: &Path, json: &[u8], picture: &dyn Fn(&str) -> Result<Vec<u8>>) -> Result<Amc> {
    let in_list = |error: Error| error.in_file(&folder.join(LIST));
    let (header, names) = parse(json).map_err(in_list)?;
    let slices = u32::try_from(names.len()).unwrap_or(u32::MAX);
    let mut size = None;
    let mut texels: Option<Texels> = None;
    for name in &names {
        let in_picture = |error: Error| error.in_file(&folder.join(name));
        let sheet = picture(name).and_then(|bytes| Sheet::decode(&bytes)).map_err(in_picture)?;
        let expected = match size {
            Some(size) => size,
            None => *size.insert(size_of(&sheet, slices).map_err(in_picture)?),
        };
        let side = expected.side();
        if (sheet.width, sheet.height) != (side, side) {
            let message = format!("{} x {} pixels; {side} x {side} were expected", sheet.width, sheet.height);
            return Err(in_picture(Error::malformed(message)));
        }
        append(&mut texels, sheet, side as usize).map_err(in_picture)?;
    }
    match (size, texels) {
        (Some(size), Some(texels)) => header.amc(size, texels),
        _ => Err(in_list(Error::malformed("names no picture").at_element("slices"))),
    }
}

/// The size that the first slice sets.
fn size_of(sheet: &Sheet, slices: u32) -> Result<TableSize> {
    let size = TableSize::new(sheet.width, slices)?;
    size.check_bytes(match sheet.texels {
        Texels::Srgb8(_) => TexelFormat::Srgb8,
        Texels::Half(_) => TexelFormat::Half,
    })?;
    Ok(size)
}

fn parse(json: &[u8]) -> Result<(Header, Vec<String>)> {
    let mut map = parse_object(json, "the list of slices")?;
    let names =
        map.remove("slices").ok_or_else(|| Error::malformed("the key is missing").at_element("slices"))?;
    let names: Vec<String> = serde_json::from_value(names)
        .map_err(|error| Error::malformed(error.to_string()).at_element("slices"))?;
    let mut seen = HashSet::new();
    for (k, name) in names.iter().enumerate() {
        let path = Path::new(name);
        // A list from elsewhere must not reach out of its folder.
        let plain = path.components().all(|part| matches!(part, Component::Normal(_)));
        let fault = if !plain || name.is_empty() {
            "is no file in the folder"
        } else if !seen.insert(path) {
            // One small picture could stand for any number of slices.
            "is named twice: give every slice a picture of its own"
        } else {
            continue;
        };
        return Err(Error::malformed(format!("{name:?} {fault}")).at_element(format!("slices[{k}]")));
    }
    Ok((Header::from_json(map)?, names))
}

/// Adds a slice, its rows turned to run upwards.
fn append(texels: &mut Option<Texels>, sheet: Sheet, side: usize) -> Result<()> {
    match (texels, sheet.texels) {
        (Some(Texels::Srgb8(all)), Texels::Srgb8(slice)) => all.extend(upwards(&slice, side)),
        (Some(Texels::Half(all)), Texels::Half(slice)) => all.extend(upwards(&slice, side)),
        (texels @ None, Texels::Srgb8(slice)) => {
            *texels = Some(Texels::Srgb8(upwards(&slice, side).collect()))
        }
        (texels @ None, Texels::Half(slice)) => *texels = Some(Texels::Half(upwards(&slice, side).collect())),
        (Some(_), _) => return Err(Error::unsupported("the slices are not all of one depth")),
    }
    Ok(())
}

fn upwards<T: Copy>(slice: &[T], side: usize) -> impl Iterator<Item = T> {
    slice.chunks_exact(side).rev().flatten().copied()
}

fn write(amc: &Amc, folder: &Path) -> Result<Vec<String>> {
    std::fs::create_dir_all(folder).map_err(|source| Error::io("cannot make the folder", source))?;
    let side = amc.size().side();
    let mut names = Vec::new();
    for s in 0..amc.size().slices() {
        let (texels, suffix) = match amc.texels() {
            Texels::Srgb8(texels) => (Texels::Srgb8(slice(texels, amc.size(), s)), "png"),
            Texels::Half(texels) => (Texels::Half(slice(texels, amc.size(), s)), "exr"),
        };
        let name = format!("slice-{s:04}.{suffix}");
        let path = folder.join(&name);
        let bytes = Sheet { width: side, height: side, texels }.encode(&[]);
        file::save_bytes(&path, &bytes.map_err(|error| error.in_file(&path))?)?;
        names.push(serde_json::Value::from(name));
    }
    let mut json = Header::of(amc).to_json()?;
    json.insert("slices".into(), names.into());
    let json = format!("{:#}\n", serde_json::Value::Object(json));
    // Last, so that a list stands only beside all that it names.
    file::save_bytes(&folder.join(LIST), json.as_bytes())?;
    Ok(Vec::new())
}

/// Slice `s` with its rows from the top.
fn slice<T: Copy>(texels: &[T], size: TableSize, s: u32) -> Vec<T> {
    let start = s as usize * size.slice_texels();
    upwards(&texels[start..start + size.slice_texels()], size.side() as usize).collect()
}

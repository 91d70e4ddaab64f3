//! All slices in one picture, side by side, left to right, then downwards; within a slice the top row is `n_y` near 1.
//!
//! PNG holds 8-bit tables, OpenEXR half-float ones, both exactly. A text chunk (attribute) `amc` holds the JSON of an AMC
//! file and, under `atlas`, the side and number of slices and how many stand in a row.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::sheet::{self, Sheet};
use super::{Form, Kind, Source};
use crate::amc::{Amc, Header, TableSize, Texels, parse_object};
use crate::image::decode::MOST_PIXELS;
use crate::{Error, Result, file};

const KEY: &str = "amc";

pub(super) const FORM: Form = Form {
    kind: Kind::Atlas,
    name: "slice atlas",
    ends: &[".atlas.png", ".atlas.exr", ".png"],
    is: |source| matches!(source, Source::File(bytes) if sheet::text(bytes, KEY).is_some()),
    read: |source| read(source.bytes()?),
    write,
};

/// How slices stand in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Layout {
    side: u32,
    slices: u32,
    columns: u32,
}

impl Layout {
    /// As square as whole slices allow.
    fn of(size: TableSize) -> Self {
        let columns = (1..).find(|columns| columns * columns >= size.slices()).unwrap_or(1);
        Self { side: size.side(), slices: size.slices(), columns }
    }

    fn width(self) -> u32 {
        self.side * self.columns
    }

    fn height(self) -> u32 {
        self.side * self.slices.div_ceil(self.columns)
    }

    /// Where the texels of each row of each slice start in the picture, in the order of the table.
    fn rows(self) -> impl Iterator<Item = usize> {
        let Self { side, slices, columns } = self;
        let width = self.width() as usize;
        (0..slices).flat_map(move |s| {
            (0..side).map(move |j| {
                let y = s / columns * side + (side - 1 - j);
                y as usize * width + (s % columns * side) as usize
            })
        })
    }

    fn arrange<T: bytemuck::Zeroable + Copy>(self, texels: &[T]) -> Vec<T> {
        let mut pixels = vec![T::zeroed(); self.width() as usize * self.height() as usize];
        let side = self.side as usize;
        for (row, at) in texels.chunks_exact(side).zip(self.rows()) {
            pixels[at..at + side].copy_from_slice(row);
        }
        pixels
    }

    fn gather<T: Copy>(self, pixels: &[T]) -> Vec<T> {
        self.rows().flat_map(|at| pixels[at..at + self.side as usize].iter().copied()).collect()
    }
}

fn read(bytes: &[u8]) -> Result<Amc> {
    let json = sheet::text(bytes, KEY).ok_or_else(|| {
        Error::unsupported("no slice atlas: it has no text `amc` that says how the slices stand")
    })?;
    let mut map = parse_object(json.as_bytes(), "the text `amc`")?;
    let layout =
        map.remove("atlas").ok_or_else(|| Error::malformed("the key is missing").at_element("atlas"))?;
    let layout: Layout = serde_json::from_value(layout)
        .map_err(|error| Error::malformed(error.to_string()).at_element("atlas"))?;
    let header = Header::from_json(map)?;
    let size = TableSize::new(layout.side, layout.slices).map_err(|error| error.at_element("atlas"))?;
    if !(1..=layout.slices).contains(&layout.columns) {
        let message = format!("{} slices cannot stand in rows of {}", layout.slices, layout.columns);
        return Err(Error::malformed(message).at_element("atlas"));
    }
    let sheet = Sheet::decode(bytes)?;
    if (sheet.width, sheet.height) != (layout.width(), layout.height()) {
        return Err(Error::malformed(format!(
            "a picture of {} x {} pixels, but its slices need {} x {}",
            sheet.width,
            sheet.height,
            layout.width(),
            layout.height()
        )));
    }
    let texels = match &sheet.texels {
        Texels::Srgb8(pixels) => Texels::Srgb8(layout.gather(pixels)),
        Texels::Half(pixels) => Texels::Half(layout.gather(pixels)),
    };
    header.amc(size, texels)
}

fn write(amc: &Amc, path: &Path) -> Result<Vec<String>> {
    let (texels, lost) = sheet::texels_for(amc, path)?;
    let layout = Layout::of(amc.size());
    let pixels = u64::from(layout.width()) * u64::from(layout.height());
    if pixels > MOST_PIXELS {
        return Err(Error::too_large(format!(
            "an atlas of {pixels} pixels; {MOST_PIXELS} can be read back: write a folder of slices"
        )));
    }
    let texels = match &texels {
        Texels::Srgb8(texels) => Texels::Srgb8(layout.arrange(texels)),
        Texels::Half(texels) => Texels::Half(layout.arrange(texels)),
    };
    let mut json = Header::of(amc).to_json()?;
    let described = serde_json::to_value(layout).map_err(|error| Error::invalid(error.to_string()))?;
    json.insert("atlas".into(), described);
    let json = sheet::ascii(&serde_json::Value::Object(json).to_string());
    let sheet = Sheet { width: layout.width(), height: layout.height(), texels };
    file::save_bytes(path, &sheet.encode(&[(KEY, &json)])?)?;
    Ok(lost)
}

//! An ordinary MatCap: one picture of a ball that fills it.
//!
//! Out of an AMC it is the mean over the slices (paper, section 5.3). As an AMC it is one slice that any direction of the
//! cloth looks up. Its row 0 is the top (the MatCap how-to flips v for it), its corners are filled from the rim.

use std::path::Path;

use super::sheet;
use super::{Form, Kind, Source};
use crate::amc::{Amc, Frame, LinearTable, Metadata, Symmetry, TableSize, TexelFormat};
use crate::image::decode::{Format, Samples, decode};
use crate::image::{Picture, encode};
use crate::view_space::Azimuth;
use crate::{Error, Result};

pub(super) const FORM: Form = Form {
    kind: Kind::MatCap,
    name: "MatCap",
    ends: &[".matcap.png", ".matcap.exr", ".exr"],
    is: |source| matches!(source, Source::File(bytes) if Format::of(bytes).is_some()),
    read: |source| {
        let raster = decode(source.bytes()?)?;
        let format = match raster.samples() {
            Samples::U8(_) => TexelFormat::Srgb8,
            _ => TexelFormat::Half,
        };
        // Before the pixels take four times their room in the file.
        let size = size_of(raster.width(), raster.height())?;
        amc_of(size, &raster.to_picture(), format)
    },
    write,
};

fn size_of(width: u32, height: u32) -> Result<TableSize> {
    if width != height {
        let message = format!("{width} x {height} pixels; a MatCap is a square that the ball fills");
        return Err(Error::unsupported(message));
    }
    TableSize::new(width, 1)
}

/// A MatCap as an AMC of one slice. Pixels that are not wholly covered (alpha below 1) are filled from their neighbours.
fn amc_of(size: TableSize, picture: &Picture, format: TexelFormat) -> Result<Amc> {
    let rows = picture.pixels().chunks_exact(size.side() as usize).rev();
    let measured = |&[r, g, b, a]: &[f32; 4]| if a >= 1.0 { [r, g, b, 1.0] } else { [0.0; 4] };
    let texels = rows.flatten().map(measured).collect();
    let mut table = LinearTable { size, texels, symmetry: Symmetry::One, azimuth: Azimuth::Transported };
    table.fill()?;
    Amc::from_linear(&table, format, Frame::default(), Metadata::default())
}

fn write(amc: &Amc, path: &Path) -> Result<Vec<String>> {
    let picture = amc.isotropic();
    let mut lost = vec!["the direction of the cloth: a MatCap is the mean over all of them".to_owned()];
    if sheet::is_exr(path)? {
        encode::write_exr(&picture, path)?;
    } else {
        lost.extend(sheet::lost_in_png(amc.format(), picture.pixels()));
        encode::write_png(&picture, path, &[])?;
    }
    Ok(lost)
}

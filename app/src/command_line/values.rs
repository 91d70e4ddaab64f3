//! Values that are written in a form of their own on the command line.

use std::str::FromStr;

use crate::pictures::SIDE_LIMIT;

/// `WxH` in pixels, each 1 to [`SIDE_LIMIT`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PictureSize {
    pub(super) width: u32,
    pub(super) height: u32,
}

impl FromStr for PictureSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed = text
            .split_once(['x', 'X'])
            .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
        match parsed {
            Some((width @ 1..=SIDE_LIMIT, height @ 1..=SIDE_LIMIT)) => Ok(Self { width, height }),
            _ => Err(format!("expected WIDTHxHEIGHT, each 1 to {SIDE_LIMIT}, such as 1024x768")),
        }
    }
}

/// `RRGGBB`, sRGB, or `none`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Background(pub(super) Option<[f32; 3]>);

impl FromStr for Background {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "none" {
            return Ok(Self(None));
        }
        let digits = text.trim_start_matches('#');
        let well_formed = digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let value = well_formed.then(|| u32::from_str_radix(digits, 16).ok()).flatten();
        let [_, red, green, blue] = value.ok_or("expected RRGGBB in hexadecimal, or none")?.to_be_bytes();
        let linear = |value: u8| amc_core::color::linear_from_srgb(f32::from(value) / 255.0);
        Ok(Self(Some([red, green, blue].map(linear))))
    }
}

/// `auto`, or `CX,CY,R` in pixels with an optional `px`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sphere {
    Auto,
    Given { x: f32, y: f32, radius: f32 },
}

impl FromStr for Sphere {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let numbers: Result<Vec<f32>, _> =
            text.trim_end_matches("px").split(',').map(|number| number.trim().parse::<f32>()).collect();
        match numbers.as_deref() {
            Ok(&[x, y, radius]) if x.is_finite() && y.is_finite() && radius.is_finite() && radius > 0.0 => {
                Ok(Self::Given { x, y, radius })
            }
            _ => Err("expected auto, or X,Y,RADIUS in pixels with a radius above 0, such as 320,240,180px"
                .to_owned()),
        }
    }
}

/// `ortho`, or the horizontal field of view in degrees, above 0 and below 180.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FieldOfView {
    Orthographic,
    Degrees(f32),
}

impl FromStr for FieldOfView {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "ortho" {
            return Ok(Self::Orthographic);
        }
        match text.parse::<f32>() {
            Ok(degrees) if degrees > 0.0 && degrees < 180.0 => Ok(Self::Degrees(degrees)),
            _ => Err("expected ortho, or the horizontal field of view in degrees, above 0 and below 180"
                .to_owned()),
        }
    }
}

/// `auto`, 1, 2, 3 or 4.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SymmetryChoice(pub(super) Option<amc_core::amc::Symmetry>);

impl FromStr for SymmetryChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self(None));
        }
        let order = text.parse::<u32>().ok().and_then(|order| order.try_into().ok());
        order.map(|symmetry| Self(Some(symmetry))).ok_or_else(|| "expected auto, 1, 2, 3 or 4".to_owned())
    }
}

/// A finite number, for angles.
pub(super) fn finite(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err("expected a finite number".to_owned()),
    }
}

/// What a mesh's numbers mean.
pub(super) fn unit(text: &str) -> Result<amc_core::mesh::Unit, String> {
    text.parse().map_err(|error: amc_core::Error| error.to_string())
}

/// The table's azimuth.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub(super) enum AzimuthChoice {
    Transported,
    Projected,
}

impl From<AzimuthChoice> for amc_core::view_space::Azimuth {
    fn from(choice: AzimuthChoice) -> Self {
        match choice {
            AzimuthChoice::Transported => Self::Transported,
            AzimuthChoice::Projected => Self::Projected,
        }
    }
}

/// The format of the table's texels.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub(super) enum FormatChoice {
    /// 8-bit sRGB.
    Srgb8,
    /// 16-bit float, linear.
    Half,
}

impl From<FormatChoice> for amc_core::amc::TexelFormat {
    fn from(choice: FormatChoice) -> Self {
        match choice {
            FormatChoice::Srgb8 => Self::Srgb8,
            FormatChoice::Half => Self::Half,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_spheres_are_read_or_refused() {
        assert_eq!("640x480".parse(), Ok(PictureSize { width: 640, height: 480 }));
        for wrong in ["640", "0x4", "4x99999", "ax4", "-1x3"] {
            assert!(wrong.parse::<PictureSize>().is_err(), "{wrong}");
        }
        assert_eq!("1,2.5,3px".parse(), Ok(Sphere::Given { x: 1.0, y: 2.5, radius: 3.0 }));
        for wrong in ["1,2", "1,2,0", "1,2,NaN", "inf,2,3", ""] {
            assert!(wrong.parse::<Sphere>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn colours_are_srgb_and_fields_of_view_bounded() {
        assert_eq!("none".parse(), Ok(Background(None)));
        assert_eq!("ffffff".parse(), Ok(Background(Some([1.0; 3]))));
        assert!("fffff".parse::<Background>().is_err());
        assert!("+fffff".parse::<Background>().is_err());
        assert!("180".parse::<FieldOfView>().is_err());
        assert_eq!("ortho".parse(), Ok(FieldOfView::Orthographic));
    }
}

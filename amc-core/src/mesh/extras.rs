//! The `extras` of a glTF file that are meant for this program: one form, for reading and for writing. What they mean
//! is documented in [`super::gltf`].

use glam::Vec2;
use serde::{Deserialize, Serialize};

use super::draft::clean_name;
use super::{Garment, Panel, PatternPiece, Seam};

/// The version that is written, and the last that is read.
pub(crate) const VERSION: u32 = 1;

/// What stands under the key `amc`. Keys that are not known are passed over.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Extras {
    pub(crate) version: Option<u32>,
    pub(crate) name: Option<String>,
    pub(crate) fabric: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) uv_unit_m: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) grain_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) mirror: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) seams: Vec<SeamExtras>,
}

/// A seam. A file that says where it is says it all.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct SeamExtras {
    #[serde(default)]
    name: String,
    edge: [Vec2; 2],
    partner: String,
    partner_edge: [Vec2; 2],
}

impl Extras {
    /// What is said here, and for the rest what `other` says.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            version: self.version.or(other.version),
            name: self.name.or(other.name),
            fabric: self.fabric.or(other.fabric),
            uv_unit_m: self.uv_unit_m.or(other.uv_unit_m),
            grain_deg: self.grain_deg.or(other.grain_deg),
            mirror: self.mirror.or(other.mirror),
            seams: if self.seams.is_empty() { other.seams } else { self.seams },
        }
    }

    /// The pattern's part of it, not yet checked.
    pub(crate) fn into_pattern(self) -> PatternPiece<String> {
        let seam = |seam: SeamExtras| Seam {
            name: clean_name(&seam.name),
            edge: seam.edge,
            partner: clean_name(&seam.partner),
            partner_edge: seam.partner_edge,
        };
        PatternPiece {
            grain: self.grain_deg.map(|degrees| (degrees % 360.0).to_radians() as f32),
            mirror: self.mirror.as_deref().map(clean_name),
            seams: self.seams.into_iter().map(seam).collect(),
            uv_unit: self.uv_unit_m,
        }
    }

    /// What is to be said of a panel; partners go by their names.
    pub(crate) fn of(garment: &Garment, panel: &Panel) -> Self {
        Self::moved(garment, panel, |_, at| at)
    }

    /// The same where the UVs are moved: `place` says where a point of the panel of a number comes to lie. Grain and unit are
    /// those of the panel as it was.
    pub(crate) fn moved(garment: &Garment, panel: &Panel, place: impl Fn(usize, Vec2) -> Vec2) -> Self {
        let index = garment.panels.iter().position(|other| other.id == panel.id).unwrap_or_default();
        let name = |panel: usize| garment.panels.get(panel).map(|panel| panel.name.clone());
        let seam = |seam: &Seam<usize>| {
            Some(SeamExtras {
                name: seam.name.clone(),
                edge: seam.edge.map(|at| place(index, at)),
                partner: name(seam.partner)?,
                partner_edge: seam.partner_edge.map(|at| place(seam.partner, at)),
            })
        };
        Self {
            version: Some(VERSION),
            name: Some(panel.name.clone()),
            fabric: Some(panel.takes_fabric),
            uv_unit_m: panel.pattern.uv_unit,
            grain_deg: panel.pattern.grain.map(shortest_degrees),
            mirror: panel.pattern.mirror.and_then(name),
            seams: panel.pattern.seams.iter().filter_map(seam).collect(),
        }
    }
}

/// The number of degrees with the fewest decimal places that means this very angle.
pub(crate) fn shortest_degrees(radians: f32) -> f64 {
    let exact = f64::from(radians).to_degrees();
    let rounded = |places: i32| {
        let scale = 10f64.powi(places);
        (exact * scale).round() / scale
    };
    (0..12).map(rounded).find(|degrees| degrees.to_radians() as f32 == radians).unwrap_or(exact)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_is_written_shortly_and_comes_back() {
        for (degrees, short) in [(90.0f32, 90.0), (-37.5, -37.5), (180.0, 180.0), (0.0, 0.0), (12.3, 12.3)] {
            assert_eq!(shortest_degrees(degrees.to_radians()), short);
        }
        for k in 0..1000 {
            let radians = (k as f32 * 0.7).sin() * std::f32::consts::PI;
            assert_eq!(shortest_degrees(radians).to_radians() as f32, radians);
        }
    }
}

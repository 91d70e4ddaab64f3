//! Small pictures: a fabric as a ball, a panel as its flat piece.

use std::sync::Arc;

use amc_core::amc::Amc;
use amc_core::color::srgb8_from_linear;
use amc_core::mesh::{Garment, Panel};
use amc_core::view_space::perpendicular;
use eframe::egui::{self, Color32, ColorImage, TextureHandle};
use glam::{Vec2, Vec3};

/// Pixels along each side: twice the points at which they are shown.
pub(super) const SIDE: usize = 48;

/// Samples along each side of a pixel.
const SAMPLES: usize = 4;

/// Share of the side that is left free on each side of a piece.
const MARGIN: f32 = 0.06;

/// A ball in the fabric, its warp running across, as it lies in front of a camera.
pub(super) fn ball(amc: &Amc) -> ColorImage {
    let table = amc.to_linear();
    let colour_at = |at: Vec2| {
        let n = Vec3::new(at.x, at.y, (1.0 - at.length_squared()).max(0.0).sqrt());
        table.look_up(at, table.azimuth.of(n, perpendicular(Vec3::X, n)))
    };
    picture(|at| {
        let place = (at * 2.0 - 1.0) * Vec2::new(1.0, -1.0) / 0.96;
        (place.length_squared() <= 1.0).then(|| colour_at(place))
    })
}

/// The panel's flat piece in white, v up; all of the square where it has no UVs.
pub(super) fn piece(garment: &Garment, panel: &Panel) -> ColorImage {
    let Some(mask) = Mask::of(garment, panel) else {
        return picture(|at| (at - 0.5).abs().max_element().le(&0.4).then_some([1.0; 3]));
    };
    picture(|at| mask.holds(at).then_some([1.0; 3]))
}

/// A picture of what `colour` gives for places from the top-left corner, 0 to 1: linear light, or nothing.
fn picture(colour: impl Fn(Vec2) -> Option<[f32; 3]>) -> ColorImage {
    let mut image = ColorImage::filled([SIDE, SIDE], Color32::TRANSPARENT);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        let mut sum = [0.0; 4];
        for sample in 0..SAMPLES * SAMPLES {
            let within = Vec2::new((sample % SAMPLES) as f32 + 0.5, (sample / SAMPLES) as f32 + 0.5);
            let corner = Vec2::new((k % SIDE) as f32, (k / SIDE) as f32);
            if let Some([r, g, b]) = colour((corner + within / SAMPLES as f32) / SIDE as f32) {
                for (sum, value) in sum.iter_mut().zip([r, g, b, 1.0]) {
                    *sum += value;
                }
            }
        }
        if sum[3] > 0.0 {
            let [r, g, b] = [0, 1, 2].map(|k| srgb8_from_linear(sum[k] / sum[3]));
            let alpha = sum[3] / (SAMPLES * SAMPLES) as f32 * 255.0;
            *pixel = Color32::from_rgba_unmultiplied(r, g, b, alpha.round() as u8);
        }
    }
    image
}

/// Which samples of the picture a flat piece covers.
struct Mask {
    covered: Vec<bool>,
}

impl Mask {
    const SIDE: usize = SIDE * SAMPLES;

    /// None where there are no UVs to draw.
    fn of(garment: &Garment, panel: &Panel) -> Option<Self> {
        let range = panel.triangles.start as usize..panel.triangles.end as usize;
        let triangles = garment.has_uvs.then(|| garment.triangles.get(range))??;
        let corners = |triangle: &[u32; 3]| triangle.map(|corner| garment.uvs[corner as usize]);
        let all = || triangles.iter().flat_map(corners);
        let low = all().fold(Vec2::INFINITY, Vec2::min);
        let high = all().fold(Vec2::NEG_INFINITY, Vec2::max);
        let extent = (high - low).max_element();
        if !(extent > 0.0 && extent.is_finite()) {
            return None;
        }
        let scale = (1.0 - 2.0 * MARGIN) / extent * Self::SIDE as f32;
        let middle = (low + high) / 2.0;
        let place = |uv: Vec2| (uv - middle) * scale * Vec2::new(1.0, -1.0) + Self::SIDE as f32 / 2.0;
        let mut mask = Self { covered: vec![false; Self::SIDE * Self::SIDE] };
        for triangle in triangles {
            mask.cover(corners(triangle).map(place));
        }
        Some(mask)
    }

    /// Covers the samples of a triangle: those whose centres lie in it, and the one in its middle, so that fine triangles
    /// leave no holes.
    fn cover(&mut self, [a, b, c]: [Vec2; 3]) {
        let last = Self::SIDE as f32 - 1.0;
        let low = a.min(b).min(c).floor().clamp(Vec2::ZERO, Vec2::splat(last));
        let high = a.max(b).max(c).ceil().clamp(Vec2::ZERO, Vec2::splat(last));
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(at - from));
                if sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0) {
                    self.covered[y * Self::SIDE + x] = true;
                }
            }
        }
        let middle = ((a + b + c) / 3.0).clamp(Vec2::ZERO, Vec2::splat(last));
        self.covered[middle.y as usize * Self::SIDE + middle.x as usize] = true;
    }

    fn holds(&self, at: Vec2) -> bool {
        let sample = (at * Self::SIDE as f32).as_uvec2();
        self.covered.get(sample.y as usize * Self::SIDE + sample.x as usize).is_some_and(|it| *it)
    }
}

/// Textures of the pictures shown, kept while anybody else keeps the picture.
#[derive(Default)]
pub(super) struct Textures(Vec<(Arc<ColorImage>, TextureHandle)>);

impl Textures {
    /// The texture of a picture.
    pub(super) fn of(&mut self, context: &egui::Context, image: &Arc<ColorImage>) -> egui::TextureId {
        self.0.retain(|(known, _)| Arc::strong_count(known) > 1);
        if let Some((_, texture)) = self.0.iter().find(|(known, _)| Arc::ptr_eq(known, image)) {
            return texture.id();
        }
        let texture = context.load_texture("thumbnail", Arc::clone(image), egui::TextureOptions::LINEAR);
        let id = texture.id();
        self.0.push((Arc::clone(image), texture));
        id
    }
}

#[cfg(test)]
mod tests {
    use amc_core::mesh::Garment;

    use super::*;

    #[test]
    fn a_piece_covers_what_its_area_says() {
        let garment = Garment::new(amc_core::shape::mesh("sheet").unwrap()).unwrap();
        let image = piece(&garment, &garment.panels[0]);
        let covered = image.pixels.iter().map(|pixel| f32::from(pixel.a()) / 255.0).sum::<f32>();
        let uvs = &garment.uvs;
        let (low, high) =
            uvs.iter().fold((Vec2::MAX, Vec2::MIN), |(low, high), uv| (low.min(*uv), high.max(*uv)));
        let size = (high - low) / (high - low).max_element() * (1.0 - 2.0 * MARGIN) * SIDE as f32;
        // The sheet's UVs fill their box.
        assert!((covered / (size.x * size.y) - 1.0).abs() < 0.05, "{covered} of {size}");
    }

    #[test]
    fn a_ball_is_round_and_lit_by_its_table() {
        use amc_core::amc::{Frame, Symmetry, TableSize, Texels};
        use amc_core::view_space::Azimuth;

        let size = TableSize::new(8, 2).unwrap();
        let texels = Texels::Srgb8(vec![[200, 100, 50, 255]; size.texels()]);
        let amc = Amc::new(size, texels, Symmetry::One, Azimuth::Transported, Frame::Half).unwrap();
        let image = ball(&amc);
        let at = |x: usize, y: usize| image.pixels[y * SIDE + x].to_srgba_unmultiplied();
        assert_eq!(at(SIDE / 2, SIDE / 2), [200, 100, 50, 255]);
        assert_eq!(at(0, 0)[3], 0);
    }
}

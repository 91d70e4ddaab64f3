//! A 2D picture looked up as a texture: bilinear, in linear light, clamped to its edge.

use glam::{Vec2, Vec3};

use crate::image::Picture;

/// A texture in linear light; row 0 is the top, v = 0.
#[derive(Debug, Clone)]
pub(super) struct Texture {
    width: usize,
    height: usize,
    texels: Vec<Vec3>,
}

impl Texture {
    /// Of a picture; its alpha is left out. None where it has no pixels.
    pub(super) fn of_picture(picture: &Picture) -> Option<Self> {
        let texels: Vec<Vec3> = picture.pixels().iter().map(|&[r, g, b, _]| Vec3::new(r, g, b)).collect();
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        (!texels.is_empty()).then_some(Self { width, height, texels })
    }

    /// The colour at texture coordinates, v downwards from the top.
    pub(super) fn sample(&self, at: Vec2) -> Vec3 {
        let axis = |coordinate: f32, size: usize| {
            let at = coordinate * size as f32 - 0.5;
            let low = at.floor();
            // A conversion to an integer saturates, and takes what is no number for 0.
            let index = |value: f32| (value.max(0.0) as usize).min(size - 1);
            (index(low), index(low + 1.0), at - low)
        };
        let (left, right, fu) = axis(at.x, self.width);
        let (top, bottom, fv) = axis(at.y, self.height);
        let row = |y: usize| {
            let texels = &self.texels[y * self.width..][..self.width];
            texels[left].lerp(texels[right], fu)
        };
        row(top).lerp(row(bottom), fv)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_are_reached_at_their_centres_and_mixed_between() {
        let pixels = [0.0, 1.0, 2.0, 3.0].map(|value| [value, 10.0 * value, 0.5, 0.0]).to_vec();
        let texture = Texture::of_picture(&Picture::new(2, 2, pixels).unwrap()).unwrap();
        let red = |u: f32, v: f32| texture.sample(Vec2::new(u, v)).x;
        assert_eq!([red(0.25, 0.25), red(0.75, 0.25), red(0.25, 0.75)], [0.0, 1.0, 2.0]);
        assert_eq!([red(0.5, 0.5), red(0.0, 0.0), red(9.0, 9.0), red(-9.0, 0.75)], [1.5, 0.0, 3.0, 2.0]);
        assert!(Texture::of_picture(&Picture::new(0, 0, Vec::new()).unwrap()).is_none());
    }
}

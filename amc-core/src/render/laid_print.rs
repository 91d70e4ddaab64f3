//! Prints laid on panels.

use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{Affine2, Mat2, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::Print;
use crate::direction::{Direction, Source};
use crate::mesh::Panel;

/// How a print lies on the cloth of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Laying {
    /// How wide the picture is on the cloth, metres.
    pub width: f32,
    /// Radians, counter-clockwise, from upright.
    pub turn: f32,
    /// From the middle of the panel to the middle of the picture: along the upright picture's width and height, metres.
    pub shift: Vec2,
    /// Whether it is repeated all over, or printed once.
    pub is_repeated: bool,
}

impl Default for Laying {
    /// Twenty centimetres, upright, repeated.
    fn default() -> Self {
        Self { width: 0.2, turn: 0.0, shift: Vec2::ZERO, is_repeated: true }
    }
}

/// A print laid on a panel. Two are the same where the picture is the same one in memory.
#[derive(Debug, Clone)]
pub struct LaidPrint {
    /// The picture.
    pub print: Arc<Print>,
    /// From UVs to pictures: the first picture's corners are at 0 and 1; x to its right, y from its top down.
    pub uv_to_picture: Affine2,
    /// Whether it is repeated; else there is no ink outside of the first picture.
    pub is_repeated: bool,
}

impl PartialEq for LaidPrint {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.print, &other.print)
            && self.uv_to_picture == other.uv_to_picture
            && self.is_repeated == other.is_repeated
    }
}

impl LaidPrint {
    /// `print` on `panel`, whose cloth has `direction`; `uv_to_metres` as [`crate::mesh::Garment::uv_to_metres`] gives it.
    ///
    /// It is on the cloth, and turns with it: upright is along the warp. Where the panel's file says nothing of a grain,
    /// upright is as the flat pattern is drawn, turned by the direction's angle. A procedural field has no one direction in
    /// the flat pattern: there the grain alone counts.
    pub fn new(
        print: &Arc<Print>,
        laying: &Laying,
        panel: &Panel,
        direction: &Direction,
        uv_to_metres: Affine2,
    ) -> Self {
        let on_cloth = Affine2::from_mat2(
            Mat2::from_angle(-laying.turn) * upright(panel, direction, uv_to_metres.matrix2),
        );
        let shift = Mat2::from_angle(-laying.turn) * laying.shift;
        let size = Vec2::new(laying.width, laying.width * print.aspect());
        let on_picture =
            Affine2::from_scale_angle_translation(Vec2::new(1.0, -1.0) / size, 0.0, Vec2::splat(0.5));
        let uv_to_picture = on_picture * Affine2::from_translation(-shift) * on_cloth * uv_to_metres;
        Self { print: Arc::clone(print), uv_to_picture, is_repeated: laying.is_repeated }
    }
}

impl LaidPrint {
    /// What multiplies the linear colour at `uv`; `right` and `below` is what changes in the UVs from this pixel of the
    /// screen to the next. Twin of `look_up_print` in `shaders/print.wgsl`.
    pub(super) fn look_up(&self, uv: Vec2, right: Vec2, below: Vec2) -> Vec3 {
        let at = self.uv_to_picture.transform_point2(uv);
        let is_inside = at.cmpge(Vec2::ZERO).all() && at.cmplt(Vec2::ONE).all();
        if !is_inside && !self.is_repeated {
            return Vec3::ONE;
        }
        let [right, below] = [right, below].map(|change| self.uv_to_picture.transform_vector2(change));
        self.print.look_up(at, self.print.width(right, below))
    }
}

/// The rotation of the flat cloth that makes a print on it upright.
fn upright(panel: &Panel, direction: &Direction, uv_to_metres: Mat2) -> Mat2 {
    let grain = panel.pattern.grain;
    let angle = match direction.source {
        Source::Gradient | Source::Yarn => direction.angle,
        Source::Field(_) => grain.unwrap_or_default(),
    };
    let angle = if grain.is_some() { angle } else { angle + FRAC_PI_2 };
    let up = Direction { angle, ..*direction }.on_cloth(uv_to_metres);
    Mat2::from_cols(Vec2::new(up.y, up.x), Vec2::new(-up.x, up.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Picture;
    use crate::mesh::{PanelFlags, PatternPiece};

    fn panel(grain: Option<f32>) -> Panel {
        Panel {
            id: "a".into(),
            name: "a".into(),
            triangles: 0..1,
            takes_fabric: true,
            area: 1.0,
            flags: PanelFlags::default(),
            pattern: PatternPiece { grain, ..PatternPiece::default() },
        }
    }

    /// Where `uv` lies in a picture twice as high as it is wide, laid 0.1 m wide.
    fn place(grain: Option<f32>, angle: f32, laying: Laying, uv: Vec2) -> Vec2 {
        let picture = Picture::new(1, 2, vec![[0.5, 0.5, 0.5, 1.0]; 2]).unwrap();
        let print = Arc::new(Print::new(&picture).unwrap());
        let direction = Direction { source: Source::Yarn, angle };
        let laying = Laying { width: 0.1, ..laying };
        let laid =
            LaidPrint::new(&print, &laying, &panel(grain), &direction, Affine2::from_scale(Vec2::splat(0.5)));
        laid.uv_to_picture.transform_point2(uv)
    }

    #[test]
    fn upright_is_along_the_warp_and_turns_with_the_cloth() {
        let close =
            |got: Vec2, x: f32, y: f32| assert!(got.abs_diff_eq(Vec2::new(x, y), 1e-5), "{got} {x} {y}");
        let plain = Laying::default();
        // 0.05 m along the warp is a quarter of the picture up from its middle, along the weft half of it to the side.
        close(place(Some(FRAC_PI_2), FRAC_PI_2, plain, Vec2::Y * 0.1), 0.5, 0.25);
        close(place(Some(FRAC_PI_2), FRAC_PI_2, plain, Vec2::X * 0.1), 1.0, 0.5);
        close(place(Some(FRAC_PI_2), 0.0, plain, Vec2::X * 0.1), 0.5, 0.25);
        close(place(Some(FRAC_PI_2), 0.0, plain, Vec2::Y * -0.1), 1.0, 0.5);
        // Without a grain it is as the pattern is drawn.
        close(place(None, 0.0, plain, Vec2::Y * 0.1), 0.5, 0.25);
        close(place(None, FRAC_PI_2, plain, Vec2::X * -0.1), 0.5, 0.25);
    }

    #[test]
    fn it_is_shifted_and_turned_on_the_cloth() {
        let laying = Laying { turn: FRAC_PI_2, shift: Vec2::new(0.05, 0.0), ..Laying::default() };
        // The middle of the picture is 0.05 m to the right; there its top is to the left.
        let middle = place(None, 0.0, laying, Vec2::X * 0.1);
        assert!(middle.abs_diff_eq(Vec2::splat(0.5), 1e-5), "{middle}");
        let left_of_it = place(None, 0.0, laying, Vec2::ZERO);
        assert!(left_of_it.abs_diff_eq(Vec2::new(0.5, 0.25), 1e-5), "{left_of_it}");
    }
}

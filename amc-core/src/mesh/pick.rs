//! Which panel is seen at a point of the picture, or in a part of it.

use std::collections::BTreeSet;
use std::ops::Range;

use glam::{UVec2, Vec2, Vec3};
use rayon::prelude::*;

use super::ray_tree::{Placement, RayTree};
use crate::render::{Drawing, Ray, View};
use crate::{Error, Result};

/// Most points looked at along each side of a box.
const MOST_POINTS: f32 = 128.0;
/// Pixels between points in a box that is small enough.
const SPACING: f32 = 2.0;

/// Finds the panels of a garment by lines of sight. Building it takes about a second per million triangles: on a
/// thread of its own for a large garment. It knows where panels are, not what they are made of.
pub struct Picker {
    /// None where there are no triangles.
    tree: Option<RayTree>,
    placement: Placement,
    panel_of_triangle: Vec<u32>,
}

/// What a line of sight meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hit {
    /// The number of the panel.
    pub panel: usize,
    /// The triangle's number, counted from panel to panel: that of [`super::Garment::triangles`] in a drawing of a garment.
    pub triangle: u32,
}

impl std::fmt::Debug for Picker {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Picker").field("triangles", &self.panel_of_triangle.len()).finish_non_exhaustive()
    }
}

impl Picker {
    /// Of the draws of a drawing, one panel each.
    ///
    /// # Errors
    /// A drawing that does not hold together ([`Drawing::check`]), or a position that is not finite.
    pub fn new(drawing: &Drawing) -> Result<Self> {
        drawing.check()?;
        let positions: Vec<Vec3> = drawing.vertices.iter().map(|vertex| vertex.position).collect();
        if let Some(index) = positions.iter().position(|p| !p.is_finite()) {
            return Err(Error::invalid("the position is not finite").at_element(format!("vertex {index}")));
        }
        let placement = Placement::of(&positions);
        let placed: Vec<Vec3> = positions.iter().map(|&p| placement.place(p)).collect();
        let ranges = drawing.draws.iter().map(|draw| draw.triangles.clone());
        let (triangles, panel_of_triangle) = of_panels(&drawing.triangles, ranges);
        let tree = (!triangles.is_empty()).then(|| RayTree::new(&placed, &triangles));
        Ok(Self { tree, placement, panel_of_triangle })
    }

    /// The panel that a ray meets first, from either side; those that `hidden` says yes to are not there.
    pub fn first(&self, ray: Ray, hidden: impl Fn(usize) -> bool) -> Option<usize> {
        self.hit(ray, hidden).map(|hit| hit.panel)
    }

    /// The triangle that a ray meets first, as [`Picker::first`] finds its panel.
    pub fn hit(&self, ray: Ray, hidden: impl Fn(usize) -> bool) -> Option<Hit> {
        let tree = self.tree.as_ref()?;
        let panel = |triangle: u32| self.panel_of_triangle[triangle as usize] as usize;
        let origin = self.placement.place(ray.origin);
        let triangle = tree.first(origin, ray.direction, |triangle| !hidden(panel(triangle)))?;
        Some(Hit { panel: panel(triangle), triangle })
    }

    /// The panels with a visible pixel in the box between two points of the picture (pixels from its top-left corner):
    /// looked for at every second pixel, and in a large box at 128 x 128 points spread evenly.
    pub fn in_box(
        &self,
        view: &View,
        from: Vec2,
        to: Vec2,
        hidden: impl Fn(usize) -> bool + Sync,
    ) -> BTreeSet<usize> {
        let limit = Vec2::new(view.width as f32, view.height as f32);
        let (low, high) = (from.min(to).max(Vec2::ZERO), from.max(to).min(limit));
        // Outside of the picture, or no box at all: a comparison with NaN is false.
        if !(low.cmple(high).all()) {
            return BTreeSet::new();
        }
        let points = ((high - low) / SPACING).ceil().clamp(Vec2::ONE, Vec2::splat(MOST_POINTS)).as_uvec2();
        let seen_in_row = |row: u32| -> BTreeSet<usize> {
            let at =
                |column| low + (UVec2::new(column, row).as_vec2() + 0.5) / points.as_vec2() * (high - low);
            (0..points.x).filter_map(|column| self.first(view.ray(at(column)), &hidden)).collect()
        };
        (0..points.y).into_par_iter().map(seen_in_row).reduce(BTreeSet::new, |mut all, row| {
            all.extend(row);
            all
        })
    }
}

/// The triangles of all ranges, and the number of the range each comes from.
fn of_panels(triangles: &[[u32; 3]], ranges: impl Iterator<Item = Range<u32>>) -> (Vec<[u32; 3]>, Vec<u32>) {
    let mut found = (Vec::with_capacity(triangles.len()), Vec::with_capacity(triangles.len()));
    for (panel, range) in (0..).zip(ranges) {
        let of_panel = &triangles[range.start as usize..range.end as usize];
        found.0.extend_from_slice(of_panel);
        found.1.extend(of_panel.iter().map(|_| panel));
    }
    found
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::Mat4;

    use super::*;
    use crate::render::{Cloth, Draw, Projection, Vertex};

    /// Squares of side 1 around (0, 0, z) and (1, 0, z), one panel each.
    fn squares(depths: [f32; 2]) -> Drawing {
        let (mut vertices, mut triangles, mut draws) = (vec![], vec![], vec![]);
        for (panel, z) in (0u32..).zip(depths) {
            for (x, y) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
                let position = Vec3::new(x + 0.5 * panel as f32, y, z);
                vertices.push(Vertex { position, normal: Vec3::Z, ..Vertex::default() });
            }
            triangles.extend([[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|k| k + 4 * panel)));
            draws.push(Draw { triangles: 2 * panel..2 * panel + 2, cloth: Cloth::Plain });
        }
        let tangents = Arc::new(vec![Vec3::X; vertices.len()]);
        Drawing {
            vertices: Arc::new(vertices),
            tangents,
            triangles: Arc::new(triangles),
            draws,
            fabrics: Vec::new(),
        }
    }

    /// A pixel is 1/100 m; the picture's middle is the origin.
    fn view() -> View {
        let projection = Projection::Orthographic { half_height: 1.0 };
        let shift = Vec2::ZERO;
        View {
            object_to_view: Mat4::IDENTITY,
            projection,
            width: 400,
            height: 200,
            near: -2.0,
            far: 2.0,
            shift,
        }
    }

    #[test]
    fn the_nearest_panel_that_is_not_hidden_is_found() {
        let at = |depths: [f32; 2], x: f32, y: f32, hidden: &[usize]| {
            let picker = Picker::new(&squares(depths)).unwrap();
            picker.first(view().ray(Vec2::new(x, y)), |panel| hidden.contains(&panel))
        };
        // The second square reaches from x = 0 to 1, the first from -1/2 to 1/2.
        for (depths, between) in [([0.1, 0.2], 1), ([0.2, 0.1], 0)] {
            assert_eq!(at(depths, 225.0, 100.0, &[]), Some(between));
            assert_eq!(at(depths, 225.0, 100.0, &[between]), Some(1 - between));
            assert_eq!(at(depths, 225.0, 100.0, &[0, 1]), None);
        }
        assert_eq!(at([0.1, 0.2], 151.0, 51.0, &[]), Some(0));
        assert_eq!(at([0.1, 0.2], 149.0, 51.0, &[]), None);
        assert_eq!(at([0.1, 0.2], 299.0, 149.0, &[]), Some(1));
        assert_eq!(at([0.1, 0.2], 299.0, 151.0, &[]), None);
    }

    #[test]
    fn a_box_holds_the_panels_that_are_seen_in_it() {
        let in_box = |depths: [f32; 2], from: (f32, f32), to: (f32, f32)| {
            let picker = Picker::new(&squares(depths)).unwrap();
            picker
                .in_box(&view(), Vec2::from(from), Vec2::from(to), |_| false)
                .into_iter()
                .collect::<Vec<_>>()
        };
        assert_eq!(in_box([0.1, 0.2], (0.0, 0.0), (400.0, 200.0)), [0, 1]);
        assert_eq!(in_box([0.1, 0.2], (400.0, 200.0), (-90.0, 0.0)), [0, 1]);
        // The second square hides the first there.
        assert_eq!(in_box([0.1, 0.2], (205.0, 60.0), (245.0, 140.0)), [1]);
        assert_eq!(in_box([0.2, 0.1], (205.0, 60.0), (245.0, 140.0)), [0]);
        assert!(in_box([0.1, 0.2], (0.0, 0.0), (140.0, 40.0)).is_empty());
        assert!(in_box([0.1, 0.2], (f32::NAN, 0.0), (140.0, 40.0)).is_empty());
        assert!(in_box([0.1, 0.2], (500.0, 10.0), (600.0, 20.0)).is_empty());
    }

    #[test]
    fn nothing_is_found_where_nothing_is_and_hostile_drawings_are_refused() {
        let nothing = Picker::new(&Drawing::default()).unwrap();
        assert_eq!(nothing.first(view().ray(Vec2::ZERO), |_| false), None);
        let mut stray = squares([0.0, 0.0]);
        Arc::make_mut(&mut stray.vertices)[3].position.y = f32::NAN;
        assert!(Picker::new(&stray).unwrap_err().to_string().contains("vertex 3"));
        let mut outside = squares([0.0, 0.0]);
        Arc::make_mut(&mut outside.triangles)[0][0] = 99;
        assert!(Picker::new(&outside).unwrap_err().to_string().contains("triangle 0"));
    }
}

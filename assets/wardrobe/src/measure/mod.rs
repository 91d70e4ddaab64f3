//! Figures that show how well a garment is draped.

mod pierce;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

use crate::body::Body;
use crate::cut::{At, CutGarment, JoinKind};
use crate::drape::Draped;

/// A piece of cloth, flat and draped.
#[derive(Debug, Clone, Copy)]
pub struct Sheet<'a> {
    /// Its vertices flat, metres.
    pub flat: &'a [DVec2],
    /// The same draped, metres.
    pub places: &'a [DVec3],
    /// Corners: indices of both.
    pub triangles: &'a [[u32; 3]],
    /// The warp's direction, radians counter-clockwise from +u.
    pub grain: f64,
}

/// The 5th, 50th and 95th percentile by area.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Percentiles {
    /// A twentieth of the area has less.
    pub p5: f64,
    /// Half of the area has less.
    pub p50: f64,
    /// A twentieth of the area has more.
    pub p95: f64,
}

/// What is measured on a draped garment.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Figures {
    /// Vertices, those of seams counted on both sides.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Angle between warp and weft as draped, degrees; 90 unsheared.
    pub angle: Percentiles,
    /// Length along the warp as draped over that cut; 1 unstretched.
    pub warp: Percentiles,
    /// The same along the weft.
    pub weft: Percentiles,
    /// The largest distance between two vertices sewn to each other, metres.
    pub seam_gap: f64,
    /// Vertices and triangles' centres inside the body.
    pub inside_body: usize,
    /// Edges that pierce a triangle.
    pub pierced: usize,
    /// Those of them that are seen from outside: from the spot at least one of 32 directions is open.
    pub pierced_in_view: usize,
}

impl Figures {
    /// The heads of [`Figures::row`]'s columns, as the first two lines of a Markdown table.
    pub const HEAD: &'static str = "| garment | triangles | warp to weft (degrees) 5 / 50 / 95 % | warp stretch 5 / 50 / 95 % | weft stretch 5 / 50 / 95 % \
        | seam gap (mm) | inside the body | pierced | in view |\n|---|---|---|---|---|---|---|---|---|";

    /// A line of a Markdown table.
    #[must_use]
    pub fn row(&self, name: &str) -> String {
        let three = |p: &Percentiles, digits: usize| {
            format!("{:.digits$} / {:.digits$} / {:.digits$}", p.p5, p.p50, p.p95)
        };
        format!(
            "| {name} | {} | {} | {} | {} | {:.2} | {} | {} | {} |",
            self.triangles,
            three(&self.angle, 1),
            three(&self.warp, 3),
            three(&self.weft, 3),
            self.seam_gap * 1e3,
            self.inside_body,
            self.pierced,
            self.pierced_in_view
        )
    }
}

/// Measures a garment as it was cut and draped.
#[must_use]
pub fn measure(garment: &CutGarment, draped: &Draped, body: &Body) -> Figures {
    let sheets: Vec<Sheet<'_>> = garment
        .pieces
        .iter()
        .zip(&draped.positions)
        .map(|(piece, places)| Sheet {
            flat: &piece.flat,
            places,
            triangles: &piece.triangles,
            grain: piece.grain,
        })
        .collect();
    let sewn = garment
        .joins
        .iter()
        .filter(|join| join.kind == JoinKind::Sewn)
        .flat_map(|join| join.pairs.iter().copied());
    measure_sheets(&sheets, sewn, body)
}

/// Measures sheets of which vertices are `sewn` in pairs; a pair that names no vertex counts as wide open.
pub fn measure_sheets(
    sheets: &[Sheet<'_>],
    sewn: impl IntoIterator<Item = (At, At)>,
    body: &Body,
) -> Figures {
    let mut strains = Strains::default();
    sheets.iter().for_each(|sheet| strains.add(sheet));
    let place = |at: At| sheets.get(at.piece as usize).and_then(|sheet| sheet.places.get(at.vertex as usize));
    let gap = |(one, other): (At, At)| match (place(one), place(other)) {
        (Some(one), Some(other)) => one.distance(*other),
        _ => f64::INFINITY,
    };
    let pierced = pierce::pierced(sheets);
    Figures {
        vertices: sheets.iter().map(|sheet| sheet.places.len()).sum(),
        triangles: sheets.iter().map(|sheet| sheet.triangles.len()).sum(),
        angle: percentiles(strains.angle),
        warp: percentiles(strains.warp),
        weft: percentiles(strains.weft),
        seam_gap: sewn.into_iter().map(gap).fold(0.0, f64::max),
        inside_body: inside(sheets, body),
        pierced: pierced.spots,
        pierced_in_view: pierced.in_view,
    }
}

/// Per triangle a value and its area.
#[derive(Debug, Default)]
struct Strains {
    angle: Vec<(f64, f64)>,
    warp: Vec<(f64, f64)>,
    weft: Vec<(f64, f64)>,
}

impl Strains {
    fn add(&mut self, sheet: &Sheet<'_>) {
        let warp_direction = DVec2::from_angle(sheet.grain);
        for corners in sheet.triangles {
            let [a, b, c] = corners.map(|corner| sheet.flat[corner as usize]);
            let [x, y, z] = corners.map(|corner| sheet.places[corner as usize]);
            let (ab, ac) = (b - a, c - a);
            let twice = ab.perp_dot(ac);
            if twice.abs() < 1e-14 {
                continue;
            }
            let along = |direction: DVec2| {
                ((y - x) * direction.perp_dot(ac) + (z - x) * ab.perp_dot(direction)) / twice
            };
            let (warp, weft) = (along(warp_direction), along(warp_direction.perp()));
            let area = 0.5 * twice.abs();
            self.angle.push((warp.angle_between(weft).to_degrees(), area));
            self.warp.push((warp.length(), area));
            self.weft.push((weft.length(), area));
        }
    }
}

fn percentiles(mut values: Vec<(f64, f64)>) -> Percentiles {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = values.iter().map(|value| value.1).sum();
    let at = |share: f64| {
        let mut passed = 0.0;
        let reached = values.iter().find(|value| {
            passed += value.1;
            passed >= share * total
        });
        reached.or(values.last()).map_or(0.0, |value| value.0)
    };
    Percentiles { p5: at(0.05), p50: at(0.5), p95: at(0.95) }
}

fn inside(sheets: &[Sheet<'_>], body: &Body) -> usize {
    let of_sheet = |sheet: &Sheet<'_>| {
        let centre = |corners: &[u32; 3]| {
            corners.iter().map(|corner| sheet.places[*corner as usize]).sum::<DVec3>() / 3.0
        };
        let places = sheet.places.iter().copied().chain(sheet.triangles.iter().map(centre));
        places.filter(|place| body.distance(*place) < 0.0).count()
    };
    sheets.iter().map(of_sheet).sum()
}

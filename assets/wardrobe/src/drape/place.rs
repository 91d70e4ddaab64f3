//! Pieces laid round the body before they are sewn.

use amc_core::{Error, Result};
use glam::{DVec2, DVec3};

use crate::body::{Body, Limb};
use crate::cut::{CutGarment, CutPiece};
use crate::pattern::Placement;

/// Below this flare a cone is a cylinder.
const LEAST_FLARE: f64 = 1e-6;
/// Times a vertex is pushed out of the body.
const PUSHES: usize = 8;

/// Where every vertex of every piece lies before it is sewn, metres: bent, not stretched, then at least `margin` out of the body.
pub(super) fn place(garment: &CutGarment, body: &Body, margin: f64) -> Result<Vec<Vec<DVec3>>> {
    let pieces = garment.pieces.iter().map(|piece| {
        let mut places = place_piece(piece, body)?;
        places.iter_mut().for_each(|place| push_out(place, body, margin));
        Ok(places)
    });
    pieces.collect()
}

fn place_piece(piece: &CutPiece, body: &Body) -> Result<Vec<DVec3>> {
    match &piece.placement {
        Placement::Around { limb, point, along, angle_deg, radius, flare } => {
            let Some(limb) = body.limb(limb) else {
                return Err(Error::invalid(format!("there is no limb \"{limb}\" to wrap the piece round"))
                    .at_element(format!("piece \"{}\"", piece.name)));
            };
            let wrap =
                Wrap { limb, along: *along, angle: angle_deg.to_radians(), radius: *radius, flare: *flare };
            Ok(piece.flat.iter().map(|flat| wrap.place(*flat - DVec2::from(*point))).collect())
        }
        Placement::Hung(hang) => Ok(piece.flat.iter().map(|flat| hang.place(flat.x, flat.y)).collect()),
        Placement::Flat { point, at, across, up } => {
            let across = DVec3::from(*across).normalize_or(DVec3::X);
            let up = DVec3::from(*up).reject_from(across).normalize_or(across.any_orthonormal_vector());
            let place = |flat: &DVec2| {
                let offset = *flat - DVec2::from(*point);
                DVec3::from(*at) + across * offset.x + up * offset.y
            };
            Ok(piece.flat.iter().map(place).collect())
        }
    }
}

/// A cylinder or cone round a limb.
struct Wrap<'a> {
    limb: &'a Limb,
    along: f64,
    angle: f64,
    radius: f64,
    flare: f64,
}

impl Wrap<'_> {
    /// Where a flat offset from the anchor goes.
    fn place(&self, offset: DVec2) -> DVec3 {
        let (along, radius, angle) =
            if self.flare.abs() < LEAST_FLARE { self.on_cylinder(offset) } else { self.on_cone(offset) };
        let round = self.limb.front * angle.cos() + self.limb.side() * angle.sin();
        self.limb.start + self.limb.axis * along + round * radius
    }

    fn on_cylinder(&self, offset: DVec2) -> (f64, f64, f64) {
        (self.along - offset.y, self.radius, self.angle + offset.x / self.radius)
    }

    /// On the cone, unrolled about its apex: distance from the apex is kept, and the angle about it shrinks by the sine of the
    /// cone's half angle.
    fn on_cone(&self, offset: DVec2) -> (f64, f64, f64) {
        let slope = self.flare.abs();
        let (sine, cosine) = (slope / slope.hypot(1.0), 1.0 / slope.hypot(1.0));
        let to_apex = self.radius / sine;
        let upwards = self.flare.signum();
        let from_apex = DVec2::new(offset.x, to_apex - upwards * offset.y);
        let distance = from_apex.length();
        let turn = from_apex.x.atan2(from_apex.y);
        (self.along + upwards * (distance - to_apex) * cosine, distance * sine, self.angle + turn / sine)
    }
}

/// Moves a place out of the body along the shortest way.
pub(super) fn push_out(place: &mut DVec3, body: &Body, margin: f64) {
    for _ in 0..PUSHES {
        let (distance, outward) = body.surface(*place);
        if distance >= margin {
            return;
        }
        *place += outward * (margin - distance);
    }
}

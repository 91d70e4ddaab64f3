//! Pieces hung along a line in space.

use amc_core::{Error, Result};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The most stations.
const MOST: usize = 100;

/// How a piece hangs along a line in space. Where it is gathered, its width lies in pleats, so that it keeps its size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hang {
    /// The piece's points at this v lie on the line, metres.
    pub v: f64,
    /// How much of the width lies in one pleat, out and back, metres; 5 mm to 1 m.
    pub pleat: f64,
    /// Places along the line, u rising, two at least; straight between them.
    pub stations: Vec<Station>,
}

/// A place along the line on which a piece hangs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Station {
    /// Where on the piece, metres.
    pub u: f64,
    /// Where in space, metres.
    pub at: [f64; 3],
    /// Where +v goes. Its length says how far a metre of the width goes: 1 smooth, less gathered. The right side faces
    /// `along x up`, `along` being the line's direction of growing u.
    pub up: [f64; 3],
}

impl Hang {
    /// Where the piece's point (u, v) lies, metres.
    pub fn place(&self, u: f64, v: f64) -> DVec3 {
        let [from, to] = self.around(u);
        let share = (u - from.u) / (to.u - from.u);
        let (start, end) = (DVec3::from(from.at), DVec3::from(to.at));
        let up = DVec3::from(from.up).lerp(DVec3::from(to.up), share);
        let across = (end - start).cross(up).normalize_or_zero();
        let height = (1.0 - up.length_squared()).max(0.0).sqrt() * self.zigzag(v - self.v);
        start.lerp(end, share) + up * (v - self.v) + across * height
    }

    /// The stations on either side of u; the outermost two beyond the ends.
    fn around(&self, u: f64) -> [&Station; 2] {
        let next = self.stations.partition_point(|station| station.u <= u).clamp(1, self.stations.len() - 1);
        [&self.stations[next - 1], &self.stations[next]]
    }

    /// Up and down by turns, with slope 1, about 0.
    fn zigzag(&self, width: f64) -> f64 {
        let half = self.pleat / 2.0;
        (width.rem_euclid(self.pleat) - half).abs() - half / 2.0
    }

    /// The mirror image, x to -x and u to -u.
    pub(super) fn mirrored(&self) -> Self {
        let image = |station: &Station| Station {
            u: -station.u,
            at: [-station.at[0], station.at[1], station.at[2]],
            up: [-station.up[0], station.up[1], station.up[2]],
        };
        Self { stations: self.stations.iter().rev().map(image).collect(), ..self.clone() }
    }

    pub(super) fn check(&self) -> Result<()> {
        if self.stations.len() < 2 || self.stations.len() > MOST {
            return Err(Error::invalid(format!(
                "its placement has {} stations; it needs 2 to {MOST}",
                self.stations.len()
            )));
        }
        if self.v.is_nan() || self.v.abs() > 10.0 {
            return Err(Error::invalid(format!(
                "its placement hangs it by v = {}; it is between -10 and 10 m",
                self.v
            )));
        }
        if !(0.005..=1.0).contains(&self.pleat) {
            return Err(Error::invalid(format!(
                "its placement has pleats of {} m; they are 0.005 to 1 m",
                self.pleat
            )));
        }
        for station in &self.stations {
            let far = station.at.iter().chain([&station.u]).any(|x| x.is_nan() || x.abs() > 10.0);
            if far || !(0.05..=1.0 + 1e-6).contains(&DVec3::from(station.up).length()) {
                return Err(Error::invalid(format!(
                    "its placement's station at u = {} is more than 10 m away, or its 'up' is not 0.05 to 1 long",
                    station.u
                )));
            }
        }
        // A comparison that is false for what is not a number.
        let rising = self.stations.windows(2).all(|pair| pair[1].u - pair[0].u > 1e-4);
        if !rising {
            return Err(Error::invalid("its placement's stations do not have rising u"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gathered() -> Hang {
        let station = |u: f64| Station { u, at: [u, 1.0, 0.0], up: [0.0, 0.6, 0.0] };
        Hang { v: 0.25, pleat: 0.1, stations: vec![station(0.0), station(1.0)] }
    }

    #[test]
    fn a_gathered_piece_keeps_its_size() {
        let hang = gathered();
        let path = |from: [f64; 2], to: [f64; 2]| {
            let at = |i: i32| {
                let t = f64::from(i) / 1000.0;
                hang.place(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]))
            };
            (0..1000).map(|i| at(i).distance(at(i + 1))).sum::<f64>()
        };
        assert!((path([0.0, 0.0], [0.0, 0.5]) - 0.5).abs() < 1e-9);
        assert!((path([0.1, 0.2], [0.9, 0.2]) - 0.8).abs() < 1e-9);
        assert!(hang.place(0.0, 0.5).distance(hang.place(0.0, 0.0)) < 0.31);
    }

    #[test]
    fn a_mirror_image_hangs_where_the_mirror_shows_it() {
        let hang = gathered();
        let seen = hang.place(0.3, 0.11) * DVec3::new(-1.0, 1.0, 1.0);
        assert!(hang.mirrored().place(-0.3, 0.11).distance(seen) < 1e-12);
    }
}

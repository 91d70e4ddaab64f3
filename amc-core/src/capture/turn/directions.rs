//! From the table's directions to the turns of the ball that show them.

use std::f64::consts::TAU;

use glam::{DMat2, DVec2};
use wide::f32x4;

use crate::capture::resample::Texel;
use crate::view_space::Azimuth;

/// Directions in the table: the cosines and sines of their azimuths.
pub(in crate::capture) struct Directions {
    count: usize,
    cosines: Vec<f32x4>,
    sines: Vec<f32x4>,
}

impl Directions {
    /// The first `count` of `all` directions at even steps around the turn.
    pub(in crate::capture) fn new(count: u32, all: u32) -> Self {
        let azimuth = |k: u32| TAU * f64::from(k) / f64::from(all);
        let lanes = |of: fn(f64) -> f64| {
            let four = |first: u32| f32x4::new([0, 1, 2, 3].map(|k| of(azimuth(first + k)) as f32));
            (0..count).step_by(4).map(four).collect()
        };
        Self { count: count as usize, cosines: lanes(f64::cos), sines: lanes(f64::sin) }
    }

    /// The turns, radians in [-pi, pi], at which the pictures show the texel's tangents of these azimuths.
    pub(in crate::capture) fn turns(&self, texel: &Texel, azimuth: Azimuth, turns: &mut Vec<f32>) {
        let [x, y] =
            to_picture(texel, azimuth).transpose().to_cols_array_2d().map(|row| row.map(|v| v as f32));
        turns.clear();
        for (&cos, &sin) in self.cosines.iter().zip(&self.sines) {
            let turn = (cos * y[0] + sin * y[1]).atan2(cos * x[0] + sin * x[1]);
            turns.extend(turn.to_array());
        }
        turns.truncate(self.count);
    }
}

/// Carries a direction of the table, as the cosine and sine of its azimuth, to one in the pictures, but for its length.
///
/// In the pictures the tangent is constant in the projection at the true normal m; the turn that takes m to the
/// table's n leaves the transported azimuth as it is. From a projected to a transported azimuth at n, `t_z = -n_xy t_xy / n_z`
/// goes into `t_xy - n_xy t_z / (1 + n_z)`; from there to the projection at m leads `t_xy - m_xy (m_xy t_xy) / (1 + m_z)`.
fn to_picture(texel: &Texel, azimuth: Azimuth) -> DMat2 {
    let outer = |v: DVec2| DMat2::from_cols(v * v.x, v * v.y);
    let (n, m) = (texel.n, texel.m);
    let projected = DMat2::IDENTITY - outer(m.truncate()) * (1.0 / (1.0 + m.z));
    match azimuth {
        Azimuth::Transported => projected,
        Azimuth::Projected => projected * (DMat2::IDENTITY * (n.z * (1.0 + n.z)) + outer(n.truncate())),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::view_space::transported_azimuth;

    /// The picture's tangent at m is carried to n by the least rotation, as any vector is.
    #[test]
    fn the_turn_read_shows_the_tangent_asked_for() {
        let directions = Directions::new(37, 74);
        let mut turns = Vec::new();
        for k in 0..50 {
            let m = DVec3::new(0.1 * f64::from(k % 7), 0.08 * f64::from(k % 9) - 0.3, 1.0).normalize();
            let n = DVec3::new(0.8 * m.x + 0.01, 0.9 * m.y, 1.0).normalize();
            let texel = Texel { i: 0, j: 0, n, m };
            for azimuth in [Azimuth::Transported, Azimuth::Projected] {
                directions.turns(&texel, azimuth, &mut turns);
                assert_eq!(turns.len(), 37);
                for (k, &turn) in turns.iter().enumerate() {
                    let shown = Azimuth::Projected.tangent(m.as_vec3(), turn);
                    let asked = azimuth.tangent(n.as_vec3(), (TAU * k as f64 / 74.0) as f32);
                    let apart =
                        transported_azimuth(m.as_vec3(), shown) - transported_azimuth(n.as_vec3(), asked);
                    assert!(apart.sin().abs() < 1e-5 && apart.cos() > 0.0, "{azimuth:?} {k}: {apart}");
                }
            }
        }
    }

    #[test]
    fn an_orthographic_picture_is_one_slice_of_the_projected_azimuth() {
        let n = DVec3::new(0.6, -0.7, 0.39).normalize();
        let mut turns = Vec::new();
        Directions::new(4, 16).turns(&Texel { i: 0, j: 0, n, m: n }, Azimuth::Projected, &mut turns);
        for (k, turn) in turns.iter().enumerate() {
            assert!((f64::from(*turn) - TAU * k as f64 / 16.0).abs() < 1e-6, "{turns:?}");
        }
    }
}

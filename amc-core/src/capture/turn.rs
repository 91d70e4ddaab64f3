//! Along the turn: what a texel shows at any angle of the ball, from the angles that were measured.
//!
//! Between the pictures a texel's colour is a periodic cubic spline through them, which even steps do not ask for:
//! nearly what the sampling theorem allows, without ringing as far as a sinc does.

use std::f64::consts::TAU;

use glam::DVec3;
use half::f16;
use half::slice::HalfFloatSliceExt as _;

use super::resample::Texel;
use crate::view_space::{Azimuth, transported_azimuth};

/// The periodic cubic spline through values at some turns.
pub(super) struct Spline {
    /// The first turn, radians.
    start: f64,
    /// The turns from the first on, radians in [0, 2 pi), rising.
    turns: Vec<f64>,
    /// From each turn to the next, in mean steps.
    gaps: Vec<f64>,
    /// One over each gap in radians.
    rates: Vec<f64>,
    /// The interval in which each bin of the turn starts.
    bins: Vec<u32>,
    /// Pictures per radian, where all steps are equal: no interval has to be looked up.
    even_rate: Option<f64>,
    /// The cyclic tridiagonal system of the second derivatives, factored (Thomas, Sherman and Morrison).
    system: System,
}

/// Where a turn lies: two neighbours and the weights of their values and second derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Position {
    first: usize,
    second: usize,
    value: [f32; 2],
    bend: [f32; 2],
}

/// Some texels' colours over the turn: `lanes` numbers for each picture, and their second derivatives.
pub(super) struct Curves {
    lanes: usize,
    values: Vec<f32>,
    bends: Vec<f32>,
}

impl Spline {
    /// Through `turns`: at least three, radians in [0, 2 pi), strictly rising.
    pub(super) fn new(mut turns: Vec<f64>) -> Self {
        let count = turns.len();
        let start = turns.first().copied().unwrap_or(0.0);
        for turn in &mut turns {
            *turn -= start;
        }
        let step = TAU / count as f64;
        let next = turns.iter().skip(1).copied().chain([TAU]);
        let gaps: Vec<f64> = turns.iter().zip(next).map(|(from, to)| (to - from) / step).collect();
        let bin_start = |bin: usize| TAU * bin as f64 / (4 * count) as f64;
        let bins = (0..4 * count)
            .map(|bin| turns.partition_point(|&turn| turn <= bin_start(bin)).saturating_sub(1) as u32)
            .collect();
        let rates = gaps.iter().map(|gap| 1.0 / (gap * step)).collect();
        let even_rate = all_within(&gaps, SAME_STEP).then(|| count as f64 / TAU);
        Self { start, system: System::new(&gaps), turns, gaps, rates, bins, even_rate }
    }

    /// How many pictures.
    pub(super) fn len(&self) -> usize {
        self.turns.len()
    }

    /// Whether the turns are even, to a hundredth of a step.
    pub(super) fn is_even(&self) -> bool {
        all_within(&self.gaps, 0.01)
    }

    /// The spline, over twice the turn, through the means of pictures half a turn apart; none where the pictures do not
    /// come in such pairs, at even steps.
    pub(super) fn of_half_turns(&self) -> Option<Self> {
        let count = self.len();
        // A spline needs three.
        (self.even_rate.is_some() && count.is_multiple_of(2) && count >= 6).then(|| {
            Self::new(self.turns[..count / 2].iter().map(|turn| 2.0 * (turn + self.start)).collect())
        })
    }

    /// Where a turn in radians lies.
    #[inline]
    pub(super) fn position(&self, turn: f64) -> Position {
        let mut turn = turn - self.start;
        // Nearly always within one turn of the range: no division.
        if turn < 0.0 {
            turn += TAU;
        } else if turn >= TAU {
            turn -= TAU;
        }
        if !(0.0..TAU).contains(&turn) {
            turn -= TAU * (turn / TAU).floor();
        }
        if let Some(rate) = self.even_rate {
            return self.even_position(turn * rate);
        }
        let count = self.turns.len();
        let bin = ((turn * (self.bins.len() as f64 / TAU)) as usize).min(self.bins.len() - 1);
        let mut first = self.bins[bin] as usize;
        while first + 1 < count && self.turns[first + 1] <= turn {
            first += 1;
        }
        let second = if first + 1 == count { 0 } else { first + 1 };
        let gap = self.gaps[first];
        let along = ((turn - self.turns[first]) * self.rates[first]).clamp(0.0, 1.0);
        let before = 1.0 - along;
        let bend = |x: f64| ((x * x * x - x) * gap * gap / 6.0) as f32;
        Position { first, second, value: [before as f32, along as f32], bend: [bend(before), bend(along)] }
    }

    /// Where a turn lies, counted in even steps from the first.
    #[inline]
    fn even_position(&self, steps: f64) -> Position {
        let count = self.turns.len();
        let first = (steps as usize).min(count - 1);
        let second = if first + 1 == count { 0 } else { first + 1 };
        let along = (steps - first as f64).clamp(0.0, 1.0) as f32;
        let before = 1.0 - along;
        let bend = |x: f32| (x * x - 1.0) * x / 6.0;
        Position { first, second, value: [before, along], bend: [bend(before), bend(along)] }
    }

    /// The mean, over all turns, of the squared weights with which measured values enter an interpolated one: what
    /// is left of independent noise.
    pub(super) fn noise_gain(&self) -> f64 {
        let count = self.len();
        let mut values = vec![0.0; count * count];
        for k in 0..count {
            values[k * count + k] = 1.0;
        }
        let curves = self.curves(count, values);
        let samples = 8 * count;
        let squares: f64 = (0..samples)
            .map(|k| {
                let position = self.position(TAU * (k as f64 + 0.5) / samples as f64);
                (0..count).map(|lane| f64::from(curves.at(&position, lane)).powi(2)).sum::<f64>()
            })
            .sum();
        squares / samples as f64
    }

    /// The curves through `values`: `lanes` numbers for each picture, picture after picture.
    pub(super) fn curves(&self, lanes: usize, values: Vec<f32>) -> Curves {
        let bends = self.system.solve(&self.gaps, lanes, &values);
        Curves { lanes, values, bends }
    }
}

/// Steps that differ by less than this share of the mean one are the same: no picture shows it.
const SAME_STEP: f64 = 1e-6;

fn all_within(gaps: &[f64], share: f64) -> bool {
    gaps.iter().all(|gap| (gap - 1.0).abs() < share)
}

impl Curves {
    pub(super) fn at(&self, position: &Position, lane: usize) -> f32 {
        let (a, b) = (position.first * self.lanes + lane, position.second * self.lanes + lane);
        position.value[0] * self.values[a]
            + position.value[1] * self.values[b]
            + position.bend[0] * self.bends[a]
            + position.bend[1] * self.bends[b]
    }

    /// The colour of the texel whose red is in `lane`; light is never negative.
    #[inline]
    pub(super) fn colour(&self, position: &Position, lane: usize) -> [f32; 3] {
        let row = |of: &[f32], picture: usize| -> [f32; 3] {
            let start = picture * self.lanes + lane;
            [of[start], of[start + 1], of[start + 2]]
        };
        let (v0, v1) = (row(&self.values, position.first), row(&self.values, position.second));
        let (b0, b1) = (row(&self.bends, position.first), row(&self.bends, position.second));
        let (v, b) = (position.value, position.bend);
        std::array::from_fn(|c| (v[0] * v0[c] + v[1] * v1[c] + b[0] * b0[c] + b[1] * b1[c]).max(0.0))
    }
}

/// `g[k-1] M[k-1] + 2 (g[k-1] + g[k]) M[k] + g[k] M[k+1] = 6 (slope[k] - slope[k-1])`, all indices cyclic.
struct System {
    /// Thomas's factors: `1 / pivot`, and the upper diagonal over it.
    inverse: Vec<f32>,
    upper: Vec<f32>,
    /// Sherman and Morrison's correction: the solution for the corner vector, and the corner's weights.
    correction: Vec<f32>,
    corner: f32,
    scale: f32,
}

impl System {
    fn new(gaps: &[f64]) -> Self {
        let count = gaps.len();
        let before = |k: usize| gaps[(k + count - 1) % count];
        let corner = before(0);
        let mut diagonal: Vec<f64> = (0..count).map(|k| 2.0 * (before(k) + gaps[k])).collect();
        let gamma = -diagonal[0];
        diagonal[0] -= gamma;
        diagonal[count - 1] -= corner * corner / gamma;
        let mut inverse = Vec::with_capacity(count);
        let mut upper = Vec::with_capacity(count);
        for k in 0..count {
            let pivot = if k == 0 { diagonal[0] } else { diagonal[k] - before(k) * upper[k - 1] };
            inverse.push(1.0 / pivot);
            upper.push(gaps[k] / pivot);
        }
        let mut correction = vec![0.0; count];
        correction[0] = gamma;
        correction[count - 1] = corner;
        for k in 0..count {
            let low = if k == 0 { 0.0 } else { before(k) * correction[k - 1] };
            correction[k] = (correction[k] - low) * inverse[k];
        }
        for k in (0..count - 1).rev() {
            correction[k] -= upper[k] * correction[k + 1];
        }
        let weight = corner / gamma;
        let scale = 1.0 / (1.0 + correction[0] + weight * correction[count - 1]);
        let single = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
        Self {
            inverse: single(inverse),
            upper: single(upper),
            correction: single(correction),
            corner: weight as f32,
            scale: scale as f32,
        }
    }

    /// The second derivatives for all lanes at once.
    fn solve(&self, gaps: &[f64], lanes: usize, values: &[f32]) -> Vec<f32> {
        let count = gaps.len();
        let mut bends = vec![0.0f32; values.len()];
        for k in 0..count {
            let (previous, next) = ((k + count - 1) % count, (k + 1) % count);
            let (low, high) = (gaps[previous] as f32, gaps[k] as f32);
            let (into_low, into_high) = (6.0 / low, 6.0 / high);
            let of = |picture: usize| &values[picture * lanes..][..lanes];
            let (before, here, after) = (of(previous), of(k), of(next));
            let (done, rest) = bends.split_at_mut(k * lanes);
            let inverse = self.inverse[k];
            let right = |l: usize| (after[l] - here[l]) * into_high - (here[l] - before[l]) * into_low;
            if k == 0 {
                for (l, bend) in rest[..lanes].iter_mut().enumerate() {
                    *bend = right(l) * inverse;
                }
            } else {
                let last = &done[(k - 1) * lanes..];
                for (l, bend) in rest[..lanes].iter_mut().enumerate() {
                    *bend = (right(l) - low * last[l]) * inverse;
                }
            }
        }
        for k in (0..count - 1).rev() {
            let (now, later) = bends.split_at_mut((k + 1) * lanes);
            for (bend, next) in now[k * lanes..].iter_mut().zip(&later[..lanes]) {
                *bend -= self.upper[k] * next;
            }
        }
        let shares: Vec<f32> = (0..lanes)
            .map(|l| (bends[l] + self.corner * bends[(count - 1) * lanes + l]) * self.scale)
            .collect();
        for (row, correction) in bends.chunks_exact_mut(lanes).zip(&self.correction) {
            for (bend, share) in row.iter_mut().zip(&shares) {
                *bend -= share * correction;
            }
        }
        bends
    }
}

/// The pictures' texels, kept as half floats: picture after picture, in order of turn.
pub(super) struct Stack {
    pub(super) pictures: Vec<Vec<f16>>,
}

impl Stack {
    /// The values of `texels` (indices into the footprints' list) over the turn, as [`Spline::curves`] takes them;
    /// gaps in the coverage are bridged. Also, for each texel, the share of pictures that show it.
    pub(super) fn gather(&self, texels: &[usize]) -> (Vec<f32>, Vec<f32>) {
        let lanes = 3 * texels.len();
        let mut halves = Vec::with_capacity(lanes * self.pictures.len());
        match texels {
            // Texels in a row are copied at once.
            [first, .., last] if texels.windows(2).all(|pair| pair[0] + 1 == pair[1]) => {
                for picture in &self.pictures {
                    halves.extend_from_slice(&picture[3 * first..3 * last + 3]);
                }
            }
            _ => {
                for picture in &self.pictures {
                    for &texel in texels {
                        halves.extend_from_slice(&picture[3 * texel..3 * texel + 3]);
                    }
                }
            }
        }
        let mut values = vec![0.0; halves.len()];
        halves.convert_to_f32_slice(&mut values);
        let mut shown = vec![1.0; texels.len()];
        if values.iter().any(|value| value.is_nan()) {
            for (k, shown) in shown.iter_mut().enumerate() {
                *shown = bridge(&mut values, lanes, 3 * k);
            }
        }
        (values, shown)
    }
}

/// Replaces a texel's missing colours by those between its neighbours in turn; gives the share that was there.
fn bridge(values: &mut [f32], lanes: usize, lane: usize) -> f32 {
    let count = values.len() / lanes;
    let there: Vec<usize> = (0..count).filter(|k| !values[k * lanes + lane].is_nan()).collect();
    let Some(&first) = there.first() else {
        for row in values.chunks_exact_mut(lanes) {
            row[lane..lane + 3].fill(0.0);
        }
        return 0.0;
    };
    let around = there.iter().skip(1).copied().chain([first + count]);
    for (&from, to) in there.iter().zip(around) {
        for k in from + 1..to {
            let along = (k - from) as f32 / (to - from) as f32;
            for c in lane..lane + 3 {
                let (a, b) = (values[from * lanes + c], values[(to % count) * lanes + c]);
                values[(k % count) * lanes + c] = a + (b - a) * along;
            }
        }
    }
    there.len() as f32 / count as f32
}

/// A direction in the table: its azimuth, radians, and that one's cosine and sine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Direction {
    phi: f32,
    cos: f32,
    sin: f32,
}

impl Direction {
    pub(super) fn new(phi: f64) -> Self {
        Self { phi: phi as f32, cos: phi.cos() as f32, sin: phi.sin() as f32 }
    }
}

/// The turn, radians, at which the pictures show the texel's tangent of this azimuth.
///
/// In the pictures the tangent is constant in the projection at the true normal m; the turn that takes m to the
/// table's n leaves the transported azimuth as it is.
#[inline]
pub(super) fn reading_turn(texel: &Texel, azimuth: Azimuth, direction: &Direction) -> f64 {
    match azimuth {
        Azimuth::Transported => projected_at(texel.m, direction.cos, direction.sin),
        // Orthographic: the picture's own azimuth.
        Azimuth::Projected if texel.n == texel.m => f64::from(direction.phi),
        Azimuth::Projected => {
            let n = texel.n.as_vec3();
            let transported = transported_azimuth(n, Azimuth::Projected.tangent(n, direction.phi));
            projected_at(texel.m, transported.cos(), transported.sin())
        }
    }
}

/// The projected azimuth, at the normal m, of the tangent whose transported azimuth has this cosine and sine.
#[inline]
fn projected_at(m: DVec3, cos: f32, sin: f32) -> f64 {
    let m = m.as_vec3();
    let d = (m.x * cos + m.y * sin) / (1.0 + m.z);
    f64::from((sin - m.y * d).atan2(cos - m.x * d))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uneven turns, the first past zero.
    fn uneven(count: usize) -> Vec<f64> {
        (0..count).map(|k| (k as f64 + 0.3 + 0.25 * (k as f64 * 1.7).sin()) * TAU / count as f64).collect()
    }

    fn wave(turn: f64) -> f64 {
        2.0 + (turn - 0.4).sin() + 0.5 * (3.0 * turn).cos()
    }

    #[test]
    fn a_spline_follows_a_smooth_periodic_curve() {
        for (turns, tolerance) in
            [(uneven(40), 4e-3), ((0..40).map(|k| TAU * f64::from(k) / 40.0).collect(), 2e-3)]
        {
            let values = turns.iter().flat_map(|&turn| [wave(turn) as f32, 1.0]).collect();
            let spline = Spline::new(turns.clone());
            let curves = spline.curves(2, values);
            for k in 0..1000 {
                let turn = f64::from(k) * TAU / 1000.0 - 1.0;
                let position = spline.position(turn);
                assert!((f64::from(curves.at(&position, 0)) - wave(turn)).abs() < tolerance, "{k}");
                assert!((curves.at(&position, 1) - 1.0).abs() < 1e-5);
            }
            for &turn in &turns {
                assert!((f64::from(curves.at(&spline.position(turn), 0)) - wave(turn)).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn noise_passes_a_spline_as_its_gain_says() {
        // Between two even samples a cardinal spline keeps 0.86 or so of white noise; at the samples all of it.
        let gain = Spline::new((0..64).map(|k| TAU * f64::from(k) / 64.0).collect()).noise_gain();
        assert!(gain > 0.75 && gain < 0.95, "{gain}");
    }

    #[test]
    fn missing_pictures_are_bridged_around_the_turn() {
        let mut values =
            vec![f32::NAN, f32::NAN, f32::NAN, 4.0, 4.0, 4.0, 1.0, 1.0, 1.0, f32::NAN, f32::NAN, f32::NAN];
        assert_eq!(bridge(&mut values, 3, 0), 0.5);
        assert_eq!(values, [3.0, 3.0, 3.0, 4.0, 4.0, 4.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    }

    #[test]
    fn the_turn_read_shows_the_tangent_asked_for() {
        for k in 0..50 {
            let n = DVec3::new(0.1 * f64::from(k % 7), 0.08 * f64::from(k % 9) - 0.3, 1.0).normalize();
            let texel = Texel { i: 0, j: 0, n, m: n };
            let phi = f64::from(k) * 0.37;
            let turn = reading_turn(&texel, Azimuth::Transported, &Direction::new(phi));
            // The tangent whose projection has the azimuth of the turn.
            let t = Azimuth::Projected.tangent(n.as_vec3(), turn as f32);
            let back = f64::from(transported_azimuth(n.as_vec3(), t));
            assert!((back - phi).sin().abs() < 1e-4 && (back - phi).cos() > 0.0, "{back} {phi}");
        }
    }
}

//! Between the pictures a texel's colour is a periodic cubic spline through them, which even steps do not ask for:
//! nearly what the sampling theorem allows, without ringing as far as a sinc does.

use std::f64::consts::TAU;

use wide::f32x4;

/// The periodic cubic spline through values at some turns.
pub(in crate::capture) struct Spline {
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
pub(in crate::capture) struct Position {
    first: usize,
    second: usize,
    value: [f32; 2],
    bend: [f32; 2],
}

/// Some texels' colours over the turn: `lanes` numbers for each picture, and their second derivatives.
pub(in crate::capture) struct Curves {
    lanes: usize,
    values: Vec<f32>,
    bends: Vec<f32>,
}

impl Spline {
    /// Through `turns`: at least three, radians in [0, 2 pi), strictly rising.
    pub(in crate::capture) fn new(mut turns: Vec<f64>) -> Self {
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
    pub(in crate::capture) fn len(&self) -> usize {
        self.turns.len()
    }

    /// Whether the turns are even, to a hundredth of a step.
    pub(in crate::capture) fn is_even(&self) -> bool {
        all_within(&self.gaps, 0.01)
    }

    /// The spline, over twice the turn, through the means of pictures half a turn apart; none where the pictures do not
    /// come in such pairs, at even steps.
    pub(in crate::capture) fn of_half_turns(&self) -> Option<Self> {
        let count = self.len();
        // A spline needs three.
        (self.even_rate.is_some() && count.is_multiple_of(2) && count >= 6).then(|| {
            Self::new(self.turns[..count / 2].iter().map(|turn| 2.0 * (turn + self.start)).collect())
        })
    }

    /// Where turns in radians lie.
    pub(in crate::capture) fn positions(&self, turns: &[f32], positions: &mut Vec<Position>) {
        positions.clear();
        let turns = turns.iter().map(|&turn| f64::from(turn));
        match self.even_rate {
            Some(rate) => {
                positions.extend(turns.map(|turn| self.even_position(self.since_first(turn) * rate)))
            }
            None => positions.extend(turns.map(|turn| self.position(turn))),
        }
    }

    /// The turn in [0, 2 pi) since the first one.
    #[inline]
    fn since_first(&self, turn: f64) -> f64 {
        let turn = turn - self.start;
        // Nearly always within one turn of the range: no division.
        let near = if turn < 0.0 {
            turn + TAU
        } else if turn >= TAU {
            turn - TAU
        } else {
            turn
        };
        if (0.0..TAU).contains(&near) { near } else { turn.rem_euclid(TAU) }
    }

    /// Where a turn in radians lies.
    fn position(&self, turn: f64) -> Position {
        let turn = self.since_first(turn);
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
    pub(in crate::capture) fn noise_gain(&self) -> f64 {
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
    pub(in crate::capture) fn curves(&self, lanes: usize, values: Vec<f32>) -> Curves {
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
    pub(in crate::capture) fn at(&self, position: &Position, lane: usize) -> f32 {
        let (a, b) = (position.first * self.lanes + lane, position.second * self.lanes + lane);
        position.value[0] * self.values[a]
            + position.value[1] * self.values[b]
            + position.bend[0] * self.bends[a]
            + position.bend[1] * self.bends[b]
    }

    /// The curve of the texel whose red is in `lane`.
    pub(in crate::capture) fn knots(&self, lane: usize, knots: &mut Knots) {
        let colour = |row: &[f32]| f32x4::new([row[lane], row[lane + 1], row[lane + 2], 0.0]);
        let rows = self.values.chunks_exact(self.lanes).zip(self.bends.chunks_exact(self.lanes));
        knots.0.clear();
        knots.0.extend(rows.map(|(values, bends)| [colour(values), colour(bends)]));
    }
}

/// One texel's curve: for each picture red, green and blue, and their second derivatives, side by side in memory.
#[derive(Default)]
pub(in crate::capture) struct Knots(Vec<[f32x4; 2]>);

impl Knots {
    /// Red, green and blue; light is never negative.
    #[inline]
    pub(in crate::capture) fn colour(&self, position: &Position) -> f32x4 {
        let ([v0, b0], [v1, b1]) = (self.0[position.first], self.0[position.second]);
        let ([before, along], [bend_before, bend_along]) = (position.value, position.bend);
        (v0 * before + v1 * along + b0 * bend_before + b1 * bend_along).fast_max(f32x4::ZERO)
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
    fn a_texels_knots_give_its_curve() {
        let values: Vec<f32> = (0..16 * 6).map(|k| ((k * 37) % 11) as f32 / 11.0).collect();
        let spline = Spline::new(uneven(16));
        let curves = spline.curves(6, values);
        let (mut knots, mut positions) = (Knots::default(), Vec::new());
        curves.knots(3, &mut knots);
        let turns: Vec<f32> = (0..40).map(|k| k as f32 * 0.37 - 5.0).collect();
        spline.positions(&turns, &mut positions);
        for (position, &turn) in positions.iter().zip(&turns) {
            let colour = knots.colour(position).to_array();
            for (c, value) in colour[..3].iter().enumerate() {
                let expected = curves.at(&spline.position(f64::from(turn)), 3 + c).max(0.0);
                assert!((value - expected).abs() < 1e-5, "{turn}");
            }
        }
    }
}

//! Constraints in groups that share no particle.

use std::ops::Range;

use rayon::prelude::*;

/// What acts on a few particles.
pub(super) trait Acts: Copy + Sync {
    /// The particles it reads or moves.
    fn particles(&self) -> impl Iterator<Item = u32>;
}

/// Constraints sorted by colour: those of one colour share no particle and can be solved in any order, so the result
/// does not depend on the number of threads.
#[derive(Debug)]
pub(super) struct Coloured<C> {
    constraints: Vec<C>,
    colours: Vec<Range<usize>>,
    /// From here on constraints may share particles.
    rest: usize,
}

/// Below this many constraints threads cost more than they bring.
const WORTH_THREADS: usize = 512;
/// Constraints that a thread takes at a time.
const CHUNK: usize = 128;

impl<C: Acts> Coloured<C> {
    /// Colours greedily, in the given order.
    pub(super) fn new(constraints: Vec<C>, particles: usize) -> Self {
        let mut used = vec![0u64; particles];
        let mut buckets: Vec<Vec<C>> = Vec::new();
        let mut uncoloured = Vec::new();
        for constraint in constraints {
            let taken = constraint.particles().fold(0, |taken, particle| taken | used[particle as usize]);
            let colour = taken.trailing_ones() as usize;
            if colour >= 64 {
                uncoloured.push(constraint);
                continue;
            }
            constraint.particles().for_each(|particle| used[particle as usize] |= 1 << colour);
            if buckets.len() <= colour {
                buckets.resize_with(colour + 1, Vec::new);
            }
            buckets[colour].push(constraint);
        }
        let mut sorted = Vec::new();
        let mut colours = Vec::new();
        for bucket in buckets {
            let start = sorted.len();
            sorted.extend(bucket);
            colours.push(start..sorted.len());
        }
        let rest = sorted.len();
        sorted.extend(uncoloured);
        Self { constraints: sorted, colours, rest }
    }

    /// Does `solve` to every constraint, colour by colour; it gets the constraint's index in [`Self::all`] too.
    pub(super) fn for_each(&self, solve: impl Fn(usize, &C) + Sync) {
        for colour in &self.colours {
            let (start, constraints) = (colour.start, &self.constraints[colour.clone()]);
            if constraints.len() < WORTH_THREADS {
                solve_in_turn(start, constraints, &solve);
            } else {
                let chunks = constraints.par_chunks(CHUNK).enumerate();
                chunks.for_each(|(chunk, constraints)| {
                    solve_in_turn(start + chunk * CHUNK, constraints, &solve);
                });
            }
        }
        solve_in_turn(self.rest, &self.constraints[self.rest..], &solve);
    }

    /// All constraints.
    pub(super) fn all(&self) -> &[C] {
        &self.constraints
    }
}

fn solve_in_turn<C>(start: usize, constraints: &[C], solve: &impl Fn(usize, &C)) {
    constraints.iter().enumerate().for_each(|(index, constraint)| solve(start + index, constraint));
}

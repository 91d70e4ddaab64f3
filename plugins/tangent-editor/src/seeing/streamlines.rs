//! Evenly spaced streamlines.
//!
//! Source: B. Jobard, W. Lefer, "Creating evenly-spaced streamlines of arbitrary density", Visualization in Scientific Computing 1997.

use std::collections::VecDeque;

use glam::Vec2;

/// A line is drawn on until it is nearer than this to another, of the distance that they start at.
const NEAREST: f32 = 0.5;
/// Points of a line to a separation.
const POINTS: f32 = 5.0;
/// The most points of one line, and of all.
const MOST: (usize, usize) = (20_000, 2_000_000);

/// A box of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Domain {
    /// Its corner with the least coordinates.
    pub(super) low: Vec2,
    /// The other one.
    pub(super) high: Vec2,
}

/// Lines along a field, about `separation` apart, none nearer than half of it to another. `along` gives the unit direction at a place, on
/// the side of the heading it is given; none where there is no field. Deterministic.
pub(super) fn streamlines(
    domain: Domain,
    separation: f32,
    along: impl Fn(Vec2, Vec2) -> Option<Vec2>,
) -> Vec<Vec<Vec2>> {
    let size = domain.high - domain.low;
    if !(separation > 0.0 && size.is_finite() && size.min_element() >= 0.0) {
        return Vec::new();
    }
    let mut drawn = Drawn::new(domain, separation);
    let mut seeds = VecDeque::from([(domain.low + domain.high) / 2.0]);
    // Where no line leads, the next seed is found in rows.
    let rows = rows(domain, separation);
    for row in rows {
        seeds.push_back(row);
        while let Some(seed) = seeds.pop_front() {
            if drawn.count > MOST.1 {
                return drawn.lines;
            }
            if !drawn.is_free(seed, separation, None) {
                continue;
            }
            let Some(line) = drawn.line(seed, separation, &along) else { continue };
            for (at, way) in line.iter().zip(ways(&line)) {
                seeds.extend([1.0, -1.0].map(|side| *at + way.perp() * (side * separation * 1.0001)));
            }
            drawn.add(line);
        }
    }
    drawn.lines
}

/// Places in rows over the whole domain.
fn rows(domain: Domain, separation: f32) -> impl Iterator<Item = Vec2> {
    let count = ((domain.high - domain.low) / separation).ceil().min(Vec2::splat(4096.0));
    let (columns, rows) = (count.x as usize + 1, count.y as usize + 1);
    (0..columns * rows).map(move |k| {
        domain.low + Vec2::new((k % columns) as f32 + 0.5, (k / columns) as f32 + 0.5) * separation
    })
}

/// The unit way at each point of a line.
fn ways(line: &[Vec2]) -> Vec<Vec2> {
    let way = |k: usize| line[(k + 1).min(line.len() - 1)] - line[k.saturating_sub(1)];
    (0..line.len()).map(|k| way(k).normalize_or_zero()).collect()
}

/// The lines so far, and their points in cells as broad as the separation.
struct Drawn {
    lines: Vec<Vec<Vec2>>,
    count: usize,
    low: Vec2,
    cell: f32,
    columns: usize,
    rows: usize,
    /// Points and the numbers of their lines.
    cells: Vec<Vec<(Vec2, usize)>>,
}

impl Drawn {
    fn new(domain: Domain, separation: f32) -> Self {
        let size = domain.high - domain.low;
        let cell = separation.max(size.max_element() / 4096.0);
        let (columns, rows) = ((size.x / cell) as usize + 1, (size.y / cell) as usize + 1);
        let cells = vec![Vec::new(); columns * rows];
        Self { lines: Vec::new(), count: 0, low: domain.low, cell, columns, rows, cells }
    }

    fn place(&self, at: Vec2) -> (usize, usize) {
        let cell = ((at - self.low) / self.cell).max(Vec2::ZERO);
        ((cell.x as usize).min(self.columns - 1), (cell.y as usize).min(self.rows - 1))
    }

    /// Whether no point of a line is nearer than `distance`; `own`: the line that is being drawn, all but its last points.
    fn is_free(&self, at: Vec2, distance: f32, own: Option<&[Vec2]>) -> bool {
        let is_near = |other: Vec2| other.distance_squared(at) < distance * distance;
        if own.is_some_and(|own| own.iter().any(|&other| is_near(other))) {
            return false;
        }
        let (column, row) = self.place(at);
        let reach = (distance / self.cell).ceil() as usize;
        for row in row.saturating_sub(reach)..=(row + reach).min(self.rows - 1) {
            for column in column.saturating_sub(reach)..=(column + reach).min(self.columns - 1) {
                if self.cells[row * self.columns + column].iter().any(|&(other, _)| is_near(other)) {
                    return false;
                }
            }
        }
        true
    }

    /// The line through a seed, both ways until it ends, comes near another, or closes; none where it would be a dot.
    fn line(
        &self,
        seed: Vec2,
        separation: f32,
        along: &impl Fn(Vec2, Vec2) -> Option<Vec2>,
    ) -> Option<Vec<Vec2>> {
        let start = along(seed, Vec2::X)?;
        let mut line = vec![seed];
        for way in [start, -start] {
            let mut own = line.clone();
            let mut heading = way;
            while own.len() < MOST.0 {
                let at = own[own.len() - 1];
                let Some(next) = step(at, heading, separation / POINTS, along) else { break };
                // Points less than a separation back on the line are near, and may be.
                let old = own.len().saturating_sub((2.0 * POINTS) as usize);
                if !self.is_free(next, NEAREST * separation, Some(&own[..old])) {
                    break;
                }
                heading = next - at;
                own.push(next);
            }
            line = own;
            line.reverse();
        }
        (line.len() as f32 > 2.0 * POINTS).then_some(line)
    }

    fn add(&mut self, line: Vec<Vec2>) {
        for &at in &line {
            let (column, row) = self.place(at);
            self.cells[row * self.columns + column].push((at, self.lines.len()));
        }
        self.count += line.len();
        self.lines.push(line);
    }
}

/// A step along the field, by the Runge-Kutta method of fourth order.
fn step(at: Vec2, heading: Vec2, length: f32, along: &impl Fn(Vec2, Vec2) -> Option<Vec2>) -> Option<Vec2> {
    let a = along(at, heading)?;
    let b = along(at + a * (length / 2.0), a)?;
    let c = along(at + b * (length / 2.0), b)?;
    let d = along(at + c * length, c)?;
    Some(at + (a + 2.0 * b + 2.0 * c + d) * (length / 6.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOMAIN: Domain = Domain { low: Vec2::NEG_ONE, high: Vec2::ONE };

    fn aligned(line: Vec2, heading: Vec2) -> Option<Vec2> {
        Some(if line.dot(heading) < 0.0 { -line } else { line })
    }

    fn inside(at: Vec2) -> bool {
        at.abs().max_element() <= 1.0
    }

    /// Of the points of different lines the least distance.
    fn nearest(lines: &[Vec<Vec2>]) -> f32 {
        let mut least = f32::INFINITY;
        for (k, line) in lines.iter().enumerate() {
            for other in &lines[k + 1..] {
                for a in line {
                    least = other.iter().map(|b| a.distance(*b)).fold(least, f32::min);
                }
            }
        }
        least
    }

    #[test]
    fn lines_of_a_circular_field_stay_on_circles_and_keep_their_distance() {
        let separation = 0.1;
        let around = |at: Vec2, heading: Vec2| {
            let within = at.length() > 0.15 && inside(at);
            within.then(|| aligned(at.perp().normalize_or_zero(), heading)).flatten()
        };
        let lines = streamlines(DOMAIN, separation, around);
        assert!(lines.len() >= 8, "{}", lines.len());
        for line in &lines {
            let radii = || line.iter().map(|at| at.length());
            let (low, high) = (radii().fold(9.0, f32::min), radii().fold(0.0, f32::max));
            assert!(high - low < 1e-3 * high, "{low} to {high}");
        }
        let least = nearest(&lines);
        assert!(least >= 0.5 * separation * 0.999, "{least}");
        // Nothing is left empty: of the places on the field none is farther than a separation or so from a line.
        for k in 0..400 {
            let at = Vec2::from_angle(k as f32 * 2.4) * (0.2 + 0.7 * (k as f32 / 400.0));
            let room = lines.iter().flatten().map(|other| other.distance(at)).fold(9.0, f32::min);
            assert!(room < 1.2 * separation, "{room} at {at}");
        }
    }

    #[test]
    fn lines_of_a_constant_field_are_straight_and_the_same_each_time() {
        let along =
            |at: Vec2, heading: Vec2| inside(at).then(|| aligned(Vec2::from_angle(0.5), heading)).flatten();
        let lines = streamlines(DOMAIN, 0.08, along);
        let across = Vec2::from_angle(0.5).perp();
        for line in &lines {
            let off = line.iter().map(|at| (at.dot(across) - line[0].dot(across)).abs()).fold(0.0, f32::max);
            assert!(off < 1e-4, "{off}");
        }
        assert!(nearest(&lines) > 0.04);
        assert_eq!(lines, streamlines(DOMAIN, 0.08, along));
        assert!(streamlines(DOMAIN, 0.0, along).is_empty());
        assert!(streamlines(DOMAIN, f32::NAN, along).is_empty());
        assert!(streamlines(DOMAIN, 0.1, |_, _| None).is_empty());
    }
}

//! How values are spread over area.

/// Values with the areas that have them, in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Spread {
    values: Vec<f32>,
    /// Of all values up to this one.
    areas: Vec<f64>,
}

/// Shares of the area, in hundredths, by which spreads are told.
pub const SHARES: [u8; 5] = [1, 5, 50, 95, 99];

impl Spread {
    /// Of values and areas; what is no number does not count.
    pub(super) fn new(items: impl IntoIterator<Item = (f32, f32)>) -> Self {
        let mut items: Vec<(f32, f32)> =
            items.into_iter().filter(|item| item.0.is_finite() && item.1 > 0.0).collect();
        items.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let areas = items.iter().scan(0.0, |sum, item| {
            *sum += f64::from(item.1);
            Some(*sum)
        });
        let areas = areas.collect();
        Self { values: items.iter().map(|item| item.0).collect(), areas }
    }

    /// The area that has a value up to this.
    fn up_to(&self, value: f32) -> f64 {
        let count = self.values.partition_point(|&other| other <= value);
        if count == 0 { 0.0 } else { self.areas[count - 1] }
    }

    fn area(&self) -> f64 {
        self.areas.last().copied().unwrap_or_default()
    }
}

/// Of [`SHARES`] the least values that, with all below, have at least that share of the area of all spreads together. None where there is
/// no area.
pub(super) fn percentiles(spreads: &[&Spread]) -> Option<[f32; 5]> {
    let ends =
        |pick: fn(&Vec<f32>) -> Option<&f32>| spreads.iter().filter_map(move |it| pick(&it.values).copied());
    let low = ends(|values| values.first()).reduce(f32::min)?;
    let high = ends(|values| values.last()).reduce(f32::max)?;
    let area: f64 = spreads.iter().map(|it| it.area()).sum();
    Some(SHARES.map(|share| {
        let wanted = area * f64::from(share) / 100.0;
        let holds = |value: f32| spreads.iter().map(|it| it.up_to(value)).sum::<f64>() >= wanted;
        let (mut below, mut found) = (low, high);
        if holds(low) {
            return low;
        }
        // Halving reaches neighbouring numbers.
        for _ in 0..64 {
            let middle = below + (found - below) / 2.0;
            if middle <= below || middle >= found {
                break;
            }
            if holds(middle) { found = middle } else { below = middle }
        }
        found
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_of_a_known_distribution_count_areas() {
        // Value k has the area k: the area up to k is k (k + 1) / 2 of 500,500.
        let items: Vec<(f32, f32)> = (1..=1000).rev().map(|k| (k as f32, k as f32)).collect();
        let whole = Spread::new(items.clone());
        let found = percentiles(&[&whole]).unwrap();
        for (share, value) in SHARES.into_iter().zip(found) {
            let wanted = (1..=1000u32).find(|k| k * (k + 1) * 50 >= 500_500 * u32::from(share)).unwrap();
            assert!((value - wanted as f32).abs() < 1e-3, "{share}: {value}, not {wanted}");
        }
        // In parts they are the same.
        let parts: Vec<Spread> = items.chunks(300).map(|part| Spread::new(part.iter().copied())).collect();
        let parts: Vec<&Spread> = parts.iter().collect();
        assert_eq!(percentiles(&parts), Some(found));
    }

    #[test]
    fn what_is_no_number_does_not_count() {
        let spread = Spread::new([(f32::NAN, 1.0), (2.0, 0.0), (3.0, 1.0), (f32::INFINITY, 1.0)]);
        assert_eq!(percentiles(&[&spread]), Some([3.0; 5]));
        assert_eq!(percentiles(&[&Spread::default()]), None);
        assert_eq!(percentiles(&[]), None);
    }
}

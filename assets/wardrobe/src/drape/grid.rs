//! Which boxes lie near a place: a hash of cells.

use glam::{DVec3, IVec3};

/// Boxes entered into the cells of a regular grid that they touch, the cells hashed (Teschner and others 2003).
#[derive(Debug)]
pub(crate) struct CellGrid {
    cell: f64,
    mask: usize,
    /// Per bucket: where its entries start; one more at the end.
    starts: Vec<u32>,
    entries: Vec<(IVec3, u32)>,
}

impl CellGrid {
    /// Enters `boxes` (low and high corner, metres) into cells of the side `cell`, metres.
    pub(crate) fn new(boxes: &[(DVec3, DVec3)], cell: f64) -> Self {
        let mask = (2 * boxes.len()).next_power_of_two().max(16) - 1;
        let mut starts = vec![0u32; mask + 2];
        for (low, high) in boxes {
            cells(*low, *high, cell).for_each(|place| starts[bucket(place, mask) + 1] += 1);
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut entries = vec![(IVec3::ZERO, 0); starts[mask + 1] as usize];
        for (index, (low, high)) in boxes.iter().enumerate() {
            for place in cells(*low, *high, cell) {
                let slot = &mut next[bucket(place, mask)];
                entries[*slot as usize] = (place, index as u32);
                *slot += 1;
            }
        }
        Self { cell, mask, starts, entries }
    }

    /// The boxes in the cell of a place, in order.
    pub(crate) fn at(&self, place: DVec3) -> impl Iterator<Item = u32> {
        self.in_cell(cell_of(place, self.cell))
    }

    /// Visits the boxes that overlap the one of `index` and come after it, each once. `boxes` as they were entered.
    pub(crate) fn overlapping(&self, index: u32, boxes: &[(DVec3, DVec3)], mut visit: impl FnMut(u32)) {
        let (low, high) = boxes[index as usize];
        let (first, last) = (cell_of(low, self.cell), cell_of(high, self.cell));
        for z in first.z..=last.z {
            for y in first.y..=last.y {
                for x in first.x..=last.x {
                    let place = IVec3::new(x, y, z);
                    let bucket = self.bucket(place);
                    let after = bucket.partition_point(|entry| entry.1 <= index);
                    for (entered, other) in &bucket[after..] {
                        if *entered != place {
                            continue;
                        }
                        let (other_low, other_high) = boxes[*other as usize];
                        let overlap = low.cmple(other_high).all() && high.cmpge(other_low).all();
                        // Both may lie in several cells: the first that they share counts.
                        if overlap && cell_of(low.max(other_low), self.cell) == place {
                            visit(*other);
                        }
                    }
                }
            }
        }
    }

    fn bucket(&self, place: IVec3) -> &[(IVec3, u32)] {
        let bucket = bucket(place, self.mask);
        &self.entries[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    fn in_cell(&self, place: IVec3) -> impl Iterator<Item = u32> {
        self.bucket(place).iter().filter(move |entry| entry.0 == place).map(|entry| entry.1)
    }
}

/// The cell of a place; the offset makes rounding towards zero the rounding down that is wanted, without a slow `floor`.
fn cell_of(place: DVec3, cell: f64) -> IVec3 {
    (place / cell + DVec3::splat(f64::from(1 << 24))).as_ivec3()
}

fn cells(low: DVec3, high: DVec3, cell: f64) -> impl Iterator<Item = IVec3> {
    let (low, high) = (cell_of(low, cell), cell_of(high, cell));
    (low.z..=high.z).flat_map(move |z| {
        (low.y..=high.y).flat_map(move |y| (low.x..=high.x).map(move |x| IVec3::new(x, y, z)))
    })
}

fn bucket(place: IVec3, mask: usize) -> usize {
    let hash = (place.x.wrapping_mul(73_856_093))
        ^ (place.y.wrapping_mul(19_349_663))
        ^ (place.z.wrapping_mul(83_492_791));
    hash.unsigned_abs() as usize & mask
}

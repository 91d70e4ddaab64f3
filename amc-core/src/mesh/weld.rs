//! Finding vertices that are the same by value.

use std::hash::{BuildHasher as _, RandomState};

/// For each of `count` items, the first item with an equal key.
///
/// An open-addressed table under a folded multiplication, seeded afresh so that no file can be made to collide; the
/// result does not depend on the seed.
pub(crate) fn weld<const N: usize>(count: usize, key: impl Fn(usize) -> [u32; N]) -> Vec<u32> {
    const EMPTY: u32 = u32::MAX;
    let seed = RandomState::new().hash_one(N);
    let mask = (count * 2).next_power_of_two().max(2) - 1;
    let mut table = vec![EMPTY; mask + 1];
    let mut first = Vec::with_capacity(count);
    for item in 0..count {
        let wanted = key(item);
        let mut slot = hash(&wanted, seed) as usize & mask;
        first.push(loop {
            match table[slot] {
                EMPTY => {
                    table[slot] = item as u32;
                    break item as u32;
                }
                there if key(there as usize) == wanted => break there,
                _ => slot = (slot + 1) & mask,
            }
        });
    }
    first
}

/// The bits of a number, the same for both zeros.
pub(crate) fn bits(x: f32) -> u32 {
    (x + 0.0).to_bits()
}

fn hash(key: &[u32], seed: u64) -> u64 {
    key.iter().fold(seed, |hash, &word| {
        let product = u128::from(hash ^ u64::from(word)) * u128::from(0x9E37_79B9_7F4A_7C15_u64);
        (product as u64) ^ ((product >> 64) as u64)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equals_is_found() {
        let values = [1.0f32, -0.0, 2.0, 0.0, 1.0, 2.0, 3.0];
        assert_eq!(weld(values.len(), |i| [bits(values[i])]), [0, 1, 2, 1, 0, 2, 6]);
        assert!(weld(0, |_| [0]).is_empty());
    }
}

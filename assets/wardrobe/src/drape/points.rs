//! Places that several threads move at once.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;

/// Places of particles, metres.
///
/// Constraints of one colour share no particle, so no two threads ever touch the same place: the atomics (plain loads and
/// stores on common processors) only say so to the compiler.
#[derive(Debug)]
pub(super) struct Points(Vec<[AtomicU64; 3]>);

impl Points {
    pub(super) fn new(places: &[DVec3]) -> Self {
        Self(places.iter().map(|p| p.to_array().map(|value| AtomicU64::new(value.to_bits()))).collect())
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    #[inline]
    pub(super) fn get(&self, particle: u32) -> DVec3 {
        let [x, y, z] = &self.0[particle as usize];
        let read = |value: &AtomicU64| f64::from_bits(value.load(Ordering::Relaxed));
        DVec3::new(read(x), read(y), read(z))
    }

    #[inline]
    pub(super) fn set(&self, particle: u32, place: DVec3) {
        for (value, new) in self.0[particle as usize].iter().zip(place.to_array()) {
            value.store(new.to_bits(), Ordering::Relaxed);
        }
    }

    #[inline]
    pub(super) fn shift(&self, particle: u32, by: DVec3) {
        self.set(particle, self.get(particle) + by);
    }

    pub(super) fn to_vec(&self) -> Vec<DVec3> {
        (0..self.len()).map(|particle| self.get(particle as u32)).collect()
    }
}

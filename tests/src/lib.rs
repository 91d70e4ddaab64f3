//! What crosses crates: comparing pictures, tables of known symmetry, fuzz targets, fidelity figures.

pub mod fuzz_targets;
pub mod materials;

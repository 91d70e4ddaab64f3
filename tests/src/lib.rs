//! What tests, benchmarks and fuzz targets share: cloths of known symmetry, fuzz targets, timing.

pub mod fuzz_targets;
pub mod materials;
pub mod timing;

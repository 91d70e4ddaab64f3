//! What tests, benchmarks and fuzz targets share: cloths of known symmetry, large garments, fuzz targets, timing, displays,
//! what processes use.

pub mod display;
pub mod fuzz_targets;
pub mod large_garment;
pub mod materials;
pub mod timing;
pub mod usage;

//! Tests of the drape.

mod cloths;
mod physics;
mod placing;
mod whole;

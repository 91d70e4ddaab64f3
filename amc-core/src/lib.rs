//! Anisotropic MatCap without a window.
//!
//! An Anisotropic MatCap (AMC) is a small 3D table of the colour that a cloth shows, under one fixed lighting, at every
//! view-space normal and tangent direction. This crate makes such tables from pictures or reflectances, reads and
//! writes them, and renders garments in them, on the CPU and (feature `gpu`) through wgpu.
//!
//! Source: D. Magri, P. Cignoni, M. Tarini, "Anisotropic MatCap: Easy Capture and Reproduction of Anisotropic
//! Materials", Smart Tools and Apps for Graphics 2016; called "the paper" throughout.

pub mod amc;
pub mod bake;
pub mod capture;
pub mod color;
pub mod direction;
mod error;
pub mod exchange;
pub mod export;
pub mod file;
pub mod image;
pub mod mesh;
pub mod occlusion;
mod progress;
#[cfg(test)]
mod pseudo_random;
pub mod reflectance;
pub mod render;
pub mod shader;
pub mod shape;
pub mod view_space;

pub use error::{Error, ErrorKind, Place, Result};
pub use progress::{Progress, Step};

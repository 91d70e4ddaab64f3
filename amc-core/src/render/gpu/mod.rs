//! The wgpu renderer: the shaders of `shaders/` drawn into any render pass.
//!
//! [`Renderer`] lives as long as its device: shaders, pipelines, layouts. [`Scene`] is a drawing on the GPU, kept
//! between frames. [`SceneDrawData`] is one frame of it from one view, and draws into a pass whose attachments have the
//! [`TargetFormat`] it was made for: a file, a thumbnail, a window. [`render_picture`] does it all for one picture.
//!
//! It needs no more than a WebGL 2 class device: textures and uniform buffers.

mod ball;
mod bindings;
mod device;
mod fabric;
mod mesh;
mod mode;
mod offscreen;
mod pipeline;
mod print;
mod scene;
mod uniforms;

pub use device::{Backend, Gpu, checked};
pub use fabric::FabricTexture;
pub use mode::{LooksUp, MODES, ShadingMode};
pub use offscreen::{Offscreen, render_picture};
pub use pipeline::TargetFormat;
pub use scene::{Eye, Renderer, Scene, SceneDrawData};
/// The wgpu that this crate is built with: a second version of it would have other types.
pub use wgpu;

#[cfg(test)]
mod tests;

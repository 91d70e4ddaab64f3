//! The tangent-field editor: every panel's fabric direction.
//!
//! The flat pattern stands beside the garment, linked with it: what is selected or under the pointer in one is so in the other. The
//! grain of a panel is turned by its arrow, by number, by presets, or by what it is aligned to. What the editor keeps with the project
//! beside directions ([`Assignments`]) can be read without a window.

#![cfg_attr(not(feature = "window"), allow(dead_code, reason = "the window uses the rest"))]

mod assignments;
#[cfg(feature = "window")]
mod comb;
#[cfg(feature = "window")]
mod commands;
#[cfg(feature = "window")]
mod editor;
#[cfg(feature = "window")]
mod exchange;
#[cfg(feature = "window")]
mod grain;
#[cfg(feature = "window")]
mod grain_pane;
pub mod import;
#[cfg(feature = "window")]
mod overlay;
#[cfg(feature = "window")]
mod pattern;
pub mod seeing;
#[cfg(feature = "window")]
mod seeing_view;
mod sheet;
#[cfg(feature = "window")]
mod splitting;
pub mod tech_sheet;
mod texts;
#[cfg(feature = "window")]
mod warnings;

pub use assignments::{Assignment, Assignments, ID, Orientation};
#[cfg(feature = "window")]
pub use editor::TangentEditor;

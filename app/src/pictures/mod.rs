//! Pictures in files: of one view, of several side by side, of a whole turn. No window is needed, and no more than a band
//! of rows, or a frame, is held in memory.
//!
//! [`Order`] says what is wanted; the [`Painter`] draws it, on the graphics device or with the reference renderer.

mod format;
mod order;
mod painter;
mod sheet;
mod stand;
#[cfg(test)]
mod tests;
mod turn;

#[cfg(feature = "window")]
pub(crate) use format::{MOVING_SUFFIXES, STILL_SUFFIXES};
pub(crate) use order::{Kind, Order};
pub(crate) use painter::{Device, Painter};
pub(crate) use sheet::{SIDE_LIMIT, Size};
pub(crate) use stand::Stand;

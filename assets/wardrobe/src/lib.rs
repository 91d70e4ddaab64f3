//! Makes the garments that AMC Studio ships: pattern pieces described as data, cut flat, sewn and draped round a body.
//!
//! A development tool; nothing of it is linked into the studio. Data flows one way: [`pattern`] (outlines, grain, seams,
//! as read from JSON and checked) -> [`cut`] (pieces triangulated flat, seams as pairs of vertices) -> [`drape`]
//! (placed round a [`body`], seams closed, left to fall until still) -> [`garment_file`], figures ([`measure`]) and
//! pictures ([`flat_sheet`], [`contact_sheet`]). [`collection`] says which garments there are.

pub mod body;
pub mod collection;
pub mod contact_sheet;
pub mod cut;
pub mod drape;
pub mod flat_sheet;
pub mod garment_file;
pub mod measure;
pub mod pattern;

//! What a plugin of AMC Studio is, and what it sees of the studio.
//!
//! [`document`] is what the person works on; it changes only through [`document::Edit`]s, so that every change can be undone.

pub mod document;

//! The document: a garment, the fabrics in use, what each panel is made of and how it is cut, the view, notes.

mod view;

pub use view::{Angles, Lens, NamedView, TurningStyle, ViewSettings};

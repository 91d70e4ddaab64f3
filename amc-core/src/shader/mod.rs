//! Shaders by logical name: where their text comes from, how `#import` composes it, and whether it is valid WGSL.
//!
//! A shader `name` is the file `name.wgsl`. A line `#import other` stands for the text of `other.wgsl`, the first time
//! it is met in a composition; later imports of the same name stand for nothing. So names are global, and a file says
//! itself what it needs. Every line of the composed text can be led back to its file ([`Composition::origin`]), and
//! every fault is reported there.

mod compose;
mod sources;
#[cfg(feature = "gpu")]
mod validate;

pub use compose::{Composition, Origin, compose};
pub use sources::{Source, Sources};
#[cfg(feature = "gpu")]
pub use validate::{Checked, Member, StructLayout, validate};

#[cfg(test)]
mod tests;

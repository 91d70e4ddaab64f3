//! The reference renderer, in plain Rust.

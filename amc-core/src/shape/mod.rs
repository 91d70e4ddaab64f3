//! Shapes by name, in place of a mesh file.

//! AMCs from a reflectance under given lights.

//! AMCs from and to other files: slice atlas, slice folder, ordinary MatCap.

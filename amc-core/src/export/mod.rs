//! Directions, written for other programs.

//! Ambient occlusion per vertex (paper, section 6.1).

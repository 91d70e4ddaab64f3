//! Pictures of a turning ball made into an AMC (paper, section 5).
//!
//! [`build`] finds the ball, carries each picture to the table's grid of normals, and resamples every texel along
//! the turn into the azimuth asked for. What differs from the paper: the camera may stand anywhere (a cone, not a
//! crop), the default azimuth is the transported one, and the symmetry is measured free of scale and noise.

mod ball;
mod build;
mod cone;
mod fill;
mod pictures;
mod reading;
mod report;
mod resample;
mod session;
mod slices;
mod symmetry;
mod turn;

pub use build::{BuildOptions, Built, build};
pub use pictures::{FEWEST_PICTURES, MOST_PICTURES};
pub use report::{Ball, BuildReport};
pub use session::{SESSION_FILE, Session, SessionPicture, Turn};
pub use symmetry::{DEFAULT_THRESHOLD, Similarity};

#[cfg(test)]
mod tests;

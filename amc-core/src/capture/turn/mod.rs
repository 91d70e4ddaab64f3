//! Along the turn: what a texel shows at any angle of the ball, from the angles that were measured.

mod directions;
mod spline;
mod stack;

pub(super) use directions::Directions;
pub(super) use spline::{Knots, Spline};
pub(super) use stack::Stack;

//! Weld: a clamp. It holds the position and the direction of the slope, not its size: the body
//! stretches freely up to the clamp.

use nalgebra::Vector2;

use super::{Holds, across};
use crate::body::Hold;

pub(super) fn holds(slope: Vector2<f64>) -> Holds {
    vec![Hold::Position, Hold::SlopeAlong(across(slope))]
}

//! Slider: the marker stays on a fixed line and turns freely.

use nalgebra::Vector2;

use super::{Holds, across};
use crate::body::Hold;

pub(super) fn holds(direction: Vector2<f64>) -> Holds {
    vec![Hold::PositionAlong(across(direction))]
}

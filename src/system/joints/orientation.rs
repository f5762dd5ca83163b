//! Orientation: the marker moves freely and does not turn. With a slider it makes a prismatic joint.

use nalgebra::Vector2;

use super::{Holds, across};
use crate::body::Hold;

pub(super) fn holds(slope: Vector2<f64>) -> Holds {
    vec![Hold::SlopeAlong(across(slope))]
}

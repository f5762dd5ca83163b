//! Revolute joint: a pin. It holds the position.

use super::Holds;
use crate::body::Hold;

pub(super) fn holds() -> Holds {
    vec![Hold::Position]
}

//! Joints to ground. All of them are linear in nodal coordinates and go into `Phi`.

mod orientation;
mod revolute;
mod slider;
mod weld;

use nalgebra::Vector2;

use crate::body::{Constraint, Hold};

/// What a joint holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// The position.
    Revolute,
    /// The position and the direction of the slope.
    Weld,
    /// The position across this direction.
    Slider(Vector2<f64>),
    /// The direction of the slope.
    Orientation,
}

/// A joint between ground and a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// What it holds.
    pub kind: JointKind,
    /// Node of the body.
    pub node: usize,
    /// Slope there in the reference configuration.
    pub slope: Vector2<f64>,
}

impl Joint {
    /// Rows of `Phi`; `index` names the joint.
    pub fn constraints(&self, index: usize) -> Vec<Constraint<2>> {
        let holds = match self.kind {
            JointKind::Revolute => revolute::holds(),
            JointKind::Weld => weld::holds(self.slope),
            JointKind::Slider(direction) => slider::holds(direction),
            JointKind::Orientation => orientation::holds(self.slope),
        };
        let row = |hold| Constraint {
            node: self.node,
            hold,
            joint: index,
        };
        holds.into_iter().map(row).collect()
    }
}

/// The unit vector across a direction.
fn across(direction: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-direction.y, direction.x).normalize()
}

/// Rows that hold something.
type Holds = Vec<Hold<2>>;

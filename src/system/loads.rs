//! Loads at markers whose size the master sets.

use nalgebra::{Matrix2, Vector2};

use crate::body::{Marker, Tangent};
use crate::elements::Nodal;

/// What acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadKind {
    /// Force in global axes: two components, N.
    Force,
    /// Moment, counter-clockwise: one component, N m.
    Moment,
}

/// A load at a marker. The mesh has a node there.
#[derive(Clone, Debug)]
pub struct Load {
    /// What acts.
    pub kind: LoadKind,
    /// Where it acts.
    pub marker: Marker,
}

impl Load {
    /// Number of input components.
    pub fn components(&self) -> usize {
        match self.kind {
            LoadKind::Force => 2,
            LoadKind::Moment => 1,
        }
    }

    /// Adds the generalized force: `S^T F`, and for a moment `M d(angle)/de` with
    /// `d(angle) = (r' x dr') / r'.r'`.
    pub(super) fn add_force(&self, inputs: &[f64], e: &[Nodal<2>], force: &mut [Nodal<2>]) {
        let element = self.marker.element;
        match self.kind {
            LoadKind::Force => {
                let load = Vector2::new(inputs[0], inputs[1]);
                force[element] += load * self.marker.values.transpose();
            }
            LoadKind::Moment => {
                let u = self.marker.slope(e);
                let on_slope = Vector2::new(-u.y, u.x) * (inputs[0] / u.norm_squared());
                force[element] += on_slope * self.marker.slopes.transpose();
            }
        }
    }

    /// Adds minus the derivative of the force by the node's slope; a dead force has none.
    pub(super) fn add_stiffness(
        &self,
        inputs: &[f64],
        e: &[Nodal<2>],
        tangent: &mut Tangent<2, 4>,
    ) {
        if self.kind == LoadKind::Force {
            return;
        }
        let u = self.marker.slope(e);
        let a = u.norm_squared();
        let turned = Vector2::new(-u.y, u.x);
        let turn = Matrix2::new(0.0, -1.0, 1.0, 0.0);
        let k = (turned * u.transpose() * (2.0 / a) - turn) * (inputs[0] / a);
        let block = &mut tangent.stiffness.diagonal[self.marker.node()];
        for r in 0..2 {
            for c in 0..2 {
                block[2 + r][2 + c] += k[(r, c)];
            }
        }
    }

    /// Work of the load on the way from `before` to `after`, for the potential of a dead load; the
    /// angle turns by less than half a turn.
    pub(super) fn work(&self, inputs: &[f64], before: &[Nodal<2>], after: &[Nodal<2>]) -> f64 {
        match self.kind {
            LoadKind::Force => {
                let way = self.marker.position(after) - self.marker.position(before);
                inputs[0] * way.x + inputs[1] * way.y
            }
            LoadKind::Moment => {
                let (u, v) = (self.marker.slope(before), self.marker.slope(after));
                inputs[0] * u.perp(&v).atan2(u.dot(&v))
            }
        }
    }
}

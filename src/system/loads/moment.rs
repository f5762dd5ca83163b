//! A moment on the direction of one end and its opposite on another, the ground or a body: an applied
//! moment or the torque of a joint.

use nalgebra::Matrix2;

use super::{Add, Instant};
use crate::body::{Node, left};
use crate::math::jet::Number;
use crate::system::end::{End, coupling};
use crate::system::signal::Signal;

/// A moment.
#[derive(Clone, Debug)]
pub struct Moment {
    /// The second end takes the moment, the first one its opposite.
    pub ends: [End; 2],
    /// Size, counter-clockwise, N m.
    pub size: Signal,
}

impl Moment {
    pub(super) fn add_force<N: Number>(&self, at: Instant<'_, N>, f: &mut [Node<4, N>]) {
        let size = self.size.value(at);
        self.ends[1].lift().add_moment(size, at.x, f);
        self.ends[0].lift().add_moment(-size, at.x, f);
    }

    pub(super) fn add_stiffness(&self, at: Instant<'_>, add: Add<'_>) {
        let size = self.size.value(at);
        for (end, size) in self.ends.iter().zip([-size, size]) {
            if let End::Body(_) = end {
                let k = curl(end, at.x) * size;
                let zero = Matrix2::zeros();
                let ground = End::Ground(nalgebra::Vector2::zeros());
                coupling(&[*end, ground], [[k, zero], [zero, zero]], 1, add);
            }
        }
    }

    pub(super) fn power<N: Number>(&self, at: Instant<'_, N>) -> N {
        let [a, b] = self.ends.map(|end| end.lift().spin(at.x, at.v));
        self.size.value(at) * (b - a)
    }

    pub(super) fn work(&self, before: Instant<'_>, after: Instant<'_>) -> f64 {
        let turn = |end: &End| {
            let (u, v) = (end.direction(before.x), end.direction(after.x));
            u.perp(&v).atan2(u.dot(&v))
        };
        self.size.value(before) * (turn(&self.ends[1]) - turn(&self.ends[0]))
    }
}

/// Minus the second derivative of the angle of a direction.
pub(super) fn curl(end: &End, x: &[Node<4>]) -> Matrix2<f64> {
    let u = end.direction(x);
    let a = u.norm_squared();
    let turn = Matrix2::new(0.0, -1.0, 1.0, 0.0);
    (left(u) * u.transpose() * (2.0 / a) - turn) / a
}

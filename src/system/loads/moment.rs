//! A moment on the direction of one end and its opposite on another, the ground or a body: an applied
//! moment or the torque of a joint.

use nalgebra::SMatrix;

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::{Vector, cross};
use crate::system::end::{Attachment, coupling};
use crate::system::signal::Signal;

/// A moment.
#[derive(Clone, Debug)]
pub struct Moment<const D: usize = 2> {
    /// The second end takes the moment, the first one its opposite.
    pub ends: [Attachment<D>; 2],
    /// Size, counter-clockwise, N m.
    pub size: Signal,
}

impl<const D: usize> ForceElement<D> for Moment<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let size = self.size.value(at);
        let [first, second] = self.ends.map(|end| end.lift());
        call(&second, second.turn(size, at.x));
        call(&first, first.turn(-size, at.x));
    }

    fn add_tangent(&self, at: Instant<'_, D>, add: Add<'_, D>, _damping: Add<'_, D>) {
        let size = self.size.value(at);
        for (end, size) in self.ends.iter().zip([-size, size]) {
            if let Attachment::Body(_) = end {
                let k = end.curl(at.x) * size;
                let zero = SMatrix::zeros();
                let ground = Attachment::Ground(Vector::zeros());
                coupling(&[*end, ground], [[k, zero], [zero, zero]], 1, add);
            }
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [a, b] = self.ends.map(|end| end.lift().spin(at.x, at.v));
        [self.size.value(at) * (b - a), N::of(0.0)]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let turn = |end: &Attachment<D>| {
            let (u, v) = (end.direction(before.x), end.direction(after.x));
            cross(&u, &v).atan2(u.dot(&v))
        };
        self.size.value(before) * (turn(&self.ends[1]) - turn(&self.ends[0]))
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.size = self.size.held(at, fraction);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        call(&self.size);
    }

    fn is_moment(&self) -> bool {
        true
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }
}

//! Directions of bodies and of space, and the angle about the axis of a joint in space: from directions across the axis that
//! are fixed in the first body to one that is fixed in the second, `angle = atan2(m . u, n . u)` with `m = axis x n`.

use crate::bodies::{Marker, Node};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::end::Attachment;
use crate::system::gradient::Gradient;

/// A direction: of a marker, or fixed in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction<const D: usize> {
    /// Direction of a marker.
    Of(Marker),
    /// A unit vector.
    Fixed(Vector<D>),
}

/// Rotation of one body relative to another about an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisRotation<const D: usize> {
    /// Unit vectors `n` and `m` across the axis, fixed in the first body.
    pub across: [Direction<D>; 2],
    /// Unit vector `u` across the axis, fixed in the second body.
    pub of: Direction<D>,
}

impl<const D: usize> Direction<D> {
    /// Returns the components in global axes.
    pub fn value<N: Number>(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        match self {
            Self::Of(marker) => marker.lift().direction(x),
            Self::Fixed(direction) => direction.map(N::of),
        }
    }

    /// Returns the rates of the components in global axes, 1/s.
    pub fn rate<N: Number>(&self, v: &[Node<D, N>]) -> Vector<D, N> {
        match self {
            Self::Of(marker) => marker.lift().direction(v),
            Self::Fixed(_) => Vector::zeros(),
        }
    }

    /// Returns the end that the direction belongs to: the ground for a fixed direction.
    pub fn end(&self) -> Attachment<D> {
        match self {
            Self::Of(marker) => Attachment::Body(*marker),
            Self::Fixed(_) => Attachment::Ground(Vector::zeros()),
        }
    }
}

impl<const D: usize> AxisRotation<D> {
    /// Cosine and sine of the angle, times one factor: `n . u` and `m . u`.
    pub(super) fn products<N: Number>(&self, x: &[Node<D, N>]) -> [N; 2] {
        let u = self.of.value(x);
        self.across.map(|across| across.value(x).dot(&u))
    }

    pub(super) fn rates<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> [N; 2] {
        let (u, rate) = (self.of.value(x), self.of.rate(v));
        self.across
            .map(|across| across.rate(v).dot(&u) + across.value(x).dot(&rate))
    }

    /// Twice the products of rates: second derivatives of the products but for accelerations.
    pub(super) fn bends<N: Number>(&self, v: &[Node<D, N>]) -> [N; 2] {
        let rate = self.of.rate(v);
        self.across
            .map(|across| N::of(2.0) * across.rate(v).dot(&rate))
    }

    /// Derivatives of `w . u = cos(angle) m . u - sin(angle) n . u` at a given angle, of which these are sine and cosine.
    pub fn gradient_at<N: Number>(&self, [sin, cos]: [N; 2], x: &[Node<D, N>]) -> Gradient<D, N> {
        let [n, m] = self.across.map(|across| across.value(x));
        let none = Vector::zeros();
        Gradient {
            ends: [
                (self.turned([sin, cos]), [none, self.of.value(x)]),
                (self.of.end().lift(), [none, m * cos - n * sin]),
            ],
        }
    }

    /// Derivatives of the angle.
    pub fn gradient<N: Number>(&self, x: &[Node<D, N>]) -> Gradient<D, N> {
        let [p, q] = self.products(x);
        let size = (p * p + q * q).sqrt();
        let mut gradient = self.gradient_at([q / size, p / size], x);
        for (_, [_, direction]) in &mut gradient.ends {
            *direction /= size;
        }
        gradient
    }

    /// `w = -sin n + cos m`, across `u` at the angle with this sine and cosine, fixed in the first body: its end.
    pub(super) fn turned<N: Number>(&self, [sin, cos]: [N; 2]) -> Attachment<D, N> {
        let [n, m] = self.across;
        match (n, m) {
            (Direction::Of(n), Direction::Of(m)) => {
                Attachment::Body(n.lift().blended(-sin, &m.lift(), cos))
            }
            _ => Attachment::Ground(Vector::zeros()),
        }
    }

    /// Returns the rate of the angle, rad/s.
    pub fn rate<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        let ([p, q], [p_rate, q_rate]) = (self.products(x), self.rates(x, v));
        (p * q_rate - q * p_rate) / (p * p + q * q)
    }

    /// Returns the second time derivative of the angle at zero nodal accelerations, rad/s^2.
    pub fn bend<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        let ([p, q], [p_rate, q_rate]) = (self.products(x), self.rates(x, v));
        let ([p_bend, q_bend], two) = (self.bends(v), N::of(2.0));
        let change = two * (p * p_rate + q * q_rate) * self.rate(x, v);
        (p * q_bend - q * p_bend - change) / (p * p + q * q)
    }

    /// The rate of its rate, rad/s^2, under nodal accelerations `a`.
    pub fn second<N: Number>(&self, [x, v, a]: [&[Node<D, N>]; 3]) -> N {
        self.bend(x, v) + self.gradient(x).along(a)
    }
}

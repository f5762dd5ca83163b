//! The angle about the axis of a joint in space: from directions across the axis that are fixed in the first body to one that
//! is fixed in the second, `angle = atan2(m . u, n . u)` with `m = axis x n`; and what drives it,
//! `-sin(angle) n . u + cos(angle) m . u = 0`.

use nalgebra::SMatrix;

use super::{Direction, Gradient, View};
use crate::body::Node;
use crate::math::jet::Number;
use crate::math::space::{Vector, moment};
use crate::system::end::{Add, End, bilinear, coupling};

/// The turn of one body against another about an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisTurn<const D: usize> {
    /// Unit vectors `n` and `m` across the axis, fixed in the first body.
    pub across: [Direction<D>; 2],
    /// Unit vector `u` across the axis, fixed in the second body.
    pub of: Direction<D>,
}

/// A driven turn.
#[derive(Clone, Debug)]
pub struct DrivenTurn<const D: usize> {
    /// What is driven.
    pub turn: AxisTurn<D>,
    /// Driven coordinate: the angle, rad.
    pub drive: usize,
}

impl<const D: usize> AxisTurn<D> {
    fn products<N: Number>(&self, x: &[Node<D, N>]) -> [N; 2] {
        let u = self.of.value(x);
        self.across.map(|across| across.value(x).dot(&u))
    }

    fn rates<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> [N; 2] {
        let (u, rate) = (self.of.value(x), self.of.rate(v));
        self.across
            .map(|across| across.rate(v).dot(&u) + across.value(x).dot(&rate))
    }

    /// Twice the products of rates: second derivatives of the products but for accelerations.
    fn bends<N: Number>(&self, v: &[Node<D, N>]) -> [N; 2] {
        let rate = self.of.rate(v);
        self.across
            .map(|across| N::of(2.0) * across.rate(v).dot(&rate))
    }

    /// The angle that is nearest to `hint`, rad.
    pub fn value<N: Number>(&self, x: &[Node<D, N>], hint: N) -> N {
        let ([along, across], (sin, cos)) = (self.products(x), hint.sin_cos());
        hint + (cos * across - sin * along).atan2(cos * along + sin * across)
    }

    /// Unit vector along the axis.
    pub fn axis<N: Number>(&self, x: &[Node<D, N>]) -> [N; 3] {
        let [n, m] = self.across.map(|across| across.value(x));
        moment(&n, &m)
    }

    /// Adds the stiffness of a spring that is at rest now: so much times the square of the derivatives of the angle.
    pub fn add_square(&self, k: f64, x: &[Node<D>], add: Add<'_, D>) {
        let [p, q] = self.products(x);
        let size = p.hypot(q);
        let turned = [q / size, p / size];
        let [first, u] = [self.turned(turned), self.of.end()];
        let across = first.direction(x);
        let [w, u_now]: [Vector<D>; 2] = match first {
            End::Body(_) => [across, self.of.value(x)],
            End::Ground(_) => {
                let [n, m] = self.across.map(|across| across.value(x));
                [m * turned[1] - n * turned[0], self.of.value(x)]
            }
        };
        let [on_first, on_second] = [u_now, w];
        let part = |a: Vector<D>, b: Vector<D>| a * b.transpose() * k;
        let by = [
            [part(on_first, on_first), part(on_first, on_second)],
            [part(on_second, on_first), part(on_second, on_second)],
        ];
        coupling(&[first, u], by, 1, add);
    }

    /// `w = -sin n + cos m`, across `u` at the angle with this sine and cosine, fixed in the first body: its end.
    fn turned<N: Number>(&self, [sin, cos]: [N; 2]) -> End<D, N> {
        let [n, m] = self.across;
        match (n, m) {
            (Direction::Of(n), Direction::Of(m)) => {
                End::Body(n.lift().blended(-sin, &m.lift(), cos))
            }
            _ => End::Ground(Vector::zeros()),
        }
    }

    /// Its rate, rad/s.
    pub fn rate<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        let ([p, q], [p_rate, q_rate]) = (self.products(x), self.rates(x, v));
        (p * q_rate - q * p_rate) / (p * p + q * q)
    }

    /// The rate of that, rad/s^2, under nodal accelerations `a`.
    pub fn second<N: Number>(&self, [x, v, a]: [&[Node<D, N>]; 3]) -> N {
        let ([p, q], [p_rate, q_rate]) = (self.products(x), self.rates(x, v));
        let (by_rates, by_accelerations) = (self.bends(v), self.rates(x, a));
        let [p_second, q_second] = [0, 1].map(|k| by_rates[k] + by_accelerations[k]);
        let square = p * p + q * q;
        let change = N::of(2.0) * (p * p_rate + q * q_rate) * self.rate(x, v);
        (p * q_second - q * p_second - change) / square
    }
}

impl<const D: usize> DrivenTurn<D> {
    /// The driven angle with two derivatives, its sine and cosine.
    fn drive<N: Number>(&self, view: &View<'_, D, N>) -> ([N; 3], [N; 2]) {
        let drive = view.drives[self.drive];
        let (sin, cos) = drive[0].sin_cos();
        (drive, [sin, cos])
    }

    pub(super) fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let (_, [sin, cos]) = self.drive(view);
        let [p, q] = self.turn.products(view.x);
        cos * q - sin * p
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let (none, (_, [sin, cos])) = (Vector::zeros(), self.drive(view));
        let [n, m] = self.turn.across.map(|across| across.value(view.x));
        let u = self.turn.of.value(view.x);
        Gradient {
            ends: [
                (self.turn.turned([sin, cos]), [none, u]),
                (self.turn.of.end().lift(), [none, m * cos - n * sin]),
            ],
        }
    }

    pub(super) fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let ([_, rate, _], [sin, cos]) = self.drive(view);
        let [p, q] = self.turn.products(view.x);
        -rate * (sin * q + cos * p)
    }

    pub(super) fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let ([_, rate, second], [sin, cos]) = self.drive(view);
        let [p, q] = self.turn.products(view.x);
        let [p_rate, q_rate] = self.turn.rates(view.x, view.v);
        let [p_bend, q_bend] = self.turn.bends(view.v);
        let two = N::of(2.0);
        cos * q_bend - sin * p_bend - two * rate * (sin * q_rate + cos * p_rate)
            + rate * rate * (sin * p - cos * q)
            - second * (cos * p + sin * q)
    }

    pub(super) fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
        let (_, turned) = self.drive(view);
        if let (End::Body(first), Direction::Of(second)) = (self.turn.turned(turned), &self.turn.of)
        {
            bilinear(
                [(&first, 1), (second, 1)],
                SMatrix::identity() * lambda,
                add,
            );
        }
    }

    /// What it joins.
    pub fn ends(&self) -> Vec<End<D>> {
        vec![self.turn.across[0].end(), self.turn.of.end()]
    }
}

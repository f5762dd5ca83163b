//! Two surfaces that meet in a line at an angle that stays: with their slopes `a` and `b` across the line and the slope `t` along it,
//! `sin(phi - phi0) = 0`, where `phi` is the angle between both normals. With `s = a . (b x t)` and
//! `c = [(a . b)(t . t) - (a . t)(b . t)] / |t|` the sine and cosine of `phi` times one factor, `g = s cos(phi0) - c sin(phi0)`.
//!
//! Source: docs/decisions/0078-edges-of-plates.md.

use nalgebra::{Matrix3, Vector3};

use super::{Equation, Gradient, View};
use crate::bodies::{Bodies, Marker, Node, block_of};
use crate::math::jet::{Jet, Number};
use crate::math::space::{Vector, components, vector};
use crate::system::end::{Add, Attachment};

/// Slopes `a` and `b` across the line, and `t` along it.
type Slopes<N = f64> = [Vector3<N>; 3];

/// The angle between two surfaces at a point of their common line.
#[derive(Clone, Debug)]
pub struct Fold {
    /// Markers whose directions add up to each of the slopes.
    slopes: Box<[[Marker; 2]; 3]>,
    /// Sine and cosine of the angle, over the size of `g`.
    turned: [f64; 2],
}

impl Fold {
    /// The angle at a point stays as it is in these nodes. Of each slope the markers whose directions add up to it are given: across the line
    /// on both surfaces, then along it.
    pub fn new<const D: usize>(slopes: [[Marker; 2]; 3], nodes: &[Node<D>]) -> Self {
        let mut fold = Self {
            slopes: Box::new(slopes),
            turned: [0.0, 1.0],
        };
        let [sine, cosine] = products(&fold.at(nodes));
        let size = sine.hypot(cosine).powi(2);
        fold.turned = [sine / size, cosine / size];
        fold
    }

    fn at<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> Slopes<N> {
        std::array::from_fn(|k| {
            let [first, second] = self.slopes[k].map(|marker| marker.lift().direction(x));
            components::<D, N>(&(first + second)).into()
        })
    }

    /// Derivatives of `g` by the slopes.
    fn derivatives<N: Number>(&self, slopes: &Slopes<N>) -> Slopes<N> {
        let [a, b, t] = slopes;
        let [sin, cos] = self.turned.map(N::of);
        let [_, c] = products(slopes);
        let (square, length) = (t.norm_squared(), t.norm());
        let of_sine = [b.cross(t), t.cross(a), a.cross(b)];
        let of_cosine = [
            (b * square - t * b.dot(t)) / length,
            (a * square - t * a.dot(t)) / length,
            (t * (a.dot(b) * N::of(2.0)) - a * b.dot(t) - b * a.dot(t)) / length - t * (c / square),
        ];
        std::array::from_fn(|k| of_sine[k] * cos - of_cosine[k] * sin)
    }

    /// Forces of a unit multiplier on the ends of each slope.
    pub(super) fn gradients<const D: usize, N: Number>(
        &self,
        view: &View<'_, D, N>,
    ) -> impl Iterator<Item = Gradient<D, N>> {
        let derivatives = self.derivatives(&self.at(view.x));
        let pairs = (*self.slopes).into_iter().zip(derivatives);
        pairs.map(|(markers, derivative)| {
            let on = [Vector::zeros(), vector::<D, N>(derivative.into())];
            Gradient {
                ends: markers.map(|marker| (Attachment::Body(marker.lift()), on)),
            }
        })
    }

    /// Second derivatives of `g` by the slopes, by numbers that carry derivatives.
    fn second_derivatives(&self, slopes: &Slopes) -> [[Matrix3<f64>; 3]; 3] {
        let mut second = [[Matrix3::zeros(); 3]; 3];
        for (by, axis) in (0..3).flat_map(|by| (0..3).map(move |axis| (by, axis))) {
            let mut moved = slopes.map(|slope| slope.map(Jet::from_re));
            moved[by][axis].v1 = 1.0;
            for (of, derivative) in self.derivatives(&moved).iter().enumerate() {
                second[of][by].set_column(axis, &derivative.map(|part| part.v1));
            }
        }
        second
    }
}

/// `s` and `c`: sine and cosine of the angle times one factor.
fn products<N: Number>([a, b, t]: &Slopes<N>) -> [N; 2] {
    let cosine = a.dot(b) * t.norm_squared() - a.dot(t) * b.dot(t);
    [a.dot(&b.cross(t)), cosine / t.norm()]
}

impl<const D: usize> Equation<D> for Fold {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [s, c] = products(&self.at(view.x));
        let [sin, cos] = self.turned.map(N::of);
        s * cos - c * sin
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let two = N::of(2.0);
        let [[a, b, t], [p, q, r]] = [self.at(view.x), self.at(view.v)];
        let [sin, cos] = self.turned.map(N::of);
        let sine = (p.dot(&q.cross(&t)) + p.dot(&b.cross(&r)) + a.dot(&q.cross(&r))) * two;
        // Value, first and second derivative by time of a product of two vectors, of products of such, and of 1 / |t|.
        let dot = |[x, dx]: [&Vector3<N>; 2], [y, dy]: [&Vector3<N>; 2]| {
            [x.dot(y), x.dot(dy) + dx.dot(y), dx.dot(dy) * two]
        };
        let times = |x: [N; 3], y: [N; 3]| {
            let second = x[2] * y[0] + x[1] * y[1] * two + x[0] * y[2];
            [x[0] * y[0], x[1] * y[0] + x[0] * y[1], second]
        };
        let square = dot([&t, &r], [&t, &r]);
        let inverse = N::of(1.0) / t.norm();
        let (half, cube) = (N::of(-0.5) * inverse / square[0], square[1] / square[0]);
        let inverse = [
            inverse,
            half * square[1],
            half * (square[2] - N::of(1.5) * cube * square[1]),
        ];
        let whole = times(dot([&a, &p], [&b, &q]), square);
        let part = times(dot([&a, &p], [&t, &r]), dot([&b, &q], [&t, &r]));
        let difference = std::array::from_fn(|k| whole[k] - part[k]);
        sine * cos - times(difference, inverse)[2] * sin
    }

    fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
        let second = self.second_derivatives(&self.at(view.x));
        let of_markers: [_; 6] =
            std::array::from_fn(|k| self.slopes[k / 2][k % 2].jacobian::<D>(1));
        let terms: [_; 12] = std::array::from_fn(|k| (k / 4, of_markers[k / 2][k % 2]));
        for (k, (a, of_a)) in &terms {
            for (l, (b, of_b)) in &terms {
                // Each pair of nodes once; a node with itself in full.
                if a > b {
                    continue;
                }
                let by = nalgebra::SMatrix::from_fn(|r, c| lambda * second[*k][*l][(r, c)]);
                add(*a, *b, &block_of(of_a, of_b, &by));
            }
        }
    }

    fn is_stiff(&self) -> bool {
        true
    }

    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        1.0
    }

    fn is_angle(&self) -> bool {
        true
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        let markers = self.slopes.as_flattened().iter();
        markers.map(|marker| Attachment::Body(*marker)).collect()
    }
}

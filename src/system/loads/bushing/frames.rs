//! Translation along the three axes of the first end and rotation of the second end against it, in space. Rotations are measured by
//! their vector, `t` = angle along axis, which has the same components along the axes `A_i` of the first end and `B_j` of
//! the second. With `R_ij = A_i . B_j`: `t = h(z) a`, `a` the vector of the skew part of `R`, of size `sin(angle)`,
//! `z = (3 - tr R) / 4 = sin^2(angle / 2)`, `h = angle / sin(angle)`. The energy `sum k t^2 / 2` is a function of how the bodies
//! stand to each other, so that forces have a potential, and whatever moves both alike changes nothing: forces and moments on
//! both ends balance. Up to half a turn.
//!
//! Source: P. Masarati, M. Morandini, Intrinsic deformable joints, Multibody System Dynamics 23 (2010) 361-386.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::{Bushing, DeformationMeasure, SixComponents};
use crate::bodies::Node;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Translation;
use crate::system::direction::Direction;
use crate::system::end::{Attachment, bilinear};
use crate::system::gradient::Terms;
use crate::system::loads::{Add, Instant};

/// Where series take over from formulas that lose digits.
const SERIES: f64 = 0.1;
/// Terms of them, below roundoff there.
const COUNT: u32 = 18;
/// Least distance to half a turn.
const HALF_TURN: f64 = 1e-12;

/// Translation and rotation between the frames of two ends.
#[derive(Clone, Debug)]
pub struct BetweenFrames<const D: usize> {
    /// Ways along the axes of the first end.
    pub ways: [Translation<D>; 3],
    /// Ways without force, m.
    pub rest: [f64; 3],
    /// Axes of both ends, which are the same without moment.
    pub axes: [[Direction<D>; 3]; 2],
}

/// `h` and its first three derivatives by `z`, from `2 z (1 - z) h' + (1 - 2 z) h = 1` and its derivatives.
fn ratio(z: f64) -> [f64; 4] {
    if z < SERIES {
        let mut sums = [0.0; 4];
        let mut coefficient = 1.0;
        for n in 0..COUNT {
            let mut factor = coefficient;
            for (order, sum) in sums.iter_mut().enumerate() {
                if n as usize >= order {
                    *sum += factor * z.powi(n as i32 - order as i32);
                    factor *= f64::from(n) - order as f64;
                }
            }
            let next = f64::from(2 * (n + 1));
            coefficient *= next / (next + 1.0);
        }
        return sums;
    }
    let left = (1.0 - z).max(HALF_TURN);
    let (twice, slope) = (2.0 * z * left, 1.0 - 2.0 * z);
    let h = (z / left).sqrt().atan() / (z * left).sqrt();
    let first = (1.0 - slope * h) / twice;
    let second = (2.0 * h - 3.0 * slope * first) / twice;
    [
        h,
        first,
        second,
        (8.0 * first - 5.0 * slope * second) / twice,
    ]
}

/// How the second end has rotated against the first.
struct Turned<N: Number> {
    /// `a`.
    skew: Vector3<N>,
    /// `h` and its derivative.
    ratio: [N; 2],
}

/// The vector of the skew part of a matrix.
fn skew<N: Number>(r: &Matrix3<N>) -> Vector3<N> {
    let part = |i: usize, j: usize| (r[(j, i)] - r[(i, j)]) * N::of(0.5);
    Vector3::new(part(1, 2), part(2, 0), part(0, 1))
}

impl<N: Number> Turned<N> {
    fn new(products: &Matrix3<N>) -> Self {
        let z = (N::of(3.0) - products.trace()) * N::of(0.25);
        let of = |order: usize| {
            let derivatives = move |z: f64| {
                let [a, b, c, d] = ratio(z);
                if order == 0 { [a, b, c] } else { [b, c, d] }
            };
            z.map(move |z| ratio(z)[order], derivatives)
        };
        Self {
            skew: skew(products),
            ratio: [of(0), of(1)],
        }
    }

    /// The rotation vector.
    fn vector(&self) -> Vector3<N> {
        self.skew * self.ratio[0]
    }

    /// Returns the rate of the rotation vector at rates of the products.
    fn rate(&self, rates: &Matrix3<N>) -> Vector3<N> {
        let z_rate = rates.trace() * N::of(-0.25);
        skew(rates) * self.ratio[0] + self.skew * (self.ratio[1] * z_rate)
    }

    /// Derivatives by the products of the components along a vector.
    fn by_products(&self, along: &Vector3<N>) -> Matrix3<N> {
        let [h, first] = self.ratio;
        let shared = first * self.skew.dot(along) * N::of(-0.25);
        let mut by = along.cross_matrix() * (h * N::of(0.5));
        (0..3).for_each(|k| by[(k, k)] += shared);
        by
    }
}

impl<const D: usize> BetweenFrames<D> {
    fn products<N: Number>(&self, x: &[Node<D, N>]) -> Matrix3<N> {
        let [a, b] = self.axes.map(|axes| axes.map(|axis| axis.value(x)));
        Matrix3::from_fn(|i, j| a[i].dot(&b[j]))
    }

    fn product_rates<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> Matrix3<N> {
        let [a, b] = self.axes.map(|axes| axes.map(|axis| axis.value(x)));
        let [a_rate, b_rate] = self.axes.map(|axes| axes.map(|axis| axis.rate(v)));
        Matrix3::from_fn(|i, j| a_rate[i].dot(&b[j]) + a[i].dot(&b_rate[j]))
    }

    /// Calls with the axes of both ends and derivatives by them, of a function with these derivatives by the products.
    fn for_each_axis<N: Number>(
        &self,
        by: &Matrix3<N>,
        x: &[Node<D, N>],
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let [a, b] = self.axes.map(|axes| axes.map(|axis| axis.value(x)));
        let sum = |of: &[Vector<D, N>; 3], weight: &dyn Fn(usize) -> N| {
            (0..3).fold(Vector::zeros(), |sum: Vector<D, N>, k| {
                sum + of[k] * weight(k)
            })
        };
        for k in 0..3 {
            let on_first = sum(&b, &|j| by[(k, j)]);
            let on_second = sum(&a, &|i| by[(i, k)]);
            for (axis, on) in [(self.axes[0][k], on_first), (self.axes[1][k], on_second)] {
                call(&axis.end().lift(), [Vector::zeros(), on]);
            }
        }
    }
}

impl<const D: usize> DeformationMeasure<D> for BetweenFrames<D> {
    fn deformation<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        let ways = Vector3::from_fn(|k, _| self.ways[k].value(at.x) - N::of(self.rest[k]));
        let rates = Vector3::from_fn(|k, _| self.ways[k].gradient(at.x).along(at.v));
        let turned = Turned::new(&self.products(at.x));
        let turning = turned.rate(&self.product_rates(at.x, at.v));
        [[ways, turned.vector()], [rates, turning]]
    }

    fn act<N: Number>(
        &self,
        [force, moment]: SixComponents<N>,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        for (way, force) in self.ways.iter().zip(force.iter()) {
            for (end, on) in &way.gradient(at.x).scaled(*force).ends {
                call(end, *on);
            }
        }
        let by = Turned::new(&self.products(at.x)).by_products(&moment);
        self.for_each_axis(&by, at.x, call);
    }

    fn add_tangent(
        &self,
        of: &Bushing<D>,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        let [force, moment] = of.force(at);
        let products = self.products(at.x);
        let turned = Turned::new(&products);
        let terms = |by: &Matrix3<f64>| {
            let mut terms: Terms<D> = Terms::default();
            self.for_each_axis(by, at.x, |end, on| terms.add_end(end, on));
            terms
        };
        for (k, way) in self.ways.iter().enumerate() {
            let gradient = way.gradient(at.x);
            gradient.add_square(of.stiffness[0][k], &mut *stiffness);
            gradient.add_square(of.damping[0][k], &mut *damping);
            way.add_hessian(-force[k], &mut *stiffness);
            let of_turn = terms(&turned.by_products(&Vector3::ith(k, 1.0)));
            of_turn.add_square(of.stiffness[1][k], &mut *stiffness);
            of_turn.add_square(of.damping[1][k], &mut *damping);
        }
        // Second derivatives of h a: of the products, then h' (dz da + da dz) + h'' a dz dz.
        let by = turned.by_products(&-moment);
        for (i, first) in self.axes[0].iter().enumerate() {
            for (j, second) in self.axes[1].iter().enumerate() {
                if let (Direction::Of(first), Direction::Of(second)) = (first, second) {
                    let product = SMatrix::identity() * by[(i, j)];
                    bilinear([(first, 1), (second, 1)], product, &mut *stiffness);
                }
            }
        }
        let [_, once, twice, _] = ratio((3.0 - products.trace()) * 0.25);
        let (by_z, by_a) = (Matrix3::identity() * -0.25, moment.cross_matrix() * -0.5);
        terms(&(by_z + by_a)).add_square(0.5 * once, &mut *stiffness);
        terms(&(by_z - by_a)).add_square(-0.5 * once, &mut *stiffness);
        let bent = -turned.skew.dot(&moment) * twice;
        terms(&by_z).add_square(bent, stiffness);
    }

    /// The axes belong to the same bodies.
    fn ends(&self) -> Vec<Attachment<D>> {
        self.ways[0].ends.to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::ratio;

    /// `h = angle / sin(angle)` by `z = sin^2(angle / 2)`, at both sides of the end of the series and beyond.
    #[test]
    fn the_ratio_and_its_derivatives_are_those_of_angle_and_sine() {
        for angle in [1e-9, 0.02, 0.3, 0.64, 0.65, 1.5, 2.8] {
            let z_of = |angle: f64| (0.5 * angle).sin().powi(2);
            let found = ratio(z_of(angle));
            assert!(
                (found[0] - angle / f64::sin(angle)).abs() < 1e-14 * found[0],
                "{angle}"
            );
            let step = 1e-4 * (1.0 - z_of(angle)).min(z_of(angle) + 0.1);
            let z = z_of(angle).max(step);
            let ([before, at, after], order) = ([z - step, z, z + step].map(ratio), 3);
            for k in 0..order {
                let slope = (after[k] - before[k]) / (2.0 * step);
                let miss = (slope - at[k + 1]).abs() / at[k + 1].abs();
                assert!(miss < 1e-5, "{angle}, derivative {k}: {miss:e}");
            }
        }
    }
}

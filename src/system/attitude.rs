//! Orientations that inputs drive: a quaternion, then an angular velocity and an angular acceleration as far as given, in
//! global axes. The course through a communication step is a polynomial of each of the four numbers, as those of other
//! driven coordinates are; the orientation is that of the quaternion, whatever its length on the way.
//!
//! With an angular velocity `w` quaternions change by `q' = w q / 2`. Where `w` changes steadily, by `w'`, the rotation after `h` is
//! that by the vector `h w + h^2 w' / 2 + h^3 (w' x w) / 12`, but for terms of order 4.
//!
//! Source: M. D. Shuster, A survey of attitude representations, J. Astronautical Sciences 41 (1993) 439-517 (rates of
//! quaternions); A. Iserles, S. P. Norsett, On the solution of linear differential equations in Lie groups, Phil. Trans. R. Soc.
//! A 357 (1999) 983-1019 (first two terms of the Magnus series).

use nalgebra::Vector3;

use super::signal::moved;
use crate::math::rotation::{Quaternion, inverse, normalized, product, turn_by};

/// Where the numbers of an orientation are among the inputs: four of the quaternion, scalar first, of any length and
/// either sign, then three for every derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attitude {
    /// Index of the first number.
    pub first: usize,
    /// Derivatives that are inputs too: 0, 1 (angular velocity, rad/s) or 2 (angular acceleration, rad/s^2).
    pub derivatives: usize,
}

impl Attitude {
    /// How many numbers there are: 4, 7 or 10.
    pub fn count(&self) -> usize {
        4 + 3 * self.derivatives
    }

    fn quaternion(&self, input: impl Fn(usize) -> f64) -> Quaternion {
        std::array::from_fn(|k| input(self.first + k))
    }

    /// The angular velocity (1) or acceleration (2); zero where it is not given.
    fn vector(&self, order: usize, input: impl Fn(usize) -> f64) -> Vector3<f64> {
        if order <= self.derivatives {
            Vector3::from_fn(|k, _| input(self.first + 1 + 3 * order + k))
        } else {
            Vector3::zeros()
        }
    }

    /// The quaternion that inputs give, of unit length, with two derivatives.
    pub fn start(&self, inputs: &[f64]) -> [Quaternion; 3] {
        let input = |i: usize| inputs[i];
        let q = normalized(self.quaternion(input));
        let [w, second] = [1, 2].map(|order| self.vector(order, input));
        orders(q, w, second)
    }

    /// Second derivative of a quaternion at its first and at the angular acceleration that inputs give; the one that it has
    /// where they give none.
    pub fn second(
        &self,
        [q, rate, second]: [Quaternion; 3],
        input: impl Fn(usize) -> f64,
    ) -> Quaternion {
        match self.derivatives {
            2 => {
                let given = self.vector(2, input);
                orders(q, velocity(&q, &rate), given)[2]
            }
            _ => second,
        }
    }

    /// How that changes along a direction of the inputs.
    pub fn second_along(&self, q: &Quaternion, direction: &[f64]) -> Quaternion {
        changed(self.vector(2, |i| direction[i]), q)
    }

    /// Third and fourth derivative of a quaternion where the angular acceleration that inputs give has these derivatives;
    /// nothing where they give none.
    pub fn higher(
        &self,
        [q, rate, _]: [Quaternion; 3],
        inputs: &[f64],
        slope: impl Fn(usize) -> [f64; 2],
    ) -> Option<[Quaternion; 2]> {
        if self.derivatives < 2 {
            return None;
        }
        let w = velocity(&q, &rate);
        let turning = self.vector(2, |i| inputs[i]);
        let [_, _, second] = orders(q, w, turning);
        let [jerk, snap] = [0, 1].map(|k| self.vector(2, |i| slope(i)[k]));
        let third = total(&[
            (1.0, changed(jerk, &q)),
            (2.0, changed(turning, &rate)),
            (1.0, changed(w, &second)),
        ]);
        let fourth = total(&[
            (1.0, changed(snap, &q)),
            (3.0, changed(jerk, &rate)),
            (3.0, changed(turning, &second)),
            (1.0, changed(w, &third)),
        ]);
        Some([third, fourth])
    }

    /// The quaternion with two derivatives after `h` of what stands at `from` and follows inputs, each told with two
    /// derivatives: as of other driven coordinates, a derivative that is an input carries on what is below it, unless that moves
    /// by itself. What is given is taken on the side of `from`.
    pub fn destination(
        &self,
        h: f64,
        from: &Quaternion,
        input: impl Fn(usize) -> [f64; 3],
    ) -> [Quaternion; 3] {
        let part = |k: usize| self.quaternion(|i| input(i)[k]);
        let moves = |first: usize, count: usize| {
            (first..first + count).any(|i| input(i)[1..].iter().any(|slope| *slope != 0.0))
        };
        let near = |q: Quaternion| {
            let along: f64 = q.iter().zip(from).map(|(a, b)| a * b).sum();
            q.map(|part| if along < 0.0 { -part } else { part })
        };
        let at_end = self.quaternion(|i| moved(input(i), h)[0]);
        let (is_carried, given) = (!moves(self.first, 4), normalized(part(0)));
        if self.derivatives == 0 {
            let target = near(normalized(at_end));
            let rate = if is_carried {
                total(&[(1.0 / h, target), (-1.0 / h, *from)])
            } else {
                let rate = self.quaternion(|i| moved(input(i), h)[1]);
                changed(velocity(&at_end, &rate), &target)
            };
            return [target, rate, [0.0; 4]];
        }
        let [w, way] = self.turn(h, &input, moves(self.first + 4, 3));
        let target = if is_carried {
            product(&turn_by(&way), &near(given))
        } else {
            near(normalized(at_end))
        };
        orders(target, w, self.vector(2, |i| moved(input(i), h)[0]))
    }

    /// The angular velocity after `h`, and the vector of the rotation until then.
    fn turn(
        &self,
        h: f64,
        input: impl Fn(usize) -> [f64; 3],
        is_moving: bool,
    ) -> [Vector3<f64>; 2] {
        // The angular velocity with three derivatives.
        let of = |order: usize, k: usize| self.vector(order, |i| input(i)[k]);
        let [w, a, b, c] = if is_moving {
            [of(1, 0), of(1, 1), of(1, 2), Vector3::zeros()]
        } else {
            [of(1, 0), of(2, 0), of(2, 1), of(2, 2)]
        };
        let after = w + (a + (b / 2.0 + c * (h / 6.0)) * h) * h;
        let way = (w + (a / 2.0 + (b / 6.0 + c * (h / 24.0)) * h) * h) * h;
        [after, way + a.cross(&w) * (h * h * h / 12.0)]
    }
}

/// Rate of a quaternion at an angular velocity: `w q / 2`.
fn changed(w: Vector3<f64>, q: &Quaternion) -> Quaternion {
    product(&[0.0, 0.5 * w.x, 0.5 * w.y, 0.5 * w.z], q)
}

/// The angular velocity of a quaternion of any length at its rate.
fn velocity(q: &Quaternion, rate: &Quaternion) -> Vector3<f64> {
    let square: f64 = q.iter().map(|part| part * part).sum();
    let [_, x, y, z] = product(rate, &inverse(*q));
    Vector3::new(x, y, z) * (2.0 / square)
}

/// A quaternion with its derivatives at an angular velocity and acceleration.
fn orders(q: Quaternion, w: Vector3<f64>, second: Vector3<f64>) -> [Quaternion; 3] {
    let rate = changed(w, &q);
    let bend = total(&[(1.0, changed(second, &q)), (1.0, changed(w, &rate))]);
    [q, rate, bend]
}

fn total(terms: &[(f64, Quaternion)]) -> Quaternion {
    std::array::from_fn(|k| terms.iter().map(|(factor, q)| factor * q[k]).sum())
}

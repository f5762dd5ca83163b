//! Explicit methods for `q'' = a(t, q)`, where accelerations read no rates: the last stage is the end of
//! the step and the first of the next, so that a step costs one evaluation less than it has stages.
//!
//! Source: L. Verlet, Phys. Rev. 159 (1967) in its velocity form, as a Nystrom method (E. Hairer, C.
//! Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., Eq. I.1.17); J. R. Dormand, M. E. A.
//! El-Mikkawy, P. J. Prince, Families of Runge-Kutta-Nystrom formulae, IMA J. Numer. Anal. 7 (1987)
//! 235-250: RKN4(3)4FM (Table 3).

use super::{Attempt, Method, Tolerance, rescaled};
use crate::math::sums::{TERMS, Term, add, sum};
use crate::system::{DenseStep, Dynamics};

/// Part of the stability limit that is used: the bound on the frequency is that of the reference
/// configuration.
const MARGIN: f64 = 0.9;

/// Coefficients of a method.
#[derive(Debug, PartialEq)]
pub struct Tableau {
    /// Name of the method.
    pub name: &'static str,
    /// Stability limit: longest step times frequency.
    pub limit: f64,
    /// Times of the stages.
    pub c: &'static [f64],
    /// Weights of accelerations in the positions of the stages; the last is the end of the step.
    pub a: &'static [&'static [f64]],
    /// Weights in the velocity at the end.
    pub rates: &'static [f64],
    /// Weights in the errors of position and velocity: method less embedded method.
    pub error: [&'static [f64]; 2],
    /// Power of the step in the error estimate.
    pub power: f64,
}

/// Velocity Verlet: order 2, one evaluation a step, conserves energy on average at steps of equal
/// length. Its error estimate is its leading error in position, `h^2 (a1 - a0) / 6`, and as much over the
/// step in velocity: of the order of the error that remains at the end.
pub static VERLET: Tableau = Tableau {
    name: "verlet",
    limit: 2.0,
    c: &[0.0, 1.0],
    a: &[&[], &[0.5]],
    rates: &[0.5, 0.5],
    error: [&[-1.0 / 6.0, 1.0 / 6.0], &[-1.0 / 6.0, 1.0 / 6.0]],
    power: 2.0,
};

/// Order 4 with 3, three evaluations a step.
pub static RKN43: Tableau = Tableau {
    name: "rkn43",
    limit: 3.767,
    c: &[0.0, 0.25, 0.7, 1.0],
    a: &[
        &[],
        &[1.0 / 32.0],
        &[7.0 / 1_000.0, 119.0 / 500.0],
        &[1.0 / 14.0, 8.0 / 27.0, 25.0 / 189.0],
    ],
    rates: &[1.0 / 14.0, 32.0 / 81.0, 250.0 / 567.0, 5.0 / 54.0],
    error: [
        &[
            1.0 / 14.0 + 7.0 / 150.0,
            8.0 / 27.0 - 67.0 / 150.0,
            25.0 / 189.0 - 3.0 / 20.0,
            1.0 / 20.0,
        ],
        &[
            1.0 / 14.0 - 13.0 / 21.0,
            32.0 / 81.0 + 20.0 / 27.0,
            250.0 / 567.0 - 275.0 / 189.0,
            5.0 / 54.0 + 1.0 / 3.0,
        ],
    ],
    power: 4.0,
};

/// A Nystrom method with its scratch.
#[derive(Clone, Debug)]
pub struct Nystrom {
    tableau: &'static Tableau,
    longest_step: f64,
    /// Accelerations of the stages.
    a: Vec<Vec<f64>>,
    q: Vec<f64>,
    v: Vec<f64>,
    error_q: Vec<f64>,
    error_v: Vec<f64>,
}

impl Nystrom {
    /// For `n` coordinates whose fastest oscillation is `frequency` (rad/s).
    pub fn new(tableau: &'static Tableau, n: usize, frequency: f64) -> Self {
        let zero = vec![0.0; n];
        Self {
            longest_step: MARGIN * tableau.limit / frequency,
            a: vec![zero.clone(); tableau.c.len()],
            tableau,
            q: zero.clone(),
            v: zero.clone(),
            error_q: zero.clone(),
            error_v: zero,
        }
    }
}

/// `out = start + factor * sum of the weighted vectors`, with at most as many vectors at the start as a sum takes.
fn set(out: &mut [f64], start: &[Term<'_>], factor: f64, (weights, a): (&[f64], &[Vec<f64>])) {
    let (mut terms, mut count) = ([(0.0, &a[0][..]); TERMS], start.len());
    terms[..count].copy_from_slice(start);
    let mut write: fn(&mut [f64], &[Term<'_>]) = sum;
    for (weight, a) in weights.iter().zip(a) {
        if count == TERMS {
            write(out, &terms);
            (write, count) = (add, 0);
        }
        terms[count] = (factor * weight, a);
        count += 1;
    }
    write(out, &terms[..count]);
}

impl Method for Nystrom {
    fn name(&self) -> &'static str {
        self.tableau.name
    }

    fn longest_step(&self) -> f64 {
        self.longest_step
    }

    fn fewest_operations(&self) -> f64 {
        (self.tableau.c.len() - 1) as f64
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a[0]);
    }

    fn error(
        &mut self,
        _: &mut dyn Dynamics,
        _: (f64, &[f64], &[f64]),
        _: Option<&DenseStep>,
        [position, velocity]: [&mut [f64]; 2],
    ) {
        position.copy_from_slice(&self.error_q);
        velocity.copy_from_slice(&self.error_v);
    }

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        (time, q, v): (f64, &[f64], &[f64]),
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        let tableau = self.tableau;
        for (stage, c) in tableau.c.iter().enumerate().skip(1) {
            let start = [(1.0, q), (c * h, v)];
            set(&mut self.q, &start, h * h, (tableau.a[stage], &self.a));
            dynamics.acceleration(time + c * h, &self.q, v, &mut self.a[stage]);
        }
        set(&mut self.v, &[(1.0, v)], h, (tableau.rates, &self.a));
        let [position, velocity] = tableau.error;
        set(&mut self.error_q, &[], h * h, (position, &self.a));
        set(&mut self.error_v, &[], h, (velocity, &self.a));
        Attempt::Done(rescaled(
            tolerance.norm(&self.error_q, &self.error_v) * dynamics.steps_in(tolerance.time, h),
            tableau.power,
        ))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        let last = self.a.len() - 1;
        self.a.swap(0, last);
    }

    fn acceleration(&self) -> &[f64] {
        &self.a[0]
    }
}

//! Embedded Nystrom pairs for `q'' = a(t, q)`; the last stage is the first of the next step.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, Families of Runge-Kutta-Nystrom formulae, IMA J.
//! Numer. Anal. 7 (1987) 235-250: RKN4(3)4FM (Table 3) and RKN6(4)6FM (Table 5).

use flexbody::integrators::{Attempt, Method, Tolerance};
use flexbody::system::Dynamics;

use super::rescaled;

/// Coefficients. Positions are weighted as the last stage is.
pub struct Tableau {
    name: &'static str,
    c: &'static [f64],
    a: &'static [&'static [f64]],
    /// Weights of velocities.
    rates: &'static [f64],
    /// Weights of the embedded formula for positions and velocities.
    embedded: [&'static [f64]; 2],
    /// Power of the step in the error estimate.
    power: f64,
}

/// Order 4 with 3, three evaluations a step.
pub const RKN43: Tableau = Tableau {
    name: "rkn43",
    c: &[0.0, 0.25, 0.7, 1.0],
    a: &[
        &[],
        &[1.0 / 32.0],
        &[7.0 / 1_000.0, 119.0 / 500.0],
        &[1.0 / 14.0, 8.0 / 27.0, 25.0 / 189.0],
    ],
    rates: &[1.0 / 14.0, 32.0 / 81.0, 250.0 / 567.0, 5.0 / 54.0],
    embedded: [
        &[-7.0 / 150.0, 67.0 / 150.0, 3.0 / 20.0, -1.0 / 20.0],
        &[13.0 / 21.0, -20.0 / 27.0, 275.0 / 189.0, -1.0 / 3.0],
    ],
    power: 4.0,
};

/// Order 6 with 4, five evaluations a step.
pub const RKN64: Tableau = Tableau {
    name: "rkn64",
    c: &[0.0, 0.1, 0.3, 0.7, 17.0 / 25.0, 1.0],
    a: &[
        &[],
        &[1.0 / 200.0],
        &[-1.0 / 2_200.0, 1.0 / 22.0],
        &[637.0 / 6_600.0, -7.0 / 110.0, 7.0 / 33.0],
        &[
            225_437.0 / 1_968_750.0,
            -30_073.0 / 281_250.0,
            65_569.0 / 281_250.0,
            -9_367.0 / 984_375.0,
        ],
        &[
            151.0 / 2_142.0,
            5.0 / 116.0,
            385.0 / 1_368.0,
            55.0 / 168.0,
            -6_250.0 / 28_101.0,
        ],
    ],
    rates: &[
        151.0 / 2_142.0,
        25.0 / 522.0,
        275.0 / 684.0,
        275.0 / 252.0,
        -78_125.0 / 112_404.0,
        1.0 / 12.0,
    ],
    embedded: [
        &[
            1_349.0 / 157_500.0,
            7_873.0 / 50_000.0,
            192_199.0 / 900_000.0,
            521_683.0 / 2_100_000.0,
            -16.0 / 125.0,
            0.0,
        ],
        &[
            1_349.0 / 157_500.0,
            7_873.0 / 45_000.0,
            27_457.0 / 90_000.0,
            521_683.0 / 630_000.0,
            -2.0 / 5.0,
            1.0 / 12.0,
        ],
    ],
    power: 5.0,
};

/// Scratch of a pair.
pub struct Nystrom {
    tableau: &'static Tableau,
    a: Vec<Vec<f64>>,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Nystrom {
    /// A pair for `n` coordinates.
    pub fn new(tableau: &'static Tableau, n: usize) -> Self {
        Self {
            a: vec![vec![0.0; n]; tableau.c.len()],
            tableau,
            q: vec![0.0; n],
            v: vec![0.0; n],
        }
    }

    fn sum(&self, weights: &[f64], i: usize) -> f64 {
        weights.iter().zip(&self.a).map(|(w, a)| w * a[i]).sum()
    }
}

impl Method for Nystrom {
    fn name(&self) -> &'static str {
        self.tableau.name
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.refresh(dynamics, time, q, v);
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a[0]);
    }

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        (time, q, v): (f64, &[f64], &[f64]),
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        let tableau = self.tableau;
        let last = tableau.c.len() - 1;
        for (stage, c) in tableau.c.iter().enumerate().skip(1) {
            for i in 0..q.len() {
                self.q[i] = q[i] + h * (c * v[i] + h * self.sum(tableau.a[stage], i));
            }
            dynamics.acceleration(time + c * h, &self.q, v, &mut self.a[stage]);
        }
        let (mut p, mut u) = (0.0, 0.0);
        for i in 0..q.len() {
            let rate = self.sum(tableau.rates, i);
            self.v[i] = v[i] + h * rate;
            let [position, velocity] = tableau.embedded.map(|weights| self.sum(weights, i));
            p += (h * h * (self.sum(tableau.a[last], i) - position)).powi(2);
            u += (h * (rate - velocity)).powi(2);
        }
        let error = tolerance.norm(&[p.sqrt()], &[u.sqrt()]);
        Attempt::Done(rescaled(error, tableau.power))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        let last = self.a.len() - 1;
        self.a.swap(0, last);
    }

    fn work(&self) -> [f64; 2] {
        [0.0; 2]
    }

    fn acceleration(&self) -> &[f64] {
        &self.a[0]
    }

    fn newton_iterations(&self) -> u64 {
        0
    }
}

//! Symplectic splitting of order 4 for `q'' = a(t, q)`: six evaluations a step, kicks and drifts in turn.
//!
//! Source: S. Blanes, P. C. Moan, Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom
//! methods, J. Comput. Appl. Math. 142 (2002) 313-330, Table 3: SRKN, order 4, six stages, kick first.

use flexbody::integrators::{Attempt, Method, Tolerance};
use flexbody::system::Dynamics;

const A: [f64; 3] = {
    let (a, b) = (0.245_298_957_184_271, 0.604_872_665_711_080);
    [a, b, 0.5 - a - b]
};
const B: [f64; 4] = {
    let a = 0.082_984_406_417_405_2;
    let (b, c) = (0.396_309_801_498_368, -0.039_056_304_922_348_6);
    [a, b, c, 1.0 - 2.0 * (a + b + c)]
};
const DRIFTS: [f64; 6] = [A[0], A[1], A[2], A[2], A[1], A[0]];
const KICKS: [f64; 7] = [B[0], B[1], B[2], B[3], B[2], B[1], B[0]];

/// Scratch of the method.
pub struct Splitting {
    a: Vec<f64>,
    end: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Splitting {
    /// For `n` coordinates.
    pub fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        Self {
            a: zero.clone(),
            end: zero.clone(),
            q: zero.clone(),
            v: zero,
        }
    }
}

impl Method for Splitting {
    fn name(&self) -> &'static str {
        "srkn4"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.refresh(dynamics, time, q, v);
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
    }

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        (time, q, v): (f64, &[f64], &[f64]),
        h: f64,
        _: &Tolerance,
    ) -> Attempt {
        self.q.copy_from_slice(q);
        for i in 0..q.len() {
            self.v[i] = v[i] + KICKS[0] * h * self.a[i];
        }
        let mut way = 0.0;
        for (drift, kick) in DRIFTS.iter().zip(&KICKS[1..]) {
            way += drift * h;
            for i in 0..q.len() {
                self.q[i] += drift * h * self.v[i];
            }
            dynamics.acceleration(time + way, &self.q, &self.v, &mut self.end);
            for i in 0..q.len() {
                self.v[i] += kick * h * self.end[i];
            }
        }
        // There is no estimate: fixed steps only.
        Attempt::Done(1.0)
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        std::mem::swap(&mut self.a, &mut self.end);
    }

    fn work(&self) -> [f64; 2] {
        [0.0; 2]
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }

    fn newton_iterations(&self) -> u64 {
        0
    }
}

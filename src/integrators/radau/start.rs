//! Where Newton's iteration on the stages starts.
//!
//! A state may hold a rate or an acceleration of a stiff direction that the method damps, or that Newton's iteration or the way
//! back to the constraints left there. Followed over a step of many periods of it they lead far out of the region in
//! which the iteration converges: a twist of `1e-11` rad in a shaft whose torsional waves take `1e-6` s becomes whole turns
//! over `0.05` s. Where an iteration that started by the acceleration has failed, the next one starts without them, if they
//! hold most of the acceleration. With `s` the real eigenvalue of the
//! method over the step, `s^2 (s^2 I + s R + K)^-1` leaves slow directions as they are and takes stiff ones out.
//!
//! Source: as for the method; starting values are section IV.8 of Hairer and Wanner.

use super::{C, GAMMA, Radau, dense, product, size};
use crate::system::Dynamics;

/// Acceleration, over that of slow directions, from which on stiff directions hold most of it. Below, they hold what is balanced
/// there, as the centripetal part of what rotates.
const DOMINANT: f64 = 2.0;

impl Radau {
    /// Starting values of the stages: the last step's polynomial, or constant acceleration; after iterations that failed, in
    /// the directions that are slow over the step alone.
    pub(super) fn start(&mut self, dynamics: &mut dyn Dynamics, v: &[f64], h: f64) {
        match self.last {
            None if self.is_slow => {
                self.error_q.copy_from_slice(&self.a);
                self.error_v.copy_from_slice(v);
                let s = GAMMA / h;
                for slow in [&mut self.error_q, &mut self.error_v] {
                    dynamics.solve(slow);
                    slow.iter_mut().for_each(|slow| *slow *= s * s);
                }
                let (v, a) = if size(&self.a) > DOMINANT * size(&self.error_q) {
                    (&self.error_v[..], &self.error_q)
                } else {
                    (v, &self.a)
                };
                for (stage, c) in self.zq.iter_mut().zip(C) {
                    follow(c * h, v, a, stage);
                }
            }
            Some(last) => self.go_on(h, last),
            None => {
                for (stage, c) in self.zq.iter_mut().zip(C) {
                    follow(c * h, v, &self.a, stage);
                }
            }
        }
        self.velocities(v, h);
    }

    /// The polynomial of a step of length `last` that went before.
    fn go_on(&mut self, h: f64, last: f64) {
        let weights = C.map(|c| dense::values(1.0 + c * h / last));
        for i in 0..self.a.len() {
            let z = [self.zq[0][i], self.zq[1][i], self.zq[2][i]];
            for (stage, weights) in self.zq.iter_mut().zip(&weights) {
                stage[i] = product(weights, &z) - z[2];
            }
        }
    }
}

/// The way in a time at a rate and a constant acceleration.
fn follow(t: f64, v: &[f64], a: &[f64], way: &mut [f64]) {
    for (way, (v, a)) in way.iter_mut().zip(v.iter().zip(a)) {
        *way = t * (v + 0.5 * t * a);
    }
}

//! What a step leaves in stiff directions, where forces are read: taken out of a state, or told of.
//! docs/decisions/0022.

use super::super::{Tolerance, size};
use super::{A_INVERSE, GAMMA, Radau, product};
use crate::system::Dynamics;

/// Part of the acceleration, in tolerances, that may be left unsolved in a state that is read.
const UNSOLVED: f64 = 10.0;

impl Radau {
    /// Acceleration at the end of the step less that of the stage equations' solution there, but for what
    /// constraints hold, into `f[0]`: what Newton's iteration and the way back to the constraints left in stiff
    /// directions. Its size, and that of the solution.
    fn left(&mut self, dynamics: &mut dyn Dynamics) -> (f64, f64) {
        let [_, _, last] = A_INVERSE;
        let mut solved = 0.0;
        for i in 0..self.a.len() {
            let z = [self.zv[0][i], self.zv[1][i], self.zv[2][i]];
            let acceleration = product(&last, &z) / self.attempted;
            self.f[0][i] = self.a[i] - acceleration;
            solved += acceleration * acceleration;
        }
        dynamics.take_out_normal(&mut self.f[0]);
        (size(&self.f[0]), solved.sqrt())
    }

    /// Takes that out of a state that is read, where it is too much.
    pub(super) fn let_rest(
        &mut self,
        dynamics: &mut dyn Dynamics,
        (time, q, v): (f64, &mut [f64], &mut [f64]),
        tolerance: &Tolerance,
    ) -> bool {
        let (left, solved) = self.left(dynamics);
        let natural = tolerance.position / (tolerance.time * tolerance.time);
        let goal = UNSOLVED * tolerance.relative * (solved + natural);
        if left.is_nan() || left <= goal {
            return false;
        }
        let s = GAMMA / self.attempted;
        dynamics.linearize(time, q, v);
        self.tangent = false;
        if !dynamics.factor(s) {
            return false;
        }
        dynamics.solve(&mut self.f[0]);
        for (i, d) in self.f[0].iter().enumerate() {
            q[i] += d;
            v[i] += s * d;
        }
        dynamics.acceleration(time, q, v, &mut self.a);
        true
    }

    /// Error that the last step is estimated to have left in a state.
    pub(super) fn error_left(
        &mut self,
        dynamics: &mut dyn Dynamics,
        (time, q, v): (f64, &[f64], &[f64]),
        [position, velocity]: [&mut [f64]; 2],
    ) {
        let s = GAMMA / self.attempted;
        dynamics.linearize(time, q, v);
        if !dynamics.factor(s) {
            position.fill(0.0);
            velocity.fill(0.0);
            return;
        }
        dynamics.acceleration(time, q, v, &mut self.a);
        self.left(dynamics);
        dynamics.solve(&mut self.f[0]);
        // Filtered twice more: stiff directions follow the others, whatever was started with.
        position.copy_from_slice(&self.error_q);
        velocity.copy_from_slice(&self.error_v);
        for error in [&mut *position, &mut *velocity] {
            for _ in 0..2 {
                dynamics.solve(error);
                error.iter_mut().for_each(|e| *e *= s * s);
            }
        }
        for (i, d) in self.f[0].iter().enumerate() {
            position[i] += d;
            velocity[i] += s * d;
        }
    }
}

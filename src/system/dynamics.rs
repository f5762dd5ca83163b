//! What integrators and static equilibrium see of a system: `q'' = a(q, q')` with identity inertia,
//! and solves with its tangent. They know neither bodies nor joints nor loads.

use nalgebra::Complex;

use super::{State, System, Work};
use crate::body::Scratch;
use crate::elements::Element;

/// A second-order system with identity inertia, `q'' = a(q, q')`, with `K = -da/dq` and
/// `R = -da/dq'`.
pub trait Dynamics {
    /// Acceleration `a(q, v)`.
    fn acceleration(&mut self, q: &[f64], v: &[f64], a: &mut [f64]);
    /// Computes `K` and `R` at a state, for the calls below.
    fn linearize(&mut self, q: &[f64], v: &[f64]);
    /// Factors `s^2 I + s R + K` for a real `s`; false when it is not positive definite.
    fn factor(&mut self, s: f64) -> bool;
    /// Factors `s^2 I + s R + K` for a complex `s`; false when it is singular.
    fn factor_complex(&mut self, s: Complex<f64>) -> bool;
    /// Solves in place with the real factors.
    fn solve(&mut self, x: &mut [f64]);
    /// Remembers the configuration of the last acceleration as that of one of three stages.
    fn set_stage(&mut self, stage: usize);
    /// Solves for three stages in place: `forward` takes the right-hand sides to one for the real
    /// factors and two for the complex ones, `back` takes the solutions to the stages. The tangent may
    /// be turned along to the configurations set before, so the result is exact only to first order in
    /// the way from the linearization.
    fn solve_stages(
        &mut self,
        forward: &[[f64; 3]; 3],
        back: &[[f64; 3]; 3],
        stages: &mut [Vec<f64>; 3],
    );
    /// `R x`, in place.
    fn apply_damping(&mut self, x: &mut [f64]);
    /// Largest rotation of any slope, rad, and change of any stretch between two configurations.
    fn largest_turn(&mut self, from: &[f64], to: &[f64]) -> f64;
    /// Told of every accepted step: counts the turns of angles.
    fn accepted(&mut self, state: &mut State);
}

/// A system under held inputs.
#[derive(Debug)]
pub struct Model<'a> {
    /// The system.
    pub system: &'a System,
    /// Components of its inputs.
    pub inputs: &'a [f64],
    /// Fraction of gravity that acts: 1 but for load steps.
    pub gravity: f64,
    /// Scratch of the system.
    pub work: &'a mut Work,
}

impl<'a> Model<'a> {
    /// The system under these inputs and its whole gravity.
    pub fn new(system: &'a System, inputs: &'a [f64], work: &'a mut Work) -> Self {
        Self {
            system,
            inputs,
            gravity: 1.0,
            work,
        }
    }

    fn place(&mut self, q: &[f64], v: &[f64]) {
        let Scratch {
            e, rate, border, ..
        } = &mut self.work.scratch;
        self.system.body.positions(q, border, e);
        // Only damping reads rates.
        if self.system.body.is_damped() {
            self.system.body.rates(v, border, rate);
        }
    }

    /// Potential at `to` less that at `from` (strain energy, gravity, dead loads), J, and the size of
    /// the terms it is summed from.
    pub fn potential_difference(&mut self, from: &[f64], to: &[f64]) -> (f64, f64) {
        let body = &self.system.body;
        let Scratch {
            e,
            rate: before,
            border,
            ..
        } = &mut self.work.scratch;
        body.positions(from, border, before);
        body.positions(to, border, e);
        let (mut sum, mut size) = (0.0, 0.0);
        // Differences element by element: the sums of both energies would cancel.
        for (i, element) in body.elements().iter().enumerate() {
            let (now, then) = (element.energy(&e[i]), element.energy(&before[i]));
            let fall = self.gravity * self.system.weight[i].dot(&(e[i] - before[i]));
            sum += now - then - fall;
            size += now + then + fall.abs();
        }
        let mut first = 0;
        for load in &self.system.loads {
            let work = load.work(&self.inputs[first..], before, e);
            sum -= work;
            size += work.abs();
            first += load.components();
        }
        before.fill(nalgebra::zero());
        (sum, size)
    }
}

impl Dynamics for Model<'_> {
    fn acceleration(&mut self, q: &[f64], v: &[f64], a: &mut [f64]) {
        self.place(q, v);
        self.system.forces(self.inputs, self.gravity, self.work);
        let Scratch { force, border, .. } = &mut self.work.scratch;
        self.system.body.reduce(force, border, a);
    }

    fn linearize(&mut self, q: &[f64], v: &[f64]) {
        self.place(q, v);
        let Scratch { e, rate, .. } = &self.work.scratch;
        self.system.body.assemble(e, rate, &mut self.work.tangent);
        self.system.load_stiffness(self.inputs, self.work);
    }

    fn factor(&mut self, s: f64) -> bool {
        self.system.body.factor(s, &mut self.work.tangent)
    }

    fn factor_complex(&mut self, s: Complex<f64>) -> bool {
        self.system.body.factor_complex(s, &mut self.work.tangent)
    }

    fn solve(&mut self, x: &mut [f64]) {
        let Work {
            scratch, tangent, ..
        } = self.work;
        self.system
            .body
            .solve(tangent, &mut scratch.e, &mut scratch.border, x);
    }

    fn set_stage(&mut self, stage: usize) {
        let Work {
            scratch, tangent, ..
        } = self.work;
        self.system.body.set_stage(stage, &scratch.e, tangent);
    }

    fn solve_stages(
        &mut self,
        forward: &[[f64; 3]; 3],
        back: &[[f64; 3]; 3],
        stages: &mut [Vec<f64>; 3],
    ) {
        let Work {
            scratch, tangent, ..
        } = self.work;
        let space = (&mut scratch.e[..], &mut scratch.border[..]);
        self.system
            .body
            .solve_stages(tangent, space, (forward, back), stages);
    }

    fn apply_damping(&mut self, x: &mut [f64]) {
        let Work {
            scratch, tangent, ..
        } = self.work;
        self.system
            .body
            .apply_damping(tangent, &mut scratch.e, &mut scratch.border, x);
    }

    fn largest_turn(&mut self, from: &[f64], to: &[f64]) -> f64 {
        let body = &self.system.body;
        let Scratch {
            e,
            force: before,
            border,
            ..
        } = &mut self.work.scratch;
        body.positions(from, border, before);
        body.positions(to, border, e);
        let mut largest = 0.0_f64;
        for (b, a) in before.iter().zip(e.iter()) {
            for column in [1, 3] {
                let (u, v) = (b.fixed_columns::<1>(column), a.fixed_columns::<1>(column));
                let turn = u.perp(&v).atan2(u.dot(&v)).abs();
                largest = largest.max(turn).max((v.norm() / u.norm()).ln().abs());
            }
        }
        largest
    }

    fn accepted(&mut self, state: &mut State) {
        if state.angles.is_empty() {
            return;
        }
        let Scratch { e, border, .. } = &mut self.work.scratch;
        self.system.body.positions(&state.coordinates, border, e);
        for (angle, marker) in state.angles.iter_mut().zip(&self.system.angles) {
            let u = marker.slope(e);
            let (sin, cos) = angle.sin_cos();
            // The turn since the last step; a step turns no slope by half a turn.
            *angle += (cos * u.y - sin * u.x).atan2(cos * u.x + sin * u.y);
        }
    }
}

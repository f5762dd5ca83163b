//! Where a step that closes joints starts: from where the tangent takes all nodes. Moving held nodes alone would fold the last element.
//!
//! Rows hold by their reference, constraints by an offset. The change of a reference changes forces by `df`. The change of offsets
//! moves the state by `d0`, the least way in the mass norm. The rest of the way, `d1`, lies in the tangent plane of the constraints and
//! balances both: `P (K + s^2 I) d1 = P (df - K d0)` with the tangent `K` and the projection `P` on that plane.

use super::newton::{Newton, SHIFTS};
use crate::system::{DrivenSystem, Dynamics, State, System};

/// Part of a step that derivatives along it are taken over.
const PART: f64 = 1e-6;

impl<const D: usize> Newton<'_, '_, D> {
    /// Moves to where the tangent says that the nodes go when held ones move on to those of the next system.
    pub(super) fn predict(&mut self, state: &mut State, next: &System<D>) {
        let (time, q) = (state.time, state.coordinates.clone());
        (self.model).acceleration(time, &q, &self.rest, &mut self.force);
        let part = self.model.system.closed_by(PART, next);
        let mut moved = self.force.clone();
        let mut model = DrivenSystem::new(&part, self.model.inputs, self.model.work, state);
        model.acceleration(time, &q, &self.rest, &mut moved);
        let least = self.least_way(&part, state);
        self.model.linearize(time, &q, &self.rest);
        for (x, (moved, force)) in self.x.iter_mut().zip(moved.iter().zip(&self.force)) {
            *x = (moved - force) / PART;
        }
        if let Some(least) = &least {
            let (system, work) = (self.model.system, &mut *self.model.work);
            let mut product = least.clone();
            (work.linearization.tangent).apply_stiffness(&system.elimination, &mut product);
            (self.x.iter_mut().zip(&product)).for_each(|(x, product)| *x -= product);
            system.project_on_tangent_plane(&mut work.constraints, &mut self.x);
        }
        let mut shift = self.least;
        for _ in 0..SHIFTS {
            if self.model.factor([shift * shift, shift]) {
                self.model.solve_small(&mut self.x);
                let ways = [Some(&self.x), least.as_ref()].into_iter().flatten();
                for way in ways {
                    (state.coordinates.iter_mut().zip(way)).for_each(|(q, way)| *q += way);
                }
                return;
            }
            shift *= 3.0;
        }
    }

    /// The least way in the mass norm that keeps constraints over the step of which `part` is a part; nothing where there are none, or where it
    /// is not found.
    fn least_way(&mut self, part: &System<D>, state: &State) -> Option<Vec<f64>> {
        if part.constraints.is_empty() {
            return None;
        }
        let mut on = state.coordinates.clone();
        part.project_positions(state.time, &mut on, self.model.work);
        let pairs = on.iter().zip(&state.coordinates);
        let way: Vec<f64> = pairs.map(|(on, q)| (on - q) / PART).collect();
        way.iter().all(|way| way.is_finite()).then_some(way)
    }
}

impl<const D: usize> System<D> {
    /// Returns a system whose references of rows and offsets of constraints are a part of the way to those of `next`.
    fn closed_by(&self, part: f64, next: &Self) -> Self {
        let mut closed = self.clone();
        for (x, to) in closed
            .bodies
            .reference
            .iter_mut()
            .zip(&next.bodies.reference)
        {
            let pairs = x.as_flattened_mut().iter_mut().zip(to.as_flattened());
            pairs.for_each(|(x, to)| *x += part * (to - *x));
        }
        for (constraint, to) in closed.constraints.iter_mut().zip(&next.constraints) {
            constraint.offset += part * (to.offset - constraint.offset);
        }
        closed
    }
}

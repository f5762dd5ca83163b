//! What a state keeps beside coordinates and rates: driven motions, angles over full turns, slides, released joints.

use super::dynamics::{DrivenSystem, StepOutcome};
use crate::system::State;
use crate::system::joints::ConstraintKind;

impl<const D: usize> DrivenSystem<'_, D> {
    /// Counts angles on, follows slides and driven motions.
    pub fn count(&mut self, state: &mut State) -> StepOutcome {
        let system = self.system;
        for (told, is_released) in state
            .released
            .iter_mut()
            .zip(&self.work.kinematics.released)
        {
            *told = f64::from(u8::from(*is_released));
        }
        for (driven, course) in state
            .driven
            .iter_mut()
            .zip(&self.work.kinematics.trajectories)
        {
            *driven = course.orders(state.time);
        }
        if let Some(drive) = system.bodies.taken_in(&self.work.kinematics.drives) {
            return StepOutcome::WinchEmpty(drive);
        }
        if state.angles.is_empty()
            && state.travel.is_empty()
            && system.bodies.all_sections().is_empty()
        {
            return StepOutcome::AsIs;
        }
        system.forward_kinematics(state.time, &state.coordinates, None, self.work);
        if let Some((body, element)) = system.bodies.overbent(&self.work.kinematics.x) {
            return StepOutcome::ElementOverDeformed(body, element);
        }
        for (i, angle) in system.angles.iter().enumerate() {
            state.angles[i] = angle.value(&self.work.kinematics.x, self.work.kinematics.angles[i]);
        }
        self.work.kinematics.angles.copy_from_slice(&state.angles);
        state.travel.copy_from_slice(&self.work.kinematics.travel);
        for (constraint, travel) in system.slides.iter().zip(&state.travel) {
            let constraint = &system.constraints[*constraint];
            let ConstraintKind::PointOnCurve(along) = &constraint.kind else {
                continue;
            };
            let length = system.bodies.lines()[along.chain].length();
            let is_released = constraint.is_released(&self.work.kinematics.released);
            if !is_released && !(-1e-9 * length..=length * (1.0 + 1e-9)).contains(travel) {
                let joint = constraint.joint.expect("a slide is part of a joint");
                state.copy_from(&self.work.before);
                return StepOutcome::SliderLeftCable(joint);
            }
        }
        if !system.slides.is_empty() {
            self.work.before.copy_from(state);
        }
        StepOutcome::AsIs
    }
}

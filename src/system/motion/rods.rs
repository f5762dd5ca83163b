//! Rods in the equations of motion: their torques, and rotations of carried frames among the coordinates, of which spins are no rates.

use crate::bodies::{Derivative, SectionFrameState};
use crate::system::workspace::Scratch;
use crate::system::{Kinematics, State, System, Workspace};

impl<const D: usize> System<D> {
    /// Changes of `q` by small rotations about axes become those of rotations from the frames that the state holds; so do
    /// angular velocities rates.
    pub(in crate::system) fn to_rotations(
        &self,
        at: &Kinematics<D>,
        scratch: &mut Scratch<D>,
        q: &mut [f64],
    ) {
        if self.bodies.has_no_frames() {
            return;
        }
        self.bodies.frames.to_rotations(&at.turns, q);
        self.change_carried(Derivative::First, &at.carries, scratch, q);
    }

    /// The configuration is that in which the tangent is made.
    pub(in crate::system) fn set_base(&self, work: &mut Workspace<D>) {
        work.linearization
            .tangent
            .stages
            .set_base(&work.kinematics.x);
        work.linearization
            .base_turns
            .copy_from_slice(&work.kinematics.turns);
        for stage in &mut work.linearization.stages {
            stage.copy_from_slice(&work.kinematics.carries);
        }
    }

    /// The configuration is that of a stage.
    pub(in crate::system) fn set_stage(&self, stage: usize, work: &mut Workspace<D>) {
        let assembly = &self.elimination.assembly;
        work.linearization
            .tangent
            .stages
            .set(assembly, stage, &work.kinematics.x);
        let kept = work.linearization.stages[1 + stage]
            .iter_mut()
            .zip(&work.kinematics.carries);
        for ((kept, carry), frame) in kept.zip(self.bodies.frames.carried()) {
            if frame.has_shear {
                *kept = *carry;
            }
        }
    }

    /// Changes of rotations in `q` become small rotations, in which tangents are made, where the tangent was made (0) or at a stage
    /// (from 1 on). Taken for each other, corrections would leave constraints and stiff directions by as much as bodies and sections
    /// have turned from the frames that the state holds. Between stages inertia is linear in `q`: all of them change as where the tangent
    /// was made, but for sections of beams, whose shear is stiffer than they are inert.
    pub(in crate::system) fn to_tangent(
        &self,
        stage: usize,
        work: &mut Workspace<D>,
        q: &mut [f64],
    ) {
        if !self.bodies.has_no_frames() {
            self.bodies
                .frames
                .to_spins(&work.linearization.base_turns, q);
            self.change_at(Derivative::Back, stage, work, q);
        }
    }

    /// The way back of [`System::to_tangent`].
    pub(in crate::system) fn back_from_tangent(
        &self,
        stage: usize,
        work: &mut Workspace<D>,
        q: &mut [f64],
    ) {
        if !self.bodies.has_no_frames() {
            self.bodies
                .frames
                .to_rotations(&work.linearization.base_turns, q);
            self.change_at(Derivative::First, stage, work, q);
        }
    }

    fn change_at(&self, order: Derivative, stage: usize, work: &mut Workspace<D>, q: &mut [f64]) {
        let carries = &work.linearization.stages[stage];
        self.change_carried(order, carries, &mut work.scratch, q);
    }

    /// Takes the part out of second derivatives of `q` that constraints, which see small rotations, do not allow where the last acceleration
    /// was.
    pub(in crate::system) fn take_out_normal(&self, work: &mut Workspace<D>, q: &mut [f64]) {
        if !self.bodies.has_no_frames() {
            self.bodies.frames.to_spins(&work.kinematics.turns, q);
            let carries = &work.kinematics.carries;
            self.change_carried(Derivative::Back, carries, &mut work.scratch, q);
        }
        self.project_on_tangent_plane(&mut work.constraints, q);
        self.to_rotations(&work.kinematics, &mut work.scratch, q);
    }

    /// Angular accelerations become second derivatives of rotations.
    pub(in crate::system) fn to_second(&self, work: &mut Workspace<D>, a: &mut [f64]) {
        if self.bodies.has_no_frames() {
            return;
        }
        self.bodies.frames.to_second(&work.kinematics.turns, a);
        let carries = &work.kinematics.carries;
        self.change_carried(Derivative::Second, carries, &mut work.scratch, a);
    }

    /// Converts changes of `q` between spins of section frames, or their derivatives, and rotations from the frames that the state holds.
    fn change_carried(
        &self,
        order: Derivative,
        carries: &[SectionFrameState],
        scratch: &mut Scratch<D>,
        q: &mut [f64],
    ) {
        if self.bodies.frames.carried().is_empty() {
            return;
        }
        let Scratch { y, other } = scratch;
        self.elimination.expand(q, y, other);
        self.bodies.frames.turn_carried(order, carries, other, y);
        self.elimination.coordinates_of(y);
        q.copy_from_slice(y);
    }

    /// Rotations larger than this, rad, begin at zero anew. Whether there were any.
    pub(in crate::system) fn renew(
        &self,
        state: &mut State,
        size: f64,
        work: &mut Workspace<D>,
    ) -> bool {
        if self.bodies.has_no_frames() {
            return false;
        }
        let mut is_large = self.bodies.frames.largest(&state.coordinates) > size;
        if !self.bodies.frames.carried().is_empty() {
            self.forward_kinematics(state.time, &state.coordinates, Some(&state.rates), work);
            is_large |= self.bodies.frames.largest_carry(&work.kinematics.carries) > size;
        }
        if !is_large {
            return false;
        }
        let (q, v) = (&mut state.coordinates, &mut state.rates);
        if !self.bodies.frames.carried().is_empty() {
            // Over the free coordinates.
            let (free, rates) = (&mut work.scratch.y, &mut work.change);
            self.elimination.displacements(q, free);
            self.elimination.displacements(v, rates);
            let at = (&work.kinematics.x[..], &work.kinematics.carries[..]);
            self.bodies
                .frames
                .renew_carried(at, &mut state.frames, [&mut *free, &mut *rates]);
            self.elimination.coordinates_of(free);
            self.elimination.coordinates_of(rates);
            q.copy_from_slice(free);
            v.copy_from_slice(rates);
        }
        self.bodies.frames.renew(&mut state.frames, q, v);
        work.kinematics.frames.copy_from_slice(&state.frames);
        // A tangent that is kept is one of the new coordinates from now on.
        let (time, q) = (state.time, &state.coordinates);
        self.forward_kinematics(time, q, Some(&state.rates), work);
        work.linearization
            .base_turns
            .copy_from_slice(&work.kinematics.turns);
        work.linearization.stages[0].copy_from_slice(&work.kinematics.carries);
        true
    }
}

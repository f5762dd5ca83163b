//! Rotations of bodies and sections among the coordinates, of which spins are no rates.

use crate::bodies::{Derivative, ScratchVectors};
use crate::system::workspace::Scratch;
use crate::system::{Kinematics, State, System, Workspace};

impl<const D: usize> Scratch<D> {
    fn vectors(&mut self) -> ScratchVectors<'_, D> {
        ScratchVectors {
            y: &mut self.y,
            nodal: &mut self.other,
        }
    }
}

impl<const D: usize> System<D> {
    /// Changes of `q` by small rotations about axes become those of rotations from the frames that the state holds; so do
    /// angular velocities rates.
    pub(in crate::system) fn to_rotations(
        &self,
        at: &Kinematics<D>,
        scratch: &mut Scratch<D>,
        q: &mut [f64],
    ) {
        let (order, rotations) = (Derivative::First, &at.rotations);
        (self.bodies).convert(order, rotations, &self.elimination, scratch.vectors(), q);
    }

    /// The configuration is that in which the tangent is made.
    pub(in crate::system) fn set_base(&self, work: &mut Workspace<D>) {
        let (kinematics, linearization) = (&work.kinematics, &mut work.linearization);
        linearization.tangent.stages.set_base(&kinematics.x);
        for stage in &mut linearization.stages {
            stage.copy_from(&kinematics.rotations);
        }
    }

    /// The configuration is that of a stage.
    pub(in crate::system) fn set_stage(&self, stage: usize, work: &mut Workspace<D>) {
        let (kinematics, linearization) = (&work.kinematics, &mut work.linearization);
        let assembly = &self.elimination.assembly;
        (linearization.tangent.stages).set(assembly, stage, &kinematics.x);
        let kept = &mut linearization.stages[1 + stage];
        self.bodies.keep_stage(&kinematics.rotations, kept);
    }

    /// Changes of rotations in `q` become small rotations, in which tangents are made, where the tangent was made (0) or at a stage
    /// (from 1 on). Taken for each other, corrections would leave constraints and stiff directions by as much as bodies and sections
    /// have rotated from the frames that the state holds.
    pub(in crate::system) fn to_tangent(
        &self,
        stage: usize,
        work: &mut Workspace<D>,
        q: &mut [f64],
    ) {
        self.convert_at(Derivative::Back, stage, work, q);
    }

    /// Reverses [`System::to_tangent`].
    pub(in crate::system) fn back_from_tangent(
        &self,
        stage: usize,
        work: &mut Workspace<D>,
        q: &mut [f64],
    ) {
        self.convert_at(Derivative::First, stage, work, q);
    }

    fn convert_at(&self, order: Derivative, stage: usize, work: &mut Workspace<D>, q: &mut [f64]) {
        let rotations = &work.linearization.stages[stage];
        let scratch = work.scratch.vectors();
        (self.bodies).convert(order, rotations, &self.elimination, scratch, q);
    }

    /// Takes the part out of second derivatives of `q` that constraints, which see small rotations, do not allow where the last acceleration
    /// was.
    pub(in crate::system) fn take_out_normal(&self, work: &mut Workspace<D>, q: &mut [f64]) {
        let (order, rotations) = (Derivative::Back, &work.kinematics.rotations);
        let scratch = work.scratch.vectors();
        (self.bodies).convert(order, rotations, &self.elimination, scratch, q);
        self.project_on_tangent_plane(&mut work.constraints, q);
        self.to_rotations(&work.kinematics, &mut work.scratch, q);
    }

    /// Angular accelerations become second derivatives of rotations.
    pub(in crate::system) fn to_second(&self, work: &mut Workspace<D>, a: &mut [f64]) {
        let (order, rotations) = (Derivative::Second, &work.kinematics.rotations);
        let scratch = work.scratch.vectors();
        (self.bodies).convert(order, rotations, &self.elimination, scratch, a);
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
        let mut is_large = self.bodies.largest_rotation(&state.coordinates) > size;
        let has_sections = self.bodies.has_section_frames();
        if has_sections {
            self.forward_kinematics(state.time, &state.coordinates, Some(&state.rates), work);
            let largest = (self.bodies).largest_section_rotation(&work.kinematics.rotations);
            is_large |= largest > size;
        }
        if !is_large {
            return false;
        }
        let (q, v) = (&mut state.coordinates, &mut state.rates);
        if has_sections {
            // Over the free coordinates.
            let (free, rates) = (&mut work.scratch.y, &mut work.change);
            self.elimination.displacements(q, free);
            self.elimination.displacements(v, rates);
            let at = (&work.kinematics.x[..], &work.kinematics.rotations);
            (self.bodies).renew_sections(at, &mut state.frames, [&mut *free, &mut *rates]);
            self.elimination.coordinates_of(free);
            self.elimination.coordinates_of(rates);
            q.copy_from_slice(free);
            v.copy_from_slice(rates);
        }
        self.bodies.renew_rigid(&mut state.frames, q, v);
        work.kinematics.frames.copy_from_slice(&state.frames);
        // A tangent that is kept is one of the new coordinates from now on.
        let (time, q) = (state.time, &state.coordinates);
        self.forward_kinematics(time, q, Some(&state.rates), work);
        let [base, stages @ ..] = &mut work.linearization.stages;
        base.copy_from(&work.kinematics.rotations);
        for stage in stages {
            stage.copy_rigid(&work.kinematics.rotations);
        }
        true
    }
}

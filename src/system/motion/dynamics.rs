//! What integrators and static equilibrium see of a system: `q'' = a(t, q, q')` with identity inertia,
//! and solves with its tangent. They know neither bodies nor joints nor loads.

use nalgebra::Complex;

use crate::bodies::{Derivative, Node, RENEWED};
use crate::system::instant::Instant;
use crate::system::joints::latch::Event;
use crate::system::loads::ForceElement as _;
use crate::system::signal::{Trajectory, moved};
use crate::system::{State, System, Workspace};

/// A second-order system with identity inertia, `q'' = a(t, q, q')`, with `K = -da/dq` and
/// `R = -da/dq'`.
pub trait Dynamics {
    /// Acceleration `a(t, q, v)`.
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]);
    /// Computes the power that came in from outside and that was dissipated at the last acceleration, W.
    fn power(&mut self) -> [f64; 2];
    /// Computes the acceleration at the end of a step, and returns the power there, W. It may leave the acceleration out where
    /// [`Dynamics::accepted`] moves every state, but counts it.
    fn acceleration_at_end(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> [f64; 2] {
        self.acceleration(time, q, v, a);
        self.power()
    }
    /// How many steps of length `h` (s) add up in a time (s), at least 1, where functions of time drive the
    /// system; 1 elsewhere. Explicit methods see the error of integrating a function of time in one step, but
    /// hardly in its acceleration: faster than the rest of the scene, it takes many steps that err alike.
    fn steps_in(&self, _time: f64, _h: f64) -> f64 {
        1.0
    }
    /// Whether anything dissipates, and the power is read.
    fn dissipates(&self) -> bool {
        true
    }
    /// Whether vibrations may die away.
    fn is_damped(&self) -> bool {
        true
    }
    /// Computes `K` and `R` at a state, for the calls below.
    fn linearize(&mut self, time: f64, q: &[f64], v: &[f64]);
    /// As [`Dynamics::linearize`] at the state of the last acceleration, if no other call has moved the system since.
    fn linearize_last(&mut self, time: f64, q: &[f64], v: &[f64]) {
        self.linearize(time, q, v);
    }
    /// Factors `m I + r R + K` for real weights `[m, r]` of inertia (1/s^2) and damping (1/s); false when it is not
    /// positive definite.
    fn factor(&mut self, weights: [f64; 2]) -> bool;
    /// Factors the matrix for complex weights, beside the real factors. Returns false if it is singular.
    fn factor_complex(&mut self, weights: [Complex<f64>; 2]) -> bool;
    /// Solves in place with the real factors.
    fn solve(&mut self, x: &mut [f64]);
    /// Whether rotations are among the coordinates.
    fn has_rotations(&self) -> bool {
        false
    }
    /// Remembers the configuration of the last acceleration as that of a stage, at most [`STAGES`](crate::bodies::STAGES).
    fn set_stage(&mut self, stage: usize);
    /// Solves for the first stages in place, as many as there are vectors. `forward`, a square matrix by rows, takes
    /// the right-hand sides to one for the real factors, where their number is odd, then to real and imaginary part
    /// of one for the complex factors; `back` takes the solutions to the stages. The tangent may be rotated along to
    /// the configurations set before, so the result is exact only to first order in the way from the
    /// linearization.
    fn solve_stages(&mut self, forward: &[f64], back: &[f64], stages: &mut [Vec<f64>]);
    /// Takes out of an acceleration what is against the constraints of the last [`Dynamics::acceleration`].
    fn take_out_normal(&mut self, _a: &mut [f64]) {}
    /// `R x`, in place.
    fn apply_damping(&mut self, x: &mut [f64]);
    /// Largest rotation of any direction, rad, and change of any stretch between two configurations.
    fn largest_rotation(&mut self, from: &[f64], to: &[f64]) -> f64;
    /// Before a step: a state whose rotations are large is put in terms of smaller ones. Whether it was; its coordinates,
    /// rates and accelerations are others then, the motion is the same.
    fn renew(&mut self, _state: &mut State) -> bool {
        false
    }
    /// Told of every accepted step: brings the state back to the constraints and counts turns on.
    fn accepted(&mut self, state: &mut State) -> StepOutcome;
    /// Begins a smooth interval: from a time to the one returned, `until` at the
    /// latest. Accelerations at both ends are those inside it.
    fn begin_smooth_interval(&mut self, from: f64, until: f64) -> f64;
    /// Until when, no later than `to` (s), what drives the system goes on as it does at `from` without a kink or a jump if
    /// inputs stay as they are; `from` where a step may not lead beyond the communication point.
    fn unchanged_until(&self, from: f64, _to: f64) -> f64 {
        from
    }
    /// Whether something may happen within a step that ends it. Nothing may where a step leads beyond a communication point.
    fn awaits_events(&self) -> bool {
        false
    }
    /// Remembers a state that a step begins at. Whether something happens there.
    fn remember(&mut self, _state: &State) -> bool {
        false
    }
    /// Finds what happens first in a step from the remembered state, which is what the state becomes again where the step is to be
    /// shorter; of a last attempt it never is.
    fn event(&mut self, _state: &mut State, _tolerance: f64, _is_last: bool) -> Event {
        Event::None
    }
    /// Lets happen what was found at a state.
    fn switch(&mut self, _state: &mut State) -> StepOutcome {
        StepOutcome::AsIs
    }
    /// Whether it has done as much work as it may.
    fn is_exhausted(&self) -> bool;
    /// Returns the operations so far, in accelerations: other operations count by their cost relative to one. Methods
    /// are compared by this count. It is 0 without counting.
    fn operations(&self) -> f64 {
        0.0
    }
    /// Ends the smooth interval, at whose end or before it the state stands; beyond a jump it goes on differently.
    fn end_smooth_interval(&mut self, state: &mut State) -> StepOutcome;
}

/// Outcome of the check of an accepted state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepOutcome {
    /// The state stays as it is.
    AsIs,
    /// The state was projected back onto the constraints.
    Moved,
    /// A slider would have left its cable, by the index of the joint. The state is that before the step.
    SliderLeftCable(usize),
    /// A winch has taken in its whole cable, by the index of its driven coordinate.
    WinchEmpty(usize),
    /// An element of a rod is bent or twisted beyond what its frames hold: the rod, among the bodies, and the element.
    ElementOverDeformed(usize, usize),
    /// The state violates the constraints and the projection failed.
    ConstraintsViolated,
    /// A driven coordinate jumps; its index.
    Jumped(usize),
    /// A driven coordinate has no value.
    NotFinite,
}

/// Residual of positions, relative, beyond which constraints count as broken.
const BROKEN: f64 = 1e-8;

/// A system under inputs that are held, or that move as polynomials in time.
#[derive(Debug)]
pub struct DrivenSystem<'a, const D: usize = 2> {
    /// The system.
    pub system: &'a System<D>,
    /// Inputs at the start of the model's time.
    pub inputs: &'a [f64],
    /// First and second derivatives of the inputs. Empty for frozen inputs.
    slopes: &'a [[f64; 2]],
    start: f64,
    /// Scratch of the system.
    pub work: &'a mut Workspace<D>,
    pub(in crate::system) time: f64,
    /// The kink or jump that ends the smooth interval under way.
    pub(in crate::system) crossing: Option<f64>,
    /// Operations so far, in accelerations, and the most of them.
    operations: f64,
    most_operations: f64,
}

impl<'a, const D: usize> DrivenSystem<'a, D> {
    /// The system at a state, what inputs drive held.
    pub fn new(
        system: &'a System<D>,
        inputs: &'a [f64],
        work: &'a mut Workspace<D>,
        state: &State,
    ) -> Self {
        work.resume(state);
        work.constraints.rank.begin(state.time);
        work.kinematics.release_at(state.time, inputs);
        work.kinematics.smooth_interval = None;
        work.kinematics.inputs.clear();
        work.kinematics.inputs.extend_from_slice(inputs);
        work.kinematics.input_rates.clear();
        work.kinematics.input_rates.resize(inputs.len(), 0.0);
        // An acceleration that is an input acts at once.
        let courses = work
            .kinematics
            .trajectories
            .iter_mut()
            .zip(system.trajectories());
        for (place, (course, given)) in courses.enumerate() {
            if given.has_acceleration() {
                let [p, v, ..] = state.driven[place];
                let a = given.second(place, &state.driven, inputs);
                *course = Trajectory::hold(state.time, [p, v, a]);
            }
        }
        if !system.slides.is_empty() {
            work.before.copy_from(state);
        }
        Self {
            system,
            inputs,
            slopes: &[],
            start: state.time,
            work,
            time: state.time,
            crossing: None,
            operations: 0.0,
            most_operations: f64::INFINITY,
        }
    }

    /// Bounds its work: operations ([`Dynamics::operations`]) times [`System::parts`].
    pub fn limited(mut self, work: f64) -> Self {
        self.most_operations = work / self.system.parts() as f64;
        self
    }

    /// Counts operations that it does not see itself, in accelerations.
    pub fn spend(&mut self, operations: f64) {
        self.operations += operations;
    }

    /// Inputs move from now on, with these first and second derivatives.
    pub fn moving(mut self, slopes: &'a [[f64; 2]]) -> Self {
        self.slopes = slopes;
        self
    }

    /// Prepares trajectories of the coordinates that inputs drive, to the values that the inputs prescribe at `until`.
    pub fn until(self, state: &State, until: f64) -> Self {
        let h = until - state.time;
        if h > 0.0 {
            let input = |index: usize| {
                let [first, second] = self.slopes.get(index).copied().unwrap_or_default();
                [self.inputs[index], first, second]
            };
            let courses = self.work.kinematics.trajectories.iter_mut();
            for (place, (course, given)) in courses.zip(self.system.trajectories()).enumerate() {
                *course = given.course((state.time, h), (place, &state.driven), input);
            }
        }
        self
    }

    /// Computes accelerations of the coordinates, and multipliers, in the workspace; of rotations, angular accelerations about the axes that
    /// rotate with the body.
    pub fn accelerate(&mut self, time: f64, q: &[f64], v: &[f64]) -> &[f64] {
        self.accelerate_with(time, q, v, true)
    }

    /// Computes accelerations with or without multipliers.
    #[inline(always)]
    fn accelerate_with(&mut self, time: f64, q: &[f64], v: &[f64], is_told: bool) -> &[f64] {
        self.operations += 1.0;
        let system = self.system;
        self.place(time, q, v);
        system.forces(time, self.work);
        system.reduce(self.work);
        let is_read = is_told || (system.tracks_work && !system.drives.is_empty());
        if !system.constraints.is_empty() && (is_read || !system.constrain_tree(self.work)) {
            system.constrain(self.work);
        }
        &self.work.acceleration
    }

    /// Puts a state whose rotations are larger than this in terms of smaller ones. Whether they were.
    pub fn renew_beyond(&mut self, state: &mut State, size: f64) -> bool {
        self.system.renew(state, size, self.work)
    }

    /// The largest rotation from one state to another, as [`Dynamics::largest_rotation`].
    pub fn rotation_between(&mut self, [from, to]: [&State; 2]) -> f64 {
        let [from, to] = [from, to].map(|state| self.system.nodes_of(state, self.work));
        self.system.bodies.largest_rotation_between(&from, &to)
    }

    fn place(&mut self, time: f64, q: &[f64], v: &[f64]) {
        self.time = time;
        let t = time - self.start;
        for (i, [first, second]) in self.slopes.iter().enumerate() {
            let [value, rate] = moved([self.inputs[i], *first, *second], t);
            (
                self.work.kinematics.inputs[i],
                self.work.kinematics.input_rates[i],
            ) = (value, rate);
        }
        let v = self.system.reads_rates().then_some(v);
        self.system.forward_kinematics(time, q, v, self.work);
    }

    /// Computes configuration and rates at a state, as they are told.
    pub(super) fn place_state(&mut self, state: &State) {
        let rates = Some(&state.rates[..]);
        (self.system).forward_kinematics(state.time, &state.coordinates, rates, self.work);
    }

    /// Kinetic energy at a state, J. Configuration and rates there are left behind.
    pub(super) fn kinetic(&mut self, state: &State) -> f64 {
        self.place_state(state);
        self.system.bodies.kinetic(self.work.kinematics.motion())
    }

    /// Potential at `to` less that at `from` (strain energy, gravity, springs, loads as they are), J, and
    /// the size of the terms it is summed from.
    pub fn potential_difference(&mut self, from: &[f64], to: &[f64]) -> (f64, f64) {
        let (system, time) = (self.system, self.time);
        system.forward_kinematics(time, to, None, self.work);
        self.work
            .scratch
            .other
            .copy_from_slice(&self.work.kinematics.x);
        system.forward_kinematics(time, from, None, self.work);
        let (before, after) = (&self.work.kinematics.x, &self.work.scratch.other);
        let (mut sum, mut size) = (0.0, 0.0);
        let mut add = |energy: f64, scale: f64| {
            sum += energy;
            size += scale;
        };
        // Differences element by element: the sums of both energies would cancel.
        (system.bodies).for_each_strain_energy([after, before], |[now, then]| {
            add(now - then, now + then);
        });
        for (weight, (a, b)) in system.weight.iter().zip(after.iter().zip(before)) {
            let ways = a.as_flattened().iter().zip(b.as_flattened());
            let fall = weight.as_flattened().iter().zip(ways);
            let fall: f64 = fall.map(|(w, (a, b))| w * (a - b)).sum();
            add(-fall, fall.abs());
        }
        let (start, end) = (self.instant(before), self.instant(after));
        for load in &system.loads {
            let work = load.work(start, end);
            add(-work, work.abs());
        }
        if system.is_rotating() {
            let of = |x| system.bodies.centrifugal(system.rotation, x);
            let difference = of(after) - of(before);
            add(-difference, difference.abs());
        }
        (sum, size)
    }

    /// Number of negative eigenvalues of `m I + r R + K` for weights `[m, r]` where constraints leave freedom, and its
    /// factors for [`Dynamics::solve`]; nothing where it is singular.
    pub fn inertia(&mut self, weights: [f64; 2]) -> Option<usize> {
        self.operations += self.system.prices.factor;
        let elimination = &self.system.elimination;
        self.work
            .linearization
            .tangent
            .inertia(elimination, weights)
    }

    /// As [`Dynamics::solve`], over small rotations in place of changes of coordinates: equilibria are found in these. Amplitudes of reduced
    /// bodies are counted with them, and are converted.
    pub fn solve_small(&mut self, x: &mut [f64]) {
        self.to_counted(x);
        self.solve_counted(x);
        self.from_counted(x);
    }

    /// Changes of coordinates become what tangents are made in, where amplitudes of reduced bodies are counted.
    pub fn to_counted(&self, x: &mut [f64]) {
        self.convert_reduced(Derivative::Back, x);
    }

    /// Reverses [`Self::to_counted`].
    pub fn from_counted(&self, x: &mut [f64]) {
        self.convert_reduced(Derivative::First, x);
    }

    fn convert_reduced(&self, order: Derivative, x: &mut [f64]) {
        let rotations = &self.work.linearization.stages[0];
        self.system.bodies.convert_reduced(order, rotations, x);
    }

    /// Adds stiffness, 1/s^2, against motions that constraints do not allow to the tangent: see [`System::add_held`].
    pub fn hold(&mut self, stiffness: f64) {
        self.system.add_held(stiffness, self.work);
    }

    /// From now on tangents take the stress that a linear step from the remembered configuration predicts, or the present stress
    /// (docs/decisions/0076-plates-and-shells.md). Of two configurations that are the same both agree.
    pub fn predict_stress(&mut self, predicts: bool) {
        self.work.linearization.predicts = predicts;
    }

    /// Remembers the configuration of the last tangent.
    pub fn remember_configuration(&mut self) {
        let Workspace {
            kinematics,
            linearization,
            ..
        } = &mut *self.work;
        linearization.from.copy_from_slice(&kinematics.x);
    }

    /// Solves in place over what the tangent is made in.
    pub fn solve_counted(&mut self, x: &mut [f64]) {
        self.operations += self.system.prices.solve;
        self.work
            .linearization
            .tangent
            .solve(&self.system.elimination, x);
    }

    /// `K x`, in place, inside the tangent plane of the constraints.
    pub fn apply_stiffness(&mut self, x: &mut [f64]) {
        let (system, work) = (self.system, &mut *self.work);
        system.project_on_tangent_plane(&mut work.constraints, x);
        (work.linearization.tangent).apply_stiffness(&system.elimination, x);
        system.project_on_tangent_plane(&mut work.constraints, x);
    }

    fn instant<'b>(&'b self, x: &'b [Node<D>]) -> Instant<'b, D> {
        Instant {
            x,
            ..self.system.instant(self.time, &self.work.kinematics)
        }
    }

    /// Brings a state onto the constraints; false where that fails.
    pub fn project(&mut self, state: &mut State) -> bool {
        if !self.system.is_projected() {
            return true;
        }
        let (system, time) = (self.system, state.time);
        let q = &mut state.coordinates;
        let residual = system.project_positions(time, q, self.work);
        if residual.is_nan() || residual > BROKEN {
            return false;
        }
        system.project_velocities(&mut state.rates, self.work);
        true
    }
}

impl<const D: usize> Dynamics for DrivenSystem<'_, D> {
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        a.copy_from_slice(self.accelerate_with(time, q, v, false));
        self.system.to_second(self.work, a);
    }

    fn power(&mut self) -> [f64; 2] {
        if self.system.tracks_work {
            self.system.powers(self.time, self.work)
        } else {
            [0.0; 2]
        }
    }

    fn acceleration_at_end(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> [f64; 2] {
        let system = self.system;
        // A search for a slide begins at what it found.
        if system.is_projected() && !system.tracks_work && system.slides.is_empty() {
            self.operations += 1.0;
            return [0.0; 2];
        }
        self.acceleration(time, q, v, a);
        self.power()
    }

    fn steps_in(&self, time: f64, h: f64) -> f64 {
        if self.system.is_driven_by_time {
            (time / h).max(1.0)
        } else {
            1.0
        }
    }

    fn dissipates(&self) -> bool {
        self.system.tracks_work && self.system.is_damped
    }

    fn is_damped(&self) -> bool {
        self.system.is_damped
    }

    fn linearize(&mut self, time: f64, q: &[f64], v: &[f64]) {
        self.operations += self.system.prices.linearize;
        if self.system.stiffens() {
            self.accelerate(time, q, v);
        } else {
            self.place(time, q, v);
        }
        self.system.assemble(time, self.work);
    }

    fn linearize_last(&mut self, time: f64, q: &[f64], v: &[f64]) {
        // A search for a slide ends closer to it when it begins at what it found.
        if self.work.constraints.is_without_multipliers || !self.system.slides.is_empty() {
            return self.linearize(time, q, v);
        }
        // The count compares methods, so it does not depend on what is at hand.
        self.operations +=
            self.system.prices.linearize + f64::from(u8::from(self.system.stiffens()));
        self.system.assemble(time, self.work);
    }

    fn factor(&mut self, weights: [f64; 2]) -> bool {
        self.operations += self.system.prices.factor;
        (self.work.linearization.tangent).factor(&self.system.elimination, weights)
    }

    fn factor_complex(&mut self, weights: [Complex<f64>; 2]) -> bool {
        self.operations += self.system.prices.factor_complex;
        (self.work.linearization.tangent).factor_complex(&self.system.elimination, weights)
    }

    fn solve(&mut self, x: &mut [f64]) {
        self.system.to_tangent(0, self.work, x);
        self.solve_counted(x);
        self.system.back_from_tangent(0, self.work, x);
    }

    fn has_rotations(&self) -> bool {
        !self.system.bodies.has_no_frames()
    }

    fn set_stage(&mut self, stage: usize) {
        self.system.set_stage(stage, self.work);
    }

    fn solve_stages(&mut self, forward: &[f64], back: &[f64], stages: &mut [Vec<f64>]) {
        self.operations += self.system.prices.solve_stages;
        let system = self.system;
        for (i, q) in stages.iter_mut().enumerate() {
            system.to_tangent(1 + i, self.work, q);
        }
        let tangent = &mut self.work.linearization.tangent;
        tangent.solve_stages(&system.elimination, [forward, back], stages);
        for (i, q) in stages.iter_mut().enumerate() {
            system.back_from_tangent(1 + i, self.work, q);
        }
    }

    fn take_out_normal(&mut self, a: &mut [f64]) {
        self.system.take_out_normal(self.work, a);
    }

    fn apply_damping(&mut self, x: &mut [f64]) {
        self.system.to_tangent(0, self.work, x);
        self.work
            .linearization
            .tangent
            .apply_damping(&self.system.elimination, x);
        self.system.back_from_tangent(0, self.work, x);
    }

    fn largest_rotation(&mut self, from: &[f64], to: &[f64]) -> f64 {
        let (system, time) = (self.system, self.time);
        system.forward_kinematics(time, from, None, self.work);
        self.work
            .scratch
            .other
            .copy_from_slice(&self.work.kinematics.x);
        system.forward_kinematics(time, to, None, self.work);
        let (before, x) = (&self.work.scratch.other, &self.work.kinematics.x);
        system.bodies.largest_rotation_between(before, x)
    }

    fn renew(&mut self, state: &mut State) -> bool {
        self.renew_beyond(state, RENEWED)
    }

    fn accepted(&mut self, state: &mut State) -> StepOutcome {
        if !self.system.is_projected() {
            return self.count(state);
        }
        self.work.constraints.rank.reach(&state.coordinates);
        if !self.project(state) {
            return StepOutcome::ConstraintsViolated;
        }
        self.system.watch_rank(state.time, self.work);
        self.system.stop_blocked(state, self.work);
        match self.count(state) {
            StepOutcome::AsIs => StepOutcome::Moved,
            other => other,
        }
    }

    fn unchanged_until(&self, from: f64, to: f64) -> f64 {
        self.goes_on_until(from, to)
    }

    fn awaits_events(&self) -> bool {
        self.system.awaits_events()
    }

    fn remember(&mut self, state: &State) -> bool {
        self.remember_start(state)
    }

    fn event(&mut self, state: &mut State, tolerance: f64, is_last: bool) -> Event {
        self.find_event(state, tolerance, is_last)
    }

    fn switch(&mut self, state: &mut State) -> StepOutcome {
        self.switch_all(state)
    }

    fn is_exhausted(&self) -> bool {
        self.operations >= self.most_operations
    }

    fn operations(&self) -> f64 {
        self.operations
    }

    fn begin_smooth_interval(&mut self, from: f64, until: f64) -> f64 {
        self.enter(from, until)
    }

    fn end_smooth_interval(&mut self, state: &mut State) -> StepOutcome {
        self.leave(state)
    }
}

//! A system with its scratch, integrator and evaluated outputs.

use super::variables::{has_rest_length_input, start_inputs};
use super::{Error, Quantity, Report, Source, StepFailure, Variable, method};
use crate::body::Marker;
use crate::integrators::{MOST_STEPS, Method, Stop, Tolerance, advance};
use crate::scene::{Assembled, Initial, MarkerReference, Scene, assemble};
use crate::system::{
    End, Evaluation, Model, NotAssembled, State, Work, equilibrium, natural_frequencies,
};

/// How much of the outputs belongs to the current state and inputs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Evaluated {
    Nothing,
    Kinematics,
    Dynamics,
}

pub(super) struct Engine {
    scene: Scene,
    assembled: Assembled,
    work: Work,
    method: Box<dyn Method>,
    tolerance: Tolerance,
    evaluation: Evaluation,
    evaluated: Evaluated,
    /// The marker of every variable that has one.
    markers: Vec<Option<Marker>>,
    /// Number of natural frequencies wanted.
    frequencies: usize,
    /// Whether inputs that jump do work on springs.
    sets_springs: bool,
    /// The state at time 0 under these inputs, until it has been asked for.
    start: Option<(Vec<f64>, State)>,
}

impl Engine {
    /// Builds the system of a valid scene.
    pub(super) fn new(scene: &Scene, variables: &[Variable]) -> Result<Self, Error> {
        let assembled = assemble(scene)?;
        let system = &assembled.system;
        let (mut work, mut evaluation) = (Work::new(system), Evaluation::new(system));
        let marker = |variable: &Variable| {
            let Source::Output(quantity) = variable.source else {
                return None;
            };
            Some(assembled.marker(marker_of(quantity)?))
        };
        let markers = variables.iter().map(marker).collect();
        let frequencies = variables
            .iter()
            .filter_map(|variable| match variable.source {
                Source::NaturalFrequency(number) => Some(number + 1),
                _ => None,
            });
        // From nothing but the scene, so that a restored state goes on with the same method.
        let inputs = start_inputs(variables);
        let described = (&assembled.nodes[..], &assembled.rates[..]);
        let state = system.initial_state(0.0, &inputs, described, &mut work);
        let blank = system.blank_state(0.0);
        let reached = state.as_ref().unwrap_or(&blank);
        evaluation.kinematics(system, reached, &mut work);
        let start = method::Start {
            system,
            state: reached,
            kinetic: evaluation.kinetic_energy(system),
            inputs: &inputs,
        };
        let (tolerance, method) = method::choose(scene, &start, &mut work)?;
        Ok(Self {
            scene: scene.clone(),
            evaluated: Evaluated::Nothing,
            frequencies: frequencies.max().unwrap_or(0),
            sets_springs: has_rest_length_input(scene),
            start: state.ok().map(|state| (inputs, state)),
            evaluation,
            markers,
            work,
            method,
            tolerance,
            assembled,
        })
    }

    /// The state to start from and the natural frequencies about it.
    pub(super) fn initial_state(
        &mut self,
        time: f64,
        inputs: &[f64],
    ) -> Result<(State, Vec<f64>), Error> {
        let Assembled {
            system,
            nodes,
            rates,
            ..
        } = &self.assembled;
        let described = (&nodes[..], &rates[..]);
        let state = match self.start.take() {
            Some((start, state)) if time == 0.0 && start == inputs => Ok(state),
            _ => system.initial_state(time, inputs, described, &mut self.work),
        };
        let mut state = state.map_err(|error| Error::NotAssembled(self.open_joints(&error)))?;
        if self.scene.initial == Initial::StaticEquilibrium {
            equilibrium::find(system, inputs, &mut self.work, &mut state)?;
        }
        let count = self.frequencies;
        let frequencies = match count {
            0 => Vec::new(),
            _ => natural_frequencies(system, inputs, &mut self.work, &state, count),
        };
        self.forget();
        state.work[0] -= self.set_energy(&state, inputs);
        self.forget();
        Ok((state, frequencies))
    }

    fn open_joints(&self, error: &NotAssembled) -> String {
        if error.gaps.is_empty() {
            return "expected joints and motions that agree, found some that contradict each other"
                .into();
        }
        let gaps = error.gaps.iter();
        let words = gaps.map(|(joint, gap)| match *gap < 1e-3 {
            true => format!("{} {gap:.1e} m", self.name(*joint)),
            false => format!("{} {gap:.3} m", self.name(*joint)),
        });
        format!(
            "expected bodies that fit together, found gaps: {}",
            words.collect::<Vec<_>>().join(", ")
        )
    }

    /// Name of a joint or motion of the system.
    fn name(&self, index: usize) -> &str {
        let joints = &self.scene.joints;
        match (joints.get(index), index.checked_sub(joints.len())) {
            (Some(joint), _) => &joint.name,
            (None, place) => {
                let motion = place.and_then(|place| self.scene.motions.get(place));
                motion.map_or("", |motion| &motion.name)
            }
        }
    }

    /// Names of the joints and motions that hold, at least in part, what others hold already, and of
    /// rigid bodies that joints alone keep in shape, at a state.
    pub(super) fn redundant(&mut self, state: &State) -> Vec<String> {
        let system = &self.assembled.system;
        let (joints, bodies) = system.redundant_at(state, &mut self.work);
        self.forget();
        let joints = joints.into_iter().map(|joint| self.name(joint).to_owned());
        let bodies = bodies
            .into_iter()
            .map(|b| self.scene.bodies[b].name().to_owned());
        joints.chain(bodies).collect()
    }

    /// Advances the state to `until`; what it did is told of a failure as well.
    pub(super) fn step(
        &mut self,
        state: &mut State,
        inputs: &[f64],
        until: f64,
    ) -> (Report, Result<(), StepFailure>) {
        self.forget();
        state.work[0] += self.set_energy(state, inputs);
        let system = &self.assembled.system;
        let mut model = Model::new(system, inputs, &mut self.work, state).until(state, until);
        let (counts, result) =
            advance(&mut *self.method, &mut model, state, until, &self.tolerance);
        self.forget();
        state.work[0] -= self.set_energy(state, inputs);
        self.forget();
        let report = Report {
            method: self.method.name(),
            steps: counts.steps,
            rejected: counts.rejected,
            newton_iterations: counts.newton_iterations,
        };
        let failure = |stop| StepFailure {
            time: state.time,
            reason: self.explain(stop),
        };
        (report, result.map_err(failure))
    }

    /// Energy in springs whose length inputs may set. Between steps the work in a state is short of it,
    /// so that the work of an input that jumps is counted by the energy it leaves behind.
    fn set_energy(&mut self, state: &State, inputs: &[f64]) -> f64 {
        if !self.sets_springs {
            return 0.0;
        }
        self.evaluate(Evaluated::Kinematics, state, inputs);
        self.evaluation
            .spring_energy(&self.assembled.system, inputs)
    }

    fn explain(&self, stop: Stop) -> String {
        let (method, tolerance) = (self.method.name(), self.tolerance.relative);
        match stop {
            Stop::StepTooSmall => format!(
                "{method}: no step however short meets the relative tolerance {tolerance:e}"
            ),
            Stop::TooManySteps => format!(
                "{method}: the relative tolerance {tolerance:e} takes more than {MOST_STEPS} steps"
            ),
            Stop::NotFinite => {
                format!("{method}: velocities or accelerations are no longer finite")
            }
            Stop::RanOff(joint) => format!("slider `{}` has left its cable", self.name(joint)),
            Stop::Broken => format!("{method}: constraints cannot be kept"),
        }
    }

    /// Whether a state has the sizes of this system.
    pub(super) fn fits(&self, state: &State) -> bool {
        self.assembled.system.fits(state)
    }

    /// The state has changed.
    pub(super) fn forget(&mut self) {
        self.evaluated = Evaluated::Nothing;
    }

    /// The inputs have changed: positions and velocities stand.
    pub(super) fn inputs_changed(&mut self) {
        self.evaluated = self.evaluated.min(Evaluated::Kinematics);
    }

    /// Value of an output; computes only what it needs and has not computed yet.
    pub(super) fn output(
        &mut self,
        index: usize,
        quantity: Quantity,
        state: &State,
        inputs: &[f64],
    ) -> f64 {
        use Quantity::*;
        self.evaluate(needs(quantity), state, inputs);
        let work_of_jumps = match quantity {
            Input => self.set_energy(state, inputs),
            _ => 0.0,
        };
        let (values, system) = (&self.evaluation, &self.assembled.system);
        let at = self.markers[index].as_ref();
        let on = |f: &dyn Fn(&Marker) -> f64| at.map_or(0.0, f);
        match quantity {
            Position(_, axis) => on(&|m| m.position(&values.x)[axis]),
            Velocity(_, axis) => on(&|m| m.position(&values.v)[axis]),
            Acceleration(_, axis) => on(&|m| m.position(&values.acceleration)[axis]),
            Angle(place) => state.angles[self.assembled.angles[place]],
            AngularVelocity(_) => on(&|m| End::Body(*m).spin(&values.x, &values.v)),
            JointVelocity(joint) => {
                let spin = |end: &End| end.spin(&values.x, &values.v);
                let [a, b] = &system.joints()[joint].ends;
                spin(b) - spin(a)
            }
            Strain(_) => on(&|m| values.strain(system, m).0),
            Curvature(_) => on(&|m| values.strain(system, m).1),
            AxialForce(_) => on(&|m| values.section(system, m).0),
            BendingMoment(_) => on(&|m| values.section(system, m).1),
            ConnectivityForce(_, axis) => {
                on(&|m| values.connectivity_force(system, inputs, m)[axis])
            }
            Travel(place) => state.travel[place],
            Reaction(joint, axis) => values.reaction(system, inputs, joint).0[axis],
            ReactionMoment(joint) => values.reaction(system, inputs, joint).1,
            KineticEnergy => values.kinetic_energy(system),
            StrainEnergy => values.strain_energy(system),
            GravityEnergy => values.gravity_energy(system),
            SpringEnergy => values.spring_energy(system, inputs),
            Input => state.work[0] + work_of_jumps,
            Dissipated => state.work[1],
            Momentum(axis) => values.momentum(system).0[axis],
            AngularMomentum => values.momentum(system).1,
            CenterOfMass(axis) => values.center_of_mass(system)[axis],
            Residual(of) => values.residuals(system)[of],
        }
    }

    fn evaluate(&mut self, needs: Evaluated, state: &State, inputs: &[f64]) {
        let system = &self.assembled.system;
        if needs >= Evaluated::Kinematics && self.evaluated < Evaluated::Kinematics {
            self.evaluation.kinematics(system, state, &mut self.work);
            self.evaluated = Evaluated::Kinematics;
        }
        if needs > self.evaluated {
            self.evaluation
                .dynamics(system, state, inputs, &mut self.work);
            self.evaluated = needs;
        }
    }
}

/// What a quantity is computed from.
fn needs(quantity: Quantity) -> Evaluated {
    use Quantity::*;
    match quantity {
        Acceleration(..) | ConnectivityForce(..) | Reaction(..) | ReactionMoment(_) => {
            Evaluated::Dynamics
        }
        Angle(_) | Travel(_) | Input | Dissipated => Evaluated::Nothing,
        _ => Evaluated::Kinematics,
    }
}

/// The marker that a quantity belongs to.
fn marker_of(quantity: Quantity) -> Option<MarkerReference> {
    use Quantity::*;
    match quantity {
        Position(at, _)
        | Velocity(at, _)
        | Acceleration(at, _)
        | AngularVelocity(at)
        | Strain(at)
        | Curvature(at)
        | AxialForce(at)
        | BendingMoment(at)
        | ConnectivityForce(at, _) => Some(at),
        _ => None,
    }
}

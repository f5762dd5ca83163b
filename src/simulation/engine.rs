//! A system with its scratch, integrator and evaluated outputs.

use super::{Error, Quantity, Report, Source, StepFailure, Variable, method};
use crate::body::Marker;
use crate::integrators::{MOST_STEPS, Method, Stop, Tolerance, advance};
use crate::math::eigen::symmetric_eigenvalues;
use crate::scene::{Initial, Scene, assemble};
use crate::system::{Dynamics, Evaluation, Model, State, System, Work, equilibrium};

/// How much of the outputs belongs to the current state and inputs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Evaluated {
    Nothing,
    Kinematics,
    Dynamics,
}

pub(super) struct Engine {
    scene: Scene,
    system: System,
    work: Work,
    method: Box<dyn Method>,
    tolerance: Tolerance,
    evaluation: Evaluation,
    evaluated: Evaluated,
    /// The marker of every variable that has one.
    markers: Vec<Option<Marker>>,
    /// Number of natural frequencies wanted.
    frequencies: usize,
}

impl Engine {
    /// Builds the system of a valid scene.
    pub(super) fn new(scene: &Scene, variables: &[Variable]) -> Result<Self, Error> {
        let system = assemble(scene)?;
        let mut work = system.work();
        let (tolerance, method) = method::choose(scene, &system, &mut work);
        let marker = |variable: &Variable| {
            let Source::Output(quantity) = variable.source else {
                return None;
            };
            coordinate(quantity).map(|at| system.body().marker(at))
        };
        let is_frequency = |v: &&Variable| matches!(v.source, Source::NaturalFrequency(_));
        Ok(Self {
            scene: scene.clone(),
            evaluation: Evaluation::new(&system),
            evaluated: Evaluated::Nothing,
            markers: variables.iter().map(marker).collect(),
            frequencies: variables.iter().filter(is_frequency).count(),
            work,
            method,
            tolerance,
            system,
        })
    }

    /// The state to start from and the natural frequencies about it.
    pub(super) fn initial_state(
        &mut self,
        time: f64,
        inputs: &[f64],
    ) -> Result<(State, Vec<f64>), Error> {
        let mut state = self.system.reference_state(time);
        Model::new(&self.system, inputs, &mut self.work).accepted(&mut state);
        match self.scene.initial {
            Initial::AsShaped => {
                let rates = &mut state.rates;
                method::rigid_motion(&self.scene, &self.system, &mut self.work, rates);
            }
            Initial::StaticEquilibrium => {
                equilibrium::find(&self.system, inputs, &mut self.work, &mut state)?;
            }
        }
        self.forget();
        let frequencies = self.natural_frequencies(&state, inputs);
        Ok((state, frequencies))
    }

    /// Lowest eigenvalues of the tangent as frequencies; negative ones are unstable.
    fn natural_frequencies(&mut self, state: &State, inputs: &[f64]) -> Vec<f64> {
        if self.frequencies == 0 {
            return Vec::new();
        }
        let rest = vec![0.0; state.rates.len()];
        Model::new(&self.system, inputs, &mut self.work).linearize(&state.coordinates, &rest);
        let stiffness = self.system.body().reduced_stiffness(&mut self.work.tangent);
        let entry = |i: usize, j: usize| 0.5 * (stiffness[i][j] + stiffness[j][i]);
        let values = symmetric_eigenvalues(stiffness.len(), entry).unwrap_or_default();
        let frequency = |value: &f64| value.signum() * value.abs().sqrt();
        let mut frequencies: Vec<f64> = values
            .iter()
            .take(self.frequencies)
            .map(frequency)
            .collect();
        frequencies.resize(self.frequencies, 0.0);
        frequencies
    }

    /// Names of the joints that hold, at least in part, what others hold already.
    pub(super) fn redundant_joints(&self) -> Vec<String> {
        let mut joints = self.system.body().redundant().to_vec();
        joints.sort_unstable();
        joints.dedup();
        let name = |joint: usize| self.scene.joints[joint].name.clone();
        joints.into_iter().map(name).collect()
    }

    /// Advances the state to `until`.
    pub(super) fn step(
        &mut self,
        state: &mut State,
        inputs: &[f64],
        until: f64,
    ) -> Result<Report, StepFailure> {
        self.forget();
        let mut model = Model::new(&self.system, inputs, &mut self.work);
        let (counts, result) =
            advance(&mut *self.method, &mut model, state, until, &self.tolerance);
        match result {
            Ok(()) => Ok(Report {
                method: self.method.name(),
                steps: counts.steps,
                rejected: counts.rejected,
                newton_iterations: counts.newton_iterations,
            }),
            Err(stop) => Err(StepFailure {
                time: state.time,
                reason: self.explain(stop),
            }),
        }
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
        }
    }

    /// Whether a state has the sizes of this system.
    pub(super) fn fits(&self, state: &State) -> bool {
        self.system.fits(state)
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
        let needs = match quantity {
            Acceleration(..) | Reaction(..) | ReactionMoment(_) => Evaluated::Dynamics,
            Angle(..) | KineticEnergy => Evaluated::Nothing,
            _ => Evaluated::Kinematics,
        };
        self.evaluate(needs, state, inputs);
        let (values, system) = (&self.evaluation, &self.system);
        let at = self.markers[index].as_ref();
        let on = |f: &dyn Fn(&Marker) -> f64| at.map_or(0.0, f);
        match quantity {
            Position(_, axis) => on(&|m| m.position(&values.e)[axis]),
            Velocity(_, axis) => on(&|m| m.position(&values.rate)[axis]),
            Acceleration(_, axis) => on(&|m| m.position(&values.acceleration)[axis]),
            Angle(_, place) => state.angles[place],
            AngularVelocity(_) => on(&|m| values.angular_velocity(m)),
            Strain(_) => on(&|m| values.strain(system, m).0),
            Curvature(_) => on(&|m| values.strain(system, m).1),
            Reaction(joint, axis) => values.reaction(system, joint)[axis],
            ReactionMoment(joint) => values.reaction_moment(system, joint),
            KineticEnergy => Evaluation::kinetic_energy(state),
            StrainEnergy => values.strain_energy(system),
            GravityEnergy => values.gravity_energy(system),
        }
    }

    fn evaluate(&mut self, needs: Evaluated, state: &State, inputs: &[f64]) {
        if needs >= Evaluated::Kinematics && self.evaluated < Evaluated::Kinematics {
            self.evaluation
                .kinematics(&self.system, state, &mut self.work);
            self.evaluated = Evaluated::Kinematics;
        }
        if needs > self.evaluated {
            self.evaluation
                .dynamics(&self.system, state, inputs, &mut self.work);
            self.evaluated = needs;
        }
    }
}

/// Material coordinate of the marker that a quantity belongs to.
fn coordinate(quantity: Quantity) -> Option<f64> {
    use Quantity::*;
    match quantity {
        Position(at, _)
        | Velocity(at, _)
        | Acceleration(at, _)
        | Angle(at, _)
        | AngularVelocity(at)
        | Strain(at)
        | Curvature(at) => Some(at),
        Reaction(..) | ReactionMoment(_) | KineticEnergy | StrainEnergy | GravityEnergy => None,
    }
}

//! A system with its scratch, integrator and evaluated outputs.

use super::deformed::DeformationWatch;
use super::inputs::Inputs;
use super::mesh::MeshWatch;
use super::modes::in_words;
use super::propeller::PropellerWatch;
use super::quantities::{Evaluated, needs, value};
use super::variables::{sets_springs, start_inputs};
use super::watch::Watch;
use super::{Error, Quantity, Report, Spectra, StepFailure, Variable, method};
use crate::bodies::GridStress;
use crate::integrators::{Methods, Tolerance};
use crate::math::jet::{Jet, part};
use crate::math::space::components;
use crate::scene::{Assembled, ConstraintOwner, InitialState, LoadId, Resolved, Timed};
use crate::system::equilibrium;
use crate::system::{
    Derivatives, DrivenSystem, Dynamics, Evaluation, NotAssembled, State, System, Workspace,
    eigenvalues, natural_frequencies,
};

/// State and inputs that small motions are about, and the rate of what causes them.
#[derive(Clone, Copy, Debug)]
pub(super) struct OperatingPoint<'a> {
    pub state: &'a State,
    pub inputs: &'a [f64],
    /// Rate at which a cause grows, 1/s.
    pub rate: f64,
}

/// Variables that the present derivatives are taken by.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Derived {
    Nothing,
    /// Time, up to this order.
    Time(usize),
    Inputs,
}

pub(super) struct Engine<const D: usize> {
    initial: InitialState,
    /// Most work of one communication step.
    pub(super) most_work: f64,
    /// Functions of time of the scene, to say which of them ended a step.
    pub(super) timed: Vec<Timed>,
    /// Owners of constraints, as pairs of list and name, by index. `bodies` holds the names of bodies.
    pub(super) holders: Vec<(&'static str, String)>,
    /// Warnings about the initial state.
    remarks: InitialWarnings,
    pub(super) bodies: Vec<String>,
    /// Names of the loads of the scene, to say which of them ended a step.
    pub(super) loads: Vec<String>,
    pub(super) assembled: Assembled<D>,
    pub(super) work: Workspace<D>,
    pub(super) methods: Methods,
    pub(super) tolerance: Tolerance,
    pub(super) evaluation: Evaluation<D>,
    evaluated: Evaluated,
    /// Readers of the stress that pictures of plates and shells show, patch by patch; empty until it is asked for.
    pub(super) grid_stresses: Vec<Option<GridStress>>,
    derivatives: Option<Box<Derivatives<D>>>,
    derived: Derived,
    pub(super) watch: Watch,
    pub(super) mesh: MeshWatch,
    pub(super) propeller: PropellerWatch,
    /// Reduced bodies and how far they deform.
    pub(super) deformation: DeformationWatch,
    /// Numbers of natural frequencies and of eigenvalues wanted.
    wanted: [usize; 2],
    /// Whether inputs that jump do work on springs.
    sets_springs: bool,
    /// The state at time 0 under these inputs, until it has been asked for.
    start: Option<(Vec<f64>, State)>,
}

/// Most work of one communication step; of a fuzzer little, so that it hears of it at once.
fn most_work(limit: f64) -> f64 {
    if cfg!(fuzzing) { limit.min(1e5) } else { limit }
}

fn names(names: &mut dyn Iterator<Item = &str>) -> Vec<String> {
    names.map(str::to_owned).collect()
}

/// Gap, in sizes of the largest body (or in rad), from which on it is told that bodies were moved to close it.
const MISFIT: f64 = 0.5;

/// Warnings about an initial state.
#[derive(Clone, Debug, Default)]
pub(super) struct InitialWarnings {
    /// Gaps of joints as described.
    pub initial_gaps: Option<String>,
    /// The equilibrium is not stable, and could not be left.
    pub is_unstable: bool,
}

fn kind_and_name(holder: &ConstraintOwner<'_>) -> (&'static str, String) {
    let kinds = ["joint", "motion", "port"];
    let kind = kinds.into_iter().find(|kind| holder.path.starts_with(kind));
    (kind.unwrap_or("joint"), holder.name.to_owned())
}

impl<const D: usize> Engine<D> {
    /// Builds the system of a scene.
    ///
    /// # Errors
    /// The scene cannot be assembled, or its integrator cannot be chosen.
    pub(super) fn new(resolved: &Resolved<'_>, variables: &[Variable]) -> Result<Self, Error> {
        let assembled: Assembled<D> = resolved.assemble()?;
        let system = &assembled.system;
        let (mut work, mut evaluation) = (Workspace::new(system), Evaluation::new(system));
        // From nothing but the scene, so that a restored state goes on with the same method.
        let inputs = start_inputs(variables);
        let described = (&assembled.nodes[..], &assembled.rates[..]);
        let state = system.initial_state(0.0, &inputs, described, &mut work);
        let blank = system.blank_state(0.0);
        let reached = state.as_ref().unwrap_or(&blank);
        evaluation.kinematics(system, reached, &mut work);
        evaluation.set_inputs(&inputs, &[]);
        let start = method::Start {
            system,
            state: reached,
            kinetic: evaluation.kinetic_energy(system),
            inputs: &inputs,
        };
        let (tolerance, methods) = method::choose(resolved, &start, &mut work)?;
        let methods = methods.found_with(resolved.scene.planned_step());
        let wanted = resolved.scene.error_wanted();
        let watch = Watch::new(variables, &assembled, &tolerance, wanted);
        Ok(Self {
            initial: resolved.scene.initial.state(),
            most_work: most_work(resolved.scene.method.work_limit),
            timed: resolved.scene.timed(),
            holders: resolved.holders.iter().map(kind_and_name).collect(),
            remarks: InitialWarnings::default(),
            bodies: names(&mut resolved.bodies.iter().map(|body| body.name())),
            loads: names(&mut resolved.loads.iter().map(|load| load.name)),
            evaluated: Evaluated::Nothing,
            watch,
            mesh: MeshWatch::default(),
            propeller: PropellerWatch::new(resolved),
            deformation: DeformationWatch::new(resolved),
            grid_stresses: Vec::new(),
            derivatives: None,
            derived: Derived::Nothing,
            wanted: Spectra::wanted(variables),
            sets_springs: sets_springs(resolved),
            start: state.ok().map(|state| (inputs, state)),
            evaluation,
            work,
            methods,
            tolerance,
            assembled,
        })
    }

    /// Computes the initial state with the natural frequencies and eigenvalues about it.
    ///
    /// # Errors
    /// Joints that do not close, loads without equilibrium, motions without steady state, or modes that cannot be
    /// found.
    pub(super) fn initial_state(
        &mut self,
        time: f64,
        inputs: &Inputs,
    ) -> Result<(State, Spectra), Error> {
        let values = &inputs.values;
        let Assembled {
            system,
            nodes,
            rates,
            motions,
            ..
        } = &self.assembled;
        let initial_gaps = system.initial_gaps((time, values), nodes, MISFIT, &mut self.work);
        self.remarks = InitialWarnings::default();
        if let Some((drive, travel)) = system
            .bodies()
            .paid_out_at_start(&self.work.kinematics.drives)
        {
            let name = self.driven_name(drive);
            return Err(Error::Begun(format!(
                "expected a winch `{name}` that has paid out nothing at the start, found {travel} m: the cable is as long \
                 as its shape then"
            )));
        }
        let described = (&nodes[..], &rates[..]);
        let state = match self.start.take() {
            Some((start, state)) if time == 0.0 && start == *values => Ok(state),
            _ => system.initial_state(time, values, described, &mut self.work),
        };
        let mut state = state.map_err(|error| Error::NotAssembled(self.open_joints(&error)))?;
        let nodes = system.nodes_of(&state, &mut self.work);
        if let Some((body, element)) = system.bodies().overbent(&nodes) {
            let place = self.overbent(body, element, " at the start");
            return Err(Error::ElementOverDeformed(place));
        }
        let steady = match self.initial {
            InitialState::Steady => Some(system.steady(&state, rates, &mut self.work)?),
            _ => None,
        };
        if self.initial != InitialState::Undeformed {
            let found = equilibrium::find(
                system,
                values,
                &mut self.work,
                &mut state,
                (steady, self.most_work),
            );
            let found = found.map_err(|error| self.unsettled(error))?;
            self.remarks.is_unstable = !found.is_stable;
            if steady.is_some() || !motions.is_none() {
                let x = system.nodes_of(&state, &mut self.work);
                let rates =
                    steady.map_or_else(|| motions.rates(&x), |steady| system.field(&steady, &x));
                if !system.start_moving(&rates, values, &mut self.work, &mut state) {
                    let gaps = Vec::new();
                    return Err(Error::NotAssembled(
                        self.open_joints(&NotAssembled { gaps }),
                    ));
                }
            }
        }
        self.assembled.begin(&mut state);
        self.work.begin();
        if !initial_gaps.is_empty() {
            self.remarks.initial_gaps = Some(self.gaps(&initial_gaps));
        }
        let spectra = self.spectra(values, &state)?;
        self.forget();
        state.work[0] -= self.set_energy(&state, inputs);
        self.forget();
        Ok((state, spectra))
    }

    fn spectra(&mut self, inputs: &[f64], state: &State) -> Result<Spectra, Error> {
        let ([natural, damped], mut spectra) = (self.wanted, Spectra::default());
        let (system, work) = (&self.assembled.system, &mut self.work);
        let refused = |kind: &str, told: String| Error::Spectrum(format!("{kind}: {told}"));
        if natural > 0 {
            let found = natural_frequencies(system, inputs, work, state, natural);
            let found =
                found.map_err(|error| refused("natural_frequency", in_words(&self.bodies, error)));
            spectra.frequencies = found?;
        }
        if damped > 0 {
            let found = eigenvalues(system, inputs, work, state, damped);
            let found =
                found.map_err(|error| refused("eigenvalue", in_words(&self.bodies, error)))?;
            let parts = found.iter().map(|s| [s.decay_rate, s.frequency]);
            spectra.eigenvalues = parts.collect();
        }
        Ok(spectra)
    }

    /// Returns the warnings about the initial state.
    pub(super) fn remarks(&self) -> &InitialWarnings {
        &self.remarks
    }

    /// Name of a joint, motion or port that holds something in the system.
    pub(super) fn name(&self, index: usize) -> &str {
        &self.holders[index].1
    }

    /// Name of the motion or port that a driven coordinate belongs to.
    pub(super) fn driven_name(&self, drive: usize) -> &str {
        let joint = self.assembled.system.driven_joint(drive);
        joint.map_or("", |joint| self.name(joint))
    }

    /// Advances the state to `until`, s, and moves inputs with it. The report also covers a step that fails.
    ///
    /// # Errors
    /// The step cannot be finished. The state is that of the last sub-step.
    pub(super) fn step(
        &mut self,
        state: &mut State,
        inputs: &mut Inputs,
        until: f64,
    ) -> (Report, Result<(), StepFailure>) {
        self.forget();
        let work = state.work[0];
        let set = self.set_energy(state, inputs);
        if !set.is_finite() {
            return self.unbounded(state, set);
        }
        state.work[0] += set;
        let (system, start) = (&self.assembled.system, state.time);
        let model = DrivenSystem::new(system, &inputs.values, &mut self.work, state);
        let model = model.limited(self.most_work);
        let mut model = model.moving(&inputs.slopes).until(state, until);
        let (counts, result) = self
            .methods
            .advance(&mut model, state, until, &self.tolerance);
        let operations = model.operations() * system.parts() as f64;
        inputs.advance(state.time - start);
        self.forget();
        if result.is_ok() {
            self.watch(state, inputs, counts.steps, state.time - start);
        }
        state.work[0] = if state.time == start {
            // Nothing has been done, not even by roundoff.
            work
        } else {
            state.work[0] - self.set_energy(state, inputs)
        };
        self.forget();
        self.watch_mesh(state, inputs);
        self.watch_propeller(state, inputs);
        self.watch_deformation(state, inputs);
        let report = Report {
            method: self.methods.name(&state.pace),
            steps: counts.steps,
            rejected: counts.rejected,
            newton_iterations: counts.newton_iterations,
            work: operations,
        };
        let failure = |stop| StepFailure {
            time: state.time,
            reason: self.explain(stop, state, start..until, &counts),
        };
        (report, result.map_err(failure))
    }

    /// Energy in springs whose length or end inputs may set. Between steps the work in a state is short of it,
    /// so that the work of an input that jumps is counted by the energy it leaves behind.
    fn set_energy(&mut self, state: &State, inputs: &Inputs) -> f64 {
        if !self.sets_springs {
            return 0.0;
        }
        self.evaluate(Evaluated::Kinematics, state, inputs);
        self.evaluation.spring_energy(&self.assembled.system)
    }

    /// Whether a state has the sizes of this system.
    pub(super) fn fits(&self, state: &State) -> bool {
        self.assembled.system.fits(state)
    }

    /// The state has changed.
    pub(super) fn forget(&mut self) {
        self.evaluated = Evaluated::Nothing;
        self.derived = Derived::Nothing;
    }

    /// The inputs have changed: positions and velocities stand.
    pub(super) fn inputs_changed(&mut self, inputs: &Inputs) {
        self.evaluation.set_inputs(&inputs.values, &inputs.slopes);
        self.evaluated = self.evaluated.min(Evaluated::Kinematics);
        self.derived = Derived::Nothing;
    }

    /// Value of an output; computes only what it needs and has not computed yet.
    pub(super) fn output(&mut self, quantity: Quantity, state: &State, inputs: &Inputs) -> f64 {
        self.evaluate(needs(quantity), state, inputs);
        let mut work = state.work;
        if quantity == Quantity::Input {
            work[0] += self.set_energy(state, inputs);
        }
        value(quantity, &self.evaluation, &self.assembled, work)
    }

    /// The system, and where it is in a state.
    pub(super) fn placed(
        &mut self,
        state: &State,
        inputs: &Inputs,
    ) -> (&Assembled<D>, &Evaluation<D>) {
        self.evaluated(Evaluated::Kinematics, state, inputs)
    }

    /// The system, and its evaluation in a state, as far as it is needed.
    pub(super) fn evaluated(
        &mut self,
        needed: Evaluated,
        state: &State,
        inputs: &Inputs,
    ) -> (&Assembled<D>, &Evaluation<D>) {
        self.evaluate(needed, state, inputs);
        (&self.assembled, &self.evaluation)
    }

    /// Force per reference length of a contact along a body, N/m.
    pub(super) fn contact(
        &mut self,
        load: LoadId,
        at: &[f64],
        state: &State,
        inputs: &Inputs,
    ) -> Vec<[f64; 3]> {
        self.evaluate(Evaluated::Kinematics, state, inputs);
        let load = self.assembled.load(load);
        let force = |s: &f64| self.evaluation.contact(&self.assembled.system, load, *s);
        at.iter().map(|s| components(&force(s))).collect()
    }

    /// Derivative in time, of order 1 or 2, of an output while inputs go on as they do.
    pub(super) fn derivative(
        &mut self,
        quantity: Quantity,
        order: usize,
        state: &State,
        inputs: &Inputs,
    ) -> f64 {
        if self.derived < Derived::Time(order) || self.derived == Derived::Inputs {
            self.prepare(state, inputs);
            let (system, plain) = (&self.assembled.system, &self.evaluation);
            if let Some(derivatives) = &mut self.derivatives {
                let (at, slopes) = ((plain, state), &inputs.slopes);
                derivatives.in_time(system, at, slopes, order, &mut self.work);
            }
            self.derived = Derived::Time(order);
        }
        let derived = self.derived_value(
            quantity,
            |values, system, done| {
                let [input, lost] = values.power(system);
                [
                    Jet::new(done[0], input.re, input.v1),
                    Jet::new(done[1], lost.re, lost.v1),
                ]
            },
            state,
        );
        part(derived, order)
    }

    /// Prepares [`Self::change`] of outputs with inputs along a direction.
    pub(super) fn differentiate(&mut self, state: &State, inputs: &Inputs, direction: &[f64]) {
        self.prepare(state, inputs);
        let (system, plain) = (&self.assembled.system, &self.evaluation);
        if let Some(derivatives) = &mut self.derivatives {
            derivatives.by_inputs(system, plain, direction, &mut self.work);
        }
        self.derived = Derived::Inputs;
    }

    /// How an output changes with inputs along the direction given before.
    pub(super) fn change(&mut self, quantity: Quantity, state: &State) -> f64 {
        let sets_springs = self.sets_springs;
        let derived = self.derived_value(
            quantity,
            |values, system, done| {
                let none = Jet::from_re(0.0);
                let set = if sets_springs {
                    values.spring_energy(system)
                } else {
                    none
                };
                [set + done[0], Jet::from_re(done[1])]
            },
            state,
        );
        part(derived, 1)
    }

    /// Evaluates state and inputs anew: derivatives start from the scratch that this leaves behind.
    fn prepare(&mut self, state: &State, inputs: &Inputs) {
        self.forget();
        self.evaluate(Evaluated::Dynamics, state, inputs);
        if self.derivatives.is_none() {
            let derivatives = Derivatives::new(&self.assembled.system);
            self.derivatives = Some(Box::new(derivatives));
        }
    }

    /// An output with the derivatives at hand, given those of work.
    fn derived_value(
        &self,
        quantity: Quantity,
        work: impl Fn(&Evaluation<D, Jet>, &System<D>, [f64; 2]) -> [Jet; 2],
        state: &State,
    ) -> Jet {
        let Some(derivatives) = &self.derivatives else {
            return Jet::from_re(0.0);
        };
        let (values, assembled) = (&derivatives.values, &self.assembled);
        let work = match quantity {
            Quantity::Input | Quantity::Dissipated => work(values, &assembled.system, state.work),
            _ => [Jet::from_re(0.0); 2],
        };
        value(quantity, values, assembled, work)
    }

    fn evaluate(&mut self, needs: Evaluated, state: &State, inputs: &Inputs) {
        let system = &self.assembled.system;
        if needs >= Evaluated::Kinematics && self.evaluated < Evaluated::Kinematics {
            self.evaluation.set_inputs(&inputs.values, &inputs.slopes);
            self.evaluation.kinematics(system, state, &mut self.work);
            self.evaluated = Evaluated::Kinematics;
        }
        if needs > self.evaluated {
            let inputs = (&inputs.values[..], &inputs.slopes[..]);
            self.evaluation
                .dynamics_moving(system, state, inputs, &mut self.work);
            self.evaluated = needs;
        }
    }
}

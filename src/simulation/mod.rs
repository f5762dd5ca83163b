//! Floor 6. A simulation: a scene with its parameters and inputs, stepped from communication point to
//! communication point. What an FMU does, without FMI.

mod curves;
mod deformed;
mod derivatives;
mod dimension;
mod engine;
mod fast;
mod inputs;
mod mesh;
mod method;
mod modes;
mod once;
mod plan;
mod propeller;
mod quantities;
mod refusals;
mod shapes;
mod signals;
mod singular;
mod snapshot;
mod stop;
#[cfg(test)]
mod tests;
mod unfit;
mod unset_rates;
mod variables;
mod warnings;
mod watch;

pub use deformed::OverDeformed;
pub use dimension::check;
pub use fast::TooFast;
pub use mesh::Unresolved;
pub use modes::{FirstFrequencies, first_frequencies};
pub use plan::{
    Budget, Damped, Plan, Planned, PlannedBody, PlannedOutput, Price, Progress, RelativeTo,
    Settled, Settles, TrialConditions, courses, plan, plan_for,
};
pub use propeller::NoPropeller;
pub use quantities::Quantity;
pub use shapes::Pose;
pub use signals::{InputTable, SignalError, Signals};
pub use singular::{NEARLY, RedundantNames, Singular};
pub use snapshot::{Snapshot, Spectra};
pub use variables::{Causality, DrivePart, Parameter, Source, Unit, Variable, variables};
pub use watch::Doubtful;

use crate::scene::{Error as SceneError, Scene, finite_at};
use crate::system::State;
use dimension::AnyEngine;
use fast::FastFunctions;
use inputs::Inputs;
use plan::damp;
use unset_rates::UnsetRates;
use variables::{set_parameter, start_inputs};

/// Reason why an engine exists: initialization builds it, and states that are started or current come after that.
const ENGINE: &str = "a simulation that is started or current has an engine";

/// Error of a simulation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A parameter makes the scene invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Joints and motions that contradict each other, or bodies too far from fitting together.
    #[error("joints: {0}")]
    NotAssembled(String),
    /// No static equilibrium.
    #[error("initial: {0}")]
    Equilibrium(String),
    /// A rod or beam with elements that cannot hold how it is bent or twisted.
    #[error("initial: {0}")]
    ElementOverDeformed(String),
    /// No steady motion.
    #[error("initial: {0}")]
    Steady(#[from] crate::system::NotSteady),
    /// A winch that has paid out cable before the start.
    #[error("motions: {0}")]
    Begun(String),
    /// No natural frequencies or eigenvalues, or not so many.
    #[error("outputs: {0}")]
    Spectrum(String),
    /// A variable was asked for something that it is not, or set to something it cannot be.
    #[error("{name}: {message}")]
    Variable {
        /// Name of the variable, or its index where there is none.
        name: String,
        /// Expectation and finding, in words.
        message: String,
    },
    /// A snapshot of another simulation, or a broken one.
    #[error("state: {0}")]
    Snapshot(String),
}

/// Why a communication step was not finished.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}; the last good time is {time} s")]
pub struct StepFailure {
    /// Time of the last accepted sub-step, where the simulation now stands, s.
    pub time: f64,
    /// Reason of the failure, in words.
    pub reason: String,
}

/// Statistics of the last call of [`Simulation::step`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Name of the integrator.
    pub method: &'static str,
    /// Accepted sub-steps.
    pub steps: u64,
    /// Rejected sub-steps.
    pub rejected: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
    /// Work: operations, counted in accelerations, times parts of the system.
    pub work: f64,
}

/// A scene in simulation.
pub struct Simulation {
    /// As packaged.
    scene: Scene,
    variables: Vec<Variable>,
    /// Parameters and inputs, one per variable.
    values: Vec<f64>,
    inputs: Inputs,
    unset_rates: UnsetRates,
    fast: FastFunctions,
    /// First parts of the quaternions among the variables that a master sets.
    quaternions: Vec<usize>,
    /// A direction of the inputs.
    direction: Vec<f64>,
    engine: Option<AnyEngine>,
    state: State,
    spectra: Spectra,
    /// Initialization has ended: parameters are fixed.
    started: bool,
    /// The initial state belongs to the current parameters and inputs.
    current: bool,
    report: Report,
}

impl Default for Simulation {
    /// A simulation of nothing: it has no variables and cannot be initialized.
    fn default() -> Self {
        Self::with(Vec::new(), Scene::default())
    }
}

impl Simulation {
    /// A simulation of a valid scene, with its start values.
    ///
    /// # Panics
    /// When the scene is not valid ([`Scene::resolved`]).
    pub fn new(scene: Scene) -> Self {
        let scene = scene.plain();
        // Where that fails, initialization says why.
        let scene = damp(&scene).map_or(scene, |(damped, _)| damped);
        Self::with(variables(&scene), scene)
    }

    fn with(variables: Vec<Variable>, scene: Scene) -> Self {
        let values = variables.iter().map(|v| v.start.unwrap_or(0.0)).collect();
        let inputs = start_inputs(&variables);
        let is_first = |v: &Variable| {
            matches!(v.source, Source::Input(_)) && v.name.ends_with(".quaternion[1]")
        };
        let places = 0..variables.len();
        Self {
            quaternions: places
                .filter(|place| is_first(&variables[*place]))
                .collect(),
            direction: vec![0.0; inputs.len()],
            inputs: Inputs::at_rest(inputs),
            unset_rates: UnsetRates::new(&variables),
            fast: FastFunctions::default(),
            scene,
            variables,
            values,
            engine: None,
            state: State::default(),
            spectra: Spectra::default(),
            started: false,
            current: false,
            report: Report {
                method: "",
                steps: 0,
                rejected: 0,
                newton_iterations: 0,
                work: 0.0,
            },
        }
    }

    /// The scene as packaged.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The variables; an index into them is an FMI value reference.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let simulation = Simulation::new(scene.clone());
    /// let mass = &simulation.variables()[place("stone.mass")];
    /// assert_eq!(mass.start, Some(2.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// Current value of a parameter or an input; 0 of all else.
    pub fn setting(&self, index: usize) -> f64 {
        self.values.get(index).copied().unwrap_or(0.0)
    }

    /// Current time, s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Returns the statistics of the last step.
    pub fn report(&self) -> Report {
        self.report
    }

    /// The size of the scene, m, and what computed variables are where it moves by its nature; 0 of what is not measured
    /// by that.
    fn natural(&self) -> (f64, Vec<f64>) {
        let Some(engine) = &self.engine else {
            return (0.0, Vec::new());
        };
        let computed = self
            .variables
            .iter()
            .filter(|variable| variable.is_computed());
        let natural = computed.map(|variable| self.natural_size(variable));
        (engine.size(), natural.collect())
    }

    /// Size of a variable where the scene moves at its natural rate, in the unit of the variable; 0 of a variable that is not compared
    /// with that, and before initialization.
    pub fn natural_size(&self, variable: &Variable) -> f64 {
        match (&self.engine, variable.source) {
            (Some(engine), Source::Output(quantity)) => engine.natural(quantity).unwrap_or(0.0),
            _ => 0.0,
        }
    }

    /// Sets a real parameter or an input.
    ///
    /// # Errors
    /// Not settable, not real, not finite, out of range; nothing has changed then.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// simulation.set_real(place("stone.mass"), 4.0)?;
    /// assert!(simulation.set_real(place("stone.mass"), -1.0).is_err());
    /// assert_eq!(simulation.setting(place("stone.mass")), 4.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_real(&mut self, index: usize, value: f64) -> Result<(), Error> {
        if self.variable(index)?.is_integer() {
            return Err(self.refuse(index, "expected a call for integers, found one for reals"));
        }
        self.set(index, value)
    }

    /// Sets an integer parameter.
    ///
    /// # Errors
    /// As [`Self::set_real`].
    pub fn set_integer(&mut self, index: usize, value: i32) -> Result<(), Error> {
        if !self.variable(index)?.is_integer() {
            return Err(self.refuse(index, "expected a call for reals, found one for integers"));
        }
        self.set(index, f64::from(value))
    }

    /// Bounds the relative tolerance by that of a master: the tighter one of both holds. A tolerance of 0 is none. The one that holds
    /// already, where the master's is looser.
    ///
    /// # Errors
    /// Out of range, or initialization has ended.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// assert_eq!(simulation.limit_tolerance(1e-4)?, Some(1e-6));
    /// assert_eq!(simulation.limit_tolerance(1e-8)?, None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn limit_tolerance(&mut self, value: f64) -> Result<Option<f64>, Error> {
        let tolerance = Source::Parameter(Parameter::RelativeTolerance);
        let index = self.variables.iter().position(|v| v.source == tolerance);
        let Some(index) = index.filter(|_| value != 0.0) else {
            return Ok(None);
        };
        let (before, current) = (self.values[index], self.current);
        self.set(index, value)?;
        if value <= before {
            return Ok(None);
        }
        (self.values[index], self.current) = (before, current);
        Ok(Some(before))
    }

    /// Value of a real variable now. Before the end of initialization it computes the initial state
    /// anew where parameters or inputs have changed.
    ///
    /// # Errors
    /// Not real, not finite, or the initial state cannot be computed.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// simulation.step(1.0)?;
    /// // A force of 4 N moves 2 kg by 1 m in a second.
    /// assert!((simulation.real(place("stone.centre.position[1]"))? - 1.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn real(&mut self, index: usize) -> Result<f64, Error> {
        if self.variable(index)?.is_integer() {
            return Err(self.refuse(index, "expected a call for integers, found one for reals"));
        }
        match self.variables[index].source {
            Source::Time => Ok(self.state.time),
            Source::Parameter(_) | Source::Input(..) => Ok(self.values[index]),
            Source::NaturalFrequency(number) => {
                self.refresh()?;
                self.finite(index, self.spectra.frequencies[number])
            }
            Source::Eigenvalue(number, part) => {
                self.refresh()?;
                self.finite(index, self.spectra.eigenvalues[number][part])
            }
            Source::Output(quantity) => {
                self.refresh()?;
                let engine = self.engine.as_mut().expect(ENGINE);
                let value = engine.output(quantity, &self.state, &self.inputs);
                self.finite(index, value)
            }
        }
    }

    /// Value of an integer variable.
    ///
    /// # Errors
    /// Not an integer.
    pub fn integer(&self, index: usize) -> Result<i32, Error> {
        if !self.variable(index)?.is_integer() {
            return Err(self.refuse(index, "expected a call for reals, found one for integers"));
        }
        Ok(self.values[index] as i32)
    }

    /// Builds the system from the current parameters and computes the initial state. May be called
    /// again until [`Self::start`].
    ///
    /// # Errors
    /// Parameters that make no valid scene, no static equilibrium.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// simulation.initialize(0.0)?;
    /// assert_eq!(simulation.real(place("stone.centre.velocity[1]"))?, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn initialize(&mut self, start_time: f64) -> Result<(), Error> {
        if self.scene.is_to_be_planned() {
            let message = "expected numbers of elements and a relative_tolerance, found some that are left to the \
                           planner: `flexbody plan` finds them";
            return Err(Error::Scene(SceneError::new("scene", message)));
        }
        if self.scene.has_ratios() {
            damp(&self.scene)?;
        }
        self.check_quaternions()?;
        let scene = self.parametrized();
        let resolved = scene.resolve()?;
        let timed = scene.timed();
        finite_at(&timed, start_time)?;
        let mut engine = AnyEngine::new(&resolved, &self.variables)?;
        let (state, spectra) = engine.initial_state(start_time, &self.inputs)?;
        (self.engine, self.state, self.spectra) = (Some(engine), state, spectra);
        self.fast = FastFunctions::new(timed);
        self.current = true;
        Ok(())
    }

    /// Ends initialization: from now on parameters are fixed and inputs act on the motion only.
    ///
    /// # Errors
    /// As [`Self::initialize`], where something changed since.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// simulation.start()?;
    /// assert!(simulation.set_real(place("stone.mass"), 4.0).is_err());
    /// simulation.set_real(place("stone.centre.force[1]"), 8.0)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn start(&mut self) -> Result<(), Error> {
        self.refresh()?;
        self.started = true;
        Ok(())
    }

    /// Advances to `until`; inputs move as their derivatives say, where those were set since the last
    /// step, and are held otherwise. Allocates nothing unless it fails.
    ///
    /// # Errors
    /// When the tolerance cannot be met; the simulation then stands at the last accepted sub-step.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// for point in 1..=10 {
    ///     simulation.step(0.1 * f64::from(point))?;
    /// }
    /// assert!((simulation.real(place("stone.centre.velocity[1]"))? - 2.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step(&mut self, until: f64) -> Result<(), StepFailure> {
        if !self.started {
            self.start().map_err(|error| StepFailure {
                time: self.state.time,
                reason: error.to_string(),
            })?;
        }
        self.check_quaternions().map_err(|error| StepFailure {
            time: self.state.time,
            reason: error.to_string(),
        })?;
        let time = self.state.time;
        if let Some(reason) = self.fast.refusal(time, until) {
            return Err(StepFailure { time, reason });
        }
        let (moves, is_held) = self.inputs.begin_step();
        self.unset_rates.begin_step();
        self.state.dense.begin_point(is_held);
        self.fast.begin_step(until - time);
        let engine = self.engine.as_mut().expect(ENGINE);
        let (report, result) = engine.step(&mut self.state, &mut self.inputs, until);
        if moves {
            for (variable, value) in self.variables.iter().zip(&mut self.values) {
                if let Source::Input(place) = variable.source {
                    *value = self.inputs.values[place];
                }
            }
        }
        self.report = report;
        result
    }

    /// Whether the initial state belongs to the current parameters and inputs.
    pub fn is_current(&self) -> bool {
        self.current
    }

    /// Declares that parameters and inputs are again those that the initial state was computed with. Without an initial
    /// state nothing happens.
    pub fn mark_current(&mut self) {
        self.current = self.engine.is_some();
    }

    fn refresh(&mut self) -> Result<(), Error> {
        if self.started || self.current {
            return Ok(());
        }
        self.initialize(self.state.time)
    }

    fn set(&mut self, index: usize, value: f64) -> Result<(), Error> {
        if !value.is_finite() {
            return Err(self.refuse(index, &format!("expected a finite number, found {value}")));
        }
        let before = self.values[index];
        match self.variables[index].source {
            Source::Input(place) => {
                self.inputs.drop_slopes();
                self.unset_rates.set(index, self.started && value != before);
                self.values[index] = value;
                self.inputs.values[place] = value;
                if let Some(engine) = &mut self.engine {
                    engine.inputs_changed(&self.inputs);
                }
            }
            Source::Parameter(_) if self.started => {
                return Err(self.refuse(index, "parameters may be set until initialization ends"));
            }
            Source::Parameter(parameter) if self.is_bound_by_others(parameter) => {
                if value < 0.0 {
                    let message = format!("expected zero or a positive number, found {value}");
                    return Err(self.refuse(index, &message));
                }
                self.values[index] = value;
            }
            Source::Parameter(_) => {
                self.values[index] = value;
                let scene = self.parametrized_but(|parameter| self.is_bound_by_others(parameter));
                if let Err(error) = scene.resolve() {
                    self.values[index] = before;
                    return Err(self.refuse(index, &error.message));
                }
            }
            _ => return Err(self.refuse(index, "expected a parameter or an input")),
        }
        if value != before && !self.started {
            self.current = false;
        }
        Ok(())
    }

    /// The scene with the current parameters, to be resolved: their values may make it invalid.
    fn parametrized(&self) -> Scene {
        self.parametrized_but(|_| false)
    }

    /// Whether a parameter bounds others: a moment of inertia in space, a length of a cross section or of a rigid body's shape, a
    /// stiffness of a rod that couples twist and bending. They are set one after another and checked together when initialization computes the state.
    fn is_bound_by_others(&self, parameter: Parameter) -> bool {
        match parameter {
            Parameter::Inertia(..) => self.scene.dimension == 3,
            Parameter::SectionLength(..) | Parameter::SolidLength(..) => true,
            Parameter::YoungsModulus(id)
            | Parameter::ShearModulus(id)
            | Parameter::SecondMoments(id, _)
            | Parameter::TorsionConstant(id) => self.scene.cable(id).is_coupled(),
            _ => false,
        }
    }

    /// Returns the scene with the current parameters, except those for which `is_left` is true.
    fn parametrized_but(&self, is_left: impl Fn(Parameter) -> bool) -> Scene {
        let mut scene = self.scene.clone();
        for (variable, value) in self.variables.iter().zip(&self.values) {
            let Source::Parameter(parameter) = variable.source else {
                continue;
            };
            if !is_left(parameter) {
                set_parameter(&mut scene, parameter, *value);
            }
        }
        scene
    }

    fn collect_inputs(&mut self) {
        for (variable, value) in self.variables.iter().zip(&self.values) {
            if let Source::Input(place) = variable.source {
                self.inputs.values[place] = *value;
            }
        }
    }
}

//! An instance of the unit: what the functions of a standard do, in safe code.

use std::any::Any;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, UnwindSafe, catch_unwind};
use std::sync::Arc;

use super::guid::guid;
use super::lifecycle::{Call, InstanceState};
use super::logger::{Category, Logger};
use super::names::Names;
use super::state::SavedState;
use super::status::{Fault, Status};
use crate::scene::{Scene, remarks};
use crate::simulation::{self, NEARLY, Simulation};

/// Relative difference up to which two times are the same; masters add up their time in many ways.
const SAME_TIME: f64 = 1e-5;

/// The library, for who reads a log.
const LIBRARY: &str = concat!(
    "flexbody ",
    env!("CARGO_PKG_VERSION"),
    " for ",
    env!("FLEXBODY_PLATFORM")
);

/// One simulated scene in the hands of a master.
pub struct Instance {
    pub(super) names: &'static Names,
    pub(super) logger: Logger,
    pub(super) simulation: Simulation,
    pub(super) state: InstanceState,
    /// Values of the variables of the last set call before that call.
    pub(super) before: Vec<f64>,
    guid: String,
    /// The scene, JSON.
    scene: Arc<str>,
    start_time: f64,
    stop_time: Option<f64>,
    /// Whether it was told that a master's tolerance is looser than the one that holds.
    told_looser: bool,
}

/// Instances move between the threads of a master.
const _: () = {
    const fn may_move_between_threads<T: Send>() {}
    may_move_between_threads::<Instance>();
};

impl Instance {
    /// An instance of the simulation that `open` finds, or of one that a saved state will bring. A refusal is
    /// logged even when logging is off.
    pub fn instantiate<E: Display>(
        names: &'static Names,
        token: &str,
        logger: Logger,
        open: impl FnOnce() -> Result<Option<Simulation>, E> + UnwindSafe,
    ) -> Option<Self> {
        let reason = match catch_unwind(open) {
            Ok(Ok(simulation)) => return Some(Self::new(names, token, logger, simulation)),
            Ok(Err(refusal)) => refusal.to_string(),
            Err(panic) => format!("defect of the library: {}", words(&*panic)),
        };
        let message = format_args!("{}: {reason}", names.instantiate);
        logger.report(Status::Error, Category::Error, message);
        None
    }

    fn new(
        names: &'static Names,
        token: &str,
        logger: Logger,
        simulation: Option<Simulation>,
    ) -> Self {
        let state = match &simulation {
            Some(simulation) => {
                let name = &simulation.scene().name;
                let message = format_args!("instantiated \"{name}\" by {LIBRARY}");
                logger.log(Status::Ok, Category::Events, message);
                let scene = simulation.scene();
                for remark in remarks(scene).iter().chain(&scene.accuracy.notes) {
                    logger.log(Status::Warning, Category::Warning, format_args!("{remark}"));
                }
                InstanceState::Instantiated
            }
            None => {
                let message =
                    format_args!("instantiated without resources: expecting a saved state");
                logger.log(Status::Ok, Category::Warning, message);
                InstanceState::Bare
            }
        };
        let simulation = simulation.unwrap_or_default();
        // A set call names few variables twice: it allocates nothing.
        let before = Vec::with_capacity(simulation.variables().len());
        Self {
            names,
            logger,
            scene: simulation.scene().to_json().into(),
            simulation,
            state,
            before,
            guid: token.into(),
            start_time: 0.0,
            stop_time: None,
            told_looser: false,
        }
    }

    /// The guard around every function: lifecycle, then the panic boundary.
    pub fn call(
        &mut self,
        call: Call,
        body: impl FnOnce(&mut Self) -> Result<(), Fault>,
    ) -> Status {
        if self.state == InstanceState::Fatal {
            return Status::Fatal;
        }
        let name = call.name;
        if !call.allowed_in(self.state) {
            let state = (self.names.state)(self.state);
            let message = format_args!("{name}: not allowed in state {state}");
            self.logger.log(Status::Error, Category::Error, message);
            return Status::Error;
        }
        match catch_unwind(AssertUnwindSafe(|| body(self))) {
            Ok(Ok(())) => Status::Ok,
            Ok(Err(fault)) => {
                self.logger.fault(name, &fault);
                fault.status()
            }
            Err(panic) => {
                // Nothing is known about the simulation any more.
                self.state = InstanceState::Fatal;
                let message = format_args!("{name}: defect of the library: {}", words(&*panic));
                self.logger.log(Status::Fatal, Category::Error, message);
                Status::Fatal
            }
        }
    }

    /// Stores tolerance, start time and stop time of the run.
    ///
    /// # Errors
    /// A time that is not finite, a stop time before the start time, or a tolerance out of range.
    pub fn set_up_experiment(
        &mut self,
        tolerance: Option<f64>,
        start_time: f64,
        stop_time: Option<f64>,
    ) -> Result<(), Fault> {
        finite("startTime", start_time)?;
        if let Some(found) = stop_time
            && !(found.is_finite() && found > start_time)
        {
            let expected = "a finite number greater than startTime";
            return Err(Fault::Argument {
                name: "stopTime",
                expected,
                found,
            });
        }
        if let Some(tolerance) = tolerance {
            let holds = self.simulation.limit_tolerance(tolerance)?;
            self.log_looser(tolerance, holds);
        }
        self.start_time = start_time;
        self.stop_time = stop_time;
        Ok(())
    }

    /// Tells once that a master's tolerance is looser than the one that holds.
    fn log_looser(&mut self, asked: f64, holds: Option<f64>) {
        let Some(holds) = holds.filter(|_| !self.told_looser) else {
            return;
        };
        self.told_looser = true;
        let experiment = self.names.experiment;
        let message = format_args!(
            "{experiment}: expected a tolerance of at most {holds:e}, that of the scene, found {asked:e}: {holds:e} holds; \
             the parameter relative_tolerance takes a looser one"
        );
        self.logger.log(Status::Warning, Category::Warning, message);
    }

    /// Builds the system and makes its values available.
    ///
    /// # Errors
    /// The scene cannot be simulated.
    pub fn enter_initialization_mode(&mut self) -> Result<(), Fault> {
        let outcome = self.simulation.initialize(self.start_time);
        self.passed_on(outcome, InstanceState::Initialization)
    }

    /// Computes the initial state at the first communication point.
    ///
    /// # Errors
    /// There is no initial state. An equilibrium that is not stable is reported as [`Fault::Remark`].
    pub fn exit_initialization_mode(&mut self) -> Result<(), Fault> {
        let outcome = self.simulation.start();
        self.passed_on(outcome, InstanceState::StepComplete)?;
        let time = self.simulation.time();
        self.log_event(format_args!("initialized at time {time} s"));
        self.log_redundant();
        if let Some(gaps) = self.simulation.initial_gaps() {
            let message = format_args!(
                "bodies were moved to close joints that are far apart as described: {gaps}"
            );
            self.logger.log(Status::Ok, Category::Warning, message);
        }
        if self.simulation.is_unstable() {
            Err(Fault::Remark(
                "the simulation starts from an equilibrium that is not stable, and no stable one was found beside it",
            ))
        } else {
            Ok(())
        }
    }

    /// Tells of what holds what others hold already, and of what nearly does.
    fn log_redundant(&mut self) {
        let redundant = self.simulation.redundant();
        let names = redundant.exactly.join(", ");
        if !names.is_empty() {
            let message = format_args!("joints that hold what others hold already: {names}");
            self.logger.log(Status::Ok, Category::Warning, message);
        }
        let names = redundant.nearly.join(", ");
        if !names.is_empty() {
            let message =
                format_args!("joints that nearly hold what others hold already: {names}; {NEARLY}");
            self.logger.log(Status::Warning, Category::Warning, message);
        }
    }

    /// Moves to the next state after a computation, or to the error state if it failed.
    fn passed_on(
        &mut self,
        outcome: Result<(), simulation::Error>,
        next: InstanceState,
    ) -> Result<(), Fault> {
        self.state = if outcome.is_ok() {
            next
        } else {
            InstanceState::Error
        };
        outcome.map_err(Fault::from)
    }

    /// Ends the run.
    ///
    /// # Errors
    /// None: termination always succeeds.
    pub fn terminate(&mut self) -> Result<(), Fault> {
        self.state = InstanceState::Terminated;
        let time = self.simulation.time();
        self.log_event(format_args!("terminated at time {time} s"));
        Ok(())
    }

    /// Starts again as a new instance.
    ///
    /// # Errors
    /// None: a reset always succeeds.
    pub fn reset(&mut self) -> Result<(), Fault> {
        self.simulation = Simulation::new(self.simulation.scene().clone());
        self.state = InstanceState::Instantiated;
        self.start_time = 0.0;
        self.stop_time = None;
        self.log_event(format_args!("reset"));
        Ok(())
    }

    /// Advances to the next communication point.
    ///
    /// # Errors
    /// A communication point other than the current time, a step that is not positive or passes the stop time, or a
    /// step that the integrator cannot finish.
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<(), Fault> {
        let until = self.end_of_step(current, step)?;
        let outcome = self.simulation.step(until);
        let report = self.simulation.report();
        let message = format_args!(
            "to time {} s: {}, {} steps, {} rejected, {} Newton iterations",
            self.simulation.time(),
            report.method,
            report.steps,
            report.rejected,
            report.newton_iterations
        );
        self.logger.log(Status::Ok, Category::Solver, message);
        let logger = &self.logger;
        self.simulation
            .tell_warnings(|message| logger.log(Status::Warning, Category::Warning, message));
        outcome.map_err(|failure| {
            self.state = InstanceState::StepFailed;
            failure.into()
        })
    }

    /// The time that a step leads to, if the step may be done.
    fn end_of_step(&self, current: f64, step: f64) -> Result<f64, Fault> {
        finite("currentCommunicationPoint", current)?;
        if !(step.is_finite() && step > 0.0) {
            let expected = "a finite number greater than zero";
            return Err(Fault::Argument {
                name: "communicationStepSize",
                expected,
                found: step,
            });
        }
        let now = self.simulation.time();
        let until = current + step;
        if !same_time(current, now, step) {
            return Err(Fault::CommunicationPoint {
                expected: now,
                found: current,
            });
        }
        if !until.is_finite() || until <= now {
            let expected = "a step that moves the time on";
            return Err(Fault::Argument {
                name: "communicationStepSize",
                expected,
                found: step,
            });
        }
        match self.stop_time {
            Some(stop) if until > stop && !same_time(until, stop, step) => {
                let experiment = self.names.experiment;
                Err(Fault::StopTime {
                    until,
                    stop,
                    experiment,
                })
            }
            _ => Ok(until),
        }
    }

    /// Where the last step ended.
    pub fn last_successful_time(&self) -> f64 {
        self.simulation.time()
    }

    /// All that the instance is.
    pub fn save(&self) -> SavedState {
        SavedState {
            guid: self.guid.clone(),
            scene: self.scene.clone(),
            lifecycle: self.state,
            start_time: self.start_time,
            stop_time: self.stop_time,
            snapshot: self.simulation.snapshot(),
        }
    }

    /// Restores a saved state.
    ///
    /// # Errors
    /// [`Fault::SavedState`] for a state of another model or of other variables.
    pub fn restore(&mut self, saved: &SavedState) -> Result<(), Fault> {
        if saved.guid != self.guid {
            let reason = format!(
                "expected one of the model {}, found {}",
                self.guid, saved.guid
            );
            return Err(Fault::SavedState(reason));
        }
        let refused = |error: simulation::Error| Fault::SavedState(error.to_string());
        if self.state == InstanceState::Bare {
            let mut simulation = self.simulation_of(saved)?;
            simulation.restore(&saved.snapshot).map_err(refused)?;
            self.scene = saved.scene.clone();
            self.simulation = simulation;
        } else {
            self.simulation.restore(&saved.snapshot).map_err(refused)?;
        }
        self.state = saved.lifecycle;
        self.start_time = saved.start_time;
        self.stop_time = saved.stop_time;
        let time = self.simulation.time();
        self.log_event(format_args!("state of time {time} s restored"));
        Ok(())
    }

    /// The simulation that a state brings along.
    fn simulation_of(&self, saved: &SavedState) -> Result<Simulation, Fault> {
        let scene = Scene::from_json(&saved.scene);
        let scene = scene.map_err(|error| Fault::SavedState(error.to_string()))?;
        let simulation = Simulation::new(scene);
        let found = guid(simulation.scene(), simulation.variables());
        if found != self.guid {
            let reason = format!("expected a scene of the model {}, found {found}", self.guid);
            return Err(Fault::SavedState(reason));
        }
        Ok(simulation)
    }

    /// Reads a saved state from its bytes.
    ///
    /// # Errors
    /// [`Fault::SavedState`] for bytes that are no state of this model.
    pub fn deserialize(&self, bytes: &[u8]) -> Result<SavedState, Fault> {
        SavedState::from_bytes(bytes, &self.guid)
    }

    /// Selects the categories that are logged.
    ///
    /// # Errors
    /// A category that does not exist, or an error of `categories`.
    pub fn set_debug_logging<'a>(
        &mut self,
        on: bool,
        categories: impl Iterator<Item = Result<&'a str, Fault>>,
    ) -> Result<(), Fault> {
        self.logger.enable(on, categories)
    }

    fn log_event(&self, message: std::fmt::Arguments<'_>) {
        self.logger.log(Status::Ok, Category::Events, message);
    }
}

fn finite(name: &'static str, found: f64) -> Result<(), Fault> {
    if found.is_finite() {
        return Ok(());
    }
    Err(Fault::Argument {
        name,
        expected: "a finite number",
        found,
    })
}

/// Whether two times are the same but for rounding. Half a step is the most that may be forgiven:
/// in a long run with short steps the relative difference alone would skip whole steps.
fn same_time(a: f64, b: f64, step: f64) -> bool {
    let scale = a.abs().max(b.abs()).max(step);
    (a - b).abs() <= (SAME_TIME * scale).min(0.5 * step)
}

fn words(panic: &(dyn Any + Send)) -> &str {
    let owned = panic.downcast_ref::<String>().map(String::as_str);
    owned
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use super::*;

    static NAMES: Names = Names {
        instantiate: "instantiate",
        token: "token",
        experiment: "experiment",
        seeds: "seeds",
        real: "real",
        integer: "integer",
        state: |_| "state",
    };

    #[test]
    fn after_a_panic_the_instance_answers_fatal_for_ever() {
        let simulation = Simulation::new(crate::scene::example());
        let logger = Logger::new(None, false);
        let mut instance = Instance::new(&NAMES, "{0}", logger, Some(simulation));
        let call = |states| Call {
            name: "call",
            states,
        };
        let panicked = instance.call(call(InstanceState::Instantiated as u8), |_| {
            panic!("planted")
        });
        assert_eq!(panicked, Status::Fatal);
        for states in 0..=u8::MAX {
            let answer = instance.call(call(states), |_| {
                unreachable!("the body of a poisoned call")
            });
            assert_eq!(answer, Status::Fatal, "{states}");
        }
    }

    #[test]
    fn times_are_compared_with_a_relative_tolerance() {
        assert!(same_time(0.1 + 0.2, 0.3, 0.1));
        assert!(same_time(1e-17, 0.0, 1e-3));
        assert!(same_time(1000.0, 1_000.000_001, 1e-3));
        assert!(!same_time(1000.0, 1000.001, 1e-3));
        assert!(!same_time(0.0, 0.01, 0.01));
        assert!(!same_time(1.0, 1.1, 0.1));
    }
}

//! Snapshots: what a simulation needs to go on from a point in time.

use super::dimension::AnyEngine;
use super::fast::FastFunctions;
use super::{Error, Simulation, Source, Variable};
use crate::system::State;

/// Everything that a simulation needs to go on from a point in time, as plain numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Current parameters and inputs, one number per variable; 0 for all others.
    pub values: Vec<f64>,
    /// Whether the initial state has been computed.
    pub initialized: bool,
    /// Whether initialization has ended.
    pub started: bool,
    /// Whether the inputs' derivatives below move them in the next step; else they are those of the
    /// last one.
    pub moving: bool,
    /// First and second derivatives of the inputs, in the order of the system.
    pub slopes: Vec<[f64; 2]>,
    /// Values of the inputs at the beginning of the last step, in the same order.
    pub held: Vec<f64>,
    /// Natural frequencies and eigenvalues about the initial state.
    pub spectra: Spectra,
    /// State of the system.
    pub state: State,
}

/// Natural frequencies and eigenvalues about the initial state. They are computed once, and are empty before.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectra {
    /// Natural frequencies, rad/s.
    pub frequencies: Vec<f64>,
    /// Decay rates, 1/s, and frequencies, rad/s, of eigenvalues.
    pub eigenvalues: Vec<[f64; 2]>,
}

impl Spectra {
    /// Numbers of natural frequencies and of eigenvalues among variables.
    pub(super) fn wanted(variables: &[Variable]) -> [usize; 2] {
        variables
            .iter()
            .fold([0, 0], |[natural, damped], variable| {
                match variable.source {
                    Source::NaturalFrequency(number) => [natural.max(number + 1), damped],
                    Source::Eigenvalue(number, _) => [natural, damped.max(number + 1)],
                    _ => [natural, damped],
                }
            })
    }
}

impl Simulation {
    /// A copy of everything that changes.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            values: self.values.clone(),
            initialized: self.engine.is_some() && self.current,
            started: self.started,
            moving: self.inputs.moving,
            slopes: self.inputs.slopes.clone(),
            held: self.inputs.held.clone(),
            spectra: self.spectra.clone(),
            state: self.state.clone(),
        }
    }

    /// Goes back to a snapshot of a simulation of the same scene.
    ///
    /// # Errors
    /// A snapshot with other sizes, with parameters out of range or with numbers that are not finite;
    /// nothing has changed then.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// simulation.start()?;
    /// let before = simulation.snapshot();
    /// simulation.step(1.0)?;
    /// simulation.restore(&before)?;
    /// assert_eq!(simulation.time(), 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        check_numbers(snapshot)?;
        if snapshot.started && !snapshot.initialized {
            return Err(Error::Snapshot(
                "expected an initial state before the start".into(),
            ));
        }
        let inputs = self.inputs.values.len();
        let sizes = |[values, slopes, held]: [usize; 3]| {
            format!("{values} variables, {slopes} derivatives of inputs, {held} inputs")
        };
        let expected = sizes([self.variables.len(), inputs, inputs]);
        let Snapshot {
            values,
            slopes,
            held,
            ..
        } = snapshot;
        let found = sizes([values.len(), slopes.len(), held.len()]);
        if found != expected {
            let message = format!("expected {expected}, found {found}");
            return Err(Error::Snapshot(message));
        }
        let spectra = &snapshot.spectra;
        let found = [spectra.frequencies.len(), spectra.eigenvalues.len()];
        let wanted = Spectra::wanted(&self.variables);
        if found != wanted && (snapshot.initialized || found != [0, 0]) {
            let words = |[a, b]: [usize; 2]| format!("{a} natural frequencies, {b} eigenvalues");
            let message = format!("expected {}, found {}", words(wanted), words(found));
            return Err(Error::Snapshot(message));
        }
        let before = std::mem::replace(&mut self.values, snapshot.values.clone());
        match self.engine_for(snapshot, &before) {
            Ok(rebuilt) => {
                if let Some(engine) = rebuilt {
                    self.engine = Some(engine);
                    self.fast = FastFunctions::new(self.parametrized().timed());
                }
            }
            Err(error) => {
                self.values = before;
                return Err(error);
            }
        }
        self.collect_inputs();
        self.inputs.slopes.clone_from(&snapshot.slopes);
        self.inputs.held.clone_from(&snapshot.held);
        self.inputs.moving = snapshot.moving;
        self.state.clone_from(&snapshot.state);
        self.spectra.clone_from(&snapshot.spectra);
        self.started = snapshot.started;
        self.current = snapshot.initialized;
        if let Some(engine) = &mut self.engine {
            engine.forget();
        }
        Ok(())
    }

    /// The engine that a snapshot needs, where the present one has other parameters.
    fn engine_for(&self, snapshot: &Snapshot, before: &[f64]) -> Result<Option<AnyEngine>, Error> {
        if !snapshot.initialized {
            self.parametrized().resolve()?;
            return Ok(None);
        }
        let is_parameter = |v: &Variable| matches!(v.source, Source::Parameter(_));
        let same = (self.variables.iter().zip(before.iter().zip(&self.values)))
            .all(|(variable, (a, b))| !is_parameter(variable) || a == b);
        let rebuilt = match &self.engine {
            Some(_) if same && self.current => None,
            _ => Some(AnyEngine::new(
                &self.parametrized().resolve()?,
                &self.variables,
            )?),
        };
        let engine = rebuilt.as_ref().or(self.engine.as_ref());
        let found = &snapshot.state;
        if engine.is_some_and(|engine| !engine.fits(found)) {
            return Err(Error::Snapshot(format!(
                "expected a state of this scene, found sizes {:?}",
                found.sizes()
            )));
        }
        Ok(rebuilt)
    }
}

/// Numbers that are finite, and a time within the step under way.
fn check_numbers(snapshot: &Snapshot) -> Result<(), Error> {
    let state = &snapshot.state;
    let numbers = [
        &snapshot.values,
        &snapshot.spectra.frequencies,
        snapshot.spectra.eigenvalues.as_flattened(),
        &state.coordinates,
        &state.rates,
        state.frames.as_flattened(),
        &state.angles,
        &state.travel,
        &state.released,
        state.driven.as_flattened(),
        snapshot.slopes.as_flattened(),
        &snapshot.held,
        &[state.time, state.step],
        &state.pace.numbers(),
        &state.work,
        &state.dense.numbers(),
        &state.dense.vectors,
    ];
    if !numbers.into_iter().flatten().all(|x| x.is_finite()) {
        return Err(Error::Snapshot("expected finite numbers".into()));
    }
    let step = &state.dense;
    if step.is_under_way() && !(step.start..step.end()).contains(&state.time) {
        let (from, to, time) = (step.start, step.end(), state.time);
        let message =
            format!("expected a time within its step from {from} to {to} s, found {time} s");
        return Err(Error::Snapshot(message));
    }
    Ok(())
}

//! What the rows are made with: the product as a master sees it, methods at fixed steps, and plain Newton.

use std::sync::{Arc, Mutex};

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance};
use flexbody::scene::Scene;
use flexbody::simulation::{Simulation, StepFailure};
use flexbody::system::{DrivenSystem, Dynamics, Evaluation, State, StepOutcome, Workspace};
use nalgebra::{DMatrix, DVector};
use serde_json::Value;

use crate::integrators::{Build, Probe, build};
use crate::scene::{Outcome, Start};

/// Something measured: the number that a test holds to its limit, and what the table says.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The number; tests alone read it.
    #[cfg_attr(not(test), expect(dead_code))]
    pub value: f64,
    /// Words with it.
    pub text: String,
}

/// A figure.
pub fn figure(value: f64, text: impl Into<String>) -> Figure {
    Figure {
        value,
        text: text.into(),
    }
}

/// A number in a sentence: two digits.
pub fn short(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (0.01..1e4).contains(&size) => {
            let digits = (1 - size.log10().floor() as i32).clamp(0, 4) as usize;
            format!("{x:.digits$}")
        }
        _ => format!("{x:.1e}"),
    }
}

/// One row of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// Where methods fail.
    pub place: &'static str,
    /// The method that fails, and its setting.
    pub method: String,
    /// Figure of the failing method.
    pub failing: Figure,
    /// Figure of the product.
    pub product: Figure,
    /// The test that holds both.
    pub test: &'static str,
}

/// A scene of the cases or one written here.
pub fn json(text: &str) -> Outcome<Value> {
    serde_json::from_str(text).map_err(|error| error.to_string())
}

/// A scene ready for methods of the studies.
pub fn start(scene: &Value) -> Outcome<Start> {
    Start::new(Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())?)
}

/// The product, as a master uses it.
pub struct Product(pub Simulation);

impl Product {
    /// After initialization.
    pub fn start(scene: &Value) -> Outcome<Self> {
        Self::of(Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())?)
    }

    /// After initialization, of a scene that is read.
    pub fn of(scene: Scene) -> Outcome<Self> {
        let mut product = Self(Simulation::new(scene));
        let started = product.0.initialize(0.0).and_then(|()| product.0.start());
        started.map_err(|error| error.to_string())?;
        Ok(product)
    }

    fn index(&self, name: &str) -> Outcome<usize> {
        let found = self.0.variables().iter().position(|v| v.name == name);
        found.ok_or_else(|| format!("{name}: expected a variable"))
    }

    /// Value of an output.
    pub fn get(&mut self, name: &str) -> Outcome<f64> {
        let index = self.index(name)?;
        self.0.real(index).map_err(|error| error.to_string())
    }

    /// Both coordinates of a marker, m.
    pub fn position(&mut self, marker: &str) -> Outcome<[f64; 2]> {
        let axis = |k: u32| format!("{marker}.position[{k}]");
        Ok([self.get(&axis(1))?, self.get(&axis(2))?])
    }

    /// Sets an input.
    pub fn set(&mut self, name: &str, value: f64) -> Outcome<()> {
        let index = self.index(name)?;
        self.0.set_real(index, value).map_err(|e| e.to_string())
    }

    /// Advances to `until`, s.
    ///
    /// # Errors
    /// A step that cannot be finished.
    pub fn step(&mut self, until: f64) -> Result<(), StepFailure> {
        self.0.step(until)
    }

    /// Energy less the work that came in plus what was dissipated, J: constant. For scenes with the
    /// outputs `energy` and `work`.
    pub fn balance(&mut self) -> Outcome<f64> {
        let mut sum = -self.get("energy.input")? + self.get("energy.dissipated")?;
        for part in ["kinetic", "strain", "gravity"] {
            sum += self.get(&format!("energy.{part}"))?;
        }
        Ok(sum)
    }
}

/// Treatment of a state after a step of a method.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum After {
    /// Projection as in the product.
    All,
    /// Dependent coordinates follow, chosen once at the start.
    Dependent,
    /// Nothing.
    Nothing,
}

/// A method of the studies by its name.
pub fn named(start: &Start, name: &str) -> Outcome<Box<dyn OneStepMethod>> {
    let nodes = Arc::new(Mutex::new(start.assembled.nodes.clone()));
    let build_for = Build {
        start,
        nodes,
        fixed: true,
    };
    build(name, &build_for)
}

/// A method at fixed steps.
pub struct March<'a> {
    /// Scene at its start.
    pub start: &'a Start,
    /// The method.
    pub method: Box<dyn OneStepMethod>,
    /// Step and end, s.
    pub times: [f64; 2],
    /// After every step.
    pub after: After,
}

impl March<'_> {
    /// Integrates and passes every state to `visit`.
    ///
    /// # Errors
    /// Outside, a method that cannot be run, in words. Inside, the time of the last good state if a step fails or is no
    /// longer finite, s.
    pub fn run(mut self, mut visit: impl FnMut(&State)) -> Outcome<Result<(), f64>> {
        let system = &self.start.assembled.system;
        let (mut state, mut work) = (self.start.state.clone(), self.start.work.clone());
        let tolerance = Tolerance {
            relative: 1e-8,
            position: system.scale(),
            time: 1e-2,
        };
        let model = DrivenSystem::new(system, &self.start.inputs, &mut work, &state);
        let mut model = Probe::new(model, None);
        if self.after == After::Dependent {
            model = model.partitioned(&state);
        }
        let method = &mut self.method;
        method.begin(&mut model, 0.0, &state.coordinates, &state.rates);
        let [step, stop] = self.times;
        for count in 1..=(stop / step).round() as u64 {
            let from = StateView::of(&state);
            let Attempt::Done(_) = method.attempt(&mut model, from, step, &tolerance) else {
                return Ok(Err(state.time));
            };
            let good = state.time;
            method.accept(&mut state.coordinates, &mut state.rates);
            state.time = count as f64 * step;
            if !state
                .coordinates
                .iter()
                .chain(&state.rates)
                .all(|x| x.is_finite())
            {
                return Ok(Err(good));
            }
            let stands = match self.after {
                After::Nothing => true,
                After::Dependent => model.project(&mut state),
                After::All => model.accepted(&mut state) != StepOutcome::ConstraintsViolated,
            };
            if !stands {
                return Ok(Err(good));
            }
            if self.after != After::Nothing {
                method.refresh(&mut model, state.time, &state.coordinates, &state.rates);
            }
            visit(&state);
        }
        Ok(Ok(()))
    }
}

/// Reads states.
pub struct Reader<'a> {
    start: &'a Start,
    work: Workspace,
    /// Evaluation of the last state read.
    pub values: Evaluation,
}

impl<'a> Reader<'a> {
    /// For a system.
    pub fn new(start: &'a Start) -> Self {
        let system = &start.assembled.system;
        Self {
            start,
            work: Workspace::new(system),
            values: Evaluation::new(system),
        }
    }

    /// Reads a state.
    pub fn read(&mut self, state: &State) -> &Evaluation {
        let system = &self.start.assembled.system;
        self.values.kinematics(system, state, &mut self.work);
        &self.values
    }

    /// Kinetic, strain and gravitational energy, J.
    pub fn energy(&mut self, state: &State) -> f64 {
        let system = &self.start.assembled.system;
        let values = self.read(state);
        values.kinetic_energy(system) + values.strain_energy(system) + values.gravity_energy(system)
    }

    /// Position of a marker, m.
    pub fn position(&mut self, state: &State, marker: &str) -> Outcome<[f64; 2]> {
        let found = self.start.marker(marker).ok_or("expected a marker")?;
        let marker = self.start.assembled.marker(found);
        let at = marker.position(&self.read(state).x);
        Ok([at.x, at.y])
    }
}

/// Iterates by Newton's method as in textbooks: full steps with a tangent by central differences. Returns the number of
/// iterations.
///
/// # Errors
/// The iteration does not converge.
pub fn newton(
    x: &mut [f64],
    size: f64,
    iterations: usize,
    mut residual: impl FnMut(&[f64], &mut [f64]),
) -> Result<usize, ()> {
    let n = x.len();
    let (mut plus, mut minus, mut r) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for iteration in 1..=iterations {
        let mut tangent = DMatrix::zeros(n, n);
        let change = 1e-6 * size;
        for j in 0..n {
            let at = x[j];
            x[j] = at + change;
            residual(x, &mut plus);
            x[j] = at - change;
            residual(x, &mut minus);
            x[j] = at;
            for i in 0..n {
                tangent[(i, j)] = (plus[i] - minus[i]) / (2.0 * change);
            }
        }
        residual(x, &mut r);
        let step = tangent
            .lu()
            .solve(&DVector::from_column_slice(&r))
            .ok_or(())?;
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        if !x.iter().all(|x| x.is_finite()) {
            return Err(());
        }
        if step.norm() < 1e-8 * size {
            return Ok(iteration);
        }
    }
    Err(())
}

/// Finds the equilibrium of a scene under its full load at once, by Newton's method from its start.
///
/// # Errors
/// The iteration does not converge.
pub fn equilibrium(start: &Start, inputs: &[f64], from: &State) -> Result<State, ()> {
    let system = &start.assembled.system;
    let (mut state, mut work) = (from.clone(), start.work.clone());
    let rest = vec![0.0; state.rates.len()];
    let mut model = DrivenSystem::new(system, inputs, &mut work, from);
    newton(&mut state.coordinates, system.scale(), 100, |q, r| {
        model.acceleration(0.0, q, &rest, r);
    })?;
    Ok(state)
}

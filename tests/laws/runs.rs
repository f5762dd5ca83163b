//! Scenes that are run as a master runs them: variables by name.

use flexbody::scene::Scene;
use flexbody::simulation::{Causality, Simulation, Snapshot};
use serde_json::{Value, json};

/// An implicit and an explicit method.
pub const METHODS: [&str; 2] = ["radau", "dopri853"];

/// Dimension and method of all runs of a law.
pub fn settings() -> impl Iterator<Item = (usize, &'static str)> {
    let dimensions = [2, 3].into_iter();
    dimensions.flat_map(|dimension| METHODS.map(|method| (dimension, method)))
}

/// A number is as far off at most.
pub fn is_near(found: f64, exact: f64, off: f64) {
    assert!((found - exact).abs() <= off, "{found} for {exact}");
}

/// A vector in the plane, with a third component of zero in space.
pub fn vector(dimension: usize, [x, y]: [f64; 2]) -> Value {
    if dimension == 2 {
        json!([x, y])
    } else {
        json!([x, y, 0.0])
    }
}

/// A simulation of a scene, started.
pub struct Run(pub Simulation);

impl Run {
    /// A simulation of a scene that is not started yet.
    pub fn ready(scene: &Value) -> Self {
        let text = scene.to_string();
        let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
        Self(Simulation::new(scene))
    }

    /// A started simulation.
    pub fn started(scene: &Value) -> Self {
        let mut run = Self::ready(scene);
        run.start();
        run
    }

    /// A simulation of a scene in static equilibrium under loads, started.
    pub fn at_rest(mut scene: Value, loads: &Value) -> Self {
        scene["loads"] = loads.clone();
        scene["initial"] = json!("static_equilibrium");
        Self::started(&scene)
    }

    /// Kinetic and strain energy of a scene that reads its energy, J.
    pub fn mechanical_energy(&mut self) -> f64 {
        self.read("energy.kinetic") + self.read("energy.strain")
    }

    /// Energy that is there and energy that was dissipated, less what went in, of a scene that reads its energy and its work, J: it stays.
    pub fn balance(&mut self) -> f64 {
        let kept = ["kinetic", "strain", "gravity", "spring", "dissipated"];
        let kept = kept.map(|of| self.read(&format!("energy.{of}")));
        kept.iter().sum::<f64>() - self.read("energy.input")
    }

    /// Outputs whose names have the word momentum.
    pub fn momenta(&mut self) -> Vec<f64> {
        let names = self.names().into_iter();
        let own = names.filter(|name| name.contains("momentum"));
        own.map(|name| self.read(&name)).collect()
    }

    /// Runs a scene that is kicked until 0.01 s and left alone after that, by an implicit and an explicit method. It has so many momenta or more;
    /// they stay, and so does its energy.
    pub fn check_kept(mut free: Value, momenta_at_least: usize) {
        free["accuracy"] = json!({"relative_tolerance": 1e-8});
        for method in ["radau", "dopri853"] {
            free["method"] = json!({"integrator": method});
            let mut run = Self::started(&free);
            run.step(0.011);
            let (momenta, energy) = (run.momenta(), run.mechanical_energy());
            run.step(0.03);
            let last = run.mechanical_energy();
            assert!(
                energy > 1e-3 && (last / energy - 1.0).abs() < 1e-6,
                "{method} {energy} {last}"
            );
            assert!(momenta.len() >= momenta_at_least, "{momenta:?}");
            for (before, after) in momenta.iter().zip(run.momenta()) {
                assert!((after - before).abs() < 1e-8, "{method} {before} {after}");
            }
        }
    }

    /// Computes the initial state and starts.
    pub fn start(&mut self) {
        self.0.initialize(0.0).expect("an initial state");
        self.0.start().expect("a start");
    }

    /// Index of a variable.
    pub fn index(&self, name: &str) -> usize {
        let mut variables = self.0.variables().iter();
        let found = variables.position(|variable| variable.name == name);
        found.unwrap_or_else(|| panic!("{name}"))
    }

    /// Sets one variable.
    pub fn set(&mut self, name: &str, value: f64) {
        let index = self.index(name);
        self.0.set_real(index, value).expect("a value");
    }

    /// Sets the components of a variable.
    pub fn set_all(&mut self, name: &str, values: &[f64]) {
        for (k, value) in values.iter().enumerate() {
            self.set(&format!("{name}[{}]", k + 1), *value);
        }
    }

    /// Value of one variable.
    pub fn read(&mut self, name: &str) -> f64 {
        let index = self.index(name);
        self.0.real(index).expect("a value")
    }

    /// Values of the components of a variable.
    pub fn read_all<const N: usize>(&mut self, name: &str) -> [f64; N] {
        std::array::from_fn(|k| self.read(&format!("{name}[{}]", k + 1)))
    }

    /// Values of all outputs.
    pub fn outputs(&mut self) -> Vec<f64> {
        let variables = self.0.variables().iter().enumerate();
        let of: Vec<usize> = variables
            .filter(|(_, variable)| Causality::of(variable) == Causality::Output)
            .map(|(index, _)| index)
            .collect();
        let value = |index: &usize| self.0.real(*index).expect("an output");
        of.iter().map(value).collect()
    }

    /// Names of all outputs.
    pub fn names(&self) -> Vec<String> {
        let variables = self.0.variables().iter();
        let outputs = variables.filter(|variable| Causality::of(variable) == Causality::Output);
        outputs.map(|variable| variable.name.clone()).collect()
    }

    /// Steps to a time.
    pub fn step(&mut self, until: f64) {
        let stepped = self.0.step(until);
        stepped.unwrap_or_else(|failure| panic!("at {until}: {failure}"));
    }

    /// Outputs after each of the steps `from..to` of a length, before each of which inputs are set.
    pub fn steps(
        &mut self,
        range: std::ops::Range<u32>,
        length: f64,
        mut set: impl FnMut(&mut Self, u32),
    ) -> Vec<Vec<f64>> {
        let step = |k: u32| {
            set(self, k);
            self.step(f64::from(k + 1) * length);
            self.outputs()
        };
        range.map(step).collect()
    }

    /// A copy of all that changes.
    pub fn snapshot(&self) -> Snapshot {
        self.0.snapshot()
    }

    /// Goes back to a copy.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.0.restore(snapshot).expect("a snapshot of its own");
    }
}

//! A small scene and what must come of it.

use std::collections::BTreeMap;

use flexbody::fmi2::model_description;
use flexbody::scene::Scene;
use flexbody::simulation::{Budget, Simulation, plan};
use serde_json::Value;

/// Relative error of what is computed without steps.
pub const EXACT: f64 = 1e-9;

/// A scene with claims.
#[derive(Clone)]
pub struct Specimen {
    pub name: &'static str,
    pub scene: Value,
    /// Time at the start, s.
    start: f64,
    /// Time of what is claimed or set next.
    now: f64,
    /// Settings of the master: time, variable and value.
    pub settings: Vec<(f64, String, f64)>,
    pub claims: Vec<Claim>,
}

/// Expected value of a variable, or of a fact about the unit.
#[derive(Clone)]
pub struct Claim {
    pub time: f64,
    /// A variable, or `@` and a fact.
    pub of: String,
    pub unit: &'static str,
    pub expected: Expected,
}

#[derive(Clone)]
pub enum Expected {
    Number { value: f64, within: f64 },
    Text(String),
}

/// Outcome of a scene that is held against claims.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// No scene, and why.
    Refused(String),
    /// No start, or no step.
    Stuck(String),
    /// A variable is not there.
    Missing(String),
    /// A claim does not hold.
    Off(String),
    Holds,
}

impl Outcome {
    /// Whether a claim noticed.
    pub fn is_noticed(&self) -> bool {
        matches!(self, Self::Missing(_) | Self::Off(_))
    }
}

impl Specimen {
    pub fn new(name: &'static str, scene: Value) -> Self {
        Self {
            name,
            scene,
            start: 0.0,
            now: 0.0,
            settings: Vec::new(),
            claims: Vec::new(),
        }
    }

    /// The time at which the simulation starts, s.
    pub fn from(mut self, time: f64) -> Self {
        (self.start, self.now) = (time, time);
        self
    }

    /// Sets the time of the settings and claims that follow, s.
    pub fn at(mut self, time: f64) -> Self {
        self.now = time;
        self
    }

    /// The master sets a variable: before the start, or at a communication point after what is claimed there.
    pub fn set(mut self, name: &str, value: f64) -> Self {
        self.settings.push((self.now, name.into(), value));
        self
    }

    /// A variable has a value, to roundoff, and a unit.
    pub fn claim(self, of: &str, unit: &'static str, value: f64) -> Self {
        let within = EXACT * (1.0 + value.abs());
        self.claim_within(of, unit, value, within)
    }

    pub fn claim_within(mut self, of: &str, unit: &'static str, value: f64, within: f64) -> Self {
        self.claims.push(Claim {
            time: self.now,
            of: of.into(),
            unit,
            expected: Expected::Number { value, within },
        });
        self
    }

    /// Both components of a vector.
    pub fn vector(self, of: &str, unit: &'static str, value: [f64; 2]) -> Self {
        let [x, y] = [1, 2].map(|axis| format!("{of}[{axis}]"));
        self.claim(&x, unit, value[0]).claim(&y, unit, value[1])
    }

    pub fn vector_within(self, of: &str, unit: &'static str, value: [f64; 2], within: f64) -> Self {
        let [x, y] = [1, 2].map(|axis| format!("{of}[{axis}]"));
        self.claim_within(&x, unit, value[0], within)
            .claim_within(&y, unit, value[1], within)
    }

    /// A fact about the unit.
    pub fn fact(mut self, of: &str, text: impl ToString) -> Self {
        self.claims.push(Claim {
            time: self.now,
            of: format!("@{of}"),
            unit: "",
            expected: Expected::Text(text.to_string()),
        });
        self
    }

    /// Names of the variables of the scene as it is, by index.
    pub fn variables(&self) -> Vec<String> {
        let scene = Scene::from_json(&self.scene.to_string());
        let scene = scene.unwrap_or_else(|error| panic!("{}: {error}", self.name));
        let simulation = Simulation::new(scene);
        let names = simulation.variables().iter().map(|v| v.name.clone());
        names.collect()
    }

    /// Judges another scene by the claims. Variables that have another name there are found by their index, if the list
    /// is as long as `known`.
    pub fn judge(&self, scene: &Value, known: &[String]) -> Outcome {
        self.judge_set(scene, known, &[])
    }

    /// Judges another scene by the claims, after the master has set more values before the start: indices and values.
    pub fn judge_set(&self, scene: &Value, known: &[String], set: &[(usize, f64)]) -> Outcome {
        let described = match Scene::from_json(&scene.to_string()) {
            Ok(scene) => scene,
            Err(error) => return Outcome::Refused(error.to_string()),
        };
        // What is left to the planner is planned as while packaging.
        let described = match plan(&described, &Budget::default(), &mut |_, _, _| ()) {
            Ok((scene, _)) => scene,
            Err(error) => return Outcome::Refused(error.to_string()),
        };
        let outcome = Run::new(self, described, known).and_then(|run| run.all(set));
        outcome.err().unwrap_or(Outcome::Holds)
    }
}

/// A specimen in simulation.
struct Run<'a> {
    specimen: &'a Specimen,
    simulation: Simulation,
    places: BTreeMap<&'a str, usize>,
}

impl<'a> Run<'a> {
    fn new(specimen: &'a Specimen, scene: Scene, known: &[String]) -> Result<Self, Outcome> {
        let simulation = Simulation::new(scene);
        let variables = simulation.variables();
        let mut places = BTreeMap::new();
        let claimed = specimen.claims.iter().map(|claim| &claim.of);
        let named = claimed.chain(specimen.settings.iter().map(|(_, name, _)| name));
        for name in named.filter(|name| !name.starts_with('@')) {
            let by_name = variables.iter().position(|v| v.name == *name);
            let by_place = || known.iter().position(|known| known == name);
            let is_listed = known.len() == variables.len();
            let place = by_name.or_else(|| by_place().filter(|_| is_listed));
            let place = place.ok_or_else(|| Outcome::Missing(name.clone()))?;
            places.insert(name.as_str(), place);
        }
        Ok(Self {
            specimen,
            simulation,
            places,
        })
    }

    fn all(mut self, set: &[(usize, f64)]) -> Result<(), Outcome> {
        for (place, value) in set {
            self.put(*place, *value)?;
        }
        let specimen = self.specimen;
        let mut times: Vec<f64> = specimen.claims.iter().map(|claim| claim.time).collect();
        times.extend(specimen.settings.iter().map(|(time, ..)| *time));
        times.push(specimen.start);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let stuck = |error: &dyn std::fmt::Display| Outcome::Stuck(error.to_string());
        for time in times {
            if time == specimen.start {
                self.set(time)?;
                let started = self.simulation.initialize(time);
                started.map_err(|error| stuck(&error))?;
                let started = self.simulation.start();
                started.map_err(|error| stuck(&error))?;
                self.check(time)?;
                continue;
            }
            let done = self.simulation.step(time);
            done.map_err(|failure| stuck(&failure))?;
            self.check(time)?;
            self.set(time)?;
        }
        Ok(())
    }

    fn put(&mut self, place: usize, value: f64) -> Result<(), Outcome> {
        let is_integer = self.simulation.variables()[place].is_integer();
        let done = if is_integer {
            self.simulation.set_integer(place, value as i32)
        } else {
            self.simulation.set_real(place, value)
        };
        done.map_err(|error| Outcome::Stuck(error.to_string()))
    }

    fn set(&mut self, time: f64) -> Result<(), Outcome> {
        for (at, name, value) in &self.specimen.settings {
            if *at == time {
                self.put(self.places[name.as_str()], *value)?;
            }
        }
        Ok(())
    }

    fn check(&mut self, time: f64) -> Result<(), Outcome> {
        for claim in self
            .specimen
            .claims
            .iter()
            .filter(|claim| claim.time == time)
        {
            let off = |found: &dyn std::fmt::Display, expected: &dyn std::fmt::Display| {
                let of = &claim.of;
                Outcome::Off(format!(
                    "{of} at {time} s: expected {expected}, found {found}"
                ))
            };
            match &claim.expected {
                Expected::Text(text) => {
                    let found = self.fact(&claim.of[1..]);
                    if found != *text {
                        return Err(off(&found, text));
                    }
                }
                Expected::Number { value, within } => {
                    let place = self.places[claim.of.as_str()];
                    let found = self.simulation.real(place);
                    let found = found.map_err(|error| Outcome::Stuck(error.to_string()))?;
                    let is_near = (found - value).abs() <= *within;
                    if !is_near {
                        return Err(off(&found, value));
                    }
                }
            }
        }
        Ok(())
    }

    /// A fact about the unit: `method`, the name of the integrator of the last step; `variables`, how many
    /// there are; else an attribute of an element of the model description, `element/attribute`.
    fn fact(&self, of: &str) -> String {
        match of {
            "method" => self.simulation.report().method.into(),
            "variables" => self.simulation.variables().len().to_string(),
            _ => {
                let (element, attribute) = of.split_once('/').expect("an attribute");
                attribute_of(self.simulation.scene(), element, attribute)
            }
        }
    }
}

fn attribute_of(scene: &Scene, element: &str, attribute: &str) -> String {
    let text = model_description(scene);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let found = document
        .descendants()
        .find(|node| node.has_tag_name(element));
    let found = found.and_then(|node| node.attribute(attribute));
    found.unwrap_or_default().into()
}

/// What a function finds at the type of variables in the model description (`Real`, `Integer`), by name.
fn of_variables<T>(
    scene: &Value,
    find: impl Fn(roxmltree::Node<'_, '_>) -> Option<T>,
) -> BTreeMap<String, T> {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let text = model_description(&scene);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let variables = document
        .descendants()
        .filter(|node| node.has_tag_name("ScalarVariable"));
    let found = variables.filter_map(|node| {
        let kind = node.children().find(roxmltree::Node::is_element)?;
        Some((node.attribute("name")?.to_owned(), find(kind)?))
    });
    found.collect()
}

/// The units of real variables in the model description, by name.
pub fn units(scene: &Value) -> BTreeMap<String, String> {
    of_variables(scene, |kind| {
        let is_real = kind.has_tag_name("Real");
        is_real.then(|| kind.attribute("unit").unwrap_or_default().to_owned())
    })
}

/// Least and greatest values of parameters in the model description, by name.
pub fn limits(scene: &Value) -> BTreeMap<String, [Option<f64>; 2]> {
    of_variables(scene, |kind| {
        let number = |key: &str| kind.attribute(key)?.parse().ok();
        Some(["min", "max"].map(number))
    })
}

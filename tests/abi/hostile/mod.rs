//! A hostile master: makes any call in any mode with any argument, and checks every answer against
//! what the standard lets a unit do.

mod bytes;
mod calls;
mod derivatives;
mod standard;
mod states;
mod values;

use std::collections::BTreeMap;
use std::ptr;

use flexbody::fmi2::abi::{Component, FmuState};
use flexbody::fmi2::model_description;
use flexbody::scene::Scene;

use crate::support::{Instance, Line, SCENE, Status, Unit};
use bytes::Bytes;
pub use standard::{Mode, allows, functions};

/// Answers that the standard leaves open here.
const OK: &[Status] = &[Status::Ok];
const ERROR: &[Status] = &[Status::Error];
const WARNING: &[Status] = &[Status::Warning];
const DISCARD: &[Status] = &[Status::Discard];
const OK_OR_ERROR: &[Status] = &[Status::Ok, Status::Error];
const ANY: &[Status] = &[Status::Ok, Status::Discard, Status::Error];
const OK_OR_DISCARD: &[Status] = &[Status::Ok, Status::Discard];

/// How often a function was called in a mode.
pub type Tally = BTreeMap<(&'static str, String), u64>;

/// What a master knows of an instance.
#[derive(Clone)]
struct Memory {
    mode: Mode,
    time: f64,
    start: f64,
    stop: Option<f64>,
    /// Parameters and inputs; 0 for all other variables.
    values: Vec<f64>,
    /// A step under a force beyond all bounds was done: nobody knows what comes.
    shaken: bool,
    /// Derivatives moved inputs: they are not where they were set.
    moved: bool,
}

/// What to expect of values that were accepted.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Temper {
    /// Every computation succeeds.
    Tame,
    /// A force beyond all bounds: a step fails at once.
    Violent,
    /// Finite, yet absurd: a computation may fail, or take for ever.
    Absurd,
}

/// A master with one instance, states of it, and a state of another model.
pub struct Master<'a> {
    unit: &'a Unit,
    instance: Instance<'a>,
    memory: Memory,
    enabled: Vec<String>,
    declared: Vec<String>,
    saved: Vec<(FmuState, Memory)>,
    serialized: Vec<(Vec<u8>, Memory)>,
    foreign: Instance<'a>,
    foreign_state: FmuState,
    /// Value references of all inputs and outputs.
    inputs: Vec<u32>,
    outputs: Vec<u32>,
    /// Whether the model description promises derivatives.
    derivatives: bool,
    /// Whether the next call goes to no instance at all.
    nobody: bool,
    /// Whether steps that may take for ever are tried: only where steps are limited.
    limited: bool,
    pub tally: Tally,
}

/// A model of the same variables whose states are not those of [`SCENE`].
pub fn foreign_unit() -> Unit {
    Unit::of(&SCENE.replace("-9.81", "-1.62"))
}

/// Names of the log categories that a model description declares.
fn declared(text: &str) -> Vec<String> {
    let names = text.split("<Category name=\"").skip(1);
    names
        .map(|rest| rest.split('"').next().unwrap_or_default().into())
        .collect()
}

impl<'a> Master<'a> {
    pub fn new(unit: &'a Unit, foreign: &'a Unit, limited: bool) -> Self {
        let foreign = Instance::started(foreign);
        let scene = Scene::from_json(SCENE).expect("a valid scene");
        let text = model_description(&scene);
        let of = |kind: fn(&Unit, usize) -> bool| -> Vec<u32> {
            let all = 0..unit.variables.len() as u32;
            all.filter(|reference| kind(unit, *reference as usize))
                .collect()
        };
        Self {
            inputs: of(values::is_input),
            outputs: of(values::is_output),
            derivatives: text.contains("providesDirectionalDerivative=\"true\""),
            memory: Memory::new(unit),
            instance: Instance::new(unit),
            unit,
            enabled: declared(&text),
            declared: declared(&text),
            saved: Vec::new(),
            serialized: Vec::new(),
            foreign_state: foreign.save(),
            foreign,
            nobody: false,
            limited,
            tally: Tally::new(),
        }
    }

    /// Makes the calls that bytes stand for.
    pub fn run(&mut self, bytes: &[u8]) {
        let mut bytes = Bytes::new(bytes);
        while !bytes.is_empty() {
            self.nobody = bytes.once_in(64);
            self.act(&mut bytes);
        }
    }

    /// Makes one call; `expected` is what the standard lets the unit answer if the function is
    /// allowed now.
    fn call(
        &mut self,
        function: &'static str,
        expected: &[Status],
        call: impl FnOnce(Component) -> Status,
    ) -> Status {
        let mode = self.memory.mode;
        let place = (function, format!("{mode:?}"));
        *self.tally.entry(place).or_default() += 1;
        let allowed = !self.nobody && allows(function, mode);
        let expected = if allowed { expected } else { ERROR };
        let before = self.fingerprint();
        self.instance.record.take();
        let status = if self.nobody {
            call(ptr::null_mut())
        } else {
            call(self.instance.component)
        };
        let lines = self.instance.record.take();
        let place = format!("{function} in {mode:?}: {status:?}, {lines:?}");
        assert!(expected.contains(&status), "{place}, not of {expected:?}");
        self.check_lines(function, status, &lines);
        if !(allowed && changes(function, mode, status)) {
            let after = self.fingerprint();
            assert!(after == before, "changed by {place}");
        }
        status
    }

    /// Everything that the instance is, as bytes; nothing before it has a scene.
    fn fingerprint(&self) -> Option<Vec<u8>> {
        (self.memory.mode != Mode::Bare).then(|| self.instance.fingerprint())
    }

    /// Every line is in a category that is declared and enabled, and a refusal has its line. That a category is not there is told
    /// whatever is enabled.
    fn check_lines(&self, function: &str, status: Status, lines: &[Line]) {
        let is_about_logging = function == "fmi2SetDebugLogging" && status == Status::Warning;
        for (name, _, category, _) in lines {
            assert_eq!(name, "instance");
            assert!(
                is_about_logging || self.enabled.contains(category),
                "{function}: {category}"
            );
        }
        let wanted = match status {
            Status::Error => "logStatusError",
            Status::Discard => "logStatusWarning",
            _ => return,
        };
        let said = lines.iter().any(|(_, logged, category, message)| {
            *logged == status && category == wanted && message.contains(function)
        });
        let due = !self.nobody && self.enabled.iter().any(|name| name == wanted);
        assert_eq!(said, due, "{function}: {status:?} with {lines:?}");
    }

    /// Whether the master can count on computations.
    fn temper(&self) -> Temper {
        self.memory.temper(self.unit)
    }
}

impl Drop for Master<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            return;
        }
        for (state, _) in self.saved.drain(..) {
            self.instance.free(state);
        }
        self.foreign.free(self.foreign_state);
    }
}

/// Whether a call that was allowed and answered so may change the instance.
fn changes(function: &str, mode: Mode, status: Status) -> bool {
    match function {
        // The initial state is computed when it is read.
        "fmi2GetReal" | "fmi2GetDirectionalDerivative" => mode == Mode::Initialization,
        "fmi2SetFMUstate" | "fmi2SetupExperiment" | "fmi2Terminate" | "fmi2Reset" => {
            status == Status::Ok
        }
        "fmi2SetReal" | "fmi2SetInteger" => status == Status::Ok,
        "fmi2SetRealInputDerivatives" => status == Status::Ok,
        "fmi2EnterInitializationMode" | "fmi2ExitInitializationMode" => true,
        "fmi2DoStep" => status != Status::Error,
        _ => false,
    }
}

impl Memory {
    fn new(unit: &Unit) -> Self {
        let starts = unit.variables.iter().map(|v| v.start.unwrap_or(0.0));
        Self {
            mode: Mode::Instantiated,
            time: 0.0,
            start: 0.0,
            stop: None,
            values: starts.collect(),
            shaken: false,
            moved: false,
        }
    }

    fn temper(&self, unit: &Unit) -> Temper {
        if self.shaken {
            return Temper::Absurd;
        }
        let of = |(index, value): (usize, &f64)| {
            if values::tame(unit, index).contains(value) {
                Temper::Tame
            } else if values::is_input(unit, index) && value.abs() > 1e299 {
                Temper::Violent
            } else {
                Temper::Absurd
            }
        };
        let settable = |(index, _): &(usize, &f64)| unit.variables[*index].start.is_some();
        let each = self.values.iter().enumerate().filter(settable).map(of);
        each.max().unwrap_or(Temper::Tame)
    }
}

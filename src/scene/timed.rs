//! Functions of time of a scene, and where they have no value.

use super::{Error, InitialState, Scene, TimedKey, Value};
use crate::math::function::Function;
use crate::math::quadrature::GAUSS_5;
use crate::math::switches::grain;

/// A function of time of a scene.
#[derive(Clone, Debug)]
pub struct Timed {
    /// Where it stands.
    path: String,
    /// Name of the motion or load that follows it.
    name: String,
    function: Function,
    /// Highest derivative that is needed.
    order: usize,
}

/// Steps of time, in grains, around a time at which a function may have no value.
const AROUND: [f64; 9] = [0.0, 1.0, -1.0, 16.0, -16.0, 256.0, -256.0, 4096.0, -4096.0];
/// Moments, in grains, within which a function multiplies near a pole.
const MOMENTS: [f64; 5] = [4096.0, 1_048_576.0, 268_435_456.0, 6.9e10, 2.8e11];

impl Scene {
    /// Functions of time of a valid scene.
    pub fn timed(&self) -> Vec<Timed> {
        let mut timed = Vec::new();
        let mut add = |path: String, name: &str, value: &Value, order: usize| {
            let functions = match (value.varying(), order) {
                // Values that change along a body as well are looked at in a few places.
                (Some((text, names)), _) => GAUSS_5
                    .map(|point| {
                        let place: Vec<_> = names.iter().map(|name| (*name, point.at)).collect();
                        Function::at(text, &place)
                    })
                    .to_vec(),
                (None, 2) => vec![value.motion_function()],
                (None, _) => vec![value.function()],
            };
            timed.extend(functions.into_iter().flatten().map(|function| Timed {
                path: path.clone(),
                name: name.to_owned(),
                function,
                order,
            }));
        };
        let place = |path: String, count: usize, k: usize| match count {
            1 => path,
            _ => format!("{path}[{k}]"),
        };
        for (i, motion) in self.motions.iter().enumerate() {
            let values = motion.kind.value().components();
            for (k, value) in values.iter().enumerate() {
                let path = place(format!("motions[{i}].value"), values.len(), k);
                add(path, &motion.name, value, 2);
            }
        }
        for (i, load) in self.loads.iter().enumerate() {
            let Some(TimedKey { key, values, order }) = load.kind.timed() else {
                continue;
            };
            for (k, value) in values.iter().enumerate() {
                let path = place(format!("loads[{i}].{key}"), values.len(), k);
                add(path, &load.name, value, order);
            }
        }
        timed
    }

    /// Whether a valid scene starts in an equilibrium that nothing but its inputs disturbs: no function of time changes, nothing
    /// is released, and no body is given a velocity.
    pub fn rests(&self) -> bool {
        let is_found = self.initial.state() == InitialState::StaticEquilibrium;
        let is_kept = self.initial.loads().is_empty()
            && self.joints.iter().all(|joint| joint.release_time.is_none())
            && self
                .latches
                .iter()
                .all(|latch| latch.release_time.is_none())
            && self.bodies.iter().all(|body| body.motion().is_none());
        let mut timed = self.timed().into_iter();
        is_found && is_kept && timed.all(|timed| timed.function.is_constant())
    }
}

/// Whether every function of time has a value at a time, s, and where it needs them its derivatives.
///
/// # Errors
/// The first that has none, with its place and name.
pub fn finite_at(timed: &[Timed], time: f64) -> Result<(), Error> {
    let mut told = timed.iter().filter_map(|timed| timed.broken(time, time));
    told.next().map_or(Ok(()), Err)
}

/// Whether every function of time has a value near a time, s: no pole.
///
/// # Errors
/// The first that has none, with its place and name.
pub fn finite_near(timed: &[Timed], time: f64) -> Result<(), Error> {
    let near = AROUND.map(|steps| time + steps * grain(time));
    for timed in timed {
        let broken = near.iter().find_map(|t| timed.broken(*t, time));
        if let Some(error) = broken.or_else(|| timed.pole(time)) {
            return Err(error);
        }
    }
    Ok(())
}

impl Timed {
    /// Name of the motion or load that follows it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where it stands in the scene.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether it holds sines, cosines or tangents.
    pub fn is_periodic(&self) -> bool {
        self.function.is_periodic()
    }

    /// Most periods that a wave in it goes through from one time to another, s. Allocates nothing.
    pub fn periods(&self, from: f64, until: f64) -> f64 {
        self.function.periods(from, until)
    }

    /// Describes a time at which the function has no value.
    fn broken(&self, t: f64, told: f64) -> Option<Error> {
        const WHAT: [&str; 3] = ["value", "first derivative", "second derivative"];
        let found = self.function.derivatives(t);
        let order = found[..=self.order].iter().position(|x| !x.is_finite())?;
        Some(self.error(WHAT[order], told, found[order]))
    }

    /// Describes a pole near a time: within a moment the value has become a multiple of what it was.
    fn pole(&self, time: f64) -> Option<Error> {
        let value = self.function.value(time);
        let size = |back: f64| self.function.value(time - back).abs();
        let mut moments = MOMENTS.iter().map(|grains| grains * grain(time));
        let moment = moments.find(|moment| {
            // A zero is no pole: before it the value was as large as after it.
            let before = [1.0, 2.0, 4.0].map(|k| size(k * moment));
            before.into_iter().all(|before| value.abs() > 10.0 * before)
        })?;
        let message = format!(
            "expected a bounded value of `{}` near t = {time} s, found {value:e}, over ten times that of \
             {moment:.0e} s before",
            self.name
        );
        Some(Error::new(&self.path, message))
    }

    fn error(&self, what: &str, time: f64, found: f64) -> Error {
        let message = format!(
            "expected a finite {what} of `{}` at t = {time} s, found {found:e}",
            self.name
        );
        Error::new(&self.path, message)
    }
}

//! Functions of time that go through far more periods in a communication step than sub-steps can follow.

use std::fmt;

use super::once::Once;
use crate::scene::Timed;

/// Periods in one communication step beyond which a function is told of. Each takes several sub-steps to follow.
const PERIODS: f64 = 1e3;
/// Periods in one communication step that no work limit lets sub-steps follow: such a step is refused.
const MOST: f64 = 1e5;

/// Functions of time with waves in them, and what there is to tell of them.
#[derive(Default)]
pub(super) struct FastFunctions {
    waves: Vec<Wave>,
}

struct Wave {
    timed: Timed,
    /// Periods in the step that is asked for.
    periods: f64,
    /// Most periods in a step, and how long that was, s.
    found: Once<[f64; 2]>,
}

/// A function of time that steps do not follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooFast<'a> {
    /// Name of the motion or load that follows it.
    pub name: &'a str,
    /// Where it stands in the scene.
    pub path: &'a str,
    /// Periods in a communication step.
    pub periods: f64,
    /// Length of that step, s.
    pub step: f64,
}

impl fmt::Display for TooFast<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {} goes through {:.1e} periods in a communication step of {} s; sub-steps do not follow that: take shorter \
             communication steps, or leave it out",
            self.path, self.name, self.periods, self.step
        )
    }
}

impl FastFunctions {
    /// Collects the periodic functions among the functions of time.
    pub(super) fn new(timed: Vec<Timed>) -> Self {
        let waves = timed.into_iter().filter(Timed::is_periodic);
        let waves = waves.map(|timed| Wave {
            timed,
            periods: 0.0,
            found: Once::default(),
        });
        Self {
            waves: waves.collect(),
        }
    }

    /// Why no sub-steps follow a communication step from one time to another, s.
    pub(super) fn refusal(&mut self, from: f64, until: f64) -> Option<String> {
        for wave in &mut self.waves {
            wave.periods = wave.timed.periods(from, until);
        }
        let mut waves = self.waves.iter();
        let refused = waves.find(|wave| wave.periods > MOST)?;
        let found = TooFast {
            name: refused.timed.name(),
            path: refused.timed.path(),
            periods: refused.periods,
            step: until - from,
        };
        Some(found.to_string())
    }

    /// The step of this length (s) that was not refused begins.
    pub(super) fn begin_step(&mut self, step: f64) {
        for wave in self.waves.iter_mut().filter(|wave| wave.found.is_open()) {
            wave.found
                .find((wave.periods > PERIODS).then_some([wave.periods, step]));
        }
    }

    /// The next one to tell of; each once.
    pub(super) fn next(&mut self) -> Option<TooFast<'_>> {
        let mut waves = self.waves.iter_mut();
        let next = waves.find_map(|wave| Some((&wave.timed, wave.found.tell()?)));
        let (timed, [periods, step]) = next?;
        Some(TooFast {
            name: timed.name(),
            path: timed.path(),
            periods,
            step,
        })
    }
}

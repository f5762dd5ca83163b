//! Prescribed motions whose value a master moves without ever setting the rates that are inputs beside it.

use super::variables::{Source, Variable};

/// Number of steps that begin with another value, from which on a value moves. One alone may be a way from rest to rest.
const MOVES: u8 = 2;

/// The prescribed motions with rates as inputs.
#[derive(Default)]
pub(super) struct UnsetRates {
    motions: Vec<MotionInputs>,
    /// Motion and order of every variable, `[variables]`.
    parts: Vec<Option<(usize, usize)>>,
}

/// Use of a prescribed motion by the master.
struct MotionInputs {
    /// Place of the input with the value.
    first: usize,
    /// Message about the motion.
    message: String,
    /// Whether the value was set to another since the last step.
    changed: bool,
    /// Steps that began with another value.
    moves: u8,
    /// Whether it needs no word any more: a rate was set, or it was told.
    done: bool,
}

impl UnsetRates {
    /// Collects the prescribed motions with rate inputs among variables.
    pub(super) fn new(variables: &[Variable]) -> Self {
        let mut motions: Vec<MotionInputs> = Vec::new();
        let drives = variables.iter().filter_map(|variable| variable.drive);
        for drive in drives.filter(|drive| drive.order() == 1) {
            if motions.iter().all(|motion| motion.first != drive.first()) {
                motions.push(MotionInputs {
                    first: drive.first(),
                    message: message(variables, drive.first()),
                    changed: false,
                    moves: 0,
                    done: false,
                });
            }
        }
        let part = |variable: &Variable| {
            let drive = variable.drive?;
            let of = |motion: &MotionInputs| motion.first == drive.first();
            Some((motions.iter().position(of)?, drive.order()))
        };
        Self {
            parts: variables.iter().map(part).collect(),
            motions,
        }
    }

    /// A master has set an input, to another value or to the same.
    pub(super) fn set(&mut self, index: usize, changed: bool) {
        let Some(&Some((motion, order))) = self.parts.get(index) else {
            return;
        };
        let motion = &mut self.motions[motion];
        motion.changed |= changed && order == 0;
        motion.done |= order > 0;
    }

    /// A step begins.
    pub(super) fn begin_step(&mut self) {
        for motion in &mut self.motions {
            motion.moves = motion.moves.saturating_add(u8::from(motion.changed));
            motion.changed = false;
        }
    }

    /// The next motion to tell of; each once.
    pub(super) fn next(&mut self) -> Option<&str> {
        let motions = &mut self.motions;
        let motion = motions
            .iter_mut()
            .find(|motion| !motion.done && motion.moves >= MOVES)?;
        motion.done = true;
        Some(&motion.message)
    }
}

/// Describes the motion whose value is this input.
fn message(variables: &[Variable], first: usize) -> String {
    let names = |is_wanted: &dyn Fn(usize) -> bool| {
        let of = |variable: &&Variable| {
            let drive = variable.drive;
            drive.is_some_and(|drive| drive.first() == first && is_wanted(drive.order()))
                && matches!(variable.source, Source::Input(_))
        };
        let names: Vec<&str> = variables
            .iter()
            .filter(of)
            .map(|variable| variable.name.as_str())
            .collect();
        names.join(", ")
    };
    let value = names(&|order| order == 0);
    let rates = names(&|order| order > 0);
    format!(
        "{value} moves, but its rates were never set and count as 0: {rates}; set them in every step; a motion \
         with {{\"input\": 0}} asks for none"
    )
}

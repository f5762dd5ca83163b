//! What is compared between runs, and which tolerance a run needs to be believed.

use super::experiment::Run;
use super::outputs::{Group, RelativeTo, shown};
use super::response;
use super::search::{Search, TIGHTEST};

/// Part of the error wanted that the tolerance is where inputs rest and nothing moves: motions of a thousandth of the size are
/// resolved when they act.
const STILL: f64 = 1e-3;

impl Search<'_, '_> {
    /// Whether natural frequencies are compared: of scenes with inputs that are held.
    pub fn tunes(&self) -> bool {
        !self.experiment.held.is_empty()
    }

    /// Number of all that is compared: outputs that count, answers to inputs that are held, and natural frequencies.
    pub fn compared(&self) -> usize {
        self.counting + self.experiment.held.len() + usize::from(self.tunes())
    }

    /// Name of something that is compared.
    pub fn name(&self, index: usize) -> String {
        let input = index.checked_sub(self.counting);
        match input.map(|input| self.experiment.held.get(input)) {
            None => self.groups[index].name.clone(),
            Some(Some(input)) => response::name(input),
            Some(None) => response::FREQUENCIES.to_owned(),
        }
    }

    /// Outputs that count, in the order in which they are compared.
    pub fn outputs(&self) -> &[Group] {
        &self.groups[..self.counting]
    }

    /// The loosest tolerance at which a run resolves what its outputs show: the error wanted of the displacements that they follow from.
    pub fn believed(&self, run: &Run) -> f64 {
        let counting = self.outputs().iter().enumerate();
        let shown = counting.filter_map(|(index, group)| shown((group, index), run));
        let least = shown.fold(f64::INFINITY, f64::min);
        let by_motion = self.error * least / run.size.max(f64::MIN_POSITIVE);
        let at_rest = match self.is_at_rest(run) {
            true => STILL * self.error,
            false => f64::INFINITY,
        };
        by_motion.min(at_rest).max(TIGHTEST)
    }

    /// Whether inputs are held while an output that counts does not change.
    pub fn is_at_rest(&self, run: &Run) -> bool {
        let mut scales = run.scales[..self.counting].iter();
        self.tunes() && scales.any(|(_, of)| *of == RelativeTo::Scene)
    }
}

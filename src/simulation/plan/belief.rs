//! What is compared between runs, and which tolerance a run needs to be believed.

use super::experiment::TrialRun;
use super::outputs::{Measure, OutputGroup, RelativeTo, shown};
use super::response;
use super::search::{Search, TIGHTEST};
use crate::scene::FileBody;

/// Part of the error wanted that the tolerance is where inputs rest and nothing moves: motions of a thousandth of the size are
/// resolved when they act.
const STILL: f64 = 1e-3;
/// Part of what doubling changes that the next doubling changes at least, where that is foreseen: of displacements, whose errors fall
/// with the fourth power of the length of elements, and of strains and forces, where they fall with the second.
const OF_DISPLACEMENTS: f64 = 1.0 / 16.0;
const OF_FORCES: f64 = 1.0 / 4.0;

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
    pub fn outputs(&self) -> &[OutputGroup] {
        &self.groups[..self.counting]
    }

    /// The loosest tolerance at which a run resolves what its outputs show: the error wanted of the displacements that they follow from.
    pub fn believed(&self, run: &TrialRun) -> f64 {
        let counting = self.outputs().iter().enumerate();
        let shown = counting.filter_map(|(index, group)| shown(group, index, run));
        let least = shown.fold(f64::INFINITY, f64::min);
        let by_motion = if run.rests {
            f64::INFINITY
        } else {
            self.error * least / run.size.max(f64::MIN_POSITIVE)
        };
        let at_rest = if self.is_at_rest(run) {
            STILL * self.error
        } else {
            f64::INFINITY
        };
        by_motion.min(at_rest).max(TIGHTEST)
    }

    /// The part of what doubling changes that the next one changes at least, of all that is compared. Of a cable without bending stiffness
    /// nothing is foreseen: its curvature jumps, so that its errors depend on where nodes are. Nor is anything of modes, which differ in what
    /// they add.
    pub fn foreseen_at_least(&self) -> Vec<f64> {
        let is_limp = |body: &usize| {
            let body = &self.scene.bodies[*body];
            let cable = body.cable();
            body.reduced().is_some_and(FileBody::is_open)
                || cable.is_some_and(|cable| cable.bending_stiffness() == 0.0)
        };
        let is_surface = |body: &usize| self.scene.bodies[*body].patch().is_some();
        let of_output = |group: &OutputGroup| match group.measure {
            _ if group.bodies.iter().any(is_limp) => f64::INFINITY,
            Measure::Elastic => OF_FORCES,
            // Curvature is not bounded where a clamped edge ends beside a free one.
            _ if group.bodies.iter().any(is_surface) => OF_FORCES,
            _ => OF_DISPLACEMENTS,
        };
        let mut least: Vec<f64> = self.outputs().iter().map(of_output).collect();
        least.resize(self.compared(), OF_DISPLACEMENTS);
        least
    }

    /// Whether inputs are held while an output that counts does not change.
    pub fn is_at_rest(&self, run: &TrialRun) -> bool {
        let mut scales = run.scales[..self.counting].iter();
        self.tunes() && scales.any(|(_, of)| *of == RelativeTo::Scene)
    }
}

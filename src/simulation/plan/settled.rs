//! What becomes of forces that do not settle where axial waves do.

use super::ladder::Choice;
use super::report::{PlannedOutput, Settled, Settles};
use super::search::{Search, cables};
use crate::scene::Axial;

/// Part of the work of planning that is kept for this.
const RESERVE: f64 = 0.3;

impl Search<'_, '_> {
    /// Tries axial damping for forces that do not converge: by one run, and by one with twice the mesh if the first
    /// differs by more than the wanted error. `None` if the damping neither makes the forces converge nor is cheaper.
    pub fn settled(&mut self, choice: &Choice, outputs: &[PlannedOutput]) -> Option<Settled> {
        let rings = |(index, output): (usize, &PlannedOutput)| {
            self.groups[index].is_force && output.settles != Settles::Yes
        };
        let bends = cables(self.scene).zip(&choice.elements);
        let waves = bends.filter(|((_, cable), count)| cable.axial == Axial::Waves && **count > 0);
        let bodies: Vec<String> = waves.map(|((_, cable), _)| cable.name.clone()).collect();
        if bodies.is_empty() || !outputs.iter().enumerate().any(rings) {
            return None;
        }
        // What never settles takes all the work: some is left to say what would.
        self.grant(RESERVE);
        let settled = Choice {
            is_settled: true,
            ..choice.clone()
        };
        let changes = self.compare(choice, &settled, self.error).ok()?;
        let changed: Vec<usize> = (0..self.outputs().len())
            .filter(|index| self.groups[*index].is_force && changes[*index].largest > self.error)
            .collect();
        if changed.is_empty() {
            return None;
        }
        let mut double = settled.clone();
        self.refine(&mut double);
        let errors = if double == settled {
            None
        } else {
            self.compare(&settled, &double, self.error).ok()
        };
        let error = |index: usize| errors.as_ref().map(|errors| errors[index].largest);
        let settles = |index: &usize| error(*index).is_some_and(|error| error <= self.error);
        let [now, then] = [choice, &settled].map(|made| self.known(made).map(|run| run.work));
        if !changed.iter().any(settles) && then >= now {
            return None;
        }
        let forces = changed.iter().map(|index| {
            let name = self.groups[*index].name.clone();
            (name, changes[*index].largest, error(*index))
        });
        Some(Settled {
            bodies,
            forces: forces.collect(),
            price: self.price(&settled, None)?,
        })
    }
}

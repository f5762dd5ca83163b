//! The account of a search: what was chosen, and why.

use super::experiment::{Run, columns};
use super::ladder::Choice;
use super::outputs::{Difference, scale};
use super::report::{Plan, PlannedBody, PlannedOutput, Price, Settles};
use super::search::Search;
use crate::simulation::Source;

impl Search<'_, '_> {
    /// The plan of a choice, from what doubling and a tenth of the tolerance change.
    pub fn report(
        &mut self,
        choice: &Choice,
        in_space: &[Difference],
        in_time: &[Difference],
    ) -> Plan {
        let _ = self.run(choice);
        let scaled = |by: fn(u32) -> u32, search: &Self| {
            let elements = choice.elements.iter().enumerate();
            let elements = elements.map(|(i, n)| if search.is_free(i) { by(*n) } else { *n });
            Choice {
                elements: elements.collect(),
                tolerance: choice.tolerance,
            }
        };
        let [half, double] = [scaled(|n| n / 2, self), scaled(|n| 2 * n, self)];
        let half_error = match half != *choice && self.known(&half).is_some() {
            true => self.compare(&half, choice, self.error).ok(),
            false => None,
        };
        let worst = |found: Vec<Difference>| found.iter().map(|d| d.largest).fold(0.0, f64::max);
        let half_error = half_error.map(worst);
        let chosen = self.known(choice);
        let cost = chosen.map_or(0.0, |run| run.work);
        Plan {
            error: self.error,
            bodies: self.bodies(choice, in_space),
            tolerance: choice.tolerance,
            method: chosen.map_or("", |run| run.method).to_owned(),
            held: self.held(),
            outputs: self.outputs(chosen, in_space, in_time),
            chosen: self.price(choice, None),
            cheaper: half_error.and_then(|error| self.price(&half, Some(error))),
            dearer: match double == *choice {
                true => None,
                false => self.price(&double, None),
            },
            runs: self.runs.len(),
            runs_cost: if cost > 0.0 { self.work / cost } else { 0.0 },
        }
    }

    /// The run with a choice, if it was made and finished.
    fn known(&self, choice: &Choice) -> Option<&Run> {
        let run = self.runs.iter().find(|(made, _)| made == choice)?;
        run.1.as_ref().ok()
    }

    fn price(&self, choice: &Choice, error: Option<f64>) -> Option<Price> {
        let run = self.known(choice)?;
        let time = run.times.last().copied().filter(|time| *time > 0.0)?;
        Some(Price {
            elements: choice.elements.clone(),
            tolerance: choice.tolerance,
            work: run.work / time,
            error,
        })
    }

    /// Inputs that keep their start values.
    fn held(&self) -> Vec<String> {
        let inputs = self.variables.iter();
        let inputs = inputs.filter(|variable| matches!(variable.source, Source::Input(_)));
        let courses = columns(&self.scene.accuracy.courses, &self.variables);
        let moves = |name: &str| courses.iter().any(|(moved, ..)| moved == name);
        let held = inputs.filter(|variable| !moves(&variable.name));
        held.map(|variable| variable.name.clone()).collect()
    }

    fn outputs(
        &self,
        chosen: Option<&Run>,
        in_space: &[Difference],
        in_time: &[Difference],
    ) -> Vec<PlannedOutput> {
        let outputs = self.groups.iter().enumerate().map(|(index, group)| {
            let parts = [in_space.get(index), in_time.get(index)];
            let error: f64 = parts.iter().flatten().map(|d| d.largest).sum();
            let until = parts.iter().flatten().filter_map(|d| d.until);
            PlannedOutput {
                name: group.name.clone(),
                error,
                scale: chosen.map_or(0.0, |run| scale(group, run)),
                skips_start: group.is_dynamic,
                settles: match (error <= self.error, until.reduce(f64::min)) {
                    (true, _) => Settles::Yes,
                    (false, Some(time)) if time > 0.0 => Settles::Until(time),
                    (false, _) => Settles::No,
                },
            }
        });
        outputs.collect()
    }

    fn bodies(&self, choice: &Choice, in_space: &[Difference]) -> Vec<PlannedBody> {
        let largest = in_space.iter().enumerate();
        let largest = largest.max_by(|a, b| a.1.largest.total_cmp(&b.1.largest));
        let mut counts = choice.elements.iter().enumerate();
        let fewest = self.coarsest().unwrap_or_default();
        let bodies = self.scene.bodies.iter().map(|body| {
            let Some(_) = body.cable() else {
                return PlannedBody {
                    name: body.name().to_owned(),
                    kind: "rigid".into(),
                    elements: None,
                    fewest: None,
                    why: "as the scene says".into(),
                };
            };
            let (cable, count) = counts.next().unwrap_or((0, &0));
            let why = match (self.is_free(cable), largest) {
                (false, _) => "as the scene says".into(),
                (true, Some((group, difference))) => format!(
                    "doubling all changes {} most, by {:.1e}",
                    self.groups[group].name, difference.largest
                ),
                (true, None) => "not more could be tried".into(),
            };
            PlannedBody {
                name: body.name().to_owned(),
                kind: "cable".into(),
                elements: Some(*count),
                fewest: fewest.get(cable).copied(),
                why,
            }
        });
        bodies.collect()
    }
}

//! The account of a search: what was chosen, and why.

use super::divisions::follows;
use super::experiment::TrialRun;
use super::ladder::Choice;
use super::outputs::{Difference, RelativeTo};
use super::report::{Plan, PlannedBody, PlannedOutput, Price, Settles};
use super::response::FREQUENCIES;
use super::search::{COMPARED_MODES, Search, counted};
use crate::scene::{Body, Model, Scene};

impl Search<'_, '_> {
    /// The plan of a choice, from what doubling and a tenth of the tolerance change.
    pub fn report(
        &mut self,
        choice: &Choice,
        in_space: &[Difference],
        in_time: &[Difference],
    ) -> Plan {
        // A tolerance that was changed last has not been run with this mesh.
        let _ = self.run(choice);
        let mut double = choice.clone();
        self.refine(&mut double);
        let cheaper = self.cheaper(choice);
        let chosen = self.known(choice);
        let outputs = self.estimated(chosen, in_space, in_time);
        let largest = outputs.iter().map(|output| output.error).reduce(f64::max);
        let cost = chosen.map_or(0.0, |run| run.work);
        let method = chosen.map_or("", |run| run.method);
        let settled = self.settled(choice, &outputs);
        Plan {
            error: self.error,
            bodies: self.bodies(choice, in_space),
            tolerance: choice.tolerance,
            method,
            held: self.experiment.held.clone(),
            answers: self.answers(in_space),
            chosen: self.price(choice, largest),
            outputs,
            settled,
            cheaper,
            dearer: if double == *choice {
                None
            } else {
                self.price(&double, None)
            },
            at_bound: self.at_bound(choice),
            is_cut: self.is_cut,
            runs: self.runs.len(),
            runs_cost: if cost > 0.0 { self.work / cost } else { 0.0 },
        }
    }

    /// The choice of half the mesh, if it was run.
    fn cheaper(&mut self, choice: &Choice) -> Option<Price> {
        let is_half = |made: &Choice| {
            let mut refined = made.clone();
            self.refine(&mut refined);
            refined == *choice && made != choice
        };
        let mut made = self.runs.iter().map(|(made, _)| made);
        let half = made.find(|made| is_half(made))?.clone();
        let changes = self.compare(&half, choice, self.error).ok()?;
        let worst = changes
            .iter()
            .map(|change| change.largest)
            .fold(0.0, f64::max);
        self.price(&half, Some(worst))
    }

    pub(super) fn price(&self, choice: &Choice, error: Option<f64>) -> Option<Price> {
        let run = self.known(choice)?;
        let planned = self.planned(choice);
        let time = run.times.last().copied().filter(|time| *time > 0.0)?;
        Some(Price {
            elements: self.counts(choice, &planned),
            meshes: meshes(&planned),
            tolerance: choice.tolerance,
            work: run.work / time,
            error,
        })
    }

    /// Elements of lines and modes of reduced bodies of a choice, which makes this scene; stiffeners have those of their lines.
    fn counts(&self, choice: &Choice, planned: &Scene) -> Vec<u32> {
        let own = choice.elements[..self.first_division()].iter();
        let bodies = counted(self.scene).zip(own);
        let counts = bodies.map(|(body, count)| match planned.bodies[body].cable() {
            Some(line) if follows(self.scene, body) => line.elements.unwrap_or(*count),
            _ => *count,
        });
        counts.collect()
    }

    /// Lists the changes on doubling the mesh of the responses to inputs that are held, and of natural frequencies.
    /// Empty for given meshes.
    fn answers(&self, in_space: &[Difference]) -> Vec<(String, f64)> {
        if !self.is_any_free() {
            return Vec::new();
        }
        let still = self.outputs().len()..in_space.len();
        let told = still.map(|index| (self.name(index), in_space[index].largest));
        // Nothing changes where no frequency was compared.
        told.filter(|(name, change)| name != FREQUENCIES || *change > 0.0)
            .collect()
    }

    fn estimated(
        &self,
        chosen: Option<&TrialRun>,
        in_space: &[Difference],
        in_time: &[Difference],
    ) -> Vec<PlannedOutput> {
        let outputs = self.outputs().iter().enumerate().map(|(index, group)| {
            let parts = [in_space.get(index), in_time.get(index)];
            let error: f64 = parts.iter().flatten().map(|d| d.largest).sum();
            let until = parts.iter().flatten().filter_map(|d| d.until);
            let scale = chosen.map_or((0.0, RelativeTo::Own), |run| run.scales[index]);
            PlannedOutput {
                name: group.name.clone(),
                error,
                scale: scale.0,
                relative_to: scale.1,
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
        let largest = largest.filter(|(_, difference)| difference.largest.is_finite());
        let changes = largest.map(|(group, difference)| {
            format!(
                "changes {} most, by {:.1e}",
                self.name(group),
                difference.largest
            )
        });
        let with_counts: Vec<usize> = counted(self.scene).collect();
        let planned = self.planned(choice);
        let counts = self.counts(choice, &planned);
        let bodies = self.scene.bodies.iter().enumerate().map(|(index, body)| {
            if let Some(patch) = planned.bodies[index].patch() {
                return self.planned_patch(index, patch.mesh.counts, changes.as_deref());
            }
            let place = with_counts.iter().position(|of| *of == index);
            let count = place.map_or(0, |place| counts[place]);
            let follows = follows(self.scene, index);
            let is_free = place.is_some_and(|place| self.is_free(place));
            let modes = place.and_then(|place| *choice.modes.get(place)?);
            let given = body.cable().filter(|line| line.model == Model::Modal);
            let modes = modes.or(given.and_then(|line| line.modes));
            let why = match (is_free, &changes, count) {
                _ if follows => "as many as the line that it stiffens has".into(),
                (false, ..) => "as the scene says".into(),
                (true, Some(changes), 0) => format!("to let it bend {changes}"),
                (true, Some(changes), _) if modes.is_some() => {
                    format!("taking twice its elements {changes}")
                }
                (true, Some(changes), _) if body.reduced().is_some() => {
                    format!("taking {COMPARED_MODES} modes or more {changes}")
                }
                (true, Some(changes), _) => format!("doubling all {changes}"),
                (true, None, _) => "not more could be tried".into(),
            };
            let line = body.cable().map(|line| line.sections.element());
            let (kind, elements) = match (count, line) {
                _ if modes.is_some() => ("modal", modes),
                (0, None) if place.is_none() && body.reduced().is_some() => ("reduced", None),
                (0, _) => ("rigid", None),
                (count, None) => ("reduced", Some(count)),
                (count, Some(element)) => (element, Some(count)),
            };
            PlannedBody {
                name: body.name().to_owned(),
                kind,
                elements,
                mesh: None,
                fewest: place.map(|place| self.fewest[place]),
                why,
            }
        });
        bodies.collect()
    }

    /// The account of a plate or shell, by its place among the bodies.
    fn planned_patch(&self, index: usize, mesh: [u32; 2], changes: Option<&str>) -> PlannedBody {
        let body = &self.scene.bodies[index];
        let is_open = body.patch().map(|patch| patch.mesh.is_open);
        let is_free = self.divisions.iter().any(|division| {
            let mut directions = division.directions.iter();
            directions.any(|(of, _)| *of == index)
        });
        let why = match (is_free, changes) {
            (true, Some(changes)) => format!("doubling all {changes}"),
            (true, None) => "not more could be tried".into(),
            (false, _) if is_open.is_some_and(|is_open| is_open.contains(&true)) => {
                "as many as what it is joined with has".into()
            }
            (false, _) => "as the scene says".into(),
        };
        PlannedBody {
            name: body.name().to_owned(),
            kind: match body {
                Body::Plate(_) => "plate",
                _ => "shell",
            },
            elements: None,
            mesh: Some(mesh),
            fewest: None,
            why,
        }
    }
}

/// Numbers of elements of all plates and shells.
fn meshes(scene: &Scene) -> Vec<[u32; 2]> {
    let patches = scene.bodies.iter().filter_map(Body::patch);
    patches.map(|patch| patch.mesh.counts).collect()
}

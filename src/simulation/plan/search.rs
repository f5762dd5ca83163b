//! The search for meshes and a tolerance.

use super::divisions::{elements_of, follows, open_divisions};
use super::experiment::{PlannedExperiment, TrialRun, Unfinished};
use super::given::TrialConditions;
use super::ladder::Choice;
use super::modal::with_all_modes;
use super::outputs::{Difference, OutputGroup, difference, groups, scales};
use super::report::Plan;
use super::response::Responses;
use super::shear::{Beam, Sheared};
use super::{Budget, Progress};
use crate::scene::{
    Accuracy, Axial, Body, BodyReference, Division, Error, FileBody, FixedInterfaceModes, LineBody,
    Model, Modes, Scene,
};
use crate::simulation::{check, variables};

/// Part of the error wanted that doubling may change.
pub(super) const OF_SPACE: f64 = 2.0 / 3.0;
/// Part of the error wanted that all doublings to come and the tolerance may change together, where they converge regularly.
pub(super) const SHARED: f64 = 0.9;
/// The tightest tolerance: below it roundoff makes the steps of motions of any size.
pub(super) const TIGHTEST: f64 = 1e-13;
/// Part of the work of planning that one run of the coarsest mesh may take, where finer ones are to be tried.
const OF_ONE: f64 = 0.25;
/// Most elements of a cable, and runs; of a fuzzer few, so that it gets on.
const MOST_ELEMENTS: u32 = if cfg!(fuzzing) { 8 } else { 1024 };
/// Fewest modes of reduced bodies that fewer ones are compared with.
pub(super) const COMPARED_MODES: u32 = 16;
const MOST_RUNS: usize = if cfg!(fuzzing) { 4 } else { 40 };

/// A search under way.
pub(super) struct Search<'a, 'p> {
    pub scene: &'a Scene,
    /// Outputs: first those that count.
    pub groups: Vec<OutputGroup>,
    /// Number of outputs that count.
    pub(super) counting: usize,
    pub experiment: PlannedExperiment,
    /// Error wanted.
    pub error: f64,
    /// Runs so far, and the work of all of them.
    pub runs: Vec<(Choice, Result<TrialRun, Unfinished>)>,
    pub work: f64,
    /// As few elements of every cable as there can be while it bends, or as many as are given; none of one that is said
    /// to be rigid.
    pub fewest: Vec<u32>,
    /// Numbers of elements of plates and shells that are left to the planner.
    pub(super) divisions: Vec<Division>,
    /// Bodies that may be beams.
    pub(super) beams: Vec<Beam>,
    /// The loosest tolerance that may be chosen.
    pub(super) loosest: f64,
    /// Most work of all runs, the part of it that one run may take, and whether planning has taken the time that it may: clocks decide
    /// only where counts do not.
    most_work: f64,
    share: f64,
    is_over: &'a dyn Fn() -> bool,
    /// Whether either has ended the search.
    pub(super) is_cut: bool,
    progress: Progress<'p>,
}

/// Cables of a scene, with their places among the bodies.
pub(super) fn cables(scene: &Scene) -> impl Iterator<Item = (usize, &LineBody)> {
    let bodies = scene.bodies.iter().enumerate();
    bodies.filter_map(|(index, body)| Some((index, body.cable()?)))
}

/// Reduced bodies of a scene whose number of modes is left to the planner, with their places among the bodies.
pub(super) fn open_reduced(scene: &Scene) -> impl Iterator<Item = (usize, &FileBody)> {
    let bodies = scene.bodies.iter().enumerate();
    let reduced = bodies.filter_map(|(index, body)| Some((index, body.reduced()?)));
    reduced.filter(|(_, body)| body.is_open())
}

/// Places among the bodies of those that have numbers of elements or modes, in the order of [`Choice::elements`].
pub(super) fn counted(scene: &Scene) -> impl Iterator<Item = usize> {
    let lines = cables(scene).map(|(body, _)| body);
    lines.chain(open_reduced(scene).map(|(body, _)| body))
}

/// The scene with a body rigid, by its place among the bodies: not valid where it is curved or what is read of it, or
/// slides along it, takes one that bends.
fn with_rigid(mut scene: Scene, body: usize) -> Scene {
    match &mut scene.bodies[body] {
        Body::Reduced(reduced) => reduced.modes = Modes::Count(0),
        line => {
            if let Some(line) = line.cable_mut() {
                line.model = Model::Rigid;
            }
        }
    }
    scene
}

/// The scene with numbers of elements and modes, in the order of [`counted`], then of elements of plates and shells; with 0 a body is rigid.
/// Stiffeners take the number of their lines.
pub(super) fn with_counts(mut scene: Scene, counts: &[u32]) -> Scene {
    let bodies: Vec<usize> = counted(&scene).collect();
    scene.divide(counts[bodies.len()..].iter().copied());
    for (body, count) in bodies.into_iter().zip(counts) {
        if *count == 0 {
            scene = with_rigid(scene, body);
        } else if let Body::Reduced(reduced) = &mut scene.bodies[body] {
            reduced.modes = Modes::FixedInterface(FixedInterfaceModes {
                fixed_interface: *count,
            });
        } else if let Some(line) = scene.bodies[body].cable_mut()
            && line.model != Model::Modal
        {
            line.elements.get_or_insert(*count);
        }
    }
    scene
}

/// Returns the least number of elements of every line body, 0 for rigid ones (see [`Search::fewest`]); one mode of reduced bodies whose number
/// of modes is open; of plates and shells as few as joints allow.
///
/// # Errors
/// A scene that is not valid, or markers that are too close for nodes.
pub(super) fn fewest(scene: &Scene) -> Result<Vec<u32>, Error> {
    let resolved = scene.resolve()?;
    let counts = resolved.bodies.iter().filter_map(|body| {
        let BodyReference::Cable(cable) = body else {
            return None;
        };
        Some(match (cable.body.model, cable.body.elements) {
            (Model::Rigid, _) => Ok(0),
            (Model::Modal, _) => Ok(1),
            (_, Some(count)) => Ok(count),
            (_, None) => resolved.fewest_elements(*cable),
        })
    });
    let mut counts: Vec<u32> = counts.collect::<Result<_, _>>()?;
    counts.extend(open_reduced(scene).map(|_| 1));
    for division in open_divisions(scene) {
        let stiffeners = resolved.bodies.iter().enumerate();
        let stiffeners = stiffeners.filter_map(|(body, of)| match of {
            BodyReference::Cable(cable) if division.stiffeners.contains(&body) => Some(*cable),
            _ => None,
        });
        let stiffeners: Vec<_> = stiffeners.collect();
        let even = resolved.evenly(&stiffeners, division.count);
        counts.push(even.unwrap_or(division.count));
    }
    Ok(counts)
}

impl<'a, 'p> Search<'a, 'p> {
    /// For a scene that leaves something to the planner, with bodies that may be beams.
    ///
    /// # Errors
    /// A name in `accuracy` that the scene does not have; what is not valid.
    pub fn new(
        scene: &'a Scene,
        given: &TrialConditions,
        beams: Vec<Beam>,
        budget: &Budget<'a>,
        progress: Progress<'p>,
    ) -> Result<Self, Error> {
        let groups = groups(scene, &variables(scene))?;
        Ok(Self {
            beams,
            counting: groups.iter().filter(|group| group.counts).count(),
            groups,
            experiment: PlannedExperiment::new(scene, given)?,
            error: scene.error(),
            scene,
            runs: Vec::new(),
            work: 0.0,
            fewest: fewest(scene)?,
            divisions: open_divisions(scene).collect(),
            loosest: f64::INFINITY,
            most_work: budget.work(),
            share: 1.0,
            is_over: budget.is_over,
            is_cut: false,
            progress,
        })
    }

    /// The planned scene, its plan, and what shear of bodies that may be beams would change.
    ///
    /// # Errors
    /// An experiment that cannot be run with any mesh.
    pub fn find(&mut self) -> Result<(Scene, Plan, Vec<Sheared>), Error> {
        let mut choice = Choice {
            elements: self.fewest.clone(),
            tolerance: self.first_tolerance(),
            ..Choice::default()
        };
        // What contradicts itself is told with its place.
        check(&self.planned(&choice))?;
        // Runs that converge slowly in time leave work for meshes.
        self.share = if self.is_any_free() { OF_ONE } else { 1.0 };
        let in_time = self.find_tolerance(&mut choice)?;
        self.share = 1.0;
        let in_space = self.find_elements(&mut choice, &in_time)?;
        let found_with = choice.tolerance;
        let in_time = match self.verify_tolerance(&mut choice, &in_space, &in_time) {
            Ok(verified) => verified.unwrap_or(in_time),
            Err(_) => self.unverified(&choice, in_time),
        };
        let in_space = if choice.tolerance < found_with {
            match self.refine_resolved(&mut choice, &in_space) {
                Some(found) => found,
                None => self.coarsen(&mut choice, in_space),
            }
        } else {
            in_space
        };
        let in_space = if self.is_cut {
            self.measured(&choice, in_space)
        } else {
            in_space
        };
        let in_space = self.reduce_lines(&mut choice, in_space);
        let sheared = self.shear(&choice);
        let plan = self.report(&choice, &in_space, &in_time);
        let mut scene = self.planned(&choice);
        scene.accuracy.notes = plan.missed();
        if !plan.held.is_empty() {
            scene.accuracy.notes.insert(0, plan.in_a_line());
        }
        Ok((scene, plan, sheared))
    }

    /// A mesh with all cables rigid that may be.
    pub(super) fn stiffest(&self, elements: &[u32]) -> Vec<u32> {
        let cables = cables(self.scene).zip(elements);
        let least = cables.map(|((body, cable), count)| {
            // What has no bending stiffness does not push.
            let bends = cable.bending_stiffness() > 0.0;
            let is_open = cable.elements.is_none() && cable.model == Model::Auto && bends;
            if is_open && with_rigid(self.scene.clone(), body).resolve().is_ok() {
                0
            } else {
                *count
            }
        });
        let reduced = open_reduced(self.scene).map(|(body, _)| {
            // Stress is read of what deforms.
            u32::from(with_rigid(self.scene.clone(), body).resolve().is_err())
        });
        let divided = elements[self.first_division()..].iter().copied();
        least.chain(reduced).chain(divided).collect()
    }

    /// Whether the number of elements or modes of a body is left to the planner, by its place among those that have one.
    pub fn is_free(&self, counted_body: usize) -> bool {
        match cables(self.scene).nth(counted_body) {
            Some((body, line)) => {
                let is_open = line.elements.is_none() && line.model.has_elements();
                is_open && !follows(self.scene, body)
            }
            None => {
                counted_body >= self.first_division() || self.most_modes(counted_body).is_some()
            }
        }
    }

    /// Number of modes of the file of a reduced body whose number of modes is open, by its place among the bodies that have a number.
    fn most_modes(&self, counted_body: usize) -> Option<u32> {
        let lines = cables(self.scene).count();
        let (_, body) = open_reduced(self.scene).nth(counted_body.checked_sub(lines)?)?;
        u32::try_from(body.first_modes()).ok()
    }

    /// Whether the number of elements of any cable is left to the planner.
    pub(super) fn is_any_free(&self) -> bool {
        (0..self.fewest.len()).any(|cable| self.is_free(cable))
    }

    pub(super) fn planned(&self, choice: &Choice) -> Scene {
        let mut scene = self.scene.clone();
        for beam in &choice.beams {
            self.beams[*beam].put_into(&mut scene);
        }
        let rigid = cables(self.scene).zip(&choice.elements);
        let bends = rigid.filter(|(_, count)| choice.is_settled && **count > 0);
        for ((body, _), _) in bends {
            if let Some(line) = scene.bodies[body].cable_mut() {
                line.axial = Axial::CriticallyDamped;
            }
        }
        scene = with_all_modes(with_counts(scene, &choice.elements), choice);
        scene.accuracy = Accuracy {
            error: Some(self.error),
            relative_tolerance: Some(choice.tolerance),
            ..Accuracy::default()
        };
        if choice.is_halved {
            scene.experiment.step *= 0.5;
        }
        scene
    }

    /// The place of the run with a choice among those made, if it was.
    fn place(&self, choice: &Choice) -> Option<usize> {
        self.runs.iter().position(|(made, _)| made == choice)
    }

    /// The run with a choice, if it was made and finished.
    pub fn known(&self, choice: &Choice) -> Option<&TrialRun> {
        self.finished(self.place(choice)?).ok()
    }

    fn finished(&self, place: usize) -> Result<&TrialRun, Unfinished> {
        self.runs[place].1.as_ref().map_err(Clone::clone)
    }

    /// Returns the run of a choice. Each choice runs once.
    ///
    /// # Errors
    /// The work limit is reached, or the run fails.
    pub fn run(&mut self, choice: &Choice) -> Result<&TrialRun, Unfinished> {
        let place = match self.place(choice) {
            Some(place) => place,
            None => {
                let run = self.make(choice);
                self.runs.push((choice.clone(), run));
                self.runs.len() - 1
            }
        };
        self.finished(place)
    }

    /// Returns the responses with the mesh of a choice, if a run with another tolerance has computed them.
    fn responses(&self, choice: &Choice) -> Option<Responses> {
        let mesh = |of: &Choice| Choice {
            tolerance: 0.0,
            is_halved: false,
            ..of.clone()
        };
        let mut made = self.runs.iter();
        let same = made.find(|(made, run)| run.is_ok() && mesh(made) == mesh(choice));
        same.and_then(|(_, run)| Some(run.as_ref().ok()?.responses.clone()))
    }

    /// Grants a part of the work of planning beside what is left.
    pub fn grant(&mut self, part: f64) {
        self.most_work = self.most_work.max(self.work) + part * self.most_work;
    }

    fn make(&mut self, choice: &Choice) -> Result<TrialRun, Unfinished> {
        let scene = self.planned(choice);
        (self.progress)(self.runs.len() + 1, elements_of(&scene), choice.tolerance);
        let left = self.most_work - self.work;
        if self.runs.len() >= MOST_RUNS || left <= 0.0 || (self.is_over)() {
            self.is_cut = true;
            return Err(Unfinished::TooMuchWork);
        }
        let most = left.min(self.share * self.most_work);
        let responses = self.responses(choice);
        let mut run = (self.experiment).run(scene, responses, most, self.is_over);
        let is_last = most == left || (self.is_over)();
        self.is_cut |= matches!(run, Err(Unfinished::TooMuchWork)) && is_last;
        if let Ok(run) = &mut run {
            run.scales = scales(&self.groups, run);
        }
        self.work += match &run {
            Ok(run) => run.work,
            Err(Unfinished::TooMuchWork) => most,
            Err(Unfinished::Failed(_)) => 0.0,
        };
        run
    }

    /// Whether the runs with two choices ended with one integrator, or neither was finished.
    pub fn end_alike(&mut self, choices: [&Choice; 2]) -> bool {
        let [one, other] = choices.map(|choice| self.run(choice).map(|run| run.method).ok());
        one == other
    }

    /// Compares all outputs between a choice and a more accurate one.
    ///
    /// # Errors
    /// The work limit is reached, or one of the runs fails.
    pub fn compare(
        &mut self,
        choice: &Choice,
        closer: &Choice,
        limit: f64,
    ) -> Result<Vec<Difference>, Unfinished> {
        self.run(choice)?;
        self.run(closer)?;
        let Some((run, closer)) = self.known(choice).zip(self.known(closer)) else {
            return Err(Unfinished::TooMuchWork);
        };
        let counting = self.groups[..self.counting].iter().enumerate();
        let of_outputs =
            counting.map(|(index, group)| difference(group, index, run, closer, limit));
        let held = 0..self.experiment.held.len();
        let [own, fine] = [run, closer].map(|run| &run.responses);
        let of_inputs = held.map(|input| {
            let components = self.experiment.components(input);
            own.difference(fine, input, &components, &self.groups)
        });
        let of_frequencies = self.tunes().then(|| own.detuned(fine));
        let still = of_inputs.chain(of_frequencies).map(|largest| Difference {
            largest,
            until: (largest > limit).then_some(0.0),
        });
        Ok(of_outputs.chain(still).collect())
    }

    /// Returns the differences of outputs that could not be compared: infinite, from the start.
    pub fn unknown(&self) -> Vec<Difference> {
        let unknown = Difference {
            largest: f64::INFINITY,
            until: Some(0.0),
        };
        vec![unknown; self.compared()]
    }

    /// Doubles all numbers of elements and modes that are free, and lets rigid bodies bend; false where there are none or too many.
    pub fn refine(&self, choice: &mut Choice) -> bool {
        let mut refined = false;
        let first = self.first_division();
        let doubled = self.doubled(choice);
        for (count, is_doubled) in choice.elements[first..].iter_mut().zip(doubled) {
            if is_doubled {
                *count *= 2;
                refined = true;
            }
        }
        for (body, count) in choice.elements[..first].iter_mut().enumerate() {
            let most_modes = self.most_modes(body);
            if self.is_free(body) && *count < most_modes.unwrap_or(MOST_ELEMENTS) {
                let doubled = (2 * *count).max(self.fewest[body]);
                *count = doubled.min(most_modes.unwrap_or(u32::MAX));
                refined = true;
            }
        }
        refined
    }

    /// The choice with more modes of reduced bodies than doubling gives: single modes may change nothing while those above them do, so that
    /// few modes are compared with many.
    pub fn with_more_modes(&self, choice: &Choice) -> Choice {
        let mut closer = choice.clone();
        for (body, count) in closer.elements.iter_mut().enumerate() {
            if let Some(most) = self.most_modes(body) {
                *count = most.min((2 * *count).max(COMPARED_MODES));
            }
        }
        closer
    }

    /// Returns limits that are the same part of the wanted error for every output.
    pub fn equal(&self, part: f64) -> Vec<f64> {
        vec![part * self.error; self.compared()]
    }
}

//! The search for meshes and a tolerance.

use super::Progress;
use super::experiment::{Experiment, Run, Unfinished};
use super::ladder::{Choice, Ladder};
use super::outputs::{Difference, Group, difference, groups};
use super::report::Plan;
use crate::scene::{Body, BodyReference, Error, Scene};
use crate::simulation::{Variable, check, variables};

/// Parts of the error wanted that doubling, and a tenth of the tolerance, may change.
const OF_SPACE: f64 = 2.0 / 3.0;
const OF_TIME: f64 = 1.0 / 3.0;
/// Tolerance above which a tenth of it says less of the error: what it changes counts this many times.
const LOOSE: f64 = 1e-4;
const DOUBT: f64 = 3.0;
/// The loosest tolerance that is tried, and the first and the last in errors wanted.
const LOOSEST: f64 = 1e-2;
const FIRST: f64 = 10.0;
const LAST: f64 = 1e-3;
/// Most cables of which single ones are tried with fewer elements.
const MOST_SINGLE: usize = 4;
/// Most elements of a cable, runs, and work of all of them (some seconds).
const MOST_ELEMENTS: u32 = 1024;
const MOST_RUNS: usize = 30;
const MOST_WORK: f64 = if cfg!(fuzzing) { 1e5 } else { 1e8 };

/// A search under way.
pub(super) struct Search<'a, 'p> {
    pub scene: &'a Scene,
    pub variables: Vec<Variable>,
    pub groups: Vec<Group>,
    experiment: Experiment,
    /// Error wanted.
    pub error: f64,
    /// Runs so far, and the work of all of them.
    pub runs: Vec<(Choice, Result<Run, Unfinished>)>,
    pub work: f64,
    progress: Progress<'p>,
}

impl<'a, 'p> Search<'a, 'p> {
    /// For a scene that leaves something to the planner.
    ///
    /// # Errors
    /// A name in `accuracy` that the scene does not have.
    pub fn new(scene: &'a Scene, progress: Progress<'p>) -> Result<Self, Error> {
        let variables = variables(scene);
        Ok(Self {
            groups: groups(scene, &variables)?,
            experiment: Experiment::new(scene)?,
            error: scene.error(),
            scene,
            variables,
            runs: Vec::new(),
            work: 0.0,
            progress,
        })
    }

    /// The planned scene, and its plan.
    ///
    /// # Errors
    /// An experiment that cannot be run with any mesh.
    pub fn find(mut self) -> Result<(Scene, Plan), Error> {
        let mut choice = Choice {
            elements: self.coarsest()?,
            tolerance: self.first_tolerance(),
        };
        // What contradicts itself is told with its place.
        check(&self.planned(&choice))?;
        let in_time = self.find_tolerance(&mut choice)?;
        let in_space = self.find_elements(&mut choice)?;
        let in_time = self.verify_tolerance(&mut choice).unwrap_or(in_time);
        Ok((
            self.planned(&choice),
            self.report(&choice, &in_space, &in_time),
        ))
    }

    /// As many elements as are given, or as few as there can be.
    pub fn coarsest(&self) -> Result<Vec<u32>, Error> {
        let resolved = self.scene.resolve()?;
        let cables = resolved.bodies.iter().filter_map(|body| match body {
            BodyReference::Cable(cable) => Some(*cable),
            BodyReference::Rigid(_) => None,
        });
        cables
            .map(|cable| match cable.body.elements {
                Some(count) => Ok(count),
                None => resolved.fewest_elements(cable),
            })
            .collect()
    }

    /// Whether the number of elements of a cable is left to the planner.
    pub fn is_free(&self, cable: usize) -> bool {
        let mut cables = self.scene.bodies.iter().filter_map(Body::cable);
        cables
            .nth(cable)
            .is_some_and(|body| body.elements.is_none())
    }

    fn first_tolerance(&self) -> f64 {
        let first = decade(FIRST * self.error).min(LOOSEST);
        self.scene.accuracy.relative_tolerance.unwrap_or(first)
    }

    fn planned(&self, choice: &Choice) -> Scene {
        let mut scene = self.scene.clone();
        let cables = scene.bodies.iter_mut().filter_map(Body::cable_mut);
        for (cable, count) in cables.zip(&choice.elements) {
            cable.elements = Some(*count);
        }
        scene.accuracy = crate::scene::Accuracy {
            relative_tolerance: Some(choice.tolerance),
            ..Default::default()
        };
        scene
    }

    /// The run with a choice; one that was made before is not made again.
    pub fn run(&mut self, choice: &Choice) -> Result<&Run, Unfinished> {
        let known = self.runs.iter().position(|(made, _)| made == choice);
        let index = match known {
            Some(index) => index,
            None => {
                let elements = choice.elements.iter().sum();
                (self.progress)(self.runs.len() + 1, elements, choice.tolerance);
                let left = match self.runs.len() < MOST_RUNS {
                    true => MOST_WORK - self.work,
                    false => 0.0,
                };
                let scene = self.planned(choice);
                let run = match left > 0.0 {
                    true => self.experiment.run(scene, left),
                    false => Err(Unfinished::TooMuchWork),
                };
                self.work += match &run {
                    Ok(run) => run.work,
                    Err(Unfinished::TooMuchWork) => left.max(0.0),
                    Err(Unfinished::Failed(_)) => 0.0,
                };
                self.runs.push((choice.clone(), run));
                self.runs.len() - 1
            }
        };
        self.runs[index].1.as_ref().map_err(Clone::clone)
    }

    /// What all outputs change from one choice to another that is closer to the truth.
    pub fn compare(
        &mut self,
        choice: &Choice,
        closer: &Choice,
        limit: f64,
    ) -> Result<Vec<Difference>, Unfinished> {
        let run = self.run(choice)?.clone();
        let groups = self.groups.clone();
        let closer = self.run(closer)?;
        let found = groups
            .iter()
            .map(|group| difference(group, &run, closer, limit));
        Ok(found.collect())
    }

    /// The loosest tolerance that the coarsest mesh allows, and what a tenth of it changes.
    fn find_tolerance(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Error> {
        loop {
            match self.loosest(choice) {
                Ok(found) => return Ok(found),
                // A mesh that is too coarse to be run says nothing of time.
                Err(Unfinished::Failed(reason)) => {
                    if !self.refine(choice) {
                        return Err(Error::new("experiment", reason));
                    }
                }
                Err(Unfinished::TooMuchWork) => return Ok(Vec::new()),
            }
        }
    }

    /// The loosest tolerance from that of a choice on, and what a tenth of it changes.
    fn loosest(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Unfinished> {
        let is_given = self.scene.accuracy.relative_tolerance.is_some();
        let mut ladder = Ladder::new(OF_TIME * self.error);
        let mut tried = choice.clone();
        loop {
            let found = self.in_time(&tried);
            match (found, ladder.rungs.is_empty()) {
                (Ok(found), _) => ladder.add(&tried, found),
                (Err(reason), true) => return Err(reason),
                (Err(_), false) => break,
            }
            if ladder.is_climbed() || is_given || tried.tolerance < 1.5 * LAST * self.error {
                break;
            }
            tried.tolerance = tenth(tried.tolerance);
        }
        let (best, found) = ladder.best().unwrap_or_default();
        choice.tolerance = best.tolerance;
        Ok(found)
    }

    /// What a tenth of the tolerance changes.
    fn in_time(&mut self, choice: &Choice) -> Result<Vec<Difference>, Unfinished> {
        let closer = Choice {
            tolerance: tenth(choice.tolerance),
            ..choice.clone()
        };
        let doubt = match choice.tolerance > LOOSE {
            true => DOUBT,
            false => 1.0,
        };
        let mut found = self.compare(choice, &closer, self.error)?;
        found
            .iter_mut()
            .for_each(|difference| difference.largest *= doubt);
        Ok(found)
    }

    /// Doubles all numbers of elements that are free; false where there are none or too many.
    fn refine(&self, choice: &mut Choice) -> bool {
        let mut refined = false;
        for (cable, count) in choice.elements.iter_mut().enumerate() {
            if self.is_free(cable) && *count < MOST_ELEMENTS {
                *count *= 2;
                refined = true;
            }
        }
        refined
    }

    /// The coarsest mesh that doubling changes by no more than may be, and what it changes.
    fn find_elements(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Error> {
        let mut ladder = Ladder::new(OF_SPACE * self.error);
        let mut tried = choice.clone();
        loop {
            let mut closer = tried.clone();
            if !self.refine(&mut closer) {
                break;
            }
            match self.compare(&tried, &closer, self.error) {
                Ok(found) => ladder.add(&tried, found),
                Err(Unfinished::TooMuchWork) => break,
                Err(Unfinished::Failed(reason)) => {
                    let mut next = closer.clone();
                    if !self.refine(&mut next) {
                        return Err(Error::new("experiment", reason));
                    }
                }
            }
            if ladder.is_climbed() {
                break;
            }
            tried = closer;
        }
        let Some((best, found)) = ladder.best() else {
            return Ok(Vec::new());
        };
        *choice = best;
        let mut closer = choice.clone();
        self.refine(&mut closer);
        self.coarsen_one_by_one(choice, &closer, &found);
        let last = self
            .compare(choice, &closer, self.error)
            .unwrap_or_default();
        let worst = |(a, b): (&Difference, &Difference)| a.worst(*b);
        Ok(match last.is_empty() {
            true => found,
            false => found.iter().zip(&last).map(worst).collect(),
        })
    }

    /// Halves the numbers of elements of single cables while that changes no more than may be.
    fn coarsen_one_by_one(&mut self, choice: &mut Choice, closer: &Choice, found: &[Difference]) {
        let fewest = self.coarsest().unwrap_or_default();
        let cables: Vec<usize> = (0..choice.elements.len())
            .filter(|i| self.is_free(*i))
            .collect();
        if !(2..=MOST_SINGLE).contains(&cables.len()) {
            return;
        }
        let limit = OF_SPACE * self.error;
        for cable in cables {
            let mut tried = choice.clone();
            tried.elements[cable] /= 2;
            if tried.elements[cable] < fewest[cable] {
                continue;
            }
            let changed = self.compare(&tried, closer, self.error);
            let keeps = |(now, before): (&Difference, &Difference)| {
                now.largest <= limit || now.largest <= before.largest
            };
            if changed.is_ok_and(|changed| changed.iter().zip(found).all(keeps)) {
                *choice = tried;
            }
        }
    }

    /// Whether the tolerance found with the coarsest mesh is good enough for the one chosen, by one half as fine;
    /// else a tighter one. What a tenth of it changes.
    fn verify_tolerance(&mut self, choice: &mut Choice) -> Option<Vec<Difference>> {
        let fewest = self.coarsest().ok()?;
        let halves = choice.elements.iter().zip(&fewest);
        let mut half = Choice {
            elements: halves
                .map(|(count, least)| (count / 2).max(*least))
                .collect(),
            tolerance: choice.tolerance,
        };
        if half.elements == fewest {
            return None;
        }
        let found = self.loosest(&mut half).ok()?;
        choice.tolerance = half.tolerance;
        Some(found)
    }
}

/// A tenth of a tolerance, as a power of ten where it is one.
fn tenth(tolerance: f64) -> f64 {
    match tolerance == decade(tolerance) {
        true => decade(0.1 * tolerance),
        false => 0.1 * tolerance,
    }
}

/// The nearest power of ten, as it would be written.
fn decade(value: f64) -> f64 {
    format!("1e{}", value.log10().round())
        .parse()
        .unwrap_or(value)
}

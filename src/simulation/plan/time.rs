//! The search for a tolerance: what a tenth of it changes.

use super::experiment::Unfinished;
use super::ladder::{Choice, Ladder};
use super::outputs::{Difference, are_kept};
use super::search::Search;
use crate::scene::Error;

/// Part of the error wanted that a tenth of the tolerance may change.
const OF_TIME: f64 = 1.0 / 3.0;
/// Tolerance above which a tenth of it says less of the error: what it changes counts this many times.
const LOOSE: f64 = 1e-4;
const DOUBT: f64 = 3.0;
/// Steps of one run over those of another below which both took the same ones.
const ALIKE: f64 = 1.2;
/// The loosest tolerance that is tried, and the last in errors wanted. None looser than the error wanted: with short
/// communication steps it would do, and with longer ones not.
const LOOSEST: f64 = 1e-2;
const LAST: f64 = 1e-3;

impl Search<'_, '_> {
    /// The first tolerance that is tried: the one given, or the loosest.
    pub(super) fn first_tolerance(&self) -> f64 {
        let first = decade(self.error).min(LOOSEST);
        self.scene.accuracy.relative_tolerance.unwrap_or(first)
    }

    /// The loosest tolerance that the coarsest mesh allows, and what a tenth of it changes.
    pub(super) fn find_tolerance(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Error> {
        loop {
            match self.loosest(choice) {
                Ok(found) => return Ok(found),
                // A mesh that is too coarse to be run says nothing of time.
                Err(Unfinished::Failed(reason)) => {
                    if !self.refine(choice) {
                        return Err(Error::new("experiment", reason));
                    }
                }
                Err(Unfinished::TooMuchWork) => return Ok(self.unknown()),
            }
        }
    }

    /// The loosest tolerance from that of a choice on, and what a tenth of it changes.
    fn loosest(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Unfinished> {
        let is_given = self.scene.accuracy.relative_tolerance.is_some();
        let mut ladder = Ladder::new(OF_TIME * self.error);
        let mut tried = choice.clone();
        loop {
            match (self.in_time(&tried), ladder.rungs.is_empty()) {
                (Ok(found), _) => ladder.add(&tried, found),
                (Err(reason), true) => return Err(reason),
                (Err(_), false) => break,
            }
            if ladder.is_climbed() || is_given {
                break;
            }
            // A tighter one that takes the same steps changes nothing.
            let steps = self.steps(&tried);
            let mut is_open = tried.tolerance >= 1.5 * LAST * self.error;
            while is_open {
                tried.tolerance = tenth(tried.tolerance);
                if self.steps(&tried) >= ALIKE * steps {
                    break;
                }
                is_open = tried.tolerance >= 1.5 * LAST * self.error;
            }
            if !is_open {
                break;
            }
        }
        let (best, found) = ladder.best().unwrap_or_default();
        choice.tolerance = best.tolerance;
        Ok(found)
    }

    /// What outputs change from a looser tolerance to a tenth of the best, if that is no more than may be: a hundredth of
    /// it says more of its error than a tenth.
    fn by_tightest(
        &mut self,
        looser: &Choice,
        best: &Choice,
        found: &[Difference],
    ) -> Option<Vec<Difference>> {
        let tightest = Choice {
            tolerance: tenth(best.tolerance),
            ..best.clone()
        };
        self.known(&tightest)?;
        let now = self.compare(looser, &tightest, self.error).ok()?;
        are_kept(&now, found, OF_TIME * self.error).then_some(now)
    }

    /// Sub-steps of a run that was made.
    fn steps(&mut self, choice: &Choice) -> f64 {
        self.run(choice).map_or(0.0, |run| run.steps as f64)
    }

    /// What a tenth of the tolerance changes; where that takes the same steps, since communication points end them, what
    /// halves of these change.
    fn in_time(&mut self, choice: &Choice) -> Result<Vec<Difference>, Unfinished> {
        let mut closer = Choice {
            tolerance: tenth(choice.tolerance),
            ..choice.clone()
        };
        let steps = self.run(choice)?.steps as f64;
        closer.is_halved = (self.run(&closer)?.steps as f64) < ALIKE * steps;
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

    /// A mesh that `auto` takes with another integrator than a coarser one makes other errors in time: the tolerance that it
    /// needs.
    pub(super) fn tighten(&mut self, coarser: &Choice, choice: &mut Choice) {
        let mut tried = choice.clone();
        if !self.end_alike([coarser, choice]) && self.loosest(&mut tried).is_ok() {
            choice.tolerance = tried.tolerance;
        }
    }

    /// Whether the tolerance found with the coarsest mesh is good enough for the one chosen, by one half as fine;
    /// else a tighter one. What a tenth of it changes.
    pub(super) fn verify_tolerance(&mut self, choice: &mut Choice) -> Option<Vec<Difference>> {
        let mut half = self.half(choice);
        if half.elements == self.fewest && choice.elements == self.fewest {
            return None;
        }
        // Another integrator makes other errors.
        if !self.end_alike([&half, choice]) {
            half.elements.clone_from(&choice.elements);
        }
        let found = self.loosest(&mut half).ok()?;
        let (tolerance, found) = self.loosen(&half, found);
        choice.tolerance = tolerance;
        Some(found)
    }

    /// Ten times the tolerance while that is good enough: a coarser mesh may have asked for more, and what a tenth changes
    /// counts more than it says.
    fn loosen(&mut self, best: &Choice, found: Vec<Difference>) -> (f64, Vec<Difference>) {
        let is_given = self.scene.accuracy.relative_tolerance.is_some();
        let (mut tolerance, mut found) = (best.tolerance, found);
        loop {
            let mut looser = best.clone();
            looser.tolerance = decade(10.0 * tolerance);
            if is_given || looser.tolerance > self.first_tolerance() {
                return (tolerance, found);
            }
            let Some(now) = self.by_tightest(&looser, best, &found) else {
                return (tolerance, found);
            };
            (tolerance, found) = (looser.tolerance, now);
        }
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

//! The search for a tolerance: what a tenth of it changes.

use super::experiment::Unfinished;
use super::ladder::{Choice, Ladder};
use super::outputs::Difference;
use super::search::{OF_SPACE, SHARED, Search, TIGHTEST};
use crate::scene::Error;

/// Part of the error wanted that a tenth of the tolerance may change.
const OF_TIME: f64 = 1.0 / 3.0;
/// Part of what a tolerance changes that a tenth of it changes at least, where that is foreseen.
const LEAST: f64 = 0.25;
/// Part of what a tenth may change, below which one mesh speaks for all.
const CLEAR: f64 = 0.3;
/// The error of a tolerance over what a tenth of it changes.
const TAIL: f64 = 1.5;
/// How many times the proportion of the coarsest mesh two tolerances have with another one at most, and what it counts at
/// least.
const PROPORTION: f64 = 1.5;
const SLOWEST: f64 = 0.125;
/// How many times what it may a doubling changes at most where errors in time may be the reason.
const NEAR: f64 = 4.0;
/// Tolerance above which a tenth of it says less of the error: what it changes counts this many times.
const LOOSE: f64 = 1e-4;
const DOUBT: f64 = 3.0;
/// Steps of one run over those of another below which both took the same ones.
const ALIKE: f64 = 1.2;
/// Steps over those of communication below which these alone end them.
const SAME: f64 = 1.05;
/// Parts of the error wanted: the most that the tolerance may change by half the mesh, and the least that is left to it.
const MOST: f64 = 0.45;
const LITTLE: f64 = 0.05;
/// The loosest tolerance that is tried, and the last in errors wanted. None looser than the error wanted: with short
/// communication steps it would do, and with longer ones not.
const LOOSEST: f64 = 1e-2;
const LAST: f64 = 1e-3;
/// Times that a tolerance is tightened at most until a run resolves what it shows.
const RESOLVED: usize = 8;

impl Search<'_, '_> {
    /// The first tolerance that is tried: the one given, or the loosest.
    pub(super) fn first_tolerance(&self) -> f64 {
        let first = decade(self.error).min(LOOSEST);
        self.scene.accuracy.relative_tolerance.unwrap_or(first)
    }

    /// Finds the loosest tolerance that the coarsest mesh allows. Returns its error.
    ///
    /// # Errors
    /// No mesh can be run.
    pub(super) fn find_tolerance(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Error> {
        loop {
            match self.loosest_believed(choice) {
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

    /// The loosest tolerance whose difference from a run that resolves its motions is small enough, from that of a choice on. Runs that
    /// damp small vibrations away agree with each other, and are all wrong.
    fn loosest_believed(&mut self, choice: &mut Choice) -> Result<Vec<Difference>, Unfinished> {
        let limits = self.equal(OF_TIME);
        let mut resolved = choice.clone();
        self.run(&resolved)?;
        self.resolve(&mut resolved);
        if resolved.tolerance >= tenth(choice.tolerance) {
            return self.loosest(choice, &limits);
        }
        self.loosest = if self.rests(&resolved) {
            resolved.tolerance
        } else {
            choice.tolerance
        };
        choice.tolerance = decade(10.0 * resolved.tolerance).min(self.loosest);
        let mut found = self.loosest(choice, &limits)?;
        // The one that it was compared with says what looser ones miss.
        let Some(reference) = self.closest(choice) else {
            return Ok(found);
        };
        while decade(10.0 * choice.tolerance) <= self.loosest {
            let looser = Choice {
                tolerance: decade(10.0 * choice.tolerance),
                ..choice.clone()
            };
            let Ok(now) = self.doubted(&looser, &reference) else {
                break;
            };
            if !now
                .iter()
                .zip(&limits)
                .all(|(now, limit)| now.largest <= *limit)
            {
                break;
            }
            (choice.tolerance, found) = (looser.tolerance, now);
        }
        Ok(found)
    }

    /// Whether inputs are held while an output that counts does not move: then the tolerance is for motions that will be.
    fn rests(&self, choice: &Choice) -> bool {
        let run = self.known(choice);
        run.is_some_and(|run| self.is_at_rest(run))
    }

    /// Tightens the tolerance of a choice until its run resolves what it shows, or cannot be finished.
    pub(super) fn resolve(&mut self, choice: &mut Choice) {
        if self.scene.accuracy.relative_tolerance.is_some() {
            return;
        }
        for _ in 0..RESOLVED {
            if self.run(choice).is_err() {
                return;
            }
            let Some(run) = self.known(choice) else {
                return;
            };
            let believed = self.believed(run);
            if choice.tolerance <= believed {
                return;
            }
            // What is damped away hides what it would show: half the way tells it for less work.
            let half = decade_below((choice.tolerance * believed).sqrt());
            choice.tolerance = half
                .min(tenth(choice.tolerance))
                .max(decade_below(believed));
        }
    }

    /// Compares a tolerance with a tighter one. The differences are weighted more the looser the tolerance is.
    fn doubted(&mut self, looser: &Choice, closer: &Choice) -> Result<Vec<Difference>, Unfinished> {
        let mut found = self.compare(looser, closer, self.error)?;
        let doubt = doubt(looser.tolerance);
        found
            .iter_mut()
            .for_each(|difference| difference.largest *= doubt);
        Ok(found)
    }

    /// The loosest tolerance from that of a choice on, and what a tenth of it changes.
    fn loosest(
        &mut self,
        choice: &mut Choice,
        limits: &[f64],
    ) -> Result<Vec<Difference>, Unfinished> {
        let is_given = self.scene.accuracy.relative_tolerance.is_some();
        let mut ladder = Ladder::new(limits.to_vec(), vec![LEAST; limits.len()]);
        let mut tried = choice.clone();
        loop {
            if let Some(found) = ladder.foreseen() {
                ladder.add(&tried, found);
                break;
            }
            match (self.in_time(&tried), ladder.rungs.is_empty()) {
                (Ok(found), _) => ladder.add(&tried, found),
                (Err(reason), true) => return Err(reason),
                (Err(_), false) => break,
            }
            if ladder.is_climbed() || is_given {
                break;
            }
            let first = choice.tolerance.min(self.error);
            if tried.tolerance < 1.5 * LAST * first || tried.tolerance < 10.0 * TIGHTEST {
                break;
            }
            tried.tolerance = tenth(tried.tolerance);
        }
        let (best, found) = ladder.best().unwrap_or_default();
        choice.tolerance = best.tolerance;
        Ok(found)
    }

    /// The run of the same mesh that is closest to the truth in time: that of most steps with no looser tolerance.
    fn closest(&self, choice: &Choice) -> Option<Choice> {
        let of_mesh = |made: &Choice| Choice {
            tolerance: choice.tolerance,
            is_halved: choice.is_halved,
            ..made.clone()
        };
        let same = self.runs.iter().filter(|(made, _)| {
            made != choice && made.tolerance <= choice.tolerance && of_mesh(made) == *choice
        });
        let finished = same.filter_map(|(made, run)| Some((made, run.as_ref().ok()?.steps)));
        let best = finished.max_by_key(|(_, steps)| *steps);
        best.map(|(made, _)| made.clone())
    }

    /// Makes a run that is to be closer take other steps than that of a choice: halves, then with tighter tolerances.
    fn set_apart(&mut self, choice: &Choice, closer: &mut Choice) -> Result<(), Unfinished> {
        self.run(closer)?;
        let mut tried = closer.clone();
        while self.take_same_steps(choice, closer) && tried.tolerance > TIGHTEST {
            if tried.is_halved {
                tried.tolerance = tenth(tried.tolerance)
            } else {
                tried.is_halved = true
            }
            // What fails when it is asked for more says nothing of what is asked for.
            if self.run(&tried).is_err() {
                break;
            }
            closer.clone_from(&tried);
        }
        Ok(())
    }

    /// Compares the tolerance with a tenth of it. If both take the same steps, which communication points end, the
    /// steps are halved instead.
    fn in_time(&mut self, choice: &Choice) -> Result<Vec<Difference>, Unfinished> {
        let mut closer = Choice {
            tolerance: tenth(choice.tolerance),
            ..choice.clone()
        };
        let steps = self.run(choice)?.steps as f64;
        // Halves that a looser one was compared with are closer still.
        let halves = Choice {
            is_halved: true,
            ..choice.clone()
        };
        if self.known(&halves).is_some() && !self.take_same_steps(choice, &halves) {
            return self.doubted(choice, &halves);
        }
        let points = self.experiment.steps as f64;
        closer.is_halved = (points..SAME * points).contains(&steps);
        self.set_apart(choice, &mut closer)?;
        self.doubted(choice, &closer)
    }

    /// A mesh that `auto` takes with another integrator than a coarser one makes other errors in time: the tolerance that it
    /// needs, where these may be what changes too much.
    pub(super) fn tighten(&mut self, coarser: &Choice, choice: &mut Choice) {
        let Ok(found) = self.compare(coarser, choice, self.error) else {
            return;
        };
        let largest = found.iter().map(|found| found.largest);
        let part = largest.fold(0.0, f64::max) / (OF_SPACE * self.error);
        if !(1.0..NEAR).contains(&part) || self.end_alike([coarser, choice]) {
            return;
        }
        let mut tried = choice.clone();
        if self.loosest(&mut tried, &self.equal(OF_TIME)).is_ok() {
            choice.tolerance = tried.tolerance;
        }
    }

    /// Whether the tolerance found with the coarsest mesh is good enough for the one chosen, by one half as fine;
    /// else a tighter one. What a tenth of it changes; nothing where the coarsest mesh speaks for all.
    ///
    /// # Errors
    /// A run that it takes cannot be finished.
    pub(super) fn verify_tolerance(
        &mut self,
        choice: &mut Choice,
        in_space: &[Difference],
        in_time: &[Difference],
    ) -> Result<Option<Vec<Difference>>, Unfinished> {
        let mut half = self.half(choice);
        // Another integrator makes other errors, and so does a mesh that moves otherwise.
        if !self.end_alike([&half, choice]) || self.are_far(&half, choice) {
            half.elements.clone_from(&choice.elements);
        }
        let limits = self.left(in_space, half.elements == choice.elements);
        let mut resolved = half.clone();
        self.resolve(&mut resolved);
        if resolved.tolerance < half.tolerance {
            let found = self.beside(&half, &resolved, &limits)?;
            choice.tolerance = found.0;
            return Ok(Some(found.1));
        }
        let is_clear = |(found, limit): (&Difference, &f64)| found.largest <= CLEAR * limit;
        if choice.tolerance == self.first_tolerance() && in_time.iter().zip(&limits).all(is_clear) {
            return Ok(None);
        }
        let (tolerance, found) = match self.by_looser(&half, &limits) {
            Some(found) => found,
            None => {
                let found = self.loosest(&mut half, &limits)?;
                (half.tolerance, found)
            }
        };
        choice.tolerance = tolerance;
        Ok(Some(found))
    }

    /// Returns the differences in time of a choice whose tolerance could not be verified. They are those of the coarsest
    /// mesh. They are unknown if the mesh moves differently, or so little that the tolerance hides it.
    pub(super) fn unverified(
        &mut self,
        choice: &Choice,
        in_time: Vec<Difference>,
    ) -> Vec<Difference> {
        let coarsest = Choice {
            elements: self.fewest.clone(),
            ..choice.clone()
        };
        let is_resolved = match self.known(choice) {
            Some(run) => choice.tolerance <= self.believed(run),
            None => false,
        };
        let is_alike = self.end_alike([&coarsest, choice]) && !self.are_far(&coarsest, choice);
        if is_resolved && is_alike {
            in_time
        } else {
            self.unknown()
        }
    }

    /// The loosest tolerance of a mesh that is good enough beside one that resolves its motions, and what it changes.
    fn beside(
        &mut self,
        tried: &Choice,
        resolved: &Choice,
        limits: &[f64],
    ) -> Result<(f64, Vec<Difference>), Unfinished> {
        let mut closer = resolved.clone();
        self.set_apart(tried, &mut closer)?;
        let found = self.doubted(tried, &closer)?;
        if found
            .iter()
            .zip(limits)
            .all(|(found, limit)| found.largest <= *limit)
        {
            return Ok((tried.tolerance, found));
        }
        let mut tighter = resolved.clone();
        let found = self.loosest(&mut tighter, limits)?;
        Ok((tighter.tolerance, found))
    }

    /// Returns the change that each output may still have by the tolerance. It is the part that the mesh leaves, at
    /// most a little more than a third of the error if another mesh determines it.
    fn left(&self, in_space: &[Difference], is_chosen: bool) -> Vec<f64> {
        let most = if is_chosen { 1.0 } else { MOST };
        let left = in_space.iter().map(|found| {
            let left = (SHARED * self.error - found.largest).min(most * self.error);
            if left > LITTLE * self.error {
                left
            } else {
                OF_TIME * self.error
            }
        });
        left.collect()
    }

    /// Whether two meshes move so differently that errors in time of one say nothing of those of the other.
    fn are_far(&mut self, half: &Choice, choice: &Choice) -> bool {
        let found = self.compare(half, choice, self.error).unwrap_or_default();
        found.iter().any(|found| found.largest > NEAR * self.error)
    }

    /// Whether communication points end the steps of two runs: what they differ by says nothing of errors in time.
    fn take_same_steps(&self, looser: &Choice, tighter: &Choice) -> bool {
        let pair = self.known(looser).zip(self.known(tighter));
        pair.is_some_and(|(looser, tighter)| {
            !looser.rests && (tighter.steps as f64) < ALIKE * looser.steps as f64
        })
    }

    /// The loosest tolerance that is good enough by what ten times as much changes, and what a tenth of it would.
    fn by_looser(&mut self, best: &Choice, limits: &[f64]) -> Option<(f64, Vec<Difference>)> {
        let is_given = self.scene.accuracy.relative_tolerance.is_some();
        let mut tolerance = best.tolerance;
        let mut found: Option<Vec<Difference>> = None;
        let coarsest = Choice {
            elements: self.fewest.clone(),
            ..best.clone()
        };
        loop {
            let mut looser = best.clone();
            looser.tolerance = decade(10.0 * tolerance);
            if is_given || looser.tolerance > self.first_tolerance().min(self.loosest) {
                break;
            }
            let now = self.doubted(&looser, best).ok()?;
            if self.take_same_steps(&looser, best) {
                break;
            }
            let doubt = doubt(looser.tolerance);
            let tail = (TAIL / doubt).max(1.0);
            let mut pairs = now.iter().zip(limits);
            let is_kept = pairs.all(|(now, limit)| tail * now.largest <= *limit);
            if !is_kept && found.is_none() {
                return self
                    .as_coarsest(&coarsest, &now, limits)
                    .map(|found| (tolerance, found));
            }
            if !is_kept {
                break;
            }
            (tolerance, found) = (looser.tolerance, Some(now));
        }
        Some((tolerance, found?))
    }

    /// Extrapolates the change by a tenth of a tolerance from the change by ten times that, if both have the ratio of
    /// the coarsest mesh. `None` if that exceeds a limit.
    fn as_coarsest(
        &mut self,
        coarsest: &Choice,
        now: &[Difference],
        limits: &[f64],
    ) -> Option<Vec<Difference>> {
        let with = |tolerance: f64| Choice {
            tolerance,
            ..coarsest.clone()
        };
        let looser = with(decade(10.0 * coarsest.tolerance));
        let loosest = with(decade(10.0 * looser.tolerance));
        let tighter = with(tenth(coarsest.tolerance));
        // The tightest three of them that were run.
        let made = if self.known(&tighter).is_some() {
            [looser, coarsest.clone(), tighter]
        } else {
            [loosest, looser, coarsest.clone()]
        };
        for choice in &made {
            self.known(choice)?;
        }
        let looser = self.compare(&made[0], &made[1], self.error).ok()?;
        let tighter = self.compare(&made[1], &made[2], self.error).ok()?;
        let groups = now.iter().zip(limits).zip(looser.iter().zip(&tighter));
        let foreseen = groups.map(|((now, limit), (looser, tighter))| {
            let rate = PROPORTION * tighter.largest / looser.largest.max(f64::MIN_POSITIVE);
            let largest = now.largest * rate.clamp(SLOWEST, 1.0);
            (largest <= *limit).then_some(Difference {
                largest,
                until: None,
            })
        });
        foreseen.collect()
    }
}

/// How many times what a tenth of a tolerance changes counts.
fn doubt(tolerance: f64) -> f64 {
    if tolerance > LOOSE { DOUBT } else { 1.0 }
}

/// A tenth of a tolerance, as a power of ten where it is one.
pub(super) fn tenth(tolerance: f64) -> f64 {
    if tolerance == decade(tolerance) {
        decade(0.1 * tolerance)
    } else {
        0.1 * tolerance
    }
}

/// The power of ten that is not above a tolerance.
fn decade_below(value: f64) -> f64 {
    format!("1e{}", value.log10().floor())
        .parse()
        .unwrap_or(value)
}

/// The nearest power of ten, as it would be written.
fn decade(value: f64) -> f64 {
    format!("1e{}", value.log10().round())
        .parse()
        .unwrap_or(value)
}

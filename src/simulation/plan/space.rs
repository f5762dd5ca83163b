//! The search for meshes: doubled until that changes no output by more than may be.

use super::experiment::Unfinished;
use super::ladder::{Choice, Ladder};
use super::outputs::{Difference, are_kept};
use super::search::{OF_SPACE, SHARED, Search};
use crate::scene::Error;

/// Most cables of which single ones are tried with fewer elements.
const MOST_SINGLE: usize = 4;

impl Search<'_, '_> {
    /// Finds the coarsest mesh for which doubling changes the outputs by less than their limits. Returns these changes.
    ///
    /// # Errors
    /// No mesh can be run.
    pub(super) fn find_elements(
        &mut self,
        choice: &mut Choice,
        in_time: &[Difference],
    ) -> Result<Vec<Difference>, Error> {
        let mut ladder = Ladder::new(self.equal(OF_SPACE), self.foreseen_at_least());
        ladder.first_division = self.first_division();
        let mut tried = Choice {
            elements: self.stiffest(&choice.elements),
            ..choice.clone()
        };
        loop {
            // Which directions are doubled follows from its run.
            if !self.divisions.is_empty() {
                let _ = self.run(&tried);
            }
            let mut next = tried.clone();
            if !self.refine(&mut next) {
                break;
            }
            if let Some(found) = self.foreseen(&ladder, &tried, &next) {
                ladder.add(&tried, found);
                break;
            }
            if tried.elements.contains(&0) {
                self.resolve(&mut next)
            } else {
                self.tighten(&tried, &mut next)
            }
            match self.compare(&tried, &self.with_more_modes(&next), self.error) {
                Ok(found) => ladder.add_step(&tried, &next, found),
                Err(Unfinished::TooMuchWork) => break,
                Err(Unfinished::Failed(reason)) if !self.refine(&mut next.clone()) => {
                    if ladder.rungs.is_empty() {
                        return Err(Error::new("experiment", reason));
                    }
                    // What coarser meshes have shown counts, and that it does not settle is told.
                    break;
                }
                Err(Unfinished::Failed(_)) => {}
            }
            let may_do = ladder.is_climbed() || self.is_enough(&ladder, in_time);
            if may_do && self.is_verified(&mut ladder, &tried, &mut next, in_time) {
                break;
            }
            if tried.elements.contains(&0) {
                next.tolerance = choice.tolerance;
            }
            tried = next;
        }
        let Some((best, found)) = ladder.best() else {
            return Ok(if self.is_any_free() {
                self.unknown()
            } else {
                vec![Difference::NONE; self.compared()]
            });
        };
        *choice = best;
        Ok(self.economize(choice, found))
    }

    /// Changes that the next rung would make, where that need not be run: of all that is doubled, and of what is not as a run says.
    fn foreseen(
        &mut self,
        ladder: &Ladder,
        tried: &Choice,
        next: &Choice,
    ) -> Option<Vec<Difference>> {
        if !ladder.goes_on(tried, next) {
            return None;
        }
        let mut found = ladder.foreseen()?;
        self.add_beside(tried, &mut next.clone(), &mut found).ok()?;
        let most = OF_SPACE * self.error;
        found.iter().all(|of| of.largest <= most).then_some(found)
    }

    /// Halves single cables where that costs nothing. What doubling all changes then.
    fn economize(&mut self, choice: &mut Choice, found: Vec<Difference>) -> Vec<Difference> {
        let mut closer = choice.clone();
        self.refine(&mut closer);
        closer = self.with_more_modes(&closer);
        // Where doubling was foreseen it has not been run.
        if self.known(&closer).is_none() {
            closer.clone_from(choice);
        }
        self.coarsen_one_by_one(choice, &closer, &found);
        let last = if closer == *choice {
            Vec::new()
        } else {
            self.compare(choice, &closer, self.error)
                .unwrap_or_default()
        };
        let worst = |(a, b): (&Difference, &Difference)| a.worst(*b);
        if last.is_empty() {
            found
        } else {
            found.iter().zip(&last).map(worst).collect()
        }
    }

    /// Whether what the last rung changed and all doublings to come would leaves enough to the tolerance.
    pub(super) fn is_enough(&self, ladder: &Ladder, in_time: &[Difference]) -> bool {
        let Some((_, last)) = ladder.rungs.last() else {
            return false;
        };
        last.iter()
            .zip(in_time)
            .enumerate()
            .all(|(group, (found, time))| {
                let to_come = match ladder.rate(group) {
                    Some(rate) => found.largest / (1.0 - rate),
                    None => found.largest / OF_SPACE,
                };
                to_come + time.largest <= SHARED * self.error
            })
    }

    /// Halves the numbers of elements of single cables while that changes no more than may be.
    fn coarsen_one_by_one(&mut self, choice: &mut Choice, closer: &Choice, found: &[Difference]) {
        let least = self.stiffest(&self.fewest);
        let cables: Vec<usize> = (0..choice.elements.len())
            .filter(|i| self.is_free(*i))
            .collect();
        if !(2..=MOST_SINGLE).contains(&cables.len()) {
            return;
        }
        let limits = self.equal(OF_SPACE);
        // What bends is compared with what does not, so its vibrations must be there.
        let mut resolved = closer.clone();
        for cable in cables {
            let mut tried = choice.clone();
            tried.elements[cable] /= 2;
            if tried.elements[cable] < self.fewest[cable] {
                tried.elements[cable] = 0;
            }
            if tried.elements[cable] < least[cable] || tried.elements == choice.elements {
                continue;
            }
            let lets_bend = tried.elements[cable] == 0;
            if lets_bend {
                self.resolve(&mut resolved);
            }
            let closer = if lets_bend { &resolved } else { closer };
            let changed = self.compare(&tried, closer, self.error);
            if changed.is_ok_and(|changed| are_kept(&changed, found, &limits)) {
                *choice = tried;
            }
        }
    }

    /// Halves all numbers of elements while that changes no more than may be: errors in time had a part in what doubling
    /// changed before. What doubling changes.
    pub(super) fn coarsen(
        &mut self,
        choice: &mut Choice,
        found: Vec<Difference>,
    ) -> Vec<Difference> {
        let (mut found, limits) = (found, self.equal(OF_SPACE));
        loop {
            let half = self.half(choice);
            if half.elements == choice.elements {
                return found;
            }
            let closer = self.with_more_modes(choice);
            let Ok(now) = self.compare(&half, &closer, self.error) else {
                return found;
            };
            if !are_kept(&now, &found, &limits) {
                return found;
            }
            (*choice, found) = (half, now);
        }
    }

    /// Replaces predicted differences by measured ones if no work was left for doubling the mesh at the chosen
    /// tolerance. The differences of the doubling before are a lower bound.
    pub(super) fn measured(
        &mut self,
        choice: &Choice,
        foreseen: Vec<Difference>,
    ) -> Vec<Difference> {
        let mut closer = choice.clone();
        let (half, is_more) = (self.half(choice), self.refine(&mut closer));
        closer = self.with_more_modes(&closer);
        if !is_more || self.known(&closer).is_some() || half.elements == choice.elements {
            return foreseen;
        }
        let Ok(before) = self.compare(&half, choice, self.error) else {
            return self.unknown();
        };
        let pairs = foreseen.iter().zip(&before);
        pairs.map(|(found, before)| found.worst(*before)).collect()
    }

    /// A choice with half as many elements where that can be.
    pub fn half(&self, choice: &Choice) -> Choice {
        let halves = choice.elements.iter().zip(&self.fewest);
        let half = |(count, least): (&u32, &u32)| match count {
            0 => 0,
            count => (count / 2).max(*least),
        };
        Choice {
            elements: halves.map(half).collect(),
            ..choice.clone()
        }
    }

    /// Doubles the mesh where that changes more with a tolerance that was tightened since: what a looser one damps away in both meshes
    /// does not tell them apart. What doubling changes; nothing where the mesh stays.
    pub(super) fn refine_resolved(
        &mut self,
        choice: &mut Choice,
        before: &[Difference],
    ) -> Option<Vec<Difference>> {
        let limits = self.equal(OF_SPACE);
        let mut closer = choice.clone();
        if !self.refine(&mut closer) {
            return None;
        }
        let more = self.with_more_modes(&closer);
        let found = self.compare(choice, &more, self.error).ok()?;
        if are_kept(&found, before, &limits) {
            return None;
        }
        choice.clone_from(&closer);
        let is_more = self.refine(&mut closer);
        let closer = self.with_more_modes(&closer);
        let next = is_more.then(|| self.compare(choice, &closer, self.error));
        // What the doubling before changed is more than the next one would.
        Some(next.and_then(Result::ok).unwrap_or(found))
    }
}

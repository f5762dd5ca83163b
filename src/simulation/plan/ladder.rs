//! Choices from cheap to dear, and what outputs change from one to the next.

use super::outputs::Difference;

/// An output settles while a doubling, or a tenth, leaves at most this part of what the one before changed.
const HALF: f64 = 0.5;
/// Doublings in a row that left more, after which an output is said not to settle.
const PATIENCE: usize = 3;
/// How many times its least change an output that does not settle may change.
const NEARLY: f64 = 2.0;
/// Largest ratio of the changes of two rungs for which convergence is regular. The next rung then need not be run.
/// `BEFORE` is that of the two rungs before.
const REGULAR: f64 = 0.4;
const BEFORE: f64 = 0.6;
/// Part of what may change below which nothing more is asked of an output.
const QUIET: f64 = 0.5;

/// Choices that a run is made with.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Choice {
    /// Elements of every line body, in the order of the bodies, then modes of every reduced body whose number of modes is open.
    pub elements: Vec<u32>,
    /// Natural modes of the line bodies that are reduced to modes instead, in the order of the bodies; empty where none is.
    pub modes: Vec<Option<u32>>,
    pub tolerance: f64,
    /// Whether steps are at most half as long as those between communication points, where these end them.
    pub is_halved: bool,
    /// Whether axial waves of all cables settle.
    pub is_settled: bool,
    /// Bodies that are tried as beams, by their places among those that may be.
    pub beams: Vec<usize>,
}

/// Choices from cheap to dear, with what the next one changed.
pub(super) struct Ladder {
    pub rungs: Vec<(Choice, Vec<Difference>)>,
    /// Place of the first number of elements of plates and shells in a choice.
    pub first_division: usize,
    /// These numbers of the choice that each rung was compared with, over its own.
    steps: Vec<Vec<f64>>,
    /// Limits of the changes of every output.
    limits: Vec<f64>,
    /// The part of what a rung changed that the next one changes at least, of every output; infinite where nothing is foreseen.
    least: Vec<f64>,
}

impl Ladder {
    pub fn new(limits: Vec<f64>, least: Vec<f64>) -> Self {
        Self {
            rungs: Vec::new(),
            first_division: usize::MAX,
            steps: Vec::new(),
            limits,
            least,
        }
    }

    pub fn add(&mut self, choice: &Choice, found: Vec<Difference>) {
        self.add_step(choice, choice, found);
    }

    /// Adds a rung with what a choice with a finer mesh changes.
    pub fn add_step(&mut self, choice: &Choice, finer: &Choice, found: Vec<Difference>) {
        self.rungs.push((choice.clone(), found));
        let step = self.ratios(choice, finer);
        self.steps.push(step);
    }

    /// Whether a choice with a finer mesh is what the one of the last rung was to it: directions of plates and shells are not always all
    /// doubled.
    pub fn goes_on(&self, choice: &Choice, finer: &Choice) -> bool {
        let ratios = self.ratios(choice, finer);
        self.steps.last().is_none_or(|step| *step == ratios)
    }

    /// Numbers of elements of plates and shells of a finer choice over those of another one.
    fn ratios(&self, choice: &Choice, finer: &Choice) -> Vec<f64> {
        let counts = choice.elements.iter().zip(&finer.elements);
        let counts = counts.skip(self.first_division);
        counts
            .map(|(count, finer)| f64::from(*finer) / f64::from(*count))
            .collect()
    }

    /// Whether no output would come closer on the next rung, and is still to.
    pub fn is_climbed(&self) -> bool {
        let Some((_, last)) = self.rungs.last() else {
            return false;
        };
        let is_open = |(group, difference): (usize, &Difference)| {
            difference.largest > self.limits[group] && !self.is_stuck(group)
        };
        !last.iter().enumerate().any(is_open)
    }

    /// Predicts the differences of the next rung from regular convergence of all outputs. `None` if convergence is not
    /// regular or a prediction exceeds its limit.
    pub fn foreseen(&self) -> Option<Vec<Difference>> {
        let groups = self.limits.iter().enumerate().map(|(group, limit)| {
            let now = self.rungs.last()?.1[group].largest;
            let largest = if now <= QUIET * limit {
                now
            } else {
                now * self.rate(group)?
            };
            (largest <= *limit).then_some(Difference {
                largest,
                until: None,
            })
        });
        groups.collect()
    }

    /// The part of what the last rung changed that the next one will change, as far as the one before tells.
    pub fn rate(&self, group: usize) -> Option<f64> {
        // Letting rigid bodies bend is no doubling.
        let rigid = |choice: &Choice| choice.elements.iter().filter(|count| **count == 0).count();
        let least = rigid(&self.rungs.last()?.0);
        let step = self.steps.last()?;
        let alike = self.rungs.iter().zip(&self.steps).rev();
        let alike = alike.filter(|(rung, _)| rigid(&rung.0) == least);
        let alike = alike.take_while(|(_, of)| *of == step);
        let mut changes = alike.map(|((_, all), _)| all[group].largest);
        let [last, before] = [changes.next()?, changes.next()?];
        let is_new = changes.next().is_some_and(|first| before > BEFORE * first);
        if last > REGULAR * before || is_new || self.least[group].is_infinite() {
            return None;
        }
        let rate = last / before.max(f64::MIN_POSITIVE);
        Some(rate.max(self.least[group]))
    }

    /// Whether an output has stopped coming closer.
    fn is_stuck(&self, group: usize) -> bool {
        let changes: Vec<f64> = self
            .rungs
            .iter()
            .map(|(_, all)| all[group].largest)
            .collect();
        let steps = changes.windows(2).rev().take(PATIENCE);
        steps.filter(|step| step[1] > HALF * step[0]).count() == PATIENCE
    }

    /// The cheapest choice on which all outputs are within the limit, and those that never are, nearly as close as they
    /// come, for nearly as long; where there is none, the one that comes nearest to it. With it what all dearer ones
    /// change at most: an output that changes more on a dearer rung was not as close as it seemed.
    pub fn best(&self) -> Option<(Choice, Vec<Difference>)> {
        let mut rungs = self.rungs.clone();
        for index in (1..rungs.len()).rev() {
            let (cheaper, dearer) = rungs.split_at_mut(index);
            let later = &dearer[0].1;
            for (now, later) in cheaper[index - 1].1.iter_mut().zip(later) {
                *now = now.worst(*later);
            }
        }
        let groups = rungs.first().map_or(0, |(_, all)| all.len());
        let closest = |group: usize| {
            let changes = rungs.iter().map(|(_, all)| all[group].largest);
            changes.fold(f64::INFINITY, f64::min)
        };
        let allowed: Vec<f64> = (0..groups)
            .map(|group| self.limits[group].max(NEARLY * closest(group)))
            .collect();
        let good_for = |rung: usize, group: usize| self.rungs[rung].1[group].until;
        let longest = |group: usize| {
            let times = (0..self.rungs.len()).filter_map(|rung| good_for(rung, group));
            times.fold(0.0, f64::max)
        };
        let longest: Vec<f64> = (0..groups).map(longest).collect();
        let excess = |rung: usize| {
            let groups = rungs[rung].1.iter().enumerate();
            groups.fold(1.0, |most: f64, (group, found)| {
                let short = match good_for(rung, group) {
                    Some(time) => longest[group] / (NEARLY * time).max(f64::MIN_POSITIVE),
                    None => 1.0,
                };
                most.max(found.largest / allowed[group]).max(short)
            })
        };
        // The first of equals.
        let best = (0..rungs.len()).reduce(|best, rung| {
            if excess(rung) < excess(best) {
                rung
            } else {
                best
            }
        });
        best.map(|best| rungs.swap_remove(best))
    }
}

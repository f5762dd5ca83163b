//! Meshes of plates and shells: which of their directions are doubled, by where curvature jumps.
//!
//! A run tells for both directions of every plate and shell how far its mesh is off ([`TrialRun::missed`]). Directions that joints connect have
//! one number of elements (a [`Division`]). The direction that is off most is doubled, with all that are off by at least half of that. Others
//! are left as they are. Before a mesh is taken one run doubles those, and what that changes counts too.
//!
//! [`TrialRun::missed`]: super::experiment::TrialRun::missed

use super::experiment::Unfinished;
use super::ladder::{Choice, Ladder};
use super::outputs::Difference;
use super::search::{Search, counted};
use crate::scene::{Body, Division, MOST_DIVISIONS, Modes, Scene};

/// A direction is doubled with the one that is off most where it is off by at least this part of it.
const ALIKE: f64 = 0.5;

/// Numbers of elements of plates and shells that are left to the planner.
pub(super) fn open_divisions(scene: &Scene) -> impl Iterator<Item = Division> {
    scene.divisions().into_iter().filter(|of| of.is_open)
}

/// Whether a body, by its place, is a stiffener that takes the number of elements of its line.
pub(super) fn follows(scene: &Scene, body: usize) -> bool {
    let line = scene.bodies[body].cable();
    line.is_some_and(|line| line.elements.is_none())
        && (scene.divisions().iter()).any(|division| division.stiffeners.contains(&body))
}

/// Elements, and modes of reduced bodies, of a scene with numbers of them.
pub(super) fn elements_of(scene: &Scene) -> u32 {
    let of = |body: &Body| match body {
        Body::Reduced(reduced) => match &reduced.modes {
            Modes::FixedInterface(modes) => modes.fixed_interface,
            _ => 0,
        },
        body => match (body.patch(), body.cable()) {
            (Some(patch), _) => patch.mesh.counts.iter().product(),
            (_, Some(line)) if line.model.has_elements() => line.elements.unwrap_or(0),
            _ => 0,
        },
    };
    scene.bodies.iter().map(of).sum()
}

impl Search<'_, '_> {
    /// Place of the first number of elements of plates and shells in a choice.
    pub(super) fn first_division(&self) -> usize {
        counted(self.scene).count()
    }

    /// Error (m) that the mesh of a choice makes along the directions of each division, by jumps of curvature: infinite where no node tells, or
    /// it could not be run.
    fn missed_by(&self, choice: &Choice) -> Vec<f64> {
        let run = self.known(choice);
        let of = |division: &Division| {
            let Some(run) = run else {
                return f64::INFINITY;
            };
            let own = division.directions.iter().filter_map(|(body, along)| {
                let missed = run.missed.iter().find(|(of, _)| of == body);
                missed.map(|(_, missed)| missed[*along])
            });
            own.fold(0.0, f64::max)
        };
        self.divisions.iter().map(of).collect()
    }

    /// Whether more elements are wanted in each division.
    fn wanted(&self, choice: &Choice) -> Vec<bool> {
        let missed = self.missed_by(choice);
        let largest = missed.iter().copied().fold(0.0, f64::max);
        missed.iter().map(|of| *of >= ALIKE * largest).collect()
    }

    /// Whether each division of a choice is doubled next.
    pub(super) fn doubled(&self, choice: &Choice) -> Vec<bool> {
        let counts = choice.elements[self.first_division()..].iter();
        let wanted = self.wanted(choice);
        (counts.zip(wanted))
            .map(|(count, is_wanted)| is_wanted && 2 * count <= MOST_DIVISIONS)
            .collect()
    }

    /// The choice with those divisions doubled which a finer one leaves as they are; nothing where there are none.
    fn other_directions(&self, choice: &Choice, finer: &Choice) -> Option<Choice> {
        let mut other = choice.clone();
        let counts = other.elements.iter_mut().zip(&finer.elements);
        let mut is_finer = false;
        for (count, doubled) in counts.skip(self.first_division()) {
            if count == doubled && 2 * *count <= MOST_DIVISIONS {
                *count *= 2;
                is_finer = true;
            }
        }
        is_finer.then_some(other)
    }

    /// Adds what the divisions change that a finer choice left as they are, and doubles them there. Returns whether there are such.
    ///
    /// # Errors
    /// The run with them doubled cannot be finished; they are doubled nonetheless.
    pub(super) fn add_beside(
        &mut self,
        choice: &Choice,
        finer: &mut Choice,
        found: &mut [Difference],
    ) -> Result<bool, Unfinished> {
        let Some(other) = self.other_directions(choice, finer) else {
            return Ok(false);
        };
        let counts = finer.elements.iter_mut().zip(&other.elements);
        for (count, doubled) in counts.skip(self.first_division()) {
            *count = (*count).max(*doubled);
        }
        let beside = self.compare(choice, &other, self.error)?;
        for (found, beside) in found.iter_mut().zip(beside) {
            let largest = found.largest + beside.largest;
            *found = Difference {
                largest,
                ..found.worst(beside)
            };
        }
        Ok(true)
    }

    /// Whether a mesh still does when what the directions change counts that the next rung left as they are. Where it does not, the next rung
    /// doubles them too.
    pub(super) fn is_verified(
        &mut self,
        ladder: &mut Ladder,
        tried: &Choice,
        next: &mut Choice,
        in_time: &[Difference],
    ) -> bool {
        let Some((_, last)) = ladder.rungs.last() else {
            return true;
        };
        let mut found = last.clone();
        match self.add_beside(tried, next, &mut found) {
            Ok(false) => return true,
            Ok(true) => {}
            // What could not be run changes as much as jumps of curvature say at most.
            Err(_) => (found.iter_mut()).for_each(|found| found.largest *= 1.0 + ALIKE),
        }
        if let Some((_, last)) = ladder.rungs.last_mut() {
            *last = found;
        }
        self.is_cut || ladder.is_climbed() || self.is_enough(ladder, in_time)
    }

    /// Names the plates and shells, with the direction, of which more elements are wanted than there may be, a sentence each.
    pub(super) fn at_bound(&self, choice: &Choice) -> Vec<String> {
        let counts = choice.elements[self.first_division()..].iter();
        let wanted = self.wanted(choice);
        let all = self.divisions.iter().zip(counts).zip(wanted);
        let bound = all.filter_map(|((division, count), is_wanted)| {
            // The mesh that is found is compared with one of twice its elements, and a finer one would be too.
            let more = match count {
                _ if !is_wanted => return None,
                count if 2 * count > MOST_DIVISIONS => "twice",
                count if 4 * count > MOST_DIVISIONS => "four times",
                _ => return None,
            };
            let (body, along) = self.worst_direction(choice, division)?;
            let name = self.scene.bodies[body].name();
            Some(format!(
                "{name}: its mesh has {count} elements along s{}, {more} as many are above the bound of {MOST_DIVISIONS}",
                along + 1
            ))
        });
        bound.collect()
    }

    /// The direction of a division that the mesh of a choice is off most along; the first one where that is not known.
    fn worst_direction(&self, choice: &Choice, division: &Division) -> Option<(usize, usize)> {
        let run = self.known(choice);
        let missed = |(body, along): &(usize, usize)| {
            let of = run.and_then(|run| run.missed.iter().find(|(of, _)| of == body));
            of.map_or(0.0, |(_, missed)| missed[*along])
        };
        let directions = division.directions.iter().copied();
        directions.reduce(|worst, next| {
            if missed(&next) > missed(&worst) {
                next
            } else {
                worst
            }
        })
    }
}

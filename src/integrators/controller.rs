//! The lengths of steps: from the error of the last one, the stability of the method and what is left to the end.
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.4.

use super::Attempt;

/// The smallest and largest change of step length from one step to the next, and the safety factor.
const SHRINK: f64 = 0.2;
const GROW: f64 = 5.0;
const SAFETY: f64 = 0.9;
/// Growth from one step to the next from which on steps have not found their length yet.
const GROWING: f64 = 1.5;
/// Growth of the longest step after one whose stage equations were not solved.
const RELAX: f64 = 1.1;

/// The error of an estimate of this power of the step as the controller, which takes the fourth, must see it to
/// choose the right step.
pub fn rescaled(error: f64, power: f64) -> f64 {
    error.powf(4.0 / power)
}

/// Most steps from one communication point to the next whose length depends on where the points are.
const FEW: f64 = 4.0;
/// Growth that roundoff may bring into a step that is to fit between two points.
const ROUNDOFF: f64 = 1e-9;

/// How far apart the communication points are that a tolerance was found with: its account holds for the steps that were taken between
/// them, and so does the choice of a method.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pitch(Option<f64>);

impl Pitch {
    /// Builds the pitch of points at a distance (s), or of none.
    pub fn new(apart: Option<f64>) -> Self {
        Self(apart.filter(|apart| *apart > 0.0))
    }

    /// The longest step to take where one of `wanted` (s) is proposed and allowed: as long as it would be between those points. One
    /// that would have led beyond them is `free`.
    pub fn allowed(self, wanted: f64, is_free: bool) -> f64 {
        match self.0 {
            Some(apart) if wanted < FEW * apart || !is_free => {
                let pieces = (apart / wanted).ceil().max(1.0);
                if pieces < FEW {
                    (1.0 + ROUNDOFF) * apart / pieces
                } else {
                    wanted
                }
            }
            _ => wanted,
        }
    }

    /// The time (s) over which methods are compared, where `remaining` is left to the end.
    pub fn way(self, remaining: f64) -> f64 {
        self.0.unwrap_or(remaining)
    }

    /// The points between those that reading a state counts for, which is `passed` (s) after the last one.
    pub fn points(self, passed: f64) -> f64 {
        self.0.map_or(1.0, |apart| passed / apart)
    }

    /// A trial of a step where one of `wanted` (s) is proposed, which is allowed this long and may lead no further than `remaining`.
    pub fn trial(self, wanted: f64, allowed: f64, remaining: f64) -> Trial {
        let trial = Controller::trial(allowed, remaining);
        trial.among(self, wanted, allowed)
    }
}

/// A step to try.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial {
    /// Length of the step, s.
    pub h: f64,
    /// Whether it reaches the end.
    pub is_last: bool,
    /// Whether it is shorter than wanted, to reach the end in whole steps.
    pub is_cut: bool,
    /// Part of the step that it would be if communication points were where the tolerance was found; 1 where it was not.
    pub part: f64,
}

impl Trial {
    /// A step of `h` (s) that is as long as it is meant to be.
    pub fn whole(h: f64) -> Self {
        Self {
            h,
            is_last: false,
            is_cut: false,
            part: 1.0,
        }
    }

    /// A step of `h` (s) that is shorter than proposed, since something happens at its end, and whether that is the end of the way.
    pub fn cut(h: f64, is_last: bool) -> Self {
        Self {
            is_last,
            is_cut: true,
            ..Self::whole(h)
        }
    }

    /// Marks the step as cut if it is shorter than the proposal `wanted`, s. `allowed` is the proposal that a pitch
    /// allows, s.
    pub fn among(self, pitch: Pitch, wanted: f64, allowed: f64) -> Self {
        let part = match pitch.0 {
            Some(_) => (self.h / allowed).min(1.0),
            None => 1.0,
        };
        Self {
            is_cut: self.h < wanted,
            part,
            ..self
        }
    }

    /// Removes the mark of a cut unless steps have found their length. The first proposal is a guess that no error
    /// estimate has confirmed, so a shortened step replaces it.
    pub fn among_settled(self, is_settled: bool) -> Self {
        Self {
            is_cut: self.is_cut && is_settled,
            ..self
        }
    }

    /// Whether the step to propose next (s) is so much longer that steps have not found their length yet.
    pub fn has_grown(&self, next: f64) -> bool {
        !self.is_cut && next > GROWING * self.h
    }
}

/// Chooses lengths of steps over a smooth interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controller {
    /// Most growth after the next step: what just failed at a length will not succeed at a longer one.
    grow: f64,
    /// Steps for which stage equations could be solved: nearly those it grows to from one that failed, s. A finite
    /// number, since a state may hold it.
    ceiling: f64,
}

impl Controller {
    /// With the steps for which stage equations could be solved before (s), where they follow on these.
    pub fn new(ceiling: Option<f64>) -> Self {
        Self {
            grow: GROW,
            ceiling: ceiling.unwrap_or(f64::MAX),
        }
    }

    /// Steps for which stage equations could be solved, s.
    pub fn ceiling(&self) -> f64 {
        self.ceiling
    }

    /// The step to try where `wanted` (s) is proposed and allowed. Whole steps to the end: a sliver left over
    /// would cost a step of its own.
    pub fn trial(wanted: f64, remaining: f64) -> Trial {
        let pieces = (remaining / wanted).ceil().max(1.0);
        let h = if pieces < FEW {
            remaining / pieces
        } else {
            wanted
        };
        Trial {
            is_last: pieces <= 1.0,
            is_cut: h < wanted,
            ..Trial::whole(h)
        }
    }

    /// The length to propose after a step with this error, in tolerances; `before` was proposed last.
    pub fn accept(&mut self, trial: Trial, error: f64, before: f64) -> f64 {
        self.ceiling = (self.ceiling * RELAX).min(f64::MAX);
        let factor = SAFETY * error.max(1e-10).powf(-0.25);
        let next = trial.h * factor.clamp(SHRINK, self.grow);
        let next = next.min(self.ceiling);
        self.grow = GROW;
        // A step cut short by the communication point says nothing against the longer one.
        if trial.is_cut {
            next.max(before).min(self.ceiling)
        } else {
            next
        }
    }

    /// The length to propose after a step that was not accepted.
    pub fn reject(&mut self, trial: Trial, outcome: Attempt) -> f64 {
        self.grow = 1.0;
        match outcome {
            Attempt::Done(error) if error.is_finite() => {
                trial.h * (SAFETY * error.powf(-0.25)).clamp(SHRINK, SAFETY)
            }
            Attempt::Done(_) => trial.h * SHRINK,
            Attempt::Failed(factor) => {
                self.ceiling = trial.h * factor;
                self.ceiling
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of a step of `h` by a method of error `(h / right)^4`.
    fn error(h: f64, right: f64) -> f64 {
        (h / right).powi(4)
    }

    #[test]
    fn finds_the_step_whose_error_is_just_tolerated() {
        let mut controller = Controller::new(None);
        let (mut step, mut rejected) = (1.0, 0);
        for _ in 0..20 {
            let trial = Controller::trial(step, 1e9);
            let error = error(trial.h, 1e-3);
            step = if error <= 1.0 {
                controller.accept(trial, error, step)
            } else {
                rejected += 1;
                controller.reject(trial, Attempt::Done(error))
            };
        }
        assert!((step / 1e-3 - SAFETY).abs() < 1e-12, "{step}");
        assert!(rejected <= 6, "{rejected}");
    }

    #[test]
    fn steps_to_the_end_are_equal_and_no_sliver_is_left() {
        let trial = Controller::trial(1.0, 2.1);
        assert_eq!((trial.h, trial.is_last), (2.1 / 3.0, false));
        let last = Controller::trial(1.0, 0.7);
        assert_eq!((last.h, last.is_last), (0.7, true));
        assert_eq!(Controller::trial(1.0, 9.5).h, 1.0);
    }

    #[test]
    fn a_step_that_ends_at_the_communication_point_leaves_the_longer_one_proposed() {
        let mut controller = Controller::new(None);
        let cut = Controller::trial(1.0, 1e-3);
        assert_eq!(controller.accept(cut, 1.0, 1.0), 1.0);
        let whole = Controller::trial(1.0, 100.0);
        assert_eq!(controller.accept(whole, 1.0, 1.0), SAFETY);
    }

    #[test]
    fn grows_slowly_from_where_stage_equations_were_not_solved() {
        let mut controller = Controller::new(None);
        let failed = Controller::trial(1.0, 100.0);
        let step = controller.reject(failed, Attempt::Failed(0.5));
        assert_eq!(step, 0.5);
        let next = controller.accept(Controller::trial(step, 100.0), 0.0, step);
        // What just failed does not grow at all, then a tenth a step.
        assert!(next <= 0.5 * RELAX);
        let trial = Controller::trial(next, 100.0);
        assert!(controller.accept(trial, 0.0, next) <= 0.5 * RELAX * RELAX);
    }

    #[test]
    fn steps_are_those_between_the_points_of_the_plan_wherever_points_are() {
        let pitch = Pitch::new(Some(1.0));
        for (wanted, planned) in [
            (5.0, 1.0),
            (1.0, 1.0),
            (0.7, 0.5),
            (0.4, 1.0 / 3.0),
            (0.1, 0.1),
        ] {
            let allowed = pitch.allowed(wanted, false);
            for remaining in [0.25, 0.5, 1.0, 7.3, 100.0] {
                let trial = pitch.trial(wanted, allowed, remaining);
                assert!(trial.h <= planned * (1.0 + 1e-8), "{wanted}, {remaining}");
                // A step counts by its part of the one of the plan.
                assert!((trial.h / trial.part / planned - 1.0).abs() < 1e-8);
            }
            let trial = pitch.trial(wanted, allowed, 1.0);
            assert!(
                (trial.h / planned - 1.0).abs() < 1e-8,
                "{wanted}: {}",
                trial.h
            );
        }
        // What would lead beyond the next points of the plan may.
        assert_eq!(pitch.allowed(5.0, true), 5.0);
        assert!(pitch.allowed(3.0, true) < 1.1);
        let none = Pitch::default();
        assert_eq!(
            (none.allowed(5.0, false), none.way(0.2), none.points(0.2)),
            (5.0, 0.2, 1.0)
        );
        assert_eq!(none.trial(5.0, 5.0, 0.2).part, 1.0);
    }
}

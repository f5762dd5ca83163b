//! Latches: the coordinate of a joint is held from the moment at which it passes a value, until the latch is opened. A latch is a
//! constraint that stands among those which can be released, and that is released while the latch is open.
//!
//! A latch that closes at a speed is a plastic impact: of all velocities that joints and motions allow, those after it change least in
//! the mass norm, so that momentum is kept where nothing holds the bodies, and energy is only lost.
//!
//! Source: E. J. Routh, Dynamics of a System of Rigid Bodies, part I, chapter VIII; F. Pfeiffer, C. Glocker, Multibody Dynamics with
//! Unilateral Contacts (1996), chapter 6.

use super::{Constraint, Equation as _, View};
use crate::math::function::hermite;

/// When a latch may close, and what opens it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatchConditions {
    /// Whether it is closed at the start.
    pub is_closed: bool,
    /// From this time on it may close, s.
    pub from: f64,
    /// Index of the input that arms it: it may close only in steps that begin with this input above 0, and opens in one that does not.
    pub input: Option<usize>,
    /// Forces on the coordinate (N, or N m for an angle) beyond which it opens: least and largest.
    pub range: [f64; 2],
}

impl LatchConditions {
    /// Whether a force can open it.
    pub(in crate::system) fn is_bounded(&self) -> bool {
        self.range.iter().any(|limit| limit.is_finite())
    }

    /// Whether it may close at a time (s).
    pub(in crate::system) fn is_armed(&self, time: f64, inputs: &[f64]) -> bool {
        time >= self.from && !self.is_opened(inputs)
    }

    /// Whether its input opens it.
    pub(in crate::system) fn is_opened(&self, inputs: &[f64]) -> bool {
        self.input.is_some_and(|input| inputs[input] <= 0.0)
    }
}

/// Place of a latch in a system.
#[derive(Clone, Copy, Debug)]
pub struct LatchPlace {
    /// When it closes and opens.
    pub latch: LatchConditions,
    /// Index of the latch among what can be released.
    pub release: usize,
    /// Index of the constraint.
    pub constraint: usize,
}

/// Coordinate that a latch or friction may hold, less the value that it is held at (m or rad), its rate, and the force on it (N or N m).
#[derive(Clone, Copy, Debug, Default)]
pub struct HeldMotion {
    /// Distance from the value that is held, m or rad.
    pub distance: f64,
    /// Rate of the distance, m/s or rad/s.
    pub rate: f64,
    /// Force that holds the coordinate, N or N m; 0 where nothing does.
    pub force: f64,
}

impl HeldMotion {
    /// Returns this motion with the force in parts of a limit (N or N m).
    pub(in crate::system) fn over(self, limit: f64) -> Self {
        Self {
            force: self.force / limit.max(f64::MIN_POSITIVE),
            ..self
        }
    }

    /// The motion of a coordinate by the constraint that holds it and the multiplier.
    pub(in crate::system) fn of<const D: usize>(
        constraint: &Constraint<D>,
        view: &View<'_, D>,
        lambda: f64,
    ) -> Self {
        let mut rate = 0.0;
        (constraint.kind).for_each_pair(view, |pair| rate += pair.along(view.v));
        Self {
            distance: constraint.kind.value(view) - constraint.offset,
            rate,
            force: -lambda,
        }
    }
}

/// Where within a step something happens that ends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// Nowhere.
    None,
    /// After this part of the step.
    Within(f64),
    /// At the end of the step.
    AtEnd,
}

/// Part of a step of length `h` (s) after which a distance is zero for the first time: that of the cubic with the values and rates at
/// both ends. Distances up to `tolerance` are none.
pub(in crate::system) fn closing(
    [before, after]: [HeldMotion; 2],
    h: f64,
    tolerance: f64,
) -> Event {
    let start = before.distance;
    if start.abs() <= tolerance {
        return Event::None;
    }
    let is_over = after.distance * start <= 0.0;
    let is_near = after.distance.abs() <= tolerance;
    if is_near && (is_over || after.distance * after.rate < 0.0) {
        return Event::AtEnd;
    }
    let cubic = Cubic::new(
        [before.distance, after.distance],
        [h * before.rate, h * after.rate],
    );
    let Some(part) = cubic.first_crossing() else {
        return Event::None;
    };
    // A little beyond, so that what is found again lies behind it.
    let speed = cubic.rate(part).abs();
    let beyond = if speed > 0.0 {
        0.25 * tolerance / speed
    } else {
        0.0
    };
    Event::Within((part + beyond).min(1.0))
}

/// Part of a step after which a force leaves its range: that of the straight line between both forces. A force that is beyond by
/// less than `share` of the larger one leaves it at the end.
pub(in crate::system) fn opening(
    [before, after]: [HeldMotion; 2],
    range: [f64; 2],
    share: f64,
) -> Event {
    let size = before.force.abs().max(after.force.abs());
    let [least, most] = range;
    let limit = if after.force < least {
        least
    } else if after.force > most {
        most
    } else {
        return Event::None;
    };
    let beyond = (after.force - limit).abs();
    if beyond <= share * size {
        return Event::AtEnd;
    }
    let part = (limit - before.force) / (after.force - before.force);
    // A little beyond the limit.
    let part = part + 0.5 * share * size / (after.force - before.force).abs();
    Event::Within(if part.is_finite() {
        part.clamp(0.01, 1.0)
    } else {
        0.5
    })
}

/// The cubic over `[0, 1]` with given values and derivatives at both ends.
struct Cubic([f64; 4]);

impl Cubic {
    fn new([start, end]: [f64; 2], slopes: [f64; 2]) -> Self {
        let [a, b, c] = hermite(end - start, slopes);
        Self([start, a, b, c])
    }

    fn value(&self, t: f64) -> f64 {
        let [a, b, c, d] = self.0;
        a + t * (b + t * (c + t * d))
    }

    fn rate(&self, t: f64) -> f64 {
        let [_, b, c, d] = self.0;
        b + t * (2.0 * c + t * 3.0 * d)
    }

    /// The first place where it has another sign than at 0.
    fn first_crossing(&self) -> Option<f64> {
        let sign = self.value(0.0).signum();
        let is_crossed = |t: f64| sign * self.value(t) <= 0.0;
        let mut from = 0.0;
        let until = self.turning_points().into_iter().chain([1.0]);
        for until in until.filter(|t| (0.0..=1.0).contains(t)) {
            if is_crossed(until) {
                let (mut low, mut high) = (from, until);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    *(if is_crossed(middle) {
                        &mut high
                    } else {
                        &mut low
                    }) = middle;
                }
                return Some(high);
            }
            from = until;
        }
        None
    }

    /// Places where its derivative is zero, in order; infinite where there are none.
    fn turning_points(&self) -> [f64; 2] {
        let [_, b, c, d] = self.0;
        // 3 d t^2 + 2 c t + b = 0, without cancellation.
        let root = (c * c - 3.0 * b * d).sqrt();
        let q = -(c + root.copysign(c));
        let [first, second] = [q / (3.0 * d), b / q];
        if first < second {
            [first, second]
        } else {
            [second, first]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(distance: f64, rate: f64) -> HeldMotion {
        HeldMotion {
            distance,
            rate,
            force: 0.0,
        }
    }

    fn under(force: f64) -> HeldMotion {
        HeldMotion {
            force,
            ..HeldMotion::default()
        }
    }

    #[test]
    fn a_throw_that_comes_back_within_a_step_passes_the_value() {
        // y = -1 + 3 t - 2 t^2 has zeros at 1/2 and 1; over a step of 0.9 it ends above and passes at 5/9 of it.
        let y = |t: f64| at(-1.0 + 3.0 * t - 2.0 * t * t, 3.0 - 4.0 * t);
        let Event::Within(part) = closing([y(0.0), y(0.9)], 0.9, 1e-9) else {
            panic!("not found");
        };
        assert!((part - 5.0 / 9.0).abs() < 1e-8, "{part}");
        // Over 1.2 it ends below again.
        let Event::Within(part) = closing([y(0.0), y(1.2)], 1.2, 1e-9) else {
            panic!("not found");
        };
        assert!((part - 0.5 / 1.2).abs() < 1e-8, "{part}");
    }

    #[test]
    fn a_step_that_ends_near_the_value_closes_there() {
        assert_eq!(
            closing([at(1.0, -1.0), at(1e-10, -1.0)], 1.0, 1e-9),
            Event::AtEnd
        );
        assert_eq!(
            closing([at(1.0, -1.0), at(-1e-10, -1.0)], 1.0, 1e-9),
            Event::AtEnd
        );
        // What leads away has passed before.
        let passed = closing([at(1.0, -1.0), at(1e-10, 1.0)], 0.1, 1e-9);
        assert!(
            matches!(passed, Event::Within(part) if part < 1.0),
            "{passed:?}"
        );
        assert_eq!(
            closing([at(1.0, 0.1), at(2.0, 0.1)], 1.0, 1e-9),
            Event::None
        );
        // What stands at the value has not passed it.
        assert_eq!(
            closing([at(1e-10, -1.0), at(-1.0, -1.0)], 1.0, 1e-9),
            Event::None
        );
    }

    #[test]
    fn a_force_leaves_its_range_where_the_line_between_both_does() {
        let range = [-1.0, 3.0];
        let Event::Within(part) = opening([under(1.0), under(5.0)], range, 1e-6) else {
            panic!("not found");
        };
        assert!((part - 0.5).abs() < 1e-5, "{part}");
        let Event::Within(part) = opening([under(1.0), under(-3.0)], range, 1e-6) else {
            panic!("not found");
        };
        assert!((part - 0.5).abs() < 1e-5, "{part}");
        assert_eq!(opening([under(1.0), under(2.9)], range, 1e-6), Event::None);
        assert_eq!(
            opening([under(2.9), under(3.000_001)], range, 1e-6),
            Event::AtEnd
        );
    }
}

//! Dry friction of joints: whether a coordinate sticks or slides, and when that changes. While it sticks, a constraint holds it, as that of a
//! latch does, at the place that the state keeps.
//!
//! Source: F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts (1996), chapter 5 (stick and slip of independent contacts).

use super::latch::{Event, HeldMotion};
use crate::math::function::hermite;
use crate::system::FrictionState;

/// Place of friction in a system.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPlace {
    /// Where states keep what it does.
    pub state: FrictionState,
    /// Places of both numbers among the trajectories.
    pub courses: [usize; 2],
    /// Index of its constraint among what can be released.
    pub release: usize,
    /// Index of the constraint.
    pub constraint: usize,
    /// Index of the load.
    pub load: usize,
}

/// A change of friction at an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionChange {
    /// The coordinate sticks where it is.
    Sticks,
    /// The coordinate slides in this direction, 1 or -1.
    Slides(f64),
}

/// Speed relative to that before a step at which sliding ends.
const SLOW: f64 = 1e-6;
/// Distance that is left within the step, relative to the size of the coordinate, at which sliding ends.
const LEFT: f64 = 1e-10;
/// Part of a step to go on with where the coordinate moves against its direction from the beginning on.
const BACK: f64 = 0.1;

/// Where in a step of length `h` (s) a coordinate of this size that slides in a direction comes to rest: that of the cubic with the
/// values and rates at both ends.
pub(in crate::system) fn stopping(
    [before, after]: [HeldMotion; 2],
    direction: f64,
    h: f64,
    size: f64,
) -> Event {
    let way = direction * (after.distance - before.distance);
    let [first, last] = [before, after].map(|of| direction * of.rate);
    let slopes = [h * first, h * last];
    // The rate times the step is `a + 2 b t + 3 c t^2`.
    let [a, b, c] = hermite(way, slopes);
    let slows = 2.0 * b + 6.0 * c < 0.0;
    // What moves on almost as before does not stop, however short the step is.
    let is_left = last.abs() * h <= LEFT * size && last <= 0.5 * first;
    if slows && (last.abs() <= SLOW * first.abs() || is_left) {
        return Event::AtEnd;
    }
    // Zeros of the rate, without cancellation.
    let root = (b * b - 3.0 * a * c).sqrt();
    let q = -(b + root.copysign(b));
    let mut zeros = [q / (3.0 * c), a / q];
    zeros.sort_by(f64::total_cmp);
    let is_forward = first * h > LEFT * size;
    let mut inside = zeros.into_iter().filter(|t| *t > 0.0 && *t < 1.0);
    match inside.next() {
        Some(part) if is_forward => Event::Within(part),
        _ if last < 0.0 => Event::Within(BACK),
        _ => Event::None,
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

    #[test]
    fn what_slows_down_evenly_stops_where_its_speed_is_zero() {
        let y = |t: f64| at(3.0 * t - 2.0 * t * t, 3.0 - 4.0 * t);
        for (h, sign) in [(1.0, 1.0), (2.0, 1.0), (0.8, -1.0)] {
            let [from, to] = [y(0.0), y(h)].map(|of| at(sign * of.distance, sign * of.rate));
            let Event::Within(part) = stopping([from, to], sign, h, 1.0) else {
                panic!("not found");
            };
            assert!((part - 0.75 / h).abs() < 1e-14, "{part}");
        }
        assert_eq!(stopping([y(0.0), y(0.75)], 1.0, 0.75, 1.0), Event::AtEnd);
        assert_eq!(stopping([y(0.0), y(0.7)], 1.0, 0.7, 1.0), Event::None);
    }

    #[test]
    fn what_stands_still_and_turns_back_within_a_step_is_found() {
        // v = (1 - 4 t)(1 - 2 t) is negative between 1/4 and 1/2.
        let y = |t: f64| {
            at(
                t - 3.0 * t * t + 8.0 / 3.0 * t * t * t,
                (1.0 - 4.0 * t) * (1.0 - 2.0 * t),
            )
        };
        let Event::Within(part) = stopping([y(0.0), y(1.0)], 1.0, 1.0, 1.0) else {
            panic!("not found");
        };
        assert!((part - 0.25).abs() < 1e-14, "{part}");
        // A step of next to nothing, whose way is roundoff, stops nothing.
        let quick =
            |way: f64| stopping([at(1.0, 40.0), at(1.0 + way, 40.0 - 1e-9)], 1.0, 1e-13, 0.1);
        for way in [-1e-15, 0.0, 4e-12, 1e-11] {
            assert_eq!(quick(way), Event::None);
        }
        // From rest forwards nothing happens, backwards the step is shortened until the coordinate has hardly moved.
        let rest = at(0.0, 0.0);
        assert_eq!(stopping([rest, at(0.5, 1.0)], 1.0, 1.0, 1.0), Event::None);
        assert_eq!(
            stopping([rest, at(-0.5, -1.0)], 1.0, 1.0, 1.0),
            Event::Within(BACK)
        );
        assert_eq!(
            stopping([rest, at(-0.5e-12, -1e-6)], 1.0, 1e-6, 1.0),
            Event::AtEnd
        );
    }
}

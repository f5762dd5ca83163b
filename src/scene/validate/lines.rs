//! Checks of the shapes of cables and rods.

use std::f64::consts::TAU;

use super::checks::{expected, finite, positive, vector};
use crate::scene::{Error, Shape};

/// Most turns of a helix: of an element more than half a turn is an error, and elements are counted.
const TURNS: f64 = 1e4;

impl Shape {
    /// Checks the reference shape of a line body.
    ///
    /// # Errors
    /// Ends of another dimension or at one point, or a curvature or a number of turns out of range.
    pub(super) fn validate(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let kind = match self {
            Self::Line { .. } => "line",
            Self::Arc { .. } => "arc",
            Self::Helix { .. } => "helix",
        };
        let at = |key: &str| format!("{path}.{kind}.{key}");
        let [from, to] = self.ends();
        vector(&at("from"), dimension, &from)?;
        vector(&at("to"), dimension, &to)?;
        let distance = self.chord();
        if distance <= 0.0 {
            let wanted = "two ends that differ";
            return Err(expected(path, wanted, "the same point twice"));
        }
        match self {
            Self::Line { .. } => Ok(()),
            Self::Arc { length, .. } => {
                if dimension == 3 && from.full()[..2] == to.full()[..2] {
                    let wanted = "ends of an arc that are not one above the other";
                    return Err(expected(path, wanted, "an upright chord"));
                }
                finite(&at("length"), *length)?;
                if *length <= distance {
                    let wanted = format!("more than the distance between the ends ({distance} m)");
                    return Err(expected(&at("length"), &wanted, length));
                }
                Ok(())
            }
            Self::Helix { .. } => self.validate_helix(path, dimension),
        }
    }

    /// Checks the keys of a helix, if it is one.
    fn validate_helix(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let Self::Helix {
            radius,
            turns,
            start,
            ..
        } = self
        else {
            return Ok(());
        };
        let (radius, turns) = (*radius, *turns);
        let at = |key: &str| format!("{path}.helix.{key}");
        if dimension == 2 {
            let wanted = "\"line\" or \"arc\" in the plane";
            return Err(expected(path, wanted, "\"helix\""));
        }
        positive(&at("radius"), "m", radius)?;
        finite(&at("turns"), turns)?;
        if turns == 0.0 || turns.abs() > TURNS {
            let wanted = format!("a number other than 0 up to {TURNS:e}");
            return Err(expected(&at("turns"), &wanted, turns));
        }
        vector(&at("start"), dimension, start)?;
        if !self.point(0.0).iter().all(|x| x.is_finite()) {
            let wanted = "a direction that is not along the axis";
            return Err(expected(
                &at("start"),
                wanted,
                format!("{:?}", start.full()),
            ));
        }
        if !(TAU * turns * radius).is_finite() {
            let wanted = "a helix of finite length";
            return Err(expected(path, wanted, "an infinite one"));
        }
        Ok(())
    }
}

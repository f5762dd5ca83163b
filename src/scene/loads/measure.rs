//! What a load is over: the length between two markers, or a coordinate of a joint.

use super::*;
use crate::system::Coordinate;

/// A length between two ends, or a coordinate of a joint.
#[derive(Clone, Copy, Debug)]
pub enum ResolvedMeasure<'a> {
    /// Length between two ends, m.
    Length(Ends<'a>),
    /// Coordinate of a joint, m or rad.
    Coordinate(JointCoordinate<'a>),
}

impl<'a> ResolvedMeasure<'a> {
    /// Place of a load on it.
    pub fn place(&self) -> LoadPlace<'a> {
        match *self {
            Self::Length(ends) => LoadPlace::Ends(ends),
            Self::Coordinate(on) => LoadPlace::Coordinate(on),
        }
    }

    /// A stiffness along it, N/m or N m/rad, as one against displacements and one against rotations.
    pub fn stiffness(&self, stiffness: f64) -> [f64; 2] {
        match self {
            Self::Length(_) => [stiffness, 0.0],
            Self::Coordinate(on) => on.stiffness(stiffness),
        }
    }

    /// Unit of a force along it.
    pub fn unit(&self) -> Unit {
        if self.place().is_angle() {
            NEWTON_METRE
        } else {
            NEWTON
        }
    }

    /// Describes it for the documentation page.
    pub fn words(&self, dimension: usize) -> String {
        match self {
            Self::Length(ends) => {
                format!("{}{}", words::ends(ends), words::at_point(dimension, ends))
            }
            Self::Coordinate(on) => words::coordinate(on),
        }
    }
}

impl<'a> Resolved<'a> {
    /// Finds what a load is over: the length between markers, the first of which may be a point of the ground, or the coordinate of a joint.
    ///
    /// # Errors
    /// Both markers and a joint, or neither; a key of the other; a reference that does not exist.
    pub(super) fn require_measure(
        &self,
        path: &str,
        (markers, point): (Option<&'a [String; 2]>, Option<SceneVector>),
        (joint, coordinate): (Option<&'a str>, Option<CoordinateKind>),
    ) -> Result<ResolvedMeasure<'a>, Error> {
        let at = |key: &str| format!("{path}.{key}");
        match (markers, joint) {
            (Some(markers), None) => {
                if coordinate.is_some() {
                    let wanted = "nothing between markers, or a `joint` in place of them";
                    return Err(expected(&at("coordinate"), wanted, "a coordinate"));
                }
                let ends = self.require_pair(path, markers, point)?;
                Ok(ResolvedMeasure::Length(ends))
            }
            (None, Some(joint)) => {
                if point.is_some() {
                    let wanted = "nothing beside a joint, or `markers` in place of it";
                    return Err(expected(&at("point"), wanted, "a point"));
                }
                let on = self.require_loaded(path, joint, coordinate)?;
                Ok(ResolvedMeasure::Coordinate(on))
            }
            (Some(_), Some(_)) => Err(expected(path, "`markers` or `joint`", "both")),
            (None, None) => Err(expected(path, "`markers` or `joint`", "neither")),
        }
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Builds a length or a coordinate.
    pub(super) fn measure(&mut self, measure: &ResolvedMeasure<'_>) -> Coordinate<D> {
        match measure {
            ResolvedMeasure::Length(ends) => Coordinate::Length(self.ends(*ends)),
            ResolvedMeasure::Coordinate(on) => self.coordinate(on),
        }
    }
}

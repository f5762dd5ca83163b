//! Places of loads and motions on bodies and in joints.

use crate::scene::Error;
use crate::scene::joints::CoordinateKind;
use crate::scene::resolved::{Cable, Ends, JointCoordinate, Plate, Resolved, ResolvedMarker};

/// Place of a load or a motion on bodies.
#[derive(Clone, Copy, Debug)]
pub enum LoadPlace<'a> {
    /// A marker.
    Marker(ResolvedMarker<'a>),
    /// Between two ends.
    Ends(Ends<'a>),
    /// A coordinate of a joint.
    Coordinate(JointCoordinate<'a>),
    /// A cable, rod or beam along its line.
    Line(Cable<'a>),
    /// The surface of a plate or shell.
    Surface(Plate<'a>),
}

impl<'a> LoadPlace<'a> {
    /// Markers where the mesh of a body needs a node; those of joints have one.
    pub fn markers(&self) -> Vec<ResolvedMarker<'a>> {
        match self {
            Self::Marker(marker) => vec![*marker],
            Self::Ends(ends) => ends.markers(),
            Self::Coordinate(_) | Self::Line(_) | Self::Surface(_) => Vec::new(),
        }
    }

    /// Name of the marker, the second one of two, the joint or the body.
    pub fn name(&self) -> &'a str {
        match self {
            Self::Marker(marker) => marker.name,
            Self::Ends(ends) => ends.second.name,
            Self::Coordinate(on) => on.name(),
            Self::Line(cable) => &cable.body.name,
            Self::Surface(plate) => &plate.body.name,
        }
    }

    /// Both ends, where there are two.
    pub fn ends(&self) -> Option<Ends<'a>> {
        match self {
            Self::Ends(ends) => Some(*ends),
            Self::Marker(_) | Self::Coordinate(_) | Self::Line(_) | Self::Surface(_) => None,
        }
    }

    /// The marker, or the second end.
    pub fn second(&self) -> Option<ResolvedMarker<'a>> {
        match self {
            Self::Marker(marker) => Some(*marker),
            Self::Ends(ends) => Some(ends.second),
            Self::Coordinate(on) => Some(on.ends().second),
            Self::Line(_) | Self::Surface(_) => None,
        }
    }

    /// Indices of the bodies, among all bodies.
    pub fn bodies(&self) -> Vec<usize> {
        match self {
            Self::Marker(marker) => vec![marker.place.body_index()],
            Self::Ends(ends) => ends.bodies(),
            Self::Coordinate(on) => on.ends().bodies(),
            Self::Line(cable) => vec![cable.id.body_index()],
            Self::Surface(plate) => vec![plate.id.index()],
        }
    }

    /// Whether it is an angle of a joint.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Coordinate(on) if on.is_angle())
    }
}

/// Forces and moments of a kind of load that follow from the motion, which outputs read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exerts {
    /// None.
    Nothing,
    /// A force.
    Force,
    /// A force and a moment.
    ForceAndMoment,
    /// A force on a displacement, a moment on an angle.
    ByCoordinate,
}

impl Exerts {
    /// Whether there is a force, and whether there is a moment, at a place.
    pub fn at(self, place: &LoadPlace<'_>) -> [bool; 2] {
        match self {
            Self::Nothing => [false; 2],
            Self::Force => [true, false],
            Self::ForceAndMoment => [true; 2],
            Self::ByCoordinate => [!place.is_angle(), place.is_angle()],
        }
    }
}

impl<'a> Resolved<'a> {
    /// Finds the coordinate of a joint that a load acts on; by default the displacement where there is one.
    ///
    /// # Errors
    /// The joint does not exist, or has no such coordinate.
    pub(super) fn require_loaded(
        &self,
        path: &str,
        joint: &'a str,
        asked: Option<CoordinateKind>,
    ) -> Result<JointCoordinate<'a>, Error> {
        let default = CoordinateKind::Displacement;
        self.require_coordinate(&format!("{path}.joint"), joint, asked, default)
    }
}

//! Places of loads and motions on bodies and in joints.

use crate::scene::Error;
use crate::scene::joints::CoordinateKind;
use crate::scene::resolved::{
    BodyReference, Cable, Ends, JointCoordinate, Plate, Resolved, ResolvedMarker,
};
use crate::scene::validate::checks::unknown;

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

/// Kind of place of a load, by which units of its numbers differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadExtent {
    /// Points, or a displacement.
    Point,
    /// An angle of a joint.
    Angle,
    /// A line, by its length.
    Line,
    /// A surface, by its area.
    Surface,
}

impl<'a> LoadPlace<'a> {
    /// Kind of place.
    pub fn extent(&self) -> LoadExtent {
        match self {
            Self::Coordinate(on) if on.is_angle() => LoadExtent::Angle,
            Self::Marker(_) | Self::Ends(_) | Self::Coordinate(_) => LoadExtent::Point,
            Self::Line(_) => LoadExtent::Line,
            Self::Surface(_) => LoadExtent::Surface,
        }
    }

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
        self.extent() == LoadExtent::Angle
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
    /// Finds a line body or a plate or shell that something acts along.
    ///
    /// # Errors
    /// The body does not exist, is rigid or reduced, or is a line that is reduced to modes.
    pub(super) fn require_line_or_surface(
        &self,
        path: &str,
        name: &str,
    ) -> Result<LoadPlace<'a>, Error> {
        match self.bodies_by_name.get(name) {
            Some(BodyReference::Plate(plate)) => return Ok(LoadPlace::Surface(*plate)),
            Some(BodyReference::Cable(_)) => {
                return self.require_cable(path, name).map(LoadPlace::Line);
            }
            _ => {}
        }
        let known = self.bodies.iter().filter_map(|body| match body {
            BodyReference::Cable(cable) => Some(&*cable.body.name),
            BodyReference::Plate(plate) => Some(&*plate.body.name),
            _ => None,
        });
        let wanted = "the name of a cable, rod, beam, plate or shell of this scene";
        Err(unknown(path, wanted, name, known))
    }

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

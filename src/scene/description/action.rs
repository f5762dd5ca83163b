//! Forces and moments, of loads as of inputs.

use super::value::{ALONG_LINE, OVER_SURFACE};

/// A force or a moment as the scene describes it.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'a> {
    /// Kind.
    pub kind: ActionKind,
    /// Name of the marker, joint or body that it acts on.
    pub on: &'a str,
    /// Whether its components rotate with what it acts on.
    pub follower: bool,
}

/// A force or a moment, of a load as of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActionKind {
    /// At a marker, N.
    Force,
    /// At a marker, N m.
    Moment,
    /// In a joint, N m.
    Torque,
    /// On a cable, N/m.
    DistributedForce,
    /// On a rod or beam, N m/m.
    DistributedMoment,
    /// On a plate or shell along its normal, Pa.
    Pressure,
    /// On a plate or shell, N/m^2.
    AreaForce,
}

/// Part that a force or moment acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActsOn {
    /// A marker.
    Marker,
    /// A joint with an angle.
    Joint,
    /// A cable as a whole.
    Cable,
    /// The sections of a rod or beam as a whole.
    Sections,
    /// The surface of a plate or shell as a whole.
    Surface,
}

impl ActionKind {
    /// Returns the part that it acts on, whether it is a force, its name and its unit.
    fn declaration(self) -> (ActsOn, bool, [&'static str; 2]) {
        match self {
            Self::Force => (ActsOn::Marker, true, ["force", "N"]),
            Self::Moment => (ActsOn::Marker, false, ["moment", "N·m"]),
            Self::Torque => (ActsOn::Joint, false, ["torque", "N·m"]),
            Self::DistributedForce => (ActsOn::Cable, true, ["distributed force", "N/m"]),
            Self::DistributedMoment => (ActsOn::Sections, false, ["distributed moment", "N·m/m"]),
            Self::Pressure => (ActsOn::Surface, false, ["pressure", "Pa"]),
            Self::AreaForce => (ActsOn::Surface, true, ["area force", "N/m²"]),
        }
    }

    /// Returns the part that it acts on.
    pub fn acts_on(self) -> ActsOn {
        self.declaration().0
    }

    /// Coordinates of the body that its values may change with.
    pub fn coordinates(self) -> &'static [&'static str] {
        match self.acts_on() {
            ActsOn::Cable | ActsOn::Sections => ALONG_LINE,
            ActsOn::Surface => &OVER_SURFACE,
            ActsOn::Marker | ActsOn::Joint => &[],
        }
    }

    /// Whether it is a force with components, not a moment or a pressure.
    pub fn is_force(self) -> bool {
        self.declaration().1
    }

    /// Returns its name and its unit.
    pub fn words(self) -> [&'static str; 2] {
        self.declaration().2
    }

    /// Number of components: those of a force in so many dimensions; of moments 1 in the plane, 3 in space; 1 of a torque or a pressure.
    pub fn components(self, dimension: usize) -> usize {
        match self {
            Self::Moment | Self::DistributedMoment if dimension == 2 => 1,
            Self::Torque | Self::Pressure => 1,
            Self::Force
            | Self::DistributedForce
            | Self::Moment
            | Self::DistributedMoment
            | Self::AreaForce => dimension,
        }
    }
}

/// Whether a key that is false by default may be left out.
pub fn is_false(value: &bool) -> bool {
    !value
}

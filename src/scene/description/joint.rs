//! Joints and driven motions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Keys, Kind, MotionValue, Vector};

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// What the joint holds.
    pub kind: JointKind,
    /// What it joins: `ground` or `body.marker`, then `body.marker`. `point_on_cable`: the name of a cable,
    /// then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: where on the ground, m; where the second marker is at the start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<Vector>,
    /// In the axes of the body of the first marker at the start (of ground: the global ones; of a rod or beam the tangent and both axes of
    /// its section there). `point_on_line`, `cylindrical`, `screw`: direction
    /// of the line along which the marker may move; `prismatic`: the same, in the plane by default the direction of the
    /// first marker itself. In space, `revolute`, `cylindrical`, `screw`: the axis of rotation, which none of them goes without
    /// (a ball joint is `spherical`); `universal`: that of the two axes which is fixed in the first body; `planar`: what is across the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<Vector>,
    /// `universal` only: the axis that is fixed in the second body, across `direction` and in the same axes as that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_direction: Option<Vector>,
    /// `weld`, `orientation`, `prismatic`: direction of the second marker less that of the first (of ground: 0),
    /// rad; as at the start by default, and in space always. `revolute` with `stiffness` or `damping`: the angle at which its spring is
    /// unloaded, rad, by default that at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// `distance` only: length of the link, m; the distance at the start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
    /// `screw` only: way along the axis a full turn, m; negative of a left-handed thread.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
    /// `generic` only: what is let go along and about the axes of the body of the first marker (of ground: the global
    /// ones); everything else is held. Of two rotations the first turns about the axis of the first body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub free: Option<Vec<Freedom>>,
    /// `revolute` only: stiffness of a spring against rotation, N m/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// `revolute` only: damping of rotation, N m s/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    /// does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub release_time: Option<f64>,
}

/// Joints by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Holds the position, in space also an axis of rotation. A spring and a damper may act against the rotation.
    Revolute,
    /// Holds the position, in space: a ball in its socket.
    Spherical,
    /// Holds the position and a right angle between an axis of each body, in space: a cross between two forks.
    Universal,
    /// Holds the position and the direction, in space how bodies stand to each other.
    Weld,
    /// Holds the marker on a line of the first one, which may move. The marker rotates freely.
    PointOnLine,
    /// Holds the marker on a line of the first one, in space, and lets it turn about that line only.
    Cylindrical,
    /// Holds the marker on a line of the first one, in space, along which it goes as it turns about it.
    Screw,
    /// Holds the marker on a line of the first one, and the direction, in space how bodies stand to each other.
    Prismatic,
    /// Holds the marker in a plane of the first one, in space, and lets it turn in that plane only.
    Planar,
    /// Holds the direction, in space how bodies stand to each other.
    Orientation,
    /// Holds the distance.
    Distance,
    /// Holds the marker on the line of a cable.
    PointOnCable,
    /// Holds, in space, what `free` does not name.
    Generic,
}

/// A translation or a rotation that a joint lets go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Freedom {
    /// Along the first axis.
    X,
    /// Along the second axis.
    Y,
    /// Along the third axis.
    Z,
    /// About the first axis.
    RotationX,
    /// About the second axis.
    RotationY,
    /// About the third axis.
    RotationZ,
}

impl Freedom {
    /// Which axis it is of, and whether it is a rotation.
    pub fn axis(self) -> (usize, bool) {
        match self {
            Self::X => (0, false),
            Self::Y => (1, false),
            Self::Z => (2, false),
            Self::RotationX => (0, true),
            Self::RotationY => (1, true),
            Self::RotationZ => (2, true),
        }
    }
}

/// A gear between two joints: `c2 = ratio c1`, of their coordinates from the start on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gear {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// The joints: the angle of those with an axis, else the displacement.
    pub joints: [String; 2],
    /// How much the coordinate of the second changes with that of the first: 1, m/rad, rad/m; negative where they turn opposite ways.
    pub ratio: f64,
}

/// A coordinate of a joint by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CoordinateKind {
    /// The way along its line from the first marker or its point, m.
    Displacement,
    /// The angle about its axis, rad.
    Angle,
}

/// What keys, checks, equations, outputs, words and the symbol of a kind of joint derive from.
#[derive(Clone, Copy, Debug)]
pub struct JointSpec {
    /// Its name in scenes.
    pub name: &'static str,
    /// Its keys.
    pub keys: &'static [Keys],
    /// What it holds.
    pub holds: &'static [Condition],
    /// How it is drawn.
    pub symbol: Symbol,
}

/// What a joint holds of its second marker, as the first one sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// The position, at that of the first marker.
    Position,
    /// The position, on a line through the first marker.
    Line,
    /// The direction; in space how bodies stand to each other.
    Direction,
    /// In space an axis, which stays along that of the first body.
    Axis,
    /// In space an axis, which stays across one of the first body.
    Across,
    /// In space the position, in a plane through the first marker.
    Plane,
    /// The distance.
    Distance,
    /// The position, on the curve of a cable, which stands in place of the first marker.
    Curve,
    /// Nothing: a spring and a damper act against the rotation.
    Spring,
    /// In space the way along a line, in proportion to the angle about it.
    Screw,
    /// In space whatever is not let go.
    Rest,
}

/// How a joint is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// A circle, on a foot where one end is the ground.
    Pin,
    /// A spiral spring around a pin.
    Spiral,
    /// A hatched wall, or a block between two bodies.
    Weld,
    /// A sleeve on a rail.
    Slider,
    /// A sleeve on a line through a body.
    Prismatic,
    /// A circle with a bar.
    Orientation,
    /// A rod between two pins.
    Link,
    /// A ring around a cable.
    Ring,
}

impl JointKind {
    /// Whether there is one in space alone.
    pub fn is_spatial(self) -> bool {
        matches!(
            self,
            Self::Spherical
                | Self::Universal
                | Self::Cylindrical
                | Self::Planar
                | Self::Screw
                | Self::Generic
        )
    }

    /// The one declaration of the kind.
    #[rustfmt::skip] // a table
    pub fn declaration(self) -> JointSpec {
        use Condition::{Across, Axis, Curve, Direction, Distance, Line, Plane, Position, Rest, Screw};
        let (name, keys, holds, symbol): (_, &[Keys], &[Condition], _) = match self {
            Self::Revolute => {
                ("revolute", &[(&[], &["point", "direction", "angle", "stiffness", "damping"])], &[Position, Axis], Symbol::Pin)
            }
            Self::Spherical => ("spherical", &[(&[], &["point"])], &[Position], Symbol::Pin),
            Self::Universal => {
                ("universal", &[(&["direction", "second_direction"], &["point"])], &[Position, Across], Symbol::Pin)
            }
            Self::Weld => ("weld", &[(&[], &["point", "angle"])], &[Position, Direction], Symbol::Weld),
            Self::PointOnLine => ("point_on_line", &[(&["direction"], &["point"])], &[Line], Symbol::Slider),
            Self::Cylindrical => ("cylindrical", &[(&["direction"], &["point"])], &[Line, Axis], Symbol::Prismatic),
            Self::Screw => ("screw", &[(&["direction", "pitch"], &["point"])], &[Line, Axis, Screw], Symbol::Prismatic),
            Self::Planar => ("planar", &[(&["direction"], &["point"])], &[Plane, Axis], Symbol::Slider),
            Self::Prismatic => ("prismatic", &[(&[], &["point", "direction", "angle"])], &[Line, Direction], Symbol::Prismatic),
            Self::Orientation => ("orientation", &[(&[], &["angle"])], &[Direction], Symbol::Orientation),
            Self::Distance => ("distance", &[(&[], &["point", "length"])], &[Distance], Symbol::Link),
            Self::PointOnCable => ("point_on_cable", &[(&[], &[])], &[Curve], Symbol::Ring),
            Self::Generic => ("generic", &[(&["free"], &["point"])], &[Rest], Symbol::Orientation),
        };
        JointSpec { name, keys, holds, symbol }
    }
}

impl Joint {
    /// Whether a spring or a damper acts against its rotation.
    pub fn is_sprung(&self) -> bool {
        self.stiffness.is_some() || self.damping.is_some()
    }

    /// Conditions that it is made of: those of its kind, and its spring.
    pub fn holds(&self) -> Vec<Condition> {
        let spring = self.is_sprung().then_some(Condition::Spring);
        let own = self.kind.declaration().holds.iter().copied();
        own.chain(spring).collect()
    }
}

impl Kind for JointKind {
    const PART: &'static str = "Joint";
    const SPEAKS: bool = true;

    fn keys(&self) -> &'static [Keys] {
        self.declaration().keys
    }
}

/// A driven motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// What is driven.
    pub kind: MotionKind,
    /// `position`, `angle`, `orientation`: the driven `body.marker`; `winch`: the end of the cable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// `angle`: name of the driven revolute joint; `displacement`: of the joint along a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Its course in time: m or rad; of `orientation` the four parts of a quaternion.
    pub value: MotionValue,
}

/// Driven motions by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionKind {
    /// Direction of a marker, or direction of the second marker of a joint less that of its first,
    /// rad.
    Angle,
    /// Position of a marker, m.
    Position,
    /// In space how a rigid body stands: the quaternion, scalar first, of the frame of a marker's body in global axes, of any
    /// length and either sign. As an input with rates: the angular velocity and the angular acceleration, in global axes.
    Orientation,
    /// Displacement along the line of a point on a line, a prismatic, a cylindrical joint or a screw from its first marker or its point, m; not where
    /// that line belongs to a cable.
    Displacement,
    /// Length that a winch at a marker, an end of a cable, has paid out since the start, m; negative where it has taken in. The mass of the
    /// cable changes with it. What is on the winch has no part in the scene; what acts between its ends acts all along it: `distributed_force`
    /// (where `s` is the share of the length now), `contact`, `fluid` without added mass.
    Winch,
}

impl Kind for MotionKind {
    const PART: &'static str = "Motion";

    fn keys(&self) -> &'static [Keys] {
        match self {
            Self::Position | Self::Orientation | Self::Winch => &[(&["marker"], &[])],
            Self::Angle => &[(&["joint"], &[]), (&["marker"], &[])],
            Self::Displacement => &[(&["joint"], &[])],
        }
    }
}

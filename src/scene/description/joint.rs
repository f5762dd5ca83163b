//! Joints.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneVector;
use super::tagged::{kinds, part};

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Joint {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the joint.
    #[serde(flatten)]
    pub kind: JointKind,
    /// Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    /// does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub release_time: Option<f64>,
}
part!(Joint { name: String, release_time: Option<f64> });

kinds! {
    /// Joints by kind.
    JointKind of "Joint", speaks: true {
        /// Holds the position, in space also an axis of rotation. A spring and a damper may act against the rotation.
        Revolute(Revolute),
        /// Holds the position, in space: a ball in its socket.
        Spherical(Spherical),
        /// Holds the position and a right angle between an axis of each body, in space: a cross between two forks.
        Universal(Universal),
        /// Holds the position and turns both bodies alike about an axis of each, in space: the homokinetic joint of drive shafts.
        ConstantVelocity(ConstantVelocity),
        /// Holds the position and the direction, in space how bodies stand to each other.
        Weld(Weld),
        /// Holds the marker on a line of the first one, which may move. The marker rotates freely.
        PointOnLine(PointOnLineJoint),
        /// Holds the marker on a line of the first one, in space, and lets it turn about that line only.
        Cylindrical(Cylindrical),
        /// Holds the marker on a line of the first one, in space, along which it goes as it turns about it.
        Screw(Screw),
        /// Holds the marker on a line of the first one, and the direction, in space how bodies stand to each other.
        Prismatic(Prismatic),
        /// Holds the marker in a plane of the first one, in space, and lets it turn in that plane only.
        Planar(Planar),
        /// Holds the direction, in space how bodies stand to each other.
        Orientation(OrientationJoint),
        /// Holds the distance.
        Distance(DistanceJoint),
        /// Holds the marker on the line of a cable.
        PointOnCable(PointOnCable),
        /// Holds, in space, what `free` does not name.
        Generic(Generic),
    }
}

/// A revolute joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Revolute {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of rotation, required in space and absent in the plane. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<SceneVector>,
    /// With `stiffness` or `damping` only: angle at which the spring is unloaded, rad; by default the angle at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Stiffness of a spring against rotation, N m/rad; by default there is no spring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping of rotation, N m s/rad; by default there is no damper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
}

/// A spherical joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Spherical {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
}

/// A universal joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Universal {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of the cross that is fixed in the first body. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
    /// Axis of the cross that is fixed in the second body, perpendicular to `direction` and in the same axes.
    pub second_direction: SceneVector,
}

/// A constant-velocity joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConstantVelocity {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of the first shaft. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
    /// Axis of the second shaft in the same axes and sense, less than a right angle from `direction`; by default `direction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_direction: Option<SceneVector>,
}

/// A weld.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Weld {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    /// The direction of `ground` is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

/// A point on a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointOnLineJoint {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Direction of the line. It is given in the axes of the first marker's body at the start: of `ground` the global axes, of a rod
    /// or beam the tangent and both axes of its section.
    // What is missing is told once the dimension is known.
    #[serde(default)]
    #[schemars(!default)]
    pub direction: SceneVector,
}

/// A cylindrical joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cylindrical {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Direction of the line, which is the axis of rotation too. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
}

/// A screw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Screw {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of the screw. It is given in the axes of the first marker's body at the start: of `ground` the global axes, of a rod
    /// or beam the tangent and both axes of its section.
    pub direction: SceneVector,
    /// Displacement along the axis for each full turn, m; negative for a left-handed thread.
    pub pitch: f64,
}

/// A prismatic joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Prismatic {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Direction of the line, required in space; in the plane by default the direction of the first marker. It is given in the axes of
    /// the first marker's body at the start: of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<SceneVector>,
    /// In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    /// The direction of `ground` is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

/// A planar joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Planar {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the plane, then the `body.marker` in the plane.
    pub markers: [String; 2],
    /// With `ground` only: a point of the plane on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Normal of the plane, which is the axis of rotation too. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
}

/// A joint that holds an orientation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OrientationJoint {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    /// The direction of `ground` is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

/// A link of constant length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistanceJoint {
    /// Markers at the ends of the link: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end of the link on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Length of the link, m; by default the distance of its ends at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
}

/// A point on the line of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointOnCable {
    /// Name of the cable, then the `body.marker` on its line.
    pub markers: [String; 2],
}

/// A joint by what it leaves free.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Generic {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Translations along and rotations about the axes of the first marker's body that are free. The joint holds all others. With
    /// `ground` these are the global axes. Of two free rotations the first is about the axis of the first body.
    pub free: Vec<Freedom>,
}

/// A translation or a rotation that a joint leaves free.
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

/// Primitive that a joint is made of: what it holds of its second marker, seen from the first one. Directions are in the axes of the first
/// marker's body at the start. An angle or a length that is not given is that at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointPrimitive {
    /// The position, at that of the first marker.
    AtPoint,
    /// The position, on a line through the first marker in this direction.
    Inline([f64; 3]),
    /// The position, in a plane through the first marker across this direction, in space.
    Inplane([f64; 3]),
    /// The position, on the curve of the cable that stands in place of the first marker.
    PointOnCurve,
    /// The direction, at this angle, rad; in space all axes.
    Orientation(Option<f64>),
    /// An axis, which stays along that of the first body, in space.
    ParallelAxes([f64; 3]),
    /// A right angle between an axis of the first body and one of the second, in space.
    Perpendicular([f64; 3], [f64; 3]),
    /// Equal rotation about an axis of the first body and one of the second, in space.
    Homokinetic([f64; 3], [f64; 3]),
    /// Displacement along a line in proportion to the angle about it, in space: that of one full rotation, m.
    Screw(f64),
    /// The distance, m.
    Distance(Option<f64>),
    /// Nothing: a spring and a damper act against the rotation.
    Spring {
        /// Angle at rest, rad.
        rest: Option<f64>,
        /// Stiffness, N m/rad.
        stiffness: f64,
        /// Damping, N m s/rad.
        damping: f64,
    },
}

impl JointPrimitive {
    /// Whether it holds directions alone.
    pub fn is_directional(&self) -> bool {
        matches!(
            self,
            Self::Orientation(_)
                | Self::ParallelAxes(_)
                | Self::Perpendicular(..)
                | Self::Homokinetic(..)
        )
    }

    /// Whether both markers need axes: those of a rigid body with inertia, a rod or a beam.
    pub fn needs_axes(&self) -> bool {
        matches!(
            self,
            Self::ParallelAxes(_)
                | Self::Perpendicular(..)
                | Self::Homokinetic(..)
                | Self::Inplane(_)
        )
    }

    /// Returns the direction of a line, an axis or a normal; the first of two.
    pub fn direction(&self) -> Option<[f64; 3]> {
        match self {
            Self::Inline(of)
            | Self::Inplane(of)
            | Self::ParallelAxes(of)
            | Self::Perpendicular(of, _)
            | Self::Homokinetic(of, _) => Some(*of),
            Self::AtPoint
            | Self::PointOnCurve
            | Self::Orientation(_)
            | Self::Screw(_)
            | Self::Distance(_)
            | Self::Spring { .. } => None,
        }
    }

    /// Converts the directions by a function.
    pub fn directed(self, by: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        match self {
            Self::Inline(along) => Self::Inline(by(along)),
            Self::Inplane(across) => Self::Inplane(by(across)),
            Self::ParallelAxes(axis) => Self::ParallelAxes(by(axis)),
            Self::Perpendicular(first, second) => Self::Perpendicular(by(first), by(second)),
            Self::Homokinetic(first, second) => Self::Homokinetic(by(first), by(second)),
            Self::AtPoint
            | Self::PointOnCurve
            | Self::Orientation(_)
            | Self::Screw(_)
            | Self::Distance(_)
            | Self::Spring { .. } => self,
        }
    }
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
    /// A pin between two rails.
    Slider,
    /// A block between two rails.
    Prismatic,
    /// A square.
    Orientation,
    /// A rod between two pins.
    Link,
    /// A ring around a cable.
    Ring,
}

impl JointKind {
    /// Whether there is one in space alone.
    pub fn is_spatial(&self) -> bool {
        matches!(
            self,
            Self::Spherical(_)
                | Self::Universal(_)
                | Self::ConstantVelocity(_)
                | Self::Cylindrical(_)
                | Self::Planar(_)
                | Self::Screw(_)
                | Self::Generic(_)
        )
    }

    /// Returns the primitives that the joint is made of.
    pub fn primitives(&self) -> Vec<JointPrimitive> {
        use JointPrimitive::{AtPoint, Inline, Inplane, Orientation, ParallelAxes, Perpendicular};
        let full = |of: &SceneVector| of.full();
        match self {
            Self::Revolute(of) => {
                let axis = of.direction.as_ref().map(full).map(ParallelAxes);
                let spring = of.is_sprung().then_some(JointPrimitive::Spring {
                    rest: of.angle,
                    stiffness: of.stiffness.unwrap_or(0.0),
                    damping: of.damping.unwrap_or(0.0),
                });
                [AtPoint].into_iter().chain(axis).chain(spring).collect()
            }
            Self::Spherical(_) => vec![AtPoint],
            Self::Universal(of) => {
                let axes = Perpendicular(of.direction.full(), of.second_direction.full());
                vec![AtPoint, axes]
            }
            Self::ConstantVelocity(of) => {
                let first = of.direction.full();
                let second = of.second_direction.as_ref().map_or(first, full);
                vec![AtPoint, JointPrimitive::Homokinetic(first, second)]
            }
            Self::Weld(of) => vec![AtPoint, Orientation(of.angle)],
            Self::PointOnLine(of) => vec![Inline(of.direction.full())],
            Self::Cylindrical(of) => {
                let along = of.direction.full();
                vec![Inline(along), ParallelAxes(along)]
            }
            Self::Screw(of) => {
                let (along, pitch) = (of.direction.full(), JointPrimitive::Screw(of.pitch));
                vec![Inline(along), ParallelAxes(along), pitch]
            }
            Self::Prismatic(of) => {
                // By default the direction of the first end itself.
                let along = of.direction.as_ref().map_or([1.0, 0.0, 0.0], full);
                vec![Inline(along), Orientation(of.angle)]
            }
            Self::Planar(of) => {
                let normal = of.direction.full();
                vec![Inplane(normal), ParallelAxes(normal)]
            }
            Self::Orientation(of) => vec![Orientation(of.angle)],
            Self::Distance(of) => vec![JointPrimitive::Distance(of.length)],
            Self::PointOnCable(_) => vec![JointPrimitive::PointOnCurve],
            Self::Generic(of) => of.primitives(),
        }
    }

    /// How it is drawn.
    pub fn symbol(&self) -> Symbol {
        match self {
            Self::Revolute(of) if of.is_sprung() => Symbol::Spiral,
            Self::Revolute(_)
            | Self::Spherical(_)
            | Self::Universal(_)
            | Self::ConstantVelocity(_) => Symbol::Pin,
            Self::Weld(_) => Symbol::Weld,
            Self::PointOnLine(_) | Self::Planar(_) => Symbol::Slider,
            Self::Cylindrical(_) | Self::Screw(_) | Self::Prismatic(_) => Symbol::Prismatic,
            Self::Orientation(_) | Self::Generic(_) => Symbol::Orientation,
            Self::Distance(_) => Symbol::Link,
            Self::PointOnCable(_) => Symbol::Ring,
        }
    }

    /// Names of what it joins: `ground`, a marker or a cable, then a marker.
    pub fn markers(&self) -> &[String; 2] {
        match self {
            Self::Revolute(of) => &of.markers,
            Self::Spherical(of) => &of.markers,
            Self::Universal(of) => &of.markers,
            Self::ConstantVelocity(of) => &of.markers,
            Self::Weld(of) => &of.markers,
            Self::PointOnLine(of) => &of.markers,
            Self::Cylindrical(of) => &of.markers,
            Self::Screw(of) => &of.markers,
            Self::Prismatic(of) => &of.markers,
            Self::Planar(of) => &of.markers,
            Self::Orientation(of) => &of.markers,
            Self::Distance(of) => &of.markers,
            Self::PointOnCable(of) => &of.markers,
            Self::Generic(of) => &of.markers,
        }
    }

    /// Point on the ground, m, of a joint that is given one.
    pub fn point(&self) -> Option<SceneVector> {
        match self {
            Self::Revolute(of) => of.point,
            Self::Spherical(of) => of.point,
            Self::Universal(of) => of.point,
            Self::ConstantVelocity(of) => of.point,
            Self::Weld(of) => of.point,
            Self::PointOnLine(of) => of.point,
            Self::Cylindrical(of) => of.point,
            Self::Screw(of) => of.point,
            Self::Prismatic(of) => of.point,
            Self::Planar(of) => of.point,
            Self::Distance(of) => of.point,
            Self::Generic(of) => of.point,
            Self::Orientation(_) | Self::PointOnCable(_) => None,
        }
    }

    /// Values of `direction` and `second_direction`, of a joint that has them.
    pub fn directions(&self) -> [Option<SceneVector>; 2] {
        match self {
            Self::Revolute(of) => [of.direction, None],
            Self::Universal(of) => [Some(of.direction), Some(of.second_direction)],
            Self::ConstantVelocity(of) => [Some(of.direction), of.second_direction],
            Self::PointOnLine(of) => [Some(of.direction), None],
            Self::Cylindrical(of) => [Some(of.direction), None],
            Self::Screw(of) => [Some(of.direction), None],
            Self::Prismatic(of) => [of.direction, None],
            Self::Planar(of) => [Some(of.direction), None],
            Self::Spherical(_)
            | Self::Weld(_)
            | Self::Orientation(_)
            | Self::Distance(_)
            | Self::PointOnCable(_)
            | Self::Generic(_) => [None; 2],
        }
    }

    /// Value of `angle`, rad, of a joint that is given one.
    pub fn angle(&self) -> Option<f64> {
        match self {
            Self::Revolute(Revolute { angle, .. })
            | Self::Weld(Weld { angle, .. })
            | Self::Prismatic(Prismatic { angle, .. })
            | Self::Orientation(OrientationJoint { angle, .. }) => *angle,
            _ => None,
        }
    }
}

impl Generic {
    /// Returns the primitives that hold what is not free.
    fn primitives(&self) -> Vec<JointPrimitive> {
        let axis = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let named = |is_rotation: bool| {
            let free = self.free.iter().map(|freedom| freedom.axis());
            let free = free.filter(|(_, of)| *of == is_rotation).map(|(k, _)| k);
            free.collect::<Vec<usize>>()
        };
        let (ways, turns) = (named(false), named(true));
        let mut primitives: Vec<JointPrimitive> = match ways[..] {
            [] => vec![JointPrimitive::AtPoint],
            [along] => vec![JointPrimitive::Inline(axis(along))],
            _ => {
                let held = (0..3).filter(|k| !ways.contains(k));
                held.map(|k| JointPrimitive::Inplane(axis(k))).collect()
            }
        };
        primitives.extend(match turns[..] {
            [] => Some(JointPrimitive::Orientation(None)),
            [about] => Some(JointPrimitive::ParallelAxes(axis(about))),
            [first, second] => Some(JointPrimitive::Perpendicular(axis(first), axis(second))),
            _ => None,
        });
        primitives
    }
}

impl Revolute {
    /// Whether a spring or a damper acts against its rotation.
    pub fn is_sprung(&self) -> bool {
        self.stiffness.is_some() || self.damping.is_some()
    }
}

//! Loads that the scene knows.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::action::{Acting, ActionKind, is_false};
use super::tagged::{kinds, part};
use super::{CoordinateKind, LoadValue, SceneVector, Surface, Value};

/// A load that is known in the scene.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Load {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the load.
    #[serde(flatten)]
    pub kind: LoadKind,
}
part!(Load { name: String });

kinds! {
    /// Loads by kind.
    LoadKind of "Load" {
        /// Force at a marker, N.
        Force(ForceLoad),
        /// Moment at a marker, counter-clockwise in the plane, N m. In space it keeps its global axes where it does not follow,
        /// and its work then depends on the way that the body turns.
        Moment(MomentLoad),
        /// Moment on the second marker of a joint about its axis, opposite on its first, N m.
        Torque(Torque),
        /// Force in global axes per reference length of a cable, rod or beam, N/m.
        DistributedForce(DistributedForceLoad),
        /// Moment per reference length of a rod or beam, N m/m: its power is that with the angular velocities of the sections. It keeps its
        /// global axes where it does not follow, and its work then depends on the way that sections turn.
        DistributedMoment(DistributedMomentLoad),
        /// Spring and damper side by side between two points.
        SpringDamper(SpringDamper),
        /// Spring and damper side by side between two points, whose forces are tables over length and over its rate.
        TableSpring(TableSpringLoad),
        /// Spring and damper side by side on a coordinate of a joint.
        JointSpring(JointSpringLoad),
        /// Springs and dampers between two bodies in space, three along and three about the axes of the first one's body (of ground: the
        /// global ones), from how they stand at the start: the rotation is measured by its vector, angle along axis.
        Bushing(BushingLoad),
        /// One-sided springs and dampers on a coordinate of a joint, beyond a lower limit, an upper one or both, without friction; the
        /// force is continuous in time (Hunt and Crossley 1975).
        JointLimit(JointLimitLoad),
        /// A fluid that streams past a cable, rod or beam: drag, added mass, inertia of the fluid and buoyancy per reference length (Morison
        /// and others 1950). The added mass counts in all directions alike.
        Fluid(FluidLoad),
        /// Contact of a marker, or of the line of a cable, rod or beam, with a surface of the ground: a one-sided spring and damper along the
        /// normal (Hunt and Crossley 1975) and friction along the surface, which is none at rest, so that an equilibrium has none.
        Contact(ContactLoad),
    }
}

/// A force at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceLoad {
    /// Marker that the force acts at, `body.marker`.
    pub marker: String,
    /// Whether the components rotate with the marker. They are then along and to the left of its direction in the plane, and along the
    /// axes of the body's frame in space.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Components of the force, N: two in the plane, three in space.
    pub value: LoadValue,
}

/// A moment at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MomentLoad {
    /// Marker that the moment acts at, `body.marker`.
    pub marker: String,
    /// Whether the components rotate with the marker, along the axes of the body's frame; in space only.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Moment, N m: one value in the plane, three components in space.
    pub value: LoadValue,
}

/// A moment between the two bodies of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Torque {
    /// Name of the joint with an axis that the torque acts about.
    pub joint: String,
    /// Torque on the second marker, N m: one value.
    pub value: LoadValue,
}

/// A force along a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistributedForceLoad {
    /// Name of the cable, rod or beam that the force acts along.
    pub body: String,
    /// Components of the force per reference length, N/m: two in the plane, three in space. Expressions may contain the material
    /// coordinate `s` of the body, which is 0 at the first end and 1 at the last.
    pub value: LoadValue,
}

/// A moment along the sections of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistributedMomentLoad {
    /// Name of the rod or beam that the moment acts along.
    pub body: String,
    /// Whether the components rotate with the sections, along their axes; in space only.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Moment per reference length, N m/m: one value in the plane, three components in space. Expressions may contain the material
    /// coordinate `s` of the body, which is 0 at the first end and 1 at the last.
    pub value: LoadValue,
}

/// A spring and a damper between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpringDamper {
    /// Ends of the spring: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end of the spring on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Stiffness, N/m; 0 by default. A stiffness or a damping is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping, N s/m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Length at rest, m; by default the distance of the ends at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Value>,
}

/// A spring and a damper by tables between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TableSpringLoad {
    /// Ends of the spring: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end of the spring on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Force with which the spring pulls, by its length: two points `[length in m, force in N]` or more, by increasing length. The curve
    /// through them is cubic and monotone where they are, and straight outside.
    #[schemars(length(min = 2))]
    pub spring: Vec<[f64; 2]>,
    /// Force with which the damper pulls, by the rate of the length: points `[rate in m/s, force in N]` as of `spring`, one of them
    /// `[0, 0]`; by default there is no damper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2))]
    pub damper: Option<Vec<[f64; 2]>>,
}

/// A spring and a damper on a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointSpringLoad {
    /// Name of the joint that the spring acts in.
    pub joint: String,
    /// Coordinate of the joint that the spring acts on; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Stiffness, N/m for a displacement and N m/rad for an angle; 0 by default. A stiffness or a damping is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping, N s/m for a displacement and N m s/rad for an angle; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Coordinate at which the spring is unloaded, m or rad; by default the coordinate at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<f64>,
}

/// Springs and dampers along and about three axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BushingLoad {
    /// Markers that the bushing connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// Stiffness along the three axes, N/m; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translational_stiffness: Option<[f64; 3]>,
    /// Damping along the three axes, N s/m; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translational_damping: Option<[f64; 3]>,
    /// Stiffness about the three axes, N m/rad; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotational_stiffness: Option<[f64; 3]>,
    /// Damping about the three axes, N m s/rad; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotational_damping: Option<[f64; 3]>,
}

/// Limits of a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointLimitLoad {
    /// Name of the joint whose coordinate is limited.
    pub joint: String,
    /// Coordinate of the joint that is limited; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Stiffness `k` beyond a limit, N/m for a displacement and N m/rad for an angle.
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping `a` in the force `k d (1 + a d')` at the coordinate `d` beyond a limit, s/m or s/rad; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Least coordinate without force, m or rad; by default there is no lower limit. One of both limits is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<f64>,
    /// Largest coordinate without force, m or rad; by default there is no upper limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<f64>,
}

/// A fluid along a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FluidLoad {
    /// Name of the cable, rod or beam that the fluid streams past.
    pub body: String,
    /// Density of the fluid, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Velocity of the fluid in global axes, m/s; zero by default. Expressions may contain the material coordinate `s` of the body,
    /// which is 0 at the first end and 1 at the last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub current: Option<Vec<Value>>,
    /// Coefficient of drag across the line, for the area `diameter` times length; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub drag: Option<f64>,
    /// Coefficient of drag along the line, for the area `pi diameter` times length; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub tangential_drag: Option<f64>,
    /// Coefficient of added mass: the mass of fluid that moves along, divided by the mass of displaced fluid; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub added_mass: Option<f64>,
    /// Diameter for drag, m; by default the outer diameter of a circle or tube, else that of a circle with the area of the section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter: Option<f64>,
    /// Area of the section that displaces fluid, m^2; by default the area of a circle of this `diameter`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: Option<f64>,
    /// Whether the weight of the displaced fluid lifts the body; true by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = true))]
    pub buoyancy: Option<bool>,
}

/// Contact with a surface of the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["marker"], ["body"]]))]
pub struct ContactLoad {
    /// Marker that touches the surface, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the cable, rod or beam whose line touches the surface; the thickness of the body does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Stiffness `k` of the surface, N/m at a marker; N/m per reference length along a body.
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping `a` in the normal force `k d (1 + a d')` at the depth `d` below the surface, s/m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Surface that is touched.
    pub surface: Surface,
    /// Coulomb's coefficient of friction `mu`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub friction: Option<f64>,
    /// With friction only: `w` in the friction `mu N v / sqrt(v^2 + w^2)` at the velocity `v` along the surface, m/s. A contact that
    /// would stick creeps at a fraction of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub slip_velocity: Option<f64>,
}

impl LoadKind {
    /// Force or moment with its components, of a load that is one.
    pub fn action(&self) -> Option<(Acting<'_>, &LoadValue)> {
        let (kind, on, follower, value) = match self {
            Self::Force(of) => (ActionKind::Force, &of.marker, of.follower, &of.value),
            Self::Moment(of) => (ActionKind::Moment, &of.marker, of.follower, &of.value),
            Self::Torque(of) => (ActionKind::Torque, &of.joint, false, &of.value),
            Self::DistributedForce(of) => {
                (ActionKind::DistributedForce, &of.body, false, &of.value)
            }
            Self::DistributedMoment(of) => (
                ActionKind::DistributedMoment,
                &of.body,
                of.follower,
                &of.value,
            ),
            Self::SpringDamper(_)
            | Self::TableSpring(_)
            | Self::JointSpring(_)
            | Self::Bushing(_)
            | Self::JointLimit(_)
            | Self::Fluid(_)
            | Self::Contact(_) => return None,
        };
        Some((Acting { kind, on, follower }, value))
    }
}

//! Loads that the scene knows, and inputs that the master sets.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{CoordinateKind, Keys, Kind, LoadValue, Surface, Value, Vector};

/// A load that is known in the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// What acts.
    pub kind: LoadKind,
    /// `force`, `moment`: where it acts, `body.marker`; `contact`: what touches, where it is no `body`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// `torque`: name of the revolute joint that it acts in; `joint_spring`, `joint_limit`: of a joint with a coordinate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// `joint_spring`, `joint_limit`: which coordinate of the joint; the displacement, if it has one, by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// `distributed_force`, `fluid`: name of the cable, rod or beam that it acts on; `distributed_moment`: of the rod or beam. `contact`: of the cable,
    /// rod or beam whose line touches, whatever its thickness, where it is no `marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// `spring_damper`, `bushing`: its ends, `ground` or `body.marker`, then `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub markers: Option<[String; 2]>,
    /// `spring_damper` from `ground` only: where on the ground, m; where the second marker is at the
    /// start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<Vector>,
    /// `force`, in space `moment` too: the components turn with the marker; in the plane along and across (to the left), in
    /// space along the axes of the body's frame. `distributed_moment`: they turn with the sections and are along their axes.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// `force`, `moment`, `torque`, `distributed_force`, `distributed_moment`: the components of a force (N), of a force per length (N/m), of a moment
    /// per length (N m/m) or of a moment in space (N m), one of either in the plane or of a torque (N m). What is distributed along a body
    /// takes expressions in `s` too, its material coordinate: 0 at the first end, 1 at the last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<LoadValue>,
    /// `spring_damper`: stiffness, N/m; `joint_spring`, `joint_limit`: N/m along a displacement, N m/rad about an angle;
    /// `contact`: N/m of a marker, N/m per reference length of a body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// `spring_damper`: damping, N s/m; `joint_spring`: N s/m or N m s/rad. `joint_limit`, `contact`: `a` in the force `k d (1 + a d')`
    /// where a limit is passed by `d`, or a point is so deep below a surface, s/m or s/rad; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// `spring_damper`: length at rest, m; the distance at the start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Value>,
    /// `bushing`: stiffness along the three axes, N/m; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translational_stiffness: Option<[f64; 3]>,
    /// `bushing`: damping along the three axes, N s/m; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translational_damping: Option<[f64; 3]>,
    /// `bushing`: stiffness about the three axes, N m/rad; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotational_stiffness: Option<[f64; 3]>,
    /// `bushing`: damping about the three axes, N m s/rad; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotational_damping: Option<[f64; 3]>,
    /// `joint_spring`: coordinate at rest, m or rad; that at the start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<f64>,
    /// `joint_limit`: the least coordinate without force, m or rad; no limit there by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<f64>,
    /// `joint_limit`: the largest coordinate without force, m or rad; no limit there by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<f64>,
    /// `fluid`: density of the fluid, kg/m^3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: Option<f64>,
    /// `fluid`: velocity of the fluid in global axes, m/s; zero by default. Its components may be expressions in `s` too, as those of
    /// what is distributed along a body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub current: Option<Vec<Value>>,
    /// `fluid`: coefficient of drag across the line, by the area `diameter` times length; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub drag: Option<f64>,
    /// `fluid`: coefficient of drag along the line, by the area `pi diameter` times length; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub tangential_drag: Option<f64>,
    /// `fluid`: coefficient of added mass, the fluid that moves along by that which is displaced; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub added_mass: Option<f64>,
    /// `fluid`: diameter that drag counts with, m; by default the outer one of a circle or tube, else that of a circle with the area of
    /// the section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter: Option<f64>,
    /// `fluid`: area of the section that displaces fluid, m^2; that of the circle of `diameter` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: Option<f64>,
    /// `fluid`: whether the weight of the displaced fluid lifts the body; true by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = true))]
    pub buoyancy: Option<bool>,
    /// `contact`: what is touched.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<Surface>,
    /// `contact`: Coulomb's coefficient of friction; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub friction: Option<f64>,
    /// `contact` with friction: `w` in the friction `mu N v / sqrt(v^2 + w^2)` at the velocity `v` along the surface, m/s. What would
    /// stick creeps at a fraction of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub slip_velocity: Option<f64>,
}

/// Loads by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadKind {
    /// Force at a marker, N.
    Force,
    /// Moment at a marker, counter-clockwise in the plane, N m. In space it keeps its global axes where it does not follow,
    /// and its work then depends on the way that the body turns.
    Moment,
    /// Moment on the second marker of a joint about its axis, opposite on its first, N m.
    Torque,
    /// Force in global axes per reference length of a cable, rod or beam, N/m.
    DistributedForce,
    /// Moment per reference length of a rod or beam, N m/m: its power is that with the angular velocities of the sections. It keeps its
    /// global axes where it does not follow, and its work then depends on the way that sections turn.
    DistributedMoment,
    /// Spring and damper side by side between two points.
    SpringDamper,
    /// Spring and damper side by side on a coordinate of a joint.
    JointSpring,
    /// Springs and dampers between two bodies in space, three along and three about the axes of the first one's body (of ground: the
    /// global ones), from how they stand at the start: the rotation is measured by its vector, angle along axis.
    Bushing,
    /// One-sided springs and dampers on a coordinate of a joint, beyond a lower limit, an upper one or both, without friction; the
    /// force is continuous in time (Hunt and Crossley 1975).
    JointLimit,
    /// A fluid that streams past a cable, rod or beam: drag, added mass, inertia of the fluid and buoyancy per reference length (Morison
    /// and others 1950). The added mass counts in all directions alike.
    Fluid,
    /// Contact of a marker, or of the line of a cable, rod or beam, with a surface of the ground: a one-sided spring and damper along the
    /// normal (Hunt and Crossley 1975) and friction along the surface, which is none at rest, so that an equilibrium has none.
    Contact,
}

/// A load that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// What is set.
    pub kind: InputKind,
    /// `force`, `moment`: where it acts, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// `torque`: name of the revolute joint that it acts in; `release`: of the joint that lets go.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// `distributed_force`: name of the cable, rod or beam that it acts on; `distributed_moment`: of the rod or beam.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// `rest_length`: name of the spring-damper; `current`: of the fluid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<String>,
    /// `force`, in space `moment` and `distributed_moment` too: as of a load.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Value before the master sets one: the components of a force or a current, one of others; zero by default,
    /// for a rest length that of the spring-damper, for a current that of the fluid.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// Inputs by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InputKind {
    /// Force at a marker, N.
    Force,
    /// Moment at a marker, counter-clockwise, N m.
    Moment,
    /// Moment on the second marker of a joint, opposite on its first, N m.
    Torque,
    /// Force in global axes per reference length of a cable, rod or beam, N/m.
    DistributedForce,
    /// Moment per reference length of a rod or beam, N m/m.
    DistributedMoment,
    /// Length at rest of a spring-damper, m.
    RestLength,
    /// Whether a joint lets go: it does, for good, in the first step that begins with more than 0.
    Release,
    /// Velocity of a fluid in global axes, m/s.
    Current,
}

impl Kind for LoadKind {
    const PART: &'static str = "Load";

    fn keys(&self) -> &'static [Keys] {
        match self {
            Self::Force => &[(&["marker", "value"], &["follower"])],
            Self::Moment => &[(&["marker", "value"], &["follower"])],
            Self::Torque => &[(&["joint", "value"], &[])],
            Self::DistributedForce => &[(&["body", "value"], &[])],
            Self::DistributedMoment => &[(&["body", "value"], &["follower"])],
            Self::JointSpring => &[(&["joint"], &["coordinate", "stiffness", "damping", "rest"])],
            Self::Bushing => &[(
                &["markers"],
                &[
                    "translational_stiffness",
                    "translational_damping",
                    "rotational_stiffness",
                    "rotational_damping",
                ],
            )],
            Self::JointLimit => &[(
                &["joint", "stiffness"],
                &["coordinate", "damping", "lower", "upper"],
            )],
            Self::Fluid => &[(
                &["body", "density"],
                &[
                    "current",
                    "drag",
                    "tangential_drag",
                    "added_mass",
                    "diameter",
                    "area",
                    "buoyancy",
                ],
            )],
            Self::Contact => &[
                (
                    &["marker", "surface", "stiffness"],
                    &["damping", "friction", "slip_velocity"],
                ),
                (
                    &["body", "surface", "stiffness"],
                    &["damping", "friction", "slip_velocity"],
                ),
            ],
            Self::SpringDamper => &[(&["markers"], &["point", "stiffness", "damping", "length"])],
        }
    }
}

impl Kind for InputKind {
    const PART: &'static str = "Input";

    fn keys(&self) -> &'static [Keys] {
        match self {
            Self::Force => &[(&["marker"], &["follower"])],
            Self::Moment => &[(&["marker"], &["follower"])],
            Self::Torque => &[(&["joint"], &[])],
            Self::DistributedForce => &[(&["body"], &[])],
            Self::DistributedMoment => &[(&["body"], &["follower"])],
            Self::RestLength | Self::Current => &[(&["load"], &[])],
            Self::Release => &[(&["joint"], &[])],
        }
    }
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
}

/// What forces and moments act on.
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
}

impl ActionKind {
    /// What it acts on, whether it is a force, what it is called, and its unit.
    fn declaration(self) -> (ActsOn, bool, [&'static str; 2]) {
        match self {
            Self::Force => (ActsOn::Marker, true, ["force", "N"]),
            Self::Moment => (ActsOn::Marker, false, ["moment", "N m"]),
            Self::Torque => (ActsOn::Joint, false, ["torque", "N m"]),
            Self::DistributedForce => (ActsOn::Cable, true, ["distributed force", "N/m"]),
            Self::DistributedMoment => (ActsOn::Sections, false, ["distributed moment", "N m/m"]),
        }
    }

    /// What it acts on.
    pub fn acts_on(self) -> ActsOn {
        self.declaration().0
    }

    /// Whether it may change along what it acts on.
    pub fn is_distributed(self) -> bool {
        matches!(self.acts_on(), ActsOn::Cable | ActsOn::Sections)
    }

    /// Whether it is a force, not a moment.
    pub fn is_force(self) -> bool {
        self.declaration().1
    }

    /// What it is called, and its unit.
    pub fn words(self) -> [&'static str; 2] {
        self.declaration().2
    }

    /// Number of components: those of a force in so many dimensions; of moments 1 in the plane, 3 in space; 1 of a torque.
    pub fn components(self, dimension: usize) -> usize {
        match self {
            Self::Moment | Self::DistributedMoment if dimension == 2 => 1,
            Self::Torque => 1,
            Self::Force | Self::DistributedForce | Self::Moment | Self::DistributedMoment => {
                dimension
            }
        }
    }
}

/// Which kinds of loads and of inputs are forces and moments, and which is none.
macro_rules! actions {
    ($($of:ident but $($none:ident)|*),*) => {$(
        impl $of {
            /// As a force or a moment, if it is one.
            pub fn action(self) -> Option<ActionKind> {
                match self {
                    Self::Force => Some(ActionKind::Force),
                    Self::Moment => Some(ActionKind::Moment),
                    Self::Torque => Some(ActionKind::Torque),
                    Self::DistributedForce => Some(ActionKind::DistributedForce),
                    Self::DistributedMoment => Some(ActionKind::DistributedMoment),
                    $(Self::$none)|* => None,
                }
            }
        }
    )*};
}
actions!(LoadKind but SpringDamper | JointSpring | JointLimit | Contact | Bushing | Fluid, InputKind but RestLength | Release | Current);

impl Input {
    /// Number of components.
    pub fn components(&self, dimension: usize) -> usize {
        match (self.kind.action(), self.kind) {
            (Some(action), _) => action.components(dimension),
            (None, InputKind::Current) => dimension,
            (None, _) => 1,
        }
    }
}

fn is_false(value: &bool) -> bool {
    !value
}

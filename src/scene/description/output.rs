//! Quantities that the master reads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Keys, Kind};

/// A quantity that the master reads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// What is read.
    pub kind: OutputKind,
    /// `body.marker`, for quantities at a marker.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// `deflection` only: the marker of the same body whose frame carries the rigid body that the marker is compared with; without it
    /// the rigid body is the drawn one where it fits the present one best.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
    /// Name of a joint, for quantities of a joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Name of a gear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gear: Option<String>,
    /// Name of a load, for its force or moment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<String>,
    /// Name of a motion, for what drives it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<String>,
    /// In space, of `angular_velocity` and `angular_acceleration` of a rigid body, and of `reaction` and `reaction_moment` of a
    /// joint: along which axes components are.
    #[serde(default, skip_serializing_if = "Along::is_global")]
    pub axes: Along,
    /// `natural_frequency` and `eigenvalue` of a scene with one body only: its name, which then begins those of the
    /// variables.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// `natural_frequency` and `eigenvalue` only: how many, lowest frequency or slowest eigenvalue first; no more than
    /// the scene has.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// `stress` and `torsion_stress` only: points of the section, m. Of a rod or beam `[y, z]` along the first and the second axis of the
    /// section from the line of the body; of a cable in the plane `[y]`, the way from its line to the left of its direction. One variable
    /// a point, in this order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1, max = 100), inner(length(min = 1, max = 2)))]
    pub points: Option<Vec<Vec<f64>>>,
}

/// Axes along which components of an output are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Along {
    /// Those of the scene.
    #[default]
    Global,
    /// Those of the frame of the rigid body; of a joint, of the first body that it joins. Names of such variables end in
    /// `_body`, so that both can be read.
    Body,
}

impl Along {
    /// Whether they are those of the scene.
    pub fn is_global(&self) -> bool {
        *self == Self::Global
    }
}

/// Outputs by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutputKind {
    /// Position of a marker, m.
    Position,
    /// Velocity of a marker; rate of the displacement of a joint, m/s.
    Velocity,
    /// Acceleration of a marker; rate of the velocity of a joint, m/s^2.
    Acceleration,
    /// Way of the second marker of a joint along its line from the first marker or the point, m; not where that line belongs to a
    /// cable.
    Displacement,
    /// Deflection of a marker of a cable, rod or beam, m: its place less where it would be if the body were rigid. The rigid body is
    /// carried by the frame at the marker `from`; without that it is the drawn body where it fits the present one best, in the mean
    /// of the squared distances along its length. Components are along the axes of the scene as the rigid body carries them. The frame
    /// at a marker is that of the section, of a cable its tangent: in space the drawn one taken to the present one by the smallest
    /// rotation. The best fit of a cable that is drawn straight in space rotates by the smallest rotation too. Zero of a body whose
    /// `model` is `rigid`. A winch lengthens the drawn body.
    Deflection,
    /// Direction at a marker: the unit vector along the cable, or along the first axis of a rigid body, which must have
    /// inertia.
    Direction,
    /// Direction at a marker, or direction of the second marker of a revolute joint less
    /// that of its first, rad, counted on over full turns.
    Angle,
    /// How a rigid body or the section of a rod in space stands: the matrix whose columns are the axes of its frame in global components, by rows.
    Orientation,
    /// The same as a unit quaternion, scalar first: `w >= 0` at the start, and from there on without jumps, so that it changes
    /// its sign with every full turn.
    Quaternion,
    /// The same as a rotation vector: the angle along the axis, rad. The angle is at most pi; where a body turns on beyond,
    /// the vector jumps to its opposite.
    RotationVector,
    /// Rate of the angle, rad/s; in space the angular velocity of a rigid body or of the section of a rod (`axes`).
    AngularVelocity,
    /// Rate of the angular velocity, rad/s^2.
    AngularAcceleration,
    /// Axial strain at a marker of a cable that bends, in the strain measure of the body. Where a load or joint acts, that after it.
    Strain,
    /// Curvature at a marker of a cable that bends, in the strain measure of the body, 1/m; in space its size.
    Curvature,
    /// Axial force at a marker of a cable, N: the part of the section force along the tangent, tension
    /// positive, from the balance of forces with inertia. Where a load or joint acts, that after it.
    AxialForce,
    /// Bending moment at a marker of a cable, N m: of the part after on the part before, positive where
    /// curvature is, from the balance of moments with inertia; of a rod the whole moment, with the torque. Where a load or joint acts,
    /// that after it.
    BendingMoment,
    /// Torque about the tangent at a marker of a rod, N m: of the part after on the part before, positive where the twist is, from the
    /// balance of moments with inertia. Where a load or joint acts, that after it.
    Torque,
    /// Normal stress at `points` of the section at a marker of a rod or beam, or of a cable in the plane, Pa, tension positive:
    /// `N / A + M1 z / I1 - M2 y / I2` of the force across the section and of the moments about its axes, from the balance of forces
    /// with inertia, so with what damps. Per area without stress, and without what a curved shape without stress makes of it (a part of
    /// about height over radius). Not of sections that are given as `stiffness` or have a `coupling`, where moments alone do not say it.
    /// Where a load or joint acts, that after it.
    Stress,
    /// Shear stress by torsion at `points` of the section at a marker of a rod or beam, Pa, with the sign of the torque: that of
    /// Saint-Venant in the shape of the section (`T r / J` in a circle or tube). Shear by transverse forces and what a clamp that
    /// prevents warping adds are not in it. Of sections with a shape.
    TorsionStress,
    /// Force that the part of a cable before a marker exerts on the part after it, global axes, N.
    ConnectivityForce,
    /// Where along the cable a joint of kind `point_on_cable` stands: length from the first end, m.
    Travel,
    /// Force of a joint on its second marker, or of a motion, N (`axes`).
    Reaction,
    /// Moment of a joint on its second marker, or of a motion, N m (`axes`).
    ReactionMoment,
    /// Force of a gear on the displacement of its second joint, N; on the coordinate of the first acts minus the ratio times that.
    GearForce,
    /// Torque of a gear on the angle of its second joint, N m; on the coordinate of the first acts minus the ratio times that.
    GearTorque,
    /// Force of a load on its second marker, N: of a `spring_damper`, a `bushing`, a `joint_spring` or `joint_limit` on a displacement; of a
    /// `contact` on its marker or on the whole body.
    LoadForce,
    /// Moment of a load on its second marker, N m: of a `bushing`, a `joint_spring` or `joint_limit` on an angle.
    LoadMoment,
    /// Kinetic, strain and gravitational energy, and that of springs where there are any, J.
    Energy,
    /// Work done by loads, inputs and motions since the start, and energy lost in dampers, J.
    Work,
    /// Linear momentum, N s, and angular momentum about the origin, N m s.
    Momentum,
    /// Centre of mass of the scene, m.
    CenterOfMass,
    /// How well meshes carry the shapes that cables have: the error in position that they make now, estimated from jumps of
    /// curvature at nodes and from the angles that elements bend by, over the error wanted (`accuracy.error`, or ten times the tolerance). Above 1 more elements are
    /// needed, which is said once in the log of every run. Within a factor of five on most scenes; what a mesh did before, errors of time,
    /// and a cable of one element that is clamped at both ends do not count.
    Resolution,
    /// Largest residual of the constraints, relative: of positions and of velocities.
    Residual,
    /// Natural frequencies of the scene at rest in the initial configuration, rad/s, without dampers; an unstable
    /// mode is a negative number. In a turning frame the imaginary parts of the eigenvalues without dampers. Refused
    /// where a force follows its marker and where cables turn initially: see `eigenvalue`.
    NaturalFrequency,
    /// Eigenvalues `s = -decay_rate + i frequency` of small motions `c e^(s t)` about the initial state, as
    /// `decay_rate` in 1/s, negative where the motion grows, and `frequency` in rad/s, slowest (least size of `s`) first;
    /// conjugate pairs once, real ones (`frequency` 0) each by itself. With dampers, gyroscopic forces and forces that
    /// follow, inputs held. Of a state in motion or out of equilibrium they are those of the equations of motion at
    /// that instant, as seen from the frame of the scene; cables that turn initially are refused: describe them in a frame
    /// that turns with them (`rotation`); so are thin rods of space that turn initially.
    Eigenvalue,
}

/// What outputs are read at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadAt {
    /// A marker.
    Marker,
    /// A marker, or a joint along a line.
    Moving,
    /// A joint along a line.
    Sliding,
    /// A gear.
    Gear,
    /// A load whose force or moment follows from the motion.
    Load,
    /// A marker with a direction: of a cable, or of a rigid body that has inertia.
    Directed,
    /// A marker of a cable.
    Cable,
    /// A marker of a cable, which may be told from another one of the same body.
    Deflected,
    /// A marker of a rod.
    Rod,
    /// A marker of a cable that bends.
    Flexible,
    /// Points of the section at a marker.
    Points,
    /// A marker of a cable, where its mesh, if it has one, has a node.
    Node,
    /// A marker of a rigid body in space that turns.
    Standing,
    /// A marker or a joint that turns.
    Turning,
    /// The same, its angle counted on over full turns.
    Angle,
    /// A joint of kind `point_on_cable`.
    Slide,
    /// A joint or a motion that transmits a force.
    Force,
    /// A joint or a motion that transmits a moment.
    Moment,
    /// The scene as a whole.
    Scene,
    /// The spectrum of the scene.
    Spectrum,
}

impl OutputKind {
    /// What it is read at.
    pub fn read_at(self) -> ReadAt {
        match self {
            Self::Position => ReadAt::Marker,
            Self::Velocity | Self::Acceleration => ReadAt::Moving,
            Self::Displacement => ReadAt::Sliding,
            Self::Deflection => ReadAt::Deflected,
            Self::GearForce | Self::GearTorque => ReadAt::Gear,
            Self::LoadForce | Self::LoadMoment => ReadAt::Load,
            Self::Direction => ReadAt::Directed,
            Self::Orientation | Self::Quaternion | Self::RotationVector => ReadAt::Standing,
            Self::Strain | Self::Curvature => ReadAt::Flexible,
            Self::AxialForce | Self::BendingMoment => ReadAt::Cable,
            Self::Torque => ReadAt::Rod,
            Self::Stress | Self::TorsionStress => ReadAt::Points,
            Self::ConnectivityForce => ReadAt::Node,
            Self::AngularVelocity | Self::AngularAcceleration => ReadAt::Turning,
            Self::Angle => ReadAt::Angle,
            Self::Travel => ReadAt::Slide,
            Self::Reaction => ReadAt::Force,
            Self::ReactionMoment => ReadAt::Moment,
            Self::Energy
            | Self::Work
            | Self::Momentum
            | Self::CenterOfMass
            | Self::Resolution
            | Self::Residual => ReadAt::Scene,
            Self::NaturalFrequency | Self::Eigenvalue => ReadAt::Spectrum,
        }
    }
}

impl Kind for OutputKind {
    const PART: &'static str = "Output";

    fn keys(&self) -> &'static [Keys] {
        match self.read_at() {
            ReadAt::Marker
            | ReadAt::Directed
            | ReadAt::Standing
            | ReadAt::Cable
            | ReadAt::Rod
            | ReadAt::Flexible
            | ReadAt::Node => &[(&["marker"], &[])],
            ReadAt::Points => &[(&["marker", "points"], &[])],
            ReadAt::Deflected => &[(&["marker"], &["from"])],
            ReadAt::Angle | ReadAt::Moving => &[(&["joint"], &[]), (&["marker"], &[])],
            ReadAt::Turning => &[(&["joint"], &[]), (&["marker"], &["axes"])],
            ReadAt::Gear => &[(&["gear"], &[])],
            ReadAt::Load => &[(&["load"], &[])],
            ReadAt::Slide | ReadAt::Sliding => &[(&["joint"], &[])],
            ReadAt::Force | ReadAt::Moment => &[(&["motion"], &[]), (&["joint"], &["axes"])],
            ReadAt::Scene => &[(&[], &[])],
            ReadAt::Spectrum => &[(&[], &["body", "count"])],
        }
    }
}

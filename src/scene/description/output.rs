//! Quantities that the master reads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tagged::{kinds, part};

kinds! {
    /// A quantity that the master reads.
    Output named OutputKind of "Output" {
        /// Position of a marker, m.
        Position(AtMarker),
        /// Velocity of a marker; rate of the displacement of a joint, m/s.
        Velocity(AtMarkerOrJoint),
        /// Acceleration of a marker; rate of the velocity of a joint, m/s^2.
        Acceleration(AtMarkerOrJoint),
        /// Way of the second marker of a joint along its line from the first marker or the point, m; not where that line belongs to a
        /// cable.
        Displacement(OfLineJoint),
        /// Deflection of a marker of a cable, rod, beam or reduced body, m: its place less where it would be if the body were rigid. The rigid body is
        /// carried by the frame at the marker `from`; without that it is the drawn body where it fits the present one best, in the mean
        /// of the squared distances along its length. Components are along the axes of the scene as the rigid body carries them. The frame
        /// at a marker is that of the section, of a cable its tangent: in space the drawn one taken to the present one by the smallest
        /// rotation. The best fit of a cable that is drawn straight in space rotates by the smallest rotation too. Without `from` the mean axes
        /// of its modes carry a reduced body, and a rod whose `model` is `modal`. Zero of a body whose `model` is `rigid`. A winch lengthens
        /// the drawn body.
        Deflection(DeflectionOutput),
        /// Direction at a marker: the unit vector along the cable, or along the first axis of a rigid body, which must have
        /// inertia.
        Direction(AtMarker),
        /// Direction at a marker, or direction of the second marker of a revolute joint less
        /// that of its first, rad, counted on over full turns.
        Angle(AngleOutput),
        /// How a rigid body or the section of a rod in space stands: the matrix whose columns are the axes of its frame in global components, by rows.
        Orientation(AtFrame),
        /// How a rigid body or the section of a rod in space stands, as a unit quaternion, scalar first: `w >= 0` at the start, and from there on without jumps, so that it changes
        /// its sign with every full turn.
        Quaternion(AtFrame),
        /// How a rigid body or the section of a rod in space stands, as a rotation vector: the angle along the axis, rad. The angle is at most pi; where a body rotates on beyond,
        /// the vector jumps to its opposite.
        RotationVector(AtFrame),
        /// Rate of the angle, rad/s; in space the angular velocity of a rigid body or of the section of a rod (`axes`).
        AngularVelocity(TurningOutput),
        /// Rate of the angular velocity, rad/s^2.
        AngularAcceleration(TurningOutput),
        /// Axial strain at a marker of a cable that bends, in the strain measure of the body. Where a load or joint acts, that after it.
        Strain(AtFlexibleLine),
        /// Curvature at a marker of a cable that bends, in the strain measure of the body, 1/m; in space its size. At a marker of a plate or
        /// shell the change of curvature, 1/m: components 11, 22 and twice 12 along the axes of its section, positive where the surface
        /// curves towards its normal.
        Curvature(CurvatureOutput),
        /// Axial force at a marker of a cable, N: the part of the section force along the tangent, tension
        /// positive, from the balance of forces with inertia. Where a load or joint acts, that after it.
        AxialForce(AtLine),
        /// Bending moment at a marker of a cable, N m: of the part after on the part before, positive where
        /// curvature is, from the balance of moments with inertia; of a rod the whole moment, with the torque. Where a load or joint acts,
        /// that after it. At a marker of a plate or shell the moment per length, N m/m: components 11, 22 and 12 along the axes of its section,
        /// positive where curvature is, with that of damping.
        BendingMoment(BendingMomentOutput),
        /// Strain of the middle surface at a marker of a plate or shell: components 11, 22 and twice 12 along the axes of its section.
        MembraneStrain(AtSurface),
        /// Force per length in a plate or shell at a marker, N/m: components 11, 22 and 12 along the axes of its section, tension positive,
        /// with that of damping.
        MembraneForce(AtSurface),
        /// Stress at the bottom and at the top of a plate or shell at a marker, Pa: components 11, 22 and 12 along the axes of its section,
        /// tension positive, with that of damping, and the equivalent stresses of von Mises. The normal of the surface points to the top. Not
        /// of sections that are given as `stiffness`. Derivatives of the equivalent stress are zero where there is no stress.
        SurfaceStress(AtSurface),
        /// Stress at the bottom and at the top of `plies` of a plate or shell with a `laminate` at a marker, Pa: along the fibres, across them
        /// and shear, tension positive, with that of damping.
        PlyStress(PlyStressOutput),
        /// Torque about the tangent at a marker of a rod, N m: of the part after on the part before, positive where the twist is, from the
        /// balance of moments with inertia. Where a load or joint acts, that after it.
        Torque(AtRod),
        /// Normal stress at `points` of the section at a marker of a rod or beam, or of a cable in the plane, Pa, tension positive:
        /// `N / A + M1 z / I1 - M2 y / I2` of the force across the section and of the moments about its axes, from the balance of forces
        /// with inertia, so with what damps. Per area without stress, and without what a curved shape without stress makes of it (a part of
        /// about height over radius). Not of sections that are given as `stiffness` or have a `coupling`, where moments alone do not say it.
        /// Where a load or joint acts, that after it.
        Stress(StressOutput),
        /// Shear stress by torsion at `points` of the section at a marker of a rod or beam, Pa, with the sign of the torque: that of
        /// Saint-Venant in the shape of the section (`T r / J` in a circle or tube). Shear by transverse forces and what a clamp that
        /// prevents warping adds are not in it. Of sections with a shape.
        TorsionStress(TorsionStressOutput),
        /// Stress at a gauge of a reduced body, Pa: the components `xx`, `yy`, `zz`, `xy`, `xz`, `yz` along the file's axes as the body carries
        /// them, and the equivalent stress of von Mises. They are the stresses of the modes in the file times the strains of the modes, without
        /// what damps. Derivatives of the equivalent stress are zero where there is no stress.
        StressTensor(AtGauge),
        /// Force that the part of a cable before a marker exerts on the part after it, global axes, N.
        ConnectivityForce(AtLine),
        /// Where along the cable a joint of kind `point_on_cable` stands: length from the first end, m.
        Travel(OfCableJoint),
        /// Force of a joint on its second marker, or of a motion, N (`axes`).
        Reaction(ReactionOutput),
        /// Moment of a joint on its second marker, or of a motion, N m (`axes`).
        ReactionMoment(ReactionOutput),
        /// Force of a gear on the displacement of its second joint, N; on the coordinate of the first acts minus the ratio times that.
        GearForce(OfGear),
        /// Torque of a gear on the angle of its second joint, N m; on the coordinate of the first acts minus the ratio times that.
        GearTorque(OfGear),
        /// Force of a closed latch on the displacement of its joint, N; 0 while it is open.
        LatchForce(OfLatch),
        /// Torque of a closed latch on the angle of its joint, N m; 0 while it is open.
        LatchTorque(OfLatch),
        /// State of a latch: 1 while it is closed, 0 while it is open.
        LatchState(OfLatch),
        /// Force of a load on its second marker, N: of a `spring_damper`, a `bushing`, a `table_spring` or `force_law` between markers or on a
        /// displacement, a `joint_spring`, `joint_limit` or `joint_friction` on a displacement; of a `contact` on its marker or on the whole body; of an `airfoil`.
        LoadForce(OfLoad),
        /// Moment of a load on its second marker, N m: of a `bushing`, a `table_spring`, `force_law`, `joint_spring`, `joint_limit` or `joint_friction` on an
        /// angle.
        LoadMoment(OfLoad),
        /// Tension of a load that pulls along a line, N, negative where it pushes: of a `reeving`, a `spring_damper`, a `table_spring` or
        /// `force_law` between markers.
        Tension(OfLoad),
        /// Length of the line that a load pulls along, m, and its rate: the distance of both markers of a `spring_damper`, a `table_spring` or a
        /// `force_law`, the path of a `reeving`.
        Length(OfLoad),
        /// Kinetic, strain and gravitational energy, and that of springs where there are any, J.
        Energy(OfScene),
        /// Work done by loads, inputs and motions since the start, and energy lost in dampers, J.
        Work(OfScene),
        /// Linear momentum, N s, and angular momentum about the origin, N m s.
        Momentum(OfScene),
        /// Centre of mass of the scene, m.
        CenterOfMass(OfScene),
        /// How well meshes carry the shapes that cables, rods, beams, plates and shells have: the error in position that they make now, estimated from jumps of
        /// curvature at nodes and from the angles that elements bend by, over the error wanted (`accuracy.error`, or ten times the tolerance). Above 1 more elements are
        /// needed, which is said once in the log of every run. Within a factor of five on most scenes; what a mesh did before, errors of time,
        /// a cable of one element that is clamped at both ends, and stretching of surfaces do not count.
        Resolution(OfScene),
        /// Largest residual of the constraints, relative: of positions and of velocities.
        Residual(OfScene),
        /// Natural frequencies of the scene at rest in the initial configuration, rad/s, without dampers; an unstable
        /// mode is a negative number. In a rotating frame the imaginary parts of the eigenvalues without dampers. Refused
        /// where a force follows its marker, and where cables, rods or beams rotate initially or by a prescribed motion: see `eigenvalue`.
        NaturalFrequency(FrequencyOutput),
        /// Eigenvalues `s = -decay_rate + i frequency` of small motions `c e^(s t)` about the initial state, as
        /// `decay_rate` in 1/s, negative where the motion grows, and `frequency` in rad/s, slowest (least size of `s`) first;
        /// conjugate pairs once, real ones (`frequency` 0) each by itself. With dampers, gyroscopic forces and forces that
        /// follow, inputs held. Of a state in motion or out of equilibrium they are those of the equations of motion at
        /// that instant, as seen from the frame of the scene; cables that rotate initially are refused: describe them in a frame
        /// that rotates with them (`rotation`); so are thin rods of space and reduced bodies that rotate initially.
        Eigenvalue(EigenvalueOutput),
    }
}
part!(Output);

/// A quantity at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtMarker {
    /// Marker at which the quantity is read, `body.marker`.
    pub marker: String,
}

/// A rate of a marker or of the displacement of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["joint"], ["marker"]]))]
pub struct AtMarkerOrJoint {
    /// Marker whose rate is read, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the joint along a line whose displacement has the rate that is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
}

/// A displacement of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OfLineJoint {
    /// Name of the joint along a line.
    pub joint: String,
}

/// A deflection of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DeflectionOutput {
    /// Marker of the cable, rod or beam whose deflection is read, `body.marker`.
    pub marker: String,
    /// Another marker of the same body, whose frame carries the rigid body that `marker` is compared with, `body.marker`. By default
    /// the rigid body is the drawn one where it fits the present one best.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
}

/// An angle of a marker or a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["joint"], ["marker"]]))]
pub struct AngleOutput {
    /// Marker whose direction is read in the plane, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the joint with an axis whose angle is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
}

/// A quantity of the frame at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtFrame {
    /// Marker of the rigid body, rod or beam whose frame is read, `body.marker`.
    pub marker: String,
}

/// A rate of rotation of a marker or a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["joint"], ["marker", "axes"]]))]
pub struct TurningOutput {
    /// Marker of the body or section whose rotation is read, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the joint with an axis whose angle has the rate that is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Axes along which the components are, in space only.
    #[serde(default, skip_serializing_if = "Along::is_global")]
    pub axes: Along,
}

/// A strain of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtFlexibleLine {
    /// Marker of the flexible cable, rod or beam at which the strain is read, `body.marker`.
    pub marker: String,
}

/// A curvature of a line or a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CurvatureOutput {
    /// Marker of the flexible cable, rod or beam, or of the plate or shell, at which the curvature is read, `body.marker`. That of a pad is
    /// read in its middle.
    pub marker: String,
}

/// A bending moment of a line or a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BendingMomentOutput {
    /// Marker of the cable, rod or beam, or of the plate or shell, at which the bending moment is read, `body.marker`. That of a pad is read
    /// in its middle.
    pub marker: String,
}

/// A quantity of the section of a plate or shell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtSurface {
    /// Marker of the plate or shell whose section is read, `body.marker`. That of a pad is read in its middle.
    pub marker: String,
}

/// Stress in plies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlyStressOutput {
    /// Marker of the plate or shell whose plies are read, `body.marker`. That of a pad is read in its middle.
    pub marker: String,
    /// Numbers of the plies, from 1 at the bottom on. Names of their variables hold these.
    #[schemars(length(min = 1, max = 200), inner(range(min = 1)))]
    pub plies: Vec<u32>,
}

/// A section force of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtLine {
    /// Marker of the cable, rod or beam at which the section force is read, `body.marker`.
    pub marker: String,
}

/// A torque in a rod.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtRod {
    /// Marker of the rod or beam at which the torque is read, `body.marker`.
    pub marker: String,
}

/// Normal stresses in a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StressOutput {
    /// Marker of the rod or beam, or of the cable in the plane, whose section is read, `body.marker`.
    pub marker: String,
    /// Points of the section, m: one variable for each point, in this order. In space a point is `[y, z]` along the first and the second
    /// axis of the section from the line of the body. In the plane it is `[y]`, to the left of the direction of the line.
    #[schemars(length(min = 1, max = 100), inner(length(min = 1, max = 2)))]
    pub points: Vec<Vec<f64>>,
}

/// Shear stresses by torsion in a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TorsionStressOutput {
    /// Marker of the rod or beam whose section is read, `body.marker`.
    pub marker: String,
    /// Points of the section, m: one variable for each point, in this order. A point is `[y, z]` along the first and the second axis of
    /// the section from the line of the body.
    #[schemars(length(min = 1, max = 100), inner(length(min = 1, max = 2)))]
    pub points: Vec<Vec<f64>>,
}

/// Stress in a reduced body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AtGauge {
    /// Gauge of the reduced body at which the stress is read, `body.gauge`.
    pub gauge: String,
}

/// A place along a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OfCableJoint {
    /// Name of the joint of kind `point_on_cable`.
    pub joint: String,
}

/// A reaction of a joint or a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["motion"], ["joint", "axes"]]))]
pub struct ReactionOutput {
    /// Name of the joint whose reaction is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Name of the motion whose driving force or moment is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<String>,
    /// Axes along which the components are, in space only.
    #[serde(default, skip_serializing_if = "Along::is_global")]
    pub axes: Along,
}

/// A reaction of a gear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OfGear {
    /// Name of the gear.
    pub gear: String,
}

/// A quantity of a latch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OfLatch {
    /// Name of the latch.
    pub latch: String,
}

/// A force or a moment of a load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OfLoad {
    /// Name of the load.
    pub load: String,
}

/// A quantity of the whole scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OfScene {}

/// Natural frequencies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrequencyOutput {
    /// Name of the body, in a scene with one body only. The names of the variables then begin with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Number of natural frequencies, from 1 to 100, lowest first; at most as many as the scene has.
    pub count: u32,
}

/// Eigenvalues.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EigenvalueOutput {
    /// Name of the body, in a scene with one body only. The names of the variables then begin with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Number of eigenvalues, from 1 to 100, slowest first; at most as many as the scene has.
    pub count: u32,
}

/// Axes along which components of an output are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Along {
    /// Global axes.
    #[default]
    Global,
    /// Axes of the frame of the rigid body; of a joint, of the first body that it joins. Names of such variables end in
    /// `_body`, so that both can be read.
    Body,
}

impl Along {
    /// Whether they are those of the scene.
    pub fn is_global(&self) -> bool {
        *self == Self::Global
    }
}

impl Output {
    /// Axes along which its components are.
    pub fn axes(&self) -> Along {
        match self {
            Self::AngularVelocity(of) | Self::AngularAcceleration(of) => of.axes,
            Self::Reaction(of) | Self::ReactionMoment(of) => of.axes,
            _ => Along::Global,
        }
    }

    /// Name of what it is read at, and of a marker that this is compared with.
    pub fn names(&self) -> [Option<&str>; 2] {
        let one = match self {
            Self::Position(of) | Self::Direction(of) => &of.marker,
            Self::Velocity(of) | Self::Acceleration(of) => return either(&of.joint, &of.marker),
            Self::Displacement(of) => &of.joint,
            Self::Deflection(of) => return [Some(&of.marker), of.from.as_deref()],
            Self::Angle(of) => return either(&of.joint, &of.marker),
            Self::Orientation(of) | Self::Quaternion(of) | Self::RotationVector(of) => &of.marker,
            Self::AngularVelocity(of) | Self::AngularAcceleration(of) => {
                return either(&of.joint, &of.marker);
            }
            Self::Strain(of) => &of.marker,
            Self::Curvature(of) => &of.marker,
            Self::AxialForce(of) | Self::ConnectivityForce(of) => &of.marker,
            Self::BendingMoment(of) => &of.marker,
            Self::MembraneStrain(of) | Self::MembraneForce(of) | Self::SurfaceStress(of) => {
                &of.marker
            }
            Self::PlyStress(of) => &of.marker,
            Self::Torque(of) => &of.marker,
            Self::Stress(of) => &of.marker,
            Self::TorsionStress(of) => &of.marker,
            Self::StressTensor(of) => &of.gauge,
            Self::Travel(of) => &of.joint,
            Self::Reaction(of) | Self::ReactionMoment(of) => {
                return either(&of.motion, &of.joint);
            }
            Self::GearForce(of) | Self::GearTorque(of) => &of.gear,
            Self::LatchForce(of) | Self::LatchTorque(of) | Self::LatchState(of) => &of.latch,
            Self::LoadForce(of) | Self::LoadMoment(of) | Self::Tension(of) | Self::Length(of) => {
                &of.load
            }
            Self::Energy(_)
            | Self::Work(_)
            | Self::Momentum(_)
            | Self::CenterOfMass(_)
            | Self::Resolution(_)
            | Self::Residual(_) => return [None; 2],
            Self::NaturalFrequency(of) => return [of.body.as_deref(), None],
            Self::Eigenvalue(of) => return [of.body.as_deref(), None],
        };
        [Some(one), None]
    }
}

fn either<'a>(first: &'a Option<String>, second: &'a Option<String>) -> [Option<&'a str>; 2] {
    [first.as_deref().or(second.as_deref()), None]
}

//! A scene whose references are resolved: what a kind demands is there, what it names has been found, and
//! what is numbered is numbered once. Values are checked while it is made (`validate/`).

mod outputs;

use std::collections::BTreeMap;

use super::description::{FileBody, LineBody, PatchBody, Port as GivenPort, RigidBody, Scene};
use super::joints::{ResolvedGear, ResolvedJoint, ResolvedLatch};
use super::loads::{Action, ResolvedLoad};
use super::motions::{Driven, ResolvedMotion};
pub use outputs::{Output, OutputTarget, Reaction, ResolvedGauge, SectionLayer, SectionPoint};

/// Numbers that are only made here, so that one list is never read with the number of another.
macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub struct $name(pub(super) usize);

        impl $name {
            /// The number.
            pub fn index(self) -> usize {
                self.0
            }
        }
    )*};
}

numbers! {
    /// A marker among those of all bodies.
    MarkerId;
    /// Owner of constraints in the system. Joints come first, then gears, latches, motions, frictions and the constraints of ports.
    ConstraintOwnerId;
    /// A joint of kind `along` among those of its kind.
    SlideId;
    /// An angle that is counted on over full turns.
    AngleId;
    /// A point of a section whose stress is read.
    PointId;
    /// A gauge whose stress is read.
    GaugeId;
    /// A height in the section of a plate or shell where stress is read.
    LayerId;
    /// A load.
    LoadId;
    /// A spring and damper of a port.
    CouplingId;
    /// A rigid body, by its place among all bodies.
    RigidId;
    /// A reduced body, by its place among all bodies.
    ReducedId;
    /// A plate or shell, by its place among all bodies.
    PlateId;
}

impl LayerId {
    /// Returns the layer `count` places after this one.
    pub fn after(self, count: usize) -> Self {
        Self(self.0 + count)
    }
}

impl PointId {
    /// Returns the point `count` places after this one.
    pub fn after(self, count: usize) -> Self {
        Self(self.0 + count)
    }
}

/// A cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineId {
    /// Index among all bodies.
    pub(super) body: usize,
    /// Form of the line body in the system.
    pub(super) form: Form,
}

impl LineId {
    /// Returns the index among all bodies.
    pub fn body_index(self) -> usize {
        self.body
    }

    /// Returns the index among the chains of the system, if the body is flexible.
    pub fn chain(self) -> Option<usize> {
        match self.form {
            Form::Chain(chain) => Some(chain),
            Form::Rod(_) | Form::Modal => None,
        }
    }
}

/// Form of a line body in the system, with its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Flexible, by the index among the chains.
    Chain(usize),
    /// Rigid, by the index among the rods.
    Rod(usize),
    /// Reduced to modes.
    Modal,
}

/// A cable.
#[derive(Clone, Copy, Debug)]
pub struct Cable<'a> {
    /// Which one.
    pub id: LineId,
    /// As described.
    pub body: &'a LineBody,
}

/// A rigid body.
#[derive(Clone, Copy, Debug)]
pub struct Rigid<'a> {
    /// Which one.
    pub id: RigidId,
    /// As described.
    pub body: &'a RigidBody,
}

/// A reduced body.
#[derive(Clone, Copy, Debug)]
pub struct Reduced<'a> {
    /// Which one.
    pub id: ReducedId,
    /// As described.
    pub body: &'a FileBody,
}

/// A plate or a shell.
#[derive(Clone, Copy, Debug)]
pub struct Plate<'a> {
    /// Which one.
    pub id: PlateId,
    /// As described.
    pub body: &'a PatchBody,
}

/// A body of any kind.
#[derive(Clone, Copy, Debug)]
pub enum BodyReference<'a> {
    /// A cable, flexible or rigid.
    Cable(Cable<'a>),
    /// A body of kind `rigid`.
    Rigid(Rigid<'a>),
    /// A body of kind `reduced`.
    Reduced(Reduced<'a>),
    /// A body of kind `plate` or `shell`.
    Plate(Plate<'a>),
}

/// A place on a body.
#[derive(Clone, Copy, Debug)]
pub enum Place<'a> {
    /// Material coordinate of a cable in [0, 1].
    Along(Cable<'a>, f64),
    /// Point in the frame of a rigid body, m.
    Point(Rigid<'a>, [f64; 3]),
    /// Interface of a reduced body, by its index in the model.
    Interface(Reduced<'a>, usize),
    /// Marker of a plate or shell, by its index among those of the body.
    Patch(Plate<'a>, usize),
}

/// A marker. Points and directions have three components, the third zero in the plane.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedMarker<'a> {
    /// Which one.
    pub id: MarkerId,
    /// Name: `body.marker` in references, without the body in the list of all markers.
    pub name: &'a str,
    /// Where it is on which body.
    pub place: Place<'a>,
    /// Where it is in the shapes and positions that the scene describes, m.
    pub position: [f64; 3],
    /// Direction there: tangent of a cable, first axis of the frame of a rigid or reduced body, of the line along `s1` of a plate or shell; a unit vector.
    pub direction: [f64; 3],
}

/// The first of two ends.
#[derive(Clone, Copy, Debug)]
pub enum First<'a> {
    /// The ground at a point, m; where the second end is at the start if none is given.
    Ground(Option<[f64; 3]>),
    /// A marker.
    Marker(ResolvedMarker<'a>),
    /// A cable as a whole.
    Cable(Cable<'a>),
}

/// The two ends of a joint or a spring.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a> {
    /// The ground, a marker or a cable.
    pub first: First<'a>,
    /// A marker of another body.
    pub second: ResolvedMarker<'a>,
}

/// A revolute joint: a joint with an angle.
#[derive(Clone, Copy, Debug)]
pub struct Pivot<'a> {
    /// Name of the joint.
    pub name: &'a str,
    /// Which holder it is.
    pub joint: ConstraintOwnerId,
    /// Ends of the joint.
    pub ends: Ends<'a>,
    /// In space its axis at the start, in global axes.
    pub axis: Option<[f64; 3]>,
}

/// Freedoms that a joint holds of a mesh line of a plate or shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeHold {
    /// The line, and the normal of the surface along it.
    Clamped,
    /// The line.
    Pinned,
    /// The line and all derivatives of the surface along it.
    Smooth,
    /// The line in a plane with this normal, and the normal of the surface in it.
    Symmetry([f64; 3]),
}

/// A line of the mesh of a plate or shell, or an edge.
#[derive(Clone, Copy, Debug)]
pub struct MeshLine<'a> {
    /// The body.
    pub plate: Plate<'a>,
    /// Coordinate that is the same along the line: 0 for `s1`, 1 for `s2`.
    pub across: usize,
    /// Number of elements before the line in that direction.
    pub line: u32,
}

/// The first of what a joint of a mesh line joins.
#[derive(Clone, Copy, Debug)]
pub enum EdgeBase<'a> {
    /// The ground.
    Ground,
    /// A marker of a body with a frame, which the line moves with.
    Marker(ResolvedMarker<'a>),
    /// A mesh line at the same place; whether both lines run in opposite directions.
    Line(MeshLine<'a>, bool),
    /// A cable, rod or beam along the mesh line, a stiffener; whether both run in opposite directions.
    Stiffener(Cable<'a>, bool),
}

/// A joint that holds a mesh line of a plate or shell.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedEdge<'a> {
    /// Name of the joint.
    pub name: &'a str,
    /// Kind of the joint.
    pub kind: &'static str,
    /// Which holder it is.
    pub holder: ConstraintOwnerId,
    /// Object that holds the line.
    pub base: EdgeBase<'a>,
    /// The line that is held.
    pub line: MeshLine<'a>,
    /// Freedoms that are held.
    pub hold: EdgeHold,
}

/// A joint that holds a marker on a line of the ground or of a rigid body.
#[derive(Clone, Copy, Debug)]
pub struct Slider<'a> {
    /// Name of the joint.
    pub name: &'a str,
    /// Which holder it is.
    pub joint: ConstraintOwnerId,
    /// Ends of the joint.
    pub ends: Ends<'a>,
    /// Direction of the line as [`Inline`](crate::scene::JointPrimitive::Inline) has it.
    pub direction: [f64; 3],
    /// Direction of the line at the start, a unit vector in global axes.
    pub along: [f64; 3],
}

/// A coordinate of a joint.
#[derive(Clone, Copy, Debug)]
pub enum JointCoordinate<'a> {
    /// Displacement along the line, m.
    Displacement(Slider<'a>),
    /// The angle about its axis, rad.
    Angle(Pivot<'a>),
}

/// Object with an angle: a marker, or a joint between two markers.
#[derive(Clone, Copy, Debug)]
pub enum DirectionSource<'a> {
    /// Direction at a marker.
    Marker(ResolvedMarker<'a>),
    /// Angle of the second marker minus that of the first.
    Pivot(Pivot<'a>),
}

/// A mass lumped at a marker.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedMass<'a> {
    /// Where it sits.
    pub marker: ResolvedMarker<'a>,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia, kg m^2.
    pub inertia: f64,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input<'a> {
    /// Quantity that the input sets.
    pub kind: InputKind<'a>,
    /// Place of its first component among the numbers that the master sets; the others follow.
    pub first: usize,
    /// Values before the master sets some, one a component.
    pub start: Vec<f64>,
}

/// Quantity that an input sets.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there are few")]
pub enum InputKind<'a> {
    /// A force or a moment.
    Action(Action<'a>),
    /// Rest length of the spring-damper of this name, m.
    RestLength(&'a str),
    /// Release of the joint of this name.
    Release(&'a str),
    /// Arming of the latch of this name.
    Latch(&'a str),
    /// Force against sliding of the friction of this name; whether it is on an angle.
    Friction(&'a str, bool),
    /// Value `u` of the force law of this name.
    Control(&'a str),
    /// Velocity of the fluid of this name, m/s.
    Current(&'a str),
}

/// A port.
#[derive(Clone, Debug)]
pub struct ResolvedPort<'a> {
    /// Name.
    pub name: &'a str,
    /// Where it is.
    pub marker: ResolvedMarker<'a>,
    /// Inputs and outputs of the port.
    pub kind: PortKind<'a>,
    /// As described.
    pub given: &'a GivenPort,
}

/// Kind of a port, with its inputs and outputs.
#[derive(Clone, Debug)]
pub enum PortKind<'a> {
    /// Input of a force, and of a moment if the port rotates. Output of the marker's motion.
    Force {
        /// Forces and moments that the master sets.
        inputs: Vec<Input<'a>>,
        /// Motion of the marker.
        outputs: Vec<Output<'a>>,
    },
    /// Input of a motion that drives the marker. Output of the force that the motion exerts.
    Motion {
        /// The position.
        position: Box<ResolvedMotion<'a>>,
        /// The angle, in space the orientation, if it rotates.
        angle: Option<Box<ResolvedMotion<'a>>>,
    },
    /// Input of a motion through a spring and a damper. Output of their force.
    Coupling {
        /// Between positions.
        position: Box<Coupling<'a>>,
        /// Between directions, if it rotates.
        angle: Option<Box<Coupling<'a>>>,
    },
}

/// Motion that comes in through a spring and a damper.
#[derive(Clone, Debug)]
pub enum Incoming<'a> {
    /// Value and rate of every coordinate, next to each other.
    Motion(Box<Driven<'a>>),
    /// In space how the frame of a rigid body would stand: a quaternion, scalar first, then the angular velocity.
    Orientation(ResolvedMarker<'a>),
}

/// A spring and a damper between a marker and what comes in.
#[derive(Clone, Debug)]
pub struct Coupling<'a> {
    /// Which one.
    pub id: CouplingId,
    /// Motion that the master sets.
    pub incoming: Incoming<'a>,
    /// Place of its first number among those that the master sets.
    pub first: usize,
    /// Stiffness, N/m or N m/rad.
    pub stiffness: f64,
    /// Damping, N s/m or N m s/rad.
    pub damping: f64,
}

/// Owner of constraints in the system: a joint, a gear, a motion or a port.
#[derive(Clone, Debug)]
pub struct ConstraintOwner<'a> {
    /// Where it stands in the scene, e.g. `joints[0]`.
    pub path: String,
    /// Name of the owner.
    pub name: &'a str,
}

/// A valid scene with its references resolved.
#[derive(Clone, Debug)]
pub struct Resolved<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Bodies.
    pub bodies: Vec<BodyReference<'a>>,
    /// Markers of all bodies, by [`MarkerId`].
    pub markers: Vec<ResolvedMarker<'a>>,
    /// Lumped masses.
    pub masses: Vec<ResolvedMass<'a>>,
    /// Joints.
    pub joints: Vec<ResolvedJoint<'a>>,
    /// Joints of mesh lines of plates and shells.
    pub edges: Vec<ResolvedEdge<'a>>,
    /// Gears.
    pub gears: Vec<ResolvedGear<'a>>,
    /// Latches.
    pub latches: Vec<ResolvedLatch<'a>>,
    /// Motions, without those of ports.
    pub motions: Vec<ResolvedMotion<'a>>,
    /// Loads.
    pub loads: Vec<ResolvedLoad<'a>>,
    /// Loads that act only while the initial state is looked for.
    pub initial_loads: Vec<ResolvedLoad<'a>>,
    /// Inputs, without those of ports.
    pub inputs: Vec<Input<'a>>,
    /// Outputs, without those of ports.
    pub outputs: Vec<Output<'a>>,
    /// Ports.
    pub ports: Vec<ResolvedPort<'a>>,
    /// Owners of constraints, by [`ConstraintOwnerId`].
    pub holders: Vec<ConstraintOwner<'a>>,
    /// Angles that are counted, by [`AngleId`].
    pub angles: Vec<DirectionSource<'a>>,
    /// Points of sections whose stress is read, by [`PointId`].
    pub points: Vec<SectionPoint<'a>>,
    /// Heights in sections of plates and shells where stress is read, by [`LayerId`].
    pub layers: Vec<SectionLayer<'a>>,
    /// Gauges whose stress is read, by [`GaugeId`].
    pub gauges: Vec<ResolvedGauge<'a>>,
    /// Number of couplings.
    pub couplings: usize,
    /// How many numbers the master sets: those of inputs, then those of motions, then those of ports. The
    /// value of a driven coordinate and as many derivatives as are inputs follow each other; of an orientation the quaternion,
    /// then the angular velocity, then the angular acceleration.
    pub numbers: usize,
    pub(super) bodies_by_name: BTreeMap<&'a str, BodyReference<'a>>,
    pub(super) markers_by_name: BTreeMap<(&'a str, &'a str), MarkerId>,
}

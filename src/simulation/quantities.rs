//! Quantities that are read of a simulation: their values, of numbers of any kind, from an evaluated state; what
//! they are computed from; how large they naturally are.

use nalgebra::Vector3;

use super::engine::Engine;
use super::mesh::resolution;
use crate::bodies::{Marker, combined};
use crate::integrators::Tolerance;
use crate::math::jet::Number;
use crate::math::rotation;
use crate::math::space::{axis, components};
use crate::scene::{
    Along, AngleId, Assembled, ConstraintOwnerId, CouplingId, GaugeId, LayerId, LoadId, MarkerId,
    PointId, SlideId,
};
use crate::system::{Attachment, Evaluation, System, von_mises};

/// Outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// Component of the position of a marker.
    Position(MarkerId, usize),
    /// Component of the deflection of a marker, from the frame at another one or from the mean of its body.
    Deflection(MarkerId, Option<MarkerId>, usize),
    /// Component of the velocity of a marker.
    Velocity(MarkerId, usize),
    /// Component of the acceleration of a marker.
    Acceleration(MarkerId, usize),
    /// Component of the unit vector in the direction at a marker.
    Direction(MarkerId, usize),
    /// Continuous angle of a marker or a joint.
    Angle(AngleId),
    /// Entry of the matrix whose columns are the axes of a rigid body's frame, by rows.
    Orientation(MarkerId, usize),
    /// Part of the unit quaternion of a rigid body's frame, scalar first.
    Quaternion(MarkerId, usize),
    /// Component of the rotation vector of a rigid body's frame.
    RotationVector(MarkerId, usize),
    /// Component of the angular velocity at a marker; in the plane the third.
    AngularVelocity(MarkerId, usize, Along),
    /// Angular velocity of the second marker of a joint less that of its first.
    JointVelocity(ConstraintOwnerId),
    /// Component of the angular acceleration at a marker; in the plane the third.
    AngularAcceleration(MarkerId, usize, Along),
    /// Angular acceleration of the second marker of a joint less that of its first.
    JointAcceleration(ConstraintOwnerId),
    /// Axial strain at a marker.
    Strain(MarkerId),
    /// Curvature at a marker.
    Curvature(MarkerId),
    /// Axial force at a marker.
    AxialForce(MarkerId),
    /// Component of the bending moment at a marker; in the plane the third.
    BendingMoment(MarkerId, usize),
    /// Torque about the tangent at a marker, N m.
    Torque(MarkerId),
    /// Normal stress at a point of a section.
    Stress(PointId),
    /// Shear stress by torsion at a point of a section.
    TorsionStress(PointId),
    /// Component of the stress at a gauge, `xx yy zz xy xz yz`.
    StressTensor(GaugeId, usize),
    /// Equivalent stress of von Mises at a gauge.
    VonMisesStress(GaugeId),
    /// Component 11, 22 or twice 12 of the membrane strain of a plate or shell at a marker.
    MembraneStrain(MarkerId, usize),
    /// Component 11, 22 or twice 12 of the change of curvature of a plate or shell at a marker.
    SurfaceCurvature(MarkerId, usize),
    /// Component 11, 22 or 12 of the force per length in a plate or shell at a marker.
    MembraneForce(MarkerId, usize),
    /// Component 11, 22 or 12 of the moment per length in a plate or shell at a marker.
    SurfaceMoment(MarkerId, usize),
    /// Component 11, 22 or 12 of the stress at a height of a plate or shell.
    LayerStress(LayerId, usize),
    /// Equivalent stress of von Mises at a height of a plate or shell.
    LayerVonMises(LayerId),
    /// Component of the force that the part of a cable before a marker exerts on the part after it.
    ConnectivityForce(MarkerId, usize),
    /// Where a slide is on its cable.
    Travel(SlideId),
    /// Component of the force of a joint or motion.
    Reaction(ConstraintOwnerId, usize, Along),
    /// Component of the moment of a joint or motion; in the plane the third.
    ReactionMoment(ConstraintOwnerId, usize, Along),
    /// Displacement of a joint along a line.
    Displacement(ConstraintOwnerId),
    /// Velocity of a joint along a line, m/s.
    SlidingVelocity(ConstraintOwnerId),
    /// Acceleration of a joint along a line, m/s^2.
    SlidingAcceleration(ConstraintOwnerId),
    /// Component of the force of a load on its second end.
    LoadForce(LoadId, usize),
    /// Component of the moment of a load on its second end; in the plane the third.
    LoadMoment(LoadId, usize),
    /// Tension of a load along a line.
    Tension(LoadId),
    /// Length of the line that a load pulls along.
    Length(LoadId),
    /// Rate of that length.
    LengthRate(LoadId),
    /// Component of the force of friction on the second end of its joint, also where it sticks.
    FrictionForce(LoadId, usize),
    /// Component of the moment of friction on the second end of its joint, also where it sticks; in the plane the third.
    FrictionMoment(LoadId, usize),
    /// State of a latch: 1 closed, 0 open.
    LatchState(ConstraintOwnerId),
    /// Force of a gear on the displacement of its second joint, or of a latch on that of its joint.
    GearForce(ConstraintOwnerId),
    /// Torque of a gear on the angle of its second joint, or of a latch on that of its joint.
    GearTorque(ConstraintOwnerId),
    /// Component of the force on what drives a marker: opposite to the reaction.
    MotionForce(ConstraintOwnerId, usize),
    /// Component of the moment on what rotates a marker; in the plane the third.
    MotionMoment(ConstraintOwnerId, usize),
    /// Component of the force of a coupling on what it couples to.
    CouplingForce(CouplingId, usize),
    /// Component of the moment of a coupling on what it couples to; in the plane the third.
    CouplingMoment(CouplingId, usize),
    /// Kinetic energy.
    KineticEnergy,
    /// Strain energy.
    StrainEnergy,
    /// Potential energy of gravity, zero at the origin.
    GravityEnergy,
    /// Energy in springs, hinges and couplings.
    SpringEnergy,
    /// Work done from outside since the start.
    Input,
    /// Energy dissipated since the start.
    Dissipated,
    /// Component of the linear momentum.
    Momentum(usize),
    /// Component of the angular momentum about the origin; in the plane the third.
    AngularMomentum(usize),
    /// Component of the centre of mass.
    CenterOfMass(usize),
    /// Error in position that meshes make in the present shapes, over the error wanted.
    Resolution,
    /// Largest residual of the constraints: 0 of positions, 1 of velocities.
    Residual(usize),
}

/// How much of the outputs belongs to the current state and inputs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Evaluated {
    Nothing,
    Kinematics,
    Dynamics,
}

/// Value of an output; `work` came in and was dissipated so far.
pub(super) fn value<const D: usize, N: Number>(
    quantity: Quantity,
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    work: [N; 2],
) -> N {
    use Quantity::*;
    let system = &assembled.system;
    let on = |id: MarkerId| -> Marker<N> { assembled.marker(id).lift() };
    let at = |id: MarkerId| assembled.marker(id);
    let joint_of = |joint: ConstraintOwnerId| &system.joints()[joint.index()];
    let (ends, rotation) = (|joint| joint_of(joint).ends, |joint| joint_of(joint).turn);
    match quantity {
        Position(id, axis) => on(id).position(&values.x)[axis],
        Velocity(id, axis) => on(id).position(&values.v)[axis],
        Acceleration(id, axis) => on(id).position(&values.acceleration)[axis],
        Deflection(id, from, axis) => deflected(values, assembled, id, from)[axis],
        Direction(id, axis) => on(id).direction(&values.x).normalize()[axis],
        Angle(angle) => values.angles[angle.index()],
        Orientation(id, ..)
        | Quaternion(id, ..)
        | RotationVector(id, ..)
        | AngularVelocity(id, ..)
        | AngularAcceleration(id, ..) => rotational(quantity, values, assembled, at(id)),
        JointVelocity(joint) => match rotation(joint) {
            Some(rotation) => rotation.rate(&values.x, &values.v),
            None => {
                let [a, b] = ends(joint).map(|end| end.lift().spin(&values.x, &values.v));
                b - a
            }
        },
        JointAcceleration(joint) => {
            let (x, v, a) = (&values.x[..], &values.v[..], &values.acceleration[..]);
            let rate = |end: Attachment<D>| end.lift().spin_rate(x, v, a);
            let [first, second] = ends(joint).map(rate);
            rotation(joint).map_or(second - first, |rotation| rotation.second([x, v, a]))
        }
        Strain(id) => values.strain(system, at(id)).0,
        Curvature(id) => values.strain(system, at(id)).1,
        AxialForce(id) => values.section(system, at(id)).0,
        BendingMoment(id, axis) => values.section(system, at(id)).1[axis],
        Torque(id) => values.torque(system, at(id)),
        Stress(id) => values.stress(system, assembled.point(id)),
        TorsionStress(id) => values.torsion_stress(system, assembled.point(id)),
        StressTensor(id, k) => values.stress_tensor(system, assembled.gauge(id))[k],
        VonMisesStress(id) => von_mises(values.stress_tensor(system, assembled.gauge(id))),
        MembraneStrain(id, k) => values.surface_strain(system, at(id))[0][k],
        SurfaceCurvature(id, k) => values.surface_strain(system, at(id))[1][k],
        MembraneForce(id, k) => values.surface_forces(system, at(id))[0][k],
        SurfaceMoment(id, k) => values.surface_forces(system, at(id))[1][k],
        LayerStress(id, k) => values.layer_stress(system, assembled.layer(id))[k],
        LayerVonMises(id) => {
            let [xx, yy, xy] = values.layer_stress(system, assembled.layer(id));
            let none = N::of(0.0);
            von_mises([xx, yy, none, xy, none, none])
        }
        ConnectivityForce(id, axis) => values.connectivity_force(system, at(id))[axis],
        Travel(slide) => values.travel[slide.index()],
        Reaction(joint, ..) | ReactionMoment(joint, ..) => {
            transmitted(quantity, values, assembled, joint)
        }
        Displacement(joint) | SlidingVelocity(joint) | SlidingAcceleration(joint) => {
            sliding(quantity, values, system, joint)
        }
        GearForce(gear) | GearTorque(gear) => values.gear(system, gear.index()),
        LatchState(latch) => values.latch_state(system, latch.index()),
        LoadForce(..) | LoadMoment(..) | FrictionForce(..) | FrictionMoment(..)
        | MotionForce(..) | MotionMoment(..) | CouplingForce(..) | CouplingMoment(..) => {
            exerted(quantity, values, assembled)
        }
        Tension(id) => values.tension(system, assembled.load(id)),
        Length(id) => values.length(system, assembled.load(id))[0],
        LengthRate(id) => values.length(system, assembled.load(id))[1],
        KineticEnergy => values.kinetic_energy(system),
        StrainEnergy => values.strain_energy(system),
        GravityEnergy => values.gravity_energy(system),
        SpringEnergy => values.spring_energy(system),
        Input => work[0],
        Dissipated => work[1],
        Momentum(axis) => values.momentum(system).0[axis],
        AngularMomentum(axis) => values.momentum(system).1[axis],
        CenterOfMass(axis) => values.center_of_mass(system)[axis],
        Resolution => resolution(values, assembled),
        Residual(of) => N::of(values.residuals(system)[of]),
    }
}

/// The deflection of a marker from the rigid body that another one carries, or the mean.
fn deflected<const D: usize, N: Number>(
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    marker: MarkerId,
    from: Option<MarkerId>,
) -> [N; 3] {
    let at = |id: MarkerId| assembled.marker(id);
    let drawn = &assembled.nodes;
    values.deflection(&assembled.system, drawn, at(marker), from.map(at))
}

/// The way along a joint, its rate or the rate of that.
fn sliding<const D: usize, N: Number>(
    quantity: Quantity,
    values: &Evaluation<D, N>,
    system: &System<D>,
    joint: ConstraintOwnerId,
) -> N {
    let (x, v) = (&values.x, &values.v);
    let way = system.joints()[joint.index()].way.as_ref();
    way.map_or(N::of(0.0), |way| match quantity {
        Quantity::Displacement(_) => way.value(x),
        Quantity::SlidingVelocity(_) => way.gradient(x).along(v),
        _ => way.bend(v) + way.gradient(x).along(&values.acceleration),
    })
}

/// How the rigid body that a marker belongs to stands and rotates.
fn rotational<const D: usize, N: Number>(
    quantity: Quantity,
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    marker: &Marker,
) -> N {
    use Quantity::*;
    let axes = || frame(values, assembled, marker);
    match quantity {
        Orientation(_, k) => axes()[k % 3][k / 3],
        Quaternion(_, k) => {
            let held = assembled.held(values.held(&assembled.system, marker), marker.body);
            rotation::quaternion_near(&axes(), &held)[k]
        }
        RotationVector(_, axis) => {
            let stance = rotation::quaternion(&axes());
            rotation::rotation_vector(&stance)[axis]
        }
        AngularVelocity(_, axis, along) => {
            let spin = values.spin(&assembled.system, marker).into();
            component(spin, axis, along, axes)
        }
        AngularAcceleration(_, axis, along) => {
            let rate = values.spin_rate(&assembled.system, marker).into();
            component(rate, axis, along, axes)
        }
        _ => unreachable!("what else is read of a body is no rotation"),
    }
}

/// Component of the force or moment of a load on its second end, of a motion on what drives it, of a coupling on what it couples to.
fn exerted<const D: usize, N: Number>(
    quantity: Quantity,
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
) -> N {
    use Quantity::*;
    let system = &assembled.system;
    let load = |id| values.exerted(system, assembled.load(id));
    let motion = |joint: ConstraintOwnerId| values.reaction(system, joint.index());
    let coupling = |id| values.coupling(system, assembled.coupling(id));
    match quantity {
        LoadForce(id, axis) | FrictionForce(id, axis) => load(id).0[axis],
        LoadMoment(id, axis) | FrictionMoment(id, axis) => load(id).1[axis],
        MotionForce(joint, axis) => -motion(joint).0[axis],
        MotionMoment(joint, axis) => -motion(joint).1[axis],
        CouplingForce(id, axis) => coupling(id).0[axis],
        CouplingMoment(id, axis) => coupling(id).1[axis],
        _ => unreachable!("what else is read is exerted by no load, motion or coupling"),
    }
}

/// Returns a component of the force or moment that a joint or motion exerts on its second end.
fn transmitted<const D: usize, N: Number>(
    quantity: Quantity,
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    joint: ConstraintOwnerId,
) -> N {
    let (force, moment) = values.reaction(&assembled.system, joint.index());
    let axes = || first(values, assembled, joint);
    match quantity {
        Quantity::Reaction(_, axis, along) => {
            component(components(&force).into(), axis, along, axes)
        }
        Quantity::ReactionMoment(_, axis, along) => component(moment.into(), axis, along, axes),
        _ => unreachable!("a joint transmits a force and a moment"),
    }
}

/// The axes of the frame of the rigid body that a marker belongs to, in global components; the global ones of none.
fn frame<const D: usize, N: Number>(
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    marker: &Marker,
) -> [Vector3<N>; 3] {
    let principal = values.axes(&assembled.system, marker).map(Vector3::from);
    let within = assembled.frame(marker.body);
    std::array::from_fn(|k| combined(&principal, &within.row(k).transpose().map(N::of)))
}

/// Returns the axes of the first end of a joint.
fn first<const D: usize, N: Number>(
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    joint: ConstraintOwnerId,
) -> [Vector3<N>; 3] {
    let [end, _] = &assembled.system.joints()[joint.index()].ends;
    match end {
        Attachment::Body(marker) => frame(values, assembled, marker),
        Attachment::Ground(_) => std::array::from_fn(|k| axis(k)),
    }
}

/// A component of a vector along global axes, or along these.
fn component<N: Number>(
    vector: Vector3<N>,
    axis: usize,
    along: Along,
    axes: impl FnOnce() -> [Vector3<N>; 3],
) -> N {
    match along {
        Along::Global => vector[axis],
        Along::Body => axes()[axis].dot(&vector),
    }
}

/// Natural scales of a scene, by which quantities are compared: length (m), rate (1/s) and force (N).
#[derive(Clone, Copy)]
pub(super) struct Scale {
    size: f64,
    rate: f64,
    force: f64,
}

impl Scale {
    /// Returns the scales of a system for the time scale of a tolerance.
    pub(super) fn of<const D: usize>(system: &System<D>, tolerance: &Tolerance) -> Self {
        let (size, rate) = (system.size(), 1.0 / tolerance.time);
        let force = system.mass() * size * rate * rate;
        Self { size, rate, force }
    }
}

/// Returns the evaluation that a quantity is computed from, and its size in a motion at the natural scales. `None` for
/// sums over the whole run and for conserved or constrained quantities.
fn nature(quantity: Quantity) -> (Evaluated, fn(Scale) -> Option<f64>) {
    use Evaluated::*;
    use Quantity::*;
    match quantity {
        Position(..) | CenterOfMass(_) | Travel(_) | Displacement(_) | Length(_) => {
            (Kinematics, |by| Some(by.size))
        }
        // What is below a billionth of the size is roundoff.
        Deflection(..) => (Kinematics, |by| Some(1e-6 * by.size)),
        Velocity(..) | SlidingVelocity(_) | LengthRate(_) => {
            (Kinematics, |by| Some(by.size * by.rate))
        }
        Acceleration(..) | SlidingAcceleration(_) => {
            (Dynamics, |by| Some(by.size * by.rate * by.rate))
        }
        Direction(..) | Angle(_) | Orientation(..) | Quaternion(..) | RotationVector(..) => {
            (Kinematics, |_| Some(1.0))
        }
        AngularVelocity(..) | JointVelocity(_) => (Kinematics, |by| Some(by.rate)),
        AngularAcceleration(..) | JointAcceleration(_) => (Dynamics, |by| Some(by.rate * by.rate)),
        Strain(_) | Curvature(_) | MembraneStrain(..) | SurfaceCurvature(..) => {
            (Kinematics, |_| Some(0.0))
        }
        MembraneForce(..) => (Kinematics, |by| Some(by.force / by.size)),
        SurfaceMoment(..) => (Kinematics, |by| Some(by.force)),
        AxialForce(_)
        | ConnectivityForce(..)
        | Reaction(..)
        | MotionForce(..)
        | GearForce(_)
        | FrictionForce(..) => (Dynamics, |by| Some(by.force)),
        BendingMoment(..) | Torque(_) | ReactionMoment(..) | MotionMoment(..) | GearTorque(_)
        | FrictionMoment(..) => (Dynamics, |by| Some(by.force * by.size)),
        Stress(_) | TorsionStress(_) => (Dynamics, |by| Some(by.force / (by.size * by.size))),
        StressTensor(..) | VonMisesStress(_) | LayerStress(..) | LayerVonMises(_) => {
            (Kinematics, |by| Some(by.force / (by.size * by.size)))
        }
        CouplingForce(..) | LoadForce(..) | Tension(_) => (Kinematics, |by| Some(by.force)),
        CouplingMoment(..) | LoadMoment(..) | KineticEnergy | StrainEnergy | GravityEnergy
        | SpringEnergy => (Kinematics, |by| Some(by.force * by.size)),
        Momentum(_) | AngularMomentum(_) | Resolution | Residual(_) => (Kinematics, |_| None),
        LatchState(_) => (Kinematics, |_| None),
        Input | Dissipated => (Nothing, |_| None),
    }
}

/// Returns the evaluation that a quantity is computed from.
pub(super) fn needs(quantity: Quantity) -> Evaluated {
    nature(quantity).0
}

/// Returns the size of a quantity in a motion at the natural scales. `None` for quantities that are not compared with
/// it.
pub(super) fn natural(quantity: Quantity, by: Scale) -> Option<f64> {
    nature(quantity).1(by)
}

impl<const D: usize> Engine<D> {
    /// Size of the scene, m.
    pub(super) fn size(&self) -> f64 {
        self.assembled.system.size()
    }

    /// Returns the size of a quantity in a motion at the natural scales of the scene. `None` for quantities that are
    /// not compared with it.
    pub(super) fn natural(&self, quantity: Quantity) -> Option<f64> {
        natural(quantity, Scale::of(&self.assembled.system, &self.tolerance))
    }
}

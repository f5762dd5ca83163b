//! Values of outputs, of numbers of any kind, from an evaluated state.

use super::Quantity;
use crate::body::Marker;
use crate::math::jet::Number;
use crate::scene::{Assembled, HolderId, MarkerId};
use crate::system::{End, Evaluation};

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
    let ends = |joint: HolderId| system.joints()[joint.index()].ends;
    match quantity {
        Position(id, axis) => on(id).position(&values.x)[axis],
        Velocity(id, axis) => on(id).position(&values.v)[axis],
        Acceleration(id, axis) => on(id).position(&values.acceleration)[axis],
        Angle(angle) => values.angles[angle.index()],
        AngularVelocity(id) => End::<D, N>::Body(on(id)).spin(&values.x, &values.v),
        JointVelocity(joint) => {
            let [a, b] = ends(joint).map(|end| end.lift().spin(&values.x, &values.v));
            b - a
        }
        AngularAcceleration(id) => {
            End::<D, N>::Body(on(id)).spin_rate(&values.x, &values.v, &values.acceleration)
        }
        JointAcceleration(joint) => {
            let rate =
                |end: End<D>| (end.lift()).spin_rate(&values.x, &values.v, &values.acceleration);
            let [a, b] = ends(joint).map(rate);
            b - a
        }
        Strain(id) => values.strain(system, at(id)).0,
        Curvature(id) => values.strain(system, at(id)).1,
        AxialForce(id) => values.section(system, at(id)).0,
        BendingMoment(id, axis) => values.section(system, at(id)).1[axis],
        ConnectivityForce(id, axis) => values.connectivity_force(system, at(id))[axis],
        Travel(slide) => values.travel[slide.index()],
        Reaction(joint, axis) => values.reaction(system, joint.index()).0[axis],
        ReactionMoment(joint) => values.reaction(system, joint.index()).1[2],
        MotionForce(joint, axis) => -values.reaction(system, joint.index()).0[axis],
        MotionMoment(joint) => -values.reaction(system, joint.index()).1[2],
        CouplingForce(id, axis) => values.coupling(system, assembled.coupling(id)).0[axis],
        CouplingMoment(id) => values.coupling(system, assembled.coupling(id)).1,
        KineticEnergy => values.kinetic_energy(system),
        StrainEnergy => values.strain_energy(system),
        GravityEnergy => values.gravity_energy(system),
        SpringEnergy => values.spring_energy(system),
        Input => work[0],
        Dissipated => work[1],
        Momentum(axis) => values.momentum(system).0[axis],
        AngularMomentum(axis) => values.momentum(system).1[axis],
        CenterOfMass(axis) => values.center_of_mass(system)[axis],
        Residual(of) => N::of(values.residuals(system)[of]),
    }
}

/// What a quantity is computed from.
pub(super) fn needs(quantity: Quantity) -> Evaluated {
    use Quantity::*;
    match quantity {
        Acceleration(..)
        | AngularAcceleration(_)
        | JointAcceleration(_)
        | ConnectivityForce(..)
        | AxialForce(_)
        | BendingMoment(..)
        | Reaction(..)
        | ReactionMoment(_)
        | MotionForce(..)
        | MotionMoment(_) => Evaluated::Dynamics,
        Input | Dissipated => Evaluated::Nothing,
        _ => Evaluated::Kinematics,
    }
}

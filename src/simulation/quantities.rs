//! Values of outputs, of numbers of any kind, from an evaluated state.

use super::Quantity;
use crate::body::Marker;
use crate::math::jet::Number;
use crate::scene::{Assembled, MarkerReference};
use crate::system::{End, Evaluation};

/// How much of the outputs belongs to the current state and inputs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Evaluated {
    Nothing,
    Kinematics,
    Dynamics,
}

/// Value of an output with its marker, if it has one; `work` came in and was dissipated so far.
pub(super) fn value<N: Number>(
    quantity: Quantity,
    marker: Option<&Marker>,
    values: &Evaluation<N>,
    assembled: &Assembled,
    work: [N; 2],
) -> N {
    use Quantity::*;
    let system = &assembled.system;
    let none = N::of(0.0);
    let on = |f: &dyn Fn(Marker<N>) -> N| marker.map_or(none, |marker| f(marker.lift()));
    let at = |f: &dyn Fn(&Marker) -> N| marker.map_or(none, f);
    match quantity {
        Position(_, axis) => on(&|m| m.position(&values.x)[axis]),
        Velocity(_, axis) => on(&|m| m.position(&values.v)[axis]),
        Acceleration(_, axis) => on(&|m| m.position(&values.acceleration)[axis]),
        Angle(place) => values.angles[assembled.angles[place]],
        AngularVelocity(_) => on(&|m| End::Body(m).spin(&values.x, &values.v)),
        JointVelocity(joint) => {
            let ends = system.joints()[joint].ends;
            let [a, b] = ends.map(|end| end.lift().spin(&values.x, &values.v));
            b - a
        }
        AngularAcceleration(_) => {
            on(&|m| End::Body(m).spin_rate(&values.x, &values.v, &values.acceleration))
        }
        JointAcceleration(joint) => {
            let rate =
                |end: End| (end.lift()).spin_rate(&values.x, &values.v, &values.acceleration);
            let [a, b] = system.joints()[joint].ends.map(rate);
            b - a
        }
        Strain(_) => at(&|m| values.strain(system, m).0),
        Curvature(_) => at(&|m| values.strain(system, m).1),
        AxialForce(_) => at(&|m| values.section(system, m).0),
        BendingMoment(_) => at(&|m| values.section(system, m).1),
        ConnectivityForce(_, axis) => at(&|m| values.connectivity_force(system, m)[axis]),
        Travel(place) => values.travel[place],
        Reaction(joint, axis) => values.reaction(system, joint).0[axis],
        ReactionMoment(joint) => values.reaction(system, joint).1,
        MotionForce(joint, axis) => -values.reaction(system, joint).0[axis],
        MotionMoment(joint) => -values.reaction(system, joint).1,
        CouplingForce(place, axis) => values.coupling(system, assembled.couplings[place]).0[axis],
        CouplingMoment(place) => values.coupling(system, assembled.couplings[place]).1,
        KineticEnergy => values.kinetic_energy(system),
        StrainEnergy => values.strain_energy(system),
        GravityEnergy => values.gravity_energy(system),
        SpringEnergy => values.spring_energy(system),
        Input => work[0],
        Dissipated => work[1],
        Momentum(axis) => values.momentum(system).0[axis],
        AngularMomentum => values.momentum(system).1,
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
        | Reaction(..)
        | ReactionMoment(_)
        | MotionForce(..)
        | MotionMoment(_) => Evaluated::Dynamics,
        Input | Dissipated => Evaluated::Nothing,
        _ => Evaluated::Kinematics,
    }
}

/// The marker that a quantity belongs to.
pub(super) fn marker_of(quantity: Quantity) -> Option<MarkerReference> {
    use Quantity::*;
    match quantity {
        Position(at, _)
        | Velocity(at, _)
        | Acceleration(at, _)
        | AngularVelocity(at)
        | AngularAcceleration(at)
        | Strain(at)
        | Curvature(at)
        | AxialForce(at)
        | BendingMoment(at)
        | ConnectivityForce(at, _) => Some(at),
        _ => None,
    }
}

//! Loads: what acts on bodies besides gravity and joints. One file a kind. A size that changes is a
//! [`Signal`]: a function of time or an input.

mod bushing;
mod contact;
mod convective_inertia;
mod distributed;
mod distributed_moment;
mod fluid;
mod force;
mod joint_limit;
mod joint_spring;
mod line_load;
mod moment;
mod orientation_bushing;
mod six_bushing;
mod spatial_moment;
mod spring;

pub use bushing::{Bushing, RotationalBushing};
pub use contact::{Contact, ContactPoint, ContactSurface};
pub use convective_inertia::ConvectiveInertia;
pub use distributed::{DistributedForce, LoadedLine};
pub use distributed_moment::DistributedMoment;
pub use fluid::{Fluid, FluidSegment};
pub use force::Force;
pub use joint_limit::JointLimit;
pub use joint_spring::JointSpring;
pub use line_load::LineLoad;
pub use moment::Moment;
pub use orientation_bushing::OrientationBushing;
pub use six_bushing::SixBushing;
pub use spatial_moment::SpatialMoment;
pub use spring::Spring;

use super::end::{Add, Attachment};
use super::instant::Instant;
use super::signal::Signal;
use crate::bodies::{LineChain, Node, RodChain};
use crate::elements::shape::Values;
use crate::math::jet::Number;
use crate::math::space::Vector;

/// Even parts of a body that does not bend in which what changes along it is integrated.
pub const PANELS: usize = 8;

/// Load on bodies.
#[derive(Clone, Debug)]
pub enum AppliedLoad<const D: usize = 2> {
    /// A force at a marker, dead or follower.
    Force(Force<D>),
    /// A moment on one end, and its opposite on another, in the plane.
    Moment(Moment<D>),
    /// A moment on one end, and its opposite on another, in space.
    SpatialMoment(SpatialMoment<D>),
    /// A dead force per reference length of a cable or a rod.
    DistributedForce(DistributedForce<D>),
    /// A moment per reference length of a rod or beam.
    DistributedMoment(Box<DistributedMoment>),
    /// A fluid that streams past a cable or a rod.
    Fluid(Box<Fluid<D>>),
    /// A spring with a damper between two ends.
    Spring(Spring<D>),
    /// A spring with a damper on a coordinate of a joint.
    JointSpring(JointSpring<D>),
    /// Stops of a coordinate of a joint.
    JointLimit(JointLimit<D>),
    /// Contact of a marker or a body with a surface.
    Contact(Box<Contact<D>>),
    /// Springs with dampers along and about three axes.
    SixBushing(Box<SixBushing<D>>),
    /// A spring with a damper from a marker to a point that moves.
    Bushing(Bushing<D>),
    /// A rotational spring with a damper from the direction of a marker to an angle.
    RotationalBushing(RotationalBushing),
    /// Rotational springs with dampers from a rigid body to an orientation, in space.
    OrientationBushing(Box<OrientationBushing>),
    /// A cable that a winch pays out.
    ConvectiveInertia(ConvectiveInertia),
}

impl<const D: usize> AppliedLoad<D> {
    /// Adds its forces.
    pub fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        match self {
            Self::DistributedForce(load) => load.add_force(at, f),
            Self::DistributedMoment(load) => load.add_force(at, f),
            Self::Fluid(load) => load.add_force(at, f),
            Self::Contact(load) => load.add_force(at, f),
            Self::ConvectiveInertia(load) => load.add_force(at, f),
            _ => self.act(at, |end, [position, direction]| {
                end.add_force(position, direction, f);
            }),
        }
    }

    /// Calls with every end that it acts on, and its forces on position and direction there; not where it is spread
    /// along a body.
    pub fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        match self {
            Self::Force(load) => load.act(at, call),
            Self::Moment(load) => load.act(at, call),
            Self::SpatialMoment(load) => load.act(at, call),
            Self::DistributedForce(_)
            | Self::DistributedMoment(_)
            | Self::Fluid(_)
            | Self::ConvectiveInertia(_) => {}
            Self::Spring(load) => load.act(at, call),
            Self::JointSpring(load) => load.act(at, call),
            Self::JointLimit(load) => load.act(at, call),
            Self::Contact(load) => load.act(at, call),
            Self::SixBushing(load) => load.act(at, call),
            Self::Bushing(load) => load.act(at, call),
            Self::RotationalBushing(load) => load.act(at, call),
            Self::OrientationBushing(load) => load.act(at, call),
        }
    }

    /// Returns the varying load along the body with this first node, at the Gauss points of a segment, N/m. `None` for
    /// other loads and bodies.
    pub(in crate::system) fn changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        (first, segment): (usize, usize),
    ) -> Option<Values<D, N>> {
        match self {
            Self::DistributedForce(load) => (load.density.changes()
                && load.first_node(&at.bodies.chains) == first)
                .then(|| load.changing(at, segment)),
            Self::Contact(load) => (load.is_distributed() && load.first_node() == first)
                .then(|| load.changing(at, segment)),
            Self::Fluid(load) => {
                (load.first_node(&at.bodies.chains) == first).then(|| load.values(at, segment))
            }
            Self::ConvectiveInertia(load) => {
                (load.first_node(&at.bodies.chains) == first).then(|| load.values(at, segment))
            }
            _ => None,
        }
    }

    /// Adds minus the derivative of its forces by coordinates (the symmetric part, which is what
    /// solves use) and, to `damping`, by rates.
    pub fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        match self {
            Self::Force(load) => load.add_stiffness(at, stiffness),
            Self::Moment(load) => load.add_stiffness(at, stiffness),
            // What it adds to the stiffness where bodies turn is not symmetric, and small beside inertia.
            Self::SpatialMoment(_) | Self::DistributedForce(_) | Self::DistributedMoment(_) => {}
            // The same: rope is paid out slowly beside its waves.
            Self::ConvectiveInertia(_) => {}
            Self::Fluid(load) => load.add_damping(at, damping),
            Self::Spring(load) => load.add_tangent(at, stiffness, damping),
            Self::JointSpring(load) => load.add_tangent(at, stiffness, damping),
            Self::JointLimit(load) => load.add_tangent(at, stiffness, damping),
            Self::Contact(load) => load.add_tangent(at, stiffness, damping),
            Self::SixBushing(load) => load.add_tangent(at, stiffness, damping),
            Self::Bushing(load) => load.add_tangent(stiffness, damping),
            Self::RotationalBushing(load) => load.add_tangent(at, stiffness, damping),
            Self::OrientationBushing(load) => load.add_tangent(at, stiffness, damping),
        }
    }

    /// Power that it supplies from outside and power that it dissipates, W. Springs store.
    pub fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let none = N::of(0.0);
        match self {
            Self::Force(load) => [load.power(at), none],
            Self::Moment(load) => [load.power(at), none],
            Self::SpatialMoment(load) => [load.power(at), none],
            Self::DistributedForce(load) => [load.power(at), none],
            Self::DistributedMoment(load) => [load.power(at), none],
            Self::Fluid(load) => load.power(at),
            Self::Spring(load) => load.power(at),
            Self::JointSpring(load) => [none, load.dissipation(at)],
            Self::JointLimit(load) => [none, load.dissipation(at)],
            Self::Contact(load) => load.power(at),
            Self::SixBushing(load) => [none, load.dissipation(at)],
            Self::Bushing(load) => load.power(at),
            Self::RotationalBushing(load) => load.power(at),
            Self::OrientationBushing(load) => load.power(at),
            Self::ConvectiveInertia(load) => [load.power(at), none],
        }
    }

    /// Energy that it stores, J.
    pub fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        match self {
            Self::Spring(load) => load.energy(at),
            Self::JointSpring(load) => load.energy(at),
            Self::JointLimit(load) => load.energy(at),
            Self::Contact(load) => load.energy(at),
            Self::SixBushing(load) => load.energy(at),
            Self::Bushing(load) => load.energy(at),
            Self::RotationalBushing(load) => load.energy(at),
            Self::OrientationBushing(load) => load.energy(at),
            _ => N::of(0.0),
        }
    }

    /// Work on the way from `before` to `after` of a load held as it is, for the potential: exact for
    /// dead loads and springs.
    pub fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        match self {
            Self::Force(load) => load.work(before, after),
            Self::Moment(load) => load.work(before, after),
            Self::SpatialMoment(load) => load.work(before, after),
            Self::DistributedForce(load) => load.work(before, after),
            Self::DistributedMoment(load) => load.work(before, after),
            Self::Fluid(load) => load.work(before, after),
            Self::Bushing(load) => load.work(before, after),
            Self::RotationalBushing(load) => load.work(before, after),
            Self::OrientationBushing(load) => load.work(before, after),
            // Where equilibria are sought winches stand.
            Self::ConvectiveInertia(_) => 0.0,
            Self::Spring(_)
            | Self::JointSpring(_)
            | Self::JointLimit(_)
            | Self::Contact(_)
            | Self::SixBushing(_) => self.energy(before) - self.energy(after),
        }
    }

    /// Returns a copy of the load frozen at an instant. Dead and follower loads are scaled by `fraction`.
    pub fn held(&self, at: Instant<'_, D>, fraction: f64) -> Self {
        let mut held = self.clone();
        let hold = |signals: &mut [Signal], fraction: f64| {
            for signal in signals {
                *signal = signal.held(at, fraction);
            }
        };
        match &mut held {
            Self::Force(load) => hold(&mut load.components, fraction),
            Self::Moment(load) => hold(std::slice::from_mut(&mut load.size), fraction),
            Self::SpatialMoment(load) => {
                for (size, _) in &mut load.parts {
                    hold(std::slice::from_mut(size), fraction);
                }
            }
            Self::DistributedForce(load) => load.density.hold(at, fraction),
            Self::DistributedMoment(load) => load.density.hold(at, fraction),
            Self::Fluid(load) => load.hold(at, fraction),
            Self::Spring(load) => hold(std::slice::from_mut(&mut load.length), 1.0),
            // At rest there is none.
            Self::Contact(load) => load.friction = 0.0,
            Self::JointSpring(_)
            | Self::JointLimit(_)
            | Self::SixBushing(_)
            | Self::ConvectiveInertia(_) => {}
            Self::Bushing(load) => {
                hold(&mut load.position, 1.0);
                hold(&mut load.velocity, 1.0);
            }
            Self::RotationalBushing(load) => {
                hold(std::slice::from_mut(&mut load.angle), 1.0);
                hold(std::slice::from_mut(&mut load.velocity), 1.0);
            }
            Self::OrientationBushing(load) => {
                hold(&mut load.quaternion, 1.0);
                hold(&mut load.velocity, 1.0);
            }
        }
        held
    }

    /// Whether it has a potential, so that its tangent is symmetric: a force that turns with a body has none, nor has drag.
    pub fn is_conservative(&self) -> bool {
        match self {
            Self::Force(load) => !load.follower,
            Self::SpatialMoment(load) => load.is_torque,
            Self::DistributedMoment(_) => false,
            Self::Fluid(load) => !load.streams(),
            Self::Contact(load) => load.friction == 0.0,
            _ => true,
        }
    }

    /// Whether it turns what it acts on.
    pub fn is_moment(&self) -> bool {
        match self {
            Self::Moment(_)
            | Self::SpatialMoment(_)
            | Self::DistributedMoment(_)
            | Self::SixBushing(_)
            | Self::RotationalBushing(_)
            | Self::OrientationBushing(_) => true,
            Self::JointSpring(load) => load.coordinate.is_angle(),
            Self::JointLimit(load) => load.coordinate.is_angle(),
            Self::Force(_)
            | Self::DistributedForce(_)
            | Self::Fluid(_)
            | Self::Spring(_)
            | Self::Contact(_)
            | Self::Bushing(_)
            | Self::ConvectiveInertia(_) => false,
        }
    }

    /// Whether its force has a kink at a time that the state decides.
    pub fn has_contact(&self) -> bool {
        matches!(self, Self::JointLimit(_) | Self::Contact(_))
    }

    /// Whether it dissipates.
    pub fn is_damped(&self) -> bool {
        match self {
            Self::Fluid(load) => load.is_damped(),
            Self::Spring(load) => load.damping > 0.0,
            Self::JointSpring(load) => load.damping > 0.0,
            Self::JointLimit(load) => load.damping > 0.0,
            Self::Contact(load) => load.damping > 0.0 || load.friction > 0.0,
            Self::SixBushing(load) => load.is_damped(),
            Self::Bushing(load) => load.damping > 0.0,
            Self::RotationalBushing(load) => load.damping > 0.0,
            Self::OrientationBushing(load) => load.damping > 0.0,
            _ => false,
        }
    }

    /// Returns the time-dependent sizes of the load.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let one = std::slice::from_ref;
        let (first, second): (&[Signal], &[Signal]) = match self {
            Self::Force(load) => (&load.components, &[]),
            Self::DistributedForce(load) => (&load.density.uniform, &[]),
            Self::DistributedMoment(load) => (&load.density.uniform, &[]),
            Self::Fluid(load) => (&load.current.uniform, &[]),
            Self::Moment(load) => (one(&load.size), &[]),
            Self::Spring(load) => (one(&load.length), &[]),
            Self::SpatialMoment(_)
            | Self::JointSpring(_)
            | Self::JointLimit(_)
            | Self::Contact(_)
            | Self::SixBushing(_)
            | Self::ConvectiveInertia(_) => (&[], &[]),
            Self::Bushing(load) => (&load.position, &load.velocity),
            Self::RotationalBushing(load) => (one(&load.angle), one(&load.velocity)),
            Self::OrientationBushing(load) => (&load.quaternion, &load.velocity),
        };
        let parts = match self {
            Self::SpatialMoment(load) => &load.parts[..],
            _ => &[],
        };
        let along: &[Vec<Signal>] = match self {
            Self::DistributedForce(load) => &load.density.along,
            Self::DistributedMoment(load) => &load.density.along,
            Self::Fluid(load) => &load.current.along,
            _ => &[],
        };
        let here = first.iter().chain(second);
        let here = here.chain(parts.iter().map(|(size, _)| size));
        here.chain(along.iter().flatten())
    }

    /// Nodes on which its forces depend and act, of every part of it that depends on no others.
    pub fn parts(&self, chains: &[LineChain<D>], sections: &[RodChain]) -> Vec<Vec<usize>> {
        match self {
            Self::Fluid(load) => load.parts(chains),
            Self::DistributedMoment(load) => {
                let rod = &sections[load.on];
                let elements = 0..rod.count();
                elements.map(|j| rod.all_nodes(j).to_vec()).collect()
            }
            Self::Contact(load) => load.parts(),
            Self::ConvectiveInertia(load) => load.parts(chains),
            _ => vec![self.ends().iter().flat_map(Attachment::nodes).collect()],
        }
    }

    /// Adds the forces of one of these parts.
    pub fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        match self {
            Self::DistributedMoment(load) => load.add_force_on(at, part, f),
            Self::Fluid(load) => load.add_force_on(at, part, f),
            Self::Contact(load) => load.add_part(at, part, f),
            Self::ConvectiveInertia(load) => load.add_part(at, part, f),
            _ => self.add_force(at, f),
        }
    }

    /// Ends between which its tangent couples.
    pub fn ends(&self) -> Vec<Attachment<D>> {
        match self {
            Self::Force(load) => vec![Attachment::Body(load.marker)],
            Self::Moment(load) => load.ends.to_vec(),
            Self::SpatialMoment(load) => load.ends.to_vec(),
            Self::DistributedForce(_) | Self::Fluid(_) | Self::ConvectiveInertia(_) => vec![],
            Self::DistributedMoment(load) => vec![Attachment::Body(load.end)],
            Self::Spring(load) => load.ends.to_vec(),
            Self::JointSpring(load) => load.coordinate.ends().to_vec(),
            Self::JointLimit(load) => load.coordinate.ends().to_vec(),
            // Elements couple their nodes already.
            Self::Contact(load) if load.is_distributed() => vec![],
            Self::Contact(load) => vec![Attachment::Body(load.places[0].marker)],
            Self::SixBushing(load) => load.ends().to_vec(),
            Self::Bushing(load) => vec![Attachment::Body(load.marker)],
            Self::RotationalBushing(load) => vec![Attachment::Body(load.marker)],
            Self::OrientationBushing(load) => vec![Attachment::Body(load.axes[0])],
        }
    }
}

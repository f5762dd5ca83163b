//! Loads: what acts on bodies besides gravity and joints. One file a kind. A size that changes is a
//! [`Signal`]: a function of time or an input.

mod airfoil;
mod area_load;
mod bushing;
mod contact;
mod convective_inertia;
mod distributed;
mod distributed_moment;
mod fluid;
mod force;
mod force_law;
mod joint_friction;
mod joint_limit;
mod joint_spring;
mod line_load;
mod loaded_surface;
mod moment;
mod one_sided_spring;
mod reeving;
mod spatial_moment;
mod spring;
mod state_law;
mod surface_contact;
mod surface_fluid;
mod table_spring;

pub use airfoil::{Airfoil, AirfoilAxes, AirfoilCoefficient, AirfoilLine, AirfoilStrip};
pub use area_load::{AreaAction, AreaLoad, AreaValues};
pub use bushing::{BetweenFrames, Bushing, BushingMeasure, FromAngle, FromOrientation, FromPoint};
pub use contact::{
    Contact, ContactLaw, ContactPoint, ContactSurface, Grip, RigidFrame, StickMotion,
    TangentialSpring,
};
pub use convective_inertia::ConvectiveInertia;
pub use distributed::DistributedForce;
pub use distributed_moment::DistributedMoment;
pub use fluid::{Fluid, FluidSegment};
pub use force::Force;
pub use force_law::ForceLaw;
pub use joint_friction::JointFriction;
pub use joint_limit::JointLimit;
pub use joint_spring::JointSpring;
pub use line_load::LineLoad;
pub use loaded_surface::LoadedSurface;
pub use moment::Moment;
pub use one_sided_spring::OneSidedSpring;
pub use reeving::{Drum, MOST_POINTS, Reeving};
pub use spatial_moment::SpatialMoment;
pub use spring::Spring;
pub use state_law::StateLaw;
pub use surface_contact::SurfaceContact;
pub use surface_fluid::SurfaceFluid;
pub use table_spring::TableSpring;

use super::end::{Add, Attachment};
use super::instant::Instant;
use super::signal::Signal;
use crate::bodies::{Bodies, Node};
use crate::elements::section::Vectors;
use crate::elements::shape::Values;
use crate::math::jet::Number;
use crate::math::space::Vector;

/// Load on bodies.
///
/// A new kind of load is one file with its `ForceElement` and one line among the [`AppliedLoad`]s. A default of an item is right for a
/// conservative load at ends, without damping and signals.
pub trait ForceElement<const D: usize>: Clone {
    /// Calls with every end that the load acts on, and its forces on position and direction there; not where it is distributed along
    /// a body. Of two ends whose force outputs read, the second one is that of the second call.
    fn act<N: Number>(
        &self,
        _at: Instant<'_, D, N>,
        _call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
    }

    /// Adds the forces on nodes to `f`, `[nodes]`.
    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        self.act(at, |end, [position, direction]| {
            end.add_force(position, direction, f);
        });
    }

    /// Returns the varying load along the body with this first node, at the Gauss points of a segment, N/m. `None` for
    /// other loads and bodies.
    fn changing<N: Number>(
        &self,
        _at: Instant<'_, D, N>,
        _first: usize,
        _segment: usize,
    ) -> Option<Values<D, N>> {
        None
    }

    /// Returns the moment per length along the rod or beam on the line with this first node, in global components at the Gauss points of an
    /// element, N m/m. `None` for other loads and bodies.
    fn changing_moments<N: Number>(
        &self,
        _at: Instant<'_, D, N>,
        _first: usize,
        _segment: usize,
    ) -> Option<Vectors<N>> {
        None
    }

    /// Adds minus the symmetric part of the derivative of the forces by coordinates and, to `damping`, by rates. A part that is
    /// small beside inertia may stay out.
    fn add_tangent(&self, _at: Instant<'_, D>, _stiffness: Add<'_, D>, _damping: Add<'_, D>) {}

    /// Returns the power supplied from outside and the power dissipated, W. Springs store.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2];

    /// Returns the stored energy, J.
    fn energy<N: Number>(&self, _at: Instant<'_, D, N>) -> N {
        N::of(0.0)
    }

    /// Returns the work on the way from `before` to `after` of a load frozen at `before`, J: exact for dead loads and springs.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        self.energy(before) - self.energy(after)
    }

    /// Freezes the load at an instant. Dead and follower loads are scaled by `fraction`.
    fn hold(&mut self, _at: Instant<'_, D>, _fraction: f64) {}

    /// Calls with every time-dependent size of the load.
    fn each_signal<'a>(&'a self, _call: &mut dyn FnMut(&'a Signal)) {}

    /// Whether the load has a potential, so that its tangent is symmetric. A force that rotates with a body has none, nor has drag.
    fn is_conservative(&self) -> bool {
        true
    }

    /// Whether the load rotates what it acts on.
    fn is_moment(&self) -> bool {
        false
    }

    /// Whether the force has a kink at a time that the state decides.
    fn has_contact(&self) -> bool {
        false
    }

    /// Whether a body is wound around a surface that rubs, so that friction follows from the tension that it changes.
    fn has_belt_friction(&self) -> bool {
        false
    }

    /// Whether the load dissipates.
    fn is_damped(&self) -> bool {
        false
    }

    /// Returns the ends that it acts on; none along a body.
    fn ends(&self) -> Vec<Attachment<D>> {
        Vec::new()
    }

    /// Whether it ties its ends to the ground by a stiffness.
    fn is_grounded(&self) -> bool {
        false
    }

    /// Returns the nodes on which the forces depend and act, of every part of the load that depends on no others: those that its tangent
    /// couples.
    fn parts(&self, _bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        vec![self.ends().iter().flat_map(Attachment::nodes).collect()]
    }

    /// Adds the forces of one of these parts.
    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, _part: usize, f: &mut [Node<D, N>]) {
        self.add_force(at, f);
    }

    /// Returns a copy of the load frozen at an instant. Dead and follower loads are scaled by `fraction`.
    fn held(&self, at: Instant<'_, D>, fraction: f64) -> Self {
        let mut held = self.clone();
        held.hold(at, fraction);
        held
    }
}

/// Declares the kinds of load with how each is kept, and passes each item of [`ForceElement`] to the kind at hand.
macro_rules! loads {
    ($($(#[$doc:meta])* $kind:ident($of:ty): $load:ty,)*) => {
        /// Load on bodies, by kind.
        #[derive(Clone, Debug)]
        pub enum AppliedLoad<const D: usize = 2> {
            $($(#[$doc])* $kind($of),)*
        }

        impl<const D: usize> ForceElement<D> for AppliedLoad<D> {
            fn act<N: Number>(
                &self,
                at: Instant<'_, D, N>,
                call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
            ) {
                match self {
                    $(Self::$kind(load) => load.act(at, call),)*
                }
            }

            fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
                match self {
                    $(Self::$kind(load) => load.add_force(at, f),)*
                }
            }

            fn changing<N: Number>(
                &self,
                at: Instant<'_, D, N>,
                first: usize,
                segment: usize,
            ) -> Option<Values<D, N>> {
                match self {
                    $(Self::$kind(load) => load.changing(at, first, segment),)*
                }
            }

            fn changing_moments<N: Number>(
                &self,
                at: Instant<'_, D, N>,
                first: usize,
                segment: usize,
            ) -> Option<Vectors<N>> {
                match self {
                    $(Self::$kind(load) => load.changing_moments(at, first, segment),)*
                }
            }

            fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
                match self {
                    $(Self::$kind(load) => load.add_tangent(at, stiffness, damping),)*
                }
            }

            fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
                match self {
                    $(Self::$kind(load) => load.power(at),)*
                }
            }

            fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
                match self {
                    $(Self::$kind(load) => load.energy(at),)*
                }
            }

            fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
                match self {
                    $(Self::$kind(load) => load.work(before, after),)*
                }
            }

            fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
                match self {
                    $(Self::$kind(load) => load.hold(at, fraction),)*
                }
            }

            fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::each_signal(load, call),)*
                }
            }

            fn is_conservative(&self) -> bool {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::is_conservative(load),)*
                }
            }

            fn is_moment(&self) -> bool {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::is_moment(load),)*
                }
            }

            fn has_contact(&self) -> bool {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::has_contact(load),)*
                }
            }

            fn has_belt_friction(&self) -> bool {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::has_belt_friction(load),)*
                }
            }

            fn is_damped(&self) -> bool {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::is_damped(load),)*
                }
            }

            fn ends(&self) -> Vec<Attachment<D>> {
                match self {
                    $(Self::$kind(load) => load.ends(),)*
                }
            }

            fn is_grounded(&self) -> bool {
                match self {
                    $(Self::$kind(load) => <$load as ForceElement<D>>::is_grounded(load),)*
                }
            }

            fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
                match self {
                    $(Self::$kind(load) => load.parts(bodies),)*
                }
            }

            fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
                match self {
                    $(Self::$kind(load) => load.add_part(at, part, f),)*
                }
            }
        }
    };
}

loads! {
    /// A force at a marker, dead or follower.
    Force(Force<D>): Force<D>,
    /// A moment on one end, and its opposite on another, in the plane.
    Moment(Moment<D>): Moment<D>,
    /// A moment on one end, and its opposite on another, in space.
    SpatialMoment(SpatialMoment<D>): SpatialMoment<D>,
    /// A dead force per reference length of a cable or a rod.
    DistributedForce(DistributedForce<D>): DistributedForce<D>,
    /// Pressure or a dead force per area of a plate or shell.
    AreaLoad(Box<AreaLoad>): AreaLoad,
    /// A moment per reference length of a rod or beam.
    DistributedMoment(Box<DistributedMoment>): DistributedMoment,
    /// A fluid that streams past a cable or a rod.
    Fluid(Box<Fluid<D>>): Fluid<D>,
    /// A fluid that streams past a plate or shell.
    SurfaceFluid(Box<SurfaceFluid>): SurfaceFluid,
    /// An airfoil at a marker or along a line.
    Airfoil(Box<Airfoil<D>>): Airfoil<D>,
    /// A spring with a damper between two ends.
    Spring(Spring<D>): Spring<D>,
    /// A rope without mass over points.
    Reeving(Box<Reeving<D>>): Reeving<D>,
    /// A force by an expression, between two ends or on a coordinate of a joint.
    ForceLaw(Box<ForceLaw<D>>): ForceLaw<D>,
    /// A spring with a damper by tables, between two ends or on a coordinate of a joint.
    TableSpring(TableSpring<D>): TableSpring<D>,
    /// A spring with a damper on a coordinate of a joint.
    JointSpring(JointSpring<D>): JointSpring<D>,
    /// Limits of a coordinate of a joint.
    JointLimit(JointLimit<D>): JointLimit<D>,
    /// Dry friction on a coordinate of a joint.
    JointFriction(JointFriction<D>): JointFriction<D>,
    /// Contact of a marker or a body with a surface.
    Contact(Box<Contact<D>>): Contact<D>,
    /// Contact of a plate or shell with a surface.
    SurfaceContact(Box<SurfaceContact>): SurfaceContact,
    /// Springs with dampers along and about three axes.
    Bushing(Box<Bushing<D>>): Bushing<D>,
    /// A cable that a winch pays out.
    ConvectiveInertia(ConvectiveInertia): ConvectiveInertia,
}

/// Freezes signals at an instant, scaled by `fraction`.
fn hold<const D: usize>(signals: &mut [Signal], at: Instant<'_, D>, fraction: f64) {
    for signal in signals {
        *signal = signal.held(at, fraction);
    }
}

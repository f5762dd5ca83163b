//! Loads of a scene. One file holds the scene side of a kind: keys and their checks, resolved references, parameters, text for the
//! documentation page, and the load of the system that is built of them.

mod action;
mod airfoil;
mod bushing;
mod contact;
mod fluid;
mod force_law;
mod joint_friction;
mod joint_limit;
mod joint_spring;
mod line;
mod measure;
mod number;
mod place;
mod reeving;
mod rest_length;
mod spring_damper;
mod table_spring;

pub use action::Action;
pub use fluid::ResolvedFluid;
pub use number::{LoadNumber, NumberMut};
pub use place::{Exerts, LoadExtent, LoadPlace};
use rest_length::RestLength;

// What follows is there for the files of the kinds too.
use std::ops::Deref;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::assemble::Builder;
use super::description::tagged::{Kinds, kinds, part};
use super::description::{SceneVector, Value};
use super::joints::CoordinateKind;
use super::resolved::{
    Cable, Ends, First, Form, JointCoordinate, LoadId, Resolved, ResolvedMarker,
};
use super::unit::*;
use super::validate::checks::{
    components, direction, expected, finite, needed, not_negative, positive, quoted, spring_damper,
    unknown, value,
};
use super::{Error, Found, number, words};
use crate::system::Signal;
use crate::system::loads::AppliedLoad;
use NumberMut::{Axes, Needed, Optional};
use number::damper;

/// A load of the system, or what is wrong with a mesh or an expression along a body.
type AssembledLoad<const D: usize> = Result<AppliedLoad<D>, Error>;

/// A load as written in the scene, with its name.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Load {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the load.
    #[serde(flatten)]
    pub kind: LoadKind,
}
part!(Load { name: String });

/// A load after names have been looked up.
#[derive(Clone, Debug)]
pub struct ResolvedLoad<'a> {
    /// Name.
    pub name: &'a str,
    /// As described.
    pub given: &'a LoadKind,
    /// Kind of load, with what its names refer to.
    pub kind: ResolvedLoadKind<'a>,
}

/// Values of a load that may change in time.
#[derive(Clone, Copy, Debug)]
pub struct TimedKey<'a> {
    /// Key of the values.
    pub key: &'static str,
    /// One value a component.
    pub values: &'a [Value],
    /// Highest derivative that is needed.
    pub order: usize,
}

/// Text on a load for the documentation page. Names and expressions stand between backticks.
#[derive(Clone, Debug)]
pub struct LoadWords {
    /// Kind of load.
    pub kind: String,
    /// Part of the scene that it acts on.
    pub on: String,
    /// Sizes.
    pub size: String,
}

/// Load as a scene describes it: one struct of keys for each kind.
///
/// A new kind of load is one file with its `SceneLoad` and [`ActingLoad`], and one line among the kinds below. Defaults of trait items fit a
/// load that has no parameters, does not change in time and is read by no output.
trait SceneLoad: Clone {
    /// The load with its references resolved.
    type Acting<'a>: ActingLoad<'a>
    where
        Self: 'a;

    /// Forces and moments that outputs read.
    const EXERTS: Exerts = Exerts::Nothing;

    /// Checks the values and resolves the references.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>>;

    /// Whether it is an explicit force or moment, which could also be an input.
    fn is_action(&self) -> bool {
        false
    }

    /// Returns the values that may change in time.
    fn timed(&self) -> Option<TimedKey<'_>> {
        None
    }

    /// Returns the numbers that are parameters of the unit. The place that the load acts on chooses the units.
    fn numbers(&mut self, _on: LoadExtent) -> Vec<LoadNumber<'_>> {
        Vec::new()
    }
}

/// Load after names have been looked up.
pub trait ActingLoad<'a> {
    /// Returns the place of the load on bodies.
    fn place(&self) -> LoadPlace<'a>;

    /// Returns the force or moment, of a load that is one.
    fn action(&self) -> Option<&Action<'a>> {
        None
    }

    /// Returns the largest stiffness against displacements (N/m; for contact along a body N/m per length) and against rotations (N m/rad).
    fn stiffness(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// Returns the markers that it acts on, where the mesh of a body needs a node; those of joints have one.
    fn markers(&self) -> Vec<ResolvedMarker<'a>> {
        self.place().markers()
    }

    /// Returns the indices of the bodies that it acts on, among all bodies.
    fn bodies(&self) -> Vec<usize> {
        self.place().bodies()
    }

    /// Whether it pulls along lines between points with a tension that outputs read.
    fn has_tension(&self) -> bool {
        false
    }

    /// Returns the straight parts of a rope, without those on the ground.
    fn spans(&self) -> Vec<Ends<'a>> {
        Vec::new()
    }

    /// Whether it acts only beyond a limit or below a surface, or where it is taut.
    fn is_one_sided(&self) -> bool {
        false
    }

    /// Whether the number with this key is a parameter in this scene.
    fn has_number(&self, _key: &str, _scene: &Resolved<'_>) -> bool {
        true
    }

    /// Builds the load of the system.
    ///
    /// # Errors
    /// A mesh that is not possible, or an expression that has no value at a Gauss point.
    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        path: &str,
    ) -> AssembledLoad<D>
    where
        Self: Sized;

    /// Describes the load for the documentation page, in a scene of this dimension.
    fn words(&self, dimension: usize) -> LoadWords;
}

/// Declares the kinds of load with the structs of their keys and of what their names refer to, and passes each item of [`SceneLoad`] and
/// [`ActingLoad`] to the kind at hand.
macro_rules! loads {
    ($($(#[$doc:meta])* $kind:ident($load:ty): $resolved:ty,)*) => {
        kinds! {
            /// Loads by kind.
            LoadKind of "Load" {
                $($(#[$doc])* $kind($load),)*
            }
        }

        /// Loads with their references resolved, by kind.
        #[derive(Clone, Debug)]
        pub enum ResolvedLoadKind<'a> {
            $($(#[$doc])* $kind($resolved),)*
        }

        impl LoadKind {
            /// Forces and moments that outputs read, in the order of the kinds.
            const EXERTS: &'static [Exerts] = &[$(<$load as SceneLoad>::EXERTS,)*];

            fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<ResolvedLoadKind<'a>> {
                Ok(match self {
                    $(Self::$kind(load) => ResolvedLoadKind::$kind(load.resolve(path, scene)?),)*
                })
            }

            fn is_action(&self) -> bool {
                match self {
                    $(Self::$kind(load) => load.is_action(),)*
                }
            }

            /// Returns the values that may change in time.
            pub fn timed(&self) -> Option<TimedKey<'_>> {
                match self {
                    $(Self::$kind(load) => load.timed(),)*
                }
            }

            /// Returns the numbers that are parameters of the unit. The place that the load acts on chooses the units.
            pub fn numbers(&mut self, on: LoadExtent) -> Vec<LoadNumber<'_>> {
                match self {
                    $(Self::$kind(load) => load.numbers(on),)*
                }
            }
        }

        impl<'a> ResolvedLoadKind<'a> {
            /// Whether it has a force, and whether it has a moment, that outputs read.
            pub fn exerts(&self) -> [bool; 2] {
                let exerts = match self {
                    $(Self::$kind(_) => <$load as SceneLoad>::EXERTS,)*
                };
                exerts.at(&self.place())
            }

            fn assemble<const D: usize>(&self, builder: &mut Builder<'_, D>, path: &str) -> AssembledLoad<D> {
                match self {
                    $(Self::$kind(load) => load.assemble(builder, path),)*
                }
            }
        }

        impl<'a> Deref for ResolvedLoadKind<'a> {
            type Target = dyn ActingLoad<'a> + 'a;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$kind(load) => load,)*
                }
            }
        }
    };
}

loads! {
    /// Force at a marker, N.
    Force(action::ForceLoad): Action<'a>,
    /// Moment at a marker, counter-clockwise in the plane, N m. In space it keeps its global axes where it does not follow. A moment in
    /// space is not conservative: its work depends on the path of the rotation.
    Moment(action::MomentLoad): Action<'a>,
    /// Moment on the second marker of a joint about its axis, opposite on its first, N m.
    Torque(action::Torque): Action<'a>,
    /// Force in global axes per reference length of a cable, rod or beam, N/m.
    DistributedForce(action::DistributedForceLoad): Action<'a>,
    /// Moment per reference length of a rod or beam, N m/m: its power is that with the angular velocities of the sections. It keeps its
    /// global axes where it does not follow. In space it is not conservative: its work depends on the path of the rotations.
    DistributedMoment(action::DistributedMomentLoad): Action<'a>,
    /// Pressure along the normal of a plate or shell, which follows it, by its present area, Pa.
    Pressure(action::PressureLoad): Action<'a>,
    /// Force in global axes per area of a plate or shell without stress, N/m^2.
    AreaForce(action::AreaForceLoad): Action<'a>,
    /// Spring and damper side by side between two points.
    SpringDamper(spring_damper::SpringDamper): spring_damper::ResolvedSpring<'a>,
    /// Spring and damper side by side between two points, whose forces are tables over length and over its rate.
    TableSpring(table_spring::TableSpringLoad): table_spring::ResolvedTableSpring<'a>,
    /// A rope of given stiffness and without mass that runs over points without friction, and onto a drum. It has one tension all along:
    /// hook blocks, tackles, hoists, cable robots. Slack, it has none.
    Reeving(reeving::ReevingLoad): reeving::ResolvedReeving<'a>,
    /// A force by an expression in a length or a coordinate of a joint, in its rate, in the time and in a value that an input sets: drag
    /// torques, bump stops, dampers with knees, actuators.
    ForceLaw(force_law::ForceLawLoad): force_law::ResolvedForceLaw<'a>,
    /// Spring and damper side by side on a coordinate of a joint.
    JointSpring(joint_spring::JointSpringLoad): joint_spring::ResolvedJointSpring<'a>,
    /// Springs and dampers between two bodies in space, three along and three about the axes of the first one's body (of ground: the
    /// global ones), from how they stand at the start: the rotation is measured by its vector, angle along axis.
    Bushing(bushing::BushingLoad): bushing::ResolvedBushing<'a>,
    /// One-sided springs and dampers on a coordinate of a joint, beyond a lower limit, an upper one or both, without friction; the
    /// force is continuous in time (Hunt and Crossley 1975).
    JointLimit(joint_limit::JointLimitLoad): joint_limit::ResolvedJointLimit<'a>,
    /// Dry friction on a coordinate of a joint: Coulomb's, with a larger force at rest and its fall by Stribeck where they are given. What
    /// sticks stands still until a force overcomes it.
    JointFriction(joint_friction::JointFrictionLoad): joint_friction::ResolvedJointFriction<'a>,
    /// A fluid that streams past a cable, rod or beam: drag, added mass, inertia of the fluid and buoyancy per reference length (Morison
    /// and others 1950). The added mass counts in all directions alike.
    Fluid(fluid::FluidLoad): ResolvedFluid<'a>,
    /// An airfoil, as a strip at a marker or along a rod or beam: lift, drag and moment by the angle of attack and the rate of pitch,
    /// quasi-steady. A rigid body with drag alone is one too.
    Airfoil(airfoil::AirfoilLoad): airfoil::ResolvedAirfoil<'a>,
    /// Contact of a marker, or of the line of a cable, rod or beam, with a surface of the ground: a one-sided spring and damper along the
    /// normal (Hunt and Crossley 1975) and friction along the surface, which is none at rest, so that an equilibrium has none.
    Contact(contact::ContactLoad): contact::ResolvedContact<'a>,
}

impl LoadKind {
    /// Names of the kinds whose force or moment outputs read and, second, of those that exert a force or a moment depending on the joint
    /// coordinate.
    pub(super) fn exerting(is_moment: bool) -> [Vec<&'static str>; 2] {
        let named = |meant: &[Exerts]| {
            let kinds = Self::all().into_iter().zip(Self::EXERTS);
            let kinds = kinds.filter(|(_, exerts)| meant.contains(exerts));
            kinds.map(|(kind, _)| kind.name).collect()
        };
        let always = if is_moment {
            &[Exerts::ForceAndMoment][..]
        } else {
            &[Exerts::Force, Exerts::ForceAndMoment]
        };
        [named(always), named(&[Exerts::ByCoordinate])]
    }
}

impl<'a> ResolvedLoadKind<'a> {
    /// Marker at which outputs read the load's force or moment; `None` for contact along a body.
    pub fn exerts_on(&self) -> Option<ResolvedMarker<'a>> {
        let is_read = self.exerts() != [false; 2];
        self.place().second().filter(|_| is_read)
    }
}

impl<'a> Resolved<'a> {
    /// Loads with their numbers.
    pub fn numbered_loads(&self) -> impl Iterator<Item = (LoadId, &ResolvedLoad<'a>)> {
        let loads = self.loads.iter().enumerate();
        loads.map(|(place, load)| (LoadId(place), load))
    }

    /// Finds the load with a name among those of one kind, which `of` tells, to make an input of a number of it.
    ///
    /// # Errors
    /// No load of this kind has the name.
    pub(super) fn require_load<'s, T>(
        &'s mut self,
        path: &str,
        name: &str,
        wanted: &str,
        of: impl Fn(&'s mut ResolvedLoadKind<'a>) -> Option<T>,
    ) -> Result<T, Error> {
        let mut known = Vec::new();
        for load in &mut self.loads {
            if let Some(found) = of(&mut load.kind) {
                if load.name == name {
                    return Ok(found);
                }
                known.push(load.name);
            }
        }
        Err(unknown(path, wanted, name, known))
    }

    /// Resolves the loads.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    pub(super) fn resolve_loads(&mut self) -> Result<(), Error> {
        for (index, load) in self.scene.loads.iter().enumerate() {
            let path = format!("loads[{index}]");
            let resolved = load.resolve(&path, self)?;
            if resolved.kind.is_friction() {
                self.hold(&path, &load.name);
            }
            self.loads.push(resolved);
        }
        Ok(())
    }

    /// Resolves the loads of the initial state.
    ///
    /// # Errors
    /// A kind other than forces and moments, a missing key, a reference that does not exist, or a value out of range.
    pub(super) fn resolve_initial_loads(&mut self) -> Result<(), Error> {
        for (index, load) in self.scene.initial.loads().iter().enumerate() {
            let path = format!("initial.loads[{index}]");
            if !load.kind.is_action() {
                let wanted = "a force, a moment, a torque or a distributed one";
                let found = match load.kind {
                    LoadKind::Fluid(_) => "a fluid",
                    _ => "springs and dampers",
                };
                return Err(expected(&format!("{path}.kind"), wanted, found));
            }
            let resolved = load.resolve(&path, self)?;
            self.initial_loads.push(resolved);
        }
        Ok(())
    }
}

impl Load {
    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Result<ResolvedLoad<'a>, Error> {
        Ok(ResolvedLoad {
            name: &self.name,
            given: &self.kind,
            kind: self.kind.resolve(path, scene)?,
        })
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Builds all loads and those of the initial state.
    ///
    /// # Errors
    /// A mesh that is not possible, or an expression that has no value at a Gauss point.
    pub(super) fn loads(&mut self) -> Result<(), Error> {
        let resolved = self.resolved;
        for (index, load) in resolved.loads.iter().enumerate() {
            let built = load.kind.assemble(self, &format!("loads[{index}]"))?;
            self.parts.loads.push(built);
        }
        for (index, load) in resolved.initial_loads.iter().enumerate() {
            let path = format!("initial.loads[{index}]");
            let built = load.kind.assemble(self, &path)?;
            self.parts.initial_loads.push(built);
        }
        Ok(())
    }
}

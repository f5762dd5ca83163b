//! Loads of a scene. One file holds the scene side of a kind: its keys and their checks, what its names refer to, its parameters and words,
//! and what it becomes in the system.

mod action;
mod bushing;
mod contact;
mod fluid;
mod joint_limit;
mod joint_spring;
mod line;
mod number;
mod place;
mod spring_damper;
mod table_spring;

pub use action::{Action, LoadTarget};
pub use fluid::ResolvedFluid;
pub use number::{LoadNumber, NumberMut};
pub use place::{Exerts, LoadPlace};

use schemars::JsonSchema;
use serde::Serialize;

use super::Error;
use super::assemble::Builder;
use super::description::Value;
use super::description::tagged::{Kinds, kinds, part};
use super::resolved::{LoadId, Resolved, ResolvedMarker};
use super::validate::checks::expected;
use crate::system::loads::AppliedLoad;
use action::{DistributedForceLoad, DistributedMomentLoad, ForceLoad, MomentLoad, Torque};
use bushing::{BushingLoad, ResolvedBushing};
use contact::{ContactLoad, ResolvedContact};
use fluid::FluidLoad;
use joint_limit::{JointLimitLoad, ResolvedJointLimit};
use joint_spring::{JointSpringLoad, ResolvedJointSpring};
use spring_damper::{ResolvedSpring, SpringDamper};
use table_spring::{ResolvedTableSpring, TableSpringLoad};

/// A load that is known in the scene.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Load {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the load.
    #[serde(flatten)]
    pub kind: LoadKind,
}
part!(Load { name: String });

/// A load that the scene knows, with its references resolved.
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

/// A load in words. Names and expressions stand between backticks.
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
/// A new kind of load is one file with its `SceneLoad` and [`ActingLoad`], and one line among the kinds below. A default of an item is right
/// for a load that depends on the motion alone, without parameters.
trait SceneLoad: Clone {
    /// The load with its references resolved.
    type Resolved<'a>: ActingLoad<'a>
    where
        Self: 'a;

    /// Forces and moments that outputs read.
    const EXERTS: Exerts = Exerts::Nothing;

    /// Checks the values and resolves the references.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>)
    -> Result<Self::Resolved<'a>, Error>;

    /// Whether it is a force or a moment, as inputs are.
    fn is_action(&self) -> bool {
        false
    }

    /// Returns the values that may change in time.
    fn timed(&self) -> Option<TimedKey<'_>> {
        None
    }

    /// Returns the numbers that are parameters of the unit. The units of a load on a coordinate of a joint depend on whether this is an angle.
    fn numbers(&mut self, _is_angle: bool) -> Vec<LoadNumber<'_>> {
        Vec::new()
    }
}

/// Load with its references resolved.
trait ActingLoad<'a>: Clone {
    /// Returns the place of the load on bodies.
    fn place(&self) -> LoadPlace<'a>;

    /// Returns the force or moment, of a load that is one.
    fn action(&self) -> Option<&Action<'a>> {
        None
    }

    /// Returns the largest stiffness against displacements (N/m, of contacts of bodies N/m per length) and against rotations (N m/rad).
    fn stiffness(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// Whether it acts now and then: on one side of a limit or a surface alone.
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
    ) -> Result<AppliedLoad<D>, Error>;

    /// Describes the load in a scene of this dimension.
    fn words(&self, dimension: usize) -> LoadWords;
}

/// Declares the kinds of load with the structs of their keys and of what their names refer to, and passes each item of [`SceneLoad`] and [`ActingLoad`] to the kind at hand.
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

            fn resolve<'a>(
                &'a self,
                path: &str,
                scene: &Resolved<'a>,
            ) -> Result<ResolvedLoadKind<'a>, Error> {
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

            /// Returns the numbers that are parameters of the unit. The units of a load on a coordinate of a joint depend on whether this is an
            /// angle.
            pub fn numbers(&mut self, is_angle: bool) -> Vec<LoadNumber<'_>> {
                match self {
                    $(Self::$kind(load) => load.numbers(is_angle),)*
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

            /// Returns the place of the load on bodies.
            pub fn place(&self) -> LoadPlace<'a> {
                match self {
                    $(Self::$kind(load) => load.place(),)*
                }
            }

            /// Returns the force or moment, of a load that is one.
            pub fn action(&self) -> Option<&Action<'a>> {
                match self {
                    $(Self::$kind(load) => load.action(),)*
                }
            }

            /// Returns the largest stiffness against displacements (N/m, of contacts of bodies N/m per length) and against rotations (N m/rad).
            pub fn stiffness(&self) -> [f64; 2] {
                match self {
                    $(Self::$kind(load) => load.stiffness(),)*
                }
            }

            /// Whether it acts now and then: on one side of a limit or a surface alone.
            pub fn is_one_sided(&self) -> bool {
                match self {
                    $(Self::$kind(load) => load.is_one_sided(),)*
                }
            }

            /// Whether the number with this key is a parameter in this scene.
            pub fn has_number(&self, key: &str, scene: &Resolved<'_>) -> bool {
                match self {
                    $(Self::$kind(load) => load.has_number(key, scene),)*
                }
            }

            /// Builds the load of the system.
            ///
            /// # Errors
            /// A mesh that is not possible, or an expression that has no value at a Gauss point.
            pub(super) fn assemble<const D: usize>(
                &self,
                builder: &mut Builder<'_, D>,
                path: &str,
            ) -> Result<AppliedLoad<D>, Error> {
                match self {
                    $(Self::$kind(load) => load.assemble(builder, path),)*
                }
            }

            /// Describes the load in a scene of this dimension.
            pub fn words(&self, dimension: usize) -> LoadWords {
                match self {
                    $(Self::$kind(load) => load.words(dimension),)*
                }
            }
        }
    };
}

loads! {
    /// Force at a marker, N.
    Force(ForceLoad): Action<'a>,
    /// Moment at a marker, counter-clockwise in the plane, N m. In space it keeps its global axes where it does not follow,
    /// and its work then depends on the way that the body turns.
    Moment(MomentLoad): Action<'a>,
    /// Moment on the second marker of a joint about its axis, opposite on its first, N m.
    Torque(Torque): Action<'a>,
    /// Force in global axes per reference length of a cable, rod or beam, N/m.
    DistributedForce(DistributedForceLoad): Action<'a>,
    /// Moment per reference length of a rod or beam, N m/m: its power is that with the angular velocities of the sections. It keeps its
    /// global axes where it does not follow, and its work then depends on the way that sections turn.
    DistributedMoment(DistributedMomentLoad): Action<'a>,
    /// Spring and damper side by side between two points.
    SpringDamper(SpringDamper): ResolvedSpring<'a>,
    /// Spring and damper side by side between two points, whose forces are tables over length and over its rate.
    TableSpring(TableSpringLoad): ResolvedTableSpring<'a>,
    /// Spring and damper side by side on a coordinate of a joint.
    JointSpring(JointSpringLoad): ResolvedJointSpring<'a>,
    /// Springs and dampers between two bodies in space, three along and three about the axes of the first one's body (of ground: the
    /// global ones), from how they stand at the start: the rotation is measured by its vector, angle along axis.
    Bushing(BushingLoad): ResolvedBushing<'a>,
    /// One-sided springs and dampers on a coordinate of a joint, beyond a lower limit, an upper one or both, without friction; the
    /// force is continuous in time (Hunt and Crossley 1975).
    JointLimit(JointLimitLoad): ResolvedJointLimit<'a>,
    /// A fluid that streams past a cable, rod or beam: drag, added mass, inertia of the fluid and buoyancy per reference length (Morison
    /// and others 1950). The added mass counts in all directions alike.
    Fluid(FluidLoad): ResolvedFluid<'a>,
    /// Contact of a marker, or of the line of a cable, rod or beam, with a surface of the ground: a one-sided spring and damper along the
    /// normal (Hunt and Crossley 1975) and friction along the surface, which is none at rest, so that an equilibrium has none.
    Contact(ContactLoad): ResolvedContact<'a>,
}

impl LoadKind {
    /// Names of the kinds that exert something on a load of their own, and of those that do so by the coordinate of a joint, for messages.
    pub(super) fn exerting(is_moment: bool) -> [Vec<&'static str>; 2] {
        let kinds = || Self::all().into_iter().zip(Self::EXERTS);
        let always = |exerts: Exerts| match exerts {
            Exerts::Force => !is_moment,
            Exerts::ForceAndMoment => true,
            Exerts::Nothing | Exerts::ByCoordinate => false,
        };
        let named = |is_meant: &dyn Fn(Exerts) -> bool| {
            let kinds = kinds().filter(|(_, exerts)| is_meant(**exerts));
            kinds.map(|(kind, _)| kind.name).collect()
        };
        [
            named(&always),
            named(&|exerts| exerts == Exerts::ByCoordinate),
        ]
    }
}

impl<'a> ResolvedLoadKind<'a> {
    /// The marker that a force or moment acts on that outputs read; none of a contact of a body.
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

    /// Resolves the loads.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    pub(super) fn resolve_loads(&mut self) -> Result<(), Error> {
        for (index, load) in self.scene.loads.iter().enumerate() {
            let resolved = load.resolve(&format!("loads[{index}]"), self)?;
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

//! The one choice between the plane and space: everything below it is compiled for both.

use super::engine::{Engine, InitialWarnings, OperatingPoint};
use super::inputs::Inputs;
use super::watch::Doubtful;
use super::{
    Error, NoPropeller, OverDeformed, Pose, Quantity, RedundantNames, Report, Singular, Spectra,
    StepFailure, Unresolved, Variable,
};
use crate::scene::{Error as SceneError, LoadId, Resolved, Scene};
use crate::system::{Mode, State};

/// Statistics of a step, and its failure.
type Stepped = (Report, Result<(), StepFailure>);
/// Points along every body.
type Outlines = Vec<Vec<[f64; 3]>>;

/// An engine of the plane or of space.
pub(super) enum AnyEngine {
    Plane(Box<Engine<2>>),
    Space(Box<Engine<3>>),
}

/// Hands calls on to the engine that there is.
macro_rules! handed_on {
    ($(fn $name:ident([$($by:tt)+] $self:ident $(, $argument:ident: $kind:ty)*) $(-> $out:ty)?;)*) => {
        impl AnyEngine {$(
            #[inline(always)]
            pub(super) fn $name($($by)+ $self $(, $argument: $kind)*) $(-> $out)? {
                match $self {
                    Self::Plane(engine) => engine.$name($($argument),*),
                    Self::Space(engine) => engine.$name($($argument),*),
                }
            }
        )*}
    };
}

handed_on! {
    fn initial_state([&mut] self, time: f64, inputs: &Inputs) -> Result<(State, Spectra), Error>;
    fn modes([&mut] self, state: &State, inputs: &[f64], count: usize) -> Result<Vec<Mode>, String>;
    fn lowest_frequencies([&mut] self, state: &State, inputs: &[f64], count: usize) -> Result<Vec<f64>, String>;
    fn damping_along([&mut] self, state: &State, inputs: &[f64], ways: &[Vec<f64>]) -> Vec<f64>;
    fn way_to_rest([&mut] self, at: OperatingPoint<'_>) -> Option<f64>;
    fn slow_response([&mut] self, at: OperatingPoint<'_>, place: usize, of: &[Option<Quantity>]) -> Option<Vec<f64>>;
    fn remarks([&] self) -> &InitialWarnings;
    fn redundant([&mut] self, state: &State) -> RedundantNames;
    fn step([&mut] self, state: &mut State, inputs: &mut Inputs, until: f64) -> Stepped;
    fn limit_work([&mut] self, most: f64);
    fn size([&] self) -> f64;
    fn natural([&] self, quantity: Quantity) -> Option<f64>;
    fn next_doubtful([&mut] self) -> Option<Doubtful>;
    fn doubtful([&] self) -> Vec<Doubtful>;
    fn next_singular([&mut] self) -> Option<Singular>;
    fn next_unresolved([&mut] self) -> Option<Unresolved<'_>>;
    fn next_without_propeller([&mut] self) -> Option<NoPropeller<'_>>;
    fn next_over_deformed([&mut] self) -> Option<OverDeformed<'_>>;
    fn fits([&] self, state: &State) -> bool;
    fn forget([&mut] self);
    fn inputs_changed([&mut] self, inputs: &Inputs);
    fn output([&mut] self, quantity: Quantity, state: &State, inputs: &Inputs) -> f64;
    fn derivative([&mut] self, of: Quantity, order: usize, state: &State, inputs: &Inputs) -> f64;
    fn differentiate([&mut] self, state: &State, inputs: &Inputs, direction: &[f64]);
    fn change([&mut] self, quantity: Quantity, state: &State) -> f64;
    fn markers([&mut] self, state: &State, inputs: &Inputs) -> Vec<[f64; 3]>;
    fn outlines([&mut] self, state: &State, inputs: &Inputs, parts: &dyn Fn(usize) -> u32) -> Outlines;
    fn drawn_outlines([&] self, parts: &dyn Fn(usize) -> u32) -> Outlines;
    fn drawn([&] self, quantity: Quantity) -> f64;
    fn contact([&mut] self, load: LoadId, at: &[f64], state: &State, inputs: &Inputs) -> Vec<[f64; 3]>;
    fn elastic_displacements([&mut] self, state: &State, inputs: &Inputs) -> Vec<f64>;
    fn missed_by_patches([&mut] self, state: &State, inputs: &Inputs) -> Vec<(usize, [f64; 2])>;
    fn poses([&mut] self, state: &State, inputs: &Inputs) -> Vec<Pose>;
    fn drawn_poses([&] self) -> Vec<Pose>;
    fn section_forces([&mut] self, state: &State, inputs: &Inputs) -> Vec<Vec<[f64; 3]>>;
    fn face_stresses([&mut] self, state: &State, inputs: &Inputs) -> Vec<Vec<[f64; 6]>>;
}

impl AnyEngine {
    /// Builds the system of a scene.
    ///
    /// # Errors
    /// As [`Resolved::assemble`], and an integrator that cannot take the system.
    pub(super) fn new(resolved: &Resolved<'_>, variables: &[Variable]) -> Result<Self, Error> {
        Ok(match resolved.scene.dimension {
            2 => Self::Plane(Box::new(Engine::new(resolved, variables)?)),
            _ => Self::Space(Box::new(Engine::new(resolved, variables)?)),
        })
    }
}

/// Whether a scene makes a system.
///
/// # Errors
/// As [`Resolved::assemble`], and when it is not valid.
pub fn check(scene: &Scene) -> Result<(), SceneError> {
    let resolved = scene.resolve()?;
    match scene.dimension {
        2 => resolved.assemble::<2>().map(drop),
        _ => resolved.assemble::<3>().map(drop),
    }
}

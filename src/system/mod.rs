//! Floor 3. A system: bodies, joints, motions and loads, constant after assembly; its state, plain
//! numbers; and scratch. `System` computes with `State` and `Workspace` and keeps nothing of its own.

mod attitude;
mod build;
mod coordinate;
mod direction;
mod end;
mod gradient;
mod instant;
pub mod joints;
pub mod loads;
mod motion;
mod outputs;
mod signal;
mod spectra;
mod start;
mod state;
mod workspace;

pub use attitude::Attitude;
pub use build::{BuildError, Parts};
pub use coordinate::{Coordinate, Translation};
pub use direction::{AxisRotation, Direction};
pub use end::{Angle, Attachment, reach};
pub use gradient::Gradient;
pub use instant::Instant;
pub use motion::dynamics::{DrivenSystem, Dynamics, StepOutcome};
pub use motion::multipliers::ConstraintRow;
pub use motion::rank::{HoldingParts, Redundant};
pub use outputs::derivatives::Derivatives;
pub use outputs::evaluation::Evaluation;
pub use outputs::gauge::{Gauge, von_mises};
pub use outputs::stress::StressPoint;
pub use outputs::surface::StressLayer;
pub use signal::{Drive, FrictionState, InputSignal, Signal, Trajectory, moved};
pub use spectra::fastest::fastest;
pub use spectra::modes::{Mode, damping_along, modes};
pub use spectra::response::slow_response;
pub use spectra::spectrum::{
    Eigenvalue, SpectrumError, eigenvalues, linearized, natural_frequencies,
};
pub use start::equilibrium;
pub use start::placement::{Gap, NotAssembled};
pub use start::steady::{NotSteady, Steady};
pub use state::{DenseStep, MethodStatistics, State};
pub use workspace::{Kinematics, Workspace};

use crate::math::rotation::NO_ROTATION;
use crate::math::space::Vector;

use crate::bodies::{Bodies, Elimination, Node};
pub use joints::Release;
use joints::friction::FrictionPlace;
pub use joints::latch::Event;
use joints::latch::LatchPlace;
use joints::{Constraint, JointEquations, Linear};
use loads::{AppliedLoad, ForceElement as _};
use motion::prices::Prices;
use motion::sticking::StickPlace;
use motion::tree::Tree;

/// Everything about a system that does not change in time.
#[derive(Clone, Debug)]
pub struct System<const D: usize = 2> {
    bodies: Bodies<D>,
    /// Distance that the system reaches where rigid bodies rotate in space, m.
    reach: f64,
    elimination: Elimination<D>,
    joints: Vec<JointEquations<D>>,
    linear: Vec<Linear<D>>,
    /// For every linear row, its cluster and place there, unless it repeats others.
    holds: Vec<Option<(usize, usize)>>,
    driven: Vec<DrivenRow<D>>,
    /// Non-linear constraints.
    constraints: Vec<Constraint<D>>,
    /// Constraints that no free coordinate can violate, though a motion might.
    settled: Vec<Constraint<D>>,
    /// Non-linear form of the section clamps that `linear` eliminates. Only placement at the start uses it.
    clamped: Vec<Constraint<D>>,
    /// For each of them its multiplier, as the assembly counts them.
    multipliers: Vec<usize>,
    /// The tree that they make of rigid bodies in space, where they do.
    tree: Option<Tree<D>>,
    /// Joints with a row that repeats others.
    redundant: Vec<usize>,
    drives: Vec<Drive>,
    loads: Vec<AppliedLoad<D>>,
    /// Loads that act only where the initial state is looked for.
    initial_loads: Vec<AppliedLoad<D>>,
    angles: Vec<Angle<D>>,
    /// Releases of joints, latches and frictions.
    releases: Vec<Release>,
    /// Latches.
    latches: Vec<LatchPlace>,
    /// Frictions of joints.
    frictions: Vec<FrictionPlace>,
    /// Points of contacts that may stick.
    sticking: Vec<StickPlace>,
    /// For every slide, its constraint.
    slides: Vec<usize>,
    gravity: Vector<D>,
    /// Forces of gravity on the nodes, N.
    weight: Vec<Node<D>>,
    /// Angular velocity of the frame about its origin, rad/s; in the plane the third component alone.
    rotation: [f64; 3],
    is_damped: bool,
    /// Whether anything reads rates besides damping.
    needs_rates: bool,
    /// Whether work is integrated.
    tracks_work: bool,
    /// Whether functions of time move or load it.
    is_driven_by_time: bool,
    /// Whether a function of time may have a kink or a jump.
    has_breaks: bool,
    grounded: Vec<usize>,
    /// What operations cost in accelerations.
    prices: Prices,
    /// For every node, whether something besides the cable may exert a moment there.
    takes_moments: Vec<bool>,
}

/// How the nodes follow a row of `Phi` that changes in time.
#[derive(Clone, Debug)]
struct DrivenRow<const D: usize> {
    /// Index among the linear rows.
    row: usize,
    /// Value in the reference configuration.
    reference: f64,
    /// Nodal coordinates per unit.
    follow: Vec<(usize, Node<D>)>,
    /// Mass times them.
    inertia: Vec<(usize, Node<D>)>,
}

impl<const D: usize> System<D> {
    /// Root of the mass times the size of the system, m sqrt(kg): what errors of `q` are measured by.
    pub fn scale(&self) -> f64 {
        self.mass().sqrt() * self.size()
    }

    /// Size: the length of the longest cable or rod, or the largest distance of two nodes if that is more, m. Where rigid
    /// bodies rotate in space: how far the system reaches.
    pub fn size(&self) -> f64 {
        self.bodies.size(self.reach)
    }

    /// Number of independent coordinates `q`.
    pub fn coordinates(&self) -> usize {
        self.elimination.coordinates()
    }

    /// Bodies and their nodes.
    pub fn bodies(&self) -> &Bodies<D> {
        &self.bodies
    }

    /// The transformation from `q` to the nodes.
    pub fn elimination(&self) -> &Elimination<D> {
        &self.elimination
    }

    /// Joints, then motions.
    pub fn joints(&self) -> &[JointEquations<D>] {
        &self.joints
    }

    /// Joints that hold, at least in part, what others hold already.
    pub fn redundant(&self) -> &[usize] {
        &self.redundant
    }

    /// Returns the cost of an evaluation as a number of parts: elements, lumped masses and constraints. The rest of an
    /// evaluation counts as four elements.
    pub fn parts(&self) -> usize {
        4 + self.bodies.cost_units() + self.constraints.len()
    }

    /// Price of an implicit step over that along a chain of elements.
    pub fn implicit_price(&self) -> f64 {
        self.prices.beside_chain()
    }

    /// Whether the frame rotates that the scene is described in.
    pub(in crate::system) fn is_rotating(&self) -> bool {
        self.rotation != [0.0; 3]
    }

    /// Number of non-linear constraints.
    pub fn constraints(&self) -> usize {
        self.constraints.len()
    }

    /// Gravitational acceleration, m/s^2.
    pub fn gravity(&self) -> Vector<D> {
        self.gravity
    }

    /// Whether accelerations, or the work that is counted, depend on rates: by damping, by multipliers of
    /// non-linear constraints, in a rotating frame, by loads that read them. Methods for
    /// `q'' = a(t, q)` are for systems where they do not.
    pub fn reads_rates(&self) -> bool {
        self.is_damped || self.needs_rates
    }

    /// Whether forces have kinks at times that the state decides: error estimates of explicit methods may miss them.
    pub fn has_contacts(&self) -> bool {
        self.loads.iter().any(AppliedLoad::has_contact)
    }

    /// Whether a body is wound around a surface that rubs.
    pub fn has_belt_friction(&self) -> bool {
        self.loads.iter().any(AppliedLoad::has_belt_friction)
    }

    /// Whether states are brought back to constraints after each step.
    pub fn is_projected(&self) -> bool {
        !self.constraints.is_empty() || !self.settled.is_empty()
    }

    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        self.bodies.mass()
    }

    /// A state with the sizes of this system: the reference configuration at rest.
    pub fn blank_state(&self, time: f64) -> State {
        let n = self.coordinates();
        State {
            time,
            step: 0.0,
            pace: MethodStatistics::default(),
            coordinates: vec![0.0; n],
            rates: vec![0.0; n],
            frames: vec![NO_ROTATION; self.bodies.frame_count()],
            angles: vec![0.0; self.angles.len()],
            travel: vec![0.0; self.slides.len()],
            released: self
                .starts_released()
                .map(|is| f64::from(u8::from(is)))
                .collect(),
            driven: vec![[0.0; 5]; self.trajectories().count()],
            work: [0.0; 2],
            dense: DenseStep::blank(n),
        }
    }

    /// Lists what prescribes every driven coordinate that follows no function of time.
    fn trajectories(&self) -> impl Iterator<Item = InputSignal> {
        self.drives.iter().filter_map(InputSignal::of)
    }

    /// Whether a state has the sizes of this system.
    pub fn fits(&self, state: &State) -> bool {
        state.sizes() == self.blank_state(0.0).sizes()
    }
}

//! Scratch of a system: nothing allocates in a step.

use super::joints::Release;
use super::joints::friction::FrictionChange;
use super::joints::latch::HeldMotion;
use super::loads::{Grip, StickMotion};
use super::motion::rank::RankWatch;
use super::motion::tree::Tree;
use super::signal::Trajectory;
use super::{State, System};
use crate::bodies::{
    Articulated, Jacobian, NodalMotion, Node, Rotations, STAGES, Tangent, no_node,
};
use crate::math::jet::Number;
use crate::math::recent::Recent;
use crate::math::rotation::{NO_ROTATION, Quaternion};

/// Scratch of all stages of an evaluation, and the parts of a state that are needed beside `q`.
#[derive(Clone, Debug)]
pub struct Workspace<const D: usize = 2> {
    /// Configuration: computed first, and read by all other stages.
    pub kinematics: Kinematics<D>,
    /// Forces over the nodes at that configuration.
    pub forces: NodalForces<D>,
    /// Jacobian and multipliers of the non-linear constraints.
    pub(super) constraints: Constraints<D>,
    /// Tangent of an implicit method.
    pub(super) linearization: Linearized<D>,
    /// Vectors that no stage keeps.
    pub(super) scratch: Scratch<D>,
    /// Accelerations of `q` at the last evaluation, of rotations about axes that rotate along, `[coordinates]`.
    pub(super) acceleration: Vec<f64>,
    /// A change of `q` that no stage keeps, `[coordinates]`.
    pub(super) change: Vec<f64>,
    /// The state accepted last, to go back to from a step that leaves a cable or passes a latch.
    pub(super) before: State,
    /// Motions of latches over the last step, `[latches]`.
    pub(super) latches: Vec<LatchWatch>,
    /// Motions of frictions over the last step, `[frictions]`.
    pub(super) frictions: Vec<FrictionWatch>,
    /// Points of contacts that may stick over the last step, `[sticking]`.
    pub(super) sticking: Vec<StickWatch<D>>,
}

/// A latch before and after a step, and whether it is to close or to open.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LatchWatch {
    pub motions: [HeldMotion; 2],
    pub is_due: bool,
}

/// Friction before and after a step, and what it is to change to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FrictionWatch {
    pub motions: [HeldMotion; 2],
    /// Largest force while it sticks, N or N m.
    pub limits: [f64; 2],
    /// Coordinate where it was measured last, m or rad.
    pub value: f64,
    pub change: Option<FrictionChange>,
}

/// A point of a contact before and after a step, and what it is to change to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StickWatch<const D: usize> {
    pub motions: [StickMotion<D>; 2],
    /// Where it was measured last.
    pub now: StickMotion<D>,
    pub change: Option<Grip>,
}

/// Configuration and rates of a system; the first part is what they follow from. [`System::forward_kinematics`] and
/// [`System::rate_kinematics`] compute it.
#[derive(Clone, Debug)]
pub struct Kinematics<const D: usize = 2> {
    /// Inputs and their rates at the time of the last configuration, `[inputs]`.
    pub(super) inputs: Vec<f64>,
    pub(super) input_rates: Vec<f64>,
    /// First and last time at which functions of time are taken in the smooth interval under way, s.
    pub(super) smooth_interval: Option<[f64; 2]>,
    /// Trajectories of driven coordinates that inputs set.
    pub(super) trajectories: Vec<Trajectory>,
    /// Last value of the function of time of each drive, `[drives]`.
    pub(super) recent: Vec<Recent>,
    /// Releases of joints and whether they have happened, `[releases]`.
    pub(super) releases: Vec<Release>,
    pub(super) released: Vec<bool>,
    /// Frames from which rotations are counted, `[frames]`.
    pub(super) frames: Vec<Quaternion>,
    /// Driven coordinates with two derivatives, `[drives][3]`.
    pub drives: Vec<[f64; 3]>,
    /// Target values of driven rows with two time derivatives, `[rows][3]`.
    pub(super) targets: Vec<[f64; 3]>,
    /// Nodal coordinates, `[nodes]`, m.
    pub x: Vec<Node<D>>,
    /// Rates of the nodal coordinates, `[nodes]`.
    pub v: Vec<Node<D>>,
    /// Rotations of bodies and sections from these frames.
    pub(super) rotations: Rotations,
    /// Counted angles, `[angles]`, rad. Each search for one begins at its last value.
    pub(super) angles: Vec<f64>,
    /// Lengths along cables at which slides are, `[slides]`, m. Each search for one begins at its last value.
    pub(super) travel: Vec<f64>,
}

/// Forces over the nodes. [`System::forces`] computes the first part, an acceleration the rest.
#[derive(Clone, Debug)]
pub struct NodalForces<const D: usize = 2> {
    /// Forces on the nodal coordinates but those of constraints, `[nodes]`, N.
    pub f: Vec<Node<D>>,
    /// Moments of rods on their sections about the tangents, or of beams along the section axes, `[sections][3]`, N m.
    pub(super) torques: Vec<[f64; 3]>,
    /// Power that damping of lines dissipates, W.
    pub(super) dissipated: f64,
    /// Forces of linear constraints over the nodes, `[nodes]`, N; while a tangent is assembled those of all other constraints and loads.
    pub(super) linear_constraint_forces: Vec<Node<D>>,
}

/// Matrices and multipliers of the non-linear constraints. An acceleration computes them.
#[derive(Clone, Debug)]
pub(super) struct Constraints<const D: usize> {
    /// Jacobian over the free coordinates, and the configuration for which it was computed.
    pub jacobian: Jacobian,
    jacobian_at: Configuration<D>,
    /// Right-hand side of the constraints, then multipliers of the last acceleration, `[constraints]`.
    pub right: Vec<f64>,
    pub lambda: Vec<f64>,
    /// Constraints that did not count at states that were accepted.
    pub rank: RankWatch,
    /// Factors of the tree that constraints make, the configuration for which they were computed, and whether they could be.
    pub articulated: Articulated,
    tree_at: Configuration<D>,
    pub is_tree: bool,
    /// Whether the last acceleration was found with these factors, without multipliers.
    pub is_without_multipliers: bool,
}

/// Tangent of an implicit method. [`System::assemble`] computes it.
#[derive(Clone, Debug)]
pub(super) struct Linearized<const D: usize> {
    /// Stiffness and damping over the free coordinates, and their factors.
    pub tangent: Tangent<D>,
    /// Nodal coordinates from which the tangent predicts stresses, and whether it does, `[nodes]`.
    pub from: Vec<Node<D>>,
    pub predicts: bool,
    /// Rotations of bodies and sections where the tangent was computed, then with the shear rotations of each stage.
    pub stages: [Rotations; 1 + STAGES],
}

/// Vectors that no stage keeps.
#[derive(Clone, Debug)]
pub(super) struct Scratch<const D: usize> {
    /// Free coordinates, `[free]`.
    pub y: Vec<f64>,
    /// Nodal accelerations or another nodal vector, `[nodes]`.
    pub other: Vec<Node<D>>,
}

/// Arguments of constraints other than rates.
#[derive(Clone, Debug)]
struct Configuration<const D: usize> {
    x: Vec<Node<D>>,
    drives: Vec<[f64; 3]>,
    travel: Vec<f64>,
    released: Vec<bool>,
}

impl<const D: usize> Configuration<D> {
    /// Before the first one.
    fn none(system: &System<D>) -> Self {
        Self {
            x: vec![[[f64::NAN; D]; 2]; system.bodies.reference.len()],
            drives: vec![[0.0; 3]; system.drives.len()],
            travel: vec![0.0; system.slides.len()],
            released: vec![false; system.releases.len()],
        }
    }

    /// Whether it is not this one; from now on it is.
    #[inline(always)]
    fn is_outdated(&mut self, now: &Kinematics<D>) -> bool {
        let same = self.x == now.x && self.drives == now.drives && self.travel == now.travel;
        if same && self.released == now.released {
            return false;
        }
        self.released.copy_from_slice(&now.released);
        self.x.copy_from_slice(&now.x);
        self.drives.copy_from_slice(&now.drives);
        self.travel.copy_from_slice(&now.travel);
        true
    }
}

impl<const D: usize> Constraints<D> {
    /// Tells whether the Jacobian is outdated for a configuration, and marks it as current.
    pub fn outdates_jacobian(&mut self, now: &Kinematics<D>) -> bool {
        self.jacobian_at.is_outdated(now)
    }

    /// Tells whether the factors of the tree are outdated for a configuration, and marks them as current.
    pub fn outdates_tree(&mut self, now: &Kinematics<D>) -> bool {
        self.tree_at.is_outdated(now)
    }
}

impl<const D: usize> Workspace<D> {
    /// For a system.
    pub fn new(system: &System<D>) -> Self {
        let nodes = vec![no_node(); system.bodies.reference.len()];
        let rotating = system.bodies.rotating_nodes();
        let is_linear = |row: usize| system.constraints[row].is_linear();
        let (elimination, multipliers) = (&system.elimination, &system.multipliers);
        let jacobian = Jacobian::new(elimination, multipliers, system.evenness(), is_linear);
        let tangent = Tangent::new(
            &system.elimination,
            system.is_damped,
            &jacobian,
            &system.grounded,
            &rotating,
        );
        let lambda = vec![0.0; system.constraints.len()];
        let kinematics = Kinematics::new(system);
        Self {
            linearization: Linearized {
                tangent,
                from: nodes.clone(),
                predicts: false,
                stages: std::array::from_fn(|_| kinematics.rotations.clone()),
            },
            forces: NodalForces {
                f: nodes.clone(),
                torques: vec![[0.0; 3]; system.bodies.moments()],
                dissipated: 0.0,
                linear_constraint_forces: nodes.clone(),
            },
            kinematics,
            constraints: Constraints {
                jacobian,
                jacobian_at: Configuration::none(system),
                right: lambda.clone(),
                rank: RankWatch::new(lambda.len(), system.coordinates()),
                lambda,
                articulated: (system.tree.as_ref())
                    .map_or_else(Articulated::default, Tree::scratch),
                tree_at: Configuration::none(system),
                is_tree: false,
                is_without_multipliers: false,
            },
            scratch: Scratch {
                y: vec![0.0; system.elimination.scratch()],
                other: nodes,
            },
            acceleration: vec![0.0; system.coordinates()],
            change: vec![0.0; system.coordinates()],
            before: system.blank_state(0.0),
            latches: vec![LatchWatch::default(); system.latches.len()],
            frictions: vec![FrictionWatch::default(); system.frictions.len()],
            sticking: vec![StickWatch::default(); system.sticking.len()],
        }
    }

    /// Begins a motion: nothing has been said of its constraints.
    pub fn begin(&mut self) {
        let constraints = &mut self.constraints;
        constraints.rank = RankWatch::new(constraints.lambda.len(), self.acceleration.len());
    }

    /// Takes over the parts of a state that are needed beside `q`; motions that inputs drive stand as they are.
    pub fn resume(&mut self, state: &State) {
        let kinematics = &mut self.kinematics;
        kinematics.frames.copy_from_slice(&state.frames);
        kinematics.angles.copy_from_slice(&state.angles);
        kinematics.travel.copy_from_slice(&state.travel);
        kinematics.release(state);
        for (course, driven) in kinematics.trajectories.iter_mut().zip(&state.driven) {
            let [p, v, a, ..] = *driven;
            *course = Trajectory::hold(state.time, [p, v, a]);
        }
    }
}

/// Inputs, driven coordinates and angles as numbers of another kind that stand still.
pub(super) struct Frozen<N> {
    /// Inputs and their rates, `[inputs]`.
    pub inputs: Vec<N>,
    pub input_rates: Vec<N>,
    /// Driven coordinates with two derivatives, `[drives][3]`.
    pub drives: Vec<[N; 3]>,
    /// Counted angles, `[angles]`, rad.
    pub angles: Vec<N>,
}

impl<const D: usize> Kinematics<D> {
    /// Configuration and rates as bodies see them.
    #[inline(always)]
    pub(super) fn motion(&self) -> NodalMotion<'_, D> {
        NodalMotion {
            drives: &self.drives,
            x: &self.x,
            v: &self.v,
            from: None,
        }
    }

    /// Converts what stands beside nodal coordinates and rates to constants of another kind of number.
    pub(super) fn frozen<N: Number>(&self) -> Frozen<N> {
        let lift = |x: &[f64]| x.iter().copied().map(N::of).collect();
        Frozen {
            inputs: lift(&self.inputs),
            input_rates: lift(&self.input_rates),
            drives: self.drives.iter().map(|drive| drive.map(N::of)).collect(),
            angles: lift(&self.angles),
        }
    }

    fn new(system: &System<D>) -> Self {
        let nodes = vec![no_node(); system.bodies.reference.len()];
        Self {
            inputs: Vec::new(),
            input_rates: Vec::new(),
            smooth_interval: None,
            trajectories: vec![Trajectory::default(); system.trajectories().count()],
            recent: vec![Recent::default(); system.drives.len()],
            releases: system.releases.clone(),
            released: system.starts_released().collect(),
            frames: vec![NO_ROTATION; system.bodies.frame_count()],
            drives: vec![[0.0; 3]; system.drives.len()],
            targets: vec![[0.0; 3]; system.driven.len()],
            x: nodes.clone(),
            v: nodes,
            rotations: Rotations::of(&system.bodies),
            angles: vec![0.0; system.angles.len()],
            travel: vec![0.0; system.slides.len()],
        }
    }
}

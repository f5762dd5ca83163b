//! Scratch of a system: nothing allocates in a step.

use super::joints::Release;
use super::motion::rank::RankWatch;
use super::motion::tree::Tree;
use super::signal::Trajectory;
use super::{State, System};
use crate::body::{
    Articulated, Jacobian, Node, RotationIncrement, STAGES, SectionFrameState, Tangent, no_node,
};
use crate::math::recent::Recent;
use crate::math::rotation::{NO_TURN, Quaternion};

/// Scratch, and what of a state is needed beside `q`: hints where to look for angles and slides.
#[derive(Clone, Debug)]
pub struct Workspace<const D: usize = 2> {
    /// Nodal coordinates, m.
    pub x: Vec<Node<D>>,
    /// Rates of the nodal coordinates.
    pub v: Vec<Node<D>>,
    /// Forces on them, N.
    pub f: Vec<Node<D>>,
    /// Nodal accelerations, or another nodal vector; forces that linear constraints supply.
    pub(super) other: Vec<Node<D>>,
    pub(super) linear_constraint_forces: Vec<Node<D>>,
    /// A vector of free coordinates.
    pub(super) y: Vec<f64>,
    /// Accelerations.
    pub(super) a: Vec<f64>,
    /// Driven coordinates with two derivatives, and the trajectories of those that inputs drive.
    pub(super) drives: Vec<[f64; 3]>,
    pub(super) trajectories: Vec<Trajectory>,
    /// For every drive, what the function of time that it is gave last.
    pub(super) recent: Vec<Recent>,
    /// Target values of driven rows with two time derivatives, `[rows][3]`.
    pub(super) targets: Vec<[f64; 3]>,
    /// First and last time at which functions of time are taken in the smooth interval under way.
    pub(super) smooth_interval: Option<[f64; 2]>,
    /// Inputs and their rates at the time of the last configuration.
    pub(super) inputs: Vec<f64>,
    pub(super) input_rates: Vec<f64>,
    pub(super) angles: Vec<f64>,
    pub(super) travel: Vec<f64>,
    /// Releases of joints, and which of them have happened.
    pub(super) releases: Vec<Release>,
    pub(super) released: Vec<bool>,
    /// Frames that rotations are counted from, and how bodies have turned from there.
    pub(super) frames: Vec<Quaternion>,
    pub(super) turns: Vec<RotationIncrement>,
    /// States of the section frames of rods and beams.
    pub(super) carries: Vec<SectionFrameState>,
    /// Both where the tangent was made, and of frames with a shear rotation at the stages of an implicit method too.
    pub(super) base_turns: Vec<RotationIncrement>,
    pub(super) stages: [Vec<SectionFrameState>; 1 + STAGES],
    /// Moments of rods on their sections, about the tangents, or of beams along the axes, N m.
    pub(super) torques: Vec<[f64; 3]>,
    /// The state accepted last, to go back to from a step that leaves a cable.
    pub(super) before: State,
    /// Jacobian of the non-linear constraints, what it was made from, and their multipliers at the last acceleration.
    pub(super) jacobian: Jacobian,
    pub(super) jacobian_at: Configuration<D>,
    pub(super) lambda: Vec<f64>,
    /// Constraints that did not count at states that were accepted.
    pub(super) rank: RankWatch,
    /// Factors of the tree that constraints make, what they were made from, and whether they could be.
    pub(super) articulated: Articulated,
    tree_at: Configuration<D>,
    pub(super) is_tree: bool,
    /// Whether the last acceleration was found with these, without multipliers.
    pub(super) is_without_multipliers: bool,
    /// Right-hand side of constraints.
    pub(super) right: Vec<f64>,
    pub(super) tangent: Tangent<D>,
    /// Power that comes in and that is dissipated at the last acceleration, W; what of the latter cables take out.
    pub(super) power: [f64; 2],
    pub(super) dissipated: f64,
}

/// Arguments of constraints other than rates.
#[derive(Clone, Debug)]
pub(super) struct Configuration<const D: usize> {
    x: Vec<Node<D>>,
    drives: Vec<[f64; 3]>,
    travel: Vec<f64>,
    released: Vec<bool>,
}

impl<const D: usize> Configuration<D> {
    /// Before the first one.
    fn none(system: &System<D>) -> Self {
        Self {
            x: vec![[[f64::NAN; D]; 2]; system.reference.len()],
            drives: vec![[0.0; 3]; system.drives.len()],
            travel: vec![0.0; system.slides.len()],
            released: vec![false; system.releases.len()],
        }
    }

    /// Whether it is not this one; from now on it is.
    #[inline(always)]
    fn is_outdated(
        &mut self,
        x: &[Node<D>],
        drives: &[[f64; 3]],
        (travel, released): (&[f64], &[bool]),
    ) -> bool {
        let same = self.x == x && self.drives == drives && self.travel == travel;
        if same && self.released == released {
            return false;
        }
        self.released.copy_from_slice(released);
        self.x.copy_from_slice(x);
        self.drives.copy_from_slice(drives);
        self.travel.copy_from_slice(travel);
        true
    }
}

impl<const D: usize> Workspace<D> {
    /// Whether the Jacobian is not that of the configuration in place; from now on it is.
    pub(super) fn outdates_jacobian(&mut self) -> bool {
        let held = (&self.travel[..], &self.released[..]);
        (self.jacobian_at).is_outdated(&self.x, &self.drives, held)
    }

    /// Tells whether the factors of the tree are outdated for the configuration in place, and marks them as current.
    pub(super) fn outdates_tree(&mut self) -> bool {
        let held = (&self.travel[..], &self.released[..]);
        (self.tree_at).is_outdated(&self.x, &self.drives, held)
    }

    /// For a system.
    pub fn new(system: &System<D>) -> Self {
        let nodes = vec![no_node(); system.reference.len()];
        let ([elastic, still], sections) = moving(system);
        let is_linear = |row: usize| system.constraints[row].is_linear();
        let (elimination, multipliers) = (&system.elimination, &system.multipliers);
        let jacobian = Jacobian::new(elimination, multipliers, system.evenness(), is_linear);
        let lambda = vec![0.0; system.constraints.len()];
        let rank = RankWatch::new(lambda.len(), system.coordinates());
        let turns = vec![RotationIncrement::default(); system.frames.list().len()];
        let carries = vec![SectionFrameState::default(); system.frames.carried().len()];
        Self {
            x: nodes.clone(),
            v: nodes.clone(),
            f: nodes.clone(),
            other: nodes.clone(),
            linear_constraint_forces: nodes,
            y: vec![0.0; system.elimination.scratch()],
            a: vec![0.0; system.coordinates()],
            drives: vec![[0.0; 3]; system.drives.len()],
            targets: vec![[0.0; 3]; system.driven.len()],
            trajectories: vec![Trajectory::default(); system.trajectories().count()],
            recent: vec![Recent::default(); system.drives.len()],
            smooth_interval: None,
            inputs: Vec::new(),
            input_rates: Vec::new(),
            angles: vec![0.0; system.angles.len()],
            travel: vec![0.0; system.slides.len()],
            released: vec![false; system.releases.len()],
            releases: system.releases.clone(),
            frames: vec![NO_TURN; system.frames.count()],
            base_turns: turns.clone(),
            turns,
            stages: std::array::from_fn(|_| carries.clone()),
            carries,
            torques: vec![[0.0; 3]; system.frames.carried().len()],
            before: system.blank_state(0.0),
            right: lambda.clone(),
            lambda,
            rank,
            tangent: Tangent::new(
                &system.elimination,
                system.is_damped,
                &jacobian,
                &system.grounded,
                ([&elastic, &still], &sections),
            ),
            jacobian,
            jacobian_at: Configuration::none(system),
            articulated: (system.tree.as_ref()).map_or_else(Articulated::default, Tree::scratch),
            tree_at: Configuration::none(system),
            is_tree: false,
            is_without_multipliers: false,
            power: [0.0; 2],
            dissipated: 0.0,
        }
    }

    /// Begins a motion: nothing has been said of its constraints.
    pub fn begin(&mut self) {
        self.rank = RankWatch::new(self.lambda.len(), self.a.len());
    }

    /// Takes over what of a state is needed beside `q`; motions that inputs drive stand as they are.
    pub fn resume(&mut self, state: &State) {
        if D > 2 {
            self.frames.copy_from_slice(&state.frames);
        }
        self.angles.copy_from_slice(&state.angles);
        self.travel.copy_from_slice(&state.travel);
        self.release(state);
        for (course, driven) in self.trajectories.iter_mut().zip(&state.driven) {
            let [p, v, a, ..] = *driven;
            *course = Trajectory::hold(state.time, [p, v, a]);
        }
    }
}

/// Which nodes turn with elastic lines and which of their own do not, and the nodes of lines with those of sections that they turn with.
fn moving<const D: usize>(system: &System<D>) -> ([Vec<bool>; 2], Vec<(usize, usize)>) {
    let mut elastic = vec![false; system.reference.len()];
    for chain in &system.chains {
        let first = chain.nodes(0)[0];
        elastic[first..first + chain.node_count()].fill(true);
    }
    let mut still = vec![false; elastic.len()];
    let mut sections = Vec::new();
    for chain in &system.rod_chains {
        if chain.has_shear() {
            // These turn with their sections; in the plane by directions, as cables do.
            sections.extend(chain.frames().map(|(frame, line)| (line, frame)));
            sections
                .iter()
                .for_each(|(line, _)| elastic[*line] &= D == 2);
        }
        let frames = chain.frames().map(|(node, _)| node);
        frames
            .chain(chain.axes_nodes())
            .chain(chain.inner())
            .for_each(|node| still[node] = true);
    }
    ([elastic, still], sections)
}

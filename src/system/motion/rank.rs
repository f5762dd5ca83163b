//! Constraints that do not count because others leave next to nothing of them: those that repeat others exactly, which does
//! no harm, and those that nearly do, without which accelerations and multipliers are found. The latter are looked
//! for at the start and at every state that a step is accepted at.

use super::multipliers::RANK;
use crate::bodies::{Jacobian, no_node};
use crate::math::sparse::{graph, parts};
use crate::math::vector::dot;
use crate::system::joints::{Constraint, ConstraintKind, Equation as _, Primitive};
use crate::system::{State, System, Workspace};

/// Part of a row of the Jacobian below which others give it exactly, but for the residuals of the state.
const EXACT: f64 = 1e-6;
/// Cosine of the angle between a velocity and what constraints take back of positions from which on it is blocked. In a motion that goes on
/// they are at right angles, but for its curvature.
const OPPOSED: f64 = 0.5;
/// Part of the way of a velocity since the last state from which on it counts as taken back: of one that has grown from zero all is half.
const TAKEN_BACK: f64 = 0.25;
/// Part of the largest change of a coordinate below which others are not counted as taken back.
const SMALL: f64 = 1e-3;

/// Joints, motions and ports by their index, and bodies that joints keep rigid.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HoldingParts {
    /// Joints, motions and ports.
    pub holders: Vec<usize>,
    /// Rigid bodies.
    pub bodies: Vec<usize>,
}

/// Constraints that others give.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Redundant {
    /// Exactly.
    pub exactly: HoldingParts,
    /// Nearly: accelerations and multipliers are found as if these were not there.
    pub nearly: HoldingParts,
}

/// Report state of a dependent constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ConstraintRemark {
    /// Nothing.
    None,
    /// The constraint is to be reported.
    Due,
    /// The constraint has been reported.
    Told,
}

/// Constraints that did not count at a state that was accepted, though they are not redundant.
#[derive(Clone, Debug)]
pub struct RankWatch {
    words: Vec<ConstraintRemark>,
    /// When the first of those that are to be told did not count, s.
    time: Option<f64>,
    /// Which constraints counted where most of them did, and how many.
    counted: Vec<bool>,
    most: usize,
    /// Scratch: a vector of free coordinates.
    rest: Vec<f64>,
    /// Free coordinates that a step came to, before they were brought onto the constraints.
    reached: Vec<f64>,
    /// When the last state was accepted, s.
    accepted: f64,
}

impl RankWatch {
    /// For so many constraints and coordinates.
    pub fn new(constraints: usize, coordinates: usize) -> Self {
        Self {
            words: vec![ConstraintRemark::None; constraints],
            time: None,
            counted: vec![false; constraints],
            most: 0,
            rest: vec![0.0; coordinates],
            reached: vec![0.0; coordinates],
            accepted: 0.0,
        }
    }

    /// Steps begin at a time, s.
    pub fn begin(&mut self, time: f64) {
        self.accepted = time;
    }

    /// A step came to coordinates that are not yet on the constraints.
    pub fn reach(&mut self, coordinates: &[f64]) {
        self.reached.copy_from_slice(coordinates);
    }

    /// Keeps which constraints count where most of them do, with those of released joints. Whether these are as many.
    fn keep(&mut self, jacobian: &Jacobian, released: usize) -> bool {
        let rank = jacobian.rank() + released;
        if rank > self.most {
            self.most = rank;
            let counted = self.counted.iter_mut().enumerate();
            counted.for_each(|(row, counted)| *counted = jacobian.is_independent(row));
        }
        rank == self.most
    }
}

impl<const D: usize> System<D> {
    /// How heavy the lightest body of each constraint is beside the heaviest one that constraints connect it with: the least inertia over
    /// the largest, of displacements or of directions, whichever differ more.
    pub(in crate::system) fn evenness(&self) -> Vec<f64> {
        let ends = |constraint: &Constraint<D>| {
            let ends = constraint.kind.ends().into_iter();
            let nodes: Vec<usize> = ends.filter_map(|end| end.nodes().next()).collect();
            nodes
        };
        let joined: Vec<Vec<usize>> = self.constraints.iter().map(ends).collect();
        let mut y = vec![0.0; self.elimination.scratch()];
        let mut mobilities = vec![None; self.bodies.reference.len()];
        for node in joined.iter().flatten() {
            mobilities[*node]
                .get_or_insert_with(|| [0, 1].map(|vector| self.mobility(*node, vector, &mut y)));
        }
        let mut evenness = vec![1.0_f64; joined.len()];
        let part = self.connected(&joined);
        for vector in 0..2 {
            let of = |node: &usize| mobilities[*node].expect("a joined node")[vector];
            let mut least = vec![f64::INFINITY; self.bodies.reference.len()];
            for node in joined.iter().flatten().filter(|node| of(node) > 0.0) {
                least[part[*node]] = least[part[*node]].min(of(node));
            }
            for (nodes, evenness) in joined.iter().zip(&mut evenness) {
                let largest = nodes.iter().map(of).fold(0.0, f64::max);
                if largest > 0.0 {
                    *evenness = evenness.min(least[part[nodes[0]]] / largest);
                }
            }
        }
        evenness
    }

    /// Returns the acceleration by a unit force on the position of a node (0), 1/kg, or by a unit moment on its
    /// direction (1), 1/(kg m^2).
    fn mobility(&self, node: usize, vector: usize, y: &mut [f64]) -> f64 {
        let mut unit = no_node();
        unit[vector][0] = 1.0;
        let moved = self.elimination.reduce_node(node, &unit, y);
        moved.iter().map(|(_, part)| part * part).sum()
    }

    /// For every node the part of the system that bodies and constraints, each with some nodes, connect it with.
    fn connected(&self, joined: &[Vec<usize>]) -> Vec<usize> {
        let of_bodies = self
            .bodies
            .ranges
            .iter()
            .flat_map(|body| body.clone().map(|node| (body.start, node)));
        let of_constraints = joined
            .iter()
            .flat_map(|nodes| nodes.iter().map(|node| (nodes[0], *node)));
        let edges: Vec<(usize, usize)> = of_bodies.chain(of_constraints).collect();
        let mut part = vec![0; self.bodies.reference.len()];
        for (index, nodes) in parts(&graph(&vec![1; part.len()], &edges))
            .iter()
            .enumerate()
        {
            nodes.iter().for_each(|node| part[*node] = index);
        }
        part
    }

    /// Looks for constraints that do not count at an accepted state, at the configuration in `work`. Those that others give
    /// exactly are none of them: where as many constraints count as anywhere, and others leave nothing of the rest.
    pub(in crate::system) fn watch_rank(&self, time: f64, work: &mut Workspace<D>) {
        if self.constraints.is_empty() || work.constraints.is_tree {
            return;
        }
        let released = self.released_rows(work);
        let (jacobian, watch) = (&mut work.constraints.jacobian, &mut work.constraints.rank);
        // As the next acceleration does.
        jacobian.factor(RANK);
        let is_most = watch.keep(jacobian, released);
        if jacobian.has_full_rank() {
            return;
        }
        for row in 0..self.constraints.len() {
            let is_released = self.constraints[row].is_released(&work.kinematics.released);
            let is_told =
                watch.words[row] != ConstraintRemark::None || jacobian.is_independent(row);
            if is_told || is_released {
                continue;
            }
            let is_near = !is_most && watch.counted[row]
                || jacobian.may_leave(row, EXACT)
                    && jacobian.part_left(row, &mut watch.rest) > EXACT;
            if is_near {
                watch.words[row] = ConstraintRemark::Due;
                watch.time.get_or_insert(time);
            }
        }
    }

    /// Takes out of the velocities of a state that was just accepted what leads where constraints do not let bodies go. At a dead point such a
    /// velocity satisfies all constraints to first order: it grows with the forces while positions are brought back after every
    /// step.
    pub(in crate::system) fn stop_blocked(&self, state: &mut State, work: &mut Workspace<D>) {
        let watch = &mut work.constraints.rank;
        let passed = state.time - watch.accepted;
        watch.accepted = state.time;
        if self.constraints.is_empty()
            || work.constraints.is_tree
            || work.constraints.jacobian.has_full_rank()
        {
            return;
        }
        let back = &mut watch.reached;
        let pairs = back.iter_mut().zip(&state.coordinates);
        pairs.for_each(|(back, on)| *back = on - *back);
        let largest = back
            .iter()
            .fold(0.0, |most: f64, back| most.max(back.abs()));
        let [mut square, mut along, mut speed] = [0.0; 3];
        let taken = back.iter().zip(&state.rates);
        for (back, v) in taken.filter(|(back, _)| back.abs() > SMALL * largest) {
            square += back * back;
            along += back * v;
            speed += v * v;
        }
        let is_opposed = along < -OPPOSED * (square * speed).sqrt();
        if passed <= 0.0 || !is_opposed || square < -TAKEN_BACK * passed * along {
            return;
        }
        let rates = state.rates.iter_mut().zip(&*back);
        rates.for_each(|(v, back)| *v -= along / square * back);
        self.project_velocities(&mut state.rates, work);
    }

    /// Reports the constraints that became dependent at accepted states since the last call, with the time of the
    /// first, s. Constraints that were reported before are left out.
    pub fn newly_singular(&self, work: &mut Workspace<D>) -> Option<(f64, HoldingParts)> {
        let watch = &mut work.constraints.rank;
        let time = watch.time.take()?;
        let words = &watch.words;
        let rows = |word: ConstraintRemark| (0..words.len()).filter(move |row| words[*row] == word);
        let mut due = self.holding(rows(ConstraintRemark::Due));
        let told = self.holding(rows(ConstraintRemark::Told));
        due.holders.retain(|holder| !told.holders.contains(holder));
        due.bodies.retain(|body| !told.bodies.contains(body));
        for word in &mut watch.words {
            if *word == ConstraintRemark::Due {
                *word = ConstraintRemark::Told;
            }
        }
        (!due.holders.is_empty() || !due.bodies.is_empty()).then_some((time, due))
    }

    /// Finds constraints that repeat others at a state, exactly or nearly, and bodies that joints keep rigid. Nearly
    /// redundant constraints are not reported again later.
    pub fn redundant_at(&self, state: &State, work: &mut Workspace<D>) -> Redundant {
        let dependent = self.dependent(RANK, state, work);
        let released = self.released_rows(work);
        work.constraints
            .rank
            .keep(&work.constraints.jacobian, released);
        let mut rest = vec![0.0; self.coordinates()];
        // What is left of rows, orthonormal: a row that others give together with one of these is none of them.
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let (mut exactly, mut nearly) = (Vec::new(), Vec::new());
        let is_held = |row: &usize| !self.constraints[*row].is_released(&work.kinematics.released);
        let dependent: Vec<usize> = dependent.into_iter().filter(is_held).collect();
        for row in dependent {
            let mut left = work.constraints.jacobian.part_left(row, &mut rest);
            for _ in 0..2 {
                for other in &basis {
                    let part = dot(other, &rest);
                    let pairs = rest.iter_mut().zip(other);
                    pairs.for_each(|(rest, other)| *rest -= part * other);
                    left = dot(&rest, &rest).sqrt();
                }
            }
            if left > EXACT {
                basis.push(rest.iter().map(|rest| rest / left).collect());
                work.constraints.rank.words[row] = ConstraintRemark::Told;
                nearly.push(row);
            } else {
                exactly.push(row);
            }
        }
        let (mut exactly, nearly) = (self.holding(exactly), self.holding(nearly));
        exactly.holders.extend(&self.redundant);
        exactly.holders.sort_unstable();
        exactly.holders.dedup();
        exactly.holders.retain(|h| !nearly.holders.contains(h));
        let aligned = self.aligned();
        exactly.bodies.retain(|body| {
            let is_aligned = self.bodies.ranges[*body].clone().any(|node| aligned[node]);
            !is_aligned && !nearly.bodies.contains(body)
        });
        Redundant { exactly, nearly }
    }

    /// By nodes, whether a joint in the plane gives one body the direction of another there: the unit length of one is then that of
    /// both, and nothing that a person has said is redundant.
    fn aligned(&self) -> Vec<bool> {
        let mut aligned = vec![false; self.bodies.reference.len()];
        let aligns = |held: &Primitive<D>| matches!(held, Primitive::Direction(_));
        let joints = self.joints.iter();
        let joints = joints.filter(|joint| joint.holds.iter().any(aligns));
        let ends = joints.flat_map(|joint| &joint.ends);
        ends.flat_map(|end| end.nodes())
            .for_each(|node| aligned[node] = true);
        aligned
    }

    /// Finds constraints that others imply at this state up to a relative remainder `part`, but not at every state.
    pub fn held_within(&self, part: f64, state: &State, work: &mut Workspace<D>) -> HoldingParts {
        let rows = self.dependent(part, state, work);
        let mut held = self.holding(rows);
        (held.holders).retain(|holder| !self.redundant.contains(holder));
        held
    }

    /// Constraints of which others leave less than a part.
    fn dependent(&self, part: f64, state: &State, work: &mut Workspace<D>) -> Vec<usize> {
        work.resume(state);
        self.forward_kinematics(state.time, &state.coordinates, None, work);
        self.jacobians(work);
        work.constraints.jacobian.factor(part);
        let rows = 0..self.constraints.len();
        rows.filter(|row| !work.constraints.jacobian.is_independent(*row))
            .collect()
    }

    /// Number of constraints whose joints are released.
    fn released_rows(&self, work: &Workspace<D>) -> usize {
        let constraints = self.constraints.iter();
        constraints
            .filter(|of| of.is_released(&work.kinematics.released))
            .count()
    }

    /// Returns the owners of constraints, but those of joints that may repeat others.
    fn holding(&self, rows: impl IntoIterator<Item = usize>) -> HoldingParts {
        let mut held = HoldingParts::default();
        for row in rows {
            let constraint = &self.constraints[row];
            match (constraint.joint, &constraint.kind) {
                (Some(joint), _) if self.joints[joint].shares_corners() => {}
                (Some(joint), _) => held.holders.push(joint),
                (None, ConstraintKind::UnitLength(unit)) => {
                    held.bodies.extend(self.bodies.body_of(unit.node));
                }
                (None, _) => {}
            }
        }
        held.holders.sort_unstable();
        held.holders.dedup();
        held
    }
}

//! Whether forces balance where Newton's method has ended. It ends where corrections are small, and they are small as well where
//! a solve fails, or where nothing is stretched along a load: what is left of the forces tells.
//!
//! At an equilibrium, what is left of the forces inside the tangent plane of the constraints is roundoff, and roundoff has a size of its
//! own everywhere: coordinates are rounded, which the tangent turns into forces, and so is every force that is summed.
//! Both are sampled with random signs and led the same way as what is left: to the free coordinates, off the constraints,
//! back to the nodes, so that a light body has the same share of either. What constraints take out is rounded where it was:
//! it counts before and behind them. With the precision `u`, random numbers `s` of mean square 1, sizes `X` of the
//! coordinates and `S` of the sums, and the projection `P` on the tangent plane:
//!
//! `n = T^T K T u s X + T^T u s S`; the squares of `n` and `P n` are compared with those of `P T^T f`, body by body, forces
//! and moments apart.
//!
//! Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), sections 2.8 (roundings as independent
//! random numbers) and 3.1 (bounds of sums).

use super::newton::{Newton, seed};
use super::{ROUNDINGS, Rest};
use crate::bodies::{Node, NodeKind, no_node};
use crate::system::loads::ForceElement as _;
use crate::system::{Dynamics, State, System, Workspace};

/// Samples of roundoff.
const SAMPLES: usize = 4;

/// Square sums of what is left and of roundoff in every body, forces and moments apart, N^2 and (N m)^2.
type Squares = Vec<[[f64; 2]; 2]>;

impl<const D: usize> Newton<'_, '_, D> {
    /// The largest force that is left, relative to roundoff, where that is more than roundoff can be.
    pub(super) fn rest(&mut self, state: &State) -> Option<Rest> {
        let (system, time) = (self.model.system, state.time);
        let q = &state.coordinates;
        self.model.linearize(time, q, &self.rest);
        let force = self.model.accelerate(time, q, &self.rest);
        self.force.copy_from_slice(force);
        let work = &mut *self.model.work;
        let terms = terms(system, time, work);
        let sizes = sizes(system, work);
        let mut squares: Squares = vec![[[0.0; 2]; 2]; system.bodies.ranges.len()];
        let mut left = self.force.clone();
        gather(system, work, &mut left, 1.0, 0, &mut squares);
        let count = 2 * 2 * D * terms.len();
        for signs in seed(SAMPLES * count).chunks_exact(count) {
            let (of_sizes, of_terms) = signs.split_at(count / 2);
            let mut noise = rounded(system, work, (&sizes, of_sizes), (&terms, of_terms));
            // Numbers between -1/2 and 1/2 have a mean square of 1/12.
            let weight = 12.0 / SAMPLES as f64;
            let mut shared = noise.clone();
            system.project_on_tangent_plane(&mut work.constraints, &mut shared);
            for noise in [&mut noise, &mut shared] {
                gather(system, work, noise, weight, 1, &mut squares);
            }
        }
        worst(&squares)
    }
}

/// The body with most left, relative to roundoff, if that is more than it can be.
fn worst(squares: &Squares) -> Option<Rest> {
    let bodies = squares.iter().enumerate();
    let kinds = bodies.flat_map(|(body, kinds)| {
        let kinds = kinds.iter().enumerate();
        kinds.map(move |(kind, squares)| (body, kind == 1, squares))
    });
    let rests = kinds.map(|(body, is_moment, [left, roundoff])| Rest {
        body,
        is_moment,
        size: left.sqrt(),
        roundoff: roundoff.sqrt(),
    });
    let rests = rests.filter(|rest| rest.size > ROUNDINGS * rest.roundoff || rest.size.is_nan());
    rests.max_by(|a, b| f64::total_cmp(&a.relative(), &b.relative()))
}

/// Sizes of what the forces over the nodes are summed from, N.
fn terms<const D: usize>(system: &System<D>, time: f64, work: &mut Workspace<D>) -> Vec<Node<D>> {
    system.add_multiplied(work);
    let mut loads = vec![no_node(); work.kinematics.x.len()];
    for load in &system.loads {
        load.add_force(system.instant(time, &work.kinematics), &mut loads);
    }
    let mut terms = vec![no_node(); work.kinematics.x.len()];
    for (n, term) in terms.iter_mut().enumerate() {
        let parts =
            [&work.forces.f[n], &system.weight[n], &loads[n]].map(|part| part.as_flattened());
        let linear_constraint_forces = work.forces.linear_constraint_forces[n].as_flattened();
        for (i, term) in term.as_flattened_mut().iter_mut().enumerate() {
            let multiplied = (parts[0][i] - linear_constraint_forces[i]).abs();
            *term = parts.iter().map(|part| part[i].abs()).sum::<f64>() + multiplied;
        }
    }
    terms
}

/// Sizes of the numbers that coordinates are summed from: places, m, and directions, which are near 1.
fn sizes<const D: usize>(system: &System<D>, work: &Workspace<D>) -> Vec<Node<D>> {
    let size = system.size();
    let node = |(node, x): (usize, &Node<D>)| {
        let mut sizes = x.map(|part| part.map(|x| x.abs().max(1.0)));
        if system.bodies.kind(node) == NodeKind::Point {
            sizes[0] = x[0].map(|x| x.abs() + size);
        }
        sizes
    };
    work.kinematics.x.iter().enumerate().map(node).collect()
}

/// A sample of what roundoff leaves, over `q`.
fn rounded<const D: usize>(
    system: &System<D>,
    work: &mut Workspace<D>,
    (sizes, of_sizes): (&[Node<D>], &[f64]),
    (terms, of_terms): (&[Node<D>], &[f64]),
) -> Vec<f64> {
    let sample = |sizes: &[Node<D>], signs: &[f64]| {
        let mut sample = sizes.to_vec();
        let numbers = sample.as_flattened_mut().as_flattened_mut();
        (numbers.iter_mut().zip(signs)).for_each(|(x, sign)| *x *= sign * f64::EPSILON);
        sample
    };
    let elimination = &system.elimination;
    let mut noise = vec![0.0; system.coordinates()];
    elimination
        .assembly
        .restrict(&sample(sizes, of_sizes), &mut noise);
    elimination.coordinates_of(&mut noise);
    work.linearization
        .tangent
        .apply_stiffness(elimination, &mut noise);
    let mut forces = sample(terms, of_terms);
    let (drives, x) = (&work.kinematics.drives, &work.kinematics.x);
    system.bodies.pull_back(drives, x, &mut forces);
    let mut summed = noise.clone();
    elimination.reduce(&forces, &mut work.scratch.y, &mut summed);
    (noise.iter_mut().zip(&summed)).for_each(|(noise, sum)| *noise += sum);
    noise
}

/// Adds the squares of a force over `q` to those of the bodies.
fn gather<const D: usize>(
    system: &System<D>,
    work: &mut Workspace<D>,
    force: &mut [f64],
    weight: f64,
    column: usize,
    squares: &mut Squares,
) {
    system.elimination.forces(force);
    (system.elimination.assembly).prolong(force, &mut work.scratch.other);
    for (nodes, squares) in system.bodies.ranges.iter().zip(squares) {
        for node in nodes.clone() {
            let is_point = system.bodies.kind(node) == NodeKind::Point;
            for (part, forces) in work.scratch.other[node].iter().enumerate() {
                let kind = usize::from(!(is_point && part == 0));
                squares[kind][column] += weight * forces.iter().map(|f| f * f).sum::<f64>();
            }
        }
    }
}

//! Which rows and constraints parts make, and what they couple.

use super::Parts;
use crate::bodies::{ConnectivityRow, Links, no_node, tied_with};
use crate::math::space::Vector;
use crate::system::end::Attachment;
use crate::system::joints::{
    Constraint, ConstraintKind, Equation as _, Linear, LinearConstraint, Release, Target,
    UnitLength,
};
use crate::system::loads::{AppliedLoad, ConvectiveInertia, ForceElement as _};

/// Most nodes that pins tie together and are eliminated with (docs/decisions/0029-constraints-at-linear-cost.md).
const TIED: usize = 8;

/// Tells cables which of their ends are free.
pub(super) fn free_ends<const D: usize>(parts: &mut Parts<D>) {
    let mut used = vec![false; parts.bodies.reference.len()];
    let joints = parts.joints.iter().flat_map(|joint| joint.ends);
    let ends = joints.chain(parts.loads.iter().flat_map(AppliedLoad::ends));
    let lumped_masses = parts
        .bodies
        .masses()
        .iter()
        .flat_map(|lump| lump.marker.nodes);
    for node in ends.flat_map(|end| end.nodes()).chain(lumped_masses) {
        used[node] = true;
    }
    parts.bodies.set_free_ends(&used);
}

pub(super) fn constraints<const D: usize>(
    parts: &Parts<D>,
) -> (Vec<Linear<D>>, Vec<Constraint<D>>) {
    let (mut linear, mut nonlinear) = (Vec::new(), Vec::new());
    for (node, turns) in &parts.rigid {
        if *turns {
            nonlinear.push(Constraint {
                joint: None,
                kind: ConstraintKind::UnitLength(UnitLength { node: *node }),
                offset: 0.0,
                release: None,
            });
            continue;
        }
        // A particle has no direction of its own.
        let direction = parts.bodies.reference[*node][1];
        let held = direction.iter().enumerate();
        linear.extend(held.map(|(axis, value)| still((*node, 1, axis), *value)));
    }
    let fixed = parts.bodies.fixed_numbers();
    linear.extend(fixed.into_iter().map(|(place, value)| still(place, value)));
    for (index, joint) in parts.joints.iter().enumerate() {
        joint.constraints(
            (index, &parts.bodies.reference),
            &mut linear,
            &mut nonlinear,
        );
    }
    release_rows(parts, &mut linear, &mut nonlinear);
    let places: Vec<usize> = releases(parts).map(|(joint, _)| joint).collect();
    for constraint in &mut nonlinear {
        let release_of = |joint: usize| places.iter().position(|of| *of == joint);
        constraint.release = constraint.joint.and_then(release_of);
    }
    (linear, nonlinear)
}

/// Joints that can be released, with their releases.
pub(super) fn releases<const D: usize>(parts: &Parts<D>) -> impl Iterator<Item = (usize, Release)> {
    let joints = parts.joints.iter().enumerate();
    joints.filter_map(|(index, joint)| Some((index, joint.release?)))
}

/// A number of a node that is none of its coordinates.
fn still<const D: usize>((node, part, axis): (usize, usize, usize), value: f64) -> Linear<D> {
    let mut coefficients = no_node();
    coefficients[part][axis] = 1.0;
    Linear {
        joint: None,
        row: ConnectivityRow {
            terms: vec![(node, coefficients)],
            is_driven: false,
        },
        target: Target::Fixed(value),
        on_ends: [[Vector::zeros(); 2]; 2],
    }
}

/// Rows that hold axes of rigid bodies in space, which are no coordinates, keep multipliers instead of being eliminated. So do
/// those of joints that can be released, those that hold cables which are paid out, and pins that would tie many rigid bodies together: what is tied together is dense.
fn release_rows<const D: usize>(
    parts: &Parts<D>,
    linear: &mut Vec<Linear<D>>,
    nonlinear: &mut Vec<Constraint<D>>,
) {
    let rows: Vec<&ConnectivityRow<D>> = linear.iter().map(|linear| &linear.row).collect();
    let tied = tied_with(parts.bodies.reference.len(), &rows);
    let paid_out = paid_out(parts);
    let is_released = |index: usize| {
        let joint = &parts.joints[index];
        let is_held =
            |end: &Attachment<D>| end.is_framed() || end.nodes().any(|node| paid_out[node]);
        if joint.release.is_some() || joint.ends.iter().any(is_held) {
            return true;
        }
        let joins = joint.ends.iter().all(|end| end.is_rigid());
        let mut nodes = joint.ends.iter().filter_map(|end| end.nodes().next());
        match (nodes.next(), nodes.next()) {
            (Some(a), Some(_)) => joint.is_pin() && joins && tied[a] > TIED,
            _ => false,
        }
    };
    let released: Vec<bool> = (0..parts.joints.len()).map(is_released).collect();
    linear.retain(|linear| {
        let Some(index) = linear.joint.filter(|index| released[*index]) else {
            return true;
        };
        let mut row = LinearConstraint::new(linear, parts.joints[index].ends);
        let nodes = parts.joints[index].ends.iter().flat_map(Attachment::nodes);
        row.is_constant &= !nodes.into_iter().any(|node| paid_out[node]);
        nonlinear.push(Constraint::of(index, ConstraintKind::LinearConstraint(row)));
        false
    });
    if parts.bodies.has_whole_frames() {
        // What belongs to one joint stands together.
        nonlinear.sort_by_key(|constraint| constraint.joint);
    }
}

/// For every node, whether its cable is paid out.
fn paid_out<const D: usize>(parts: &Parts<D>) -> Vec<bool> {
    let mut paid_out = vec![false; parts.bodies.reference.len()];
    for (chain, ..) in &parts.winches {
        paid_out[parts.bodies.lines()[*chain].range()].fill(true);
    }
    paid_out
}

/// Winches, each with what its cable does as it passes through its mesh among the loads.
pub(super) fn add_winches<const D: usize>(parts: &mut Parts<D>) {
    for &(line, at_last, drive) in &parts.winches {
        parts.bodies.pay_out(line, (at_last, drive), parts.gravity);
        let inertia = ConvectiveInertia { line };
        parts.loads.push(AppliedLoad::ConvectiveInertia(inertia));
    }
}

/// Lists the couplings of nodes by mass, stiffness and constraints.
pub(super) fn links<const D: usize>(parts: &Parts<D>, nonlinear: &[Constraint<D>]) -> Links {
    let mut links = parts.bodies.links();
    let first = parts.bodies.acted_nodes();
    let owners = |nodes: Vec<usize>| {
        let Some(first) = &first else {
            return nodes;
        };
        let mut owners: Vec<usize> = Vec::with_capacity(2 * nodes.len());
        for owner in nodes.iter().flat_map(|node| first[*node].iter().copied()) {
            if !owners.contains(&owner) {
                owners.push(owner);
            }
        }
        owners
    };
    let mut tie = |nodes: &[usize]| {
        for (i, a) in nodes.iter().enumerate() {
            (links.stiffness).extend(nodes[i + 1..].iter().map(|b| (*a, *b)));
        }
    };
    for load in parts.loads.iter().chain(&parts.initial_loads) {
        for nodes in load.parts(&parts.bodies) {
            tie(&owners(nodes));
        }
    }
    let mut joint = None;
    for constraint in nonlinear {
        let nodes = owners(constraint.kind.nodes(&parts.bodies));
        if constraint.kind.is_stiff() {
            tie(&nodes);
        }
        match links.held.last_mut() {
            Some((on, count)) if joint == constraint.joint && *on == nodes => *count += 1,
            _ => links.held.push((nodes, 1)),
        }
        joint = constraint.joint;
    }
    links
}

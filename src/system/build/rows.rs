//! Which rows and constraints parts make, and what they couple.

use super::Parts;
use crate::body::{
    ConnectivityRow, Links, Node, RigidBodyFrame, RodChain, no_node, tied_with, untwisted,
};
use crate::math::space::Vector;
use crate::system::Winch;
use crate::system::end::Attachment;
use crate::system::joints::{
    Constraint, ConstraintKind, Linear, LinearConstraint, Release, Target, UnitLength,
};
use crate::system::loads::{AppliedLoad, ConvectiveInertia};

/// Most nodes that pins tie together and are eliminated with (docs/decisions/0029-constraints-at-linear-cost.md).
const TIED: usize = 8;

/// Tells cables which of their ends are free.
pub(super) fn free_ends<const D: usize>(parts: &mut Parts<D>) {
    let mut used = vec![false; parts.nodes.len()];
    let joints = parts.joints.iter().flat_map(|joint| joint.ends);
    let ends = joints.chain(parts.loads.iter().flat_map(AppliedLoad::ends));
    let lumped_masses = parts
        .lumped_masses
        .iter()
        .flat_map(|lump| lump.marker.nodes);
    for node in ends.flat_map(|end| end.nodes()).chain(lumped_masses) {
        used[node] = true;
    }
    for chain in &mut parts.chains {
        let first = chain.nodes(0)[0];
        let last = first + chain.node_count() - 1;
        chain.set_free_ends([!used[first], !used[last]], &parts.nodes);
    }
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
        let direction = parts.nodes[*node][1];
        let held = direction.iter().enumerate();
        linear.extend(held.map(|(axis, value)| still((*node, 1, axis), *value)));
    }
    for frame in &parts.frames {
        rest(parts, frame, &mut linear);
    }
    for chain in &parts.rod_chains {
        rest_of_rod(parts, chain, &mut linear);
    }
    for (index, joint) in parts.joints.iter().enumerate() {
        joint.constraints((index, &parts.nodes), &mut linear, &mut nonlinear);
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

/// The second node of a rigid body of space has no coordinates of its own, nor has the first a rotation about an axis without
/// inertia.
fn rest<const D: usize>(parts: &Parts<D>, frame: &RigidBodyFrame, linear: &mut Vec<Linear<D>>) {
    let second = unplaced(&parts.nodes[frame.node]);
    for (part, vector) in second.iter().enumerate() {
        let held = vector.iter().enumerate();
        linear.extend(held.map(|(axis, value)| still((frame.node + 1, part, axis), *value)));
    }
    let without = (0..D).filter(|axis| frame.moments[*axis] <= 0.0);
    linear.extend(without.map(|axis| still((frame.node, 1, axis), 0.0)));
}

/// Fixes the vectors of section and inner nodes that are no coordinates. Of a section frame only rotations are
/// coordinates: one about the tangent of a rod, three of a beam. Of an inner node only the internal twist and shear
/// rotations are. In the plane the coordinates are the direction of a section and the angle of the section inside.
fn rest_of_rod<const D: usize>(parts: &Parts<D>, chain: &RodChain, linear: &mut Vec<Linear<D>>) {
    let mut nodes = parts.nodes.clone();
    unplaced_rod(chain, &mut nodes);
    let turns = if D == 2 { D } else { chain.turns() };
    let turns: Vec<_> = (0..turns).map(|axis| (1, axis)).collect();
    let inside: Vec<_> = chain.inside().map(|(_, place)| place).collect();
    let frames = chain.frames().map(|(node, _)| (node, &turns[..]));
    let second = (chain.axes_nodes()).filter(|_| D > 2);
    let held = frames.chain(second.map(|node| (node, &[][..])));
    for (node, free) in held.chain(chain.inner().map(|node| (node, &inside[..]))) {
        for (part, axis) in (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis))) {
            if !free.contains(&(part, axis)) {
                linear.push(still((node, part, axis), nodes[node][part][axis]));
            }
        }
    }
}

/// Puts the nodes of a rod's frames and those inside its elements where nothing has turned and nothing is twisted.
pub(super) fn unplaced_rod<const D: usize>(chain: &RodChain, nodes: &mut [Node<D>]) {
    for (node, line) in chain.frames().filter(|_| D > 2) {
        let at = unplaced(&nodes[line]);
        nodes[node..][..2].fill(at);
    }
    for (j, node) in chain.inner().enumerate().filter(|_| D > 2) {
        let [line, ..] = chain.nodes(j);
        nodes[node] = [nodes[line][0], untwisted::<D>()[1]];
    }
}

/// Coordinates of both nodes of a rigid body of space where it has not turned.
pub(super) fn unplaced<const D: usize>([center, _]: &Node<D>) -> Node<D> {
    [*center, [0.0; D]]
}

/// Rows that hold axes of rigid bodies in space, which are no coordinates, keep multipliers instead of being eliminated. So do
/// those of joints that can be released, those that hold cables which are paid out, and pins that would tie many rigid bodies together: what is tied together is dense.
fn release_rows<const D: usize>(
    parts: &Parts<D>,
    linear: &mut Vec<Linear<D>>,
    nonlinear: &mut Vec<Constraint<D>>,
) {
    let rows: Vec<&ConnectivityRow<D>> = linear.iter().map(|linear| &linear.row).collect();
    let tied = tied_with(parts.nodes.len(), &rows);
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
    if !parts.frames.is_empty() {
        // What belongs to one joint stands together.
        nonlinear.sort_by_key(|constraint| constraint.joint);
    }
}

/// For every node, whether its cable is paid out.
fn paid_out<const D: usize>(parts: &Parts<D>) -> Vec<bool> {
    let mut paid_out = vec![false; parts.nodes.len()];
    for (chain, ..) in &parts.winches {
        let chain = &parts.chains[*chain];
        paid_out[chain.nodes(0)[0]..][..chain.node_count()].fill(true);
    }
    paid_out
}

/// Winches, each with what its cable does as it passes through its mesh among the loads.
pub(super) fn winches<const D: usize>(parts: &mut Parts<D>) -> Vec<Winch<D>> {
    let gravity = parts.gravity;
    let of = |(chain, at_last, drive): &(usize, bool, usize)| {
        Winch::new((*chain, &parts.chains[*chain]), (*at_last, *drive), gravity)
    };
    let winches: Vec<Winch<D>> = parts.winches.iter().map(of).collect();
    let transports = winches.iter().enumerate();
    let transports = transports.map(|(winch, of)| {
        AppliedLoad::ConvectiveInertia(ConvectiveInertia {
            winch,
            chain: of.chain,
        })
    });
    parts.loads.extend(transports);
    winches
}

/// Links the nodes that elements of a rod couple. Planar sections have their inertia at nodes.
fn link_rod<const D: usize>(chain: &RodChain, links: &mut Links) {
    for j in 0..chain.count() {
        let nodes = chain.nodes(j);
        let [_, a, _, b, inner] = nodes;
        if D > 2 {
            links.mass.extend([(a, inner), (a, b), (b, inner)]);
        }
        for (i, row) in nodes.iter().enumerate() {
            (links.stiffness).extend(nodes[..i].iter().map(|column| (*row, *column)));
        }
    }
}

/// Lists the couplings of nodes by mass, stiffness and constraints.
pub(super) fn links<const D: usize>(parts: &Parts<D>, nonlinear: &[Constraint<D>]) -> Links {
    let mut links = Links::default();
    for chain in &parts.chains {
        let elements = 0..chain.elements().len();
        (links.mass).extend(elements.map(|j| <(usize, usize)>::from(chain.nodes(j))));
    }
    for lump in &parts.lumped_masses {
        let [a, b] = lump.marker.nodes;
        links.mass.push((a, b));
    }
    // What holds the axes of a rigid body of space holds its first node, what holds those of a carried frame the line as well.
    let mut first: Vec<[usize; 2]> = (0..parts.nodes.len()).map(|node| [node; 2]).collect();
    for frame in &parts.frames {
        links.mass.push((frame.node, frame.node));
        first[frame.node + 1] = [frame.node; 2];
    }
    for chain in &parts.rod_chains {
        link_rod::<D>(chain, &mut links);
        for (node, line) in chain.frames().filter(|_| D > 2) {
            first[node..][..2].fill([line, node]);
        }
    }
    let has_frames = D > 2 && !(parts.frames.is_empty() && parts.rod_chains.is_empty());
    let owners = |nodes: Vec<usize>| {
        if !has_frames {
            return nodes;
        }
        let mut owners: Vec<usize> = Vec::with_capacity(2 * nodes.len());
        for owner in nodes.iter().flat_map(|node| first[*node]) {
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
        tie(&owners(
            load.ends().iter().flat_map(Attachment::nodes).collect(),
        ));
    }
    let mut joint = None;
    for constraint in nonlinear {
        let nodes = owners(constraint.nodes(&parts.chains));
        if constraint.is_stiff() {
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

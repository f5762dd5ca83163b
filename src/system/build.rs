//! From parts to a system: constraints are sorted into linear and non-linear ones, the linear ones are
//! eliminated, and what does not change in time is computed.

mod rows;

use super::end::{Angle, Attachment};
use super::joints::{
    Constraint, ConstraintKind, Equation as _, JointEquations, Linear, Primitive, Target, View,
};
use super::loads::{AppliedLoad, ForceElement as _};
use super::motion::prices::Prices;
use super::motion::tree::Tree;
use super::signal::Drive;
use super::{DrivenRow, System};
use crate::bodies::{
    Assembly, Bodies, ConnectivityRow, Dependent, Elimination, Node, NodeKind, add_node, no_node,
    product,
};
use crate::math::function::Function;
use crate::math::space::Vector;
use rows::{add_winches, constraints, free_ends, links, releases};

/// Part of a gradient that counts as none.
const NOTHING: f64 = 1e-12;

/// Parts from which a system is built.
#[derive(Clone, Debug)]
pub struct Parts<const D: usize = 2> {
    /// Bodies, at nodal coordinates as described; they need not fit together yet.
    pub bodies: Bodies<D>,
    /// Nodes of rigid bodies, and whether they can rotate.
    pub rigid: Vec<(usize, bool)>,
    /// Joints, then motions.
    pub joints: Vec<JointEquations<D>>,
    /// Driven coordinates.
    pub drives: Vec<Drive>,
    /// Cables that winches pay out: of each the chain, whether the winch is at its last end, and the driven coordinate.
    pub winches: Vec<(usize, bool, usize)>,
    /// Loads.
    pub loads: Vec<AppliedLoad<D>>,
    /// Loads that act only where the initial state is looked for.
    pub initial_loads: Vec<AppliedLoad<D>>,
    /// Angles to count.
    pub angles: Vec<Angle<D>>,
    /// Gravitational acceleration, m/s^2.
    pub gravity: Vector<D>,
    /// Angular velocity of the frame about its origin, rad/s; in the plane the third component alone.
    pub rotation: [f64; 3],
    /// Whether work is to be integrated.
    pub tracks_work: bool,
}

/// Why parts make no system; joints by index.
#[derive(Clone, Debug, PartialEq)]
pub enum BuildError {
    /// A motion prescribes what other joints or motions determine already.
    Determined(Option<usize>),
    /// The mass is not positive definite.
    Massless,
}

impl<const D: usize> System<D> {
    /// Builds a system.
    ///
    /// # Errors
    /// Motions that contradict other constraints; bodies without mass.
    pub fn new(mut parts: Parts<D>) -> Result<Self, BuildError> {
        free_ends(&mut parts);
        add_winches(&mut parts);
        parts.bodies.complete();
        let (linear, nonlinear) = constraints(&parts);
        let is_clamp = |joint: usize| parts.joints[joint].clamp().is_some();
        let (clamped, nonlinear): (_, Vec<Constraint<D>>) =
            (nonlinear.into_iter()).partition(|constraint| constraint.joint.is_some_and(is_clamp));
        let rows: Vec<ConnectivityRow<D>> =
            linear.iter().map(|linear| linear.row.clone()).collect();
        let links = links(&parts, &nonlinear);
        let (assembly, dependent) = Assembly::new(parts.bodies.reference.len(), &rows, &links);
        let mut redundant = redundant(&linear, &dependent)?;
        redundant.retain(|joint| !parts.joints[*joint].shares_corners());
        let mass = parts.bodies.mass_matrix(&assembly);
        let elimination = Elimination::new(assembly, mass).ok_or(BuildError::Massless)?;
        let loads_damped = parts.loads.iter().any(AppliedLoad::is_damped);
        let releases = releases(&parts).map(|(_, release)| release).collect();
        let (grounded, takes_moments) = (grounded(&parts, &nonlinear), takes_moments(&parts));
        let (described, mut bodies) = (parts.bodies.reference.clone(), parts.bodies);
        bodies.unplace();
        let mut system = Self {
            prices: Prices::default(),
            is_driven_by_time: false,
            has_breaks: false,
            grounded,
            takes_moments,
            is_damped: bodies.is_damped() || loads_damped,
            needs_rates: loads_damped
                || parts.rotation != [0.0; 3]
                || parts.tracks_work
                || bodies.frame_count() > 0,
            reach: 0.0,
            bodies,
            elimination,
            joints: parts.joints,
            holds: vec![None; linear.len()],
            linear,
            driven: Vec::new(),
            constraints: Vec::new(),
            settled: Vec::new(),
            clamped,
            multipliers: Vec::new(),
            tree: None,
            redundant,
            drives: parts.drives,
            loads: parts.loads,
            initial_loads: parts.initial_loads,
            angles: parts.angles,
            releases,
            latches: Vec::new(),
            frictions: Vec::new(),
            sticking: Vec::new(),
            slides: Vec::new(),
            gravity: parts.gravity,
            weight: Vec::new(),
            rotation: parts.rotation,
            tracks_work: parts.tracks_work,
        };
        system.find_functions();
        system.move_reference();
        system.bodies.find_rotations(&system.elimination);
        system.reach = system.find_reach();
        system.weight = system.bodies.weight(system.gravity);
        system.keep(nonlinear, &described);
        system.prices = Prices::new(system.parts(), &system.bodies, &system.elimination);
        system.needs_rates |= !system.constraints.is_empty() || system.bodies.pays_out();
        Ok(system)
    }

    /// Finds what functions of time there are.
    fn find_functions(&mut self) {
        let mut has_breaks = self.releases.iter().any(|release| release.time.is_some());
        let mut is_driven_by_time = false;
        self.each_function(|function| {
            has_breaks |= function.has_breaks();
            // Tables are smooth between their points.
            is_driven_by_time |= matches!(function, Function::Expression(_));
        });
        (self.has_breaks, self.is_driven_by_time) = (has_breaks, is_driven_by_time);
    }

    /// Moves the reference onto the fixed rows, and finds how nodes follow the driven ones.
    fn move_reference(&mut self) {
        let mut moves: Vec<(usize, Node<D>)> = Vec::new();
        for (c, cluster) in self.elimination.assembly.clusters().iter().enumerate() {
            for (k, row) in cluster.rows.iter().enumerate() {
                self.holds[*row] = Some((c, k));
                let linear = &self.linear[*row];
                let value: f64 = (linear.row.terms.iter())
                    .map(|(node, c)| product(c, &self.bodies.reference[*node]))
                    .sum();
                let column = cluster.multipliers.row(k);
                let entry = |i: usize, p: usize, d: usize| column[(2 * i + p) * D + d];
                let part = |i: usize| [0, 1].map(|p| std::array::from_fn(|d| entry(i, p, d)));
                let nodes = cluster.nodes.iter().enumerate();
                let follow: Vec<(usize, Node<D>)> = nodes.map(|(i, n)| (*n, part(i))).collect();
                match linear.target {
                    Target::Fixed(target) => {
                        let scaled = |(n, c): &(usize, Node<D>)| {
                            let mut way = no_node();
                            add_node(&mut way, target - value, c);
                            (*n, way)
                        };
                        moves.extend(follow.iter().map(scaled));
                    }
                    _ => self.driven.push(DrivenRow {
                        row: *row,
                        reference: value,
                        inertia: self.inertia_of(&follow),
                        follow,
                    }),
                }
            }
        }
        for (node, change) in moves {
            add_node(&mut self.bodies.reference[node], 1.0, &change);
        }
    }

    /// Largest distance from the first node of what its bodies reach, however they rotate: nodes, joints, and the radius of
    /// gyration of bodies that rotate, m.
    fn find_reach(&self) -> f64 {
        let first = Vector::from(self.bodies.reference[0][0]);
        let ends = || self.joints.iter().flat_map(|joint| &joint.ends);
        let mut arms = self.bodies.gyrations();
        for marker in ends()
            .filter_map(Attachment::marker)
            .filter(|m| m.is_framed())
        {
            let arm = &mut arms[marker.nodes[0]];
            *arm = arm.max(marker.arm());
        }
        let far = |place: Vector<D>| (place - first).norm();
        let nodes = self.bodies.reference.iter().zip(&arms).enumerate();
        let nodes = nodes.filter(|(node, _)| self.bodies.kind(*node) == NodeKind::Point);
        let nodes = nodes.map(|(_, (node, arm))| far(node[0].into()) + arm);
        let on_ground = ends().filter(|end| end.marker().is_none());
        let on_ground = on_ground.map(|end| far(end.position(&self.bodies.reference)));
        nodes.chain(on_ground).fold(0.0, f64::max)
    }

    /// Mass times a sparse nodal vector.
    fn inertia_of(&self, follow: &[(usize, Node<D>)]) -> Vec<(usize, Node<D>)> {
        let zero = vec![no_node(); self.bodies.reference.len()];
        let (mut a, mut f) = (zero.clone(), zero);
        for (node, value) in follow {
            a[*node] = *value;
        }
        self.bodies.add_inertia(1.0, &a, &mut f);
        let nodes = f.into_iter().enumerate();
        nodes.filter(|(_, f)| *f != no_node()).collect()
    }

    /// Keeps non-linear constraints, but for those that nothing free can violate.
    fn keep(&mut self, nonlinear: Vec<Constraint<D>>, described: &[Node<D>]) {
        let mut x = self.bodies.reference.clone();
        self.bodies.take_axes(described, &mut x);
        let assembly = &self.elimination.assembly;
        let slides = nonlinear.iter().filter_map(|c| match &c.kind {
            ConstraintKind::PointOnCurve(along) if c.is_slide() => {
                Some(along.nearest(&self.bodies.lines()[along.chain], &x))
            }
            _ => None,
        });
        let travel: Vec<f64> = slides.collect();
        let mut drives = vec![[0.0; 3]; self.drives.len()];
        for constraint in &nonlinear {
            if let ConstraintKind::DrivenOrientation(driven) = &constraint.kind {
                driven.stand(&x, &mut drives);
            }
        }
        let angles = vec![0.0; self.angles.len()];
        let view = View {
            x: &x,
            v: &x,
            drives: &drives,
            bodies: &self.bodies,
            travel: &travel,
            angles: &angles,
            released: &vec![false; self.releases.len()],
        };
        let mut y = vec![0.0; assembly.free()];
        let is_free = |(index, constraint): (usize, &Constraint<D>)| {
            let mut size = 0.0;
            constraint.for_each_pulled(&view, |node, term| {
                assembly.restrict_node(node, term, &mut y);
                size += product(term, term);
            });
            let mut is_free = false;
            for vertex in assembly.held(index) {
                let range = assembly.of_mass().range(*vertex);
                is_free |= (y[range.clone()].iter()).any(|y| y.abs() > NOTHING * f64::sqrt(size));
                y[range].fill(0.0);
            }
            is_free
        };
        let free: Vec<bool> = nonlinear.iter().enumerate().map(is_free).collect();
        for (index, (constraint, is_free)) in nonlinear.into_iter().zip(free).enumerate() {
            if is_free {
                self.multipliers.push(index);
                self.constraints.push(constraint);
                continue;
            }
            self.redundant.extend(constraint.joint);
            if !matches!(constraint.kind, ConstraintKind::PointOnCurve(_)) {
                self.settled.push(constraint);
            }
        }
        self.slides = vec![0; travel.len()];
        for (index, constraint) in self.constraints.iter().enumerate() {
            if let ConstraintKind::PointOnCurve(along) = &constraint.kind {
                self.slides[along.slide] = index;
            }
        }
        self.latches = self.find_latches();
        self.frictions = self.find_frictions();
        self.sticking = self.find_sticking();
        self.tree = Tree::of(self);
    }
}

fn redundant<const D: usize>(
    linear: &[Linear<D>],
    dependent: &[Dependent],
) -> Result<Vec<usize>, BuildError> {
    let mut redundant = Vec::new();
    for found in dependent {
        let joint = linear[found.row].joint;
        if found.is_driven {
            return Err(BuildError::Determined(joint));
        }
        redundant.extend(joint);
    }
    redundant.sort_unstable();
    redundant.dedup();
    Ok(redundant)
}

/// For every node, whether a joint, motion, load or lumped inertia may exert a moment there.
fn takes_moments<const D: usize>(parts: &Parts<D>) -> Vec<bool> {
    let mut takes = vec![false; parts.bodies.reference.len()];
    let mut take = |end: &Attachment<D>| end.nodes().for_each(|node| takes[node] = true);
    for joint in &parts.joints {
        for hold in &joint.holds {
            match hold {
                Primitive::Direction(_) | Primitive::Clamped(_) | Primitive::DrivenDirection(_) => {
                    joint.ends.iter().for_each(&mut take);
                }
                Primitive::Coupler(related) => {
                    let angles = related.terms.iter().filter(|(_, of)| of.is_angle());
                    let ends = angles.flat_map(|(_, of)| of.ends());
                    ends.for_each(|end| take(&end));
                }
                // A line that rotates with the first end is pushed at a distance from it.
                Primitive::Line(_) => take(&joint.ends[0]),
                _ => {}
            }
        }
    }
    for load in &parts.loads {
        if load.is_moment() {
            load.ends().iter().for_each(&mut take);
        }
    }
    let masses = parts.bodies.masses().iter();
    for lump in masses.filter(|lump| lump.inertia > 0.0) {
        take(&Attachment::Body(lump.marker));
    }
    for joint in &parts.joints {
        for hold in &joint.holds {
            if let Primitive::Edge(edge) = hold {
                edge.moments.iter().for_each(|node| takes[*node] = true);
            }
        }
    }
    for patch in parts.bodies.patches() {
        for point in 0..patch.point_count() {
            let first = patch.point_node(point);
            if takes[first] || takes[first + 1] {
                patch.acted(point).for_each(|node| takes[node] = true);
            }
        }
    }
    takes
}

/// Nodes that something besides rows ties to the ground.
fn grounded<const D: usize>(parts: &Parts<D>, nonlinear: &[Constraint<D>]) -> Vec<usize> {
    if parts.rotation != [0.0; 3] {
        return parts
            .bodies
            .ranges
            .iter()
            .map(|nodes| nodes.start)
            .collect();
    }
    // Coordinates of a cable that is paid out are not moved alike by a translation of all.
    let paid_out = parts.winches.iter();
    let mut nodes: Vec<usize> = paid_out
        .map(|(chain, ..)| parts.bodies.lines()[*chain].first_node())
        .collect();
    for load in &parts.loads {
        if load.is_grounded() {
            nodes.extend(load.ends().iter().flat_map(Attachment::nodes));
        }
    }
    for constraint in nonlinear.iter().filter(|c| c.is_grounded()) {
        nodes.extend(constraint.kind.nodes(&parts.bodies));
    }
    nodes
}

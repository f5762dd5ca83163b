//! The equations of motion linearized at a state, exactly: `x'' + R x' + K x = 0` for small motions that keep
//! the constraints, with whatever is not symmetric in `R` and `K`: forces that follow, a turning frame, dampers that
//! move, constraints whose directions turn.
//!
//! Loads, constraints and damped elements are differentiated one by one on numbers that carry derivatives; the rest
//! is assembled as solves use it. While constraints turn, small motions are measured along with their tangent plane
//! (parallel transport in the mass norm): with `D = Q'` the rates of the orthonormal rows `Q`, velocities follow
//! displacements `d` by `-Q^T D d`, and `K` becomes `P (K - (R - M') Q^T D - D^T D) P`, `P = I - Q^T Q`, with the rate `M'` of the
//! mass over axes that stand still, which rigid bodies of space have that turn. So what turns freely and steadily has the
//! eigenvalue 0 whatever its coordinates are.
//!
//! Sources: A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), section 3.1; J. M. Lee, Introduction to
//! Riemannian Manifolds, 2nd ed. (2018), proposition 10.4 (variation of motions on a manifold).

use nalgebra::{DMatrix, Vector3};

use super::probe::{NodeBlocks, Nodes, Probe, SKEW};
use super::rods::RodElastic;
use crate::bodies::{
    Elimination, Node, RotationMaps, SparseRows, no_block, no_node, turning_block,
};
use crate::elements::{self, Element, Nodal};
use crate::math::jet::{Jet, Number};
use crate::math::space::{Vector, spin_matrix, spun};
use crate::math::sparse::{General, Matrix};
use crate::system::instant::Instant;
use crate::system::joints::{Constraint, ConstraintKind, Equation as _, View};
use crate::system::loads::ForceElement as _;
use crate::system::workspace::Frozen;
use crate::system::{System, Workspace};

/// `K` and `R` over the free coordinates, and what constraints make of them: rows and columns of multipliers stand with
/// `K`.
#[derive(Clone, Debug)]
pub(super) struct Linearization<'a, const D: usize> {
    pub elimination: &'a Elimination<D>,
    pub stiffness: General<f64>,
    pub damping: General<f64>,
    /// Contributions of cable elements to both matrices, element by element.
    pub elements: Vec<Elastic<D>>,
    pub rods: Vec<RodElastic<'a>>,
    pub others: [General<f64>; 2],
    pub border: Border,
    /// Whether `R` is not zero.
    pub is_damped: bool,
    /// Whether `K` is symmetric but for loads that follow, and moves no block out of its place.
    pub is_symmetric: bool,
    /// The first load whose force has no potential.
    pub follower: Option<usize>,
    /// Derivatives of the constraints by `q`, and which of them hold what no others do.
    pub normals: SparseRows,
    pub independent: Vec<usize>,
}

/// Tangents of one element: over the coordinates of its two nodes.
#[derive(Clone, Debug)]
pub(super) struct Elastic<const D: usize> {
    pub nodes: [usize; 2],
    pub stiffness: elements::Blocks<D>,
    pub damping: Option<elements::Blocks<D>>,
}

/// Products `column row^T` that add to `K`, over the free coordinates.
#[derive(Clone, Debug, Default)]
pub(super) struct Border {
    pub columns: Vec<Vec<f64>>,
    pub rows: Vec<Vec<f64>>,
}

impl<const D: usize> System<D> {
    /// The equations linearized at the configuration in `work`, at which an acceleration has been computed
    /// if there are constraints. `at_rest` takes all rates as zero and leaves dampers out.
    pub(super) fn linearization(
        &self,
        time: f64,
        work: &mut Workspace<D>,
        at_rest: bool,
    ) -> Linearization<'_, D> {
        let pattern = self.elimination.assembly.pattern();
        if at_rest {
            work.kinematics.v.fill(no_node());
        }
        let mut made = Linearization {
            elimination: &self.elimination,
            stiffness: General::zeros(pattern),
            damping: General::zeros(pattern),
            elements: Vec::new(),
            rods: Vec::new(),
            others: [General::zeros(pattern), General::zeros(pattern)],
            border: Border::default(),
            is_damped: self.is_turning(),
            is_symmetric: true,
            follower: None,
            normals: work.constraints.jacobian.rows().clone(),
            independent: (0..self.constraints.len())
                .filter(|row| work.constraints.jacobian.is_independent(*row))
                .collect(),
        };
        let mut probe = Probe::new(&work.kinematics.x, &work.kinematics.v);
        self.linearize_loads(time, work, at_rest, &mut probe, &mut made);
        self.linearize_rotation(work, &mut made);
        self.linearize_turning(work, &mut probe, &mut made);
        let mut elsewhere = Vec::new();
        let still = work.kinematics.frozen();
        for (constraint, lambda) in self.constraints.iter().zip(&work.constraints.lambda) {
            let held = (constraint, *lambda);
            let blocks = self.linearize_constraint(work, &still, held, &mut probe);
            let blocks = blocks.pulled(&self.bodies.frames, &work.kinematics.x);
            let assembly = &self.elimination.assembly;
            blocks.add(assembly, &mut made.stiffness, &mut |r, c, value| {
                elsewhere.push((r, c, value));
            });
        }
        self.linearize_frames(work, &mut made);
        self.linearize_carried(work, &mut made);
        made.is_symmetric &= elsewhere.is_empty();
        made.others = [made.stiffness.clone(), made.damping.clone()];
        self.linearize_rods(work, at_rest, &mut made);
        self.linearize_chains(work, at_rest, &mut probe, &mut made);
        let mut multipliers = Matrix::zeros(pattern);
        self.add_multipliers(
            &self.view(&work.kinematics),
            &work.constraints.jacobian,
            &mut multipliers,
        );
        made.stiffness.add_symmetric(1.0, &multipliers);
        add_elsewhere(&elsewhere, self.coordinates(), &mut made.border);
        self.add_turning(work, at_rest, &mut made);
        made
    }

    fn linearize_chains(
        &self,
        work: &Workspace<D>,
        at_rest: bool,
        probe: &mut Probe<D>,
        made: &mut Linearization<'_, D>,
    ) {
        let assembly = &self.elimination.assembly;
        let mut none = |_: usize, _: usize, _: f64| {};
        for chain in &self.bodies.chains {
            let is_damped = chain.is_damped() && !at_rest;
            let moves = is_damped && work.kinematics.v.iter().any(|v| *v != no_node());
            made.is_damped |= is_damped;
            made.is_symmetric &= !moves;
            for (j, element) in chain.elements().iter().enumerate() {
                let (nodes, e) = (chain.nodes(j), chain.element(j, &work.kinematics.x));
                let stiffness = if moves {
                    let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
                        let force: Nodal<D, Jet> =
                            element.force(&chain.element(j, x), &chain.element(j, v));
                        let f = f[nodes[0]..=nodes[1]].as_flattened_mut();
                        f.as_flattened_mut()
                            .iter_mut()
                            .zip(force.as_slice())
                            .for_each(|(sum, f)| *sum += *f);
                    };
                    probe.differentiate(&nodes, false, &force).vectors()
                } else {
                    element.stiffness(&e, &Nodal::zeros())
                };
                let damping = is_damped.then(|| element.damping(&e));
                let places = [
                    (Some(&stiffness), &mut made.stiffness),
                    (damping.as_ref(), &mut made.damping),
                ];
                for (matrix, place) in places {
                    for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        let Some(matrix) = matrix else { continue };
                        let mut block = no_block();
                        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                            let part = &matrix[2 * a + p][2 * b + q];
                            for (r, c) in (0..D).flat_map(|r| (0..D).map(move |c| (r, c))) {
                                block[p][r][q][c] = part[(r, c)];
                            }
                        }
                        assembly.add_block((nodes[a], nodes[b]), &block, place, &mut none);
                    }
                }
                made.elements.push(Elastic {
                    nodes,
                    stiffness,
                    damping,
                });
            }
        }
    }

    fn linearize_loads(
        &self,
        time: f64,
        work: &Workspace<D>,
        at_rest: bool,
        probe: &mut Probe<D>,
        made: &mut Linearization<'_, D>,
    ) {
        let assembly = &self.elimination.assembly;
        let mut still: Frozen<Jet> = work.kinematics.frozen();
        // What is driven stands still at rest.
        if at_rest {
            let zero = Jet::from_re(0.0);
            (still.drives.iter_mut()).for_each(|drive| (drive[1], drive[2]) = (zero, zero));
        }
        let mut none = |_: usize, _: usize, _: f64| {};
        let mut following: Option<General<f64>> = None;
        for (index, load) in self.loads.iter().enumerate() {
            for (part, nodes) in load.parts(&self.bodies).iter().enumerate() {
                let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
                    let at = Instant {
                        time: Jet::from_re(time),
                        inputs: &still.inputs,
                        input_rates: &still.input_rates,
                        drives: &still.drives,
                        x,
                        v,
                        bodies: &self.bodies,
                        angles: (&self.angles, &still.angles),
                    };
                    load.add_part(at, part, f);
                };
                let blocks = probe.differentiate(nodes, false, &force);
                let mut blocks = blocks.pulled(&self.bodies.frames, &work.kinematics.x);
                // Of a moment about the axis of a joint in space that is skew which the joint holds.
                let has_potential = !self.bodies.frames.is_empty() && load.is_conservative();
                if !blocks.is_symmetric() && !has_potential {
                    made.follower.get_or_insert(index);
                    let zeros = || General::zeros(assembly.pattern());
                    blocks.add(assembly, following.get_or_insert_with(zeros), &mut none);
                }
                if load.is_damped() && !at_rest {
                    made.is_damped = true;
                    let by_rates = probe.differentiate(nodes, true, &force);
                    // Axes that turn change their rates where they are turned.
                    blocks.add_turned(
                        &by_rates,
                        &self.bodies.frames,
                        (&work.kinematics.x, &work.kinematics.v),
                    );
                    let by_rates = by_rates.pulled(&self.bodies.frames, &work.kinematics.x);
                    by_rates.add(assembly, &mut made.damping, &mut none);
                }
                blocks.add(assembly, &mut made.stiffness, &mut none);
            }
        }
        // What joints hold does no work.
        let skew = following.is_some_and(|matrix| {
            let [whole, skew] = matrix.largest(assembly.pattern());
            skew > SKEW * whole
        });
        made.is_symmetric &= !skew;
        made.follower = made.follower.filter(|_| skew);
    }

    /// Adds the contributions of rigid bodies in space: geometric stiffness of forces on their axes, and gyroscopic
    /// moments. Small rotations are measured about axes fixed in the frame of the scene, those of the body at the
    /// instant. With a body's angular momentum `L = J w` its moment is `J p'' + (w J - J w - L) p'`. Each vector stands
    /// for the matrix of its cross product.
    fn linearize_frames(&self, work: &Workspace<D>, made: &mut Linearization<'_, D>) {
        let assembly = &self.elimination.assembly;
        let mut none = |_: usize, _: usize, _: f64| {};
        for frame in self.bodies.frames.list() {
            let node = (frame.node, frame.node);
            let spin = frame.spin(&work.kinematics.x, &work.kinematics.v);
            let turned = RotationMaps::geometric(
                frame,
                &work.forces.linear_constraint_forces,
                &work.kinematics.x,
            );
            // At rest without the moment that speeds the body up, which is none in equilibrium.
            let turned = if spin == Vector3::zeros() {
                (turned + turned.transpose()) * 0.5
            } else {
                turned
            };
            assembly.add_block(
                node,
                &turning_block(&turned),
                &mut made.stiffness,
                &mut none,
            );
            if spin != Vector3::zeros() {
                (made.is_damped, made.is_symmetric) = (true, false);
                let momentum = frame.momentum(&spin).cross_matrix();
                let gyroscopic = frame.inertia_rate(&spin) - momentum;
                assembly.add_block(
                    node,
                    &turning_block(&gyroscopic),
                    &mut made.damping,
                    &mut none,
                );
            }
        }
    }

    /// Forces of a turning frame.
    fn linearize_rotation(&self, work: &Workspace<D>, made: &mut Linearization<'_, D>) {
        if !self.is_turning() {
            return;
        }
        let (assembly, spin) = (&self.elimination.assembly, self.rotation);
        let mut none = |_: usize, _: usize, _: f64| {};
        let mut centrifugal = Matrix::zeros(assembly.pattern());
        (self.bodies).add_centrifugal(
            self.rotation,
            &work.kinematics.x,
            assembly,
            &mut centrifugal,
        );
        made.stiffness.add_symmetric(1.0, &centrifugal);
        self.linearize_coriolis(work, made);
        let mut add = |nodes: &[usize], mass: &dyn Fn(Node<D>, usize, usize) -> Node<D>| {
            for a in nodes {
                for b in nodes {
                    let mut block = no_block();
                    for (q, c) in [0, 1].into_iter().flat_map(|q| (0..D).map(move |c| (q, c))) {
                        let mut unit = no_node();
                        unit[q][c] = 1.0;
                        let force = mass(
                            unit.map(|v| spun(spin, Vector::<D>::from(v)).into()),
                            *a,
                            *b,
                        );
                        for (p, r) in [0, 1].into_iter().flat_map(|p| (0..D).map(move |r| (p, r))) {
                            block[p][r][q][c] = 2.0 * force[p][r];
                        }
                    }
                    assembly.add_block((*a, *b), &block, &mut made.damping, &mut none);
                }
            }
        };
        for chain in &self.bodies.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                let (nodes, mass) = (chain.nodes(j), element.mass());
                add(&nodes, &|x, a, b| {
                    let (row, column) = (2 * (a - nodes[0]), 2 * (b - nodes[0]));
                    [0, 1].map(|p| {
                        let m = |k: usize| mass[(row + p, column + k)];
                        std::array::from_fn(|d| m(0) * x[0][d] + m(1) * x[1][d])
                    })
                });
            }
        }
        let mut scratch = vec![no_node(); self.bodies.reference.len()];
        for lump in &self.bodies.lumped_masses {
            let marker = lump.marker;
            let nodes = &marker.nodes[..if marker.is_nodal() { 1 } else { 2 }];
            let scratch = std::cell::RefCell::new(&mut scratch);
            add(nodes, &|x, a, b| {
                let mut nodal = scratch.borrow_mut();
                nodal[b] = x;
                let at: Vector<D> = marker.position(&nodal) * lump.moved();
                let on = marker.direction(&nodal) * lump.inertia;
                nodal[b] = no_node();
                let forces = marker.forces(at, on);
                forces[usize::from(a != nodes[0])].1
            });
        }
    }

    /// The Coriolis force on rigid bodies of space in a turning frame.
    fn linearize_coriolis(&self, work: &Workspace<D>, made: &mut Linearization<'_, D>) {
        let assembly = &self.elimination.assembly;
        let mut none = |_: usize, _: usize, _: f64| {};
        let coriolis = spin_matrix::<D>(self.rotation) * 2.0;
        for frame in self.bodies.frames.list() {
            let nodes = [frame.node, frame.node + 1];
            let mut whole = DMatrix::zeros(4 * D, 4 * D);
            for (node, part, mass) in frame.masses() {
                let at = 2 * D * (node - nodes[0]) + D * part;
                whole
                    .fixed_view_mut::<D, D>(at, at)
                    .copy_from(&(coriolis * mass));
            }
            let by_rates = NodeBlocks::new(&nodes, whole);
            let mut blocks = NodeBlocks::new(&[frame.node], DMatrix::zeros(2 * D, 2 * D));
            blocks.add_turned(
                &by_rates,
                &self.bodies.frames,
                (&work.kinematics.x, &work.kinematics.v),
            );
            blocks.add(assembly, &mut made.stiffness, &mut none);
            let by_rates = by_rates.pulled(&self.bodies.frames, &work.kinematics.x);
            by_rates.add(assembly, &mut made.damping, &mut none);
        }
    }

    /// `d (J^T lambda) / dx` of one constraint.
    fn linearize_constraint(
        &self,
        work: &Workspace<D>,
        still: &Frozen<Jet>,
        (constraint, lambda): (&Constraint<D>, f64),
        probe: &mut Probe<D>,
    ) -> NodeBlocks {
        let mut nodes = constraint.kind.nodes(&self.bodies);
        if let ConstraintKind::PointOnCurve(along) = &constraint.kind {
            let chain = &self.bodies.chains[along.chain];
            let (element, _) = chain.find(work.kinematics.travel[along.slide]);
            nodes = chain
                .nodes(element)
                .into_iter()
                .chain(along.end.nodes())
                .collect();
        }
        let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
            let travel = work.kinematics.travel.iter();
            let mut travel: Vec<Jet> = travel.map(|place| Jet::from_re(*place)).collect();
            if let ConstraintKind::PointOnCurve(along) = &constraint.kind {
                let place = &mut travel[along.slide];
                *place = along.travel(&self.bodies.chains[along.chain], x, *place);
            }
            let view = View {
                x,
                v,
                drives: &still.drives,
                bodies: &self.bodies,
                travel: &travel,
                angles: &still.angles,
                released: &work.kinematics.released,
            };
            constraint.for_each(&view, |node, term| {
                let f = f[node].as_flattened_mut().iter_mut();
                for (f, term) in f.zip(term.as_flattened()) {
                    *f -= *term * Jet::of(lambda);
                }
            });
        };
        probe.differentiate(&nodes, false, &force)
    }
}

/// Entries of `K` that are stored nowhere: row, column, value.
fn add_elsewhere(entries: &[(usize, usize, f64)], coordinates: usize, border: &mut Border) {
    let mut places: Vec<usize> = entries.iter().map(|(_, c, _)| *c).collect();
    places.sort_unstable();
    places.dedup();
    for place in places {
        let (mut column, mut row) = (vec![0.0; coordinates], vec![0.0; coordinates]);
        row[place] = 1.0;
        for (r, _, value) in entries.iter().filter(|(_, c, _)| *c == place) {
            column[*r] += value;
        }
        border.columns.push(column);
        border.rows.push(row);
    }
}

//! The equations of motion linearized at a state, exactly: `x'' + R x' + K x = 0` for small motions that keep
//! the constraints, with whatever is not symmetric in `R` and `K`: forces that follow, a rotating frame, dampers that
//! move, constraints whose directions rotate.
//!
//! Loads, constraints and damped elements are differentiated one by one on numbers that carry derivatives; the rest
//! is assembled as solves use it. While constraints rotate, small motions are measured along with their tangent plane
//! (parallel transport in the mass norm): with `D = Q'` the rates of the orthonormal rows `Q`, velocities follow
//! displacements `d` by `-Q^T D d`, and `K` becomes `P (K - (R - M') Q^T D - D^T D) P`, `P = I - Q^T Q`, with the rate `M'` of the
//! mass over axes that stand still, which rigid bodies of space have that rotate. So what rotates freely and steadily has the
//! eigenvalue 0 whatever its coordinates are.
//!
//! Sources: A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), section 3.1; J. M. Lee, Introduction to
//! Riemannian Manifolds, 2nd ed. (2018), proposition 10.4 (variation of motions on a manifold).

use crate::bodies::{
    Elimination, LinearTerms, LinearizationPoint, NodeBlocks, Nodes, Probe, SKEW, SparseRows,
    no_node,
};
use crate::math::jet::{Jet, Number};
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
    /// Both, and what elements contribute to them. `K` counts as symmetric only if it moves no block out of its place.
    pub terms: LinearTerms,
    /// Both without elements.
    pub others: [General<f64>; 2],
    pub border: Border,
    /// The first load whose force has no potential.
    pub follower: Option<usize>,
    /// Derivatives of the constraints by `q`, and which of them hold what no others do.
    pub normals: SparseRows,
    pub independent: Vec<usize>,
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
        let assembly = &self.elimination.assembly;
        let mut made = Linearization {
            elimination: &self.elimination,
            terms: LinearTerms::new(assembly),
            others: [General::zeros(pattern), General::zeros(pattern)],
            border: Border::default(),
            follower: None,
            normals: work.constraints.jacobian.rows().clone(),
            independent: (0..self.constraints.len())
                .filter(|row| work.constraints.jacobian.is_independent(*row))
                .collect(),
        };
        made.terms.is_damped = self.is_rotating();
        let mut probe = Probe::new(&work.kinematics.x, &work.kinematics.v);
        self.linearize_loads(time, work, at_rest, &mut probe, &mut made);
        let mut elsewhere = Vec::new();
        let still = work.kinematics.frozen();
        for (constraint, lambda) in self.constraints.iter().zip(&work.constraints.lambda) {
            let held = (constraint, *lambda);
            let blocks = self.linearize_constraint(work, &still, held, &mut probe);
            let blocks = blocks.pulled(&self.bodies, &work.kinematics.x);
            blocks.add(assembly, &mut made.terms.stiffness, &mut |r, c, value| {
                elsewhere.push((r, c, value));
            });
        }
        let mut at = LinearizationPoint {
            bodies: &self.bodies,
            motion: work.kinematics.motion(),
            at_rest,
            rotation: self.rotation,
            forces: &work.forces.linear_constraint_forces,
            assembly,
            probe: &mut probe,
        };
        self.bodies.linearize(&mut at, &mut made.terms);
        made.terms.is_symmetric &= elsewhere.is_empty();
        made.others = [made.terms.stiffness.clone(), made.terms.damping.clone()];
        self.bodies.linearize_elements(&mut at, &mut made.terms);
        let mut multipliers = Matrix::zeros(pattern);
        self.add_multipliers(
            &self.view(&work.kinematics),
            &work.constraints.jacobian,
            &mut multipliers,
        );
        made.terms.stiffness.add_symmetric(1.0, &multipliers);
        add_elsewhere(&elsewhere, self.coordinates(), &mut made.border);
        self.add_rotating_constraints(work, at_rest, &mut made);
        made
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
                let mut blocks = blocks.pulled(&self.bodies, &work.kinematics.x);
                // Of a moment about the axis of a joint in space that is skew which the joint holds.
                let has_potential = !self.bodies.has_no_frames() && load.is_conservative();
                if !blocks.is_symmetric() && !has_potential {
                    made.follower.get_or_insert(index);
                    let zeros = || General::zeros(assembly.pattern());
                    blocks.add(assembly, following.get_or_insert_with(zeros), &mut none);
                }
                if load.is_damped() && !at_rest {
                    made.terms.is_damped = true;
                    let by_rates = probe.differentiate(nodes, true, &force);
                    // Axes that rotate change their rates where they are rotated.
                    let motion = work.kinematics.motion().pair();
                    blocks.add_by_rates_of_axes(&by_rates, &self.bodies, motion);
                    let by_rates = by_rates.pulled(&self.bodies, &work.kinematics.x);
                    by_rates.add(assembly, &mut made.terms.damping, &mut none);
                }
                blocks.add(assembly, &mut made.terms.stiffness, &mut none);
            }
        }
        // What joints hold does no work.
        let skew = following.is_some_and(|matrix| {
            let [whole, skew] = matrix.largest(assembly.pattern());
            skew > SKEW * whole
        });
        made.terms.is_symmetric &= !skew;
        made.follower = made.follower.filter(|_| skew);
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
            let chain = &self.bodies.lines()[along.chain];
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
                *place = along.travel(&self.bodies.lines()[along.chain], x, *place);
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

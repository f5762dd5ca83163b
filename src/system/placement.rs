//! Initial configurations: bodies are moved, each as a whole, until all joints fit; then rates are found
//! that come closest to those given.
//!
//! The way is a Gauss-Newton iteration with the smallest steps (E. J. Haug, Computer Aided Kinematics and
//! Dynamics of Mechanical Systems (1989)), started from the bodies as described.

use nalgebra::{DMatrix, DVector, Rotation2, Vector2};

use super::joints::{Constraint, ConstraintKind, View};
use super::loads::{Instant, Load};
use super::{Dynamics, Model, State, System, Work};
use crate::body::Node;
use crate::math::vector::dot;

/// Most iterations.
const ITERATIONS: usize = 200;
/// Gap at which joints fit, relative to the size of the system.
const CLOSE: f64 = 1e-9;
/// Gap that is roundoff.
const EXACT: f64 = 1e-15;

/// Joints that do not fit together.
#[derive(Clone, Debug, PartialEq)]
pub struct NotAssembled {
    /// Joints, by index, with the gap that is left (m, or rad).
    pub gaps: Vec<(usize, f64)>,
}

impl System {
    /// The state to start from: bodies as near to the reference as joints and motions allow, and rates
    /// as near to `rates` (over the nodes) in the mass norm.
    ///
    /// # Errors
    /// Joints that cannot be fitted.
    pub fn initial_state(
        &self,
        time: f64,
        inputs: &[f64],
        described: (&[Node<4>], &[Node<4>]),
        work: &mut Work,
    ) -> Result<State, NotAssembled> {
        let mut state = self.blank_state(time);
        self.start_courses(&mut state, inputs);
        let (nodes, rates) = described;
        work.follow(&state);
        // Drives first: targets of the rows depend on them.
        self.place(time, &state.coordinates, None, work);
        let mut x = nodes.to_vec();
        self.fit(&mut x, work)?;
        self.start_hints(&mut state, &x, inputs);
        work.follow(&state);
        self.place(time, &state.coordinates, None, work);
        let missing = difference(&x, &work.x);
        if missing.iter().flatten().any(|m| *m != 0.0) {
            let mut q = std::mem::take(&mut state.coordinates);
            self.coordinates_of(&missing, work, &mut q);
            state.coordinates = q;
        }
        let mut start = work.other.clone();
        start.fill([0.0; 4]);
        self.follow(&work.drives, 1, &mut start);
        let missing = difference(rates, &start);
        let mut v = std::mem::take(&mut state.rates);
        self.coordinates_of(&missing, work, &mut v);
        state.rates = v;
        let mut model = Model::new(self, inputs, work, &state);
        if !model.project(&mut state) {
            return Err(NotAssembled { gaps: Vec::new() });
        }
        model.accepted(&mut state);
        Ok(state)
    }

    /// `q = T^T M dx`: coordinates that come closest to a nodal displacement in the mass norm.
    fn coordinates_of(&self, dx: &[Node<4>], work: &mut Work, q: &mut [f64]) {
        work.f.fill([0.0; 4]);
        self.add_inertia(1.0, dx, &mut work.f);
        self.elimination.reduce(&work.f, &mut work.y, q);
    }

    /// Motions that inputs drive start where the inputs say.
    fn start_courses(&self, state: &mut State, inputs: &[f64]) {
        for (driven, course) in state.driven.iter_mut().zip(self.courses()) {
            let given = course.len();
            driven[..given].copy_from_slice(&inputs[course]);
        }
    }

    /// Where angles and slides are counted from.
    fn start_hints(&self, state: &mut State, x: &[Node<4>], inputs: &[f64]) {
        for (value, angle) in state.angles.iter_mut().zip(&self.angles) {
            *value = angle.value(x, 0.0);
        }
        for load in &self.loads {
            // What a coupling turns along with may have turned fully before.
            if let Load::Turning(turning) = load {
                let outside = turning.angle.value(Instant {
                    time: state.time,
                    inputs,
                    input_rates: &[],
                    x,
                    v: x,
                    chains: &self.chains,
                    angles: (&self.angles, &state.angles),
                });
                state.angles[turning.counted] = self.angles[turning.counted].value(x, outside);
            }
        }
        self.find_slides(x, &mut state.travel);
    }

    /// Moves bodies as a whole until rows and constraints hold.
    fn fit(&self, x: &mut [Node<4>], work: &mut Work) -> Result<(), NotAssembled> {
        let size = extent(x);
        let mut best = f64::INFINITY;
        for iteration in 0..=ITERATIONS {
            self.find_slides(x, &mut work.travel);
            let gaps = self.gaps(x, work, size);
            let largest = gaps.iter().map(|gap| gap.abs()).fold(0.0, f64::max);
            let done = largest <= EXACT || (largest <= CLOSE && largest > 0.5 * best);
            if done {
                return Ok(());
            }
            if iteration == ITERATIONS || !largest.is_finite() {
                break;
            }
            best = largest.min(best);
            let jacobian = self.rigid_jacobian(x, work, size);
            let step = jacobian
                .svd(true, true)
                .solve(&DVector::from_vec(gaps), 1e-9)
                .unwrap_or_else(|_| DVector::zeros(3 * self.bodies.len()));
            // Far from the solution a long step may turn bodies over.
            let turns = step.iter().skip(2).step_by(3).map(|s| s.abs());
            let fraction = (0.5 / turns.fold(0.0, f64::max)).min(1.0);
            for (body, nodes) in self.bodies.iter().enumerate() {
                let part = [0, 1, 2].map(|k| -fraction * step[3 * body + k]);
                let way = Vector2::new(part[0], part[1]) * size;
                move_body(&mut x[nodes.clone()], way, part[2]);
            }
        }
        self.find_slides(x, &mut work.travel);
        let gaps = self.gaps(x, work, size);
        let owners = self.owners();
        let mut open: Vec<(usize, f64)> = Vec::new();
        for (gap, owner) in gaps.iter().zip(owners) {
            if let (Some(joint), true) = (owner, gap.is_nan() || gap.abs() > CLOSE) {
                let gap = self.length_of(joint, gap * size) / size;
                match open.iter_mut().find(|(other, _)| *other == joint) {
                    Some((_, most)) => *most = most.hypot(gap * size),
                    None => open.push((joint, gap.abs() * size)),
                }
            }
        }
        Err(NotAssembled { gaps: open })
    }

    /// A gap in m: that of a distance is measured by squares.
    fn length_of(&self, joint: usize, gap: f64) -> f64 {
        match self.joints[joint].kind {
            super::joints::JointKind::Distance(length) => {
                (length * (length + 2.0 * gap)).max(0.0).sqrt() - length
            }
            _ => gap,
        }
    }

    fn all_constraints(&self) -> impl Iterator<Item = &Constraint> {
        self.constraints.iter().chain(&self.settled)
    }

    /// Joints of the entries of [`System::gaps`].
    fn owners(&self) -> Vec<Option<usize>> {
        let linear = self.linear.iter().map(|linear| linear.joint);
        linear
            .chain(self.all_constraints().map(|c| c.joint))
            .collect()
    }

    /// Where slides are on their chains, wherever they were before.
    fn find_slides(&self, x: &[Node<4>], travel: &mut [f64]) {
        for (travel, constraint) in travel.iter_mut().zip(&self.slides) {
            if let ConstraintKind::Along(along) = &self.constraints[*constraint].kind {
                *travel = along.nearest(&self.chains[along.chain], x);
            }
        }
    }

    /// What is missing of every row and constraint; lengths relative to `size`.
    fn gaps(&self, x: &[Node<4>], work: &Work, size: f64) -> Vec<f64> {
        let mut gaps = Vec::new();
        for linear in &self.linear {
            let value: f64 = (linear.row.terms.iter())
                .map(|(node, c)| dot(c, &x[*node]))
                .sum();
            let missing = value - linear.target.derivatives(&work.drives)[0];
            gaps.push(missing / linear_size(linear, size));
        }
        let view = View {
            x,
            ..self.view(work)
        };
        for constraint in self.all_constraints() {
            gaps.push(constraint.value(&view) / constraint_size(constraint, size));
        }
        gaps
    }

    /// Derivatives of the gaps by translations (relative to `size`) and turns of all bodies.
    fn rigid_jacobian(&self, x: &[Node<4>], work: &Work, size: f64) -> DMatrix<f64> {
        let count = self.linear.len() + self.all_constraints().count();
        let mut jacobian = DMatrix::zeros(count, 3 * self.bodies.len());
        let mut of_node = vec![0; x.len()];
        for (body, nodes) in self.bodies.iter().enumerate() {
            of_node[nodes.clone()].fill(body);
        }
        let mut enter = |row: usize, node: usize, c: &Node<4>, scale: f64| {
            let body = of_node[node];
            let about = center(&x[self.bodies[body].clone()]);
            let p = x[node];
            let turn =
                c[1] * (p[0] - about.x) - c[0] * (p[1] - about.y) + c[3] * p[2] - c[2] * p[3];
            for (k, part) in [c[0] * size, c[1] * size, turn].into_iter().enumerate() {
                jacobian[(row, 3 * body + k)] += part / scale;
            }
        };
        for (row, linear) in self.linear.iter().enumerate() {
            for (node, c) in &linear.row.terms {
                enter(row, *node, c, linear_size(linear, size));
            }
        }
        let view = View {
            x,
            ..self.view(work)
        };
        for (i, constraint) in self.all_constraints().enumerate() {
            constraint.gradient(&view).for_each(|node, c| {
                let scale = constraint_size(constraint, size);
                enter(self.linear.len() + i, node, c, scale);
            });
        }
        jacobian
    }
}

fn linear_size(linear: &super::Linear, size: f64) -> f64 {
    let positions = linear.on_second[0].norm() > 0.0;
    if positions { size } else { 1.0 }
}

fn constraint_size(constraint: &Constraint, size: f64) -> f64 {
    match constraint.kind {
        ConstraintKind::Unit(_) | ConstraintKind::Parallel(_) => 1.0,
        ConstraintKind::Distance(_) | ConstraintKind::Along(_) => size,
    }
}

fn difference(a: &[Node<4>], b: &[Node<4>]) -> Vec<Node<4>> {
    let pairs = a.iter().zip(b);
    pairs
        .map(|(a, b)| std::array::from_fn(|k| a[k] - b[k]))
        .collect()
}

/// Largest distance from the first node, m; 1 where there is none.
pub(super) fn extent(x: &[Node<4>]) -> f64 {
    let way = |p: &Node<4>| (p[0] - x[0][0]).hypot(p[1] - x[0][1]);
    let largest = x.iter().map(way).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

fn center(nodes: &[Node<4>]) -> Vector2<f64> {
    let sum: Vector2<f64> = nodes.iter().map(|p| Vector2::new(p[0], p[1])).sum();
    sum / nodes.len() as f64
}

fn move_body(nodes: &mut [Node<4>], way: Vector2<f64>, angle: f64) {
    let (about, turn) = (center(nodes), Rotation2::new(angle));
    for node in nodes {
        let p = about + way + turn * (Vector2::new(node[0], node[1]) - about);
        let d = turn * Vector2::new(node[2], node[3]);
        *node = [p.x, p.y, d.x, d.y];
    }
}

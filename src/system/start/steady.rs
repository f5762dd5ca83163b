//! Steady motions: all bodies rotate together about one point, in space about one axis, at a constant rate, or move on
//! together.
//!
//! The velocity field `V + omega x r` is the one that motions and joints ask for, in the least-squares sense, and
//! where they leave it free the one that comes closest to the rates of the bodies in the mass norm.

use nalgebra::{DMatrix, DVector};

use super::equilibrium::SteadyRotation;
use crate::bodies::{
    Node, NodeKind, add_node, no_node, node_frame_acceleration, product, rotate_inner,
};
use crate::math::least::Least;
use crate::math::space::{Vector, spins, spun};
use crate::system::{State, System, Workspace};

/// Part of the largest entry below which motions and joints leave a field free.
const FREE: f64 = 1e-9;
/// Velocity or acceleration, relative to the largest, that joints and motions may miss.
const MISSED: f64 = 1e-9;

/// A motion of all bodies as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady<const D: usize = 2> {
    /// Velocity of the origin, m/s.
    pub velocity: Vector<D>,
    /// Angular velocity, rad/s; in the plane the third component alone.
    pub rate: [f64; 3],
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotSteady {
    /// Bodies cannot move together.
    #[error(
        "expected joints and motions that let all bodies turn or move together as one, found some that do not"
    )]
    Apart,
    /// A motion accelerates.
    #[error("expected motions at a constant rate, found one that accelerates")]
    Accelerates,
}

impl<const D: usize> Steady<D> {
    /// Returns the velocities of nodes at these coordinates.
    pub fn rates(&self, x: &[Node<D>]) -> Vec<Node<D>> {
        let turned = |v: [f64; D]| spun(self.rate, Vector::from(v));
        let rate = |[p, d]: &Node<D>| [(self.velocity + turned(*p)).into(), turned(*d).into()];
        x.iter().map(rate).collect()
    }

    /// Returns the rotation of the frame in which the motion is at rest. `None` if the motion does not rotate.
    pub fn turning(&self) -> Option<SteadyRotation<D>> {
        let square: f64 = self.rate.iter().map(|rate| rate * rate).sum();
        (square != 0.0).then(|| SteadyRotation {
            rate: self.rate,
            center: spun(self.rate, self.velocity) / square,
        })
    }

    /// One of the motions that all others are combined of: translations along the axes, then rotations that move a point at
    /// this distance (m) from their axis by 1.
    fn unit(k: usize, size: f64) -> Self {
        let (mut velocity, mut rate) = (Vector::zeros(), [0.0; 3]);
        match k.checked_sub(D) {
            Some(turn) => rate[spins(D).start + turn] = 1.0 / size,
            None => velocity[k] = 1.0,
        }
        Self { velocity, rate }
    }
}

impl<const D: usize> System<D> {
    /// The motion of all bodies as one that motions, joints and rates over the nodes ask for.
    ///
    /// # Errors
    /// Where they ask for none.
    pub fn steady(
        &self,
        state: &State,
        rates: &[Node<D>],
        work: &mut Workspace<D>,
    ) -> Result<Steady<D>, NotSteady> {
        let x = self.nodes_of(state, work);
        let size = self.size();
        let count = D + spins(D).len();
        let units: Vec<Steady<D>> = (0..count).map(|k| Steady::unit(k, size)).collect();
        let fields: Vec<Vec<Node<D>>> = units.iter().map(|unit| self.field(unit, &x)).collect();
        let (rows, targets) = self.velocity_rows(work, &fields);
        let scale = targets.amax();
        let least = Least::new(&rows, FREE);
        let solved = least.solve(&targets);
        if (&rows * &solved - &targets).amax() > MISSED * scale {
            return Err(NotSteady::Apart);
        }
        let free = self.free_part(least.free(), &fields, rates, &solved);
        let mut steady = Steady {
            velocity: Vector::zeros(),
            rate: [0.0; 3],
        };
        for (unit, part) in units.iter().zip((solved + free).iter()) {
            steady.velocity += unit.velocity * *part;
            (steady.rate.iter_mut().zip(unit.rate)).for_each(|(sum, rate)| *sum += part * rate);
        }
        if self.keeps(&steady, &x, work) {
            Ok(steady)
        } else {
            Err(NotSteady::Accelerates)
        }
    }

    /// The rates of nodes in a steady motion. Second nodes of frames hold axes alone; what is inside elements stands still in space.
    pub fn field(&self, steady: &Steady<D>, x: &[Node<D>]) -> Vec<Node<D>> {
        let mut rates = steady.rates(x);
        for (node, rate) in rates.iter_mut().enumerate() {
            match self.bodies.kind(node) {
                NodeKind::Point => {}
                NodeKind::Axes => *rate = x[node].map(|axis| spun(steady.rate, axis.into()).into()),
                NodeKind::Modal => *rate = no_node(),
                NodeKind::Inner => {
                    *rate = no_node();
                    rotate_inner(rate, steady.rate[2]);
                }
            }
        }
        rates
    }

    /// Evaluates rows and constraints on velocity fields, and returns them with their right-hand sides.
    fn velocity_rows(
        &self,
        work: &Workspace<D>,
        fields: &[Vec<Node<D>>],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let mut rows: Vec<(Vec<f64>, f64)> = Vec::new();
        for linear in &self.linear {
            let of = |field: &Vec<Node<D>>| -> f64 {
                linear
                    .row
                    .terms
                    .iter()
                    .map(|(node, c)| product(c, &field[*node]))
                    .sum()
            };
            // What is no coordinate of a node rotates along.
            if linear.joint.is_some() {
                let target = linear.target.derivatives(&work.kinematics.drives)[1];
                rows.push((fields.iter().map(of).collect(), target));
            }
        }
        let view = self.view(&work.kinematics);
        for constraint in self.constraints.iter().chain(&self.clamped) {
            let mut row = vec![0.0; fields.len()];
            constraint.for_each(&view, |node, term| {
                for (sum, field) in row.iter_mut().zip(fields) {
                    *sum += product(term, &field[node]);
                }
            });
            rows.push((row, -constraint.rate(&view)));
        }
        // A row of zeros keeps the decomposition of no rows defined.
        let count = rows.len().max(1);
        let entry = |i: usize, k: usize| rows.get(i).map_or(0.0, |row| row.0[k]);
        let matrix = DMatrix::from_fn(count, fields.len(), entry);
        let target = DVector::from_fn(count, |i, _| rows.get(i).map_or(0.0, |row| row.1));
        (matrix, target)
    }

    /// The part that rows leave free, closest to given rates in the mass norm, and where that does not tell, as how a thin
    /// rod rotates about itself, in the sum of squares.
    fn free_part(
        &self,
        mut free: Vec<DVector<f64>>,
        fields: &[Vec<Node<D>>],
        rates: &[Node<D>],
        p: &DVector<f64>,
    ) -> DVector<f64> {
        let count = fields.len();
        let inner = |a: &[Node<D>], b: &[Node<D>]| -> f64 {
            a.iter().zip(b).map(|(a, b)| product(a, b)).sum()
        };
        let mut found = DVector::zeros(count);
        for is_weighted in [true, false] {
            let weigh = |field: &Vec<Node<D>>| {
                if is_weighted {
                    let mut momentum = vec![no_node(); field.len()];
                    self.bodies.add_inertia(1.0, field, &mut momentum);
                    momentum
                } else {
                    field.clone()
                }
            };
            let weighted: Vec<Vec<Node<D>>> = fields.iter().map(weigh).collect();
            let norm = DMatrix::from_fn(count, count, |i, j| inner(&weighted[i], &fields[j]));
            let given = DVector::from_fn(count, |i, _| inner(&weighted[i], rates));
            let missing = given - &norm * (p + &found);
            let n = free.len();
            if n == 0 {
                break;
            }
            let reduced = DMatrix::from_fn(n, n, |i, j| free[i].dot(&(&norm * &free[j])));
            let modes = reduced.symmetric_eigen();
            let mut rest = Vec::new();
            for (k, size) in modes.eigenvalues.iter().enumerate() {
                let parts = (0..n).map(|j| &free[j] * modes.eigenvectors[(j, k)]);
                let way: DVector<f64> = parts.sum();
                if *size > FREE * norm.amax() {
                    found += &way * (way.dot(&missing) / size);
                } else {
                    rest.push(way);
                }
            }
            free = rest;
        }
        found
    }

    /// Whether motions ask for the accelerations that a steady motion has.
    fn keeps(&self, steady: &Steady<D>, x: &[Node<D>], work: &Workspace<D>) -> bool {
        let square: f64 = steady.rate.iter().map(|rate| rate * rate).sum();
        let center = steady
            .turning()
            .map_or(Vector::zeros(), |turning| turning.center);
        let largest = square * self.size()
            + work
                .kinematics
                .drives
                .iter()
                .fold(0.0, |m, d| f64::max(m, d[2].abs()));
        self.linear
            .iter()
            .filter(|linear| linear.target.is_driven())
            .all(|linear| {
                let of = |(node, c): &(usize, Node<D>)| {
                    let mut arm = x[*node];
                    add_node(&mut arm, -1.0, &[center.into(), [0.0; D]]);
                    product(c, &node_frame_acceleration(steady.rate, &arm, &no_node()))
                };
                let has: f64 = linear.row.terms.iter().map(of).sum();
                let wants = linear.target.derivatives(&work.kinematics.drives)[2];
                (has - wants).abs() <= 1e-6 * largest.max(square)
            })
    }
}

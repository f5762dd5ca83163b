//! Steady motions: all bodies turn together about one point at a constant rate, or move on together.
//!
//! The velocity field `V + omega J x` is the one that motions and joints ask for, in the least-squares sense, and
//! where they leave it free the one that comes closest to the rates of the bodies in the mass norm.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::equilibrium::Turning;
use crate::body::{Node, add_node, no_node, product};
use crate::math::space::{Vector, axis, perpendicular};
use crate::system::{State, System, Work};

/// Part of the largest singular value below which motions and joints leave a field free.
const FREE: f64 = 1e-9;
/// Velocity or acceleration, relative to the largest, that joints and motions may miss.
const MISSED: f64 = 1e-9;

/// A motion of all bodies as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady<const D: usize = 2> {
    /// Velocity of the origin, m/s.
    pub velocity: Vector<D>,
    /// Angular velocity, rad/s.
    pub rate: f64,
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
    /// Its field over nodes at these coordinates.
    pub fn rates(&self, x: &[Node<D>]) -> Vec<Node<D>> {
        let turned = |v: [f64; D]| perpendicular(v.into()) * self.rate;
        let rate = |[p, d]: &Node<D>| [(self.velocity + turned(*p)).into(), turned(*d).into()];
        x.iter().map(rate).collect()
    }

    /// What it is seen from the turning frame: nothing where it does not turn.
    pub fn turning(&self) -> Option<Turning<D>> {
        let center = perpendicular(self.velocity) / self.rate;
        (self.rate != 0.0).then_some(Turning {
            rate: self.rate,
            center,
        })
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
        work: &mut Work<D>,
    ) -> Result<Steady<D>, NotSteady> {
        let x = self.nodes_of(state, work);
        let size = self.size();
        // UnitLength translations, and the turn that moves a point at the distance of the size by 1.
        let field = |k: usize| -> Vec<Node<D>> {
            let (velocity, rate) = match k {
                2 => (Vector::zeros(), 1.0 / size),
                k => (axis(k), 0.0),
            };
            Steady { velocity, rate }.rates(&x)
        };
        let fields = [field(0), field(1), field(2)];
        let (rows, targets) = self.velocity_rows(work, &fields);
        let scale = targets.amax();
        let svd = rows.clone().svd(true, true);
        let largest = svd.singular_values.max();
        let least = FREE * largest;
        let solved = svd
            .solve(&targets, least)
            .unwrap_or_else(|_| DVector::zeros(3));
        if (&rows * &solved - &targets).amax() > MISSED * scale {
            return Err(NotSteady::Apart);
        }
        let mut p = Vector3::new(solved[0], solved[1], solved[2]);
        p += self.free_part(&rows, &fields, rates, p, least);
        let steady = Steady {
            velocity: axis(0) * p[0] + axis(1) * p[1],
            rate: p[2] / size,
        };
        match self.keeps(&steady, &x, work) {
            true => Ok(steady),
            false => Err(NotSteady::Accelerates),
        }
    }

    /// What rows and constraints see of three fields, and what they ask for.
    fn velocity_rows(
        &self,
        work: &Work<D>,
        fields: &[Vec<Node<D>>; 3],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let mut rows: Vec<([f64; 3], f64)> = Vec::new();
        for linear in &self.linear {
            let of = |field: &Vec<Node<D>>| -> f64 {
                linear
                    .row
                    .terms
                    .iter()
                    .map(|(node, c)| product(c, &field[*node]))
                    .sum()
            };
            let target = linear.target.derivatives(&work.drives)[1];
            rows.push((fields.each_ref().map(of), target));
        }
        let view = self.view(work);
        for constraint in &self.constraints {
            let mut row = [0.0; 3];
            constraint.for_each(&view, |node, term| {
                for (sum, field) in row.iter_mut().zip(fields) {
                    *sum += product(term, &field[node]);
                }
            });
            rows.push((row, -constraint.rate(&view)));
        }
        // A row of zeros keeps the decomposition of no rows defined.
        let count = rows.len().max(1);
        let matrix = DMatrix::from_fn(count, 3, |i, k| rows.get(i).map_or(0.0, |row| row.0[k]));
        let target = DVector::from_fn(count, |i, _| rows.get(i).map_or(0.0, |row| row.1));
        (matrix, target)
    }

    /// The part that rows leave free, closest to given rates in the mass norm.
    fn free_part(
        &self,
        rows: &DMatrix<f64>,
        fields: &[Vec<Node<D>>; 3],
        rates: &[Node<D>],
        p: Vector3<f64>,
        least: f64,
    ) -> Vector3<f64> {
        let normal = rows.transpose() * rows;
        let normal = Matrix3::from_fn(|i, j| normal[(i, j)]).symmetric_eigen();
        let momenta = fields.each_ref().map(|field| {
            let mut momentum = vec![no_node(); field.len()];
            self.add_inertia(1.0, field, &mut momentum);
            momentum
        });
        let inner = |a: &[Node<D>], b: &[Node<D>]| -> f64 {
            a.iter().zip(b).map(|(a, b)| product(a, b)).sum()
        };
        let mass = Matrix3::from_fn(|i, j| inner(&momenta[i], &fields[j]));
        let given = Vector3::from_fn(|i, _| inner(&momenta[i], rates)) - mass * p;
        let free: Vec<Vector3<f64>> = (0..3)
            .filter(|k| normal.eigenvalues[*k] <= least * least)
            .map(|k| normal.eigenvectors.column(k).into_owned())
            .collect();
        let n = free.len();
        if n == 0 {
            return Vector3::zeros();
        }
        let reduced = DMatrix::from_fn(n, n, |i, j| free[i].dot(&(mass * free[j])));
        let right = DVector::from_fn(n, |i, _| free[i].dot(&given));
        let z = reduced
            .lu()
            .solve(&right)
            .unwrap_or_else(|| DVector::zeros(n));
        free.iter().zip(z.iter()).map(|(free, z)| free * *z).sum()
    }

    /// Whether motions ask for the accelerations that a steady motion has.
    fn keeps(&self, steady: &Steady<D>, x: &[Node<D>], work: &Work<D>) -> bool {
        let square = steady.rate * steady.rate;
        let center = steady
            .turning()
            .map_or(Vector::zeros(), |turning| turning.center);
        let largest =
            square * self.size() + work.drives.iter().fold(0.0, |m, d| f64::max(m, d[2].abs()));
        self.linear
            .iter()
            .filter(|linear| linear.target.is_driven())
            .all(|linear| {
                let of = |(node, c): &(usize, Node<D>)| {
                    let mut arm = x[*node];
                    add_node(&mut arm, -1.0, &[center.into(), [0.0; D]]);
                    -square * product(c, &arm)
                };
                let has: f64 = linear.row.terms.iter().map(of).sum();
                let wants = linear.target.derivatives(&work.drives)[2];
                (has - wants).abs() <= 1e-6 * largest.max(square)
            })
    }
}

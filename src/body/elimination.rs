//! Elimination of all linear constraints by one QR decomposition, with `Q` applied and never formed.
//!
//! With the mass `M = L L^T` and `L^-1 Phi^T = Q R`, the coordinates `q` of
//! `e = e0 + T (q - q0)`, `T = L^-T Q2`, keep every constraint (`Phi T = 0`) and have identity inertia
//! (`T^T M T = I`), so that `q'' = T^T F`. This is the report's method with the square root of the
//! mass as weight; as printed (Eqs. 23-34: `M^-1 Phi^T = Q R`, `T = Q2`) connectivity breaks.
//!
//! The rows of `Phi` that apply to whole vectors are scalar rows times the identity of space. Ordered
//! along the body they are factored element by element: a front takes two rows carried over from its
//! left neighbour and the four of its element, eliminates the constraints that end here and hands two
//! rows on (multifrontal QR on a chain). Rows over single components (a clamp's slope, a slider) come
//! after, as a border of a few full-length Householder vectors. Both are rank-revealing: a row that
//! depends on rows before it drops out and is reported.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), sections 4-6; multifrontal QR: J. W. H. Liu,
//! SIAM Review 34 (1992); why the weight: docs/decisions/0001-mass-weighted-elimination.md.

use nalgebra::{SMatrix, SVector};

use super::connectivity::Constraint;
use crate::elements::Nodal;
use crate::math::householder::{norm, reflect, reflector};

/// How constraints are eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// Weighted by the square root of the mass: exact.
    MassWeighted,
    /// Report Eqs. 23-34 as printed, kept to show on a chart that it fails.
    AsPrinted,
}

/// Columns that a front eliminates or hands on, relative size below which a column repeats others.
pub(super) const RANK_TOLERANCE: f64 = 1e-10;
/// Rows of a front: two carried over, four of the element.
const ROWS: usize = 6;

/// The transformation `T`, stored as factors.
#[derive(Clone, Debug)]
pub struct Elimination<const D: usize> {
    fronts: Vec<Front>,
    border: Vec<Reflector>,
    /// Coordinates before the border takes its part.
    length: usize,
    redundant: Vec<usize>,
}

/// One step of the factorization: 4 outputs (free coordinates, then carried rows) from 6 inputs
/// (carried rows, then element coordinates). Unused rows are zero.
#[derive(Clone, Debug)]
struct Front {
    /// For `T^T F`.
    reduce: [[f64; ROWS]; 4],
    /// For `T q`; differs from `reduce` only as printed.
    expand: [[f64; ROWS]; 4],
    free: usize,
    carried: usize,
}

#[derive(Clone, Debug)]
struct Reflector {
    vector: Vec<f64>,
    tau: f64,
}

/// A column of the weighted `Phi^T` on the rows of a front.
type Column = [f64; ROWS];

impl<const D: usize> Elimination<D> {
    /// Factors the constraints of a chain of elements with these scalar mass matrices (positive
    /// definite).
    pub fn new(
        masses: &[SMatrix<f64, 4, 4>],
        constraints: &[Constraint<D>],
        formulation: Formulation,
    ) -> Self {
        let mut elimination = Self {
            fronts: Vec::with_capacity(masses.len()),
            border: Vec::new(),
            length: 0,
            redundant: Vec::new(),
        };
        elimination.factor_fronts(masses, constraints, formulation);
        let free: usize = elimination.fronts.iter().map(|f| f.free).sum();
        elimination.length = free * D;
        elimination.factor_border(masses.len(), constraints);
        elimination
    }

    /// Number of independent coordinates `q`.
    pub fn coordinates(&self) -> usize {
        self.length - self.border.len()
    }

    /// Length of the scratch vector that [`Self::expand`] and [`Self::reduce`] need.
    pub fn scratch(&self) -> usize {
        self.length
    }

    /// Joints with a row that repeats others, in the order of the constraints.
    pub fn redundant(&self) -> &[usize] {
        &self.redundant
    }

    /// `e = T q`, for rates and increments alike.
    pub fn expand(&self, q: &[f64], scratch: &mut [f64], e: &mut [Nodal<D>]) {
        let all: &[f64] = if self.border.is_empty() {
            q
        } else {
            scratch[..self.border.len()].fill(0.0);
            scratch[self.border.len()..].copy_from_slice(q);
            for reflector in self.border.iter().rev() {
                reflect(&reflector.vector, reflector.tau, scratch);
            }
            scratch
        };
        let mut carry = [[0.0; D]; 2];
        let mut end = all.len();
        for (front, e) in self.fronts.iter().zip(e).rev() {
            let start = end - front.free * D;
            let mut input = [[0.0; D]; 4];
            for (row, values) in input.iter_mut().zip(all[start..end].chunks_exact(D)) {
                row.copy_from_slice(values);
            }
            input[front.free..front.free + front.carried].copy_from_slice(&carry[..front.carried]);
            let mut output = [[0.0; D]; ROWS];
            for (weights, row) in front.expand.iter().zip(&input) {
                for (weight, out) in weights.iter().zip(&mut output) {
                    for axis in 0..D {
                        out[axis] += weight * row[axis];
                    }
                }
            }
            carry = [output[0], output[1]];
            *e = Nodal::from_fn(|axis, k| output[2 + k][axis]);
            end = start;
        }
    }

    /// `q = T^T f`.
    pub fn reduce(&self, f: &[Nodal<D>], scratch: &mut [f64], q: &mut [f64]) {
        if self.border.is_empty() {
            self.reduce_fronts(f, q);
            return;
        }
        self.reduce_fronts(f, scratch);
        for reflector in &self.border {
            reflect(&reflector.vector, reflector.tau, scratch);
        }
        q.copy_from_slice(&scratch[self.border.len()..]);
    }

    fn reduce_fronts(&self, f: &[Nodal<D>], q: &mut [f64]) {
        let mut carry = [[0.0; D]; 2];
        let mut start = 0;
        for (front, f) in self.fronts.iter().zip(f) {
            let mut input = [[0.0; D]; ROWS];
            input[..2].copy_from_slice(&carry);
            for (k, row) in input[2..].iter_mut().enumerate() {
                for axis in 0..D {
                    row[axis] = f[(axis, k)];
                }
            }
            let mut output = [[0.0; D]; 4];
            for (weights, out) in front.reduce.iter().zip(&mut output) {
                for (weight, row) in weights.iter().zip(&input) {
                    for axis in 0..D {
                        out[axis] += weight * row[axis];
                    }
                }
            }
            let end = start + front.free * D;
            for (values, row) in q[start..end].chunks_exact_mut(D).zip(&output) {
                values.copy_from_slice(row);
            }
            carry = [[0.0; D]; 2];
            carry[..front.carried].copy_from_slice(&output[front.free..front.free + front.carried]);
            start = end;
        }
    }

    fn factor_fronts(
        &mut self,
        masses: &[SMatrix<f64, 4, 4>],
        constraints: &[Constraint<D>],
        formulation: Formulation,
    ) {
        let last = masses.len() - 1;
        // Interface columns on the carried rows, from the front before.
        let mut carried: Vec<Vec<f64>> = vec![Vec::new(); 2];
        for (j, mass) in masses.iter().enumerate() {
            let weights = Weights::new(mass, formulation);
            let rows = carried[0].len();
            let mut ending: Vec<(Column, Option<usize>)> = Vec::new();
            if j > 0 {
                for (k, above) in carried.iter().enumerate() {
                    let mut column = weights.column(rows, SVector::ith(k, -1.0));
                    column[..rows].copy_from_slice(above);
                    ending.push((column, None));
                }
            }
            for constraint in constraints {
                let element = constraint.node.min(last);
                if element == j
                    && let Some([position, slope]) = constraint.vector_row()
                {
                    let second = 2 * (constraint.node - element);
                    let mut coefficients = SVector::zeros();
                    coefficients[second] = position;
                    coefficients[second + 1] = slope;
                    ending.push((weights.column(rows, coefficients), Some(constraint.joint)));
                }
            }
            let mut starting = Vec::new();
            if j < last {
                starting.push(weights.column(rows, SVector::ith(2, 1.0)));
                starting.push(weights.column(rows, SVector::ith(3, 1.0)));
            }
            let (front, handed, dropped) = factor_front(&weights, rows, ending, starting);
            self.fronts.push(front);
            self.redundant.extend(dropped);
            carried = handed;
        }
    }

    /// Rows over components: each becomes a full-length Householder reflection in the coordinates
    /// that the fronts leave, where inertia is already the identity.
    fn factor_border(&mut self, elements: usize, constraints: &[Constraint<D>]) {
        let mut row = vec![Nodal::<D>::zeros(); elements];
        for constraint in constraints.iter().filter(|c| c.vector_row().is_none()) {
            for [position, slope] in constraint.component_rows() {
                let element = constraint.node.min(elements - 1);
                let second = 2 * (constraint.node - element);
                row.fill(Nodal::zeros());
                row[element].set_column(second, &position);
                row[element].set_column(second + 1, &slope);
                let mut vector = vec![0.0; self.length];
                self.reduce_fronts(&row, &mut vector);
                let size = norm(&vector);
                for reflector in &self.border {
                    reflect(&reflector.vector, reflector.tau, &mut vector);
                }
                let done = self.border.len();
                // A position held twice leaves nothing of the row even before the border.
                let scale = self.free_size(&row);
                if size <= RANK_TOLERANCE * scale || norm(&vector[done..]) <= RANK_TOLERANCE * size
                {
                    self.redundant.push(constraint.joint);
                    continue;
                }
                vector[..done].fill(0.0);
                let (tau, _) = reflector(&mut vector[done..]);
                self.border.push(Reflector { vector, tau });
            }
        }
    }

    /// Size of a row as it would be without any constraint but connectivity: a scale for the rank.
    fn free_size(&self, row: &[Nodal<D>]) -> f64 {
        let element = row.iter().position(|r| r.norm() > 0.0).unwrap_or(0);
        let front = &self.fronts[element];
        let largest = front
            .reduce
            .iter()
            .flatten()
            .fold(0.0_f64, |a, v| a.max(v.abs()));
        largest * row[element].norm()
    }
}

/// `reduce` takes `Y f`, `expand` gives `X x`: `X = Y^T = L^-T`, or as printed `X = I`, `Y = M^-1`.
struct Weights {
    reduce: SMatrix<f64, 4, 4>,
    expand: SMatrix<f64, 4, 4>,
}

impl Weights {
    fn new(mass: &SMatrix<f64, 4, 4>, formulation: Formulation) -> Self {
        let inverse = invert_lower(&cholesky(mass));
        match formulation {
            Formulation::MassWeighted => Self {
                reduce: inverse,
                expand: inverse.transpose(),
            },
            Formulation::AsPrinted => Self {
                reduce: inverse.transpose() * inverse,
                expand: SMatrix::identity(),
            },
        }
    }

    fn column(&self, rows: usize, coefficients: SVector<f64, 4>) -> Column {
        let weighted = self.reduce * coefficients;
        let mut column = [0.0; ROWS];
        column[rows..rows + 4].copy_from_slice(weighted.as_slice());
        column
    }
}

/// Triangularizes one front. Returns it with the interface columns on the rows it hands on and the
/// joints whose rows repeat others.
fn factor_front(
    weights: &Weights,
    carried: usize,
    ending: Vec<(Column, Option<usize>)>,
    starting: Vec<Column>,
) -> (Front, Vec<Vec<f64>>, Vec<usize>) {
    let rows = carried + 4;
    let mut reflectors: Vec<(Column, f64, usize)> = Vec::new();
    let apply = |reflectors: &[(Column, f64, usize)], x: &mut Column| {
        for (v, tau, at) in reflectors {
            reflect(&v[*at..rows], *tau, &mut x[*at..rows]);
        }
    };
    let mut dropped = Vec::new();
    let push = |reflectors: &mut Vec<(Column, f64, usize)>, mut column: Column| -> bool {
        let size = norm(&column);
        apply(reflectors, &mut column);
        let at = reflectors.len();
        if at == rows || norm(&column[at..rows]) <= RANK_TOLERANCE * size {
            return false;
        }
        let (tau, _) = reflector(&mut column[at..rows]);
        reflectors.push((column, tau, at));
        true
    };
    for (column, joint) in ending {
        if !push(&mut reflectors, column) {
            dropped.extend(joint);
        }
    }
    let rank = reflectors.len();
    for column in &starting {
        push(&mut reflectors, *column);
    }
    let handed_on = reflectors.len() - rank;
    let free = rows - rank - handed_on;
    let handed = starting
        .into_iter()
        .map(|mut column| {
            apply(&reflectors, &mut column);
            column[rank..rank + handed_on].to_vec()
        })
        .collect();

    let mut front = Front {
        reduce: [[0.0; ROWS]; 4],
        expand: [[0.0; ROWS]; 4],
        free,
        carried: handed_on,
    };
    for output in 0..free + handed_on {
        // Free coordinates first, then what is handed on.
        let mut q = [0.0; ROWS];
        q[rank + (output + handed_on) % (free + handed_on)] = 1.0;
        for (v, tau, at) in reflectors.iter().rev() {
            reflect(&v[*at..rows], *tau, &mut q[*at..rows]);
        }
        let local = SVector::<f64, 4>::from_column_slice(&q[carried..rows]);
        front.reduce[output][..carried].copy_from_slice(&q[..carried]);
        front.expand[output][..carried].copy_from_slice(&q[..carried]);
        front.reduce[output][2..].copy_from_slice((weights.reduce.transpose() * local).as_slice());
        front.expand[output][2..].copy_from_slice((weights.expand * local).as_slice());
    }
    (front, handed, dropped)
}

fn cholesky(mass: &SMatrix<f64, 4, 4>) -> SMatrix<f64, 4, 4> {
    let mut l = SMatrix::<f64, 4, 4>::zeros();
    for i in 0..4 {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| l[(i, k)] * l[(j, k)]).sum();
            let value = mass[(i, j)] - sum;
            l[(i, j)] = if i == j {
                value.sqrt()
            } else {
                value / l[(j, j)]
            };
        }
    }
    l
}

fn invert_lower(l: &SMatrix<f64, 4, 4>) -> SMatrix<f64, 4, 4> {
    let mut inverse = SMatrix::<f64, 4, 4>::zeros();
    for c in 0..4 {
        inverse[(c, c)] = 1.0 / l[(c, c)];
        for r in c + 1..4 {
            let sum: f64 = (c..r).map(|k| l[(r, k)] * inverse[(k, c)]).sum();
            inverse[(r, c)] = -sum / l[(r, r)];
        }
    }
    inverse
}

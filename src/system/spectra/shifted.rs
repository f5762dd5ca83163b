//! Products and solves with the linearized equations: dense for few coordinates, `(s^2 I + s R + K)^-1` by sparse
//! factors and a border for many.
//!
//! Source: M. Benzi, G. H. Golub, J. Liesen, Numerical solution of saddle point problems, Acta Numerica 14 (2005),
//! section 5 (Schur complement).

use nalgebra::{Complex, ComplexField, DMatrix, DVector, Dyn, LU};

use super::linearization::Linearization;
use crate::bodies::{Node, no_node};
use crate::math::row_space::RowSpace;
use crate::math::sparse::{self, Factors, General};
use crate::math::vector::dot;
use crate::system::Workspace;

/// Factors of `s^2 I + s R + K` for one `s`.
pub(super) struct Shifted<'a, const D: usize, T: ComplexField> {
    of: &'a Linearization<'a, D>,
    factors: Factors<T>,
    /// Solutions for the columns of the border, and the factors of its Schur complement.
    solutions: Vec<Vec<T>>,
    rest: LU<T, Dyn, Dyn>,
    /// Scratch: free coordinates with multipliers.
    x: Vec<T>,
}

impl<'a, const D: usize> Linearization<'a, D> {
    /// Number of free coordinates: of motions that keep the constraints.
    pub fn modes(&self) -> usize {
        self.elimination.coordinates() - self.independent.len()
    }

    /// Gives the solves of `work` the symmetric part of `K`, exactly, in place of the tangent of steps, which leaves small parts out.
    pub fn hand_over(&self, work: &mut Workspace<D>) {
        let pattern = self.elimination.assembly.pattern();
        (self.terms.stiffness).symmetric_part(pattern, &mut work.linearization.tangent.stiffness);
    }

    /// `R q`, in place; `y` and `product` are scratch as long as the free coordinates.
    pub fn apply_damping(&self, q: &mut [f64], y: &mut [f64], product: &mut [f64]) {
        self.elimination.displacements(q, y);
        self.multiply(&self.terms.damping, y, product);
        self.elimination.project(product, q);
    }

    /// A matrix times free coordinates.
    fn multiply(&self, matrix: &General<f64>, y: &[f64], product: &mut [f64]) {
        let assembly = &self.elimination.assembly;
        let zeros = vec![0.0; assembly.pattern().len()];
        let (mut x, mut sum) = (zeros.clone(), zeros);
        assembly.put(y, &mut x);
        matrix.multiply(assembly.pattern(), &x, &mut sum);
        assembly.take(&sum, product);
    }

    /// An orthonormal basis of the motions that keep the constraints, column by column, and `K` and `R` in it.
    pub fn dense(&self) -> (Vec<Vec<f64>>, [DMatrix<f64>; 2]) {
        let basis = self.basis();
        let projected = self.project(&basis);
        (basis, projected)
    }

    /// `K` and `R` in a basis of columns `q` that keep the constraints. Elements are summed up one by one in
    /// displacements relative to their first ends: those of the whole would cancel, by a part of roundoff that grows with
    /// the fourth power of the number of elements.
    pub fn project(&self, columns: &[Vec<f64>]) -> [DMatrix<f64>; 2] {
        let (n, m) = (self.elimination.coordinates(), self.elimination.scratch());
        let (assembly, size) = (&self.elimination.assembly, columns.len());
        let mut nodal = Vec::with_capacity(size);
        let mut projected = [DMatrix::zeros(size, size), DMatrix::zeros(size, size)];
        let (mut y, mut product, mut out) = (vec![0.0; m], vec![0.0; m], vec![0.0; n]);
        for (k, q) in columns.iter().enumerate() {
            self.elimination.displacements(q, &mut y);
            let mut x: Vec<Node<D>> = vec![no_node(); assembly.nodes()];
            assembly.prolong(&y, &mut x);
            nodal.push(x);
            for (which, matrix) in self.others.iter().enumerate() {
                self.multiply(matrix, &y, &mut product);
                let pairs = self.border.columns.iter().zip(&self.border.rows);
                for (column, row) in pairs.filter(|_| which == 0) {
                    let factor = dot(row, &y);
                    let to = product.iter_mut().zip(column);
                    to.for_each(|(to, c)| *to += factor * c);
                }
                self.elimination.project(&product, &mut out);
                for (i, left) in columns.iter().enumerate() {
                    projected[which][(i, k)] = dot(left, &out);
                }
            }
        }
        let [stiffness, damping] = &mut projected;
        for element in &self.terms.elements {
            let local: Vec<_> = nodal.iter().map(|x| element.relative(x)).collect();
            add_products(&local, &element.stiffness, stiffness);
            if let Some(matrix) = &element.damping {
                add_products(&local, matrix, damping);
            }
        }
        projected
    }

    /// Sum of the sizes of all terms that `q^T K q` is summed from.
    pub fn size(&self, q: &[f64]) -> f64 {
        let assembly = &self.elimination.assembly;
        let (mut y, mut x) = (vec![0.0; q.len()], vec![no_node(); assembly.nodes()]);
        self.elimination.displacements(q, &mut y);
        assembly.prolong(&y, &mut x);
        let mut force = vec![0.0; q.len()];
        self.multiply(&self.others[0], &y, &mut force);
        let others: f64 = y.iter().zip(force).map(|(y, f)| (y * f).abs()).sum();
        let products = self.border.columns.iter().zip(&self.border.rows);
        let products: f64 = products
            .map(|(column, row)| (dot(column, &y) * dot(row, &y)).abs())
            .sum();
        let elastic = self.terms.elements.iter().map(|element| {
            let e = element.relative(&x).abs();
            e.dot(&(element.stiffness.abs() * &e))
        });
        others + products + elastic.sum::<f64>()
    }

    /// Orthonormal columns that the held directions leave.
    fn basis(&self) -> Vec<Vec<f64>> {
        let n = self.elimination.coordinates();
        let axis = |k: usize| (0..n).map(|i| f64::from(u8::from(i == k))).collect();
        if self.independent.is_empty() {
            return (0..n).map(axis).collect();
        }
        let held = self.held();
        let mut rows = RowSpace::new(n, n);
        for k in 0..n {
            let row = rows.row_mut(k);
            row.fill(0.0);
            row[k] = 1.0;
            for _ in 0..2 {
                for unit in (0..held.rank()).map(|i| held.unit(i)) {
                    let factor = dot(unit, row);
                    let pairs = row.iter_mut().zip(unit);
                    pairs.for_each(|(x, u)| *x -= factor * u);
                }
            }
            // What is nothing but roundoff is no direction.
            if dot(row, row) < 1e-20 {
                row.fill(0.0);
            }
        }
        rows.factor(1e-7);
        let columns = 0..self.modes().min(rows.rank());
        columns.map(|k| rows.unit(k).to_vec()).collect()
    }

    /// Factors `s^2 I + s R + K`. `None` where that is singular.
    pub fn shifted<T: ComplexField + sparse::Number>(&'a self, s: T) -> Option<Shifted<'a, D, T>> {
        let pattern = self.elimination.assembly.pattern();
        let mut matrix = General::zeros(pattern);
        matrix.add_symmetric(s * s, &self.elimination.mass);
        if self.terms.is_damped {
            matrix.add(s, &self.terms.damping);
        }
        matrix.add(<T as From<f64>>::from(1.0), &self.terms.stiffness);
        let mut shifted = Shifted {
            of: self,
            factors: matrix.factor(pattern)?,
            solutions: Vec::new(),
            rest: DMatrix::zeros(0, 0).lu(),
            x: vec![<T as From<f64>>::from(0.0); pattern.len()],
        };
        shifted.factor_border();
        Some(shifted)
    }
}

/// Adds the products of displacements of one element with what a matrix makes of them: rows by columns.
fn add_products(local: &[DVector<f64>], matrix: &DMatrix<f64>, sum: &mut DMatrix<f64>) {
    for (k, right) in local.iter().enumerate() {
        let force = matrix * right;
        for (i, left) in local.iter().enumerate() {
            sum[(i, k)] += left.dot(&force);
        }
    }
}

impl<const D: usize, T: ComplexField + sparse::Number> Shifted<'_, D, T> {
    fn factor_border(&mut self) {
        let real = <T as From<f64>>::from;
        let border = &self.of.border;
        let mut solutions = Vec::with_capacity(border.columns.len());
        for column in &border.columns {
            let mut y: Vec<T> = column.iter().map(|c| real(*c)).collect();
            self.solve_sparse(&mut y);
            solutions.push(y);
        }
        let m = solutions.len();
        let rest = DMatrix::from_fn(m, m, |i, j| {
            let corner = f64::from(u8::from(i == j));
            -(real(corner) + product(&border.rows[i], &solutions[j]))
        });
        (self.solutions, self.rest) = (solutions, rest.lu());
    }

    /// Solves in place over the free coordinates, but for the border.
    fn solve_sparse(&mut self, y: &mut [T]) {
        let assembly = &self.of.elimination.assembly;
        assembly.put(y, &mut self.x);
        self.factors.solve(assembly.pattern(), &mut self.x);
        assembly.take(&self.x, y);
    }

    /// Solves in place over the free coordinates, among motions that keep the constraints. False where that is
    /// singular.
    fn solve_free(&mut self, y: &mut [T]) -> bool {
        self.solve_sparse(y);
        if self.solutions.is_empty() {
            return true;
        }
        let rows = self.of.border.rows.iter();
        let nu = rows.map(|row| -product(row, y));
        let mut nu = DVector::from_iterator(self.solutions.len(), nu);
        if !self.rest.solve_mut(&mut nu) {
            return false;
        }
        for (nu, solution) in nu.iter().zip(&self.solutions) {
            let pairs = y.iter_mut().zip(solution);
            pairs.for_each(|(y, s)| *y -= *nu * *s);
        }
        true
    }
}

impl<const D: usize> Shifted<'_, D, f64> {
    /// Solves in place, in the coordinates `q`. False where that is singular.
    pub fn solve(&mut self, q: &mut [f64]) -> bool {
        let elimination = self.of.elimination;
        elimination.forces(q);
        let solved = self.solve_free(q);
        elimination.coordinates_of(q);
        solved
    }
}

impl<const D: usize> Shifted<'_, D, Complex<f64>> {
    /// Numbers of size 1 whose product is that of the determinant but for a sign that is the same for all shifts.
    /// Each changes slowly with the shift, which the product of very many need not.
    pub fn phases(&self) -> Vec<Complex<f64>> {
        let phase = |is_odd: bool, pivots: &mut dyn Iterator<Item = Complex<f64>>| {
            let start = Complex::new(if is_odd { -1.0 } else { 1.0 }, 0.0);
            pivots.fold(start, |phase, pivot| phase * pivot.unscale(pivot.norm()))
        };
        let blocks = self.factors.blocks(self.of.elimination.assembly.pattern());
        let mut phases: Vec<_> = (blocks)
            .map(|(pivots, is_odd)| phase(is_odd, &mut pivots.iter().copied()))
            .collect();
        if !self.solutions.is_empty() {
            let is_odd = self.rest.p().determinant::<f64>() < 0.0;
            let pivots = self.rest.u();
            phases.push(phase(is_odd, &mut pivots.diagonal().iter().copied()));
        }
        phases
    }
}

fn product<T: sparse::Number>(a: &[f64], b: &[T]) -> T {
    let pairs = a.iter().zip(b);
    pairs.fold(T::from(0.0), |sum, (a, b)| sum + T::from(*a) * *b)
}

//! What non-linear constraints add to a solve: a border of a few rows per component of the system.
//!
//! Acceleration keeps to the constraints, so a Newton correction may leave their tangent plane only as
//! far as inertia alone says: `[A U; U^T 0] [d; nu] = [f; U^T M^-1 f / m]` with `U = W Q^T` the forces along the
//! orthonormal rows `Q` of the Jacobian in `q`, solved through `S = U^T A^-1 U`.
//!
//! Source: M. Benzi, G. H. Golub, J. Liesen, Numerical solution of saddle point problems, Acta Numerica 14
//! (2005), section 5 (Schur complement) and theorem 3.1 (inertia).

use std::ops::Range;

use super::stages::STAGES;
use crate::math::row_space::RowSpace;
use crate::math::sparse::Number;

/// The border of one component.
#[derive(Clone, Debug)]
pub struct Border<R, C> {
    /// Component of the system and its coordinates.
    pub component: usize,
    pub range: Range<usize>,
    pub rank: usize,
    /// Rows `Q` and `U^T`, each as long as the range.
    pub units: Vec<f64>,
    pub forces: Vec<f64>,
    pub real: Schur<R>,
    pub complex: Schur<C>,
    /// Parts of the stages along `Q`.
    pub normal: [Vec<f64>; STAGES],
}

/// `A^-1 U` and the factors of `S` for one matrix `A`.
#[derive(Clone, Debug)]
pub struct Schur<T> {
    pub solutions: Vec<T>,
    s: Vec<T>,
    nu: Vec<T>,
}

impl<R: Number, C: Number> Border<R, C> {
    pub(super) fn new(component: usize, range: Range<usize>, count: usize) -> Self {
        let (n, zeros) = (range.len(), vec![0.0; count]);
        Self {
            component,
            rank: 0,
            units: vec![0.0; count * n],
            forces: vec![0.0; count * n],
            real: Schur::new(count, n),
            complex: Schur::new(count, n),
            normal: [zeros.clone(), zeros.clone(), zeros],
            range,
        }
    }

    /// Takes over the rows `Q`; their forces are still to be made.
    pub(super) fn set_units(&mut self, rows: &RowSpace) {
        self.rank = rows.rank();
        let n = self.range.len();
        for i in 0..self.rank {
            self.units[i * n..(i + 1) * n].copy_from_slice(rows.unit(i));
        }
    }

    /// Keeps the parts of a stage's `q` along the rows.
    pub(super) fn set_normal(&mut self, stage: usize, q: &[f64]) {
        let (n, q) = (self.range.len(), &q[self.range.clone()]);
        for (i, part) in self.normal[stage][..self.rank].iter_mut().enumerate() {
            *part = product(&self.units[i * n..(i + 1) * n], q);
        }
    }
}

impl<T: Number> Schur<T> {
    fn new(count: usize, n: usize) -> Self {
        let zero = T::from(0.0);
        Self {
            solutions: vec![zero; count * n],
            s: vec![zero; count * count],
            nu: vec![zero; count],
        }
    }

    /// Makes and factors `S` from the solutions. Returns how many of its pivots are negative, nothing
    /// at a pivot that is zero or not finite.
    pub(super) fn factor(&mut self, forces: &[f64], rank: usize, n: usize) -> Option<usize> {
        let mut negative = 0;
        for i in 0..rank {
            for j in 0..=i {
                let solution = &self.solutions[i * n..(i + 1) * n];
                let mut value = product(&forces[j * n..(j + 1) * n], solution);
                for k in 0..j {
                    value =
                        value - self.s[i * rank + k] * self.s[j * rank + k] * self.s[k * rank + k];
                }
                if i == j {
                    value.inverse()?;
                    negative += usize::from(value.is_negative());
                    self.s[i * rank + i] = value;
                } else {
                    self.s[i * rank + j] = value / self.s[j * rank + j];
                }
            }
        }
        Some(negative)
    }

    /// Corrects a solution `d` of `A d = f` so that `U^T d = target`.
    pub(super) fn correct(
        &mut self,
        (forces, rank): (&[f64], usize),
        target: impl Fn(usize) -> T,
        d: &mut [T],
    ) {
        let n = d.len();
        for i in 0..rank {
            let mut value = product(&forces[i * n..(i + 1) * n], d) - target(i);
            for k in 0..i {
                value = value - self.s[i * rank + k] * self.nu[k];
            }
            self.nu[i] = value;
        }
        for i in (0..rank).rev() {
            let mut value = self.nu[i] / self.s[i * rank + i];
            for k in i + 1..rank {
                value = value - self.s[k * rank + i] * self.nu[k];
            }
            self.nu[i] = value;
        }
        for i in 0..rank {
            let nu = self.nu[i];
            let solution = &self.solutions[i * n..(i + 1) * n];
            for (d, y) in d.iter_mut().zip(solution) {
                *d = *d - nu * *y;
            }
        }
    }
}

fn product<T: Number>(a: &[f64], b: &[T]) -> T {
    let pairs = a.iter().zip(b);
    pairs.fold(T::from(0.0), |sum, (a, b)| sum + T::from(*a) * *b)
}

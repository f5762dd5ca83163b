//! The tangent over the free coordinates, and solves with it in the coordinates `q` without any dense
//! matrix: `(m I + r T^T R T + T^T K T)^-1 = W^T (m M + r R + K)^-1 W`, one sparse solve.

use nalgebra::Complex;

use super::border::Border;
use super::elimination::Elimination;
use super::stages::Stages;
use crate::math::row_space::RowSpace;
use crate::math::sparse::{Matrix, Number};

/// Stiffness and damping over the free coordinates, and the factors of a combination with the mass.
#[derive(Clone, Debug)]
pub struct Tangent<const D: usize> {
    /// Stiffness `K`.
    pub stiffness: Matrix<f64>,
    /// Damping `R`.
    pub damping: Matrix<f64>,
    is_damped: bool,
    pub(super) real: Matrix<f64>,
    pub(super) complex: Matrix<Complex<f64>>,
    /// Weights of inertia that the factors were made with, 1/s^2.
    pub(super) inertia: (f64, Complex<f64>),
    pub(super) borders: Vec<Border<f64, Complex<f64>>>,
    pub(super) x: Vec<f64>,
    product: Vec<f64>,
    pub(super) z: Vec<Complex<f64>>,
    /// Stages of an implicit method.
    pub stages: Stages<D>,
}

impl<const D: usize> Tangent<D> {
    /// Storage. `borders` lists, for components with non-linear constraints, how many; `grounded` are
    /// nodes that something else than rows ties to the ground; `elastic` says which belong to cables.
    pub fn new(
        elimination: &Elimination<D>,
        is_damped: bool,
        borders: &[(usize, usize)],
        grounded: &[usize],
        elastic: &[bool],
    ) -> Self {
        let pattern = elimination.assembly.pattern();
        let zeros = Matrix::zeros(pattern);
        let border = |(component, count): &(usize, usize)| {
            let range = pattern.components()[*component].variables.clone();
            Border::new(*component, range, *count)
        };
        Self {
            stages: Stages::new(elimination, grounded, elastic),
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            is_damped,
            real: zeros,
            complex: Matrix::zeros(pattern),
            inertia: (0.0, Complex::new(0.0, 0.0)),
            borders: borders.iter().map(border).collect(),
            x: vec![0.0; pattern.len()],
            product: vec![0.0; pattern.len()],
            z: vec![Complex::new(0.0, 0.0); pattern.len()],
        }
    }

    /// Sets stiffness and damping to zero.
    pub fn clear(&mut self) {
        self.stiffness.values.fill(0.0);
        if self.is_damped {
            self.damping.values.fill(0.0);
        }
    }

    /// Takes over the Jacobian of the constraints of border `i`.
    pub fn set_border(&mut self, elimination: &Elimination<D>, i: usize, rows: &RowSpace) {
        let border = &mut self.borders[i];
        border.set_units(rows);
        let n = border.range.len();
        let used = border.rank * n;
        border.forces[..used].copy_from_slice(&border.units[..used]);
        for row in border.forces[..used].chunks_exact_mut(n) {
            elimination.forces_component(border.component, row);
        }
    }

    /// Factors `m M + r R + K` for real weights `[m, r]`. False when it is not positive definite where the
    /// constraints leave freedom.
    pub fn factor(&mut self, elimination: &Elimination<D>, weights: [f64; 2]) -> bool {
        self.inertia(elimination, weights) == Some(0)
    }

    /// Factors `m M + r R + K` for real weights `[m, r]`. The number of negative eigenvalues where the constraints
    /// leave freedom, by Sylvester's law of inertia; nothing at a vanishing pivot.
    pub fn inertia(&mut self, elimination: &Elimination<D>, weights: [f64; 2]) -> Option<usize> {
        self.inertia.0 = weights[0];
        let damping = self.is_damped.then_some(&self.damping);
        combine(
            &elimination.mass,
            damping,
            &self.stiffness,
            weights,
            &mut self.real,
        );
        self.factor_combined(elimination)
    }

    /// Factors `K - shift M`. Returns how many eigenvalues of `K` are below the shift where the constraints
    /// leave freedom (Sylvester's law of inertia); nothing at a vanishing pivot.
    ///
    /// Source: B. N. Parlett, The Symmetric Eigenvalue Problem (1998), section 3.3; of the border, as
    /// [`Border`]: theorem 3.1 there.
    pub fn factor_below(&mut self, elimination: &Elimination<D>, shift: f64) -> Option<usize> {
        // What is held does not move: inertia has no say.
        self.inertia.0 = f64::INFINITY;
        combine(
            &elimination.mass,
            None,
            &self.stiffness,
            [-shift, 0.0],
            &mut self.real,
        );
        self.factor_combined(elimination)
    }

    /// Factors what was combined; how many of its eigenvalues are negative where the constraints leave freedom.
    fn factor_combined(&mut self, elimination: &Elimination<D>) -> Option<usize> {
        let pattern = elimination.assembly.pattern();
        let mut negative = self.real.factor(pattern)?;
        for border in &mut self.borders {
            let (n, used) = (border.range.len(), border.rank * border.range.len());
            let schur = &mut border.real;
            schur.solutions[..used].copy_from_slice(&border.forces[..used]);
            for row in schur.solutions[..used].chunks_exact_mut(n) {
                self.real.solve_component(pattern, border.component, row);
            }
            let held = schur.factor(&border.forces, border.rank, n)?;
            negative = negative.checked_sub(held)?;
        }
        Some(negative)
    }

    /// Factors `m M + r R + K` for complex weights `[m, r]`. False at a vanishing pivot.
    pub fn factor_complex(
        &mut self,
        elimination: &Elimination<D>,
        weights: [Complex<f64>; 2],
    ) -> bool {
        self.inertia.1 = weights[0];
        let damping = self.is_damped.then_some(&self.damping);
        combine(
            &elimination.mass,
            damping,
            &self.stiffness,
            weights,
            &mut self.complex,
        );
        let pattern = elimination.assembly.pattern();
        if self.complex.factor(pattern).is_none() {
            return false;
        }
        for border in &mut self.borders {
            let (n, used) = (border.range.len(), border.rank * border.range.len());
            let schur = &mut border.complex;
            for (y, u) in schur.solutions[..used].iter_mut().zip(&border.forces) {
                *y = Complex::new(*u, 0.0);
            }
            for row in schur.solutions[..used].chunks_exact_mut(n) {
                self.complex.solve_component(pattern, border.component, row);
            }
            if schur.factor(&border.forces, border.rank, n).is_none() {
                return false;
            }
        }
        true
    }

    /// Solves in place with the real factors, in the coordinates `q`.
    pub fn solve(&mut self, elimination: &Elimination<D>, q: &mut [f64]) {
        for border in &mut self.borders {
            border.set_normal(0, q);
        }
        elimination.forces(q);
        self.real.solve(elimination.assembly.pattern(), q);
        let scale = 1.0 / self.inertia.0;
        // Where inertia has no say a correction stays in the tangent plane.
        let scale = if scale.is_finite() { scale } else { 0.0 };
        for border in &mut self.borders {
            let (rows, normal) = ((&border.forces[..], border.rank), &border.normal[0]);
            let d = &mut q[border.range.clone()];
            border.real.correct(rows, |i| scale * normal[i], d);
        }
        elimination.coordinates_of(q);
    }

    /// `T^T R T q`, in place; does nothing to an undamped system but set zero.
    pub fn apply_damping(&mut self, elimination: &Elimination<D>, q: &mut [f64]) {
        if self.is_damped {
            apply(
                &self.damping,
                elimination,
                (&mut self.x, &mut self.product),
                q,
            );
        } else {
            q.fill(0.0);
        }
    }

    /// `T^T K T q`, in place.
    pub fn apply_stiffness(&mut self, elimination: &Elimination<D>, q: &mut [f64]) {
        apply(
            &self.stiffness,
            elimination,
            (&mut self.x, &mut self.product),
            q,
        );
    }
}

/// `T^T A T q`, in place.
fn apply<const D: usize>(
    matrix: &Matrix<f64>,
    elimination: &Elimination<D>,
    (y, product): (&mut [f64], &mut [f64]),
    q: &mut [f64],
) {
    elimination.displacements(q, y);
    matrix.multiply(elimination.assembly.pattern(), y, product);
    elimination.project(product, q);
}

/// `out = m M + r R + K`.
fn combine<T: Number>(
    mass: &Matrix<f64>,
    damping: Option<&Matrix<f64>>,
    stiffness: &Matrix<f64>,
    [m, r]: [T; 2],
    out: &mut Matrix<T>,
) {
    let terms = mass.values.iter().zip(&stiffness.values);
    for (out, (mass, k)) in out.values.iter_mut().zip(terms) {
        *out = m * T::from(*mass) + T::from(*k);
    }
    if let Some(damping) = damping {
        for (out, damping) in out.values.iter_mut().zip(&damping.values) {
            *out = *out + r * T::from(*damping);
        }
    }
}

//! The tangent over the free coordinates, and solves with it in the coordinates `q` without any dense
//! matrix: `(m I + r T^T R T + T^T K T)^-1 = W^T (m M + r R + K)^-1 W`, one sparse solve.
//!
//! Acceleration keeps to the constraints, so a Newton correction may leave their tangent plane only as far as inertia
//! alone says. With `A` the matrix above and `C_y` the derivatives of the constraints by the free coordinates that is
//! `[A C_y^T; C_y 0] [d; nu] = [f; C_y M^-1 f / m]`. Multipliers are eliminated after the nodes that they touch, so their pivots
//! are negative; every other pivot is positive where the tangent is definite on what constraints leave free.
//!
//! Source: M. Benzi, G. H. Golub, J. Liesen, Numerical solution of saddle point problems, Acta Numerica 14
//! (2005), sections 3.4 (inertia) and 7 (symmetric indefinite factors).

use nalgebra::Complex;

use super::assembly::Assembly;
use super::elimination::Elimination;
use super::jacobian::{Jacobian, SparseRows};
use super::stages::{RotatingNodes, STAGES, Stages};
use crate::math::sparse::{Matrix, Number};

/// Stiffness and damping over the free coordinates, and the factors of a combination with the mass. Rows and columns
/// of multipliers stand with the stiffness.
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
    pub(super) normals: Normals,
    /// Scratch: free coordinates; vectors that matrices are applied to.
    pub(super) y: Vec<f64>,
    pub(super) x: Vec<f64>,
    product: Vec<f64>,
    pub(super) z: Vec<Complex<f64>>,
    /// Stages of an implicit method.
    pub stages: Stages<D>,
}

/// Directions that constraints hold where the tangent was made.
#[derive(Clone, Debug)]
pub(super) struct Normals {
    /// Derivatives of the constraints by `q`.
    rows: SparseRows,
    /// Where the multipliers of those that count stand in vectors that matrices are applied to.
    places: Vec<Option<usize>>,
    /// Parts of the stages along the rows.
    parts: [Vec<f64>; STAGES],
}

impl Normals {
    /// Keeps the parts of a stage's `q` along the rows.
    pub(super) fn measure(&mut self, stage: usize, q: &[f64]) {
        for (row, part) in self.parts[stage].iter_mut().enumerate() {
            *part = self.rows.product(row, q);
        }
    }

    /// Where the multipliers of constraints stand, and the parts of the stages along them.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, [f64; STAGES])> {
        let places = self.places.iter().enumerate();
        places.filter_map(|(row, place)| {
            let parts = std::array::from_fn(|stage| self.parts[stage][row]);
            place.map(|place| (place, parts))
        })
    }
}

impl<const D: usize> Tangent<D> {
    /// Storage. `jacobian` is that of the constraints; `grounded` are nodes that something else than rows ties to the
    /// ground; the first flags say which belong to cables, the second which have no position among their coordinates; `sections` are
    /// nodes of beams with the first of their frames.
    pub fn new(
        elimination: &Elimination<D>,
        is_damped: bool,
        jacobian: &Jacobian,
        grounded: &[usize],
        rotating: &RotatingNodes,
    ) -> Self {
        let pattern = elimination.assembly.pattern();
        let zeros = Matrix::zeros(pattern);
        let parts = vec![0.0; jacobian.rows().count()];
        Self {
            stages: Stages::new(elimination, grounded, rotating),
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            is_damped,
            real: zeros,
            complex: Matrix::zeros(pattern),
            inertia: (0.0, Complex::new(0.0, 0.0)),
            normals: Normals {
                places: vec![None; parts.len()],
                rows: jacobian.rows().clone(),
                parts: [parts.clone(), parts.clone(), parts],
            },
            y: vec![0.0; elimination.assembly.free()],
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

    /// Takes over the Jacobian of constraints; those of the assembly are told by their indices.
    pub fn hold(&mut self, assembly: &Assembly<D>, jacobian: &Jacobian, all: &[usize]) {
        self.normals.rows.copy_from(jacobian.rows());
        for (row, constraint) in all.iter().enumerate() {
            let counts = jacobian.is_independent(row);
            self.normals.places[row] = counts.then(|| assembly.multiplier(*constraint));
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
    /// Source: B. N. Parlett, The Symmetric Eigenvalue Problem (1998), section 3.3.
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
        let assembly = &elimination.assembly;
        let negative = self.real.factor(assembly.pattern())?;
        // One pivot of every multiplier is.
        negative.checked_sub(assembly.constraints())
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
        self.complex.factor(pattern).is_some()
    }

    /// Solves in place with the real factors, in the coordinates `q`.
    pub fn solve(&mut self, elimination: &Elimination<D>, q: &mut [f64]) {
        let assembly = &elimination.assembly;
        self.normals.measure(0, q);
        elimination.forces(q);
        assembly.put(q, &mut self.x);
        let scale = 1.0 / self.inertia.0;
        // Where inertia has no say a correction stays in the tangent plane.
        let scale = if scale.is_finite() { scale } else { 0.0 };
        for (place, [part, ..]) in self.normals.parts() {
            self.x[place] = scale * part;
        }
        self.real.solve(assembly.pattern(), &mut self.x);
        assembly.take(&self.x, q);
        elimination.coordinates_of(q);
    }

    /// `T^T R T q`, in place; does nothing to an undamped system but set zero.
    pub fn apply_damping(&mut self, elimination: &Elimination<D>, q: &mut [f64]) {
        if self.is_damped {
            self.apply(elimination, |tangent| &tangent.damping, q);
        } else {
            q.fill(0.0);
        }
    }

    /// `T^T K T q`, in place.
    pub fn apply_stiffness(&mut self, elimination: &Elimination<D>, q: &mut [f64]) {
        self.apply(elimination, |tangent| &tangent.stiffness, q);
    }

    /// `T^T A T q`, in place.
    fn apply(
        &mut self,
        elimination: &Elimination<D>,
        matrix: impl Fn(&Self) -> &Matrix<f64>,
        q: &mut [f64],
    ) {
        let assembly = &elimination.assembly;
        elimination.displacements(q, &mut self.y);
        assembly.put(&self.y, &mut self.x);
        let mut product = std::mem::take(&mut self.product);
        matrix(self).multiply(assembly.pattern(), &self.x, &mut product);
        self.product = product;
        assembly.take(&self.product, &mut self.y);
        elimination.project(&self.y, q);
    }
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

//! Gauss with three stages: implicit, symplectic, order 6. Stages are solved for as the product's Radau
//! solves for its own: one real and one complex system over positions, the tangent rotating along.
//!
//! Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Table IV.5.2 (method),
//! section IV.8 (transformation, stopping).

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance};
use flexbody::system::Dynamics;
use nalgebra::{Complex, Matrix3};

/// sqrt(15).
const ROOT: f64 = 3.872_983_346_207_417;
/// Nodes.
const C: [f64; 3] = [0.5 - ROOT / 10.0, 0.5, 0.5 + ROOT / 10.0];
/// Weights of stage increments in the increment of the step.
const END: [f64; 3] = [5.0 / 3.0, -4.0 / 3.0, 5.0 / 3.0];
/// Size of the error that Newton's method leaves, in units of the tolerance.
const GOAL: f64 = 0.03;
/// Most iterations, growth of the first correction that counts as divergence.
const ITERATIONS: u32 = 15;
const DIVERGING: f64 = 2.0;
/// Rate of convergence up to which the tangent is kept for the next step.
const FAST: f64 = 0.02;

type Square = [[f64; 3]; 3];
type Stages = [Vec<f64>; 3];

/// Scratch of the method.
pub struct Gauss {
    inverse: Square,
    forward: Square,
    back: Square,
    real: f64,
    complex: Complex<f64>,
    a: Vec<f64>,
    zq: Stages,
    zv: Stages,
    f: Stages,
    stage_q: Vec<f64>,
    stage_v: Vec<f64>,
    /// Length of the step that the stages belong to.
    last: Option<f64>,
    tangent: bool,
    factored: f64,
    iterations: u64,
}

impl Gauss {
    /// For `n` coordinates.
    pub fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        let stages = || [zero.clone(), zero.clone(), zero.clone()];
        let (inverse, real, complex) = inverse();
        let (forward, back) = transformation(&inverse, real, complex);
        Self {
            inverse: rows(&inverse),
            forward,
            back,
            real,
            complex,
            a: zero.clone(),
            zq: stages(),
            zv: stages(),
            f: stages(),
            stage_q: zero.clone(),
            stage_v: zero,
            last: None,
            tangent: false,
            factored: 0.0,
            iterations: 0,
        }
    }

    /// Stages to start from: the last step's polynomial, or constant acceleration.
    fn start(&mut self, v: &[f64], h: f64) {
        let weights = self
            .last
            .map(|last| C.map(|c| lagrange(1.0 + c * h / last)));
        for i in 0..v.len() {
            let z = [self.zq[0][i], self.zq[1][i], self.zq[2][i]];
            for stage in 0..3 {
                let t = C[stage] * h;
                self.zq[stage][i] = match &weights {
                    Some(weights) => product(&weights[stage], &z) - product(&END, &z),
                    None => t * (v[i] + 0.5 * t * self.a[i]),
                };
            }
        }
        self.velocities(v, h);
    }

    fn velocities(&mut self, v: &[f64], h: f64) {
        for i in 0..v.len() {
            let z = [self.zq[0][i], self.zq[1][i], self.zq[2][i]];
            for (stage, row) in self.zv.iter_mut().zip(&self.inverse) {
                stage[i] = product(row, &z) / h - v[i];
            }
        }
    }

    /// One iteration; the size of the correction in units of the tolerance.
    fn iterate(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> f64 {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        for stage in 0..3 {
            for i in 0..q.len() {
                self.stage_q[i] = q[i] + self.zq[stage][i];
                self.stage_v[i] = v[i] + self.zv[stage][i];
            }
            let at = time + C[stage] * h;
            dynamics.acceleration(at, &self.stage_q, &self.stage_v, &mut self.f[stage]);
            dynamics.set_stage(stage);
        }
        for i in 0..q.len() {
            let z = [self.zv[0][i], self.zv[1][i], self.zv[2][i]];
            for (f, row) in self.f.iter_mut().zip(&self.inverse) {
                f[i] -= product(row, &z) / h;
            }
        }
        let [forward, back] = [self.forward.as_flattened(), self.back.as_flattened()];
        dynamics.solve_stages(forward, back, &mut self.f);
        let (mut positions, mut velocities) = (0.0, 0.0);
        for i in 0..q.len() {
            let x = [self.f[0][i], self.f[1][i], self.f[2][i]];
            positions += product(&x, &x);
            let dv = self.inverse.map(|row| product(&row, &x) / h);
            velocities += product(&dv, &dv);
            for (z, x) in self.zq.iter_mut().zip(x) {
                z[i] += x;
            }
        }
        self.velocities(v, h);
        self.iterations += 1;
        let size = positions.sqrt() + velocities.sqrt() * tolerance.time;
        size / (tolerance.position * tolerance.relative)
    }

    fn newton(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Result<(), f64> {
        let (mut before, mut before_that, mut rate) = (0.0, 0.0, 0.0_f64);
        for k in 0..ITERATIONS {
            let size = self.iterate(dynamics, state, h, tolerance);
            if !size.is_finite() {
                return Err(0.25);
            }
            if k == 1 {
                rate = size / before;
                if rate > DIVERGING {
                    return Err(0.5);
                }
            } else if k > 1 {
                rate = f64::sqrt(size / before_that);
                if rate >= 0.99 {
                    return Err(0.5);
                }
            }
            let rate = rate.min(0.99);
            if k > 0 && rate / (1.0 - rate) * size <= GOAL || size <= 1e-3 * GOAL {
                self.tangent = rate < FAST;
                return Ok(());
            }
            (before_that, before) = (before, size);
        }
        Err(0.5)
    }
}

impl OneStepMethod for Gauss {
    fn name(&self) -> &'static str {
        "gauss6"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
        self.last = None;
        self.tangent = false;
        self.iterations = 0;
    }

    fn refresh(&mut self, _: &mut dyn Dynamics, _: f64, _: &[f64], _: &[f64]) {}

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        self.start(v, h);
        for _ in 0..2 {
            let was_kept = self.tangent;
            if !self.tangent {
                dynamics.linearize(time, q, v);
                self.tangent = true;
                self.factored = 0.0;
            }
            if self.factored != h {
                self.factored = h;
                // Indefinite factors serve too.
                let (real, complex) = (self.real / h, self.complex / h);
                dynamics.factor([real * real, real]);
                dynamics.factor_complex([complex * complex, complex]);
            }
            match self.newton(dynamics, state, h, tolerance) {
                Ok(()) => {
                    self.last = Some(h);
                    // There is no estimate: fixed steps only.
                    return Attempt::Done(1.0);
                }
                Err(factor) => {
                    self.tangent = false;
                    self.last = None;
                    if !was_kept {
                        return Attempt::Failed(factor);
                    }
                    dynamics.acceleration(time, q, v, &mut self.a);
                    self.start(v, h);
                }
            }
        }
        Attempt::Failed(0.5)
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        for i in 0..q.len() {
            q[i] += product(&END, &[self.zq[0][i], self.zq[1][i], self.zq[2][i]]);
            v[i] += product(&END, &[self.zv[0][i], self.zv[1][i], self.zv[2][i]]);
        }
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }

    fn newton_iterations(&self) -> u64 {
        self.iterations
    }
}

/// Inverse of the Runge-Kutta matrix, its real eigenvalue and one of the complex pair: roots of
/// `z^3 - 12 z^2 + 60 z - 120`, the denominator of the Pade approximation.
fn inverse() -> (Matrix3<f64>, f64, Complex<f64>) {
    let matrix = Matrix3::new(
        5.0 / 36.0,
        2.0 / 9.0 - ROOT / 15.0,
        5.0 / 36.0 - ROOT / 30.0,
        5.0 / 36.0 + ROOT / 24.0,
        2.0 / 9.0,
        5.0 / 36.0 - ROOT / 24.0,
        5.0 / 36.0 + ROOT / 30.0,
        2.0 / 9.0 + ROOT / 15.0,
        5.0 / 36.0,
    );
    let mut z = 4.64_f64;
    for _ in 0..20 {
        let value = ((z - 12.0) * z + 60.0) * z - 120.0;
        z -= value / ((3.0 * z - 24.0) * z + 60.0);
    }
    let half = 0.5 * (12.0 - z);
    let complex = Complex::new(half, (120.0 / z - half * half).sqrt());
    (matrix.try_inverse().unwrap_or_default(), z, complex)
}

/// The matrices to and from the eigenvectors: real, real part, negative imaginary part.
fn transformation(inverse: &Matrix3<f64>, real: f64, complex: Complex<f64>) -> (Square, Square) {
    let wide = inverse.map(|x| Complex::new(x, 0.0));
    let vector = |value: Complex<f64>| {
        let shifted = wide - Matrix3::identity() * value;
        let row = |i: usize| shifted.row(i).transpose();
        row(0).cross(&row(1))
    };
    let (first, pair) = (vector(Complex::new(real, 0.0)), vector(complex));
    let columns = [first.map(|x| x.re), pair.map(|x| x.re), pair.map(|x| -x.im)];
    let back = Matrix3::from_columns(&columns);
    (rows(&back.try_inverse().unwrap_or_default()), rows(&back))
}

fn rows(matrix: &Matrix3<f64>) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}

fn product(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Weights of the stages in the value at `s` of the polynomial through zero at 0 and them.
fn lagrange(s: f64) -> [f64; 3] {
    std::array::from_fn(|i| {
        let others = (0..3).filter(|j| *j != i);
        others.fold(s / C[i], |value, j| value * (s - C[j]) / (C[i] - C[j]))
    })
}

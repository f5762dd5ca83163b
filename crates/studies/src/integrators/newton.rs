//! Newton's method with one solve an iteration. The tangent is kept, from step to step too, while that
//! converges fast; where it does not, it is made anew at the iterate.

use flexbody::integrators::Tolerance;
use flexbody::system::Dynamics;

/// Equation `r = 0` of a step, with corrections `(m I + w R + K)^-1 r`.
pub trait Equation {
    /// Residual, an acceleration.
    fn residual(&mut self, dynamics: &mut dyn Dynamics, r: &mut [f64]);
    /// Applies a correction of the positions; its size in units of the tolerance.
    fn correct(&mut self, dynamics: &mut dyn Dynamics, correction: &[f64]) -> f64;
    /// Linearizes at the iterate.
    fn linearize(&self, dynamics: &mut dyn Dynamics);
}

/// Size of the error that is left, in units of the tolerance.
const GOAL: f64 = 0.03;
/// Rate of convergence beyond which the tangent is made anew.
const SLOW: f64 = 0.1;
/// Most iterations.
const ITERATIONS: u32 = 15;
/// Growth of a correction by a new tangent beyond which the iteration diverges.
const DIVERGING: f64 = 20.0;

/// State of the iteration.
pub struct Newton {
    r: Vec<f64>,
    /// Weights of inertia and damping for which the factors were made, if there are any.
    factored: Option<[f64; 2]>,
    tangent: bool,
    /// Whether solves rotate the tangent along with directions, as those of the product's Radau do.
    turned: bool,
    /// Rate of convergence seen last with the tangent that is kept.
    rate: f64,
    /// Iterations since the last reset.
    pub iterations: u64,
}

impl Newton {
    /// For `n` coordinates, with a tangent that stays as it is or rotates along.
    pub fn new(n: usize, turned: bool) -> Self {
        Self {
            turned,
            r: vec![0.0; n],
            factored: None,
            tangent: false,
            rate: 1.0,
            iterations: 0,
        }
    }

    /// Forgets the tangent.
    pub fn reset(&mut self) {
        self.tangent = false;
        self.rate = 1.0;
        self.iterations = 0;
    }

    /// Solves with the last factors.
    pub fn solve_last(&self, dynamics: &mut dyn Dynamics, x: &mut [f64]) {
        dynamics.solve(x);
    }

    fn solve_turned(&mut self, dynamics: &mut dyn Dynamics) {
        if self.turned {
            dynamics.set_stage(0);
            dynamics.solve_stages(&[1.0], &[1.0], std::slice::from_mut(&mut self.r));
        } else {
            dynamics.solve(&mut self.r);
        }
    }

    /// Solves with these weights of inertia and damping.
    ///
    /// # Errors
    /// The fraction of the step to try instead.
    pub fn solve(
        &mut self,
        dynamics: &mut dyn Dynamics,
        equation: &mut impl Equation,
        weights: [f64; 2],
    ) -> Result<(), f64> {
        let mut before = 0.0;
        for k in 0..ITERATIONS {
            equation.residual(dynamics, &mut self.r);
            let is_new = !self.tangent;
            if is_new {
                equation.linearize(dynamics);
                self.tangent = true;
                self.factored = None;
                self.rate = 1.0;
            }
            if self.factored != Some(weights) {
                // Iterates may be compressed so far that the tangent is indefinite; its factors still serve.
                dynamics.factor(weights);
                self.factored = Some(weights);
            }
            self.solve_turned(dynamics);
            let size = equation.correct(dynamics, &self.r);
            self.iterations += 1;
            if !size.is_finite() {
                self.tangent = false;
                return Err(0.25);
            }
            if k > 0 {
                let ratio: f64 = size / before;
                if ratio > DIVERGING && k > 2 {
                    self.tangent = false;
                    return Err(0.5);
                }
                self.rate = ratio;
            }
            // Before there is a ratio the correction itself counts: what is left in stiff directions is small
            // as a displacement, not as a force.
            let left = match k {
                0 => 1.0,
                _ if self.rate < 0.9 => self.rate / (1.0 - self.rate),
                _ => 10.0,
            };
            if left * size <= GOAL {
                self.tangent = k == 0 || self.rate < 0.5;
                return Ok(());
            }
            if k > 0 && self.rate > SLOW {
                self.tangent = false;
            }
            before = size;
        }
        self.tangent = false;
        Err(0.5)
    }
}

/// Loosest tolerance that the iteration works to: what it leaves in stiff directions makes vibrations
/// that cost more than it saves.
const LOOSEST: f64 = 1e-5;

/// Size of a correction of positions and of velocities `rate` times it, in units of a tolerance.
pub fn size(correction: &[f64], rate: f64, tolerance: &Tolerance) -> f64 {
    let norm = correction.iter().map(|x| x * x).sum::<f64>().sqrt();
    let relative = tolerance.relative.min(LOOSEST);
    norm * (1.0 + rate * tolerance.time) / (tolerance.position * relative)
}

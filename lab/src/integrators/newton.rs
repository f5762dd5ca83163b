//! Newton's method with one solve an iteration. The tangent is kept, from step to step too, while that
//! converges fast; where it does not, it is made anew at the iterate.

use flexbody::integrators::Tolerance;
use flexbody::system::Dynamics;
use nalgebra::Complex;

/// What a step solves: `r = 0`, with corrections `(s^2 I + s R + K)^-1 r`.
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
    /// For what the factors were made; 0 for nothing.
    factored: f64,
    tangent: bool,
    /// Whether solves turn the tangent along with directions, as those of the product's Radau do: through
    /// its solve for three stages, two of which are idle.
    turned: bool,
    stages: [Vec<f64>; 3],
    /// Rate of convergence seen last with the tangent that is kept.
    rate: f64,
    /// Iterations since the last reset.
    pub iterations: u64,
}

impl Newton {
    /// For `n` coordinates, with a tangent that stays as it is or turns along.
    pub fn new(n: usize, turned: bool) -> Self {
        let zero = vec![0.0; if turned { n } else { 0 }];
        Self {
            turned,
            stages: [zero.clone(), zero.clone(), zero],
            r: vec![0.0; n],
            factored: 0.0,
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
            const FIRST: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
            dynamics.set_stage(0);
            self.stages[0].copy_from_slice(&self.r);
            dynamics.solve_stages(&FIRST, &FIRST, &mut self.stages);
            self.r.copy_from_slice(&self.stages[0]);
        } else {
            dynamics.solve(&mut self.r);
        }
    }

    /// Solves; `Err` is the fraction of the step to try instead.
    pub fn solve(
        &mut self,
        dynamics: &mut dyn Dynamics,
        equation: &mut impl Equation,
        s: f64,
    ) -> Result<(), f64> {
        let mut before = 0.0;
        for k in 0..ITERATIONS {
            equation.residual(dynamics, &mut self.r);
            let is_new = !self.tangent;
            if is_new {
                equation.linearize(dynamics);
                self.tangent = true;
                self.factored = 0.0;
                self.rate = 1.0;
            }
            if self.factored != s {
                // Iterates may be compressed so far that the tangent is indefinite; its factors still serve.
                dynamics.factor(s);
                if self.turned && self.iterations == 0 {
                    // The idle stages only need some factors.
                    dynamics.factor_complex(Complex::new(s, s));
                }
                self.factored = s;
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

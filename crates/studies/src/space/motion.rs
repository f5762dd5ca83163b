//! Motion of one rod by Nystrom's explicit method with fixed steps.
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993),
//! section II.14, classical method of Nystrom: order 4 with three accelerations a step, for forces without velocities.

use std::time::Duration;

use cpu_time::ThreadTime;

use super::problem::Problem;
use crate::elements::band::Band;
use crate::elements::rod::{Rod, Vector};

/// Largest stable product of step and frequency.
pub const STABLE: f64 = 2.586;
/// Iterations for the largest frequency; it converges from below.
const POWER: usize = 300;

/// A rod that moves.
pub struct Motion<'a, const F: usize> {
    rod: Rod<F>,
    problem: &'a Problem,
    mass: Band,
    weight: Vec<Vector>,
    k: [Vec<Vector>; 3],
    stage: Vec<Vector>,
}

impl<'a, const F: usize> Motion<'a, F> {
    /// A rod of a problem; nothing where the mass is not positive definite.
    pub fn new(rod: Rod<F>, problem: &'a Problem) -> Option<Self> {
        let mut mass = rod.mass();
        if problem.held {
            mass.hold(0);
        }
        let positive = mass.factor();
        let g = problem.gravity;
        let density = problem.material.density;
        let weight = rod.loads(|_| [density * g[0], density * g[1]]);
        let n = rod.functions();
        let zeros = || vec![[0.0; 2]; n];
        positive.then(|| Self {
            k: std::array::from_fn(|_| zeros()),
            stage: zeros(),
            rod,
            problem,
            mass,
            weight,
        })
    }

    /// The rod.
    pub fn rod(&self) -> &Rod<F> {
        &self.rod
    }

    /// Number of free coordinates.
    pub fn coordinates(&self) -> usize {
        2 * (self.rod.functions() - usize::from(self.problem.held))
    }

    /// CPU time of what an iteration of an implicit method takes: tangent, factor and solve, by bands;
    /// the mean of a number of them.
    pub fn time_iteration(&self, c: &[Vector], times: u32) -> Duration {
        let n = c.len();
        let mut matrix = Band::zeros(2 * n, 2 * F - 1);
        let mut residual = vec![0.0; 2 * n];
        let started = ThreadTime::now();
        for _ in 0..times {
            matrix.clear();
            self.rod.add_stiffness(c, &mut matrix);
            // Any positive shift in the place of the mass over the square of the step.
            (0..2 * n).for_each(|i| *matrix.at(i, i) += self.problem.material.axial);
            matrix.factor();
            residual.fill(1.0);
            matrix.solve_any(&mut residual);
            std::hint::black_box(&residual);
        }
        started.elapsed() / times
    }

    /// Accelerations of the coordinates.
    pub fn acceleration(&self, t: f64, c: &[Vector], out: &mut [Vector]) {
        out.copy_from_slice(&self.weight);
        self.rod.add_force(c, out);
        self.problem.add_load(&self.rod, t, c, out);
        self.finish(out);
    }

    fn finish(&self, out: &mut [Vector]) {
        if self.problem.held {
            out[0] = [0.0; 2];
        }
        self.mass.solve::<2, F>(out);
    }

    /// Largest frequency at a configuration, rad/s.
    pub fn largest_frequency(&self, c: &[Vector]) -> f64 {
        let n = c.len();
        let mut stiffness = Band::zeros(2 * n, 2 * F - 1);
        self.rod.add_stiffness(c, &mut stiffness);
        let mut x: Vec<Vector> = (0..n)
            .map(|i| {
                let i = i as f64;
                [(1.7 * i * i).sin(), (2.3 * i * i).cos()]
            })
            .collect();
        let mut square: f64 = 0.0;
        let mut flat = vec![[0.0]; 2 * n];
        for _ in 0..POWER {
            let xs: Vec<[f64; 1]> = x.iter().flat_map(|x| [[x[0]], [x[1]]]).collect();
            stiffness.multiply(&xs, &mut flat);
            let mut y: Vec<Vector> = flat.chunks(2).map(|y| [y[0][0], y[1][0]]).collect();
            self.finish(&mut y);
            let norm = |x: &[Vector]| x.iter().map(|x| x[0] * x[0] + x[1] * x[1]).sum::<f64>();
            square = (norm(&y) / norm(&x)).sqrt();
            x = y.iter().map(|y| [y[0] / square, y[1] / square]).collect();
        }
        square.sqrt()
    }

    /// One step from `t`.
    pub fn step(&mut self, t: f64, h: f64, c: &mut [Vector], v: &mut [Vector]) {
        let mut k = std::mem::take(&mut self.k);
        let mut stage = std::mem::take(&mut self.stage);
        let predict =
            |stage: &mut [Vector], part: f64, k: &[Vector], c: &[Vector], v: &[Vector]| {
                let square = 0.5 * part * part * h * h;
                for i in 0..c.len() {
                    for a in 0..2 {
                        stage[i][a] = c[i][a] + part * h * v[i][a] + square * k[i][a];
                    }
                }
            };
        self.acceleration(t, c, &mut k[0]);
        predict(&mut stage, 0.5, &k[0], c, v);
        self.acceleration(t + 0.5 * h, &stage, &mut k[1]);
        predict(&mut stage, 1.0, &k[1], c, v);
        self.acceleration(t + h, &stage, &mut k[2]);
        for i in 0..c.len() {
            for a in 0..2 {
                let [k1, k2, k3] = [k[0][i][a], k[1][i][a], k[2][i][a]];
                c[i][a] += h * v[i][a] + h * h / 6.0 * (k1 + 2.0 * k2);
                v[i][a] += h / 6.0 * (k1 + 4.0 * k2 + k3);
            }
        }
        self.k = k;
        self.stage = stage;
    }
}

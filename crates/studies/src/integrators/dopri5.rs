//! Dormand and Prince 5(4): explicit Runge-Kutta, seven stages, the last is the first of the next step.
//!
//! Source: J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19-26, Table 2 (RK5(4)7M); E. Hairer,
//! S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., Table II.5.2.

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance, rescaled};
use flexbody::system::Dynamics;

const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const A: [&[f64]; 7] = [
    &[],
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19_372.0 / 6_561.0,
        -25_360.0 / 2_187.0,
        64_448.0 / 6_561.0,
        -212.0 / 729.0,
    ],
    &[
        9_017.0 / 3_168.0,
        -355.0 / 33.0,
        46_732.0 / 5_247.0,
        49.0 / 176.0,
        -5_103.0 / 18_656.0,
    ],
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1_113.0,
        125.0 / 192.0,
        -2_187.0 / 6_784.0,
        11.0 / 84.0,
    ],
];
/// Weights of order 5 less those of order 4.
const ERROR: [f64; 7] = [
    71.0 / 57_600.0,
    0.0,
    -71.0 / 16_695.0,
    71.0 / 1_920.0,
    -17_253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Scratch of the method.
pub struct Dopri5 {
    /// Rates and accelerations of the stages.
    dq: [Vec<f64>; 7],
    dv: [Vec<f64>; 7],
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Dopri5 {
    /// For `n` coordinates.
    pub fn new(n: usize) -> Self {
        let stages = || std::array::from_fn(|_| vec![0.0; n]);
        Self {
            dq: stages(),
            dv: stages(),
            q: vec![0.0; n],
            v: vec![0.0; n],
        }
    }
}

impl OneStepMethod for Dopri5 {
    fn name(&self) -> &'static str {
        "dopri5"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.dq[0].copy_from_slice(v);
        dynamics.acceleration(time, q, v, &mut self.dv[0]);
    }

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
        for stage in 1..7 {
            self.q.copy_from_slice(q);
            self.v.copy_from_slice(v);
            for (j, weight) in A[stage].iter().enumerate() {
                add(h * weight, &self.dq[j], &mut self.q);
                add(h * weight, &self.dv[j], &mut self.v);
            }
            self.dq[stage].copy_from_slice(&self.v);
            let at = time + C[stage] * h;
            dynamics.acceleration(at, &self.q, &self.v, &mut self.dv[stage]);
        }
        let (mut p, mut u) = (0.0, 0.0);
        for i in 0..q.len() {
            let of = |stages: &[Vec<f64>; 7]| -> f64 {
                let terms = ERROR.iter().zip(stages);
                h * terms.map(|(e, stage)| e * stage[i]).sum::<f64>()
            };
            p += of(&self.dq).powi(2);
            u += of(&self.dv).powi(2);
        }
        Attempt::Done(rescaled(
            tolerance.error_norm(&[p.sqrt()], &[u.sqrt()]),
            5.0,
        ))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        // The last stage is the end.
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        self.dq.swap(0, 6);
        self.dv.swap(0, 6);
    }

    fn acceleration(&self) -> &[f64] {
        &self.dv[0]
    }
}

fn add(factor: f64, x: &[f64], y: &mut [f64]) {
    if factor != 0.0 {
        y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
    }
}

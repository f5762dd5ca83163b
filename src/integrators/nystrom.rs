//! Explicit methods for `q'' = a(t, q)`, where accelerations read no rates: the last stage is the end of
//! the step and the first of the next, so that a step costs one evaluation less than it has stages.
//!
//! Source: L. Verlet, Phys. Rev. 159 (1967) in its velocity form, as a Nystrom method (E. Hairer, C.
//! Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., Eq. I.1.17); J. R. Dormand, M. E. A.
//! El-Mikkawy, P. J. Prince, Families of Runge-Kutta-Nystrom formulae, IMA J. Numer. Anal. 7 (1987)
//! 235-250: RKN4(3)4FM (Table 3).

use super::selection::cheaper_of_pair;
use super::{Attempt, ErrorEstimate, OneStepMethod, StateView, Tolerance, rescaled};
use crate::math::sums::{Term, combine};
use crate::system::{DenseStep, Dynamics};

/// Part of the stability limit that is used: the bound on the frequency is that of the reference
/// configuration.
const MARGIN: f64 = 0.9;

/// Coefficients of a method.
#[derive(Debug, PartialEq)]
pub struct Tableau {
    /// Name of the method.
    pub name: &'static str,
    /// Stability limit: longest step times frequency.
    pub limit: f64,
    /// Times of the stages.
    pub c: &'static [f64],
    /// Weights of accelerations in the positions of the stages; the last is the end of the step.
    pub a: &'static [&'static [f64]],
    /// Weights in the velocity at the end.
    pub rates: &'static [f64],
    /// Weights in the errors of position and velocity: method less embedded method.
    pub error: [&'static [f64]; 2],
    /// Power of the step in the error estimate.
    pub power: f64,
}

/// Velocity Verlet: order 2, one evaluation a step, conserves energy on average at steps of equal
/// length. Its error estimate is its leading error in position, `h^2 (a1 - a0) / 6`, and as much over the
/// step in velocity: of the order of the error that remains at the end.
pub static VERLET: Tableau = Tableau {
    name: "verlet",
    limit: 2.0,
    c: &[0.0, 1.0],
    a: &[&[], &[0.5]],
    rates: &[0.5, 0.5],
    error: [&[-1.0 / 6.0, 1.0 / 6.0], &[-1.0 / 6.0, 1.0 / 6.0]],
    power: 2.0,
};

/// Order 4 with 3, three evaluations a step.
pub static RKN43: Tableau = Tableau {
    name: "rkn43",
    limit: 3.767,
    c: &[0.0, 0.25, 0.7, 1.0],
    a: &[
        &[],
        &[1.0 / 32.0],
        &[7.0 / 1_000.0, 119.0 / 500.0],
        &[1.0 / 14.0, 8.0 / 27.0, 25.0 / 189.0],
    ],
    rates: &[1.0 / 14.0, 32.0 / 81.0, 250.0 / 567.0, 5.0 / 54.0],
    error: [
        &[
            1.0 / 14.0 + 7.0 / 150.0,
            8.0 / 27.0 - 67.0 / 150.0,
            25.0 / 189.0 - 3.0 / 20.0,
            1.0 / 20.0,
        ],
        &[
            1.0 / 14.0 - 13.0 / 21.0,
            32.0 / 81.0 + 20.0 / 27.0,
            250.0 / 567.0 - 275.0 / 189.0,
            5.0 / 54.0 + 1.0 / 3.0,
        ],
    ],
    power: 4.0,
};

/// Nodes of [`RKN64`].
const C64: [f64; 6] = [
    0.0,
    1.0 / 4.0,
    31.0 / 100.0,
    73.0 / 100.0,
    125.0 / 159.0,
    1.0,
];
/// Error of the velocity that [`RKN64`] estimates: this part of the fourth divided difference of the accelerations. The embedded
/// methods of order 4 differ by it alone.
const SHARE64: f64 = 2e-4;
/// Fourth divided difference over the first five nodes of [`RKN64`].
const DIFFERENCE64: [f64; 5] = [
    50_880.0 / 2_263.0,
    -265_000.0 / 1_023.0,
    1_325_000_000.0 / 4_928_721.0,
    -165_625_000.0 / 1_368_969.0,
    204_521_267_520.0 / 2_305_467_923.0,
];

/// Order 6 with 4, five evaluations a step.
///
/// A member of the family of RKN6(4)6FM, whose nodes `c2`, `c3`, `c4` are free (`c5` and all weights follow from the conditions of
/// order 6; 1/10, 3/10, 7/10 give RKN6(4)6FM itself). That one amplifies every oscillation, by 1e-7 a step of one radian. The nodes
/// here were searched for: this member damps every oscillation up to its limit, and its principal error (norm of the nine coefficients
/// of order 7 in the velocity) is 5.5e-5 against 3.4e-5.
pub static RKN64: Tableau = Tableau {
    name: "rkn64",
    limit: 4.975,
    c: &C64,
    a: &[
        &[],
        &[1.0 / 32.0],
        &[6_913.0 / 500_000.0, 2_139.0 / 62_500.0],
        &[
            143_340_829.0 / 2_154_500_000.0,
            -39_712.0 / 2_171_875.0,
            23_506.0 / 107_725.0,
        ],
        &[
            2_383_359_257_375.0 / 14_836_739_700_654.0,
            -1_342_326_338_375.0 / 812_972_038_392.0,
            610_293_578_125.0 / 304_864_514_397.0,
            -36_022_936_296_875.0 / 178_040_876_407_848.0,
        ],
        &[
            23_237.0 / 282_875.0,
            4_031.0 / 24_552.0,
            2_084_375.0 / 14_786_163.0,
            434_375.0 / 3_650_584.0,
            -3_621_730_779.0 / 576_366_980_750.0,
        ],
    ],
    rates: &[
        23_237.0 / 282_875.0,
        4_031.0 / 18_414.0,
        9_062_500.0 / 44_358_489.0,
        10_859_375.0 / 24_641_442.0,
        -33_873_834_933.0 / 1_152_733_961_500.0,
        1.0 / 12.0,
    ],
    error: [
        &[
            SHARE64 * (1.0 - C64[0]) * DIFFERENCE64[0],
            SHARE64 * (1.0 - C64[1]) * DIFFERENCE64[1],
            SHARE64 * (1.0 - C64[2]) * DIFFERENCE64[2],
            SHARE64 * (1.0 - C64[3]) * DIFFERENCE64[3],
            SHARE64 * (1.0 - C64[4]) * DIFFERENCE64[4],
            // Counts only where it is not finite.
            0.0,
        ],
        &[
            SHARE64 * DIFFERENCE64[0],
            SHARE64 * DIFFERENCE64[1],
            SHARE64 * DIFFERENCE64[2],
            SHARE64 * DIFFERENCE64[3],
            SHARE64 * DIFFERENCE64[4],
            0.0,
        ],
    ],
    power: 5.0,
};

/// How many times longer the second of two methods steps than the first where errors set their steps: 1.8 to 2.6 times
/// ([`RKN64`] and [`RKN43`], tolerances from 1e-4 to 1e-7).
const LONGER: f64 = 2.2;

/// A Nystrom method, or two of which the cheaper goes on, with their scratch.
#[derive(Clone, Debug)]
pub struct Nystrom {
    tableaux: [&'static Tableau; 2],
    /// Index of the one in use.
    variant: usize,
    frequency: f64,
    /// Accelerations of the stages.
    a: Vec<Vec<f64>>,
    q: Vec<f64>,
    v: Vec<f64>,
    error_q: Vec<f64>,
    error_v: Vec<f64>,
}

impl Nystrom {
    /// For `n` coordinates whose fastest oscillation is `frequency` (rad/s).
    pub fn new(tableau: &'static Tableau, n: usize, frequency: f64) -> Self {
        Self::pair([tableau; 2], n, frequency)
    }

    /// Builds a pair of methods of which the cheaper one is used. It begins with the first, whose order is lower.
    pub fn pair(tableaux: [&'static Tableau; 2], n: usize, frequency: f64) -> Self {
        let zero = vec![0.0; n];
        let stages = tableaux.map(|tableau| tableau.c.len());
        Self {
            a: vec![zero.clone(); stages[0].max(stages[1])],
            tableaux,
            variant: 0,
            frequency,
            q: zero.clone(),
            v: zero.clone(),
            error_q: zero.clone(),
            error_v: zero,
        }
    }

    fn tableau(&self) -> &'static Tableau {
        self.tableaux[self.variant]
    }

    /// Accelerations that the steps to an end take that is `remaining` (s) away, where errors allow steps of `h` (s).
    fn price(&self, variant: usize, h: f64, remaining: f64) -> f64 {
        let tableau = self.tableaux[variant];
        let longest = MARGIN * tableau.limit / self.frequency;
        (remaining / h.min(longest)).ceil() * (tableau.c.len() - 1) as f64
    }
}

/// `out = start + factor * sum of the weighted vectors`.
fn set(out: &mut [f64], start: &[Term<'_>], factor: f64, weights: &[f64], a: &[Vec<f64>]) {
    let weighted = weights.iter().zip(a);
    let weighted = weighted.map(|(weight, a)| (factor * weight, &a[..]));
    combine(out, start.iter().copied().chain(weighted));
}

impl OneStepMethod for Nystrom {
    fn name(&self) -> &'static str {
        self.tableau().name
    }

    fn longest_step(&self) -> f64 {
        MARGIN * self.tableau().limit / self.frequency
    }

    fn fewest_operations(&self) -> f64 {
        (self.tableau().c.len() - 1) as f64
    }

    fn use_variant(&mut self, variant: usize) {
        self.variant = variant;
    }

    fn cheaper(&self, h: f64, remaining: f64) -> Option<(usize, f64)> {
        cheaper_of_pair(self.variant, h, LONGER, |variant, h| {
            self.price(variant, h, remaining)
        })
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a[0]);
    }

    fn error(
        &mut self,
        _: &mut dyn Dynamics,
        _: StateView<'_>,
        _: Option<&DenseStep>,
        error: ErrorEstimate<'_>,
    ) {
        error.position.copy_from_slice(&self.error_q);
        error.velocity.copy_from_slice(&self.error_v);
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
        let tableau = self.tableau();
        for (stage, c) in tableau.c.iter().enumerate().skip(1) {
            let start = [(1.0, q), (c * h, v)];
            set(&mut self.q, &start, h * h, tableau.a[stage], &self.a);
            dynamics.acceleration(time + c * h, &self.q, v, &mut self.a[stage]);
        }
        set(&mut self.v, &[(1.0, v)], h, tableau.rates, &self.a);
        let [position, velocity] = tableau.error;
        set(&mut self.error_q, &[], h * h, position, &self.a);
        set(&mut self.error_v, &[], h, velocity, &self.a);
        Attempt::Done(rescaled(
            tolerance.error_norm(&self.error_q, &self.error_v)
                * dynamics.steps_in(tolerance.time, h),
            tableau.power,
        ))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        let last = self.tableau().c.len() - 1;
        self.a.swap(0, last);
    }

    fn acceleration(&self) -> &[f64] {
        &self.a[0]
    }
}

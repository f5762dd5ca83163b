//! Small problems with the face of a mechanical system.

use flexbody::system::{Dynamics, State, StepOutcome};
use nalgebra::{Complex, Matrix2, Vector2};

/// Acceleration from time, coordinates and rates.
pub type Law = fn(f64, Vector2<f64>, Vector2<f64>) -> Vector2<f64>;

/// `q'' = a(t, q, v)` in two coordinates with `K = -da/dq` and `R = -da/dv`.
pub struct Problem {
    acceleration: Law,
    tangent: fn(Vector2<f64>, Vector2<f64>) -> [Matrix2<f64>; 2],
    stiffness: Matrix2<f64>,
    damping: Matrix2<f64>,
    real: Matrix2<f64>,
    complex: Matrix2<Complex<f64>>,
    /// Calls of `acceleration`, and accepted steps.
    pub calls: u32,
    pub most_calls: u32,
    pub steps: u32,
    /// Power that comes in and that is dissipated, from time and rates.
    pub powers: fn(f64, Vector2<f64>) -> [f64; 2],
    power: [f64; 2],
    /// Times that no step may lead across.
    pub breaks: Vec<f64>,
    /// Whether steps may lead beyond communication points.
    pub is_smooth: bool,
    /// Projection of accepted states.
    pub settle: fn(&mut State) -> StepOutcome,
}

impl Problem {
    pub fn new(
        acceleration: Law,
        tangent: fn(Vector2<f64>, Vector2<f64>) -> [Matrix2<f64>; 2],
    ) -> Self {
        Self {
            acceleration,
            tangent,
            stiffness: Matrix2::zeros(),
            damping: Matrix2::zeros(),
            real: Matrix2::zeros(),
            complex: Matrix2::zeros(),
            calls: 0,
            most_calls: u32::MAX,
            steps: 0,
            powers: |_, _| [0.0; 2],
            power: [0.0; 2],
            breaks: Vec::new(),
            is_smooth: false,
            settle: |_| StepOutcome::AsIs,
        }
    }
}

fn pair(x: &[f64]) -> Vector2<f64> {
    Vector2::from_column_slice(x)
}

impl Dynamics for Problem {
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        self.calls += 1;
        assert!(self.calls < 1_000_000, "an endless crawl at {q:?}");
        a.copy_from_slice((self.acceleration)(time, pair(q), pair(v)).as_slice());
        self.power = (self.powers)(time, pair(v));
    }

    fn power(&mut self) -> [f64; 2] {
        self.power
    }

    fn linearize(&mut self, _time: f64, q: &[f64], v: &[f64]) {
        [self.stiffness, self.damping] = (self.tangent)(pair(q), pair(v));
    }

    fn factor(&mut self, [inertia, damping]: [f64; 2]) -> bool {
        let a = Matrix2::identity() * inertia + self.damping * damping + self.stiffness;
        a.try_inverse().is_some_and(|inverse| {
            self.real = inverse;
            true
        })
    }

    fn factor_complex(&mut self, [inertia, damping]: [Complex<f64>; 2]) -> bool {
        let complex = |m: Matrix2<f64>| m.map(|x| Complex::new(x, 0.0));
        let shift = Matrix2::from_diagonal_element(inertia);
        let a = shift + complex(self.damping) * damping + complex(self.stiffness);
        a.try_inverse().is_some_and(|inverse| {
            self.complex = inverse;
            true
        })
    }

    fn solve(&mut self, x: &mut [f64]) {
        let y = self.real * pair(x);
        x.copy_from_slice(y.as_slice());
    }

    // All stages share the tangent here.
    fn set_stage(&mut self, _stage: usize) {}

    fn solve_stages(&mut self, forward: &[f64], back: &[f64], stages: &mut [Vec<f64>]) {
        let mix = |rows: &[f64], x: [Vector2<f64>; 3]| -> [Vector2<f64>; 3] {
            let row =
                |i: usize| x[0] * rows[3 * i] + x[1] * rows[3 * i + 1] + x[2] * rows[3 * i + 2];
            [row(0), row(1), row(2)]
        };
        let [real, re, im] = mix(forward, [0, 1, 2].map(|i| pair(&stages[i])));
        let z = self.complex * re.zip_map(&im, Complex::new);
        let solved = mix(back, [self.real * real, z.map(|z| z.re), z.map(|z| z.im)]);
        for (stage, x) in stages.iter_mut().zip(solved) {
            stage.copy_from_slice(x.as_slice());
        }
    }

    fn apply_damping(&mut self, x: &mut [f64]) {
        let y = self.damping * pair(x);
        x.copy_from_slice(y.as_slice());
    }

    fn largest_rotation(&mut self, _from: &[f64], _to: &[f64]) -> f64 {
        0.0
    }

    fn accepted(&mut self, state: &mut State) -> StepOutcome {
        self.steps += 1;
        (self.settle)(state)
    }

    fn unchanged_until(&self, from: f64, to: f64) -> f64 {
        if self.is_smooth { to } else { from }
    }

    fn is_exhausted(&self) -> bool {
        self.calls >= self.most_calls
    }

    fn begin_smooth_interval(&mut self, from: f64, until: f64) -> f64 {
        let next = self.breaks.iter().find(|t| **t > from);
        next.map_or(until, |t| t.min(until))
    }

    fn end_smooth_interval(&mut self, _state: &mut State) -> StepOutcome {
        StepOutcome::AsIs
    }
}

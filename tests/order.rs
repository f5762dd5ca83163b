//! Every integrator has the order, the stability and the error control that it claims. Row by row for
//! each method; a new one is a new row.

use flexbody::integrators::{Attempt, Method, Radau, Rk4, Stop, Tolerance, advance};
use flexbody::system::{Dynamics, State};
use nalgebra::{Complex, Matrix2, Vector2};

/// `q'' = a(q, v)` in two coordinates with `K = -da/dq` and `R = -da/dv`.
struct Problem {
    acceleration: fn(Vector2<f64>, Vector2<f64>) -> Vector2<f64>,
    tangent: fn(Vector2<f64>, Vector2<f64>) -> [Matrix2<f64>; 2],
    stiffness: Matrix2<f64>,
    damping: Matrix2<f64>,
    real: Matrix2<f64>,
    complex: Matrix2<Complex<f64>>,
    /// Calls of `acceleration`, and accepted steps.
    calls: u32,
    steps: u32,
}

impl Problem {
    fn new(
        acceleration: fn(Vector2<f64>, Vector2<f64>) -> Vector2<f64>,
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
            steps: 0,
        }
    }
}

fn pair(x: &[f64]) -> Vector2<f64> {
    Vector2::from_column_slice(x)
}

impl Dynamics for Problem {
    fn coordinates(&self) -> usize {
        2
    }

    fn acceleration(&mut self, q: &[f64], v: &[f64], a: &mut [f64]) {
        self.calls += 1;
        assert!(self.calls < 1_000_000, "an endless crawl at {q:?}");
        a.copy_from_slice((self.acceleration)(pair(q), pair(v)).as_slice());
    }

    fn linearize(&mut self, q: &[f64], v: &[f64]) {
        [self.stiffness, self.damping] = (self.tangent)(pair(q), pair(v));
    }

    fn factor(&mut self, s: f64) -> bool {
        let a = Matrix2::identity() * (s * s) + self.damping * s + self.stiffness;
        a.try_inverse().is_some_and(|inverse| {
            self.real = inverse;
            true
        })
    }

    fn factor_complex(&mut self, s: Complex<f64>) -> bool {
        let complex = |m: Matrix2<f64>| m.map(|x| Complex::new(x, 0.0));
        let shift = Matrix2::from_diagonal_element(s * s);
        let a = shift + complex(self.damping) * s + complex(self.stiffness);
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

    fn solve_stages(
        &mut self,
        forward: &[[f64; 3]; 3],
        back: &[[f64; 3]; 3],
        stages: &mut [Vec<f64>; 3],
    ) {
        let mix = |rows: &[[f64; 3]; 3], x: [Vector2<f64>; 3]| {
            rows.map(|row| x[0] * row[0] + x[1] * row[1] + x[2] * row[2])
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

    fn largest_turn(&mut self, _from: &[f64], _to: &[f64]) -> f64 {
        0.0
    }

    fn accepted(&mut self, _state: &mut State) {
        self.steps += 1;
    }
}

/// A method with its name, order and a sequence of numbers of steps fine enough to show it.
struct Row {
    name: &'static str,
    order: f64,
    make: fn() -> Box<dyn Method>,
    steps: [u32; 3],
}

const ROWS: [Row; 2] = [
    Row {
        name: "rk4",
        order: 4.0,
        make: || Box::new(Rk4::new(2, 1.0, 0.0)),
        steps: [40, 80, 160],
    },
    Row {
        name: "radau",
        order: 5.0,
        make: || Box::new(Radau::new(2)),
        steps: [8, 16, 32],
    },
];

const TIGHT: Tolerance = Tolerance {
    relative: 1e-12,
    position: 1.0,
    time: 1.0,
};

/// The solution of [`driven`].
fn exact(t: f64) -> [f64; 2] {
    [1.2 + 0.5 * (2.0 * t).sin(), (2.0 * t).cos()]
}

/// A driven Duffing oscillator with damping that depends on the position; the second coordinate is
/// time, so that the equation knows it.
fn driven() -> Problem {
    fn drive(t: f64) -> f64 {
        let [x, v] = exact(t);
        -2.0 * (2.0 * t).sin() + x * x * x + 0.3 * x * v
    }
    fn drive_rate(t: f64) -> f64 {
        let ([x, v], a) = (exact(t), -2.0 * (2.0 * t).sin());
        -4.0 * (2.0 * t).cos() + 3.0 * x * x * v + 0.3 * (v * v + x * a)
    }
    Problem::new(
        |q, v| Vector2::new(drive(q.y) - q.x.powi(3) - 0.3 * q.x * v.x, 0.0),
        |q, v| {
            let by_x = 3.0 * q.x * q.x + 0.3 * v.x;
            [
                Matrix2::new(by_x, -drive_rate(q.y), 0.0, 0.0),
                Matrix2::new(0.3 * q.x, 0.0, 0.0, 0.0),
            ]
        },
    )
}

/// One step of a given length, whatever its error; returns the estimate of it.
fn force(method: &mut dyn Method, problem: &mut Problem, state: &mut [Vec<f64>; 2], h: f64) -> f64 {
    let [q, v] = state;
    method.begin(problem, q, v);
    match method.attempt(problem, (q, v), h, &TIGHT) {
        Attempt::Done(error) => {
            method.accept(q, v);
            error * TIGHT.relative
        }
        Attempt::Failed(factor) => panic!("the step failed with {factor}"),
    }
}

/// Error after steps of equal length, and the estimate of the first.
fn run(
    row: &Row,
    mut problem: Problem,
    time: f64,
    steps: u32,
    exact: fn(f64) -> [f64; 2],
) -> [f64; 2] {
    let mut method = (row.make)();
    let [x, v] = exact(0.0);
    let mut state = [vec![x, 0.0], vec![v, 1.0]];
    let h = time / f64::from(steps);
    let mut first = None;
    for _ in 0..steps {
        let estimate = force(&mut *method, &mut problem, &mut state, h);
        first.get_or_insert(estimate);
    }
    let [x, v] = exact(time);
    let error = (state[0][0] - x).hypot(state[1][0] - v);
    [error, first.unwrap_or(f64::NAN)]
}

/// Observed order of the last halving, of errors and of estimates.
fn orders(row: &Row, problem: fn() -> Problem, exact: fn(f64) -> [f64; 2]) -> [f64; 2] {
    let runs = row
        .steps
        .map(|steps| run(row, problem(), 2.0, steps, exact));
    println!("{}: errors and estimates {runs:?}", row.name);
    [0, 1].map(|what| (runs[1][what] / runs[2][what]).log2())
}

#[test]
fn methods_converge_with_their_order() {
    for row in &ROWS {
        let [observed, _] = orders(row, driven, exact);
        println!("{}: order {observed:.2}", row.name);
        assert!(
            (observed - row.order).abs() < 0.3,
            "{}: order {observed}",
            row.name
        );
    }
}

#[test]
fn estimates_have_order_three_at_least() {
    for row in &ROWS {
        let [_, observed] = orders(row, driven, exact);
        println!("{}: local estimate of order {observed:.2}", row.name);
        // The error of one step is of one order more than that of the run.
        assert!(observed > 3.7, "{}: order {observed}", row.name);
    }
}

/// Growth of the largest deflection of a linear oscillator `q'' = -w^2 q - 2 z w v` over many steps of
/// `h` = 1, from its first to its second half.
fn growth(method: &mut dyn Method, frequency: f64, ratio: f64) -> f64 {
    thread_local! {
        static LINEAR: std::cell::Cell<[f64; 2]> = const { std::cell::Cell::new([0.0; 2]) };
    }
    LINEAR.set([frequency * frequency, 2.0 * ratio * frequency]);
    let mut problem = Problem::new(
        |q, v| {
            let [k, r] = LINEAR.get();
            -q * k - v * r
        },
        |_, _| LINEAR.get().map(Matrix2::from_diagonal_element),
    );
    let mut state = [vec![1.0, 0.0], vec![0.0, 0.0]];
    let mut largest = [0.0_f64; 2];
    for step in 0..400 {
        force(method, &mut problem, &mut state, 1.0);
        let size = (state[0][0].powi(2) + (state[1][0] / frequency).powi(2)).sqrt();
        largest[step / 200] = largest[step / 200].max(size);
    }
    largest[1] / largest[0]
}

#[test]
fn rk4_is_stable_exactly_as_far_as_it_says() {
    let limit = 8.0_f64.sqrt();
    let mut method = Rk4::new(2, limit, 0.0);
    assert!(
        (method.longest_step() - 0.9).abs() < 1e-12,
        "0.9 of the limit"
    );
    assert!(growth(&mut method, 0.999 * limit, 0.0) < 1.0);
    assert!(growth(&mut method, 1.001 * limit, 0.0) > 1.0);
    // Damped modes at the longest step that the method allows itself.
    for number in 0..=60 {
        let ratio = 0.05 * f64::from(number);
        let (frequency, decay) = (1.0, 2.0 * ratio);
        let h = Rk4::new(2, frequency, decay).longest_step();
        let grown = growth(&mut method, h * frequency, ratio);
        assert!(grown < 1.0, "damping ratio {ratio}: {grown}");
    }
}

#[test]
fn radau_damps_what_is_too_fast_for_the_step() {
    let mut method = Radau::new(2);
    for frequency in [1e2, 1e4, 1e7] {
        for ratio in [0.0, 0.1, 2.0] {
            let grown = growth(&mut method, frequency, ratio);
            assert!(
                grown < 1e-10,
                "h w = {frequency:e}, damping {ratio}: {grown:e}"
            );
        }
    }
    assert_eq!(method.longest_step(), f64::INFINITY);
}

/// A slow oscillation and a stiff mode, turned against each other; it starts on the slow one.
fn stiff() -> Problem {
    const SLOW: f64 = 1.0;
    const FAST: f64 = 1e6;
    fn stiffness() -> Matrix2<f64> {
        let (sin, cos) = 0.6_f64.sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        turn * Matrix2::new(SLOW, 0.0, 0.0, FAST) * turn.transpose()
    }
    Problem::new(
        |q, _| -(stiffness() * q),
        |_, _| [stiffness(), Matrix2::zeros()],
    )
}

#[test]
fn radau_keeps_its_order_beside_a_stiff_mode() {
    let (sin, cos) = 0.6_f64.sin_cos();
    let errors = [4_u32, 8, 16].map(|steps| {
        let (mut method, mut problem) = (Radau::new(2), stiff());
        let mut state = [vec![cos, sin], vec![0.0, 0.0]];
        for _ in 0..steps {
            force(
                &mut method,
                &mut problem,
                &mut state,
                2.0 / f64::from(steps),
            );
        }
        let slow = state[0][0] * cos + state[0][1] * sin;
        let fast = state[0][1] * cos - state[0][0] * sin;
        assert!(fast.abs() < 1e-12, "the stiff mode is excited by {fast:e}");
        (slow - 2.0_f64.cos()).abs()
    });
    let order = (errors[1] / errors[2]).log2();
    println!("radau beside a stiff mode: errors {errors:?}, order {order:.2}");
    assert!((order - 5.0).abs() < 0.3, "order {order}");
}

#[test]
fn radau_follows_a_driven_stiff_spring() {
    // q'' = -w^2 (q - sin t) - sin t: Prothero and Robinson's problem of second order.
    let problem = || {
        Problem::new(
            |q, _| Vector2::new(-1e8 * (q.x - q.y.sin()) - q.y.sin(), 0.0),
            |q, _| {
                let by_time = -1e8 * q.y.cos() + q.y.cos();
                [Matrix2::new(1e8, by_time, 0.0, 0.0), Matrix2::zeros()]
            },
        )
    };
    let row = &ROWS[1];
    let [coarse, fine] =
        [10, 20].map(|steps| run(row, problem(), 2.0, steps, |t| [t.sin(), t.cos()])[0]);
    println!("radau on a driven stiff spring: {coarse:e}, {fine:e}");
    assert!(fine < coarse / 6.0, "order {}", (coarse / fine).log2());
    assert!(coarse < 1e-3);
}

fn started() -> State {
    let [x, v] = exact(0.0);
    State {
        time: 0.0,
        step: 0.0,
        coordinates: vec![x, 0.0],
        rates: vec![v, 1.0],
        angles: Vec::new(),
    }
}

#[test]
fn errors_follow_the_tolerance() {
    for row in &ROWS {
        let errors = [1e-3, 1e-5, 1e-7, 1e-9].map(|relative| {
            let (mut method, mut problem, mut state) = ((row.make)(), driven(), started());
            let tolerance = Tolerance { relative, ..TIGHT };
            let (counts, result) = advance(&mut *method, &mut problem, &mut state, 5.0, &tolerance);
            assert_eq!(result, Ok(()));
            assert_eq!(counts.steps, u64::from(problem.steps));
            let error = (state.coordinates[0] - exact(5.0)[0]).abs();
            assert!(
                error < 100.0 * relative,
                "{}: {error:e} at {relative:e}",
                row.name
            );
            error
        });
        println!("{}: errors {errors:?}", row.name);
        let fall = (errors[0] / errors[3]).log10() / 6.0;
        assert!(fall > 0.6, "{}: errors {errors:?}", row.name);
    }
}

#[test]
fn communication_points_are_met_exactly() {
    for row in &ROWS {
        let (mut method, mut problem, mut state) = ((row.make)(), driven(), started());
        let tolerance = Tolerance {
            relative: 1e-6,
            ..TIGHT
        };
        for until in [1e-9, 0.1, 0.1 + 1e-12, 0.3, 1.0 / 3.0, 2.0, 2.000_001, 5.0] {
            let (_, result) = advance(&mut *method, &mut problem, &mut state, until, &tolerance);
            assert_eq!(result, Ok(()));
            assert_eq!(state.time, until);
            // The second coordinate is time itself.
            let off = (state.coordinates[1] - until).abs();
            assert!(off < 1e-13, "{}: {off:e} at {until}", row.name);
            let error = (state.coordinates[0] - exact(until)[0]).abs();
            assert!(error < 1e-4, "{}: {error:e} at {until}", row.name);
        }
        // Nothing to do is done at once.
        let before = (state.clone(), problem.steps);
        let (counts, result) = advance(&mut *method, &mut problem, &mut state, 5.0, &tolerance);
        assert_eq!((counts.steps, result), (0, Ok(())));
        assert_eq!((state, problem.steps), before);
    }
}

/// Different at every place, however near.
fn noise(q: Vector2<f64>) -> f64 {
    let mixed = q.x.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15);
    1e15 * (mixed >> 11) as f64 / (1_u64 << 53) as f64
}

/// Accelerations that no step resolves: noise, a wall, nothing finite.
type Impossible = (&'static str, fn(Vector2<f64>) -> f64, Stop);

const IMPOSSIBLE: [Impossible; 3] = [
    ("noise", noise, Stop::StepTooSmall),
    (
        "a wall",
        |q| if q.x > 1.5 { f64::NAN } else { 1.0 },
        Stop::StepTooSmall,
    ),
    ("nothing finite", |_| f64::INFINITY, Stop::NotFinite),
];

#[test]
fn a_tolerance_that_cannot_be_met_ends_the_step() {
    for row in &ROWS {
        for (name, acceleration, reason) in IMPOSSIBLE {
            thread_local! {
                static CHOSEN: std::cell::Cell<fn(Vector2<f64>) -> f64> =
                    const { std::cell::Cell::new(|_| 0.0) };
            }
            CHOSEN.set(acceleration);
            let mut problem = Problem::new(
                |q, _| Vector2::new(CHOSEN.get()(q), 0.0),
                |_, _| [Matrix2::zeros(); 2],
            );
            let (mut method, mut state) = ((row.make)(), started());
            let tolerance = Tolerance {
                relative: 1e-6,
                ..TIGHT
            };
            let (counts, result) = advance(&mut *method, &mut problem, &mut state, 5.0, &tolerance);
            println!(
                "{} at {name}: {result:?} at {} after {counts:?}",
                row.name, state.time
            );
            assert_eq!(result, Err(reason), "{} at {name}", row.name);
            let finite = state.coordinates.iter().chain(&state.rates);
            assert!(finite.chain([&state.time]).all(|x| x.is_finite()));
            assert!(state.time < 5.0);
        }
    }
}

#[test]
fn a_singular_tangent_ends_the_step() {
    let mut problem = Problem::new(
        |q, _| -q,
        |_, _| [Matrix2::from_element(f64::NAN), Matrix2::zeros()],
    );
    let mut state = started();
    let (counts, result) = advance(&mut Radau::new(2), &mut problem, &mut state, 1.0, &TIGHT);
    assert_eq!((counts.steps, result), (0, Err(Stop::StepTooSmall)));
}

#[test]
fn a_step_keeps_to_the_longest_that_stability_allows() {
    let mut problem = Problem::new(|q, _| -q * 1e4, |_, _| [Matrix2::zeros(); 2]);
    let mut method = Rk4::new(2, 100.0, 0.0);
    let mut state = started();
    (state.coordinates, state.rates) = (vec![1e-9, 0.0], vec![0.0, 0.0]);
    let loose = Tolerance {
        relative: 0.1,
        ..TIGHT
    };
    let (counts, result) = advance(&mut method, &mut problem, &mut state, 10.0, &loose);
    assert_eq!(result, Ok(()));
    let fewest = (10.0 / method.longest_step()).ceil() as u64;
    assert!(counts.steps >= fewest, "{} steps of {fewest}", counts.steps);
}

//! Every integrator has the order, the stability and the error control that it claims. Row by row for
//! each method; a new one is a new row.

mod control;
mod problem;
mod trees;
mod work;

use flexbody::integrators::{
    Attempt, Coefficients, DOPRI853, Nystrom, OneStepMethod, RK4, RKN43, RKN64, Radau, RungeKutta,
    StateView, Tolerance, VERLET,
};
use nalgebra::{Matrix2, Vector2};
use problem::Problem;

/// A method with its name, order and a sequence of numbers of steps fine enough to show it.
struct Row {
    name: &'static str,
    order: f64,
    make: fn() -> Box<dyn OneStepMethod>,
    steps: [u32; 3],
    /// Whether it takes accelerations that depend on rates, and counts work.
    rates: bool,
}

const ROWS: [Row; 6] = [
    Row {
        name: "rk4",
        order: 4.0,
        make: || Box::new(RungeKutta::new(&RK4, 2, 1.0, 0.0)),
        steps: [40, 80, 160],
        rates: true,
    },
    Row {
        name: "radau",
        order: 5.0,
        make: || Box::new(Radau::new(2)),
        steps: [8, 16, 32],
        rates: true,
    },
    Row {
        name: "dopri853",
        order: 8.0,
        make: || Box::new(RungeKutta::new(&DOPRI853, 2, 1.0, 0.0)),
        steps: [4, 8, 16],
        rates: true,
    },
    Row {
        name: "verlet",
        order: 2.0,
        make: || Box::new(Nystrom::new(&VERLET, 2, 1.0)),
        steps: [40, 80, 160],
        rates: false,
    },
    Row {
        name: "rkn43",
        order: 4.0,
        make: || Box::new(Nystrom::new(&RKN43, 2, 1.0)),
        steps: [20, 40, 80],
        rates: false,
    },
    Row {
        name: "rkn64",
        order: 6.0,
        make: || Box::new(Nystrom::new(&RKN64, 2, 1.0)),
        steps: [20, 40, 80],
        rates: false,
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
/// time.
fn driven() -> Problem {
    fn drive(t: f64) -> f64 {
        let [x, v] = exact(t);
        -2.0 * (2.0 * t).sin() + x * x * x + 0.3 * x * v
    }
    Problem::new(
        |t, q, v| Vector2::new(drive(t) - q.x.powi(3) - 0.3 * q.x * v.x, 0.0),
        |q, v| {
            let by_x = 3.0 * q.x * q.x + 0.3 * v.x;
            [
                Matrix2::new(by_x, 0.0, 0.0, 0.0),
                Matrix2::new(0.3 * q.x, 0.0, 0.0, 0.0),
            ]
        },
    )
}

/// The same oscillator without damping.
fn undamped() -> Problem {
    Problem::new(
        |t, q, _| {
            let x = exact(t)[0];
            Vector2::new(-2.0 * (2.0 * t).sin() + x * x * x - q.x.powi(3), 0.0)
        },
        |q, _| {
            [
                Matrix2::new(3.0 * q.x * q.x, 0.0, 0.0, 0.0),
                Matrix2::zeros(),
            ]
        },
    )
}

impl Row {
    /// The problem whose solution is [`exact`].
    fn problem(&self) -> Problem {
        if self.rates { driven() } else { undamped() }
    }
}

/// One step of a given length, whatever its error; returns the estimate of it.
fn force(
    method: &mut dyn OneStepMethod,
    problem: &mut Problem,
    time: f64,
    state: &mut [Vec<f64>; 2],
    h: f64,
) -> f64 {
    let [q, v] = state;
    method.begin(problem, time, q, v);
    let from = StateView {
        time,
        coordinates: q,
        rates: v,
    };
    match method.attempt(problem, from, h, &TIGHT) {
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
    for step in 0..steps {
        let at = f64::from(step) * h;
        let estimate = force(&mut *method, &mut problem, at, &mut state, h);
        first.get_or_insert(estimate);
    }
    let [x, v] = exact(time);
    let error = (state[0][0] - x).hypot(state[1][0] - v);
    [error, first.unwrap_or(f64::NAN)]
}

/// Observed order of the last halving, of errors and of estimates.
fn orders(row: &Row, exact: fn(f64) -> [f64; 2]) -> [f64; 2] {
    let runs = row
        .steps
        .map(|steps| run(row, row.problem(), 2.0, steps, exact));
    println!("{}: errors and estimates {runs:?}", row.name);
    [0, 1].map(|what| (runs[1][what] / runs[2][what]).log2())
}

#[test]
fn methods_converge_with_their_order() {
    for row in &ROWS {
        let [observed, _] = orders(row, exact);
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
        let [_, observed] = orders(row, exact);
        println!("{}: local estimate of order {observed:.2}", row.name);
        // The error of one step is of one order more than that of the run.
        assert!(observed > 3.7, "{}: order {observed}", row.name);
    }
}

/// A linear oscillator `q'' = -w^2 q - 2 z w v`.
fn oscillator(frequency: f64, ratio: f64) -> Problem {
    thread_local! {
        static LINEAR: std::cell::Cell<[f64; 2]> = const { std::cell::Cell::new([0.0; 2]) };
    }
    LINEAR.set([frequency * frequency, 2.0 * ratio * frequency]);
    Problem::new(
        |_, q, v| {
            let [k, r] = LINEAR.get();
            -q * k - v * r
        },
        |_, _| LINEAR.get().map(Matrix2::from_diagonal_element),
    )
}

/// Growth of the largest deflection of an oscillator over many steps of `h` = 1, from its first to its second half.
fn growth(method: &mut dyn OneStepMethod, frequency: f64, ratio: f64) -> f64 {
    let mut problem = oscillator(frequency, ratio);
    let mut state = [vec![1.0, 0.0], vec![0.0, 0.0]];
    let mut largest = [0.0_f64; 2];
    for step in 0..400 {
        force(method, &mut problem, 0.0, &mut state, 1.0);
        let size = (state[0][0].powi(2) + (state[1][0] / frequency).powi(2)).sqrt();
        largest[step / 200] = largest[step / 200].max(size);
    }
    largest[1] / largest[0]
}

#[test]
fn runge_kutta_methods_are_stable_exactly_as_far_as_they_say() {
    assert_eq!(RK4.limits[0], 8.0_f64.sqrt());
    for coefficients in [&RK4, &DOPRI853] {
        is_stable_exactly_as_far_as_it_says(coefficients);
    }
}

fn is_stable_exactly_as_far_as_it_says(coefficients: &'static Coefficients) {
    let name = coefficients.name;
    let [limit, decay] = coefficients.limits;
    let mut method = RungeKutta::new(coefficients, 2, limit, 0.0);
    assert!(
        (method.longest_step() - 0.9).abs() < 1e-12,
        "0.9 of the limit"
    );
    for part in 1..=200 {
        let frequency = 0.999 * limit * f64::from(part) / 200.0;
        let grown = growth(&mut method, frequency, 0.0);
        // Neutral, or nearly: what is seen of the largest deflection differs a little.
        let most = if part < 200 { 1.01 } else { 1.0 };
        assert!(grown < most, "{name}: {grown} at {frequency}");
    }
    assert!(growth(&mut method, 1.001 * limit, 0.0) > 1.0, "{name}");
    // The faster rate of an overdamped mode of the frequency 0.1.
    let ratio = |decay: f64| (decay + 0.01 / decay) / 0.2;
    assert!(
        growth(&mut method, 0.1, ratio(0.999 * decay)) < 1.0,
        "{name}"
    );
    assert!(
        growth(&mut method, 0.1, ratio(1.01 * decay)) > 1.0,
        "{name}"
    );
    // Damped modes at the longest step that the method allows itself.
    for number in 0..=60 {
        let ratio = 0.05 * f64::from(number);
        let (frequency, decay) = (1.0, 2.0 * ratio);
        let h = RungeKutta::new(coefficients, 2, frequency, decay).longest_step();
        let grown = growth(&mut method, h * frequency, ratio);
        assert!(grown < 1.0, "{name}: damping ratio {ratio}: {grown}");
    }
}

#[test]
fn nystrom_methods_are_stable_exactly_as_far_as_they_say() {
    for tableau in [&VERLET, &RKN43, &RKN64] {
        let method = |frequency| Nystrom::new(tableau, 2, frequency);
        let limit = method(1.0).longest_step() / 0.9;
        for part in 1..=500 {
            let frequency = 0.999 * limit * f64::from(part) / 500.0;
            let grown = growth(&mut method(1.0), frequency, 0.0);
            // Neutral, or nearly: what is seen of the largest deflection differs a little.
            let most = if part < 500 { 1.01 } else { 1.001 };
            let name = method(1.0).name();
            assert!(grown < most, "{name}: {grown} at {frequency}");
        }
        let grown = growth(&mut method(1.0), 1.01 * limit, 0.0);
        assert!(grown > 1.1, "{}: {grown}", method(1.0).name());
    }
}

#[test]
fn nystrom_methods_estimate_more_than_the_error_of_any_oscillation() {
    for (tableau, power) in [(&RKN43, 4.0), (&RKN64, 5.0)] {
        for part in 1..=100 {
            let frequency = 0.9 * tableau.limit * f64::from(part) / 100.0;
            let mut problem = oscillator(frequency, 0.0);
            let mut state = [vec![1.0, 0.0], vec![0.0, 0.0]];
            let mut method = Nystrom::new(tableau, 2, 1.0);
            let rescaled = force(&mut method, &mut problem, 0.0, &mut state, 1.0);
            let estimate = (rescaled / TIGHT.relative).powf(power / 4.0) * TIGHT.relative;
            let (sin, cos) = frequency.sin_cos();
            let [position, velocity] = [state[0][0] - cos, state[1][0] + frequency * sin];
            let error = position.abs().max(velocity.abs());
            assert!(
                estimate > 2.5 * error,
                "{}: {error:e} at {frequency}, estimated as {estimate:e}",
                tableau.name
            );
        }
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

/// A slow oscillation and a stiff mode, rotated against each other; it starts on the slow one.
fn stiff() -> Problem {
    const SLOW: f64 = 1.0;
    const FAST: f64 = 1e6;
    fn stiffness() -> Matrix2<f64> {
        let (sin, cos) = 0.6_f64.sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        turn * Matrix2::new(SLOW, 0.0, 0.0, FAST) * turn.transpose()
    }
    Problem::new(
        |_, q, _| -(stiffness() * q),
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
            let h = 2.0 / f64::from(steps);
            force(&mut method, &mut problem, 0.0, &mut state, h);
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
            |t, q, _| Vector2::new(-1e8 * (q.x - t.sin()) - t.sin(), 0.0),
            |_, _| [Matrix2::new(1e8, 0.0, 0.0, 0.0), Matrix2::zeros()],
        )
    };
    let row = &ROWS[1];
    let [coarse, fine] =
        [10, 20].map(|steps| run(row, problem(), 2.0, steps, |t| [t.sin(), t.cos()])[0]);
    println!("radau on a driven stiff spring: {coarse:e}, {fine:e}");
    assert!(fine < coarse / 6.0, "order {}", (coarse / fine).log2());
    assert!(coarse < 1e-3);
}

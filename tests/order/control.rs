//! Error control: tolerances are followed, communication points met, the impossible refused.

use flexbody::integrators::{
    Attempt, Methods, OneStepMethod, RK4, Radau, RungeKutta, StateView, StepError, Tolerance,
    advance,
};
use flexbody::system::{DenseStep, Dynamics, State};
use nalgebra::{Matrix2, Vector2};

use crate::order::problem::Problem;
use crate::order::{ROWS, TIGHT, exact};

fn started() -> State {
    let [x, v] = exact(0.0);
    State {
        time: 0.0,
        step: 0.0,
        coordinates: vec![x, 0.0],
        rates: vec![v, 1.0],
        ..State::default()
    }
}

#[test]
fn errors_follow_the_tolerance() {
    for row in &ROWS {
        let errors = [1e-3, 1e-5, 1e-7, 1e-9].map(|relative| {
            let (mut method, mut problem, mut state) = ((row.make)(), row.problem(), started());
            let tolerance = Tolerance { relative, ..TIGHT };
            let (counts, result) = advance(&mut *method, &mut problem, &mut state, 5.0, &tolerance);
            assert_eq!(result, Ok(()));
            assert_eq!(counts.steps, u64::from(problem.steps));
            let error = (state.coordinates[0] - exact(5.0)[0]).abs();
            assert!(
                error < 2.0 * relative,
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
        let (mut method, mut problem, mut state) = ((row.make)(), row.problem(), started());
        let tolerance = Tolerance {
            relative: 1e-6,
            ..TIGHT
        };
        let odd = [1e-9, 0.1, 0.1 + 1e-12, 0.3, 1.0 / 3.0];
        for until in odd.into_iter().chain((5..72).map(|i| 0.07 * f64::from(i))) {
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
        let now = state.time;
        let (counts, result) = advance(&mut *method, &mut problem, &mut state, now, &tolerance);
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
type Impossible = (&'static str, fn(Vector2<f64>) -> f64, StepError);

const IMPOSSIBLE: [Impossible; 3] = [
    ("noise", noise, StepError::StepTooSmall),
    (
        "a wall",
        |q| if q.x > 1.5 { f64::NAN } else { 1.0 },
        StepError::StepTooSmall,
    ),
    ("nothing finite", |_| f64::INFINITY, StepError::NotFinite),
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
                |_, q, _| Vector2::new(CHOSEN.get()(q), 0.0),
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
        |_, q, _| -q,
        |_, _| [Matrix2::from_element(f64::NAN), Matrix2::zeros()],
    );
    let mut state = started();
    let (counts, result) = advance(&mut Radau::new(2), &mut problem, &mut state, 1.0, &TIGHT);
    assert_eq!((counts.steps, result), (0, Err(StepError::StepTooSmall)));
}

#[test]
fn a_step_keeps_to_the_longest_that_stability_allows() {
    let mut problem = Problem::new(|_, q, _| -q * 1e4, |_, _| [Matrix2::zeros(); 2]);
    let mut method = RungeKutta::new(&RK4, 2, 100.0, 0.0);
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

/// A free motion takes steps as long as they may be: the end must not be missed by rounding.
#[test]
fn communication_points_far_ahead_are_met_exactly() {
    for row in &ROWS {
        let mut problem = Problem::new(|_, _, _| Vector2::zeros(), |_, _| [Matrix2::zeros(); 2]);
        let (mut method, mut state) = ((row.make)(), started());
        state.step = 10.0;
        let (mut until, mut rounded) = (1e-6, 0);
        while until < 2.0 {
            rounded += u32::from(state.time + (until - state.time) > until);
            let (_, result) = advance(&mut *method, &mut problem, &mut state, until, &TIGHT);
            assert_eq!((state.time, result), (until, Ok(())));
            until *= 7.3;
        }
        assert!(rounded > 0, "no point of these is overshot by a sum");
    }
}

/// A push that lasts a moment in the middle of rest: steps that overlook it must be rejected.
#[test]
fn a_sudden_push_is_not_overlooked() {
    const WIDTH: f64 = 0.02;
    fn push(t: f64) -> f64 {
        (-((t - 2.0) / WIDTH).powi(2)).exp() / (WIDTH * std::f64::consts::PI.sqrt())
    }
    for row in &ROWS {
        let mut problem = Problem::new(
            |_, q, _| Vector2::new(push(q.y), 0.0),
            |q, _| {
                let by_time = 2.0 * (q.y - 2.0) / (WIDTH * WIDTH) * push(q.y);
                [Matrix2::new(0.0, by_time, 0.0, 0.0), Matrix2::zeros()]
            },
        );
        let (mut method, mut state) = ((row.make)(), started());
        (state.coordinates, state.rates) = (vec![0.0, 0.0], vec![0.0, 1.0]);
        let tolerance = Tolerance {
            relative: 1e-6,
            ..TIGHT
        };
        let mut rejected = 0;
        for until in (1..=40).map(|i| 0.1 * f64::from(i)) {
            let (counts, result) =
                advance(&mut *method, &mut problem, &mut state, until, &tolerance);
            assert_eq!(result, Ok(()));
            rejected += counts.rejected;
        }
        let error = (state.rates[0] - 1.0).abs();
        println!(
            "{}: a push is off by {error:e}, {rejected} steps rejected",
            row.name
        );
        assert!(error < 1e-5, "{}: {error:e}", row.name);
        assert!(rejected > 0);
    }
}

/// A method that takes no step from a time on.
struct Weary(Box<dyn OneStepMethod>, f64);

impl OneStepMethod for Weary {
    fn name(&self) -> &'static str {
        "weary"
    }

    fn longest_step(&self) -> f64 {
        self.0.longest_step()
    }

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        if state.time < self.1 {
            self.0.attempt(dynamics, state, h, tolerance)
        } else {
            Attempt::Failed(0.1)
        }
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        self.0.accept(q, v);
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.0.refresh(dynamics, time, q, v);
    }

    fn acceleration(&self) -> &[f64] {
        self.0.acceleration()
    }
}

#[test]
fn what_one_of_two_methods_cannot_do_the_other_does() {
    let tolerance = Tolerance {
        relative: 1e-6,
        ..TIGHT
    };
    let row = &ROWS[0];
    let weary = |until| -> Box<dyn OneStepMethod> { Box::new(Weary((row.make)(), until)) };
    let (mut problem, mut state) = (row.problem(), started());
    let mut methods = Methods::two(weary(2.0), Box::new(Radau::new(2)));
    let (_, result) = methods.advance(&mut problem, &mut state, 5.0, &tolerance);
    assert_eq!((result, state.time), (Ok(()), 5.0));
    assert_eq!(methods.name(&state.pace), "radau");
    assert!((state.coordinates[0] - exact(5.0)[0]).abs() < 2e-6);
    // Where neither goes on, that is the answer.
    let (mut problem, mut state) = (row.problem(), started());
    let mut methods = Methods::two(weary(2.0), weary(3.0));
    let (_, result) = methods.advance(&mut problem, &mut state, 5.0, &tolerance);
    assert_eq!(result, Err(StepError::StepTooSmall));
    assert!((3.0..3.5).contains(&state.time), "{}", state.time);
}

/// A method whose stage equations cannot be solved for steps longer than this, s.
struct Short(Radau, f64);

impl OneStepMethod for Short {
    fn name(&self) -> &'static str {
        "short"
    }

    fn longest_step(&self) -> f64 {
        self.0.longest_step()
    }

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        if h <= self.1 {
            self.0.attempt(dynamics, state, h, tolerance)
        } else {
            Attempt::Failed(0.5)
        }
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        self.0.accept(q, v);
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.0.refresh(dynamics, time, q, v);
    }

    fn is_dense(&self) -> bool {
        true
    }

    fn keep(&mut self, step: &mut DenseStep) {
        self.0.keep(step);
    }

    fn acceleration(&self) -> &[f64] {
        self.0.acceleration()
    }
}

/// Steps for which equations cannot be solved are tried as rarely where each leads beyond communication points, and the next
/// begins anew, as where one run takes them all.
#[test]
fn a_step_beyond_communication_points_knows_which_failed_before_it() {
    let rejected = |points: u32| {
        let mut problem = Problem::new(|_, _, _| Vector2::zeros(), |_, _| [Matrix2::zeros(); 2]);
        problem.is_smooth = true;
        let (mut method, mut state) = (Short(Radau::new(2), 0.3), started());
        state.dense = DenseStep::blank(2);
        let mut rejected = 0;
        for point in 1..=points {
            state.dense.begin_point(true);
            let until = 60.0 * f64::from(point) / f64::from(points);
            let (counts, result) = advance(&mut method, &mut problem, &mut state, until, &TIGHT);
            assert_eq!((result, state.time), (Ok(()), until));
            rejected += counts.rejected;
        }
        rejected
    };
    let (once, often) = (rejected(1), rejected(2000));
    println!("{once} steps failed in one run, {often} across communication points");
    assert!(once > 10, "{once}");
    assert!(often <= 2 * once, "{often} for {once}");
}

//! What goes along with steps: work, times that no step leads across, states put right on the way.

use flexbody::integrators::{StateView, StepError, Tolerance, advance};
use flexbody::system::{State, StepOutcome};
use nalgebra::{Matrix2, Vector2};

use crate::order::problem::Problem;
use crate::order::{ROWS, TIGHT};

/// `q'' = -q` from `q = 0`, `v = 1`, with the power `v cos t` coming in and `v^2` dissipated.
fn oscillator() -> Problem {
    let mut problem = Problem::new(|_, q, _| -q, |_, _| [Matrix2::identity(), Matrix2::zeros()]);
    problem.powers = |t, v| [v.x * t.cos(), v.x * v.x];
    problem
}

fn started() -> State {
    State {
        coordinates: vec![0.0, 0.0],
        rates: vec![1.0, 0.0],
        ..State::default()
    }
}

#[test]
fn work_is_the_integral_of_power_with_the_order_of_the_method() {
    for row in ROWS.iter().filter(|row| row.rates) {
        // Short of roundoff.
        let coarse = if row.order > 5.0 { 4 } else { 20 };
        let errors = [coarse, 2 * coarse].map(|steps: u32| {
            let (mut method, mut problem) = ((row.make)(), oscillator());
            let mut state = started();
            let (h, mut work) = (2.0 / f64::from(steps), [0.0; 2]);
            for step in 0..steps {
                let (q, v) = (&mut state.coordinates, &mut state.rates);
                let time = f64::from(step) * h;
                method.begin(&mut problem, time, q, v);
                let from = StateView {
                    time,
                    coordinates: q,
                    rates: v,
                };
                method.attempt(&mut problem, from, h, &TIGHT);
                method.accept(q, v);
                work.iter_mut()
                    .zip(method.work())
                    .for_each(|(w, p)| *w += p);
            }
            // Both are the integral of cos^2.
            let exact = 1.0 + 0.25 * 4.0_f64.sin();
            work.map(|w| (w - exact).abs())
        });
        println!("{}: errors of work {errors:?}", row.name);
        for kind in 0..2 {
            let order = (errors[0][kind] / errors[1][kind]).log2();
            assert!(order > row.order - 0.4, "{}: order {order}", row.name);
        }
    }
}

#[test]
fn the_driver_adds_up_the_work_of_accepted_steps() {
    for row in ROWS.iter().filter(|row| row.rates) {
        let (mut method, mut problem, mut state) = ((row.make)(), oscillator(), started());
        let tolerance = Tolerance {
            relative: 1e-8,
            ..TIGHT
        };
        for until in [0.3, 0.31, 2.0] {
            let (_, result) = advance(&mut *method, &mut problem, &mut state, until, &tolerance);
            assert_eq!(result, Ok(()));
        }
        let exact = 1.0 + 0.25 * 4.0_f64.sin();
        for work in state.work {
            assert!((work - exact).abs() < 1e-6, "{}: {work}", row.name);
        }
    }
}

/// A push that grows from 0.7 to 0.9 and is gone at 1.1: between its kinks the motion is a polynomial
/// that both methods follow exactly, in as few steps as they like.
#[test]
fn no_step_leads_across_a_break() {
    fn push(t: f64) -> f64 {
        (1.0 - 5.0 * (t - 0.9).abs()).max(0.0)
    }
    for row in ROWS.iter().filter(|row| row.rates) {
        let mut problem = Problem::new(
            |t, _, _| Vector2::new(push(t), 0.0),
            |_, _| [Matrix2::zeros(); 2],
        );
        problem.breaks = vec![-1.0, 0.7, 0.9, 1.1, 9.0];
        let (mut method, mut state) = ((row.make)(), started());
        state.rates[0] = 0.0;
        state.step = 0.5;
        let (counts, result) = advance(&mut *method, &mut problem, &mut state, 2.0, &TIGHT);
        assert_eq!((state.time, result), (2.0, Ok(())));
        // The triangle's area, and its area times the way from its centre of mass.
        let errors = [state.rates[0] - 0.2, state.coordinates[0] - 0.2 * 1.1];
        println!("{}: {errors:?} after {counts:?}", row.name);
        assert!(errors.iter().all(|e| e.abs() < 1e-14), "{errors:?}");
        assert!(counts.steps < 10 && counts.rejected == 0, "{counts:?}");
    }
}

/// A state that is put right after every step: the method must go on from what became of it.
#[test]
fn a_moved_state_is_the_one_to_go_on_from() {
    for row in ROWS.iter().filter(|row| row.rates) {
        // Distance from the origin grows by itself and is put right: uniform motion on a circle.
        let mut problem = Problem::new(
            |_, q, v| -q * (v.norm_squared() / q.norm_squared()),
            |_, _| [Matrix2::zeros(); 2],
        );
        problem.settle = |state| {
            let q = Vector2::from_column_slice(&state.coordinates).normalize();
            let v = Vector2::from_column_slice(&state.rates);
            let v = v - q * q.dot(&v);
            state.coordinates.copy_from_slice(q.as_slice());
            state.rates.copy_from_slice(v.as_slice());
            StepOutcome::Moved
        };
        let (mut method, mut state) = ((row.make)(), started());
        state.coordinates = vec![1.0, 0.0];
        state.rates = vec![0.0, 1.0];
        let tolerance = Tolerance {
            relative: 1e-8,
            ..TIGHT
        };
        let (_, result) = advance(&mut *method, &mut problem, &mut state, 3.0, &tolerance);
        assert_eq!(result, Ok(()));
        let q = Vector2::from_column_slice(&state.coordinates);
        assert!((q.norm() - 1.0).abs() < 1e-15);
        let off = (q - Vector2::new(3.0_f64.cos(), 3.0_f64.sin())).norm();
        assert!(off < 1e-6, "{}: {off:e}", row.name);
    }
}

#[test]
fn what_ends_a_motion_ends_the_step() {
    type Settle = fn(&mut State) -> StepOutcome;
    const ENDS: [(Settle, StepError); 2] = [
        (
            |_| StepOutcome::ConstraintsViolated,
            StepError::ConstraintsViolated,
        ),
        (
            |_| StepOutcome::SliderLeftCable(3),
            StepError::SliderLeftCable(3),
        ),
    ];
    for row in ROWS.iter().filter(|row| row.rates) {
        for (settle, stop) in ENDS {
            let (mut method, mut problem, mut state) = ((row.make)(), oscillator(), started());
            problem.settle = settle;
            let (counts, result) = advance(&mut *method, &mut problem, &mut state, 1.0, &TIGHT);
            assert_eq!((counts.steps, result), (1, Err(stop)));
            assert!(state.time < 1.0);
        }
    }
}

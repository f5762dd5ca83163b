//! What is driven: courses of inputs, what a motion takes, motions that cannot be.

use flexbody::integrators::{Radau, StepError, Tolerance, advance};
use flexbody::system::{
    BuildError, Drive, DrivenSystem, Evaluation, Parts, System, Trajectory, Workspace,
};
use nalgebra::Vector2;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::laws::built::Moving;
use crate::laws::closed::{bodies, ground, hold, on, rigid, started, still};
use crate::laws::differences::{Outcome, check, derivative, within};
use crate::laws::mechanism::{Body, Kind, Wave};

const G: f64 = 9.81;

/// Inputs that do not move.
fn held(inputs: &[f64]) -> Vec<[f64; 3]> {
    inputs.iter().map(|input| [*input, 0.0, 0.0]).collect()
}

/// Random inputs, a row a communication step.
fn inputs() -> impl Strategy<Value = Vec<[f64; 3]>> {
    vec([-1.0..1.0, -1.0..1.0, -1.0..1.0], 6)
}

#[test]
fn driven_coordinates_go_on_without_jumps() {
    check(60, (inputs(), 0..3_usize), |(inputs, derivatives)| {
        let (h, mut at) = (0.2, [0.1, 0.0, 0.0]);
        for (step, inputs) in inputs.iter().enumerate() {
            let time = h * step as f64;
            let course = Trajectory::new(time, h, at, &held(&inputs[..=derivatives]));
            let [p, v, a] = course.derivatives(time);
            within("value", (p - at[0]).abs(), 1e-14)?;
            within("rate", (v - at[1]).abs(), 1e-13)?;
            if derivatives == 2 {
                within("second derivative", (a - at[2]).abs(), 1e-12)?;
            }
            for k in 0..=10 {
                let t = time + 0.1 * h * f64::from(k);
                let slope = derivative(1e-3, |s| {
                    let [p, v, _] = course.derivatives(t + s);
                    Vector2::new(p, v)
                });
                let [_, v, a] = course.derivatives(t);
                within(
                    "rate of the value",
                    (slope.x - v).abs(),
                    1e-8 * (1.0 + v.abs()),
                )?;
                within(
                    "rate of the rate",
                    (slope.y - a).abs(),
                    1e-7 * (1.0 + a.abs()),
                )?;
            }
            at = course.derivatives(time + h);
            // At the end it is where the input, with its derivatives, says.
            let [p, v, a] = [0, 1, 2].map(|k| if k <= derivatives { inputs[k] } else { 0.0 });
            within(
                "value at the end",
                (at[0] - p - h * (v + 0.5 * h * a)).abs(),
                1e-13,
            )?;
            if derivatives > 0 {
                within("rate at the end", (at[1] - v - h * a).abs(), 1e-12)?;
            }
        }
        Ok(())
    });
}

/// A particle that inputs drive, in both directions.
fn driven(derivatives: usize) -> System {
    let mut mechanism = bodies(&[(Body::Particle { mass: 2.0 }, [0.0, 0.0, 0.0])]);
    let still = Kind::DrivenPosition([still(0.0); 2]);
    mechanism
        .holds
        .push(hold(still, ground(0.0, 0.0), on(0, 0.0, 0.0)));
    let drive = |axis: usize| Drive::Input {
        first: axis * (derivatives + 1),
        derivatives,
    };
    let parts = Parts {
        drives: vec![drive(0), drive(1)],
        ..mechanism.parts()
    };
    System::new(parts).expect("a system")
}

fn follows_inputs(rows: &[[f64; 3]], derivatives: usize) -> Outcome {
    let system = driven(derivatives);
    let (h, mut courses) = (0.1, [Trajectory::hold(0.0, [0.0; 3]); 2]);
    let mut work = Workspace::new(&system);
    let zero = vec![0.0; 2 * (derivatives + 1)];
    let nodes = [[[0.0, 0.0], [1.0, 0.0]]];
    let started = system.initial_state(0.0, &zero, (&nodes, &[[[0.0; 2]; 2]]), &mut work);
    let mut state = started.map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let mut method = Radau::new(system.coordinates());
    let tolerance = Tolerance {
        relative: 1e-6,
        position: 1.0,
        time: 1.0,
    };
    for (step, row) in rows.iter().enumerate() {
        let (time, until) = (h * step as f64, h * (step + 1) as f64);
        let of = |axis: usize| -> Vec<f64> {
            row.iter()
                .take(derivatives + 1)
                .map(|x| x * (1.0 + axis as f64))
                .collect()
        };
        let inputs: Vec<f64> = (0..2).flat_map(of).collect();
        for (axis, course) in courses.iter_mut().enumerate() {
            let mut from = course.derivatives(time);
            let given = of(axis);
            // An acceleration that is an input acts at once.
            if derivatives == 2 {
                from[2] = given[2];
            }
            *course = Trajectory::new(time, h, from, &held(&given));
        }
        let mut model = DrivenSystem::new(&system, &inputs, &mut work, &state).until(&state, until);
        let (_, result) = advance(&mut method, &mut model, &mut state, until, &tolerance);
        prop_assert_eq!(result, Ok(()));
        let mut values = Evaluation::new(&system);
        values.kinematics(&system, &state, &mut work);
        values.dynamics(&system, &state, &inputs, &mut work);
        let (force, _) = values.reaction(&system, 0);
        for (axis, course) in courses.iter().enumerate() {
            let [p, v, a] = course.derivatives(until);
            within("position", (values.x[0][0][axis] - p).abs(), 1e-12)?;
            within("velocity", (values.v[0][0][axis] - v).abs(), 1e-11)?;
            // What drives it carries and accelerates it.
            let weight = if axis == 1 { 2.0 * G } else { 0.0 };
            within(
                "force",
                (force[axis] - 2.0 * a - weight).abs(),
                1e-8 * (1.0 + a.abs()),
            )?;
        }
    }
    Ok(())
}

#[test]
fn a_body_goes_where_inputs_say_and_the_reaction_is_what_it_takes() {
    check(40, (inputs(), 0..3_usize), |(inputs, derivatives)| {
        follows_inputs(&inputs, derivatives)
    });
}

/// A rigid rod pinned to the ground, its other end driven away from there.
#[test]
fn a_motion_that_rigidity_contradicts_ends_the_step() {
    let mut rod = bodies(&[(rigid(1.0, 0.1), [0.5, 0.0, 0.0])]);
    rod.holds
        .push(hold(Kind::Revolute, ground(0.0, 0.0), on(0, -0.5, 0.0)));
    let away = Wave {
        constant: 1.0,
        amplitude: 0.5,
        frequency: 1.0,
    };
    let drive = Kind::DrivenPosition([away, still(0.0)]);
    rod.holds
        .push(hold(drive, ground(0.0, 0.0), on(0, 0.5, 0.0)));
    let Moving {
        system,
        mut state,
        mut work,
    } = started(&rod);
    let mut method = Radau::new(system.coordinates());
    let tolerance = Tolerance {
        relative: 1e-6,
        position: 1.0,
        time: 1.0,
    };
    let mut model = DrivenSystem::new(&system, &[], &mut work, &state);
    let (_, result) = advance(&mut method, &mut model, &mut state, 1.0, &tolerance);
    assert_eq!(result, Err(StepError::ConstraintsViolated));
}

/// Motions of what others determine are refused, whoever comes first.
#[test]
fn motions_of_what_is_held_are_refused() {
    let wave = still(0.0);
    let base = || bodies(&[(rigid(1.0, 0.1), [0.0, 0.0, 0.0])]);
    let at = on(0, 0.2, 0.1);
    let pin = hold(Kind::Revolute, ground(0.2, 0.1), at);
    let weld = hold(Kind::Weld(0.0), ground(0.2, 0.1), at);
    let position = hold(
        Kind::DrivenPosition([still(0.2), still(0.1)]),
        ground(0.0, 0.0),
        at,
    );
    let angle = hold(Kind::DrivenAngle(wave), ground(0.0, 0.0), at);
    let rail = hold(Kind::Slider(Vector2::x()), ground(0.2, 0.1), at);
    let way = hold(Kind::DrivenWay(Vector2::x(), wave), ground(0.2, 0.1), at);
    let refused = [
        [pin, position],
        [position, pin],
        [weld, angle],
        [angle, weld],
        [pin, way],
        [position, rail],
        [position, position],
    ];
    for holds in refused {
        let mut made = base();
        made.holds.extend(holds);
        let result = made.system();
        assert!(
            matches!(result, Err(BuildError::Determined(Some(_)))),
            "{holds:?}"
        );
    }
    for holds in [[pin, angle], [rail, way], [position, angle]] {
        let mut made = base();
        made.holds.extend(holds);
        assert!(made.system().is_ok(), "{holds:?}");
    }
}

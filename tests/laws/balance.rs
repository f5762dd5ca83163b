//! Energy along motions of random mechanisms: what came in less what was dissipated is what is there.

use std::cell::Cell;

use flexbody::integrators::{OneStepMethod, RK4, Radau, RungeKutta, Tolerance, advance};
use flexbody::system::{DrivenSystem, Evaluation, System, fastest};
use proptest::prelude::*;

use crate::laws::built::{Moving, moving};
use crate::laws::differences::{Outcome, check, within};
use crate::laws::mechanism::Mechanism;
use crate::laws::random::{ALL, mechanisms};

const CASES: u32 = 60;

fn energy(values: &Evaluation, system: &System) -> [f64; 2] {
    let parts = [
        values.kinetic_energy(system),
        values.strain_energy(system),
        values.gravity_energy(system),
        values.spring_energy(system),
    ];
    [parts.iter().sum(), parts.iter().map(|e| e.abs()).sum()]
}

fn method(moving: &mut Moving, explicit: bool) -> Box<dyn OneStepMethod> {
    let n = moving.system.coordinates();
    let (frequency, decay) = fastest(&moving.system, &[], &mut moving.work, &moving.state);
    if explicit {
        Box::new(RungeKutta::new(&RK4, n, frequency, decay))
    } else {
        Box::new(Radau::new(n))
    }
}

fn balance(mechanism: &Mechanism, explicit: bool, seen: &Cell<u32>) -> Outcome {
    let Some(mut moving) = moving(mechanism, 0.02)? else {
        return Ok(());
    };
    let mut method = method(&mut moving, explicit);
    let tolerance = Tolerance {
        relative: 1e-9,
        position: moving.system.scale(),
        time: 0.1,
    };
    let before = energy(&moving.evaluated(), &moving.system);
    let mut state = moving.state.clone();
    for until in [0.02, 0.05] {
        let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &state);
        let (_, result) = advance(&mut *method, &mut model, &mut state, until, &tolerance);
        // A slide may leave its cable, a singular configuration may come up.
        if result.is_err() {
            return Ok(());
        }
    }
    seen.set(seen.get() + 1);
    moving.state = state;
    let values = moving.evaluated();
    let [after, size] = energy(&values, &moving.system);
    let [supplied, dissipated] = moving.state.work;
    let off = (after - before[0] - supplied + dissipated).abs();
    let size = size + before[1] + supplied.abs() + dissipated.abs() + 1.0;
    within("energy", off / size, 1e-6)?;
    prop_assert!(dissipated >= -1e-12);
    let [position, velocity] = values.residuals(&moving.system);
    within("residual of positions", position, 1e-12)?;
    within("residual of rates", velocity, 1e-9)?;
    let x = mechanism.apart(&values.x);
    within("positions", mechanism.missing(0.05, &x).amax(), 1e-11)
}

#[test]
fn energy_is_what_came_in_less_what_was_dissipated() {
    let seen = Cell::new(0);
    check(CASES, mechanisms(ALL), |mechanism| {
        balance(&mechanism, false, &seen)
    });
    assert!(seen.get() > CASES / 2, "{} cases", seen.get());
}

#[test]
fn so_it_is_with_the_explicit_method() {
    let seen = Cell::new(0);
    check(CASES, mechanisms(ALL), |mechanism| {
        balance(&mechanism, true, &seen)
    });
    assert!(seen.get() > CASES / 2, "{} cases", seen.get());
}

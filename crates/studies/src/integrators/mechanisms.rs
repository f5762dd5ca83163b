//! Coordinate partitioning on the random mechanisms of the law tests: it moves as projection does.

use std::cell::Cell;

use flexbody::integrators::{RK4, RungeKutta, Tolerance, advance};
use flexbody::system::{DrivenSystem, Dynamics, fastest};

use super::probe::Probe;
use crate::laws::built::moving;
use crate::laws::differences::{Outcome, check, within};
use crate::laws::mechanism::Mechanism;
use crate::laws::random::{ALL, mechanisms};

const CASES: u32 = 60;

/// The same mechanism by both ways to keep constraints, from the same state.
fn both_ways(mechanism: &Mechanism, seen: &Cell<u32>) -> Outcome {
    let Some(mut moving) = moving(mechanism, 0.0)? else {
        return Ok(());
    };
    if moving.system.constraints() == 0 {
        return Ok(());
    }
    let n = moving.system.coordinates();
    let (frequency, decay) = fastest(&moving.system, &[], &mut moving.work, &moving.state);
    let tolerance = Tolerance {
        relative: 1e-8,
        position: moving.system.scale(),
        time: 0.1,
    };
    let start = moving.state.clone();
    let (mut accelerations, mut ends) = (Vec::new(), Vec::new());
    for partitioned in [false, true] {
        let mut state = start.clone();
        let model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &state);
        let mut probe = Probe::new(model, None);
        if partitioned {
            probe = probe.partitioned(&state);
        }
        let mut a = vec![0.0; n];
        probe.acceleration(state.time, &state.coordinates, &state.rates, &mut a);
        accelerations.push(a);
        let mut method = RungeKutta::new(&RK4, n, frequency, decay);
        let (_, result) = advance(&mut method, &mut probe, &mut state, 0.03, &tolerance);
        if result.is_err() {
            return Ok(());
        }
        moving.state = state;
        ends.push(mechanism.apart(&moving.evaluated().x));
    }
    let (a, b) = (&accelerations[0], &accelerations[1]);
    let size = a.iter().fold(1.0_f64, |most, a: &f64| a.abs().max(most));
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs() / size);
    within("acceleration", apart.fold(0.0, f64::max), 1e-9)?;
    seen.set(seen.get() + 1);
    within("positions", (&ends[0] - &ends[1]).amax(), 1e-6)
}

#[test]
fn partitioning_moves_as_projection_does() {
    let seen = Cell::new(0);
    check(CASES, mechanisms(ALL), |mechanism| {
        both_ways(&mechanism, &seen)
    });
    assert!(seen.get() > CASES / 4, "{} cases", seen.get());
}

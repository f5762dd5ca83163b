//! Accelerations, multipliers and reactions of random mechanisms, against the dense augmented equations
//! of all their constraints.

use std::cell::Cell;

use crate::laws::built::moving;
use crate::laws::differences::{Outcome, check, within};
use crate::laws::mechanism::Mechanism;
use crate::laws::random::{ALL, Scope, mechanisms};

const CASES: u32 = 300;

fn agrees(mechanism: &Mechanism, seen: &Cell<[u32; 3]>) -> Outcome {
    let Some(mut moving) = moving(mechanism, 0.05)? else {
        return Ok(());
    };
    let values = moving.evaluated();
    let [x, v, a] = [&values.x, &values.v, &values.acceleration].map(|x| mechanism.apart(x));
    if mechanism.missing(0.0, &x).is_empty() {
        // One free element.
        return Ok(());
    }
    within("positions", mechanism.missing(0.0, &x).amax(), 1e-10)?;
    let exact = mechanism.augmented(0.0, (&x, &v), &a);
    within(
        "velocities",
        mechanism.missing_rates(0.0, &x, &v).amax(),
        1e-8,
    )?;
    let [mut all, mut free, mut skipped] = seen.get();
    all += 1;
    skipped += u32::from(exact.weakest < 1e-3);
    free += u32::from(!exact.redundant);
    seen.set([all, free, skipped]);
    if exact.weakest < 1e-3 {
        // Close to a singular configuration anything is sensitive.
        return Ok(());
    }
    let loss = 1e-10 / exact.weakest;
    within("forces", exact.lack, loss)?;
    within("accelerations of constraints", exact.gap, loss)?;
    if exact.redundant {
        return Ok(());
    }
    let found = moving.reactions(&values);
    let forces = (exact.reactions.iter()).map(|(f, m)| f.amax().max(m.abs()));
    let size = forces.fold(a.norm(), f64::max);
    for (i, (force, moment)) in exact.reactions.iter().enumerate() {
        let off = (found[i].0 - force).amax();
        within(
            &format!("reaction of {:?}", mechanism.holds[i]),
            off / size,
            10.0 * loss,
        )?;
        let off = (found[i].1 - moment).abs();
        within(
            &format!("moment of {:?}", mechanism.holds[i]),
            off / size,
            10.0 * loss,
        )?;
    }
    Ok(())
}

fn agree(scope: Scope) {
    let seen = Cell::new([0; 3]);
    check(CASES, mechanisms(scope), |mechanism| {
        agrees(&mechanism, &seen)
    });
    let [all, free, skipped] = seen.get();
    println!("{all} of {CASES} move, {free} without redundancy, {skipped} nearly singular");
    assert!(all > CASES / 2 && free > all / 2 && free < all && skipped < all / 5);
}

#[test]
fn accelerations_and_reactions_are_those_of_the_augmented_equations() {
    agree(ALL);
}

/// The same with loops alone.
#[test]
fn so_they_are_in_closed_loops() {
    agree(Scope {
        bodies: 5,
        extras: 4,
        loads: 0,
        rotates: false,
        ..ALL
    });
}

//! The tangent of random mechanisms with multipliers, where constraints leave freedom, and the equations linearized
//! exactly, in motion and with whatever is not symmetric, against differences of their accelerations.

use std::cell::Cell;

use flexbody::bodies::Node;
use flexbody::system::{DrivenSystem, Dynamics, Evaluation, System, linearized};
use nalgebra::{Complex, DMatrix, DVector};
use proptest::prelude::*;

use crate::laws::built::moving;
use crate::laws::chain::expand;
use crate::laws::dense::{Orthogonal, orthogonal};
use crate::laws::differences::{Outcome, check, derivative, within};
use crate::laws::mechanism::Mechanism;
use crate::laws::random::{ALL, Scope, mechanisms};

const CASES: u32 = 100;
const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The tangent of slides leaves out what moves along, that of followers is not symmetric, a rotating
/// frame has forces across; what is driven is not at rest.
const SYMMETRIC: Scope = Scope {
    bodies: 3,
    slides: false,
    drives: false,
    followers: false,
    rotates: false,
    ..ALL
};

/// Orthonormal directions in `q` that constraints hold at a configuration.
fn held(mechanism: &Mechanism, system: &System, t: f64, x: &[Node]) -> DMatrix<f64> {
    let n = system.coordinates();
    let jacobian = mechanism.jacobian(t, &mechanism.apart(x));
    let mut rows = DMatrix::zeros(n, jacobian.nrows());
    for i in 0..n {
        let mut q = vec![0.0; n];
        q[i] = 1.0;
        let moved = &jacobian * mechanism.apart(&expand(system, &q));
        rows.row_mut(i).copy_from(&moved.transpose());
    }
    // Rows of connections and pins vanish.
    let Orthogonal { q, .. } = orthogonal(&rows);
    q
}

fn tangent(mechanism: &Mechanism, seen: &Cell<u32>) -> Outcome {
    let Some(mut moving) = moving(mechanism, 0.03)? else {
        return Ok(());
    };
    moving.state.rates.fill(0.0);
    let values = moving.evaluated();
    let (system, n) = (&moving.system, moving.system.coordinates());
    let held = held(mechanism, system, 0.0, &values.x);
    if held.ncols() == n {
        return Ok(());
    }
    seen.set(seen.get() + u32::from(system.constraints() > 0));
    let free = DMatrix::identity(n, n) - &held * held.transpose();
    let (q, rest) = (moving.state.coordinates.clone(), vec![0.0; n]);
    let mut model = DrivenSystem::new(system, &[], &mut moving.work, &moving.state);
    let mut slope = |by_rate: bool, i: usize, step: f64| {
        derivative(step, |t| {
            let mut at = [q.clone(), rest.clone()];
            at[usize::from(by_rate)][i] += t;
            let mut a = vec![0.0; n];
            model.acceleration(0.0, &at[0], &at[1], &mut a);
            DVector::from_vec(a)
        })
    };
    let step = 1e-4 * system.scale() / (n as f64).sqrt();
    let columns = |slope: &mut dyn FnMut(usize) -> DVector<f64>| {
        let columns: Vec<DVector<f64>> = (0..n).map(slope).collect();
        -(&free * DMatrix::from_columns(&columns) * &free)
    };
    let stiffness = columns(&mut |i| slope(false, i, step));
    // At rest centrifugal terms are of second order in the rates.
    let damping = columns(&mut |i| slope(true, i, 10.0 * step));
    let s = 2.0 * stiffness.amax().sqrt().max(1.0) * (n as f64).sqrt();
    model.linearize(0.0, &q, &rest);
    prop_assert!(model.factor([s * s, s]), "not definite at {s}");
    let right = &free * DVector::from_vec(mechanism.random(n, 23));
    let mut x = right.as_slice().to_vec();
    model.solve(&mut x);
    let x = DVector::from_vec(x);
    within(
        "held directions",
        (held.transpose() * &x).norm(),
        1e-7 * x.norm(),
    )?;
    let back = &x * (s * s) + &damping * &x * s + &stiffness * &x;
    within("real solve", (back - &right).norm() / right.norm(), 1e-5)?;
    // Along what is held, inertia alone has a say.
    let whole = DVector::from_vec(mechanism.random(n, 31));
    let mut x = whole.as_slice().to_vec();
    model.solve(&mut x);
    let off = held.transpose() * (DVector::from_vec(x) * (s * s) - &whole);
    within("normal part", off.norm() / whole.norm(), 1e-6)?;

    let shift = Complex::new(0.8, 0.9) * s;
    prop_assert!(model.factor_complex([shift * shift, shift]));
    let mut z = [rest.clone(), right.as_slice().to_vec(), rest.clone()];
    model.solve_stages(IDENTITY.as_flattened(), IDENTITY.as_flattened(), &mut z);
    let z = DVector::from_fn(n, |i, _| Complex::new(z[1][i], z[2][i]));
    let complex = |m: &DMatrix<f64>| m.map(|x| Complex::new(x, 0.0));
    let back = &z * (shift * shift) + complex(&damping) * &z * shift + complex(&stiffness) * &z;
    let right = right.map(|x| Complex::new(x, 0.0));
    within("complex solve", (back - &right).norm() / right.norm(), 1e-5)
}

#[test]
fn tangents_are_derivatives_of_accelerations_where_constraints_leave_freedom() {
    let seen = Cell::new(0);
    check(CASES, mechanisms(SYMMETRIC), |mechanism| {
        tangent(&mechanism, &seen)
    });
    assert!(
        seen.get() > CASES / 4,
        "{} cases with multipliers",
        seen.get()
    );
}

/// Compares `K` and `R` with differences of accelerations by place and by rate.
fn alike(
    rate: f64,
    [by_place, stiffness]: [&DMatrix<f64>; 2],
    [by_rate, damping]: [&DMatrix<f64>; 2],
) -> Outcome {
    within("K", (by_place - stiffness).amax(), 1e-5 * rate * rate)?;
    within(
        "R",
        (by_rate - damping).amax(),
        1e-6 * (rate + damping.amax()),
    )
}

/// Against the covariant derivative along motions that keep the constraints: accelerations at states that are moved
/// and brought back, in the tangent plane, less what the plane's own rotating makes of them.
fn exact(mechanism: &Mechanism, seen: &Cell<[u32; 3]>) -> Outcome {
    let Some(mut moving) = moving(mechanism, 0.03)? else {
        return Ok(());
    };
    let values = moving.evaluated();
    let [x, v, a] = [&values.x, &values.v, &values.acceleration].map(|x| mechanism.apart(x));
    let weakest = if mechanism.missing(0.0, &x).is_empty() {
        1.0
    } else {
        mechanism.augmented(0.0, (&x, &v), &a).weakest
    };
    let [basis, stiffness, damping] =
        linearized(&moving.system, &[], &mut moving.work, &moving.state);
    let (system, n) = (&moving.system, moving.system.coordinates());
    if basis.ncols() == 0 || weakest < 1e-2 {
        return Ok(());
    }
    let rates = moving.state.rates.clone();
    let projector = |t: f64| {
        let (mut state, mut work) = (moving.state.clone(), moving.work.clone());
        state.time = t;
        (state.coordinates.iter_mut().zip(&rates)).for_each(|(q, v)| *q += t * v);
        let mut values = Evaluation::new(system);
        values.kinematics(system, &state, &mut work);
        let held = held(mechanism, system, t, &values.x);
        DMatrix::identity(n, n) - &held * held.transpose()
    };
    let plane = projector(0.0);
    prop_assert_eq!(plane.trace().round() as usize, basis.ncols());
    within("basis", (&plane * &basis - &basis).amax(), 1e-6)?;
    let turning = derivative(2e-3, projector);
    let turned = (&turning * &basis).transpose() * (&turning * &basis);

    let size = system.scale() / (n as f64).sqrt();
    let mut work = moving.work.clone();
    let mut slope = |by_rate: bool, column: usize| {
        let step = if by_rate { 1e-3 } else { 1e-4 } * size;
        derivative(step, |t| {
            let mut state = moving.state.clone();
            let moved = if by_rate {
                &mut state.rates
            } else {
                &mut state.coordinates
            };
            moved
                .iter_mut()
                .zip(basis.column(column).iter())
                .for_each(|(x, b)| *x += t * b);
            let mut model = DrivenSystem::new(system, &[], &mut work, &moving.state);
            if !by_rate {
                assert!(model.project(&mut state));
            }
            let mut a = vec![0.0; n];
            model.acceleration(0.0, &state.coordinates, &state.rates, &mut a);
            DVector::from_vec(a)
        })
    };
    let mut columns = |by_rate: bool| {
        let columns: Vec<_> = (0..basis.ncols()).map(|k| slope(by_rate, k)).collect();
        -(basis.transpose() * DMatrix::from_columns(&columns))
    };
    let (by_place, by_rate) = (columns(false) - turned, columns(true));
    let rate = 1.0 + stiffness.amax().sqrt();
    alike(rate, [&by_place, &stiffness], [&by_rate, &damping])?;
    let skew = |m: &DMatrix<f64>| u32::from((m - m.transpose()).amax() > 1e-4 * rate);
    let [all, unsymmetric, held] = seen.get();
    let multiplied = u32::from(system.constraints() > 0);
    seen.set([all + 1, unsymmetric + skew(&stiffness), held + multiplied]);
    Ok(())
}

#[test]
fn linearized_equations_are_derivatives_of_accelerations_in_motion() {
    let seen = Cell::new([0; 3]);
    check(CASES, mechanisms(Scope { bodies: 3, ..ALL }), |mechanism| {
        exact(&mechanism, &seen)
    });
    let [all, unsymmetric, held] = seen.get();
    println!("{all} of {CASES}, {unsymmetric} not symmetric, {held} with multipliers");
    assert!(all > CASES / 2 && unsymmetric > all / 4 && held > all / 3);
}

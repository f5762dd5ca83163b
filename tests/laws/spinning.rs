//! Rigid bodies of space that rotate: their small motions against differences of Newton's and Euler's equations, and what
//! is seen from a frame that rotates.

use flexbody::system::{Evaluation, System, linearized};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3};

use crate::laws::chance::Chance;
use crate::laws::linkage::{Body, Held, Kind, Mechanism, V};

/// Displacements and rotations of all bodies, in global components, of vectors of `q` (columns).
fn twists(mechanism: &Mechanism, system: &System<3>, columns: &DMatrix<f64>) -> DMatrix<f64> {
    let elimination = system.elimination();
    let mut found = DMatrix::zeros(6 * mechanism.bodies.len(), columns.ncols());
    let mut y = vec![0.0; elimination.scratch()];
    let mut x = vec![[[0.0; 3]; 2]; 2 * mechanism.bodies.len()];
    for (k, column) in columns.column_iter().enumerate() {
        elimination.expand(column.into_owned().as_slice(), &mut y, &mut x);
        for (i, body) in mechanism.bodies.iter().enumerate() {
            let [center, rotation] = x[2 * i].map(V::from);
            found.fixed_view_mut::<3, 1>(6 * i, k).copy_from(&center);
            let rotation = body.axes * rotation;
            found
                .fixed_view_mut::<3, 1>(6 * i + 3, k)
                .copy_from(&rotation);
        }
    }
    found
}

/// Mass over global axes, and its rate.
fn mass(mechanism: &Mechanism) -> [DMatrix<f64>; 2] {
    let n = 6 * mechanism.bodies.len();
    let mut made = [DMatrix::zeros(n, n), DMatrix::zeros(n, n)];
    for (i, body) in mechanism.bodies.iter().enumerate() {
        let inertia = body.axes * Matrix3::from_diagonal(&body.moments) * body.axes.transpose();
        let turn = body.spin.cross_matrix();
        for j in 0..3 {
            made[0][(6 * i + j, 6 * i + j)] = body.mass;
        }
        let at = (6 * i + 3, 6 * i + 3);
        made[0]
            .fixed_view_mut::<3, 3>(at.0, at.1)
            .copy_from(&inertia);
        let rate = turn * inertia - inertia * turn;
        made[1].fixed_view_mut::<3, 3>(at.0, at.1).copy_from(&rate);
    }
    made
}

/// The same mechanism with its bodies displaced and rotated, and with other velocities and spins.
fn disturbed(
    mechanism: &Mechanism,
    way: &DVector<f64>,
    rate: &DVector<f64>,
    size: f64,
) -> Mechanism {
    let mut bodies = mechanism.twisted(way, size);
    for (i, body) in bodies.iter_mut().enumerate() {
        let part = |of: &DVector<f64>, k: usize| V::from_fn(|j, _| of[6 * i + k + j]);
        let spin = mechanism.bodies[i].spin;
        body.velocity += part(rate, 0) * size;
        body.spin = spin + (part(rate, 3) + part(way, 3).cross(&spin)) * size;
    }
    Mechanism {
        bodies,
        ..mechanism.clone()
    }
}

/// `a'' + R a' + K a = 0` for motions `N a`, with a basis `N` that is carried along so that `N^T M N' = 0`.
#[test]
fn small_motions_about_turning_bodies_are_those_of_newton_and_euler() {
    let mut chance = Chance(29);
    let mut compared = 0;
    for run in 0..120 {
        let mechanism = Mechanism::random(&mut chance);
        if mechanism.is_driven() {
            continue;
        }
        let (system, state, mut work) = mechanism.started();
        let [basis, stiffness, damping] = linearized(&system, &[], &mut work, &state);
        let n = basis.ncols();
        let rows = mechanism.jacobian();
        let is_redundant = !mechanism.joints.is_empty() && {
            let sizes = rows.clone().svd(false, false).singular_values;
            sizes.min() < 1e-3 * sizes.max()
        };
        if n == 0 || is_redundant {
            continue;
        }
        compared += 1;
        let basis = twists(&mechanism, &system, &basis);
        let [mass, mass_rate] = mass(&mechanism);
        let one = basis.transpose() * &mass * &basis;
        assert!((&one - DMatrix::identity(n, n)).amax() < 1e-9, "{run}");
        let mut carried = DMatrix::zeros(basis.nrows(), n);
        if !mechanism.joints.is_empty() {
            assert!((&rows * &basis).amax() < 1e-7, "{run}");
            let moving = mechanism.twists();
            let at = |h: f64| Mechanism {
                bodies: mechanism.twisted(&moving, h),
                ..mechanism.clone()
            };
            const STEP: f64 = 1e-4;
            let rates = (at(STEP).jacobian() - at(-STEP).jacobian()) / (2.0 * STEP);
            let inverse = mass.clone().cholesky().expect("positive").inverse();
            let schur = &rows * &inverse * rows.transpose();
            let least = schur.cholesky().expect("independent rows").inverse();
            carried = -&inverse * rows.transpose() * least * rates * &basis;
        }
        let a = DVector::from_fn(n, |_, _| chance.number());
        let rate = DVector::from_fn(n, |_, _| chance.number());
        let (way, change) = (&basis * &a, &basis * &rate + &carried * &a);
        const STEP: f64 = 1e-4;
        let at = |h: f64| disturbed(&mechanism, &way, &change, h).accelerations();
        let mut second = (at(STEP) - at(-STEP)) / (2.0 * STEP);
        let now = mechanism.accelerations();
        for (i, body) in mechanism.bodies.iter().enumerate() {
            let part = |of: &DVector<f64>| V::from_fn(|j, _| of[6 * i + 3 + j]);
            let turned = part(&change).cross(&body.spin) + part(&way).cross(&part(&now));
            let mut rows = second.fixed_rows_mut::<3>(6 * i + 3);
            rows -= turned;
        }
        let still =
            carried.transpose() * &mass * &carried + basis.transpose() * mass_rate * &carried;
        let wanted = basis.transpose() * mass * second + still * &a;
        let found = -(&damping * &rate + &stiffness * &a);
        let size = wanted.amax() + stiffness.amax() + damping.amax() + 0.1;
        let miss = (&wanted - &found).amax() / size;
        assert!(miss < 1e-5, "{run}: {miss:e}, {wanted} for {found}");
    }
    assert!(compared > 60, "{compared}");
}

/// What is free of the ground moves in a frame that rotates as it does outside: with `W` the frame's rate,
/// `v' = v - W x r`, `a' = a - 2 W x v' - W x (W x r)`, and angular velocities and accelerations likewise.
#[test]
fn a_turning_frame_changes_what_is_seen_alone() {
    let mut chance = Chance(31);
    let mut compared = 0;
    while compared < 60 {
        let mut mechanism = Mechanism::random(&mut chance);
        if mechanism.is_driven() {
            continue;
        }
        if mechanism
            .joints
            .iter()
            .any(|joint| joint.bodies[0].is_none())
        {
            continue;
        }
        compared += 1;
        mechanism.gravity = V::zeros();
        let outside = mechanism.accelerations();
        let rate = chance.vector() * 2.0;
        let spins: Vec<V> = mechanism.bodies.iter().map(|body| body.spin).collect();
        for body in &mut mechanism.bodies {
            body.velocity -= rate.cross(&body.center);
            body.spin -= rate;
        }
        let mut parts = mechanism.parts();
        parts.rotation = rate.into();
        let system = System::new(parts).expect("a system");
        let (state, mut work) = mechanism.state_of(&system);
        let mut evaluation = Evaluation::new(&system);
        evaluation.kinematics(&system, &state, &mut work);
        evaluation.dynamics(&system, &state, &[], &mut work);
        let size = outside.amax() + rate.norm_squared() + 1.0;
        for (i, body) in mechanism.bodies.iter().enumerate() {
            let part = |k: usize| V::from_fn(|j, _| outside[6 * i + k + j]);
            let carried = rate.cross(&body.velocity) * 2.0 + rate.cross(&rate.cross(&body.center));
            let found = V::from(evaluation.acceleration[2 * i][0]);
            let miss = (found - (part(0) - carried)).norm();
            assert!(
                miss < 1e-6 * size,
                "{compared} body {i}: {miss:e} of {size:e}"
            );
            // Angular accelerations: of the first axis.
            let turn = part(3) - rate.cross(&spins[i]);
            let axis = body.axes.column(0).into_owned();
            let wanted = turn.cross(&axis) + body.spin.cross(&body.spin.cross(&axis));
            let found = V::from(evaluation.acceleration[2 * i][1]);
            let miss = (found - wanted).norm();
            assert!(
                miss < 1e-6 * size,
                "{compared} axis of {i}: {miss:e} of {size:e}"
            );
        }
    }
}

/// Small displacements and rotations `p` with `p'' + R p' + K p = 0` outside move by `p'' + (R + 2 W) p' + (K + R W + W W) p = 0`
/// in a frame that rotates, `W` the matrix of the cross product with its rate: there they have the rates `p' - W p`.
#[test]
fn small_motions_in_a_turning_frame_are_those_outside_seen_from_it() {
    let mut chance = Chance(41);
    let mut sizes = 0.0_f64;
    for run in 0..40 {
        let mut mechanism = Mechanism {
            bodies: Mechanism::random(&mut chance).bodies,
            joints: Vec::new(),
            gravity: V::zeros(),
            sprung: Vec::new(),
            gears: Vec::new(),
        };
        let small = |mechanism: &Mechanism, rotation: V| {
            let mut parts = mechanism.parts();
            parts.rotation = rotation.into();
            let system = System::new(parts).expect("a system");
            let (state, mut work) = mechanism.state_of(&system);
            let [basis, stiffness, damping] = linearized(&system, &[], &mut work, &state);
            let basis = twists(mechanism, &system, &basis);
            let inverse = basis.clone().try_inverse().expect("free bodies");
            [stiffness, damping].map(|matrix| &basis * matrix * &inverse)
        };
        let [stiffness, damping] = small(&mechanism, V::zeros());
        let rate = chance.vector() * 2.0;
        for body in &mut mechanism.bodies {
            body.velocity -= rate.cross(&body.center);
            body.spin -= rate;
        }
        let found = small(&mechanism, rate);
        let mut turn = DMatrix::zeros(damping.nrows(), damping.nrows());
        for at in (0..turn.nrows()).step_by(3) {
            turn.fixed_view_mut::<3, 3>(at, at)
                .copy_from(&rate.cross_matrix());
        }
        let wanted = [
            stiffness + (&damping + &turn) * &turn,
            damping + &turn * 2.0,
        ];
        for (found, wanted) in found.iter().zip(&wanted) {
            let miss = (found - wanted).amax() / (wanted.amax() + 1.0);
            assert!(miss < 1e-9, "{run}: {miss:e}, {found} for {wanted}");
            sizes = sizes.max(wanted.amax());
        }
    }
    assert!(sizes > 1.0, "{sizes}");
}

/// A free body is found to move as it does; a thin rod, too, of which the energy does not tell how it rotates about itself.
#[test]
fn a_free_body_moves_steadily_as_it_moves() {
    let mut chance = Chance(43);
    for run in 0..200 {
        // About its own axis a thin rod has none.
        let own = 0.4 * f64::from(run % 2);
        let mechanism = Mechanism {
            bodies: vec![Body {
                mass: 1.0,
                moments: V::new(own, 0.4, 0.4),
                center: chance.vector() * 2.0,
                axes: Rotation3::new(chance.vector() * 3.0).into_inner(),
                velocity: chance.vector(),
                spin: chance.vector(),
            }],
            joints: Vec::new(),
            gravity: V::zeros(),
            sprung: Vec::new(),
            gears: Vec::new(),
        };
        let body = &mechanism.bodies[0];
        let (system, state, mut work) = mechanism.started();
        let rates = mechanism.nodes(|body| (body.velocity, body.spin.cross_matrix() * body.axes));
        let steady = system.steady(&state, &rates, &mut work);
        let steady = steady.expect("a steady motion");
        let miss = (V::from(steady.rate) - body.spin).norm();
        assert!(miss < 1e-9, "{run}: turns at {steady:?}, {miss:e} off");
        let found = steady.velocity + V::from(steady.rate).cross(&body.center);
        let miss = (found - body.velocity).norm();
        assert!(miss < 1e-9, "{run}: moves at {steady:?}, {miss:e} off");
    }
}

/// A body on two ball joints, wherever they are, rotates about the line through them. How fast, joints leave free.
#[test]
fn a_steady_turn_about_any_line_that_joints_leave_free_is_found() {
    let mut chance = Chance(37);
    for run in 0..200 {
        let center = chance.vector();
        let axes = Rotation3::new(chance.vector() * 3.0).into_inner();
        let points = [0; 2].map(|_| chance.vector());
        let spin = (points[1] - points[0]).normalize() * 1.5;
        let held = points.map(|point| Held {
            kind: Kind::Spherical,
            bodies: [None, Some(0)],
            points: [point, axes.transpose() * (point - center)],
            axes: [Matrix3::identity(); 2],
            length: 0.0,
        });
        let mechanism = Mechanism {
            bodies: vec![Body {
                mass: 1.0,
                moments: V::new(0.3, 0.4, 0.5),
                center,
                axes,
                velocity: spin.cross(&(center - points[0])),
                spin,
            }],
            joints: held.into(),
            gravity: V::zeros(),
            sprung: Vec::new(),
            gears: Vec::new(),
        };
        let (system, state, mut work) = mechanism.started();
        let rates = mechanism.nodes(|body| (body.velocity, spin.cross_matrix() * body.axes));
        let steady = system.steady(&state, &rates, &mut work);
        let found = V::from(steady.expect("a steady motion").rate);
        let miss = (found - spin).norm();
        assert!(miss < 1e-9, "{run}: {found} for {spin}");
    }
}

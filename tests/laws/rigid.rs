//! Rigid bodies of space in random mechanisms, against Newton's and Euler's equations of every body by itself.

use flexbody::bodies::{Marker, Node};
use flexbody::integrators::{OneStepMethod, RK4, Radau, RungeKutta, Tolerance, advance};
use flexbody::math::function::Function;
use flexbody::math::jet::Jet;
use flexbody::system::loads::{
    AppliedLoad, Contact, ContactLaw, ContactPoint, ContactSurface, OneSidedSpring, RigidFrame,
    Spring, TangentialSpring,
};
use flexbody::system::{
    Attachment, Derivatives, Drive, DrivenSystem, Dynamics, Evaluation, Parts, Signal, State,
    System, Workspace,
};
use nalgebra::{DMatrix, DVector};

use crate::laws::chance::Chance;
use crate::laws::least::is_near_singular;
use crate::laws::linkage::{Held, Kind, Mechanism, V};
use crate::laws::sprung::Sprung;

#[test]
fn accelerations_are_those_of_newton_and_euler() {
    let (mut all, mut compared) = (0, 0);
    for mut chance in Chance::several(1) {
        for run in 0..1200 {
            let mut mechanism = Mechanism::random(&mut chance);
            if run % 2 == 0 {
                mechanism.spring(&mut chance, run % 4 == 0);
            }
            let (system, state, mut work) = mechanism.started();
            all += 1;
            if !is_near_singular(&system, &state, &mut work) {
                compared += 1;
                accelerations_fit(run, &mechanism, (&system, &state, &mut work));
            }
        }
    }
    assert!(compared * 20 > all * 19, "{compared} of {all}");
}

fn accelerations_fit(
    run: usize,
    mechanism: &Mechanism,
    (system, state, work): (&System<3>, &State, &mut Workspace<3>),
) {
    let mut evaluation = Evaluation::new(system);
    evaluation.kinematics(system, state, work);
    evaluation.dynamics(system, state, &[], work);
    let wanted = mechanism.accelerations();
    let size = wanted.amax() + mechanism.twists().amax() + mechanism.gravity.norm();
    let stored = mechanism.sprung_forces().1;
    let miss = (evaluation.spring_energy(system) - stored).abs();
    assert!(
        miss < 1e-10 * (1.0 + stored),
        "{run}: {miss:e} of {stored} J"
    );
    for (i, body) in mechanism.bodies.iter().enumerate() {
        let part = |k: usize| V::from_fn(|j, _| wanted[6 * i + k + j]);
        let node = |of: &[Node<3>]| {
            [
                of[2 * i][0],
                of[2 * i][1],
                of[2 * i + 1][0],
                of[2 * i + 1][1],
            ]
            .map(V::from)
        };
        let (x, v, a) = (
            node(&evaluation.x),
            node(&evaluation.v),
            node(&evaluation.acceleration),
        );
        let names = mechanism.joints.iter().map(|joint| joint.kind);
        let names: Vec<Kind> = names.collect();
        let off = [(x[0] - body.center).norm(), (v[0] - body.velocity).norm()];
        assert!(
            off[0] < 1e-9 && off[1] < 1e-7,
            "{run} {names:?} {:?}: {off:?}",
            mechanism.gears
        );
        let miss = (a[0] - part(0)).norm();
        assert!(
            miss < 1e-6 * size,
            "{run} {names:?} {:?}: {miss:e} of {size:e}",
            mechanism.sprung
        );
        for k in 1..4 {
            let w = body.spin;
            let turned = part(3).cross(&x[k]) + w.cross(&w.cross(&x[k]));
            let miss = (a[k] - turned).norm();
            assert!(
                miss < 1e-6 * size,
                "{run} {names:?} axis {k}: {miss:e} of {size:e}"
            );
        }
    }
}

#[test]
fn trees_are_eliminated_as_multipliers_would() {
    // Accelerations with multipliers are those of Newton and Euler, above; without them they must be the same.
    let (mut all, mut compared, mut trees) = (0, 0, 0);
    for mut chance in Chance::several(23) {
        for run in 0..600 {
            let mechanism = Mechanism::random(&mut chance);
            let (system, state, mut work) = mechanism.started();
            all += 1;
            if is_near_singular(&system, &state, &mut work) {
                continue;
            }
            compared += 1;
            trees += u32::from(system.is_open_tree());
            elimination_fits(run, (&system, state, &mut work), &mut chance);
        }
    }
    assert!(compared * 20 > all * 19, "{compared} of {all}");
    assert!(trees * 10 > all, "{trees} trees of {all}");
}

fn elimination_fits(
    run: usize,
    (system, mut state, work): (&System<3>, State, &mut Workspace<3>),
    chance: &mut Chance,
) {
    let n = system.coordinates();
    let mut model = DrivenSystem::new(system, &[], work, &state);
    model.renew_beyond(&mut state, 0.0);
    let mut without = vec![0.0; n];
    let at = (&state.coordinates, &state.rates);
    model.acceleration(0.0, at.0, at.1, &mut without);
    let mut other = DVector::from_fn(n, |_, _| chance.number());
    let kept = other.clone();
    model.take_out_normal(other.as_mut_slice());
    let with = model.accelerate(0.0, at.0, at.1).to_vec();
    let mut along = kept.clone();
    model.take_out_normal(along.as_mut_slice());
    let (with, without) = (DVector::from_vec(with), DVector::from_vec(without));
    let miss = (&with - without).amax() / (1.0 + with.amax());
    assert!(miss < 1e-11, "{run}: {miss:e}");
    let miss = (along - other).amax();
    assert!(miss < 1e-11, "{run}: {miss:e} in the tangent plane");

    // Rates that are off are brought back along the shortest way: across all that joints allow.
    state
        .rates
        .iter_mut()
        .zip(&kept)
        .for_each(|(v, off)| *v += off);
    let off = state.rates.clone();
    assert!(model.project(&mut state), "{run}");
    let mut change = DVector::from_fn(n, |k, _| state.rates[k] - off[k]);
    model.accelerate(0.0, &state.coordinates, &state.rates);
    model.take_out_normal(change.as_mut_slice());
    assert!(change.amax() < 1e-11, "{run}: {:e} along", change.amax());
    let mut left = 0.0_f64;
    let (q, v) = (&state.coordinates, &state.rates);
    system.visit_constraints(0.0, q, Some(v), work, |row| {
        left = left.max(row.rate().abs());
    });
    assert!(left < 1e-12, "{run}: {left:e} left");
}

/// Energy, momentum and angular momentum of a state.
fn invariants(system: &System<3>, state: &State, work: &mut Workspace<3>) -> [f64; 7] {
    let mut values = Evaluation::new(system);
    values.kinematics(system, state, work);
    let energy = values.kinetic_energy(system)
        + values.gravity_energy(system)
        + values.spring_energy(system);
    let ([a, b, c], [d, e, f]) = {
        let (linear, angular) = values.momentum(system);
        (<[f64; 3]>::from(linear), angular)
    };
    [energy, a, b, c, d, e, f]
}

fn advanced(
    method: &mut dyn OneStepMethod,
    (system, state, work): (&System<3>, &mut State, &mut Workspace<3>),
    until: f64,
    tolerance: f64,
) -> u64 {
    let tolerance = Tolerance {
        relative: tolerance,
        position: system.scale(),
        time: 0.5,
    };
    let mut model = DrivenSystem::new(system, &[], work, state);
    let (counts, result) = advance(method, &mut model, state, until, &tolerance);
    result.unwrap_or_else(|error| panic!("{error:?} at {} s", state.time));
    counts.steps
}

#[test]
fn free_mechanisms_keep_energy_momentum_and_angular_momentum() {
    let mut chance = Chance(7);
    let mut runs = 0;
    while runs < 40 {
        let mut mechanism = Mechanism::random(&mut chance);
        let is_grounded = |joint: &Held| joint.bodies[0].is_none();
        if mechanism.joints.iter().any(is_grounded) || mechanism.is_driven() {
            continue;
        }
        mechanism.gravity = V::zeros();
        runs += 1;
        if runs % 2 == 0 {
            mechanism.spring(&mut chance, false);
            mechanism.sprung.retain(|sprung| match sprung {
                Sprung::Bushing(bushing) => bushing.bodies[0].is_some(),
                _ => true,
            });
        }
        let (system, start, mut work) = mechanism.started();
        let n = system.coordinates();
        let before = invariants(&system, &start, &mut work);
        let mut ends = Vec::new();
        let tolerance = if mechanism.sprung.is_empty() {
            1e-8
        } else {
            1e-9
        };
        let methods: [&mut dyn OneStepMethod; 2] = [
            &mut RungeKutta::new(&RK4, n, 1e-9, 1e-9),
            &mut Radau::new(n),
        ];
        for method in methods {
            let mut state = start.clone();
            let name = method.name();
            let steps = advanced(method, (&system, &mut state, &mut work), 3.0, tolerance);
            let after = invariants(&system, &state, &mut work);
            for (k, (a, b)) in before.iter().zip(after).enumerate() {
                let miss = (a - b).abs() / before[0];
                assert!(miss < 3e-6, "{runs} {name}, {steps} steps, {k}: {miss:e}");
            }
            let mut values = Evaluation::new(&system);
            values.kinematics(&system, &state, &mut work);
            ends.push(values.x);
        }
        let far = ends[0].iter().flatten().zip(ends[1].iter().flatten());
        let far = far.map(|(a, b)| (V::from(*a) - V::from(*b)).norm());
        let far = far.fold(0.0, f64::max);
        assert!(far < 1e-4, "{runs}: {far:e}");
    }
}

/// A step for differences that is short beside the times in which accelerations and their rates change.
fn fitting(system: &System<3>, state: &State, work: &mut Workspace<3>) -> f64 {
    let (mut plain, mut made) = (Evaluation::new(system), Derivatives::new(system));
    plain.kinematics(system, state, work);
    plain.dynamics(system, state, &[], work);
    made.in_time(system, (&plain, state), &[], 2, work);
    let vectors = made.values.acceleration.iter().flatten();
    let rates = vectors.map(|a| {
        let [size, jerk, snap] = [|j: &Jet| j.re, |j: &Jet| j.v1, |j: &Jet| j.v2]
            .map(|of| V::from_fn(|k, _| of(&a[k])).norm());
        f64::max(jerk / (size + 10.0), snap / (jerk + 10.0))
    });
    f64::min(2e-3, 0.06 / rates.fold(1.0, f64::max))
}

#[test]
fn derivatives_in_time_are_those_of_the_motion() {
    let mut chance = Chance(3);
    for run in 0..100 {
        let mut mechanism = Mechanism::random(&mut chance);
        if run % 2 == 0 {
            mechanism.spring(&mut chance, true);
        }
        let (system, start, mut work) = mechanism.started();
        let mut accelerations = Vec::new();
        let step = fitting(&system, &start, &mut work);
        let mut made = Derivatives::new(&system);
        let mut state = start.clone();
        for k in 0..5 {
            if k > 0 {
                let mut method = RungeKutta::new(&RK4, system.coordinates(), 1e-9, 1e-9);
                let until = step * f64::from(k);
                advanced(&mut method, (&system, &mut state, &mut work), until, 1e-13);
            }
            let mut plain = Evaluation::new(&system);
            plain.kinematics(&system, &state, &mut work);
            plain.dynamics(&system, &state, &[], &mut work);
            if k == 2 {
                made.in_time(&system, (&plain, &state), &[], 2, &mut work);
            }
            accelerations.push(plain.acceleration);
        }
        for (node, found) in made.values.acceleration.iter().enumerate() {
            for (part, found) in found.iter().enumerate() {
                let at = |k: usize| V::from(accelerations[k][node][part]);
                let [a, b, c, d, e] = [at(0), at(1), at(2), at(3), at(4)];
                let first = ((a - e) + (d - b) * 8.0) / (12.0 * step);
                let second = ((b + d) * 16.0 - c * 30.0 - a - e) / (12.0 * step * step);
                let [jerk, snap] =
                    [|j: &Jet| j.v1, |j: &Jet| j.v2].map(|of| V::from_fn(|k, _| of(&found[k])));
                let size = c.norm() + mechanism.gravity.norm() + 10.0;
                let misses = [(jerk - first).norm(), (snap - second).norm()];
                let (jerks, snaps) = (size + jerk.norm(), size + snap.norm());
                assert!(
                    misses[0] < 1e-4 * jerks && misses[1] < 1e-3 * snaps,
                    "{run} node {node}, {part}: {misses:?} of {jerks} and {snaps}"
                );
            }
        }
    }
}

/// Its parts, with springs from every body to the ground.
fn tethered(mechanism: &Mechanism, chance: &mut Chance) -> Parts<3> {
    let mut parts = mechanism.parts();
    for (body, sign) in (0..mechanism.bodies.len()).flat_map(|body| [(body, 1.0), (body, -1.0)]) {
        let at = chance.vector();
        let marker = Marker::framed(body, 2 * body, at.into(), [1.0, 0.0, 0.0]);
        let point = mechanism.bodies[body].point(&at) + chance.vector() + V::new(sign, 0.0, 0.0);
        parts.loads.push(AppliedLoad::Spring(Spring {
            ends: [Attachment::Ground(point), Attachment::Body(marker)],
            stiffness: 50.0,
            damping: 0.0,
            length: Signal::Function(Function::constant(0.4)),
        }));
    }
    for body in 1..mechanism.bodies.len() {
        let touching = touching(mechanism, body, chance);
        let sticking = sticking(touching.clone(), &mut parts.drives, chance);
        let loads = [touching, sticking].map(|of| AppliedLoad::Contact(Box::new(of)));
        parts.loads.extend(loads);
    }
    parts
}

/// The contact, of a point that sticks to the surface near its place in the frame of the surface.
fn sticking(mut of: Contact<3>, drives: &mut Vec<Drive>, chance: &mut Chance) -> Contact<3> {
    let (point, normal) = match of.law.surface {
        ContactSurface::Plane { point, normal } => (point, normal),
        ContactSurface::Round { center, .. } => (center + V::x() * 2.0, V::x()),
    };
    of.law.surface = ContactSurface::Plane { point, normal };
    of.kept = Some(drives.len());
    of.law.friction = 0.5;
    of.law.radius = 0.0;
    of.rolling = None;
    of.law.sticking = Some(TangentialSpring {
        stiffness: 20.0,
        damping: 0.0,
        static_ratio: 1.0,
    });
    let end = point + chance.vector();
    let kept = end.iter().copied().chain([1.0]);
    drives.extend(kept.map(|value| Drive::Function(Function::constant(value))));
    of
}

/// Contact of a place of a body with a surface of the one before it, deep below.
fn touching(mechanism: &Mechanism, body: usize, chance: &mut Chance) -> Contact<3> {
    let at = chance.vector();
    let owner = &mechanism.bodies[body - 1];
    let place = owner.axes.transpose() * (mechanism.bodies[body].point(&at) - owner.center);
    let normal = (chance.vector() + V::new(0.0, 0.0, 2.0)).normalize();
    let round = |axis| ContactSurface::Round {
        center: place - normal * 0.9,
        axis,
        radius: 1.0,
    };
    let surface = match body % 3 {
        0 => ContactSurface::Plane {
            point: place + normal * 0.2,
            normal,
        },
        1 => round(None),
        _ => round(Some(V::new(0.6, 0.0, 0.8))),
    };
    let frame = |of: usize| {
        let center = Marker::framed(of, 2 * of, [0.0; 3], [1.0, 0.0, 0.0]);
        Some(RigidFrame::of(&center))
    };
    Contact {
        places: vec![ContactPoint {
            marker: Marker::framed(body, 2 * body, at.into(), [1.0, 0.0, 0.0]),
            weight: 1.0,
        }],
        law: ContactLaw {
            surface,
            spring: OneSidedSpring {
                stiffness: 30.0,
                damping: 0.0,
            },
            friction: 0.0,
            slip_velocity: 0.0,
            sticking: None,
            radius: 0.3,
        },
        surface_frame: frame(body - 1),
        rolling: frame(body),
        kept: None,
    }
}

#[test]
fn the_stiffness_is_the_derivative_of_forces() {
    let (mut chance, mut compared) = (Chance(11), 0);
    for run in 0..60 {
        let mut mechanism = Mechanism::random(&mut chance);
        if mechanism.is_driven() {
            continue;
        }
        if run % 2 == 0 {
            mechanism.spring(&mut chance, false);
        }
        mechanism.bodies.iter_mut().for_each(|body| {
            (body.velocity, body.spin) = (V::zeros(), V::zeros());
        });
        let parts = tethered(&mechanism, &mut chance);
        compared += usize::from(stiffness_is_the_derivative(run, &mechanism, parts));
    }
    assert!(compared > 35, "{compared}");
}

/// Largest singular value of a mechanism's Jacobian over the least that is not zero: large near a singular position. Along a
/// way `h` rows change by about `h` of the largest, so that what follows from them changes by `h` times this.
fn condition(mechanism: &Mechanism) -> f64 {
    if mechanism.joints.is_empty() {
        return 1.0;
    }
    let sizes = mechanism.jacobian().singular_values();
    let largest = sizes.max();
    let least = sizes.iter().filter(|size| **size > 1e-7 * largest);
    largest / least.fold(largest, |least, size| least.min(*size))
}

/// Compares the symmetric part of the stiffness of a mechanism at rest under loads with differences. Returns whether it
/// was compared. Near a singular position it is not: the error of the differences is the fourth power of the step times
/// the condition.
pub fn stiffness_is_the_derivative(run: usize, mechanism: &Mechanism, parts: Parts<3>) -> bool {
    const STEP: f64 = 1e-4;
    const LIMIT: f64 = 1e-5;
    if (STEP * condition(mechanism)).powi(4) > 0.1 * LIMIT {
        return false;
    }
    let system = System::new(parts).expect("a system");
    let (mut state, mut work) = mechanism.state_of(&system);
    state.rates.fill(0.0);
    let n = system.coordinates();
    let rest = vec![0.0; n];
    let mut model = DrivenSystem::new(&system, &[], &mut work, &state);
    model.renew_beyond(&mut state, 0.0);
    let mut tangents = Vec::new();
    for k in 0..n {
        let mut unit = vec![0.0; n];
        unit[k] = 1.0;
        model.linearize(0.0, &state.coordinates, &rest);
        model.apply_stiffness(&mut unit);
        tangents.push(unit);
    }
    let at = |model: &mut DrivenSystem<'_, 3>, k: usize, h: f64| {
        let mut q = state.coordinates.clone();
        let mut way = vec![0.0; n];
        way[k] = 1.0;
        model.linearize(0.0, &state.coordinates, &rest);
        model.take_out_normal(&mut way);
        q.iter_mut().zip(&way).for_each(|(q, way)| *q += h * way);
        let mut moved = State {
            coordinates: q,
            ..state.clone()
        };
        model.project(&mut moved);
        let mut a = model.accelerate(0.0, &moved.coordinates, &rest).to_vec();
        model.linearize(0.0, &state.coordinates, &rest);
        model.take_out_normal(&mut a);
        a
    };
    let columns = (0..n).map(|k| {
        let mut by = |h: f64| {
            let [a, b] = [at(&mut model, k, h), at(&mut model, k, -h)];
            DVector::from_fn(n, |j, _| (b[j] - a[j]) / (2.0 * h))
        };
        (by(0.5 * STEP) * 4.0 - by(STEP)) / 3.0
    });
    let wanted = DMatrix::from_columns(&columns.collect::<Vec<_>>());
    let symmetric = (&wanted + wanted.transpose()) * 0.5;
    let found = DMatrix::from_fn(n, n, |i, j| tangents[j][i]);
    // Where nothing is free, both are zero.
    let miss = (&symmetric - &found).amax() / found.amax().max(1.0);
    assert!(miss < LIMIT, "{run}: {miss:e}");
    true
}

/// Bodies are moved to where joints that are there twice fit as to where they fit once: what repeats others leads nowhere else.
#[test]
fn joints_that_are_held_twice_are_closed_as_those_held_once() {
    let mut chance = Chance(47);
    let mut compared = 0;
    for run in 0..400 {
        let mut mechanism = Mechanism::random(&mut chance);
        if mechanism.is_driven() || mechanism.joints.is_empty() {
            continue;
        }
        compared += 1;
        mechanism.gears.clear();
        let count = 6 * mechanism.bodies.len();
        let twists = DVector::from_fn(count, |_, _| 0.1 * chance.number());
        mechanism.bodies = mechanism.twisted(&twists, 1.0);
        let described = mechanism.nodes(|body| (body.center, body.axes));
        let still = vec![[[0.0; 3]; 2]; described.len()];
        let mut placed = || {
            let system = System::new(mechanism.parts()).expect("a system");
            let mut work = Workspace::new(&system);
            let state = system.initial_state(0.0, &[], (&described, &still), &mut work);
            let state = state.unwrap_or_else(|error| panic!("{run}: {error:?}"));
            let x = system.nodes_of(&state, &mut work);
            mechanism.joints.extend(mechanism.joints.clone());
            x
        };
        let [once, twice] = [placed(), placed()];
        let mut miss = 0.0_f64;
        for (once, twice) in once.as_flattened().iter().zip(twice.as_flattened()) {
            miss = miss.max((V::from(*once) - V::from(*twice)).norm());
        }
        assert!(miss < 1e-6, "{run}: {miss:e} m apart");
    }
    assert!(compared > 200, "{compared}");
}

//! Back to the constraints by the shortest way, and initial configurations.

use flexbody::bodies::Node;
use flexbody::system::{DrivenSystem, NotAssembled};
use nalgebra::{Rotation2, Vector2};
use proptest::prelude::*;

use crate::laws::built::{Moving, moving};
use crate::laws::chain::{expand, project};
use crate::laws::differences::{Outcome, check, within};
use crate::laws::mechanism::{At, Body, Hold, Kind, Mechanism, Place, Point};
use crate::laws::random::{ALL, mechanisms};

const CASES: u32 = 200;

/// A small nodal field as coordinates.
fn small(mechanism: &Mechanism, moving: &Moving, from: usize, size: f64) -> Vec<f64> {
    let numbers = mechanism.random(4 * mechanism.nodes.len(), from);
    let nodes: Vec<Node> = (numbers.chunks_exact(4))
        .map(|x| [[size * x[0], size * x[1]], [size * x[2], size * x[3]]])
        .collect();
    project(&moving.system, &nodes)
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn size(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn shortest(mechanism: &Mechanism) -> Outcome {
    let Some(mut moving) = moving(mechanism, 0.03)? else {
        return Ok(());
    };
    if moving.system.constraints() == 0 {
        return Ok(());
    }
    let values = moving.evaluated();
    let x = mechanism.apart(&values.x);
    let (dq, dv) = (
        small(mechanism, &moving, 3, 1e-5),
        small(mechanism, &moving, 41, 1.0),
    );
    let mut state = moving.state.clone();
    state.rates.iter_mut().zip(&dv).for_each(|(v, d)| *v += d);
    let disturbed = state.rates.clone();
    let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &state);
    prop_assert!(model.project(&mut state));
    let change = difference(&state.rates, &disturbed);
    let rank = 1e-4;
    if size(&change) > 1e-6 * size(&dv) {
        let whole = mechanism.apart(&expand(&moving.system, &change));
        within(
            "way of rates",
            mechanism.needless(0.0, &x, &whole),
            1e-8 / rank,
        )?;
    }
    // Positions: the way is straight up to the square of its length.
    state.copy_from(&moving.state);
    state
        .coordinates
        .iter_mut()
        .zip(&dq)
        .for_each(|(q, d)| *q += d);
    let disturbed = state.coordinates.clone();
    let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &state);
    prop_assert!(model.project(&mut state));
    let change = difference(&state.coordinates, &disturbed);
    if size(&change) > 1e-2 * size(&dq) {
        let whole = mechanism.apart(&expand(&moving.system, &change));
        within(
            "way of positions",
            mechanism.needless(0.0, &x, &whole),
            1e-2,
        )?;
    }
    moving.state = state;
    let values = moving.evaluated();
    let [position, velocity] = values.residuals(&moving.system);
    within("residual of positions", position, 1e-12)?;
    within("residual of rates", velocity, 1e-10)?;
    let missing = mechanism.missing(0.0, &mechanism.apart(&values.x)).amax();
    within("positions", missing, 1e-12)?;
    // What is on the constraints stays where it is.
    let before = moving.state.clone();
    let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &before);
    prop_assert!(model.project(&mut moving.state));
    let moved = difference(&moving.state.coordinates, &before.coordinates);
    within("twice", size(&moved) / moving.system.scale(), 1e-14)
}

#[test]
fn states_come_back_to_the_constraints_by_the_shortest_way() {
    check(CASES, mechanisms(ALL), |mechanism| shortest(&mechanism));
}

/// Every body moved as a whole by a random way.
fn scattered(mechanism: &Mechanism, size: f64) -> Vec<Node> {
    let mut nodes = mechanism.nodes.clone();
    for (b, body) in mechanism.bodies.iter().enumerate() {
        let number = |k: usize| size * mechanism.noise[(17 + 3 * b + k) % mechanism.noise.len()];
        let (way, mut turn) = (
            Vector2::new(number(0), number(1)),
            Rotation2::new(number(2)),
        );
        if let Body::Particle { .. } = body {
            turn = Rotation2::identity();
        }
        let first = mechanism.firsts[b];
        let about = Vector2::from(nodes[first][0]);
        for node in &mut nodes[first..first + body.sizes()[0]] {
            let p = about + way + turn * (Vector2::from(node[0]) - about);
            let d = turn * Vector2::from(node[1]);
            *node = [p.into(), d.into()];
        }
    }
    nodes
}

fn assembled(mechanism: &Mechanism) -> Outcome {
    let Ok(system) = mechanism.system() else {
        return Ok(());
    };
    let mut work = flexbody::system::Workspace::new(&system);
    let described = (
        &scattered(mechanism, 0.1)[..],
        &mechanism.rigid_rates(5)[..],
    );
    let started = system.initial_state(0.0, &[], described, &mut work);
    let state = started.map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let mut moving = Moving {
        system,
        state,
        work,
    };
    let values = moving.evaluated();
    let x = mechanism.apart(&values.x);
    within("positions", mechanism.missing(0.0, &x).amax(), 1e-9)?;
    if mechanism.contradiction(0.0, &x) > 1e-6 {
        return Ok(());
    }
    let rates = mechanism.missing_rates(0.0, &x, &mechanism.apart(&values.v));
    within("rates", rates.amax(), 1e-7)?;
    // Bodies are moved, never strained: energy goes with the square of strain.
    within("strain energy", values.strain_energy(&moving.system), 1e-12)
}

#[test]
fn bodies_are_moved_as_wholes_until_joints_fit() {
    check(CASES, mechanisms(ALL), |mechanism| assembled(&mechanism));
}

/// Two rods of length 1 on pins 3 apart, with a link of 0.5 between their ends.
#[test]
fn what_cannot_fit_is_named_with_its_gap() {
    let rod = |x: f64, angle: f64| [[x, 0.0], [angle.cos(), angle.sin()]];
    let end = |body: usize, x: f64| {
        let at = At::Point([x, 0.0]);
        Point::On(Place { body, at })
    };
    let pin = |x: f64, body: usize| Hold {
        kind: Kind::Revolute,
        ends: [Point::Ground(Vector2::new(x, 0.0)), end(body, -0.5)],
    };
    let rigid = Body::Rigid {
        mass: 1.0,
        inertia: 0.1,
    };
    let link = Hold {
        kind: Kind::Distance(0.5),
        ends: [end(0, 0.5), end(1, 0.5)],
    };
    let mechanism = Mechanism {
        bodies: vec![rigid.clone(), rigid],
        firsts: vec![0, 1],
        nodes: vec![rod(0.0, 0.3), rod(3.0, 2.5)],
        holds: vec![pin(0.0, 0), pin(3.0, 1), link],
        loads: Vec::new(),
        lumped_masses: Vec::new(),
        gravity: Vector2::zeros(),
        rotation: 0.0,
        noise: vec![0.0],
    };
    let system = mechanism.system().expect("a system");
    let Err(NotAssembled { gaps }) = mechanism.started(system) else {
        panic!("it fits together");
    };
    // What is missing of 3 = 1 + 0.5 + 1 is spread over the joints, most of it over the link.
    let worst = gaps.iter().max_by(|a, b| a.size.total_cmp(&b.size));
    assert_eq!(worst.map(|gap| gap.joint), Some(2), "{gaps:?}");
    let missing: f64 = gaps.iter().map(|gap| gap.size).sum();
    assert!((missing - 0.5).abs() < 0.05, "{gaps:?}");
}

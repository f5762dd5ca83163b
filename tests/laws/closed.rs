//! Mechanisms with known answers: natural frequencies, what is held twice, parts that know nothing of each
//! other.

use flexbody::bodies::Node;
use flexbody::elements::StrainMeasure;
use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::integrators::{OneStepMethod, RK4, Radau, RungeKutta, StateView, Tolerance, advance};
use flexbody::system::{DrivenSystem, HoldingParts, fastest, natural_frequencies};
use nalgebra::Vector2;
use proptest::prelude::*;

use crate::laws::built::{Moving, moving};
use crate::laws::differences::{check, within};
use crate::laws::mechanism::{Acting, At, Body, Hold, Kind, Mechanism, Place, Point, Wave};
use crate::laws::random::{ALL, Scope, mechanisms};

const G: f64 = 9.81;

/// A number that does not change.
pub fn still(constant: f64) -> Wave {
    Wave {
        constant,
        amplitude: 0.0,
        frequency: 1.0,
    }
}

/// A point of a rigid body.
pub fn on(body: usize, x: f64, y: f64) -> Point {
    let at = At::Point([x, y]);
    Point::On(Place { body, at })
}

/// A point of the ground.
pub fn ground(x: f64, y: f64) -> Point {
    Point::Ground(Vector2::new(x, y))
}

/// Bodies of one node each at positions and angles, otherwise nothing.
pub fn bodies(parts: &[(Body, [f64; 3])]) -> Mechanism {
    let node = |(_, [x, y, angle]): &(Body, [f64; 3])| [[*x, *y], [angle.cos(), angle.sin()]];
    Mechanism {
        bodies: parts.iter().map(|(body, _)| body.clone()).collect(),
        firsts: (0..parts.len()).collect(),
        nodes: parts.iter().map(node).collect(),
        holds: Vec::new(),
        loads: Vec::new(),
        lumped_masses: Vec::new(),
        gravity: Vector2::new(0.0, -G),
        rotation: 0.0,
        noise: vec![0.0],
    }
}

/// A rigid body.
pub fn rigid(mass: f64, inertia: f64) -> Body {
    Body::Rigid { mass, inertia }
}

/// A joint or motion.
pub fn hold(kind: Kind, first: Point, second: Point) -> Hold {
    Hold {
        kind,
        ends: [first, second],
    }
}

/// The system of a mechanism as it starts.
pub fn started(mechanism: &Mechanism) -> Moving {
    let system = mechanism.system().expect("a system");
    mechanism.started(system).expect("a state")
}

fn frequencies(mechanism: &Mechanism, count: usize) -> Vec<f64> {
    let Moving {
        system,
        mut state,
        mut work,
    } = started(mechanism);
    state.rates.fill(0.0);
    natural_frequencies(&system, &[], &mut work, &state, count).expect("frequencies")
}

fn near(found: &[f64], exact: &[f64]) {
    for (found, exact) in found.iter().zip(exact) {
        let off = (found - exact).abs();
        assert!(
            off < 1e-7 * (1.0 + exact.abs()),
            "{found} instead of {exact}"
        );
    }
}

#[test]
fn a_rigid_pendulum_swings_with_its_frequency() {
    let (m, j, d) = (1.7, 0.23, 0.6);
    let mut pendulum = bodies(&[(rigid(m, j), [0.0, -d, 0.4])]);
    let back = nalgebra::Rotation2::new(-0.4) * Vector2::new(0.0, d);
    let pin = on(0, back.x, back.y);
    pendulum
        .holds
        .push(hold(Kind::Revolute, ground(0.0, 0.0), pin));
    let exact = (m * G * d / (j + m * d * d)).sqrt();
    near(&frequencies(&pendulum, 1), &[exact]);
    // Upside down it falls: a growing motion counts as negative.
    pendulum.gravity *= -1.0;
    near(&frequencies(&pendulum, 1), &[-exact]);
    // A hinge adds its stiffness, relative to the frame that it rotates in.
    pendulum.gravity *= -1.0;
    pendulum.holds[0].kind = Kind::Hinge([3.0, 0.0, 0.4]);
    near(
        &frequencies(&pendulum, 1),
        &[((m * G * d + 3.0) / (j + m * d * d)).sqrt()],
    );
}

#[test]
fn a_mass_on_a_link_swings_with_its_frequency() {
    let mut mass = bodies(&[(Body::Particle { mass: 2.0 }, [0.3, -0.7, 0.0])]);
    let link = hold(Kind::Distance(0.7), ground(0.3, 0.0), on(0, 0.0, 0.0));
    mass.holds.push(link);
    near(&frequencies(&mass, 1), &[(G / 0.7_f64).sqrt()]);
}

/// A point mass on an isotropic suspension in a rotating frame: `w0 +- rotation`, as seen from the frame.
#[test]
fn a_spinning_frame_splits_a_frequency_in_two() {
    let (m, k, rotation) = (2.0, 50.0, 1.3);
    let mut mass = bodies(&[(Body::Particle { mass: m }, [0.0, 0.0, 0.0])]);
    mass.gravity *= 0.0;
    mass.rotation = rotation;
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        mass.loads.push(Acting::Spring {
            ends: [ground(x, y), on(0, 0.0, 0.0)],
            stiffness: 0.5 * k,
            damping: 0.0,
            length: still(1.0),
        });
    }
    let w = f64::sqrt(k / m);
    near(&frequencies(&mass, 2), &[w - rotation, w + rotation]);
    mass.rotation = 0.0;
    near(&frequencies(&mass, 2), &[w, w]);
}

/// The largest natural frequency is what an explicit method must resolve.
#[test]
fn the_fastest_oscillation_is_bounded_closely() {
    let scope = Scope {
        extras: 1,
        followers: false,
        rotates: false,
        ..ALL
    };
    check(150, mechanisms(scope), |mechanism| {
        let Some(mut moving) = moving(&mechanism, 0.02)? else {
            return Ok(());
        };
        if moving.system.constraints() > 0 {
            return Ok(());
        }
        moving.state.rates.fill(0.0);
        let Moving {
            system,
            state,
            mut work,
        } = moving;
        let all = natural_frequencies(&system, &[], &mut work, &state, system.coordinates());
        let all = all.expect("frequencies");
        let largest = all.iter().fold(0.0_f64, |m, w| m.max(*w));
        let (bound, decay) = fastest(&system, &[], &mut work, &state);
        if largest > 0.0 {
            let ratio = bound / largest;
            prop_assert!((0.98..1.1).contains(&ratio), "{bound} over {largest}");
        }
        prop_assert!(decay >= 0.0);
        Ok(())
    });
}

/// Equal cranks under one bar, of the mass and inertia of three: but for two they hold nothing.
fn parallelogram(cranks: usize) -> Mechanism {
    let part = 3.0 / cranks as f64;
    let crank = |x: f64| {
        let place = [x, 0.25, 0.5 * std::f64::consts::PI];
        (rigid(0.5 * part, 0.04 * part), place)
    };
    let places: Vec<f64> = match cranks {
        ..=3 => [0.0, 1.0, 0.4][..cranks].to_vec(),
        _ => (0..cranks)
            .map(|k| k as f64 / (cranks - 1) as f64)
            .collect(),
    };
    let mut parts: Vec<_> = places.iter().map(|x| crank(*x)).collect();
    parts.push((rigid(1.0, 0.1), [0.5, 0.5, 0.0]));
    let mut made = bodies(&parts);
    for (k, x) in places.iter().enumerate() {
        made.holds
            .push(hold(Kind::Revolute, ground(*x, 0.0), on(k, -0.25, 0.0)));
        made.holds.push(hold(
            Kind::Revolute,
            on(k, 0.25, 0.0),
            on(cranks, x - 0.5, 0.0),
        ));
    }
    made
}

#[test]
fn more_cranks_than_two_change_nothing() {
    let ends = [2, 3, 12].map(|cranks| {
        let mut mechanism = parallelogram(cranks);
        mechanism.gravity = Vector2::new(3.0, -G);
        let mut moving = started(&mechanism);
        moving.state.rates.fill(0.0);
        let mut method = Radau::new(moving.system.coordinates());
        let tolerance = Tolerance {
            relative: 1e-9,
            position: moving.system.scale(),
            time: 0.3,
        };
        let mut state = moving.state.clone();
        let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &state);
        let (_, result) = advance(&mut method, &mut model, &mut state, 1.0, &tolerance);
        assert_eq!(result, Ok(()));
        moving.state = state;
        let values = moving.evaluated();
        let residuals = values.residuals(&moving.system);
        assert!(residuals[0] < 1e-12, "{residuals:?}");
        let bar = values.x[values.x.len() - 1];
        assert!(
            (bar[1][0] - 1.0).abs() < 1e-7 && bar[1][1].abs() < 1e-7,
            "the bar turns: {bar:?}"
        );
        bar
    });
    for more in &ends[1..] {
        for (more, two) in more.as_flattened().iter().zip(ends[0].as_flattened()) {
            assert!((more - two).abs() < 1e-6, "{more} and {two}");
        }
    }
    // It is told: one body need not be rigid for all to be held; where there are many, that or a pin.
    for (cranks, spare) in [(3, 1), (2, 0)] {
        let mut moving = started(&parallelogram(cranks));
        let held = (moving.system).redundant_at(&moving.state, &mut moving.work);
        let HoldingParts { holders, bodies } = held.exactly;
        assert_eq!((holders.len(), bodies.len()), (0, spare), "{cranks} cranks");
        assert_eq!(held.nearly, HoldingParts::default());
    }
    let mut moving = started(&parallelogram(12));
    let held = (moving.system).redundant_at(&moving.state, &mut moving.work);
    let HoldingParts { holders, bodies } = held.exactly;
    assert!(
        (1..=10).contains(&(holders.len() + bodies.len())),
        "{holders:?} {bodies:?}"
    );
    assert_eq!(held.nearly, HoldingParts::default());
}

#[test]
fn what_is_held_twice_is_held_once() {
    let scope = Scope { extras: 0, ..ALL };
    check(100, mechanisms(scope), |mechanism| {
        let Some(mut once) = moving(&mechanism, 0.03)? else {
            return Ok(());
        };
        let mut again = mechanism.clone();
        let still = |hold: &&Hold| {
            matches!(
                hold.kind,
                Kind::Revolute | Kind::Weld(_) | Kind::Distance(_) | Kind::Orientation(_)
            )
        };
        let Some(hold) = mechanism.holds.iter().rfind(still) else {
            return Ok(());
        };
        again.holds.push(*hold);
        let Some(mut twice) = moving(&again, 0.0)? else {
            return Err(TestCaseError::fail("what is held twice cannot move"));
        };
        twice.state.coordinates.clone_from(&once.state.coordinates);
        twice.state.rates.clone_from(&once.state.rates);
        twice.state.angles.clone_from(&once.state.angles);
        twice.state.travel.clone_from(&once.state.travel);
        let [a, b] = [once.evaluated(), twice.evaluated()].map(|v| again.apart(&v.acceleration));
        within("acceleration", (&a - &b).amax() / (1.0 + a.amax()), 1e-9)?;
        // It is reported: the later one, where it is linear.
        if matches!(hold.kind, Kind::Revolute) {
            prop_assert!(twice.system.redundant().contains(&(again.holds.len() - 1)));
        }
        Ok(())
    });
}

/// A rigid pendulum and a hanging cable, each alone and both together.
#[test]
fn parts_without_connection_do_not_know_of_each_other() {
    let swing = |x: f64| {
        let mut made = bodies(&[(rigid(1.3, 0.2), [x + 0.4, 0.0, 0.0])]);
        made.holds
            .push(hold(Kind::Revolute, ground(x, 0.0), on(0, -0.4, 0.0)));
        made
    };
    let cable = || {
        let parameters = Parameters {
            inertia: Inertia::Corrected,
            length: 0.5,
            axial_stiffness: 200.0,
            bending_stiffness: 0.5,
            line_of: flexbody::elements::cable::LineOf::Cable,
            line_density: 1.0,
            axial_damping_time: 0.001,
            bending_damping_time: 0.001,
            strain: StrainMeasure::ThetaPrime,
        };
        let mut made = bodies(&[]);
        made.bodies
            .push(Body::Cable(vec![Cable::new(parameters, None); 2]));
        made.firsts.push(0);
        made.nodes = [0.0, 0.5, 1.0].map(|x| [[x, 0.0], [1.0, 0.0]]).to_vec();
        let root = Point::On(Place {
            body: 0,
            at: At::Part(0.0),
        });
        made.holds
            .push(hold(Kind::Revolute, ground(0.0, 0.0), root));
        made
    };
    let both = |first: Mechanism, second: Mechanism| {
        let mut made = first;
        let (bodies, nodes) = (made.bodies.len(), made.nodes.len());
        made.bodies.extend(second.bodies);
        made.firsts
            .extend(second.firsts.iter().map(|first| first + nodes));
        made.nodes.extend(second.nodes);
        for mut hold in second.holds {
            for end in &mut hold.ends {
                if let Point::On(place) = end {
                    place.body += bodies;
                }
            }
            made.holds.push(hold);
        }
        made
    };
    let apart = [run(&swing(0.0)), run(&cable())];
    let together = run(&both(swing(0.0), cable()));
    for (alone, together) in apart.iter().flatten().zip(&together) {
        for (a, b) in alone.as_flattened().iter().zip(together.as_flattened()) {
            assert!((a - b).abs() < 1e-12, "{alone:?}, {together:?}");
        }
    }
    let reversed = run(&both(cable(), swing(0.0)));
    assert_eq!(reversed.len(), together.len());
    for (one, other) in reversed[3..].iter().zip(&together[..1]) {
        for (a, b) in one.as_flattened().iter().zip(other.as_flattened()) {
            assert!((a - b).abs() < 1e-12, "{one:?}, {other:?}");
        }
    }
}

/// Nodal coordinates after steps of equal length of the explicit method.
fn run(mechanism: &Mechanism) -> Vec<Node> {
    let mut moving = started(mechanism);
    let mut state = moving.state.clone();
    let tolerance = Tolerance {
        relative: 1e-3,
        position: 1.0,
        time: 1.0,
    };
    let mut method = RungeKutta::new(&RK4, moving.system.coordinates(), 1.0, 0.0);
    let h = 5e-4;
    for step in 0..400 {
        let time = h * f64::from(step);
        state.time = time;
        let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &state);
        method.begin(&mut model, time, &state.coordinates, &state.rates);
        method.attempt(&mut model, StateView::of(&state), h, &tolerance);
        method.accept(&mut state.coordinates, &mut state.rates);
        assert!(model.project(&mut state));
    }
    moving.state = state;
    moving.evaluated().x
}

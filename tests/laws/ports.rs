//! Forces and moments that come in at markers of rigid bodies of space: what moves by them, against dense equations of every
//! body by itself; orientations that bodies are pulled towards; quaternions that go on over full turns.

use flexbody::bodies::Marker;
use flexbody::integrators::{RK4, RungeKutta, Tolerance, advance};
use flexbody::math::function::Function;
use flexbody::math::rotation;
use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use flexbody::system::loads::{
    AppliedLoad, Bushing, BushingMeasure, Force, FromOrientation, SpatialMoment,
};
use flexbody::system::{
    Attachment, Derivatives, Direction, DrivenSystem, Evaluation, Parts, Signal, State, System,
    Workspace,
};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3};

use crate::laws::chance::Chance;
use crate::laws::least::{is_near_singular, least};
use crate::laws::linkage::{Mechanism, V};
use crate::laws::rigid::stiffness_is_the_derivative;

/// Where a force and a moment come in: a body and a point of it.
type Place = (usize, V);

fn axis(k: usize) -> V {
    V::ith(k, 1.0)
}

fn marker((body, at): Place, direction: V) -> Marker {
    Marker::framed(body, 2 * body, at.into(), direction.into())
}

/// Force and moment of six inputs at each place.
fn ported(mut parts: Parts<3>, places: &[Place]) -> Parts<3> {
    for (port, place) in places.iter().enumerate() {
        let signal = |k: usize| Signal::Input(6 * port + k);
        let at = marker(*place, axis(0));
        parts.loads.push(AppliedLoad::Force(Force {
            marker: at,
            follower: false,
            components: [0, 1, 2].map(signal),
            axes: [0, 1, 2].map(|k| marker(*place, axis(k))),
        }));
        parts.loads.push(AppliedLoad::SpatialMoment(SpatialMoment {
            ends: [Attachment::Ground(V::zeros()), Attachment::Body(at)],
            is_torque: false,
            parts: (0..3)
                .map(|k| (signal(3 + k), Direction::Fixed(axis(k))))
                .collect(),
        }));
    }
    parts
}

/// Acceleration and angular acceleration at every place.
fn read(values: &Evaluation<3>, system: &System<3>, places: &[Place]) -> DVector<f64> {
    let numbers = places.iter().flat_map(|place| {
        let at = marker(*place, axis(0));
        let a: [f64; 3] = at.position(&values.acceleration).into();
        a.into_iter().chain(values.spin_rate(system, &at))
    });
    DVector::from_vec(numbers.collect())
}

/// How motions at places follow from twists: `v + w x r`, `w`.
fn carried(mechanism: &Mechanism, places: &[Place]) -> DMatrix<f64> {
    let mut carried = DMatrix::zeros(6 * places.len(), 6 * mechanism.bodies.len());
    for (port, (body, at)) in places.iter().enumerate() {
        let arm = mechanism.bodies[*body].axes * at;
        let one = Matrix3::identity();
        let mut set = |row: usize, column: usize, block: Matrix3<f64>| {
            let corner = (6 * port + row, 6 * body + column);
            carried.view_mut(corner, (3, 3)).copy_from(&block);
        };
        set(0, 0, one);
        set(0, 3, -arm.cross_matrix());
        set(3, 3, one);
    }
    carried
}

/// `S (M^-1 - L (J L)^+ J L L^T) S^T` of all bodies by themselves with `M^-1 = L L^T`, and the size of `M^-1`.
fn mobility(mechanism: &Mechanism, places: &[Place]) -> (DMatrix<f64>, f64) {
    let n = 6 * mechanism.bodies.len();
    let mut inverse = DMatrix::zeros(n, n);
    for (i, body) in mechanism.bodies.iter().enumerate() {
        let moments = body.moments.map(|moment| 1.0 / moment);
        let tensor = body.axes * Matrix3::from_diagonal(&moments) * body.axes.transpose();
        let light = Matrix3::identity() / body.mass;
        inverse.view_mut((6 * i, 6 * i), (3, 3)).copy_from(&light);
        let corner = (6 * i + 3, 6 * i + 3);
        inverse.view_mut(corner, (3, 3)).copy_from(&tensor);
    }
    let size = inverse.amax();
    if !mechanism.joints.is_empty() {
        // As in `Mechanism::accelerations`, in coordinates of unit mass.
        let root = inverse.clone().cholesky().expect("positive").unpack();
        let rows = mechanism.jacobian() * &root;
        let mut free = root.transpose();
        for mut column in free.column_iter_mut() {
            let held = least(&rows, &(&rows * &column));
            column -= held;
        }
        inverse = root * free;
    }
    let carried = carried(mechanism, places);
    (&carried * inverse * carried.transpose(), size)
}

#[test]
fn motions_follow_forces_and_moments_by_the_mobility() {
    let (mut all, mut compared, mut free) = (0, 0, 0);
    for mut chance in Chance::several(23) {
        for run in 0..150 {
            let mechanism = Mechanism::random(&mut chance);
            let count = mechanism.bodies.len();
            let places = [0; 2].map(|_| (chance.below(count), chance.vector()));
            let system = System::new(ported(mechanism.parts(), &places)).expect("a system");
            let (state, mut work) = mechanism.state_of(&system);
            let inputs: Vec<f64> = (0..12).map(|_| 5.0 * chance.number()).collect();
            all += 1;
            if is_near_singular(&system, &state, &mut work) {
                continue;
            }
            compared += 1;
            free += usize::from(mechanism.joints.is_empty());
            let moving = (&system, &state, &mut work);
            mobility_fits(run, (&mechanism, &places), moving, &inputs);
        }
    }
    assert!(compared * 20 > all * 19, "{compared} of {all}");
    assert!(free * 50 > all, "{free} free ones of {all}");
}

fn mobility_fits(
    run: usize,
    (mechanism, places): (&Mechanism, &[Place]),
    (system, state, work): (&System<3>, &State, &mut Workspace<3>),
    inputs: &[f64],
) {
    let mut plain = Evaluation::new(system);
    let mut at = |inputs: &[f64], work: &mut Workspace<3>| {
        plain.kinematics(system, state, work);
        plain.dynamics(system, state, inputs, work);
        (read(&plain, system, places), plain.clone())
    };
    let (before, _) = at(inputs, work);
    let (wanted, size) = mobility(mechanism, places);
    let mut columns = Vec::new();
    for k in 0..12 {
        // Motions are linear in what acts: a difference has no error but rounding.
        let mut more = inputs.to_vec();
        more[k] += 1.0;
        let (after, _) = at(&more, work);
        let (_, values) = at(inputs, work);
        let mut direction = vec![0.0; 12];
        direction[k] = 1.0;
        let mut made = Derivatives::new(system);
        made.by_inputs(system, &values, &direction, work);
        let column = places.iter().flat_map(|place| {
            let at = marker(*place, axis(0));
            let a: [_; 3] = at.lift().position(&made.values.acceleration).into();
            let turning = made.values.spin_rate(system, &at);
            a.into_iter().chain(turning).map(|number| number.v1)
        });
        let column = DVector::from_vec(column.collect());
        let miss = (&after - &before - &column).amax();
        let size = size + before.amax();
        assert!(miss < 1e-11 * size, "{run}: {miss:e} of {size:e}");
        columns.push(column);
    }
    let found = DMatrix::from_columns(&columns);
    let skew = (&found - found.transpose()).amax();
    assert!(skew < 1e-11 * size, "{run}: {skew:e}");
    let least = found.clone().symmetric_eigenvalues().min();
    assert!(least > -1e-11 * size, "{run}: {least:e}");
    let miss = (&found - &wanted).amax() / size;
    // Joints are differentiated numerically; a free body has none.
    let within = if mechanism.joints.is_empty() {
        1e-12
    } else {
        1e-6
    };
    assert!(miss < within, "{run}: {miss:e}");
}

fn held(value: f64) -> Signal {
    Signal::Function(Function::constant(value))
}

/// Pulls a body towards an orientation.
fn pulled(body: usize, towards: Rotation3<f64>, stiffness: f64) -> AppliedLoad<3> {
    let columns = [0, 1, 2].map(|k| towards.matrix().column(k).into_owned());
    let q = rotation::quaternion(&columns);
    AppliedLoad::Bushing(Box::new(Bushing {
        measure: BushingMeasure::Orientation(FromOrientation {
            axes: [0, 1, 2].map(|k| marker((body, V::zeros()), axis(k))),
            // Of any length and either sign.
            quaternion: q.map(|part| held(-1.7 * part)),
            velocity: [0.0; 3].map(held),
        }),
        stiffness: [[0.0; 3], [stiffness; 3]],
        damping: [[0.0; 3]; 2],
    }))
}

#[test]
fn the_stiffness_towards_an_orientation_is_the_derivative_of_its_moment() {
    let (mut chance, mut compared) = (Chance(29), 0);
    for run in 0..40 {
        let mut mechanism = Mechanism::random(&mut chance);
        if mechanism.is_driven() {
            continue;
        }
        mechanism.bodies.iter_mut().for_each(|body| {
            (body.velocity, body.spin) = (V::zeros(), V::zeros());
        });
        let mut parts = mechanism.parts();
        for (i, body) in mechanism.bodies.iter().enumerate() {
            let turn = chance.vector() * [1e-8, 0.3, 1.5][run % 3];
            let axes = Rotation3::from_matrix_unchecked(body.axes);
            parts
                .loads
                .push(pulled(i, Rotation3::new(turn) * axes, 40.0));
        }
        compared += usize::from(stiffness_is_the_derivative(run, &mechanism, parts));
    }
    assert!(compared > 25, "{compared}");
}

#[test]
fn what_pulls_towards_an_orientation_conserves_energy() {
    let mut chance = Chance(31);
    for run in 0..20 {
        let mechanism = Mechanism::random(&mut chance);
        if mechanism.is_driven() {
            continue;
        }
        let mut parts = mechanism.parts();
        for (i, body) in mechanism.bodies.iter().enumerate() {
            // No further than what rotates by less than half a turn.
            let axes = Rotation3::from_matrix_unchecked(body.axes);
            let turned = Rotation3::new(chance.vector() * 0.3) * axes;
            parts.loads.push(pulled(i, turned, 60.0));
        }
        let system = System::new(parts).expect("a system");
        let (mut state, mut work) = mechanism.state_of(&system);
        let energy = |state: &_, work: &mut Workspace<3>| {
            let mut values = Evaluation::new(&system);
            values.kinematics(&system, state, work);
            [
                values.kinetic_energy(&system) + values.gravity_energy(&system),
                values.spring_energy(&system),
            ]
        };
        let before = energy(&state, &mut work);
        let tolerance = Tolerance {
            relative: 1e-10,
            position: system.scale(),
            time: 0.5,
        };
        let mut method = RungeKutta::new(&RK4, system.coordinates(), 1e-9, 1e-9);
        let mut model = DrivenSystem::new(&system, &[], &mut work, &state);
        let (_, result) = advance(&mut method, &mut model, &mut state, 0.3, &tolerance);
        result.expect("a motion");
        let after = energy(&state, &mut work);
        let gained = after[0] + after[1] - before[0] - before[1];
        let size = before[0].abs() + after[1] + 1.0;
        assert!(gained.abs() < 1e-8 * size, "{run}: {gained:e} of {size:e}");
    }
}

/// How a body stands at the start.
const STANDS: V = V::new(2.0, 1.5, -1.0);

/// A free body that rotates at this rate about an axis of its inertia, rad/s.
fn spinning(rate: f64) -> Simulation {
    // About the third axis of the frame.
    let spin: [f64; 3] = (Rotation3::new(STANDS) * axis(2) * rate).into();
    let text = format!(
        r#"{{ "name": "top", "dimension": 3,
             "bodies": [ {{ "name": "top", "element": "rigid", "mass": 1.0,
               "inertia": [[0.5, 0.1, 0.0], [0.1, 0.4, 0.0], [0.0, 0.0, 0.7]],
               "position": [0, 0, 0], "orientation": {{ "rotation_vector": [2.0, 1.5, -1.0] }},
               "motion": {{ "spin": {spin:?} }}, "markers": {{ "c": [0, 0, 0] }} }} ],
             "outputs": [ {{ "kind": "quaternion", "marker": "top.c" }},
               {{ "kind": "rotation_vector", "marker": "top.c" }},
               {{ "kind": "angular_velocity", "marker": "top.c", "axes": "body" }} ],
             "accuracy": {{ "relative_tolerance": 1e-9 }} }}"#
    );
    let scene = Scene::from_json(&text).expect("a valid scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("a state");
    simulation.start().expect("a start");
    simulation
}

fn outputs(simulation: &mut Simulation, name: &str) -> Vec<f64> {
    let variables = simulation.variables().iter().enumerate();
    let found: Vec<usize> = variables
        .filter(|(_, variable)| variable.name.split('[').next() == Some(name))
        .map(|(index, _)| index)
        .collect();
    let real = |index: &usize| simulation.real(*index).expect("an output");
    found.iter().map(real).collect()
}

#[test]
fn quaternions_go_on_over_full_turns_and_go_back_with_states() {
    const RATE: f64 = 5.0;
    let mut simulation = spinning(RATE);
    let start = rotation::quaternion(&[0, 1, 2].map(|k| Rotation3::new(STANDS) * axis(k)));
    let mut saved = Vec::new();
    let mut signs = [0, 0];
    for step in 0..=80 {
        let time = 0.05 * f64::from(step);
        if step > 0 {
            simulation.step(time).expect("a step");
        }
        let (sin, cos) = (0.5 * RATE * time).sin_cos();
        let wanted = rotation::product(&start, &[cos, 0.0, 0.0, sin]);
        let found = outputs(&mut simulation, "top.c.quaternion");
        let miss = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
        let miss = miss.fold(0.0, f64::max);
        assert!(miss < 1e-7, "{time}: {found:?}, {wanted:?}");
        signs[usize::from(found[0] < 0.0)] += 1;
        let vector = outputs(&mut simulation, "top.c.rotation_vector");
        let half = rotation::rotation_vector(&wanted);
        let miss = (V::from_vec(vector) - half).norm();
        assert!(miss < 1e-6, "{time}: {miss:e}");
        let spin = outputs(&mut simulation, "top.c.angular_velocity_body");
        let miss = (V::from_vec(spin) - V::new(0.0, 0.0, RATE)).norm();
        assert!(miss < 1e-7, "{time}: {miss:e}");
        saved.push((simulation.snapshot(), found));
    }
    assert!(signs[0] > 10 && signs[1] > 10, "{signs:?}");
    // Another instance that never made these rotations goes on bit for bit.
    let mut other = spinning(RATE);
    for (k, (snapshot, found)) in saved.iter().enumerate() {
        other.restore(snapshot).expect("a state");
        assert_eq!(&outputs(&mut other, "top.c.quaternion"), found);
        if let Some((_, next)) = saved.get(k + 1) {
            other.step(0.05 * (k as f64 + 1.0)).expect("a step");
            assert_eq!(&outputs(&mut other, "top.c.quaternion"), next);
        }
    }
}

//! Rigid bodies of space in random mechanisms, against Newton's and Euler's equations of every body by itself with
//! multipliers: dense, in global components, joints differentiated numerically along twists.

use flexbody::body::{Frame, Marker, Node};
use flexbody::integrators::{Method, Radau, Rk4, Tolerance, advance};
use flexbody::math::function::Function;
use flexbody::math::jet::Jet;
use flexbody::system::joints::{Across, Direction, Joint, Perpendicular, Primitive};
use flexbody::system::loads::{Load, Spring};
use flexbody::system::{
    Derivatives, Dynamics, End, Evaluation, Model, Parts, Signal, State, System, Work,
};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};

type V = Vector3<f64>;

/// Numbers in (-1, 1), the same in every run.
struct Chance(u64);

impl Chance {
    fn number(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> V {
        V::from_fn(|_, _| self.number())
    }

    fn below(&mut self, count: usize) -> usize {
        ((0.5 + 0.5 * self.number()) * count as f64) as usize % count
    }
}

#[derive(Clone)]
struct Body {
    mass: f64,
    moments: V,
    center: V,
    axes: Matrix3<f64>,
    velocity: V,
    spin: V,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Spherical,
    Revolute,
    Universal,
    Cylindrical,
    Prismatic,
    Planar,
    Weld,
    Distance,
}

const KINDS: [Kind; 8] = [
    Kind::Spherical,
    Kind::Revolute,
    Kind::Universal,
    Kind::Cylindrical,
    Kind::Prismatic,
    Kind::Planar,
    Kind::Weld,
    Kind::Distance,
];

/// A joint: the first body (none is the ground), the second, points and axes fixed in both.
struct Held {
    kind: Kind,
    bodies: [Option<usize>; 2],
    points: [V; 2],
    axes: [Matrix3<f64>; 2],
    length: f64,
}

struct Mechanism {
    bodies: Vec<Body>,
    joints: Vec<Held>,
    gravity: V,
}

impl Body {
    fn point(&self, at: &V) -> V {
        self.center + self.axes * at
    }

    /// The same body moved along twists for a while.
    fn moved(&self, velocity: &V, spin: &V, time: f64) -> Self {
        Self {
            center: self.center + velocity * time,
            axes: Rotation3::new(spin * time) * self.axes,
            ..self.clone()
        }
    }
}

impl Held {
    /// What is missing.
    fn gaps(&self, bodies: &[Body]) -> Vec<f64> {
        let at = |i: usize| match self.bodies[i] {
            Some(body) => (
                bodies[body].point(&self.points[i]),
                bodies[body].axes * self.axes[i],
            ),
            None => (self.points[i], self.axes[i]),
        };
        let ([p, q], [a, b]) = ([at(0).0, at(1).0], [at(0).1, at(1).1]);
        let (way, position) = (q - p, [q[0] - p[0], q[1] - p[1], q[2] - p[2]]);
        let right = |i: usize, j: usize| a.column(i).dot(&b.column(j));
        let across = |i: usize| a.column(i).dot(&way);
        let mut gaps = Vec::new();
        match self.kind {
            Kind::Spherical => gaps.extend(position),
            Kind::Revolute => gaps.extend(position.into_iter().chain([right(0, 2), right(1, 2)])),
            Kind::Universal => gaps.extend(position.into_iter().chain([right(0, 1)])),
            Kind::Cylindrical => gaps.extend([across(0), across(1), right(0, 2), right(1, 2)]),
            Kind::Prismatic => {
                gaps.extend([across(0), across(1), right(0, 2), right(1, 2), right(0, 1)]);
            }
            Kind::Planar => gaps.extend([across(2), right(0, 2), right(1, 2)]),
            Kind::Weld => {
                gaps.extend(
                    position
                        .into_iter()
                        .chain([right(0, 2), right(1, 2), right(0, 1)]),
                );
            }
            Kind::Distance => gaps.push(way.norm_squared() - self.length * self.length),
        }
        gaps
    }
}

impl Mechanism {
    /// A tree of bodies with joints that fit, now and then a joint more; moving as joints allow.
    fn random(chance: &mut Chance) -> Self {
        let count = 1 + chance.below(5);
        let mut made = Self {
            bodies: Vec::new(),
            joints: Vec::new(),
            gravity: chance.vector() * 9.81,
        };
        for body in 0..count {
            let sizes = chance.vector().map(|x| 0.2 + x * x);
            // Three lengths give moments that a body can have; now and then a plate.
            let flat = if chance.below(4) == 0 { 0.0 } else { sizes[2] };
            let moments = V::new(sizes[1] + flat, flat + sizes[0], sizes[0] + sizes[1]) * 0.3;
            made.bodies.push(Body {
                mass: 1.0 + 0.5 * chance.number(),
                moments,
                center: chance.vector() * 2.0,
                axes: Rotation3::new(chance.vector() * 3.0).into_inner(),
                velocity: V::zeros(),
                spin: V::zeros(),
            });
            let first = match body {
                0 if chance.below(3) > 0 => None,
                0 => continue,
                _ => Some(chance.below(body)),
            };
            made.join(first, body, chance);
        }
        if count > 2 && chance.below(2) == 0 {
            let first = chance.below(count - 1);
            made.join(Some(first), count - 1, chance);
        }
        made.start(chance);
        made
    }

    fn join(&mut self, first: Option<usize>, second: usize, chance: &mut Chance) {
        let kind = KINDS[chance.below(KINDS.len())];
        let (place, axes) = (
            chance.vector() * 2.0,
            Rotation3::new(chance.vector() * 3.0).into_inner(),
        );
        let way = match kind {
            Kind::Distance => chance.vector() + V::new(0.0, 0.0, 2.0),
            Kind::Cylindrical | Kind::Prismatic => axes.column(2) * chance.number(),
            Kind::Planar => axes.column(0) * chance.number() + axes.column(1) * chance.number(),
            _ => V::zeros(),
        };
        // A universal joint that is bent.
        let bent = match kind {
            Kind::Universal => Rotation3::new(V::new(0.0, 0.0, chance.number())).into_inner(),
            _ => Matrix3::identity(),
        };
        // What may turn.
        let turned = match kind {
            Kind::Spherical | Kind::Distance => Rotation3::new(chance.vector()).into_inner(),
            Kind::Revolute | Kind::Cylindrical | Kind::Planar => {
                Rotation3::new(V::new(0.0, 0.0, chance.number())).into_inner()
            }
            Kind::Universal => Rotation3::new(V::new(0.0, chance.number(), 0.0)).into_inner(),
            _ => Matrix3::identity(),
        };
        // The universal joint's axes are the first of one body and the second of the other.
        let turned = match kind {
            Kind::Universal => {
                Rotation3::new(V::new(chance.number(), 0.0, 0.0)).into_inner() * turned
            }
            _ => turned,
        };
        let _ = bent;
        let ends = [
            (first, place, axes),
            (Some(second), place + way, axes * turned),
        ];
        let in_body = |(body, place, axes): (Option<usize>, V, Matrix3<f64>)| match body {
            Some(body) => {
                let body = &self.bodies[body];
                let back = body.axes.transpose();
                (back * (place - body.center), back * axes)
            }
            None => (place, axes),
        };
        let [a, b] = ends.map(in_body);
        self.joints.push(Held {
            kind,
            bodies: [first, Some(second)],
            points: [a.0, b.0],
            axes: [a.1, b.1],
            length: way.norm(),
        });
    }

    fn gaps(&self, bodies: &[Body]) -> DVector<f64> {
        DVector::from_vec(
            self.joints
                .iter()
                .flat_map(|joint| joint.gaps(bodies))
                .collect(),
        )
    }

    fn twisted(&self, twists: &DVector<f64>, time: f64) -> Vec<Body> {
        let bodies = self.bodies.iter().enumerate();
        bodies
            .map(|(i, body)| {
                let part = |k: usize| V::from_fn(|j, _| twists[6 * i + k + j]);
                body.moved(&part(0), &part(3), time)
            })
            .collect()
    }

    fn slope(&self, twists: &DVector<f64>, step: f64) -> DVector<f64> {
        let at = |h: f64| self.gaps(&self.twisted(twists, h));
        let by = |h: f64| (at(h) - at(-h)) / (2.0 * h);
        (by(0.5 * step) * 4.0 - by(step)) / 3.0
    }

    fn bend(&self, twists: &DVector<f64>, step: f64) -> DVector<f64> {
        let at = |h: f64| self.gaps(&self.twisted(twists, h));
        let by = |h: f64| (at(h) + at(-h) - at(0.0) * 2.0) / (h * h);
        (by(0.5 * step) * 4.0 - by(step)) / 3.0
    }

    fn jacobian(&self) -> DMatrix<f64> {
        let n = 6 * self.bodies.len();
        let columns: Vec<DVector<f64>> = (0..n)
            .map(|i| {
                let mut unit = DVector::zeros(n);
                unit[i] = 1.0;
                self.slope(&unit, 1e-2)
            })
            .collect();
        DMatrix::from_columns(&columns)
    }

    fn twists(&self) -> DVector<f64> {
        let parts = self.bodies.iter().flat_map(|body| {
            let (v, w) = (body.velocity, body.spin);
            [v[0], v[1], v[2], w[0], w[1], w[2]]
        });
        DVector::from_vec(parts.collect())
    }

    /// Random velocities without the part that joints do not allow.
    fn start(&mut self, chance: &mut Chance) {
        let n = 6 * self.bodies.len();
        let mut twists = DVector::from_fn(n, |_, _| 2.0 * chance.number());
        if !self.joints.is_empty() {
            let svd = self.jacobian().svd(true, true);
            let along = svd.v_t.expect("asked for");
            for (row, size) in along.row_iter().zip(svd.singular_values.iter()) {
                if *size > 1e-7 {
                    let row = row.transpose();
                    twists -= &row * row.dot(&twists);
                }
            }
        }
        for (i, body) in self.bodies.iter_mut().enumerate() {
            body.velocity = V::from_fn(|j, _| twists[6 * i + j]);
            body.spin = V::from_fn(|j, _| twists[6 * i + 3 + j]);
        }
    }

    /// Accelerations and angular accelerations of all bodies.
    fn accelerations(&self) -> DVector<f64> {
        let n = 6 * self.bodies.len();
        let (mut mass, mut force) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for (i, body) in self.bodies.iter().enumerate() {
            let inertia = body.axes * Matrix3::from_diagonal(&body.moments) * body.axes.transpose();
            for j in 0..3 {
                mass[(6 * i + j, 6 * i + j)] = body.mass;
                force[6 * i + j] = body.mass * self.gravity[j];
            }
            mass.view_mut((6 * i + 3, 6 * i + 3), (3, 3))
                .copy_from(&inertia);
            let gyroscopic = body.spin.cross(&(inertia * body.spin));
            force.rows_mut(6 * i + 3, 3).copy_from(&-gyroscopic);
        }
        let inverse = mass.clone().cholesky().expect("positive").inverse();
        let free = &inverse * force;
        if self.joints.is_empty() {
            return free;
        }
        let jacobian = self.jacobian();
        let missing = -self.bend(&self.twists(), 1e-2) - &jacobian * &free;
        let schur = &jacobian * &inverse * jacobian.transpose();
        let multipliers = schur
            .svd(true, true)
            .solve(&missing, 1e-7)
            .expect("a solution");
        free + inverse * jacobian.transpose() * multipliers
    }

    fn end(&self, joint: &Held, i: usize, axis: usize) -> End<3> {
        match joint.bodies[i] {
            Some(body) => End::Body(Marker::framed(
                body,
                2 * body,
                joint.points[i].into(),
                joint.axes[i].column(axis).into_owned().into(),
            )),
            None => End::Ground(joint.points[i]),
        }
    }

    fn direction(&self, joint: &Held, i: usize, axis: usize) -> Direction<3> {
        match self.end(joint, i, axis) {
            End::Body(marker) => Direction::Of(marker),
            End::Ground(_) => Direction::Fixed(joint.axes[i].column(axis).into_owned()),
        }
    }

    fn joint(&self, joint: &Held) -> Joint<3> {
        let ends = [self.end(joint, 0, 0), self.end(joint, 1, 0)];
        let right = |i: usize, j: usize| {
            Primitive::Perpendicular(Perpendicular {
                direction: self.direction(joint, 0, i),
                across: Across::Direction(self.direction(joint, 1, j)),
            })
        };
        let across = |i: usize| {
            Primitive::Perpendicular(Perpendicular {
                direction: self.direction(joint, 0, i),
                across: Across::Way([self.end(joint, 0, i), ends[1]], 1.0),
            })
        };
        let position = Primitive::Coincident;
        let holds = match joint.kind {
            Kind::Spherical => vec![position],
            Kind::Revolute => vec![position, right(0, 2), right(1, 2)],
            Kind::Universal => vec![position, right(0, 1)],
            Kind::Cylindrical => vec![across(0), across(1), right(0, 2), right(1, 2)],
            Kind::Prismatic => vec![across(0), across(1), right(0, 2), right(1, 2), right(0, 1)],
            Kind::Planar => vec![across(2), right(0, 2), right(1, 2)],
            Kind::Weld => vec![position, right(0, 2), right(1, 2), right(0, 1)],
            Kind::Distance => vec![Primitive::Distance(joint.length)],
        };
        Joint {
            holds,
            ends,
            spring: None,
            turn: None,
        }
    }

    fn nodes(&self, of: impl Fn(&Body) -> (V, Matrix3<f64>)) -> Vec<Node<3>> {
        let nodes = self.bodies.iter().flat_map(|body| {
            let (center, axes) = of(body);
            let axis = |k: usize| axes.column(k).into_owned().into();
            [[center.into(), axis(0)], [axis(1), axis(2)]]
        });
        nodes.collect()
    }

    fn parts(&self) -> Parts<3> {
        let count = self.bodies.len();
        let frames = self.bodies.iter().enumerate().map(|(i, body)| Frame {
            node: 2 * i,
            mass: body.mass,
            moments: body.moments.into(),
            places: [None; 3],
        });
        Parts {
            nodes: self.nodes(|body| (body.center, body.axes)),
            bodies: (0..count).map(|i| 2 * i..2 * i + 2).collect(),
            chains: Vec::new(),
            lumped_masses: Vec::new(),
            frames: frames.collect(),
            rods: Vec::new(),
            rigid: Vec::new(),
            joints: self.joints.iter().map(|joint| self.joint(joint)).collect(),
            drives: Vec::new(),
            loads: Vec::new(),
            initial_loads: Vec::new(),
            angles: Vec::new(),
            gravity: self.gravity,
            rotation: 0.0,
            tracks_work: false,
        }
    }

    /// The system with its state as described.
    fn started(&self) -> (System<3>, State, Work<3>) {
        let system = System::new(self.parts()).expect("a system");
        let (state, work) = self.state_of(&system);
        (system, state, work)
    }

    fn state_of(&self, system: &System<3>) -> (State, Work<3>) {
        let mut work = Work::new(system);
        let described = self.nodes(|body| (body.center, body.axes));
        let cross = |w: V| Matrix3::new(0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0);
        let rates = self.nodes(|body| (body.velocity, cross(body.spin) * body.axes));
        let state = system
            .initial_state(0.0, &[], (&described, &rates), &mut work)
            .unwrap_or_else(|error| {
                panic!(
                    "{error:?} of {:?}",
                    self.joints
                        .iter()
                        .map(|joint| (joint.kind, joint.bodies))
                        .collect::<Vec<_>>()
                )
            });
        (state, work)
    }
}

#[test]
fn accelerations_are_those_of_newton_and_euler() {
    let mut chance = Chance(1);
    for run in 0..600 {
        let mechanism = Mechanism::random(&mut chance);
        let (system, state, mut work) = mechanism.started();
        let mut evaluation = Evaluation::new(&system);
        evaluation.kinematics(&system, &state, &mut work);
        evaluation.dynamics(&system, &state, &[], &mut work);
        let wanted = mechanism.accelerations();
        let size = wanted.amax() + mechanism.twists().amax() + mechanism.gravity.norm();
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
            assert!((x[0] - body.center).norm() < 1e-9 && (v[0] - body.velocity).norm() < 1e-7);
            let names = mechanism.joints.iter().map(|joint| joint.kind);
            let names: Vec<Kind> = names.collect();
            let miss = (a[0] - part(0)).norm();
            assert!(miss < 1e-6 * size, "{run} {names:?}: {miss:e} of {size:e}");
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
}

/// Energy, momentum and angular momentum of a state.
fn invariants(system: &System<3>, state: &State, work: &mut Work<3>) -> [f64; 7] {
    let mut values = Evaluation::new(system);
    values.kinematics(system, state, work);
    let energy = values.kinetic_energy(system) + values.gravity_energy(system);
    let ([a, b, c], [d, e, f]) = {
        let (linear, angular) = values.momentum(system);
        (<[f64; 3]>::from(linear), angular)
    };
    [energy, a, b, c, d, e, f]
}

fn advanced(
    method: &mut dyn Method,
    (system, state, work): (&System<3>, &mut State, &mut Work<3>),
    until: f64,
    tolerance: f64,
) -> u64 {
    let tolerance = Tolerance {
        relative: tolerance,
        position: system.scale(),
        time: 0.5,
    };
    let mut model = Model::new(system, &[], work, state);
    let (counts, result) = advance(method, &mut model, state, until, &tolerance);
    result.expect("a motion");
    counts.steps
}

#[test]
fn free_mechanisms_keep_energy_momentum_and_angular_momentum() {
    let mut chance = Chance(7);
    let mut runs = 0;
    while runs < 40 {
        let mut mechanism = Mechanism::random(&mut chance);
        if mechanism
            .joints
            .iter()
            .any(|joint| joint.bodies[0].is_none())
        {
            continue;
        }
        mechanism.gravity = V::zeros();
        runs += 1;
        let (system, start, mut work) = mechanism.started();
        let n = system.coordinates();
        let before = invariants(&system, &start, &mut work);
        let mut ends = Vec::new();
        let methods: [&mut dyn Method; 2] = [&mut Rk4::new(n, 1e-9, 1e-9), &mut Radau::new(n)];
        for method in methods {
            let mut state = start.clone();
            let name = method.name();
            let steps = advanced(method, (&system, &mut state, &mut work), 3.0, 1e-8);
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

#[test]
fn derivatives_in_time_are_those_of_the_motion() {
    let mut chance = Chance(3);
    for run in 0..100 {
        let mechanism = Mechanism::random(&mut chance);
        let (system, start, mut work) = mechanism.started();
        let mut accelerations = Vec::new();
        const STEP: f64 = 2e-3;
        let mut made = Derivatives::new(&system);
        let mut state = start.clone();
        for k in 0..5 {
            if k > 0 {
                let mut method = Rk4::new(system.coordinates(), 1e-9, 1e-9);
                let until = STEP * f64::from(k);
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
                let first = ((a - e) + (d - b) * 8.0) / (12.0 * STEP);
                let second = ((b + d) * 16.0 - c * 30.0 - a - e) / (12.0 * STEP * STEP);
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

#[test]
fn the_stiffness_is_the_derivative_of_forces() {
    let mut chance = Chance(11);
    for run in 0..60 {
        let mut mechanism = Mechanism::random(&mut chance);
        mechanism.bodies.iter_mut().for_each(|body| {
            (body.velocity, body.spin) = (V::zeros(), V::zeros());
        });
        let mut parts = mechanism.parts();
        for (body, sign) in (0..mechanism.bodies.len()).flat_map(|body| [(body, 1.0), (body, -1.0)])
        {
            let at = chance.vector();
            let marker = Marker::framed(body, 2 * body, at.into(), [1.0, 0.0, 0.0]);
            let point =
                mechanism.bodies[body].point(&at) + chance.vector() + V::new(sign, 0.0, 0.0);
            parts.loads.push(Load::Spring(Spring {
                ends: [End::Ground(point), End::Body(marker)],
                stiffness: 50.0,
                damping: 0.0,
                length: Signal::Function(Function::constant(0.4)),
            }));
        }
        let system = System::new(parts).expect("a system");
        let (mut state, mut work) = mechanism.state_of(&system);
        state.rates.fill(0.0);
        let n = system.coordinates();
        let rest = vec![0.0; n];
        let mut model = Model::new(&system, &[], &mut work, &state);
        model.renew_beyond(&mut state, 0.0);
        let mut tangents = Vec::new();
        for k in 0..n {
            let mut unit = vec![0.0; n];
            unit[k] = 1.0;
            model.linearize(0.0, &state.coordinates, &rest);
            model.apply_stiffness(&mut unit);
            tangents.push(unit);
        }
        let at = |model: &mut Model<'_, 3>, k: usize, h: f64| {
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
            let mut a = vec![0.0; n];
            model.accelerate(0.0, &moved.coordinates, &rest, &mut a);
            model.linearize(0.0, &state.coordinates, &rest);
            model.take_out_normal(&mut a);
            a
        };
        const STEP: f64 = 1e-4;
        let columns = (0..n).map(|k| {
            let [a, b] = [at(&mut model, k, STEP), at(&mut model, k, -STEP)];
            DVector::from_fn(n, |j, _| (b[j] - a[j]) / (2.0 * STEP))
        });
        let wanted = DMatrix::from_columns(&columns.collect::<Vec<_>>());
        let symmetric = (&wanted + wanted.transpose()) * 0.5;
        let found = DMatrix::from_fn(n, n, |i, j| tangents[j][i]);
        let miss = (&symmetric - &found).amax() / found.amax();
        assert!(miss < 1e-5, "{run}: {miss:e}");
    }
}

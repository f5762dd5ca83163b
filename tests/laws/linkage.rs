//! Random mechanisms of rigid bodies in space, and Newton's and Euler's equations of every body by itself with multipliers:
//! dense, in global components, joints differentiated numerically along twists.

use flexbody::bodies::{Bodies, Marker, Node, RigidBodyFrame};
use flexbody::system::joints::{Across, JointEquations, Perpendicular, Primitive};
use flexbody::system::{Attachment, Direction, Parts, State, System, Workspace};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};

use crate::laws::chance::Chance;
use crate::laws::least::least;
use crate::laws::sprung::Sprung;

pub type V = Vector3<f64>;

#[derive(Clone)]
pub struct Body {
    pub mass: f64,
    pub moments: V,
    pub center: V,
    pub axes: Matrix3<f64>,
    pub velocity: V,
    pub spin: V,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Spherical,
    Revolute,
    Universal,
    Cylindrical,
    Prismatic,
    Planar,
    Weld,
    Distance,
    Screw,
    /// Cylindrical, its way driven: [`DRIVE`].
    DrivenCylindrical,
}

/// Rate (m/s) and half the second derivative (m/s^2) of driven ways.
pub const DRIVE: [f64; 2] = [0.4, 0.7];
/// Way of a screw per angle, m/rad.
pub const THREAD: f64 = 0.35;

pub const KINDS: [Kind; 10] = [
    Kind::Spherical,
    Kind::Revolute,
    Kind::Universal,
    Kind::Cylindrical,
    Kind::Prismatic,
    Kind::Planar,
    Kind::Weld,
    Kind::Distance,
    Kind::Screw,
    Kind::DrivenCylindrical,
];

/// A joint: the first body (none is the ground), the second, points and axes fixed in both.
#[derive(Clone)]
pub struct Held {
    pub kind: Kind,
    pub bodies: [Option<usize>; 2],
    pub points: [V; 2],
    pub axes: [Matrix3<f64>; 2],
    pub length: f64,
}

/// A joint, and whether it is its angle.
pub type Of = (usize, bool);

#[derive(Clone)]
pub struct Mechanism {
    pub bodies: Vec<Body>,
    pub joints: Vec<Held>,
    pub gravity: V,
    pub sprung: Vec<Sprung>,
    /// Pairs of coordinates, by joint and whether it is the angle; ratio and what `c2 - ratio c1` is.
    pub gears: Vec<((Of, Of), [f64; 2])>,
}

impl Body {
    pub fn point(&self, at: &V) -> V {
        self.center + self.axes * at
    }

    /// Moves the body along twists for `time`, s.
    pub fn moved(&self, velocity: &V, spin: &V, time: f64) -> Self {
        Self {
            center: self.center + velocity * time,
            axes: Rotation3::new(spin * time) * self.axes,
            ..self.clone()
        }
    }
}

impl Held {
    /// Returns the gaps of the joint.
    pub fn gaps(&self, bodies: &[Body]) -> Vec<f64> {
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
            Kind::Screw => {
                gaps.extend([across(0), across(1), right(0, 2), right(1, 2)]);
                let angle = right(1, 0).atan2(right(0, 0));
                gaps.push(across(2) - THREAD * angle - self.length);
            }
            // Less what drives it, which depends on time alone.
            Kind::DrivenCylindrical => {
                gaps.extend([across(0), across(1), right(0, 2), right(1, 2), across(2)]);
            }
        }
        gaps
    }
}

impl Mechanism {
    /// A tree of bodies with joints that fit, now and then a joint more; moving as joints allow.
    pub fn random(chance: &mut Chance) -> Self {
        let count = 1 + chance.below(5);
        let mut made = Self {
            bodies: Vec::new(),
            joints: Vec::new(),
            gravity: chance.vector() * 9.81,
            sprung: Vec::new(),
            gears: Vec::new(),
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
        if chance.below(2) == 0 {
            made.gear(chance);
        }
        made.start(chance);
        made
    }

    pub fn join(&mut self, first: Option<usize>, second: usize, chance: &mut Chance) {
        let kind = KINDS[chance.below(KINDS.len())];
        let (place, axes) = (
            chance.vector() * 2.0,
            Rotation3::new(chance.vector() * 3.0).into_inner(),
        );
        let way = match kind {
            Kind::Distance => chance.vector() + V::new(0.0, 0.0, 2.0),
            Kind::Cylindrical | Kind::Prismatic | Kind::Screw | Kind::DrivenCylindrical => {
                axes.column(2) * chance.number()
            }
            Kind::Planar => axes.column(0) * chance.number() + axes.column(1) * chance.number(),
            _ => V::zeros(),
        };
        // What may rotate.
        let turned = match kind {
            Kind::Spherical | Kind::Distance => Rotation3::new(chance.vector()).into_inner(),
            Kind::Revolute
            | Kind::Cylindrical
            | Kind::Planar
            | Kind::Screw
            | Kind::DrivenCylindrical => {
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
        let made = self.joints.len() - 1;
        let held = &self.joints[made];
        let way = held.coordinate(&self.bodies, false);
        let angle = held.coordinate(&self.bodies, true);
        match kind {
            Kind::Screw => self.joints[made].length = way - THREAD * angle,
            Kind::DrivenCylindrical => self.joints[made].length = way,
            _ => {}
        }
    }

    pub fn gaps(&self, bodies: &[Body]) -> DVector<f64> {
        let joints = self.joints.iter().flat_map(|joint| joint.gaps(bodies));
        let gears = self.gears.iter();
        let gears = gears.map(|(of, [ratio, gap])| self.related(*of, *ratio, bodies) - gap);
        DVector::from_vec(joints.chain(gears).collect())
    }

    pub fn twisted(&self, twists: &DVector<f64>, time: f64) -> Vec<Body> {
        let bodies = self.bodies.iter().enumerate();
        bodies
            .map(|(i, body)| {
                let part = |k: usize| V::from_fn(|j, _| twists[6 * i + k + j]);
                body.moved(&part(0), &part(3), time)
            })
            .collect()
    }

    pub fn slope(&self, twists: &DVector<f64>, step: f64) -> DVector<f64> {
        self.slope_of(&|bodies| self.gaps(bodies), twists, step)
    }

    pub fn slope_of(
        &self,
        of: &dyn Fn(&[Body]) -> DVector<f64>,
        twists: &DVector<f64>,
        step: f64,
    ) -> DVector<f64> {
        let at = |h: f64| of(&self.twisted(twists, h));
        let by = |h: f64| (at(h) - at(-h)) / (2.0 * h);
        (by(0.5 * step) * 4.0 - by(step)) / 3.0
    }

    pub fn bend(&self, twists: &DVector<f64>, step: f64) -> DVector<f64> {
        let at = |h: f64| self.gaps(&self.twisted(twists, h));
        let by = |h: f64| (at(h) + at(-h) - at(0.0) * 2.0) / (h * h);
        (by(0.5 * step) * 4.0 - by(step)) / 3.0
    }

    pub fn jacobian(&self) -> DMatrix<f64> {
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

    pub fn twists(&self) -> DVector<f64> {
        let parts = self.bodies.iter().flat_map(|body| {
            let (v, w) = (body.velocity, body.spin);
            [v[0], v[1], v[2], w[0], w[1], w[2]]
        });
        DVector::from_vec(parts.collect())
    }

    /// Random velocities without the part that joints do not allow.
    pub fn start(&mut self, chance: &mut Chance) {
        let n = 6 * self.bodies.len();
        let mut twists = DVector::from_fn(n, |_, _| 2.0 * chance.number());
        if !self.joints.is_empty() {
            let jacobian = self.jacobian();
            let missing = self.driven(1) - &jacobian * &twists;
            twists += least(&jacobian, &missing);
            let left = (self.driven(1) - jacobian * &twists).norm();
            if self.is_driven() && (left > 1e-7 || twists.amax() > 10.0) {
                // A loop holds what would be driven, or nearly.
                self.release_drives();
                return self.start(chance);
            }
        }
        for (i, body) in self.bodies.iter_mut().enumerate() {
            body.velocity = V::from_fn(|j, _| twists[6 * i + j]);
            body.spin = V::from_fn(|j, _| twists[6 * i + 3 + j]);
        }
    }

    /// Accelerations and angular accelerations of all bodies.
    pub fn accelerations(&self) -> DVector<f64> {
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
        force += self.sprung_forces().0;
        let inverse = mass.clone().cholesky().expect("positive").inverse();
        let free = &inverse * force;
        if self.joints.is_empty() {
            return free;
        }
        let jacobian = self.jacobian();
        let missing = self.driven(2) - self.bend(&self.twists(), 1e-2) - &jacobian * &free;
        // In coordinates of unit mass the least change. Not by `J M^-1 J^T`: its singular values are squares, of which
        // a threshold would take those near a singular position for zero that velocities do not.
        let root = inverse.cholesky().expect("positive").unpack();
        free + &root * least(&(jacobian * &root), &missing)
    }

    pub fn end(&self, joint: &Held, i: usize, axis: usize) -> Attachment<3> {
        match joint.bodies[i] {
            Some(body) => Attachment::Body(Marker::framed(
                body,
                2 * body,
                joint.points[i].into(),
                joint.axes[i].column(axis).into_owned().into(),
            )),
            None => Attachment::Ground(joint.points[i]),
        }
    }

    pub fn direction(&self, joint: &Held, i: usize, axis: usize) -> Direction<3> {
        match self.end(joint, i, axis) {
            Attachment::Body(marker) => Direction::Of(marker),
            Attachment::Ground(_) => Direction::Fixed(joint.axes[i].column(axis).into_owned()),
        }
    }

    pub fn joint(&self, joint: &Held) -> JointEquations<3> {
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
                across: Across::Translation([self.end(joint, 0, i), ends[1]], 1.0),
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
            Kind::Screw | Kind::DrivenCylindrical => {
                vec![across(0), across(1), right(0, 2), right(1, 2)]
            }
        };
        JointEquations {
            holds,
            ends,
            spring: None,
            turn: None,
            way: None,
            release: None,
        }
    }

    pub fn nodes(&self, of: impl Fn(&Body) -> (V, Matrix3<f64>)) -> Vec<Node<3>> {
        let nodes = self.bodies.iter().flat_map(|body| {
            let (center, axes) = of(body);
            let axis = |k: usize| axes.column(k).into_owned().into();
            [[center.into(), axis(0)], [axis(1), axis(2)]]
        });
        nodes.collect()
    }

    pub fn parts(&self) -> Parts<3> {
        let count = self.bodies.len();
        let frames = self
            .bodies
            .iter()
            .enumerate()
            .map(|(i, body)| RigidBodyFrame::new(2 * i, body.mass, body.moments.into()));
        let mut bodies = Bodies::new(
            self.nodes(|body| (body.center, body.axes)),
            (0..count).map(|i| 2 * i..2 * i + 2).collect(),
        );
        frames.for_each(|frame| bodies.add_rigid(frame));
        let mut parts = Parts {
            bodies,
            rigid: Vec::new(),
            joints: self.joints.iter().map(|joint| self.joint(joint)).collect(),
            drives: Vec::new(),
            winches: Vec::new(),
            loads: Vec::new(),
            initial_loads: Vec::new(),
            angles: Vec::new(),
            gravity: self.gravity,
            rotation: [0.0; 3],
            tracks_work: false,
        };
        self.couple(&mut parts);
        parts
    }

    /// The system with its state as described.
    pub fn started(&self) -> (System<3>, State, Workspace<3>) {
        let system = System::new(self.parts()).expect("a system");
        let (state, work) = self.state_of(&system);
        (system, state, work)
    }

    pub fn state_of(&self, system: &System<3>) -> (State, Workspace<3>) {
        let mut work = Workspace::new(system);
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

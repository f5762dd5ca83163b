//! Springs, dampers, joint limits and bushings of random mechanisms, by their energies and laws along numerical derivatives of what
//! they stretch: rotations by the logarithm of matrices, angles by arc tangents.

use flexbody::bodies::Marker;
use flexbody::math::function::Function;
use flexbody::system::joints::{Coupler, JointEquations, Primitive};
use flexbody::system::loads::{
    self, AppliedLoad, BetweenFrames, BushingMeasure, JointLimit, JointSpring, OneSidedSpring,
};
use flexbody::system::{
    Angle, Attachment, AxisRotation, Coordinate, Direction, Drive, Parts, Translation,
};
use nalgebra::{DVector, Matrix3, Rotation3};

use crate::laws::chance::Chance;
use crate::laws::linkage::{Body, DRIVE, Held, Kind, Mechanism, Of, THREAD, V};

/// Springs, joint limits and bushings beside gravity.
#[derive(Clone, Debug)]
pub enum Sprung {
    /// On the angle of a joint, or on its way: stiffness, damping, value at rest.
    Spring(Of, [f64; 3]),
    /// Limits of the same: stiffness, damping, limits.
    JointLimit(Of, [f64; 2], [f64; 2]),
    /// Between two bodies, the first of which may be the ground.
    Bushing(Box<Bushing>),
}

#[derive(Clone, Debug)]
pub struct Bushing {
    pub bodies: [Option<usize>; 2],
    pub points: [V; 2],
    /// Axes along which it is soft, fixed in both.
    pub axes: [Matrix3<f64>; 2],
    pub rest: V,
    pub stiffness: [V; 2],
    pub damping: [V; 2],
}

/// A joint's point and axes now.
fn placed(
    body: Option<usize>,
    point: &V,
    axes: &Matrix3<f64>,
    bodies: &[Body],
) -> (V, Matrix3<f64>) {
    match body {
        Some(body) => (bodies[body].point(point), bodies[body].axes * axes),
        None => (*point, *axes),
    }
}

impl Held {
    /// Returns the angle about the third axis (from -pi to pi), or the displacement along it.
    pub fn coordinate(&self, bodies: &[Body], is_angle: bool) -> f64 {
        let at = |i: usize| placed(self.bodies[i], &self.points[i], &self.axes[i], bodies);
        let ((p, a), (q, b)) = (at(0), at(1));
        if !is_angle {
            return a.column(2).dot(&(q - p));
        }
        let along = b.column(0);
        a.column(1).dot(&along).atan2(a.column(0).dot(&along))
    }

    /// Which coordinates it has: an angle, a way.
    pub fn coordinates(&self) -> Vec<bool> {
        match self.kind {
            Kind::Revolute | Kind::Planar => vec![true],
            Kind::Cylindrical | Kind::Screw | Kind::DrivenCylindrical => vec![true, false],
            Kind::Prismatic => vec![false],
            _ => vec![],
        }
    }
}

impl Sprung {
    /// Returns the strains that the load resists.
    pub fn strains(&self, joints: &[Held], bodies: &[Body]) -> Vec<f64> {
        match self {
            Self::Spring((joint, is_angle), _) | Self::JointLimit((joint, is_angle), ..) => {
                vec![joints[*joint].coordinate(bodies, *is_angle)]
            }
            Self::Bushing(bushing) => {
                let at = |i: usize| {
                    placed(
                        bushing.bodies[i],
                        &bushing.points[i],
                        &bushing.axes[i],
                        bodies,
                    )
                };
                let ((p, a), (q, b)) = (at(0), at(1));
                let way = a.transpose() * (q - p) - bushing.rest;
                let turned = Rotation3::from_matrix_unchecked(a.transpose() * b).scaled_axis();
                way.iter().chain(turned.iter()).copied().collect()
            }
        }
    }

    /// The forces that these strains meet at their rates, and the energy that is stored.
    pub fn forces(&self, strains: &[f64], rates: &[f64]) -> (Vec<f64>, f64) {
        match self {
            Self::Spring(_, [k, c, rest]) => {
                let stretch = strains[0] - rest;
                (
                    vec![-k * stretch - c * rates[0]],
                    0.5 * k * stretch * stretch,
                )
            }
            Self::JointLimit(_, [k, a], [lower, upper]) => {
                let by = |depth: f64, rate: f64| k * depth * (1.0 + a * rate).max(0.0);
                let (below, above) = (lower - strains[0], strains[0] - upper);
                match (below > 0.0, above > 0.0) {
                    (true, _) => (vec![by(below, -rates[0])], 0.5 * k * below * below),
                    (_, true) => (vec![-by(above, rates[0])], 0.5 * k * above * above),
                    _ => (vec![0.0], 0.0),
                }
            }
            Self::Bushing(bushing) => {
                let sizes = |of: &[V; 2]| [of[0].as_slice(), of[1].as_slice()].concat();
                let (k, c) = (sizes(&bushing.stiffness), sizes(&bushing.damping));
                let each = (0..6).map(|i| -k[i] * strains[i] - c[i] * rates[i]);
                let energy: f64 = (0..6).map(|i| 0.5 * k[i] * strains[i] * strains[i]).sum();
                (each.collect(), energy)
            }
        }
    }

    pub fn load(&self, mechanism: &Mechanism, parts: &mut Parts<3>) -> AppliedLoad<3> {
        match self {
            Self::Spring(of, [stiffness, damping, rest]) => AppliedLoad::JointSpring(JointSpring {
                coordinate: Box::new(mechanism.coordinate(*of, parts)),
                stiffness: *stiffness,
                damping: *damping,
                rest: *rest,
            }),
            Self::JointLimit(of, [stiffness, damping], limits) => {
                AppliedLoad::JointLimit(JointLimit {
                    coordinate: Box::new(mechanism.coordinate(*of, parts)),
                    limits: *limits,
                    spring: OneSidedSpring {
                        stiffness: *stiffness,
                        damping: *damping,
                    },
                })
            }
            Self::Bushing(bushing) => {
                let marker = |i: usize, k: usize| {
                    let axis = bushing.axes[i].column(k).into_owned();
                    let made = |body| {
                        Marker::framed(body, 2 * body, bushing.points[i].into(), axis.into())
                    };
                    bushing.bodies[i].map_or(Err(axis), |body| Ok(made(body)))
                };
                let direction = |i: usize, k: usize| match marker(i, k) {
                    Ok(marker) => Direction::Of(marker),
                    Err(axis) => Direction::Fixed(axis),
                };
                let end = |i: usize, k: usize| match marker(i, k) {
                    Ok(marker) => Attachment::Body(marker),
                    Err(_) => Attachment::Ground(bushing.points[i]),
                };
                AppliedLoad::Bushing(Box::new(loads::Bushing {
                    measure: BushingMeasure::Frames(BetweenFrames {
                        ways: std::array::from_fn(|k| Translation {
                            ends: [end(0, k), end(1, k)],
                            direction: direction(0, k),
                            turn: [0.0, 1.0],
                        }),
                        rest: bushing.rest.into(),
                        axes: [0, 1].map(|i| std::array::from_fn(|k| direction(i, k))),
                    }),
                    stiffness: bushing.stiffness.map(Into::into),
                    damping: bushing.damping.map(Into::into),
                }))
            }
        }
    }
}

impl Mechanism {
    /// A coordinate of a joint for the system; an angle is counted.
    pub fn coordinate(&self, (joint, is_angle): Of, parts: &mut Parts<3>) -> Coordinate<3> {
        let held = &self.joints[joint];
        let ends = [self.end(held, 0, 2), self.end(held, 1, 0)];
        if !is_angle {
            return Coordinate::Translation(Translation {
                ends,
                direction: self.direction(held, 0, 2),
                turn: [0.0, 1.0],
            });
        }
        let turn = AxisRotation {
            across: [0, 1].map(|k| self.direction(held, 0, k)),
            of: self.direction(held, 1, 0),
        };
        let angle = Angle {
            ends,
            turn: Some(turn),
        };
        parts.angles.push(angle);
        Coordinate::Angle(angle, parts.angles.len() - 1)
    }

    /// Springs, joint limits and bushings here and there, damped or not.
    pub fn spring(&mut self, chance: &mut Chance, is_damped: bool) {
        let damping = |chance: &mut Chance| {
            if is_damped {
                0.5 + 0.5 * chance.number()
            } else {
                0.0
            }
        };
        for (joint, held) in self.joints.iter().enumerate() {
            for is_angle in held.coordinates() {
                let (of, value) = ((joint, is_angle), held.coordinate(&self.bodies, is_angle));
                let sizes = [
                    6.0 + 3.0 * chance.number(),
                    damping(chance),
                    value + 0.5 * chance.number(),
                ];
                match chance.below(4) {
                    0 => self.sprung.push(Sprung::Spring(of, sizes)),
                    1 => {
                        let limits = match chance.below(2) {
                            0 => [f64::NEG_INFINITY, value - 0.2],
                            _ => [value + 0.2, f64::INFINITY],
                        };
                        let damping = 0.05 * damping(chance);
                        self.sprung
                            .push(Sprung::JointLimit(of, [6.0, damping], limits));
                    }
                    _ => {}
                }
            }
        }
        for second in 0..self.bodies.len() {
            let first = match chance.below(3) {
                0 => continue,
                1 => None,
                _ => Some(chance.below(self.bodies.len())).filter(|first| *first != second),
            };
            let damped = damping(chance);
            self.mount(first, second, chance, [18.0, damped]);
        }
    }

    fn mount(
        &mut self,
        first: Option<usize>,
        second: usize,
        chance: &mut Chance,
        [k, c]: [f64; 2],
    ) {
        let bodies = [first, Some(second)];
        let mut axes = [0, 1].map(|_| Rotation3::new(chance.vector() * 3.0).into_inner());
        let points = [0, 1].map(|_| chance.vector());
        let standing = |body: Option<usize>| {
            body.map_or_else(Matrix3::identity, |body| self.bodies[body].axes)
        };
        // They stand to each other as at rest, but for a part of a turn.
        let bent = Rotation3::new(chance.vector() * 0.7).into_inner();
        axes[1] = standing(bodies[1]).transpose() * standing(first) * axes[0] * bent;
        let at = |i: usize| placed(bodies[i], &points[i], &axes[i], &self.bodies);
        let ((p, a), (q, _)) = (at(0), at(1));
        let rest = a.transpose() * (q - p) + chance.vector() * 0.3;
        let sizes =
            |by: f64, chance: &mut Chance| V::from_fn(|_, _| by * (1.0 + 0.5 * chance.number()));
        self.sprung.push(Sprung::Bushing(Box::new(Bushing {
            bodies,
            points,
            axes,
            rest,
            stiffness: [0, 1].map(|_| sizes(k, chance)),
            damping: [0, 1].map(|_| sizes(c, chance)),
        })));
    }

    /// Returns the forces of springs, joint limits and bushings along twists of all bodies, and their energy.
    pub fn sprung_forces(&self) -> (DVector<f64>, f64) {
        let n = 6 * self.bodies.len();
        let (mut force, mut energy) = (DVector::zeros(n), 0.0);
        for load in &self.sprung {
            let strains = |bodies: &[Body]| DVector::from_vec(load.strains(&self.joints, bodies));
            let along = |twists: &DVector<f64>| self.slope_of(&strains, twists, 1e-2);
            let (forces, stored) = load.forces(
                strains(&self.bodies).as_slice(),
                along(&self.twists()).as_slice(),
            );
            energy += stored;
            let forces = DVector::from_vec(forces);
            for i in 0..n {
                let mut unit = DVector::zeros(n);
                unit[i] = 1.0;
                force[i] += along(&unit).dot(&forces);
            }
        }
        (force, energy)
    }

    /// Joins two coordinates of joints by a gear, where there are two.
    pub fn gear(&mut self, chance: &mut Chance) {
        let joints = self.joints.iter().enumerate();
        let all = joints.flat_map(|(joint, held)| {
            let is_free = held.kind != Kind::DrivenCylindrical;
            let coordinates = held.coordinates().into_iter().filter(move |_| is_free);
            coordinates.map(move |is_angle| (joint, is_angle))
        });
        let all: Vec<Of> = all.collect();
        let (Some(first), Some(second)) = (all.first(), all.last()) else {
            return;
        };
        if first.0 != second.0 {
            let ratio = 1.2 + 0.7 * chance.number();
            let gap = self.related((*first, *second), ratio, &self.bodies);
            self.gears.push(((*first, *second), [ratio, gap]));
        }
    }

    /// `c2 - ratio c1`.
    pub fn related(&self, (first, second): (Of, Of), ratio: f64, bodies: &[Body]) -> f64 {
        let [a, b] = [first, second].map(|(joint, of)| self.joints[joint].coordinate(bodies, of));
        b - ratio * a
    }

    /// A joint of the system that holds such a relation.
    pub fn relation(
        &self,
        (first, second): (Of, Of),
        [ratio, offset]: [f64; 2],
        parts: &mut Parts<3>,
    ) -> JointEquations<3> {
        let [a, b] = [first, second].map(|of| self.coordinate(of, parts));
        let ends = b.ends();
        JointEquations {
            holds: vec![Primitive::Coupler(Coupler {
                terms: vec![(-ratio, a), (1.0, b)],
                offset,
                drive: None,
                size: 1.0,
            })],
            ends,
            spring: None,
            turn: None,
            way: None,
            release: None,
        }
    }

    /// Drives nothing.
    pub fn release_drives(&mut self) {
        for joint in &mut self.joints {
            if joint.kind == Kind::DrivenCylindrical {
                joint.kind = Kind::Cylindrical;
            }
        }
    }

    /// Whether anything is driven.
    pub fn is_driven(&self) -> bool {
        let mut joints = self.joints.iter();
        joints.any(|joint| joint.kind == Kind::DrivenCylindrical)
    }

    /// Derivatives in time, of this order, of what the gaps are to be.
    pub fn driven(&self, order: usize) -> DVector<f64> {
        let size = [DRIVE[0], 2.0 * DRIVE[1]][order - 1];
        let joints = self.joints.iter().flat_map(|joint| {
            let mut rows = vec![0.0; joint.gaps(&self.bodies).len()];
            if let (Kind::DrivenCylindrical, Some(last)) = (joint.kind, rows.last_mut()) {
                *last = size;
            }
            rows
        });
        DVector::from_vec(joints.chain(self.gears.iter().map(|_| 0.0)).collect())
    }

    /// Screws, gears, what is driven, springs.
    pub fn couple(&self, parts: &mut Parts<3>) {
        for (joint, held) in self.joints.iter().enumerate() {
            let added = match held.kind {
                Kind::Screw => {
                    let both = ((joint, true), (joint, false));
                    self.relation(both, [THREAD, held.length], parts)
                }
                Kind::DrivenCylindrical => {
                    let [rate, half] = DRIVE;
                    let course = format!("{}+{rate}*t+{half}*t^2", held.length);
                    let course = Function::expression(&course).expect("a function");
                    parts.drives.push(Drive::Function(course));
                    let mut driven =
                        self.relation(((joint, true), (joint, false)), [0.0; 2], parts);
                    if let Primitive::Coupler(related) = &mut driven.holds[0] {
                        related.terms.remove(0);
                        related.drive = Some(parts.drives.len() - 1);
                    }
                    driven
                }
                _ => continue,
            };
            parts.joints.push(added);
        }
        for (of, sizes) in &self.gears {
            let gear = self.relation(*of, *sizes, parts);
            parts.joints.push(gear);
        }
        for sprung in &self.sprung {
            let load = sprung.load(self, parts);
            parts.loads.push(load);
        }
    }
}

//! Mechanisms from random numbers: every body is held to the ground or to one before it where both
//! are, so that all fit together at the start; then something may be held once more.

use std::f64::consts::{PI, TAU};

use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Nodal, StrainMeasure};
use nalgebra::Vector2;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::laws::mechanism::{Acting, At, Body, Hold, Kind, Mechanism, Place, Point, Wave, left};

/// Parts that a random mechanism may have.
#[derive(Clone, Copy)]
pub struct Scope {
    /// Most bodies, joints beyond a tree, loads.
    pub bodies: usize,
    pub extras: usize,
    pub loads: usize,
    /// Whether things may slide along cables, be driven, follow, rotate with the frame.
    pub slides: bool,
    pub drives: bool,
    pub followers: bool,
    pub rotates: bool,
    pub damped: bool,
}

/// Everything.
pub const ALL: Scope = Scope {
    bodies: 4,
    extras: 2,
    loads: 3,
    slides: true,
    drives: true,
    followers: true,
    rotates: true,
    damped: true,
};

/// Random mechanisms.
pub fn mechanisms(scope: Scope) -> impl Strategy<Value = Mechanism> {
    vec(0.0..1.0_f64, 150).prop_map(move |numbers| {
        let mut builder = Builder::new(numbers, scope);
        builder.build();
        builder.made
    })
}

/// Two bodies that can rotate, from numbers; a first hold names a place on each, a second one two places on
/// the first body.
pub fn pair(numbers: Vec<f64>) -> Mechanism {
    let mut builder = Builder::new(numbers, ALL);
    for body in 0..2 {
        builder.body();
        if let Body::Particle { mass } = builder.made.bodies[body] {
            let inertia = 0.1 * mass;
            builder.made.bodies[body] = Body::Rigid { mass, inertia };
        }
    }
    // Apart from each other, as nothing may have a length of zero.
    let ends = [0, 1].map(|body| builder.place(body));
    builder.shift(ends[1], Vector2::new(3.0, 2.0));
    let ends = ends.map(Point::On);
    builder.hold(Kind::Revolute, ends);
    // Two places on one body, often in one element.
    let at = match builder.made.bodies[0] {
        Body::Cable(_) => {
            [(0.05, 0.4), (0.6, 0.95)].map(|(a, b)| At::Part(builder.dice.between(a, b)))
        }
        _ => [-0.4, 0.4].map(|x| At::Point([x, builder.dice.between(-0.5, 0.5)])),
    };
    let ends = at.map(|at| Point::On(Place { body: 0, at }));
    builder.hold(Kind::Revolute, ends);
    builder.made
}

/// Random numbers one after the other.
struct Dice {
    numbers: Vec<f64>,
    next: usize,
}

impl Dice {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.next += 1;
        low + (high - low) * self.numbers[self.next % self.numbers.len()]
    }

    /// A number below `count`.
    fn pick(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f64) as usize).min(count - 1)
    }

    fn vector(&mut self, size: f64) -> Vector2<f64> {
        Vector2::new(self.between(-size, size), self.between(-size, size))
    }

    fn wave(&mut self, size: f64) -> Wave {
        Wave {
            constant: self.between(-size, size),
            amplitude: self.between(-size, size),
            frequency: self.between(0.5, 3.0),
        }
    }
}

struct Builder {
    dice: Dice,
    scope: Scope,
    made: Mechanism,
}

impl Builder {
    fn new(numbers: Vec<f64>, scope: Scope) -> Self {
        let noise = numbers.iter().map(|x| 2.0 * x - 1.0).collect();
        Self {
            dice: Dice { numbers, next: 0 },
            scope,
            made: Mechanism {
                bodies: Vec::new(),
                firsts: Vec::new(),
                nodes: Vec::new(),
                holds: Vec::new(),
                loads: Vec::new(),
                lumped_masses: Vec::new(),
                gravity: Vector2::new(0.4, -9.81),
                rotation: 0.0,
                noise,
            },
        }
    }

    fn build(&mut self) {
        let bodies = 1 + self.dice.pick(self.scope.bodies);
        for _ in 0..bodies {
            self.body();
            self.attach();
        }
        for _ in 0..self.dice.pick(self.scope.extras + 1) {
            self.extra();
        }
        for _ in 0..self.dice.pick(self.scope.loads + 1) {
            self.load();
        }
        if self.dice.pick(3) == 0 {
            let body = self.dice.pick(bodies);
            let place = self.place(body);
            let sizes = match self.made.bodies[body] {
                // Only cables have inertia added to.
                Body::Cable(_) => [self.dice.between(0.1, 1.0), self.dice.between(0.0, 0.1)],
                _ => [self.dice.between(0.1, 1.0), 0.0],
            };
            self.made.lumped_masses.push((place, sizes));
        }
        if self.scope.rotates && self.dice.pick(4) == 0 {
            self.made.rotation = self.dice.between(-2.0, 2.0);
        }
    }

    /// A body somewhere.
    fn body(&mut self) {
        self.made.firsts.push(self.made.nodes.len());
        let at = self.dice.vector(1.0);
        let mut heading = self.dice.between(-PI, PI);
        let direction = |heading: f64| Vector2::new(heading.cos(), heading.sin());
        let node = |p: Vector2<f64>, d: Vector2<f64>| [p.into(), d.into()];
        match self.dice.pick(5) {
            0..=2 => self.cable(at, heading),
            3 => {
                self.made.nodes.push(node(at, direction(heading)));
                self.made.bodies.push(Body::Rigid {
                    mass: self.dice.between(0.3, 2.0),
                    inertia: self.dice.between(0.05, 0.5),
                });
            }
            _ => {
                heading = 0.0;
                self.made.nodes.push(node(at, direction(heading)));
                self.made.bodies.push(Body::Particle {
                    mass: self.dice.between(0.3, 2.0),
                });
            }
        }
    }

    fn cable(&mut self, mut at: Vector2<f64>, mut heading: f64) {
        let direction = |heading: f64| Vector2::new(heading.cos(), heading.sin());
        let mut cables = Vec::new();
        let mut ends = vec![[at, direction(heading)]];
        let damping_time = if self.scope.damped && self.dice.pick(2) == 0 {
            0.02
        } else {
            0.0
        };
        for _ in 0..1 + self.dice.pick(3) {
            let (length, turn) = (self.dice.between(0.3, 0.8), self.dice.between(-0.3, 0.3));
            at += direction(heading + 0.5 * turn) * length;
            heading += turn;
            let [p, d] = ends[ends.len() - 1];
            ends.push([at, direction(heading)]);
            let parameters = Parameters {
                inertia: Inertia::Corrected,
                length,
                axial_stiffness: 300.0,
                bending_stiffness: 2.0,
                line_of: flexbody::elements::cable::LineOf::Cable,
                line_density: self.dice.between(0.3, 2.0),
                axial_damping_time: damping_time,
                bending_damping_time: damping_time,
                strain: StrainMeasure::ThetaPrime,
            };
            let shape = Nodal::from_columns(&[p, d, at, direction(heading)]);
            cables.push(Cable::new(parameters, Some(&shape)));
        }
        let nodes = ends.iter().map(|end| end.map(Into::into));
        self.made.nodes.extend(nodes);
        self.made.bodies.push(Body::Cable(cables));
    }

    /// A place on a body; where it is matters to what is under test, so ends are frequent.
    fn place(&mut self, body: usize) -> Place {
        let at = match self.made.bodies[body] {
            Body::Cable(_) => At::Part(match self.dice.pick(4) {
                0 => 0.0,
                1 => 1.0,
                _ => self.dice.between(0.1, 0.9),
            }),
            Body::Rigid { .. } => At::Point(self.dice.vector(0.5).into()),
            Body::Particle { .. } => At::Point([0.0; 2]),
        };
        Place { body, at }
    }

    /// Position and direction of a point.
    fn end(&self, point: Point) -> [Vector2<f64>; 2] {
        self.made.end(point, &self.made.apart(&self.made.nodes))
    }

    fn angle(&self, ends: [Point; 2]) -> f64 {
        let [a, b] = ends.map(|end| self.end(end)[1]);
        a.perp(&b).atan2(a.dot(&b))
    }

    fn hold(&mut self, kind: Kind, ends: [Point; 2]) {
        self.made.holds.push(Hold { kind, ends });
    }

    /// A wave that is `start` at the time 0.
    fn from(&mut self, start: f64) -> Wave {
        Wave {
            constant: start,
            ..self.dice.wave(0.5)
        }
    }

    /// Moves a body so that a place on it is at `to`.
    fn shift(&mut self, place: Place, to: Vector2<f64>) {
        let way = to - self.end(Point::On(place))[0];
        let first = self.made.firsts[place.body];
        for node in &mut self.made.nodes[first..] {
            node[0][0] += way.x;
            node[0][1] += way.y;
        }
    }

    /// Holds the last body.
    fn attach(&mut self) {
        let body = self.made.bodies.len() - 1;
        let second = self.place(body);
        let grounded = body == 0 || self.dice.pick(3) == 0;
        let first = if grounded {
            Point::Ground(self.dice.vector(1.0))
        } else {
            let before = self.dice.pick(body);
            Point::On(self.place(before))
        };
        let (ends, to) = ([first, Point::On(second)], self.end(first)[0]);
        let turns = ends.iter().all(|end| self.made.turns(*end));
        let chosen = self.dice.pick(11);
        let wanted = if self.scope.drives || chosen < 8 {
            chosen
        } else {
            chosen - 6
        };
        match wanted {
            0 => {}
            3 if turns && self.dice.pick(2) == 0 => {
                self.hold(Kind::Orientation(self.angle(ends)), ends);
            }
            3 if turns => {
                let (y, x) = self.dice.between(-PI, PI).sin_cos();
                let axis = self.end(first)[1].normalize();
                let line = axis * x + left(axis) * y;
                let way = line * self.dice.between(0.2, 1.0);
                self.shift(second, to + way);
                self.hold(Kind::Prismatic(Vector2::new(x, y), self.angle(ends)), ends);
            }
            4 => {
                let way = self.dice.between(0.0, TAU);
                let length = self.dice.between(0.3, 1.0);
                self.shift(second, to + Vector2::new(way.cos(), way.sin()) * length);
                self.hold(Kind::Distance(length), ends);
            }
            5 if grounded => {
                let way = self.dice.between(-PI, PI);
                self.shift(second, to);
                self.hold(Kind::Slider(Vector2::new(way.cos(), way.sin())), ends);
            }
            8 if grounded => {
                self.shift(second, to);
                let waves = [self.from(to.x), self.from(to.y)];
                let ground = Point::Ground(Vector2::zeros());
                self.hold(Kind::DrivenPosition(waves), [ground, ends[1]]);
            }
            9 if grounded => {
                self.shift(second, to);
                let way = self.dice.between(-PI, PI);
                let along = Vector2::new(way.cos(), way.sin());
                let wave = self.from(0.0);
                self.hold(Kind::Slider(along), ends);
                self.hold(Kind::DrivenWay(along, wave), ends);
            }
            chosen => {
                self.shift(second, to);
                self.join(chosen, ends, turns);
            }
        }
    }

    /// Joints of two points at the same place.
    fn join(&mut self, chosen: usize, ends: [Point; 2], turns: bool) {
        let slide = match ends[0] {
            Point::On(place) => {
                let cable = matches!(self.made.bodies[place.body], Body::Cable(_));
                let inside = matches!(place.at, At::Part(s) if s > 0.05 && s < 0.95);
                self.scope.slides && cable && inside
            }
            Point::Ground(_) => false,
        };
        match chosen {
            1 if turns => self.hold(Kind::Weld(self.angle(ends)), ends),
            2 if turns => {
                let numbers = [self.dice.between(0.0, 5.0), self.dice.between(0.0, 0.5)];
                let damping = if self.scope.damped { numbers[1] } else { 0.0 };
                let rest = self.angle(ends) + self.dice.between(-0.5, 0.5);
                self.hold(Kind::Hinge([numbers[0], damping, rest]), ends);
            }
            6 | 7 if slide => self.hold(Kind::Along, ends),
            10 if turns => {
                let start = self.angle(ends);
                let wave = self.from(start);
                self.hold(Kind::Revolute, ends);
                self.hold(Kind::DrivenAngle(wave), ends);
            }
            _ => self.hold(Kind::Revolute, ends),
        }
    }

    /// Something held beyond the tree, as it is at the start.
    fn extra(&mut self) {
        let count = self.made.bodies.len();
        let (a, b) = (self.dice.pick(count), self.dice.pick(count));
        let [first, second] = [self.place(a), self.place(b)].map(Point::On);
        let here = self.end(second)[0];
        let far = (self.end(first)[0] - here).norm();
        match self.dice.pick(4) {
            0 => self.hold(Kind::Revolute, [Point::Ground(here), second]),
            1 if a != b && far > 0.1 => self.hold(Kind::Distance(far), [first, second]),
            2 if a != b && self.made.turns(first) && self.made.turns(second) => {
                self.hold(
                    Kind::Orientation(self.angle([first, second])),
                    [first, second],
                );
            }
            3 if !self.made.holds.is_empty() => {
                // The same again: redundant.
                let again = self.dice.pick(self.made.holds.len());
                let Hold { kind, ends } = self.made.holds[again];
                let still = matches!(kind, Kind::Revolute | Kind::Weld(_) | Kind::Distance(_));
                if still {
                    self.hold(kind, ends);
                }
            }
            _ => {}
        }
    }

    fn load(&mut self) {
        let count = self.made.bodies.len();
        let (a, b) = (self.dice.pick(count), self.dice.pick(count));
        let [first, second] = [self.place(a), self.place(b)];
        let far = (self.end(Point::On(first))[0] - self.end(Point::On(second))[0]).norm();
        let ground = Point::Ground(self.dice.vector(2.0));
        let size = [self.dice.wave(3.0), self.dice.wave(3.0)];
        let load = match (self.dice.pick(6), &self.made.bodies[b]) {
            (0 | 1, Body::Cable(_)) => Acting::DistributedForce { body: b, size },
            (2, body) if !matches!(body, Body::Particle { .. }) => Acting::Moment {
                ends: [ground, Point::On(second)],
                size: size[0],
            },
            (3, _) if a != b && far > 0.1 => self.spring([first, second].map(Point::On)),
            (4, _) => self.spring([ground, Point::On(second)]),
            _ => Acting::Force {
                at: second,
                follower: self.scope.followers && self.dice.pick(2) == 0,
                size,
            },
        };
        self.made.loads.push(load);
    }

    fn spring(&mut self, ends: [Point; 2]) -> Acting {
        let damping = self.dice.between(0.0, 1.0);
        Acting::Spring {
            ends,
            stiffness: self.dice.between(1.0, 30.0),
            damping: if self.scope.damped { damping } else { 0.0 },
            length: Wave {
                constant: 0.7,
                ..self.dice.wave(0.2)
            },
        }
    }
}

//! From the description of a mechanism to the product's system.

use flexbody::bodies::{Bodies, LineChain, LoadedLine, LumpedMass, Marker, Node};
use flexbody::system::joints::{JointEquations, Primitive};
use flexbody::system::loads::{
    AppliedLoad, DistributedForce, Force, JointSpring, LineLoad, Moment, Spring,
};
use flexbody::system::{
    Angle, Attachment, BuildError, Coordinate, Drive, DrivenSystem, Evaluation, NotAssembled,
    Parts, Signal, State, StepOutcome, System, Workspace,
};
use nalgebra::Vector2;
use proptest::test_runner::TestCaseError;

use crate::laws::chain::project;
use crate::laws::mechanism::{Acting, At, Body, Hold, Kind, Mechanism, Place, Point, Wave};

/// A system in a state.
pub struct Moving {
    pub system: System,
    pub state: State,
    pub work: Workspace,
}

impl Mechanism {
    pub fn chains(&self) -> Vec<LineChain> {
        let bodies = self.bodies.iter().zip(&self.firsts);
        bodies
            .filter_map(|(body, first)| match body {
                Body::Cable(elements) => Some(LineChain::new(elements.clone(), *first)),
                _ => None,
            })
            .collect()
    }

    /// Number of a cable among the cables.
    pub fn chain(&self, body: usize) -> usize {
        let before = self.bodies[..body].iter();
        before.filter(|b| matches!(b, Body::Cable(_))).count()
    }

    pub fn marker(&self, place: Place) -> Marker {
        match place.at {
            At::Point(point) => Marker::rigid(place.body, self.firsts[place.body], point),
            At::Part(part) => {
                let chain = &self.chains()[self.chain(place.body)];
                Marker::along(place.body, chain, part * chain.length())
            }
        }
    }

    pub fn product_end(&self, point: Point) -> Attachment {
        match point {
            Point::Ground(p) => Attachment::Ground(p),
            Point::On(place) => Attachment::Body(self.marker(place)),
        }
    }

    /// The joint of a hold; what drives it is appended.
    pub fn joint(&self, hold: &Hold, drives: &mut Vec<Drive>) -> JointEquations {
        let mut drive = |wave: &Wave| {
            drives.push(Drive::Function(wave.function()));
            drives.len() - 1
        };
        let holds = match &hold.kind {
            Kind::Revolute | Kind::Hinge(_) => vec![Primitive::Coincident],
            Kind::Weld(angle) => vec![Primitive::Coincident, Primitive::Direction(*angle)],
            Kind::Slider(along) => vec![Primitive::Line(*along)],
            Kind::Orientation(angle) => vec![Primitive::Direction(*angle)],
            Kind::Prismatic(along, angle) => {
                vec![Primitive::Line(*along), Primitive::Direction(*angle)]
            }
            Kind::Distance(length) => vec![Primitive::Distance(*length)],
            Kind::Along => {
                let Point::On(place) = hold.ends[0] else {
                    panic!("a cable");
                };
                vec![Primitive::Curve(self.chain(place.body))]
            }
            Kind::DrivenAngle(wave) => vec![Primitive::DrivenDirection(drive(wave))],
            Kind::DrivenPosition([a, b]) => {
                vec![Primitive::DrivenPosition([drive(a), drive(b)])]
            }
            Kind::DrivenWay(along, wave) => {
                vec![Primitive::DrivenDistance(*along, drive(wave))]
            }
        };
        JointEquations {
            holds,
            ends: hold.ends.map(|end| self.product_end(end)),
            spring: None,
            turn: None,
            way: None,
            release: None,
        }
    }

    /// The load of an action.
    pub fn load(&self, acting: &Acting) -> AppliedLoad {
        let signal = |wave: &Wave| Signal::Function(wave.function());
        let ends = |ends: &[Point; 2]| ends.map(|end| self.product_end(end));
        match acting {
            Acting::Force { at, follower, size } => AppliedLoad::Force(Force {
                marker: self.marker(*at),
                follower: *follower,
                components: size.each_ref().map(signal),
                axes: [self.marker(*at); 2],
            }),
            Acting::Moment { ends: e, size } => AppliedLoad::Moment(Moment {
                ends: ends(e),
                size: signal(size),
            }),
            Acting::DistributedForce { body, size } => {
                AppliedLoad::DistributedForce(DistributedForce {
                    on: LoadedLine::Chain(self.chain(*body)),
                    density: LineLoad {
                        uniform: size.each_ref().map(signal),
                        along: [Vec::new(), Vec::new()],
                    },
                })
            }
            Acting::Spring {
                ends: e,
                stiffness,
                damping,
                length,
            } => AppliedLoad::Spring(Spring {
                ends: ends(e),
                stiffness: *stiffness,
                damping: *damping,
                length: signal(length),
            }),
        }
    }

    /// Returns the parts of the system.
    pub fn parts(&self) -> Parts {
        let (mut rigid, mut lumped_masses) = (Vec::new(), Vec::new());
        let mut ranges = Vec::new();
        for (index, (body, first)) in self.bodies.iter().zip(&self.firsts).enumerate() {
            ranges.push(*first..first + body.sizes()[0]);
            let (mass, inertia) = match body {
                Body::Cable(_) => continue,
                Body::Rigid { mass, inertia } => (*mass, *inertia),
                Body::Particle { mass } => (*mass, 0.0),
            };
            rigid.push((*first, inertia > 0.0));
            let marker = Marker::rigid(index, *first, [0.0; 2]);
            lumped_masses.push(LumpedMass {
                marker,
                mass,
                added: 0.0,
                inertia,
            });
        }
        let extra = self
            .lumped_masses
            .iter()
            .map(|(place, [mass, inertia])| LumpedMass {
                marker: self.marker(*place),
                mass: *mass,
                added: 0.0,
                inertia: *inertia,
            });
        lumped_masses.extend(extra);
        let (mut joints, mut drives, mut angles) = (Vec::new(), Vec::new(), Vec::new());
        let mut loads: Vec<AppliedLoad> = self.loads.iter().map(|load| self.load(load)).collect();
        for hold in &self.holds {
            let mut joint = self.joint(hold, &mut drives);
            if let Kind::Hinge([stiffness, damping, rest]) = hold.kind {
                joint.spring = Some(loads.len());
                let angle = Angle {
                    ends: joint.ends,
                    turn: None,
                };
                angles.push(angle);
                loads.push(AppliedLoad::JointSpring(JointSpring {
                    coordinate: Box::new(Coordinate::Angle(angle, angles.len() - 1)),
                    stiffness,
                    damping,
                    rest,
                }));
            }
            joints.push(joint);
        }
        let mut bodies = Bodies::new(self.nodes.clone(), ranges);
        for line in self.chains() {
            bodies.add_line(line);
        }
        for mass in lumped_masses {
            bodies.add_mass(mass);
        }
        Parts {
            bodies,
            rigid,
            joints,
            drives,
            winches: Vec::new(),
            loads,
            initial_loads: Vec::new(),
            angles,
            gravity: self.gravity,
            rotation: [0.0, 0.0, self.rotation],
            tracks_work: true,
        }
    }

    /// Builds the system of the mechanism.
    ///
    /// # Errors
    /// Parts that [`System::new`] refuses.
    pub fn system(&self) -> Result<System, BuildError> {
        System::new(self.parts())
    }

    /// Rates of a rigid motion of every body, random.
    pub fn rigid_rates(&self, from: usize) -> Vec<Node> {
        let mut rates = Vec::new();
        for (b, body) in self.bodies.iter().enumerate() {
            let number = |k: usize| self.noise[(from + 3 * b + k) % self.noise.len()];
            let [origin, _] = self.nodes[self.firsts[b]];
            let spin = match body {
                Body::Particle { .. } => 0.0,
                _ => 2.0 * number(2),
            };
            for [p, d] in &self.nodes[self.firsts[b]..self.firsts[b] + body.sizes()[0]] {
                let velocity = [
                    number(0) - spin * (p[1] - origin[1]),
                    number(1) + spin * (p[0] - origin[0]),
                ];
                rates.push([velocity, [-spin * d[1], spin * d[0]]]);
            }
        }
        rates
    }

    /// Starts the system with random rates.
    ///
    /// # Errors
    /// Joints that do not close.
    pub fn started(&self, system: System) -> Result<Moving, NotAssembled> {
        let mut work = Workspace::new(&system);
        let described = (&self.nodes[..], &self.rigid_rates(0)[..]);
        let state = system.initial_state(0.0, &[], described, &mut work)?;
        Ok(Moving {
            system,
            state,
            work,
        })
    }

    /// Numbers of the size of `q`.
    pub fn random(&self, n: usize, from: usize) -> Vec<f64> {
        (0..n)
            .map(|i| self.noise[(from + 7 * i) % self.noise.len()])
            .collect()
    }
}

impl Moving {
    /// Disturbs nodes by parts of the size of an element and rates likewise, and brings them back to
    /// the constraints; false where that fails or a slide leaves its cable.
    pub fn disturb(&mut self, mechanism: &Mechanism, size: f64) -> bool {
        let [dx, dv] = [11, 53].map(|from| {
            let numbers = mechanism.random(4 * mechanism.nodes.len(), from);
            let node = |x: &[f64]| [[0.3 * x[0], 0.3 * x[1]], [x[2], x[3]]];
            let nodes: Vec<Node> = numbers.chunks_exact(4).map(node).collect();
            project(&self.system, &nodes)
        });
        let add = |sum: &mut [f64], part: &[f64], size: f64| {
            sum.iter_mut().zip(part).for_each(|(s, p)| *s += size * p);
        };
        add(&mut self.state.coordinates, &dx, size);
        add(&mut self.state.rates, &dv, 10.0 * size);
        let mut model = DrivenSystem::new(&self.system, &[], &mut self.work, &self.state);
        model.project(&mut self.state) && model.count(&mut self.state) == StepOutcome::AsIs
    }

    /// Coordinates, rates, accelerations and reactions.
    pub fn evaluated(&mut self) -> Evaluation {
        let mut values = Evaluation::new(&self.system);
        values.kinematics(&self.system, &self.state, &mut self.work);
        values.dynamics(&self.system, &self.state, &[], &mut self.work);
        values
    }

    /// Force and moment of every joint on its second end.
    pub fn reactions(&self, values: &Evaluation) -> Vec<(Vector2<f64>, f64)> {
        let joints = 0..self.system.joints().len();
        joints
            .map(|joint| {
                let (force, [.., moment]) = values.reaction(&self.system, joint);
                (force, moment)
            })
            .collect()
    }
}

/// Builds the mechanism in a random state. `None` if it cannot move, or if motions disagree with joints.
///
/// # Errors
/// A system that cannot be built, or joints that do not close.
pub fn moving(mechanism: &Mechanism, size: f64) -> Result<Option<Moving>, TestCaseError> {
    let system = match mechanism.system() {
        Ok(system) => system,
        Err(BuildError::Determined(_)) => return Ok(None),
        Err(error) => return Err(TestCaseError::fail(format!("{error:?}"))),
    };
    let started = mechanism.started(system);
    let mut moving = started.map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let n = moving.system.coordinates();
    let disturbed = moving.disturb(mechanism, size);
    if n == 0 || !disturbed {
        return Ok(None);
    }
    let x = mechanism.apart(&moving.evaluated().x);
    Ok((mechanism.contradiction(0.0, &x) < 1e-6).then_some(moving))
}

//! Bodies and joints in a row: one vector of unknowns, multipliers beside what they join, so that tangents are banded.

use super::band::Band;
use super::{Block, Body, BodyMarker, Columns, Motion, Placement, Vector, plus};

/// Partner that a pin holds a marker to.
#[derive(Clone, Copy, Debug)]
pub enum To {
    /// A point of the ground, m
    Ground(Vector),
    /// A marker of another body
    Body(BodyMarker),
}

/// Angle (rad), its rate and its second derivative at a time.
pub type Angle = fn(f64) -> [f64; 3];

/// Joints, by multipliers; bodies are numbered in the order in which they come.
#[derive(Clone, Copy, Debug)]
pub enum Joint {
    /// Two points are one
    Pin {
        /// Body and its marker.
        at: BodyMarker,
        /// The other point.
        to: To,
    },
    /// A point stays on a line along the first axis
    Guide {
        /// Body and its marker.
        at: BodyMarker,
        /// Height of the line, m.
        height: f64,
    },
    /// A direction is driven
    Drive {
        /// Body and its marker.
        at: BodyMarker,
        /// The direction.
        angle: Angle,
    },
}

impl Joint {
    fn rows(&self) -> usize {
        match self {
            Self::Pin { .. } => 2,
            Self::Guide { .. } | Self::Drive { .. } => 1,
        }
    }
}

/// Force along both axes (N) and moment (N m) on a marker at a time.
pub struct Load {
    /// Body and its marker.
    pub at: BodyMarker,
    /// Values.
    pub value: Box<dyn Fn(f64) -> [f64; 3]>,
}

/// Part of a system, in the order of building.
pub enum Item {
    /// A body at its start
    Body(Box<dyn Body>, Placement),
    /// A joint
    Joint(Joint),
}

/// A row of a constraint: derivatives by unknowns.
type Row = Vec<(usize, f64)>;

/// The whole.
pub struct System {
    bodies: Vec<(usize, Box<dyn Body>)>,
    joints: Vec<(usize, Joint)>,
    loads: Vec<Load>,
    gravity: Vector,
    /// Coordinates and rates at the start.
    pub start: [Vec<f64>; 2],
    /// Whether an unknown is a multiplier.
    pub multiplier: Vec<bool>,
    half: usize,
    columns: Columns,
    rows: [Row; 2],
}

impl System {
    /// Bodies and joints in this order.
    pub fn new(items: Vec<Item>, loads: Vec<Load>, gravity: Vector) -> Self {
        let (mut bodies, mut joints) = (Vec::new(), Vec::new());
        let (mut start, mut multiplier) = ([Vec::new(), Vec::new()], Vec::new());
        for item in items {
            let offset = multiplier.len();
            match item {
                Item::Body(body, placement) => {
                    let [q, v] = body.place(&placement);
                    start[0].extend(q);
                    start[1].extend(v);
                    multiplier.resize(offset + body.coordinates(), false);
                    bodies.push((offset, body));
                }
                Item::Joint(joint) => {
                    let end = offset + joint.rows();
                    start.iter_mut().for_each(|x| x.resize(end, 0.0));
                    multiplier.resize(end, true);
                    joints.push((offset, joint));
                }
            }
        }
        let half = bodies.iter().map(|(_, body)| body.half_width()).max();
        let mut system = Self {
            bodies,
            joints,
            loads,
            gravity,
            start,
            multiplier,
            half: half.unwrap_or_default(),
            columns: Vec::new(),
            rows: [Vec::new(), Vec::new()],
        };
        let q = system.start[0].clone();
        for j in 0..system.joints.len() {
            let first = system.joints[j].0;
            for k in 0..system.rows_of(j, &q) {
                let apart = system.rows[k].iter().map(|(i, _)| i.abs_diff(first + k));
                system.half = system.half.max(apart.max().unwrap_or_default());
            }
        }
        system
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.multiplier.len()
    }

    /// A matrix for tangents.
    pub fn band(&self) -> Band {
        Band::zeros(self.size(), self.half)
    }

    /// Tangents of stiffness and of mass at the start, without motion.
    pub fn matrices_at_rest(&mut self) -> [Band; 2] {
        let [q, v] = self.start.clone();
        let rest = vec![0.0; v.len()];
        let motion = Motion {
            q: &q,
            v: &rest,
            a: &rest,
        };
        [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(|weights| {
            let mut matrix = self.band();
            self.tangent(0.0, motion, &rest, weights, &mut matrix);
            matrix
        })
    }

    /// Whether mass and joints never change.
    pub fn has_constant_mass(&self) -> bool {
        self.bodies.iter().all(|(_, body)| body.has_constant_mass())
    }

    fn part<'a>(&self, body: usize, x: &'a [f64]) -> &'a [f64] {
        let (offset, body) = &self.bodies[body];
        &x[*offset..offset + body.coordinates()]
    }

    /// Position of a marker, m.
    pub fn position(&self, at: BodyMarker, q: &[f64]) -> Vector {
        self.bodies[at.body]
            .1
            .position(at.marker, self.part(at.body, q))
    }

    /// Elastic energy, J.
    #[cfg(test)]
    pub fn strain_energy(&self, q: &[f64]) -> f64 {
        let bodies = self.bodies.iter().enumerate();
        bodies
            .map(|(i, (_, body))| body.strain_energy(self.part(i, q)))
            .sum()
    }

    /// Fills the rows of a joint and says how many there are.
    fn rows_of(&mut self, joint: usize, q: &[f64]) -> usize {
        let joint = self.joints[joint].1;
        let mut rows = std::mem::take(&mut self.rows);
        rows.iter_mut().for_each(Vec::clear);
        let mut point = |system: &mut Self, at: BodyMarker, sign: f64| {
            let mut columns = std::mem::take(&mut system.columns);
            columns.clear();
            let (offset, made) = &system.bodies[at.body];
            made.columns(at.marker, system.part(at.body, q), &mut columns);
            for (i, by) in &columns {
                for d in 0..2 {
                    rows[d].push((offset + i, sign * by[d]));
                }
            }
            system.columns = columns;
        };
        match joint {
            Joint::Pin { at, to } => {
                point(self, at, 1.0);
                if let To::Body(other) = to {
                    point(self, other, -1.0);
                }
            }
            Joint::Guide { at, .. } => {
                point(self, at, 1.0);
                rows.swap(0, 1);
            }
            Joint::Drive { at, .. } => {
                let (offset, body) = &self.bodies[at.body];
                rows[0].extend(
                    body.angle(at.marker)
                        .iter()
                        .map(|(i, by)| (offset + i, *by)),
                );
            }
        }
        self.rows = rows;
        joint.rows()
    }

    /// What is missing in a joint.
    fn gap(&self, joint: Joint, time: f64, q: &[f64]) -> Vector {
        match joint {
            Joint::Pin { at, to } => {
                let other = match to {
                    To::Ground(point) => point,
                    To::Body(other) => self.position(other, q),
                };
                plus(self.position(at, q), -1.0, other)
            }
            Joint::Guide { at, height } => [self.position(at, q)[1] - height, 0.0],
            Joint::Drive { at, angle } => {
                let (offset, body) = &self.bodies[at.body];
                let terms = body.angle(at.marker);
                let found: f64 = terms.iter().map(|(i, by)| by * q[offset + i]).sum();
                [found - angle(time)[0], 0.0]
            }
        }
    }

    /// Second derivative of that, where coordinates do not accelerate.
    fn bias(&self, joint: Joint, time: f64, q: &[f64], v: &[f64]) -> Vector {
        let of = |at: BodyMarker| {
            let [q, v] = [q, v].map(|all| self.part(at.body, all));
            self.bodies[at.body].1.bias(at.marker, q, v)
        };
        match joint {
            Joint::Pin {
                at,
                to: To::Ground(_),
            } => of(at),
            Joint::Pin {
                at,
                to: To::Body(other),
            } => plus(of(at), -1.0, of(other)),
            Joint::Guide { at, .. } => [of(at)[1], 0.0],
            Joint::Drive { angle, .. } => [-angle(time)[2], 0.0],
        }
    }

    /// Computes the residual of the equations of motion with multipliers, followed by the gaps of joints.
    pub fn residual(&mut self, time: f64, motion: Motion<'_>, multipliers: &[f64], r: &mut [f64]) {
        self.forces(time, motion, r);
        for j in 0..self.joints.len() {
            let (first, joint) = self.joints[j];
            let gap = self.gap(joint, time, motion.q);
            for k in 0..self.rows_of(j, motion.q) {
                r[first + k] = gap[k];
                for (i, by) in &self.rows[k] {
                    r[*i] += by * multipliers[first + k];
                }
            }
        }
    }

    fn forces(&mut self, time: f64, motion: Motion<'_>, r: &mut [f64]) {
        r.fill(0.0);
        for (offset, body) in &self.bodies {
            let own = *offset..offset + body.coordinates();
            let part = Motion {
                q: &motion.q[own.clone()],
                v: &motion.v[own.clone()],
                a: &motion.a[own.clone()],
            };
            body.residual(part, self.gravity, &mut r[own]);
        }
        for load in &self.loads {
            let [x, y, moment] = (load.value)(time);
            let BodyMarker { body, marker } = load.at;
            let (offset, made) = &self.bodies[body];
            let mut columns = std::mem::take(&mut self.columns);
            columns.clear();
            made.columns(marker, self.part(body, motion.q), &mut columns);
            for (i, by) in &columns {
                r[offset + i] -= by[0] * x + by[1] * y;
            }
            self.columns = columns;
            if moment != 0.0 {
                for (i, by) in made.angle(marker) {
                    r[offset + i] -= by * moment;
                }
            }
        }
    }

    /// `w_0 dR/dq + w_1 dR/dv + w_2 dR/da` and the joints, whose multipliers count `w_0` times.
    pub fn tangent(
        &mut self,
        time: f64,
        motion: Motion<'_>,
        multipliers: &[f64],
        weights: [f64; 3],
        band: &mut Band,
    ) {
        band.clear();
        for (offset, body) in &self.bodies {
            let own = *offset..offset + body.coordinates();
            let part = Motion {
                q: &motion.q[own.clone()],
                v: &motion.v[own.clone()],
                a: &motion.a[own],
            };
            let mut block = Block {
                band,
                offset: *offset,
            };
            body.tangent(part, self.gravity, weights, &mut block);
        }
        if weights[0] != 0.0 {
            for load in &self.loads {
                let [x, y, _] = (load.value)(time);
                self.add_bend(load.at, motion.q, [-weights[0] * x, -weights[0] * y], band);
            }
        }
        for j in 0..self.joints.len() {
            let (first, joint) = self.joints[j];
            for k in 0..self.rows_of(j, motion.q) {
                for (i, by) in &self.rows[k] {
                    band.add(first + k, *i, *by);
                    band.add(*i, first + k, *by);
                }
            }
            let force = |k: usize| weights[0] * multipliers[first + k];
            match joint {
                _ if weights[0] == 0.0 => {}
                Joint::Pin { at, to } => {
                    self.add_bend(at, motion.q, [force(0), force(1)], band);
                    if let To::Body(other) = to {
                        self.add_bend(other, motion.q, [-force(0), -force(1)], band);
                    }
                }
                Joint::Guide { at, .. } => self.add_bend(at, motion.q, [0.0, force(0)], band),
                Joint::Drive { .. } => {}
            }
        }
    }

    fn add_bend(&self, at: BodyMarker, q: &[f64], force: Vector, band: &mut Band) {
        let (offset, made) = &self.bodies[at.body];
        let mut block = Block {
            band,
            offset: *offset,
        };
        made.bend(at.marker, self.part(at.body, q), force, &mut block);
    }

    /// Accelerations, multipliers in their places, by a factored `[M J^T; J 0]` that is made again where it changes.
    pub fn acceleration(
        &mut self,
        time: f64,
        q: &[f64],
        v: &[f64],
        factors: &mut Factors,
        a: &mut [f64],
    ) {
        factors.rest.resize(q.len(), 0.0);
        let rest = std::mem::take(&mut factors.rest);
        let motion = Motion { q, v, a: &rest };
        if !(factors.made && self.has_constant_mass()) {
            self.tangent(time, motion, &rest, [0.0, 0.0, 1.0], &mut factors.band);
            factors.made = factors.band.factor().is_some();
        }
        self.forces(time, motion, a);
        a.iter_mut().for_each(|a| *a = -*a);
        for (first, joint) in &self.joints {
            let bias = self.bias(*joint, time, q, v);
            for k in 0..joint.rows() {
                a[first + k] = -bias[k];
            }
        }
        factors.rest = rest;
        factors.band.solve(a);
    }
}

/// A factored mass with joints.
pub struct Factors {
    band: Band,
    made: bool,
    rest: Vec<f64>,
}

impl Factors {
    /// None yet.
    pub fn new(system: &System) -> Self {
        Self {
            band: system.band(),
            made: false,
            rest: Vec::new(),
        }
    }
}

//! What integrators and static equilibrium see of a system: `q'' = a(t, q, q')` with identity inertia,
//! and solves with its tangent. They know neither bodies nor joints nor loads.

use nalgebra::Complex;

use super::joints::{ConstraintKind, View};
use super::loads::Instant;
use super::signal::{Course, Drive};
use super::{Constraints, PlanarChain, State, System, Work};
use crate::body::Node;
use crate::elements::Element;

/// A second-order system with identity inertia, `q'' = a(t, q, q')`, with `K = -da/dq` and
/// `R = -da/dq'`.
pub trait Dynamics {
    /// Acceleration `a(t, q, v)`.
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]);
    /// Power that came in from outside and that was dissipated at the last acceleration, W.
    fn power(&self) -> [f64; 2];
    /// Computes `K` and `R` at a state, for the calls below.
    fn linearize(&mut self, time: f64, q: &[f64], v: &[f64]);
    /// Factors `s^2 I + s R + K` for a real `s`; false when it is not positive definite.
    fn factor(&mut self, s: f64) -> bool;
    /// Factors `s^2 I + s R + K` for a complex `s`; false when it is singular.
    fn factor_complex(&mut self, s: Complex<f64>) -> bool;
    /// Solves in place with the real factors.
    fn solve(&mut self, x: &mut [f64]);
    /// Remembers the configuration of the last acceleration as that of one of three stages.
    fn set_stage(&mut self, stage: usize);
    /// Solves for three stages in place: `forward` takes the right-hand sides to one for the real
    /// factors and two for the complex ones, `back` takes the solutions to the stages. The tangent may
    /// be turned along to the configurations set before, so the result is exact only to first order in
    /// the way from the linearization.
    fn solve_stages(
        &mut self,
        forward: &[[f64; 3]; 3],
        back: &[[f64; 3]; 3],
        stages: &mut [Vec<f64>; 3],
    );
    /// `R x`, in place.
    fn apply_damping(&mut self, x: &mut [f64]);
    /// Largest rotation of any direction, rad, and change of any stretch between two configurations.
    fn largest_turn(&mut self, from: &[f64], to: &[f64]) -> f64;
    /// Told of every accepted step: brings the state back to the constraints and counts turns on.
    fn accepted(&mut self, state: &mut State) -> Accepted;
    /// Times that no step may lead across, s, increasing.
    fn breaks(&self) -> &[f64];
}

/// What became of an accepted state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accepted {
    /// It stands.
    AsIs,
    /// It was brought back to the constraints.
    Moved,
    /// A slide has left its cable; the joint.
    RanOff(usize),
    /// It is off the constraints and cannot be brought back.
    Broken,
}

/// Residual of positions, relative, beyond which constraints count as broken.
const BROKEN: f64 = 1e-8;

/// A system under held inputs.
#[derive(Debug)]
pub struct Model<'a> {
    /// The system.
    pub system: &'a System,
    /// Its inputs.
    pub inputs: &'a [f64],
    /// Fraction of gravity and of loads that are not inputs: 1 but for load steps.
    pub fraction: f64,
    /// Scratch of the system.
    pub work: &'a mut Work,
    time: f64,
}

impl<'a> Model<'a> {
    /// The system at a state, what inputs drive held.
    pub fn new(system: &'a System, inputs: &'a [f64], work: &'a mut Work, state: &State) -> Self {
        work.follow(state);
        Self {
            system,
            inputs,
            fraction: 1.0,
            work,
            time: state.time,
        }
    }

    /// What inputs drive moves to where they say by `until`.
    pub fn until(self, state: &State, until: f64) -> Self {
        let h = until - state.time;
        let mut drives = self.system.drives.iter().filter_map(|drive| match drive {
            Drive::Input { first, derivatives } => Some(*first..first + derivatives + 1),
            Drive::Function(_) => None,
        });
        if h > 0.0 {
            for (course, driven) in self.work.courses.iter_mut().zip(&state.driven) {
                let range = drives.next().unwrap_or(0..0);
                *course = Course::new(state.time, h, *driven, &self.inputs[range]);
            }
        }
        self
    }

    fn place(&mut self, time: f64, q: &[f64], v: &[f64]) {
        self.time = time;
        let rates = self.system.is_damped || self.system.needs_rates;
        let v = rates.then_some(v);
        self.system.place(time, q, v, self.work);
    }

    /// Potential at `to` less that at `from` (strain energy, gravity, springs, loads as they are), J, and
    /// the size of the terms it is summed from.
    pub fn potential_difference(&mut self, from: &[f64], to: &[f64]) -> (f64, f64) {
        let (system, time) = (self.system, self.time);
        system.place(time, to, None, self.work);
        self.work.other.copy_from_slice(&self.work.x);
        system.place(time, from, None, self.work);
        let (before, after) = (&self.work.x, &self.work.other);
        let (mut sum, mut size) = (0.0, 0.0);
        let mut add = |energy: f64, scale: f64| {
            sum += energy;
            size += scale;
        };
        // Differences element by element: the sums of both energies would cancel.
        for chain in &system.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                let [now, then] = [after, before].map(|x| element.energy(&chain.element(j, x)));
                add(now - then, now + then);
            }
        }
        for (weight, (a, b)) in system.weight.iter().zip(after.iter().zip(before)) {
            let fall: f64 = (0..4).map(|k| weight[k] * (a[k] - b[k])).sum();
            add(-self.fraction * fall, (self.fraction * fall).abs());
        }
        let (start, end) = (self.instant(before), self.instant(after));
        for load in &system.loads {
            let work = load.work(start, end);
            add(-work, work.abs());
        }
        if system.rotation != 0.0 {
            let difference = system.centrifugal(after) - system.centrifugal(before);
            add(-difference, difference.abs());
        }
        (sum, size)
    }

    fn instant<'b>(&'b self, x: &'b [Node<4>]) -> Instant<'b> {
        Instant {
            x,
            ..self.system.instant(self.time, self.inputs, self.work)
        }
    }

    /// Brings a state onto the constraints; false where that fails.
    pub fn project(&mut self, state: &mut State) -> bool {
        if self.system.constraints.is_empty() {
            return true;
        }
        let (system, time) = (self.system, state.time);
        let q = &mut state.coordinates;
        let residual = system.project_positions(time, q, self.work);
        if residual.is_nan() || residual > BROKEN {
            return false;
        }
        system.project_velocities(&mut state.rates, self.work);
        true
    }

    /// Counts angles on, follows slides and driven motions.
    pub fn count(&mut self, state: &mut State) -> Accepted {
        let system = self.system;
        for (driven, course) in state.driven.iter_mut().zip(&self.work.courses) {
            *driven = course.derivatives(state.time);
        }
        if state.angles.is_empty() && state.travel.is_empty() {
            return Accepted::AsIs;
        }
        system.place(state.time, &state.coordinates, None, self.work);
        for (i, angle) in system.angles.iter().enumerate() {
            state.angles[i] = angle.value(&self.work.x, self.work.angles[i]);
        }
        self.work.angles.copy_from_slice(&state.angles);
        state.travel.copy_from_slice(&self.work.travel);
        for (constraint, travel) in system.slides.iter().zip(&state.travel) {
            let constraint = &system.constraints[*constraint];
            let ConstraintKind::Along(along) = &constraint.kind else {
                continue;
            };
            let length = system.chains[along.chain].length();
            if !(-1e-9 * length..=length * (1.0 + 1e-9)).contains(travel) {
                return Accepted::RanOff(constraint.joint.unwrap_or(0));
            }
        }
        Accepted::AsIs
    }
}

impl Dynamics for Model<'_> {
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        let system = self.system;
        if system.method == Constraints::Partitioning && !system.constraints.is_empty() {
            let (mut p, mut u) = (
                std::mem::take(&mut self.work.p),
                std::mem::take(&mut self.work.u),
            );
            p.copy_from_slice(q);
            u.copy_from_slice(v);
            system.project_positions(time, &mut p, self.work);
            system.project_velocities(&mut u, self.work);
            self.place(time, &p, &u);
            self.work.p = p;
            self.work.u = u;
        } else {
            self.place(time, q, v);
        }
        system.forces(time, self.inputs, self.fraction, self.work);
        system.reduce(self.work, a);
        if !system.constraints.is_empty() {
            system.constrain(self.work, a);
        }
        if system.tracks_work {
            self.work.power = system.powers(time, self.inputs, a, self.work);
        }
    }

    fn power(&self) -> [f64; 2] {
        self.work.power
    }

    fn linearize(&mut self, time: f64, q: &[f64], v: &[f64]) {
        let system = self.system;
        if !system.constraints.is_empty() {
            // Multipliers stiffen, and the border needs the Jacobian here.
            let mut a = std::mem::take(&mut self.work.p);
            self.acceleration(time, q, v, &mut a);
            self.work.p = a;
        } else {
            self.place(time, q, v);
        }
        system.assemble(time, self.inputs, self.work);
    }

    fn factor(&mut self, s: f64) -> bool {
        self.work.tangent.factor(&self.system.elimination, s)
    }

    fn factor_complex(&mut self, s: Complex<f64>) -> bool {
        let elimination = &self.system.elimination;
        self.work.tangent.factor_complex(elimination, s)
    }

    fn solve(&mut self, x: &mut [f64]) {
        self.work.tangent.solve(&self.system.elimination, x);
    }

    fn set_stage(&mut self, stage: usize) {
        let Work { tangent, x, .. } = &mut *self.work;
        let assembly = &self.system.elimination.assembly;
        tangent.stages.set(assembly, stage, x);
    }

    fn solve_stages(
        &mut self,
        forward: &[[f64; 3]; 3],
        back: &[[f64; 3]; 3],
        stages: &mut [Vec<f64>; 3],
    ) {
        let elimination = &self.system.elimination;
        self.work
            .tangent
            .solve_stages(elimination, (forward, back), stages);
    }

    fn apply_damping(&mut self, x: &mut [f64]) {
        self.work.tangent.apply_damping(&self.system.elimination, x);
    }

    fn largest_turn(&mut self, from: &[f64], to: &[f64]) -> f64 {
        let (system, time) = (self.system, self.time);
        system.place(time, from, None, self.work);
        self.work.other.copy_from_slice(&self.work.x);
        system.place(time, to, None, self.work);
        let mut largest = 0.0_f64;
        for (a, b) in self.work.other.iter().zip(&self.work.x) {
            let (along, across) = (a[2] * b[2] + a[3] * b[3], a[2] * b[3] - a[3] * b[2]);
            let stretch = b[2].hypot(b[3]) / a[2].hypot(a[3]);
            largest = largest
                .max(across.atan2(along).abs())
                .max(stretch.ln().abs());
        }
        largest
    }

    fn accepted(&mut self, state: &mut State) -> Accepted {
        if self.system.constraints.is_empty() {
            return self.count(state);
        }
        if !self.project(state) {
            return Accepted::Broken;
        }
        if self.system.method == Constraints::Partitioning {
            self.system.select(self.work);
        }
        match self.count(state) {
            Accepted::AsIs => Accepted::Moved,
            other => other,
        }
    }

    fn breaks(&self) -> &[f64] {
        &self.system.breaks
    }
}

impl System {
    /// Puts the nodal coordinates and, if given, rates of a state into `work`.
    pub(super) fn place(&self, time: f64, q: &[f64], v: Option<&[f64]>, work: &mut Work) {
        let mut courses = work.courses.iter();
        for (value, drive) in work.drives.iter_mut().zip(&self.drives) {
            *value = match drive {
                Drive::Function(function) => function.derivatives(time),
                Drive::Input { .. } => {
                    let course = courses.next();
                    course.map_or([0.0; 3], |course| course.derivatives(time))
                }
            };
        }
        self.elimination.expand(q, &mut work.y, &mut work.x);
        for (x, reference) in work.x.iter_mut().zip(&self.reference) {
            for k in 0..4 {
                x[k] += reference[k];
            }
        }
        self.follow(&work.drives, 0, &mut work.x);
        for (i, constraint) in self.slides.iter().enumerate() {
            if let ConstraintKind::Along(along) = &self.constraints[*constraint].kind {
                let chain: &PlanarChain = &self.chains[along.chain];
                work.travel[i] = along.travel(chain, &work.x, work.travel[i]);
            }
        }
        if let Some(v) = v {
            self.place_rates(v, work);
        }
    }

    /// Puts nodal rates into `work`; what drives them is that of the last [`System::place`].
    pub(super) fn place_rates(&self, v: &[f64], work: &mut Work) {
        self.elimination.expand(v, &mut work.y, &mut work.v);
        self.follow(&work.drives, 1, &mut work.v);
    }

    /// Adds what nodes follow of driven rows: coordinates, rates (`order` 1) or accelerations (2).
    pub(super) fn follow(&self, drives: &[[f64; 3]], order: usize, out: &mut [Node<4>]) {
        for driven in &self.driven {
            let mut value = self.linear[driven.row].target.derivatives(drives)[order];
            if order == 0 {
                value -= driven.reference;
            }
            add(&driven.follow, value, out);
        }
    }

    pub(super) fn instant<'a>(
        &'a self,
        time: f64,
        inputs: &'a [f64],
        work: &'a Work,
    ) -> Instant<'a> {
        Instant {
            time,
            inputs,
            x: &work.x,
            v: &work.v,
            chains: &self.chains,
            angles: (&self.angles, &work.angles),
        }
    }

    /// Total force on the nodes in `work`, but for constraints.
    pub(super) fn forces(&self, time: f64, inputs: &[f64], fraction: f64, work: &mut Work) {
        let mut force = std::mem::take(&mut work.f);
        for (f, weight) in force.iter_mut().zip(&self.weight) {
            *f = weight.map(|w| w * fraction);
        }
        for chain in &self.chains {
            chain.add_force(&work.x, &work.v, &mut force);
        }
        let at = self.instant(time, inputs, work);
        for load in &self.loads {
            load.add_force(at, &mut force);
        }
        if self.rotation != 0.0 {
            let rate = self.rotation;
            self.add_inertia(rate * rate, &work.x, &mut force);
            for (turned, v) in work.other.iter_mut().zip(&work.v) {
                *turned = [-v[1], v[0], -v[3], v[2]];
            }
            self.add_inertia(-2.0 * rate, &work.other, &mut force);
        }
        work.f = force;
    }

    /// Generalized forces `T^T (f - M G c'')` of the nodal forces in `work`, which stay.
    fn reduce(&self, work: &mut Work, a: &mut [f64]) {
        let change = |sign: f64, work: &mut Work| {
            for driven in &self.driven {
                let second = self.linear[driven.row].target.derivatives(&work.drives)[2];
                add(&driven.inertia, sign * second, &mut work.f);
            }
        };
        change(-1.0, work);
        self.elimination.reduce(&work.f, &mut work.y, a);
        change(1.0, work);
    }

    /// Tangent at the state in `work`, with the multipliers of its last acceleration.
    fn assemble(&self, time: f64, inputs: &[f64], work: &mut Work) {
        let assembly = &self.elimination.assembly;
        let Work { tangent, x, v, .. } = work;
        let (drives, travel, angles) = (&work.drives, &work.travel, &work.angles);
        tangent.stages.set_base(x);
        tangent.clear();
        let (stiffness, damping) = (&mut tangent.stiffness, &mut tangent.damping);
        for chain in &self.chains {
            chain.add_tangent((x, v), assembly, stiffness, damping);
        }
        let at = Instant {
            time,
            inputs,
            x,
            v,
            chains: &self.chains,
            angles: (&self.angles, angles),
        };
        for load in &self.loads {
            load.add_tangent(
                at,
                &mut |a, b, block| assembly.add(a, b, block, stiffness),
                &mut |a, b, block| assembly.add(a, b, block, damping),
            );
        }
        if self.rotation != 0.0 {
            let square = self.rotation * self.rotation;
            let pairs = stiffness
                .values
                .iter_mut()
                .zip(&self.elimination.mass.values);
            pairs.for_each(|(k, m)| *k -= square * m);
        }
        let view = View {
            x,
            v,
            drives,
            chains: &self.chains,
            travel,
        };
        for (i, group) in work.groups.iter().enumerate() {
            for (constraint, lambda) in group.multiplied(&self.constraints) {
                constraint.stiffness(lambda, &view, &mut |a, b, block| {
                    assembly.add(a, b, block, &mut tangent.stiffness);
                });
            }
            tangent.set_border(&self.elimination, i, &group.rows);
        }
    }

    /// Forces that linear constraints supply at accelerations `a`, over the nodes, into `work.supply`:
    /// `M x'' - f + J^T lambda`; nodal accelerations into `work.other`.
    pub(super) fn supply(&self, a: &[f64], work: &mut Work) {
        self.elimination.expand(a, &mut work.y, &mut work.other);
        self.follow(&work.drives, 2, &mut work.other);
        for (supply, f) in work.supply.iter_mut().zip(&work.f) {
            *supply = f.map(|f| -f);
        }
        self.add_inertia(1.0, &work.other, &mut work.supply);
        let mut supply = std::mem::take(&mut work.supply);
        let view = self.view(work);
        for group in &work.groups {
            for (constraint, lambda) in group.multiplied(&self.constraints) {
                constraint.gradient(&view).for_each(|node, term| {
                    add(&[(node, *term)], lambda, &mut supply);
                });
            }
        }
        work.supply = supply;
    }

    /// Power that comes in through loads and motions and that is dissipated, W, at the state and
    /// accelerations in place.
    fn powers(&self, time: f64, inputs: &[f64], a: &[f64], work: &mut Work) -> [f64; 2] {
        let mut power = [0.0; 2];
        if !self.drives.is_empty() {
            self.supply(a, work);
            for driven in &self.driven {
                let rate = self.linear[driven.row].target.derivatives(&work.drives)[1];
                let multiplier: f64 = (driven.follow.iter())
                    .map(|(node, c)| (0..4).map(|k| c[k] * work.supply[*node][k]).sum::<f64>())
                    .sum();
                power[0] += multiplier * rate;
            }
            let view = self.view(work);
            for group in &work.groups {
                for (constraint, lambda) in group.multiplied(&self.constraints) {
                    power[0] += lambda * constraint.rate(&view);
                }
            }
        }
        let at = self.instant(time, inputs, work);
        for load in &self.loads {
            let [supplied, dissipated] = load.power(at);
            power[0] += supplied;
            power[1] += dissipated;
        }
        for chain in &self.chains {
            power[1] += chain.dissipation(&work.x, &work.v);
        }
        power
    }

    /// Energy of the centrifugal force in a turning frame, negative, J.
    pub(super) fn centrifugal(&self, x: &[Node<4>]) -> f64 {
        let mut sum = 0.0;
        for chain in &self.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                let e = chain.element(j, x);
                sum += (e * element.mass()).dot(&e);
            }
        }
        for lump in &self.lumps {
            sum += lump.mass * lump.marker.position(x).norm_squared()
                + lump.inertia * lump.marker.direction(x).norm_squared();
        }
        0.5 * self.rotation * self.rotation * sum
    }
}

fn add(terms: &[(usize, Node<4>)], factor: f64, out: &mut [Node<4>]) {
    for (node, term) in terms {
        for k in 0..4 {
            out[*node][k] += factor * term[k];
        }
    }
}

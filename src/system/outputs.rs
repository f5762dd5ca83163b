//! Quantities that follow from a state.

use nalgebra::Vector2;

use super::joints::View;
use super::loads::{Instant, Load};
use super::{Dynamics, Model, State, System, Work};
use crate::body::{Marker, Node};
use crate::elements::{Element, Nodal};
use crate::math::vector::dot;

/// Coordinates, rates, accelerations and what constraints supply, of all nodes at one state.
#[derive(Clone, Debug)]
pub struct Evaluation {
    time: f64,
    /// Coordinates, m.
    pub x: Vec<Node<4>>,
    /// Rates, m/s.
    pub v: Vec<Node<4>>,
    /// Accelerations, m/s^2.
    pub acceleration: Vec<Node<4>>,
    /// Forces that linear constraints supply, N.
    supply: Vec<Node<4>>,
    /// Multipliers of non-linear constraints.
    lambda: Vec<f64>,
    angles: Vec<f64>,
    travel: Vec<f64>,
    drives: Vec<[f64; 3]>,
    q: Vec<f64>,
}

impl Evaluation {
    /// Storage for a system.
    pub fn new(system: &System) -> Self {
        let zero = vec![[0.0; 4]; system.reference.len()];
        Self {
            time: 0.0,
            x: zero.clone(),
            v: zero.clone(),
            acceleration: zero.clone(),
            supply: zero,
            lambda: vec![0.0; system.constraints.len()],
            angles: vec![0.0; system.angles.len()],
            travel: vec![0.0; system.slides.len()],
            drives: vec![[0.0; 3]; system.drives.len()],
            q: vec![0.0; system.coordinates()],
        }
    }

    /// Computes coordinates and rates.
    pub fn kinematics(&mut self, system: &System, state: &State, work: &mut Work) {
        work.follow(state);
        self.time = state.time;
        system.place(state.time, &state.coordinates, Some(&state.rates), work);
        self.x.copy_from_slice(&work.x);
        self.v.copy_from_slice(&work.v);
        self.angles.copy_from_slice(&work.angles);
        self.travel.copy_from_slice(&work.travel);
        self.drives.copy_from_slice(&work.drives);
    }

    /// Computes accelerations and what constraints supply.
    pub fn dynamics(&mut self, system: &System, state: &State, inputs: &[f64], work: &mut Work) {
        let mut model = Model::new(system, inputs, work, state);
        model.acceleration(state.time, &state.coordinates, &state.rates, &mut self.q);
        system.supply(&self.q, work);
        self.acceleration.copy_from_slice(&work.other);
        self.supply.copy_from_slice(&work.supply);
        let multiplied = work
            .groups
            .iter()
            .flat_map(|g| g.multiplied(&system.constraints));
        for (lambda, (_, value)) in self.lambda.iter_mut().zip(multiplied) {
            *lambda = value;
        }
    }

    /// Axial strain and curvature (1/m) at a marker of a cable; zero elsewhere.
    pub fn strain(&self, system: &System, marker: &Marker) -> (f64, f64) {
        let at = system.element(marker);
        at.map_or((0.0, 0.0), |(chain, j, xi)| {
            let e = chain.element(j, &self.x);
            let element = &chain.elements()[j];
            (element.recovered_strain(&e, xi), element.strain(&e, xi).1)
        })
    }

    /// Axial force (N) and bending moment (N m) at a marker of a cable; zero elsewhere.
    pub fn section(&self, system: &System, marker: &Marker) -> (f64, f64) {
        let at = system.element(marker);
        at.map_or((0.0, 0.0), |(chain, j, xi)| {
            let (e, rate) = (chain.element(j, &self.x), chain.element(j, &self.v));
            chain.elements()[j].section(&e, &rate, xi)
        })
    }

    /// Force that the element before a node of a cable exerts on the one after it (report Eq. 14), N:
    /// what the one before lacks for equilibrium. Joints and point loads at the node count with what
    /// comes after. Zero at the first end.
    pub fn connectivity_force(
        &self,
        system: &System,
        inputs: &[f64],
        marker: &Marker,
    ) -> Vector2<f64> {
        let Some((chain, j, xi)) = system.element(marker) else {
            return Vector2::zeros();
        };
        let (element, right) = if xi < 0.5 {
            (j.wrapping_sub(1), 2)
        } else {
            (j, 2)
        };
        if element >= chain.elements().len() {
            return Vector2::zeros();
        }
        let (e, v) = (
            chain.element(element, &self.x),
            chain.element(element, &self.v),
        );
        let part = &chain.elements()[element];
        let mut lack: Nodal<2> = part.force(&e, &v);
        lack += system.gravity * part.weight().transpose();
        let mut inertia = chain.element(element, &self.acceleration);
        let rate = system.rotation;
        let turned = nalgebra::Matrix2::new(0.0, -1.0, 1.0, 0.0) * v;
        inertia += turned * (2.0 * rate) - e * (rate * rate);
        lack -= inertia * part.mass();
        let scale = part.length() / (part.weight()[0] + part.weight()[2]);
        for load in &system.loads {
            if let Load::Distributed(load) = load
                && std::ptr::eq(&system.chains[load.chain], chain)
            {
                let [a, b] = (load.components.each_ref()).map(|c| c.value(self.time, inputs));
                lack += Vector2::new(a, b) * part.weight().transpose() * scale;
            }
        }
        lack.column(right).into()
    }

    /// Force (N) and moment (N m) of a joint or motion on its second end.
    pub fn reaction(&self, system: &System, inputs: &[f64], joint: usize) -> (Vector2<f64>, f64) {
        let mut force = Vector2::zeros();
        let second = &system.joints[joint].ends[1];
        let u = second.direction(&self.x);
        let mut moment = 0.0;
        for (row, linear) in system.linear.iter().enumerate() {
            if linear.joint == Some(joint) {
                let lambda = system.row_multiplier(row, &self.supply);
                force += linear.on_second[0] * lambda;
                moment += u.perp(&(linear.on_second[1] * lambda));
            }
        }
        let (at, view) = (self.instant(system, inputs), self.view(system));
        for (constraint, lambda) in system.constraints.iter().zip(&self.lambda) {
            if constraint.joint == Some(joint) {
                let [position, direction] = constraint.gradient(&view).ends[1].1;
                force -= position * *lambda;
                moment -= u.perp(&(direction * *lambda));
            }
        }
        if let Some(load) = system.joints[joint].spring
            && let Load::Rotational(spring) = &system.loads[load]
        {
            moment += spring.moment(at);
        }
        (force, moment)
    }

    fn instant<'a>(&'a self, system: &'a System, inputs: &'a [f64]) -> Instant<'a> {
        Instant {
            time: self.time,
            inputs,
            x: &self.x,
            v: &self.v,
            chains: &system.chains,
            angles: (&system.angles, &self.angles),
        }
    }

    fn view<'a>(&'a self, system: &'a System) -> View<'a> {
        View {
            x: &self.x,
            v: &self.v,
            drives: &self.drives,
            chains: &system.chains,
            travel: &self.travel,
        }
    }

    /// Largest residual of non-linear constraints: of positions, relative to their size, and of
    /// velocities, relative to size over time, 1/s.
    pub fn residuals(&self, system: &System) -> [f64; 2] {
        let view = self.view(system);
        [
            system.position_residual(&view),
            system.velocity_residual(&view),
        ]
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy(&self, system: &System) -> f64 {
        let mut sum = 0.0;
        for chain in &system.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                let v = chain.element(j, &self.v);
                sum += (v * element.mass()).dot(&v);
            }
        }
        for lump in &system.lumps {
            sum += lump.mass * lump.marker.position(&self.v).norm_squared()
                + lump.inertia * lump.marker.direction(&self.v).norm_squared();
        }
        0.5 * sum
    }

    /// Strain energy, J.
    pub fn strain_energy(&self, system: &System) -> f64 {
        let chains = system.chains.iter();
        chains.map(|chain| chain.strain_energy(&self.x)).sum()
    }

    /// Energy in springs, J.
    pub fn spring_energy(&self, system: &System, inputs: &[f64]) -> f64 {
        let at = self.instant(system, inputs);
        system.loads.iter().map(|load| load.energy(at)).sum()
    }

    /// Potential energy of gravity, zero at the origin, and of the centrifugal force in a turning frame,
    /// J.
    pub fn gravity_energy(&self, system: &System) -> f64 {
        let falls = system.weight.iter().zip(&self.x).map(|(w, x)| dot(w, x));
        -falls.sum::<f64>()
            - if system.rotation == 0.0 {
                0.0
            } else {
                system.centrifugal(&self.x)
            }
    }

    /// Momentum (kg m/s) and angular momentum about the origin (kg m^2/s).
    pub fn momentum(&self, system: &System) -> (Vector2<f64>, f64) {
        let (mut linear, mut angular) = (Vector2::zeros(), 0.0);
        let mut add = |x: &[f64], p: [f64; 2], translates: bool| {
            if translates {
                linear += Vector2::from(p);
            }
            angular += x[0] * p[1] - x[1] * p[0];
        };
        for chain in &system.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                let x = chain.element(j, &self.x);
                let p = chain.element(j, &self.v) * element.mass();
                for k in 0..4 {
                    let part = [p[(0, k)], p[(1, k)]];
                    add(&[x[(0, k)], x[(1, k)]], part, k % 2 == 0);
                }
            }
        }
        for lump in &system.lumps {
            let (marker, m, j) = (&lump.marker, lump.mass, lump.inertia);
            let (x, d) = (marker.position(&self.x), marker.direction(&self.x));
            let (p, s) = (marker.position(&self.v) * m, marker.direction(&self.v) * j);
            add(x.as_slice(), [p.x, p.y], true);
            add(d.as_slice(), [s.x, s.y], false);
        }
        (linear, angular)
    }

    /// Center of mass, m.
    pub fn center_of_mass(&self, system: &System) -> Vector2<f64> {
        let mut sum = Vector2::zeros();
        for chain in &system.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                sum += chain.element(j, &self.x) * element.weight();
            }
        }
        for lump in &system.lumps {
            sum += lump.marker.position(&self.x) * lump.mass;
        }
        sum / system.mass()
    }
}

impl System {
    /// Chain, element and place inside it of a marker of a cable.
    fn element(&self, marker: &Marker) -> Option<(&super::PlanarChain, usize, f64)> {
        let (j, xi) = marker.element?;
        let first = self.bodies[marker.body].start;
        let chain = self.chains.iter().find(|c| c.nodes(0)[0] == first)?;
        Some((chain, j, xi))
    }

    /// Multiplier of a linear row from the forces that rows supply; zero for one that repeats others.
    fn row_multiplier(&self, row: usize, supply: &[Node<4>]) -> f64 {
        match self.holds[row] {
            Some((cluster, k)) => {
                let cluster = &self.elimination.assembly.clusters()[cluster];
                let column = cluster.multipliers.row(k);
                let nodes = cluster.nodes.iter().flat_map(|node| &supply[*node]);
                column.iter().zip(nodes).map(|(c, f)| c * f).sum()
            }
            None if self.elimination.assembly.clusters().is_empty() => {
                // As printed, rows are no clusters; they apply to one node each.
                let terms = &self.linear[row].row.terms;
                let sum: f64 = terms.iter().map(|(n, c)| dot(c, &supply[*n])).sum();
                sum / terms.iter().map(|(_, c)| dot(c, c)).sum::<f64>()
            }
            None => 0.0,
        }
    }
}

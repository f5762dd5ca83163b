//! Energy-momentum scheme: the midpoint rule with elastic forces that do exactly the work the strain
//! energy gains and, like it, do not change in translations and rotations: energy, momentum and angular
//! momentum are conserved but for what Newton's method leaves.
//!
//! At every quadrature point the energy is a function of the quadratic invariants `a = r'.r'` and
//! `b = r' ^ r''`, whose changes over a step are exact by their gradients at the midpoint; the difference
//! quotients of the energy by `a` and `b` are written out in closed form, so that none vanishes over
//! nothing.
//!
//! Source: O. Gonzalez, Comput. Methods Appl. Mech. Eng. 190 (2000) 1763-1783, sections 3 and 4 (discrete
//! gradient in invariants); J. C. Simo, N. Tarnow, Z. Angew. Math. Phys. 43 (1992) 757-792, Eqs. 3.10.
//!
//! The tangent is the symmetric one at the midpoint; the scheme's own is not symmetric. On stiff bodies the
//! iteration therefore converges at short steps only.

use std::sync::{Arc, Mutex};

use flexbody::bodies::{Elimination, Node, no_node};
use flexbody::elements::{Element, Nodal};
use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance};
use flexbody::math::quadrature::{BETWEEN_3, GAUSS_3, LOBATTO_3, QuadraturePoint};
use flexbody::scene::Strain;
use flexbody::system::Dynamics;
use nalgebra::Vector2;

use super::Build;
use super::newton::{Equation, Newton, size};
use crate::scene::Outcome;

/// Slenderness EA l^2 / EI from which the element takes Lobatto's points: as in `elements/cable.rs`.
const SLENDER: f64 = 200.0;

/// A cable element by its quadrature points.
pub struct Bar {
    nodes: [usize; 2],
    length: f64,
    axial_stiffness: f64,
    bending_stiffness: f64,
    strain: Strain,
    axial: &'static [QuadraturePoint; 3],
    natural_strain: [f64; 3],
    natural_curvature: [f64; 3],
}

type Vectors = [Vector2<f64>; 3];

/// Chord over length and slopes.
fn vectors(e: &Nodal<2>, length: f64) -> Vectors {
    let column = |i: usize| Vector2::from(e.column(i));
    [(column(2) - column(0)) / length, column(1), column(3)]
}

fn combine(weights: &[f64; 3], v: &Vectors) -> Vector2<f64> {
    v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2]
}

fn slope(point: &QuadraturePoint) -> [f64; 3] {
    let (at, square) = (point.at, point.at * point.at);
    let ends = [1.0 - 4.0 * at + 3.0 * square, 3.0 * square - 2.0 * at];
    [6.0 * (at - square), ends[0], ends[1]]
}

fn curvature(point: &QuadraturePoint, length: f64) -> [f64; 3] {
    let at = point.at;
    [6.0 - 12.0 * at, 6.0 * at - 4.0, 6.0 * at - 2.0].map(|c| c / length)
}

fn wedge(u: &Vector2<f64>, w: &Vector2<f64>) -> f64 {
    u.x * w.y - u.y * w.x
}

impl Bar {
    /// All elements of a system of cables.
    fn all(build: &Build<'_>) -> Vec<Self> {
        let start = build.start;
        let cables = start.scene.bodies.iter().filter_map(|body| body.flexible());
        let mut bars = Vec::new();
        for (cable, chain) in cables.zip(start.assembled.system.bodies().lines()) {
            for (j, element) in chain.elements().iter().enumerate() {
                let length = element.length();
                let axial_stiffness = cable.axial_stiffness_of(&cable.section_at(0.5));
                let bending_stiffness = cable.bending_stiffness();
                let slender = axial_stiffness * length * length > SLENDER * bending_stiffness;
                let mut bar = Self {
                    nodes: chain.nodes(j),
                    length,
                    axial_stiffness,
                    bending_stiffness,
                    strain: cable.strain,
                    axial: if slender { &LOBATTO_3 } else { &BETWEEN_3 },
                    natural_strain: [0.0; 3],
                    natural_curvature: [0.0; 3],
                };
                if !cable.shape.is_straight() {
                    let v = vectors(&chain.element(j, &start.assembled.nodes), length);
                    bar.natural_strain = bar.axial.each_ref().map(|p| {
                        let a = combine(&slope(p), &v).norm_squared();
                        bar.stretch(a)
                    });
                    bar.natural_curvature = GAUSS_3.each_ref().map(|p| {
                        let u = combine(&slope(p), &v);
                        wedge(&u, &combine(&curvature(p, length), &v))
                            * bar.shrink(u.norm_squared())
                    });
                }
                bars.push(bar);
            }
        }
        bars
    }

    /// Axial strain by `a`.
    fn stretch(&self, a: f64) -> f64 {
        match self.strain {
            Strain::GreenLagrangeFrenetKappa => 0.5 * (a - 1.0),
            _ => a.sqrt() - 1.0,
        }
    }

    /// Difference quotient of the axial strain.
    fn stretch_quotient(&self, a: [f64; 2]) -> f64 {
        match self.strain {
            Strain::GreenLagrangeFrenetKappa => 0.5,
            _ => 1.0 / (a[0].sqrt() + a[1].sqrt()),
        }
    }

    /// Curvature over `b`: a power of `a`.
    fn shrink(&self, a: f64) -> f64 {
        match self.strain {
            Strain::ThetaPrime => 1.0 / a,
            _ => 1.0 / (a * a.sqrt()),
        }
    }

    /// Its difference quotient.
    fn shrink_quotient(&self, a: [f64; 2]) -> f64 {
        let [r, s] = a.map(f64::sqrt);
        match self.strain {
            Strain::ThetaPrime => -1.0 / (a[0] * a[1]),
            _ => -(a[0] + r * s + a[1]) / ((r + s) * (r * s).powi(3)),
        }
    }

    /// Elastic force over a step from its two ends.
    fn force(&self, start: &Nodal<2>, end: &Nodal<2>) -> Nodal<2> {
        let (v0, v1) = (vectors(start, self.length), vectors(end, self.length));
        let middle: Vectors = std::array::from_fn(|i| (v0[i] + v1[i]) * 0.5);
        let mut sum = [Vector2::zeros(); 3];
        for (point, natural) in self.axial.iter().zip(self.natural_strain) {
            let weights = slope(point);
            let a = [&v0, &v1].map(|v| combine(&weights, v).norm_squared());
            let mean = 0.5 * (self.stretch(a[0]) + self.stretch(a[1])) - natural;
            let stress = self.axial_stiffness * mean * self.stretch_quotient(a);
            let gradient = combine(&weights, &middle) * (2.0 * stress * point.weight);
            for i in 0..3 {
                sum[i] += gradient * weights[i];
            }
        }
        for (point, natural) in GAUSS_3.iter().zip(self.natural_curvature) {
            let (s, c) = (slope(point), curvature(point, self.length));
            let ends = [&v0, &v1].map(|v| (combine(&s, v), combine(&c, v)));
            let a = ends.map(|(u, _)| u.norm_squared());
            let b = ends.map(|(u, w)| wedge(&u, &w));
            let shrink = a.map(|a| self.shrink(a));
            let mean = 0.5 * (b[0] * shrink[0] + b[1] * shrink[1]) - natural;
            let moment = self.bending_stiffness * mean * point.weight;
            let by_a = moment * 0.5 * (b[0] + b[1]) * self.shrink_quotient(a);
            let by_b = moment * 0.5 * (shrink[0] + shrink[1]);
            let (u, w) = (combine(&s, &middle), combine(&c, &middle));
            let by_u = u * (2.0 * by_a) + Vector2::new(w.y, -w.x) * by_b;
            let by_w = Vector2::new(-u.y, u.x) * by_b;
            for i in 0..3 {
                sum[i] += by_u * s[i] + by_w * c[i];
            }
        }
        let l = self.length;
        Nodal::from_columns(&[sum[0], -sum[1] * l, -sum[0], -sum[2] * l])
    }
}

fn element(nodes: [usize; 2], x: &[Node]) -> Nodal<2> {
    Nodal::from_column_slice(nodes.map(|node| x[node]).as_flattened().as_flattened())
}

/// Scratch of the method.
pub struct EnergyMomentum {
    bars: Vec<Bar>,
    elimination: Elimination,
    /// Where the dynamics leave nodal coordinates.
    nodes: Arc<Mutex<Vec<Node>>>,
    /// Nodal coordinates at the start of the step and at the midpoint.
    start: Vec<Node>,
    middle: Vec<Node>,
    force: Vec<Node>,
    y: Vec<f64>,
    extra: Vec<f64>,
    newton: Newton,
    a: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    per_time: f64,
}

impl EnergyMomentum {
    /// For a system of cables.
    pub fn new(build: &Build<'_>) -> Outcome<Self> {
        let system = &build.start.assembled.system;
        if build
            .start
            .scene
            .bodies
            .iter()
            .any(|body| body.flexible().is_none())
        {
            return Err("energy_momentum: expected cables, found a rigid body".into());
        }
        let n = system.coordinates();
        let (zero, nodes) = (
            vec![0.0; n],
            vec![no_node(); system.bodies().reference.len()],
        );
        Ok(Self {
            bars: Bar::all(build),
            elimination: system.elimination().clone(),
            nodes: build.nodes.clone(),
            start: nodes.clone(),
            middle: nodes.clone(),
            force: nodes,
            y: vec![0.0; system.elimination().scratch()],
            extra: zero.clone(),
            newton: Newton::new(n, false),
            a: zero.clone(),
            q: zero.clone(),
            v: zero,
            per_time: 0.0,
        })
    }

    fn placed(&self, into: &mut [Node]) {
        if let Ok(nodes) = self.nodes.lock() {
            into.copy_from_slice(&nodes);
        }
    }
}

struct Step<'a> {
    scheme: &'a mut EnergyMomentum,
    time: f64,
    rates: &'a [f64],
    tolerance: &'a Tolerance,
}

impl Equation for Step<'_> {
    fn residual(&mut self, dynamics: &mut dyn Dynamics, r: &mut [f64]) {
        let scheme = &mut *self.scheme;
        dynamics.acceleration(self.time, &scheme.q, &scheme.v, r);
        if let Ok(nodes) = scheme.nodes.lock() {
            scheme.middle.copy_from_slice(&nodes);
        }
        scheme.force.fill(no_node());
        for bar in &scheme.bars {
            let (start, middle) = (
                element(bar.nodes, &scheme.start),
                element(bar.nodes, &scheme.middle),
            );
            let end = middle * 2.0 - start;
            // The acceleration came with the force of the midpoint.
            let force = bar.force(&start, &end) - bar.force(&middle, &middle);
            for (half, node) in bar.nodes.iter().enumerate() {
                for k in 0..4 {
                    scheme.force[*node][k / 2][k % 2] += force[4 * half + k];
                }
            }
        }
        let (force, y) = (&scheme.force, &mut scheme.y);
        scheme.elimination.reduce(force, y, &mut scheme.extra);
        for i in 0..r.len() {
            r[i] += scheme.extra[i] - scheme.per_time * (scheme.v[i] - self.rates[i]);
        }
    }

    fn correct(&mut self, _: &mut dyn Dynamics, correction: &[f64]) -> f64 {
        let scheme = &mut *self.scheme;
        for i in 0..correction.len() {
            scheme.q[i] += correction[i];
            scheme.v[i] += scheme.per_time * correction[i];
        }
        2.0 * size(correction, scheme.per_time, self.tolerance)
    }

    fn linearize(&self, dynamics: &mut dyn Dynamics) {
        dynamics.linearize(self.time, &self.scheme.q, &self.scheme.v);
    }
}

impl OneStepMethod for EnergyMomentum {
    fn name(&self) -> &'static str {
        "energy_momentum"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
        let mut start = std::mem::take(&mut self.start);
        self.placed(&mut start);
        self.start = start;
        self.newton.reset();
    }

    fn refresh(&mut self, _: &mut dyn Dynamics, _: f64, _: &[f64], _: &[f64]) {}

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        self.per_time = 2.0 / h;
        for i in 0..q.len() {
            self.v[i] = v[i] + 0.5 * h * self.a[i];
            self.q[i] = q[i] + 0.5 * h * self.v[i];
        }
        let mut newton = std::mem::replace(&mut self.newton, Newton::new(0, false));
        let mut step = Step {
            scheme: self,
            time: time + 0.5 * h,
            rates: v,
            tolerance,
        };
        let outcome = newton.solve(dynamics, &mut step, [4.0 / (h * h), 2.0 / h]);
        self.newton = newton;
        if let Err(factor) = outcome {
            return Attempt::Failed(factor);
        }
        for i in 0..q.len() {
            self.q[i] = 2.0 * self.q[i] - q[i];
            self.v[i] = 2.0 * self.v[i] - v[i];
        }
        // Nodal coordinates at the end, from which the next step starts, and its first guess.
        dynamics.acceleration(time + h, &self.q, &self.v, &mut self.a);
        let mut start = std::mem::take(&mut self.start);
        self.placed(&mut start);
        self.start = start;
        Attempt::Done(1.0)
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }

    fn newton_iterations(&self) -> u64 {
        self.newton.iterations
    }
}

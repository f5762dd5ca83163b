//! A free rod that is thrown with bending and fast spin, by the classical Runge-Kutta method, with and without the force that a
//! spin about an axis that rotates makes on it.
//!
//! Source: a spin about the tangent is no rate of a coordinate; Lagrange's equations in it (Boltzmann and Hamel) have the force
//! `p (t x t') / |u|` on the slope, `p` the momentum of the spin. It does no work.

use flexbody::elements::shape;
use nalgebra::{DMatrix, DVector};

use super::Real3;
use super::hermite::{ALL, ELEMENT, NODE, Node, Rod, Section};
use super::statics::Line;
use crate::elements::rule::Rule;

/// Rod that is thrown, with its rotation.
#[derive(Clone, Copy, Debug)]
pub struct Thrown {
    /// Length, m.
    pub length: f64,
    /// Elements.
    pub elements: usize,
    /// Stiffness of the sections.
    pub section: Section,
    /// Mass (kg/m) and moment of inertia about the line (kg m) by length.
    pub inertia: [f64; 2],
    /// Angular velocity, rad/s.
    pub spin: Real3,
    /// Velocity on top at a length along it, and its derivative, m/s and 1/s.
    pub deformation: fn(f64) -> [Real3; 2],
    /// Whether the force is there.
    pub gyroscopic: bool,
}

/// Largest changes of the energy, relative to it, and of the angular momentum, relative to that.
#[derive(Clone, Copy, Debug)]
pub struct Changes {
    /// Change of the energy.
    pub energy: f64,
    /// Change of the angular momentum.
    pub momentum: f64,
}

/// A rod that moves.
#[derive(Clone, Debug)]
struct Moving {
    rod: Rod,
    /// Rates: of position, slope and rotation about the tangent of all nodes, of internal twists.
    rates: Vec<f64>,
}

struct Motion {
    thrown: Thrown,
    /// Of positions and slopes, kg, and of spins and rates of internal twists, kg m^2.
    mass: [DMatrix<f64>; 2],
    inverse: [DMatrix<f64>; 2],
}

impl Thrown {
    /// Moves until a time (s) in so many steps.
    pub fn run(&self, until: f64, steps: u32) -> Changes {
        let motion = Motion::new(*self);
        let mut moving = self.start();
        let (energy, momentum) = motion.invariants(&moving);
        let mut most = Changes {
            energy: 0.0,
            momentum: 0.0,
        };
        for _ in 0..steps {
            motion.step(until / f64::from(steps), &mut moving);
            let (now, turning) = motion.invariants(&moving);
            most.energy = most.energy.max((now / energy - 1.0).abs());
            let off = (turning - momentum).norm() / momentum.norm();
            most.momentum = most.momentum.max(off);
        }
        most
    }

    fn start(&self) -> Moving {
        let rod = Rod::straight(self.length, self.elements, self.section, ALL);
        let mut rates = Vec::new();
        for node in &rod.nodes {
            let [velocity, slope] = (self.deformation)(node.r.x);
            let own = [
                self.spin.cross(&node.r) + velocity,
                self.spin.cross(&node.u) + slope,
            ];
            rates.extend(own.iter().flatten());
            rates.push(self.spin.dot(&node.u));
        }
        rates.resize(rates.len() + self.elements, 0.0);
        Moving { rod, rates }
    }
}

/// A vector of the numbers of a node: position's (0) or slope's (3).
fn of(numbers: &[f64], node: usize, first: usize) -> Real3 {
    Real3::from_column_slice(&numbers[NODE * node + first..][..3])
}

impl Motion {
    fn new(thrown: Thrown) -> Self {
        let (n, l) = (thrown.elements, thrown.length / thrown.elements as f64);
        let [line, section] = thrown.inertia;
        let mut mass = [
            DMatrix::zeros(2 * (n + 1), 2 * (n + 1)),
            DMatrix::zeros(2 * n + 1, 2 * n + 1),
        ];
        for element in 0..n {
            for point in Rule::Gauss(4).points() {
                let (xi, weight) = (point.at, point.weight * l);
                let shapes = <[f64; 4]>::from(shape::values(xi, l));
                let spins = [1.0 - xi, xi, 4.0 * xi * (1.0 - xi)];
                let places = [element, element + 1, n + 1 + element];
                for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
                    let at = (2 * element + i, 2 * element + j);
                    mass[0][at] += line * weight * shapes[i] * shapes[j];
                }
                for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                    mass[1][(places[i], places[j])] += section * weight * spins[i] * spins[j];
                }
            }
        }
        let inverse = mass.each_ref().map(|mass| {
            let factor = mass.clone().cholesky();
            factor.expect("a positive mass").inverse()
        });
        Self {
            thrown,
            mass,
            inverse,
        }
    }

    /// Positions and slopes in rows, spins and rates of internal twists in a column.
    fn apart(&self, numbers: &[f64]) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.thrown.elements;
        let line = DMatrix::from_fn(2 * (n + 1), 3, |r, c| {
            numbers[NODE * (r / 2) + 3 * (r % 2) + c]
        });
        let sections = DVector::from_fn(2 * n + 1, |r, _| {
            if r <= n {
                numbers[NODE * r + 6]
            } else {
                numbers[NODE * (n + 1) + r - n - 1]
            }
        });
        (line, sections)
    }

    /// The inverse of [`Self::apart`].
    fn together(&self, line: &DMatrix<f64>, sections: &DVector<f64>) -> Vec<f64> {
        let n = self.thrown.elements;
        let mut numbers = Vec::new();
        for node in 0..=n {
            for row in [2 * node, 2 * node + 1] {
                numbers.extend(line.row(row).iter());
            }
            numbers.push(sections[node]);
        }
        numbers.extend(sections.rows(n + 1, n).iter());
        numbers
    }

    /// Momenta belonging to all rates.
    fn momenta(&self, rates: &[f64]) -> Vec<f64> {
        let (line, sections) = self.apart(rates);
        self.together(&(&self.mass[0] * line), &(&self.mass[1] * sections))
    }

    /// Energy, J, and angular momentum, N m s.
    fn invariants(&self, Moving { rod, rates }: &Moving) -> (f64, Real3) {
        let momenta = self.momenta(rates);
        let twice: f64 = rates.iter().zip(&momenta).map(|(v, p)| v * p).sum();
        let mut turning = Real3::zeros();
        for (k, node) in rod.nodes.iter().enumerate() {
            turning += node.r.cross(&of(&momenta, k, 0)) + node.u.cross(&of(&momenta, k, 3));
            turning += node.u.normalize() * momenta[NODE * k + 6];
        }
        (0.5 * twice + rod.energy(), turning)
    }

    fn accelerations(&self, Moving { rod, rates }: &Moving) -> Vec<f64> {
        let n = self.thrown.elements;
        let mut force = vec![0.0; rates.len()];
        for element in 0..n {
            let slopes = rod.slopes(element, &[0.0; ELEMENT]);
            for (k, slope) in slopes.iter().enumerate() {
                let at = if k < 2 * NODE {
                    NODE * element + k
                } else {
                    NODE * (n + 1) + element
                };
                force[at] -= slope;
            }
        }
        if self.thrown.gyroscopic {
            let momenta = self.momenta(rates);
            for (k, node) in rod.nodes.iter().enumerate() {
                let turn = node.u.cross(&of(rates, k, 3)) / node.u.norm().powi(3);
                for i in 0..3 {
                    force[NODE * k + 3 + i] += momenta[NODE * k + 6] * turn[i];
                }
            }
        }
        let (line, sections) = self.apart(&force);
        self.together(&(&self.inverse[0] * line), &(&self.inverse[1] * sections))
    }

    /// A step of the classical method.
    fn step(&self, h: f64, moving: &mut Moving) {
        let begin = moving.clone();
        let mut at = begin.clone();
        let mut sums = vec![[0.0; 2]; moving.rates.len()];
        let mut frames = vec![Real3::zeros(); moving.rod.nodes.len()];
        for (stage, weight) in [1.0, 2.0, 2.0, 1.0].into_iter().enumerate() {
            let rates = at.rates.clone();
            let accelerations = self.accelerations(&at);
            let turns = turns(&at);
            for (sum, (v, a)) in sums.iter_mut().zip(rates.iter().zip(&accelerations)) {
                *sum = [sum[0] + weight / 6.0 * v, sum[1] + weight / 6.0 * a];
            }
            for (sum, turn) in frames.iter_mut().zip(&turns) {
                *sum += turn * (weight / 6.0);
            }
            if let Some(part) = [0.5, 0.5, 1.0].get(stage) {
                at = begin.advanced(part * h, &rates, &accelerations, &turns);
            }
        }
        let [rates, accelerations]: [Vec<f64>; 2] =
            [0, 1].map(|k| sums.iter().map(|sum| sum[k]).collect());
        *moving = begin.advanced(h, &rates, &accelerations, &frames);
    }
}

/// Rates of the unit vectors of sections: they rotate with the tangent and about it.
fn turns(at: &Moving) -> Vec<Real3> {
    let turn = |(k, node): (usize, &Node)| {
        let (square, rate) = (node.u.norm_squared(), of(&at.rates, k, 3));
        let spin = node.u * (at.rates[NODE * k + 6] / square.sqrt());
        spin.cross(&node.d) - node.u * (node.d.dot(&rate) / square)
    };
    at.rod.nodes.iter().enumerate().map(turn).collect()
}

impl Moving {
    fn advanced(&self, h: f64, rates: &[f64], accelerations: &[f64], frames: &[Real3]) -> Self {
        let mut at = self.clone();
        for (rate, change) in at.rates.iter_mut().zip(accelerations) {
            *rate += h * change;
        }
        for (k, node) in at.rod.nodes.iter_mut().enumerate() {
            node.r += of(rates, k, 0) * h;
            node.u += of(rates, k, 3) * h;
            let t = node.u.normalize();
            let d = node.d + frames[k] * h;
            node.d = (d - t * t.dot(&d)).normalize();
        }
        let first = NODE * at.rod.nodes.len();
        for (bubble, rate) in at.rod.bubbles.iter_mut().zip(&rates[first..]) {
            *bubble += h * rate;
        }
        at
    }
}

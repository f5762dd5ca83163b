//! Large rotation vector: positions and rotations of cross sections are interpolated apart from each other; the beam
//! stretches, shears and bends.
//!
//! Source: J. C. Simo, L. Vu-Quoc, On the dynamics of flexible beams under large overall motions - the plane case,
//! J. Appl. Mech. 53 (1986) 849-863 (strains, constant mass); reduced integration against locking: J. C. Simo,
//! L. Vu-Quoc, A three-dimensional finite-strain rod model, Part II, Comput. Methods Appl. Mech. Eng. 58 (1986) 79-116,
//! section 5.

use super::scenes::Rod;
use super::{Block, Body, Columns, Marker, Motion, Node, Placement, Vector, dot, plus};
use crate::elements::rule::Rule;

/// Degree of the interpolation and points of the strain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interpolation {
    /// 1 or 2.
    pub degree: usize,
    /// As many Gauss points as the degree where reduced, one more where full.
    pub reduced: bool,
}

/// Largest number of nodes of an element.
const MOST: usize = 3;

/// Values and slopes of the shape functions at a point, and its weight times the length, m.
struct Point {
    n: [f64; MOST],
    d: [f64; MOST],
    weight: f64,
}

/// A chain of equal elements; three coordinates a node: position and angle.
pub struct Rotations {
    rod: Rod,
    elements: usize,
    degree: usize,
    points: Vec<Point>,
    /// Integrals of products of two shape functions over an element, m.
    products: [[f64; MOST]; MOST],
}

impl Rotations {
    /// Builds the body of a rod.
    pub fn new(rod: Rod, elements: usize, interpolation: Interpolation) -> Self {
        let degree = interpolation.degree;
        let length = rod.length / elements as f64;
        let made = |count: usize| -> Vec<Point> {
            let rule = Rule::Gauss(count).points();
            let point = |p: &crate::elements::rule::Point| shape(degree, p.at, p.weight, length);
            rule.iter().map(point).collect()
        };
        let mut products = [[0.0; MOST]; MOST];
        for point in made(degree + 1) {
            for i in 0..=degree {
                for j in 0..=degree {
                    products[i][j] += point.weight * point.n[i] * point.n[j];
                }
            }
        }
        Self {
            rod,
            elements,
            degree,
            points: made(if interpolation.reduced {
                degree
            } else {
                degree + 1
            }),
            products,
        }
    }

    fn nodes(&self) -> usize {
        self.elements * self.degree + 1
    }

    fn node(&self, marker: Marker) -> Node {
        let node = match marker {
            Marker::Start => 0,
            Marker::Middle => (self.nodes() - 1) / 2,
            Marker::End => self.nodes() - 1,
        };
        Node(3 * node)
    }

    /// Strains at a point of an element.
    #[inline(always)]
    fn strain(&self, q: &[f64], point: &Point) -> Strain {
        let (mut u, mut angle, mut bend) = ([0.0; 2], 0.0, 0.0);
        for i in 0..=self.degree {
            u = plus(u, point.d[i], [q[3 * i], q[3 * i + 1]]);
            angle += point.n[i] * q[3 * i + 2];
            bend += point.d[i] * q[3 * i + 2];
        }
        let (s, c) = angle.sin_cos();
        let (normal, across) = ([c, s], [-s, c]);
        Strain {
            stretch: dot(normal, u) - 1.0,
            shear: dot(across, u),
            bend,
            normal,
            across,
        }
    }
}

/// Strains of a cross section and its axes.
struct Strain {
    stretch: f64,
    shear: f64,
    bend: f64,
    normal: Vector,
    across: Vector,
}

/// Lagrange polynomials on equal distances.
fn shape(degree: usize, x: f64, weight: f64, length: f64) -> Point {
    let (n, d) = match degree {
        1 => ([1.0 - x, x, 0.0], [-1.0, 1.0, 0.0]),
        _ => (
            [
                (1.0 - x) * (1.0 - 2.0 * x),
                4.0 * x * (1.0 - x),
                x * (2.0 * x - 1.0),
            ],
            [4.0 * x - 3.0, 4.0 - 8.0 * x, 4.0 * x - 1.0],
        ),
    };
    Point {
        n,
        d: d.map(|d| d / length),
        weight: weight * length,
    }
}

impl Body for Rotations {
    fn coordinates(&self) -> usize {
        3 * self.nodes()
    }

    fn half_width(&self) -> usize {
        3 * self.degree + 2
    }

    fn has_constant_mass(&self) -> bool {
        true
    }

    fn place(&self, placement: &Placement) -> [Vec<f64>; 2] {
        super::scenes::nodes_of(self.rod.length, self.nodes(), placement)
    }

    fn residual(&self, motion: Motion<'_>, gravity: Vector, r: &mut [f64]) {
        let rod = &self.rod;
        let step = 3 * self.degree;
        for first in (0..self.elements).map(|e| e * step) {
            let nodes = first..first + step + 3;
            let q = &motion.q[nodes.clone()];
            let a = &motion.a[nodes.clone()];
            let out = &mut r[nodes];
            for point in &self.points {
                let at = self.strain(q, point);
                let (axial, shear) = (rod.axial * at.stretch, rod.shear * at.shear);
                let moment = point.weight * rod.bending * at.bend;
                let turn = point.weight * (axial * at.shear - shear * (1.0 + at.stretch));
                let [x, y] =
                    [0, 1].map(|k| point.weight * (axial * at.normal[k] + shear * at.across[k]));
                for i in 0..=self.degree {
                    out[3 * i] += point.d[i] * x;
                    out[3 * i + 1] += point.d[i] * y;
                    out[3 * i + 2] += point.n[i] * turn + point.d[i] * moment;
                }
            }
            for i in 0..=self.degree {
                for j in 0..=self.degree {
                    let mass = rod.density * self.products[i][j];
                    out[3 * i] += mass * (a[3 * j] - gravity[0]);
                    out[3 * i + 1] += mass * (a[3 * j + 1] - gravity[1]);
                    out[3 * i + 2] += rod.rotary * self.products[i][j] * a[3 * j + 2];
                }
            }
        }
    }

    fn tangent(&self, motion: Motion<'_>, _: Vector, weights: [f64; 3], out: &mut Block<'_>) {
        let rod = &self.rod;
        let step = 3 * self.degree;
        for first in (0..self.elements).map(|e| e * step) {
            let q = &motion.q[first..first + step + 3];
            let mut k = [[0.0; 3 * MOST]; 3 * MOST];
            if weights[0] != 0.0 {
                for point in &self.points {
                    self.add_stiffness(q, point, weights[0], &mut k);
                }
            }
            for i in 0..=self.degree {
                for j in 0..=self.degree {
                    let mass = weights[2] * self.products[i][j];
                    k[3 * i][3 * j] += mass * rod.density;
                    k[3 * i + 1][3 * j + 1] += mass * rod.density;
                    k[3 * i + 2][3 * j + 2] += mass * rod.rotary;
                }
            }
            for i in 0..step + 3 {
                for j in 0..step + 3 {
                    out.add(first + i, first + j, k[i][j]);
                }
            }
        }
    }

    fn strain_energy(&self, q: &[f64]) -> f64 {
        let (rod, step) = (&self.rod, 3 * self.degree);
        let mut energy = 0.0;
        for first in (0..self.elements).map(|e| e * step) {
            for point in &self.points {
                let at = self.strain(&q[first..first + step + 3], point);
                let density = rod.axial * at.stretch * at.stretch
                    + rod.shear * at.shear * at.shear
                    + rod.bending * at.bend * at.bend;
                energy += 0.5 * point.weight * density;
            }
        }
        energy
    }

    fn position(&self, marker: Marker, q: &[f64]) -> Vector {
        self.node(marker).position(q)
    }

    fn columns(&self, marker: Marker, _: &[f64], out: &mut Columns) {
        self.node(marker).columns(out);
    }

    fn angle(&self, marker: Marker) -> Vec<(usize, f64)> {
        self.node(marker).angle()
    }
}

impl Rotations {
    /// Material and geometric stiffness at a point.
    #[inline(always)]
    fn add_stiffness(
        &self,
        q: &[f64],
        point: &Point,
        factor: f64,
        k: &mut [[f64; 3 * MOST]; 3 * MOST],
    ) {
        let rod = &self.rod;
        let at = self.strain(q, point);
        let (axial, shear) = (rod.axial * at.stretch, rod.shear * at.shear);
        let (one, long) = (factor * point.weight, 1.0 + at.stretch);
        let (n, t) = (at.normal, at.across);
        let entry = |i: usize, j: usize| one * (rod.axial * n[i] * n[j] + rod.shear * t[i] * t[j]);
        let uu = [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]];
        let along = one * (rod.axial * at.shear - shear);
        let across = one * (axial - rod.shear * long);
        let ut = [along * n[0] + across * t[0], along * n[1] + across * t[1]];
        let tt = one
            * (rod.axial * at.shear * at.shear - axial * long + rod.shear * long * long
                - shear * at.shear);
        for i in 0..=self.degree {
            for j in 0..=self.degree {
                let dd = point.d[i] * point.d[j];
                for r in 0..2 {
                    for c in 0..2 {
                        k[3 * i + r][3 * j + c] += dd * uu[r][c];
                    }
                    k[3 * i + r][3 * j + 2] += point.d[i] * point.n[j] * ut[r];
                    k[3 * i + 2][3 * j + r] += point.n[i] * point.d[j] * ut[r];
                }
                k[3 * i + 2][3 * j + 2] += point.n[i] * point.n[j] * tt + dd * one * rod.bending;
            }
        }
    }
}

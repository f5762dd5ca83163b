//! Corotational beam: every element has a frame that rotates with its chord, in which a small-displacement beam of Euler
//! and Bernoulli is bent. What a step adds to the angles of nodes are increments; in the plane they add up exactly, so
//! nothing is linearized along the way (what happens where it is: `increments.rs`).
//!
//! Source: M. A. Crisfield, Non-linear Finite Element Analysis of Solids and Structures, Vol. 1 (1991), section 7.3
//! (forces and tangent); the frame itself: T. Belytschko, B. J. Hsieh, Int. J. Numer. Methods Eng. 7 (1973) 255-271 (with
//! explicit steps and lumped masses), and
//! C. C. Rankin, F. A. Brogan, J. Press. Vessel Technol. 108 (1986) 165-174; shallow arch and cubic inertia in the frame:
//! T.-N. Le, J.-M. Battini, M. Hjiaj, Efficient formulation for dynamics of corotational 2D beams, Comput. Mech. 48 (2011)
//! 153-161.

use super::scenes::Rod;
use super::{Block, Body, Columns, Marker, Motion, Node, Placement, Vector, dot, plus, quarter};
use crate::elements::rule::Rule;

/// Mass of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inertia {
    /// Mass of the cubic deflection in the rotating frame
    Cubic,
    /// Half of it on either node, and inertia of the angles: a diagonal, for explicit steps
    Lumped,
}

/// Lumped inertia of the angle at a node of an element over its mass times length squared: E. Hinton, T. Rock, O. C.
/// Zienkiewicz, A note on mass lumping and related processes, Earthq. Eng. Struct. Dyn. 4 (1976) 245-249.
const LUMPED: f64 = 1.0 / 78.0;

/// Elastic law of an element in its own frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Local {
    /// The chord alone stretches
    Linear,
    /// The mean stretch of a shallow arch over the chord
    ShallowArch,
}

/// A chain of equal elements; three coordinates a node: position and angle.
pub struct Corotational {
    rod: Rod,
    elements: usize,
    length: f64,
    local: Local,
    inertia: Inertia,
    points: Vec<Point>,
}

/// A point of the inertia: place, Hermite functions of both angles over the length, mass (kg).
struct Point {
    at: f64,
    hermite: [f64; 2],
    mass: f64,
}

/// Points that integrate the cubic mass exactly.
const POINTS: usize = 4;

/// An element in its frame.
struct Frame {
    along: Vector,
    across: Vector,
    length: f64,
    /// Elongation of the chord (m), angles of both ends to it (rad).
    local: [f64; 3],
}

/// Energy of an element in its frame (J), its gradient and its second derivatives by elongation and both angles.
struct Energy {
    value: f64,
    gradient: [f64; 3],
    second: [[f64; 3]; 3],
}

impl Corotational {
    /// Builds the body of a rod.
    pub fn new(rod: Rod, elements: usize, local: Local, inertia: Inertia) -> Self {
        let length = rod.length / elements as f64;
        let points = Rule::Gauss(POINTS).points();
        let point = |p: &crate::elements::rule::Point| Point {
            at: p.at,
            hermite: [p.at * (1.0 - p.at).powi(2), p.at * p.at * (p.at - 1.0)].map(|h| length * h),
            mass: rod.density * length * p.weight,
        };
        Self {
            rod,
            elements,
            length,
            local,
            inertia,
            points: points.iter().map(point).collect(),
        }
    }

    fn node(&self, marker: Marker) -> Node {
        let node = match marker {
            Marker::Start => 0,
            Marker::Middle => self.elements / 2,
            Marker::End => self.elements,
        };
        Node(3 * node)
    }

    #[inline(always)]
    fn frame(&self, q: &[f64]) -> Frame {
        let d = [q[3] - q[0], q[4] - q[1]];
        let length = dot(d, d).sqrt();
        let along = d.map(|d| d / length);
        let across = quarter(along);
        let angle = |angle: f64| {
            let (s, c) = angle.sin_cos();
            dot(across, [c, s]).atan2(dot(along, [c, s]))
        };
        Frame {
            along,
            across,
            length,
            local: [length - self.length, angle(q[2]), angle(q[5])],
        }
    }

    #[inline(always)]
    fn energy(&self, [u, a, b]: [f64; 3]) -> Energy {
        let l = self.length;
        let (axial, bending) = (self.rod.axial * l, self.rod.bending / l);
        let arch = match self.local {
            Local::Linear => 0.0,
            Local::ShallowArch => 1.0 / 30.0,
        };
        let strain = u / l + arch * (2.0 * a * a - a * b + 2.0 * b * b);
        let by = [1.0 / l, arch * (4.0 * a - b), arch * (4.0 * b - a)];
        let force = axial * strain;
        let bent = [
            0.0,
            bending * (4.0 * a + 2.0 * b),
            bending * (4.0 * b + 2.0 * a),
        ];
        let mut second = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                second[i][j] = axial * by[i] * by[j];
            }
        }
        for i in 1..3 {
            second[i][i] += force * arch * 4.0 + 4.0 * bending;
            second[i][3 - i] += 2.0 * bending - force * arch;
        }
        Energy {
            value: 0.5 * axial * strain * strain + 2.0 * bending * (a * a + a * b + b * b),
            gradient: [0, 1, 2].map(|i| force * by[i] + bent[i]),
            second,
        }
    }

    /// Derivatives of the point by the coordinates of its element: with `g`, by the first position
    /// `(1 - at) I - g n^T`, by the second `at I + g n^T`, by the angles `hermite n`.
    #[inline(always)]
    fn lever(frame: &Frame, point: &Point) -> Vector {
        let [_, a, b] = frame.local;
        let [h, k] = point.hermite;
        let deflection = h * a + k * b;
        let both = plus([0.0; 2], -(h + k) / frame.length, frame.across);
        plus(both, -deflection / frame.length, frame.along)
    }

    /// `J^T f` of a point.
    #[inline(always)]
    fn add_force(frame: &Frame, point: &Point, f: Vector, out: &mut [f64]) {
        let g = dot(Self::lever(frame, point), f);
        let n = frame.across;
        let turn = dot(n, f);
        for k in 0..2 {
            out[k] += (1.0 - point.at) * f[k] - g * n[k];
            out[3 + k] += point.at * f[k] + g * n[k];
            out[3 * k + 2] += point.hermite[k] * turn;
        }
    }

    /// Acceleration of a point.
    #[inline(always)]
    fn acceleration(frame: &Frame, point: &Point, v: &[f64], a: &[f64]) -> Vector {
        let (e, n, l) = (frame.along, frame.across, frame.length);
        let rate = [v[3] - v[0], v[4] - v[1]];
        let second = [a[3] - a[0], a[4] - a[1]];
        let spin = dot(n, rate) / l;
        let turning = (dot(n, second) - 2.0 * spin * dot(e, rate)) / l;
        let [h, k] = point.hermite;
        let [_, first, last] = frame.local;
        let w = h * first + k * last;
        let w_rate = h * (v[2] - spin) + k * (v[5] - spin);
        let w_second = h * (a[2] - turning) + k * (a[5] - turning);
        let mut out = plus([a[0], a[1]], point.at, second);
        out = plus(out, w_second - w * spin * spin, n);
        plus(out, -2.0 * w_rate * spin - w * turning, e)
    }
}

impl Body for Corotational {
    fn coordinates(&self) -> usize {
        3 * (self.elements + 1)
    }

    fn half_width(&self) -> usize {
        5
    }

    fn has_constant_mass(&self) -> bool {
        self.inertia == Inertia::Lumped
    }

    fn place(&self, placement: &Placement) -> [Vec<f64>; 2] {
        super::scenes::nodes_of(self.rod.length, self.elements + 1, placement)
    }

    fn residual(&self, motion: Motion<'_>, gravity: Vector, r: &mut [f64]) {
        for first in (0..self.elements).map(|e| 3 * e) {
            let nodes = first..first + 6;
            let own = Motion {
                q: &motion.q[nodes.clone()],
                v: &motion.v[nodes.clone()],
                a: &motion.a[nodes.clone()],
            };
            let (q, a) = (own.q, own.a);
            let out = &mut r[nodes];
            let frame = self.frame(q);
            let [force, one, two] = self.energy(frame.local).gradient;
            let shear = (one + two) / frame.length;
            for k in 0..2 {
                let pull = force * frame.along[k] - shear * frame.across[k];
                out[k] -= pull;
                out[3 + k] += pull;
            }
            out[2] += one;
            out[5] += two;
            match self.inertia {
                Inertia::Cubic => self.add_inertia(&frame, own, gravity, out),
                Inertia::Lumped => {
                    let [mass, turning] = self.lumps();
                    for node in [0, 3] {
                        out[node] += mass * (a[node] - gravity[0]);
                        out[node + 1] += mass * (a[node + 1] - gravity[1]);
                        out[node + 2] += turning * a[node + 2];
                    }
                }
            }
        }
    }

    /// Of inertia only `M`: what rotates with the frame is the small deflection. Without its derivatives Newton's method takes
    /// 2.5 iterations a step where exact tangents take 2 (held by a test), and converges to the same.
    fn tangent(&self, motion: Motion<'_>, _: Vector, weights: [f64; 3], out: &mut Block<'_>) {
        for first in (0..self.elements).map(|e| 3 * e) {
            let frame = self.frame(&motion.q[first..first + 6]);
            let mut k = [[0.0; 6]; 6];
            if weights[0] != 0.0 {
                self.add_stiffness(&frame, weights[0], &mut k);
            }
            if weights[2] != 0.0 {
                match self.inertia {
                    Inertia::Cubic => self.add_mass(&frame, weights[2], &mut k),
                    Inertia::Lumped => {
                        let [mass, turning] = self.lumps().map(|lump| weights[2] * lump);
                        for (i, lump) in [mass, mass, turning, mass, mass, turning]
                            .iter()
                            .enumerate()
                        {
                            k[i][i] += lump;
                        }
                    }
                }
            }
            for i in 0..6 {
                for j in 0..6 {
                    out.add(first + i, first + j, k[i][j]);
                }
            }
        }
    }

    fn strain_energy(&self, q: &[f64]) -> f64 {
        let elements = (0..self.elements).map(|e| &q[3 * e..3 * e + 6]);
        elements
            .map(|q| self.energy(self.frame(q).local).value)
            .sum()
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

impl Corotational {
    /// Mass (kg) and moment of inertia (kg m^2) of a node of an element.
    fn lumps(&self) -> [f64; 2] {
        let mass = self.rod.density * self.length;
        [0.5 * mass, LUMPED * mass * self.length * self.length]
    }

    #[inline(always)]
    fn add_inertia(&self, frame: &Frame, motion: Motion<'_>, gravity: Vector, out: &mut [f64]) {
        for point in &self.points {
            let left = plus(
                Self::acceleration(frame, point, motion.v, motion.a),
                -1.0,
                gravity,
            );
            Self::add_force(frame, point, left.map(|f| point.mass * f), out);
        }
    }

    #[inline(always)]
    fn add_stiffness(&self, frame: &Frame, factor: f64, k: &mut [[f64; 6]; 6]) {
        let (e, n, l) = (frame.along, frame.across, frame.length);
        let energy = self.energy(frame.local);
        let stretch = [-e[0], -e[1], 0.0, e[0], e[1], 0.0];
        let turn = [-n[0], -n[1], 0.0, n[0], n[1], 0.0];
        let mut by = [stretch, turn.map(|t| -t / l), turn.map(|t| -t / l)];
        by[1][2] = 1.0;
        by[2][5] = 1.0;
        let [force, one, two] = energy.gradient;
        let moments = (one + two) / (l * l);
        for i in 0..6 {
            let row =
                [0, 1, 2].map(|c| (0..3).map(|r| by[r][i] * energy.second[r][c]).sum::<f64>());
            for j in 0..6 {
                let material = row[0] * by[0][j] + row[1] * by[1][j] + row[2] * by[2][j];
                let geometric = force / l * turn[i] * turn[j]
                    + moments * (stretch[i] * turn[j] + turn[i] * stretch[j]);
                k[i][j] += factor * (material + geometric);
            }
        }
    }

    #[inline(always)]
    fn add_mass(&self, frame: &Frame, factor: f64, k: &mut [[f64; 6]; 6]) {
        let n = frame.across;
        for point in &self.points {
            let g = Self::lever(frame, point);
            let mut j = [[0.0; 6]; 2];
            for r in 0..2 {
                for c in 0..2 {
                    let one = if r == c { 1.0 } else { 0.0 };
                    j[r][c] = (1.0 - point.at) * one - g[r] * n[c];
                    j[r][3 + c] = point.at * one + g[r] * n[c];
                }
                j[r][2] = point.hermite[0] * n[r];
                j[r][5] = point.hermite[1] * n[r];
            }
            let mass = factor * point.mass;
            for a in 0..6 {
                for b in 0..6 {
                    k[a][b] += mass * (j[0][a] * j[0][b] + j[1][a] * j[1][b]);
                }
            }
        }
    }
}

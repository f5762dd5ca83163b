//! Floating frame of reference: a frame that moves as a rigid body does, and small deformations seen from it, as
//! coordinates of shapes. Inertia couples both; its integrals over the shapes are computed once.
//!
//! With foreshortening a bent line is shorter along the axis by half the integral of its slope squared. Energies are then
//! complete to the second order in the shapes, as in the sources (products of the shortening with shapes are left out).
//!
//! Source: A. A. Shabana, Dynamics of Multibody Systems (1989), chapter 5; T. R. Kane, R. R. Ryan, A. K. Banerjee, J. Guid.
//! Control Dyn. 10 (1987) 139-151; J. Mayo, J. Dominguez, A. A. Shabana, Geometrically nonlinear formulations of beams in
//! flexible multibody dynamics, J. Vib. Acoust. 117 (1995) 501-509.

use super::basis::{Basis, Shape};
use super::{
    Block, Body, Columns, Marker, Motion, Placement, Vector, back, dot, plus, quarter, turned,
};

/// Largest number of shapes.
pub const MOST: usize = 24;

/// A body in its frame; coordinates: position of the frame, its angle, the shapes.
pub struct FloatingFrame {
    /// Integrals of the shapes.
    pub basis: Basis,
    /// Place of the frame on the undeformed body from its first end, m.
    origin: f64,
}

/// A vector of as many numbers as there are shapes.
type Shapes = [f64; MOST];

/// What the equations read.
struct Terms {
    turn: Vector,
    spin: f64,
    turning: f64,
    /// Acceleration of the frame less gravity, in its axes.
    apparent: Vector,
    /// First moment and its derivatives by shapes.
    s: Vector,
    by: [Vector; MOST],
    s_rate: Vector,
    /// Inertial force on the whole body but for that of the frame's acceleration, in the frame.
    force: Vector,
    /// `j + D e`, `D e'`, `b - H e`, `H e'`, `H e''`, `G e'`, `G e''`, `M e''`.
    reach: Shapes,
    reach_rate: Shapes,
    swing: Shapes,
    coriolis: Shapes,
    cross_second: Shapes,
    short_rate: Shapes,
    short_second: Shapes,
    inertial: Shapes,
}

impl FloatingFrame {
    /// With shapes.
    pub fn new(basis: Basis) -> Self {
        assert!(basis.count <= MOST, "at most {MOST} shapes");
        let origin = -basis.marker(Marker::Start).x;
        Self { basis, origin }
    }

    /// Where a marker is in the frame, and derivatives by shapes.
    fn local(&self, shape: &Shape, e: &[f64]) -> (Vector, [Vector; MOST]) {
        let n = self.basis.count;
        let (mut at, mut by) = ([shape.x, 0.0], [[0.0; 2]; MOST]);
        for k in 0..n {
            let row = &shape.shortening[n * k..n * (k + 1)];
            let short: f64 = if self.basis.foreshortening {
                row.iter().zip(e).map(|(g, e)| g * e).sum()
            } else {
                0.0
            };
            by[k] = [shape.u[k] - short, shape.w[k]];
            at = plus(at, e[k], [shape.u[k] - 0.5 * short, shape.w[k]]);
        }
        (at, by)
    }

    fn terms(&self, motion: Motion<'_>, gravity: Vector) -> Terms {
        let (basis, n) = (&self.basis, self.basis.count);
        let (e, rate, second) = (&motion.q[3..], &motion.v[3..], &motion.a[3..]);
        let (sine, cosine) = motion.q[2].sin_cos();
        let (turn, spin, turning) = ([cosine, sine], motion.v[2], motion.a[2]);
        let zero = [0.0; MOST];
        let mut t = Terms {
            turn,
            spin,
            turning,
            apparent: back(turn, plus([motion.a[0], motion.a[1]], -1.0, gravity)),
            s: [basis.moment, 0.0],
            by: [[0.0; 2]; MOST],
            s_rate: [0.0; 2],
            force: [0.0; 2],
            reach: zero,
            reach_rate: zero,
            swing: zero,
            coriolis: zero,
            cross_second: zero,
            short_rate: zero,
            short_second: zero,
            inertial: zero,
        };
        let mut s_second = [0.0; 2];
        for k in 0..n {
            let row = n * k..n * (k + 1);
            let (mut short, mut far, mut cross) = (0.0, 0.0, 0.0);
            let rows = (
                &basis.shortening[row.clone()],
                &basis.centrifugal[row.clone()],
            );
            let others = (&basis.cross[row.clone()], &basis.product[row]);
            for l in 0..n {
                short += rows.0[l] * e[l];
                t.short_rate[k] += rows.0[l] * rate[l];
                t.short_second[k] += rows.0[l] * second[l];
                far += rows.1[l] * e[l];
                t.reach_rate[k] += rows.1[l] * rate[l];
                cross += others.0[l] * e[l];
                t.coriolis[k] += others.0[l] * rate[l];
                t.cross_second[k] += others.0[l] * second[l];
                t.inertial[k] += others.1[l] * second[l];
            }
            t.by[k] = plus(basis.first[k], -short, [1.0, 0.0]);
            t.s = plus(t.s, e[k], plus(basis.first[k], -0.5 * short, [1.0, 0.0]));
            t.s_rate = plus(t.s_rate, rate[k], t.by[k]);
            s_second = plus(s_second, second[k], t.by[k]);
            s_second[0] -= rate[k] * t.short_rate[k];
            t.reach[k] = basis.along[k] + far;
            t.swing[k] = basis.across[k] - cross;
        }
        t.force = plus(s_second, 2.0 * spin, quarter(t.s_rate));
        t.force = plus(t.force, turning, quarter(t.s));
        t.force = plus(t.force, -spin * spin, t.s);
        t
    }

    /// Moment of inertia about the frame, kg m^2.
    fn inertia(&self, e: &[f64], t: &Terms) -> f64 {
        let shapes = (0..self.basis.count).map(|k| e[k] * (self.basis.along[k] + t.reach[k]));
        self.basis.inertia + shapes.sum::<f64>()
    }
}

impl Body for FloatingFrame {
    fn coordinates(&self) -> usize {
        3 + self.basis.count
    }

    fn half_width(&self) -> usize {
        2 + self.basis.count
    }

    fn has_constant_mass(&self) -> bool {
        false
    }

    fn place(&self, placement: &Placement) -> [Vec<f64>; 2] {
        let (sine, cosine) = placement.angle.sin_cos();
        let start = plus(placement.start, self.origin, [cosine, sine]);
        let rate = plus(
            placement.velocity,
            self.origin * placement.spin,
            [-sine, cosine],
        );
        let rest = vec![0.0; self.basis.count];
        let with = |[x, y]: Vector, angle: f64| [&[x, y, angle], &rest[..]].concat();
        [with(start, placement.angle), with(rate, placement.spin)]
    }

    fn residual(&self, motion: Motion<'_>, gravity: Vector, r: &mut [f64]) {
        let (basis, t) = (&self.basis, self.terms(motion, gravity));
        let (e, rate, second) = (&motion.q[3..], &motion.v[3..], &motion.a[3..]);
        let push = turned(t.turn, plus(t.force, basis.mass, t.apparent));
        r[0] += push[0];
        r[1] += push[1];
        let mut moment = dot(t.apparent, quarter(t.s)) + t.turning * self.inertia(e, &t);
        for k in 0..basis.count {
            moment += 2.0 * t.spin * t.reach[k] * rate[k] + t.swing[k] * second[k];
            r[3 + k] += dot(t.by[k], t.apparent) + t.turning * t.swing[k] + t.inertial[k]
                - 2.0 * t.spin * t.coriolis[k]
                - t.spin * t.spin * t.reach[k]
                + basis.stiffness[k] * e[k];
        }
        r[2] += moment;
    }

    fn tangent(&self, motion: Motion<'_>, gravity: Vector, weights: [f64; 3], out: &mut Block<'_>) {
        let t = self.terms(motion, gravity);
        let [by_q, by_v, by_a] = weights;
        self.add_mass(&motion.q[3..], &t, by_a, out);
        if by_v != 0.0 {
            self.add_gyroscopic(motion, &t, by_v, out);
        }
        if by_q != 0.0 {
            self.add_stiffness(&t, by_q, out);
        }
    }

    fn strain_energy(&self, q: &[f64]) -> f64 {
        let shapes = self.basis.stiffness.iter().zip(&q[3..]);
        shapes.map(|(k, e)| 0.5 * k * e * e).sum()
    }

    fn position(&self, marker: Marker, q: &[f64]) -> Vector {
        let (s, c) = q[2].sin_cos();
        let (at, _) = self.local(self.basis.marker(marker), &q[3..]);
        plus([q[0], q[1]], 1.0, turned([c, s], at))
    }

    fn columns(&self, marker: Marker, q: &[f64], out: &mut Columns) {
        let (s, c) = q[2].sin_cos();
        let (at, by) = self.local(self.basis.marker(marker), &q[3..]);
        out.extend([(0, [1.0, 0.0]), (1, [0.0, 1.0])]);
        out.push((2, quarter(turned([c, s], at))));
        out.extend((0..self.basis.count).map(|k| (3 + k, turned([c, s], by[k]))));
    }

    fn bias(&self, marker: Marker, q: &[f64], v: &[f64]) -> Vector {
        let (s, c) = q[2].sin_cos();
        let shape = self.basis.marker(marker);
        let (at, by) = self.local(shape, &q[3..]);
        let n = self.basis.count;
        let mut local = plus([0.0; 2], -v[2] * v[2], at);
        for k in 0..n {
            local = plus(local, 2.0 * v[2] * v[3 + k], quarter(by[k]));
            if self.basis.foreshortening {
                let row = (0..n).map(|l| shape.shortening[n * k + l] * v[3 + l]);
                local[0] -= v[3 + k] * row.sum::<f64>();
            }
        }
        turned([c, s], local)
    }

    fn bend(&self, marker: Marker, q: &[f64], force: Vector, out: &mut Block<'_>) {
        let (s, c) = q[2].sin_cos();
        let shape = self.basis.marker(marker);
        let (at, by) = self.local(shape, &q[3..]);
        let (f, n) = (back([c, s], force), self.basis.count);
        out.add(2, 2, -dot(at, f));
        for k in 0..n {
            let entry = dot(quarter(by[k]), f);
            out.add(2, 3 + k, entry);
            out.add(3 + k, 2, entry);
            if self.basis.foreshortening {
                for l in 0..n {
                    out.add(3 + k, 3 + l, -shape.shortening[n * k + l] * f[0]);
                }
            }
        }
    }

    fn angle(&self, marker: Marker) -> Vec<(usize, f64)> {
        let shape = self.basis.marker(marker);
        let slopes = shape.slope.iter().enumerate();
        let shapes = slopes.map(|(k, slope)| (3 + k, *slope));
        [(2, 1.0)].into_iter().chain(shapes).collect()
    }
}

impl FloatingFrame {
    fn add_mass(&self, e: &[f64], t: &Terms, factor: f64, out: &mut Block<'_>) {
        let (basis, n) = (&self.basis, self.basis.count);
        let lever = turned(t.turn, quarter(t.s));
        for d in 0..2 {
            out.add(d, d, factor * basis.mass);
            out.add(d, 2, factor * lever[d]);
            out.add(2, d, factor * lever[d]);
        }
        out.add(2, 2, factor * self.inertia(e, t));
        for k in 0..n {
            let column = turned(t.turn, t.by[k]);
            for (d, entry) in [column[0], column[1], t.swing[k]].into_iter().enumerate() {
                out.add(d, 3 + k, factor * entry);
                out.add(3 + k, d, factor * entry);
            }
            for l in 0..n {
                out.add(3 + k, 3 + l, factor * basis.product[n * k + l]);
            }
        }
    }

    fn add_gyroscopic(&self, motion: Motion<'_>, t: &Terms, factor: f64, out: &mut Block<'_>) {
        let (basis, n) = (&self.basis, self.basis.count);
        let column = turned(t.turn, plus(quarter(t.s_rate), -t.spin, t.s));
        for d in 0..2 {
            out.add(d, 2, 2.0 * factor * column[d]);
        }
        let mut reach = 0.0;
        for k in 0..n {
            let mut local = plus([0.0; 2], 2.0 * t.spin, quarter(t.by[k]));
            local[0] -= 2.0 * t.short_rate[k];
            let column = turned(t.turn, local);
            out.add(0, 3 + k, factor * column[0]);
            out.add(1, 3 + k, factor * column[1]);
            reach += 2.0 * t.reach[k] * motion.v[3 + k];
            out.add(2, 3 + k, 2.0 * factor * t.spin * t.reach[k]);
            out.add(
                3 + k,
                2,
                -2.0 * factor * (t.coriolis[k] + t.spin * t.reach[k]),
            );
            for l in 0..n {
                out.add(
                    3 + k,
                    3 + l,
                    -2.0 * factor * t.spin * basis.cross[n * k + l],
                );
            }
        }
        out.add(2, 2, factor * reach);
    }

    fn add_stiffness(&self, t: &Terms, factor: f64, out: &mut Block<'_>) {
        let (basis, n) = (&self.basis, self.basis.count);
        let column = turned(t.turn, quarter(t.force));
        out.add(0, 2, factor * column[0]);
        out.add(1, 2, factor * column[1]);
        out.add(2, 2, -factor * dot(t.apparent, t.s));
        for k in 0..n {
            let mut local = plus([0.0; 2], t.turning, quarter(t.by[k]));
            local = plus(local, -t.spin * t.spin, t.by[k]);
            local[0] -= t.short_second[k];
            local[1] -= 2.0 * t.spin * t.short_rate[k];
            let column = turned(t.turn, local);
            out.add(0, 3 + k, factor * column[0]);
            out.add(1, 3 + k, factor * column[1]);
            let moment = dot(t.apparent, quarter(t.by[k]))
                + 2.0 * t.turning * t.reach[k]
                + 2.0 * t.spin * t.reach_rate[k]
                + t.cross_second[k];
            out.add(2, 3 + k, factor * moment);
            out.add(3 + k, 2, -factor * dot(t.by[k], quarter(t.apparent)));
            for l in 0..n {
                let i = n * k + l;
                let entry = -basis.shortening[i] * t.apparent[0]
                    - t.turning * basis.cross[i]
                    - t.spin * t.spin * basis.centrifugal[i];
                out.add(3 + k, 3 + l, factor * entry);
            }
            out.add(3 + k, 3 + k, factor * basis.stiffness[k]);
        }
    }
}

//! What mechanisms have besides beams: a rigid bar with its centre of mass half-way, and a particle.

use super::{
    Block, Body, Columns, Marker, Motion, Placement, Vector, back, dot, plus, quarter, turned,
};

/// A bar: centre of mass and angle; or a particle, whose markers are all one point.
pub struct Rigid {
    /// Mass, kg.
    pub mass: f64,
    /// Length and moment of inertia about the centre of mass (m, kg m^2); none of a particle.
    pub bar: Option<[f64; 2]>,
}

impl Rigid {
    fn local(&self, marker: Marker) -> Vector {
        let half = 0.5 * self.bar.map_or(0.0, |[length, _]| length);
        match marker {
            Marker::Start => [-half, 0.0],
            Marker::Middle => [0.0; 2],
            Marker::End => [half, 0.0],
        }
    }

    fn lever(&self, marker: Marker, q: &[f64]) -> Vector {
        match self.bar {
            None => [0.0; 2],
            Some(_) => {
                let (s, c) = q[2].sin_cos();
                turned([c, s], self.local(marker))
            }
        }
    }
}

impl Body for Rigid {
    fn coordinates(&self) -> usize {
        if self.bar.is_some() { 3 } else { 2 }
    }

    fn half_width(&self) -> usize {
        2
    }

    fn has_constant_mass(&self) -> bool {
        self.bar.is_none()
    }

    fn place(&self, placement: &Placement) -> [Vec<f64>; 2] {
        let (s, c) = placement.angle.sin_cos();
        let to = turned([c, s], plus([0.0; 2], -1.0, self.local(Marker::Start)));
        let mut q = plus(placement.start, 1.0, to).to_vec();
        let mut v = plus(placement.velocity, placement.spin, quarter(to)).to_vec();
        if self.bar.is_some() {
            q.push(placement.angle);
            v.push(placement.spin);
        }
        [q, v]
    }

    fn residual(&self, motion: Motion<'_>, gravity: Vector, r: &mut [f64]) {
        for d in 0..2 {
            r[d] += self.mass * (motion.a[d] - gravity[d]);
        }
        if let Some([_, inertia]) = self.bar {
            r[2] += inertia * motion.a[2];
        }
    }

    fn tangent(&self, _: Motion<'_>, _: Vector, weights: [f64; 3], out: &mut Block<'_>) {
        for d in 0..2 {
            out.add(d, d, weights[2] * self.mass);
        }
        if let Some([_, inertia]) = self.bar {
            out.add(2, 2, weights[2] * inertia);
        }
    }

    fn strain_energy(&self, _: &[f64]) -> f64 {
        0.0
    }

    fn position(&self, marker: Marker, q: &[f64]) -> Vector {
        plus([q[0], q[1]], 1.0, self.lever(marker, q))
    }

    fn columns(&self, marker: Marker, q: &[f64], out: &mut Columns) {
        out.extend([(0, [1.0, 0.0]), (1, [0.0, 1.0])]);
        if self.bar.is_some() {
            out.push((2, quarter(self.lever(marker, q))));
        }
    }

    fn bias(&self, marker: Marker, q: &[f64], v: &[f64]) -> Vector {
        match self.bar {
            None => [0.0; 2],
            Some(_) => plus([0.0; 2], -v[2] * v[2], self.lever(marker, q)),
        }
    }

    fn bend(&self, marker: Marker, q: &[f64], force: Vector, out: &mut Block<'_>) {
        if self.bar.is_some() {
            let (s, c) = q[2].sin_cos();
            out.add(2, 2, -dot(self.local(marker), back([c, s], force)));
        }
    }

    fn angle(&self, _: Marker) -> Vec<(usize, f64)> {
        vec![(2, 1.0)]
    }
}

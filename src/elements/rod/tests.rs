//! Laws of bending and torsion of one element.
//!
//! Source: derivatives of the energy by differences; rotations and the exchange of ends.

use nalgebra::{Rotation3, Vector3};

use super::*;

type V = Vector3<f64>;

/// Numbers between -1 and 1 that look random.
pub(super) struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> V {
        V::from_fn(|_, _| self.next())
    }

    fn rates(&mut self) -> Rates<f64> {
        Rates {
            e: std::array::from_fn(|_| self.vector().into()),
            spin: [self.next(), self.next()],
            bubble: self.next(),
        }
    }
}

/// A unit vector across `u`.
fn section(u: [f64; 3], near: V) -> [f64; 3] {
    let t = V::from(u).normalize();
    (near - t * t.dot(&near)).normalize().into()
}

/// An element that is bent and twisted.
fn bent(seed: u64, by: f64) -> At<f64> {
    let mut noise = Noise(seed);
    let [a, b, c, d, f, g] = std::array::from_fn(|_| noise.vector() * by);
    let u = [(V::x() + b).into(), (V::x() + d).into()];
    At {
        e: [a.into(), u[0], (V::x() * 0.7 + a + c * 0.3).into(), u[1]],
        d: [section(u[0], V::y() + f), section(u[1], V::y() + g)],
        bubble: 0.3 * by,
    }
}

const GENERAL: Parameters = Parameters {
    length: 0.7,
    stiffness: [[1.3, 0.2, -0.1], [0.2, 2.0, 0.3], [-0.1, 0.3, 0.9]],
    damping_times: [0.1, 0.02, 0.3],
};

const ROUND: Parameters = Parameters {
    length: 0.7,
    stiffness: [[1.3, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
    damping_times: [0.1, 0.3, 0.3],
};

fn rods() -> [Rod; 3] {
    let straight = bent(1, 0.0);
    [
        Rod::new(GENERAL, &bent(2, 0.3)),
        Rod::new(GENERAL, &straight),
        Rod::new(ROUND, &straight),
    ]
}

/// Moved by a small time with these velocities.
fn moved(at: &At<f64>, rates: &Rates<f64>, time: f64) -> At<f64> {
    let e: [[f64; 3]; 4] =
        std::array::from_fn(|k| std::array::from_fn(|i| at.e[k][i] + time * rates.e[k][i]));
    let d = std::array::from_fn(|k| {
        let (u, new) = (V::from(at.e[2 * k + 1]), V::from(e[2 * k + 1]));
        let turn = Rotation3::rotation_between(&u, &new).expect("less than half a turn");
        let t = nalgebra::Unit::new_normalize(new);
        let about = Rotation3::from_axis_angle(&t, time * rates.spin[k]);
        section(e[2 * k + 1], about * (turn * V::from(at.d[k])))
    });
    At {
        e,
        d,
        bubble: at.bubble + time * rates.bubble,
    }
}

fn power(force: &Force<f64>, rates: &Rates<f64>) -> f64 {
    let of = Force {
        e: rates.e,
        torque: rates.spin,
        bubble: rates.bubble,
    };
    dot(&force.flat(), &of.flat())
}

#[test]
fn force_is_minus_the_gradient_of_the_energy() {
    let h = 1e-4;
    for (case, rod) in rods().iter().enumerate() {
        for seed in 10..20 {
            let at = bent(seed, 0.5);
            let force = rod.force(&at, None).0;
            let rates = Noise(seed).rates();
            let energy = |time: f64| rod.energy(&moved(&at, &rates, time));
            let slope =
                (8.0 * (energy(h) - energy(-h)) - energy(2.0 * h) + energy(-2.0 * h)) / (12.0 * h);
            let found = power(&force, &rates);
            assert!(
                (found + slope).abs() < 1e-8 * (1.0 + slope.abs()),
                "{case} {seed} {found} {slope}"
            );
        }
    }
}

#[test]
fn stiffness_and_damping_are_derivatives_of_the_force() {
    let h = 1e-4;
    for (case, rod) in rods().iter().enumerate() {
        let at = bent(10, 0.5);
        let (stiffness, damping) = (rod.stiffness(&at, None), rod.damping(&at));
        let mut differences = [[0.0; VELOCITIES]; VELOCITIES];
        for j in 0..VELOCITIES {
            let way = unit_velocity(j);
            let force = |time: f64| rod.force(&moved(&at, &way, time), None).0.flat();
            let [a, b, c, d] = [h, -h, 2.0 * h, -2.0 * h].map(force);
            for i in 0..VELOCITIES {
                differences[i][j] = -(8.0 * (a[i] - b[i]) - c[i] + d[i]) / (12.0 * h);
            }
            let damped = rod.force(&at, Some(&way)).0.flat();
            let force = rod.force(&at, None).0.flat();
            for i in 0..VELOCITIES {
                assert!((damping[i][j] - (force[i] - damped[i])).abs() < 1e-11);
                assert!((damping[i][j] - damping[j][i]).abs() < 1e-12);
            }
        }
        for i in 0..VELOCITIES {
            for j in 0..VELOCITIES {
                let mean = 0.5 * (differences[i][j] + differences[j][i]);
                assert!((stiffness[i][j] - mean).abs() < 1e-7, "{case} {i} {j}");
            }
        }
    }
}

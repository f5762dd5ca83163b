//! Laws of bending and torsion of one element.
//!
//! Source: derivatives of the energy by differences; rotations and the exchange of ends.

use nalgebra::{Matrix4, Rotation3, Vector3, Vector4};

use super::*;
use crate::elements::{Element, Nodal};
use crate::math::jet::Jet;
use crate::math::quadrature::GAUSS_3;

mod helix;

type V = Vector3<f64>;

/// Numbers between -1 and 1 that look random.
pub(crate) struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self) -> V {
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
pub(super) fn section(u: [f64; 3], near: V) -> [f64; 3] {
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
    stiffness: [[[1.3, 0.2, -0.1], [0.2, 2.0, 0.3], [-0.1, 0.3, 0.9]]; 3],
    damping_times: [0.1, 0.02, 0.3],
    axial: None,
};

const TAPERED: Parameters = Parameters {
    length: 0.7,
    stiffness: [
        [[1.3, 0.2, -0.1], [0.2, 2.0, 0.3], [-0.1, 0.3, 0.9]],
        [[1.0, 0.1, 0.0], [0.1, 1.5, 0.2], [0.0, 0.2, 0.8]],
        [[0.4, 0.0, 0.1], [0.0, 1.1, 0.1], [0.1, 0.1, 0.7]],
    ],
    damping_times: [0.1, 0.02, 0.3],
    axial: None,
};

const COUPLED: Parameters = Parameters {
    axial: Some(Stretch {
        stiffness: [3.0, 2.5, 2.0],
        coupling: [[0.4, -0.3, 0.5], [0.3, -0.2, 0.4], [0.1, -0.2, 0.3]],
        damping_time: 0.2,
    }),
    ..TAPERED
};

const ROPE: Parameters = Parameters {
    axial: Some(Stretch {
        stiffness: [3.0; 3],
        coupling: [[0.4, 0.0, 0.0]; 3],
        damping_time: 0.2,
    }),
    ..ROUND
};

const ROUND: Parameters = Parameters {
    length: 0.7,
    stiffness: [[[1.3, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]; 3],
    damping_times: [0.1, 0.3, 0.3],
    axial: None,
};

fn rods() -> [Rod; 6] {
    let straight = bent(1, 0.0);
    [
        Rod::new(GENERAL, &bent(2, 0.3)),
        Rod::new(GENERAL, &straight),
        Rod::new(ROUND, &straight),
        Rod::new(TAPERED, &bent(3, 0.3)),
        Rod::new(COUPLED, &bent(3, 0.3)),
        Rod::new(ROPE, &straight),
    ]
}

/// Moved by a small time with these velocities.
pub(super) fn moved(at: &At<f64>, rates: &Rates<f64>, time: f64) -> At<f64> {
    let e: [[f64; 3]; 4] =
        std::array::from_fn(|k| std::array::from_fn(|i| at.e[k][i] + time * rates.e[k][i]));
    let d = std::array::from_fn(|k| {
        let [t, new] = [at.e, e].map(|e| V::from(e[2 * k + 1]).normalize());
        let d = V::from(at.d[k]);
        let carried = d - (t + new) * (new.dot(&d) / (1.0 + t.dot(&new)));
        let (sin, cos) = (time * rates.spin[k]).sin_cos();
        section(e[2 * k + 1], carried * cos + new.cross(&carried) * sin)
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

/// One of the velocities of an element.
fn unit_velocity(index: usize) -> Rates<f64> {
    let one = |at: usize| f64::from(u8::from(at == index));
    Rates {
        e: std::array::from_fn(|k| std::array::from_fn(|i| one(7 * (k / 2) + 3 * (k % 2) + i))),
        spin: [one(6), one(13)],
        bubble: one(14),
    }
}

/// An element that moves.
fn moving(at: &At<f64>, rates: &Rates<f64>) -> At<Jet> {
    let jets = |x: [f64; 3], v: [f64; 3]| std::array::from_fn(|i| Jet::new(x[i], v[i], 0.0));
    At {
        e: std::array::from_fn(|k| jets(at.e[k], rates.e[k])),
        d: std::array::from_fn(|k| jets(at.d[k], at.section_rate(rates, k))),
        bubble: Jet::new(at.bubble, rates.bubble, 0.0),
    }
}

#[test]
fn stiffness_and_damping_are_derivatives_of_the_force() {
    for (case, rod) in rods().iter().enumerate() {
        for seed in 10..14 {
            let at = bent(seed, 0.5);
            let (stiffness, damping) = (rod.stiffness(&at, None), rod.damping(&at));
            let elastic = rod.force(&at, None).0.flat();
            let columns: [_; VELOCITIES] = std::array::from_fn(|k| {
                let force = rod.force(&moving(&at, &unit_velocity(k)), None).0;
                force.flat().map(|force| -force.v1)
            });
            for j in 0..VELOCITIES {
                let damped = rod.force(&at, Some(&unit_velocity(j))).0.flat();
                for i in 0..VELOCITIES {
                    let mean = 0.5 * (columns[i][j] + columns[j][i]);
                    let size = 1.0 + mean.abs();
                    assert!(
                        (stiffness[i][j] - mean).abs() < 1e-13 * size,
                        "{case} {i} {j}"
                    );
                    assert!((damping[i][j] - (elastic[i] - damped[i])).abs() < 1e-11);
                }
            }
        }
    }
}

/// Stiffness or damping at a point over stretch, twist and curvatures; stretching that is the line's own counts 1.
fn whole(kernel: &Kernel<f64>, point: usize, is_damping: bool) -> Matrix4<f64> {
    let (square, axial) = if is_damping {
        (
            &kernel.law.damping[point],
            kernel.axial.as_ref().map(|axial| &axial.damping),
        )
    } else {
        (
            &kernel.law.stiffness[point],
            kernel.axial.as_ref().map(|axial| &axial.stiffness),
        )
    };
    Matrix4::from_fn(|i, j| match (i, j, axial) {
        (0, 0, axial) => axial.map_or(1.0, |axial| axial.own[point]),
        (0, k, axial) | (k, 0, axial) => axial.map_or(0.0, |axial| axial.with[point][k - 1]),
        _ => square[i - 1][j - 1],
    })
}

#[test]
fn stresses_that_damping_adds_stiffen_as_any() {
    let h = 1e-4;
    for (case, rod) in rods().iter().enumerate() {
        let (at, rates) = (bent(10, 0.5), Noise(4).rates());
        let mut other = rod.clone();
        other.kernel.geometry.is_round = false;
        for (k, point) in POINTS.iter().enumerate() {
            let [stiffness, damping] =
                [false, true].map(|is_damping| whole(&rod.kernel, k, is_damping));
            let strains = |time: f64| {
                let at = moved(&at, &rates, time);
                let [twist, first, second] = rod.strains(&at, point.at);
                Vector4::new(
                    rod.kernel.geometry.stretch(&at, point),
                    twist,
                    first,
                    second,
                )
            };
            let [near, far] = [h, 2.0 * h].map(|time| strains(time) - strains(-time));
            let shift = stiffness.try_inverse().expect("positive") * damping * (8.0 * near - far)
                / (12.0 * h);
            if let Some(axial) = &mut other.kernel.axial {
                axial.offset[k] += shift[0];
            }
            for (offset, shift) in other.kernel.law.offset[k]
                .iter_mut()
                .zip(shift.iter().skip(1))
            {
                *offset += shift;
            }
        }
        let [found, wanted] = [rod.stiffness(&at, Some(&rates)), other.stiffness(&at, None)];
        for (a, b) in found.as_flattened().iter().zip(wanted.as_flattened()) {
            assert!((a - b).abs() < 1e-8 * (1.0 + b.abs()), "{case} {a} {b}");
        }
    }
}

#[test]
fn rotating_everything_leaves_the_energy() {
    for (case, rod) in rods().iter().enumerate() {
        for seed in 20..30 {
            let mut at = bent(seed, 0.5);
            let before = rod.energy(&at);
            let turn = Rotation3::new(Noise(seed).vector() * 3.0);
            at.e = at.e.map(|v| (turn * V::from(v)).into());
            at.d = at.d.map(|v| (turn * V::from(v)).into());
            let change = rod.energy(&at) - before;
            assert!(change.abs() < 3e-14 * before, "{case} {seed} {change}");
        }
    }
}

/// Seen from the last end: tangents rotate round.
fn from_the_last_end(at: &At<f64>) -> At<f64> {
    let [ra, ua, rb, ub] = at.e;
    At {
        e: [rb, ub.map(|x| -x), ra, ua.map(|x| -x)],
        d: [at.d[1], at.d[0]],
        bubble: -at.bubble,
    }
}

#[test]
fn both_ends_are_alike() {
    for given in [TAPERED, COUPLED] {
        let mut parameters = given;
        for (i, j) in [(0, 1), (1, 0), (1, 2), (2, 1)] {
            for stiffness in &mut parameters.stiffness {
                stiffness[i][j] *= -1.0;
            }
        }
        parameters.stiffness.reverse();
        if let Some(axial) = &mut parameters.axial {
            axial.stiffness.reverse();
            axial.coupling.reverse();
            axial.coupling.iter_mut().for_each(|with| with[1] *= -1.0);
        }
        let shape = bent(2, 0.3);
        let rod = Rod::new(given, &shape);
        let turned = Rod::new(parameters, &from_the_last_end(&shape));
        for seed in 30..40 {
            let at = bent(seed, 0.5);
            let energy = rod.energy(&at);
            let change = turned.energy(&from_the_last_end(&at)) - energy;
            assert!(change.abs() < 1e-14 * energy, "{seed} {change}");
        }
    }
}

#[test]
fn damping_takes_out_what_its_force_does() {
    for rod in &rods() {
        for seed in 40..60 {
            let (at, rates) = (bent(seed, 0.5), Noise(seed).rates());
            let (damped, taken) = rod.force(&at, Some(&rates));
            let elastic = rod.force(&at, None).0;
            let work = power(&elastic, &rates) - power(&damped, &rates);
            assert!(taken >= 0.0 && (work - taken).abs() < 1e-12 * (1.0 + taken));
        }
        // Rigid motion is not damped.
        let at = bent(3, 0.5);
        let spin = V::new(0.3, -1.0, 0.7);
        let turned = |v: [f64; 3]| <[f64; 3]>::from(spin.cross(&V::from(v)));
        let rates = Rates {
            e: at.e.map(turned),
            spin: [1, 3].map(|k| spin.dot(&V::from(at.e[k]).normalize())),
            bubble: 0.0,
        };
        assert!(rod.force(&at, Some(&rates)).1 < 1e-28);
        for end in 0..2 {
            let miss = V::from(at.section_rate(&rates, end)) - V::from(turned(at.d[end]));
            assert!(miss.norm() < 1e-15);
        }
    }
}

/// Forces of a pack, and the power that damping takes out.
struct Packed<'a>(&'a [Rod], &'a [At<f64>], &'a [Rates<f64>], &'a mut Vec<f64>);

impl crate::math::lanes::Vectorized for Packed<'_> {
    fn run<S: Simd>(self, simd: S) {
        let Self(rods, at, rates, out) = self;
        let lanes = |of: &dyn Fn(usize) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(lane.min(rods.len() - 1)))
        };
        let e: [[_; 3]; 4] =
            std::array::from_fn(|k| std::array::from_fn(|i| lanes(&|n| at[n].e[k][i])));
        let d: [[_; 3]; 2] =
            std::array::from_fn(|k| std::array::from_fn(|i| lanes(&|n| at[n].d[k][i])));
        let bubble = lanes(&|n| at[n].bubble);
        let v: [[_; 3]; 4] =
            std::array::from_fn(|k| std::array::from_fn(|i| lanes(&|n| rates[n].e[k][i])));
        let spin: [_; 2] = std::array::from_fn(|k| lanes(&|n| rates[n].spin[k]));
        let bubble_rate = lanes(&|n| rates[n].bubble);
        let at = At {
            e: e.each_ref().map(|v| v.each_ref()),
            d: d.each_ref().map(|v| v.each_ref()),
            bubble: &bubble,
        };
        let moves = Rates {
            e: v.each_ref().map(|v| v.each_ref()),
            spin: spin.each_ref(),
            bubble: &bubble_rate,
        };
        let pack = Rod::pack(rods);
        let zero = [0.0; PACK];
        for rates in [None, Some(&moves)] {
            let motion = ElementMotion { at: &at, rates };
            let mut force = Force {
                e: [[zero; 3]; 4],
                torque: [zero; 2],
                bubble: zero,
            };
            let power = Rod::pack_force(simd, &pack, motion, &mut force);
            let mut stiffness = [[zero; VELOCITIES]; VELOCITIES];
            let mut damping = stiffness;
            for (kind, out) in [
                (Tangent::Stiffness, &mut stiffness),
                (Tangent::Damping, &mut damping),
            ] {
                Rod::pack_tangent(simd, &pack, motion, kind, out);
            }
            for lane in 0..rods.len() {
                out.extend(force.flat().map(|force| force[lane]));
                for r in 0..VELOCITIES {
                    out.extend(stiffness[r][..=r].iter().map(|entry| entry[lane]));
                    out.extend(damping[r][..=r].iter().map(|entry| entry[lane]));
                }
            }
            out.push(power);
        }
    }
}

#[test]
fn packs_are_as_their_elements() {
    for (case, rod) in rods().iter().enumerate() {
        for (count, lanes) in [(1, false), (PACK, true), (5, true)] {
            let rods = vec![rod.clone(); count];
            let at: Vec<_> = (0..count as u64).map(|n| bent(50 + n, 0.5)).collect();
            let rates: Vec<_> = (0..count as u64).map(|n| Noise(n).rates()).collect();
            let mut found = Vec::new();
            crate::math::lanes::vectorized_where(lanes, Packed(&rods, &at, &rates, &mut found));
            let mut wanted = Vec::new();
            for damped in [false, true] {
                let mut sum = 0.0;
                for n in 0..count {
                    let (force, power) = rod.force(&at[n], damped.then_some(&rates[n]));
                    wanted.extend(force.flat());
                    let stiffness = rod.stiffness(&at[n], damped.then_some(&rates[n]));
                    let damping = rod.damping(&at[n]);
                    for r in 0..VELOCITIES {
                        wanted.extend(&stiffness[r][..=r]);
                        wanted.extend(&damping[r][..=r]);
                    }
                    sum += power;
                }
                wanted.push(sum);
            }
            for (a, b) in found.iter().zip(&wanted) {
                assert!((a - b).abs() < 1e-13 * (1.0 + b.abs()), "{case} {a} {b}");
            }
            assert_eq!(found.len(), wanted.len());
        }
    }
}

#[test]
fn plane_bending_is_that_of_a_cable() {
    use crate::elements::cable::{Cable, Inertia, LineOf};
    let turn = Rotation3::new(V::new(0.4, -1.2, 0.7));
    let flat = [[0.1, 0.2], [0.9, -0.3], [0.65, 0.3], [1.0, 0.6]];
    let e = flat.map(|[x, y]| <[f64; 3]>::from(turn * V::new(x, y, 0.0)));
    let cable = crate::elements::cable::Parameters {
        length: 0.7,
        axial_stiffness: 0.0,
        bending_stiffness: 2.0,
        line_of: LineOf::Cable,
        line_density: 1.0,
        axial_damping_time: 0.0,
        bending_damping_time: 0.0,
        strain: crate::elements::StrainMeasure::ThetaPrime,
        inertia: Inertia::Consistent,
    };
    let cable = Cable::<3>::new(cable, None);
    let wanted = cable.energy(&Nodal::<3>::from(e));
    let across = [e[1], e[3]].map(|u| (turn * V::z()).cross(&V::from(u)).normalize());
    for angle in [0.0, 0.3, 2.0] {
        let d = across.map(|n| (turn * V::z() * f64::cos(angle) + n * f64::sin(angle)).into());
        let at = At { e, d, bubble: 0.0 };
        for is_round in [true, false] {
            let mut rod = rods()[2].clone();
            assert!(rod.kernel.geometry.is_round);
            rod.kernel.geometry.is_round = is_round;
            let energy = rod.energy(&at);
            assert!(
                (energy - wanted).abs() < 1e-13 * wanted,
                "{angle} {energy} {wanted}"
            );
            assert!(rod.strains(&at, 0.3)[0].abs() < 1e-13);
        }
        if angle == 0.0 {
            let mut parameters = ROUND;
            parameters.stiffness = parameters.stiffness.map(|mut stiffness| {
                stiffness[2][2] = 100.0;
                stiffness
            });
            let energy = Rod::new(parameters, &bent(1, 0.0)).energy(&at);
            assert!((energy - wanted).abs() < 1e-13 * wanted);
        }
    }
}

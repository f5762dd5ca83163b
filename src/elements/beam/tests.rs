//! Laws of one element.
//!
//! Source: derivatives of the energy by differences; rotations and the exchange of ends; closed forms of a stretched, sheared and
//! twisted straight beam.

use nalgebra::{Matrix3, Rotation3, SMatrix, SVector, Vector3};

use super::*;
use crate::elements::line::dot;
use crate::elements::rod::tests::Noise;
use crate::elements::section::spin_inertia;
use crate::math::jet::Jet;

type V = Vector3<f64>;

fn rates(seed: u64) -> Rates<f64> {
    let mut noise = Noise(seed);
    let mut vector = || noise.vector().into();
    Rates {
        e: std::array::from_fn(|_| vector()),
        spin: [vector(), vector()],
        inner: vector(),
    }
}

/// Axes rotated from those of space.
fn turned(turn: &Rotation3<f64>) -> [[f64; 3]; 3] {
    [V::x(), V::y(), V::z()].map(|axis| (turn * axis).into())
}

/// An element that is bent, twisted and sheared.
fn bent(seed: u64, by: f64) -> At<f64> {
    let mut noise = Noise(seed);
    let [a, b, c, d, f, g, h] = std::array::from_fn(|_| noise.vector() * by);
    At {
        e: [
            a.into(),
            (V::x() + b).into(),
            (V::x() * 0.7 + a + c * 0.3).into(),
            (V::x() + d).into(),
        ],
        axes: [f, g].map(|turn| turned(&Rotation3::new(turn))),
        inner: (h * 0.5).into(),
    }
}

/// A positive matrix that couples all components.
fn coupled(seed: u64) -> [[f64; 6]; 6] {
    let mut noise = Noise(seed);
    let root: [[f64; 6]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| noise.next()));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| dot(&root[i], &root[j]) + f64::from(u8::from(i == j)))
    })
}

fn matrix(of: [[f64; 6]; 6]) -> SMatrix<f64, 6, 6> {
    SMatrix::from_fn(|i, j| of[i][j])
}

fn parameters(seeds: [u64; 3]) -> Parameters {
    Parameters {
        length: 0.7,
        stiffness: seeds.map(coupled),
        damping_times: [0.1, 0.02, 0.3, 0.07, 0.2, 0.05],
    }
}

fn beams() -> [Beam; 3] {
    [
        Beam::new(parameters([1; 3]), &bent(2, 0.3)),
        Beam::new(parameters([4; 3]), &bent(1, 0.0)),
        Beam::new(parameters([1, 2, 3]), &bent(3, 0.3)),
    ]
}

/// Moved by a small time with these velocities.
pub(super) fn moved(at: &At<f64>, rates: &Rates<f64>, time: f64) -> At<f64> {
    let ahead = |x: [f64; 3], v: [f64; 3]| std::array::from_fn(|i| x[i] + time * v[i]);
    At {
        e: std::array::from_fn(|k| ahead(at.e[k], rates.e[k])),
        axes: std::array::from_fn(|k| {
            let axes = Matrix3::from(at.axes[k]);
            let turn = Rotation3::new(V::from(rates.spin[k]) * time);
            (axes * turn.matrix()).into()
        }),
        inner: ahead(at.inner, rates.inner),
    }
}

fn power(force: &Force<f64>, rates: &Rates<f64>) -> f64 {
    let of = Force {
        e: rates.e,
        moment: rates.spin,
        inner: rates.inner,
    };
    dot(&force.flat(), &of.flat())
}

#[test]
fn force_is_minus_the_gradient_of_the_energy() {
    let h = 1e-4;
    for (case, beam) in beams().iter().enumerate() {
        for seed in 10..20 {
            let at = bent(seed, 0.5);
            let force = beam.force(&at, None).0;
            let rates = rates(seed);
            let energy = |time: f64| beam.energy(&moved(&at, &rates, time));
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
    let vector = |start: usize| [0, 1, 2].map(|i| one(start + i));
    Rates {
        e: [0, 3, 9, 12].map(vector),
        spin: [6, 15].map(vector),
        inner: vector(18),
    }
}

/// An element that moves.
fn moving(at: &At<f64>, rates: &Rates<f64>) -> At<Jet> {
    let jets = |x: [f64; 3], v: [f64; 3]| std::array::from_fn(|i| Jet::new(x[i], v[i], 0.0));
    At {
        e: std::array::from_fn(|k| jets(at.e[k], rates.e[k])),
        axes: std::array::from_fn(|k| {
            let rates = at.axes_rate(rates, k);
            std::array::from_fn(|axis| jets(at.axes[k][axis], rates[axis]))
        }),
        inner: jets(at.inner, rates.inner),
    }
}

#[test]
fn stiffness_and_damping_are_derivatives_of_the_force() {
    for (case, beam) in beams().iter().enumerate() {
        for seed in 10..14 {
            let at = bent(seed, 0.5);
            let (stiffness, damping) = (beam.stiffness(&at, None), beam.damping(&at));
            let elastic = beam.force(&at, None).0.flat();
            let columns: [_; VELOCITIES] = std::array::from_fn(|k| {
                let force = beam.force(&moving(&at, &unit_velocity(k)), None).0;
                force.flat().map(|force| -force.v1)
            });
            for j in 0..VELOCITIES {
                let damped = beam.force(&at, Some(&unit_velocity(j))).0.flat();
                for i in 0..VELOCITIES {
                    let mean = 0.5 * (columns[i][j] + columns[j][i]);
                    let size = 1.0 + mean.abs();
                    let found = stiffness[i][j];
                    assert!(
                        (found - mean).abs() < 1e-13 * size,
                        "{case} {i} {j} {found} {mean}"
                    );
                    let miss = damping[i][j] - (elastic[i] - damped[i]);
                    assert!(miss.abs() < 1e-11, "{case} {i} {j} {miss}");
                }
            }
        }
    }
}

#[test]
fn stresses_that_damping_adds_stiffen_as_any() {
    let h = 1e-4;
    for (case, beam) in beams().iter().enumerate() {
        let (at, rates) = (bent(10, 0.5), rates(4));
        let mut other = beam.clone();
        for (k, point) in POINTS.iter().enumerate() {
            let strains = |time: f64| {
                SVector::<f64, 6>::from(beam.strains(&moved(&at, &rates, time), point.at))
            };
            let [near, far] = [h, 2.0 * h].map(|time| strains(time) - strains(-time));
            let stress = matrix(beam.kernel.law.damping[k]) * (8.0 * near - far) / (12.0 * h);
            let stiffness = matrix(beam.kernel.law.stiffness[k]).cholesky();
            let shift = stiffness.expect("positive").solve(&stress);
            for (offset, shift) in other.kernel.law.offset[k].iter_mut().zip(shift.iter()) {
                *offset += shift;
            }
        }
        let [found, wanted] = [
            beam.stiffness(&at, Some(&rates)),
            other.stiffness(&at, None),
        ];
        for (a, b) in found.as_flattened().iter().zip(wanted.as_flattened()) {
            assert!((a - b).abs() < 1e-8 * (1.0 + b.abs()), "{case} {a} {b}");
        }
    }
}

#[test]
fn rotating_everything_leaves_the_energy() {
    for (case, beam) in beams().iter().enumerate() {
        for seed in 20..30 {
            let mut at = bent(seed, 0.5);
            let before = beam.energy(&at);
            let turn = Rotation3::new(Noise(seed).vector() * 3.0);
            let shift = Noise(seed + 1).vector();
            at.e = at.e.map(|v| (turn * V::from(v)).into());
            for k in [0, 2] {
                at.e[k] = (V::from(at.e[k]) + shift).into();
            }
            at.axes = at.axes.map(|axes| axes.map(|v| (turn * V::from(v)).into()));
            let change = beam.energy(&at) - before;
            assert!(change.abs() < 3e-14 * before, "{case} {seed} {change}");
        }
    }
}

/// Seen from the last end: tangents and normals rotate round, and the third axes.
fn from_the_last_end(at: &At<f64>) -> At<f64> {
    let ([ra, ua, rb, ub], [beta, p, q]) = (at.e, at.inner);
    let round =
        |[first, second, third]: [[f64; 3]; 3]| [first.map(|x| -x), second, third.map(|x| -x)];
    At {
        e: [rb, ub.map(|x| -x), ra, ua.map(|x| -x)],
        axes: [round(at.axes[1]), round(at.axes[0])],
        inner: [-beta, p, -q],
    }
}

#[test]
fn both_ends_are_alike() {
    let given = parameters([1, 2, 3]);
    let mut other = given;
    let signs = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
    for stiffness in &mut other.stiffness {
        for i in 0..6 {
            for j in 0..6 {
                stiffness[i][j] *= signs[i] * signs[j];
            }
        }
    }
    other.stiffness.reverse();
    let shape = bent(2, 0.3);
    let beam = Beam::new(given, &shape);
    let turned = Beam::new(other, &from_the_last_end(&shape));
    for seed in 30..40 {
        let at = bent(seed, 0.5);
        let energy = beam.energy(&at);
        let change = turned.energy(&from_the_last_end(&at)) - energy;
        assert!(change.abs() < 1e-14 * energy, "{seed} {change}");
    }
}

#[test]
fn damping_takes_out_what_its_force_does() {
    for beam in &beams() {
        for seed in 40..60 {
            let (at, rates) = (bent(seed, 0.5), rates(seed));
            let (damped, taken) = beam.force(&at, Some(&rates));
            let elastic = beam.force(&at, None).0;
            let work = power(&elastic, &rates) - power(&damped, &rates);
            assert!(taken >= 0.0 && (work - taken).abs() < 1e-12 * (1.0 + taken));
            // The rates of strain are those of the strains.
            let h = 1e-4;
            let mut expected = 0.0;
            for (damping, point) in beam.kernel.law.damping.iter().zip(&POINTS) {
                let strains = |time: f64| beam.strains(&moved(&at, &rates, time), point.at);
                let [near, far] = [h, 2.0 * h].map(|time| {
                    let [a, b] = [strains(time), strains(-time)];
                    std::array::from_fn::<_, 6, _>(|k| a[k] - b[k])
                });
                let rate: [f64; 6] = std::array::from_fn(|k| (8.0 * near[k] - far[k]) / (12.0 * h));
                let stress = damping.map(|row| dot(&row, &rate));
                expected += 0.7 * point.weight * dot(&stress, &rate);
            }
            assert!((taken - expected).abs() < 1e-8 * (1.0 + taken));
        }
    }
}

/// Velocities of a rigid motion: a spin about the origin and a translation.
fn rigid(at: &At<f64>, spin: V, speed: V) -> Rates<f64> {
    let turned = |k: usize| {
        let v = spin.cross(&V::from(at.e[k]));
        if k.is_multiple_of(2) { v + speed } else { v }
    };
    Rates {
        e: std::array::from_fn(|k| turned(k).into()),
        spin: at
            .axes
            .map(|axes| axes.map(|axis| spin.dot(&V::from(axis)))),
        inner: [0.0; 3],
    }
}

#[test]
fn rigid_motion_takes_no_power() {
    for beam in &beams() {
        for seed in 60..70 {
            let (at, mut noise) = (bent(seed, 0.5), Noise(seed));
            let (spin, speed) = (noise.vector(), noise.vector());
            let rates = rigid(&at, spin, speed);
            let (force, taken) = beam.force(&at, Some(&rates));
            assert!(power(&force, &rates).abs() < 1e-12 && taken < 1e-26);
            for end in 0..2 {
                for (rate, axis) in at.axes_rate(&rates, end).iter().zip(at.axes[end]) {
                    let miss = V::from(*rate) - spin.cross(&V::from(axis));
                    assert!(miss.norm() < 1e-15);
                }
            }
        }
    }
}

/// Forces of a pack, and the power that damping takes out.
struct Packed<'a>(
    &'a [Beam],
    &'a [At<f64>],
    &'a [Rates<f64>],
    &'a mut Vec<f64>,
);

/// Numbers of elements side by side.
fn side_by_side<const K: usize>(
    count: usize,
    of: impl Fn(usize) -> [[f64; 3]; K],
) -> [[[f64; PACK]; 3]; K] {
    let all: [_; PACK] = std::array::from_fn(|lane| of(lane.min(count - 1)));
    std::array::from_fn(|k| std::array::from_fn(|d| all.map(|one| one[k][d])))
}

impl crate::math::lanes::Vectorized for Packed<'_> {
    fn run<S: Simd>(self, simd: S) {
        let Self(beams, at, rates, out) = self;
        let count = beams.len();
        let e = side_by_side(count, |n| at[n].e);
        let axes = [0, 1].map(|k| side_by_side(count, |n| at[n].axes[k]));
        let [inner] = side_by_side(count, |n| [at[n].inner]);
        let v = side_by_side(count, |n| rates[n].e);
        let spin = side_by_side(count, |n| rates[n].spin);
        let [inner_rate] = side_by_side(count, |n| [rates[n].inner]);
        let at = At {
            e: e.each_ref().map(|v| v.each_ref()),
            axes: axes
                .each_ref()
                .map(|axes| axes.each_ref().map(|v| v.each_ref())),
            inner: inner.each_ref(),
        };
        let moves = Rates {
            e: v.each_ref().map(|v| v.each_ref()),
            spin: spin.each_ref().map(|v| v.each_ref()),
            inner: inner_rate.each_ref(),
        };
        let pack = Beam::pack(beams);
        let zero = [0.0; PACK];
        for rates in [None, Some(&moves)] {
            let motion = ElementMotion { at: &at, rates };
            let mut force = Force {
                e: [[zero; 3]; 4],
                moment: [[zero; 3]; 2],
                inner: [zero; 3],
            };
            let power = Beam::pack_force(simd, &pack, motion, &mut force);
            let mut stiffness = [[zero; VELOCITIES]; VELOCITIES];
            let mut damping = stiffness;
            for (kind, out) in [
                (Tangent::Stiffness, &mut stiffness),
                (Tangent::Damping, &mut damping),
            ] {
                Beam::pack_tangent(simd, &pack, motion, kind, out);
            }
            for lane in 0..count {
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
    for (case, beam) in beams().iter().enumerate() {
        for (count, lanes) in [(1, false), (PACK, true), (5, true)] {
            let beams: Vec<_> = (0..count as u64)
                .map(|n| match n {
                    0 => beam.clone(),
                    _ => Beam::new(parameters([n, n + 1, n + 2]), &bent(n, 0.3)),
                })
                .collect();
            let at: Vec<_> = (0..count as u64).map(|n| bent(50 + n, 0.5)).collect();
            let moves: Vec<_> = (0..count as u64).map(rates).collect();
            let mut found = Vec::new();
            crate::math::lanes::vectorized_where(lanes, Packed(&beams, &at, &moves, &mut found));
            let mut wanted = Vec::new();
            for damped in [false, true] {
                let mut sum = 0.0;
                for n in 0..count {
                    let (force, power) = beams[n].force(&at[n], damped.then_some(&moves[n]));
                    wanted.extend(force.flat());
                    let stiffness = beams[n].stiffness(&at[n], damped.then_some(&moves[n]));
                    let damping = beams[n].damping(&at[n]);
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
fn a_straight_beam_has_its_strains() {
    // Stretched by 1.1, sections with a shear rotation of 0.2 rad about their second axis, which rotates evenly by 0.5 rad along the beam.
    let (stretch, angle, twist) = (1.1, 0.2_f64, 0.5);
    let shear_rotation = Rotation3::new(V::y() * angle);
    let axes = [0.0, twist].map(|by| turned(&(Rotation3::new(V::x() * by) * shear_rotation)));
    let u: [f64; 3] = (V::x() * stretch).into();
    let at = At {
        e: [[0.0; 3], u, u.map(|x| x * 0.7), u],
        axes,
        inner: [0.0; 3],
    };
    let beam = &beams()[1];
    let (sin, cos) = angle.sin_cos();
    let rate = twist / 0.7;
    let wanted = [
        stretch * cos - 1.0,
        0.0,
        stretch * sin,
        rate * cos,
        0.0,
        rate * sin,
    ];
    for xi in [0.0, 0.3, 1.0] {
        for (found, wanted) in beam.strains(&at, xi).iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
        }
    }
}

#[test]
fn inertia_is_that_of_twists_interpolated_and_of_turns_at_the_ends() {
    // Of an even density, and of one that grows in proportion to the way along the element.
    let even = [[20.0, 20.0, 10.0], [20.0, 32.0, 20.0], [10.0, 20.0, 20.0]];
    let rising = [[5.0, 8.0, 5.0], [8.0, 16.0, 12.0], [5.0, 12.0, 15.0]];
    let at_ends = [[30.0, 32.0, 30.0], [10.0, 16.0, 20.0]];
    let moments = [[3.0, 0.0, 0.0], [0.0, 1.0, 0.3], [0.0, 0.3, 2.0]];
    for ((shapes, slope), ends) in [(even, 0.0), (rising, 1.0)].into_iter().zip(at_ends) {
        let density = |xi: f64| Matrix3::from(moments) * (1.0 - slope + slope * xi);
        let inertia = spin_inertia(0.7, density);
        for r in 0..9 {
            for c in 0..9 {
                let (i, j) = (r / 3, c / 3);
                let shape = match (r % 3, i == j) {
                    (0, _) => shapes[i][j],
                    (_, true) => ends[i],
                    _ => 0.0,
                };
                let wanted = 0.7 * moments[r % 3][c % 3] * shape / 60.0;
                let found = inertia[r / 3][c / 3][r % 3][c % 3];
                assert!((found - wanted).abs() < 1e-15, "{r} {c}");
            }
        }
    }
}

//! Laws of one planar element, and the beam of space that moves in a plane.
//!
//! Source: derivatives of the energy by differences; rotations; closed forms of a straight beam that is stretched, sheared and bent.

use nalgebra::{Rotation3, Vector3};

use super::*;
use crate::elements::beam::{self, Beam};
use crate::elements::line::dot;
use crate::elements::rod::tests::Noise;

const LENGTH: f64 = 0.7;

/// Line and angles of the three sections.
type State = [f64; 11];

fn axes(angle: f64) -> [[f64; 3]; 3] {
    let (s, c) = angle.sin_cos();
    [[c, s, 0.0], [0.0, 0.0, 1.0], [s, -c, 0.0]]
}

/// Where an element is with these numbers in the order of [`PLACES`].
fn at(x: &State) -> At<f64> {
    let [a, b, c, d, first, e, f, g, h, last, middle] = *x;
    let (s, m) = middle.sin_cos();
    At {
        e: [[a, b, 0.0], [c, d, 0.0], [e, f, 0.0], [g, h, 0.0]],
        axes: [axes(first), axes(last)],
        inner: [m, s, 0.0],
    }
}

fn rates(x: &State) -> Rates<f64> {
    let [a, b, c, d, first, e, f, g, h, last, middle] = *x;
    Rates {
        e: [[a, b, 0.0], [c, d, 0.0], [e, f, 0.0], [g, h, 0.0]],
        spin: [[0.0, first, 0.0], [0.0, last, 0.0]],
        inner: [0.0, middle, 0.0],
    }
}

fn flat(force: &Force<f64>) -> State {
    PLACES.map(|place| force.flat()[place])
}

fn noise(seed: u64) -> State {
    let mut noise = Noise(seed);
    std::array::from_fn(|_| noise.next())
}

/// An element that is bent and sheared.
fn bent(seed: u64) -> State {
    let straight = [0.1, 0.2, 1.0, 0.1, 0.1, 0.8, 0.2, 0.9, -0.2, 0.2, 0.1];
    let noise = noise(seed);
    std::array::from_fn(|k| straight[k] + 0.3 * noise[k])
}

fn coupled(seed: u64) -> [[f64; 3]; 3] {
    let mut noise = Noise(seed);
    let root: [[f64; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| noise.next()));
    let one = |i: usize, j: usize| f64::from(u8::from(i == j));
    std::array::from_fn(|i| std::array::from_fn(|j| dot(&root[i], &root[j]) + one(i, j)))
}

fn beam(seeds: [u64; 3], shape: &State) -> Planar {
    let parameters = Parameters {
        length: LENGTH,
        stiffness: seeds.map(coupled),
        damping_times: [0.1, 0.02, 0.3],
    };
    Planar::new(parameters, &at(shape))
}

fn moved(x: &State, by: &State, time: f64) -> State {
    std::array::from_fn(|k| x[k] + time * by[k])
}

/// Derivative of order 4.
fn slope<const K: usize>(of: impl Fn(f64) -> [f64; K]) -> [f64; K] {
    let h = 3e-4;
    let [a, b, c, d] = [-2.0 * h, -h, h, 2.0 * h].map(of);
    std::array::from_fn(|k| (8.0 * (c[k] - b[k]) - d[k] + a[k]) / (12.0 * h))
}

#[test]
fn force_is_minus_the_gradient_of_the_energy() {
    for seed in 10..30 {
        let (x, by) = (bent(seed), noise(seed + 100));
        let beam = beam([1, 2, 3], &bent(seed + 50));
        let [wanted] = slope(|time| [beam.energy(&at(&moved(&x, &by, time)))]);
        let found = dot(&flat(&beam.force(&at(&x), None).0), &by);
        let off = (found + wanted).abs();
        assert!(off < 1e-8 * (1.0 + wanted.abs()), "{found} {wanted}");
    }
}

#[test]
fn tangents_are_derivatives_of_forces() {
    for seed in 10..30 {
        let (x, by, v) = (bent(seed), noise(seed + 100), noise(seed + 200));
        let (beam, at_rest) = (beam([1, 2, 3], &bent(seed + 50)), at(&x));
        let stiffness = beam.stiffness(&at_rest, None);
        let damping = beam.damping(&at_rest);
        let by_place = slope(|time| flat(&beam.force(&at(&moved(&x, &by, time)), None).0));
        let by_rate = slope(|time| {
            let rates = rates(&moved(&v, &by, time));
            flat(&beam.force(&at_rest, Some(&rates)).0)
        });
        for (k, place) in PLACES.into_iter().enumerate() {
            for (matrix, wanted) in [(&stiffness, by_place[k]), (&damping, by_rate[k])] {
                let row = PLACES.map(|column| matrix[place][column]);
                let found = -dot(&row, &by);
                let off = (found - wanted).abs();
                assert!(off < 1e-8 * (1.0 + wanted.abs()), "{k}: {found} {wanted}");
            }
        }
        // Where stresses of damping are taken as given, they stiffen as others do.
        let rates = rates(&v);
        let stressed = beam.stiffness(&at_rest, Some(&rates));
        let still = |time: f64| {
            let there = at(&moved(&x, &by, time));
            flat(&beam.force(&there, None).0)
        };
        assert_ne!(stressed, stiffness);
        assert!(slope(still).iter().all(|f| f.is_finite()));
    }
}

#[test]
fn damping_takes_out_what_its_force_does() {
    for seed in 10..20 {
        let (x, v) = (bent(seed), noise(seed + 200));
        let beam = beam([1, 2, 3], &bent(seed + 50));
        let (force, power) = beam.force(&at(&x), Some(&rates(&v)));
        let elastic = beam.force(&at(&x), None).0;
        let lost = dot(&flat(&elastic), &v) - dot(&flat(&force), &v);
        assert!(power > 0.0 && (lost - power).abs() < 1e-12 * (1.0 + power));
    }
}

/// The planar beam agrees with the spatial one. Only the internal shear rotation is another number.
#[test]
fn it_is_the_beam_of_space_in_a_plane() {
    for seed in 10..30 {
        let (x, v, shape) = (bent(seed), noise(seed + 100), bent(seed + 50));
        let planar = beam([4; 3], &shape);
        let mut stiffness = [[0.0; 6]; 6];
        for (r, row) in coupled(4).iter().enumerate() {
            for (c, entry) in row.iter().enumerate() {
                stiffness[2 * r][2 * c] = *entry;
            }
        }
        let shear_rotation = |slope: [f64; 2], normal: [f64; 2]| {
            let size = slope[0].hypot(slope[1]);
            let sine = slope[0] * normal[1] - slope[1] * normal[0];
            2.0 * sine / (size + slope[0] * normal[0] + slope[1] * normal[1])
        };
        let spatial = |x: &State| {
            let mut at = at(x);
            let [_, a, _, b] = at.e.map(|v| [v[0], v[1]]);
            let chord = [0, 1].map(|k| (at.e[2][k] - at.e[0][k]) / LENGTH);
            let middle = [0, 1].map(|k| 1.5 * chord[k] - 0.25 * (a[k] + b[k]));
            let normals = at.axes.map(|axes| [axes[0][0], axes[0][1]]);
            let mean = 0.5 * (shear_rotation(a, normals[0]) + shear_rotation(b, normals[1]));
            let own = shear_rotation(middle, [at.inner[0], at.inner[1]]);
            at.inner = [0.0, own - mean, 0.0];
            at
        };
        let parameters = beam::Parameters {
            length: LENGTH,
            stiffness: [stiffness; 3],
            damping_times: [0.0; 6],
        };
        // The unstressed shape of the other has no internal shear rotation.
        let mut still = spatial(&shape);
        still.inner = [0.0; 3];
        let whole = Beam::new(parameters, &still);
        let mut straight = shape;
        let between = |x: &State| {
            let at = spatial(x);
            at.inner[1]
        };
        for _ in 0..20 {
            straight[10] -= between(&straight);
        }
        let planar_too = beam([4; 3], &straight);
        let (a, b) = (planar_too.energy(&at(&x)), whole.energy(&spatial(&x)));
        assert!((a - b).abs() < 1e-12 * (1.0 + b), "{a} {b}");
        assert!(planar.energy(&at(&x)).is_finite() && v.iter().all(|v| v.is_finite()));
    }
}

#[test]
fn nothing_sees_rigid_motion() {
    for seed in 10..20 {
        let x = bent(seed);
        let beam = beam([1, 2, 3], &bent(seed + 50));
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.3 * seed as f64);
        let mut turned = at(&x);
        for (k, vector) in turned.e.iter_mut().enumerate() {
            let moved = turn * Vector3::from(*vector);
            *vector =
                (moved + Vector3::new(1.0, -2.0, 0.0) * f64::from(u8::from(k % 2 == 0))).into();
        }
        for axes in &mut turned.axes {
            *axes = axes.map(|axis| (turn * Vector3::from(axis)).into());
        }
        turned.inner = (turn * Vector3::from(turned.inner)).into();
        let (a, b) = (beam.energy(&at(&x)), beam.energy(&turned));
        assert!((a - b).abs() < 1e-13 * (1.0 + a), "{a} {b}");
        let (force, other) = (beam.force(&at(&x), None).0, beam.force(&turned, None).0);
        for k in 0..4 {
            let back = turn.inverse() * Vector3::from(other.e[k]);
            assert!((back - Vector3::from(force.e[k])).norm() < 1e-12);
        }
        assert!((force.inner[1] - other.inner[1]).abs() < 1e-12);
    }
}

#[test]
fn a_straight_beam_stretches_shears_and_bends_alone() {
    let straight = [0.0, 0.0, 1.0, 0.0, 0.0, LENGTH, 0.0, 1.0, 0.0, 0.0, 0.0];
    let diagonal = [[5.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.0]];
    let parameters = Parameters {
        length: LENGTH,
        stiffness: [diagonal; 3],
        damping_times: [0.0; 3],
    };
    let beam = Planar::new(parameters, &at(&straight));
    // All sections rotated by the same angle against a line that is as long as it was.
    let mut sheared = straight;
    (sheared[4], sheared[9], sheared[10]) = (0.1, 0.1, 0.1);
    let (sin, cos) = 0.1_f64.sin_cos();
    let wanted = 0.5 * LENGTH * (5.0 * (cos - 1.0).powi(2) + 3.0 * sin * sin);
    assert!((beam.energy(&at(&sheared)) - wanted).abs() < 1e-15);
    // The right side of the section goes ahead of the line's.
    assert!((beam.strains(&at(&sheared), 0.3)[1] - sin).abs() < 1e-15);
    let mut stretched = straight;
    (stretched[2], stretched[5], stretched[7]) = (1.2, 1.2 * LENGTH, 1.2);
    assert!((beam.energy(&at(&stretched)) - 0.5 * LENGTH * 5.0 * 0.04).abs() < 1e-15);
    // Sections that rotate along it bend it without its line: to the rational shear rotation's order.
    let mut turned = straight;
    (turned[4], turned[9]) = (-1e-4, 1e-4);
    let bending = 2e-4 / LENGTH;
    let found = beam.strains(&at(&turned), 0.5)[2];
    assert!((found - bending).abs() < 1e-11, "{found} {bending}");
}

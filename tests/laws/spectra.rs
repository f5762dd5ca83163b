//! Eigenvalues of mechanisms in closed form: whirl, gyroscopic stability, spin, many copies; and those of many
//! coordinates against all of them, computed with dense matrices.

use std::f64::consts::PI;

use flexbody::elements::StrainMeasure;
use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::system::{Eigenvalue, SpectrumError, eigenvalues, linearized, natural_frequencies};
use nalgebra::Complex;

use crate::laws::built::Moving;
use crate::laws::closed::{bodies, ground, hold, on, rigid, started, still};
use crate::laws::mechanism::{Acting, At, Body, Kind, Mechanism, Place, Point};

/// Eigenvalues of a mechanism at rest or as it moves.
fn spectrum(mechanism: &Mechanism, moves: bool, count: usize) -> Vec<Eigenvalue> {
    let mut start = started(mechanism);
    if !moves {
        start.state.rates.fill(0.0);
    }
    let Moving {
        system,
        state,
        mut work,
    } = start;
    eigenvalues(&system, &[], &mut work, &state, count).expect("eigenvalues")
}

fn near(found: &[Eigenvalue], exact: &[[f64; 2]], allowed: f64) {
    assert_eq!(found.len(), exact.len());
    for (found, [decay, frequency]) in found.iter().zip(exact) {
        let off = (found.decay_rate - decay)
            .abs()
            .max((found.frequency - frequency).abs());
        assert!(
            off <= allowed,
            "{found:?} instead of {decay} and {frequency}"
        );
    }
}

/// A rigid disc in the middle of four springs that pull with `k` per length each, in a rotating frame.
fn disc([mass, inertia]: [f64; 2], [stiffness, damping]: [f64; 2], rotation: f64) -> Mechanism {
    let mut made = bodies(&[(rigid(mass, inertia), [0.0; 3])]);
    made.gravity *= 0.0;
    made.rotation = rotation;
    for (x, y) in [(2.0, 0.0), (-2.0, 0.0), (0.0, 2.0), (0.0, -2.0)] {
        made.loads.push(Acting::Spring {
            ends: [ground(x, y), on(0, 0.0, 0.0)],
            stiffness: 0.25 * stiffness,
            damping: 0.5 * damping,
            length: still(0.0),
        });
    }
    made
}

/// Jeffcott's rotor with damping that rotates along: with `z = x + i y` in the rotating frame
/// `z'' + (2 i W + 2 d) z' + (w^2 - W^2) z = 0`, `s = -(d + i W) +- sqrt(d^2 + 2 i d W - w^2)`. It whirls forward and
/// grows above the critical speed. Its spin is free: 0 twice.
#[test]
fn jeffcotts_rotor_whirls() {
    let (mass, natural, decay) = (2.0, 5.0, 0.3);
    for rotation in [1.3, 4.9, 5.1, 7.0] {
        let made = disc(
            [mass, 0.4],
            [mass * natural * natural, 2.0 * mass * decay],
            rotation,
        );
        let root = Complex::new(decay * decay - natural * natural, 2.0 * decay * rotation).sqrt();
        let mean = Complex::new(-decay, -rotation);
        let mut exact = [mean + root, mean - root].map(|s| [-s.re, s.im.abs()]);
        exact.sort_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
        let found = spectrum(&made, false, 4);
        near(&found, &[[0.0; 2], [0.0; 2], exact[0], exact[1]], 1e-6);
        assert_eq!(exact.iter().any(|s| s[0] < 0.0), rotation > natural);
    }
}

/// A ring on soft springs in a frame that rotates faster than it swings sits on top of a potential hill,
/// `w^2 - W^2 < 0`, and is kept there by gyroscopic forces alone: `W - w` and `W + w`. The least damping that rotates
/// along lets it fall.
#[test]
fn a_ring_is_stable_by_gyroscopic_forces_alone() {
    let (mass, natural, rotation) = (1.5, 3.0, 4.0);
    let ring = |damping: f64| disc([mass, mass], [mass * natural * natural, damping], rotation);
    let exact = [
        [0.0; 2],
        [0.0; 2],
        [0.0, rotation - natural],
        [0.0, rotation + natural],
    ];
    near(&spectrum(&ring(0.0), false, 4), &exact, 1e-7);
    let Moving {
        system,
        state,
        mut work,
    } = started(&ring(0.0));
    let found = natural_frequencies(&system, &[], &mut work, &state, 3).expect("frequencies");
    let off = (found[1] - 1.0).abs().max((found[2] - 7.0).abs());
    assert!(found[0].abs() < 1e-6 && off < 1e-7, "{found:?}");
    assert!(spectrum(&ring(1e-3), false, 3)[2].decay_rate < 0.0);
}

/// What spins or circles freely is not restored: 0 twice, however fast.
#[test]
fn free_rotation_has_the_eigenvalue_zero() {
    let mut made = bodies(&[
        (rigid(1.0, 0.3), [0.0, 0.0, 0.3]),
        (Body::Particle { mass: 2.0 }, [3.0, 0.0, 0.0]),
    ]);
    made.gravity *= 0.0;
    // Velocities and spins: see `rigid_rates`.
    made.noise = vec![0.0, 0.0, 4.0, 0.0, 2.0, 0.0];
    made.holds
        .push(hold(Kind::Distance(1.0), ground(2.0, 0.0), on(1, 0.0, 0.0)));
    let zeros = [[0.0; 2]; 8];
    near(&spectrum(&made, true, 8), &zeros, 1e-6);
    let Moving {
        system,
        state,
        mut work,
    } = started(&made);
    let found = eigenvalues(&system, &[], &mut work, &state, 9);
    assert_eq!(found, Err(SpectrumError::Count(9, 8)));
    assert!(state.rates.iter().any(|v| v.abs() > 1.0));
}

/// Ziegler's column: two massless links of length `l` with hinges of stiffness `k`, masses `2 m` at the middle and `m` at
/// the end, and a force `P` that follows the second link. Linearized:
/// `m l^2 [3 1; 1 1] a'' + [2 k - P l, P l - k; -k, k] a = 0`, so with `w^2 = x k / (m l^2)`:
/// `2 x^2 - (7 - 2 p) x + 1 = 0`, `p = P l / k`; double at `p = 7/2 - sqrt(2)`.
#[test]
fn zieglers_column_flutters() {
    let (m, l, k) = (0.7, 1.3, 2.9);
    let column = |p: f64| {
        let link = |mass: f64, x: f64| (rigid(mass, 1e-9), [x, 0.0, 0.0]);
        let mut made = bodies(&[link(2.0 * m, l), link(m, 2.0 * l)]);
        made.gravity *= 0.0;
        let hinge = Kind::Hinge([k, 0.0, 0.0]);
        made.holds
            .push(hold(hinge, ground(0.0, 0.0), on(0, -l, 0.0)));
        made.holds
            .push(hold(hinge, on(0, 0.0, 0.0), on(1, -l, 0.0)));
        made.loads.push(Acting::Force {
            at: Place {
                body: 1,
                at: At::Point([0.0; 2]),
            },
            follower: true,
            size: [still(-p * k / l), still(0.0)],
        });
        made
    };
    let unit = (k / (m * l * l)).sqrt();
    for p in [0.0, 0.8, 1.5, 2.0] {
        let b: f64 = 7.0 - 2.0 * p;
        let root = (b * b - 8.0).sqrt();
        let exact = [b - root, b + root].map(|x| [0.0, unit * (x / 4.0).sqrt()]);
        near(&spectrum(&column(p), false, 2), &exact, 1e-7);
        if p == 1.5 {
            assert!((exact[0][1] / unit - 0.5412).abs() < 1e-4);
            assert!((exact[1][1] / unit - 1.3066).abs() < 1e-4);
        }
    }
    let grows = |p: f64| {
        spectrum(&column(p), false, 2)
            .iter()
            .any(|s| s.decay_rate < -1e-4)
    };
    let flutter = bisect(1.5, 3.0, grows);
    assert!(
        (flutter - (3.5 - 2.0_f64.sqrt())).abs() < 1e-5,
        "flutter at {flutter}"
    );
    let Moving {
        system,
        state,
        mut work,
    } = started(&column(1.5));
    let found = natural_frequencies(&system, &[], &mut work, &state, 2);
    assert_eq!(found, Err(SpectrumError::NotConservative(1)));
}

/// Where something begins to hold.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    assert!(!holds(low) && holds(high));
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// A straight slender cable along the x axis, of unit length, `EI = rho A = 1`, clamped at its start if wanted.
fn beam(elements: usize, axial_stiffness: f64, damping_time: f64, clamped: bool) -> Mechanism {
    let length = 1.0 / elements as f64;
    let parameters = Parameters {
        length,
        axial_stiffness,
        bending_stiffness: 1.0,
        line_of: flexbody::elements::cable::LineOf::Cable,
        line_density: 1.0,
        axial_damping_time: damping_time,
        bending_damping_time: damping_time,
        strain: StrainMeasure::ThetaPrime,
        inertia: Inertia::Corrected,
    };
    let mut made = bodies(&[]);
    made.bodies
        .push(Body::Cable(vec![Cable::new(parameters, None); elements]));
    made.firsts.push(0);
    made.nodes = (0..=elements)
        .map(|i| [[i as f64 * length, 0.0], [1.0, 0.0]])
        .collect();
    made.gravity *= 0.0;
    if clamped {
        made.holds
            .push(hold(Kind::Weld(0.0), ground(0.0, 0.0), end(0.0)));
    }
    made
}

fn end(part: f64) -> Point {
    Point::On(Place {
        body: 0,
        at: At::Part(part),
    })
}

/// A force that follows the end, and the compression in which it is balanced.
fn push(made: &mut Mechanism, axial_stiffness: f64, force: f64) {
    for node in &mut made.nodes {
        node.as_flattened_mut()
            .iter_mut()
            .for_each(|x| *x *= 1.0 - force / axial_stiffness);
    }
    made.loads.push(Acting::Force {
        at: Place {
            body: 0,
            at: At::Part(1.0),
        },
        follower: true,
        size: [still(-force), still(0.0)],
    });
}

/// Kelvin-Voigt damping: `s^2 + tau w^2 s + w^2 = 0`, so a damping ratio `w tau / 2`, for every mode of a straight beam.
#[test]
fn the_damping_ratio_of_a_cantilever_is_proportional_to_frequency() {
    for elements in [6, 60] {
        let tau = 2e-3;
        let free = spectrum(&beam(elements, 1e5, 0.0, true), false, 6);
        let damped = spectrum(&beam(elements, 1e5, tau, true), false, 6);
        assert!((free[0].frequency - 3.516_015_268_500_151).abs() < 1e-4);
        for (free, damped) in free.iter().zip(damped) {
            let w = free.frequency;
            let ratio = 0.5 * w * tau;
            let exact = [ratio * w, w * (1.0 - ratio * ratio).sqrt()];
            near(&[damped], &[exact], 1e-7 * w);
        }
    }
}

/// Sizes of all eigenvalues of the equations as linearized, by faer.
fn dense(mechanism: &Mechanism) -> Vec<[f64; 2]> {
    let mut start = started(mechanism);
    start.state.rates.fill(0.0);
    let Moving {
        system,
        state,
        mut work,
    } = start;
    let [_, k, r] = linearized(&system, &[], &mut work, &state);
    let n = k.nrows();
    let rate = k.amax().sqrt();
    let matrix = faer::Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => rate * f64::from(u8::from(j - n == i)),
        (false, true) => -k[(i - n, j)] / rate,
        (false, false) => -r[(i - n, j - n)],
    });
    let values = matrix.eigenvalues().expect("eigenvalues");
    let upper = values
        .into_iter()
        .filter(|s| s.im >= 0.0)
        .map(|s| [-s.re, s.im]);
    let mut all: Vec<[f64; 2]> = upper.collect();
    all.sort_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
    all
}

/// Many coordinates: what is found by iteration is the beginning of the whole spectrum.
#[test]
fn few_eigenvalues_of_many_coordinates_are_those_of_dense_matrices() {
    let count = 6;
    let mut cases = Vec::new();
    for (tau, force, rotation) in [
        (0.0, 0.0, 0.0),
        (0.0, 15.0, 0.0),
        (0.0, 30.0, 0.0),
        (1e-2, 12.0, 0.0),
        (1e-3, 0.0, 6.0),
        (0.0, 0.0, 2.0),
    ] {
        let mut made = beam(24, 1e4, tau, true);
        if force > 0.0 {
            push(&mut made, 1e4, force);
        }
        made.rotation = rotation;
        cases.push(made);
    }
    // Overdamped: many slow real ones.
    cases.push(beam(24, 1e4, 3.0, true));
    for made in &cases {
        let all = dense(made);
        let found = spectrum(made, false, count);
        for (found, [decay, frequency]) in found.iter().zip(&all) {
            let off = (found.decay_rate - decay).hypot(found.frequency - frequency);
            let size = decay.hypot(*frequency);
            assert!(
                off < 1e-5 * size,
                "{found:?} instead of {decay} {frequency}"
            );
        }
    }
}

/// A hundred equal pendulums: each frequency a hundred times.
#[test]
fn copies_are_counted() {
    let part = |i: usize| {
        (
            Body::Particle {
                mass: 1.0 + i as f64,
            },
            [3.0 * i as f64, -0.5, 0.0],
        )
    };
    let mut made = bodies(&(0..100).map(part).collect::<Vec<_>>());
    for i in 0..100 {
        let x = 3.0 * i as f64;
        made.holds
            .push(hold(Kind::Distance(0.5), ground(x, 0.0), on(i, 0.0, 0.0)));
    }
    let exact = [0.0, (9.81_f64 / 0.5).sqrt()];
    near(&spectrum(&made, false, 7), &[exact; 7], 1e-6);
    let Moving {
        system,
        state,
        mut work,
    } = started(&made);
    let found = natural_frequencies(&system, &[], &mut work, &state, 100).expect("frequencies");
    assert!(
        found.iter().all(|w| (w - exact[1]).abs() < 1e-6),
        "{found:?}"
    );
    let found = natural_frequencies(&system, &[], &mut work, &state, 101);
    assert_eq!(found, Err(SpectrumError::Count(101, 100)));
}

/// A beam that nothing holds, and two that are alike: rigid motions first, then all else twice.
#[test]
fn rigid_motions_and_twins_are_there() {
    let one = beam(40, 1e4, 0.0, false);
    let mut two = one.clone();
    let nodes = one.nodes.iter().map(|[[x, y], d]| [[*x, y + 1.0], *d]);
    two.nodes.extend(nodes);
    two.bodies.push(one.bodies[0].clone());
    two.firsts.push(41);
    let frequencies = |made: &Mechanism, count: usize| {
        let Moving {
            system,
            state,
            mut work,
        } = started(made);
        natural_frequencies(&system, &[], &mut work, &state, count).expect("frequencies")
    };
    let exact = [
        22.373_285_448_061_32,
        61.672_822_867_920_25,
        120.903_391_727_123_8,
    ];
    let found = frequencies(&one, 6);
    assert!(found[..3].iter().all(|w| w.abs() < 1e-2), "{found:?}");
    for (found, exact) in found[3..].iter().zip(exact) {
        assert!(
            (found / exact - 1.0).abs() < 1e-5,
            "{found} instead of {exact}"
        );
    }
    let twins = frequencies(&two, 12);
    assert!(twins[..6].iter().all(|w| w.abs() < 1e-2), "{twins:?}");
    for (i, twin) in twins[6..].iter().enumerate() {
        assert!((twin / found[3 + i / 2] - 1.0).abs() < 1e-6);
    }
}

/// Beck's column: the first two frequencies of a cantilever meet under a force that follows its end at
/// `20.0509536 EI / L^2` (M. Beck, ZAMP 3, 1952; root of its characteristic equation,
/// `a^4 + b^4 + 2 a^2 b^2 cosh(a) cos(b) + a b (b^2 - a^2) sinh(a) sin(b)` double in `w`, `a^2 = sqrt(P^2/4 + w^2) - P/2`,
/// `b^2 = sqrt(P^2/4 + w^2) + P/2`). Axially stiff, so that it stays as long as it is.
#[test]
fn becks_column_flutters() {
    let column = |elements: usize, p: f64| {
        let mut made = beam(elements, 1e8, 0.0, true);
        push(&mut made, 1e8, p);
        made
    };
    for (elements, allowed) in [(10, 2e-3), (24, 1e-4)] {
        let grows = |p: f64| {
            let found = spectrum(&column(elements, p), false, 2);
            found.iter().any(|s| s.decay_rate < -1e-3)
        };
        let flutter = bisect(18.0, 22.0, grows);
        assert!(
            (flutter - 20.050_953_6).abs() < allowed,
            "{elements}: flutter at {flutter}"
        );
    }
    // At half the load its frequencies are roots of that equation.
    let p = 10.0_f64;
    for found in spectrum(&column(16, p), false, 3) {
        let w = found.frequency;
        let root = (0.25 * p * p + w * w).sqrt();
        let (a, b) = ((root - 0.5 * p).sqrt(), (root + 0.5 * p).sqrt());
        let value = a.powi(4)
            + b.powi(4)
            + 2.0 * a * a * b * b * a.cosh() * b.cos()
            + a * b * (b * b - a * a) * a.sinh() * b.sin();
        let size = (a * b).powi(2) * a.cosh() * PI;
        assert!((value / size).abs() < 1e-4, "{w}: {value} of {size}");
    }
}

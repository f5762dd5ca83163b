//! Every formulation against what does not come from it: its own energy, closed forms, and the product.

use std::f64::consts::{PI, TAU};

use super::basis::Held;
use super::corotational::{Inertia, Local};
use super::increments::stretch_of_a_turn;
use super::march::{Kind, run};
use super::rotations::Interpolation;
use super::scenes::{Choice, Played, Rod};
use super::statics::{cantilever, elastica};
use super::system::{Item, Joint, System, To};
use super::table::strain_turned;
use super::{Block, Body, Marker, Motion, Placement};

const fn rotations(elements: usize, degree: usize, reduced: bool) -> Choice {
    Choice::Rotations(elements, Interpolation { degree, reduced })
}

const CHOICES: [Choice; 9] = [
    Choice::Frame(3, 2, false),
    Choice::Frame(3, 2, true),
    Choice::Corotational(3, Local::Linear, Inertia::Cubic),
    Choice::Corotational(3, Local::ShallowArch, Inertia::Cubic),
    Choice::Corotational(3, Local::ShallowArch, Inertia::Lumped),
    rotations(3, 1, false),
    rotations(3, 1, true),
    rotations(2, 2, false),
    rotations(2, 2, true),
];

const ROD: Rod = Rod {
    length: 1.3,
    axial: 90.0,
    shear: 40.0,
    bending: 1.7,
    density: 2.1,
    rotary: 0.4,
};

fn number(i: usize, seed: f64) -> f64 {
    (12.9898 * (i as f64 + seed)).sin()
}

/// A state that is bent, stretched, rotated and moves.
fn moved(body: &dyn Body) -> [Vec<f64>; 3] {
    let placement = Placement {
        start: [0.4, -0.3],
        angle: 2.1,
        velocity: [0.6, 1.1],
        spin: 1.9,
    };
    let [mut q, mut v] = body.place(&placement);
    q.iter_mut()
        .enumerate()
        .for_each(|(i, q)| *q += 0.1 * number(i, 0.3));
    v.iter_mut()
        .enumerate()
        .for_each(|(i, v)| *v += 0.5 * number(i, 0.7));
    let a = (0..q.len()).map(|i| 2.0 * number(i, 0.1)).collect();
    [q, v, a]
}

fn residual(body: &dyn Body, [q, v, a]: &[Vec<f64>; 3], gravity: [f64; 2]) -> Vec<f64> {
    let mut r = vec![0.0; q.len()];
    body.residual(Motion { q, v, a }, gravity, &mut r);
    r
}

/// A column of `w_0 dR/dq + w_1 dR/dv + w_2 dR/da`.
fn column(body: &dyn Body, [q, v, a]: &[Vec<f64>; 3], weights: [f64; 3], j: usize) -> Vec<f64> {
    let mut band = super::band::Band::zeros(q.len(), body.half_width());
    let mut block = Block {
        band: &mut band,
        offset: 0,
    };
    body.tangent(Motion { q, v, a }, GRAVITY, weights, &mut block);
    let mut unit = vec![0.0; q.len()];
    unit[j] = 1.0;
    band.times(&unit)
}

const GRAVITY: [f64; 2] = [0.7, -9.81];

/// Central differences of the residual by one number.
fn differences(body: &dyn Body, state: &[Vec<f64>; 3], which: usize, j: usize) -> Vec<f64> {
    let h = 1e-5;
    let at = |sign: f64| {
        let mut state = state.clone();
        state[which][j] += sign * h;
        residual(body, &state, GRAVITY)
    };
    let (plus, minus) = (at(1.0), at(-1.0));
    plus.iter()
        .zip(minus)
        .map(|(p, m)| (p - m) / (2.0 * h))
        .collect()
}

#[test]
fn tangents_are_derivatives() {
    for choice in CHOICES {
        let body = choice.rod(ROD, Held::Nothing);
        let mut state = moved(&*body);
        let is_corotational = matches!(choice, Choice::Corotational(..));
        for which in 0..3 {
            if is_corotational && which == 1 {
                // What is left out there: see `Corotational::tangent`.
                state[1].fill(0.0);
                state[2].fill(0.0);
                for k in 0..body.coordinates() / 3 {
                    state[2][3 * k] = GRAVITY[0];
                    state[2][3 * k + 1] = GRAVITY[1];
                }
                continue;
            }
            let mut weights = [0.0; 3];
            weights[which] = 1.0;
            for j in 0..body.coordinates() {
                if is_corotational && which == 0 {
                    state[1].fill(0.0);
                    state[2].fill(0.0);
                }
                let found = column(&*body, &state, weights, j);
                let expected = differences(&*body, &state, which, j);
                for (i, (f, e)) in found.iter().zip(expected).enumerate() {
                    // Weight and inertia in the frame of the chord are left out of the tangent of the corotational beam.
                    let left_out = if is_corotational && which == 0 {
                        30.0
                    } else {
                        1e-6
                    };
                    assert!(
                        (f - e).abs() < left_out * (1.0 + e.abs()),
                        "{choice:?} {which} {i} {j}: {f} {e}"
                    );
                }
            }
        }
    }
}

#[test]
fn forces_are_gradients_of_the_energy() {
    for choice in CHOICES {
        let body = choice.rod(ROD, Held::Nothing);
        let [q, v, a] = moved(&*body);
        let rest = [
            q.clone(),
            v.iter().map(|_| 0.0).collect(),
            a.iter().map(|_| 0.0).collect(),
        ];
        let force = residual(&*body, &rest, [0.0; 2]);
        for j in 0..q.len() {
            let h = 1e-5;
            let at = |sign: f64| {
                let mut q = q.clone();
                q[j] += sign * h;
                body.strain_energy(&q)
            };
            let slope = (at(1.0) - at(-1.0)) / (2.0 * h);
            assert!(
                (force[j] - slope).abs() < 1e-6 * (1.0 + slope.abs()),
                "{choice:?} {j}: {} {slope}",
                force[j]
            );
            // Its derivative too, exactly.
            let found = column(&*body, &rest, [1.0, 0.0, 0.0], j);
            let by = |sign: f64| {
                let mut moved = rest.clone();
                moved[0][j] += sign * h;
                residual(&*body, &moved, [0.0; 2])
            };
            if !matches!(choice, Choice::Frame(..)) {
                for (i, (plus, minus)) in by(1.0).iter().zip(by(-1.0)).enumerate() {
                    let expected = (plus - minus) / (2.0 * h);
                    assert!(
                        (found[i] - expected).abs() < 1e-6 * (1.0 + expected.abs()),
                        "{choice:?} {i} {j}"
                    );
                }
            }
        }
    }
}

/// Kinetic and strain energy, J.
fn energy(system: &mut System, [q, v]: &[Vec<f64>; 2]) -> f64 {
    let rest = vec![0.0; q.len()];
    let mut mass = system.band();
    let motion = Motion {
        q,
        v: &rest,
        a: &rest,
    };
    system.tangent(0.0, motion, &rest, [0.0, 0.0, 1.0], &mut mass);
    let momentum = mass.times(v);
    let kinetic: f64 = momentum.iter().zip(v).map(|(p, v)| 0.5 * p * v).sum();
    kinetic + system.strain_energy(q)
}

#[test]
fn energy_of_free_flight_is_conserved() {
    let placement = Placement {
        start: [0.0; 2],
        angle: 0.4,
        velocity: [1.0, -0.5],
        spin: 4.0,
    };
    for choice in CHOICES {
        let made = || {
            let body = choice.rod(ROD, Held::Nothing);
            let mut system = System::new(vec![Item::Body(body, placement)], Vec::new(), [0.0; 2]);
            let rates = system.start[1].iter_mut().enumerate();
            rates.for_each(|(i, v)| *v += 0.4 * number(i, 0.2));
            system
        };
        let lost = |kind: Kind| {
            let mut system = made();
            let start = system.start.clone();
            let before = energy(&mut system, &start);
            let seen = run(&mut system, kind, &[0.5, 1.0], &[]).expect("a run");
            (energy(&mut system, &seen.end) / before - 1.0).abs()
        };
        let (coarse, fine) = (lost(Kind::Explicit(0.2)), lost(Kind::Explicit(0.1)));
        assert!(
            fine < 1e-4 && (fine < 0.1 * coarse || fine < 1e-11),
            "{choice:?}: {coarse:e} {fine:e}"
        );
        let alpha = lost(Kind::Alpha(2e-4));
        assert!(alpha < 1e-4, "{choice:?}: {alpha:e} by generalized-alpha");
    }
}

#[test]
fn generalized_alpha_is_of_order_two() {
    let scene = Played::SpinUp;
    let choice = Choice::Frame(2, 0, true);
    let tip = |step: f64| {
        let seen = run(
            &mut scene.system(choice),
            Kind::Alpha(step),
            &[10.0],
            scene.places(),
        );
        seen.expect("a run").positions[0][0]
    };
    let [a, b, c] = [0.04, 0.02, 0.01].map(tip);
    let ratio = (a[0] - b[0]).hypot(a[1] - b[1]) / (b[0] - c[0]).hypot(b[1] - c[1]);
    assert!((3.7..4.3).contains(&ratio), "{ratio}");
}

#[test]
fn a_frame_without_modes_is_the_rigid_pendulum() {
    let reference = include_str!("../../../../tests/cases/steel_pendulum/reference.csv");
    let rows = reference.lines().skip(2).map(|line| {
        let numbers: Vec<f64> = line
            .split(',')
            .filter_map(|word| word.parse().ok())
            .collect();
        [numbers[1], numbers[2]]
    });
    let scene = Played::SteelPendulum;
    let choice = Choice::Frame(0, 0, false);
    let seen = run(
        &mut scene.system(choice),
        Kind::Alpha(1e-4),
        &scene.times(),
        scene.places(),
    );
    for (found, expected) in seen.expect("a run").positions.iter().zip(rows) {
        let off = (found[0][0] - expected[0]).hypot(found[0][1] - expected[1]);
        assert!(off < 1e-6, "{found:?} {expected:?}");
    }
}

/// Lowest frequency of a beam between two pins, one of which slides, over the closed form: inverse iteration.
fn lowest_frequency(choice: Choice) -> f64 {
    let rod = Rod {
        length: 1.0,
        axial: 1e6,
        shear: 1e9,
        bending: 1.0,
        density: 1.0,
        rotary: 1e-9,
    };
    let placement = Placement {
        start: [0.0; 2],
        angle: 0.0,
        velocity: [0.0; 2],
        spin: 0.0,
    };
    let items = vec![
        Item::Joint(Joint::Pin {
            at: Marker::Start.on(0),
            to: To::Ground([0.0; 2]),
        }),
        Item::Body(choice.rod(rod, Held::BothEnds), placement),
        Item::Joint(Joint::Guide {
            at: Marker::End.on(0),
            height: 0.0,
        }),
    ];
    let mut system = System::new(items, Vec::new(), [0.0; 2]);
    let [mut stiffness, mass] = system.matrices_at_rest();
    stiffness.factor().expect("a regular stiffness");
    let free = |z: &mut Vec<f64>| {
        let entries = z.iter_mut().zip(&system.multiplier);
        entries.for_each(|(z, held)| *z = if *held { 0.0 } else { *z });
    };
    let mut z: Vec<f64> = (0..system.size()).map(|i| 1.0 + number(i, 0.9)).collect();
    let mut square = 0.0;
    for _ in 0..60 {
        free(&mut z);
        let size = z.iter().map(|z| z * z).sum::<f64>().sqrt();
        z.iter_mut().for_each(|z| *z /= size);
        let mut next = mass.times(&z);
        free(&mut next);
        stiffness.solve(&mut next);
        free(&mut next);
        square = 1.0 / next.iter().map(|z| z * z).sum::<f64>().sqrt();
        z = next;
    }
    square.sqrt() / (PI * PI)
}

#[test]
fn a_pinned_beam_has_its_natural_frequency() {
    for (choice, within) in [
        (Choice::Frame(2, 1, true), 1e-6),
        (
            Choice::Corotational(8, Local::ShallowArch, Inertia::Cubic),
            3e-5,
        ),
        (rotations(32, 1, true), 2e-3),
        (rotations(8, 2, true), 2e-4),
    ] {
        let off = (lowest_frequency(choice) - 1.0).abs();
        assert!(off < within, "{choice:?}: {off:e}");
    }
}

/// Order of convergence from one number of elements to twice as many.
fn order(error: impl Fn(usize) -> f64, elements: usize) -> f64 {
    (error(elements) / error(2 * elements)).log2()
}

#[test]
fn large_static_deflections_converge() {
    let tip = |choice: Choice| elastica(choice, 1e8).expect("an equilibrium");
    for (made, expected) in [
        (
            &(|n| Choice::Corotational(n, Local::Linear, Inertia::Cubic))
                as &dyn Fn(usize) -> Choice,
            2.0,
        ),
        (
            &|n| Choice::Corotational(n, Local::ShallowArch, Inertia::Cubic),
            4.0,
        ),
        (&|n| rotations(n, 1, true), 2.0),
        (&|n| rotations(n, 2, true), 4.0),
    ] {
        let found = order(|n| tip(made(n)), 16);
        assert!(found > expected - 0.3, "{:?}: {found}", made(16));
        let fine = tip(made(64));
        assert!(fine < 2e-3, "{:?}: {fine:e}", made(64));
    }
}

#[test]
fn a_full_turn_rolls_up() {
    for choice in [
        Choice::Corotational(32, Local::ShallowArch, Inertia::Cubic),
        rotations(32, 1, true),
        rotations(16, 2, true),
    ] {
        let tip = cantilever(choice, 1e6, [0.0, TAU], 32).expect("an equilibrium");
        assert!(tip[0].hypot(tip[1]) < 1e-2, "{choice:?}: {tip:?}");
    }
}

#[test]
fn rigid_rotation_strains_nothing_but_linear_increments() {
    for choice in CHOICES {
        let body = choice.rod(Played::SteelPendulum.rod(), Held::Start);
        let strain = strain_turned(&*body, Played::SteelPendulum);
        assert!(strain < 1e-14, "{choice:?}: {strain:e}");
    }
    for count in [36, 360] {
        let expected = count as f64 * ((TAU / count as f64).cos() - 1.0);
        assert!((stretch_of_a_turn(count) - expected).abs() < 1e-12);
    }
}

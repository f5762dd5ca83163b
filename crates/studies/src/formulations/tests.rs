//! All exact formulations agree with a dense augmented solve; the printed one does not.

use flexbody::elements::cable::{Inertia, Parameters};
use flexbody::elements::{Element as _, StrainMeasure};
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;

use super::rod::cables;
use super::*;

const EXACT: [Formulation; 6] = [
    Formulation::QrDense,
    Formulation::QrApplied,
    Formulation::Cholesky,
    Formulation::Product,
    Formulation::Assembled,
    Formulation::Augmented,
];
const GRAVITY: [f64; 2] = [0.0, -9.81];

fn soft(inertia: Inertia) -> Parameters {
    Parameters {
        length: 1.2,
        axial_stiffness: 0.7e6 * 0.0018,
        bending_stiffness: 0.7e6 * 1.215e-8,
        line_of: flexbody::elements::cable::LineOf::Cable,
        line_density: 5540.0 * 0.0018,
        axial_damping_time: 0.0,
        bending_damping_time: 0.0,
        strain: StrainMeasure::ThetaPrime,
        inertia,
    }
}

/// Forces on a bent and stretched chain, elements apart.
fn bent(rod: &Rod) -> Vec<Node> {
    let mut x = rod.reference.clone();
    for (index, node) in x.iter_mut().enumerate() {
        // The same at both sides of an interface.
        let number = if rod.connected {
            index
        } else {
            index.div_ceil(2)
        };
        let at = number as f64;
        node[0][1] = 0.03 * (1.3 * at).sin();
        node[1][0] += 0.02 * (0.7 * at).cos();
        node[1][1] = 0.1 * (0.9 * at).sin();
    }
    let mut f = x.clone();
    rod.force(&x, &mut f);
    f
}

/// `[M Phi^T; Phi 0]` of elements apart with the report's scalar masses, solved as it stands.
fn augmented_dense(rod: &Rod, f: &[Node]) -> Vec<Node> {
    let (count, n) = (rod.count(), 8 * rod.count());
    let size = n + 4 * (count - 1) + 2;
    let (mut a, mut b) = (DMatrix::zeros(size, size), DVector::zeros(size));
    for (j, mass) in rod.masses().iter().enumerate() {
        for (r, c, d) in (0..32).map(|i| (i / 8, i / 2 % 4, i % 2)) {
            a[(8 * j + 2 * r + d, 8 * j + 2 * c + d)] = mass[r][c];
        }
    }
    let mut hold = |row: usize, column: usize, value: f64| {
        a[(n + row, column)] = value;
        a[(column, n + row)] = value;
    };
    for k in 0..2 {
        hold(k, k, 1.0);
    }
    for j in 1..count {
        for k in 0..4 {
            hold(4 * j - 2 + k, 8 * j - 4 + k, 1.0);
            hold(4 * j - 2 + k, 8 * j + k, -1.0);
        }
    }
    b.rows_mut(0, n)
        .copy_from_slice(f.as_flattened().as_flattened());
    let solved = a.lu().solve(&b).expect("a regular matrix");
    let (pairs, _) = solved.as_slice()[..n].as_chunks::<2>();
    pairs.as_chunks::<2>().0.to_vec()
}

/// Accelerations of all nodes, and those of an independent solution.
fn compared(formulation: Formulation, inertia: Inertia, lengths: &[f64]) -> (Vec<Node>, Vec<Node>) {
    let apart = Rod::new(cables(soft(inertia), lengths), false, GRAVITY);
    let expected = augmented_dense(&apart, &bent(&apart));
    let elements = cables(soft(inertia), lengths);
    let mut system = System::new(formulation, elements, GRAVITY).expect("a system");
    let mut f = bent(&system.rod);
    let mut a = vec![0.0; system.transformation.coordinates()];
    system.transformation.restrict(&mut f, &mut a);
    system.transformation.prolong(&a, &mut f);
    let pick = |index: usize| {
        if system.rod.connected {
            f[index.div_ceil(2)]
        } else {
            f[index]
        }
    };
    ((0..expected.len()).map(pick).collect(), expected)
}

fn distance(a: &[Node], b: &[Node]) -> f64 {
    let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [a, b] = [a, b].map(|x| x.as_flattened().as_flattened());
    let apart: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    size(&apart) / size(b)
}

#[test]
fn exact_formulations_agree_with_the_augmented_equations() {
    for formulation in EXACT {
        for inertia in [Inertia::Consistent, Inertia::Corrected] {
            for lengths in [&[1.2][..], &[0.5, 0.7], &[0.3, 0.1, 0.4, 0.2, 0.2]] {
                let (found, expected) = compared(formulation, inertia, lengths);
                let error = distance(&found, &expected);
                assert!(error < 1e-9, "{formulation:?}, {lengths:?}: {error:e}");
            }
        }
    }
}

#[test]
fn equal_elements_accelerate_as_the_augmented_equations_from_rest() {
    for formulation in EXACT {
        let elements = || uniform(soft(Inertia::Corrected), 7);
        let rod = Rod::new(elements(), false, GRAVITY);
        let mut f = rod.reference.clone();
        rod.force(&rod.reference, &mut f);
        let expected = augmented_dense(&rod, &f);
        let mut system = System::new(formulation, elements(), GRAVITY).expect("a system");
        let n = system.transformation.coordinates();
        let (q, mut a) = (vec![0.0; n], vec![0.0; n]);
        system.acceleration(&q, &mut a);
        let mut u = system.rod.reference.clone();
        system.transformation.prolong(&a, &mut u);
        let (tip, exact) = (u[u.len() - 1], expected[expected.len() - 1]);
        let error = distance(&[tip], &[exact]);
        assert!(error < 1e-9, "{formulation:?}: {error:e}");
    }
}

/// Accelerations under gravity from rest, m/s^2: of the pin, of the gap between two elements and of the tip
/// (vertical), in a unit of length that is `unit` m.
fn at_rest(formulation: Formulation, unit: f64) -> [f64; 3] {
    let parameters = Parameters {
        length: 1.2 / unit,
        line_density: 5540.0 * 0.0018 * unit,
        ..soft(Inertia::Consistent)
    };
    let gravity = GRAVITY.map(|g| g / unit);
    let mut system = System::new(formulation, uniform(parameters, 2), gravity).expect("a system");
    let n = system.transformation.coordinates();
    let (q, mut a) = (vec![0.0; n], vec![0.0; n]);
    system.acceleration(&q, &mut a);
    let mut u = system.rod.reference.clone();
    system.transformation.prolong(&a, &mut u);
    [u[0][0][1], system.rod.gap(&u), u[u.len() - 1][0][1]].map(|a| a * unit)
}

/// Figures of docs/decisions/0001-mass-weighted-elimination.md, from a separate program.
#[test]
fn as_printed_it_falls_off_its_pin_and_apart() {
    let [pin, gap, tip] = at_rest(Formulation::AsPrinted, 1.0);
    assert!((pin + 9.68).abs() < 5e-3, "{pin}");
    assert!((gap - 0.097).abs() < 5e-4, "{gap}");
    assert!((tip + 9.825).abs() < 1e-3, "{tip}");
    // What is printed even depends on the unit of length.
    let [_, _, in_millimetres] = at_rest(Formulation::AsPrinted, 1e-3);
    assert!((in_millimetres - tip).abs() > 1.0, "{in_millimetres}");
    let [pin, gap, tip] = at_rest(Formulation::QrApplied, 1.0);
    assert!(pin.abs() < 1e-12 && gap < 1e-12, "{pin} {gap}");
    assert!((tip + 10.51).abs() < 5e-3, "{tip}");
}

/// `T`, a column for every coordinate.
fn expansion(formulation: Formulation, elements: Vec<Element>) -> (Rod, Vec<Vec<Node>>) {
    let mut system = System::new(formulation, elements, GRAVITY).expect("a system");
    let n = system.transformation.coordinates();
    let columns = (0..n).map(|k| {
        let (mut q, mut u) = (vec![0.0; n], system.rod.reference.clone());
        q[k] = 1.0;
        system.transformation.prolong(&q, &mut u);
        u
    });
    let columns = columns.collect();
    (system.rod, columns)
}

fn difference(a: &Node, b: &Node) -> Node {
    let mut difference = *a;
    add_node(&mut difference, -1.0, b);
    difference
}

fn largest(x: &[Node]) -> f64 {
    x.as_flattened()
        .as_flattened()
        .iter()
        .fold(0.0, |most, x| x.abs().max(most))
}

/// Largest violation of connectivity and of identity inertia by unit coordinates.
fn violations(formulation: Formulation) -> [f64; 2] {
    let (rod, t) = expansion(formulation, uniform(soft(Inertia::Consistent), 2));
    let apart = |u: &Vec<Node>| largest(&[difference(&u[1], &u[2])]);
    let size = t.iter().map(|u| largest(u)).fold(0.0, f64::max);
    let gap = t.iter().map(apart).fold(0.0, f64::max) / size;
    let product = |a: &[Node], b: &[Node]| -> f64 {
        let pairs = a.as_chunks::<2>().0.iter().zip(b.as_chunks::<2>().0);
        let parts = pairs.zip(rod.masses()).map(|((a, b), mass)| {
            let forces = rod::times(&mass, b);
            let [a, forces] = [a, &forces].map(|x| x.as_flattened().as_flattened());
            a.iter().zip(forces).map(|(a, f)| a * f).sum::<f64>()
        });
        parts.sum()
    };
    let mut inertia = 0.0_f64;
    for (i, a) in t.iter().enumerate() {
        for (j, b) in t.iter().enumerate() {
            let identity = f64::from(u8::from(i == j));
            inertia = inertia.max((product(a, b) - identity).abs());
        }
    }
    [gap, inertia]
}

#[test]
fn as_printed_connectivity_and_inertia_fail_by_orders_of_magnitude() {
    let [gap, inertia] = violations(Formulation::QrApplied);
    assert!(gap < 1e-14 && inertia < 1e-14, "{gap:e}, {inertia:e}");
    let [gap, inertia] = violations(Formulation::AsPrinted);
    assert!(gap > 0.1 && inertia > 0.1, "{gap:e}, {inertia:e}");
}

/// Largest gap of a column of `T`, relative to the largest displacement in it; slopes count in lengths of the
/// shortest element.
fn worst_gap(formulation: Formulation, elements: Vec<Element>) -> f64 {
    let lengths = elements.iter().map(Element::length);
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    let (rod, t) = expansion(formulation, elements);
    let of = |u: &Vec<Node>| {
        let gaps = (1..rod.count()).map(|j| {
            let [gap, slopes] = difference(&u[rod.nodes(j - 1)[1]], &u[rod.nodes(j)[0]]);
            largest(&[[gap, slopes.map(|x| x * shortest)]])
        });
        let pin = u[0][0][0].abs().max(u[0][0][1].abs());
        gaps.fold(pin, f64::max) / largest(u)
    };
    t.iter().map(of).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// On every rod of more than one element, of lengths within a factor of three and densities within one of
    /// ten.
    #[test]
    fn as_printed_every_body_breaks(parts in vec((-0.5..0.0_f64, -1.0..0.0_f64), 2..=12)) {
        let cable = |(length, density): &(f64, f64)| {
            Element::new(
                Parameters {
                    length: 10_f64.powf(*length),
                    line_density: 10_f64.powf(*density),
                    ..soft(Inertia::Corrected)
                },
                None,
            )
        };
        let elements: Vec<Element> = parts.iter().map(cable).collect();
        let printed = worst_gap(Formulation::AsPrinted, elements.clone());
        prop_assert!(printed > 1e-3, "connectivity holds to {:e}", printed);
        let weighted = worst_gap(Formulation::QrApplied, elements);
        prop_assert!(weighted < 1e-13, "connectivity holds to {:e}", weighted);
    }
}

//! All exact formulations agree with a dense augmented solve; the printed one does not.

use flexbody::elements::Strain;
use flexbody::elements::cable::{Inertia, Parameters};
use nalgebra::{DMatrix, DVector};

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
        line_density: 5540.0 * 0.0018,
        damping_time: 0.0,
        strain: Strain::ThetaPrime,
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
        node[1] = 0.03 * (1.3 * at).sin();
        node[2] += 0.02 * (0.7 * at).cos();
        node[3] = 0.1 * (0.9 * at).sin();
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
    b.rows_mut(0, n).copy_from_slice(f.as_flattened());
    let solved = a.lu().solve(&b).expect("a regular matrix");
    solved.as_slice()[..n].as_chunks::<4>().0.to_vec()
}

/// Accelerations of all nodes, and those of an independent solution.
fn compared(formulation: Formulation, inertia: Inertia, lengths: &[f64]) -> (Vec<Node>, Vec<Node>) {
    let apart = Rod::new(cables(soft(inertia), lengths), false, GRAVITY);
    let expected = augmented_dense(&apart, &bent(&apart));
    let elements = cables(soft(inertia), lengths);
    let mut system = System::new(formulation, elements, GRAVITY).expect("a system");
    let mut f = bent(&system.rod);
    let mut a = vec![0.0; system.transformation.coordinates()];
    system.transformation.gather(&mut f, &mut a);
    system.transformation.spread(&a, &mut f);
    let pick = |index: usize| match system.rod.connected {
        true => f[index.div_ceil(2)],
        false => f[index],
    };
    ((0..expected.len()).map(pick).collect(), expected)
}

fn distance(a: &[Node], b: &[Node]) -> f64 {
    let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    let apart: Vec<f64> = pairs.map(|(a, b)| a - b).collect();
    size(&apart) / size(b.as_flattened())
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
        system.transformation.spread(&a, &mut u);
        let (tip, exact) = (u[u.len() - 1], expected[expected.len() - 1]);
        let error = distance(&[tip], &[exact]);
        assert!(error < 1e-9, "{formulation:?}: {error:e}");
    }
}

/// Figures of docs/decisions/0001-mass-weighted-elimination.md, from a separate program.
#[test]
fn as_printed_tears_the_beam() {
    let at_rest = |formulation| {
        let elements = uniform(soft(Inertia::Consistent), 2);
        let mut system = System::new(formulation, elements, GRAVITY).expect("a system");
        let n = system.transformation.coordinates();
        let (q, mut a) = (vec![0.0; n], vec![0.0; n]);
        system.acceleration(&q, &mut a);
        let mut u = system.rod.reference.clone();
        system.transformation.spread(&a, &mut u);
        [u[0][1], system.rod.gap(&u), u[u.len() - 1][1]]
    };
    let [pin, gap, tip] = at_rest(Formulation::AsPrinted);
    assert!((pin + 9.68).abs() < 5e-3, "{pin}");
    assert!((gap - 0.097).abs() < 5e-4, "{gap}");
    assert!((tip + 9.83).abs() < 5e-3, "{tip}");
    let [pin, gap, tip] = at_rest(Formulation::QrApplied);
    assert!(pin.abs() < 1e-12 && gap < 1e-12, "{pin} {gap}");
    assert!((tip + 10.51).abs() < 5e-3, "{tip}");
}

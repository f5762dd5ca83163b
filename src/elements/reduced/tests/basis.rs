//! Models in bases of their modes: what a change of basis keeps.
//!
//! Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319 (static shapes, modes with held interfaces).

use nalgebra::{DMatrix, DVector, Vector3};

use super::{MODES, Points, Random, terms};
use crate::elements::reduced::{Interface, ModalBasis, ReducedModel};

/// Two points of the body that are held.
const HELD: [usize; 2] = [0, 1];

/// A model whose pairs of all modes have second-order terms, with three of its points as interfaces.
fn model() -> ReducedModel {
    let points = Points::new();
    let mut random = Random(23);
    let mut model = points.model();
    model.paired = MODES;
    let symmetric = |random: &mut Random| -> Vec<f64> {
        let given: Vec<f64> = (0..MODES * MODES * MODES).map(|_| random.next()).collect();
        let at = |m: usize, k: usize, l: usize| {
            let mut places = [m, k, l];
            places.sort_unstable();
            given[(places[0] * MODES + places[1]) * MODES + places[2]]
        };
        let all = 0..MODES * MODES * MODES;
        all.map(|i| at(i / MODES / MODES, i / MODES % MODES, i % MODES))
            .collect()
    };
    model.cubic = symmetric(&mut random)
        .iter()
        .map(|value| 1e3 * value)
        .collect();
    model.interfaces = (0..3)
        .map(|i| {
            let components = [0, 1, 2].map(|_| symmetric(&mut random));
            Interface {
                name: format!("p{i}"),
                position: points.places[i],
                modes: points.modes.iter().map(|mode| mode[i]).collect(),
                rotation: None,
                second_rotation: Vec::new(),
                second: (0..MODES * MODES)
                    .map(|at| Vector3::from_fn(|c, _| components[c][at]))
                    .collect(),
            }
        })
        .collect();
    model
}

/// Largest difference of two lists, relative to the largest entry.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let off = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    off.fold(0.0, f64::max) / size
}

/// All arrays of a model.
fn arrays(model: &ReducedModel) -> [Vec<f64>; 6] {
    let interfaces = || model.interfaces.iter();
    let vectors = |of: &[Vector3<f64>]| {
        of.iter()
            .flat_map(|of| of.iter().copied().collect::<Vec<_>>())
            .collect::<Vec<f64>>()
    };
    [
        model.inertia_1.concat(),
        model.inertia_2.concat(),
        vectors(&model.coupling),
        model.cubic.clone(),
        interfaces().flat_map(|of| vectors(&of.modes)).collect(),
        interfaces().flat_map(|of| vectors(&of.second)).collect(),
    ]
}

fn assert_same(a: &ReducedModel, b: &ReducedModel) {
    assert_eq!(a.eigenvalues, b.eigenvalues);
    for (a, b) in arrays(a).iter().zip(&arrays(b)) {
        assert!(difference(a, b) < 1e-12, "{}", difference(a, b));
    }
}

#[test]
fn all_first_modes_are_the_model_again() {
    let model = model();
    assert_same(&model, &model.in_basis(&model.first_modes(MODES)));
}

#[test]
fn modes_cut_at_once_or_one_by_one_leave_the_same_model() {
    let model = model();
    let between = model.in_basis(&model.first_modes(5));
    assert_ne!(arrays(&between)[1], arrays(&model)[1]);
    let twice = between.in_basis(&between.first_modes(3));
    assert_same(&model.in_basis(&model.first_modes(3)), &twice);
}

/// Modes of equal frequency may be combined at will.
#[test]
fn combined_modes_are_the_same_body() {
    let mut model = model();
    model.eigenvalues[3] = model.eigenvalues[2];
    let (sine, cosine) = 0.7_f64.sin_cos();
    let mut columns = DMatrix::identity(MODES, MODES);
    for (row, column, value) in [(2, 2, cosine), (2, 3, -sine), (3, 2, sine), (3, 3, cosine)] {
        columns[(row, column)] = value;
    }
    let basis = ModalBasis {
        columns: columns.clone(),
        ..model.first_modes(MODES)
    };
    let combined = model.in_basis(&basis);
    let mut random = Random(31);
    let own = DVector::from_fn(MODES, |_, _| random.next());
    let eta = &columns * &own;
    let inertia = |model: &ReducedModel, eta: &DVector<f64>| -> Vec<f64> {
        let component = |c: usize| {
            let first = (0..MODES).map(|k| model.inertia_1[k][c] * eta[k]);
            let pairs = (0..MODES * MODES).map(|at| (at, at / MODES, at % MODES));
            let second = pairs.map(|(at, k, l)| model.inertia_2[at][c] * eta[k] * eta[l]);
            first.sum::<f64>() + second.sum::<f64>()
        };
        (0..6).map(component).collect()
    };
    assert!(difference(&inertia(&model, &eta), &inertia(&combined, &own)) < 1e-12);
    let places = |model: &ReducedModel, eta: &DVector<f64>| -> Vec<f64> {
        let (matrix, [terms, _]) = terms(model, eta.as_slice(), eta.as_slice());
        let terms = matrix.read(&terms);
        let places = (model.interfaces.iter().enumerate())
            .map(|(index, of)| of.place(eta.as_slice(), terms.shapes(index)));
        places.flat_map(<[f64; 3]>::from).collect()
    };
    assert!(difference(&places(&model, &eta), &places(&combined, &own)) < 1e-12);
    let energy = |model: &ReducedModel, eta: &DVector<f64>| -> f64 {
        let all = model.cubic.iter().enumerate();
        let terms = all.map(|(i, value)| {
            value * eta[i / MODES / MODES] * eta[i / MODES % MODES] * eta[i % MODES]
        });
        terms.sum()
    };
    let (before, after) = (energy(&model, &eta), energy(&combined, &own));
    assert!(
        (before - after).abs() < 1e-11 * before.abs(),
        "{before} {after}"
    );
}

/// How far two held points move apart under unit forces along their distance that balance each other.
fn compliance(model: &ReducedModel) -> f64 {
    let [a, b] = HELD.map(|held| &model.interfaces[held]);
    let along = (b.position - a.position).normalize();
    let by_mode = model.eigenvalues.iter().enumerate();
    by_mode
        .map(|(k, eigenvalue)| (b.modes[k] - a.modes[k]).dot(&along).powi(2) / eigenvalue)
        .sum()
}

#[test]
fn static_shapes_keep_the_compliance_between_held_interfaces() -> Result<(), &'static str> {
    let model = model();
    for modes in 0..3 {
        let basis = model
            .fixed_interface_modes(&HELD, modes)
            .ok_or("no modes")?;
        let reduced = model.in_basis(&basis);
        assert_eq!(reduced.modes(), 1 + modes);
        let off = compliance(&reduced) / compliance(&model) - 1.0;
        assert!(off.abs() < 1e-12, "{off}");
    }
    let cut = model.in_basis(&model.first_modes(1));
    assert!(compliance(&cut) < 0.9 * compliance(&model));
    Ok(())
}

/// Squares of the natural frequencies of a body whose held points are tied to the ground by stiff springs.
fn tied(model: &ReducedModel) -> Vec<f64> {
    let n = model.modes();
    let stiffness = 1e9;
    let matrix = HELD.iter().fold(DMatrix::zeros(6 + n, 6 + n), |sum, held| {
        let of = &model.interfaces[*held];
        let column = |column: usize| match column {
            0..3 => Vector3::ith(column, 1.0 / model.mass.sqrt()),
            3..6 => {
                Vector3::ith(column - 3, 1.0 / model.moments[column - 3].sqrt()).cross(&of.position)
            }
            _ => of.modes[column - 6],
        };
        let rows = DMatrix::from_fn(3, 6 + n, |r, c| column(c)[r]);
        sum + rows.tr_mul(&rows) * stiffness
    });
    let elastic = DMatrix::from_fn(6 + n, 6 + n, |r, c| {
        if r == c && r >= 6 {
            model.eigenvalues[r - 6]
        } else {
            0.0
        }
    });
    let mut squares: Vec<f64> = (matrix + elastic)
        .symmetric_eigenvalues()
        .iter()
        .copied()
        .collect();
    squares.sort_by(f64::total_cmp);
    squares
}

/// The first one is a rotation about the line through both held points.
#[test]
fn natural_modes_with_held_interfaces_keep_their_frequencies() -> Result<(), &'static str> {
    let model = model();
    let basis = model.fixed_interface_modes(&HELD, 3).ok_or("no modes")?;
    let (whole, reduced) = (tied(&model), tied(&model.in_basis(&basis)));
    for k in 1..4 {
        let off = reduced[k] / whole[k] - 1.0;
        assert!(off.abs() < 1e-5, "{k}: {off} {}", whole[k]);
    }
    Ok(())
}

#[test]
fn a_basis_of_all_modes_has_their_frequencies() -> Result<(), &'static str> {
    let model = model();
    let basis = model
        .fixed_interface_modes(&HELD, MODES)
        .ok_or("no modes")?;
    assert!(difference(&model.eigenvalues, &basis.eigenvalues) < 1e-12);
    // With nothing held natural modes are those of the free body.
    let free = model.fixed_interface_modes(&[], 4).ok_or("no modes")?;
    assert!(difference(&model.eigenvalues[..4], &free.eigenvalues) < 1e-12);
    Ok(())
}

/// A file lacks pairs where slow modes of a basis have strain energy in modes that form none.
#[test]
fn a_basis_needs_pairs_of_the_modes_that_it_combines() -> Result<(), &'static str> {
    let mut model = model();
    let held = model.fixed_interface_modes(&HELD, 2).ok_or("no modes")?;
    assert!(!model.lacks_pairs(&held));
    assert!(!model.lacks_pairs(&model.first_modes(MODES)));
    model.paired = 2;
    assert!(model.lacks_pairs(&held));
    assert!(!model.lacks_pairs(&model.first_modes(2)));
    assert!(model.lacks_pairs(&model.first_modes(3)));
    model.paired = 0;
    assert!(model.lacks_pairs(&model.first_modes(1)));
    assert!(!model.lacks_pairs(&model.first_modes(0)));
    Ok(())
}

//! Laws of the elimination: constraints hold, inertia is the identity, nothing is lost.

use flexbody::elements::Element;
use flexbody::system::Evaluation;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use crate::laws::chain::{
    Chain, ORDINARY, Spread, chains, expand, expansion, flat, project, reduction, state,
};
use crate::laws::differences::{Outcome, check, within};

const CASES: u32 = 128;

/// Neighbours of very different length.
const LENGTHS: Spread = Spread {
    length: 3.0,
    density: 0.0,
};
/// Neighbours of very different mass.
const MASSES: Spread = Spread {
    length: 0.0,
    density: 6.0,
};

/// `Phi T`, a row for every constraint; slopes count in lengths of the shortest element, so that all
/// rows are gaps in m.
fn gaps(chain: &Chain, t: &DMatrix<f64>) -> DMatrix<f64> {
    let shortest = chain
        .elements
        .iter()
        .map(Element::length)
        .fold(f64::INFINITY, f64::min);
    let rows = chain.constraints();
    let mut gaps = DMatrix::zeros(rows.len(), t.ncols());
    for (i, (_, row)) in rows.iter().enumerate() {
        let on_slope = row
            .iter()
            .position(|x| *x != 0.0)
            .is_some_and(|at| at % 4 > 1);
        let scale = if on_slope { shortest } else { 1.0 };
        gaps.set_row(i, &(row.transpose() * t * scale));
    }
    gaps
}

/// Largest entry of a column of gaps, relative to the largest displacement in the same column.
fn worst_gap(chain: &Chain, t: &DMatrix<f64>) -> f64 {
    let gaps = gaps(chain, t);
    (0..t.ncols())
        .map(|column| gaps.column(column).amax() / t.column(column).amax())
        .fold(0.0, f64::max)
}

/// Largest number of a matrix, which may have none.
fn largest(matrix: &DMatrix<f64>) -> f64 {
    matrix.iter().fold(0.0, |most, x| most.max(x.abs()))
}

fn rank(chain: &Chain) -> usize {
    let rows = chain.constraints();
    if rows.is_empty() {
        return 0;
    }
    let phi = DMatrix::from_fn(rows.len(), chain.size(), |r, c| rows[r].1[c]);
    phi.singular_values().iter().filter(|s| **s > 1e-8).count()
}

/// Promises of the elimination, in roundoff times `allowed`.
fn elimination(chain: &Chain, allowed: f64) -> Outcome {
    let system = chain.system();
    let t = expansion(&system);
    within("constraints", worst_gap(chain, &t), allowed)?;
    let inertia = t.transpose() * chain.mass() * &t;
    let identity = DMatrix::<f64>::identity(t.ncols(), t.ncols());
    within("inertia", largest(&(inertia - identity)), allowed)?;
    let difference = reduction(&system) - t.transpose();
    within(
        "transpose",
        largest(&difference) / largest(&t).max(1.0),
        1e-14,
    )?;
    prop_assert_eq!(system.coordinates(), chain.size() - rank(chain));
    Ok(())
}

#[test]
fn constraints_hold_inertia_is_the_identity_and_no_coordinate_is_lost() {
    check(CASES, chains(ORDINARY), |chain| elimination(&chain, 1e-13));
}

#[test]
fn so_they_do_at_a_length_ratio_of_a_thousand() {
    check(CASES, chains(LENGTHS), |chain| elimination(&chain, 1e-12));
}

#[test]
fn so_they_do_at_a_mass_ratio_of_a_million() {
    check(CASES, chains(MASSES), |chain| elimination(&chain, 1e-12));
}

#[test]
fn joints_that_repeat_others_are_named() {
    check(CASES, chains(ORDINARY), |chain| {
        let system = chain.system();
        let repeats = rank(&chain) < chain.constraints().len();
        prop_assert_eq!(!system.redundant().is_empty(), repeats);
        for named in system.redundant() {
            let node = chain.joints[*named].node;
            let here = chain.joints.iter().filter(|joint| joint.node == node);
            prop_assert!(here.count() > 1, "joint {} repeats none", named);
        }
        Ok(())
    });
}

#[test]
fn redundant_joints_are_among_the_cases() {
    let seen = std::cell::Cell::new(0_u32);
    check(CASES, chains(ORDINARY), |chain| {
        let repeats = rank(&chain) < chain.constraints().len();
        seen.set(seen.get() + u32::from(repeats));
        Ok(())
    });
    assert!(seen.get() > CASES / 16, "{} cases", seen.get());
}

/// `T T^T M` is a projector: rates that the constraints allow come back as they went.
#[test]
fn projecting_rates_that_constraints_allow_changes_nothing() {
    check(CASES, chains(ORDINARY), |chain| {
        let system = chain.system();
        let q: Vec<f64> = (0..system.coordinates())
            .map(|i| chain.noise[i / 8 % 13].as_slice()[i % 8])
            .collect();
        let rates = expand(&system, &q);
        let back = project(&system, &rates);
        let off = |back: &[f64]| {
            let pairs = q.iter().zip(back);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        within("projection", off(&back), 1e-13)?;
        // The same as a start from rates.
        let rest = vec![0.0; q.len()];
        let (_, mut work) = state(&system, &rest, &rest);
        let described = (&system.bodies().reference[..], &rates[..]);
        let started = system.initial_state(0.0, &[], described, &mut work);
        let started = started.map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
        within("rates at the start", off(&started.rates), 1e-13)?;
        let mut values = Evaluation::new(&system);
        values.kinematics(&system, &started, &mut work);
        // |q'|^2 / 2 is the kinetic energy.
        let rate = flat(&system.bodies().lines()[0], &rates);
        let energy = 0.5 * rate.dot(&(chain.mass() * &rate));
        let square = 0.5 * DVector::from_vec(q.clone()).norm_squared();
        let off = (energy - square).abs();
        within("kinetic energy", off, 1e-13 * (1.0 + energy))?;
        let off = (values.kinetic_energy(&system) - energy).abs();
        within("kinetic energy of all", off, 1e-13 * (1.0 + energy))
    });
}

#[test]
fn reference_positions_and_total_mass_are_those_given() {
    check(CASES, chains(ORDINARY), |chain| {
        let system = chain.system();
        for (x, [p, s]) in system.bodies().reference.iter().zip(&chain.nodes) {
            let given = [p.x, p.y, s.x, s.y];
            let pairs = x.as_flattened().iter().zip(given);
            let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Joints hold nodes where they are; what rounding makes of that stays small.
            within("reference", off, 1e-14)?;
        }
        let translation = DVector::from_fn(chain.size(), |i, _| f64::from(u8::from(i % 4 == 0)));
        let mass = translation.dot(&(chain.mass() * &translation));
        within("mass", (system.mass() - mass).abs(), 1e-14 * mass)
    });
}

//! Forces of connectivity and joints, against the augmented equations with multipliers.

use flexbody::body::Formulation;
use flexbody::elements::{Element, Nodal};
use flexbody::system::loads::{Load, LoadKind};
use flexbody::system::{Evaluation, System};
use nalgebra::{DMatrix, DVector, SVector, Vector2};
use proptest::prelude::*;

use crate::chain::{Chain, ORDINARY, Spread, chains, flat};
use crate::differences::{Outcome, check, within};

const CASES: u32 = 96;

/// Accelerations and, for every independent row, its owner, itself and its multiplier, from
/// `[M Phi^T; Phi 0] [e''; lambda] = [F; 0]`.
type Augmented = (DVector<f64>, Vec<(Option<usize>, DVector<f64>, f64)>);

fn augmented(chain: &Chain, force: &DVector<f64>) -> Augmented {
    let rows = chain.independent();
    let (n, m) = (chain.size(), rows.len());
    let mut matrix = DMatrix::zeros(n + m, n + m);
    matrix.view_mut((0, 0), (n, n)).copy_from(&chain.mass());
    for (i, (_, row)) in rows.iter().enumerate() {
        matrix.view_mut((0, n + i), (n, 1)).copy_from(row);
        matrix
            .view_mut((n + i, 0), (1, n))
            .copy_from(&row.transpose());
    }
    let mut right = DVector::zeros(n + m);
    right.rows_mut(0, n).copy_from(force);
    let solution = matrix
        .full_piv_lu()
        .solve(&right)
        .expect("independent rows");
    let multipliers = rows.into_iter().enumerate();
    let multipliers = multipliers.map(|(i, (owner, row))| (owner, row, solution[n + i]));
    (solution.rows(0, n).into_owned(), multipliers.collect())
}

fn agrees_with_augmented(chain: &Chain, allowed: f64) -> Outcome {
    let body = chain.body(Formulation::MassWeighted);
    let (mut scratch, mut q) = (body.scratch(), vec![0.0; body.coordinates()]);
    let force = chain.forces();
    body.reduce(&force, &mut scratch.border, &mut q);
    let mut acceleration = vec![Nodal::zeros(); force.len()];
    body.rates(&q, &mut scratch.border, &mut acceleration);
    let (expected, multipliers) = augmented(chain, &flat(&force));
    // In the mass norm, as everything here is.
    let difference = flat(&acceleration) - &expected;
    let norm = |x: &DVector<f64>| x.dot(&(chain.mass() * x)).sqrt();
    let scale = norm(&expected).max(1.0);
    within("acceleration", norm(&difference) / scale, allowed)?;

    let mut lack = force.clone();
    body.subtract_inertia(&acceleration, &mut lack);
    let size = multipliers
        .iter()
        .map(|(_, _, l)| l.abs())
        .fold(1.0, f64::max);
    for interface in 0..force.len() - 1 {
        let found = body.connectivity_force(interface, &lack);
        let found = [found.force, found.slope_force];
        for component in 0..4 {
            let exact = multipliers[4 * interface + component].2;
            let off = (found[component / 2][component % 2] - exact).abs();
            within("connectivity force", off / size, allowed)?;
        }
    }
    for (index, joint) in chain.joints.iter().enumerate() {
        let first = 4 * (2 * joint.node.min(force.len() - 1));
        let first = first + 4 * (joint.node - joint.node.min(force.len() - 1));
        let mut exact = SVector::<f64, 4>::zeros();
        for (owner, row, multiplier) in &multipliers {
            if *owner == Some(index) {
                exact -= row.fixed_rows::<4>(first) * *multiplier;
            }
        }
        let found = body.reaction(index, &lack);
        let off = (found.force - exact.fixed_rows::<2>(0)).amax();
        within("reaction force", off / size, allowed)?;
        let off = (found.slope_force - exact.fixed_rows::<2>(2)).amax();
        within("reaction on the slope", off / size, allowed)?;
    }
    Ok(())
}

#[test]
fn accelerations_and_forces_agree_with_the_augmented_equations() {
    check(CASES, chains(ORDINARY), |chain| {
        agrees_with_augmented(&chain, 1e-11)
    });
}

#[test]
fn so_they_do_at_a_mass_ratio_of_a_million() {
    let spread = Spread {
        length: 0.0,
        density: 6.0,
    };
    check(CASES, chains(spread), |chain| {
        agrees_with_augmented(&chain, 1e-9)
    });
}

/// A system in a random state under gravity, a force and a moment.
fn system(chain: &Chain) -> (System, Vec<f64>) {
    let body = chain.body(Formulation::MassWeighted);
    let last = chain.elements.len();
    let at = |node: usize| {
        let length: f64 = chain.elements[..node].iter().map(Element::length).sum();
        body.marker(length / body.length())
    };
    let place = |x: f64| ((0.5 + 0.5 * x) * (last + 1) as f64) as usize;
    let numbers = &chain.noise[12];
    let loads = vec![
        Load {
            kind: LoadKind::Force,
            marker: at(place(numbers[0])),
        },
        Load {
            kind: LoadKind::Moment,
            marker: at(place(numbers[1])),
        },
    ];
    let inputs = vec![3.0 * numbers[2], 3.0 * numbers[3], 2.0 * numbers[4]];
    let gravity = Vector2::new(numbers[5], -9.81);
    let system = System::new(body, gravity, chain.joints.clone(), loads, Vec::new());
    (system, inputs)
}

/// Sum of forces, and of their moments about the origin, of nodal forces at nodal positions.
fn resultant(e: &[Nodal<2>], force: &[Nodal<2>]) -> (Vector2<f64>, f64) {
    let (mut sum, mut moment) = (Vector2::zeros(), 0.0);
    for (e, f) in e.iter().zip(force) {
        sum += f.column(0) + f.column(2);
        for k in 0..4 {
            moment += e.column(k).perp(&f.column(k));
        }
    }
    (sum, moment)
}

fn newton_and_euler(chain: &Chain) -> Outcome {
    let (system, inputs) = system(chain);
    let body = system.body();
    let mut work = system.work();
    let mut state = system.reference_state(0.0);
    state.coordinates = chain.coordinates(body, 0.3);
    state.rates = chain.coordinates(body, 1.0);
    let mut values = Evaluation::new(&system);
    values.kinematics(&system, &state, &mut work);
    values.dynamics(&system, &state, &inputs, &mut work);

    let e = &values.e;
    let inertia: Vec<_> = (body.elements().iter().zip(&values.acceleration))
        .map(|(element, a)| *a * element.mass())
        .collect();
    let weights: Vec<_> = (body.elements().iter())
        .map(|element| system.gravity() * element.weight().transpose())
        .collect();
    let (change, turn) = resultant(e, &inertia);
    let (mut force, mut moment) = resultant(e, &weights);
    let place = |x: f64| ((0.5 + 0.5 * x) * (chain.elements.len() + 1) as f64) as usize;
    let at = |node: usize| -> Vector2<f64> {
        let element = node.min(e.len() - 1);
        e[element].column(2 * (node - element)).into()
    };
    let load = Vector2::new(inputs[0], inputs[1]);
    force += load;
    moment += at(place(chain.noise[12][0])).perp(&load) + inputs[2];
    let mut size = inertia.iter().map(|f| f.amax()).fold(1.0, f64::max);
    for (index, joint) in chain.joints.iter().enumerate() {
        let reaction = values.reaction(&system, index);
        let reaction_moment = values.reaction_moment(&system, index);
        force += reaction;
        moment += at(joint.node).perp(&reaction) + reaction_moment;
        size = size.max(reaction.amax()).max(reaction_moment.abs());
    }
    // Elastic forces cancel in the sums; what is left of them is roundoff.
    let lack = values.lack.iter().map(|f| f.amax()).fold(size, f64::max);
    within("linear momentum", (change - force).amax(), 1e-11 * lack)?;
    within("angular momentum", (turn - moment).abs(), 1e-11 * lack)?;
    prop_assert_eq!(system.inputs(), 3);
    Ok(())
}

#[test]
fn momentum_changes_by_gravity_loads_and_reactions() {
    check(CASES, chains(ORDINARY), |chain| newton_and_euler(&chain));
}

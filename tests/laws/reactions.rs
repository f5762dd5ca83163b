//! Forces of connectivity and joints, against the augmented equations with multipliers.

use flexbody::elements::{Element, Nodal};
use flexbody::system::loads::{AppliedLoad, Force, Moment};
use flexbody::system::{Attachment, Evaluation, Parts, Signal, State, System, Workspace};
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::prelude::*;

use crate::laws::chain::{Chain, ORDINARY, Spread, chains, flat, state};
use crate::laws::differences::{Outcome, check, within};

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

/// A chain in a random state under gravity, a force and a moment.
struct Case {
    system: System,
    state: State,
    work: Workspace,
    values: Evaluation,
    inputs: [f64; 3],
    /// Nodes of the force and of the moment.
    places: [usize; 2],
}

fn case(chain: &Chain) -> Case {
    let numbers = &chain.noise[12];
    let place = |x: f64| ((0.5 + 0.5 * x) * chain.nodes.len() as f64) as usize;
    let places = [place(numbers[0]), place(numbers[1])];
    let marker = |node: usize| chain.marker(node);
    let loads = vec![
        AppliedLoad::Force(Force {
            marker: marker(places[0]),
            follower: false,
            components: [Signal::Input(0), Signal::Input(1)],
            axes: [marker(places[0]); 2],
        }),
        AppliedLoad::Moment(Moment {
            ends: [
                Attachment::Ground(Vector2::zeros()),
                Attachment::Body(marker(places[1])),
            ],
            size: Signal::Input(2),
        }),
    ];
    let parts = Parts {
        loads,
        gravity: Vector2::new(numbers[5], -9.81),
        ..chain.parts()
    };
    let system = System::new(parts).expect("a body with mass");
    let (q, v) = (
        chain.coordinates(&system, 0.3),
        chain.coordinates(&system, 1.0),
    );
    let (state, mut work) = state(&system, &q, &v);
    let inputs = [3.0 * numbers[2], 3.0 * numbers[3], 2.0 * numbers[4]];
    let mut values = Evaluation::new(&system);
    values.kinematics(&system, &state, &mut work);
    values.dynamics(&system, &state, &inputs, &mut work);
    Case {
        system,
        state,
        work,
        values,
        inputs,
        places,
    }
}

/// All forces on all elements but those of connectivity and joints; loads act on the element after.
fn applied(chain: &Chain, case: &Case) -> DVector<f64> {
    let body = &case.system.bodies().lines()[0];
    let [e, rate] = [&case.values.x, &case.values.v].map(|x| flat(body, x));
    let mut f = DVector::zeros(chain.size());
    for (j, element) in chain.elements.iter().enumerate() {
        let part = |x: &DVector<f64>| Nodal::from_column_slice(&x.as_slice()[8 * j..8 * j + 8]);
        let elastic = element.force(&part(&e), &part(&rate));
        let force = elastic + case.system.gravity() * element.weight().transpose();
        f.rows_mut(8 * j, 8).copy_from_slice(force.as_slice());
    }
    let first = |node: usize| {
        let (element, end) = chain.place(node);
        8 * element + 4 * end
    };
    let [at, on] = case.places.map(first);
    f[at] += case.inputs[0];
    f[at + 1] += case.inputs[1];
    let slope = Vector2::new(e[on + 2], e[on + 3]);
    let turn = Vector2::new(-slope.y, slope.x) * (case.inputs[2] / slope.norm_squared());
    f[on + 2] += turn.x;
    f[on + 3] += turn.y;
    f
}

fn agrees_with_augmented(chain: &Chain, allowed: f64) -> Outcome {
    let case = case(chain);
    let (system, values) = (&case.system, &case.values);
    let body = &system.bodies().lines()[0];
    let (expected, multipliers) = augmented(chain, &applied(chain, &case));
    // In the mass norm, as everything here is.
    let difference = flat(body, &values.acceleration) - &expected;
    let norm = |x: &DVector<f64>| x.dot(&(chain.mass() * x)).sqrt();
    let scale = norm(&expected).max(1.0);
    within("acceleration", norm(&difference) / scale, allowed)?;
    let sizes = multipliers.iter().map(|(_, _, l)| l.abs());
    let size = sizes.fold(1.0, f64::max);
    for interface in 1..chain.elements.len() {
        let marker = chain.marker(interface);
        let found = values.connectivity_force(system, &marker);
        for axis in 0..2 {
            let exact = multipliers[4 * (interface - 1) + axis].2;
            let off = (found[axis] - exact).abs();
            within("connectivity force", off / size, allowed)?;
        }
    }
    let e = flat(body, &values.x);
    for (index, joint) in chain.joints.iter().enumerate() {
        let (element, end) = chain.place(joint.node);
        let first = 8 * element + 4 * end;
        let mut exact = DVector::zeros(4);
        for (owner, row, multiplier) in &multipliers {
            if *owner == Some(index) {
                exact -= row.rows(first, 4) * *multiplier;
            }
        }
        let (force, [.., moment]) = values.reaction(system, index);
        let off = (force - Vector2::new(exact[0], exact[1])).amax();
        within("reaction force", off / size, allowed)?;
        let exact = e[first + 2] * exact[3] - e[first + 3] * exact[2];
        within("reaction moment", (moment - exact).abs() / size, allowed)?;
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

/// Sum of forces, and of their moments about the origin, of forces on elements at coordinates.
fn resultant(e: &DVector<f64>, force: &DVector<f64>) -> (Vector2<f64>, f64) {
    let (mut sum, mut moment) = (Vector2::zeros(), 0.0);
    for at in (0..e.len()).step_by(2) {
        let [e, f] = [e, force].map(|x| Vector2::new(x[at], x[at + 1]));
        if at % 4 == 0 {
            sum += f;
        }
        moment += e.perp(&f);
    }
    (sum, moment)
}

fn newton_and_euler(chain: &Chain) -> Outcome {
    let mut case = case(chain);
    let (system, values) = (&case.system, &case.values);
    let body = &system.bodies().lines()[0];
    let (e, rate) = (flat(body, &values.x), flat(body, &values.v));
    let inertia = chain.mass() * flat(body, &values.acceleration);
    let applied = applied(chain, &case);
    let (change, turn) = resultant(&e, &inertia);
    let mut weight = DVector::zeros(chain.size());
    for (j, element) in chain.elements.iter().enumerate() {
        let part = system.gravity() * element.weight().transpose();
        weight.rows_mut(8 * j, 8).copy_from_slice(part.as_slice());
    }
    let (mut force, mut moment) = resultant(&e, &weight);
    let at = |node: usize| Vector2::from(values.x[node][0]);
    let load = Vector2::new(case.inputs[0], case.inputs[1]);
    force += load;
    moment += at(case.places[0]).perp(&load) + case.inputs[2];
    let mut size = inertia.amax().max(applied.amax()).max(1.0);
    for (index, joint) in chain.joints.iter().enumerate() {
        let (reaction, [.., turning]) = values.reaction(system, index);
        force += reaction;
        moment += at(joint.node).perp(&reaction) + turning;
        size = size.max(reaction.amax()).max(turning.abs());
    }
    // Elastic forces cancel in the sums; what is left of them is roundoff.
    within("linear momentum", (change - force).amax(), 1e-11 * size)?;
    within("angular momentum", (turn - moment).abs(), 1e-11 * size)?;
    // What is given out as momentum is the sum over elements.
    let (linear, [.., angular]) = values.momentum(system);
    let (exact, turning) = resultant(&e, &(chain.mass() * rate));
    within(
        "momentum",
        (linear - exact).amax(),
        1e-12 * (1.0 + exact.amax()),
    )?;
    let off = (angular - turning).abs();
    within(
        "angular momentum given out",
        off,
        1e-12 * (1.0 + turning.abs()),
    )?;
    // Evaluating leaves the state as it was.
    let before = case.state.clone();
    case.values
        .dynamics(&case.system, &case.state, &case.inputs, &mut case.work);
    prop_assert_eq!(before, case.state);
    Ok(())
}

#[test]
fn momentum_changes_by_gravity_loads_and_reactions() {
    check(CASES, chains(ORDINARY), |chain| newton_and_euler(&chain));
}

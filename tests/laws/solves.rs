//! Solves with the tangent in the coordinates `q`, against dense matrices and differences.

use flexbody::bodies::{Jacobian, RotatingNodes, Tangent, add_node};
use flexbody::elements::{Element, Nodal};
use flexbody::system::loads::{AppliedLoad, Force, Moment};
use flexbody::system::{Attachment, DrivenSystem, Dynamics, Signal, System, fastest};
use nalgebra::{Complex, DMatrix, DVector, Rotation2, Vector2};
use proptest::prelude::*;

use crate::laws::chain::{
    Chain, ORDINARY, chains, diagonal, expand, expansion, flat, project, state,
};
use crate::laws::dense::reduced_stiffness;
use crate::laws::differences::{Outcome, check, derivative, within};

const CASES: u32 = 96;
const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A system without loads, its state, and `T^T K T`, `T^T R T` there.
struct Dense {
    system: System,
    q: Vec<f64>,
    v: Vec<f64>,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
}

fn dense(chain: &Chain, loads: Vec<AppliedLoad>) -> Dense {
    let system = chain.loaded(loads);
    let q = chain.coordinates(&system, 0.25);
    let v = chain.coordinates(&system, 1.0);
    let t = expansion(&system);
    let body = &system.bodies().lines()[0];
    let e = flat(body, &system.bodies().reference) + &t * DVector::from_column_slice(&q);
    let rate = &t * DVector::from_column_slice(&v);
    let part =
        |x: &DVector<f64>, j: usize| Nodal::from_column_slice(&x.as_slice()[8 * j..8 * j + 8]);
    let elements = || chain.elements.iter().enumerate();
    let blocks: Vec<_> = elements()
        .map(|(j, element)| element.stiffness(&part(&e, j), &part(&rate, j)))
        .collect();
    let stiffness = t.transpose() * diagonal(&blocks) * &t;
    let blocks: Vec<_> = elements()
        .map(|(j, element)| element.damping(&part(&e, j)))
        .collect();
    let damping = t.transpose() * diagonal(&blocks) * &t;
    Dense {
        system,
        q,
        v,
        stiffness,
        damping,
    }
}

/// The fastest oscillation of the undeformed system, rad/s.
fn frequency(system: &System) -> f64 {
    let rest = vec![0.0; system.coordinates()];
    let (state, mut work) = state(system, &rest, &rest);
    fastest(system, &[0.0; 4], &mut work, &state).0
}

fn random(chain: &Chain, n: usize, from: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| chain.noise[(from + i / 8) % 13].as_slice()[i % 8])
}

/// Inertia and damping may weigh whatever they like.
const SHARE: f64 = 0.3;

fn real_solve(chain: &Chain, s: f64) -> Outcome {
    let dense = dense(chain, Vec::new());
    let (state, mut work) = state(&dense.system, &dense.q, &dense.v);
    let mut model = DrivenSystem::new(&dense.system, &[], &mut work, &state);
    model.linearize(0.0, &dense.q, &dense.v);
    let n = dense.q.len();
    let s = s * frequency(&dense.system);
    let weights = [s * s, SHARE * s];
    let a = DMatrix::identity(n, n) * weights[0] + &dense.damping * weights[1] + &dense.stiffness;
    let lowest = (0.5 * (&a + a.transpose())).symmetric_eigenvalues().min() / a.amax();
    let definite = model.factor(weights);
    if lowest.abs() > 1e-10 {
        prop_assert_eq!(definite, lowest > 0.0, "lowest eigenvalue {:e}", lowest);
    }
    if !definite || lowest < 1e-6 {
        return Ok(());
    }
    let right = random(chain, n, 3);
    let mut x = right.as_slice().to_vec();
    model.solve(&mut x);
    let residual = &a * DVector::from_column_slice(&x) - &right;
    within("real solve", residual.amax() / right.amax(), 1e-13 / lowest)?;
    // Where no direction has rotated, the solve for one stage is the same.
    let mut stage = [right.as_slice().to_vec()];
    model.set_stage(0);
    model.solve_stages(&[1.0], &[1.0], &mut stage);
    let [stage] = stage.map(DVector::from_vec);
    let off = (&stage - DVector::from_column_slice(&x)).amax() / stage.amax();
    within("one stage", off, 1e-12)?;
    let mut y = right.as_slice().to_vec();
    model.apply_damping(&mut y);
    let off = (DVector::from_vec(y) - &dense.damping * &right).amax();
    within("damping", off, 1e-12 * dense.damping.amax())
}

#[test]
fn real_factors_invert_the_shifted_tangent() {
    check(CASES, (chains(ORDINARY), 0.01..2.0), |(chain, s)| {
        if free(&chain) {
            real_solve(&chain, s)
        } else {
            Ok(())
        }
    });
}

fn complex_solve(chain: &Chain, size: f64) -> Outcome {
    let dense = dense(chain, Vec::new());
    let (state, mut work) = state(&dense.system, &dense.q, &dense.v);
    let mut model = DrivenSystem::new(&dense.system, &[], &mut work, &state);
    model.linearize(0.0, &dense.q, &dense.v);
    let n = dense.q.len();
    // The angle of Radau's eigenvalues.
    let s = Complex::new(2.681, 3.050) * (size * frequency(&dense.system));
    let complex = |m: &DMatrix<f64>| m.map(|x| Complex::new(x, 0.0));
    let one = DMatrix::<Complex<f64>>::identity(n, n);
    let weights = [s * s, s * SHARE];
    let a = one * weights[0] + complex(&dense.damping) * weights[1] + complex(&dense.stiffness);
    // The real factors are not looked at but must exist.
    let real = 20.0 * s.re;
    if !model.factor([real * real, real]) || !model.factor_complex(weights) {
        return Err(TestCaseError::fail("no factors"));
    }
    let (re, im) = (random(chain, n, 5), random(chain, n, 9));
    let right = re.zip_map(&im, Complex::new);
    let exact = a.lu().solve(&right).expect("a regular matrix");
    let mut x = [vec![0.0; n], re.as_slice().to_vec(), im.as_slice().to_vec()];
    model.solve_stages(IDENTITY.as_flattened(), IDENTITY.as_flattened(), &mut x);
    let off = (0..n).map(|i| (Complex::new(x[1][i], x[2][i]) - exact[i]).norm());
    let off = off.fold(0.0, f64::max);
    within("complex solve", off / exact.camax(), 1e-12)?;
    // Two stages need the complex factors alone.
    let mut x = [re.as_slice().to_vec(), im.as_slice().to_vec()];
    model.solve_stages(&[1.0, 0.0, 0.0, 1.0], &[1.0, 0.0, 0.0, 1.0], &mut x);
    let off = (0..n).map(|i| (Complex::new(x[0][i], x[1][i]) - exact[i]).norm());
    within("two stages", off.fold(0.0, f64::max) / exact.camax(), 1e-12)
}

#[test]
fn complex_factors_invert_the_shifted_tangent() {
    check(CASES, (chains(ORDINARY), 0.1..2.0), |(chain, size)| {
        if free(&chain) {
            complex_solve(&chain, size)
        } else {
            Ok(())
        }
    });
}

/// Stages that have rotated as a whole are solved with the tangent rotated along.
fn turned_solve(chain: &Chain, angle: f64) -> Outcome {
    let mut free = chain.clone();
    free.joints.clear();
    let here = dense(&free, Vec::new());
    let (system, n) = (&here.system, here.q.len());
    let turn = Rotation2::new(angle).into_inner();
    // Coordinates of the same shape, rotated about the origin.
    let way: Vec<_> = (expand(system, &here.q)
        .iter()
        .zip(&system.bodies().reference))
    .map(|(change, reference)| {
        [0, 1].map(|k| {
            let reference = Vector2::from(reference[k]);
            (turn * (reference + Vector2::from(change[k])) - reference).into()
        })
    })
    .collect();
    let there = project(system, &way);

    let (state, mut work) = state(system, &here.q, &here.v);
    // Well above the lowest frequency of any compressed state.
    let (s, rest) = (2.0 * frequency(system), vec![0.0; n]);
    let complex = Complex::new(s, s);
    let complex = [complex * complex, complex];
    let mut model = DrivenSystem::new(system, &[], &mut work, &state);
    let right = random(&free, n, 7).as_slice().to_vec();
    model.linearize(0.0, &there, &rest);
    prop_assert!(model.factor([s * s, s]) && model.factor_complex(complex));
    let mut exact = [right.clone(), right.clone(), right.clone()];
    model.solve_stages(IDENTITY.as_flattened(), IDENTITY.as_flattened(), &mut exact);
    model.linearize(0.0, &here.q, &rest);
    prop_assert!(model.factor([s * s, s]) && model.factor_complex(complex));
    for stage in 0..3 {
        model.acceleration(0.0, &there, &rest, &mut vec![0.0; n]);
        model.set_stage(stage);
    }
    let mut found = [right.clone(), right.clone(), right];
    model.solve_stages(IDENTITY.as_flattened(), IDENTITY.as_flattened(), &mut found);
    for (found, exact) in found.iter().zip(&exact) {
        let (found, exact) = (
            DVector::from_column_slice(found),
            DVector::from_column_slice(exact),
        );
        within(
            "turned solve",
            (found - &exact).amax() / exact.amax(),
            1e-10,
        )?;
    }
    Ok(())
}

#[test]
fn solves_of_turned_stages_turn_along() {
    check(CASES, (chains(ORDINARY), -1.5..1.5), |(chain, angle)| {
        turned_solve(&chain, angle)
    });
}

/// With loads: `K` and `R` of the whole model are minus the derivatives of its acceleration.
fn model_tangent(chain: &Chain) -> Outcome {
    let last = chain.elements.len();
    let moment = |node: usize, input: usize| {
        let end = Attachment::Body(chain.marker(node));
        AppliedLoad::Moment(Moment {
            ends: [Attachment::Ground(Vector2::zeros()), end],
            size: Signal::Input(input),
        })
    };
    let force = AppliedLoad::Force(Force {
        marker: chain.marker(0),
        follower: false,
        components: [Signal::Input(1), Signal::Input(2)],
        axes: [chain.marker(0); 2],
    });
    let loads = vec![moment(last, 0), force, moment(0, 3)];
    let inputs = [2.0, 3.0, -1.0, -4.0];
    let Dense { system, q, v, .. } = dense(chain, loads);
    let (state, mut work) = state(&system, &q, &v);
    let n = q.len();
    let direction = random(chain, n, 2).normalize();
    // Displacements of a hundredth of the shortest element at most.
    let lengths = chain.elements.iter().map(Element::length);
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    let step = 2e-4 * shortest * system.mass().sqrt();
    let rest = vec![0.0; n];
    // The rate of strain is taken as given in K, so K is compared at rest.
    let mut slope = |q: &[f64], v: &[f64], by_rate: bool, step: f64| {
        derivative(step, |t| {
            let mut place = [q.to_vec(), v.to_vec()];
            let moved = place[usize::from(by_rate)].iter_mut();
            moved.zip(&direction).for_each(|(x, d)| *x += t * d);
            let (mut a, [q, v]) = (vec![0.0; n], place);
            DrivenSystem::new(&system, &inputs, &mut work, &state)
                .acceleration(0.0, &q, &v, &mut a);
            DVector::from_vec(a)
        })
    };
    let stiff = -slope(&q, &rest, false, step);
    let damp = -slope(&q, &v, true, 1.0);
    let mut model = DrivenSystem::new(&system, &inputs, &mut work, &state);
    model.linearize(0.0, &q, &rest);
    // Compressed and twisted bodies are not stable: the shift must outweigh that.
    let shifts = [1.0, 2.0, 4.0, 8.0].map(|factor| factor * frequency(&system));
    let Some(s) = shifts.into_iter().find(|s| model.factor([s * s, *s])) else {
        return Err(TestCaseError::fail("no factors"));
    };
    let right = stiff + &damp * s + &direction * (s * s);
    let mut x = right.as_slice().to_vec();
    model.solve(&mut x);
    let off = (DVector::from_vec(x) - &direction).amax();
    within("solve of the model", off, 1e-6)
}

/// Cases without any freedom left have nothing to solve for.
fn free(chain: &Chain) -> bool {
    chain.system().coordinates() > 0
}

#[test]
fn the_tangent_of_a_model_is_the_derivative_of_its_acceleration() {
    check(CASES, chains(ORDINARY), |chain| {
        if free(&chain) {
            model_tangent(&chain)
        } else {
            Ok(())
        }
    });
}

#[test]
fn the_dense_stiffness_for_frequencies_is_the_tangent() {
    check(CASES, chains(ORDINARY), |chain| {
        if !free(&chain) {
            return Ok(());
        }
        let Dense {
            system,
            q,
            v,
            stiffness,
            ..
        } = dense(&chain, Vec::new());
        let [mut x, rate] = [&q, &v].map(|q| expand(&system, q));
        for (x, reference) in x.iter_mut().zip(&system.bodies().reference) {
            add_node(x, 1.0, reference);
        }
        let elimination = system.elimination();
        let body = &system.bodies().lines()[0];
        let rotating = RotatingNodes {
            elastic: vec![true; x.len()],
            modal: vec![false; x.len()],
            still: vec![false; x.len()],
            sections: Vec::new(),
            surfaces: Vec::new(),
            stiffeners: Vec::new(),
        };
        let mut tangent: Tangent<2> = Tangent::new(
            elimination,
            body.is_damped(),
            &Jacobian::new(elimination, &[], Vec::new(), |_| false),
            &[],
            &rotating,
        );
        tangent.clear();
        let assembly = &elimination.assembly;
        let (k, r) = (&mut tangent.stiffness, &mut tangent.damping);
        body.add_tangent((&x, &rate), [1.0, 0.0], assembly, (k, r));
        for (c, column) in reduced_stiffness(&mut tangent, elimination)
            .iter()
            .enumerate()
        {
            let off = (DVector::from_column_slice(column) - stiffness.column(c)).amax();
            within("dense stiffness", off, 1e-12 * stiffness.amax())?;
        }
        Ok(())
    });
}

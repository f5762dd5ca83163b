//! Solves with the tangent in the coordinates `q`, against dense matrices and differences.

use flexbody::body::Formulation;
use flexbody::elements::{Element, Nodal};
use flexbody::system::loads::{Load, LoadKind};
use flexbody::system::{Dynamics, Model, System};
use nalgebra::{Complex, DMatrix, DVector, Rotation2, Vector2};
use proptest::prelude::*;

use crate::chain::{Chain, ORDINARY, chains, diagonal, expansion};
use crate::differences::{Outcome, check, derivative, within};

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

fn dense(chain: &Chain, loads: Vec<Load>) -> Dense {
    let body = chain.body(Formulation::MassWeighted);
    let q = chain.coordinates(&body, 0.25);
    let v = chain.coordinates(&body, 1.0);
    let mut scratch = body.scratch();
    body.positions(&q, &mut scratch.border, &mut scratch.e);
    body.rates(&v, &mut scratch.border, &mut scratch.rate);
    let t = expansion(&body);
    let places = || body.elements().iter().zip(&scratch.e);
    let blocks: Vec<_> = (places().zip(&scratch.rate))
        .map(|((element, e), rate)| element.stiffness(e, rate))
        .collect();
    let stiffness = t.transpose() * diagonal(&blocks) * &t;
    let blocks: Vec<_> = places().map(|(element, e)| element.damping(e)).collect();
    let damping = t.transpose() * diagonal(&blocks) * &t;
    let joints = chain.joints.clone();
    Dense {
        system: System::new(body, Vector2::zeros(), joints, loads, Vec::new()),
        q,
        v,
        stiffness,
        damping,
    }
}

fn random(chain: &Chain, n: usize, from: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| chain.noise[(from + i / 8) % 13].as_slice()[i % 8])
}

fn real_solve(chain: &Chain, s: f64) -> Outcome {
    let dense = dense(chain, Vec::new());
    let mut work = dense.system.work();
    let mut model = Model::new(&dense.system, &[], &mut work);
    model.linearize(&dense.q, &dense.v);
    let n = dense.q.len();
    let s = s * dense.system.body().frequency_bound();
    let a = DMatrix::identity(n, n) * (s * s) + &dense.damping * s + &dense.stiffness;
    let lowest = (0.5 * (&a + a.transpose())).symmetric_eigenvalues().min() / a.amax();
    let definite = model.factor(s);
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
    let mut y = right.as_slice().to_vec();
    model.apply_damping(&mut y);
    let off = (DVector::from_vec(y) - &dense.damping * &right).amax();
    within("damping", off, 1e-12 * dense.damping.amax())
}

#[test]
fn real_factors_invert_the_shifted_tangent() {
    check(CASES, (chains(ORDINARY), 0.01..2.0), |(chain, s)| {
        real_solve(&chain, s)
    });
}

fn complex_solve(chain: &Chain, size: f64) -> Outcome {
    let dense = dense(chain, Vec::new());
    let mut work = dense.system.work();
    let mut model = Model::new(&dense.system, &[], &mut work);
    model.linearize(&dense.q, &dense.v);
    let n = dense.q.len();
    // The angle of Radau's eigenvalues.
    let s = Complex::new(2.681, 3.050) * (size * dense.system.body().frequency_bound());
    let complex = |m: &DMatrix<f64>| m.map(|x| Complex::new(x, 0.0));
    let one = DMatrix::<Complex<f64>>::identity(n, n);
    let a = one * (s * s) + complex(&dense.damping) * s + complex(&dense.stiffness);
    // One shift for both kinds of factors: the real one is not looked at but must exist.
    if !model.factor(20.0 * s.re) || !model.factor_complex(s) {
        return Err(TestCaseError::fail("no factors"));
    }
    let (re, im) = (random(chain, n, 5), random(chain, n, 9));
    let right = re.zip_map(&im, Complex::new);
    let exact = a.lu().solve(&right).expect("a regular matrix");
    let mut x = [vec![0.0; n], re.as_slice().to_vec(), im.as_slice().to_vec()];
    model.solve_stages(&IDENTITY, &IDENTITY, &mut x);
    let off = (0..n).map(|i| (Complex::new(x[1][i], x[2][i]) - exact[i]).norm());
    let off = off.fold(0.0, f64::max);
    within("complex solve", off / exact.camax(), 1e-12)
}

#[test]
fn complex_factors_invert_the_shifted_tangent() {
    check(CASES, (chains(ORDINARY), 0.1..2.0), |(chain, size)| {
        complex_solve(&chain, size)
    });
}

/// Stages that have turned as a whole are solved with the tangent turned along.
fn turned_solve(chain: &Chain, angle: f64) -> Outcome {
    let mut free = chain.clone();
    free.joints.clear();
    let here = dense(&free, Vec::new());
    let body = here.system.body();
    let n = here.q.len();
    let turn = Rotation2::new(angle).into_inner();
    // Coordinates of the same shape, turned about the origin.
    let mut scratch = body.scratch();
    body.positions(&here.q, &mut scratch.border, &mut scratch.e);
    let way: Vec<Nodal<2>> = (scratch.e.iter().zip(body.reference()))
        .map(|(e, reference)| turn * e - reference)
        .collect();
    let mut there = vec![0.0; n];
    body.project(&way, &mut scratch, &mut there);

    let mut work = here.system.work();
    let mut model = Model::new(&here.system, &[], &mut work);
    let (s, rest) = (body.frequency_bound(), vec![0.0; n]);
    let right = random(&free, n, 7).as_slice().to_vec();
    model.linearize(&there, &rest);
    prop_assert!(model.factor(s) && model.factor_complex(Complex::new(s, s)));
    let mut exact = [right.clone(), right.clone(), right.clone()];
    model.solve_stages(&IDENTITY, &IDENTITY, &mut exact);
    model.linearize(&here.q, &rest);
    prop_assert!(model.factor(s) && model.factor_complex(Complex::new(s, s)));
    for stage in 0..3 {
        model.acceleration(&there, &rest, &mut vec![0.0; n]);
        model.set_stage(stage);
    }
    let mut found = [right.clone(), right.clone(), right];
    model.solve_stages(&IDENTITY, &IDENTITY, &mut found);
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
    let body = chain.body(Formulation::MassWeighted);
    let loads = [
        (LoadKind::Moment, 1.0),
        (LoadKind::Force, 0.0),
        (LoadKind::Moment, 0.0),
    ];
    let loads = loads.map(|(kind, at)| Load {
        kind,
        marker: body.marker(at),
    });
    let inputs = [2.0, 3.0, -1.0, -4.0];
    let Dense { system, q, v, .. } = dense(chain, loads.to_vec());
    let mut work = system.work();
    let n = q.len();
    let direction = random(chain, n, 2).normalize();
    // Displacements of a hundredth of the shortest element at most.
    let shortest = chain
        .elements
        .iter()
        .map(Element::length)
        .fold(f64::INFINITY, f64::min);
    let step = 2e-4 * shortest * system.body().mass().sqrt();
    let rest = vec![0.0; n];
    // The rate of strain is taken as given in K, so K is compared at rest.
    let mut slope = |q: &[f64], v: &[f64], by_rate: bool, step: f64| {
        derivative(step, |t| {
            let mut place = [q.to_vec(), v.to_vec()];
            let moved = place[usize::from(by_rate)].iter_mut();
            moved.zip(&direction).for_each(|(x, d)| *x += t * d);
            let mut a = vec![0.0; n];
            Model::new(&system, &inputs, &mut work).acceleration(&place[0], &place[1], &mut a);
            DVector::from_vec(a)
        })
    };
    let stiff = -slope(&q, &rest, false, step);
    let damp = -slope(&q, &v, true, 1.0);
    let mut model = Model::new(&system, &inputs, &mut work);
    model.linearize(&q, &rest);
    // Compressed and twisted bodies are not stable: the shift must outweigh that.
    let bound = system.body().frequency_bound();
    let shifts = [1.0, 2.0, 4.0, 8.0].map(|factor| factor * bound);
    let Some(s) = shifts.into_iter().find(|s| model.factor(*s)) else {
        return Err(TestCaseError::fail("no factors"));
    };
    let right = stiff + &damp * s + &direction * (s * s);
    let mut x = right.as_slice().to_vec();
    model.solve(&mut x);
    let off = (DVector::from_vec(x) - &direction).amax();
    within("solve of the model", off, 1e-6)
}

#[test]
fn the_tangent_of_a_model_is_the_derivative_of_its_acceleration() {
    check(CASES, chains(ORDINARY), |chain| model_tangent(&chain));
}

#[test]
fn the_dense_stiffness_for_frequencies_is_the_tangent() {
    check(CASES, chains(ORDINARY), |chain| {
        let dense = dense(&chain, Vec::new());
        let body = dense.system.body();
        let mut scratch = body.scratch();
        body.positions(&dense.q, &mut scratch.border, &mut scratch.e);
        body.rates(&dense.v, &mut scratch.border, &mut scratch.rate);
        let mut tangent = body.tangent();
        body.assemble(&scratch.e, &scratch.rate, &mut tangent);
        for (c, column) in body.reduced_stiffness(&mut tangent).iter().enumerate() {
            let off = (DVector::from_column_slice(column) - dense.stiffness.column(c)).amax();
            within("dense stiffness", off, 1e-12 * dense.stiffness.amax())?;
        }
        Ok(())
    });
}

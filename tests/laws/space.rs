//! Chains of cables in space: what bodies of the plane promise holds for any dimension.

use flexbody::bodies::{
    Assembly, Chain, ConnectivityRow, Elimination, Jacobian, Links, Node, RotatingNodes, Tangent,
    map_node,
};
use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Element, Nodal, StrainMeasure};
use flexbody::math::sparse::Matrix;
use nalgebra::{Complex, DMatrix, DVector, Rotation3, SMatrix, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::laws::dense::reduced_stiffness;
use crate::laws::differences::{Outcome, check, within};
use crate::laws::specimen::{decades, noise};

const CASES: u32 = 64;
const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

type Spatial = Chain<Cable<3>, 3>;

/// A chain in space, rows on it, and its matrices by hand.
#[derive(Debug)]
struct Case {
    chain: Spatial,
    elimination: Elimination<3>,
    rows: Vec<ConnectivityRow<3>>,
    /// Nodal coordinates of a deformed shape, and numbers for anybody.
    x: Vec<Node<3>>,
    noise: Vec<Nodal<3>>,
}

/// Lengths and densities, where rows act (node, kind), numbers.
type Numbers = (Vec<(f64, f64)>, Vec<(f64, usize)>, Vec<Nodal<3>>);

fn numbers() -> impl Strategy<Value = Numbers> {
    let element = (decades(-0.5, 0.0), decades(-1.0, 0.0));
    let row = (0.0..1.0, 0..4_usize);
    (vec(element, 1..=8), vec(row, 0..=3), vec(noise(), 9))
}

fn case((elements, joints, noise): Numbers) -> Case {
    let cable = |(length, line_density): &(f64, f64)| {
        let parameters = Parameters {
            inertia: Inertia::Corrected,
            length: *length,
            axial_stiffness: 200.0,
            bending_stiffness: 1.0,
            line_of: flexbody::elements::cable::LineOf::Cable,
            line_density: *line_density,
            axial_damping_time: 0.0,
            bending_damping_time: 0.0,
            strain: StrainMeasure::ThetaPrime,
        };
        Cable::new(parameters, None)
    };
    let chain = Spatial::new(elements.iter().map(cable).collect(), 0);
    let (mut x, mut at) = (Vec::new(), Vector3::zeros());
    for node in 0..chain.node_count() {
        let (p, s) = (noise[node].column(0) * 0.02, noise[node].column(1) * 0.1);
        let (p, s) = (at + p, Vector3::x() + s);
        x.push([p.into(), s.into()]);
        at.x += elements.get(node).map_or(0.0, |e| e.0);
    }
    let mut rows = Vec::new();
    for (i, (place, kind)) in joints.iter().enumerate() {
        let node = (place * chain.node_count() as f64) as usize;
        let other = (node + 1) % chain.node_count();
        let mut push = |terms| {
            rows.push(ConnectivityRow {
                terms,
                is_driven: false,
            });
        };
        let random = Vector3::from(noise[i].column(2));
        match kind {
            // A ball joint.
            0 => (0..3).for_each(|k| push(vec![(node, unit(k))])),
            // The slope stays in a plane, the position too.
            1 => push(vec![(node, [[0.0; 3], random.into()])]),
            2 => push(vec![(node, [random.into(), [0.0; 3]])]),
            // Two nodes at the same height.
            _ => push(vec![(node, unit(2)), (other, map_node(&unit(2), |x| -x))]),
        }
    }
    let links = Links {
        mass: (1..chain.node_count())
            .map(|node| (node - 1, node))
            .collect(),
        ..Links::default()
    };
    let (assembly, _) = Assembly::new(chain.node_count(), &rows, &links);
    let mut mass = Matrix::zeros(assembly.pattern());
    chain.add_mass(&SMatrix::identity(), &assembly, &mut mass);
    Case {
        elimination: Elimination::new(assembly, mass).expect("a chain with mass"),
        chain,
        rows,
        x,
        noise,
    }
}

fn unit(k: usize) -> Node<3> {
    let mut unit = [[0.0; 3]; 2];
    unit[k / 3][k % 3] = 1.0;
    unit
}

impl Case {
    /// `T` column by column.
    fn expansion(&self) -> DMatrix<f64> {
        let n = self.elimination.coordinates();
        let mut t = DMatrix::zeros(6 * self.x.len(), n);
        for column in 0..n {
            let (mut q, mut y) = (vec![0.0; n], vec![0.0; self.elimination.scratch()]);
            q[column] = 1.0;
            let mut x = self.x.clone();
            self.elimination.expand(&q, &mut y, &mut x);
            t.column_mut(column)
                .copy_from_slice(x.as_flattened().as_flattened());
        }
        t
    }

    /// A matrix over the nodes from 12 x 12 matrices of the elements.
    fn dense(&self, of: impl Fn(usize, usize, usize) -> f64) -> DMatrix<f64> {
        let size = 6 * self.x.len();
        let mut matrix = DMatrix::zeros(size, size);
        for j in 0..self.chain.elements().len() {
            for r in 0..12 {
                for c in 0..12 {
                    matrix[(6 * j + r, 6 * j + c)] += of(j, r, c);
                }
            }
        }
        matrix
    }

    fn mass(&self) -> DMatrix<f64> {
        self.dense(|j, r, c| {
            let m = self.chain.elements()[j].mass();
            if r % 3 == c % 3 {
                m[(r / 3, c / 3)]
            } else {
                0.0
            }
        })
    }

    fn stiffness(&self, x: &[Node<3>]) -> DMatrix<f64> {
        let blocks: Vec<_> = (self.chain.elements().iter().enumerate())
            .map(|(j, element)| {
                let e = Nodal::from_column_slice(x[j..j + 2].as_flattened().as_flattened());
                element.stiffness(&e, &Nodal::zeros())
            })
            .collect();
        self.dense(|j, r, c| blocks[j][r / 3][c / 3][(r % 3, c % 3)])
    }

    fn tangent(&self, x: &[Node<3>]) -> Tangent<3> {
        let rotating = RotatingNodes {
            elastic: vec![true; x.len()],
            modal: vec![false; x.len()],
            still: vec![false; x.len()],
            sections: Vec::new(),
            surfaces: Vec::new(),
            stiffeners: Vec::new(),
        };
        let mut tangent: Tangent<3> = Tangent::new(
            &self.elimination,
            false,
            &Jacobian::new(&self.elimination, &[], Vec::new(), |_| false),
            &[],
            &rotating,
        );
        tangent.clear();
        let (k, r) = (&mut tangent.stiffness, &mut tangent.damping);
        self.chain
            .add_tangent((x, x), [1.0, 0.0], &self.elimination.assembly, (k, r));
        tangent.stages.set_base(x);
        tangent
    }

    fn random(&self, from: usize) -> Vec<f64> {
        let n = self.elimination.coordinates();
        (0..n)
            .map(|i| self.noise[(from + i / 12) % 9].as_slice()[i % 12])
            .collect()
    }
}

fn elimination(case: &Case) -> Outcome {
    let t = case.expansion();
    let size = t.nrows();
    let phi = DMatrix::from_fn(case.rows.len(), size, |r, c| {
        let terms = case.rows[r].terms.iter().filter(|(node, _)| *node == c / 6);
        terms
            .map(|(_, coefficients)| coefficients.as_flattened()[c % 6])
            .sum()
    });
    let gap = (&phi * &t)
        .iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    within("constraints", gap / t.amax(), 1e-13)?;
    let n = t.ncols();
    let inertia = t.transpose() * case.mass() * &t - DMatrix::<f64>::identity(n, n);
    within("inertia", inertia.amax(), 1e-12)?;
    let held = match case.rows.len() {
        0 => 0,
        _ => phi.singular_values().iter().filter(|s| **s > 1e-8).count(),
    };
    prop_assert_eq!(n, size - held);
    // Forces go the other way.
    let mut f = case.x.clone();
    f.iter_mut()
        .flatten()
        .flatten()
        .zip(0..)
        .for_each(|(f, i)| *f = case.random(i)[0]);
    let (mut y, mut q) = (vec![0.0; case.elimination.scratch()], vec![0.0; n]);
    case.elimination.reduce(&f, &mut y, &mut q);
    let exact = t.transpose() * DVector::from_column_slice(f.as_flattened().as_flattened());
    let off = (DVector::from_vec(q) - &exact).amax();
    within("transpose", off, 1e-13 * exact.amax().max(1.0))
}

#[test]
fn constraints_hold_and_inertia_is_the_identity() {
    check(CASES, numbers(), |numbers| elimination(&case(numbers)));
}

fn solves(case: &Case) -> Outcome {
    let (t, n) = (case.expansion(), case.elimination.coordinates());
    let k = t.transpose() * case.stiffness(&case.x) * &t;
    let s = (k.clone().symmetric_eigenvalues().amax()).sqrt();
    let mut tangent = case.tangent(&case.x);
    let dense = reduced_stiffness(&mut tangent, &case.elimination);
    for (c, column) in dense.iter().enumerate() {
        let off = (DVector::from_column_slice(column) - k.column(c)).amax();
        within("dense stiffness", off, 1e-12 * k.amax())?;
    }
    prop_assert!(tangent.factor(&case.elimination, [2.25 * s * s, 1.5 * s]));
    let right = case.random(0);
    let mut x = right.clone();
    tangent.solve(&case.elimination, &mut x);
    let a = &k + DMatrix::identity(n, n) * (2.25 * s * s);
    let residual = a * DVector::from_vec(x) - DVector::from_column_slice(&right);
    within("real solve", residual.amax(), 1e-12)?;
    let shift = Complex::new(2.681, 3.050) * s;
    prop_assert!(tangent.factor_complex(&case.elimination, [shift * shift, shift]));
    let [re, im] = [case.random(3), case.random(5)];
    let mut x = [right, re.clone(), im.clone()];
    tangent.solve_stages(&case.elimination, [IDENTITY.as_flattened(); 2], &mut x);
    let a =
        DMatrix::identity(n, n).map(|i: f64| shift * shift * i) + k.map(|k| Complex::new(k, 0.0));
    let of = |re: &[f64], im: &[f64]| DVector::from_fn(n, |i, _| Complex::new(re[i], im[i]));
    let residual = a * of(&x[1], &x[2]) - of(&re, &im);
    within("complex solve", residual.camax(), 1e-12)
}

#[test]
fn solves_invert_the_shifted_tangent() {
    check(CASES, numbers(), |numbers| {
        let case = case(numbers);
        if case.elimination.coordinates() == 0 {
            return Ok(());
        }
        solves(&case)
    });
}

/// A free chain that has rotated as a whole in space is solved with the tangent rotated along.
fn turned(case: &Case, axis: Vector3<f64>) -> Outcome {
    // The smallest rotation between two directions rotates about nothing but what is across both: so the
    // chain is straight, and rotated about an axis across it.
    let mut at = 0.0;
    let mut straight: Vec<Node<3>> = vec![[[0.0; 3], [1.01, 0.0, 0.0]]];
    for element in case.chain.elements() {
        at += 1.01 * element.length();
        straight.push([[at, 0.0, 0.0], [1.01, 0.0, 0.0]]);
    }
    let turn = Rotation3::new(Vector3::new(0.0, axis.y, axis.z));
    let there = straight.iter();
    let there: Vec<Node<3>> = there
        .map(|x| x.map(|v| (turn * Vector3::from(v)).into()))
        .collect();
    let n = case.elimination.coordinates();
    let shift = Complex::new(2.0, 2.0) * 10.0;
    let mut exact = case.tangent(&there);
    prop_assert!(exact.factor(&case.elimination, [400.0, 20.0]));
    prop_assert!(exact.factor_complex(&case.elimination, [shift * shift, shift]));
    let right = case.random(1);
    let mut expected = [right.clone(), right.clone(), right.clone()];
    exact.solve_stages(
        &case.elimination,
        [IDENTITY.as_flattened(); 2],
        &mut expected,
    );
    let mut tangent = case.tangent(&straight);
    prop_assert!(tangent.factor(&case.elimination, [400.0, 20.0]));
    prop_assert!(tangent.factor_complex(&case.elimination, [shift * shift, shift]));
    let assembly = &case.elimination.assembly;
    (0..3).for_each(|stage| tangent.stages.set(assembly, stage, &there));
    let mut found = [right.clone(), right.clone(), right];
    tangent.solve_stages(&case.elimination, [IDENTITY.as_flattened(); 2], &mut found);
    for (found, expected) in found.iter().zip(&expected) {
        let off = (0..n)
            .map(|i| (found[i] - expected[i]).abs())
            .fold(0.0, f64::max);
        let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        within("turned solve", off, 1e-11 * size)?;
    }
    Ok(())
}

#[test]
fn solves_turn_along_in_space() {
    check(CASES, (numbers(), noise::<3>()), |(mut numbers, axis)| {
        numbers.1.clear();
        turned(&case(numbers), axis.column(0).into())
    });
}

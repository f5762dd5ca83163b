//! Neighbours of very different mass and length.

use flexbody::bodies::{Bodies, LineChain, Marker, Node};
use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Element, StrainMeasure};
use flexbody::system::joints::{JointEquations, Primitive};
use flexbody::system::{Attachment, Evaluation, Parts, System, Workspace};
use nalgebra::{DMatrix, DVector, Vector2};

use super::support::{Row, figure, short};
use crate::scene::Outcome;

/// Lengths and masses per length of a pinned straight cable, element by element.
const ELEMENTS: [[f64; 2]; 6] = [
    [1.0, 1.0],
    [1e-3, 1e6],
    [1.0, 1e6],
    [1e-3, 1.0],
    [1.0, 1.0],
    [1e-3, 1e6],
];

fn cables() -> Vec<Cable<2>> {
    let cable = |[length, line_density]: [f64; 2]| {
        let parameters = Parameters {
            length,
            axial_stiffness: 1e3,
            bending_stiffness: 1.0,
            line_of: flexbody::elements::cable::LineOf::Cable,
            line_density,
            axial_damping_time: 0.0,
            bending_damping_time: 0.0,
            strain: StrainMeasure::ThetaPrime,
            inertia: Inertia::Consistent,
        };
        Cable::new(parameters, None)
    };
    ELEMENTS.map(cable).into()
}

/// Vertical accelerations under gravity from rest, positions and slopes of all nodes, as the product
/// has them.
fn product(cables: &[Cable<2>]) -> Outcome<DVector<f64>> {
    let mut at = 0.0;
    let mut nodes: Vec<Node> = vec![[[0.0, 0.0], [1.0, 0.0]]];
    for cable in cables {
        at += cable.length();
        nodes.push([[at, 0.0], [1.0, 0.0]]);
    }
    let chain = LineChain::new(cables.to_vec(), 0);
    let pin = JointEquations {
        holds: vec![Primitive::Coincident],
        ends: [
            Attachment::Ground(Vector2::zeros()),
            Attachment::Body(Marker::inside(0, &chain, 0, 0.0)),
        ],
        spring: None,
        turn: None,
        way: None,
        release: None,
    };
    let ranges = std::iter::once(0..nodes.len()).collect();
    let mut bodies = Bodies::new(nodes, ranges);
    bodies.add_line(chain);
    let system = System::new(Parts {
        bodies,
        rigid: Vec::new(),
        joints: vec![pin],
        drives: Vec::new(),
        winches: Vec::new(),
        loads: Vec::new(),
        initial_loads: Vec::new(),
        angles: Vec::new(),
        gravity: Vector2::new(0.0, -1.0),
        rotation: [0.0; 3],
        tracks_work: false,
    });
    let system = system.map_err(|error| format!("{error:?}"))?;
    let mut values = Evaluation::new(&system);
    values.dynamics(
        &system,
        &system.blank_state(0.0),
        &[],
        &mut Workspace::new(&system),
    );
    let both = values.acceleration.iter().flat_map(|[p, s]| [p[1], s[1]]);
    Ok(DVector::from_iterator(2 * values.acceleration.len(), both))
}

/// The mass over unconnected elements, their weight, and rows that connect and pin them (vertical
/// coordinates alone).
fn apart(cables: &[Cable<2>]) -> (DMatrix<f64>, DVector<f64>, DMatrix<f64>) {
    let n = 4 * cables.len();
    let (mut mass, mut force) = (DMatrix::zeros(n, n), DVector::zeros(n));
    let mut rows = DMatrix::zeros(2 * cables.len() - 1, n);
    rows[(0, 0)] = 1.0;
    for (j, cable) in cables.iter().enumerate() {
        let (m, w) = (cable.mass(), cable.weight());
        for a in 0..4 {
            force[4 * j + a] = -w[a];
            for b in 0..4 {
                mass[(4 * j + a, 4 * j + b)] = m[(a, b)];
            }
        }
        for k in 0..2 {
            if j > 0 {
                let row = 2 * j - 1 + k;
                rows[(row, 4 * j - 2 + k)] = 1.0;
                rows[(row, 4 * j + k)] = -1.0;
            }
        }
    }
    (mass, force, rows)
}

/// By the report's Eq. 23, mended: `M^-1 Phi^T = Q R`, `T = M^-1 Q2`, hence `Phi T = 0`.
fn by_inverse(cables: &[Cable<2>]) -> Outcome<DVector<f64>> {
    let (mass, force, rows) = apart(cables);
    let (n, m) = (rows.ncols(), rows.nrows());
    let inverse = mass.clone().try_inverse().ok_or("a singular mass")?;
    // With unit columns behind it the thin factor is the whole one.
    let mut wide = DMatrix::zeros(n, m + n);
    wide.columns_mut(0, m)
        .copy_from(&(&inverse * rows.transpose()));
    wide.columns_mut(m, n).fill_diagonal(1.0);
    let t = inverse * wide.qr().q().columns(m, n - m);
    let inertia = t.transpose() * mass * &t;
    let rates = inertia.lu().solve(&(t.transpose() * force));
    Ok(t * rates.ok_or("singular inertia")?)
}

/// Accelerations of the connected elements: their mass assembled, scaled to a unit diagonal.
fn assembled(cables: &[Cable<2>]) -> Outcome<DVector<f64>> {
    let (mass, force, _) = apart(cables);
    let n = 2 * cables.len() + 1;
    let place = |i: usize| (2 * (i / 4) + i % 4).checked_sub(1);
    let (mut m, mut f) = (DMatrix::zeros(n, n), DVector::zeros(n));
    for i in 0..force.len() {
        let Some(row) = place(i) else { continue };
        f[row] += force[i];
        for j in 0..force.len() {
            if let Some(column) = place(j) {
                m[(row, column)] += mass[(i, j)];
            }
        }
    }
    let scale = DVector::from_fn(n, |i, _| 1.0 / f64::sqrt(m[(i, i)]));
    let scaled = DMatrix::from_fn(n, n, |i, j| m[(i, j)] * scale[i] * scale[j]);
    let factors = scaled
        .cholesky()
        .ok_or("a mass that is not positive definite")?;
    let a = factors
        .solve(&f.component_mul(&scale))
        .component_mul(&scale);
    Ok(DVector::from_fn(
        n + 1,
        |i, _| if i == 0 { 0.0 } else { a[i - 1] },
    ))
}

/// Elimination by the inverse of the mass.
pub fn masses_and_lengths() -> Outcome<Row> {
    let cables = cables();
    let exact = assembled(&cables)?;
    // In the mass norm, in which nothing depends on units.
    let (mass, ..) = apart(&cables);
    let spread =
        |nodes: &DVector<f64>| DVector::from_fn(mass.nrows(), |i, _| nodes[2 * (i / 4) + i % 4]);
    let norm = |x: &DVector<f64>| x.dot(&(&mass * x)).sqrt();
    let wanted = spread(&exact);
    let off = |found: &DVector<f64>| norm(&(found - &wanted)) / norm(&wanted);
    let [failing, kept] = [off(&by_inverse(&cables)?), off(&spread(&product(&cables)?))];
    Ok(Row {
        place: "Masses of ratio 1e6, lengths of ratio 1e3",
        method: "M^-1 Phi^T = Q R as in the report's Eq. 23, T = M^-1 Q2; 6 elements".into(),
        failing: figure(failing, format!("accelerations {} off", short(failing))),
        product: figure(kept, format!("accelerations {} off", short(kept))),
        test: "the_inverse_of_the_mass_loses_digits",
    })
}

#[test]
fn the_inverse_of_the_mass_loses_digits() {
    let row = masses_and_lengths().expect("a row");
    assert!(row.failing.value > 1e-10, "{}", row.failing.text);
    assert!(row.product.value < 1e-12, "{}", row.product.text);
}

//! Report Eqs. 23-34 as printed fail where the product's formulation holds, by orders of magnitude.

use flexbody::body::Formulation;
use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Element, Strain};
use flexbody::system::{Evaluation, Parts, System, Work};
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::prelude::*;

use crate::bodies::worst_gap;
use crate::chain::{Chain, Held, Hold, ORDINARY, chains, expansion, flat};
use crate::differences::{check, within};

const GRAVITY: f64 = -9.81;

/// A beam of two equal elements, pinned at its first end, in a unit of length that is `unit` m.
fn beam(unit: f64) -> Chain {
    let length = 0.6 / unit;
    let parameters = Parameters {
        inertia: Inertia::Consistent,
        length,
        axial_stiffness: 1260.0,
        bending_stiffness: 8.505e-3,
        line_density: 9.972 * unit,
        damping_time: 0.0,
        strain: Strain::ThetaPrime,
    };
    let node = |i: u8| [Vector2::new(f64::from(i) * length, 0.0), Vector2::x()];
    Chain {
        elements: vec![Cable::new(parameters, None); 2],
        nodes: vec![node(0), node(1), node(2)],
        joints: vec![Held {
            hold: Hold::Revolute,
            node: 0,
        }],
        noise: Vec::new(),
    }
}

/// Accelerations under gravity from rest over all elements, m/s^2 (positions).
fn fall(formulation: Formulation, unit: f64) -> DVector<f64> {
    let parts = Parts {
        gravity: Vector2::new(0.0, GRAVITY / unit),
        ..beam(unit).parts(formulation)
    };
    let system = System::new(parts).expect("a body with mass");
    let mut values = Evaluation::new(&system);
    let rest = system.blank_state(0.0);
    values.dynamics(&system, &rest, &[], &mut Work::new(&system));
    flat(&system.chains()[0], &values.acceleration) * unit
}

/// Acceleration of the pin, gap that opens between the elements, and acceleration of the tip
/// (vertical), m/s^2.
fn pin_gap_and_tip(formulation: Formulation, unit: f64) -> [f64; 3] {
    let a = fall(formulation, unit);
    let gap = (a.fixed_rows::<2>(4) - a.fixed_rows::<2>(8)).norm();
    [a.fixed_rows::<2>(0).norm(), gap, a[13]]
}

/// Exact tip acceleration on this mesh, from the augmented equations of one unknown function: a pinned
/// uniform beam without strain falls like a chain of two elements whose vertical motion is cubic.
fn tip_by_rayleigh_ritz() -> f64 {
    let beam = beam(1.0);
    // Free nodal coordinates: slope at 0, position and slope at 1 and at 2; vertical only.
    let place = |element: usize, k: usize| (2 * element + k).checked_sub(1);
    let (mut mass, mut force) = (DMatrix::zeros(5, 5), DVector::zeros(5));
    for (j, element) in beam.elements.iter().enumerate() {
        let (m, w) = (element.mass(), element.weight());
        for a in 0..4 {
            let Some(row) = place(j, a) else { continue };
            force[row] += GRAVITY * w[a];
            for b in 0..4 {
                if let Some(column) = place(j, b) {
                    mass[(row, column)] += m[(a, b)];
                }
            }
        }
    }
    let solution = mass.lu().solve(&force).expect("a positive definite mass");
    solution[3]
}

#[test]
fn a_pinned_beam_falls_as_one_piece() {
    let [pin, gap, tip] = pin_gap_and_tip(Formulation::MassWeighted, 1.0);
    assert!(pin < 1e-13, "the pin moves with {pin:e} m/s^2");
    assert!(gap < 1e-13, "the elements part with {gap:e} m/s^2");
    let exact = tip_by_rayleigh_ritz();
    assert!((tip - exact).abs() < 1e-12, "{tip} instead of {exact}");
    assert!((tip + 10.511).abs() < 1e-3, "{tip} instead of -10.511");
    let [_, _, in_millimetres] = pin_gap_and_tip(Formulation::MassWeighted, 1e-3);
    assert!((in_millimetres - tip).abs() < 1e-11, "{in_millimetres}");
}

#[test]
fn as_printed_it_falls_off_its_pin_and_apart() {
    let [pin, gap, tip] = pin_gap_and_tip(Formulation::AsPrinted, 1.0);
    assert!((pin - 9.68).abs() < 5e-3, "the pin moves with {pin} m/s^2");
    assert!(
        (gap - 0.097).abs() < 1e-3,
        "the elements part with {gap} m/s^2"
    );
    assert!((tip + 9.825).abs() < 1e-3, "tip acceleration {tip}");
    // What is printed even depends on the unit of length.
    let [_, _, in_millimetres] = pin_gap_and_tip(Formulation::AsPrinted, 1e-3);
    assert!((in_millimetres - tip).abs() > 1.0, "{in_millimetres}");
}

/// Largest violation of connectivity and of identity inertia by unit coordinates.
fn violations(formulation: Formulation) -> (f64, f64) {
    let beam = beam(1.0);
    let t = expansion(&beam.system(formulation));
    let gaps = (0..4).map(|row| (t.row(4 + row) - t.row(8 + row)).amax());
    let gap = gaps.fold(0.0, f64::max) / t.amax();
    let mass = beam.mass();
    let inertia = t.transpose() * mass * &t;
    let identity = DMatrix::<f64>::identity(t.ncols(), t.ncols());
    (gap, (inertia - identity).amax())
}

#[test]
fn as_printed_connectivity_and_inertia_fail_by_orders_of_magnitude() {
    let (gap, inertia) = violations(Formulation::MassWeighted);
    assert!(gap < 1e-14 && inertia < 1e-14, "{gap:e}, {inertia:e}");
    let (gap, inertia) = violations(Formulation::AsPrinted);
    assert!(gap > 0.1 && inertia > 0.1, "{gap:e}, {inertia:e}");
}

/// On every random body of more than one element, where the product's formulation keeps roundoff.
#[test]
fn as_printed_every_body_breaks() {
    check(96, chains(ORDINARY), |mut chain| {
        chain.joints.retain(|joint| joint.hold == Hold::Revolute);
        if chain.elements.len() < 2 {
            return Ok(());
        }
        let printed = expansion(&chain.system(Formulation::AsPrinted));
        let gap = worst_gap(&chain, &printed);
        prop_assert!(gap > 1e-3, "connectivity holds to {:e}", gap);
        let weighted = expansion(&chain.system(Formulation::MassWeighted));
        within("connectivity", worst_gap(&chain, &weighted), 1e-13)
    });
}

//! Report Eqs. 23-34 as printed fail where the product's formulation holds, by orders of magnitude.

use flexbody::body::{Constraint, Formulation, Hold};
use flexbody::elements::cable::{Cable, Parameters};
use flexbody::elements::{Element, Nodal, Strain};
use flexbody::system::PlanarBody;
use flexbody::system::joints::JointKind;
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::prelude::*;

use crate::bodies::worst_gap;
use crate::chain::{ORDINARY, chains, expansion};
use crate::differences::{check, within};

const GRAVITY: f64 = -9.81;

/// A beam of two equal elements, pinned at its first end, in a unit of length that is `unit` m.
fn beam(formulation: Formulation, unit: f64) -> PlanarBody {
    let length = 0.6 / unit;
    let parameters = Parameters {
        length,
        axial_stiffness: 1260.0,
        bending_stiffness: 8.505e-3,
        line_density: 9.972 * unit,
        damping_time: 0.0,
        strain: Strain::ThetaPrime,
    };
    let node = |i: u8| [Vector2::new(f64::from(i) * length, 0.0), Vector2::x()];
    let pin = Constraint {
        node: 0,
        hold: Hold::Position,
        joint: 0,
    };
    let elements = vec![Cable::new(parameters, None); 2];
    PlanarBody::new(elements, &[node(0), node(1), node(2)], &[pin], formulation)
}

/// Accelerations under gravity from rest, m/s^2 (positions).
fn fall(formulation: Formulation, unit: f64) -> Vec<Nodal<2>> {
    let body = beam(formulation, unit);
    let gravity = Vector2::new(0.0, GRAVITY / unit);
    let weight: Vec<_> = (body.elements().iter())
        .map(|element| gravity * element.weight().transpose())
        .collect();
    let (mut scratch, mut q) = (body.scratch(), vec![0.0; body.coordinates()]);
    body.reduce(&weight, &mut scratch.border, &mut q);
    body.rates(&q, &mut scratch.border, &mut scratch.rate);
    scratch.rate.iter().map(|a| a * unit).collect()
}

/// Acceleration of the pin, gap that opens between the elements, and acceleration of the tip
/// (vertical), m/s^2.
fn pin_gap_and_tip(formulation: Formulation, unit: f64) -> [f64; 3] {
    let a = fall(formulation, unit);
    let gap = (a[0].column(2) - a[1].column(0)).norm();
    [a[0].column(0).norm(), gap, a[1][(1, 2)]]
}

/// Exact tip acceleration on this mesh, from the augmented equations of one unknown function: a pinned
/// uniform beam without strain falls like a chain of two elements whose vertical motion is cubic.
fn tip_by_rayleigh_ritz() -> f64 {
    let body = beam(Formulation::MassWeighted, 1.0);
    // Free nodal coordinates: slope at 0, position and slope at 1 and at 2; vertical only.
    let place = |element: usize, k: usize| (2 * element + k).checked_sub(1);
    let (mut mass, mut force) = (DMatrix::zeros(5, 5), DVector::zeros(5));
    for (j, element) in body.elements().iter().enumerate() {
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
    assert!((tip + 10.51).abs() < 5e-3, "{tip} instead of -10.51");
    let [_, _, in_millimetres] = pin_gap_and_tip(Formulation::MassWeighted, 1e-3);
    assert!((in_millimetres - tip).abs() < 1e-11, "{in_millimetres}");
}

#[test]
fn as_printed_it_falls_off_its_pin_and_apart() {
    let [pin, gap, tip] = pin_gap_and_tip(Formulation::AsPrinted, 1.0);
    assert!((pin - 9.7).abs() < 0.05, "the pin moves with {pin} m/s^2");
    assert!(gap > 0.05, "the elements part with {gap} m/s^2 only");
    assert!((tip + 9.83).abs() < 1e-2, "tip acceleration {tip}");
    // What is printed even depends on the unit of length.
    let [_, _, in_millimetres] = pin_gap_and_tip(Formulation::AsPrinted, 1e-3);
    assert!((in_millimetres - tip).abs() > 1.0, "{in_millimetres}");
}

/// Largest violation of connectivity and of identity inertia by unit coordinates.
fn violations(formulation: Formulation) -> (f64, f64) {
    let body = beam(formulation, 1.0);
    let t = expansion(&body);
    let gaps = (0..4).map(|row| (t.row(4 + row) - t.row(8 + row)).amax());
    let gap = gaps.fold(0.0, f64::max) / t.amax();
    let mut mass = DMatrix::zeros(16, 16);
    for (j, element) in body.elements().iter().enumerate() {
        let full = element.mass().kronecker(&nalgebra::Matrix2::identity());
        mass.view_mut((8 * j, 8 * j), (8, 8)).copy_from(&full);
    }
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
        chain
            .joints
            .retain(|joint| joint.kind == JointKind::Revolute);
        if chain.elements.len() < 2 {
            return Ok(());
        }
        let printed = expansion(&chain.body(Formulation::AsPrinted));
        let gap = worst_gap(&chain, &printed);
        prop_assert!(gap > 1e-3, "connectivity holds to {:e}", gap);
        let weighted = expansion(&chain.body(Formulation::MassWeighted));
        within("connectivity", worst_gap(&chain, &weighted), 1e-13)
    });
}

//! A pinned beam falls as one piece: connectivity and identity inertia hold to roundoff. What the report's
//! Eqs. 23-34 do as printed is tested in the studies.

use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Element, StrainMeasure};
use flexbody::system::{Evaluation, Parts, System, Workspace};
use nalgebra::{DMatrix, DVector, Vector2};

use crate::laws::chain::{Chain, Held, Hold, expansion, flat};

const GRAVITY: f64 = -9.81;

/// A beam of two equal elements, pinned at its first end, in a unit of length that is `unit` m.
fn beam(unit: f64) -> Chain {
    let length = 0.6 / unit;
    let parameters = Parameters {
        inertia: Inertia::Consistent,
        length,
        axial_stiffness: 1260.0,
        bending_stiffness: 8.505e-3,
        line_of: flexbody::elements::cable::LineOf::Cable,
        line_density: 9.972 * unit,
        axial_damping_time: 0.0,
        bending_damping_time: 0.0,
        strain: StrainMeasure::ThetaPrime,
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
fn fall(unit: f64) -> DVector<f64> {
    let parts = Parts {
        gravity: Vector2::new(0.0, GRAVITY / unit),
        ..beam(unit).parts()
    };
    let system = System::new(parts).expect("a body with mass");
    let mut values = Evaluation::new(&system);
    let rest = system.blank_state(0.0);
    values.dynamics(&system, &rest, &[], &mut Workspace::new(&system));
    flat(&system.bodies().lines()[0], &values.acceleration) * unit
}

/// Acceleration of the pin, gap that opens between the elements, and acceleration of the tip
/// (vertical), m/s^2.
fn pin_gap_and_tip(unit: f64) -> [f64; 3] {
    let a = fall(unit);
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
    let [pin, gap, tip] = pin_gap_and_tip(1.0);
    assert!(pin < 1e-13, "the pin moves with {pin:e} m/s^2");
    assert!(gap < 1e-13, "the elements part with {gap:e} m/s^2");
    let exact = tip_by_rayleigh_ritz();
    assert!((tip - exact).abs() < 1e-12, "{tip} instead of {exact}");
    assert!((tip + 10.511).abs() < 1e-3, "{tip} instead of -10.511");
    let [_, _, in_millimetres] = pin_gap_and_tip(1e-3);
    assert!((in_millimetres - tip).abs() < 1e-11, "{in_millimetres}");
}

/// Largest violation of connectivity and of identity inertia by unit coordinates.
fn violations() -> (f64, f64) {
    let beam = beam(1.0);
    let t = expansion(&beam.system());
    let gaps = (0..4).map(|row| (t.row(4 + row) - t.row(8 + row)).amax());
    let gap = gaps.fold(0.0, f64::max) / t.amax();
    let mass = beam.mass();
    let inertia = t.transpose() * mass * &t;
    let identity = DMatrix::<f64>::identity(t.ncols(), t.ncols());
    (gap, (inertia - identity).amax())
}

#[test]
fn connectivity_and_identity_inertia_hold() {
    let (gap, inertia) = violations();
    assert!(gap < 1e-14 && inertia < 1e-14, "{gap:e}, {inertia:e}");
}

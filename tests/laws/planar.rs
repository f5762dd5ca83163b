//! Laws of the planar cable.

use flexbody::elements::{Element, Nodal, StrainMeasure};
use nalgebra::SVector;

use crate::laws::differences::{Outcome, apply, check, derivative, within};
use crate::laws::elements;
use crate::laws::specimen::{Specimen, planar, rigid_motion};

type Planar = Specimen<2>;

/// Random elements that each law sees.
const CASES: u32 = 256;

#[test]
fn mass_and_weight_are_integrals_of_the_shape_functions() {
    check(CASES, planar(), |s| elements::inertia(&s));
}

#[test]
fn force_is_minus_the_gradient_of_the_energy() {
    check(CASES, planar(), |s| elements::force_is_gradient(&s));
}

#[test]
fn stiffness_is_minus_the_derivative_of_the_force_and_symmetric() {
    check(CASES, planar(), |s| elements::stiffness_is_derivative(&s));
}

#[test]
fn force_and_energy_do_not_see_rigid_motion() {
    check(CASES, (planar(), rigid_motion()), |(s, motion)| {
        elements::objectivity(&s, &motion)
    });
}

#[test]
fn forces_and_moments_sum_to_zero() {
    check(CASES, planar(), |s| elements::momentum(&s));
}

#[test]
fn energy_changes_by_the_power_of_the_force() {
    check(CASES, planar(), |s| elements::power(&s));
}

#[test]
fn damping_is_minus_the_derivative_by_the_rate_symmetric_and_dissipates() {
    check(CASES, planar(), |s| elements::damping(&s));
}

#[test]
fn strains_are_those_of_the_position_field() {
    check(CASES, (planar(), 0.0..1.0), |(s, xi)| {
        let measure = s.parameters.strain;
        elements::strains(&s, xi, |u, w| {
            let (stretch, turn) = (u.norm(), u.x * w.y - u.y * w.x);
            match measure {
                StrainMeasure::ThetaPrime => (stretch - 1.0, turn / stretch.powi(2)),
                StrainMeasure::GreenLagrangeFrenetKappa => {
                    (0.5 * (stretch * stretch - 1.0), turn / stretch.powi(3))
                }
                StrainMeasure::EngStrainFrenetKappa => (stretch - 1.0, turn / stretch.powi(3)),
            }
        })
    });
}

/// Where strains are sampled, with weight times stiffness: axial, then bending.
fn samples(s: &Planar) -> [Vec<(f64, f64)>; 2] {
    let p = &s.parameters;
    let points = |far: f64, end: f64| {
        let far = far.sqrt() / 2.0;
        vec![(0.5 - far, end), (0.5, 1.0 - 2.0 * end), (0.5 + far, end)]
    };
    let axial = if s.is_slender() {
        points(1.0, 1.0 / 6.0)
    } else {
        points(13.0 / 15.0, 5.0 / 26.0)
    };
    let bending = points(0.6, 5.0 / 18.0);
    let times = |points: Vec<(f64, f64)>, stiffness: f64| {
        points
            .into_iter()
            .map(|(xi, w)| (xi, w * stiffness * p.length))
            .collect()
    };
    [
        times(axial, p.axial_stiffness),
        times(bending, p.bending_stiffness),
    ]
}

/// Axial strain (0) or curvature (1) at a sample.
fn measure(s: &Planar, e: &Nodal<2>, xi: f64, kind: usize) -> f64 {
    let (strain, curvature) = s.cable.strain(e, xi);
    [strain, curvature][kind]
}

/// Sum over all samples of a function of (xi, kind).
fn sum(s: &Planar, f: impl Fn(f64, usize) -> f64) -> f64 {
    let mut sum = 0.0;
    for (kind, points) in samples(s).into_iter().enumerate() {
        sum += points
            .into_iter()
            .map(|(xi, w)| w * f(xi, kind))
            .sum::<f64>();
    }
    sum
}

#[test]
fn energy_is_half_the_integral_of_squared_strains() {
    check(CASES, planar(), |s| {
        let squares = sum(&s, |xi, kind| {
            let change = measure(&s, &s.e, xi, kind) - measure(&s, &s.unstressed, xi, kind);
            change * change
        });
        let off = (s.cable.energy(&s.e) - 0.5 * squares).abs();
        within("energy", off, 1e-12 * s.energy_scale())
    });
}

/// Damping times of both strains, and the longer one.
fn damping_times(s: &Planar) -> ([f64; 2], f64) {
    let p = &s.parameters;
    let times = [p.axial_damping_time, p.bending_damping_time];
    (times, p.longest_damping_time())
}

#[test]
fn stress_of_damping_is_stiffness_times_damping_time_times_strain_rate() {
    check(CASES, planar(), |s| {
        let (times, longest) = damping_times(&s);
        let [x, y] = &s.directions;
        let rate = |direction: &Nodal<2>, xi, kind| {
            derivative(1e-3, |t| measure(&s, &(s.e + direction * t), xi, kind))
        };
        let power = sum(&s, |xi, kind| {
            times[kind] * rate(x, xi, kind) * rate(y, xi, kind)
        });
        let found = x.dot(&apply(&s.cable.damping(&s.e), y));
        let off = (found - power).abs();
        within("Kelvin-Voigt", off, 1e-8 * longest * s.energy_scale())
    });
}

/// At a rate the exact derivative of a damped force is not symmetric; the stiffness is what remains
/// when the rate of strain is taken as given. What is left out is computed here.
#[test]
fn stiffness_at_a_rate_takes_the_rate_of_strain_as_given() {
    check(CASES, planar(), |s| left_out(&s));
}

fn left_out(s: &Planar) -> Outcome {
    let ((times, longest), scale) = (damping_times(s), s.energy_scale());
    let [x, y] = &s.directions;
    let change = derivative(5e-4, |t| s.cable.force(&(s.e + y * t), &s.rate));
    let kept = apply(&s.cable.stiffness(&s.e, &s.rate), y);
    let expected = sum(s, |xi, kind| {
        let along = derivative(1e-3, |t| measure(s, &(s.e + x * t), xi, kind));
        let rate = |t: f64| derivative(2e-3, |u| measure(s, &(s.e + y * t + s.rate * u), xi, kind));
        times[kind] * along * derivative(2e-3, rate)
    });
    let off = (x.dot(&(change + kept)) + expected).abs();
    within("derivative at a rate", off, 1e-6 * scale * (1.0 + longest))
}

#[test]
fn both_quadratures_are_seen() {
    let slender = std::cell::Cell::new([0_u32; 2]);
    check(CASES, planar(), |s| {
        let mut seen = slender.get();
        seen[usize::from(s.is_slender())] += 1;
        slender.set(seen);
        Ok(())
    });
    assert!(slender.get().iter().all(|count| *count > CASES / 4));
}

#[test]
fn a_constant_stretch_has_the_energy_of_a_rod() {
    check(CASES, (planar(), 0.5..1.5), |(s, stretch)| {
        let p = &s.parameters;
        let straight = flexbody::elements::cable::Cable::<2>::new(*p, None);
        let along = SVector::from([0.6, 0.8]);
        let zero = SVector::zeros();
        let e = Nodal::from_columns(&[
            zero,
            along * stretch,
            along * (stretch * p.length),
            along * stretch,
        ]);
        let strain = match p.strain {
            StrainMeasure::GreenLagrangeFrenetKappa => 0.5 * (stretch * stretch - 1.0),
            _ => stretch - 1.0,
        };
        let exact = 0.5 * p.axial_stiffness * p.length * strain * strain;
        let off: f64 = straight.energy(&e) - exact;
        let off = off.abs();
        within("energy of stretching", off, 1e-14 * s.energy_scale())
    });
}

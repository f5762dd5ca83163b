//! Laws of the spatial cable, straight without stress.

use flexbody::elements::cable::Cable;
use flexbody::elements::{Element, Nodal, StrainMeasure};

use crate::laws::differences::{apply, check, scaled, within};
use crate::laws::elements;
use crate::laws::specimen::{planar, rigid_motion, spatial};

const CASES: u32 = 128;

#[test]
fn mass_and_weight_are_integrals_of_the_shape_functions() {
    check(CASES, spatial(), |s| elements::inertia(&s));
}

#[test]
fn force_is_minus_the_gradient_of_the_energy() {
    check(CASES, spatial(), |s| elements::force_is_gradient(&s));
}

#[test]
fn stiffness_is_minus_the_derivative_of_the_force_and_symmetric() {
    check(CASES, spatial(), |s| elements::stiffness_is_derivative(&s));
}

#[test]
fn force_and_energy_do_not_see_rigid_motion() {
    check(CASES, (spatial(), rigid_motion()), |(s, motion)| {
        elements::objectivity(&s, &motion)
    });
}

#[test]
fn forces_and_moments_sum_to_zero() {
    check(CASES, spatial(), |s| elements::momentum(&s));
}

#[test]
fn energy_changes_by_the_power_of_the_force() {
    check(CASES, spatial(), |s| elements::power(&s));
}

#[test]
fn damping_is_minus_the_derivative_by_the_rate_symmetric_and_dissipates() {
    check(CASES, spatial(), |s| elements::damping(&s));
}

#[test]
fn strains_are_those_of_the_position_field() {
    check(CASES, (spatial(), 0.0..1.0), |(s, xi)| {
        let measure = s.parameters.strain;
        elements::strains(&s, xi, |u, w| {
            let (stretch, turn) = (u.norm(), u.cross(w).norm());
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

/// A planar state somewhere in space is what the planar cable says it is.
#[test]
fn a_planar_state_in_space_agrees_with_the_planar_cable() {
    check(CASES, (planar(), rigid_motion::<3>()), |(s, motion)| {
        let p = s.parameters;
        let (flat, full) = (Cable::<2>::new(p, None), Cable::<3>::new(p, None));
        let lift = |x: &Nodal<2>| {
            let lifted = Nodal::<3>::from_fn(|i, k| if i < 2 { x[(i, k)] } else { 0.0 });
            motion.rotation * lifted
        };
        let (e, rest) = (lift(&s.e), Nodal::zeros());
        let scale = s.energy_scale() * (1.0 + p.longest_damping_time());
        let off = (full.energy(&e) - flat.energy(&s.e)).abs();
        within("energy", off, 1e-13 * scale)?;
        let flat_force = flat.force(&s.e, &Nodal::zeros());
        let off = full.force(&e, &rest) - lift(&flat_force);
        let bent = |change: [f64; 3]| nalgebra::SVector::from(change).norm();
        for xi in [0.0, 1.0] {
            let found = bent(full.curvature_change(&e, xi));
            let off = found - bent(flat.curvature_change(&s.e, xi));
            within(
                "curvature",
                off.abs() * p.length,
                1e-11 * (1.0 + found * p.length),
            )?;
        }
        within("force", scaled(&off, p.length).abs().max(), 1e-12 * scale)?;
        let off = full.force(&e, &lift(&s.rate)) - lift(&flat.force(&s.e, &s.rate));
        within("damping", scaled(&off, p.length).abs().max(), 1e-12 * scale)?;
        let [x, _] = &s.directions;
        let flat_change = apply(&flat.stiffness(&s.e, &Nodal::zeros()), x);
        let off = apply(&full.stiffness(&e, &rest), &lift(x)) - lift(&flat_change);
        let off = scaled(&off, p.length).abs().max();
        within("stiffness", off, 1e-12 * scale)
    });
}

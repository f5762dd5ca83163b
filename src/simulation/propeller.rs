//! Rods that rotate so quickly that the propeller moment counts, which they do not have.
//!
//! A section of unequal second moments that rotates at `w1`, `w2` about its axes takes the moment `rho (I2 - I1) w1 w2` about the
//! tangent, per length. Where a rod rotates at `w` across its line, that is up to `rho |I2 - I1| w^2` times a small twist: a
//! stiffness, which stands against that of torsion, `G J (PI / (2 L))^2` in the lowest shape of a rod held at one end.
//!
//! Source: A. A. Shabana, Dynamics of Multibody Systems, 5th ed. (2020), section 3.6 (Euler's equations, here of a section).

use std::f64::consts::FRAC_PI_2;
use std::fmt;

use super::engine::Engine;
use super::inputs::Inputs;
use super::once::Once;
use crate::scene::{BodyReference, Resolved};
use crate::system::State;

/// Share of the stiffness of torsion from which on it is told.
const SHARE: f64 = 1e-3;

/// Rods with sections of unequal second moments.
#[derive(Default)]
pub(super) struct PropellerWatch {
    rods: Vec<Rod>,
}

struct Rod {
    /// Index of the body. `chain` is the index of its chain.
    body: usize,
    chain: usize,
    /// Share of the stiffness of torsion by the square of the rate, s^2.
    by_rate: f64,
    /// The share when it was first too large.
    found: Once<f64>,
}

/// A rod that rotates too quickly to leave the propeller moment out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoPropeller<'a> {
    /// The body.
    pub body: &'a str,
    /// Size of the missing moment relative to the torsional stiffness.
    pub share: f64,
}

impl fmt::Display for NoPropeller<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: rotates so quickly that the propeller moment of its sections, which a rod does not have, is about {:.1e} of its stiffness \
             of torsion; a beam has it",
            self.body, self.share
        )
    }
}

impl PropellerWatch {
    /// Collects the rods of a scene.
    pub(super) fn new(resolved: &Resolved<'_>) -> Self {
        let lines = resolved.bodies.iter().filter_map(|body| match body {
            BodyReference::Cable(cable) => Some(cable),
            BodyReference::Rigid(_) | BodyReference::Reduced(_) | BodyReference::Plate(_) => None,
        });
        let rods = lines.filter(|cable| cable.body.is_rod() && !cable.body.is_beam());
        let rods = rods.filter_map(|cable| {
            let chain = cable.id.chain()?;
            let (body, length) = (cable.body, cable.body.shape.length());
            let shear = body.material.shear_modulus.unwrap_or_default();
            let by_rate = body.all_sections().map(|section| {
                let numbers = section.numbers();
                let torsion = shear * numbers.torsion_constant * (FRAC_PI_2 / length).powi(2);
                body.material.density.unwrap_or_default() * numbers.principal_difference() / torsion
            });
            Some(Rod {
                body: cable.id.body_index(),
                chain,
                by_rate: by_rate.filter(|by| by.is_finite()).fold(0.0, f64::max),
                found: Once::default(),
            })
        });
        Self {
            rods: rods.filter(|rod| rod.by_rate > 0.0).collect(),
        }
    }
}

impl<const D: usize> Engine<D> {
    /// Looks at a communication point at how fast rods rotate across their lines.
    pub(super) fn watch_propeller(&mut self, state: &State, inputs: &Inputs) {
        let mut watch = std::mem::take(&mut self.propeller);
        for rod in watch.rods.iter_mut().filter(|rod| rod.found.is_open()) {
            let (assembled, values) = self.placed(state, inputs);
            let system = &assembled.system;
            let square = values.turning_across(system, &system.bodies().lines()[rod.chain]);
            let share = rod.by_rate * square;
            rod.found.find((share > SHARE).then_some(share));
        }
        self.propeller = watch;
    }

    /// A rod that rotates too quickly and that has not been told of.
    pub(super) fn next_without_propeller(&mut self) -> Option<NoPropeller<'_>> {
        let mut rods = self.propeller.rods.iter_mut();
        let (body, share) = rods.find_map(|rod| Some((rod.body, rod.found.tell()?)))?;
        Some(NoPropeller {
            body: &self.bodies[body],
            share,
        })
    }
}

//! Damping that lets axial waves of a cable settle.

use std::f64::consts::PI;

use crate::scene::Axial;
use crate::scene::resolved::{Cable, Place, Resolved, ResolvedMarker};

/// Part of the length from an end up to which a marker is at it.
const AT_END: f64 = 1e-9;

impl Resolved<'_> {
    /// Kelvin-Voigt damping time of the axial strain of a cable, s: that of its material or, where axial waves are to
    /// settle and that is longer, `2 / omega_1`, which damps the first axial mode critically.
    pub(super) fn axial_damping_time(&self, cable: Cable<'_>) -> f64 {
        let time = cable.body.material.damping_time;
        match cable.body.axial {
            Axial::Waves => time,
            Axial::CriticallyDamped => time.max(2.0 / self.first_axial_frequency(cable)),
        }
    }

    /// Angular frequency of the first axial mode of a uniform bar with these ends, rad/s: `pi c / L` where both ends are
    /// held or both are free, `pi c / (2 L)` where one is.
    fn first_axial_frequency(&self, cable: Cable<'_>) -> f64 {
        let (body, middle) = (cable.body, cable.body.section_at(0.5));
        let [stiffness, density] = [
            body.axial_stiffness_of(&middle),
            body.line_density_of(&middle) + self.added_mass(cable.id.body_index(), &middle),
        ];
        let speed = (stiffness / density).sqrt();
        let halves = match self.held_ends(cable) {
            [true, false] | [false, true] => 0.5,
            [true, true] | [false, false] => 1.0,
        };
        PI * halves * speed / body.shape.length()
    }

    /// Whether joints or motions exert forces on the first and the last end of a cable.
    fn held_ends(&self, cable: Cable<'_>) -> [bool; 2] {
        let mut held = [false; 2];
        let mut hold = |marker: ResolvedMarker<'_>| {
            if let Place::Along(of, s) = marker.place
                && of.id == cable.id
            {
                held[0] |= s < AT_END;
                held[1] |= s > 1.0 - AT_END;
            }
        };
        for joint in self.joints.iter().filter(|joint| joint.holds_position()) {
            joint.ends.markers().into_iter().for_each(&mut hold);
        }
        for motion in self.all_motions() {
            let quantity = motion.driven.quantity();
            if quantity.exerts[0] {
                quantity.place.markers().into_iter().for_each(&mut hold);
            }
        }
        held
    }
}

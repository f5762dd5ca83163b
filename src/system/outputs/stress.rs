//! Stress at points of sections.
//!
//! Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed. (1970), section 102 (bending: stress is linear over the
//! section) and chapter 10 (torsion).

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::space::{axis, components};
use crate::system::System;

/// A point of a section whose stress is read: stress by force and moments.
#[derive(Clone, Copy, Debug)]
pub struct StressPoint {
    /// Where the section is.
    pub marker: Marker,
    /// Normal stress by the force across the section, 1/m^2.
    pub by_force: f64,
    /// Normal stress by the moments about the first and the second axis; in the plane by the moment, and 0 before, 1/m^3.
    pub by_moments: [f64; 2],
    /// Shear stress by the torque, 1/m^3.
    pub by_torque: f64,
    /// Point of the section that it twists about and that the torque is about, m.
    pub twist_center: [f64; 2],
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Normal stress at a point of a section, Pa.
    pub fn stress(&self, system: &System<D>, point: &StressPoint) -> N {
        let (force, moment) = self.cut(system, &point.marker);
        let [normal, first, second] = self.section_axes(system, &point.marker);
        let moment = Vector3::from(moment);
        let [by_first, by_second] = point.by_moments.map(N::of);
        normal.dot(&Vector3::from(components(&force))) * N::of(point.by_force)
            + first.dot(&moment) * by_first
            + second.dot(&moment) * by_second
    }

    /// Axial force (N) in a section, and bending moments about both its axes (N m); of a section without axes the size of the moment is
    /// the first.
    pub fn section_forces(&self, system: &System<D>, marker: &Marker) -> [N; 3] {
        let (force, moment) = self.cut(system, marker);
        let [normal, first, second] = self.section_axes(system, marker);
        let (force, moment) = (Vector3::from(components(&force)), Vector3::from(moment));
        let axial = normal.dot(&force);
        if D == 3 && marker.is_framed() {
            return [axial, first.dot(&moment), second.dot(&moment)];
        }
        let across = moment - normal * normal.dot(&moment);
        [axial, across.norm(), N::of(0.0)]
    }

    /// Shear stress by torsion at a point of a section, Pa.
    pub fn torsion_stress(&self, system: &System<D>, point: &StressPoint) -> N {
        let (force, moment) = self.cut(system, &point.marker);
        let [normal, first, second] = self.section_axes(system, &point.marker);
        let mut torque = normal.dot(&Vector3::from(moment));
        if point.twist_center != [0.0; 2] {
            let force = Vector3::from(components(&force));
            let [y, z] = point.twist_center.map(N::of);
            torque = torque + first.dot(&force) * z - second.dot(&force) * y;
        }
        torque * N::of(point.by_torque)
    }

    /// Returns the normal of a section and its axes. In the plane they are the tangent and the perpendicular axis,
    /// which is last.
    fn section_axes(&self, system: &System<D>, marker: &Marker) -> [Vector3<N>; 3] {
        if marker.is_framed() {
            return self.axes(system, marker).map(Vector3::from);
        }
        let tangent = marker.lift::<N>().direction(&self.x).normalize();
        [components(&tangent).into(), Vector3::zeros(), axis(2)]
    }
}

//! Points and heights of sections, and gauges of reduced bodies, whose stress is read.

use super::Builder;
use crate::scene::resolved;
use crate::system::{Gauge, StressLayer, StressPoint};

impl<const D: usize> Builder<'_, D> {
    /// All of them, as the scene numbers them.
    pub(super) fn section_points(&self) -> Vec<StressPoint> {
        let points = self.resolved.points.iter();
        points.map(|point| self.section_point(point)).collect()
    }

    /// Gauges of reduced bodies, as the scene numbers them.
    pub(super) fn gauges(&self) -> Vec<Gauge> {
        let gauge = |of: &resolved::ResolvedGauge<'_>| {
            let id = of.reduced.id.index();
            let body = self.interfaces.range(..id).count();
            let model = self.parts.bodies.reduced()[body].model();
            Gauge {
                body,
                by_modes: model.by_own_modes(of.by_modes),
            }
        };
        self.resolved.gauges.iter().map(gauge).collect()
    }

    /// Heights in sections of plates and shells, as the scene numbers them.
    pub(super) fn layers(&self) -> Vec<StressLayer> {
        let layers = self.resolved.layers.iter();
        let layer = |layer: &resolved::SectionLayer<'_>| StressLayer {
            marker: self.marker(layer.marker),
            height: layer.height,
            law: layer.law,
        };
        layers.map(layer).collect()
    }

    fn section_point(&self, given: &resolved::SectionPoint<'_>) -> StressPoint {
        let section = given.cable.body.section_after(given.at);
        let [y, _] = given.point;
        let by_moments = match D {
            // Bending in the plane is about the first axis, which is across it; about the other one the body is held.
            2 if y == 0.0 => [0.0; 2],
            2 => [0.0, -y / section.second_moments[0]],
            _ => section.stress_by_moments(given.point),
        };
        // Rods twist about their line.
        let twist_center = if given.cable.body.is_beam() {
            section.shear_center()
        } else {
            [0.0; 2]
        };
        StressPoint {
            marker: self.marker(given.marker),
            by_force: section.area.recip(),
            by_moments,
            by_torque: (section.shape.as_ref())
                .map_or(0.0, |shape| shape.torsion_stress(given.point)),
            twist_center,
        }
    }
}

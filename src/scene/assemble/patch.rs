//! Plates and shells: patches of elements, and frames at their markers.

use super::Builder;
use crate::bodies::{Marker, Patch};
use crate::scene::resolved::Plate;

impl<const D: usize> Builder<'_, D> {
    /// Adds the patch of a plate or shell, and its nodes. Returns those that hold axes only.
    pub(super) fn patch(&mut self, plate: Plate<'_>) -> Vec<usize> {
        let (body, geometry) = (plate.body, plate.body.geometry());
        let points = body.markers.values().map(|marker| geometry.point(marker));
        let section = body.section();
        let patch = Patch::new(
            self.parts.bodies.reference.len(),
            geometry.lines(),
            &geometry.corners(),
            |_, _| section,
            points.collect(),
        );
        let [n, m] = patch.divisions();
        let second = (0..=n).flat_map(|i| (0..=m).map(move |j| [i, j]));
        let second = second.map(|[i, j]| patch.mesh_node(i, j) + 1);
        let axes = second.chain(patch.axes_nodes()).collect();
        self.parts.bodies.reference.extend(patch.reference::<D>());
        self.parts.bodies.add_patch(patch);
        self.patches.push(plate.id.index());
        axes
    }

    /// A marker of a plate or shell, with the line along `s1` as direction.
    pub(super) fn on_patch(&self, plate: Plate<'_>, index: usize) -> Marker {
        let body = plate.id.index();
        let patch = self.patches.iter().position(|of| *of == body);
        let patch = patch.and_then(|patch| self.parts.bodies.patches().get(patch));
        let node = patch.map_or(0, |patch| patch.point_node(index));
        Marker::framed(body, node, [0.0; 3], [1.0, 0.0, 0.0])
    }
}

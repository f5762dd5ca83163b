//! Plates and shells: patches of elements, and frames at their markers.

use super::Builder;
use crate::bodies::{Marker, Patch};
use crate::scene::resolved::Plate;

impl<const D: usize> Builder<'_, D> {
    /// Adds the patch of a plate or shell, and its nodes. Returns those that hold axes only.
    pub(super) fn patch(&mut self, plate: Plate<'_>) -> Vec<usize> {
        let (body, geometry) = (plate.body, plate.body.geometry());
        let points = body.markers.values().map(|marker| geometry.point(marker));
        let uniform = body.is_uniform().then(|| body.section([0.5; 2]));
        let patch = Patch::new(
            self.parts.bodies.reference.len(),
            geometry.lines(),
            &geometry.corners(),
            |at| uniform.unwrap_or_else(|| body.section(at)),
            &points.collect::<Vec<_>>(),
        );
        let axes = patch.axes_nodes().collect();
        self.parts.bodies.reference.extend(patch.reference::<D>());
        self.parts.bodies.add_patch(patch);
        self.patches.push(plate.id.index());
        axes
    }

    /// A marker of a plate or shell, with the line along `s1` as direction.
    pub(super) fn on_patch(&self, plate: Plate<'_>, index: usize) -> Marker {
        let node = self.patch_of(plate).point_node(index);
        Marker::framed(plate.id.index(), node, [0.0; 3], [1.0, 0.0, 0.0])
    }

    /// The patch of a plate or shell.
    pub(crate) fn patch_of(&self, plate: Plate<'_>) -> &Patch {
        &self.parts.bodies.patches()[self.patch_index(plate)]
    }

    /// Index among the patches of a plate or shell.
    pub(crate) fn patch_index(&self, plate: Plate<'_>) -> usize {
        let index = self.patches.iter().position(|of| *of == plate.id.index());
        index.unwrap_or_else(|| unreachable!("patches are built before what acts on them"))
    }
}

//! Plates and shells: patches of elements, and frames at their markers.

use super::Builder;
use crate::bodies::{Marker, Patch, PatchPoint};
use crate::scene::description::OutputKind;
use crate::scene::resolved::{OutputTarget, Place, Plate};
use crate::system::loads::LoadedSurface;

impl<const D: usize> Builder<'_, D> {
    /// Adds the patch of a plate or shell, and its nodes. Returns those that hold axes only.
    pub(super) fn patch(&mut self, plate: Plate<'_>) -> Vec<usize> {
        let (body, geometry) = (plate.body, plate.body.geometry());
        let read: Vec<usize> = self.sections_read(plate).collect();
        let point = |(index, marker)| PatchPoint {
            has_section: read.contains(&index),
            ..geometry.point(marker)
        };
        let points = body.markers.values().enumerate().map(point);
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

    /// Markers, by their index among those of a plate or shell, whose section an output reads.
    fn sections_read(&self, plate: Plate<'_>) -> impl Iterator<Item = usize> {
        let read = self.resolved.outputs.iter().filter_map(|output| {
            let reads_section = matches!(
                output.kind,
                OutputKind::Curvature
                    | OutputKind::BendingMoment
                    | OutputKind::MembraneStrain
                    | OutputKind::MembraneForce
            );
            match output.of {
                OutputTarget::Marker(marker) if reads_section => Some(marker),
                OutputTarget::Faces(marker, _) | OutputTarget::Plies(marker, ..) => Some(marker),
                _ => None,
            }
        });
        read.filter_map(move |marker| match marker.place {
            Place::Patch(of, index) if of.id.index() == plate.id.index() => Some(index),
            _ => None,
        })
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

    /// A plate or shell as the surface that a load acts on.
    pub(crate) fn surface(&self, plate: Plate<'_>) -> LoadedSurface {
        LoadedSurface(self.patch_index(plate))
    }

    /// Index among the patches of a plate or shell.
    pub(crate) fn patch_index(&self, plate: Plate<'_>) -> usize {
        let index = self.patches.iter().position(|of| *of == plate.id.index());
        index.unwrap_or_else(|| unreachable!("patches are built before what acts on them"))
    }
}

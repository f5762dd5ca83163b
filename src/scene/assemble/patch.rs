//! Plates and shells: patches of elements, and frames at their markers.

use nalgebra::Vector3;

use super::Builder;
use crate::bodies::{ConnectivityRow, Marker, Node, Patch, no_node, product};
use crate::math::space::{axis, components, normals, vector};
use crate::scene::resolved::{EdgeHold, Plate, ResolvedEdge};

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
    fn patch_of(&self, plate: Plate<'_>) -> &Patch {
        &self.parts.bodies.patches()[self.patch_index(plate)]
    }

    /// Index among the patches of a plate or shell.
    pub(crate) fn patch_index(&self, plate: Plate<'_>) -> usize {
        let index = self.patches.iter().position(|of| *of == plate.id.index());
        index.unwrap_or_else(|| unreachable!("patches are built before what acts on them"))
    }

    /// Rows of joints of edges.
    pub(super) fn edges(&mut self) {
        for edge in &self.resolved.edges {
            let rows: Vec<_> = edge_nodes(self.patch_of(edge.plate), edge)
                .into_iter()
                .flat_map(|node| self.edge_rows(edge, node))
                .collect();
            self.parts.held.extend(rows);
        }
    }

    /// Rows of a node of an edge, by the first one of its two.
    fn edge_rows(&self, edge: &ResolvedEdge<'_>, node: usize) -> Vec<(ConnectivityRow<D>, f64)> {
        let x = &self.parts.bodies.reference;
        let full = |part: [f64; D]| Vector3::from(components(&part.into()));
        let [first, second] = [node, node + 1];
        let normal = full(x[first][1]).cross(&full(x[second][0]));
        // Where the position, the slopes along the edge and across it, and the mixed derivative stand.
        let slopes = [(first, 1), (second, 0)];
        let (point, mixed) = ((first, 0), (second, 1));
        let (along, across) = (slopes[1 - edge.across], slopes[edge.across]);
        let row = |(node, part): (usize, usize), direction: Vector3<f64>| {
            let mut coefficients: Node<D> = no_node();
            coefficients[part] = vector::<D, f64>(direction.into()).into();
            let value = product(&coefficients, &x[node]);
            let terms = vec![(node, coefficients)];
            let is_driven = false;
            (ConnectivityRow { terms, is_driven }, value)
        };
        let all = || (0..D).map(|k| Vector3::from(components(&axis::<D, f64>(k))));
        let held = |of| all().map(move |direction| (of, direction));
        let rows: Vec<((usize, usize), Vector3<f64>)> = match edge.hold {
            EdgeHold::Pinned => held(point).chain(held(along)).collect(),
            EdgeHold::Clamped => {
                let normal = normal.normalize();
                let turned = [across, mixed].map(|of| (of, normal));
                held(point).chain(held(along)).chain(turned).collect()
            }
            EdgeHold::Symmetry(plane) => {
                let plane = Vector3::from(plane).normalize();
                let beside: Vec<Vector3<f64>> = normals(&plane).collect();
                let turned = [across, mixed].into_iter();
                let turned = turned.flat_map(|of| beside.iter().map(move |way| (of, *way)));
                [point, along]
                    .map(|of| (of, plane))
                    .into_iter()
                    .chain(turned)
                    .collect()
            }
        };
        rows.into_iter()
            .map(|(of, direction)| row(of, direction))
            .collect()
    }
}

/// First nodes of the nodes of the mesh on an edge.
fn edge_nodes(patch: &Patch, edge: &ResolvedEdge<'_>) -> Vec<usize> {
    let divisions = patch.divisions();
    let held = if edge.is_last {
        divisions[edge.across]
    } else {
        0
    };
    let node = |k: usize| match edge.across {
        0 => patch.mesh_node(held, k),
        _ => patch.mesh_node(k, held),
    };
    (0..=divisions[1 - edge.across]).map(node).collect()
}

//! Plates and shells: structured patches of elements through mesh nodes, and points on them with frames that follow.
//!
//! Nodes of a patch: two for each mesh node, `(r, r1)` and `(r2, unit r12)`, mesh line by mesh line of the first direction; then two for each
//! point, its place and three axes, as those of an interface of a reduced body. Points have no coordinates. Place and axes follow from the
//! mesh nodes of the elements that they stand on.

mod body;
mod faces;
mod point;
mod recovery;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;

use super::chain::{Pack, packs};
use super::connectivity::Node;
use crate::elements::shell::{
    AREA_PLACES, Corner, ElementCorners, GaussStrains, Shell, ShellPack, ShellSection, VECTORS,
    area_place, axis_components,
};
use crate::math::jet::Number;
use crate::math::quadrature::{GAUSS_3, QuadraturePoint};
use crate::math::space::{components, vector};
pub use faces::{GridStress, SectionFaces};
use point::{MeshWeights, PatchFrame};
use recovery::PatchSection;
pub use recovery::stress_at;

/// A point of a patch that something acts on or is read at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// Material coordinates along both directions, in [0, 1].
    pub at: [f64; 2],
    /// Lengths of the pad over which it is the mean, m; zeros of a bare point.
    pub pad: [f64; 2],
    /// Whether strains, forces or stress of its section are read.
    pub has_section: bool,
}

/// A plate or shell: `n` by `m` elements.
#[derive(Clone, Debug)]
pub struct Patch {
    first: usize,
    /// Elements and points of patches before.
    pub(super) first_element: usize,
    pub(super) first_point: usize,
    /// Places of the mesh lines along both directions, m.
    lines: [Vec<f64>; 2],
    /// The unstressed surface at mesh nodes.
    corners: Vec<Corner>,
    /// Elements, those along the second direction one after the other.
    elements: Vec<Shell>,
    packs: Vec<Pack<ShellPack>>,
    points: Vec<PatchFrame>,
    /// What section forces at each point are read by, where they are.
    sections: Vec<Option<PatchSection>>,
    is_damped: bool,
    /// Curvature along each direction per one along the other where no moment acts, with the opposite sign: in the middle.
    contraction: [f64; 2],
}

impl Patch {
    /// A patch from node `first` on: places of the mesh lines along both directions from 0 on (m), the unstressed surface at mesh nodes with
    /// its derivatives by these lengths, `[(n + 1)(m + 1)]`, the section of each element, and points.
    pub fn new(
        first: usize,
        lines: [Vec<f64>; 2],
        nodes: &[Corner],
        section: impl Fn([f64; 2]) -> ShellSection,
        points: &[PatchPoint],
    ) -> Self {
        let [n, m] = [0, 1].map(|k| lines[k].len() - 1);
        let mut patch = Self {
            first,
            first_element: 0,
            first_point: 0,
            lines,
            corners: Vec::new(),
            elements: Vec::new(),
            packs: Vec::new(),
            points: Vec::new(),
            sections: Vec::new(),
            is_damped: false,
            contraction: [0.0; 2],
        };
        let unit = patch.unit();
        let scaled = |corner: &Corner| {
            let [r, r1, r2, r12] = *corner;
            [r, r1, r2, r12.map(|component| component * unit)]
        };
        patch.corners = nodes.iter().map(scaled).collect();
        for element in 0..n * m {
            let at = [element / m, element % m];
            let corners = patch.mesh_nodes(element).map(|node| patch.corners[node]);
            let sizes = [0, 1].map(|k| patch.spacing(k, at[k]));
            let section = |xi: [f64; 2]| section([0, 1].map(|k| patch.along(k, at[k], xi[k])));
            let element = Shell::new(section, (sizes, unit), &corners);
            patch.elements.push(element);
        }
        let middle = section([0.5; 2]);
        let (element, xi) = patch.find([0.5; 2]);
        patch.contraction = middle.contraction(&patch.tangents(element, xi));
        patch.is_damped = patch.elements.iter().any(Shell::is_damped);
        patch.packs = packs(&patch.elements, |_| true, Shell::goes_with, Shell::pack);
        patch.points = points.iter().map(|point| patch.frame(point)).collect();
        let read = |point: &PatchPoint| {
            (point.has_section).then(|| patch.patch_section(point.at, &section(point.at)))
        };
        patch.sections = points.iter().map(read).collect();
        patch
    }

    /// Unit of length of the mixed derivatives in the nodes, m.
    pub fn unit(&self) -> f64 {
        let [n, m] = self.divisions();
        (self.lengths()[0] * self.lengths()[1] / (n * m) as f64).sqrt()
    }

    /// Length of an element along a direction, m.
    pub fn spacing(&self, direction: usize, element: usize) -> f64 {
        self.lines[direction][element + 1] - self.lines[direction][element]
    }

    /// Material coordinate in [0, 1] along a direction at a place of an element, `xi` in [0, 1].
    fn along(&self, direction: usize, element: usize, xi: f64) -> f64 {
        let from = self.lines[direction][element];
        (from + xi * self.spacing(direction, element)) / self.lengths()[direction]
    }

    /// Numbers of elements along both directions.
    pub fn divisions(&self) -> [usize; 2] {
        [0, 1].map(|k| self.lines[k].len() - 1)
    }

    /// Lengths along both directions, m.
    pub fn lengths(&self) -> [f64; 2] {
        [0, 1].map(|k| self.lines[k][self.lines[k].len() - 1])
    }

    /// Curvature along each direction, with the opposite sign, that goes with one along the other where no moment acts along the first.
    pub fn contraction(&self) -> [f64; 2] {
        self.contraction
    }

    /// Elements, those along the second direction one after the other.
    pub fn elements(&self) -> &[Shell] {
        &self.elements
    }

    /// Mass, kg.
    pub fn total_mass(&self) -> f64 {
        let of_element = |element: &Shell| {
            let masses = element.weight().iter().step_by(VECTORS);
            masses.sum::<f64>()
        };
        self.elements.iter().map(of_element).sum()
    }

    /// First node of a mesh node. The second one follows it.
    pub fn mesh_node(&self, i: usize, j: usize) -> usize {
        self.first + 2 * (i * self.lines[1].len() + j)
    }

    /// First node of the frame of a point.
    pub fn point_node(&self, index: usize) -> usize {
        self.first + 2 * (self.corners.len() + index)
    }

    /// Number of points.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// Index of a point among those of all patches.
    pub fn point_of_all(&self, point: usize) -> usize {
        self.first_point + point
    }

    /// Second nodes of mesh nodes and of points, which hold no positions.
    pub fn axes_nodes(&self) -> impl Iterator<Item = usize> {
        self.all().skip(1).step_by(2)
    }

    /// All its nodes.
    pub fn all(&self) -> std::ops::Range<usize> {
        self.first..self.point_node(self.points.len())
    }

    /// Nodes of the mesh, which have coordinates.
    pub fn mesh(&self) -> std::ops::Range<usize> {
        self.first..self.point_node(0)
    }

    /// Nodes of points.
    pub(super) fn followers(&self) -> std::ops::Range<usize> {
        self.mesh().end..self.all().end
    }

    /// Mesh nodes of an element, corner by corner, among those of the patch.
    fn mesh_nodes(&self, element: usize) -> [usize; 4] {
        let across = self.lines[1].len();
        let (i, j) = (element / (across - 1), element % (across - 1));
        [0, 1, 2, 3].map(|corner| (i + corner / 2) * across + j + corner % 2)
    }

    /// First nodes of the corners of an element.
    fn corner_nodes(&self, element: usize) -> [usize; 4] {
        self.mesh_nodes(element).map(|node| self.first + 2 * node)
    }

    /// Nodes whose coordinates forces on a point act on.
    pub fn acted(&self, point: usize) -> impl Iterator<Item = usize> {
        self.points[point]
            .followed()
            .flat_map(|node| [node, node + 1])
    }

    /// Coordinates of all its nodes on the unstressed surface.
    pub fn reference<const D: usize>(&self) -> Vec<Node<D>> {
        let corner = |corner: &Corner| {
            let [r, r1, r2, r12] = corner.map(|v| vector::<D, f64>(v).into());
            [[r, r1], [r2, r12]]
        };
        let mut nodes: Vec<Node<D>> = self.corners.iter().flat_map(corner).collect();
        nodes.resize(2 * (self.corners.len() + self.points.len()), [[0.0; D]; 2]);
        // Places of nodes count from the first node of the system.
        let mut all = vec![[[0.0; D]; 2]; self.first];
        all.append(&mut nodes);
        self.place_points(&mut all);
        all.split_off(self.first)
    }

    /// Vectors of the corners of an element at a configuration, or their rates.
    pub fn element<const D: usize, N: Number>(
        &self,
        element: usize,
        x: &[Node<D, N>],
    ) -> ElementCorners<N> {
        self.corner_nodes(element).map(|node| corner(node, x))
    }

    /// Adds forces on the corners of an element.
    pub fn add_to<const D: usize, N: Number>(
        &self,
        element: usize,
        force: &ElementCorners<N>,
        f: &mut [Node<D, N>],
    ) {
        for (node, force) in self.corner_nodes(element).into_iter().zip(force) {
            for (k, force) in force.iter().enumerate() {
                let sum = f[node + k / 2][k % 2].iter_mut();
                sum.zip(force).for_each(|(sum, force)| *sum += *force);
            }
        }
    }

    /// Position at a place of an element, `xi` and `eta` in [0, 1], m.
    pub fn position<const D: usize, N: Number>(
        &self,
        [i, j]: [usize; 2],
        xi: [f64; 2],
        x: &[Node<D, N>],
    ) -> [N; 3] {
        let element = i * (self.lines[1].len() - 1) + j;
        let weights = self.elements[element].weights(xi.map(N::of), [0, 0]);
        weighted(&weights, &self.element(element, x))
    }

    /// Coordinates in [0, 1] of the places of quadrature of loads, element by element.
    pub fn area_places(&self) -> impl Iterator<Item = [f64; 2]> {
        let across = self.lines[1].len() - 1;
        (0..self.elements.len()).flat_map(move |element| {
            (0..AREA_PLACES).map(move |place| {
                let [xi, eta] = area_place(place);
                [
                    self.along(0, element / across, xi),
                    self.along(1, element % across, eta),
                ]
            })
        })
    }

    /// Element and place in it of material coordinates along both directions.
    fn find(&self, at: [f64; 2]) -> (usize, [f64; 2]) {
        let along = |k: usize| {
            let (lines, length) = (&self.lines[k], at[k] * self.lengths()[k]);
            let after = lines.partition_point(|line| *line <= length);
            let j = after.clamp(1, lines.len() - 1) - 1;
            (j, (length - lines[j]) / (lines[j + 1] - lines[j]))
        };
        let ((i, xi), (j, eta)) = (along(0), along(1));
        (i * (self.lines[1].len() - 1) + j, [xi, eta])
    }

    /// Derivatives of the position of the unstressed surface at a place of an element.
    fn tangents(&self, element: usize, xi: [f64; 2]) -> [Vector3<f64>; 2] {
        let corners = self.mesh_nodes(element).map(|node| self.corners[node]);
        [[1, 0], [0, 1]].map(|orders| {
            let weights = self.elements[element].weights(xi, orders);
            Vector3::from(weighted(&weights, &corners))
        })
    }

    /// The frame of a point: means over its pad of place and derivatives.
    fn frame(&self, point: &PatchPoint) -> PatchFrame {
        let (element, xi) = self.find(point.at);
        let by = axis_components(&self.tangents(element, xi), 0.0);
        let mut frame = PatchFrame::default();
        let mut total = 0.0;
        for (at, weight) in self.places(point) {
            let (element, xi) = self.find(at);
            let of = &self.elements[element];
            let [values, along, across] = [[0, 0], [1, 0], [0, 1]].map(|o| of.weights(xi, o));
            for (corner, node) in self.corner_nodes(element).into_iter().enumerate() {
                let mut term = MeshWeights::at(node);
                for k in 0..VECTORS {
                    let number = VECTORS * corner + k;
                    term.position[k] = weight * values[number];
                    for (to, by) in term.along.iter_mut().zip(&by) {
                        to[k] = weight * (by[0] * along[number] + by[1] * across[number]);
                    }
                }
                frame.add(&term);
            }
            total += weight;
        }
        frame.divide(total);
        frame
    }

    /// Places that a point is the mean of, with their weights: itself, or points of quadrature of all elements under its pad.
    fn places(&self, point: &PatchPoint) -> Vec<([f64; 2], f64)> {
        let along = |k: usize| -> Vec<QuadraturePoint> {
            let (length, size) = (self.lengths()[k], 0.5 * point.pad[k]);
            let middle = point.at[k] * length;
            let (from, to) = ((middle - size).max(0.0), (middle + size).min(length));
            if from >= to {
                return vec![QuadraturePoint {
                    at: point.at[k],
                    weight: 1.0,
                }];
            }
            let elements = self.lines[k].windows(2);
            let parts = elements.filter_map(|line| {
                let (from, to) = (line[0].max(from), line[1].min(to));
                (from < to).then_some((from, to))
            });
            let points = |(from, to): (f64, f64)| {
                GAUSS_3.map(|point| QuadraturePoint {
                    at: (from + (to - from) * point.at) / length,
                    weight: (to - from) * point.weight,
                })
            };
            parts.flat_map(points).collect()
        };
        let (first, second) = (along(0), along(1));
        let both = first
            .iter()
            .flat_map(|a| (second.iter()).map(move |b| ([a.at, b.at], a.weight * b.weight)));
        both.collect()
    }
}

/// Vectors of a mesh node with this first node, or their rates.
fn corner<const D: usize, N: Number>(node: usize, x: &[Node<D, N>]) -> Corner<N> {
    let [[r, r1], [r2, r12]] = [x[node], x[node + 1]];
    [r, r1, r2, r12].map(|v| components::<D, N>(&v.into()))
}

/// Sum of the vectors of all corners of an element, weighted.
fn weighted<N: Number>(weights: &[N; 16], corners: &ElementCorners<N>) -> [N; 3] {
    let mut sum = [N::of(0.0); 3];
    for (weight, vector) in weights.iter().zip(corners.as_flattened()) {
        for (sum, component) in sum.iter_mut().zip(vector) {
            *sum += *weight * *component;
        }
    }
    sum
}

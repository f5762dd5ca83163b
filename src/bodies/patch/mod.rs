//! Patches of plates and shells.

use super::assembly::{Assembly, Links};
use super::body::{BodyPart, Momentum, NodalMotion};
use super::connectivity::Node;
use crate::elements::shell::{Corner, ShellSection};
use crate::math::jet::Number;
use crate::math::space::vector;
use crate::math::sparse::Matrix;

/// A point of a patch, or a pad about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// Place, fractions in [0, 1].
    pub at: [f64; 2],
    /// Sizes of the pad, m; zeros of a point.
    pub pad: [f64; 2],
}

/// A patch of elements of a plate or shell.
#[derive(Clone, Debug)]
pub struct Patch {
    first: usize,
    lines: [Vec<f64>; 2],
    nodes: Vec<Corner>,
    points: Vec<PatchPoint>,
}

impl Patch {
    /// A patch.
    pub fn new(
        first: usize,
        lines: [Vec<f64>; 2],
        nodes: &[Corner],
        section: impl Fn(usize, usize) -> ShellSection,
        points: Vec<PatchPoint>,
    ) -> Self {
        let _ = section(0, 0);
        Self {
            first,
            lines,
            nodes: nodes.to_vec(),
            points,
        }
    }

    /// Reference.
    pub fn reference<const D: usize>(&self) -> Vec<Node<D>> {
        let of = |v: [f64; 3]| vector::<D, f64>(v).into();
        let mesh = self
            .nodes
            .iter()
            .flat_map(|[r, a, b, c]| [[of(*r), of(*a)], [of(*b), of(*c)]]);
        let points = self.points.iter().flat_map(|_| {
            [
                [of([0.0; 3]), of([1.0, 0.0, 0.0])],
                [of([0.0, 1.0, 0.0]), of([0.0, 0.0, 1.0])],
            ]
        });
        mesh.chain(points).collect()
    }

    /// First node of the frame of a point.
    pub fn point_node(&self, index: usize) -> usize {
        self.first + 2 * self.nodes.len() + 2 * index
    }

    /// First of the two nodes of a mesh node.
    pub fn mesh_node(&self, i: usize, j: usize) -> usize {
        self.first + 2 * (i * self.lines[1].len() + j)
    }

    /// Numbers of elements.
    pub fn divisions(&self) -> [usize; 2] {
        self.lines.each_ref().map(|lines| lines.len() - 1)
    }

    /// Second nodes of the frames of points.
    pub fn axes_nodes(&self) -> impl Iterator<Item = usize> {
        let first = self.point_node(0);
        (0..self.points.len()).map(move |index| first + 2 * index + 1)
    }

    /// Position.
    pub fn position<N: Number>(
        &self,
        element: [usize; 2],
        _xi: [f64; 2],
        x: &[Node<3, N>],
    ) -> [N; 3] {
        x[self.mesh_node(element[0], element[1])][0]
    }
}

impl<const D: usize> BodyPart<D> for Patch {
    fn add_links(&self, _links: &mut Links) {}
    fn add_mass(&self, _assembly: &Assembly<D>, _mass: &mut Matrix<f64>) {}
    fn add_momentum<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _sum: &mut Momentum<D, N>) {}
}

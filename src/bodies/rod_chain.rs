//! The sections of a rod or beam, along the chain that is its line: bending and torsion; of a beam shear and stretching too. Its nodes are
//! those of the line, two for the frame transported at each of them, and one inside every element, which holds the internal twist and a beam's
//! internal shear rotations alone. In the plane there are beams alone; the section at a node is a unit vector in one node (`plane.rs`).

mod body;
mod frame_spin;
mod inertia;
mod lanes;
mod loaded;
mod plane;
mod shaped;

use std::ops::Range;

use nalgebra::Vector3;

use super::assembly::{NodeBlock, no_block};
use super::connectivity::{Node, no_node};
use super::frame::{SectionFrame, axes_at, combined};
use super::marker::Marker;
use crate::elements::beam::{At, Matrix as ElementMatrix, Rates, VELOCITIES};
use crate::elements::section::{SectionElement, SpinInertia};
use crate::math::jet::Number;
use crate::math::space::{Vector, components};
use lanes::{Packed, packs};
pub use plane::{axes as planar_axes, middle, rotate_inner};
pub use shaped::transported_nodes;

/// Where the internal twist and a beam's two internal shear rotations stand in a node inside an element: part and axis. The first axis stands one
/// further than the shear rotation, so that the node has a direction.
pub const INNER: [(usize, usize); 3] = [(1, 1), (1, 0), (1, 2)];

/// Values in the places of [`INNER`] where the coordinates are zero.
const AHEAD: [f64; 3] = [0.0, 1.0, 0.0];

/// A node inside an element without internal twist and shear rotations.
pub fn untwisted<const D: usize>() -> Node<D> {
    let mut node = no_node();
    for ((part, axis), ahead) in INNER.into_iter().zip(AHEAD) {
        node[part][axis] = ahead;
    }
    node
}

/// Angles from the middle of an element to an end, and of its twist, rad, from which on its frames are not told: just below a right angle,
/// where no smallest rotation is stable, and half a turn.
const MOST_BEND: f64 = 1.5;
const MOST_TWIST: f64 = 3.0;

/// The sections of a rod or beam.
#[derive(Clone, Debug)]
pub struct RodChain {
    packs: Vec<Packed>,
    /// Elements, each with its inertia against spins at its ends and the rates inside, kg m^2.
    elements: Vec<(SectionElement, SpinInertia)>,
    /// Which components of spins, moments and internal coordinates there are: the first of a rod, all of a beam, the second of one in the
    /// plane, where the internal coordinate is the angle of the section in the middle of the element.
    parts: Range<usize>,
    /// First node of the line, of the transported frames, and inside the elements.
    line: usize,
    frames: usize,
    inner: usize,
    /// Nodes of a frame: 2, in the plane 1.
    stride: usize,
    /// Section frames, in space.
    section_frames: Vec<SectionFrame>,
    /// Index of the first section frame among those of the system.
    first_section: usize,
    is_damped: bool,
}

impl RodChain {
    /// Along the line from node `line` on, whose nodes those of its frames follow and then those inside its elements; each element with its
    /// inertia against spins. `first_section` frames of other sections come before its own.
    pub fn new<const D: usize>(
        elements: Vec<(SectionElement, SpinInertia)>,
        line: usize,
        first_section: usize,
    ) -> Self {
        let (nodes, stride) = (elements.len() + 1, D - 1);
        let turns = elements
            .first()
            .map_or(1, |(section, _)| section.rotations());
        let mut made = Self {
            parts: if D == 2 { plane::PARTS } else { 0..turns },
            is_damped: elements.iter().any(|(section, _)| section.is_damped()),
            line,
            frames: line + nodes,
            inner: line + (1 + stride) * nodes,
            stride,
            packs: packs(&elements),
            elements,
            section_frames: Vec::new(),
            // In the plane there are none.
            first_section: if D == 2 { 0 } else { first_section },
        };
        if D > 2 {
            let has_shear = made.has_shear();
            let frame = |(node, line)| SectionFrame::new(node, line, has_shear);
            made.section_frames = made.frames().map(frame).collect();
        }
        made
    }

    /// Index of its first section frame among those of all bodies.
    pub(super) fn first_section(&self) -> usize {
        self.first_section
    }

    /// Section frames, in space.
    pub fn section_frames(&self) -> &[SectionFrame] {
        &self.section_frames
    }

    /// Section frames, to be changed.
    pub(super) fn section_frames_mut(&mut self) -> &mut [SectionFrame] {
        &mut self.section_frames
    }

    /// The nodes of element `j`: line and frame at both ends, then that inside.
    pub fn nodes(&self, j: usize) -> [usize; 5] {
        let [a, b] = [j, j + 1].map(|k| [self.line + k, self.frames + self.stride * k]);
        [a[0], a[1], b[0], b[1], self.inner + j]
    }

    /// First nodes of its section frames, and the nodes of the line that they are at.
    pub fn frames(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..=self.elements.len()).map(|k| (self.frames + self.stride * k, self.line + k))
    }

    /// Nodes that hold axes alone: the second ones of its frames, in the plane the only ones.
    pub fn axes_nodes(&self) -> impl Iterator<Item = usize> {
        self.frames().map(|(node, _)| node + self.stride - 1)
    }

    /// Returns the marker of the section at a nodal marker of the line. `None` between nodes.
    pub fn section_at(&self, marker: &Marker) -> Option<Marker> {
        let k = marker.nodes[0] - self.line;
        let frame = self.frames + self.stride * k;
        marker.is_nodal().then(|| {
            if self.is_planar() {
                Marker::sheared(marker.body, [self.line + k, frame])
            } else {
                Marker::framed(marker.body, frame, [0.0; 3], [1.0, 0.0, 0.0])
            }
        })
    }

    /// Element and place inside it of a section by the first node of its marker: the element after it, but at the last end.
    pub fn element_at(&self, node: usize) -> (usize, f64) {
        let k = if self.is_planar() {
            node - self.line
        } else {
            (node - self.frames) / self.stride
        };
        if k == self.elements.len() {
            (k - 1, 1.0)
        } else {
            (k, 0.0)
        }
    }

    /// Nodes inside its elements.
    pub fn inner(&self) -> Range<usize> {
        self.inner..self.inner + self.elements.len()
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.elements.len()
    }

    /// First node of the line.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Spins of a section, and numbers inside an element: 1 of a rod, 3 of a beam; in the plane 1.
    pub fn rotations(&self) -> usize {
        self.parts.len()
    }

    /// Whether its sections have a shear rotation: those of a beam.
    pub fn has_shear(&self) -> bool {
        self.parts.end > 1
    }

    /// Whether it is one of the plane.
    fn is_planar(&self) -> bool {
        self.stride == 1
    }

    /// Element `j`.
    pub fn element(&self, j: usize) -> &SectionElement {
        &self.elements[j].0
    }

    /// Whether any element dissipates.
    pub fn is_damped(&self) -> bool {
        self.is_damped
    }

    /// Where element `j` is.
    pub fn at<const D: usize, N: Number>(&self, j: usize, x: &[Node<D, N>]) -> At<N> {
        let [a, fa, b, fb, inner] = self.nodes(j);
        let axes = |frame: usize| match D {
            2 => plane::axes(&x[frame][1]),
            _ => axes_at(frame, x).map(Into::into),
        };
        At {
            e: ends([a, b], x),
            axes: [axes(fa), axes(fb)],
            inner: match D {
                2 => plane::inner(&x[inner]),
                _ => self.read_inner(&x[inner], AHEAD),
            },
        }
    }

    /// Reads the internal coordinates of a node, or their rates. `ahead` is subtracted.
    fn read_inner<const D: usize, N: Number>(&self, node: &Node<D, N>, ahead: [f64; 3]) -> [N; 3] {
        let mut inner = [N::of(0.0); 3];
        for (k, (part, axis)) in self.inside() {
            inner[k] = node[part][axis] - N::of(ahead[k]);
        }
        inner
    }

    /// Velocities of element `j`, or changes.
    pub fn rates<const D: usize, N: Number>(
        &self,
        j: usize,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
    ) -> Rates<N> {
        let [a, fa, b, fb, inner] = self.nodes(j);
        let spin = |k: usize, node: usize| match D {
            2 => plane::spin(&x[node][1], &v[node][1]),
            _ => self.frame(k).spin(x, v),
        };
        Rates {
            e: ends([a, b], v),
            spin: [spin(j, fa), spin(j + 1, fb)],
            inner: self.read_inner(&v[inner], [0.0; 3]),
        }
    }

    /// Returns the section frame at a node.
    pub(super) fn frame(&self, k: usize) -> &SectionFrame {
        &self.section_frames[k]
    }

    /// Returns the section frame, in space, at a node of the line.
    pub(super) fn frame_at(&self, node: usize) -> Option<&SectionFrame> {
        self.section_frames.get(node.checked_sub(self.line)?)
    }

    /// Coordinates inside its elements, and where they stand in their nodes.
    pub fn inside(&self) -> impl Iterator<Item = (usize, (usize, usize))> + use<> {
        let places = if self.is_planar() {
            [plane::ANGLE; 3]
        } else {
            INNER
        };
        self.parts.clone().map(move |k| (k, places[k]))
    }

    /// The blocks of a symmetric matrix over the velocities of element `j`, on and below the diagonal of its nodes.
    fn for_each_block<const D: usize>(
        &self,
        j: usize,
        whole: &ElementMatrix,
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let nodes = self.nodes(j);
        for (row, a) in nodes.iter().enumerate() {
            for (column, b) in nodes.iter().enumerate().take(row + 1) {
                let mut block: NodeBlock<D> = no_block();
                for (r, (p, i)) in self.entries(row) {
                    for (c, (q, k)) in self.entries(column) {
                        block[p][i][q][k] = whole[r][c];
                    }
                }
                add(*a, *b, &block);
            }
        }
    }

    /// Velocities of an element at one of its nodes `[line, frame, line, frame, inner]`: number, then part and axis. In the plane those of
    /// a section are the rates of its direction.
    fn entries(&self, node: usize) -> impl Iterator<Item = (usize, (usize, usize))> {
        let (is_planar, parts) = (self.is_planar(), self.parts.clone());
        let turns = if is_planar { 3 } else { parts.len() };
        let first = [0, 6, 6 + turns, 12 + turns, 12 + 2 * turns][node];
        let numbers = match node {
            0 | 2 => 0..6,
            4 => parts,
            _ if is_planar => 0..2,
            _ => parts,
        };
        let places = numbers.map(move |k| {
            let place = match node {
                0 | 2 => (k / 3, k % 3),
                4 if is_planar => plane::ANGLE,
                4 => INNER[k],
                _ => (1, k),
            };
            (first + k, place)
        });
        places.filter(move |(_, (_, axis))| !is_planar || *axis < 2)
    }

    /// Velocities of element `j`, or small displacements, in the order of its matrices: what nodes hold that have coordinates, so for
    /// every frame its rotations. Positions are relative to the first one.
    pub fn displacements<const D: usize>(&self, j: usize, x: &[Node<D>]) -> [f64; VELOCITIES] {
        let nodes = self.nodes(j);
        let mut found = [0.0; VELOCITIES];
        for (k, node) in nodes.iter().enumerate() {
            for (at, (part, axis)) in self.entries(k) {
                found[at] = x[*node][part][axis];
                if (k == 0 || k == 2) && part == 0 {
                    found[at] -= x[nodes[0]][0][axis];
                }
            }
        }
        found
    }

    /// The first element that is bent or twisted beyond what its frames hold.
    pub fn overbent<const D: usize>(&self, x: &[Node<D>]) -> Option<usize> {
        (0..self.count()).find(|j| {
            let [bend, twist] = self.element(*j).angles(&self.at(*j, x));
            bend > MOST_BEND || twist > MOST_TWIST
        })
    }

    /// Moments on the sections at the ends of element `j`, given along their axes, in global components.
    pub fn global<const D: usize, N: Number>(
        &self,
        j: usize,
        moments: [[N; 3]; 2],
        x: &[Node<D, N>],
    ) -> [Vector3<N>; 2] {
        let [first, last] = moments.map(Vector3::from);
        let at = self.at(j, x);
        let axes = at.axes.map(|axes| axes.map(Vector3::from));
        [combined(&axes[0], &first), combined(&axes[1], &last)]
    }
}

/// Positions and slopes of two nodes, or their rates.
fn ends<const D: usize, N: Number>(nodes: [usize; 2], x: &[Node<D, N>]) -> [[N; 3]; 4] {
    let [a, b] = nodes.map(|node| [0, 1].map(|k| part(&x[node], k)));
    [a[0], a[1], b[0], b[1]]
}

fn part<const D: usize, N: Number>(node: &Node<D, N>, k: usize) -> [N; 3] {
    components(&Vector::<D, N>::from(node[k]))
}

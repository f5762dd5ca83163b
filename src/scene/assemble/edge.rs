//! Joints of edges and other mesh lines of plates and shells: conditions on the vectors of their mesh nodes.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::Builder;
use crate::bodies::{ConnectivityRow, Marker, Node, Patch, RodChain, axes_at, no_node, product};
use crate::math::space::{Vector, axis, components, normals, vector};
use crate::scene::resolved::{Cable, EdgeBase, EdgeHold, MeshLine, ResolvedEdge};
use crate::system::joints::{
    Across, ConstraintKind, Edge, Fold, JointEquations, LinearConstraint, Perpendicular, Primitive,
    Target,
};
use crate::system::{Attachment, Direction};

/// A vector of a node: the node and which of its two.
type NodeVector = (usize, usize);

/// The vectors of a mesh node on a line.
#[derive(Clone, Copy)]
struct LineNode {
    /// Its first node.
    first: usize,
    /// The slope along the line.
    along: NodeVector,
    /// The slope across the line.
    across: NodeVector,
}

impl LineNode {
    fn point(&self) -> NodeVector {
        (self.first, 0)
    }

    fn mixed(&self) -> NodeVector {
        (self.first + 1, 1)
    }
}

/// The mesh nodes of a line, in one of its directions.
struct Line<'a> {
    body: usize,
    patch: &'a Patch,
    across: usize,
    nodes: Vec<LineNode>,
    /// Length of each element along the line, m.
    lengths: Vec<f64>,
    /// 1, or -1 where it runs against its coordinate.
    sign: f64,
}

impl<'a> Line<'a> {
    fn new(patch: &'a Patch, line: &MeshLine<'_>) -> Self {
        let (held, direction) = (line.line as usize, 1 - line.across);
        let node = |k: usize| {
            let first = match line.across {
                0 => patch.mesh_node(held, k),
                _ => patch.mesh_node(k, held),
            };
            let slopes = [(first, 1), (first + 1, 0)];
            let (along, across) = (slopes[direction], slopes[line.across]);
            LineNode {
                first,
                along,
                across,
            }
        };
        let count = patch.divisions()[direction];
        Self {
            body: line.plate.id.index(),
            patch,
            across: line.across,
            nodes: (0..=count).map(node).collect(),
            lengths: (0..count).map(|k| patch.spacing(direction, k)).collect(),
            sign: 1.0,
        }
    }

    /// The same line in the other direction.
    fn reversed(mut self) -> Self {
        self.nodes.reverse();
        self.lengths.reverse();
        self.sign = -self.sign;
        self
    }

    /// Marker at a vector of a node: the vector is its direction.
    fn marker(&self, (node, part): NodeVector, weight: f64) -> Marker {
        let mut weights = [0.0; 4];
        weights[part] = weight;
        Marker::weighted(self.body, [node, node], weights)
    }

    /// First node of its middle node, or of that after the middle.
    fn middle(&self) -> usize {
        self.nodes[self.nodes.len() / 2].first
    }

    /// The middle: the element and the place in it.
    fn middle_place(&self, line: usize) -> ([usize; 2], [f64; 2]) {
        let (mut element, mut place) = ([0; 2], [0.0; 2]);
        let (across, along) = (self.across, 1 - self.across);
        element[across] = line.min(self.patch.divisions()[across] - 1);
        place[across] = (line - element[across]) as f64;
        element[along] = self.lengths.len() / 2;
        place[along] = 0.5 * (self.lengths.len() % 2) as f64;
        (element, place)
    }

    /// End of a joint at its middle node.
    fn end<const D: usize>(&self) -> Attachment<D> {
        Attachment::Body(self.marker((self.middle(), 1), 1.0))
    }

    /// Marker at the same vector of both ends of an element, with their weights.
    fn between(&self, element: usize, of: fn(&LineNode) -> NodeVector, by: [f64; 2]) -> Marker {
        let [(first, part), (second, _)] = [element, element + 1].map(|k| of(&self.nodes[k]));
        let mut weights = [0.0; 4];
        (weights[part], weights[2 + part]) = (by[0], by[1]);
        Marker::weighted(self.body, [first, second], weights)
    }

    /// Markers that add up to the slope across the line at a node, and at the middle of an element.
    fn slope_at(&self, node: usize) -> [Marker; 2] {
        let across = self.nodes[node].across;
        [self.marker(across, 1.0), self.marker(across, 0.0)]
    }

    fn slope_between(&self, element: usize) -> [Marker; 2] {
        let by = 0.125 * self.sign * self.lengths[element] / self.patch.unit();
        let across = self.between(element, |node| node.across, [0.5, 0.5]);
        [across, self.between(element, LineNode::mixed, [by, -by])]
    }

    /// Markers that add up to the slope along the line.
    fn tangent_at(&self, node: usize) -> [Marker; 2] {
        let along = self.nodes[node].along;
        [self.marker(along, self.sign), self.marker(along, 0.0)]
    }

    fn tangent_between(&self, element: usize) -> [Marker; 2] {
        let by = 1.5 / self.lengths[element];
        let points = self.between(element, LineNode::point, [-by, by]);
        let by = -0.25 * self.sign;
        [points, self.between(element, |node| node.along, [by, by])]
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Joints of edges.
    pub(super) fn edges(&mut self) {
        let joints: Vec<_> = (self.resolved.edges.iter())
            .map(|edge| self.edge(edge))
            .collect();
        self.parts.joints.extend(joints);
        for edge in &self.resolved.edges {
            if let EdgeBase::Stiffener(body, is_reversed) = edge.base {
                // The line of a beam rotates with its sections, which a pin lets rotate about it.
                let is_free = body.body.is_beam() && edge.hold == EdgeHold::Pinned;
                let base = self.nodes_along(body, is_reversed);
                let of = Line::new(self.patch_of(edge.line.plate), &edge.line);
                let firsts: Vec<_> = of.nodes.iter().map(|node| node.first).collect();
                let pairs = base.into_iter().zip(firsts).filter(|_| !is_free);
                self.parts.bodies.rotate_with_surface(pairs);
            }
        }
    }

    fn edge(&self, edge: &ResolvedEdge<'_>) -> JointEquations<D> {
        let of = Line::new(self.patch_of(edge.line.plate), &edge.line);
        let (mut rows, mut constraints) = (Vec::new(), Vec::new());
        let transmits = edge.hold != EdgeHold::Pinned;
        let moments = |line: &Line<'_>| {
            let nodes = line.nodes.iter().filter(|_| transmits);
            nodes.map(|node| node.across.0).collect::<Vec<_>>()
        };
        let mut held_moments = moments(&of);
        let first = match &edge.base {
            EdgeBase::Ground => {
                for node in &of.nodes {
                    rows.extend(self.rows_on_ground(edge.hold, node));
                }
                Attachment::Ground(self.parts.bodies.reference[of.middle()][0].into())
            }
            EdgeBase::Marker(marker) => {
                let marker = self.marker(*marker);
                let is_clamped = edge.hold == EdgeHold::Clamped;
                for node in &of.nodes {
                    constraints.extend(self.on_frame(&marker, (&of, node), is_clamped));
                }
                Attachment::Body(marker)
            }
            EdgeBase::Stiffener(body, is_reversed) => {
                let base = self.nodes_along(*body, *is_reversed);
                for (node, second) in base.iter().zip(&of.nodes) {
                    let along = [(*node, 1), second.along];
                    let pairs = [([(*node, 0), second.point()], 1.0)];
                    let pairs = pairs.into_iter().chain([(along, self.ratio(along))]);
                    rows.extend(rows_of_pairs(pairs));
                }
                if edge.hold == EdgeHold::Clamped {
                    constraints.extend(self.sections_on(*body, &base, &of));
                }
                Attachment::Body(self.on_line_at(*body, base[base.len() / 2]))
            }
            EdgeBase::Line(base, is_reversed) => {
                let base = Line::new(self.patch_of(base.plate), base);
                let base = if *is_reversed { base.reversed() } else { base };
                let units = of.patch.unit() / base.patch.unit();
                let units = (edge.hold == EdgeHold::Smooth).then_some(units);
                for nodes in base.nodes.iter().zip(&of.nodes) {
                    rows.extend(self.rows_between(nodes, units));
                }
                if edge.hold == EdgeHold::Clamped {
                    constraints.extend(self.folds(&base, &of));
                }
                held_moments.extend(moments(&base));
                base.end()
            }
        };
        let held = Edge {
            patch: self.patch_index(edge.line.plate),
            nodes: of.nodes.iter().map(|node| node.first).collect(),
            middle: of.middle_place(edge.line.line as usize),
            moments: held_moments,
            rows,
            constraints,
        };
        JointEquations {
            holds: vec![Primitive::Edge(held)],
            ends: [first, of.end()],
            spring: None,
            turn: None,
            way: None,
            release: None,
        }
    }

    /// A vector of a node at the start.
    fn vector_of(&self, (node, part): NodeVector) -> Vector3<f64> {
        Vector3::from(components::<D, f64>(
            &self.parts.bodies.reference[node][part].into(),
        ))
    }

    /// Normal of a surface at a node of a line, of unit length.
    fn normal_at(&self, node: &LineNode) -> Vector3<f64> {
        let [along, across] = [node.along, node.across].map(|of| self.vector_of(of));
        along.cross(&across).normalize()
    }

    /// Rows that hold a node of a line on the ground.
    fn rows_on_ground(&self, hold: EdgeHold, node: &LineNode) -> Vec<(ConnectivityRow<D>, f64)> {
        let (point, along) = (node.point(), node.along);
        let beside = [node.across, node.mixed()];
        let all = || (0..D).map(|k| Vector3::from(components(&axis::<D, f64>(k))));
        let held = |of| all().map(move |direction| (of, direction));
        let rows: Vec<(NodeVector, Vector3<f64>)> = match hold {
            EdgeHold::Pinned | EdgeHold::Smooth => held(point).chain(held(along)).collect(),
            EdgeHold::Clamped => {
                let normal = self.normal_at(node);
                let rotated = beside.map(|of| (of, normal));
                held(point).chain(held(along)).chain(rotated).collect()
            }
            EdgeHold::Symmetry(plane) => {
                let plane = Vector3::from(plane).normalize();
                let in_plane: Vec<Vector3<f64>> = normals(&plane).collect();
                let rotated = beside.into_iter();
                let rotated = rotated.flat_map(|of| in_plane.iter().map(move |by| (of, *by)));
                let held = [point, along].map(|of| (of, plane));
                held.into_iter().chain(rotated).collect()
            }
        };
        let row = |((node, part), direction): (NodeVector, Vector3<f64>)| {
            let mut coefficients: Node<D> = no_node();
            coefficients[part] = vector::<D, f64>(direction.into()).into();
            let value = product(&coefficients, &self.parts.bodies.reference[node]);
            (joined([(node, coefficients)]), value)
        };
        rows.into_iter().map(row).collect()
    }

    /// Rows that give a node of a second line the place of one of the first, and the slope along it; of a smooth surface all slopes, with the
    /// unit of length of its mixed derivatives over that of the first.
    fn rows_between(
        &self,
        (first, second): (&LineNode, &LineNode),
        units: Option<f64>,
    ) -> Vec<(ConnectivityRow<D>, f64)> {
        let (along, across) = ([first.along, second.along], [first.across, second.across]);
        let mixed = [first.mixed(), second.mixed()];
        let mut pairs = vec![
            ([first.point(), second.point()], 1.0),
            (along, self.ratio(along)),
        ];
        if let Some(units) = units {
            let of_mixed = self.ratio(along) * self.ratio(across) * units;
            pairs.extend([(across, self.ratio(across)), (mixed, of_mixed)]);
        }
        rows_of_pairs(pairs).collect()
    }

    /// Ratio of two vectors of nodes that have one direction: the second over the first.
    fn ratio(&self, pair: [NodeVector; 2]) -> f64 {
        let [of, by] = pair.map(|of| self.vector_of(of));
        by.dot(&of) / of.norm_squared()
    }

    /// Nodes of the line of a body, in one of its directions.
    fn nodes_along(&self, body: Cable<'_>, is_reversed: bool) -> Vec<usize> {
        let chains = self.parts.bodies.lines();
        let range = body.id.chain().map(|chain| chains[chain].range());
        let mut nodes: Vec<usize> = range.into_iter().flatten().collect();
        if is_reversed {
            nodes.reverse();
        }
        nodes
    }

    /// Marker at a node of the line of a body.
    fn on_line_at(&self, body: Cable<'_>, node: usize) -> Marker {
        Marker::weighted(body.id.body, [node; 2], [0.0, 1.0, 0.0, 0.0])
    }

    /// Conditions by which the sections of a rod or beam at the nodes of a line rotate about it with the surface: its normal at the start
    /// stays perpendicular to the slope across the line.
    fn sections_on<'b>(
        &'b self,
        body: Cable<'_>,
        base: &'b [usize],
        of: &'b Line<'b>,
    ) -> impl Iterator<Item = ConstraintKind<D>> {
        let (index, chains) = (body.id.body, self.parts.bodies.lines());
        let chain = body.id.chain().map(|chain| &chains[chain]);
        let sections = chain.and_then(|chain| self.parts.bodies.sections(chain));
        let frames = sections.into_iter().flat_map(RodChain::frames);
        let frames: BTreeMap<usize, usize> = frames.map(|(frame, line)| (line, frame)).collect();
        let x = &self.parts.bodies.reference;
        base.iter()
            .zip(&of.nodes)
            .filter_map(move |(node, second)| {
                let frame = *frames.get(node)?;
                let normal = self.normal_at(second);
                let normal = axes_at(frame, x).map(|axis| axis.dot(&normal));
                let normal = Marker::framed(index, frame, [0.0; 3], normal);
                let across = of.marker(second.across, 1.0);
                Some(ConstraintKind::Perpendicular(Perpendicular {
                    direction: Direction::Of(normal),
                    across: Across::Direction(Direction::Of(across)),
                }))
            })
    }

    /// Conditions that hold a node of a line on the frame of a marker, and the normal where it `is_clamped`.
    fn on_frame(
        &self,
        marker: &Marker,
        (line, node): (&Line<'_>, &LineNode),
        is_clamped: bool,
    ) -> Vec<ConstraintKind<D>> {
        let x = &self.parts.bodies.reference;
        let (body, origin) = (marker.body, marker.nodes[0]);
        let axes = axes_at(origin, x);
        let within = |v: Vector3<f64>| axes.map(|axis| axis.dot(&v));
        let arm = within(self.vector_of(node.point()) - self.vector_of((origin, 0)));
        let fixed = |direction: Vector3<f64>| Marker::framed(body, origin, arm, within(direction));
        let size = line.lengths.iter().sum();
        let none = Vector::zeros();
        let ends = [
            fixed(self.vector_of(node.along)),
            line.marker(node.along, 1.0),
        ];
        let point = Marker::weighted(line.body, [node.first; 2], [0.0; 4]);
        let held = |second: Marker, size: f64, on: [Vector<D>; 2]| {
            ConstraintKind::LinearConstraint(LinearConstraint {
                ends: [ends[0], second].map(Attachment::Body),
                on_ends: [on.map(|on| -on), on],
                target: Target::Fixed(0.0),
                size,
                is_constant: false,
            })
        };
        let places = (0..D).map(|k| held(point, size, [axis(k), none]));
        let slopes = (0..D).map(|k| held(ends[1], 1.0, [none, axis(k)]));
        let normal = fixed(self.normal_at(node));
        let beside = [node.across, node.mixed()]
            .into_iter()
            .filter(|_| is_clamped);
        let rotated = beside.map(|of| {
            ConstraintKind::Perpendicular(Perpendicular {
                direction: Direction::Of(normal),
                across: Across::Direction(Direction::Of(line.marker(of, 1.0))),
            })
        });
        places.chain(slopes).chain(rotated).collect()
    }

    /// Conditions that keep the angle between two surfaces, at the nodes of their common line and at the middles of its elements.
    fn folds<'b>(
        &'b self,
        first: &'b Line<'b>,
        second: &'b Line<'b>,
    ) -> impl Iterator<Item = ConstraintKind<D>> {
        let x = &self.parts.bodies.reference;
        let fold = move |slopes| ConstraintKind::Fold(Fold::new(slopes, x));
        let at_nodes = (0..second.nodes.len())
            .map(move |k| fold([first.slope_at(k), second.slope_at(k), second.tangent_at(k)]));
        let between = (0..second.lengths.len()).map(move |k| {
            let slopes = [first, second].map(|line| line.slope_between(k));
            fold([slopes[0], slopes[1], second.tangent_between(k)])
        });
        at_nodes.chain(between)
    }
}

/// Rows that make the second vector of each pair this ratio times the first.
fn rows_of_pairs<const D: usize>(
    pairs: impl IntoIterator<Item = ([NodeVector; 2], f64)>,
) -> impl Iterator<Item = (ConnectivityRow<D>, f64)> {
    let row = |(pair, ratio): ([NodeVector; 2], f64), axis: usize| {
        let terms = [(pair[0], -ratio), (pair[1], 1.0)].map(|((node, part), by)| {
            let mut coefficients: Node<D> = no_node();
            coefficients[part][axis] = by;
            (node, coefficients)
        });
        (joined(terms), 0.0)
    };
    let pairs = pairs.into_iter();
    pairs.flat_map(move |pair| (0..D).map(move |axis| row(pair, axis)))
}

/// A row of terms on nodes.
fn joined<const D: usize, const N: usize>(terms: [(usize, Node<D>); N]) -> ConnectivityRow<D> {
    ConnectivityRow {
        terms: terms.to_vec(),
        is_driven: false,
    }
}

//! Nodes that rotate with axes of their own.
//!
//! Mesh nodes of plates and shells rotate with their tangent plane: all four vectors of one by its rotation.
//!
//! Sections of beams hold their nodes: the line of a beam rotates with its sections, roll included. Rotated by the smallest rotation of their
//! tangents alone, lines and sections would come apart by the roll between the tangent and a stage, times the stiffness of shear. In the
//! plane there is no roll, and a direction is all that a line rotates by.
//!
//! Stiffeners rotate with the surface that they are on, so that nodes that are tied together rotate alike.

use nalgebra::{SVector, Vector3};

use super::RotatingNodes;
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{Axes, axes_at, combined};
use crate::math::space::{Vector, components, tangent_axes, vector};

/// What a node rotates with.
#[derive(Clone, Copy, Debug)]
enum RotatesWith {
    /// The frame of a section with this first node.
    Section(usize),
    /// The tangent plane at a mesh node with this first node.
    Surface(usize),
}

/// Nodes with what they rotate with, and axes where the tangent was made and at the stages.
#[derive(Clone, Debug)]
pub(super) struct StageSections {
    nodes: Vec<(usize, RotatesWith)>,
    base: Vec<Axes>,
    turned: [Vec<Axes>; super::STAGES],
}

impl StageSections {
    /// Starts with nodes of lines and their sections, with mesh nodes of plates and shells, and with nodes of stiffeners.
    pub fn new(rotating: &RotatingNodes) -> Self {
        let lines = rotating.sections.iter();
        let lines = lines.map(|(node, frame)| (*node, RotatesWith::Section(*frame)));
        let surfaces = rotating.surfaces.iter();
        let surfaces = surfaces
            .flat_map(|node| [*node, *node + 1].map(|own| (own, RotatesWith::Surface(*node))));
        let stiffeners = rotating.stiffeners.iter();
        let stiffeners = stiffeners.map(|(line, node)| (*line, RotatesWith::Surface(*node)));
        let nodes: Vec<_> = lines.chain(surfaces).chain(stiffeners).collect();
        let axes = vec![Axes::default(); nodes.len()];
        Self {
            nodes,
            turned: [axes.clone(), axes.clone(), axes.clone()],
            base: axes,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// In the plane, the unit directions of lines are those of their sections.
    pub fn direct<const D: usize>(&self, units: &mut [SVector<f64, D>]) {
        for (line, with) in self.nodes.iter().filter(|_| D == 2) {
            if let RotatesWith::Section(section) = with {
                units[*line] = units[*section];
            }
        }
    }

    /// The tangent is made at this configuration.
    pub fn set_base<const D: usize>(&mut self, x: &[Node<D>]) {
        place(&self.nodes, x, &mut self.base);
        for turned in &mut self.turned {
            turned.copy_from_slice(&self.base);
        }
    }

    /// Sets the configuration of a stage.
    pub fn set<const D: usize>(&mut self, stage: usize, x: &[Node<D>]) {
        place(&self.nodes, x, &mut self.turned[stage]);
    }

    /// Rotates the vectors of the nodes back to where the tangent was made.
    pub fn rotate_to_tangent<const D: usize>(&self, stage: usize, nodes: &mut [Node<D>]) {
        self.turn([&self.turned[stage], &self.base], nodes);
    }

    /// Rotates the vectors of the nodes to a stage.
    pub fn rotate_to_stage<const D: usize>(&self, stage: usize, nodes: &mut [Node<D>]) {
        self.turn([&self.base, &self.turned[stage]], nodes);
    }

    fn turn<const D: usize>(&self, [from, to]: [&[Axes]; 2], nodes: &mut [Node<D>]) {
        if D == 2 {
            return;
        }
        for ((line, _), (from, to)) in self.nodes.iter().zip(from.iter().zip(to)) {
            for v in &mut nodes[*line] {
                let whole = Vector3::from(components(&Vector::<D>::from(*v)));
                let along = Vector3::from(from.map(|axis| axis.dot(&whole)));
                *v = vector::<D, f64>(combined(to, &along).into()).into();
            }
        }
    }
}

fn place<const D: usize>(nodes: &[(usize, RotatesWith)], x: &[Node<D>], axes: &mut [Axes]) {
    if D == 2 {
        return;
    }
    for ((_, with), axes) in nodes.iter().zip(axes) {
        *axes = match with {
            RotatesWith::Section(frame) => axes_at(*frame, x),
            RotatesWith::Surface(node) => {
                let derivatives = [x[*node][1], x[node + 1][0]];
                let [first, second] = derivatives.map(|v| components(&Vector::from(v)).into());
                tangent_axes(&first, &second)
            }
        };
    }
}

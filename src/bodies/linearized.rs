//! What bodies contribute to the equations of motion linearized at a state, `x'' + R x' + K x = 0`.
//!
//! Source: A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), section 3.1, for what is differentiated on numbers that carry
//! derivatives ([`Probe`]).

use nalgebra::{DMatrix, DVector};

use super::Bodies;
use super::assembly::{Assembly, NodeBlock, no_block};
use super::body::{BodyPart, NodalMotion, each};
use super::connectivity::{Node, no_node};
use super::probe::Probe;
use super::setup::NodeNumber;
use crate::math::space::{Vector, spun};
use crate::math::sparse::{General, Matrix};

/// Where bodies are linearized.
pub struct LinearizationPoint<'a, const D: usize> {
    /// Bodies that are linearized.
    pub bodies: &'a Bodies<D>,
    /// Configuration and rates.
    pub motion: NodalMotion<'a, D>,
    /// Whether all rates are taken as zero and damping is left out.
    pub at_rest: bool,
    /// Angular velocity of the frame of the scene, rad/s.
    pub rotation: [f64; 3],
    /// Forces over the nodes but those of linear constraints, `[nodes]`, N.
    pub forces: &'a [Node<D>],
    /// Where coordinates stand in matrices.
    pub assembly: &'a Assembly<D>,
    /// Scratch for derivatives of forces.
    pub probe: &'a mut Probe<D>,
}

/// Matrices of the linearized equations over the free coordinates.
#[derive(Clone, Debug)]
pub struct LinearTerms {
    /// `K`.
    pub stiffness: General<f64>,
    /// `R`.
    pub damping: General<f64>,
    /// Contributions of elements to both, element by element.
    pub elements: Vec<ElementTangent>,
    /// Whether `R` is not zero.
    pub is_damped: bool,
    /// Whether `K` is symmetric but for loads that follow.
    pub is_symmetric: bool,
    /// Symmetric parts of both that [`Self::settle`] has not added yet.
    pub(super) symmetric: [Matrix<f64>; 2],
}

/// Stiffness and damping of one element over its own velocities.
#[derive(Clone, Debug)]
pub struct ElementTangent {
    /// Where its velocities stand among the numbers of nodes, and whether each is a component of a position. The first is one.
    pub(super) places: Vec<(NodeNumber, bool)>,
    /// Stiffness.
    pub stiffness: DMatrix<f64>,
    /// Damping, if there is any.
    pub damping: Option<DMatrix<f64>>,
}

impl ElementTangent {
    /// Displacements of its nodes relative to the position of the first: those of the whole would cancel.
    pub fn relative<const D: usize>(&self, x: &[Node<D>]) -> DVector<f64> {
        let ((first, ..), _) = self.places[0];
        let from = x[first][0];
        let relative = |&((node, part, axis), is_position): &(NodeNumber, bool)| {
            let moved = x[node][part][axis];
            if is_position {
                moved - from[axis]
            } else {
                moved
            }
        };
        DVector::from_iterator(self.places.len(), self.places.iter().map(relative))
    }
}

impl LinearTerms {
    /// Zero.
    pub fn new<const D: usize>(assembly: &Assembly<D>) -> Self {
        let pattern = assembly.pattern();
        Self {
            stiffness: General::zeros(pattern),
            damping: General::zeros(pattern),
            elements: Vec::new(),
            is_damped: false,
            is_symmetric: true,
            symmetric: [0, 1].map(|_| Matrix::zeros(pattern)),
        }
    }

    /// Adds what has been collected in symmetric matrices.
    fn settle<const D: usize>(&mut self, assembly: &Assembly<D>) {
        let [stiffness, damping] = &mut self.symmetric;
        self.stiffness.add_symmetric(1.0, stiffness);
        self.damping.add_symmetric(1.0, damping);
        for matrix in [stiffness, damping] {
            *matrix = Matrix::zeros(assembly.pattern());
        }
    }

    /// Adds the Coriolis force on a constant mass over a few nodes, in a frame that rotates at `rotation`. `mass` gives the force on the
    /// node `a` of a vector at the node `b`.
    pub(super) fn add_coriolis<const D: usize>(
        &mut self,
        nodes: &[usize],
        at: &LinearizationPoint<'_, D>,
        mut mass: impl FnMut(Node<D>, usize, usize) -> Node<D>,
    ) {
        let numbers = || (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis)));
        for a in nodes {
            for b in nodes {
                let mut block: NodeBlock<D> = no_block();
                for (q, c) in numbers() {
                    let mut unit = no_node();
                    unit[q][c] = 1.0;
                    let turned = unit.map(|v| spun(at.rotation, Vector::<D>::from(v)).into());
                    let force = mass(turned, *a, *b);
                    for (p, r) in numbers() {
                        block[p][r][q][c] = 2.0 * force[p][r];
                    }
                }
                let matrix = &mut self.damping;
                (at.assembly).add_block((*a, *b), &block, matrix, &mut |_, _, _| {});
            }
        }
    }
}

impl<const D: usize> Bodies<D> {
    /// Adds all but elastic and damping forces: centrifugal, Coriolis and gyroscopic terms, geometric stiffness of forces on axes.
    pub fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        if at.rotation != [0.0; 3] {
            let [stiffness, _] = &mut terms.symmetric;
            self.add_centrifugal(at.rotation, at.motion.x, at.assembly, stiffness);
        }
        each!(self, |body| BodyPart::linearize(body, at, terms));
        terms.settle(at.assembly);
    }

    /// Adds stiffness and damping of elements.
    pub fn linearize_elements(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        each!(self, |body| BodyPart::linearize_elements(body, at, terms));
        terms.settle(at.assembly);
    }

    /// Adds the stiffness of the centrifugal force at a rotation of the frame of the scene, rad/s.
    pub fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        each!(self, |body| BodyPart::add_centrifugal(
            body, rotation, x, assembly, matrix
        ));
    }
}

//! One chain of cable elements, pinned at its start, under gravity, in formulations that differ only
//! in coordinates and in how the accelerations follow from the forces on the elements.
//!
//! In the plane all of mass and constraints is a scalar times the identity of space: every formulation
//! works on pairs. Elements are those of the product, with its mass; gravity is the only load.

mod as_printed;
mod assembled;
mod augmented;
mod band;
mod cholesky;
mod dense;
mod fronts;
mod product;
mod qr_applied;
mod qr_dense;
mod rod;

#[cfg(test)]
mod tests;

use clap::ValueEnum;
use flexbody::bodies::add_node;

pub use rod::{Element, Node, Rod, uniform};

/// How accelerations follow from forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Formulation {
    /// Report Eqs. 23-34: `M^-1 Phi^T = Q R`, `e = Q2 q`, `Q2` dense
    AsPrinted,
    /// `M = L L^T`, `L^-1 Phi^T = Q R`, `T = L^-T Q2` dense
    QrDense,
    /// `T` by QR, applied interface by interface
    QrApplied,
    /// Elements assembled, `M = W W^T`, `T = W^-T` applied
    Cholesky,
    /// `T` as the product applies it
    Product,
    /// Coordinates of the nodes, `M^-1` by a factorization
    Assembled,
    /// Coordinates of all elements, connectivity and pin as multipliers
    Augmented,
}

/// Coordinates `q` with displacements `u = T q` and accelerations `q'' = G F(u)`.
pub trait Transformation {
    /// Numbers in `q`.
    fn coordinates(&self) -> usize;
    /// `u = T q`, for rates and accelerations alike.
    fn prolong(&mut self, q: &[f64], u: &mut [Node]);
    /// `q'' = G F` of the forces on the nodes, whose content may be lost.
    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]);
    /// Size of the matrices, bytes.
    fn memory(&self) -> usize;
}

impl Formulation {
    /// Whether neighbouring elements share a node.
    fn is_connected(self) -> bool {
        matches!(self, Self::Cholesky | Self::Product | Self::Assembled)
    }

    fn transformation(self, rod: &Rod) -> Result<Box<dyn Transformation>, String> {
        let made: Option<Box<dyn Transformation>> = match self {
            Self::AsPrinted => as_printed::new(rod).map(|made| Box::new(made) as _),
            Self::QrDense => qr_dense::new(rod).map(|made| Box::new(made) as _),
            Self::QrApplied => qr_applied::new(rod).map(|made| Box::new(made) as _),
            Self::Cholesky => cholesky::new(rod).map(|made| Box::new(made) as _),
            Self::Product => product::new(rod).map(|made| Box::new(made) as _),
            Self::Assembled => assembled::new(rod).map(|made| Box::new(made) as _),
            Self::Augmented => augmented::new(rod).map(|made| Box::new(made) as _),
        };
        made.ok_or_else(|| "expected a mass that is positive".to_owned())
    }
}

/// A rod in one formulation.
pub struct System {
    /// The rod.
    pub rod: Rod,
    /// The formulation.
    pub transformation: Box<dyn Transformation>,
    x: Vec<Node>,
    f: Vec<Node>,
}

impl System {
    /// Builds elements in a row along the first axis.
    ///
    /// # Errors
    /// A transformation that cannot be built, in words.
    pub fn new(
        formulation: Formulation,
        elements: Vec<Element>,
        gravity: [f64; 2],
    ) -> Result<Self, String> {
        let rod = Rod::new(elements, formulation.is_connected(), gravity);
        let transformation = formulation.transformation(&rod)?;
        let (x, f) = (rod.reference.clone(), rod.reference.clone());
        Ok(Self {
            rod,
            transformation,
            x,
            f,
        })
    }

    /// `q''`.
    pub fn acceleration(&mut self, q: &[f64], a: &mut [f64]) {
        self.nodes_at(q);
        self.rod.force(&self.x, &mut self.f);
        self.transformation.restrict(&mut self.f, a);
    }

    /// Coordinates of the nodes.
    pub fn nodes(&mut self, q: &[f64]) -> &[Node] {
        self.nodes_at(q);
        &self.x
    }

    fn nodes_at(&mut self, q: &[f64]) {
        self.transformation.prolong(q, &mut self.x);
        for (x, reference) in self.x.iter_mut().zip(&self.rod.reference) {
            add_node(x, 1.0, reference);
        }
    }
}

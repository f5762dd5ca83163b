//! Floor 2. Flexible bodies: unassembled elements, their connectivity, its elimination, and the
//! structured tangent solve.

mod connectivity;
mod elimination;
mod marker;
mod reaction;
mod stages;
mod tangent;

pub use connectivity::{Constraint, Hold};
pub use elimination::{Elimination, Formulation};
pub use marker::Marker;
pub use reaction::Reaction;
pub use tangent::Tangent;

use nalgebra::{SMatrix, SVector};

use crate::elements::{Element, Nodal};
use crate::math::eigen::symmetric_eigenvalues;
use reaction::Support;

/// A chain of elements in `D` dimensions; `B = 2 D` coordinates per node (position, slope).
///
/// Its coordinates `q` are displacements from the reference configuration, `e = e0 + T q`; their unit
/// is m sqrt(kg), and `|dq/dt|^2 / 2` is the kinetic energy.
#[derive(Clone, Debug)]
pub struct FlexibleBody<E, const D: usize, const B: usize> {
    elements: Vec<E>,
    /// Reference coordinates e0 of every element.
    reference: Vec<Nodal<D>>,
    elimination: Elimination<D>,
    supports: Vec<Support<B>>,
    is_damped: bool,
}

/// Scratch of a body: as long as its elements, never allocated in a step.
#[derive(Clone, Debug)]
pub struct Scratch<const D: usize> {
    /// Coordinates of the elements, m.
    pub e: Vec<Nodal<D>>,
    /// Their rates, m/s.
    pub rate: Vec<Nodal<D>>,
    /// Forces on them, N.
    pub force: Vec<Nodal<D>>,
    /// Coordinates before the border of the elimination, m sqrt(kg).
    pub border: Vec<f64>,
}

impl<E: Element<D>, const D: usize, const B: usize> FlexibleBody<E, D, B> {
    /// A body of these elements through these nodes (position, slope), one more than elements.
    pub fn new(
        elements: Vec<E>,
        nodes: &[[SVector<f64, D>; 2]],
        constraints: &[Constraint<D>],
        formulation: Formulation,
    ) -> Self {
        assert!(B == 2 * D && nodes.len() == elements.len() + 1);
        let reference = nodes
            .windows(2)
            .map(|pair| Nodal::from_columns(&[pair[0][0], pair[0][1], pair[1][0], pair[1][1]]))
            .collect();
        let masses: Vec<_> = elements.iter().map(Element::mass).collect();
        let elimination = Elimination::new(&masses, constraints, formulation);
        let supports = Support::collect(constraints);
        Self {
            is_damped: elements.iter().any(Element::is_damped),
            elements,
            reference,
            elimination,
            supports,
        }
    }

    /// Number of independent coordinates `q`.
    pub fn coordinates(&self) -> usize {
        self.elimination.coordinates()
    }

    /// The elements, in order from the first end.
    pub fn elements(&self) -> &[E] {
        &self.elements
    }

    /// Reference length, m.
    pub fn length(&self) -> f64 {
        self.elements.iter().map(Element::length).sum()
    }

    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        let of_element = |e: &E| e.weight()[0] + e.weight()[2];
        self.elements.iter().map(of_element).sum()
    }

    /// Joints with a constraint that repeats others.
    pub fn redundant(&self) -> &[usize] {
        self.elimination.redundant()
    }

    /// Scratch for this body.
    pub fn scratch(&self) -> Scratch<D> {
        let zero = vec![Nodal::zeros(); self.elements.len()];
        Scratch {
            e: zero.clone(),
            rate: zero.clone(),
            force: zero,
            border: vec![0.0; self.elimination.scratch()],
        }
    }

    /// `e = e0 + T q`.
    pub fn positions(&self, q: &[f64], border: &mut [f64], e: &mut [Nodal<D>]) {
        self.elimination.expand(q, border, e);
        e.iter_mut()
            .zip(&self.reference)
            .for_each(|(e, e0)| *e += e0);
    }

    /// `de/dt = T dq/dt`, and the same for accelerations.
    pub fn rates(&self, rate: &[f64], border: &mut [f64], e: &mut [Nodal<D>]) {
        self.elimination.expand(rate, border, e);
    }

    /// Generalized force `T^T f`.
    pub fn reduce(&self, f: &[Nodal<D>], border: &mut [f64], q: &mut [f64]) {
        self.elimination.reduce(f, border, q);
    }

    /// Adds elastic and damping forces.
    pub fn add_force(&self, e: &[Nodal<D>], rate: &[Nodal<D>], force: &mut [Nodal<D>]) {
        for (i, element) in self.elements.iter().enumerate() {
            force[i] += element.force(&e[i], &rate[i]);
        }
    }

    /// Strain energy, J.
    pub fn strain_energy(&self, e: &[Nodal<D>]) -> f64 {
        let pairs = self.elements.iter().zip(e);
        pairs.map(|(element, e)| element.energy(e)).sum()
    }

    /// `f -= M a` element by element: what connectivity and joints must supply, negative.
    pub fn subtract_inertia(&self, acceleration: &[Nodal<D>], force: &mut [Nodal<D>]) {
        for (i, element) in self.elements.iter().enumerate() {
            force[i] -= acceleration[i] * element.mass();
        }
    }

    /// Coordinates that come closest, in the mass norm, to the given rates: `T^T M de/dt`.
    pub fn project(&self, rate: &[Nodal<D>], scratch: &mut Scratch<D>, q: &mut [f64]) {
        for (i, element) in self.elements.iter().enumerate() {
            scratch.force[i] = rate[i] * element.mass();
        }
        self.reduce(&scratch.force, &mut scratch.border, q);
    }

    /// Reference coordinates of the elements.
    pub fn reference(&self) -> &[Nodal<D>] {
        &self.reference
    }

    /// Whether any element dissipates.
    pub fn is_damped(&self) -> bool {
        self.is_damped
    }

    /// Upper bound of the natural frequencies in the reference configuration, rad/s: the largest of
    /// any free element bounds those of the body (I. Fried, AIAA J. 10 (1972)).
    pub fn frequency_bound(&self) -> f64 {
        let (mut bound, mut length) = (0.0_f64, f64::NAN);
        for (element, e) in self.elements.iter().zip(&self.reference) {
            // Neighbours of the same length have the same frequencies.
            if (element.length() - length).abs() <= 1e-9 * length {
                continue;
            }
            length = element.length();
            bound = bound.max(largest_frequency(element, e));
        }
        bound
    }
}

/// Largest natural frequency of a free element, rad/s.
fn largest_frequency<E: Element<D>, const D: usize>(element: &E, e: &Nodal<D>) -> f64 {
    let stiffness = element.stiffness(e, &Nodal::zeros());
    let Some(factor) = nalgebra::Cholesky::new(element.mass()) else {
        return f64::INFINITY;
    };
    let l = factor.l();
    let Some(inverse) = l.try_inverse() else {
        return f64::INFINITY;
    };
    // L^-1 K L^-T, the scalar factor applied block by block.
    let weighted = |a: usize, b: usize| {
        let mut sum = SMatrix::<f64, D, D>::zeros();
        for (i, row) in stiffness.iter().enumerate() {
            for (j, block) in row.iter().enumerate() {
                sum += block * (inverse[(a, i)] * inverse[(b, j)]);
            }
        }
        sum
    };
    let values = symmetric_eigenvalues(4 * D, |r, c| weighted(r / D, c / D)[(r % D, c % D)]);
    match values.as_deref() {
        Some([.., largest]) => largest.max(0.0).sqrt(),
        _ => f64::INFINITY,
    }
}

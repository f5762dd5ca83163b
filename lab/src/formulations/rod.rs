//! The chain that all formulations move.

use flexbody::body::Chain;
use flexbody::elements::Element as _;
use flexbody::elements::cable::{Cable, Parameters};
use nalgebra::{Matrix4, Vector2};

/// The product's cable.
pub type Element = Cable<2, 1>;
/// Position and slope, or rates of them, or forces on them.
pub type Node = [f64; 4];
/// Scalar mass of an element.
pub type Mass = [[f64; 4]; 4];

/// A chain along the first axis, its start pinned to the origin.
pub struct Rod {
    /// The elements.
    pub chain: Chain<Element, 2, 4>,
    /// Whether neighbours share a node.
    pub connected: bool,
    /// Coordinates of the straight chain.
    pub reference: Vec<Node>,
    /// Forces of gravity.
    weight: Vec<Node>,
}

/// Elements of these lengths, m.
pub fn cables(parameters: Parameters, lengths: &[f64]) -> Vec<Element> {
    let cable = |&length: &f64| {
        Cable::new(
            Parameters {
                length,
                ..parameters
            },
            None,
        )
    };
    lengths.iter().map(cable).collect()
}

/// `count` equal elements from a body of the length of `parameters`.
pub fn uniform(parameters: Parameters, count: usize) -> Vec<Element> {
    cables(parameters, &vec![parameters.length / count as f64; count])
}

impl Rod {
    /// From elements in a row.
    pub fn new(elements: Vec<Element>, connected: bool, gravity: [f64; 2]) -> Self {
        let chain = Chain::new(elements, 0, connected);
        let mut reference = vec![[0.0; 4]; chain.node_count()];
        let mut start = 0.0;
        for (j, element) in chain.elements().iter().enumerate() {
            let [first, second] = chain.nodes(j);
            reference[first] = [start, 0.0, 1.0, 0.0];
            start += element.length();
            reference[second] = [start, 0.0, 1.0, 0.0];
        }
        let mut weight = vec![[0.0; 4]; reference.len()];
        chain.add_weight(&Vector2::from(gravity), &mut weight);
        Self {
            chain,
            connected,
            reference,
            weight,
        }
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.chain.elements().len()
    }

    /// Elastic forces and gravity.
    pub fn force(&self, x: &[Node], f: &mut [Node]) {
        f.copy_from_slice(&self.weight);
        self.chain.add_force(x, x, f);
    }

    /// Scalar masses of the elements.
    pub fn masses(&self) -> Vec<Mass> {
        let mass = |e: &Element| -> Mass {
            let m = e.mass();
            std::array::from_fn(|r| std::array::from_fn(|c| m[(r, c)]))
        };
        self.chain.elements().iter().map(mass).collect()
    }

    /// Largest distance between the ends of elements that meet, m.
    pub fn gap(&self, x: &[Node]) -> f64 {
        let pairs = (1..self.count()).map(|j| {
            let (before, after) = (x[self.chain.nodes(j - 1)[1]], x[self.chain.nodes(j)[0]]);
            (before[0] - after[0]).hypot(before[1] - after[1])
        });
        pairs.fold(0.0, f64::max)
    }
}

/// Scalar rows of `Phi` on one element: the pin, or both ends of an interface. Interface `j` is at the
/// start of element `j`, the pin is that of the first element.
pub fn rows(j: usize, count: usize) -> (&'static [[f64; 4]], &'static [[f64; 4]]) {
    const PIN: [[f64; 4]; 1] = [[1.0, 0.0, 0.0, 0.0]];
    const START: [[f64; 4]; 2] = [[-1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 0.0]];
    const END: [[f64; 4]; 2] = [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let own = if j == 0 { &PIN[..] } else { &START[..] };
    (own, if j + 1 < count { &END } else { &[] })
}

/// A mass for factorizations.
pub fn matrix(mass: &Mass) -> Matrix4<f64> {
    Matrix4::from_fn(|r, c| mass[r][c])
}

/// Its entries.
pub fn entries(matrix: &Matrix4<f64>) -> Mass {
    std::array::from_fn(|r| std::array::from_fn(|c| matrix[(r, c)]))
}

/// The identity.
pub fn identity() -> Mass {
    entries(&Matrix4::identity())
}

/// A scalar matrix times both nodes of an element.
#[inline]
pub fn times(matrix: &Mass, nodes: &[Node; 2]) -> [Node; 2] {
    let x = nodes.as_flattened();
    let entry = |row: usize, d: usize| (0..4).map(|c| matrix[row][c] * x[2 * c + d]).sum();
    std::array::from_fn(|n| std::array::from_fn(|k| entry(2 * n + k / 2, k % 2)))
}

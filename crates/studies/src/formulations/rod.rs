//! The chain that all formulations move.

use flexbody::bodies::{Chain, no_node};
use flexbody::elements::cable::{Cable, Parameters};
use flexbody::elements::{Element as _, ElementMotion};
use flexbody::math::lanes::{PACK, Simd, Vectorized, vectorized};
use nalgebra::{Matrix4, Vector2};

/// The product's cable.
pub type Element = Cable<2>;
/// Position and slope, or rates of them, or forces on them.
pub type Node = flexbody::bodies::Node;
/// Scalar mass of an element.
pub type Mass = [[f64; 4]; 4];

/// Elements that are computed together.
type Pack = <Element as flexbody::elements::Element<2>>::Pack;

/// A chain along the first axis, its start pinned to the origin.
pub struct Rod {
    /// The elements, as neighbours that share a node.
    pub chain: Chain<Element, 2>,
    /// Elements that have both their nodes for themselves are computed in these packs.
    packs: Vec<Pack>,
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
        let packs = elements.chunks(PACK).map(Cable::pack).collect();
        let mut rod = Self {
            chain: Chain::new(elements, 0),
            packs,
            connected,
            reference: Vec::new(),
            weight: Vec::new(),
        };
        let count = rod.nodes(rod.count() - 1)[1] + 1;
        let (mut reference, mut weight) = (vec![no_node(); count], vec![no_node(); count]);
        let mut start = 0.0;
        for (j, element) in rod.chain.elements().iter().enumerate() {
            let [first, second] = rod.nodes(j);
            reference[first] = [[start, 0.0], [1.0, 0.0]];
            start += element.length();
            reference[second] = [[start, 0.0], [1.0, 0.0]];
            let force = Vector2::from(gravity) * element.weight().transpose();
            for (node, column) in [(first, 0), (second, 2)] {
                for k in 0..4 {
                    weight[node][k / 2][k % 2] += force[(k % 2, column + k / 2)];
                }
            }
        }
        (rod.reference, rod.weight) = (reference, weight);
        rod
    }

    /// Nodes of element `j`.
    pub fn nodes(&self, j: usize) -> [usize; 2] {
        let first = if self.connected { j } else { 2 * j };
        [first, first + 1]
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.chain.elements().len()
    }

    /// Elastic forces and gravity.
    pub fn force(&self, x: &[Node], f: &mut [Node]) {
        f.copy_from_slice(&self.weight);
        if self.connected {
            self.chain.add_force((x, x), [1.0, 0.0], f);
        } else {
            vectorized(AddForce { rod: self, x, f })
        }
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
        let gaps = (1..self.count()).map(|j| self.gap_before(j, x));
        gaps.fold(0.0, f64::max)
    }

    /// Distance between the start of an element and the end of the one before it, m.
    pub fn gap_before(&self, j: usize, x: &[Node]) -> f64 {
        let ([before, _], [after, _]) = (x[self.nodes(j - 1)[1]], x[self.nodes(j)[0]]);
        (before[0] - after[0]).hypot(before[1] - after[1])
    }
}

/// [`Rod::force`] of elements that stand alone.
struct AddForce<'a> {
    rod: &'a Rod,
    x: &'a [Node],
    f: &'a mut [Node],
}

impl Vectorized for AddForce<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        // Coordinates that any element can be evaluated at, for lanes without one.
        let (mut e, mut f) = ([[[1.0; PACK]; 2]; 4], [[[1.0; PACK]; 2]; 4]);
        let nodes = self.x.chunks(2 * PACK).zip(self.f.chunks_mut(2 * PACK));
        for (pack, (x, force)) in self.rod.packs.iter().zip(nodes) {
            for (lane, ends) in x.as_chunks::<2>().0.iter().enumerate() {
                for k in 0..4 {
                    e[k / 2][k % 2][lane] = ends[0][k / 2][k % 2];
                    e[2 + k / 2][k % 2][lane] = ends[1][k / 2][k % 2];
                }
            }
            let motion = ElementMotion {
                at: e.each_ref().map(|v| v.each_ref()),
                rates: None,
            };
            Cable::pack_force(simd, pack, motion, 1.0, &mut f);
            for (lane, ends) in force.as_chunks_mut::<2>().0.iter_mut().enumerate() {
                for k in 0..4 {
                    ends[0][k / 2][k % 2] += f[k / 2][k % 2][lane];
                    ends[1][k / 2][k % 2] += f[2 + k / 2][k % 2][lane];
                }
            }
        }
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

/// Converts a matrix to an array of its entries.
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
    let entry = |row: usize, d: usize| (0..4).map(|c| matrix[row][c] * x[c][d]).sum();
    [0, 2].map(|row| [row, row + 1].map(|row| [entry(row, 0), entry(row, 1)]))
}

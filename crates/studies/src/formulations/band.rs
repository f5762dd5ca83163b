//! Symmetric positive matrices of 2 x 2 blocks on and beside the diagonal, each entry a multiple of the
//! identity of the plane; what they act on are rows of nodes `[pair, pair]`.
//!
//! Source: block form of the LDL^T factorization, G. H. Golub, C. F. Van Loan, Matrix Computations,
//! 4th ed., sections 4.3.6 and 4.5.1.

use flexbody::bodies::no_node;

use super::rod::{Mass, Node};

/// A scalar 2 x 2 block.
pub type Block = [[f64; 2]; 2];

/// A matrix; first of a start that may be held.
pub struct Band {
    /// Blocks on the diagonal.
    pub diagonal: Vec<Block>,
    /// Blocks of a row with the row before; the first is zero.
    pub below: Vec<Block>,
}

/// `L D L^T`.
pub struct Factors {
    /// Inverses of the blocks of `D`, and the blocks of `L` beside the diagonal.
    rows: Vec<[Block; 2]>,
}

/// `W W^T`, of `x <- W^-1 x` and of `x <- W^-T x`.
pub struct Root {
    /// Inverses of the blocks of `W` on the diagonal, and these times the ones beside it.
    rows: Vec<[Block; 2]>,
}

impl Band {
    /// Mass of elements that share nodes. A start that is held has the inertia 1 and nothing beside it.
    pub fn assembled(masses: &[Mass]) -> Self {
        let zero = [[0.0; 2]; 2];
        let mut diagonal = vec![zero; masses.len() + 1];
        let mut below = diagonal.clone();
        for (j, m) in masses.iter().enumerate() {
            for r in 0..2 {
                for c in 0..2 {
                    diagonal[j][r][c] += m[r][c];
                    diagonal[j + 1][r][c] += m[2 + r][2 + c];
                    below[j + 1][r][c] = m[2 + r][c];
                }
            }
        }
        diagonal[0] = [[1.0, 0.0], [0.0, diagonal[0][1][1]]];
        below[1][0][0] = 0.0;
        below[1][1][0] = 0.0;
        Self { diagonal, below }
    }

    /// `L D L^T`; `None` where it is not positive.
    pub fn factors(&self) -> Option<Factors> {
        let mut rows: Vec<[Block; 2]> = Vec::new();
        for (diagonal, below) in self.diagonal.iter().zip(&self.below) {
            let (mut d, mut l) = (*diagonal, [[0.0; 2]; 2]);
            if let Some([before, _]) = rows.last() {
                l = product(below, before);
                d = minus(&d, &product(&l, &transposed(below)));
            }
            let determinant = d[0][0] * d[1][1] - d[0][1] * d[1][0];
            if !(d[0][0] > 0.0 && determinant > 0.0) {
                return None;
            }
            let inverse = |x: f64| x / determinant;
            let inverse = [[d[1][1], -d[0][1]], [-d[1][0], d[0][0]]].map(|row| row.map(inverse));
            rows.push([inverse, l]);
        }
        Some(Factors { rows })
    }

    /// `W W^T`; `None` where it is not positive.
    pub fn root(&self) -> Option<Root> {
        let mut rows: Vec<[Block; 2]> = Vec::new();
        for (diagonal, below) in self.diagonal.iter().zip(&self.below) {
            let (mut d, mut w) = (*diagonal, [[0.0; 2]; 2]);
            if let Some([before, _]) = rows.last() {
                w = product(below, &transposed(before));
                d = minus(&d, &product(&w, &transposed(&w)));
            }
            let a = d[0][0].sqrt();
            let b = d[1][0] / a;
            let c = (d[1][1] - b * b).sqrt();
            if !(a > 0.0 && c > 0.0) {
                return None;
            }
            let inverse = [[1.0 / a, 0.0], [-b / (a * c), 1.0 / c]];
            rows.push([inverse, product(&inverse, &w)]);
        }
        Some(Root { rows })
    }
}

impl Factors {
    /// `x <- A^-1 x`.
    pub fn solve(&self, x: &mut [Node]) {
        let mut before = no_node();
        for ([_, l], x) in self.rows.iter().zip(x.iter_mut()) {
            *x = less(x, &times(l, &before));
            before = *x;
        }
        let mut after = no_node();
        for ([inverse, l], x) in self.rows.iter().zip(x.iter_mut()).rev() {
            *x = less(&times(inverse, x), &after);
            after = times_transposed(l, x);
        }
    }

    /// Bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.rows[..])
    }
}

impl Root {
    /// `y = W^-1 x`; the first pair is held.
    pub fn forward(&self, x: &[Node], y: &mut [f64]) {
        let y = y.as_chunks_mut::<2>().0.as_chunks_mut::<2>().0;
        let mut before = no_node();
        let mut x = x.iter().copied();
        let first = x.next().map(|[_, slope]| [[0.0; 2], slope]);
        let x = first.into_iter().chain(x);
        for (([inverse, w], x), y) in self.rows.iter().zip(x).zip(y) {
            before = less(&times(inverse, &x), &times(w, &before));
            *y = before;
        }
    }

    /// `x = W^-T y`.
    pub fn backward(&self, y: &[f64], x: &mut [Node]) {
        let y = y.as_chunks::<2>().0.as_chunks::<2>().0;
        let mut after = no_node();
        // Block above the diagonal, one row later.
        for (([inverse, w], y), x) in self.rows.iter().zip(y).zip(x).rev() {
            let z = less(y, &after);
            *x = times_transposed(inverse, &z);
            after = times_transposed(w, &z);
        }
    }

    /// Bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.rows[..])
    }
}

fn product(a: &Block, b: &Block) -> Block {
    let entry = |r: usize, c: usize| a[r][0] * b[0][c] + a[r][1] * b[1][c];
    std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c)))
}

fn transposed(a: &Block) -> Block {
    [[a[0][0], a[1][0]], [a[0][1], a[1][1]]]
}

fn minus(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|r| std::array::from_fn(|c| a[r][c] - b[r][c]))
}

fn less(a: &Node, b: &Node) -> Node {
    std::array::from_fn(|r| std::array::from_fn(|k| a[r][k] - b[r][k]))
}

fn times(a: &Block, x: &Node) -> Node {
    std::array::from_fn(|r| std::array::from_fn(|k| a[r][0] * x[0][k] + a[r][1] * x[1][k]))
}

fn times_transposed(a: &Block, x: &Node) -> Node {
    std::array::from_fn(|r| std::array::from_fn(|k| a[0][r] * x[0][k] + a[1][r] * x[1][k]))
}

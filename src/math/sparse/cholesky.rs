//! The triangular factor of a positive definite matrix, as a change of coordinates.
//!
//! Masses are isotropic: a block over two nodes of a chain is a 2 x 2 matrix times the identity of the
//! plane. Runs of such blocks have loops of their own, on two vectors a node.

use std::ops::Range;

use super::pattern::{CHAIN, Step};
use super::{Matrix, Pattern, kernels};

/// Cholesky factor W, lower triangular in elimination order, of a positive definite A = W W^T,
/// kept as W = L sqrt(D) with the factors L D L^T of A.
#[derive(Clone, Debug)]
pub struct Cholesky {
    factors: Matrix<f64>,
    roots: Vec<f64>,
    inverse_roots: Vec<f64>,
    /// For every step of the pattern.
    pieces: Vec<Piece>,
}

/// The columns of one step of the pattern.
#[derive(Clone, Debug)]
struct Piece {
    columns: Range<usize>,
    /// The columns of a run where it is isotropic, else nothing; and the first of their variables.
    links: Vec<Link>,
    start: usize,
}

/// A column of L: two vectors of a node, `p` and `s`, and those of the next one.
#[derive(Clone, Copy, Debug)]
struct Link {
    /// `s` by `p`.
    own: f64,
    /// Those of the next node by `p` and by `s`.
    below: [[f64; 2]; 2],
    /// Those of the next node by `p` once `s` is reduced: `below[.][0] - below[.][1] own`, so that a
    /// substitution need not wait for that.
    direct: [f64; 2],
}

impl Link {
    /// From the blocks of a column, unless they depend on the direction.
    fn new([diagonal, below]: &[[[f64; CHAIN]; CHAIN]; 2]) -> Option<Self> {
        for r in 0..CHAIN {
            for c in 0..CHAIN {
                let (twin_r, twin_c) = (r ^ 1, c ^ 1);
                let isotropic = |block: &[[f64; CHAIN]; CHAIN]| match r % 2 == c % 2 {
                    true => block[r][c] == block[twin_r][twin_c],
                    false => block[r][c] == 0.0,
                };
                if !isotropic(below) || (c < r && !isotropic(diagonal)) {
                    return None;
                }
            }
        }
        let (own, below) = (
            diagonal[2][0],
            [[below[0][0], below[0][2]], [below[2][0], below[2][2]]],
        );
        Some(Self {
            own,
            below,
            direct: below.map(|row| row[0] - row[1] * own),
        })
    }
}

impl Cholesky {
    /// Factors `a` (not yet factored); `None` if it is not positive definite.
    pub fn new(pattern: &Pattern, a: &Matrix<f64>) -> Option<Self> {
        let mut factors = a.clone();
        if factors.factor(pattern)? > 0 {
            return None;
        }
        let mut inverse_roots = Vec::with_capacity(pattern.len());
        for column in &pattern.columns {
            let pivots = (0..column.size).map(|i| column.at + i * (column.size + 1));
            inverse_roots.extend(pivots.map(|i| factors.values[i].sqrt()));
        }
        Some(Self {
            pieces: pieces(pattern, &factors),
            factors,
            roots: inverse_roots.iter().map(|root| 1.0 / root).collect(),
            inverse_roots,
        })
    }

    /// `x <- W^-1 x`.
    pub fn forward(&self, pattern: &Pattern, x: &mut [f64]) {
        self.forward_steps(pattern, 0..self.pieces.len(), 0, x);
        scale(x, &self.inverse_roots);
    }

    /// `x <- W^-1 x` for one component; `x` holds the variables of this component alone.
    pub fn forward_component(&self, pattern: &Pattern, component: usize, x: &mut [f64]) {
        let component = &pattern.components()[component];
        let variables = component.variables.clone();
        self.forward_steps(pattern, component.steps.clone(), variables.start, x);
        scale(x, &self.inverse_roots[variables]);
    }

    fn forward_steps(&self, pattern: &Pattern, steps: Range<usize>, base: usize, x: &mut [f64]) {
        for (piece, step) in self.pieces[steps.clone()].iter().zip(&pattern.steps[steps]) {
            if piece.links.is_empty() {
                let step = std::slice::from_ref(step);
                kernels::forward(pattern, step, &self.factors.values, base, x);
            } else {
                forward_links(&piece.links, &mut x[piece.start - base..]);
            }
        }
    }

    /// `x <- W^-T x`.
    pub fn backward(&self, pattern: &Pattern, x: &mut [f64]) {
        scale(x, &self.inverse_roots);
        for (piece, step) in self.pieces.iter().zip(&pattern.steps).rev() {
            if piece.links.is_empty() {
                let step = std::slice::from_ref(step);
                kernels::backward::<f64, false>(pattern, step, &self.factors.values, 0, x);
            } else {
                backward_links(&piece.links, &mut x[piece.start..]);
            }
        }
    }

    /// `x <- W x`.
    pub fn multiply(&self, pattern: &Pattern, x: &mut [f64]) {
        scale(x, &self.roots);
        self.multiply_steps(pattern, 0..self.pieces.len(), 0, x);
    }

    /// `x <- W x` for one component; `x` holds the variables of this component alone.
    pub fn multiply_component(&self, pattern: &Pattern, component: usize, x: &mut [f64]) {
        let component = &pattern.components()[component];
        let variables = component.variables.clone();
        scale(x, &self.roots[variables.clone()]);
        self.multiply_steps(pattern, component.steps.clone(), variables.start, x);
    }

    fn multiply_steps(&self, pattern: &Pattern, steps: Range<usize>, base: usize, x: &mut [f64]) {
        for piece in self.pieces[steps].iter().rev() {
            if piece.links.is_empty() {
                for column in pattern.columns[piece.columns.clone()].iter().rev() {
                    kernels::multiply_lower(pattern, column, &self.factors.values, base, x);
                }
            } else {
                multiply_links(&piece.links, &mut x[piece.start - base..]);
            }
        }
    }

    /// `x <- W^T x`.
    pub fn multiply_transposed(&self, pattern: &Pattern, x: &mut [f64]) {
        for piece in &self.pieces {
            if piece.links.is_empty() {
                for column in &pattern.columns[piece.columns.clone()] {
                    kernels::multiply_lower_transposed(pattern, column, &self.factors.values, x);
                }
            } else {
                multiply_links_transposed(&piece.links, &mut x[piece.start..]);
            }
        }
        scale(x, &self.roots);
    }
}

fn pieces(pattern: &Pattern, factors: &Matrix<f64>) -> Vec<Piece> {
    let mut first = 0;
    let piece = |step: &Step| {
        let (count, links, start) = match step {
            Step::Column(_) => (1, None, 0),
            Step::Chain { values, variables } => {
                let blocks = factors.values[values.clone()].as_chunks::<CHAIN>().0;
                let columns = blocks.as_chunks::<CHAIN>().0.as_chunks::<2>().0;
                let links: Option<Vec<Link>> = columns.iter().map(Link::new).collect();
                (columns.len(), links, variables.start)
            }
        };
        let columns = first..first + count;
        first += count;
        Piece {
            columns,
            links: links.unwrap_or_default(),
            start,
        }
    };
    pattern.steps.iter().map(piece).collect()
}

/// `x <- L^-1 x` over a run; `x` starts with its variables.
fn forward_links(links: &[Link], x: &mut [f64]) {
    let mut nodes = x.as_chunks_mut::<CHAIN>().0.iter_mut();
    let Some(mut node) = nodes.next() else {
        return;
    };
    for (link, next) in links.iter().zip(nodes) {
        let [[_, by_p], [_, by_s]] = link.below;
        let [p, q, s, t] = *node;
        node[2] = s - link.own * p;
        node[3] = t - link.own * q;
        next[0] = next[0] - by_p * s - link.direct[0] * p;
        next[1] = next[1] - by_p * t - link.direct[0] * q;
        next[2] = next[2] - by_s * s - link.direct[1] * p;
        next[3] = next[3] - by_s * t - link.direct[1] * q;
        node = next;
    }
}

/// `x <- L^-T x`.
fn backward_links(links: &[Link], x: &mut [f64]) {
    let nodes = &mut x.as_chunks_mut::<CHAIN>().0[..links.len() + 1];
    let mut nodes = nodes.iter_mut().rev();
    let Some(mut next) = nodes.next() else {
        return;
    };
    for (link, node) in links.iter().rev().zip(nodes) {
        let [[_, by_p], [_, by_s]] = link.below;
        let [p, q, s, t] = *next;
        let [own_p, own_q] = [node[0] - link.own * node[2], node[1] - link.own * node[3]];
        node[0] = own_p - link.direct[0] * p - link.direct[1] * s;
        node[1] = own_q - link.direct[0] * q - link.direct[1] * t;
        node[2] = node[2] - by_p * p - by_s * s;
        node[3] = node[3] - by_p * q - by_s * t;
        next = node;
    }
}

/// `x <- L x`.
fn multiply_links(links: &[Link], x: &mut [f64]) {
    let nodes = &mut x.as_chunks_mut::<CHAIN>().0[..links.len() + 1];
    let mut nodes = nodes.iter_mut().rev();
    let Some(mut next) = nodes.next() else {
        return;
    };
    for (link, node) in links.iter().rev().zip(nodes) {
        let [p, q, s, t] = *node;
        for (k, below) in link.below.iter().enumerate() {
            next[2 * k] += below[0] * p + below[1] * s;
            next[2 * k + 1] += below[0] * q + below[1] * t;
        }
        node[2] += link.own * p;
        node[3] += link.own * q;
        next = node;
    }
}

/// `x <- L^T x`.
fn multiply_links_transposed(links: &[Link], x: &mut [f64]) {
    let mut nodes = x.as_chunks_mut::<CHAIN>().0.iter_mut();
    let Some(mut node) = nodes.next() else {
        return;
    };
    for (link, next) in links.iter().zip(nodes) {
        let [[pp, ps], [sp, ss]] = link.below;
        let [p, q, s, t] = *next;
        node[0] += link.own * node[2] + pp * p + sp * s;
        node[1] += link.own * node[3] + pp * q + sp * t;
        node[2] += ps * p + ss * s;
        node[3] += ps * q + ss * t;
        node = next;
    }
}

fn scale(x: &mut [f64], factors: &[f64]) {
    for (x, factor) in x.iter_mut().zip(factors) {
        *x *= factor;
    }
}

//! The triangular factor of a positive definite matrix, as a change of coordinates.
//!
//! Masses are isotropic: a block over two nodes of a chain is a 2 x 2 matrix times the identity of the
//! plane or of space. Runs of such blocks have loops of their own, on two vectors a node; columns of surfaces have those of `vectors`.

use std::collections::BTreeSet;
use std::ops::Range;

use super::pattern::{CHAINS, Column, Step, of_size};
use super::vectors::{Sweep, VectorColumns};
use super::{Matrix, Pattern, kernels};

/// Cholesky factor W, lower triangular in elimination order, of a positive definite A = W W^T,
/// kept as W = L sqrt(D) with the factors L D L^T of A.
#[derive(Clone, Debug)]
pub struct Cholesky {
    factors: Matrix<f64>,
    roots: Vec<f64>,
    inverse_roots: Vec<f64>,
    /// All columns, in the order they are eliminated.
    pieces: Vec<Piece>,
}

/// Columns that are gone through together.
#[derive(Clone, Debug)]
struct Piece {
    columns: Range<usize>,
    kind: PieceKind,
}

#[derive(Clone, Debug)]
enum PieceKind {
    /// `L` is the identity here: a body that nothing couples.
    Identity,
    /// Isotropic columns of nodes, each joined to the next one alone.
    Nodes(NodeRun),
    /// Isotropic columns in space with the same rows below.
    Vectors(VectorColumns),
    /// A step of the pattern.
    Step(Step),
}

/// A run of nodes.
#[derive(Clone, Debug)]
struct NodeRun {
    /// Vectors of the first node by the one of a pinned node before it, where its column belongs to the run.
    head: Option<[f64; 2]>,
    /// Columns that a next node follows.
    links: Vec<NodeColumn>,
    /// `s` by `p` of the last node, where its column belongs to the run.
    last: Option<f64>,
    /// The first variable of the first node.
    start: usize,
    /// Variables of a column.
    size: usize,
}

/// Where `W^-1 x` is not zero for some `x`.
#[derive(Clone, Debug)]
pub struct Reach {
    /// Pieces to go through, and how many columns of each may be skipped.
    pieces: Vec<(usize, usize)>,
    /// The variables that are not zero, in order.
    pub variables: Vec<Range<usize>>,
}

/// A column of L: two vectors of a node, `p` and `s`, and those of the next one. A pinned node has one.
#[derive(Clone, Copy, Debug)]
struct NodeColumn {
    /// `s` by `p`.
    own: f64,
    /// Vectors of the next node by `p` and by `s`.
    below: [[f64; 2]; 2],
    /// Vectors of the next node by `p` once `s` is reduced: `below[.][0] - below[.][1] own`. A substitution need not
    /// wait for that.
    direct: [f64; 2],
}

/// Whether a block over two vectors is the same in all directions; of a diagonal block the lower triangle is read.
fn is_isotropic<const B: usize>(block: &[[f64; B]; B], is_diagonal: bool) -> bool {
    let dimension = B / 2;
    let mut entries = (0..B).flat_map(|r| (0..B).map(move |c| (r, c)));
    entries.all(|(r, c)| {
        if is_diagonal && c >= r {
            true
        } else if r % dimension == c % dimension {
            // The entry of the first axis over the same vectors.
            block[r][c] == block[r - r % dimension][c - c % dimension]
        } else {
            block[r][c] == 0.0
        }
    })
}

impl NodeColumn {
    /// From the blocks of a column over two vectors, unless they depend on the direction.
    fn new<const B: usize>([diagonal, below]: &[[[f64; B]; B]; 2]) -> Option<Self> {
        if !(is_isotropic(diagonal, true) && is_isotropic(below, false)) {
            return None;
        }
        let d = B / 2;
        let (own, below) = (
            diagonal[d][0],
            [[below[0][0], below[0][d]], [below[d][0], below[d][d]]],
        );
        Some(Self {
            own,
            below,
            direct: below.map(|row| row[0] - row[1] * own),
        })
    }
}

impl NodeRun {
    /// The columns of a step, if they are isotropic and the next nodes are all that is below.
    fn new(pattern: &Pattern, step: &Step, values: &[f64]) -> Option<Self> {
        match step {
            Step::Chain {
                size,
                values: run,
                variables,
            } => {
                let links = of_size!(size, B => {
                    let blocks = values[run.clone()].as_chunks::<B>().0.as_chunks::<B>().0;
                    let links = blocks.as_chunks::<2>().0.iter().map(NodeColumn::new);
                    // Two vectors a node.
                    B.is_multiple_of(2).then(|| links.collect::<Option<Vec<NodeColumn>>>()).flatten()
                });
                Some(Self {
                    head: None,
                    links: links?,
                    last: None,
                    start: variables.start,
                    size: *size,
                })
            }
            Step::Column(j) => Self::of_column(pattern, *j, values),
        }
    }

    /// The last node of a run, or the pinned node before one.
    fn of_column(pattern: &Pattern, j: usize, values: &[f64]) -> Option<Self> {
        let column = &pattern.columns[j];
        let size = column.size;
        let run = |head, last, start, size| Self {
            head,
            links: Vec::new(),
            last,
            start,
            size,
        };
        match &pattern.rows[column.rows.clone()] {
            [] if CHAINS.contains(&size) => {
                let last = of_size!(size, B => {
                    let block = values[column.at..].as_chunks::<B>().0.as_chunks::<B>().0;
                    let is_node = B.is_multiple_of(2) && is_isotropic(&block[0], true);
                    is_node.then(|| block[0][B / 2][0])
                });
                Some(run(None, Some(last?), column.start, size))
            }
            [row] if row.column == j + 1 && row.size == 2 * size && CHAINS.contains(&row.size) => {
                let entry = |at: usize, r: usize, c: usize| values[at + r * size + c];
                let head = [0, size].map(|r| entry(row.at, r, 0));
                let mut places = (0..size).flat_map(|r| (0..size).map(move |c| (r, c)));
                let is_isotropic = places.all(|(r, c)| {
                    let below = [0, size].map(|first| entry(row.at, first + r, c));
                    let of = if r == c { head } else { [0.0; 2] };
                    below == of && (c >= r || entry(column.at, r, c) == 0.0)
                });
                is_isotropic.then(|| run(Some(head), None, column.start + size, row.size))
            }
            _ => None,
        }
    }

    /// Takes over the run that begins with the node that this one ends with. False where there is none.
    fn join(&mut self, next: &Self) -> bool {
        let end = self.start + self.links.len() * self.size;
        let is_open = self.last.is_none() && next.head.is_none();
        let is_next = is_open && (next.start, next.size) == (end, self.size);
        if is_next {
            self.links.extend(&next.links);
            self.last = next.last;
        }
        is_next
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

    /// Variables that three directions at once are gone through with.
    #[cfg(test)]
    pub(super) fn in_vectors(&self) -> usize {
        let sizes = self.pieces.iter().map(|piece| match &piece.kind {
            PieceKind::Vectors(columns) => columns.variables(),
            _ => 0,
        });
        sizes.sum()
    }

    /// `x <- W^-1 x`.
    pub fn forward(&self, pattern: &Pattern, x: &mut [f64]) {
        for piece in &self.pieces {
            self.forward_piece(pattern, piece, 0, x);
        }
        scale(x, &self.inverse_roots);
    }

    /// `x <- W^-1 x` where `x` is zero but at vertices that it was made for.
    pub fn forward_within(&self, pattern: &Pattern, reach: &Reach, x: &mut [f64]) {
        for &(piece, skipped) in &reach.pieces {
            self.forward_piece(pattern, &self.pieces[piece], skipped, x);
        }
        for range in &reach.variables {
            scale(&mut x[range.clone()], &self.inverse_roots[range.clone()]);
        }
    }

    /// One piece, but for its first columns.
    #[inline(always)]
    fn forward_piece(&self, pattern: &Pattern, piece: &Piece, skipped: usize, x: &mut [f64]) {
        match &piece.kind {
            PieceKind::Identity => {}
            PieceKind::Nodes(run) => {
                of_size!(run.size, B => forward_nodes::<{ B / 2 }>(run, skipped, x));
            }
            // Columns that may be skipped are zero.
            PieceKind::Vectors(columns) => {
                columns.apply(Sweep::Forward, &self.factors.values, x);
            }
            PieceKind::Step(step) => {
                let values = &self.factors.values;
                if skipped == 0 {
                    kernels::forward(pattern, std::slice::from_ref(step), values, x);
                } else {
                    kernels::forward(pattern, &[step.skip(skipped)], values, x);
                }
            }
        }
    }

    /// Returns the nonzero variables of `W^-1 x` for an `x` that is nonzero only at some vertices.
    pub fn reach(&self, pattern: &Pattern, vertices: &[usize]) -> Reach {
        let mut reach = Reach {
            pieces: Vec::new(),
            variables: Vec::new(),
        };
        let own = vertices.iter().filter(|v| !pattern.range(**v).is_empty());
        let mut open: BTreeSet<usize> = own.map(|v| pattern.column_of[*v]).collect();
        while let Some(j) = open.pop_first() {
            let column = &pattern.columns[j];
            open.extend(pattern.rows[column.rows.clone()].iter().map(|r| r.column));
            let index = self.pieces.partition_point(|p| p.columns.end <= j);
            let piece = &self.pieces[index];
            // A column of a run reaches the next one.
            let is_identity = matches!(piece.kind, PieceKind::Identity);
            if !is_identity && reach.pieces.last().is_none_or(|(last, _)| *last < index) {
                reach.pieces.push((index, j - piece.columns.start));
            }
            let end = column.start + column.size;
            match reach.variables.last_mut() {
                Some(last) if last.end == column.start => last.end = end,
                _ => reach.variables.push(column.start..end),
            }
        }
        reach
    }

    /// `y = W^-T x`.
    pub fn backward(&self, pattern: &Pattern, x: &[f64], y: &mut [f64]) {
        for ((y, x), factor) in y.iter_mut().zip(x).zip(&self.inverse_roots) {
            *y = x * factor;
        }
        for piece in self.pieces.iter().rev() {
            match &piece.kind {
                PieceKind::Identity => {}
                PieceKind::Nodes(run) => {
                    of_size!(run.size, B => backward_nodes::<{ B / 2 }>(run, y));
                }
                PieceKind::Vectors(columns) => {
                    columns.apply(Sweep::Backward, &self.factors.values, y);
                }
                PieceKind::Step(step) => {
                    let step = std::slice::from_ref(step);
                    kernels::backward::<f64, false>(pattern, step, &self.factors.values, y);
                }
            }
        }
    }

    /// `x <- W x`.
    pub fn multiply(&self, pattern: &Pattern, x: &mut [f64]) {
        scale(x, &self.roots);
        for piece in self.pieces.iter().rev() {
            match &piece.kind {
                PieceKind::Identity => {}
                PieceKind::Nodes(run) => {
                    of_size!(run.size, B => multiply_nodes::<{ B / 2 }>(run, x));
                }
                PieceKind::Vectors(columns) => {
                    columns.apply(Sweep::Multiply, &self.factors.values, x);
                }
                PieceKind::Step(_) => {
                    for column in pattern.columns[piece.columns.clone()].iter().rev() {
                        kernels::multiply_lower(pattern, column, &self.factors.values, x);
                    }
                }
            }
        }
    }

    /// `x <- W^T x`.
    pub fn multiply_transposed(&self, pattern: &Pattern, x: &mut [f64]) {
        for piece in &self.pieces {
            match &piece.kind {
                PieceKind::Identity => {}
                PieceKind::Nodes(run) => {
                    of_size!(run.size, B => multiply_nodes_transposed::<{ B / 2 }>(run, x));
                }
                PieceKind::Vectors(columns) => {
                    columns.apply(Sweep::MultiplyTransposed, &self.factors.values, x);
                }
                PieceKind::Step(_) => {
                    for column in &pattern.columns[piece.columns.clone()] {
                        kernels::multiply_lower_transposed(
                            pattern,
                            column,
                            &self.factors.values,
                            x,
                        );
                    }
                }
            }
        }
        scale(x, &self.roots);
    }
}

/// The pieces of a factor; a run of nodes takes in the node that it ends with where nothing is below that.
fn pieces(pattern: &Pattern, factors: &Matrix<f64>) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut first = 0;
    let mut is_alone = vec![false; pattern.columns.len()];
    for step in &pattern.steps {
        if let Step::Column(j) = step {
            is_alone[*j] = true;
        }
    }
    for step in &pattern.steps {
        let count = match step {
            Step::Column(_) => 1,
            Step::Chain {
                size, variables, ..
            } => variables.len() / size,
        };
        let columns = first..first + count;
        if pieces
            .last()
            .is_some_and(|before| before.columns.end > first)
        {
            // A column of those before.
            first += count;
            continue;
        }
        first += count;
        let run = NodeRun::new(pattern, step, &factors.values);
        if let (Some(next), Some(before)) = (&run, pieces.last_mut())
            && let PieceKind::Nodes(run) = &mut before.kind
            && run.join(next)
        {
            before.columns.end = columns.end;
            continue;
        }
        let kind = match (run, step) {
            (_, Step::Column(j)) if is_identity(&pattern.columns[*j], &factors.values) => {
                PieceKind::Identity
            }
            (Some(run), _) => PieceKind::Nodes(run),
            (None, Step::Column(j)) => {
                let of = VectorColumns::new(pattern, &factors.values, *j, |j| is_alone[j]);
                of.map_or_else(|| PieceKind::Step(step.clone()), PieceKind::Vectors)
            }
            (None, step) => PieceKind::Step(step.clone()),
        };
        let columns = match &kind {
            PieceKind::Vectors(of) => of.columns.clone(),
            _ => columns,
        };
        pieces.push(Piece { columns, kind });
    }
    pieces
}

/// Whether a column of L has nothing but ones on the diagonal.
fn is_identity(column: &Column, values: &[f64]) -> bool {
    let size = column.size;
    let mut below = (0..size).flat_map(|r| (0..r).map(move |c| column.at + r * size + c));
    column.rows.is_empty() && below.all(|at| values[at] == 0.0)
}

/// The nodes of a run: two vectors each.
fn nodes<const D: usize>(x: &mut [f64]) -> &mut [[[f64; D]; 2]] {
    x.as_chunks_mut::<D>().0.as_chunks_mut::<2>().0
}

/// `a + k b`.
#[inline(always)]
fn plus<const D: usize>(a: [f64; D], k: f64, b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|d| a[d] + k * b[d])
}

/// `a - k b`.
#[inline(always)]
fn less<const D: usize>(a: [f64; D], k: f64, b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|d| a[d] - k * b[d])
}

// What a node hands to the next one stays in registers, vector by vector: written back and read again component by
// component, a sweep takes nearly twice the instructions.

/// `x <- L^-1 x` over a run, but for its first columns.
fn forward_nodes<const D: usize>(run: &NodeRun, skipped: usize, x: &mut [f64]) {
    let first = skipped.saturating_sub(usize::from(run.head.is_some()));
    let (before, x) = x.split_at_mut(run.start + first * run.size);
    let mut nodes = nodes::<D>(x).iter_mut();
    let Some(mut node) = nodes.next() else {
        return;
    };
    let [mut p, mut s] = *node;
    if let (0, Some([to_p, to_s]), Some(head)) = (skipped, run.head, before.last_chunk()) {
        (p, s) = (less(p, to_p, *head), less(s, to_s, *head));
        node[0] = p;
    }
    for (link, next) in run.links[first..].iter().zip(nodes) {
        let [[_, by_p], [_, by_s]] = link.below;
        node[1] = less(s, link.own, p);
        let of_p = less(less(next[0], by_p, s), link.direct[0], p);
        s = less(less(next[1], by_s, s), link.direct[1], p);
        p = of_p;
        next[0] = p;
        node = next;
    }
    node[1] = run.last.map_or(s, |own| less(s, own, p));
}

/// `x <- L^-T x`.
fn backward_nodes<const D: usize>(run: &NodeRun, x: &mut [f64]) {
    let (before, x) = x.split_at_mut(run.start);
    let nodes = &mut nodes::<D>(x)[..run.links.len() + 1];
    let mut nodes = nodes.iter_mut().rev();
    let Some(node) = nodes.next() else {
        return;
    };
    let [mut p, mut s] = *node;
    if let Some(own) = run.last {
        p = less(p, own, s);
        node[0] = p;
    }
    for (link, node) in run.links.iter().rev().zip(nodes) {
        let [[_, by_p], [_, by_s]] = link.below;
        let own = less(node[0], link.own, node[1]);
        let of_p = less(less(own, link.direct[0], p), link.direct[1], s);
        s = less(less(node[1], by_p, p), by_s, s);
        p = of_p;
        *node = [p, s];
    }
    if let (Some([to_p, to_s]), Some(head)) = (run.head, before.last_chunk_mut()) {
        *head = less(less(*head, to_p, p), to_s, s);
    }
}

/// `x <- L x`.
fn multiply_nodes<const D: usize>(run: &NodeRun, x: &mut [f64]) {
    let (before, x) = x.split_at_mut(run.start);
    let nodes = &mut nodes::<D>(x)[..run.links.len() + 1];
    let mut nodes = nodes.iter_mut().rev();
    let Some(mut next) = nodes.next() else {
        return;
    };
    let [mut of_p, mut of_s] = *next;
    if let Some(own) = run.last {
        of_s = plus(of_s, own, of_p);
    }
    for (link, node) in run.links.iter().rev().zip(nodes) {
        let ([[pp, ps], [sp, ss]], [p, s]) = (link.below, *node);
        *next = [
            plus(plus(of_p, pp, p), ps, s),
            plus(plus(of_s, sp, p), ss, s),
        ];
        (of_p, of_s) = (p, plus(s, link.own, p));
        next = node;
    }
    if let (Some([to_p, to_s]), Some(head)) = (run.head, before.last_chunk()) {
        (of_p, of_s) = (plus(of_p, to_p, *head), plus(of_s, to_s, *head));
    }
    *next = [of_p, of_s];
}

/// `x <- L^T x`.
fn multiply_nodes_transposed<const D: usize>(run: &NodeRun, x: &mut [f64]) {
    let (before, x) = x.split_at_mut(run.start);
    let mut nodes = nodes::<D>(x).iter_mut();
    let Some(mut node) = nodes.next() else {
        return;
    };
    let [mut p, mut s] = *node;
    if let (Some([to_p, to_s]), Some(head)) = (run.head, before.last_chunk_mut()) {
        *head = plus(plus(*head, to_p, p), to_s, s);
    }
    for (link, next) in run.links.iter().zip(nodes) {
        let ([[pp, ps], [sp, ss]], [next_p, next_s]) = (link.below, *next);
        *node = [
            plus(plus(plus(p, link.own, s), pp, next_p), sp, next_s),
            plus(plus(s, ps, next_p), ss, next_s),
        ];
        (p, s) = (next_p, next_s);
        node = next;
    }
    if let Some(own) = run.last {
        node[0] = plus(p, own, s);
    }
}

fn scale(x: &mut [f64], factors: &[f64]) {
    for (x, factor) in x.iter_mut().zip(factors) {
        *x *= factor;
    }
}

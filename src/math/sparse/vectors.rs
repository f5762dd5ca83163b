//! Columns of a triangular factor that are numbers times the identity of space, for three directions at once.
//!
//! The mass of a surface is such a matrix: each pair of nodal vectors has a number. Columns with the same rows below go together, so that each
//! vector below is read once for all of them. Blocks below that depend on the direction, as those of clamped edges do, are multiplied by
//! themselves.
//!
//! Source: J. W. H. Liu, E. G. Ng, B. W. Peyton, On finding supernodes for sparse matrix computations, SIAM J. Matrix Anal. Appl. 14 (1993).

use std::ops::Range;

use super::pattern::{Column, Pattern, of_size};
use crate::math::lanes::{Simd, Vectorized, vectorized};
use crate::math::space::is_isotropic_below;

/// Directions of space.
const SPACE: usize = 3;

/// Most vectors of columns that go together: with one below, as many as registers hold.
const WIDEST: usize = 8;

/// Fewest numbers below the columns: what is smaller is quicker block by block.
const FEWEST: usize = 24;

/// A vector in lanes, with a zero beside it.
type Padded = [f64; SPACE + 1];

/// Columns that go together.
#[derive(Clone, Debug)]
pub(super) struct VectorColumns {
    /// The columns.
    pub columns: Range<usize>,
    /// Their first variable.
    start: usize,
    /// Their vectors.
    width: usize,
    /// `L` row by row: of the columns themselves, then of the vectors below.
    values: Vec<f64>,
    /// First variables of vectors below that stand side by side, and how many there are.
    rows: Vec<(usize, usize)>,
    /// Blocks below that depend on the direction.
    others: Vec<DirectedBlock>,
}

/// A block of `L` with a number for each pair of variables.
#[derive(Clone, Copy, Debug)]
struct DirectedBlock {
    /// Variables of its column, counted from the first of the columns, and of its row, from the first one after them.
    column: usize,
    row: usize,
    /// Its first number in the values, its rows and columns.
    at: usize,
    rows: usize,
    columns: usize,
}

/// How a vector is multiplied.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sweep {
    /// By `L^-1`.
    Forward,
    /// By `L^-T`.
    Backward,
    /// By `L`.
    Multiply,
    /// By `L^T`.
    MultiplyTransposed,
}

/// Whether a block of so many columns is numbers times the identity of space; of a diagonal block what is below the diagonal is read.
fn is_isotropic(block: &[f64], columns: usize, is_diagonal: bool) -> bool {
    let read = |r: usize| if is_diagonal { r } else { columns };
    let sizes = (block.len() / columns, columns);
    is_isotropic_below::<SPACE>(sizes, read, |r, c| block[r * columns + c])
}

/// Whether the diagonal block of a column is numbers times the identity of space.
fn is_of_vectors(column: &Column, values: &[f64]) -> bool {
    let block = &values[column.at..column.at + column.size * column.size];
    is_isotropic(block, column.size, true)
}

impl VectorColumns {
    /// The columns from one on that go together; nothing where that is not worth it. `counts` tells which columns may be taken.
    pub fn new(
        pattern: &Pattern,
        values: &[f64],
        first: usize,
        counts: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let columns = &pattern.columns;
        let fits = |j: usize| counts(j) && is_of_vectors(&columns[j], values);
        let goes_on = |j: usize| {
            let own = &pattern.rows[columns[j].rows.clone()];
            let next = columns.get(j + 1).map(|next| next.rows.len());
            own.first().is_some_and(|row| row.column == j + 1) && next == Some(own.len() - 1)
        };
        if !fits(first) {
            return None;
        }
        let (mut last, mut size) = (first, columns[first].size);
        while goes_on(last) && fits(last + 1) && size + columns[last + 1].size <= SPACE * WIDEST {
            let below = pattern.rows[columns[last].rows.start].at;
            let block = &values[below..below + columns[last].size * columns[last + 1].size];
            if !is_isotropic(block, columns[last].size, false) {
                break;
            }
            last += 1;
            size += columns[last].size;
        }
        let made = Self::of(pattern, values, first..last + 1, size / SPACE);
        let is_worth =
            made.width <= WIDEST && made.values.len() - made.width * made.width >= FEWEST;
        is_worth.then_some(made)
    }

    /// These columns, which have the same rows below.
    fn of(pattern: &Pattern, values: &[f64], columns: Range<usize>, width: usize) -> Self {
        let own = &pattern.columns[columns.clone()];
        let (start, last) = (own[0].start, &own[own.len() - 1]);
        let end = last.start + last.size;
        let mut made = Self {
            columns: columns.clone(),
            start,
            width,
            values: vec![0.0; width * width],
            rows: Vec::new(),
            others: Vec::new(),
        };
        for column in own {
            let to = (column.start - start) / SPACE;
            let diagonal = &values[column.at..column.at + column.size * column.size];
            made.put(to, (to, diagonal), column.size);
            let among = pattern.rows[column.rows.clone()].iter();
            for row in among.filter(|row| row.column < columns.end) {
                let block = &values[row.at..row.at + row.size * column.size];
                made.put((row.start - start) / SPACE, (to, block), column.size);
            }
        }
        for (number, row) in pattern.rows[last.rows.clone()].iter().enumerate() {
            let block = |column: &Column| {
                let rows = &pattern.rows[column.rows.clone()];
                let at = rows[rows.len() - last.rows.len() + number].at;
                at..at + row.size * column.size
            };
            if !own
                .iter()
                .all(|c| is_isotropic(&values[block(c)], c.size, false))
            {
                made.others.extend(own.iter().map(|column| DirectedBlock {
                    column: column.start - start,
                    row: row.start - end,
                    at: block(column).start,
                    rows: row.size,
                    columns: column.size,
                }));
                continue;
            }
            let (line, count) = (made.values.len() / width, row.size / SPACE);
            made.values.resize((line + count) * width, 0.0);
            for column in own {
                let to = (column.start - start) / SPACE;
                made.put(line, (to, &values[block(column)]), column.size);
            }
            match made.rows.last_mut() {
                Some((from, so_many)) if *from + SPACE * *so_many == row.start => *so_many += count,
                _ => made.rows.push((row.start, count)),
            }
        }
        made
    }

    /// Puts the numbers of a block from a row and a column on.
    fn put(&mut self, line: usize, (to, block): (usize, &[f64]), columns: usize) {
        for (r, row) in block.chunks_exact(columns).step_by(SPACE).enumerate() {
            for (c, value) in row.iter().step_by(SPACE).enumerate() {
                self.values[(line + r) * self.width + to + c] = *value;
            }
        }
    }

    /// Variables of the columns.
    #[cfg(test)]
    pub fn variables(&self) -> usize {
        SPACE * self.width
    }

    /// Multiplies the vector `x`; `factor` are the values of the factor.
    pub fn apply(&self, sweep: Sweep, factor: &[f64], x: &mut [f64]) {
        vectorized(Apply {
            columns: self,
            sweep,
            factor,
            x,
        });
    }

    #[inline(always)]
    fn sweep<const W: usize>(&self, sweep: Sweep, factor: &[f64], x: &mut [f64]) {
        let end = self.start + SPACE * W;
        let (own, later) = x.split_at_mut(end);
        let own = &mut own[self.start..];
        let lines = self.values.as_chunks::<W>().0;
        let (triangle, below) = lines.split_at(W);
        match sweep {
            Sweep::Forward => {
                let mut of = read::<W>(own);
                for r in 1..W {
                    for c in 0..r {
                        of[r] = plus(of[r], -triangle[r][c], of[c]);
                    }
                }
                write(&of, own);
                self.add_below::<W, true>(below, &of, (end, later));
                self.add_others::<true>(factor, own, later);
            }
            Sweep::Backward => {
                self.add_from_others::<true>(factor, own, later);
                let mut of = read::<W>(own);
                self.add_from_below::<W, true>(below, &mut of, (end, later));
                for r in (1..W).rev() {
                    for c in 0..r {
                        of[c] = plus(of[c], -triangle[r][c], of[r]);
                    }
                }
                write(&of, own);
            }
            Sweep::Multiply => {
                let mut of = read::<W>(own);
                self.add_below::<W, false>(below, &of, (end, later));
                self.add_others::<false>(factor, own, later);
                for r in (1..W).rev() {
                    for c in 0..r {
                        of[r] = plus(of[r], triangle[r][c], of[c]);
                    }
                }
                write(&of, own);
            }
            Sweep::MultiplyTransposed => {
                let mut of = read::<W>(own);
                for r in 1..W {
                    for c in 0..r {
                        of[c] = plus(of[c], triangle[r][c], of[r]);
                    }
                }
                self.add_from_below::<W, false>(below, &mut of, (end, later));
                write(&of, own);
                self.add_from_others::<false>(factor, own, later);
            }
        }
    }

    /// Adds, or takes away, what the columns give to the vectors below.
    #[inline(always)]
    fn add_below<const W: usize, const AWAY: bool>(
        &self,
        below: &[[f64; W]],
        of: &[Padded; W],
        (end, later): (usize, &mut [f64]),
    ) {
        let mut lines = below.iter();
        for (start, count) in &self.rows {
            let vectors = &mut later[start - end..][..SPACE * count];
            for (vector, line) in vectors
                .as_chunks_mut::<SPACE>()
                .0
                .iter_mut()
                .zip(&mut lines)
            {
                let mut sum = padded(vector);
                for c in 0..W {
                    sum = plus(sum, signed::<AWAY>(line[c]), of[c]);
                }
                *vector = [sum[0], sum[1], sum[2]];
            }
        }
    }

    /// Adds, or takes away, what the vectors below give to the columns.
    #[inline(always)]
    fn add_from_below<const W: usize, const AWAY: bool>(
        &self,
        below: &[[f64; W]],
        of: &mut [Padded; W],
        (end, later): (usize, &[f64]),
    ) {
        let (mut lines, mut sums) = (below.iter(), *of);
        for (start, count) in &self.rows {
            let vectors = &later[start - end..][..SPACE * count];
            for (vector, line) in vectors.as_chunks::<SPACE>().0.iter().zip(&mut lines) {
                let vector = padded(vector);
                for c in 0..W {
                    sums[c] = plus(sums[c], signed::<AWAY>(line[c]), vector);
                }
            }
        }
        *of = sums;
    }

    #[inline(always)]
    fn add_others<const AWAY: bool>(&self, factor: &[f64], own: &[f64], later: &mut [f64]) {
        for block in &self.others {
            let own = &own[block.column..][..block.columns];
            let later = &mut later[block.row..][..block.rows];
            let lines = factor[block.at..].chunks_exact(block.columns);
            for (sum, line) in later.iter_mut().zip(lines) {
                for (own, value) in own.iter().zip(line) {
                    *sum += signed::<AWAY>(*value) * own;
                }
            }
        }
    }

    #[inline(always)]
    fn add_from_others<const AWAY: bool>(&self, factor: &[f64], own: &mut [f64], later: &[f64]) {
        for block in &self.others {
            let own = &mut own[block.column..][..block.columns];
            let later = &later[block.row..][..block.rows];
            let lines = factor[block.at..].chunks_exact(block.columns);
            for (later, line) in later.iter().zip(lines) {
                for (sum, value) in own.iter_mut().zip(line) {
                    *sum += signed::<AWAY>(*value) * later;
                }
            }
        }
    }
}

/// [`VectorColumns::apply`].
struct Apply<'a> {
    columns: &'a VectorColumns,
    sweep: Sweep,
    factor: &'a [f64],
    x: &'a mut [f64],
}

impl Vectorized for Apply<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Self {
            columns,
            sweep,
            factor,
            x,
        } = self;
        of_size!([1 2 3 4 5 6 7] or 8, columns.width, W => columns.sweep::<W>(sweep, factor, x));
    }
}

/// A number or what is less by it.
#[inline(always)]
fn signed<const AWAY: bool>(value: f64) -> f64 {
    if AWAY { -value } else { value }
}

/// `a + k b`.
#[inline(always)]
fn plus(a: Padded, k: f64, b: Padded) -> Padded {
    std::array::from_fn(|d| a[d] + k * b[d])
}

#[inline(always)]
fn padded([x, y, z]: &[f64; SPACE]) -> Padded {
    [*x, *y, *z, 0.0]
}

#[inline(always)]
fn read<const W: usize>(own: &[f64]) -> [Padded; W] {
    let own = own.as_chunks::<SPACE>().0;
    std::array::from_fn(|c| padded(&own[c]))
}

#[inline(always)]
fn write<const W: usize>(of: &[Padded; W], own: &mut [f64]) {
    for (own, of) in own.as_chunks_mut::<SPACE>().0.iter_mut().zip(of) {
        own.copy_from_slice(&of[..SPACE]);
    }
}

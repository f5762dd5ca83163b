//! The loops over stored blocks. A column of `size` variables is one matrix of `size` numbers per
//! row: its diagonal block first, then its blocks below.

use super::pattern::{Column, Pattern, Step, of_size};
use super::{Number, chains, panels};

/// Rule for pivots: takes a variable and its pivot, and returns the inverse of the pivot. Zero drops the row, `None`
/// ends the factorization.
pub(super) trait Pivots<T>: FnMut(usize, T) -> Option<T> {}

impl<T, F: FnMut(usize, T) -> Option<T>> Pivots<T> for F {}

/// Does something with the size of a column, known when compiling where it is a common one.
macro_rules! of_any_size {
    ([$($common:literal)*] $size:expr, $n:ident => $call:expr) => {
        match $size {
            $($common => {
                let $n = $common;
                $call
            })*
            $n => $call,
        }
    };
    ($size:expr, $n:ident => $call:expr) => {
        of_any_size!([1 2 3 4 5 6] $size, $n => $call)
    };
}

pub(super) use of_any_size;

/// L D L^T in place, column after column; nothing where a pivot ends it.
pub(super) fn factor<T: Number>(
    pattern: &Pattern,
    (values, scratch): (&mut [T], &mut [f64]),
    pivots: &mut impl Pivots<T>,
) -> Option<()> {
    let mut panels = pattern.panels.iter().peekable();
    for step in &pattern.steps {
        match step {
            Step::Chain {
                size,
                values: run,
                variables,
            } => {
                let run = &mut values[run.start..run.end + size * size];
                of_size!(size, B => chains::factor::<T, B>(run, variables.start, pivots)?);
            }
            Step::Column(j) => {
                if let Some(panel) = panels.peek()
                    && panel.columns.contains(j)
                {
                    if *j + 1 == panel.columns.end {
                        panels::factor(pattern, panel, (values, scratch), pivots)?;
                        panels.next();
                    }
                    continue;
                }
                let column = &pattern.columns[*j];
                of_any_size!(column.size, n => factor_column(n, pattern, column, values, pivots)?);
            }
        }
    }
    Some(())
}

/// `x <- L^-1 x` over some steps.
pub(super) fn forward<T: Number>(pattern: &Pattern, steps: &[Step], values: &[T], x: &mut [T]) {
    for step in steps {
        if lone_number(pattern, step).is_none() {
            forward_step(pattern, step, values, x);
        }
    }
}

/// `x <- L^-T x`, or `x <- L^-T D^-1 x` if `SCALE`, over some steps.
pub(super) fn backward<T: Number, const SCALE: bool>(
    pattern: &Pattern,
    steps: &[Step],
    values: &[T],
    x: &mut [T],
) {
    for step in steps.iter().rev() {
        match lone_number(pattern, step) {
            None => backward_step::<T, SCALE>(pattern, step, values, x),
            Some(column) if SCALE => x[column.start] = x[column.start] * values[column.at],
            Some(_) => {}
        }
    }
}

/// The column of a step, where that is a single variable that nothing after it is coupled with.
#[inline(always)]
fn lone_number<'a>(pattern: &'a Pattern, step: &Step) -> Option<&'a Column> {
    match step {
        Step::Column(j) => {
            let column = &pattern.columns[*j];
            (column.size == 1 && column.rows.is_empty()).then_some(column)
        }
        Step::Chain { .. } => None,
    }
}

/// Not inlined: what saves registers for all sizes would cost single numbers more than their work.
#[inline(never)]
fn forward_step<T: Number>(pattern: &Pattern, step: &Step, values: &[T], x: &mut [T]) {
    match step {
        Step::Chain {
            size,
            values: run,
            variables,
        } => {
            let x = &mut x[variables.start..variables.end + size];
            of_size!(size, B => chains::forward::<T, B>(&values[run.clone()], x));
        }
        Step::Column(j) => {
            let column = &pattern.columns[*j];
            of_any_size!(column.size, n => forward_column(n, pattern, column, values, x));
        }
    }
}

#[inline(never)]
fn backward_step<T: Number, const SCALE: bool>(
    pattern: &Pattern,
    step: &Step,
    values: &[T],
    x: &mut [T],
) {
    match step {
        Step::Chain {
            size,
            values: run,
            variables,
        } => {
            let x = &mut x[variables.start..variables.end + size];
            of_size!(size, B => chains::backward::<T, B, SCALE>(&values[run.clone()], x));
        }
        Step::Column(j) => {
            let column = &pattern.columns[*j];
            of_any_size!(column.size, n => {
                backward_column::<T, SCALE>(n, pattern, column, values, x);
            });
        }
    }
}

/// `y = A x`.
pub(super) fn multiply<T: Number>(pattern: &Pattern, values: &[T], x: &[T], y: &mut [T]) {
    y.fill(T::from(0.0));
    for step in &pattern.steps {
        match step {
            Step::Chain {
                size,
                values: run,
                variables,
            } => {
                let variables = variables.start..variables.end + size;
                let (x, y) = (&x[variables.clone()], &mut y[variables]);
                of_size!(size, B => chains::multiply::<T, B>(&values[run.clone()], x, y));
            }
            Step::Column(j) => multiply_column(pattern, &pattern.columns[*j], values, x, y),
        }
    }
}

/// Every row is solved for its part of L D, which changes the later columns, then made one of L.
#[inline(always)]
fn factor_column<T: Number>(
    size: usize,
    pattern: &Pattern,
    column: &Column,
    values: &mut [T],
    pivots: &mut impl Pivots<T>,
) -> Option<()> {
    let (diagonal, rest) = values[column.at..].split_at_mut(size * size);
    factor_diagonal(size, diagonal, column.start, pivots)?;
    let rows = &pattern.rows[column.rows.clone()];
    let height: usize = rows.iter().map(|row| row.size).sum();
    let (panel, later) = rest.split_at_mut(height * size);
    let offset = column.at + (size + height) * size;
    let mut targets = pattern.targets[column.targets..].iter();
    let mut top = 0;
    for (a, row) in rows.iter().enumerate() {
        let (above, block) = panel[..(top + row.size) * size].split_at_mut(top * size);
        for line in block.chunks_exact_mut(size) {
            substitute(size, diagonal, line);
        }
        let mut above = &above[..];
        for (left, target) in rows[..a].iter().zip(&mut targets) {
            let (other, remaining) = above.split_at(left.size * size);
            above = remaining;
            let target = &mut later[target - offset..][..row.size * left.size];
            let lines = block.chunks_exact(size);
            for (line, target) in lines.zip(target.chunks_exact_mut(left.size)) {
                for (value, other) in target.iter_mut().zip(other.chunks_exact(size)) {
                    *value = *value - dot(line, other);
                }
            }
        }
        if let Some(target) = targets.next() {
            let target = &mut later[target - offset..][..row.size * row.size];
            for (r, target) in target.chunks_exact_mut(row.size).enumerate() {
                let (done, line) = block.split_at_mut(r * size);
                let line = &mut line[..size];
                for (value, other) in target.iter_mut().zip(done.chunks_exact(size)) {
                    *value = *value - dot(line, other);
                }
                target[r] = target[r] - normalize(size, diagonal, line);
            }
        }
        top += row.size;
    }
    Some(())
}

/// L D L^T of a diagonal block from its lower triangle; the diagonal becomes the inverse pivots.
#[inline(always)]
fn factor_diagonal<T: Number>(
    size: usize,
    diagonal: &mut [T],
    start: usize,
    pivots: &mut impl Pivots<T>,
) -> Option<()> {
    for i in 0..size {
        let (above, rest) = diagonal.split_at_mut(i * size);
        let line = &mut rest[..size];
        for j in 1..i {
            line[j] = line[j] - dot(&line[..j], &above[j * size..j * size + j]);
        }
        let mut pivot = line[i];
        for k in 0..i {
            let scaled = line[k] * above[k * size + k];
            pivot = pivot - scaled * line[k];
            line[k] = scaled;
        }
        line[i] = pivots(start + i, pivot)?;
    }
    Some(())
}

/// Forward substitution with the unit lower triangle of a factored diagonal block.
#[inline(always)]
fn substitute<T: Number>(size: usize, diagonal: &[T], line: &mut [T]) {
    for j in 1..size {
        line[j] = line[j] - dot(&line[..j], &diagonal[j * size..j * size + j]);
    }
}

/// Multiplies a row of L D by the inverse pivots; returns its product with what results.
#[inline(always)]
fn normalize<T: Number>(size: usize, diagonal: &[T], line: &mut [T]) -> T {
    let mut sum = T::from(0.0);
    for k in 0..size {
        let scaled = line[k] * diagonal[k * size + k];
        sum = sum + scaled * line[k];
        line[k] = scaled;
    }
    sum
}

#[inline(always)]
fn forward_column<T: Number>(
    size: usize,
    pattern: &Pattern,
    column: &Column,
    values: &[T],
    x: &mut [T],
) {
    let (diagonal, mut rest) = values[column.at..].split_at(size * size);
    let offset = column.start + size;
    let (x, later) = x.split_at_mut(offset);
    let x = &mut x[offset - size..];
    substitute(size, diagonal, x);
    for row in &pattern.rows[column.rows.clone()] {
        let (block, remaining) = rest.split_at(row.size * size);
        rest = remaining;
        let y = &mut later[row.start - offset..][..row.size];
        for (y, line) in y.iter_mut().zip(block.chunks_exact(size)) {
            *y = *y - dot(line, x);
        }
    }
}

#[inline(always)]
fn backward_column<T: Number, const SCALE: bool>(
    size: usize,
    pattern: &Pattern,
    column: &Column,
    values: &[T],
    x: &mut [T],
) {
    let (diagonal, mut rest) = values[column.at..].split_at(size * size);
    let offset = column.start + size;
    let (x, later) = x.split_at_mut(offset);
    let x = &mut x[offset - size..];
    if SCALE {
        for k in 0..size {
            x[k] = x[k] * diagonal[k * size + k];
        }
    }
    for row in &pattern.rows[column.rows.clone()] {
        let (block, remaining) = rest.split_at(row.size * size);
        rest = remaining;
        let y = &later[row.start - offset..][..row.size];
        for (y, line) in y.iter().zip(block.chunks_exact(size)) {
            for (x, entry) in x.iter_mut().zip(line) {
                *x = *x - *entry * *y;
            }
        }
    }
    for r in (1..size).rev() {
        for c in 0..r {
            x[c] = x[c] - diagonal[r * size + c] * x[r];
        }
    }
}

/// Adds what the blocks of a column and their transposes give in `A x`.
fn multiply_column<T: Number>(
    pattern: &Pattern,
    column: &Column,
    values: &[T],
    x: &[T],
    y: &mut [T],
) {
    let size = column.size;
    let (diagonal, mut rest) = values[column.at..].split_at(size * size);
    let end = column.start + size;
    let (y, later) = y.split_at_mut(end);
    let y = &mut y[column.start..];
    let own = &x[column.start..end];
    for (y, line) in y.iter_mut().zip(diagonal.chunks_exact(size)) {
        *y = *y + dot(line, own);
    }
    for row in &pattern.rows[column.rows.clone()] {
        let (block, remaining) = rest.split_at(row.size * size);
        rest = remaining;
        let x = &x[row.start..row.start + row.size];
        let later = &mut later[row.start - end..][..row.size];
        for ((line, x), later) in block.chunks_exact(size).zip(x).zip(later) {
            *later = *later + dot(line, own);
            for (y, entry) in y.iter_mut().zip(line) {
                *y = *y + *entry * *x;
            }
        }
    }
}

/// The part of one column in `x <- L x`; later columns come first.
pub(super) fn multiply_lower(pattern: &Pattern, column: &Column, values: &[f64], x: &mut [f64]) {
    of_any_size!(column.size, n => lower_column(n, pattern, column, values, x));
}

#[inline(always)]
fn lower_column(size: usize, pattern: &Pattern, column: &Column, values: &[f64], x: &mut [f64]) {
    let start = column.start;
    let (diagonal, mut rest) = values[column.at..].split_at(size * size);
    let end = start + size;
    let (x, later) = x.split_at_mut(end);
    let x = &mut x[start..];
    for row in &pattern.rows[column.rows.clone()] {
        let (block, remaining) = rest.split_at(row.size * size);
        rest = remaining;
        let y = &mut later[row.start - end..][..row.size];
        for (y, line) in y.iter_mut().zip(block.chunks_exact(size)) {
            *y += dot(line, x);
        }
    }
    for r in (1..size).rev() {
        x[r] += dot(&diagonal[r * size..r * size + r], &x[..r]);
    }
}

/// The part of one column in `x <- L^T x`; earlier columns come first.
pub(super) fn multiply_lower_transposed(
    pattern: &Pattern,
    column: &Column,
    values: &[f64],
    x: &mut [f64],
) {
    of_any_size!(column.size, n => transposed_column(n, pattern, column, values, x));
}

#[inline(always)]
fn transposed_column(
    size: usize,
    pattern: &Pattern,
    column: &Column,
    values: &[f64],
    x: &mut [f64],
) {
    let (diagonal, mut rest) = values[column.at..].split_at(size * size);
    let end = column.start + size;
    let (x, later) = x.split_at_mut(end);
    let x = &mut x[column.start..];
    for r in 1..size {
        for c in 0..r {
            x[c] += diagonal[r * size + c] * x[r];
        }
    }
    for row in &pattern.rows[column.rows.clone()] {
        let (block, remaining) = rest.split_at(row.size * size);
        rest = remaining;
        let y = &later[row.start - end..][..row.size];
        for (y, line) in y.iter().zip(block.chunks_exact(size)) {
            for (x, entry) in x.iter_mut().zip(line) {
                *x += entry * y;
            }
        }
    }
}

#[inline(always)]
fn dot<T: Number>(a: &[T], b: &[T]) -> T {
    let mut sum = T::from(0.0);
    for (a, b) in a.iter().zip(b) {
        sum = sum + *a * *b;
    }
    sum
}

//! Columns with the same rows below are factored together, as one dense panel in lanes: those of a mesh of a surface, whose columns are high.
//!
//! Source: J. W. H. Liu, E. G. Ng, B. W. Peyton, On finding supernodes for sparse matrix computations, SIAM J. Matrix Anal. Appl. 14 (1993);
//! K. Goto, R. A. van de Geijn, Anatomy of high-performance matrix multiplication, ACM Trans. Math. Softw. 34 (2008) (tiles).

use std::ops::Range;

use super::Number;
use super::kernels::{Pivots, of_any_size};
use super::pattern::{Column, Pattern, PatternRow};
use crate::math::lanes::{Simd, Vectorized, vectorized};

/// Most variables of a panel.
const WIDEST: usize = 48;

/// Fewest variables of a panel, and fewest below it: what is smaller is quicker block by block.
const NARROWEST: usize = 8;
const LOWEST: usize = 60;

/// Vectors of lanes that are summed at once, so that no sum waits for the one before.
const WIDE: usize = 4;

/// Rows and vectors of lanes of a tile of a product of real numbers, and of complex ones: as many sums as registers hold besides what they
/// are made of.
const REAL: usize = 3;
const COMPLEX: usize = 2;

/// The most numbers side by side, on processors with eight lanes.
const STRIDE: usize = 8 * WIDE;

/// Columns that are factored together. Each has the next ones and the rows of the last one below it.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    /// The columns.
    pub columns: Range<usize>,
    /// Their variables.
    width: usize,
    /// Variables of the rows below the last one.
    height: usize,
    /// Most variables of such a row.
    highest_row: usize,
}

impl Panel {
    /// Numbers from a column of the panel to the next one.
    fn lead(&self) -> usize {
        (self.width + self.height).next_multiple_of(STRIDE) + STRIDE
    }

    /// Numbers of scratch that its factorization takes.
    pub fn scratch(&self) -> usize {
        (2 * self.width + self.highest_row) * self.lead()
    }
}

/// The panels of a pattern.
pub(super) fn panels(columns: &[Column], rows: &[PatternRow]) -> Vec<Panel> {
    let below = |j: usize| &rows[columns[j].rows.clone()];
    let goes_on = |j: usize| {
        let (own, next) = (below(j), columns.get(j + 1).map(|next| next.rows.len()));
        own.first().is_some_and(|row| row.column == j + 1) && next == Some(own.len() - 1)
    };
    let (mut panels, mut first) = (Vec::new(), 0);
    while first < columns.len() {
        let (mut last, mut width) = (first, columns[first].size);
        while goes_on(last) && width + columns[last + 1].size <= WIDEST {
            last += 1;
            width += columns[last].size;
        }
        let sizes = || below(last).iter().map(|row| row.size);
        let height = sizes().sum();
        if last > first && width >= NARROWEST && height >= LOWEST {
            panels.push(Panel {
                columns: first..last + 1,
                width,
                height,
                highest_row: sizes().max().unwrap_or(0),
            });
        }
        first = last + 1;
    }
    panels
}

/// L D L^T of the columns of a panel in place, and their products taken out of the later columns. Nothing where a pivot ends it.
pub(super) fn factor<T: Number>(
    pattern: &Pattern,
    panel: &Panel,
    (values, scratch): (&mut [T], &mut [f64]),
    pivots: &mut impl Pivots<T>,
) -> Option<()> {
    let mut outcome = None;
    vectorized(FactorPanel {
        pattern,
        panel,
        values,
        scratch,
        pivots,
        outcome: &mut outcome,
    });
    outcome
}

/// [`factor`].
struct FactorPanel<'a, T, P> {
    pattern: &'a Pattern,
    panel: &'a Panel,
    values: &'a mut [T],
    scratch: &'a mut [f64],
    pivots: &'a mut P,
    outcome: &'a mut Option<()>,
}

impl<T: Number, P: Pivots<T>> Vectorized for FactorPanel<'_, T, P> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let outcome = if T::PARTS == 1 {
            Dense::<S, 1>::new(simd, self.panel, self.scratch).factor(
                self.pattern,
                self.values,
                self.pivots,
            )
        } else {
            Dense::<S, 2>::new(simd, self.panel, self.scratch).factor(
                self.pattern,
                self.values,
                self.pivots,
            )
        };
        *self.outcome = outcome;
    }
}

/// Numbers in lanes by their parts: real, and imaginary where they are complex.
type LaneParts<S, const P: usize> = [<S as Simd>::f64s; P];

/// A dense panel by columns, real and imaginary parts apart.
struct Dense<'a, S, const P: usize> {
    simd: S,
    panel: &'a Panel,
    lead: usize,
    /// `L`, and `L D`.
    lower: &'a mut [f64],
    scaled: &'a mut [f64],
    /// Products of the rows of a vertex below the panel with those before and itself, row by row.
    strip: &'a mut [f64],
}

impl<'a, S: Simd, const P: usize> Dense<'a, S, P> {
    #[inline(always)]
    fn new(simd: S, panel: &'a Panel, scratch: &'a mut [f64]) -> Self {
        let lead = panel.lead();
        let size = P * panel.width * lead;
        let (lower, rest) = scratch.split_at_mut(size);
        let (scaled, strip) = rest.split_at_mut(size);
        Self {
            simd,
            panel,
            lead,
            lower,
            scaled,
            strip: &mut strip[..P * panel.highest_row * lead],
        }
    }

    /// Numbers of a part.
    #[inline(always)]
    fn plane(&self) -> usize {
        self.panel.width * self.lead
    }

    #[inline(always)]
    fn factor<T: Number>(
        &mut self,
        pattern: &Pattern,
        values: &mut [T],
        pivots: &mut impl Pivots<T>,
    ) -> Option<()> {
        self.gather(pattern, values);
        let start = pattern.columns[self.panel.columns.start].start;
        for c in 0..self.panel.width {
            self.reduce(c);
            let at = c * self.lead + c;
            let mut pivot = [0.0; 2];
            for p in 0..P {
                pivot[p] = self.scaled[p * self.plane() + at];
            }
            let inverse = pivots(start + c, T::from_parts(pivot))?.parts();
            self.normalize(c, inverse);
        }
        self.scatter(pattern, values);
        self.reduce_later(pattern, values);
        Some(())
    }

    /// Copies the columns of the panel. Each stands row by row, its rows are the last ones of the panel.
    #[inline(always)]
    fn gather<T: Number>(&mut self, pattern: &Pattern, values: &[T]) {
        self.scaled.fill(0.0);
        let (plane, total) = (self.plane(), self.panel.width + self.panel.height);
        let mut first = 0;
        for column in &pattern.columns[self.panel.columns.clone()] {
            let size = column.size;
            let block = &values[column.at..column.at + (total - first) * size];
            for (r, row) in block.chunks_exact(size).enumerate() {
                for (c, value) in row.iter().enumerate() {
                    let parts = value.parts();
                    for p in 0..P {
                        self.scaled[p * plane + (first + c) * self.lead + first + r] = parts[p];
                    }
                }
            }
            first += size;
        }
    }

    /// Copies the columns of `L` back, with the inverse pivots, which stand on the diagonal of `lower`.
    #[inline(always)]
    fn scatter<T: Number>(&self, pattern: &Pattern, values: &mut [T]) {
        let (plane, total) = (self.plane(), self.panel.width + self.panel.height);
        let mut first = 0;
        for column in &pattern.columns[self.panel.columns.clone()] {
            let size = column.size;
            let block = &mut values[column.at..column.at + (total - first) * size];
            for (r, row) in block.chunks_exact_mut(size).enumerate() {
                for (c, value) in row.iter_mut().enumerate() {
                    let mut parts = [0.0; 2];
                    for p in 0..P {
                        parts[p] = self.lower[p * plane + (first + c) * self.lead + first + r];
                    }
                    *value = T::from_parts(parts);
                }
            }
            first += size;
        }
    }

    /// Takes the columns before out of one.
    #[inline(always)]
    fn reduce(&mut self, c: usize) {
        let (simd, lead, plane) = (self.simd, self.lead, self.plane());
        let width = WIDE * S::F64_LANES;
        let end = self.panel.width + self.panel.height;
        for row in (c..end).step_by(width) {
            let mut sum = [[simd.splat_f64s(0.0); P]; WIDE];
            let at = c * lead + row;
            for p in 0..P {
                let from = S::as_simd_f64s(&self.scaled[p * plane + at..][..width]).0;
                for v in 0..WIDE {
                    sum[v][p] = from[v];
                }
            }
            for k in 0..c {
                let mut factor = [simd.splat_f64s(0.0); P];
                for p in 0..P {
                    factor[p] = simd.splat_f64s(-self.scaled[p * plane + k * lead + c]);
                }
                let column = &*self.lower;
                let mut parts = [[simd.splat_f64s(0.0); P]; WIDE];
                for p in 0..P {
                    let from = S::as_simd_f64s(&column[p * plane + k * lead + row..][..width]).0;
                    for v in 0..WIDE {
                        parts[v][p] = from[v];
                    }
                }
                for v in 0..WIDE {
                    sum[v] = plus_product(simd, sum[v], parts[v], factor);
                }
            }
            for p in 0..P {
                let to = &mut self.scaled[p * plane + at..][..width];
                let to = S::as_mut_simd_f64s(to).0;
                for v in 0..WIDE {
                    to[v] = sum[v][p];
                }
            }
        }
    }

    /// Makes a column of `L` of one of `L D`.
    #[inline(always)]
    fn normalize(&mut self, c: usize, inverse: [f64; 2]) {
        let (simd, plane) = (self.simd, self.plane());
        let zero = [simd.splat_f64s(0.0); P];
        let mut factor = zero;
        for p in 0..P {
            factor[p] = simd.splat_f64s(inverse[p]);
        }
        let end = self.panel.width + self.panel.height;
        for row in (c..end).step_by(S::F64_LANES) {
            let at = c * self.lead + row;
            let mut number = zero;
            for p in 0..P {
                number[p] = S::as_simd_f64s(&self.scaled[p * plane + at..][..S::F64_LANES]).0[0];
            }
            let number = plus_product(simd, zero, number, factor);
            for p in 0..P {
                let to = &mut self.lower[p * plane + at..][..S::F64_LANES];
                S::as_mut_simd_f64s(to).0[0] = number[p];
            }
        }
        for p in 0..P {
            self.lower[p * plane + c * self.lead + c] = inverse[p];
        }
    }

    /// Takes the products of the panel's rows out of the later columns.
    #[inline(always)]
    fn reduce_later<T: Number>(&mut self, pattern: &Pattern, values: &mut [T]) {
        let last = &pattern.columns[self.panel.columns.end - 1];
        let rows = &pattern.rows[last.rows.clone()];
        let mut targets = pattern.targets[last.targets..].iter();
        let mut end = 0;
        for (a, row) in rows.iter().enumerate() {
            let first = end;
            end += row.size;
            let tile = if P == 1 { REAL } else { COMPLEX };
            let whole = row.size / tile * tile;
            for r in (0..whole).step_by(tile) {
                if P == 1 {
                    self.multiply::<REAL, REAL>((r, first + r), end);
                } else {
                    self.multiply::<COMPLEX, COMPLEX>((r, first + r), end);
                }
            }
            for r in whole..row.size {
                self.multiply::<1, COMPLEX>((r, first + r), end);
            }
            let mut from = 0;
            for (left, target) in rows[..=a].iter().zip(&mut targets) {
                let block = &mut values[*target..*target + row.size * left.size];
                of_any_size!(left.size, n => self.subtract(n, from, block));
                from += left.size;
            }
        }
    }

    /// Products of `R` rows with all up to an end, `V` vectors at once, into the strip.
    #[inline(always)]
    fn multiply<const R: usize, const V: usize>(&mut self, at: (usize, usize), end: usize) {
        for column in (0..end).step_by(V * S::F64_LANES) {
            self.tile::<R, V>(at, column);
        }
    }

    /// Products of `R` rows with `V` vectors of rows.
    #[inline(always)]
    fn tile<const R: usize, const V: usize>(&mut self, (to, row): (usize, usize), column: usize) {
        let (simd, lead, plane) = (self.simd, self.lead, self.plane());
        let (width, skip) = (V * S::F64_LANES, self.panel.width);
        let zero = [simd.splat_f64s(0.0); P];
        let mut sums = [[zero; V]; R];
        for k in 0..self.panel.width {
            let base = k * lead + skip;
            let mut right = [zero; V];
            for p in 0..P {
                let at = p * plane + base + column;
                let from = S::as_simd_f64s(&self.lower[at..at + width]).0;
                for v in 0..V {
                    right[v][p] = from[v];
                }
            }
            for r in 0..R {
                let mut left = zero;
                for p in 0..P {
                    left[p] = simd.splat_f64s(self.scaled[p * plane + base + row + r]);
                }
                for v in 0..V {
                    sums[r][v] = plus_product(simd, sums[r][v], right[v], left);
                }
            }
        }
        let plane = self.panel.highest_row * lead;
        for r in 0..R {
            for p in 0..P {
                let strip = &mut self.strip[p * plane + (to + r) * lead + column..][..width];
                let strip = S::as_mut_simd_f64s(strip).0;
                for v in 0..V {
                    strip[v] = sums[r][v][p];
                }
            }
        }
    }

    /// Takes columns of the strip out of a block.
    #[inline(always)]
    fn subtract<T: Number>(&self, size: usize, from: usize, block: &mut [T]) {
        let plane = self.panel.highest_row * self.lead;
        for (r, row) in block.chunks_exact_mut(size).enumerate() {
            let at = r * self.lead + from;
            let real = &self.strip[at..at + size];
            if P == 1 {
                for (value, real) in row.iter_mut().zip(real) {
                    *value = *value - T::from_parts([*real, 0.0]);
                }
            } else {
                let imaginary = &self.strip[plane + at..][..size];
                for (value, (real, imaginary)) in row.iter_mut().zip(real.iter().zip(imaginary)) {
                    *value = *value - T::from_parts([*real, *imaginary]);
                }
            }
        }
    }
}

/// `sum + a b`.
#[inline(always)]
fn plus_product<S: Simd, const P: usize>(
    simd: S,
    mut sum: LaneParts<S, P>,
    a: LaneParts<S, P>,
    b: LaneParts<S, P>,
) -> LaneParts<S, P> {
    sum[0] = simd.mul_add_e_f64s(a[0], b[0], sum[0]);
    if P == 2 {
        sum[0] = simd.negate_mul_add_e_f64s(a[1], b[1], sum[0]);
        sum[1] = simd.mul_add_e_f64s(a[0], b[1], sum[1]);
        sum[1] = simd.mul_add_e_f64s(a[1], b[0], sum[1]);
    }
    sum
}

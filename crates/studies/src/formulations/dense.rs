//! A transformation written out as one dense matrix; a scalar each for both directions of the plane.

use flexbody::bodies::no_node;
use flexbody::math::lanes::{Simd, Vectorized, vectorized};

use super::fronts::Fronts;
use super::rod::Node;

/// Columns that are added up side by side.
const LANES: usize = 4;

/// Rows of a matrix, one for every pair of the elements.
pub struct Dense {
    columns: usize,
    /// Row by row, each filled up with zeros to a multiple of [`LANES`].
    entries: Vec<f64>,
    padded: usize,
    /// Pairs of `q`, filled up likewise.
    pairs: Vec<[f64; 2]>,
}

impl Dense {
    /// `B Q2`, column by column.
    pub fn new(fronts: &Fronts, elements: usize) -> Self {
        let columns = fronts.coordinates() / 2;
        let padded = columns.next_multiple_of(LANES);
        let mut entries = vec![0.0; 4 * elements * padded];
        let mut unit = vec![0.0; 2 * columns];
        let mut u = vec![no_node(); 2 * elements];
        for column in 0..columns {
            unit[2 * column] = 1.0;
            fronts.prolong(&unit, &mut u);
            unit[2 * column] = 0.0;
            for (row, pair) in u.as_flattened().iter().enumerate() {
                entries[row * padded + column] = pair[0];
            }
        }
        Self {
            columns,
            entries,
            padded,
            pairs: vec![[0.0; 2]; padded],
        }
    }

    /// Numbers in `q`.
    pub fn coordinates(&self) -> usize {
        2 * self.columns
    }

    /// `u = B Q2 q`.
    pub fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        self.pairs[..self.columns].copy_from_slice(q.as_chunks::<2>().0);
        let dense = self;
        vectorized(Spread { dense, u });
    }

    /// `q = Q2^T B^T f`.
    pub fn restrict(&mut self, f: &[Node], q: &mut [f64]) {
        self.pairs.fill([0.0; 2]);
        let dense = self;
        vectorized(Gather { dense, f });
        q.as_chunks_mut::<2>()
            .0
            .copy_from_slice(&dense.pairs[..dense.columns]);
    }

    /// Bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.entries[..])
    }
}

struct Spread<'a> {
    dense: &'a Dense,
    u: &'a mut [Node],
}

impl Vectorized for Spread<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let dense = self.dense;
        let rows = dense.entries.chunks_exact(dense.padded);
        let u = self.u.as_flattened_mut();
        for (row, u) in rows.zip(u) {
            let mut sums = [[0.0; 2]; LANES];
            let chunks = row.as_chunks::<LANES>().0.iter();
            for (entries, pairs) in chunks.zip(dense.pairs.as_chunks::<LANES>().0) {
                for lane in 0..LANES {
                    sums[lane][0] += entries[lane] * pairs[lane][0];
                    sums[lane][1] += entries[lane] * pairs[lane][1];
                }
            }
            *u = sums
                .into_iter()
                .fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
        }
    }
}

struct Gather<'a> {
    dense: &'a mut Dense,
    f: &'a [Node],
}

impl Vectorized for Gather<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Dense {
            entries,
            padded,
            pairs,
            ..
        } = self.dense;
        let f = self.f.as_flattened();
        for (row, [x, y]) in entries.chunks_exact(*padded).zip(f) {
            for (entry, pair) in row.iter().zip(pairs.iter_mut()) {
                pair[0] += entry * x;
                pair[1] += entry * y;
            }
        }
    }
}

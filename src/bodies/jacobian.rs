//! Non-linear constraints in the coordinates `q`: rows of their Jacobian `J = C_x T`, short where bodies are many, and
//! the least change of `q` that satisfies them. `J J^T` is sparse: only constraints on one body meet in it.
//!
//! Rows may depend on each other, always or in singular configurations. In the elimination of `J J^T` the pivot of a
//! row is the square of what the rows before it leave of it; where that is too little the row drops out, and what
//! is left gives the solution of minimum norm. Each solution is refined once, since `J J^T` squares the condition.
//!
//! Sources: A. Bjorck, Numerical Methods for Least Squares Problems (1996), sections 2.7.4 (rank by the pivots) and
//! 6.6.5 (refinement of semi-normal equations).

use std::collections::BTreeMap;
use std::ops::Range;

use super::connectivity::Node;
use super::elimination::Elimination;
use crate::math::sparse::{Matrix, Pattern, Reach};
use crate::math::vector::short_dot;

/// Part of the square of a row that the heaviest body has of it, which a pivot is below where the row is dependent.
const OF_HEAVIEST: f64 = 1e-3;
/// Part of the square of a row below which a pivot is roundoff.
const ROUNDOFF: f64 = 1e-13;

/// Sparse rows over `q`.
#[derive(Clone, Debug)]
pub struct SparseRows {
    pieces: Vec<RowSegment>,
    /// Pieces of every row.
    of_row: Vec<Range<usize>>,
    values: Vec<f64>,
}

/// Numbers of a row that stand side by side.
#[derive(Clone, Debug)]
struct RowSegment {
    coordinates: Range<usize>,
    at: usize,
}

impl SparseRows {
    fn new(reaches: &[Reach]) -> Self {
        let (mut pieces, mut of_row, mut at) = (Vec::new(), Vec::new(), 0);
        for reach in reaches {
            let first = pieces.len();
            for range in &reach.variables {
                pieces.push(RowSegment {
                    coordinates: range.clone(),
                    at,
                });
                at += range.len();
            }
            of_row.push(first..pieces.len());
        }
        Self {
            pieces,
            of_row,
            values: vec![0.0; at],
        }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.of_row.len()
    }

    /// The numbers of a row that are not zero, piece by piece, and where they stand.
    pub fn pieces(&self, row: usize) -> impl Iterator<Item = (Range<usize>, &[f64])> {
        let pieces = self.pieces[self.of_row[row].clone()].iter();
        pieces.map(|piece| {
            let range = piece.coordinates.clone();
            (
                range.clone(),
                &self.values[piece.at..piece.at + range.len()],
            )
        })
    }

    /// Square of a row.
    pub fn square(&self, row: usize) -> f64 {
        let entries = self.pieces(row).flat_map(|(_, piece)| piece);
        entries.map(|entry| entry * entry).sum()
    }

    /// Product of a row with `q`.
    #[inline(always)]
    pub fn product(&self, row: usize, q: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (range, row) in self.pieces(row) {
            sum += short_dot(row, &q[range]);
        }
        sum
    }

    /// Adds a multiple of a row to `q`.
    #[inline(always)]
    pub fn add(&self, row: usize, factor: f64, q: &mut [f64]) {
        for (range, row) in self.pieces(row) {
            let pairs = q[range].iter_mut().zip(row);
            pairs.for_each(|(q, row)| *q += factor * row);
        }
    }

    /// Takes over the numbers of rows of the same structure.
    pub fn copy_from(&mut self, other: &Self) {
        self.values.copy_from_slice(&other.values);
    }
}

/// A part of the product of two rows, in numbers short enough for many to fit in the cache.
#[derive(Clone, Debug)]
struct Overlap {
    /// Entry of `J J^T`.
    entry: u32,
    /// Where the numbers of both rows stand, and how many.
    at: [u32; 2],
    length: u32,
}

/// The Jacobian and the factors of `J J^T`.
#[derive(Clone, Debug)]
pub struct Jacobian {
    rows: SparseRows,
    reaches: Vec<Reach>,
    /// Whether each row is the same in every configuration, and whether those rows are filled in.
    constant: Vec<bool>,
    is_begun: bool,
    /// Overlaps of two constant rows, and the others.
    fixed: Vec<Overlap>,
    moving: Vec<Overlap>,
    pattern: Pattern,
    /// `J J^T` of the constant rows.
    base: Matrix<f64>,
    factors: Matrix<f64>,
    /// Where rows stand in vectors over `pattern`.
    place: Vec<usize>,
    /// Where rows meet themselves.
    corners: Vec<usize>,
    /// How heavy the lightest body of each row is beside the heaviest one that rows connect it with.
    evenness: Vec<f64>,
    /// Squares of rows, what those before leave of them (the pivots) and at least must where a row counts, and whether each does, as
    /// `pattern` has them.
    squares: Vec<f64>,
    bounds: Vec<f64>,
    pivots: Vec<f64>,
    counts: Vec<bool>,
    /// The bound that `factors` were made with; nothing where rows have changed since.
    factored: Option<f64>,
    missing: Vec<f64>,
    lambda: Vec<f64>,
    /// Scratch: free coordinates, zero between calls.
    y: Vec<f64>,
}

impl Jacobian {
    /// Storage for some of the constraints of an assembly, with how heavy the lightest body of each is beside the heaviest one that they
    /// connect it with, and whether their rows are the same in every configuration.
    pub fn new<const D: usize>(
        elimination: &Elimination<D>,
        constraints: &[usize],
        evenness: Vec<f64>,
        is_constant: impl Fn(usize) -> bool,
    ) -> Self {
        let constant: Vec<bool> = (0..constraints.len()).map(is_constant).collect();
        let reaches: Vec<Reach> = constraints.iter().map(|c| elimination.reach(*c)).collect();
        let rows = SparseRows::new(&reaches);
        let meetings = meetings(&rows);
        let blocks = RowBlocks::new(elimination, constraints);
        let edge = |(i, j): (usize, usize)| (blocks.of_row[i].0, blocks.of_row[j].0);
        let edges: Vec<(usize, usize)> = meetings.iter().map(|(rows, _, _)| edge(*rows)).collect();
        let pattern = Pattern::new(&blocks.sizes, &edges);
        let entry = |i: usize, j: usize| {
            let [(v, r), (w, c)] = [i, j].map(|row| blocks.of_row[row]);
            // Of a block with itself the lower triangle is read.
            let (r, c) = if v == w { (r.max(c), r.min(c)) } else { (r, c) };
            let slot = pattern.slot(v, w).expect("rows that meet have a block");
            slot.entry(r, c)
        };
        let overlap = |((i, j), at, length): &((usize, usize), [usize; 2], usize)| Overlap {
            entry: entry(*i, *j) as u32,
            at: at.map(|at| at as u32),
            length: *length as u32,
        };
        let (fixed, moving) = meetings
            .iter()
            .partition::<Vec<_>, _>(|((i, j), _, _)| constant[*i] && constant[*j]);
        Self {
            fixed: fixed.into_iter().map(overlap).collect(),
            moving: moving.into_iter().map(overlap).collect(),
            constant,
            is_begun: false,
            base: Matrix::zeros(&pattern),
            place: (blocks.of_row.iter())
                .map(|(v, r)| pattern.range(*v).start + r)
                .collect(),
            corners: (0..rows.count()).map(|i| entry(i, i)).collect(),
            factors: Matrix::zeros(&pattern),
            evenness,
            squares: vec![0.0; rows.count()],
            bounds: vec![0.0; rows.count()],
            pivots: vec![0.0; rows.count()],
            counts: vec![false; rows.count()],
            factored: None,
            missing: vec![0.0; rows.count()],
            lambda: vec![0.0; rows.count()],
            y: vec![0.0; elimination.assembly.free()],
            reaches,
            pattern,
            rows,
        }
    }

    /// The rows.
    pub fn rows(&self) -> &SparseRows {
        &self.rows
    }

    /// Whether a row counts: the others do not give it.
    pub fn is_independent(&self, row: usize) -> bool {
        self.counts[self.place[row]]
    }

    /// How many rows count.
    pub fn rank(&self) -> usize {
        self.counts.iter().filter(|counts| **counts).count()
    }

    /// Whether the pivot of a row says that others leave more of it than a part of its size: right where that is well above
    /// the roundoff of pivots, which are squares.
    pub fn may_leave(&self, row: usize, part: f64) -> bool {
        let place = self.place[row];
        self.pivots[place] > part * part * self.squares[place]
    }

    /// Projects a row onto the complement of the independent rows. Returns the size of the remainder relative to the
    /// row, and stores the remainder in `rest`, also relative.
    pub fn part_left(&mut self, row: usize, rest: &mut [f64]) -> f64 {
        let size = self.squares[self.place[row]].sqrt();
        if size == 0.0 {
            return 0.0;
        }
        rest.fill(0.0);
        self.rows.add(row, 1.0 / size, rest);
        self.solve_minimum_norm(3, |_| 0.0, rest);
        short_dot(rest, rest).sqrt()
    }

    /// Whether all rows count.
    pub fn has_full_rank(&self) -> bool {
        self.counts.iter().all(|counts| *counts)
    }

    /// Whether a row needs filling in: a constant one does once.
    pub fn needs(&self, row: usize) -> bool {
        !(self.is_begun && self.constant[row])
    }

    /// Fills in a row from the derivatives of a constraint by nodes: `terms` tells them one by one.
    pub fn fill<const D: usize>(
        &mut self,
        elimination: &Elimination<D>,
        row: usize,
        terms: impl FnOnce(&mut dyn FnMut(usize, &Node<D>)),
    ) {
        self.factored = None;
        let y = &mut self.y;
        terms(&mut |node, term| elimination.assembly.restrict_node(node, term, y));
        elimination.project_within(&self.reaches[row], y);
        for piece in &self.rows.pieces[self.rows.of_row[row].clone()] {
            let (range, at) = (piece.coordinates.clone(), piece.at);
            self.rows.values[at..at + range.len()].copy_from_slice(&y[range.clone()]);
            y[range].fill(0.0);
        }
    }

    /// Factors `J J^T`. A row of which others leave less than `least`, relative to its size, does not count. The square of a row of a light
    /// body is one over its mass. Where other rows hold that body too, what they leave is one over the mass of heavier bodies. That is
    /// no sign of dependence, so a small part of what the heaviest body has of the row is enough.
    pub fn factor(&mut self, least: f64) {
        if self.factored.replace(least) == Some(least) {
            return;
        }
        if !self.is_begun {
            add_products(&self.fixed, &self.rows.values, &mut self.base.values);
            self.is_begun = true;
        }
        self.factors.values.copy_from_slice(&self.base.values);
        add_products(&self.moving, &self.rows.values, &mut self.factors.values);
        let least = least * least;
        let rows = self.place.iter().zip(&self.corners);
        for ((place, corner), evenness) in rows.zip(&self.evenness) {
            let square = self.factors.values[*corner];
            self.squares[*place] = square;
            self.bounds[*place] = least.min(OF_HEAVIEST * evenness).max(ROUNDOFF) * square;
        }
        let (counts, pivots) = (&mut self.counts, &mut self.pivots);
        (self.factors).factor_semidefinite(&self.pattern, &self.bounds, counts, pivots);
    }

    /// Changes `q` by the least that makes `J q = right` as far as rows count. Two passes do so to roundoff; one is
    /// enough for an iteration that begins anew with what is missing.
    pub fn solve_minimum_norm(
        &mut self,
        passes: usize,
        right: impl Fn(usize) -> f64,
        q: &mut [f64],
    ) {
        self.lambda.fill(0.0);
        for _ in 0..passes {
            for (row, place) in self.place.iter().enumerate() {
                self.missing[*place] = if self.counts[*place] {
                    self.rows.product(row, q) - right(row)
                } else {
                    0.0
                };
            }
            self.factors.solve(&self.pattern, &mut self.missing);
            for (row, (place, lambda)) in self.place.iter().zip(&mut self.lambda).enumerate() {
                let part = self.missing[*place];
                if part != 0.0 {
                    self.rows.add(row, -part, q);
                    *lambda += part;
                }
            }
        }
    }

    /// Multipliers: what [`Jacobian::solve_minimum_norm`] took out last is `J^T lambda`, zero for rows that do not count.
    pub fn multipliers(&self) -> &[f64] {
        &self.lambda
    }
}

/// Rows in blocks: those that hold the same bodies, and with them those that hold one of these bodies alone.
struct RowBlocks {
    /// Block of every row and place in it.
    of_row: Vec<(usize, usize)>,
    sizes: Vec<usize>,
}

impl RowBlocks {
    fn new<const D: usize>(elimination: &Elimination<D>, constraints: &[usize]) -> Self {
        let held = |row: usize| elimination.assembly.held(constraints[row]);
        let mut shared: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
        for row in 0..constraints.len() {
            shared.entry(held(row)).or_default().push(row);
        }
        // What holds one body alone has no block of its own where another of it has room: in chains all blocks are
        // equal and follow each other.
        let mut alone = BTreeMap::new();
        shared.retain(|vertices, rows| match vertices {
            [vertex] => alone.insert(*vertex, std::mem::take(rows)).is_some(),
            _ => true,
        });
        let mut blocks: Vec<Vec<usize>> = Vec::new();
        for (vertices, mut rows) in shared {
            let room = rows.len();
            let fits = |vertex: &&usize| alone.get(vertex).is_some_and(|own| own.len() <= room);
            if let Some(own) = vertices.iter().find(fits).and_then(|v| alone.remove(v)) {
                rows.extend(own);
            }
            blocks.push(rows);
        }
        blocks.extend(alone.into_values());
        blocks.sort_unstable();
        let mut of_row = vec![(0, 0); constraints.len()];
        for (block, rows) in blocks.iter().enumerate() {
            for (place, row) in rows.iter().enumerate() {
                of_row[*row] = (block, place);
            }
        }
        Self {
            of_row,
            sizes: blocks.iter().map(Vec::len).collect(),
        }
    }
}

/// Adds the parts of products of rows to the entries of a matrix.
#[inline(always)]
fn add_products(overlaps: &[Overlap], rows: &[f64], entries: &mut [f64]) {
    for Overlap { entry, at, length } in overlaps {
        let [a, b] = at.map(|at| &rows[at as usize..(at + length) as usize]);
        entries[*entry as usize] += short_dot(a, b);
    }
}

/// Where two rows, the earlier one second, have numbers at the same coordinates.
fn meetings(rows: &SparseRows) -> Vec<((usize, usize), [usize; 2], usize)> {
    let mut pieces: Vec<(usize, &RowSegment)> = Vec::new();
    for (row, range) in rows.of_row.iter().enumerate() {
        pieces.extend(rows.pieces[range.clone()].iter().map(|piece| (row, piece)));
    }
    pieces.sort_by_key(|(row, piece)| (piece.coordinates.start, *row));
    let mut meetings = Vec::new();
    let mut open: Vec<(usize, &RowSegment)> = Vec::new();
    for (row, piece) in pieces {
        let start = piece.coordinates.start;
        open.retain(|(_, other)| other.coordinates.end > start);
        open.push((row, piece));
        for (other, before) in &open {
            let length = piece.coordinates.end.min(before.coordinates.end) - start;
            let at = [piece.at, before.at + start - before.coordinates.start];
            meetings.push(((row.max(*other), row.min(*other)), at, length));
        }
    }
    meetings
}

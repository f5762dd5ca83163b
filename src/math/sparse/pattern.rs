//! Which blocks of a sparse symmetric matrix are stored, and in which order they are eliminated.

use std::collections::BTreeSet;
use std::ops::Range;

use super::order::{graph, least_degree, parts, take_out};
use super::panels::{Panel, panels};

/// The elimination order, the stored blocks (with fill) and the components of symmetric matrices
/// over one graph. Vectors are laid out in elimination order: see [`Pattern::range`].
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Variables of every vertex.
    ranges: Vec<Range<usize>>,
    /// Column of every vertex; what stands at an empty vertex has no meaning.
    pub(super) column_of: Vec<usize>,
    component_of: Vec<usize>,
    order: Vec<usize>,
    components: Vec<GraphComponent>,
    pub(super) columns: Vec<Column>,
    /// All columns, in the order they are eliminated.
    pub(super) steps: Vec<Step>,
    /// Columns that are factored together, in order.
    pub(super) panels: Vec<Panel>,
    /// Blocks below the diagonal, column by column, from the first to the last in the order.
    pub(super) rows: Vec<PatternRow>,
    /// For every column and every pair (a, b), b <= a, of its rows: where in the values the block
    /// stands that their product changes; pair (a, b) is number a (a + 1) / 2 + b of the column.
    pub(super) targets: Vec<usize>,
    /// Length of the values.
    pub(super) stored: usize,
}

/// A part of the graph that no edge leaves. Vertices without variables couple nothing, so each is
/// a component of its own.
#[derive(Clone, Debug)]
pub struct GraphComponent {
    /// Where the variables stand in every vector.
    pub variables: Range<usize>,
    /// Where the vertices stand in [`Pattern::order`].
    pub vertices: Range<usize>,
}

/// Columns eliminated in one go.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// One column of any size with any rows.
    Column(usize),
    /// Columns of one of the sizes of [`CHAINS`] and one row each: the next column, of the same size.
    Chain {
        /// Variables of a column.
        size: usize,
        /// The blocks of the columns.
        values: Range<usize>,
        /// The variables of the columns.
        variables: Range<usize>,
    },
}

impl Step {
    /// The step but for its first columns.
    pub fn skip(&self, columns: usize) -> Self {
        let mut step = self.clone();
        if let Self::Chain {
            size,
            values,
            variables,
        } = &mut step
        {
            values.start += columns * 2 * *size * *size;
            variables.start += columns * *size;
        }
        step
    }
}

/// The block sizes for which runs have loops of their own: pins and nodes of cables, in the plane and in space, and
/// hinges in space.
pub(super) const CHAINS: [usize; 5] = [2, 3, 4, 5, 6];

/// Constraints on the same vertices from which on these are eliminated late. A chain that is laid out from its end costs up to an eighth
/// of a planar step (scene `slider_crank`), rows that reach along it a third of a clamped rod's.
const MANY: usize = 3;

/// Does something with the size of a run's blocks known when compiling.
macro_rules! of_size {
    ([$($known:literal)*] or $last:literal, $size:expr, $b:ident => $call:expr) => {
        match $size {
            $($known => {
                const $b: usize = $known;
                $call
            })*
            _ => {
                const $b: usize = $last;
                $call
            }
        }
    };
    ($size:expr, $b:ident => $call:expr) => {
        of_size!([2 3 4 5] or 6, $size, $b => $call)
    };
}
pub(super) use of_size;

/// Where the block of two vertices is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Place of its first entry in the values of the matrix.
    pub at: usize,
    /// Whether the stored block is the transpose of the one asked for.
    pub transposed: bool,
    /// Columns of the stored block, which stands row by row.
    pub columns: usize,
}

impl Slot {
    /// Returns the slot of the transposed block.
    pub fn flipped(self) -> Self {
        Self {
            transposed: !self.transposed,
            ..self
        }
    }

    /// Place, in the values of the matrix, of entry (`row`, `column`) of the block asked for.
    pub fn entry(&self, row: usize, column: usize) -> usize {
        let (row, column) = if self.transposed {
            (column, row)
        } else {
            (row, column)
        };
        self.at + row * self.columns + column
    }
}

/// A vertex with variables: its diagonal block, then its blocks below, are stored row by row from
/// `at` on, without gaps.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub start: usize,
    pub size: usize,
    pub at: usize,
    pub rows: Range<usize>,
    pub targets: usize,
}

#[derive(Clone, Debug)]
pub(super) struct PatternRow {
    pub column: usize,
    pub start: usize,
    pub size: usize,
    pub at: usize,
}

impl Pattern {
    /// The pattern of `sizes.len()` vertices with `sizes[v]` variables each, coupled by `edges`
    /// in any order; repeated edges and edges from a vertex to itself change nothing.
    ///
    /// Vertices are eliminated by least degree (variables of the neighbours), at ties by lowest
    /// index, one component after the other in the order of their lowest vertices.
    ///
    /// # Panics
    ///
    /// If an edge names a vertex that does not exist.
    pub fn new(sizes: &[usize], edges: &[(usize, usize)]) -> Self {
        Self::with_multipliers(sizes, edges, sizes.len())
    }

    /// Builds the pattern of a matrix whose vertices from number `first` on are multipliers. These are rows and columns
    /// of constraints with an empty diagonal. Each is eliminated after the last vertex that it has an edge to, where
    /// its pivot is negative. Multipliers are not linked to each other. The other vertices are eliminated as if a
    /// multiplier linked its vertices in the order of its edges. Among those with the same degree, vertices with at
    /// least [`MANY`] multipliers come last, so that eliminated constraints pass through few vertices.
    ///
    /// Source: M. Benzi, G. H. Golub, J. Liesen, Numerical solution of saddle point problems, Acta Numerica 14 (2005),
    /// section 7.
    ///
    /// # Panics
    ///
    /// If an edge names a vertex that does not exist.
    pub fn with_multipliers(sizes: &[usize], edges: &[(usize, usize)], first: usize) -> Self {
        let mut held: Vec<Vec<usize>> = vec![Vec::new(); sizes.len() - first];
        let mut plain = Vec::with_capacity(edges.len());
        for &(v, w) in edges {
            match v.max(w) {
                last if last < first => plain.push((v, w)),
                last => held[last - first].push(v.min(w)),
            }
        }
        for vertices in &mut held {
            vertices.retain(|v| sizes[*v] > 0);
            plain.extend(vertices.windows(2).map(|pair| (pair[0], pair[1])));
        }
        let mut is_held = vec![false; first];
        let of_many = held.iter().zip(&sizes[first..]);
        let of_many = of_many.filter(|(_, rows)| **rows >= MANY);
        of_many.for_each(|(on, _)| on.iter().for_each(|v| is_held[*v] = true));
        let order = least_degree(&sizes[..first], &plain, &is_held);
        let mut place = vec![0; first];
        order.iter().enumerate().for_each(|(k, v)| place[*v] = k);
        let mut after: Vec<Vec<usize>> = vec![Vec::new(); first];
        let mut alone = Vec::new();
        for (index, vertices) in held.iter().enumerate() {
            match vertices.iter().max_by_key(|v| place[**v]) {
                Some(last) => after[*last].push(first + index),
                None => alone.push(first + index),
            }
        }
        let with_multipliers = order
            .iter()
            .flat_map(|v| [*v].into_iter().chain(after[*v].clone()));
        let order: Vec<usize> = with_multipliers.chain(alone).collect();
        let mut graph = graph(sizes, edges);
        let parts = parts(&graph);
        Self::in_order(sizes, order, &parts, &mut graph)
    }

    /// The pattern of some of the edges over the first `sizes.len()` vertices, as one component. What these edges join stands
    /// together, at the place of its first vertex and in the same order, those that are `late` last: chains that other edges join are chains
    /// again.
    pub fn of_part(&self, sizes: &[usize], edges: &[(usize, usize)], late: &[bool]) -> Self {
        let mut graph = graph(sizes, edges);
        let order = self.order.iter().copied();
        let mut order: Vec<usize> = order.filter(|v| *v < sizes.len()).collect();
        let mut place = vec![0; sizes.len()];
        order.iter().enumerate().for_each(|(k, v)| place[*v] = k);
        let mut first = vec![0; sizes.len()];
        for part in parts(&graph) {
            let least = part.iter().map(|v| place[*v]).min();
            let least = least.expect("a part has a vertex");
            part.iter().for_each(|v| first[*v] = least);
        }
        order.sort_by_key(|v| (first[*v], late[*v]));
        let whole = [order.clone()];
        Self::in_order(sizes, order, &whole, &mut graph)
    }

    /// With the vertices in elimination order, and the components of their graph in this order; the graph is taken
    /// apart.
    fn in_order(
        sizes: &[usize],
        order: Vec<usize>,
        parts: &[Vec<usize>],
        graph: &mut [BTreeSet<usize>],
    ) -> Self {
        let below = order.iter().map(|v| take_out(*v, graph, |_, _| {}));
        let below: Vec<Vec<usize>> = below.collect();
        let mut component_of = vec![0; sizes.len()];
        for (c, part) in parts.iter().enumerate() {
            part.iter().for_each(|&v| component_of[v] = c);
        }
        let mut pattern = Self {
            ranges: vec![0..0; sizes.len()],
            column_of: vec![0; sizes.len()],
            component_of,
            order,
            components: Vec::new(),
            columns: Vec::new(),
            steps: Vec::new(),
            panels: Vec::new(),
            rows: Vec::new(),
            targets: Vec::new(),
            stored: 0,
        };
        pattern.lay_out(sizes, &below);
        pattern.find_steps();
        pattern.panels = panels(&pattern.columns, &pattern.rows);
        pattern.find_components(parts);
        pattern.find_targets();
        pattern
    }

    /// Numbers the variables and places the blocks; `below`: neighbours at elimination, in order.
    fn lay_out(&mut self, sizes: &[usize], below: &[Vec<usize>]) {
        let (mut start, mut columns) = (0, 0);
        for &v in &self.order {
            self.ranges[v] = start..start + sizes[v];
            self.column_of[v] = columns;
            start += sizes[v];
            columns += usize::from(sizes[v] > 0);
        }
        for (&v, below) in self.order.iter().zip(below) {
            let size = sizes[v];
            if size == 0 {
                continue;
            }
            let (first, at) = (self.rows.len(), self.stored);
            let mut end = at + size * size;
            let mut below = below.clone();
            below.sort_unstable_by_key(|&w| self.column_of[w]);
            for w in below {
                self.rows.push(PatternRow {
                    column: self.column_of[w],
                    start: self.ranges[w].start,
                    size: sizes[w],
                    at: end,
                });
                end += size * sizes[w];
            }
            self.columns.push(Column {
                start: self.ranges[v].start,
                size,
                at,
                rows: first..self.rows.len(),
                targets: 0,
            });
            self.stored = end;
        }
    }

    fn find_steps(&mut self) {
        for (j, column) in self.columns.iter().enumerate() {
            let size = column.size;
            let linked = match &self.rows[column.rows.clone()] {
                [row] => row.column == j + 1 && row.size == size && CHAINS.contains(&size),
                _ => false,
            };
            let variables = column.start..column.start + size;
            let values = column.at..column.at + 2 * size * size;
            match self.steps.last_mut() {
                Some(Step::Chain {
                    size: s,
                    values: v,
                    variables: x,
                }) if linked && *s == size && v.end == values.start => {
                    v.end = values.end;
                    x.end = variables.end;
                }
                _ if linked => self.steps.push(Step::Chain {
                    size,
                    values,
                    variables,
                }),
                _ => self.steps.push(Step::Column(j)),
            }
        }
    }

    fn find_components(&mut self, parts: &[Vec<usize>]) {
        let (mut vertices, mut variables) = (0..0, 0..0);
        for part in parts {
            vertices = vertices.end..vertices.end + part.len();
            let size: usize = part.iter().map(|&v| self.ranges[v].len()).sum();
            variables = variables.end..variables.end + size;
            self.components.push(GraphComponent {
                variables: variables.clone(),
                vertices: vertices.clone(),
            });
        }
    }

    fn find_targets(&mut self) {
        for j in 0..self.columns.len() {
            self.columns[j].targets = self.targets.len();
            let rows = self.columns[j].rows.clone();
            for a in rows.clone() {
                let row = self.rows[a].column;
                for b in rows.start..a {
                    self.targets.push(self.below(row, self.rows[b].column).1);
                }
                self.targets.push(self.columns[row].at);
            }
        }
    }

    /// Whether the block of two columns, `row` after `column`, is stored, and where.
    fn below(&self, row: usize, column: usize) -> (bool, usize) {
        let rows = &self.rows[self.columns[column].rows.clone()];
        let found = rows.partition_point(|r| r.column < row);
        rows.get(found)
            .map_or((false, 0), |r| (r.column == row, r.at))
    }

    /// Most numbers of scratch that a panel takes, for every part of a number.
    pub(super) fn scratch(&self) -> usize {
        self.panels.iter().map(Panel::scratch).max().unwrap_or(0)
    }

    /// The vertices with variables, column by column.
    pub(super) fn vertices(&self) -> impl Iterator<Item = &usize> {
        let order = self.order.iter();
        order.filter(|&&v| !self.ranges[v].is_empty())
    }

    /// Number of variables: the length of every vector.
    pub fn len(&self) -> usize {
        self.components.last().map_or(0, |c| c.variables.end)
    }

    /// Whether there are no variables.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Where the variables of vertex `v` stand in every vector.
    pub fn range(&self, v: usize) -> Range<usize> {
        self.ranges[v].clone()
    }

    /// The vertices as they are eliminated and laid out.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The components, in the order of their lowest vertices; each is contiguous.
    pub fn components(&self) -> &[GraphComponent] {
        &self.components
    }

    /// The component of vertex `v`.
    pub fn component_of(&self, v: usize) -> usize {
        self.component_of[v]
    }

    /// Where the block of rows `v` and columns `w` is stored; `None` if it is not, so always zero.
    /// The block of a vertex without variables has no entries and counts as stored.
    pub fn slot(&self, v: usize, w: usize) -> Option<Slot> {
        let transposed = self.ranges[v].start < self.ranges[w].start;
        let (late, early) = if transposed { (w, v) } else { (v, w) };
        let columns = self.ranges[early].len();
        let (stored, at) = if columns == 0 || self.ranges[late].is_empty() {
            (true, 0)
        } else if v == w {
            (true, self.columns[self.column_of[v]].at)
        } else {
            self.below(self.column_of[late], self.column_of[early])
        };
        stored.then_some(Slot {
            at,
            transposed,
            columns,
        })
    }
}

//! How much work the factors over a pattern are, counted without numbers.
//!
//! Source: A. George, J. W. H. Liu, Computer Solution of Large Sparse Positive Definite Systems (1981), section 2.1 (operations of columns).

use super::pattern::{Column, Pattern};

/// Work beyond that of a chain of the same columns, each with the next one below it: what elimination fills in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FactorWork {
    /// Numbers of the factor: products of one substitution.
    pub entries: f64,
    /// Products of the factorization in panels.
    pub in_panels: f64,
    /// Products of the factorization in all other columns.
    pub apart: f64,
}

/// Cost of an entry of an isotropic block over one of another: nine entries are one number, which multiplies a vector at once.
const OF_VECTORS: f64 = 1.0 / 9.0;

/// Numbers and products of a column of so many variables with so many below.
fn of_column(size: usize, below: usize) -> [f64; 2] {
    let variables = (below..below + size).map(|later| later as f64);
    variables.fold([0.0; 2], |[entries, products], later| {
        [entries + later, products + 0.5 * later * (later + 3.0)]
    })
}

impl Pattern {
    /// Work of the factors of its matrices.
    pub fn work(&self) -> FactorWork {
        let mut work = FactorWork::default();
        let mut panels = self.panels.iter().peekable();
        for (j, column) in self.columns.iter().enumerate() {
            while panels.next_if(|panel| panel.columns.end <= j).is_some() {}
            let is_in_panel = panels.peek().is_some_and(|p| p.columns.contains(&j));
            let [entries, products] = self.beyond_chain(column);
            work.entries += entries;
            if is_in_panel {
                work.in_panels += products;
            } else {
                work.apart += products;
            }
        }
        work
    }

    /// Products of a substitution with the factor of a matrix whose blocks are numbers times the identity of space but for those of
    /// vertices that are `directed`. What is eliminated after them depends on the direction, where they are below it.
    pub fn substitution_in_space(&self, directed: &[bool]) -> f64 {
        let is_directed: Vec<bool> = self.vertices().map(|v| directed[*v]).collect();
        let mut depends = is_directed.clone();
        let mut products = 0.0;
        for (j, column) in self.columns.iter().enumerate() {
            for row in &self.rows[column.rows.clone()] {
                let block = (row.size * column.size) as f64;
                let is_whole = depends[j] || is_directed[row.column];
                products += if is_whole { block } else { OF_VECTORS * block };
                depends[row.column] |= depends[j];
            }
        }
        products
    }

    fn beyond_chain(&self, column: &Column) -> [f64; 2] {
        let below = self.rows[column.rows.clone()].iter().map(|row| row.size);
        let (own, chain) = (
            of_column(column.size, below.sum()),
            of_column(column.size, column.size),
        );
        [0, 1].map(|k| (own[k] - chain[k]).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers below the diagonal and products of an elimination, variable by variable: a product for each quotient and each pair.
    fn counted(size: usize, edges: &[(usize, usize)], pattern: &Pattern) -> [f64; 2] {
        let n = pattern.len();
        let mut is_there = vec![vec![false; n]; n];
        let own = (0..n / size).map(|v| (v, v));
        for (v, w) in edges.iter().copied().chain(own) {
            for (i, j) in pattern
                .range(v)
                .flat_map(|i| pattern.range(w).map(move |j| (i, j)))
            {
                (is_there[i][j], is_there[j][i]) = (true, true);
            }
        }
        let [mut entries, mut products] = [0.0; 2];
        for k in 0..n {
            let below: Vec<usize> = (k + 1..n).filter(|i| is_there[*i][k]).collect();
            entries += below.len() as f64;
            for (place, i) in below.iter().enumerate() {
                products += 2.0 + place as f64;
                below.iter().for_each(|j| is_there[*i][*j] = true);
            }
        }
        [entries, products]
    }

    #[test]
    fn work_is_that_of_an_elimination_beyond_chains() {
        let chain: Vec<_> = (1..9).map(|v| (v - 1, v)).collect();
        let pattern = Pattern::new(&[6; 9], &chain);
        assert_eq!(pattern.work(), FactorWork::default());
        // A square mesh, whose elimination fills in, in panels and apart.
        let (size, side) = (6, 14);
        let edges: Vec<_> = (0..side * side)
            .flat_map(|v| {
                [
                    (v, v + 1, v % side + 1 < side),
                    (v, v + side, v + side < side * side),
                ]
            })
            .filter_map(|(v, w, is_edge)| is_edge.then_some((v, w)))
            .collect();
        let pattern = Pattern::new(&vec![size; side * side], &edges);
        let [entries, products] = counted(size, &edges, &pattern);
        let work = pattern.work();
        // What columns with fewer below than in a chain take less is left out.
        let chain = of_column(size, size).map(|of| of * (side * side) as f64);
        let beyond = [entries - chain[0], products - chain[1]];
        let total = work.in_panels + work.apart;
        assert!(work.entries >= beyond[0] && work.entries - beyond[0] < 36.0 + 1e-9);
        assert!(total >= beyond[1] && total - beyond[1] < of_column(size, size)[1]);
        assert!(work.in_panels > 0.0 && work.apart > 0.0, "{work:?}");
    }
}

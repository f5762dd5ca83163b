//! Coordinate partitioning: independent coordinates are integrated, dependent ones, chosen by complete
//! pivoting, follow by Newton's method.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), section 7; R. A. Wehage, E. J. Haug, Generalized
//! coordinate partitioning for dimension reduction in analysis of constrained dynamic systems, J. Mech.
//! Design 104 (1982).

use flexbody::integrators::StateView;
use flexbody::system::{DrivenSystem, State};

/// Most iterations of Newton's method.
const ITERATIONS: usize = 20;
/// Pivot, relative to the first, at which the rest of the rows depends on those before.
const PIVOT: f64 = 1e-9;
/// Residual at which positions are on the constraints.
const EXACT: f64 = 2e-15;
/// Residual of positions, relative, beyond which constraints count as broken.
const BROKEN: f64 = 1e-8;

/// Which coordinates of a system depend on the others.
#[derive(Clone, Debug)]
pub struct Partition {
    /// Numbers of rows and of coordinates.
    size: [usize; 2],
    /// Rows of the Jacobian, one after the other.
    rows: Vec<f64>,
    /// What every row is to change by.
    right: Vec<f64>,
    dependent: Vec<usize>,
    /// Rows, those that determine the dependent coordinates first.
    chosen: Vec<usize>,
    square: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Partition {
    /// Chosen at a state.
    pub fn new(model: &mut DrivenSystem<'_>, state: &State) -> Self {
        let (m, n) = (model.system.constraints(), state.coordinates.len());
        let mut partition = Self {
            size: [m, n],
            rows: vec![0.0; m * n],
            right: vec![0.0; m],
            dependent: Vec::new(),
            chosen: Vec::new(),
            square: vec![0.0; m * (m + 1)],
            q: vec![0.0; n],
            v: vec![0.0; n],
        };
        partition.choose(model, state);
        partition
    }

    /// Chooses anew at a state: as many coordinates as there are independent rows.
    pub fn choose(&mut self, model: &mut DrivenSystem<'_>, state: &State) {
        let [m, n] = self.size;
        self.fill(model, state.time, &state.coordinates, None);
        self.dependent.clear();
        self.chosen = (0..m).collect();
        let mut largest = 0.0;
        for k in 0..m {
            let (mut best, mut size) = ((k, 0), 0.0);
            for i in k..m {
                for (j, value) in self.rows[i * n..(i + 1) * n].iter().enumerate() {
                    if value.abs() > size && !self.dependent.contains(&j) {
                        (best, size) = ((i, j), value.abs());
                    }
                }
            }
            let (row, column) = best;
            if k == 0 {
                largest = size;
            }
            if size <= PIVOT * largest {
                return;
            }
            self.chosen.swap(k, row);
            for j in 0..n {
                self.rows.swap(k * n + j, row * n + j);
            }
            self.dependent.push(column);
            let (done, rest) = self.rows.split_at_mut((k + 1) * n);
            let pivot = &done[k * n..];
            for row in rest.chunks_exact_mut(n) {
                let factor = row[column] / pivot[column];
                row.iter_mut()
                    .zip(pivot)
                    .for_each(|(x, p)| *x -= factor * p);
            }
        }
    }

    /// Coordinates and rates with the dependent ones as the others ask for.
    pub fn completed(
        &mut self,
        model: &mut DrivenSystem<'_>,
        state: StateView<'_>,
        then: impl FnOnce(&mut DrivenSystem<'_>, &[f64], &[f64]),
    ) {
        let (mut p, mut u) = (std::mem::take(&mut self.q), std::mem::take(&mut self.v));
        p.copy_from_slice(state.coordinates);
        u.copy_from_slice(state.rates);
        self.complete(model, state.time, &mut p, &mut u);
        then(model, &p, &u);
        (self.q, self.v) = (p, u);
    }

    /// Moves a state onto the constraints; false where that fails.
    pub fn project(&mut self, model: &mut DrivenSystem<'_>, state: &mut State) -> bool {
        let (q, v) = (&mut state.coordinates, &mut state.rates);
        self.complete(model, state.time, q, v) <= BROKEN
    }

    /// Moves dependent coordinates and rates; the largest residual of positions that is left.
    fn complete(
        &mut self,
        model: &mut DrivenSystem<'_>,
        time: f64,
        q: &mut [f64],
        v: &mut [f64],
    ) -> f64 {
        let mut residual = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let found = self.fill(model, time, q, None);
            let is_settled = found <= EXACT || found > 0.5 * residual;
            residual = found;
            if is_settled {
                break;
            }
            self.solve(q);
        }
        self.fill(model, time, q, Some(v));
        self.solve(v);
        residual
    }

    /// Fills in rows and what they miss, of positions or, where they are given, of rates. Returns the largest
    /// residual, relative to the size of its constraint.
    fn fill(
        &mut self,
        model: &mut DrivenSystem<'_>,
        time: f64,
        q: &[f64],
        v: Option<&[f64]>,
    ) -> f64 {
        let n = self.size[1];
        self.rows.fill(0.0);
        let (mut i, mut largest) = (0, 0.0);
        let system = model.system;
        system.visit_constraints(time, q, v, model.work, |row| {
            self.rows[i * n..(i + 1) * n].copy_from_slice(&row.gradient(n));
            let missing = match v {
                None => row.value(),
                Some(_) => row.rate(),
            };
            self.right[i] = -missing;
            // Not f64::max, which would hide a NaN.
            let residual = missing.abs() / row.size;
            largest = if largest > residual {
                largest
            } else {
                residual + 0.0 * largest
            };
            i += 1;
        });
        largest
    }

    /// Moves dependent coordinates alone so that the rows come to the right-hand sides: Gaussian
    /// elimination with row pivoting.
    fn solve(&mut self, q: &mut [f64]) {
        let (m, n) = (self.dependent.len(), self.size[1]);
        let w = m + 1;
        for i in 0..m {
            for (k, column) in self.dependent.iter().enumerate() {
                self.square[i * w + k] = self.rows[self.chosen[i] * n + column];
            }
            self.square[i * w + m] = self.right[self.chosen[i]];
        }
        let a = &mut self.square;
        for k in 0..m {
            let size = |i: &usize| a[i * w + k].abs();
            let pivot = (k..m)
                .max_by(|i, j| size(i).total_cmp(&size(j)))
                .unwrap_or(k);
            for c in 0..w {
                a.swap(k * w + c, pivot * w + c);
            }
            for i in k + 1..m {
                let factor = a[i * w + k] / a[k * w + k];
                for c in k..w {
                    a[i * w + c] -= factor * a[k * w + c];
                }
            }
        }
        for k in (0..m).rev() {
            let later: f64 = (k + 1..m).map(|c| a[k * w + c] * a[c * w + m]).sum();
            a[k * w + m] = (a[k * w + m] - later) / a[k * w + k];
            q[self.dependent[k]] += a[k * w + m];
        }
    }
}

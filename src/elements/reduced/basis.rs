//! Reduced models in a smaller basis: the first modes of a file, or the modes that the joints and loads of a scene need.
//!
//! Columns `b_a` of a basis are amplitudes of the modes of the file: `eta = sum b_a eta'_a`. Modes of the basis are `psi'_a = sum b_ka psi_k`.
//!
//! Source: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA Journal 6 (1968) 1313-1319 (static shapes and
//! modes with held interfaces).

use nalgebra::{DMatrix, DVector, Vector3};

use super::{Interface, PAIRED, ReducedModel, Symmetric};
use crate::math::eigen::symmetric_eigenvectors;
use crate::math::least::Least;

/// Part of the largest entry below which a pivot of rows counts as zero.
const DEPENDENT: f64 = 1e-9;
/// Part of a shape beside those before it below which it counts as one of them.
const SAME: f64 = 1e-6;
/// Part of the lowest eigenvalue of the file below which a mode with held interfaces is a rigid motion.
const RIGID: f64 = 1e-6;
/// Part of the strain energy of a mode of a basis in modes without second-order displacements up to which these count as complete.
const UNPAIRED: f64 = 1e-3;
/// Modes take part in second-order terms whose eigenvalues are below this multiple of the first one: 30 times its frequency.
const PAIRED_BELOW: f64 = 900.0;

/// A basis of the modes of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalBasis {
    /// Amplitudes of the modes of the file, `[modes of the file][modes of the basis]`.
    pub columns: DMatrix<f64>,
    /// Squares of the natural frequencies of the free body within the basis, ascending, 1/s^2.
    pub eigenvalues: Vec<f64>,
    /// Square of the highest natural frequency of the free body without the static shapes, 1/s^2; zero where there are static shapes alone.
    pub highest: f64,
    /// Number of first modes that take part in second-order terms.
    pub paired: usize,
}

impl ReducedModel {
    /// Returns the basis of the first modes.
    pub fn first_modes(&self, modes: usize) -> ModalBasis {
        let n = modes.min(self.modes());
        let eigenvalues = self.eigenvalues[..n].to_vec();
        ModalBasis {
            columns: DMatrix::identity(self.modes(), n),
            highest: eigenvalues.last().copied().unwrap_or_default(),
            paired: self.paired.min(slow(&eigenvalues)),
            eigenvalues,
        }
    }

    /// Returns the basis of Craig and Bampton within the modes of the model: static shapes of forces that balance each other at held
    /// interfaces, and the lowest natural modes with these interfaces held. Returns `None` where an eigenproblem has no solution.
    ///
    /// - `held`: indices of the interfaces.
    /// - `modes`: number of natural modes beside the static shapes; fewer where the model does not have them.
    pub fn fixed_interface_modes(&self, held: &[usize], modes: usize) -> Option<ModalBasis> {
        let rows = self.rows(held);
        let natural = self.held_modes(&rows)?;
        let natural = &natural[..natural.len().min(modes)];
        let stiffness = DMatrix::from_diagonal(&DVector::from_column_slice(&self.eigenvalues));
        let free = |shapes: &[DVector<f64>]| {
            let basis = independent(self.modes(), shapes);
            let (eigenvalues, vectors) =
                symmetric_eigenvectors(basis.tr_mul(&(&stiffness * &basis)))?;
            Some((eigenvalues, basis * vectors))
        };
        let highest = free(natural)?.0.last().copied().unwrap_or_default();
        let mut shapes = self.static_shapes(&rows);
        shapes.extend_from_slice(natural);
        let (eigenvalues, columns) = free(&shapes)?;
        Some(ModalBasis {
            columns,
            highest,
            paired: if self.paired == 0 {
                0
            } else {
                slow(&eigenvalues)
            },
            eigenvalues,
        })
    }

    /// Whether a body in a basis needs second-order terms of pairs of modes that the model does not have. What is left out of one mode of the
    /// basis is the part of its strain energy in modes of the model that form no pairs.
    pub fn lacks_pairs(&self, basis: &ModalBasis) -> bool {
        let needed = slow(&basis.eigenvalues);
        let columns = basis.columns.column_iter().zip(&basis.eigenvalues);
        columns.take(needed).any(|(column, whole)| {
            let parts = column.iter().zip(&self.eigenvalues).skip(self.paired);
            let left_out: f64 = parts.map(|(by, of)| of * by * by).sum();
            left_out > UNPAIRED * whole
        })
    }

    /// Amplitudes of the modes of the model under forces at rows that balance each other.
    fn static_shapes(&self, rows: &DMatrix<f64>) -> Vec<DVector<f64>> {
        if rows.nrows() == 0 {
            return Vec::new();
        }
        let elastic = rows.columns(6, self.modes());
        let balanced = Least::new(&rows.columns(0, 6).transpose(), DEPENDENT).free();
        let stiffness = DVector::from_column_slice(&self.eigenvalues);
        let shapes =
            (balanced.iter()).map(|forces| elastic.tr_mul(forces).component_div(&stiffness));
        shapes.collect()
    }

    /// Displacements and rotations of held interfaces by rigid motions and modes, `[rows][6 + modes]`: lengths over the radius of
    /// gyration, motions of unit mass.
    fn rows(&self, held: &[usize]) -> DMatrix<f64> {
        let count = 6 + self.modes();
        let size = (self.moments.iter().sum::<f64>() / (2.0 * self.mass)).sqrt();
        let by_mass = 1.0 / self.mass.sqrt();
        let by_moment = self.moments.map(|moment| 1.0 / moment.sqrt());
        let mut rows: Vec<f64> = Vec::new();
        for interface in held.iter().map(|index| &self.interfaces[*index]) {
            let mut add = |of: &dyn Fn(usize) -> Vector3<f64>| {
                for axis in 0..3 {
                    rows.extend((0..count).map(|column| of(column)[axis]));
                }
            };
            let turned = |axis: usize| Vector3::ith(axis, by_moment[axis]);
            add(&|column| match column {
                0..3 => Vector3::ith(column, by_mass / size),
                3..6 => turned(column - 3).cross(&interface.position) / size,
                _ => interface.modes[column - 6] / size,
            });
            if let Some(rotation) = &interface.rotation {
                add(&|column| match column {
                    0..3 => Vector3::zeros(),
                    3..6 => turned(column - 3),
                    _ => rotation[column - 6],
                });
            }
        }
        DMatrix::from_row_slice(rows.len() / count, count, &rows)
    }

    /// Natural modes with held rows as amplitudes of the modes of the model, in the order of their frequencies and without rigid motions.
    fn held_modes(&self, rows: &DMatrix<f64>) -> Option<Vec<DVector<f64>>> {
        let count = 6 + self.modes();
        let free = if rows.nrows() == 0 {
            DMatrix::identity(count, count)
        } else {
            let free = Least::new(rows, DEPENDENT).free();
            if free.is_empty() {
                return Some(Vec::new());
            }
            DMatrix::from_columns(&free)
        };
        let elastic = free.rows(6, self.modes());
        let stiffness = DMatrix::from_diagonal(&DVector::from_column_slice(&self.eigenvalues));
        let (squares, vectors) = symmetric_eigenvectors(elastic.tr_mul(&(stiffness * elastic)))?;
        let lowest = RIGID * self.eigenvalues.first().copied().unwrap_or_default();
        let modes = squares.into_iter().zip(vectors.column_iter());
        let elastic = modes.filter(|(square, _)| *square > lowest);
        Some(
            elastic
                .map(|(_, of)| free.rows(6, self.modes()) * of)
                .collect(),
        )
    }

    /// Returns the model in a basis. What second-order displacements leave to modes as energy depends on which modes there are:
    /// `u_kl` gives back `2 psi_m T_mkl / lambda_m` of the modes of the file and takes that of the modes of the basis, and `J2_kl` likewise.
    #[must_use]
    pub fn in_basis(&self, basis: &ModalBasis) -> Self {
        let (n, paired) = (basis.eigenvalues.len(), basis.paired);
        let cubic = CubicTerms::new(self, basis);
        let columns = &basis.columns;
        let combined = |of: &dyn Fn(usize) -> Vector3<f64>, a: usize| -> Vector3<f64> {
            let terms = columns.column(a).into_owned();
            terms.iter().enumerate().map(|(k, by)| of(k) * *by).sum()
        };
        let inertia_1: Vec<Symmetric> = (0..n)
            .map(|a| {
                let by = columns.column(a);
                std::array::from_fn(|c| {
                    self.inertia_1
                        .iter()
                        .zip(by.iter())
                        .map(|(of, b)| of[c] * b)
                        .sum()
                })
            })
            .collect();
        let mut inertia_2 = vec![[0.0; 6]; n * n];
        for c in 0..6 {
            let second = self.squared(columns, &|at| self.inertia_2[at][c]);
            let before: Vec<f64> = self.inertia_1.iter().map(|of| of[c]).collect();
            let after: Vec<f64> = inertia_1.iter().map(|of| of[c]).collect();
            let moved = cubic.moved(&before, &after);
            for (at, of) in inertia_2.iter_mut().enumerate() {
                of[c] = second[(at / n, at % n)] - moved[(at / n, at % n)];
            }
        }
        let coupling = [0, 1, 2].map(|c| self.squared(columns, &|at| self.coupling[at][c]));
        let interface = |of: &Interface| {
            let modes: Vec<_> = (0..n).map(|a| combined(&|k| of.modes[k], a)).collect();
            Interface {
                name: of.name.clone(),
                position: of.position,
                rotation: (of.rotation.as_ref())
                    .map(|rotation| (0..n).map(|a| combined(&|k| rotation[k], a)).collect()),
                second: self.second_in(of, &modes, basis, &cubic),
                second_rotation: Vec::new(),
                modes,
            }
        };
        Self {
            mass: self.mass,
            moments: self.moments,
            eigenvalues: basis.eigenvalues.clone(),
            coupling: (0..n * n)
                .map(|at| Vector3::from_fn(|c, _| coupling[c][(at / n, at % n)]))
                .collect(),
            paired,
            cubic: cubic.kept(paired),
            interfaces: self.interfaces.iter().map(interface).collect(),
            of_file: Some(match &self.of_file {
                Some(before) => before * columns,
                None => columns.clone(),
            }),
            inertia_1,
            inertia_2,
        }
    }

    /// Second-order displacements of an interface in a basis.
    fn second_in(
        &self,
        interface: &Interface,
        modes: &[Vector3<f64>],
        basis: &ModalBasis,
        cubic: &CubicTerms,
    ) -> Vec<Vector3<f64>> {
        if interface.second.is_empty() {
            return Vec::new();
        }
        let (before, paired) = (self.paired, basis.paired);
        let columns = basis.columns.rows(0, before);
        let components = [0, 1, 2].map(|c| {
            let second =
                DMatrix::from_fn(before, before, |k, l| interface.second[before * k + l][c]);
            let of =
                |modes: &[Vector3<f64>]| modes.iter().map(|mode| 2.0 * mode[c]).collect::<Vec<_>>();
            columns.tr_mul(&(second * columns)) - cubic.moved(&of(&interface.modes), &of(modes))
        });
        let pairs = (0..paired * paired).map(|at| (at / paired, at % paired));
        pairs
            .map(|at| Vector3::from_fn(|c, _| components[c][at]))
            .collect()
    }

    /// A square array of pairs of modes in a basis.
    fn squared(&self, columns: &DMatrix<f64>, of: &dyn Fn(usize) -> f64) -> DMatrix<f64> {
        let all = self.modes();
        let square = DMatrix::from_fn(all, all, |k, l| of(all * k + l));
        columns.tr_mul(&(square * columns))
    }
}

/// Cubic terms of the strain energy, of pairs of modes of a basis.
struct CubicTerms {
    /// Of every mode of the file, as far as its second-order displacements hold them, over its eigenvalue.
    before: Vec<DMatrix<f64>>,
    /// Of every mode of the basis.
    after: Vec<DMatrix<f64>>,
    /// Eigenvalues of the modes of the basis.
    eigenvalues: Vec<f64>,
}

impl CubicTerms {
    fn new(model: &ReducedModel, basis: &ModalBasis) -> Self {
        let (paired, columns) = (model.paired, &basis.columns);
        let n = basis.eigenvalues.len();
        // A linear model has none, of any mode.
        let all = if paired == 0 { 0 } else { model.modes() };
        let stored = |m: usize, k: usize, l: usize| model.cubic[(m * paired + k) * paired + l];
        // Third derivatives of an energy are symmetric in all modes.
        let whole = |m: usize, k: usize, l: usize| match [m, k, l].map(|of| of < paired) {
            [_, true, true] => stored(m, k, l),
            [true, _, true] => stored(k, m, l),
            [true, true, _] => stored(l, m, k),
            _ => 0.0,
        };
        let first = columns.rows(0, paired);
        let before = (0..all).map(|m| {
            let of_file = DMatrix::from_fn(paired, paired, |k, l| stored(m, k, l));
            first.tr_mul(&(of_file * first)) / model.eigenvalues[m]
        });
        let mut after = vec![DMatrix::zeros(n, n); n];
        for m in 0..all {
            let pairs = DMatrix::from_fn(all, all, |k, l| whole(m, k, l));
            let pairs = columns.tr_mul(&(pairs * columns));
            for (a, sum) in after.iter_mut().enumerate() {
                *sum += &pairs * columns[(m, a)];
            }
        }
        Self {
            before: before.collect(),
            after,
            eigenvalues: basis.eigenvalues.clone(),
        }
    }

    /// What pairs of modes move as static answers of single modes, of the modes of the file less those of the basis: `sum x_m T_mkl / lambda_m`.
    fn moved(&self, before: &[f64], after: &[f64]) -> DMatrix<f64> {
        let n = self.eigenvalues.len();
        let mut sum = DMatrix::zeros(n, n);
        for (of, by) in self.before.iter().zip(before) {
            sum += of * *by;
        }
        for ((of, by), eigenvalue) in self.after.iter().zip(after).zip(&self.eigenvalues) {
            sum -= of * (*by / *eigenvalue);
        }
        sum
    }

    /// Those of pairs of the first modes, `[n paired paired]`.
    fn kept(&self, paired: usize) -> Vec<f64> {
        let of_modes = self.after.iter();
        let pairs = of_modes
            .flat_map(|of| (0..paired * paired).map(move |at| of[(at / paired, at % paired)]));
        pairs.collect()
    }
}

/// Number of modes that take part in second-order terms.
fn slow(eigenvalues: &[f64]) -> usize {
    let first = eigenvalues.first().copied().unwrap_or_default();
    let slow = eigenvalues.partition_point(|of| *of < PAIRED_BELOW * first);
    slow.min(PAIRED)
}

/// Orthonormal columns that span the same as given ones, in their order, without those that depend on columns before them.
fn independent(rows: usize, given: &[DVector<f64>]) -> DMatrix<f64> {
    let mut columns: Vec<DVector<f64>> = Vec::new();
    for of in given {
        let size = of.norm();
        let mut column = of / size;
        // Twice is enough: what rounding leaves after the first time is removed.
        for _ in 0..2 {
            for other in &columns {
                column -= other * other.dot(&column);
            }
        }
        let left = column.norm();
        if size > 0.0 && left > SAME {
            columns.push(column / left);
        }
    }
    if columns.is_empty() {
        DMatrix::zeros(rows, 0)
    } else {
        DMatrix::from_columns(&columns)
    }
}
